#!/bin/sh
# Runs studies/slurm.sh on a Slurm of one node, made for the purpose from Debian's packages: submits a
# study as a job array, kills one of its workers in mid-run, submits it again, merges, and compares the
# table with that of the same study made on one machine.
#
#   cargo build --release --bin abrade && sh benches/slurm/run.sh
#
# Takes a Debian or Ubuntu, and root for the daemons; installs slurm-wlm where it is missing.
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
ABRADE=${ABRADE:-$top/target/release/abrade}
dir=$(mktemp -d)
export ABRADE SLURM_CONF="$dir/slurm.conf" OUT="$dir/cluster" STUDY="$dir/study.ron"
fail() { echo "failed: $*" >&2; exit 1; }

[ -x "$ABRADE" ] || fail "no $ABRADE: cargo build --release --bin abrade"
command -v slurmctld >/dev/null || { apt-get update -q && apt-get install -y -q slurm-wlm munge; } >"$dir/apt.log" 2>&1 \
  || fail "slurm-wlm cannot be installed, see $dir/apt.log"

end() {
  kill "$(cat "$dir/slurmctld.pid" 2>/dev/null)" "$(cat "$dir/slurmd.pid" 2>/dev/null)" 2>/dev/null || true
}
trap end EXIT
trap 'exit 1' INT TERM

if ! munge -n </dev/null >/dev/null 2>&1; then
  [ -s /etc/munge/munge.key ] || { dd if=/dev/urandom bs=1 count=1024 of=/etc/munge/munge.key 2>/dev/null; chown munge: /etc/munge/munge.key; chmod 400 /etc/munge/munge.key; }
  mkdir -p /run/munge && chown munge: /run/munge
  su -s /bin/sh munge -c /usr/sbin/munged
fi
host=$(hostname -s)
mkdir "$dir/state" "$dir/spool"
cat >"$SLURM_CONF" <<CONF
ClusterName=abrade
SlurmctldHost=$host
SlurmUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
ReturnToService=2
NodeName=$host CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for _ in $(seq 60); do sinfo -h -o %t 2>/dev/null | grep -q idle && break; sleep 1; done
sinfo -h -o %t | grep -q idle || fail "the node does not come up, see $dir"

# Every case of the shipped study, with fewer impacts each.
sed 's/samples: .*/samples: (least: 48, most: 48),/' "$top/studies/sphere_vs_angular.ron" >"$STUDY"

drain() { while [ -n "$(squeue -h)" ]; do sleep 1; done; }
count() { "$ABRADE" sweep "$STUDY" --out "$OUT" --list | grep -c ' there ' || true; }

submit() { sbatch --parsable --array=0-3 --chdir="$dir" "$top/studies/slurm.sh"; }
job=$(submit)
# Killed when its shard has made a case and has others to make.
has_made() { "$ABRADE" sweep "$STUDY" --out "$OUT" --list | grep -q "^ *$1  there "; }
for _ in $(seq 600); do has_made 1 && break; sleep 0.1; done
has_made 1 || fail "the second shard makes nothing, see $dir"
scancel --full --signal=KILL "${job}_1" || fail "there was nothing left to kill"
drain
all=$("$ABRADE" sweep "$STUDY" --out "$OUT" --list | wc -l)
first=$(count)
[ "$first" -lt "$all" ] || fail "the killed worker left nothing undone"
if "$ABRADE" sweep "$STUDY" --out "$OUT" --merge >/dev/null 2>&1; then fail "a merge with cases missing succeeds"; fi
submit >/dev/null
drain
[ "$(count)" = "$all" ] || fail "$(count) of $all cases after the second run, see $dir"
"$ABRADE" sweep "$STUDY" --out "$OUT" --merge >/dev/null
"$ABRADE" study erosion "$STUDY" --out "$dir/machine" >/dev/null
for table in cases.csv grains.csv cases.jsonl; do
  cmp "$OUT/$table" "$dir/machine/$table" || fail "$table differs"
done
echo "one worker of four killed: $first of $all cases; submitted again: $all; tables alike to the byte"
rm -r "$dir"
