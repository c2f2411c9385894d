#!/usr/bin/env bash
# Installs what is missing, builds and passes the tests.
#   tests/run.sh [PRESET [CTEST ARGUMENT...]]    PRESET: ci (default), nightly, sanitize
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-ci}
case $preset in
  sanitize) build=sanitize ;;
  *) build=release ;;
esac
# Wall-clock bars are nightly checks: one test at a time there.
jobs=$(nproc)
[ "$preset" != nightly ] || jobs=1
scripts/build.sh "$build"
exec ctest --preset "$preset" --parallel "$jobs" "${@:2}"
