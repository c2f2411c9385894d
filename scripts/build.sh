#!/usr/bin/env bash
# Installs the Debian packages that are missing, configures and builds.
#   scripts/build.sh [PRESET]                        the program; PRESET of CMakePresets.json, default: release
#   scripts/build.sh --tests [PRESET [LIST...]]      program, tests and benchmarks; LIST: files of further packages
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tests=
[[ ${1:-} == --tests ]] && tests=yes && shift
preset=${1:-release}
lists=(scripts/packages.txt "${@:2}")
[[ -z $tests ]] || lists+=(tests/packages.txt)

# shellcheck source=scripts/packages.sh
source scripts/packages.sh
mapfile -t missing < <(missing_packages "${lists[@]}")

# The largest source needs 2.9 GB, some two, most one.
jobs=$(nproc)
by_memory=$(awk '/^MemAvailable:/ {print int($2 / 2500000)}' /proc/meminfo)
((by_memory >= jobs)) || jobs=$((by_memory > 1 ? by_memory : 1))

if [[ ! -x build/$preset/splashdown && -z $tests ]]; then
  cpu_minutes=12  # measured with g++ 12 on two busy cores, the run included (tests/bare_machine/run.sh root): 708 s
  echo "Splashdown has to be compiled first: about $((cpu_minutes / jobs + 1)) minutes with $jobs compilers at a time of up to 3 GB of memory each,"
  echo "and 0.5 GB of disk in build/$preset."
  ((${#missing[@]} == 0)) || echo "Before that packages are installed: 0.1 GB to load and 0.65 GB of disk on a system that has compilers."
fi

((${#missing[@]} == 0)) || install_packages "${missing[@]}"

if [[ -n $tests ]]; then
  cmake --preset "$preset" -DBUILD_TESTING=ON
  cmake --build --preset "$preset" --parallel "$jobs"
else
  # A folder that has the tests keeps them.
  [[ -f build/$preset/CMakeCache.txt ]] || off=-DBUILD_TESTING=OFF
  cmake --preset "$preset" ${off:+"$off"}
  cmake --build --preset "$preset" --parallel "$jobs" --target splashdown
fi
[[ ! -x build/$preset/splashdown ]] || echo "splashdown is built: build/$preset/splashdown"
