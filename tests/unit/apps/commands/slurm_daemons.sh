# A Slurm of its own for a test, one node that is this machine; to be sourced with the folder `work` set. Its daemons run as
# whoever runs the test, on ports and sockets of their own, and know of no other Slurm. `start_slurm` fails with the reason
# in `why_not`; `stop_slurm` ends what was started.
slurm_pids=()
why_not=

start_slurm() {  # start_slurm MAX_ARRAY_SIZE
  local program user host
  # Debian keeps daemons out of the PATH of users.
  PATH=$PATH:/usr/sbin:/sbin
  for program in munged slurmctld slurmd sbatch squeue scontrol scancel; do
    command -v $program >/dev/null || { why_not="there is no $program (Debian: slurm-wlm, munge)"; return 1; }
  done
  user=$(id -un) host=$(hostname -s)
  slurm=$(mktemp -d -p "$work" slurm.XXXX)
  chmod 755 "$work" "$slurm"
  mkdir "$slurm"/{state,spool}
  head -c 1024 /dev/urandom >"$slurm/munge.key"
  chmod 400 "$slurm/munge.key"
  local port=$((20000 + RANDOM % 20000))
  cat >"$slurm/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MaxArraySize=$1
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$slurm/slurm.conf
  munged --foreground --socket="$slurm/munge.socket" --key-file="$slurm/munge.key" --pid-file="$slurm/munged.pid" \
    --log-file="$slurm/munged.log" --seed-file="$slurm/munged.seed" >"$slurm/munged.out" 2>&1 &
  slurm_pids+=($!)
  for ((i = 0; i < 100; ++i)); do [[ -S $slurm/munge.socket ]] && break; sleep 0.1; done
  [[ -S $slurm/munge.socket ]] || { why_not="munged does not start: $(tail -n 1 "$slurm/munged.out")"; return 1; }
  slurmctld -D -c >"$slurm/slurmctld.out" 2>&1 &
  slurm_pids+=($!)
  slurmd -D -N "$host" >"$slurm/slurmd.out" 2>&1 &
  slurm_pids+=($!)
  for ((i = 0; i < 300; ++i)); do
    sinfo --noheader -o %T 2>/dev/null | grep -qx idle && return 0
    sleep 0.1
  done
  why_not="its node does not come up: $(cat "$slurm"/{slurmctld,slurmd}.out "$slurm"/{slurmctld,slurmd}.log 2>/dev/null | grep -i -m 1 -E 'fatal|error')"
  return 1
}

stop_slurm() {
  # The last first: slurmd ends what it runs.
  ((${#slurm_pids[@]})) || return 0
  scancel --user="$(id -un)" 2>/dev/null
  local k
  for ((k = ${#slurm_pids[@]} - 1; k >= 0; --k)); do
    kill "${slurm_pids[k]}" 2>/dev/null
    wait "${slurm_pids[k]}" 2>/dev/null
  done
  slurm_pids=()
}

no_jobs_left() {  # no_jobs_left SECONDS
  for ((i = 0; i < 5 * $1; ++i)); do
    [[ -z $(squeue --noheader 2>/dev/null) ]] && return 0
    sleep 0.2
  done
  squeue
  return 1
}
