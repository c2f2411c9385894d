#!/usr/bin/env python3
"""Puts deliberate faults into a copy of the sources, one at a time, and says which test notices each.

    tests/faults/run.py [--copy DIR] [--jobs N] [--only WORD] [--again] [--write]
    tests/faults/run.py --check     only whether each fault still has its place in the sources

The copy (default: build/faults) is made from the files that git knows, and built once without any fault. For each fault of
faults.toml the libraries and one suite after the other are built and run until a test fails: unit, verification and stability
tests, no examples. Without a fault none may fail, which is tried first. Results are kept in DIR/results.json; what is there is not tried again. --write renews the table in tests/README.md.
Ends with 1 if a fault was not noticed, with 2 if one could not be tried.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# The fast ones first; folder of the executable in the build, its name.
SUITES = [
    ("tests/unit/fluid", "unit_fluid"),
    ("tests/unit/rigid", "unit_rigid"),
    ("tests/unit/fluid_terms", "unit_fluid_terms"),
    ("tests/unit/coupling", "unit_coupling"),
    ("tests/verification", "verification"),
    ("tests/stability", "stability"),
]
SUITE_OF_ROOM = {"rigid": ["unit_rigid"], "fluid/effects": ["unit_fluid_terms"]}
LONGEST = 900  # seconds: a suite takes two minutes on two cores; what hangs is noticed, too


def say(text):
    print(text, flush=True)


def make_copy(copy):
    """Sources as git has them now; files that have not changed keep their times, so that little is built again."""
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True).stdout
    for name in names.decode().split("\0"):
        source = ROOT / name
        if not name or not source.is_file():
            continue
        target = copy / name
        if not target.exists() or target.read_bytes() != source.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)
    if not (copy / "build/release/build.ninja").exists():
        subprocess.run(["cmake", "--preset", "release"], cwd=copy, check=True)


def build(copy, target, jobs):
    done = subprocess.run(
        ["ninja", "-C", copy / "build/release", f"-j{jobs}", target], capture_output=True, text=True
    )
    return "" if done.returncode == 0 else done.stdout[-3000:]


def first_failure(copy, folder, name, jobs):
    """The first test of the suite that fails, in as many processes as there are jobs."""
    program = copy / "build/release" / folder / name
    running = []
    for shard in range(jobs):
        environment = dict(
            os.environ, GTEST_TOTAL_SHARDS=str(jobs), GTEST_SHARD_INDEX=str(shard), OPENBLAS_NUM_THREADS="1"
        )
        command = ["timeout", str(LONGEST), program, "--gtest_fail_fast", "--gtest_brief=1"]
        running.append(subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True))
    found = None
    for process in running:
        output = process.communicate()[0]
        failed = re.search(r"\[  FAILED  \] (\S+?)(?:,| \()", output)
        if failed and not found:
            found = failed.group(1)
        elif process.returncode == 124 and not found:
            found = f"{name} does not end"
        elif process.returncode and not failed and not found:
            found = f"{name} crashes"
    return found


def suites_for(file):
    """All of them, those nearest to the fault first."""
    near = [name for room, names in SUITE_OF_ROOM.items() if file.startswith(room) for name in names]
    return sorted(SUITES, key=lambda suite: suite[1] not in near)


SOUND = {"name": "no fault", "file": "CMakeLists.txt", "find": "cmake_minimum_required", "replace": "cmake_minimum_required"}


def misplaced(copy, fault):
    """What is wrong with the fault's place; empty where `find` stands once."""
    count = (copy / fault["file"]).read_text().count(fault["find"])
    return "" if count == 1 else f"'find' stands {count} times in {fault['file']}"


def attempt(copy, fault, jobs):
    path = copy / fault["file"]
    sound = path.read_text()
    if error := misplaced(copy, fault):
        return {"invalid": error}
    if fault is not SOUND:
        path.write_text(sound.replace(fault["find"], fault["replace"]))
    try:
        for folder, name in suites_for(fault["file"]):
            if error := build(copy, name, jobs):
                return {"invalid": "does not compile: " + error}
            if test := first_failure(copy, folder, name, jobs):
                return {"suite": name, "test": test}
        return {"suite": None}
    finally:
        if fault is not SOUND:
            path.write_text(sound)


def write_table(faults, results):
    rows = ["| fault | in | noticed by |", "|---|---|---|"]
    for fault in faults:
        result = results.get(fault["name"], {})
        by = f"`{result['test']}` ({result['suite']})" if result.get("suite") else "**nothing**" if "suite" in result else "not tried"
        rows.append(f"| {fault['name']} | `{fault['file']}` | {by} |")
    caught = sum(1 for fault in faults if results.get(fault["name"], {}).get("suite"))
    page = HERE.parent / "README.md"
    text = page.read_text()
    head, rest = text.split("<!-- table -->\n")[0], text.split("<!-- end -->")[1]
    page.write_text(head + "<!-- table -->\n" + f"{caught} of {len(faults)} are noticed.\n\n" + "\n".join(rows) + "\n<!-- end -->" + rest)


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(130))  # by way of `finally`: the sources are sound again
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--copy", type=pathlib.Path, default=ROOT / "build/faults")
    parser.add_argument("--jobs", type=int, default=max(1, (os.cpu_count() or 2) // 2))
    parser.add_argument("--only", default="", help="faults whose name contains this")
    parser.add_argument("--again", action="store_true", help="try also what has a result")
    parser.add_argument("--here", action="store_true", help="the tree of this script is such a copy: no other is made")
    parser.add_argument("--write", action="store_true", help="renew the table in tests/README.md; tries nothing")
    parser.add_argument("--check", action="store_true", help="say which faults have lost their place; tries nothing")
    options = parser.parse_args()
    with open(HERE / "faults.toml", "rb") as file:
        faults = tomllib.load(file)["fault"]
    if options.check:
        lost = [f"{fault['name']}: {error}" for fault in faults if (error := misplaced(ROOT, fault))]
        sys.exit("\n".join(lost) or 0)
    copy = ROOT if options.here else options.copy.resolve()
    kept = copy / "build/results_of_faults.json" if options.here else copy / "results.json"
    results = json.loads(kept.read_text()) if kept.exists() else {}
    if options.write:
        return write_table(faults, results)
    if not options.here:
        make_copy(copy)
    if SOUND["name"] not in results:
        results[SOUND["name"]] = attempt(copy, SOUND, options.jobs)
        if results[SOUND["name"]].get("suite", "") is not None:
            sys.exit(f"without a fault: {results[SOUND['name']]}")
        kept.write_text(json.dumps(results, indent=1))
    todo = [f for f in faults if options.only in f["name"] and (options.again or f["name"] not in results)]
    for number, fault in enumerate(todo, 1):
        start = time.monotonic()
        result = attempt(copy, fault, options.jobs)
        say(f"[{number}/{len(todo)}] {fault['name']}: {result.get('invalid') or result.get('test') or 'NOT NOTICED'}, {time.monotonic() - start:.0f} s")
        if "invalid" not in result:
            results[fault["name"]] = result
            kept.write_text(json.dumps(results, indent=1))
    tried = [results.get(f["name"]) for f in faults if options.only in f["name"]]
    if None in tried:
        sys.exit(2)
    sys.exit(0 if all(r["suite"] for r in tried) else 1)


if __name__ == "__main__":
    main()
