#!/usr/bin/env bash
# Installs what is missing, builds and passes the tests.
#   tests/run.sh [PRESET [CTEST ARGUMENT...]]    PRESET: ci (default), nightly, sanitize, threads, fuzz, fuzz_nightly
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-ci}
more=()  # lists of packages
case $preset in
  sanitize) build=sanitize ;;
  threads) build=threads ;;
  fuzz*) build=fuzz more=(tests/fuzz/packages.txt) ;;
  nightly) build=release more=(tests/packages_nightly.txt) ;;
  *) build=release ;;
esac
# Wall-clock bars are nightly checks: one test at a time there.
jobs=$(nproc)
[ "$preset" != nightly ] || jobs=1
scripts/build.sh --tests "$build" "${more[@]}"
exec ctest --preset "$preset" --parallel "$jobs" "${@:2}"
