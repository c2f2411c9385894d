#!/usr/bin/env bash
# `splashdown new`, as a new user would: a hull, its scene, check and a run without an edit.
#   new_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# A wedge-shaped float in millimetres: keel, chines, deck; a lid for each end.
float() {
  python3 - "$@" <<'PYTHON'
import sys
ring = [(0, 0), (200, 60), (200, 150), (-200, 150), (-200, 60)]
points = [(x, y, z) for x in (-500, 500) for y, z in ring]
facets = []
for k in range(5):
    n = (k + 1) % 5
    facets += [(k, 5 + k, 5 + n), (k, 5 + n, n)]
for k in (1, 2, 3):
    facets += [(0, k, k + 1), (5, 5 + k + 1, 5 + k)]
facets = [(a, c, b) for a, b, c in facets]
if "open" in sys.argv: facets = facets[:-1]
if "inside_out" in sys.argv: facets = [(a, c, b) for a, b, c in facets]
print("solid float")
for facet in facets:
    print("facet normal 0 0 0\nouter loop")
    for corner in facet: print("vertex %g %g %g" % points[corner])
    print("endloop\nendfacet")
print("endsolid float")
PYTHON
}
float >"my float.stl"
float open >open.stl
float inside_out >over.stl
new() { "$splashdown" new "$@"; }

check "a hull becomes a scene" exits 0 new "my float.stl" --mass 10 --sink 2 --forward 3 --pitch 5 --point seat=0.2,0,0.1 --limit-g 10
for word in "in millimetres" "uniform density" "splashdown run my_float/scene.toml --refine draft"; do
  check "it says $word" grep -q "$word" stdout
done
check "which check takes" exits 0 "$splashdown" check my_float/scene.toml
check "without a question" test "$(grep -c "did you mean" stdout)" -eq 0
check "and run, too" exits 0 "$splashdown" run my_float/scene.toml --refine 0.12 --until 0.02 --no-report --quiet
check "from anywhere" bash -c "cd / && '$splashdown' check '$work/my_float/scene.toml' >/dev/null"
check "it is not replaced" exits 2 new "my float.stl" --mass 10 --sink 2
check "unless it is asked for" exits 0 new "my float.stl" --mass 10 --sink 2 --force
check "the hull itself is kept" exits 0 new open.stl --mass 10 --sink 2 --repair --force --out .
check "what is mended lies beside it" test -s open_repaired.stl
check "an open hull is refused" exits 2 new open.stl --mass 10 --sink 2
check "with a cure" grep -q -- "--repair" stderr
check "and nothing is written" test ! -e open
check "repaired it is a scene" exits 0 new open.stl --mass 10 --sink 2 --repair
check "and what was done is told" grep -q "put a lid on a hole" stdout
check "one that is inside out, too" exits 0 new over.stl --mass 10 --sink 2 --repair --out turned
check "whose hull is written" test -s turned/over.stl
check "and read again" exits 0 "$splashdown" check turned/scene.toml
uav=$(dirname "${BASH_SOURCE[0]}")/../../../../examples/uav_landing/uav.stl
check "wide water, for which the coarsest meshes are too coarse" exits 0 new "$(realpath "$uav")" --mass 600 --sink 1.5 --forward 12 --pitch 6
check "a mass is needed" exits 2 new "my float.stl" --sink 2
check "in kilograms" exits 2 new "my float.stl" --mass 1e9 --sink 2
check "with a cure" grep -q -- "--units" stderr
check "shapes need no file" exits 0 new --shape wedge --plane --deadrise 25 --breadth 0.5 --mass 30 --sink 3 -o wedge.toml
check "and run in seconds" exits 0 "$splashdown" run wedge.toml --refine draft --until 0.01 --quiet --no-report
check "a mesh of a given time is chosen for them" exits 0 "$splashdown" run wedge.toml --seconds 5 --quiet --no-report --out timed
verdict
