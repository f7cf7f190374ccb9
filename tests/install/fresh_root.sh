#!/usr/bin/env bash
# fresh_root.sh PACKAGE: installs a .deb and the packages that it recommends in a fresh minimal root
# of this system's release, without a source tree. There a new user measures a shipped scene, makes a
# page of its report, reads a mesh and opens a window. Prints how long that took. Needs mmdebstrap,
# the distribution's mirror, and root or the right to make user namespaces.
set -euo pipefail
package=$(realpath "$1")
# shellcheck source=/dev/null
source /etc/os-release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/try" <<'END'
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive HOME=/home/somebody
apt-get -qq update
start=$SECONDS
apt-get -qq -y -o Dpkg::Use-Pty=0 install --install-recommends /tmp/hairbench.deb >/dev/null
echo "installed in $((SECONDS - start)) s with $(du -sm /usr | cut -f 1) MB in /usr"
apt-get -qq -y -o Dpkg::Use-Pty=0 install --no-install-recommends xvfb >/dev/null
useradd --create-home somebody
cd
start=$SECONDS
as() { setpriv --reuid somebody --regid somebody --init-groups "$@"; }
as hairbench run smoke --max-time 1
echo "first result after $((SECONDS - start)) s"
as test -s results/local/smoke.json
as hairbench report results/local/smoke.json -o page.html
as hairbench schema | cmp - /usr/share/hairbench/scenes/scene.schema.json
printf '%s\n' 'o scalp' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'v 0 0 1' 'f 1 3 2' 'f 1 2 4' 'f 1 4 3' 'f 2 3 4' >head.obj
echo '{"groom": {"grow": {"mesh": "head.obj"}}}' >scene.json
[[ $(as hairbench validate scene.json) == 'scene.json: ok, 1 case' ]]
as Xvfb :7 -screen 0 1280x800x24 >/dev/null 2>&1 &
trap "kill $!" EXIT
until [[ -e /tmp/.X11-unix/X7 ]]; do sleep 0.1; done
as env DISPLAY=:7 hairbench view smoke --width 1280 --height 800 --frames 20 --screenshot view.png
[[ $(head -c 4 view.png | tail -c 3) == PNG ]]
END
cp "$package" "$work/hairbench.deb"
# shellcheck disable=SC2016  # "$1" is the hook's
mmdebstrap --quiet --variant=apt --format=null \
    --customize-hook="copy-in '$work/hairbench.deb' '$work/try' /tmp" \
    --customize-hook='chroot "$1" bash /tmp/try' \
    "$VERSION_CODENAME"
echo "the package of $(($(stat -c %s "$package") / 1000000)) MB works in a fresh root of $VERSION_CODENAME"
