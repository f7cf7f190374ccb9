"""Makes minimal roots of Debian and runs commands in them."""

import shlex
import subprocess
import sys
from pathlib import Path


def run(*command, **options):
    print("container test:", shlex.join(map(str, command))[:200], file=sys.stderr, flush=True)
    return subprocess.run(command, check=True, text=True, **options)


def mirror():
    """Returns the archive that this machine's own apt installs from, and its components."""
    said = run("apt-get", "indextargets", "--format", "$(REPO_URI) $(COMPONENT)", "Created-By: Packages",
               stdout=subprocess.PIPE).stdout
    found = [line.split() for line in said.splitlines() if "security" not in line]
    uris = [uri for uri, component in found if component == "main" and uri.startswith("http")]
    if not uris:
        sys.exit("container test: apt on this machine names no archive; apt-get update makes its lists")
    return uris[0], sorted({component for uri, component in found if uri == uris[0]})


def make(root, suite, *packages):
    """Makes a root of the suite with only the essential packages, apt and these packages. Takes them
    from the sources of this machine's own apt."""
    sources = [
        path for path in (Path("/etc/apt/sources.list"), *Path("/etc/apt").glob(
            "sources.list.d/*.sources")) if path.is_file() and suite in path.read_text()]
    if not sources:  # this machine has another release
        uri, components = mirror()
        sources = [f"deb {uri} {suite} {' '.join(components)}"]
    include = [f"--include={','.join(packages)}"] if packages else []
    run("mmdebstrap", "--quiet", "--variant=minbase", *include, suite, root, *sources)


def command_inside(root, command):
    """Returns the command line that runs a command there, with its own processes, devices and environment."""
    path = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
    mounts = f"mount --rbind /dev {root}/dev && mount --rbind /sys {root}/sys && exec \"$@\""
    return ["unshare", "--mount", "--pid", "--fork", f"--mount-proc={root}/proc", "sh", "-c", mounts, "sh", "chroot",
            root, "/usr/bin/env", "-i", f"PATH={path}", "HOME=/root", "LC_ALL=C.UTF-8", *command]


def inside(root, command, **options):
    """Runs a command there, as command_inside() says."""
    return run(*command_inside(root, command), **options)
