# What the command's shell tests share; to be sourced. The program to be tested is their first argument, they work in a
# folder of their own, `check` counts what failed, and `verdict` ends them.
set -uo pipefail
splashdown=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

verdict() {
  echo "$failures failures"
  ((failures == 0))
}

check() {  # check DESCRIPTION COMMAND...
  local what=$1
  shift
  if "$@"; then
    echo "ok    $what"
  else
    echo "FAIL  $what"
    failures=$((failures + 1))
  fi
}

exits() {  # exits CODE COMMAND...: the command ends with this code
  local expected=$1
  shift
  "$@" >stdout 2>stderr
  local code=$?
  ((code == expected)) && return 0
  echo "exit code $code instead of $expected: $*"
  cat stdout stderr
  return 1
}

until_true() {  # until_true COMMAND...: waits for what another process brings about, however busy the machine is
  local tries
  for ((tries = 0; tries < 1200; ++tries)); do  # a minute
    "$@" 2>/dev/null && return 0
    sleep 0.05
  done
  echo "FAIL  after a minute still not: $*"
  failures=$((failures + 1))
  return 1
}

under_way() {  # under_way DIR: the run there holds its folder, listens to signals and has made a few steps
  [[ -s $1/bodies.csv ]] && (($(wc -l <"$1/bodies.csv") > 5))
}

killed_after() {  # killed_after SECONDS COMMAND...
  local seconds=$1
  shift
  "$@" &
  local pid=$!
  sleep "$seconds"
  kill -s KILL $pid 2>/dev/null
  wait $pid 2>/dev/null
}

wedge_scene() {  # wedge_scene PITCH_DEG: a coarse wedge that falls on water; its [output] stands last, to be gone on with
  cat <<SCENE
title = "coarse wedge"
[time]
end = 0.06
[gravity]
[tank]
min = [-1, -0.6]
max = [1, 0.6]
[fluid]
density = 1000
[fluid.size]
surface = 0.04
far = 0.1
[[fluid.region]]
shape = "box"
min = [-1, -0.6]
max = [1, 0]
[[body]]
name = "wedge"
mass = 60
position = [0, 0.02]
velocity = [0, -3]
pitch_deg = $1
size = 0.02
shape = { type = "wedge", deadrise_deg = 30, breadth = 0.4, height = 0.2 }
[output]
checkpoint = 0.02
SCENE
}

# Rows of a table without the column of wall-clock seconds, which no two runs share.
simulated() { awk -F, 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i == "wall_seconds") w = i} {$w = ""; print}' "$1"; }
