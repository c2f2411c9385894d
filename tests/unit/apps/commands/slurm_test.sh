#!/usr/bin/env bash
# `splashdown study --on slurm` on a real Slurm: arrays longer than it takes, a run that breaks down, a task that is killed, a
# time limit. The test starts munged, slurmctld and slurmd itself; skipped (exit code 77), with the reason, where it may not.
#   slurm_test.sh PATH_OF_SPLASHDOWN
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/checks.sh"
. "$here/slurm_daemons.sh"
trap 'stop_slurm; rm -rf "$work"' EXIT
if ! start_slurm 4; then
  echo "skipped: no Slurm of its own: $why_not"
  exit 77
fi

wedge_scene 0 >scene.toml
cat >study.toml <<'STUDY'
scene = "scene.toml"
[[axis]]
name = "mass"
key = "body.wedge.mass"
values = [60, 30, 1]
[[axis]]
name = "scheme"
[[axis.case]]
name = "exact"
set = ["coupling.interface_term=rigid"]
[[axis.case]]
name = "plain"
set = ["coupling.interface_term=none", "coupling.max_passes=3"]
STUDY
"$splashdown" study study.toml --quiet --out local
status_of() { awk -F, -v run="$2" 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i == "status") s = i} $1 == run {print $s}' "$1/study.csv"; }
same_tables() {
  for run in local/*/bodies.csv; do cmp "$run" "$1/${run#local/}" || return 1; done
}

check "six runs go to a Slurm that takes arrays of four" exits 0 "$splashdown" study study.toml --on slurm --jobs 2 --out array
check "as two arrays" test "$(ls array/study-*.sbatch | wc -l)" = 2
# The first task that shows up is killed as the kernel kills when memory is short.
for ((i = 0; i < 600; ++i)); do
  victim=$(pgrep -f -- "--out $work/array/.*-" | head -n 1) && [[ -n $victim ]] && break
  sleep 0.05
done
out=$(tr '\0' '\n' </proc/"$victim"/cmdline | grep -A 1 -x -- --out | tail -n 1)
sleep 0.1
kill -s KILL "$victim"
killed=$(basename "$out")
check "all jobs end" no_jobs_left 120
check "the killed run, $killed, counts as begun or waiting" grep -qE 'interrupted|waiting' <<<"$(status_of array "$killed")"
broken=mass-1_plain
if [[ $killed != "$broken" ]]; then
  check "a run that breaks down is told as at home" test "$(status_of array $broken)" = "$(status_of local $broken)"
fi
check "the others have ended" test "$(grep -cE ',(converged|diverged|stalled),' array/study.csv)" -ge 5
check "the same command submits what is left" exits 0 "$splashdown" study study.toml --on slurm --jobs 2 --out array
check "and that ends" no_jobs_left 120
check "with every run" test "$(grep -cE ',(converged|diverged|stalled),' array/study.csv)" = 6
check "to the results of a study without Slurm" same_tables array
check "nothing is left to be submitted" exits 0 "$splashdown" study study.toml --on slurm --out array
check "which is said" grep -q 'all runs are finished' stdout

# A minute is the shortest limit; the signal comes up to a minute before it.
cat >long.toml <<'STUDY'
scene = "scene.toml"
set = ["time.end=1000"]
[[axis]]
name = "mass"
key = "body.wedge.mass"
values = [60]
STUDY
rows=1
for part in first second; do
  check "a run that is too long, $part part" exits 0 env SBATCH_TIMELIMIT=1 "$splashdown" study long.toml --on slurm --out long
  check "ends at the time limit" no_jobs_left 240
  check "as interrupted" test "$(status_of long mass-60)" = interrupted
  check "with a checkpoint" test -s long/mass-60/checkpoint/state
  if [[ $part == second ]]; then
    check "which the second part went on from" cmp before.csv <(head -n "$rows" long/mass-60/bodies.csv)
    check "further" test "$(wc -l <long/mass-60/bodies.csv)" -gt "$rows"
  fi
  cp long/mass-60/bodies.csv before.csv
  rows=$(wc -l <before.csv)
done
((failures == 0)) || tail -n 5 array/*.log long/*.log "$slurm"/*.log
verdict
