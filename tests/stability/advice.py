#!/usr/bin/env python3
"""What a run advises next is followed: the grade improves, or the text has said that it may not.

    advice.py BINARY [--members 60] [--first SEED] [--keep DIR]

Members are hulls that drop on still water in the plane, on meshes and with steps far too coarse, at a refine of their own, so that most of
them are unresolved; those that are resolved or doubtful at once are left out and do not count. The command of `next` is run as it is told. Laws:

  it can be pasted: exit code 0, another grade or other numbers, at the refine that it names
  a promise holds: the grade is better
  no promise: the text says `may`
  the time told is that of this run times what `check` guesses of both: told / check is that of this run within a third

Standard library only. Exit code 1 if a member breaks a law."""
import argparse
import json
import math
import os
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time

MOST_FINER = 4
GRADES = ["resolved", "doubtful", "unresolved", "unphysical"]


def scene(seed):
    """A wedge, box, circle or capsule some elements wide; the text and the options of its first run."""
    r = random.Random(seed)
    length, speed = 10 ** r.uniform(-0.7, 0.3), r.uniform(0.8, 2.5)
    kind = r.choice(["wedge", "wedge", "circle", "capsule", "box"])
    pitch = r.choice([0, 5, 15]) if kind != "circle" else 0
    half = 0.5 * length
    shape, low = {
        "wedge": (f'{{type="wedge", deadrise_deg={r.choice([20, 30, 45])}, breadth={length:g}, height={0.6 * length:g}}}', 0.1 * length),
        "circle": (f'{{type="circle", radius={half:g}}}', half),
        "capsule": (f'{{type="capsule", radius={0.25 * length:g}, length={half:g}}}', 0.4 * length),
        "box": (f'{{type="box", width={length:g}, height={0.4 * length:g}}}', 0.45 * length)}[kind]
    if kind == "box":
        pitch = r.choice([10, 20])
    V = speed * math.sqrt(9.81 * length)
    end = r.choice([0.4, 0.8]) * length / V * 1.5
    size = length / r.choice([8, 12, 16, 24])
    steps = f"dt_max = {end / r.choice([8, 15]):g}\n" if r.random() < 0.3 else ""
    W = 3 * length
    text = f'''title = "advice {seed}"
[time]
end = {end:g}
{steps}[gravity]
[tank]
min = [{-W:g}, {-W:g}]
max = [{W:g}, {2 * length:g}]
[fluid]
density = 1000
[fluid.size]
surface = {max(size, length / 8):g}
far = {length / 2:g}
growth = 0.2
[[fluid.region]]
shape = "box"
min = [{-W:g}, {-W:g}]
max = [{W:g}, 0]
[[body]]
name = "hull"
shape = {shape}
density = {r.choice([100, 250, 500, 800])}
position = [0, {1.05 * low:g}]
pitch_deg = {pitch}
velocity = [0, {-V:g}]
size = {size:g}
'''
    refine = r.choice([0.5, 0.7, 1])
    return text, ["--refine", f"{refine:g}"] if refine != 1 else []


def summary_of(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def run(words, binary, folder):
    words = [binary if word == "splashdown" else word for word in words]
    return subprocess.run(words + ["--quiet"], cwd=folder, capture_output=True, text=True, check=False)


def guessed(binary, words, folder):
    """Seconds that check says of the scene and options of a command."""
    keep, skip = [], False
    for word in words[3:]:
        if skip or word in ("--no-report", "--large", "--resume", "--quiet"):
            skip = False
        elif word in ("--out", "--threads", "--until"):
            skip = True
        else:
            keep.append(word)
    said = subprocess.run([binary, "check", words[2], *keep], cwd=folder, capture_output=True, text=True, check=False).stdout
    clock = re.search(r"the run +(?:about|>) ([0-9:]+) on one core", said)
    if not clock:
        return math.nan
    seconds = 0
    for part in clock.group(1).split(":"):
        seconds = 60 * seconds + int(part)
    return seconds


def follow(binary, seed, folder):
    """What came of it: a row of the table, or nothing for a member that does not count."""
    os.makedirs(folder, exist_ok=True)
    text, options = scene(seed)
    with open(os.path.join(folder, "scene.toml"), "w", encoding="utf-8") as file:
        file.write(text)
    first = ["splashdown", "run", "scene.toml", *options, "--out", "out", "--threads", "1", "--no-report"]
    begun = run(first, binary, folder)
    if begun.returncode == 2:
        raise RuntimeError(begun.stderr)
    before = summary_of(os.path.join(folder, "out"))
    grade, said = before["verdict"]["grade"], before.get("next")
    if begun.returncode != 0 or grade != "unresolved":
        return None
    row = {"seed": seed, "before": grade, "after": "", "next": "", "promises": False, "broken": "", "told": math.nan, "took": math.nan}
    if not said:
        row["broken"] = "" if "impulse" in " ".join(before["verdict"]["reasons"]) else "no next step, and no reason why"
        return row
    row.update(next=said["text"], promises=said["promises"], told=said["seconds"])
    own = float(options[1]) if options else 1
    if said.get("refine", 0) > MOST_FINER * own:
        return None  # true or not, too dear to be followed
    words = shlex.split(said["command"])
    told, here = guessed(binary, words, folder), guessed(binary, first, folder)
    start = time.monotonic()
    ended = run(words, binary, folder)
    row["took"] = time.monotonic() - start
    if ended.returncode != 0:
        row["broken"] = f"exit code {ended.returncode}: {ended.stderr.strip()}"
        return row
    after = summary_of(os.path.join(folder, "out"))
    row["after"] = after["verdict"]["grade"]
    better = GRADES.index(row["after"]) < GRADES.index(grade)
    if said["promises"] and not better:
        row["broken"] = "a promise that did not hold: " + " ".join(after["verdict"]["reasons"])[:300]
    if not said["promises"] and "may" not in said["text"]:
        row["broken"] = "no promise, and the text does not say so"
    # check prints whole seconds: only long runs can be compared
    if here >= 20 and not 2 / 3 < (told / here) / (said["seconds"] / before["wall_seconds"]) < 3 / 2:
        row["broken"] = f"told {said['seconds']:.3g} s after {before['wall_seconds']:.3g} s, check says {told:g} s after {here:g} s"
    return row


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("binary")
    arguments.add_argument("--members", type=int, default=60)
    arguments.add_argument("--first", type=int, default=1)
    arguments.add_argument("--keep")
    asked = arguments.parse_args()
    binary, rows, seed = os.path.abspath(asked.binary), [], asked.first
    with tempfile.TemporaryDirectory() as work:
        while len(rows) < asked.members and seed < asked.first + 4 * asked.members:
            row = follow(binary, seed, os.path.join(asked.keep or work, str(seed)))
            seed += 1
            if row is None:
                continue
            rows.append(row)
            print(f"{row['seed']:>6} {row['before']} -> {row['after'] or '-':<10} told {row['told']:6.3g} s took {row['took']:6.3g} s  "
                  f"{'promised' if row['promises'] else 'may     '}  {row['next'][-110:]}" + (f"\n       BROKEN {row['broken']}" if row["broken"] else ""), flush=True)
    broken = [row for row in rows if row["broken"]]
    promised = [row for row in rows if row["promises"]]
    better = [row for row in rows if row["after"] and GRADES.index(row["after"]) < GRADES.index(row["before"])]
    print(f"{len(rows)} unresolved runs: {len(promised)} promises, {len(better)} better, {len(broken)} break a law")
    return 1 if broken or len(rows) < asked.members else 0


if __name__ == "__main__":
    sys.exit(main())
