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
check "a scene without a subcommand, too" exits 2 "$splashdown" scene.toml
check "with the subcommand that is meant" grep -q 'scene.toml: what is to be done with it? Use e.g. splashdown run scene.toml' stderr
check "a misspelt subcommand is refused" exits 2 "$splashdown" rum scene.toml
check "with the right one" grep -q 'rum: there is no such command. Did you mean run?' stderr
check "a misspelt option is refused" exits 2 "$splashdown" run scene.toml --thread 2
check "with the right one" grep -q -e '--thread: not expected here. Did you mean --threads?' stderr
check "a blank for an equals sign is refused" exits 2 "$splashdown" check scene.toml --set time.end 1
check "with how it is written" grep -q 'must read KEY=VALUE, without blanks, e.g. --set time.end=1' stderr
check "a hull is no scene" exits 2 "$splashdown" check hull.stl
check "and stands in one" grep -q 'hull.stl: is a hull, not a scene. Name a scene in which a body has' stderr
check "a scene is no study" exits 2 "$splashdown" study scene.toml
check "and is run" grep -q 'scene.toml: is a scene, not a study. Use splashdown run scene.toml' stderr
printf 'scene = "scene.toml"\n' >study.toml
check "a study is no scene" exits 2 "$splashdown" run study.toml
check "and is made" grep -q 'study.toml: is a study, not a scene. Use splashdown study study.toml' stderr
check "a missing scene file is refused" exits 2 "$splashdown" run missing.toml
check "a bad scene is refused" exits 2 "$splashdown" run scene.toml --set fluid.density=-3 --out never
check "with its key, value, rule and cure" grep -q 'fluid.density = -3: must be positive (kg/m^3). Use' stderr
check "and nothing is written" test ! -e never
check "a stop after the end is refused" exits 2 "$splashdown" run scene.toml --until 1 --out never
check "check accepts the scene" exits 0 "$splashdown" check scene.toml
check "check refuses a bad one" exits 2 "$splashdown" check scene.toml --set time.end=0
# At rest: what holds a body counts, and hollows are dry until water comes over the rim.
cat >harbour.toml <<'SCENE'
[time]
end = 1
[gravity]
[tank]
min = [-8, -9]
max = [8, 5]
[fluid]
density = 1000
[[fluid.region]]
shape = "box"
min = [-8, -9]
max = [8, 0]
[[body]]
name = "pile"
shape = {type = "box", width = 1, height = 1}
density = 500
free = ["y"]
position = [-5, 0]
[[body]]
name = "flap"
shape = {type = "box", width = 1, height = 4}
density = 300
position = [-2, -3]
[[body]]
name = "trough"
shape = {type = "polygon", points = [[-1, 0], [1, 0], [1, 1], [0.9, 1], [0.9, 0.1], [-0.9, 0.1], [-0.9, 1], [-1, 1]]}
density = 2000
position = [3, 0.5]
[[joint]]
type = "hinge"
body = "flap"
point = [-2, -5]
SCENE
check "check knows what holds bodies" exits 0 "$splashdown" check harbour.toml
check "held upright" grep -q 'draft of 0.5 m, pitch 0 deg, .*(free in y only)' stdout
check "on a hinge" grep -q 'lowest point 5 m deep, pitch 0 deg, .*(hinge to the world)' stdout
check "floating on a hollow" grep -q 'floats with a draft of 0.38 m, pitch 0 deg, GM' stdout
check "that is dry" grep -q 'dry until water comes over its rim, 0.62 m above the water' stdout
check "check sees liquid in a hollow" exits 0 "$splashdown" check harbour.toml --set 'body.trough.position=[3, -0.5]'
check "and takes it as flooded" grep -q 'a region reaches into it: taken as flooded' stdout
check "so that it sinks" grep -q 'sinks: heavier than the water it can displace' stdout

check "report needs a run" exits 2 "$splashdown" report nowhere

check "a run that fills the memory is refused" exits 2 run --set fluid.size.surface=1e-6 --out never
check "with its size and what asks for it" grep -q 'more than .* GB of memory for .* nodes, more than the 4 GB .* --large' stderr
check "and nothing is written" test ! -e never
check "a negative stop is refused" exits 2 "$splashdown" run scene.toml --until -1
check "in few words" grep -q -e '--until: must be a positive number, not -1' stderr
touch file
check "a folder that cannot be made is refused" exits 2 run --out file/run
check "with what is in the way" grep -q 'file/run: .*/file is a file, where a folder is needed. Use another --out' stderr
for place in file/run /proc/run /dev/null/run; do  # where nobody may write, root included
  for command in "run scene.toml --quiet" "run scene.toml --quiet --seconds 9" "price scene.toml --quiet"; do
    check "$command --out $place is refused" exits 2 "$splashdown" $command --out $place
    check "before anything is written" test "$(find . -newer file ! -name stdout ! -name stderr ! -name . ! -name file | wc -l)" = 0
  done
done
chmod 755 .
nobody="setpriv --reuid=65534 --clear-groups $splashdown"
if ((EUID == 0)) && $nobody --version >/dev/null 2>&1; then
  mkdir closed && chmod 755 closed
  for place in closed closed/run; do
    check "a folder without permission is refused" exits 2 $nobody run scene.toml --quiet --out $place
    check "with the system's reason" grep -q "$place: files cannot be written.*: Permission denied. Use another --out" stderr
    check "and nothing is written" test -z "$(ls -A closed)"
  done
fi
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

for threads in 2 4; do
  check "a run on $threads threads" exits 0 run --out "threads_$threads" --threads $threads
  check "makes the same bits" same_run whole "threads_$threads"
done

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
check "which is told where even the first mesh was not ready" exits 130 run --out early --budget 1e-9
check "with nothing written" test ! -e early
check "and why" grep -q 'the budget of 1e-09 s was spent before the first mesh was ready; nothing is written' stderr
check "a run does not go back" exits 2 run --out budget --resume --until 0.001
check "another scene is not continued" exits 2 run --out budget --resume --set body.wedge.mass=61
check "the message names what differs" grep -q 'body\[0\].mass = 61.0, in the checkpoint 60.0' stderr

# Checkpoints that cannot be used
damage() {  # damage FILE: a byte in its middle
  printf '\x5a\xa5' | dd of="$1" bs=1 seek=$(($(stat -c %s "$1") / 2)) conv=notrunc status=none
}
check "two checkpoints are kept" test -s stopped_0.018/checkpoint/state -a -s stopped_0.018/checkpoint/previous
check "a run stops" exits 0 run --out older --until 0.036
damage older/checkpoint/state
check "one whose newest checkpoint is damaged goes on from the one before" exits 0 run --out older --resume
check "says so although it is quiet" grep -q 'note: older/checkpoint/state is damaged: its checksum does not agree' stderr
check "and from where" grep -q 'note: continuing from the checkpoint before, older/checkpoint/previous, t = ' stderr
check "to the same bits" same_run whole older
check "a run stops again" exits 0 run --out lost --until 0.036
cp lost/bodies.csv bodies.before
damage lost/checkpoint/state
sed -i 's/splashdown checkpoint [0-9]*/splashdown checkpoint 2/' lost/checkpoint/previous
check "without any good one it is not continued" exits 2 run --out lost --resume
check "the message says which is damaged" grep -q 'error: --resume: lost/checkpoint/state is damaged' stderr
check "which is of another version" grep -q 'lost/checkpoint/previous was written by another version of splashdown (format 2' stderr
check "and what to do" grep -q 'nothing was changed. Continue it with the version .*(--out), or with --restart instead' stderr
check "and nothing was changed" cmp bodies.before lost/bodies.csv
rm -r lost/checkpoint
check "nor is one that has lost its checkpoints" exits 2 run --out lost --resume
check "which is told" grep -q 'lost holds tables of a run, but no checkpoint' stderr
check "its tables stay" cmp bodies.before lost/bodies.csv
check "--restart and --resume exclude each other" exits 2 run --out lost --resume --restart
check "--restart begins anew" exits 0 run --out lost --restart
check "bit for bit" same_run whole lost

# One folder, two scenes
mkdir cone wedge
cp scene.toml cone/scene_45.toml
sed 's/coarse wedge/other wedge/' scene.toml >wedge/scene_45.toml
for folder in cone wedge; do
  check "a scene of a name that others have" exits 0 "$splashdown" run $folder/scene_45.toml --quiet --set time.end=0.001
  check "has a folder of its own" test -s out/${folder}_scene_45/bodies.csv
done
cp out/cone_scene_45/bodies.csv bodies.before
check "another scene does not replace what is there" exits 2 \
  "$splashdown" run wedge/scene_45.toml --quiet --out out/cone_scene_45 --set time.end=0.002
check "the message names both" grep -q "out/cone_scene_45 holds the results of another scene, 'coarse wedge' (.*/cone/scene_45.toml); this one is 'other wedge' (.*/wedge/scene_45.toml)" stderr
check "and the ways out" grep -q 'Use --out with another folder, or --force to replace it' stderr
check "nothing was changed" cmp bodies.before out/cone_scene_45/bodies.csv
check "the same scene may" exits 0 "$splashdown" run cone/scene_45.toml --quiet --set time.end=0.002
check "and the other one by force" exits 0 "$splashdown" run wedge/scene_45.toml --quiet --out out/cone_scene_45 --force --set time.end=0.002

mkdir -p mine/checkpoint mine/report
echo mine | tee mine/checkpoint/weights >mine/report/figure.svg
check "nor are files replaced that no run has left" exits 2 run --out mine
check "which is told" grep -q 'mine holds checkpoint, which would be replaced, but no scene.resolved.toml: no run has left it. Use --out' stderr
check "they stay" test -s mine/checkpoint/weights -a -s mine/report/figure.svg

# A folder that goes away under a run
long=(--set time.end=10 --set time.dt_max=1e-4)  # minutes before the wedge is at the floor
{ "$splashdown" run scene.toml --quiet --out gone/here "${long[@]}" 2>gone.said; echo $? >gone.code; } &
until_true under_way gone/here
mv gone/here gone/away  # at once: removing file by file meets pictures that are written meanwhile
rm -rf gone/away 2>/dev/null
wait
check "a run whose folder is removed ends with 3" grep -qx 3 gone.code
check "says what is gone" grep -q 'error: gone/here/.* was removed, moved or replaced while the run was writing it, at t = .* s, step' gone.said
check "and where the rest is" grep -q 'saved in .*gone/here.rescued, without frames and pictures; --out .* --resume' gone.said
rows=$(wc -l <gone/here.rescued/bodies.csv)
check "its rows are there" test "$rows" -gt 5
last=$(tail -n 1 gone/here.rescued/bodies.csv | cut -d, -f1)
stop=$(awk -v t="$last" 'BEGIN {print t + 0.002}')
check "it goes on" exits 0 run --out gone/here.rescued --resume "${long[@]}" --until "$stop"
check "as one that was left alone" exits 0 run --out gone/alone "${long[@]}" --until "$stop"
check "bit for bit" cmp gone/here.rescued/bodies.csv gone/alone/bodies.csv

for signal in INT TERM; do
  "$splashdown" run scene.toml --quiet --out "signal_$signal" "${long[@]}" &
  pid=$!
  until_true under_way "signal_$signal"
  check "a second run in its folder is refused" exits 2 run --out "signal_$signal"
  kill -s $signal $pid
  wait $pid
  check "SIG$signal ends a run with 130" test $? -eq 130
  check "a checkpoint is there" test -s "signal_$signal/checkpoint/state"
done

# A request to stop is answered at once, also while figures are drawn
"$splashdown" run scene.toml --out answered "${long[@]}" >answer_out 2>answer &
pid=$!
until_true under_way answered
kill -s INT $pid
wait $pid
check "a stop is answered" grep -q 'stopping after this step; once more stops at once' answer
check "and says where the report comes from" grep -q 'no report: splashdown report answered draws it' answer_out
mkdir slow && printf '#!/bin/sh\ntouch "%s/drawing"\nexec sleep 60\n' "$PWD" >slow/gnuplot && chmod +x slow/gnuplot
PATH="$PWD/slow:$PATH" "$splashdown" run scene.toml --out drawn --until 0.002 >/dev/null 2>answer &
pid=$!
until_true test -e drawing
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

# A heavy body, and nothing that holds it at the floor
{
  sed '/^\[\[body\]\]/,$d; s/coarse wedge/stone/; s/end = 0.06/end = 0.6/' scene.toml
  printf '[[body]]\nname = "stone"\nshape = {type = "circle", radius = 0.1}\ndensity = 2600\nposition = [0, -0.3]\nsize = 0.02\n'
} >stone.toml
check "a body on its way through the floor is asked about" exits 0 "$splashdown" check stone.toml
check "with wall, time and cure" grep -q "body.stone may reach the tank's floor at about t = 0.* s, .* did you mean to add \[contact\]" stdout
check "a run ends where it gets there" exits 3 "$splashdown" run stone.toml --out stone --no-report
check "before, it asked" grep -q "question: body.stone may reach the tank's floor" stderr
check "it names body, wall and time" grep -q "could not go on .*: body.stone goes through the tank's floor: at (.*) m, t = 0" stderr
check "and the cure" grep -q 'Add \[contact\]' stderr
check "the last good state is saved" test -s stone/checkpoint/state
check "with contact it does not end there" exits 0 "$splashdown" run stone.toml --out held --no-report --quiet --set "contact={}" --until 0.3

# Stills and films: what is refused before any browser is looked for, and what is said where there is none
check "render needs to know what" exits 2 "$splashdown" render whole
check "with both ways" grep -q 'Use --time T -o FILE.png, or --movie FILE.mp4' stderr
check "a time after the run is refused" exits 2 "$splashdown" render whole --time 7
check "with those that there are" grep -q -e '--time 7: the run has frames from 0 s to 60 ms' stderr
check "a run without frames has no film" exits 2 "$splashdown" render held --movie film.mp4
check "with the line that records them" grep -q 'frames = 0.01' stderr
check "a misspelt view is no view" exits 2 "$splashdown" render whole --time 0 --veiw bow
check "with the right one" grep -q -e 'Did you mean --view?' stderr
check "render says what is not installed" exits 2 env PATH=/nowhere "$splashdown" render whole --movie film.mp4
check "and how to get it" grep -q 'sudo apt-get install chromium ffmpeg' stderr
check "and leaves no film" test ! -e film.mp4

# Killed at any time, many times
for pause in 0.05 0.3 0.11 0.17 0.23 0.08 0.29 0.41 0.13 0.19 0.37 0.07 0.31 0.21 0.15 0.45 0.09 0.27 0.33 0.25; do
  killed_after $pause "$splashdown" run scene.toml --quiet --out killed --resume
done
check "a run killed twenty times is finished" exits 0 run --out killed --resume
check "bit for bit" same_run whole killed

verdict
