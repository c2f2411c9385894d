#!/usr/bin/env bash
# clang-tidy with the checks of .clang-tidy over the sources of a folder, all at once:   tests/lint/tidy.sh FOLDER...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
together=$(mktemp --suffix=.cpp)
trap 'rm -f "$together"' EXIT
find "$@" -name '*.cpp' | LC_ALL=C sort | sed 's/.*/#include "&"/' > "$together"
flags=(-std=c++20 -I. -DBT_USE_DOUBLE_PRECISION)
for headers in /usr/include/eigen3 /usr/include/bullet /usr/include/hypre /usr/include/suitesparse; do flags+=(-isystem "$headers"); done
clang-tidy --quiet --config-file=.clang-tidy --warnings-as-errors='*' "$together" -- "${flags[@]}" 2> >(grep -v 'warnings\? generated' >&2)
