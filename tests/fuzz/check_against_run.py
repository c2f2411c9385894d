"""What `splashdown check` calls good is not refused by `run` at its start, and what it refuses `run` refuses, too.

  check_against_run.py PATH_OF_SPLASHDOWN PATH_OF_STABILITY_ENSEMBLE COUNT [--seed N] [--jobs N] [--wait SECONDS] [--keep FOLDER]

Scenes are members of the stability classes (docs/stability.md), every other one with a slip: a number of it is another one, or a
body has come nearer to what is beside it. A run gets no farther than its first step. One whose first mesh is not ready after
--wait seconds is left out and counted. Scene K of a seed is always the same.
"""

import argparse
import collections
import concurrent.futures
import pathlib
import random
import re
import subprocess
import sys
import tempfile

# Classes and how often they are drawn: those with bodies side by side most often.
CLASSES = {"slots": 6, "light_polygons": 3, "light_hulls": 4, "light_solids": 4, "round_drops": 1, "drops_and_jets": 1}
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
FACTORS = (1000, 0.001, 10, 0.1, 3, 0.3, -1, 0.5, 2)


def members(ensemble, folder, seed, count):
    """Folders with scene.toml and what belongs to it."""
    rng = random.Random(f"members {seed}")
    kinds = rng.choices(list(CLASSES), CLASSES.values(), k=count)
    places = []
    for kind in CLASSES:
        many = kinds.count(kind)
        if many == 0:
            continue
        first = 100_000 + 1000 * seed
        subprocess.run([ensemble, "--class", kind, "--seeds", f"{first}:{first + many - 1}", "--write", folder], check=True)
        places += [folder / kind / str(first + k) for k in range(many)]
    return places


def nearer(rng, text):
    """The last body's first coordinate moves by a share of itself: gaps close, open, or become overlaps."""
    at = text.rfind("position = [")
    number = NUMBER.search(text, at) if at >= 0 else None
    if number is None:
        return text
    value = float(number.group()) * (1 + rng.choice((-1, 1)) * 10 ** rng.uniform(-3, -0.5))
    return text[: number.start()] + f"{value:.6g}" + text[number.end() :]


def other_number(rng, text):
    places = [p for p in NUMBER.finditer(text) if "dimension" not in text[max(0, p.start() - 14) : p.start()]]
    at = rng.choice(places)
    return text[: at.start()] + f"{float(at.group()) * rng.choice(FACTORS):.9g}" + text[at.end() :]


def slip(seed, k, scene):
    rng = random.Random(f"slip {seed} {k}")
    if rng.random() < 0.5:
        text = scene.read_text()
        scene.write_text((nearer if rng.random() < 0.7 else other_number)(rng, text))


def answer(command, seconds):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
        return done.returncode, (done.stderr or done.stdout).strip()
    except subprocess.TimeoutExpired:
        return None, ""


def compare(splashdown, place, wait):
    """Kind of agreement, and what both said where they do not."""
    scene = place / "scene.toml"
    checked, said = answer([splashdown, "check", scene], 10 * wait)
    ran, told = answer(
        [splashdown, "run", scene, "--out", place / "run", "--until", "1e-12", "--threads", "1", "--quiet", "--no-report", "--budget", str(wait)],
        10 * wait,
    )
    if ran is None or ran == 130:
        return "not known, the first mesh takes longer", ""
    if checked not in (0, 2):
        return "DISAGREE", f"check ended with {checked}: {said}"
    refused = ran == 2
    if (checked == 2) == refused:
        return ("refused by both" if refused else "good for both"), ""
    return "DISAGREE", f"check {checked}: {said[-300:]}\n    run {ran}: {told[-300:]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("splashdown", type=pathlib.Path)
    parser.add_argument("ensemble", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--wait", type=float, default=30)
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        places = members(options.ensemble.resolve(), folder.resolve(), options.seed, options.count)
        for k, place in enumerate(places):
            slip(options.seed, k, place / "scene.toml")
        counts = collections.Counter()
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for place, (kind, why) in zip(places, pool.map(lambda p: compare(options.splashdown.resolve(), p, options.wait), places)):
                counts[kind] += 1
                if why:
                    print(f"{place.parent.name} {place.name}: {why}", flush=True)
        print(", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())))
        return 1 if counts["DISAGREE"] else 0


if __name__ == "__main__":
    sys.exit(main())
