#!/usr/bin/env python3
"""How far the predicted cost of landings is off: pitched capsules, boxes and lofted hulls by `splashdown new`, with draws from a seed.

    tests/benchmark/landing_cost.py build/release/splashdown --out build/landings --count 12 --seed 1 [--set fluid.size.refine=0.3]...

Each scene is written by `new`, its predicted steps and seconds are those of `check`; `run` on one core is held against them.
"""
import argparse
import json
import math
import pathlib
import random
import resource
import statistics
import struct
import subprocess

from cost_guess import guess


def lofted_hull(file, length, breadth, height, deadrise):
    """A float with a hard chine: bow drawn in and up, a flat transom; metres."""
    stations = 14
    rings = []
    for i in range(stations):
        along = i / (stations - 1)
        fullness = 1 if along < 0.5 else max(0.03, 1 - ((along - 0.5) / 0.5) ** 2)
        half, keel = breadth / 2 * fullness, 0.6 * height * (1 - fullness)
        chine = min(keel + half * math.tan(math.radians(deadrise)), 0.9 * height)
        rings.append([(along * length, y, z) for y, z in ((0, keel), (half, chine), (half, height), (-half, height), (-half, chine))])
    facets = []
    for a, b in zip(rings, rings[1:]):
        for k in range(5):
            n = (k + 1) % 5
            facets += [(a[k], b[n], a[n]), (a[k], b[k], b[n])]
    for k in range(1, 4):
        facets += [(rings[0][0], rings[0][k], rings[0][k + 1]), (rings[-1][0], rings[-1][k + 1], rings[-1][k])]
    with open(file, "wb") as out:
        out.write(bytes(80) + struct.pack("<I", len(facets)))
        for facet in facets:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for corner in facet for x in corner), 0))
    return length * breadth * height * 0.6


def drawn(draw, kind, folder, number):
    """Arguments of `new` for one landing."""
    specific = draw.uniform(0.15, 0.6)  # of its volume over the same of water
    if kind == "capsule":
        radius, length = draw.uniform(0.1, 0.4), draw.uniform(0.3, 1.2)
        volume = math.pi * radius**2 * (length + 4 / 3 * radius)
        hull = ["--shape", "capsule", "--radius", f"{radius:.3f}", "--length", f"{length:.3f}"]
    elif kind == "box":
        size = [draw.uniform(0.5, 1.5), draw.uniform(0.2, 0.6), draw.uniform(0.1, 0.4)]
        volume = math.prod(size)
        hull = ["--shape", "box", "--size", ",".join(f"{x:.3f}" for x in size)]
    else:
        file = folder / f"hull{number}.stl"
        length, deadrise = draw.uniform(0.8, 2.5), draw.uniform(8, 25)
        volume = lofted_hull(file, length, length * draw.uniform(0.2, 0.35), length * draw.uniform(0.15, 0.25), deadrise)
        hull = [str(file), "--units", "m", "--repair"]
    return [*hull, "--mass", f"{1000 * specific * volume:.3f}", "--sink", f"{draw.uniform(1, 4):.2f}",
            "--forward", f"{draw.choice([0, draw.uniform(2, 12)]):.2f}", "--pitch", f"{draw.uniform(2, 15):.1f}"]


def measured(program, scene, out, overrides):
    said = [x for override in overrides for x in ("--set", override)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "run", scene, "--out", out, "--restart", "--threads", "1", "--quiet", "--no-report", "--force", *said],
                          capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise RuntimeError(done.stderr[-400:])
    summary = json.loads((out / "summary.json").read_text())
    return summary["steps"], summary["nodes"]["max"], after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--set", action="append", default=["fluid.size.refine=0.35"])
    parser.add_argument("--guess-only", action="store_true", help="of runs that are there")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    draw = random.Random(options.seed)
    off = {"steps": [], "seconds": []}
    for number in range(options.count):
        kind = ("capsule", "box", "hull")[number % 3]
        folder, file = options.out / f"landing{number}", options.out / f"landing{number}.json"
        arguments = drawn(draw, kind, options.out, number)
        subprocess.run([options.program, "new", *arguments, "--out", folder, "--force"], capture_output=True, text=True, check=True)
        scene = next(folder.glob("*.toml"))
        steps, nodes, start, step = guess(options.program, scene, options.set)
        if options.guess_only and file.exists():
            found = json.loads(file.read_text())
        else:
            found = measured(options.program, scene, options.out / f"run{number}", options.set)
            file.write_text(json.dumps(found))
        seconds = start + steps * step
        off["steps"].append(steps / found[0])
        off["seconds"].append(seconds / found[2])
        print(f"{kind:8} steps {steps:7.0f} guessed, {found[0]:6d} run: {steps / found[0]:5.2f}   nodes {nodes / found[1]:5.2f}   "
              f"seconds {seconds:6.1f}, {found[2]:6.1f}: {seconds / found[2]:5.2f}   {' '.join(arguments)}", flush=True)
    for name, factors in off.items():
        far = [math.exp(abs(math.log(factor))) for factor in factors]
        print(f"{name}: guess over run {statistics.median(factors):.2f} in the median, off by {max(far):.2f} at most, "
              f"within 1.5: {sum(x <= 1.5 for x in far)} of {len(far)}")


if __name__ == "__main__":
    main()
