#!/usr/bin/env python3
"""What the digits of four scenes cost: docs/performance.md's tables of this program.

    tests/benchmark/work_precision.py build/release/splashdown [CASE...]     (default: all but the cones)
    tests/benchmark/work_precision.py build/release/splashdown --presets [CASE...]
    tests/benchmark/work_precision.py build/release/splashdown --growth [CASE...]     how fast elements may grow

Runs a scene on several meshes, one thread, from the start of the process to the files on disk, report and frames
included, and prints processor seconds (user + system, with those of gnuplot: other work on the machine changes them
less than wall seconds), wall seconds and the errors of what has a known value.
"""
import csv
import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def column(folder, name, of="bodies.csv", where=lambda time: True):
    with open(folder / of, newline="") as file:
        rows = [(float(row["time"]), float(row[name])) for row in csv.DictReader(file)
                if row.get("body", "") not in ("tank",)]
    return [row for row in rows if where(row[0])]


def mean(series):
    """Over time, by trapezia."""
    steps = [(b[0] - a[0], 0.5 * (a[1] + b[1])) for a, b in zip(series, series[1:])]
    return sum(dt * value for dt, value in steps) / sum(dt for dt, _ in steps)


def at(series, when):
    for (t0, y0), (t1, y1) in zip(series, series[1:]):
        if t0 <= when <= t1:
            return y0 + (y1 - y0) * (when - t0) / (t1 - t0)
    raise SystemExit(f"no value at {when} s")


def smoothed_peak(series, width):
    """Largest mean over `width` seconds."""
    area = [0.0]
    for (t0, y0), (t1, y1) in zip(series, series[1:]):
        area.append(area[-1] + 0.5 * (y0 + y1) * (t1 - t0))
    primitive = [(t, a) for (t, _), a in zip(series, area)]
    ends = [t for t, _ in series if series[0][0] <= t - width]
    return max(at(primitive, t) - at(primitive, t - width) for t in ends) / width


def similarity(folder, end, force, pressure, last=0.6):
    """Constant entry, speed 1 m/s: F / (rho V^3 t) of the last share of the run, largest Cp of its last tenth."""
    load = [(t, f / (1000 * t)) for t, f in column(folder, "fy", where=lambda t: t >= (1 - last) * end)]
    errors = {"force": mean(load) / force - 1, "its scatter": statistics.pstdev(f for _, f in load) / force}
    if (folder / "surface_pressure.csv").exists():
        highest = {}
        for t, p in column(folder, "p", "surface_pressure.csv", lambda t: t >= 0.9 * end):
            highest[t] = max(highest.get(t, 0), p / 500)
        errors["Cp_max"] = sum(highest.values()) / len(highest) / pressure - 1
    return errors


def wedge_drop(folder):
    speed = at(column(folder, "vy"), 0.016)
    return {"peak force": smoothed_peak(column(folder, "fy"), 5e-4) / 26746 - 1, "speed at 16 ms": -speed / 5.068 - 1}


def cone(folder, force):
    load = [(t, f / (1000 * t * t)) for t, f in column(folder, "fz", where=lambda t: t >= 0.2)]
    return {"force": mean(load) / force - 1, "its scatter": statistics.pstdev(f for _, f in load) / force}


def capsule(folder):
    summary = json.loads((folder / "summary.json").read_text())
    speed = column(folder, "vy", where=lambda t: t > 0.05)
    return {"passes a step": summary["coupling"]["passes_mean"], "highest speed upwards [m/s]": max(v for _, v in speed)}


def wide(factor, half=13.5):
    """A tank of that many times the example's width and depth."""
    size = factor * half
    return [f"--set=tank.min=[-{size},-{size}]", f"--set=tank.max=[{size},3.0]",
            f"--set=fluid.region.0.min=[-{size},-{size}]", f"--set=fluid.region.0.max=[{size},0.0]"]


def root(size, smallest):
    """Elements on a cone's hull, and the smallest at the root of its jet."""
    return [f"--set=body.cone.size={size}", "--set=fluid.size.hollow=0.3", f"--set=fluid.size.hollow_min={smallest}"]


CASES = {
    "wedge_30": ("wedge_entry/scene.toml", lambda f: similarity(f, 0.4, 14.02, 6.8948),
                 [["--refine=0.14"], ["--refine=0.2"], ["--refine=0.28", *wide(2)], ["--refine=0.4", *wide(2)],
                  ["--refine=0.57", *wide(2)], ["--refine=0.8", *wide(2)], ["--refine=1.13", *wide(2)]]),
    "wedge_15": ("wedge_entry/scene_15.toml", lambda f: similarity(f, 0.19, 84.94, 1),
                 [["--refine=0.12"], ["--refine=0.18"], ["--refine=0.25"], ["--refine=0.35"], ["--refine=0.5"]]),
    "wedge_10": ("wedge_entry/scene_10.toml", lambda f: similarity(f, 0.125, 212.97, 1),
                 [["--refine=0.12"], ["--refine=0.18"], ["--refine=0.25"], ["--refine=0.35"], ["--refine=0.5"]]),
    "wedge_5": ("wedge_entry/scene_5.toml", lambda f: similarity(f, 0.0613, 937, 1, 0.4),
                [["--refine=0.35"], ["--refine=0.5"], ["--refine=0.71"], ["--refine=1"]]),
    "wedge_drop": ("wedge_drop/scene.toml", wedge_drop,
                   [["--refine=0.25"], ["--refine=0.35"], ["--refine=0.5"], ["--refine=0.71"], ["--refine=1"],
                    ["--refine=1.41"], ["--refine=2"]]),
    "light_capsule": ("capsule_drop_2d/scene.toml", capsule, [["--refine=0.7", "--until=0.3"], ["--refine=1", "--until=0.3"]]),
    "cone_45": ("cone_entry/scene_45.toml", lambda f: cone(f, 3.331),
                [["--refine=0.35"], ["--refine=0.5"], ["--refine=0.71"], root(0.06, 0.015), root(0.04, 0.01), ["--refine=1"]]),
    "cone_30": ("cone_entry/scene.toml", lambda f: cone(f, 24.69),
                [["--refine=0.5"], root(0.05, 0.0125), root(0.035, 0.01), ["--refine=1"]]),
}


def told_options(options):
    """As they were given; of a wider tank that it is."""
    given = [option.removeprefix("--set=fluid.size.").removeprefix("--set=body.") for option in options if "tank" not in option and "region" not in option]
    return " ".join([*given, "wide"] if len(given) < len(options) else given)


def measure(program, scene, options):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "run"
        command = [program, "run", str(EXAMPLES / scene), "--out", str(folder), "--quiet", "--threads=1", *options]
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        subprocess.run(command, check=True)
        wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        summary = json.loads((folder / "summary.json").read_text())
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return used, wall, summary, CASES_BY_SCENE[scene](folder)


CASES_BY_SCENE = {scene: errors for scene, errors, _ in CASES.values()}


def main():
    program, names = sys.argv[1], sys.argv[2:]
    of_presets, of_growth = "--presets" in names, "--growth" in names
    names = [name for name in names if not name.startswith("--")] or [name for name in CASES if not name.startswith("cone")]
    for name in names:
        scene, _, ladder = CASES[name]
        if of_presets:
            others = [option for option in ladder[-1] if not option.startswith("--refine")]
            ladder = [[f"--refine={preset}", *others] for preset in ("draft", "standard", "reference")]
        if of_growth:
            ladder = [[*options, f"--set=fluid.size.growth={growth}"]
                      for options in (ladder[2], ladder[-1]) for growth in (0.1, 0.15, 0.2, 0.3)]
        print(f"{name}: examples/{scene}")
        for options in ladder:
            used, wall, summary, errors = measure(program, scene, options)
            phases = summary["phases"]
            around = sum(phases.get(phase, 0) for phase in ("setup", "output", "report"))
            told = ", ".join(f"{what} {value:.3g}" if "pass" in what or "[" in what else f"{what} {100 * value:+.2f} %"
                             for what, value in errors.items())
            print(f"  {told_options(options):44} {used:6.2f} s of processor, {wall:6.2f} s wall, "
                  f"{summary['nodes']['max']:6d} nodes, {summary['steps']:5d} steps, not steps "
                  f"{100 * around / summary['wall_seconds']:.0f} %: {told}", flush=True)


if __name__ == "__main__":
    main()
