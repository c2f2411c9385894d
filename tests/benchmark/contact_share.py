#!/usr/bin/env python3
"""Share of a step that two fine hulls take which float side by side and may touch.

    tests/benchmark/contact_share.py PROGRAM [FACETS]

Balls of 20 480 facets (20 times a power of four) with a gap of a centimetre, elements of 0.04 m at them. Prints nodes, seconds a step of
bodies and of all but output and setup, and the share.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

SCENE = """
title = "Two fine hulls side by side"
dimension = 3
[time]
end = 0.006
dt_max = 1e-3
[gravity]
acceleration = [0.0, 0.0, -9.81]
[tank]
min = [-2.0, -2.0, -2.0]
max = [2.0, 2.0, 1.0]
[fluid]
density = 1000
[fluid.size]
surface = 0.4
far = 0.4
growth = 0.3
[[fluid.region]]
shape = "box"
min = [-2.0, -2.0, -2.0]
max = [2.0, 2.0, 0.0]
[contact]
"""
BODY = """
[[body]]
name = "{name}"
shape = {{type = "surface", file = "ball.obj", scale = 0.5}}
density = 500
position = [{x}, 0.0, 0.0]
velocity = [{v}, 0.0, 0.0]
size = 0.04
"""


def ball(facets):
    """An icosahedron, each facet in four until there are enough, on the unit sphere."""
    t = (1 + math.sqrt(5)) / 2
    signs = [(s, u * t) for s in (-1, 1) for u in (-1, 1)]
    points = [p for s, u in signs for p in ((s, u, 0), (0, s, u), (u, 0, s))]
    points = [tuple(c / math.hypot(*p) for c in p) for p in points]
    apart = lambda i, j: math.dist(points[i], points[j])
    edge = min(apart(0, j) for j in range(1, 12)) * 1.001
    near = lambda i, j: apart(i, j) < edge
    triangles = [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near(i, j) and near(j, k) and near(i, k)]
    while len(triangles) < facets:
        middles, finer = {}, []

        def middle(i, j):
            key = min(i, j), max(i, j)
            if key not in middles:
                p = [a + b for a, b in zip(points[i], points[j])]
                points.append(tuple(c / math.hypot(*p) for c in p))
                middles[key] = len(points) - 1
            return middles[key]

        for i, j, k in triangles:
            a, b, c = middle(i, j), middle(j, k), middle(k, i)
            finer += [(i, a, c), (j, b, a), (k, c, b), (a, b, c)]
        triangles = finer
    for n, (i, j, k) in enumerate(triangles):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[i], points[j], points[k]
        if ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx) < 0:
            triangles[n] = (i, k, j)
    lines = ["v %.17g %.17g %.17g" % p for p in points] + ["f %d %d %d" % tuple(i + 1 for i in f) for f in triangles]
    return "\n".join(lines) + "\n", len(triangles)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    obj, facets = ball(int(sys.argv[2]) if len(sys.argv) > 2 else 20480)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "ball.obj").write_text(obj)
        bodies = BODY.format(name="left", x=-0.505, v=0.0) + BODY.format(name="right", x=0.505, v=-0.5)
        (folder / "scene.toml").write_text(SCENE + bodies)
        subprocess.run([program, "run", "scene.toml", "--out", "out", "--quiet", "--no-report"], cwd=folder, check=True)
        summary = json.loads((folder / "out/summary.json").read_text())
    phases, steps = summary["phases"], summary["steps"]
    step = sum(seconds for name, seconds in phases.items() if name not in ("setup", "output")) / steps
    bodies = phases["rigid"] / steps
    print(f"{facets} facets each, {summary['nodes']['max']} nodes: {bodies:.3f} s of {step:.3f} s a step, {bodies / step:.1%}")


main()
