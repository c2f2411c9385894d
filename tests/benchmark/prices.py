#!/usr/bin/env python3
"""What the examples' prices promise, and how often they are right: docs/price.md's table.

    tests/benchmark/prices.py build/release/splashdown [CASE...]     (default: all; those in space take most of an hour)

One `splashdown price` a case, one thread, with a budget of ten minutes in the plane and 45 in space (90 for small elements at the
root of a jet), in out/prices/CASE; what is finished there is reused. Prints the price list and each quantity with its band, and beside it what is known to be true (the examples' references).
"""
import json
import pathlib
import subprocess
import sys
import time

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"

LOAD_2D = "force=mean(fy/(1000*time), time) from bodies.csv:wedge where time >= {}"
CP_MAX = "cp_max=mean(group_max(2*p/1000, time)) from surface_pressure.csv:wedge where time >= {}"
CP_PLACE = "cp_place=mean(group_argmax(p, time, y/time)) from surface_pressure.csv:wedge where time >= {}"
PEAK_3D = "max(select(smooth(az, time, 0.002), abs(time - 0.00325) < 0.00225))"
PEAK_TIME_3D = ("argmax(select(smooth(az, time, 0.002), abs(time - 0.00325) < 0.00225), "
                "select(time, abs(time - 0.00325) < 0.00225))")

# Pressure of a cone: the largest mean of p, at 20 and 60 degrees of p + p_repair, what loads the hull, over a ring a sixteenth of V t
# high, wherever it lies: a twentieth of the wetted radius at 20 to 60 degrees. Repairs are noise from step to step, so (nearly) each
# step is recorded. The references' curves have their means by the same rule (reference_cp_20.csv, reference_cp_30.csv). At 45 degrees
# the apex has the largest, in rings of V t/40, of p alone (the largest of many means picks out what repairs scatter), where
# reference_cp_45.csv has a mean of 1.552 by height and 1.536 by area. At 60 degrees it is the tip: the mean over the area of a disc.
EACH_STEP = ["--set", 'record=[{kind="surface_pressure", wall="cone"}]']
CONE_LOAD = "force=mean(fz/(1000*time^2), time) from bodies.csv:cone where time >= {}"
CONE_CP_45 = "cp_max=max(bins(2*p/1000, z/time, -1, 0.25, 50)) from surface_pressure.csv:cone where time >= 0.4"
CONE_TIP = "disc=largest_mean(2*(p + p_repair)/1000, (1 + z/time)^2, 0.0625^2) from surface_pressure.csv:cone where time >= 0.3"
CONE_CP = "cp_max=largest_mean(2*({})/1000, z/time, 0.0625) from surface_pressure.csv:cone where time >= {}"

# Pressures of the sphere: the largest mean over a ring of a twentieth of (3 R h)^1/2, the wetted radius of shallow spheres (Wagner
# 1932), at h/R = 0.1; and at the lowest point, within 0.15 of that radius.
SPHERE_LOW = ("low=mean(2*(p + p_repair)/1000) from surface_pressure.csv:sphere "
              "where abs(time + 0.002 - 0.1) < 0.0075 and x^2 + y^2 < 0.15^2*3*0.1")
SPHERE_CP = ("cp_max=largest_mean(2*(p + p_repair)/1000, sqrt((x^2 + y^2)/(3*(time + 0.002))), 0.05) from surface_pressure.csv:sphere "
             "where abs(time - 0.098) < 0.0075")

# The capsule: its draft by Archimedes less what the water it displaces raises the level by in a tank 8 m wide.
# scene, options, quantities (none: those that price chooses), what is known of them
CASES = {
    "wedge_entry_30": ("wedge_entry/scene.toml", ["--open-water"],
                       [LOAD_2D.format(0.16), CP_MAX.format(0.36), CP_PLACE.format(0.36)],
                       {"force": 14.02, "cp_max": 6.895, "cp_place": 0.4254}),
    "wedge_entry_45": ("wedge_entry/scene_45.toml", ["--open-water"],
                       [LOAD_2D.format(0.28), CP_MAX.format(0.63), CP_PLACE.format(0.63)],
                       {"force": 3.448, "cp_max": 2.705, "cp_place": -1}),
    "wedge_drop": ("wedge_drop/scene.toml", ["--open-water"],
                   ["peak_force=max(smooth(fy, time, 5e-4)) from bodies.csv:wedge",
                    *(f"speed_{ms}ms=-interp(time, vy, {ms / 1000}) from bodies.csv:wedge" for ms in (8, 16, 24)),
                    "force_20ms=interp(time, smooth(fy, time, 5e-4), 0.020) from bodies.csv:wedge"],
                   {"peak_force": 26746, "speed_8ms": 5.8321, "speed_16ms": 5.068, "speed_24ms": 4.619, "force_20ms": 14270}),
    "light_wedge": ("light_wedge/scene.toml", ["--open-water"],
                    ["peak_force=max(smooth(fy, time, 2e-4)) from bodies.csv:wedge"], {"peak_force": 7360}),
    "capsule_drop_2d": ("capsule_drop_2d/scene.toml", [], [], {"capsule.rest_submergence": 0.0688812 - 0.0371386 / 8}),
    "cone_entry_45": ("cone_entry/scene_45.toml", ["--accuracy", "4%", *EACH_STEP], [CONE_LOAD.format(0.2), CONE_CP_45],
                      {"force": 3.331, "cp_max": 1.544}),
    "cone_entry_20": ("cone_entry/scene_20.toml",
                      ["--set", "body.cone.size=0.04", "--set", "fluid.size.hollow_min=0.0078", "--budget", "5400",
                       "--accuracy", "4%", "--set", 'record=[{kind="surface_pressure", wall="cone", interval=0.001}]'],
                      [CONE_LOAD.format(0.24), CONE_CP.format("p + p_repair", 0.24)], {"force": 120.7, "cp_max": 11.06}),
    "cone_entry_30": ("cone_entry/scene.toml", [], [CONE_LOAD.format(0.2), CONE_CP.format("p", 0.4)],
                      {"force": 24.694, "cp_max": 4.555}),
    "cone_entry_30_root": ("cone_entry/scene.toml",
                           ["--set", "body.cone.size=0.032", "--set", "fluid.size.hollow=0.3",
                            "--set", "fluid.size.hollow_min=0.0078", "--budget", "5400", "--accuracy", "4%"],
                           [CONE_LOAD.format(0.2), CONE_CP.format("p", 0.4)], {"force": 24.694, "cp_max": 4.555}),
    "cone_entry_60": ("cone_entry/scene_60.toml",
                      ["--set", "body.cone.size=0.025", "--set", "fluid.size.corner=0.25", "--rungs", "5", "--accuracy", "4%", *EACH_STEP],
                      [CONE_LOAD.format(0.2), CONE_TIP], {"force": 0.4094, "disc": 0.873}),
    "sphere_entry": ("sphere_entry/scene.toml",
                     ["--set", "time.end=0.107", "--set", 'record=[{kind="surface_pressure", wall="sphere", interval=0.0005}]',
                      "--rungs", "3", "--accuracy", "4%"],
                     ["force_10=mean(fz/(1570.796), time) from bodies.csv:sphere where abs(time - 0.098) < 0.01",
                      SPHERE_CP, SPHERE_LOW], {"force_10": 1.038, "low": 3.042}),
    "capsule_water_landing": ("capsule_water_landing/scene.toml", [],
                              [f"peak={PEAK_3D} from bodies.csv:capsule",
                               f"speed_at_peak=-interp(time, vz, {PEAK_TIME_3D})/4.5 from bodies.csv:capsule"],
                              {"peak": 143.1, "speed_at_peak": 0.911}),
    "uav_landing": ("uav_landing/scene.toml", [], [], {}),
}


def price(program, case):
    """The price list and the seconds it took."""
    scene, options, quantities, _ = CASES[case]
    folder = pathlib.Path("out/prices") / case
    in_space = "dimension = 3" in (EXAMPLES / scene).read_text()
    command = [program, "price", str(EXAMPLES / scene), "--out", str(folder), "--threads", "1", "--quiet", *options]
    if "--budget" not in options:
        command += ["--budget", "2700" if in_space else "600"]
    if "\nframes" in (EXAMPLES / scene).read_text():
        command += ["--set", "output.frames="]
    for quantity in quantities:
        command += ["--quantity", quantity]
    start = time.monotonic()
    subprocess.run(command, check=True)
    return json.loads((folder / "price.json").read_text()), time.monotonic() - start


def told_seconds(seconds):
    if seconds >= 6000:
        return f"{seconds / 3600:.2g} h"
    return f"{seconds:.2g} s" if seconds < 100 else f"{seconds / 60:.2g} min"


def told_rows(rows):
    return "; ".join(f"{row['accuracy_percent']:g} %: {told_seconds(row['seconds'])}" + ("*" if row["extrapolated"] else "")
                     for row in rows if row["seconds"] is not None)


def main():
    program, *wanted = sys.argv[1:]
    inside = known = 0
    print("| case | took | list | quantity | by itself | true | value ± band | deviation |\n|---|---|---|---|---|---|---|---|")
    for case in wanted or CASES:
        found, took = price(program, case)
        first = f"{case} | {told_seconds(took)} | {told_rows(found['rows'])}"
        for name, quantity in found["quantities"].items():
            if not quantity["counts"] or quantity["value"] is None:
                continue
            value, band, true = quantity["value"], quantity["band"], CASES[case][3].get(name)
            row = f"{value:.5g}" + ("" if band is None else f" ± {band:.2g}")
            deviation = ""
            if true is not None and band is not None:
                known += 1
                inside += abs(value - true) <= band
                deviation = f"{100 * (value / true - 1):+.2g} %" + ("" if abs(value - true) <= band else ", outside")
            print(f"| {first} | {name} | {told_rows(quantity['rows'])} | {'' if true is None else f'{true:g}'} | {row} | {deviation} |", flush=True)
            first = " | |"
    print(f"\n{inside} of {known} within the band")


if __name__ == "__main__":
    main()
