#!/usr/bin/env python3
"""What theory advises against what runs say, on all shipped scenes: the tables of docs/effects.md.

    tests/benchmark/effects.py build/release/splashdown [--page docs/effects.md] [--out out/effects] [--jobs 2] [--minutes 6] [SCENE...]

Each scene has one `splashdown advise` and one `splashdown ablate --all`. A scene that takes more than --minutes of processor time is stopped, and told with what there is of
it: `ablate` begins with what the scene has and with what is advised. The same command continues it; what is finished is reused. Without SCENE all of
SCENES, the short ones first. --collect makes no runs.
Writes between the marks of the page, where tables of other scenes stay. Ends with 1 if advice and runs disagree where no exception is explained, or if a shipped
scene is neither in SCENES nor in EXCLUDED.
"""
import argparse
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEGIN, END = "<!-- tables: made by tests/benchmark/effects.py -->", "<!-- end of tables -->"

# All shipped scenes, the short ones first: with arguments that shorten long ones to what an effect needs to show. Without --refine: draft.
SCENES = {
    "hydrostatic/scene": [],
    "elliptic_drop/scene": [],
    "moored_float/scene_tether": [],
    "moored_float/scene": [],
    "parachute_landing/scene": [],
    "planing_plate/scene": [],
    "dam_break/scene": [],
    "jet_on_plate/scene": [],
    "wedge_drop_yettou/scene": [],
    "light_wedge/scene": [],
    "terminal_speed/scene": [],
    "bird_on_plate/scene": [],
    "bird_on_plate/scene_flat": [],
    "leading_edge/scene_bird": [],
    "two_boxes/scene_wall": [],
    "two_boxes/scene": [],
    "sloshing/scene": ["--set", "time.end=3.3"],
    "flat_plate_impact/scene": [],
    "wave_landing/scene": [],
    "wave_flume/scene": ["--set", "time.end=8"],
    "release_under_water/scene": [],
    "wedge_drop/scene": [],
    "hinged_plate/scene": [],
    "circle_entry/scene": [],
    "floating_box/scene": [],
    "floating_box/scene_displaced": ["--set", "time.end=6"],
    "box_in_waves/scene_decay": [],
    "box_in_waves/scene": ["--set", "time.end=8"],
    "glider_ditching/scene": [],
    "wedge_entry/scene": [],
    "wedge_entry/scene_45": [],
    "jet_impact/scene": [],
    "jet_impact/scene_round": ["--refine", "0.6", "--set", "time.end=0.004"],
    "leading_edge/scene": ["--refine", "0.5"],
    "viscous_jet/scene": [],
    "added_mass/scene": [],
    "added_mass/scene_turning": [],
    "regular_waves/scene": ["--set", "time.end=8"],
    "capsule_drop_2d/scene": ["--set", "time.end=3"],
    "capsule_drop_2d/scene_afloat": ["--set", "time.end=3"],
    "wedge_entry/scene_75": [],
    "circle_entry/scene_cavity": [],
    "capsule_water_landing/scene_attitude": [],
    "float_stability/scene": ["--set", "time.end=1.5"],
    "sphere_heave/scene": ["--set", "time.end=3.5"],
    "uav_landing/scene": ["--refine", "0.3", "--set", "time.end=0.25"],
    "capsule_water_landing/scene": ["--refine", "0.3"],
    "sphere_entry/scene": ["--refine", "0.25"],
    "cone_entry/scene_20": ["--refine", "0.25"],
    "cone_entry/scene_45": ["--refine", "0.25"],
    "cone_entry/scene": ["--refine", "0.25"],
    "cone_entry/scene_60": ["--refine", "0.25"],
    "wedge_entry/scene_15": ["--set", "time.end=0.12"],
    "wedge_entry/scene_10": ["--set", "time.end=0.06"],
    "wedge_entry/scene_5": ["--set", "time.end=0.03"],
    "release_under_water_3d/scene": [],
    "release_under_water_3d/scene_disc": [],
    "uav_landing/scene_afloat": ["--refine", "0.3", "--set", "time.end=0.8"],
}

# Shipped scenes without a table, and why.
NO_EFFECTS = "fills a grid, where the tables of effects have no part, and ablate has no meshes to change"
EXCLUDED = {
    "cylinder_wake/scene": NO_EFFECTS,
    "flapping_foil/scene": NO_EFFECTS,
    "impulsive_cylinder/scene": NO_EFFECTS,
    "oscillating_cylinder/scene": NO_EFFECTS,
    "plate_trajectories/scene": NO_EFFECTS,
    "sedimenting_cylinder/scene": NO_EFFECTS,
}

# (scene, effect): why advice and runs differ. A line each in the page.
EXPLAINED = {
    ("flat_plate_impact/scene", "gravity"): "the impact is an impulse; what the panel has afterwards is the weight of the water alone",
    ("circle_entry/scene_cavity", "form_drag"): "the cavity behind it stays open, and drag acts on wet facets alone",
    ("hinged_plate/scene", "skin_friction"): "a plate that swings in its own splash; three draft meshes, no finer one was tried",
}


def say(program, arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    if done.returncode not in (0, 3):  # 3: a variant that could not go on is a row without a result
        sys.exit(f"splashdown {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def processor_seconds(pid):
    """Of a process and its children that have ended (proc(5)); on a loaded machine a minute of the clock is little work."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


def wait_for(run, seconds):
    """What it says on standard error; TimeoutExpired after so many seconds of processor time, 0: never."""
    while True:
        try:
            return run.communicate(timeout=1)[1]
        except subprocess.TimeoutExpired:
            if seconds and processor_seconds(run.pid) > seconds:
                raise


def ablated(program, arguments, folder, seconds):
    """What ablation.json of the folder says after so much processor time; nothing where not even the scene has run."""
    if seconds == 0:
        arguments = [*arguments, "--collect"]
    run = subprocess.Popen([program, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    try:
        words = wait_for(run, seconds)
        if run.returncode not in (0, 1, 3):
            return None, words.strip()
    except subprocess.TimeoutExpired:
        run.send_signal(signal.SIGINT)  # checkpoints are written
        run.communicate()
        say_all = subprocess.run([program, *map(str, arguments), "--collect"], capture_output=True, text=True)
        if say_all.returncode not in (0, 1, 3):
            return None, say_all.stderr.strip()
    result = folder / "ablation.json"
    return (json.loads(result.read_text()), "") if result.exists() else (None, "no run was finished")


def percent(change):
    if change is None:
        return "–"
    return "< 0.1 %" if abs(change) < 1e-3 else f"{100 * change:.2g} %"


def numbers(effect):
    return "; ".join(f"{n['name']} = {n['value']:.3g}" + ("" if n["unit"] == "-" else " " + n["unit"])
                     for n in effect["numbers"] if n["value"] is not None)


def ran(variant):
    """Whether there is a result, or a cause why there can be none; not where time was over before."""
    line = variant.get("line") or ""
    return bool(line) and not any(word in line for word in ("no result: waiting", "no result: interrupted", "no result: running"))


def rows_of(scene, advice, ablation):
    """Rows of the scene's table, and what disagrees."""
    rows, wrong = [], []
    by_effect = {e["name"]: e for e in advice["effects"]}
    for variant in ablation["variants"]:
        if variant["kind"] == "scene" or not ran(variant):
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


def left_out(ablation):
    """A line for what the time was too short for."""
    names = [v["what"] for v in ablation["variants"] if v["kind"] != "scene" and not ran(v)]
    return ["", f"Not run for want of time: {', '.join(names)}."] if names else []


def how_run(arguments):
    """A line for runs that are not those of the scene at draft."""
    words = " ".join(f"`{option} {value}`" for option, value in zip(arguments[::2], arguments[1::2]))
    return ["", f"Runs with {words}."] if words else []


def without_refine(arguments):
    return [a for option, value in zip(arguments[::2], arguments[1::2]) if option != "--refine" for a in (option, value)]


def table_of(scene, advice, ablation):
    rows, wrong = rows_of(scene, advice, ablation)
    absent = [f"| {e['name']} | {e['advice']} | {numbers(e)} |" for e in advice["effects"] if not e["available"]]
    if absent:
        absent = ["", "| not to be had yet | advice | numbers |", "|---|---|---|", *absent]
    text = [f"### {scene.removesuffix('/scene').replace('/scene_', ', ')}", "", advice["entry"] or "No body enters the water.", "",
            "| effect or choice | there | advice | peak load, expected | motion, expected | runs | agree |", "|---|---|---|---|---|---|---|",
            *rows, *how_run(SCENES.get(scene, [])), *left_out(ablation), *absent, ""]
    return "\n".join(text), wrong


def shipped():
    """Scenes of the examples, as SCENES names them; studies and checks are none."""
    for path in sorted((ROOT / "examples").glob("*/scene*.toml")):
        yield f"{path.parent.name}/{path.stem}"


def by_heading(text):
    """Tables of a page by their headings."""
    parts = re.split(r"^(?=### )", text, flags=re.M)
    return {part.split("\n", 1)[0]: part.rstrip() + "\n" for part in parts if part.startswith("### ")}


def write_page(page, texts):
    """Puts the tables into the page. One with more results than the new one of its scene stays, and so do those of scenes that were not made."""
    before, rest = page.read_text().split(BEGIN)
    tables, after = rest.split(END)
    found = by_heading(tables)
    for heading, text in by_heading("\n".join(texts)).items():
        results = text.count(" time: ")  # runs; what theory says of other effects may become less
        if heading not in found or results >= found[heading].count(" time: "):
            found[heading] = text
    page.write_text(before + BEGIN + "\n\n" + "\n".join(found.values()) + "\n" + END + after)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("splashdown")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "effects")
    parser.add_argument("--jobs", default="2")
    parser.add_argument("--minutes", type=float, default=6, help="of processor time, a scene")
    parser.add_argument("--collect", action="store_true", help="no runs: tables of what is there")
    given = parser.parse_intermixed_args()
    texts, wrong, unfinished = [], [], []
    missing = [scene for scene in shipped() if scene not in SCENES and scene not in EXCLUDED]
    for scene in given.scenes or SCENES:
        path, extra, begin = ROOT / "examples" / f"{scene}.toml", SCENES.get(scene, []), time.time()
        advice = json.loads(say(given.splashdown, ["advise", path, "--json", *without_refine(extra)]))
        folder = given.out / scene.replace("/", "_")
        ablation, why = ablated(given.splashdown, ["ablate", path, "--all", *([] if "--refine" in extra else ["--refine", "draft"]), "--jobs",
                                                   given.jobs, "--threads", "1", "--quiet", "--out", folder, *extra],
                                 folder, 0 if given.collect else 60 * given.minutes)
        if ablation is None or not any(v["kind"] != "scene" and ran(v) for v in ablation["variants"]):
            unfinished.append(scene)
            print(f"{scene}: nothing after {time.time() - begin:.0f} s: {why}", flush=True)
            continue
        text, differs = table_of(scene, advice, ablation)
        texts.append(text)
        wrong += differs
        print(text, f"{time.time() - begin:.0f} s", flush=True)
        if given.page:
            write_page(given.page, texts)
    if unfinished:
        print("nothing of:", ", ".join(unfinished), file=sys.stderr)
    for line in wrong:
        print("not explained:", line, file=sys.stderr)
    for scene in missing:
        print("not in SCENES:", scene, file=sys.stderr)
    return 1 if wrong or missing else 0


if __name__ == "__main__":
    sys.exit(main())
