#!/usr/bin/env bash
# From an empty machine to a wedge that drops on water: installs what is missing, builds, runs.
# Further arguments go to `splashdown run`, e.g.  --set body.wedge.mass=20
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/build.sh release
exec build/release/splashdown run examples/wedge_drop/scene.toml --out out/wedge_drop "$@"
