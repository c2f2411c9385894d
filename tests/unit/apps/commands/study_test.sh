#!/usr/bin/env bash
# `splashdown study` as scripts use it: what it leaves behind, killed in the middle and resumed, on Slurm.
#   study_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

wedge_scene 0 >scene.toml

cat >study.toml <<'STUDY'
scene = "scene.toml"
[[axis]]
name = "mass"
key = "body.wedge.mass"
values = [60, 1]
[[axis]]
name = "scheme"
[[axis.case]]
name = "exact"
set = ["coupling.interface_term=rigid"]
[[axis.case]]
name = "plain"
set = ["coupling.interface_term=none", "coupling.max_passes=3"]
[[quantity]]
name = "speed"
table = "bodies.csv:wedge"
quantity = "last(vy)"
reference = {scheme = "exact"}
unit = "m/s"
[chart]
x = "mass"
series = "scheme"
STUDY

study() { "$splashdown" study study.toml --quiet "$@"; }

same_results() {
  cmp <(simulated "$1/study.csv") <(simulated "$2/study.csv") || return 1
  for run in "$1"/*/bodies.csv; do
    cmp "$run" "$2/${run#"$1"/}" || return 1
  done
}
# Inode and time of last change of all files of the runs that are finished.
prints_of_finished() {
  for summary in "$1"/*/summary.json; do
    grep -q '"status": "\(done\|failed\)"' "$summary" && find "$(dirname "$summary")" -type f -printf '%p %i %T@\n'
  done 2>/dev/null | sort
}

check "a study needs a file" exits 2 "$splashdown" study missing.toml
sed 's/wedge.mass/wegde.mass/' study.toml >bad.toml
check "a bad study is refused" exits 2 "$splashdown" study bad.toml --out never
check "with place, key and rule" grep -q 'bad.toml:5: axis.mass: body.wegde.mass=60: no body .*Did you mean' stderr
check "and nothing is written" test ! -e never

check "a study ends well although a scheme breaks down" exits 0 study --out whole
for file in study.csv study.json; do check "it leaves $file" test -s "whole/$file"; done
if command -v gnuplot >/dev/null; then check "and a chart" test -s whole/study.svg -a -s whole/study.png; fi
check "and its report" grep -q 'All 4 runs have ended' whole/report.html
check "which links the reports of its runs" grep -q 'href="mass-60_exact/report.html"' whole/report.html
cp whole/report.html before.html
rm whole/report.html
check "splashdown report writes it anew" exits 0 "$splashdown" report whole
check "to the same bytes" cmp before.html whole/report.html
check "a folder that holds neither a run nor a study is refused" exits 2 "$splashdown" report .
check "and the reason is told" grep -q 'neither a run .* nor a study' stderr
check "all runs have ended" test "$(grep -c -E 'converged|diverged|stalled' whole/study.csv)" = 4
check "the scheme without a term breaks down for the light body" grep -qE '^mass-1_plain,1,plain,(diverged|stalled),' whole/study.csv
check "the exact one does not" grep -q '^mass-1_exact,1,exact,converged,[a-z]*,' whole/study.csv

prints_of_finished whole >before
check "a finished study is made in no time" exits 0 study --out whole
check "and nothing in its runs is touched" cmp before <(prints_of_finished whole)

# Killed in the middle, with every child dead or dying, until it gets no further
for pause in 0.2 0.4 0.6 0.3 0.8; do
  killed_after $pause "$splashdown" study study.toml --quiet --out killed --jobs 2
done
"$splashdown" study study.toml --quiet --out killed &
pid=$!
for ((i = 0; i < 600; ++i)); do
  prints_of_finished killed >before
  (($(grep -c summary.json before) >= 2)) && break
  sleep 0.05
done
kill -s KILL $pid 2>/dev/null
wait $pid 2>/dev/null
# The runs of a killed study save a checkpoint or end their report; from then on nothing may change.
for ((i = 0; i < 600; ++i)); do
  pgrep -f -- "--out $work/killed/" >/dev/null || break
  sleep 0.05
done
check "the runs of a killed study end by themselves" test $i -lt 600
prints_of_finished killed >before
check "some runs were finished before the kill" test -s before
check "the rest is finished by the same command" exits 0 study --out killed --jobs 2
check "what was finished is untouched" cmp before <(grep -F -f <(cut -d' ' -f1 before) <(prints_of_finished killed))
check "results are those of an undisturbed study" same_results whole killed

"$splashdown" study study.toml --quiet --out stopped &
pid=$!
until_true compgen -G 'stopped/*/bodies.csv' >/dev/null
kill -s TERM $pid
wait $pid
check "SIGTERM ends a study with 130" test $? -eq 130
check "and it goes on" exits 0 study --out stopped
check "to the same results" same_results whole stopped

# Another value: only what is new is made.
prints_of_finished whole >before
sed 's/60, 1/60, 1, 30/' study.toml >more.toml
check "a longer axis" exits 0 "$splashdown" study more.toml --quiet --out whole
check "makes its new runs only" cmp before <(grep -F -f <(cut -d' ' -f1 before) <(prints_of_finished whole))
check "which are there" test "$(grep -c '^mass-30_' whole/study.csv)" = 2

# What no study made is never removed
mkdir -p sandbox/docs sandbox/inner
echo treasure >sandbox/docs/book
echo treasure >sandbox/book
names_study() {  # names_study NAME...: a study with cases of these names
  printf 'scene = "%s/scene.toml"\nset = ["time.end=0.001"]\n[[axis]]\nname = "case"\n' "$work"
  printf '[[axis.case]]\nname = "%s"\nset = []\n' "$@"
}
names_study docs >sandbox/study.toml
check "a case of the name of a folder is refused" exits 2 env -C sandbox "$splashdown" study study.toml --out .
check "the message says so and how to go on" grep -q 'docs: is there already, and no study made it. Rename the case, use another --out' stderr
check "and nothing is written" test ! -e sandbox/study.csv
names_study .. . '' / -rf study.csv "$(printf 'x%.0s' {1..400})" 'a\\nb' >sandbox/study.toml
check "cases may have any name" exits 0 timeout 120 env -C sandbox "$splashdown" study study.toml --out inner --quiet
check "each has its folder" test "$(find sandbox/inner -mindepth 1 -maxdepth 1 -type d | wc -l)" = 8
check "and has run there" test "$(grep -c ',converged,' sandbox/inner/study.csv)" = 8
names_study .. . '' / >sandbox/study.toml
sed -i 's/0.001/0.002/' sandbox/study.toml
check "folders that the study made are emptied" exits 0 timeout 120 env -C sandbox "$splashdown" study study.toml --out inner --quiet
check "for the other scene" grep -q '"simulated_time": 0.002' sandbox/inner/_../summary.json
check "what lay around is there still" test -s sandbox/docs/book -a -s sandbox/book
echo mine >sandbox/docs/report.html
check "nor does a study write over files that are not its own" exits 2 env -C sandbox "$splashdown" study study.toml --out docs
check "it names them" grep -q 'docs/report.html: is there already, and no study wrote it. Use another --out' stderr
check "which stay" grep -q mine sandbox/docs/report.html

# A stand-in for sbatch that works the array off at once
mkdir bin
cat >bin/sbatch <<'SBATCH'
#!/usr/bin/env bash
echo "$@" >>sbatch.calls
for script in "$@"; do :; done
case "$*" in
*--wrap*) bash -c "$script" >&2 && echo '8;cluster' ;;
*)
  last=$(sed -n 's/^#SBATCH --array=0-\([0-9]*\)%.*/\1/p' "$script")
  for ((task = 0; task <= last; ++task)); do SLURM_ARRAY_TASK_ID=$task bash "$script" >&2; done
  echo '7;cluster' ;;
esac
SBATCH
cat >bin/scontrol <<'SCONTROL'
#!/usr/bin/env bash
echo "MaxArraySize            = 3"
SCONTROL
chmod +x bin/sbatch bin/scontrol
check "without sbatch --on slurm is refused" exits 2 env PATH=/nowhere "$splashdown" study study.toml --on slurm --out never
check "and nothing is written" test ! -e never
check "with it the study is handed over" exits 0 env PATH="$work/bin:$PATH" "$splashdown" study study.toml --on slurm --out array
check "no array is longer than the cluster takes" test "$(sed -n "s/^#SBATCH --array=//p" array/study-*.sbatch | tr "\n" " ")" = "0-2%1 0-0%1 "
check "one array waits for the other" grep -q -- '--dependency=afterany:7 ' sbatch.calls
check "the gathering job waits for all" grep -q -- '--dependency=afterany:7:7' sbatch.calls
"$splashdown" study study.toml --quiet --out local_again
check "the array's results are those of a study without Slurm" same_results local_again array

# An envelope: runs are made where the limit's line is least known
cat >fall.toml <<'FALL'
[time]
end = 0.1
[gravity]
[[body]]
name = "box"
mass = 1.0
velocity = [0.0, 0.0]
shape = {type = "box", width = 0.1, height = 0.1}
FALL
cat >envelope.toml <<'ENVELOPE'
scene = "fall.toml"
[[axis]]
name = "u"
key = "body.box.velocity.0"
values = [0, 1, 2, 3, 4, 5, 6, 7]
[[axis]]
name = "v"
key = "body.box.velocity.1"
values = [0, 1, 2, 3, 4, 5, 6, 7]
[[quantity]]
name = "speed"
table = "bodies.csv:box"
quantity = "sqrt(last(vx)^2 + last(vy)^2)"
[[limit]]
name = "fast"
quantity = "speed"
above = 5
[envelope]
limit = "fast"
x = "u"
y = "v"
runs = 12
ENVELOPE
check "an envelope ends after its runs" exits 0 "$splashdown" study envelope.toml --out plane --quiet
check "as many as it may make" test "$(grep -c ',converged,' plane/study.csv)" = 12
sed -i 's/runs = 12/runs = 64/' envelope.toml
check "the same command continues it" exits 0 "$splashdown" study envelope.toml --out plane --quiet
check "and ends before all are made" test "$(grep -c ',converged,' plane/study.csv)" -lt 40
# Gravity takes 0.98 m/s from v. Cells whose speed is within 0.3 of the limit may be on either side.
check "each cell is on its side of the line" test "$(awk -F, 'NR > 1 {s = sqrt($1^2 + ($2 - 0.98)^2); if ((s < 4.7 && $6 > 0.5) || (s > 5.3 && $6 < 0.5)) ++n} END {print n + 0}' plane/envelope.csv)" = 0
check "the report draws the line" grep -q 'border-left:2px solid' plane/report.html
# A study that ends once a band is narrow enough
cat >enough.toml <<'ENOUGH'
scene = "fall.toml"
[samples]
number = 60
plan = "random"
[[axis]]
name = "u"
key = "body.box.velocity.0"
distribution = {type = "normal", mean = 3, sd = 0.1}
[[quantity]]
name = "speed"
table = "bodies.csv:box"
quantity = "last(vx)"
[stop]
of = "speed"
width = 0.2
ENOUGH
check "a study ends when its band is narrow" exits 0 "$splashdown" study enough.toml --out enough --quiet
check "before all runs are made" test "$(grep -c ',converged,' enough/study.csv)" -lt 60
check "the report says that they are enough" grep -q 'of 60 runs are enough: the band of speed is 0.1' enough/report.html
check "and none is waited for" test -z "$(grep 'are waiting' enough/report.html)"
check "runs that are handed over at once cannot be chosen" exits 2 env PATH="$work/bin:$PATH" "$splashdown" study envelope.toml --on slurm --out never

verdict
