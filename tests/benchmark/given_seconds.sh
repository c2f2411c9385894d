#!/usr/bin/env bash
# How near run --seconds comes to the seconds that it is given, by a clock of processor seconds: docs/performance.md.
#   tests/benchmark/given_seconds.sh build/release/splashdown SCENE:SECONDS...     e.g. wedge_drop:60
set -euo pipefail
program=$(realpath "$1") examples=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../examples")
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"${CC:-cc}" -O2 -shared -fPIC -o "$scratch/clock.so" "$(dirname "${BASH_SOURCE[0]}")/processor_clock.c"
for case in "$@"; do
  echo "$case"
  LD_PRELOAD="$scratch/clock.so" "$program" run "$examples/${case%:*}/scene.toml" --seconds "${case#*:}" --threads 1 \
    --out "$scratch/run" --force | grep -E '^(refine|chosen  |predicted|reached|   .*with the probes)'
  rm -rf "$scratch"/run*
done
