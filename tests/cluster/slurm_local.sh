#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A Slurm of several nodes on the loopback of this machine, for tests: job arrays, requeues, nodes that die.
#   slurm_local.sh start DIR NODES PORT   starts it; then SLURM_CONF=DIR/slurm.conf for every command of Slurm
#   slurm_local.sh controller DIR         starts slurmctld again, which must be dead
#   slurm_local.sh node DIR N             starts slurmd of node nN again, which must be dead
#   slurm_local.sh stop DIR               ends its daemons, and only those; a munged that it started stays
# Ports PORT … PORT + NODES must be free. Needs root, and the Debian packages slurm-wlm and munge. It uses the munged of
# the machine, and starts one where none runs. Ends with 77 where something is missing.
set -euo pipefail

verb=${1:?start, controller, node or stop}
dir=$(mkdir -p "${2:?folder}" && cd "$2" && pwd)
export SLURM_CONF=$dir/slurm.conf

missing() {
  echo "not run: $*" >&2
  exit 77
}

write_configuration() {
  local nodes=$1 port=$2 host n
  host=$(hostname -s)
  mkdir -p "$dir"/{state,log,pid}
  {
    echo "ClusterName=trial"
    echo "SlurmctldHost=$host(127.0.0.1)"
    echo "SlurmctldPort=$port"
    echo "SlurmUser=root"
    echo "SlurmdUser=root"
    echo "AuthType=auth/munge"
    echo "CredType=cred/munge"
    # No control groups, no accounts, no limits enforced by the kernel: a container has none of them.
    echo "ProctrackType=proctrack/linuxproc"
    echo "TaskPlugin=task/none"
    echo "JobAcctGatherType=jobacct_gather/none"
    echo "AccountingStorageType=accounting_storage/none"
    echo "MpiDefault=none"
    echo "SchedulerType=sched/backfill"
    echo "SelectType=select/cons_tres"
    echo "SelectTypeParameters=CR_Core"
    # Everything is noticed and done soon: a test does not want to wait.
    echo "SlurmctldTimeout=5"
    echo "SlurmdTimeout=6"
    echo "InactiveLimit=0"
    echo "KillWait=2"
    echo "ReturnToService=2"
    echo "SchedulerParameters=sched_interval=1,bf_interval=2,batch_sched_delay=0,requeue_delay=1"
    echo "StateSaveLocation=$dir/state"
    echo "SlurmdSpoolDir=$dir/spool.%n"
    echo "SlurmctldPidFile=$dir/pid/slurmctld.pid"
    echo "SlurmdPidFile=$dir/pid/slurmd.%n.pid"
    echo "SlurmctldLogFile=$dir/log/slurmctld.log"
    echo "SlurmdLogFile=$dir/log/slurmd.%n.log"
    for ((n = 1; n <= nodes; ++n)); do
      echo "NodeName=n$n NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + n)) CPUs=1 RealMemory=4000 State=UNKNOWN"
    done
    echo "PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP"
  } >"$SLURM_CONF"
}

start_munge() {
  munge -n >/dev/null 2>&1 && return
  mkdir -p /run/munge
  chown munge: /run/munge
  su -s /bin/sh munge -c munged || missing "munged does not start"
}

wait_for_nodes() {
  local n
  for ((n = 0; n < 150; ++n)); do
    [[ $(sinfo --noheader --states=idle --format=%D 2>/dev/null) == "$1" ]] && return
    sleep 0.2
  done
  echo "the nodes did not come up; see $dir/log" >&2
  exit 1
}

case $verb in
start)
  ((EUID == 0)) || missing "starting daemons of Slurm needs root"
  for program in slurmctld slurmd sbatch munged; do
    command -v "$program" >/dev/null || missing "there is no $program; packages slurm-wlm and munge"
  done
  write_configuration "${3:?number of nodes}" "${4:?port}"
  start_munge
  slurmctld
  for ((n = 1; n <= $3; ++n)); do slurmd -N "n$n"; done
  wait_for_nodes "$3"
  ;;
controller) slurmctld ;;
node) slurmd -N "n${3:?number of the node}" ;;
stop)
  for file in "$dir"/pid/*.pid; do
    [[ -s $file ]] || continue
    process=$(cat "$file")
    kill "$process" 2>/dev/null || continue
    for ((n = 0; n < 50; ++n)); do
      kill -0 "$process" 2>/dev/null || break
      sleep 0.1
    done
  done
  ;;
*) echo "unknown: $verb" >&2 && exit 2 ;;
esac
