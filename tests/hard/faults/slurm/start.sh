#!/usr/bin/env bash
# A Slurm of this machine alone, with its files in DIR; as root. Ends with the processes whose numbers are in DIR/*.pid.
set -euo pipefail
dir=$(realpath "${1:?usage: start.sh DIR}")
host=$(hostname -s)
mkdir -p "$dir"/{state,spool} /run/munge
cat > "$dir/slurm.conf" <<C
ClusterName=test
SlurmctldHost=$host
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=cred_expire=2
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
ReturnToService=2
SelectType=select/cons_tres
NodeName=$host CPUs=$(nproc) RealMemory=$(awk '/^MemTotal/ {print int($2 / 1024)}' /proc/meminfo) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
C
export SLURM_CONF="$dir/slurm.conf"
[ -f /etc/munge/munge.key ] || mungekey
chown -R munge: /etc/munge /run/munge /var/log/munge /var/lib/munge
# One may be running already, and is left alone then.
if ! pgrep -x munged > /dev/null; then
  runuser -u munge -- munged
  cp /run/munge/munged.pid "$dir/munged.pid"
fi
slurmctld -D > "$dir/slurmctld.log" 2>&1 &
slurmd -D > "$dir/slurmd.log" 2>&1 &
for _ in $(seq 100); do
  [ "$(sinfo -h -o %T 2> /dev/null)" = idle ] && exit 0
  sleep 0.2
done
echo "no node of Slurm is idle: see $dir/slurmctld.log" >&2
exit 1
