#!/usr/bin/env bash
# `splashdown study --on slurm` on a Slurm that runs on this machine. Skipped (exit code 77) where there is none.
#   slurm_test.sh PATH_OF_SPLASHDOWN FOLDER_OF_EXAMPLES
set -uo pipefail
splashdown=$1
examples=$2
if ! command -v sbatch >/dev/null || ! sinfo --noheader >/dev/null 2>&1; then
  echo "skipped: no Slurm answers on this machine (sbatch, sinfo); install slurm-wlm and start slurmctld and slurmd"
  exit 77
fi
work=$(mktemp -d -p "${SLURM_TEST_FOLDER:-/tmp}")  # on a cluster: a folder that all nodes see
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cat >study.toml <<STUDY
scene = "$examples/release_under_water/scene.toml"
set = ["time.end=0.0002", "body.cylinder.size=0.06"]
[[axis]]
name = "density"
key = "body.cylinder.density"
values = [1000, 100]
STUDY
"$splashdown" study study.toml --on slurm --jobs 2 --out out || exit 1
for ((i = 0; i < 120; ++i)); do
  [[ $(grep -c converged out/study.csv 2>/dev/null) == 2 ]] && break
  sleep 1
done
cat out/*.log 2>/dev/null
[[ $(grep -c converged out/study.csv) == 2 ]]
