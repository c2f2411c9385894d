#!/usr/bin/env bash
# The command as scripts use it: exit codes, files, and resumption with the same bits.
#   command_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

{
  wedge_scene 5
  cat <<'SCENE'
frames = 0.02
[[record]]
kind = "pressure"
name = "keel"
body = "wedge"
point = [0, 0]
SCENE
} >scene.toml

same_run() {  # same_run DIR DIR
  cmp "$1/bodies.csv" "$2/bodies.csv" && cmp "$1/probes.csv" "$2/probes.csv" && cmp "$1/frames.pvd" "$2/frames.pvd" &&
    cmp <(simulated "$1/fluid.csv") <(simulated "$2/fluid.csv")
}

run() { "$splashdown" run scene.toml --quiet "$@"; }

# Exit codes
check "help is no error" exits 0 "$splashdown" --help
check "version is no error" exits 0 "$splashdown" --version
check "an unknown option is refused" exits 2 "$splashdown" run scene.toml --bogus
check "a missing subcommand is refused" exits 2 "$splashdown"
check "a missing scene file is refused" exits 2 "$splashdown" run missing.toml
check "a bad scene is refused" exits 2 "$splashdown" run scene.toml --set fluid.density=-3 --out never
check "with its key, value, rule and cure" grep -q 'fluid.density = -3: must be positive (kg/m^3). Use' stderr
check "and nothing is written" test ! -e never
check "a stop after the end is refused" exits 2 "$splashdown" run scene.toml --until 1 --out never
check "check accepts the scene" exits 0 "$splashdown" check scene.toml
check "check refuses a bad one" exits 2 "$splashdown" check scene.toml --set time.end=0
check "report needs a run" exits 2 "$splashdown" report nowhere

check "a run that fills the memory is refused" exits 2 run --set fluid.size.surface=1e-6 --out never
check "with its size and what asks for it" grep -q 'more than .* GB of memory for .* nodes, more than the 4 GB .* --large' stderr
check "and nothing is written" test ! -e never
check "a negative stop is refused" exits 2 "$splashdown" run scene.toml --until -1
check "in few words" grep -q -e '--until: must be a positive number, not -1' stderr
touch file
check "a folder that cannot be made is refused" exits 2 run --out file/run
check "with its name, the reason and a cure" grep -q '^error: file/run: Not a directory. Use another --out' stderr
check "a likely slip is asked about" exits 0 "$splashdown" run scene.toml --until 0.001 --set fluid.density=1 --out slip
check "before the run, which goes on" grep -q 'question: fluid.density = 1: lighter than any liquid .* did you mean 1000?' stderr
check "and in check" exits 0 "$splashdown" check scene.toml --set fluid.density=1
check "among the questions" grep -q 'did you mean 1000?' stdout

# A whole run
check "a run ends well" exits 0 run --out whole
for file in scene.resolved.toml summary.json bodies.csv fluid.csv probes.csv frames.pvd report.html; do
  check "it leaves $file" test -s "whole/$file"
done
check "its last row is at the end time" grep -q '^0.06,wedge,' <(tail -n 1 whole/bodies.csv)
check "the resolved scene is a scene" exits 0 "$splashdown" check whole/scene.resolved.toml
check "the resolved scene makes the same run" exits 0 "$splashdown" run whole/scene.resolved.toml --quiet --out again
check "bit for bit" same_run whole again
check "a finished run may be resumed" exits 0 run --out again --resume
check "and stays what it was" same_run whole again

# Stops and resumption
for until in 0.007 0.018 0.036; do
  check "a run stops at $until s" exits 0 run --out "stopped_$until" --until $until
  check "exactly" grep -q "^$until,wedge," <(tail -n 1 "stopped_$until/bodies.csv")
  check "and continues" exits 0 run --out "stopped_$until" --resume
  check "bit for bit" same_run whole "stopped_$until"
done

check "a spent budget interrupts" exits 130 run --out budget --budget 0.001
check "what is left is a checkpoint" exits 0 run --out budget --resume
check "that continues bit for bit" same_run whole budget
check "a run does not go back" exits 2 run --out budget --resume --until 0.001
check "another scene is not continued" exits 2 run --out budget --resume --set body.wedge.mass=61
check "the message names what differs" grep -q 'body\[0\].mass = 61.0, in the checkpoint 60.0' stderr

for signal in INT TERM; do
  "$splashdown" run scene.toml --quiet --out "signal_$signal" --set time.end=10 &
  pid=$!
  sleep 0.5
  check "a second run in its folder is refused" exits 2 run --out "signal_$signal"
  kill -s $signal $pid
  wait $pid
  check "SIG$signal ends a run with 130" test $? -eq 130
  check "a checkpoint is there" test -s "signal_$signal/checkpoint/state"
done

# A request to stop is answered at once, also while figures are drawn
"$splashdown" run scene.toml --out answered --set time.end=10 >answer_out 2>answer &
pid=$!
sleep 0.5
kill -s INT $pid
wait $pid
check "a stop is answered" grep -q 'stopping after this step; once more stops at once' answer
check "and says where the report comes from" grep -q 'no report: splashdown report answered draws it' answer_out
mkdir slow && printf '#!/bin/sh\nexec sleep 60\n' >slow/gnuplot && chmod +x slow/gnuplot
PATH="$PWD/slow:$PATH" "$splashdown" run scene.toml --out drawn --until 0.002 >/dev/null 2>answer &
pid=$!
for _ in $(seq 100); do
  test -e drawn/summary.json && break
  sleep 0.1
done
sleep 0.5
begin=$SECONDS
kill -s INT $pid
wait $pid
check "a stop while figures are drawn ends with 130" test $? -eq 130
check "within seconds" test $((SECONDS - begin)) -le 5
check "with the way to the report" grep -q 'stopped while the report was drawn: splashdown report drawn draws it' answer
check "and loses nothing" test -s drawn/checkpoint/state

# A light body that the pressure equation does not know, and no pass to spare for it
check "a run that cannot go on ends with 3" exits 3 run --out failed --set body.wedge.mass=1 \
  --set coupling.interface_term=none --set coupling.max_passes=2
check "it names time and cause" grep -q 'could not go on at t = .* the coupling' stderr
check "the last good state is saved" test -s failed/checkpoint/state
check "the summary says so" grep -q '"status": "failed"' failed/summary.json

# Killed at any time, many times
for pause in 0.05 0.3 0.11 0.17 0.23 0.08 0.29 0.41 0.13 0.19 0.37 0.07 0.31 0.21 0.15 0.45 0.09 0.27 0.33 0.25; do
  killed_after $pause "$splashdown" run scene.toml --quiet --out killed --resume
done
check "a run killed twenty times is finished" exits 0 run --out killed --resume
check "bit for bit" same_run whole killed

verdict
