#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# slurm.sh COMMAND...: a Slurm of one node, this machine, without systemd: starts munged, slurmctld and
# slurmd in the foreground of a folder of their own, runs COMMAND with SLURM_CONF set, and stops them.
# The exit status is that of COMMAND; 77, with a reason on stderr, where it cannot start.
set -u

cannot() {
    echo "no Slurm here: $1" >&2
    for log in "$folder"/*.log; do
        [ ! -s "$log" ] || tail -n 3 "$log" >&2
    done
    exit 77
}

folder=$(mktemp -d /tmp/jostle-slurm-XXXXXX) # short: names of sockets have 107 characters at most
children=()
stop() {
    [ ${#children[@]} -eq 0 ] || kill "${children[@]}" 2>/dev/null
    wait
    rm -rf "$folder"
}
trap stop EXIT

[ "$(id -u)" -eq 0 ] || cannot 'it needs root'
PATH=$PATH:/usr/sbin:/sbin
for tool in munged slurmctld slurmd sbatch sinfo; do
    command -v $tool >/dev/null || cannot "there is no $tool"
done

host=$(hostname -s)
cores=$(getconf _NPROCESSORS_ONLN)
port=$((20000 + RANDOM % 20000))
mkdir "$folder/state" "$folder/spool" "$folder/munge"
chmod 755 "$folder" "$folder/munge"
cat >"$folder/slurm.conf" <<END
ClusterName=jostle
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=10 State=UP
END
echo 'CgroupPlugin=cgroup/v1' >"$folder/cgroup.conf"

# start NAME WORD...: as a child that is stopped in the end.
start() {
    local name=$1
    shift
    "$@" >"$folder/$name.out.log" 2>&1 </dev/null &
    children+=($!)
}

# until WORD...: waits 15 s for the command to succeed.
until_good() {
    for _ in $(seq 75); do
        "$@" >/dev/null 2>&1 && return 0
        sleep 0.2
    done
    return 1
}

node_is_idle() {
    [ "$(sinfo -h -o %T)" = idle ]
}

export SLURM_CONF=$folder/slurm.conf
head -c 128 /dev/urandom >"$folder/munge/key"
chmod 600 "$folder/munge/key"
start munged munged --foreground --force --socket="$folder/munge/socket" \
    --key-file="$folder/munge/key" --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" \
    --log-file="$folder/munged.log"
until_good test -S "$folder/munge/socket" || cannot 'munged does not start'
start slurmctld slurmctld -D -c
start slurmd slurmd -D
until_good node_is_idle || cannot 'its node does not become idle'
"$@"
