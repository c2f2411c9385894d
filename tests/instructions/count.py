#!/usr/bin/env python3
"""What a run costs in instructions: scenes without further effects must not pay for those that exist.

    count.py SPLASHDOWN            counts each scene of counts.csv and compares; exit 1 above the bar
    count.py SPLASHDOWN --write    writes what it counts

Instructions of a whole run under valgrind, one thread, which are the same each time on one system (a new compiler or library is
a reason to write them anew, with the change that brought it in). A rise by more than 0.5 % fails. Scenes are plane: valgrind does not
round as CGAL's intervals ask for, and the first mesh in space ends in its stack.
"""

import argparse
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BAR = 0.005
HERE = pathlib.Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"
COUNTS = HERE / "counts.csv"


def count(binary, scene, arguments):
    with tempfile.TemporaryDirectory() as folder:
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out"]
        command += [binary, "run", str(EXAMPLES / scene / "scene.toml"), *arguments.split(), "--out", f"{folder}/run"]
        command += ["--no-report", "--quiet", "--threads", "1"]
        environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OPENBLAS_CORETYPE="Haswell")
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        found = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode != 0 or not found:
            sys.exit(f"{scene}: ended with {done.returncode}: {done.stderr[-2000:]}")
        return int(found.group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("binary")
    parser.add_argument("--write", action="store_true", help="write counts.csv")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed")
        return 77
    with open(COUNTS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    failed = False
    for row in rows:
        now = count(options.binary, row["scene"], row["arguments"])
        before = int(row["instructions"])
        if before == 0 and not options.write:
            sys.exit(f"{row['scene']}: counts.csv has no count; --write makes it")
        change = now / before - 1 if before else 0
        print(f"{row['scene']} {row['arguments']}: {now} instructions, {100 * change:+.3f} %")
        failed |= change > BAR
        row["instructions"] = now
    if options.write:
        with open(COUNTS, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        return 0
    if failed:
        print(f"more than {100 * BAR:g} %: what the change added is paid by scenes that do not use it")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
