#!/usr/bin/env bash
# Half of a scene, told as the whole: the numbers of the full run within what two meshes of it differ by.
#   symmetry_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# free = y: what the plane leaves; the full run must not roll either.
wedge_scene 0 | sed 's/^position/free = ["y"]\nposition/' >wedge.toml
sed 's/type = "wedge".*/type = "circle", radius = 0.15 }/; s/position = \[0, 0.02\]/position = [0, 0.16]/; s/mass = 60/mass = 30/' wedge.toml >circle.toml

compare() {  # compare FULL OTHER HALF: impulse, lowest place, mass of water; half within thrice what the two full runs differ by
  python3 - "$@" <<'PYTHON'
import csv, json, sys

def numbers(folder):
    summary = json.load(open(folder + "/summary.json"))
    rows = list(csv.DictReader(open(folder + "/bodies.csv")))
    water = list(csv.DictReader(open(folder + "/fluid.csv")))
    body = summary["bodies"]["wedge"]
    return {"impulse": body["impulse"][1], "velocity": float(rows[-1]["vy"]), "submergence": body["maximum_submergence"]["value"],
            "volume": float(water[-1]["volume"]), "kinetic_energy": float(water[-1]["kinetic_energy"])}, int(water[-1]["nodes"]), rows

(full, nodes, _), (other, _, _), (half, half_nodes, rows) = map(numbers, sys.argv[1:4])
wrong = 0 if half_nodes < 0.6 * nodes else 1
for name, value in full.items():
    scatter = max(abs(other[name] - value), 0.01 * abs(value))
    print(name, value, other[name], half[name])
    wrong += abs(half[name] - value) > 3 * scatter
wrong += any(float(row["fx"]) != 0 or float(row["x"]) != 0 or float(row["mz"]) != 0 for row in rows)
sys.exit(wrong)
PYTHON
}

for shape in wedge circle; do
  check "a $shape" exits 0 "$splashdown" run $shape.toml --quiet --no-report --out $shape
  check "a $shape on another mesh" exits 0 "$splashdown" run $shape.toml --set fluid.size.far=0.11 --quiet --no-report --out $shape.other
  check "half a $shape" exits 0 "$splashdown" run $shape.toml --set "symmetry={}" --quiet --no-report --out $shape.half
  check "is told as the whole" compare $shape $shape.other $shape.half
done

check "a stopped half" exits 0 "$splashdown" run wedge.toml --set "symmetry={}" --until 0.03 --quiet --no-report --out parts
check "continues" exits 0 "$splashdown" run wedge.toml --set "symmetry={}" --resume --quiet --no-report --out parts
check "to the same bits" cmp wedge.half/bodies.csv parts/bodies.csv
check "a heeled half is refused" exits 2 "$splashdown" run wedge.toml --set "symmetry={}" --set body.wedge.pitch_deg=3 --quiet --out none
check "with the body" grep -q "body.wedge" stderr

verdict
