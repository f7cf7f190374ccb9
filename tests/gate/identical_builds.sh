#!/bin/sh
# Runs gates of a build with itself, which must find nothing:
#   tests/gate/identical_builds.sh build/release [GATES [OPTION ...]]
# Takes some ten minutes for 20 gates on two cores. It is not part of the tests, which must pass on
# a busy machine, too. Options go to the gate, for example --metrics 'time$'.
set -u
build=${1:?a build folder}
gates=${2:-20}
[ $# -gt 1 ] && shift
shift
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
wrong=0
i=0
while [ "$i" -lt "$gates" ]; do
    i=$((i + 1))
    "$build/benchmarks/hairbench" gate --a "$build" --b "$build" \
        --scene "$root/scenes/smoke.json" --filter 'msaa:1$' --max-time 0 --calibrate 12 \
        "$@" -o "$folder/gate.json" > "$folder/said" 2>&1
    status=$?
    echo "$i: exit status $status: $(grep -E '^[0-9]+ regressed' "$folder/said")"
    if [ "$status" -ne 0 ] || ! grep -q ' 0 improved' "$folder/said"; then
        wrong=$((wrong + 1))
        cat "$folder/said"
    fi
done
echo "$wrong of $gates wrong"
[ "$wrong" -eq 0 ]
