#!/usr/bin/env bash
# `splashdown price` and what `run` makes of it, as scripts use them.
#   price_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

wedge_scene 0 | sed 's/^end = .*/end = 0.03/; s/position = .*/position = [0, 0.005]/' >scene.toml
stopped_at() {  # stopped_at FILE COMMAND...: told to stop when the file is there; its exit code
  local file=$1
  shift
  "$@" >stdout 2>stderr &
  local pid=$!
  until [[ -e $file ]]; do sleep 0.01; done
  kill -s TERM $pid
  wait $pid
}
runs_of() { find "$1" -name summary.json -printf '%p %i %T@\n' | sort; }
price() { "$splashdown" price scene.toml --rungs 3 --quiet "$@"; }

check "a price needs a scene" exits 2 "$splashdown" price missing.toml
check "a quantity that no run can measure is refused" exits 2 price --out never --quantity "a=max(fx) from bodies.csv:wegde"
check "with its cure" grep -q "Did you mean 'wedge'" stderr
check "and nothing is written" test ! -e never
check "a budget that is too small ends without a price" exits 130 price --out short --budget 0.01
check "a signal ends it" exits 130 stopped_at list/refine-0.5/scene.resolved.toml "$splashdown" price scene.toml --rungs 3 --out list
check "the same command goes on" exits 0 price --out list --quantity "slowed=last(vy)+3 from bodies.csv:wedge"
for file in price.json report.html; do check "it leaves $file" test -s "list/$file"; done
if command -v gnuplot >/dev/null; then check "and a chart" test -s list/price.svg; fi
runs_of list >before
check "five runs" test "$(wc -l <before)" -eq 5
check "and once more" exits 0 price --out list
runs_of list >after
check "makes no run again" cmp before after
check "an accuracy that a mesh has asks for no other" exits 0 price --out list --accuracy 10000%
runs_of list >after
check "so that none is made" cmp before after
check "one that none has makes the ladder go on" exits 130 stopped_at list/refine-1.41/scene.resolved.toml \
  "$splashdown" price scene.toml --rungs 3 --out list --accuracy 1e-9%
check "a list without a row says how to go on" exits 0 "$splashdown" price scene.toml --rungs 3 --out list
check "and what that takes" grep -Eq 'no mesh has 20 % yet: (--accuracy 20% goes on, the next one takes about [0-9]|meshes of equal size differ by .* --accuracy 20%.* makes several runs)' stdout
check "rungs have what they cost" grep -q '"node_steps": [1-9]' list/price.json
check "its page can be written anew" exits 0 "$splashdown" report list
mkdir study && echo '{}' >study/study.json
check "a study's folder is not taken" exits 2 price --out study

check "a run takes its mesh from the list" exits 0 "$splashdown" run scene.toml --accuracy 300% --price list --out run --no-report
for word in 'chosen  .*list/price.json' 'predicted ' 'reached .*for the run'; do check "and says $word" grep -q "$word" stdout; done
check "an accuracy beyond the list is refused" exits 2 "$splashdown" run scene.toml --accuracy 1e-9% --price list
check "with its cure" grep -q 'splashdown price' stderr
check "so is the list of another scene" exits 2 "$splashdown" run scene.toml --accuracy 50% --price list --set body.wedge.mass=50
check "so is an accuracy without its sign" exits 2 "$splashdown" run scene.toml --accuracy 50
check "--refine is the key" cmp <("$splashdown" check scene.toml --refine 0.5) <("$splashdown" check scene.toml --set fluid.size.refine=0.5)
check "presets are refinements by name" cmp <("$splashdown" check scene.toml --refine draft) <("$splashdown" check scene.toml --refine 0.35)
check "one that is misspelt is refused" exits 2 "$splashdown" check scene.toml --refine drafft
check "with its cure" grep -q 'did you mean draft' stderr

told() { "$splashdown" run scene.toml --seconds "$1" --price list --out told --no-report >stdout 2>stderr; }
check "seconds for none but the coarsest mesh take the run that was made" exits 0 told 0.001
check "and say so" grep -q 'chosen  *refine 0.5, ' stdout
check "with its files" cmp told/bodies.csv list/refine-0.5/bodies.csv
finest=$(sed -n 's/.*"wall_seconds": *\([0-9.e+-]*\).*/\1/p' list/refine-1/summary.json | head -1)
check "seconds that a run took which was made take no coarser mesh" exits 0 told "$(awk "BEGIN {print 1.01 * $finest}")"
check "but it, or a finer one" awk '/^chosen/ {found = $3 + 0 >= 1} END {exit !found}' stdout
check "without a list coarse runs are made, of any refinement" exits 0 \
  "$splashdown" run scene.toml --set fluid.size.refine=0.77777 --accuracy 1000% --out odd --no-report
check "and one of them is taken, its seconds too" cmp <(head -3 odd/fluid.csv) <(head -3 odd_probe/refine-0.1944/fluid.csv)
verdict
