#!/usr/bin/env python3
"""How far `splashdown check` is off in what runs cost.

    ctest --preset ci -R '^validation'
    tests/benchmark/cost_guess.py build/release/splashdown build/release/validation/ci

Compares the guess for each run's scene with its wall seconds; of runs that stopped early, the steps are scaled.
"""
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tomllib

UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1}


def guess(program, scene, overrides=()):
    """Steps, most nodes, and seconds of the start and of a step."""
    changed = [x for override in overrides for x in ("--set", override)]
    said = subprocess.run([program, "check", scene, *changed], capture_output=True, text=True, check=True).stdout
    steps = float(re.search(r"^  steps +about ([\d.e+]+) to", said, re.M)[1])
    nodes = float(re.findall(r"\d[\d.e+]*", re.search(r"^  nodes +(.*)", said, re.M)[1])[-1])
    start, step = (
        float(found[1]) * UNITS[found[2]]
        for found in (re.search(rf"^  {row} +about ([\d.e+]+) (\w+)", said, re.M) for row in ("the start", "a step")))
    return steps, nodes, start, step


def main():
    program, runs = sys.argv[1], pathlib.Path(sys.argv[2])
    errors = {2: [], 3: []}
    for file in sorted(runs.glob("*/*/summary.json")):
        summary = json.loads(file.read_text())
        scene = file.parent / "scene.resolved.toml"
        if not summary.get("nodes", {}).get("initial") or not summary["wall_seconds"]:
            continue
        steps, nodes, start, step = guess(program, scene)
        share = summary["simulated_time"] / tomllib.loads(scene.read_text())["time"]["end"]
        error = (start + share * steps * step) / summary["wall_seconds"]
        errors[summary["dimension"]].append(error)
        print(f"{file.parent.relative_to(runs)!s:50} {summary['wall_seconds']:8.1f} s, guess over run {error:6.2f}, "
              f"in steps {share * steps / summary['steps']:6.2f}, in nodes {nodes / summary['nodes']['max']:6.2f}")
    for dimension, all_errors in errors.items():
        off = [math.exp(abs(math.log(error))) for error in all_errors]
        if off:
            print(f"{dimension}D: median {statistics.median(off):.2f}, within 2: {sum(x <= 2 for x in off)}, within 3: "
                  f"{sum(x <= 3 for x in off)} of {len(off)}; median of guess over run {statistics.median(all_errors):.2f}")


if __name__ == "__main__":
    main()
