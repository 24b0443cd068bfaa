#!/usr/bin/env bash
# Four shards as an array of a real Slurm on this machine, merged by a job that waits for them, are the bytes
# of one run. Usage: slurm_test.sh CROON CHECKOUT; ends with 77 where it cannot run.
# shellcheck source=shards.sh
source "$(dirname "$0")/shards.sh" "$@"

for program in slurmctld slurmd sbatch munged; do
  PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || skip "Slurm is not installed: no $program"
done
[[ $(id -u) -eq 0 ]] || skip 'a Slurm of its own needs root'
PATH=$PATH:/usr/sbin
host=$(hostname -s)
getent hosts "$host" >/dev/null || skip "the name of this host, $host, does not resolve"

daemons=()
stop() {
  local status=$?
  # The newest first: slurmd tells slurmctld, and both speak through munged.
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    kill "${daemons[i]}" 2>/dev/null || true
    wait "${daemons[i]}" 2>/dev/null || true
  done
  if [[ $status -ne 0 ]]; then tail -n 20 "$folder"/{,log/,out%j/log/}*.log || true; fi
  rm -rf "$folder"
}
trap stop EXIT
trap 'exit 1' INT TERM

is_taken() { (: <"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
port=$((20000 + $$ % 5000 * 2))
while is_taken "$port" || is_taken "$((port + 1))"; do port=$((port + 2)); done

mkdir "$folder"/{munge,state,spool,log}
cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/sock
CredType=cred/munge
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=1
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf

# $1: what is waited for; then the command that tells that it is there. The test fails after some two minutes.
wait_until() {
  local what=$1
  shift
  for ((i = 0; i < 600; ++i)); do
    if "$@"; then return 0; fi
    sleep 0.2
  done
  echo "waited in vain for $what" >&2
  return 1
}

# The daemon ends with this shell even where the shell is killed and has no time for its trap.
start_daemon() {
  setpriv --pdeathsig TERM "$@" </dev/null >>"$folder/log/daemons.log" 2>&1 &
  daemons+=($!)
}

dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 status=none
chmod 400 "$folder/munge/key"
start_daemon munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/sock" \
  --pid-file="$folder/munge/pid" --log-file="$folder/log/munged.log" --seed-file="$folder/munge/seed"
wait_until munged test -S "$folder/munge/sock"
start_daemon slurmctld -D -f "$SLURM_CONF"
start_daemon slurmd -D -f "$SLURM_CONF" -N "$host"
is_idle() { [[ $(sinfo -h -o %T 2>/dev/null) == idle ]]; }
wait_until 'an idle node' is_idle

write_experiment
# In Slurm's own paths a percent sign begins a pattern; %j is the job's number.
"$scripts/submit.sh" "$folder/small.json" "$folder/out%j" 4
run_in_one_piece
is_done() { [[ -z $(squeue -h 2>/dev/null || echo unknown) ]]; }
wait_until 'the jobs' is_done
compare_with_one_piece "$folder/out%j"
[[ -s "$folder/out%j/log/merge.log" ]]
