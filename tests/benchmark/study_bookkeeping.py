#!/usr/bin/env python3
"""What a study costs beside its runs: 100, 1000 and 10 000 of them in one folder.

    tests/benchmark/study_bookkeeping.py build/release/splashdown --out build/bookkeeping [--runs 100 1000 10000]

A ball in flight is the cheapest run there is. All runs but the last 50 are copies of one run with their own speed, so that a folder of 10 000
is there in seconds. Processor seconds, user and system, with those of child processes:

  plan      the study file and the scene of each run are read, and a folder of which nothing is there
  each run  making the last 50, over what `splashdown run` takes for them by itself
  resume    the same command with all runs there: results are read and measured, tables and report are written
  report    `splashdown report`

With --bars the exit code is 1 if one of these grows faster than the number of runs to the power 1.25 from the second number to the third, or
if each run takes 30 ms more among the third number of runs than among the first.
"""
import argparse
import csv
import math
import pathlib
import resource
import shutil
import subprocess

left = 50
scene = """title = "A ball flies"
[time]
end = 0.1
[gravity]
[[body]]
name = "ball"
shape = {type = "circle", radius = 0.1}
density = 500
velocity = [1.0, 5.0]
"""
study = """scene = "scene.toml"
[samples]
number = NUMBER
plan = "sobol"
[[axis]]
name = "speed"
key = "body.ball.velocity.1"
range = [1, 10]
[[quantity]]
name = "height"
table = "bodies.csv:ball"
quantity = "max(y)"
unit = "m"
[[limit]]
name = "high"
quantity = "height"
above = 0.5
"""


def seconds(*command):
    """Processor seconds of a command and its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def copy_runs(folder, runs):
    """Folders of these rows of study.csv, after the first one's."""
    pattern = folder / runs[0]["run"]
    resolved = (pattern / "scene.resolved.toml").read_text()
    own = f"velocity = [1.0, {float(runs[0]['speed'])}]"
    assert own in resolved
    for run in runs[1:]:
        place = folder / run["run"]
        place.mkdir()
        for name in (".splashdown-study", "summary.json", "bodies.csv"):
            shutil.copy(pattern / name, place / name)
        (place / "scene.resolved.toml").write_text(resolved.replace(own, f"velocity = [1.0, {float(run['speed'])}]"))


def measured(program, folder, number):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "scene.toml").write_text(scene)
    file, out = folder / "study.toml", folder / "runs"
    file.write_text(study.replace("NUMBER", "1"))
    make = (program, "study", file, "--out", out, "--quiet")
    seconds(*make)
    file.write_text(study.replace("NUMBER", str(number)))
    plan = seconds(*make, "--collect")
    copy_runs(out, list(csv.DictReader((out / "study.csv").open()))[:number - left])
    made = seconds(*make)
    resume = seconds(*make)
    report = seconds(program, "report", out)
    alone = sum(seconds(program, "run", folder / "scene.toml", "--out", folder / f"run{k}", "--quiet", "--threads", 1) for k in range(left))
    rows = list(csv.DictReader((out / "study.csv").open()))
    assert len(rows) == number and all(row["status"] == "converged" and row["height"] for row in rows)
    return {"plan": plan, "each run": (made - resume - alone) / left, "resume": resume, "report": report}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, nargs=3, default=[100, 1000, 10000])
    parser.add_argument("--bars", action="store_true")
    arguments = parser.parse_args()
    found = []
    print("| runs | plan | each run | resume | report |\n|---|---|---|---|---|")
    for number in arguments.runs:
        found.append(measured(arguments.program, arguments.out / str(number), number))
        row = found[-1]
        print(f"| {number} | {row['plan']:.2f} s | {1e3 * row['each run']:.0f} ms | {row['resume']:.2f} s | {row['report']:.2f} s |", flush=True)
    few, some, many = found
    ratio = math.log(arguments.runs[2] / arguments.runs[1])
    powers = {name: math.log(many[name] / some[name]) / ratio for name in ("plan", "resume", "report")}
    more = many["each run"] - few["each run"]
    print("powers of the number: " + ", ".join(f"{name} {power:.2f}" for name, power in powers.items()) + f"; each run {1e3 * more:+.0f} ms")
    if arguments.bars and (max(powers.values()) > 1.25 or more > 0.03):
        raise SystemExit(1)


main()
