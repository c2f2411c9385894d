#!/usr/bin/env bash
# `splashdown advise` and `splashdown ablate`, as scripts use them.
#   ablate_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

wedge_scene 0 | sed 's/^end = .*/end = 0.012/; s/position = .*/position = [0, 0.005]/; s/^surface = .*/surface = 0.06/' >scene.toml
runs_of() { find "$1" -name summary.json -printf '%p %i %T@\n' | sort; }
ablate() { "$splashdown" ablate scene.toml --quiet "$@"; }
# Rows of the table without what the clock says.
timeless() {
  awk -F, 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i == "seconds" || $i == "time_change") skip[i] = 1}
           {for (i in skip) $i = ""; print}' "$1/ablation.csv"
}

check "advice needs a scene" exits 2 "$splashdown" advise missing.toml
check "it is given" exits 0 "$splashdown" advise scene.toml
for word in 'gravity  *yes' 'surface tension  *-' 'Re = ' 'We = ' 'von Karman\|Blasius'; do check "it says $word" grep -q "$word" stdout; done
check "and as JSON" exits 0 "$splashdown" advise scene.toml --json
check "which is JSON" python3 -c 'import json; a = json.load(open("stdout")); assert all(e["advice"] in ("on", "off", "doubtful") for e in a["effects"])'
check "a mistake is told" exits 2 "$splashdown" advise scene.toml --set gravty.acceleration=1
check "with its cure" grep -q "gravity" stderr

check "an effect that is none is refused" exits 2 ablate --only gravty --out never
check "with its cure" grep -q "Did you mean 'gravity'" stderr
check "a percentage needs its sign" exits 2 ablate --matters 1 --out never
check "a quantity that no run can measure is refused" exits 2 ablate --quantity "a=max(fx) from bodies.csv:wegde" --out never
check "and nothing is written" test ! -e never
mkdir list && echo '{}' >list/price.json
check "a price list's folder is not taken" exits 2 ablate --out list
mkdir study && echo '{}' >study/study.json
check "nor a study's" exits 2 ablate --out study

only=(--only gravity --only walls)
check "runs are made" exits 0 ablate --out one "${only[@]}"
for file in ablation.csv ablation.json study.csv report.html; do check "it leaves $file" test -s "one/$file"; done
if command -v gnuplot >/dev/null; then check "and a chart" test -s one/ablation.svg; fi
check "three variants on three meshes" test "$(runs_of one | wc -l)" -eq 9
runs_of one >before
check "and once more" exits 0 "$splashdown" ablate scene.toml --out one "${only[@]}"
runs_of one >after
check "makes no run again" cmp before after
check "the console says what gravity does" grep -Eq '^gravity: [+-]?[0-9.]+ % ± [0-9.]+ % wedge\.[a-z0-9_]+, [+-][0-9]+ % time: (keep|leave out|undecided) \(advise: ' stdout
check "and what walls do" grep -q '^walls (no_slip): ' stdout
check "its page can be written anew" exits 0 "$splashdown" report one
check "what is there can be collected" exits 0 ablate --out one "${only[@]}" --collect

# Stopped as soon as a run is under way, resumed with two at a time: the same numbers.
"$splashdown" ablate scene.toml --quiet --out two "${only[@]}" >/dev/null 2>&1 &
pid=$!
until_true test -e two/scene_refine-1/scene.resolved.toml
kill -s TERM $pid
wait $pid
check "a signal ends it" test $? -eq 130
check "the same command goes on" exits 0 ablate --out two "${only[@]}" --jobs 2
check "to the same table" cmp <(timeless one) <(timeless two)
check "without gravity nothing falls faster: what it adds to the wedge's speed is downward" python3 - <<'PYTHON'
import csv
rows = [r for r in csv.DictReader(open("one/ablation.csv")) if r["variant"] == "without_gravity" and r["quantity"] == "wedge.impulse"]
assert len(rows) == 1 and rows[0]["change"] and rows[0]["kind"] == "without", rows
PYTHON
check "another scene in the folder is run anew" exits 0 ablate --out one --only gravity --set body.wedge.mass=50 --jobs 2
verdict
