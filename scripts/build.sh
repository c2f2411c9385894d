#!/usr/bin/env bash
# Installs the Debian packages that are missing, configures and builds.
#   scripts/build.sh [PRESET]      PRESET of CMakePresets.json, default: release
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}

missing=()
while read -r package; do
  dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done < <(grep -v '^#' scripts/packages.txt)

if ((${#missing[@]})); then
  echo "installing: ${missing[*]}"
  as_root=()
  ((EUID == 0)) || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

# CGAL and VTK sources need up to 1.5 GB a compiler.
jobs=$(nproc)
by_memory=$(awk '/^MemAvailable:/ {print int($2 / 1500000)}' /proc/meminfo)
((by_memory >= jobs)) || jobs=$((by_memory > 1 ? by_memory : 1))

cmake --preset "$preset"
cmake --build --preset "$preset" --parallel "$jobs"
