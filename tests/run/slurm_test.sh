#!/usr/bin/env bash
# Runs a sweep as a job array of a real Slurm, on this machine alone. scripts/sweep.sbatch must give
# the result of a single run. scripts/test --slurm calls it as root. Usage: tests/run/slurm_test.sh
# PROGRAM
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

program=$(realpath "$1")
work=$(mktemp -d)
chmod 755 "$work"
daemons=()

stop() {
    local i
    # The last started is stopped first: slurmd still has to tell slurmctld.
    for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
        kill "${daemons[i]}" 2>/dev/null || true
        wait "${daemons[i]}" 2>/dev/null || true
    done
    rm -rf "$work"
}
trap stop EXIT

fail() {
    echo "slurm test: $*" >&2
    local log
    for log in "$work"/*.log "$work"/sweep.shards/*.log; do
        [[ ! -s $log ]] || { echo "---- $log" && tail -n 20 "$log"; } >&2
    done
    exit 1
}

start() { # name command...
    local name=$1
    shift
    "$@" >"$work/$name.log" 2>&1 &
    daemons+=($!)
}

wait_until() { # seconds what command...
    local seconds=$1 what=$2 end
    shift 2
    end=$((SECONDS + seconds))
    until "$@" >/dev/null 2>&1; do
        ((SECONDS < end)) || fail "$what: not after $seconds s"
        sleep 0.1
    done
}

free_port() {
    local port
    for ((port = 20000 + RANDOM % 20000; ; ++port)); do
        # The port is free if nothing answers.
        (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null || break
    done
    echo "$port"
}

# ---- One node of Slurm --------------------------------------------------------------------------

dd if=/dev/urandom of="$work/munge.key" bs=128 count=1 status=none
chmod 600 "$work/munge.key"
start munged munged --foreground --force --key-file="$work/munge.key" --socket="$work/munge.socket" \
    --pid-file="$work/munged.pid" --seed-file="$work/munge.seed" --log-file="$work/munged.out"
wait_until 30 "munged" test -S "$work/munge.socket"

node=$(hostname -s)
mkdir "$work/state" "$work/spool"
cat >"$work/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
MailProg=/bin/true
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$work/slurm.conf
start slurmctld slurmctld -D -i -f "$SLURM_CONF"
wait_until 30 "slurmctld" scontrol ping
start slurmd slurmd -D -N "$node" -f "$SLURM_CONF"
node_is_idle() { [[ $(sinfo --noheader --format=%t) == idle ]]; }
wait_until 60 "slurmd" node_is_idle

# ---- The sweep ----------------------------------------------------------------------------------

export HAIRBENCH=$program
options=(-a "/strands/density=8,12,16" --no-pictures)
said=$(scripts/sweep.sbatch -o "$work/sweep.json" scenes/smoke.json 2 -- "${options[@]}")
echo "$said"
[[ $said =~ array\ ([0-9]+) ]] || fail "which job is the array?"
task=${BASH_REMATCH[1]}_1
# In the middle of a shard, Slurm takes the node away and gives it back. Slurm by itself would wait
# two minutes in between.
shard_has_a_case() { (($(wc -l <"$work/sweep.shards/1.json.journal") > 1)); }
wait_until 120 "the first case" shard_has_a_case
scontrol requeue "$task"
task_waits() { [[ $(squeue --noheader --jobs "$task" --format=%t) == PD ]]; }
wait_until 60 "the requeued task" task_waits
scontrol update "JobId=$task" StartTime=now
queue_is_empty() { [[ -z $(squeue --noheader) ]]; }
wait_until 600 "the jobs" queue_is_empty
[[ -f $work/sweep.json ]] || fail "there is no merged report"
cat "$work/sweep.shards/merge.log"
for shard in 1 2; do
    grep -q "^report: " "$work/sweep.shards/$shard.log" || fail "shard $shard did not run"
done

grep -E "continuing after [12] of 3 cases" "$work/sweep.shards/1.log" ||
    fail "the requeued shard did not go on where it was"

"$program" run scenes/smoke.json "${options[@]}" --out "$work/whole.json" >"$work/run.log" 2>&1 ||
    fail "the run without shards"
python3 - "$work/sweep.json" "$work/whole.json" <<'END' || fail "the reports differ"
import json, sys

# Everything except parts that differ between runs: times, and the environment's start and command.
def lasting(path):
    report = json.load(open(path))
    for each in report["cases"]:
        assert each["status"] == "ok", each
        for member in ("metrics", "sampling", "conditions", "trust", "order"):
            each.pop(member, None)
    report.pop("order_seed", None)
    for member in ("started", "command"):
        report["environment"].pop(member)
    return report

sweep, whole = map(lasting, sys.argv[1:])
assert len(sweep["cases"]) == 6, len(sweep["cases"])
assert sweep == whole, "\n" + json.dumps(sweep) + "\n" + json.dumps(whole)
END
echo "slurm test: $(sbatch --version), 2 shards, 6 cases, one shard requeued: the merged report equals the whole one's"

# Finished shards are not run again.
scripts/sweep.sbatch -o "$work/sweep.json" scenes/smoke.json 2 -- "${options[@]}"
wait_until 600 "the jobs" queue_is_empty
for shard in 1 2; do
    grep -q "nothing left to do" "$work/sweep.shards/$shard.log" || fail "shard $shard ran again"
done
echo "slurm test: submitted again, nothing was left to do"
