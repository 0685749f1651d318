#!/usr/bin/env bash
# A Slurm of one machine, for trials and tests: local_slurm.sh start|stop|slurmd FOLDER. It runs Debian's munged,
# slurmctld and slurmd as the calling user, with state, keys and sockets in FOLDER, and without systemd, control groups
# or database. SLURM_CONF=FOLDER/slurm.conf selects it. slurmd: starts only the node's daemon, after it was killed. CPUS
# and MEMORY_MB override the machine's values.
set -euo pipefail
export LC_ALL=C PATH=$PATH:/usr/sbin:/sbin
do=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
export SLURM_CONF=$folder/slurm.conf

free_port() { # a port that nobody listens on
  local port
  while port=$((20000 + RANDOM % 20000)); do
    if ! (: < "/dev/tcp/127.0.0.1/$port") 2> /dev/null; then echo "$port"; return; fi
  done
}

configure() {
  local user host
  user=$(id -un)
  host=$(hostname -s)
  cat > "$SLURM_CONF" << END
ClusterName=local
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,bf_interval=2,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
KillWait=3
MinJobAge=600
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=${CPUS:-$(nproc)} \
RealMemory=${MEMORY_MB:-$(awk '/^MemTotal/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)} State=UNKNOWN
PartitionName=local Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
}

stop() {
  local daemon pid
  for daemon in slurmd slurmctld munged; do
    pid=$(cat "$folder/$daemon.pid" 2> /dev/null || true)
    [ -z "$pid" ] || kill "$pid" 2> /dev/null || true
    for _ in $(seq 50); do
      if [ -z "$pid" ] || ! kill -0 "$pid" 2> /dev/null; then break; fi
      sleep 0.1
    done
  done
}

alive() { [ -e "$1" ] && kill -0 "$(cat "$1")" 2> /dev/null; }

case $do in
  start)
    for program in munged slurmctld slurmd sbatch; do
      command -v $program > /dev/null || { echo "local-slurm: $program is not there: apt install munge slurmctld slurmd slurm-client" >&2; exit 1; }
    done
    if alive "$folder/slurmctld.pid"; then echo "local-slurm: runs already in $folder"; exit 0; fi
    rm -rf "${folder:?}"/{state,spool,munge*,*.pid,*.log}
    mkdir -p "$folder"/{state,spool}
    trap stop EXIT  # none of the daemons is left behind if another does not start
    chmod 755 "$folder"
    (umask 077 && dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none)
    munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
      --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
    configure
    slurmctld
    slurmd
    for _ in $(seq 100); do
      if [ "$(sinfo -h -o %T 2> /dev/null || true)" = idle ]; then
        trap - EXIT
        echo "local-slurm: ready; export SLURM_CONF=$SLURM_CONF"
        exit 0
      fi
      sleep 0.2
    done
    echo "local-slurm: the node did not come up; see $folder/slurmctld.log and slurmd.log" >&2
    exit 1 ;;
  slurmd) slurmd ;;
  stop) stop ;;
  *) echo "local_slurm.sh start|stop|slurmd FOLDER" >&2; exit 2 ;;
esac
