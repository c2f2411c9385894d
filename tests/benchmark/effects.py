#!/usr/bin/env python3
"""What theory advises against what runs say, on the shipped plane scenes: the tables of docs/effects.md.

    tests/benchmark/effects.py build/release/splashdown [--page docs/effects.md] [--out out/effects] [--jobs 2] [SCENE...]

Each scene has one `splashdown advise` and one `splashdown ablate --all --refine draft`; what is finished there is reused. Without
SCENE all of SCENES. Rewrites what stands between the marks of the page. Ends with 1 if advice and runs disagree where no exception is explained.
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEGIN, END = "<!-- tables: made by tests/benchmark/effects.py -->", "<!-- end of tables -->"

# Plane scenes whose ablation takes minutes: with arguments that shorten long ones to what an effect needs to show.
SCENES = {
    "circle_entry/scene": [],
    "dam_break/scene": [],
    "elliptic_drop/scene": [],
    "flat_plate_impact/scene": [],
    "floating_box/scene_displaced": ["--set", "time.end=6"],
    "hinged_plate/scene": [],
    "light_wedge/scene": [],
    "release_under_water/scene": [],
    "sloshing/scene": ["--set", "time.end=3.3"],
    "two_boxes/scene": [],
    "wedge_drop/scene": [],
    "wedge_drop_yettou/scene": [],
    "wedge_entry/scene": [],
    "wedge_entry/scene_45": [],
}

# (scene, effect): why advice and runs differ. A line each in the page.
EXPLAINED = {
    ("flat_plate_impact/scene", "gravity"): "the impact is an impulse; what the panel has afterwards is the weight of the water alone",
}


def say(program, arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    if done.returncode not in (0, 3):  # 3: a variant that could not go on is a row without a result
        sys.exit(f"splashdown {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def percent(change):
    if change is None:
        return "–"
    return "< 0.1 %" if abs(change) < 1e-3 else f"{100 * change:.2g} %"


def numbers(effect):
    return "; ".join(f"{n['name']} = {n['value']:.3g}" + ("" if n["unit"] == "-" else " " + n["unit"])
                     for n in effect["numbers"] if n["value"] is not None)


def rows_of(scene, advice, ablation):
    """Rows of the scene's table, and what disagrees."""
    rows, wrong = [], []
    by_effect = {e["name"]: e for e in advice["effects"]}
    for variant in ablation["variants"]:
        if variant["kind"] == "scene":
            continue
        effect = by_effect.get(variant["what"]) if variant["kind"] != "choice" else None
        name = variant["what"] if effect else f"{variant['what']}: {variant['variant']}"
        said = effect["advice"] if effect else ""
        change = effect["change"] if effect else {"peak_load": None, "motion": None}
        agrees = {None: "", True: "yes", False: "no"}[variant["agrees"]]
        if variant["agrees"] is False:
            reason = EXPLAINED.get((scene, variant["what"]))
            agrees = f"no: {reason}" if reason else "no"
            if not reason:
                wrong.append(f"{scene}: {variant['line']}")
        line = variant["line"].split(": ", 1)[1].split(" (advise")[0]
        rows.append(f"| {name} | {'yes' if variant['kind'] == 'without' else '' if not effect else 'no'} | {said} | {percent(change['peak_load'])} | "
                    f"{percent(change['motion'])} | {line} | {agrees} |")
    return rows, wrong


def table_of(scene, advice, ablation):
    rows, wrong = rows_of(scene, advice, ablation)
    absent = [f"| {e['name']} | {e['advice']} | {numbers(e)} |" for e in advice["effects"] if not e["available"]]
    if absent:
        absent = ["", "| not to be had yet | advice | numbers |", "|---|---|---|", *absent]
    text = [f"### {scene.removesuffix('/scene').replace('/scene_', ', ')}", "", advice["entry"] or "No body enters the water.", "",
            "| effect or choice | there | advice | peak load, expected | motion, expected | runs | agree |", "|---|---|---|---|---|---|---|",
            *rows, *absent, ""]
    return "\n".join(text), wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("splashdown")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "effects")
    parser.add_argument("--jobs", default="2")
    given = parser.parse_args()
    texts, wrong = [], []
    for scene in given.scenes or SCENES:
        path, extra = ROOT / "examples" / f"{scene}.toml", SCENES.get(scene, [])
        advice = json.loads(say(given.splashdown, ["advise", path, "--json", *extra]))
        folder = given.out / scene.replace("/", "_")
        say(given.splashdown, ["ablate", path, "--all", "--refine", "draft", "--jobs", given.jobs, "--quiet", "--out", folder, *extra])
        text, differs = table_of(scene, advice, json.loads((folder / "ablation.json").read_text()))
        texts.append(text)
        wrong += differs
        print(text, flush=True)
    if given.page:
        page = given.page.read_text()
        before, rest = page.split(BEGIN)
        given.page.write_text(before + BEGIN + "\n\n" + "\n".join(texts) + "\n" + END + rest.split(END)[1])
    for line in wrong:
        print("not explained:", line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
