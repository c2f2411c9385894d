#!/usr/bin/env bash
# Installs the build to a scratch prefix and builds and runs the example that knows only the package.
#   install_test.sh CMAKE BUILD_DIR CXX_COMPILER CXX_FLAGS
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cmake=$1 build=$2 compiler=$3 flags=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$cmake" --install "$build" --prefix "$scratch/prefix" >"$scratch/install.log" || { cat "$scratch/install.log"; exit 1; }

"$cmake" -DINCLUDE="$scratch/prefix/include/splashdown" -DOUT="$scratch/headers.cpp" -P "$here/every_header.cmake"
# The flags are a list of words.
# shellcheck disable=SC2086,SC2046
"$compiler" $flags -std=c++20 -fsyntax-only -I"$scratch/prefix/include/splashdown" $(pkg-config --cflags eigen3) \
  "$scratch/headers.cpp"

"$cmake" -S "$here/../../../examples/library" -B "$scratch/library" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_CXX_STANDARD=20 -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/configure.log" || {
  cat "$scratch/configure.log"
  exit 1
}
"$cmake" --build "$scratch/library"
"$scratch/library/wedge_load" >"$scratch/loads.txt" || { cat "$scratch/loads.txt"; exit 1; }

# What the example's README promises comes out, with the compiler's options that it is built with there.
promised=$(sed -n 's/^ *\([0-9.]* ms  *-[0-9.]* m\/s  *[0-9.]* kN\/m\)$/\1/p' "$here/../../../examples/library/README.md")
if [[ -z $flags ]] && ! tail -n 1 "$scratch/loads.txt" | grep -qF -- "$promised"; then
  echo "examples/library/README.md promises '$promised', wedge_load ends with:"
  tail -n 1 "$scratch/loads.txt"
  exit 1
fi
