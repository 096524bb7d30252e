#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A Slurm of this machine alone, on the loopback address and below one folder, while a command runs:
#
#   testenv/farm/slurm.sh FOLDER COMMAND...
#
# It needs munged, slurmctld and slurmd (Debian: apt-get install slurmctld slurmd slurm-client munge) and the rights of root. The
# command finds it by $SLURM_CONF. Ports follow from the process's number, so that two do not meet.
set -euo pipefail

[ $# -ge 2 ] || { echo "usage: slurm.sh FOLDER COMMAND..." >&2; exit 2; }
mkdir -p "$1"
folder=$(cd "$1" && pwd -P)
shift
for program in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || { echo "slurm.sh: $program is missing" >&2; exit 3; }
done
[ "$(id -u)" = 0 ] || { echo "slurm.sh: slurmd needs the rights of root" >&2; exit 3; }
PATH=$PATH:/usr/sbin
cores=${SLURM_CORES:-$(nproc)}
host=$(hostname -s)
port=$((20000 + $$ % 20000))
started=()
tidy() {
    scancel --quiet --state=RUNNING --state=PENDING --user=root 2>/dev/null || true
    local pid
    for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done
    wait 2>/dev/null || true
}
trap tidy EXIT

umask 022
mkdir -p "$folder"/{state,spool,log}
mkdir -p -m 0711 "$folder/munge"
chmod 0711 "$folder/munge"
if [ ! -s "$folder/munge/key" ]; then
    (umask 077 && head -c 1024 /dev/urandom >"$folder/munge/key")
fi
munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" >"$folder/log/munged" 2>&1 &
started+=($!)

cat >"$folder/slurm.conf" <<END
ClusterName=patina
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/log/slurmctld
SlurmdLogFile=$folder/log/slurmd
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=bf_interval=1,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores RealMemory=1000 State=UNKNOWN
PartitionName=local Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
export SLURM_CONF=$folder/slurm.conf
slurmctld -D >"$folder/log/slurmctld.out" 2>&1 &
started+=($!)
slurmd -D -N "$host" >"$folder/log/slurmd.out" 2>&1 &
started+=($!)

for _ in $(seq 100); do
    [ "$(sinfo --noheader --format=%t 2>/dev/null || true)" = idle ] && break
    sleep 0.2
done
[ "$(sinfo --noheader --format=%t 2>/dev/null || true)" = idle ] || {
    echo "slurm.sh: the node does not become idle; logs are in $folder/log" >&2
    tail -n 5 "$folder"/log/* >&2
    exit 1
}
"$@"
