#!/usr/bin/env python3
"""Random elastic bodies that land on water, or are let go under it: shapes, stiffness, density down to a thousandth of water's.

    tests/stability/elastics.py build/release/splashdown bodies --members 6

Laws: the run ends at its end; all numbers are finite; the body has no more energy than it began with and the water's work on it, to
2 % of the largest of these (it may have less: vibrations that steps do not resolve are damped); with modes as coordinates passes
do not exceed three in the mean.
"""
import json
import math
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import members  # noqa: E402
from grids import rows_of  # noqa: E402

WATER, GRAVITY, LENGTH = 1000.0, 9.81, 0.5  # kg/m^3, m/s^2, m


def outline(rng):
    """A plate, an ellipse or a wedge, 0.5 m long, and its thinnest part."""
    kind = rng.choice(["plate", "ellipse", "wedge"])
    height = LENGTH * rng.uniform(0.06, 0.4)
    if kind == "plate":
        return f'{{type = "box", width = {LENGTH}, height = {height:.4f}}}', height
    if kind == "ellipse":
        points = [(0.5 * LENGTH * math.cos(a), 0.5 * height * math.sin(a)) for a in (2 * math.pi * k / 24 for k in range(24))]
    else:
        points = [(0.0, -0.5 * height), (0.5 * LENGTH, 0.3 * height), (0.5 * LENGTH, 0.5 * height), (-0.5 * LENGTH, 0.5 * height), (-0.5 * LENGTH, 0.3 * height)]
    return '{type = "polygon", points = [' + ", ".join(f"[{x:.5f}, {y:.5f}]" for x, y in points) + "]}", height


def scene(rng):
    """Its text, density over water's, modulus over the weight of water as high as the body is long, whether modes are its coordinates."""
    shape, height = outline(rng)
    density, stiffness, modal = 10 ** rng.uniform(-3, 0), 10 ** rng.uniform(2.5, 6), rng.random() < 0.5
    under = rng.random() < 0.3
    y, speed = (-0.4, 0.0) if under else (0.5 * LENGTH + 0.03, rng.uniform(0, 2))
    coordinates = f'coordinates = "modes"\nmodes = {rng.randint(5, 16)}' if modal else ""
    return f"""
dimension = 2
[time]
end = 0.3
dt_max = 2e-3
[gravity]
acceleration = [0.0, {-GRAVITY}]
[tank]
min = [-1.0, -0.8]
max = [1.0, 0.8]
[fluid]
density = {WATER}
[fluid.size]
surface = 0.03
far = 0.06
[[fluid.region]]
shape = "box"
min = [-1.0, -0.8]
max = [1.0, 0.0]
[[body]]
name = "body"
shape = {shape}
position = [0.0, {y}]
velocity = [{rng.uniform(-0.5, 0.5):.3f}, {-speed:.3f}]
pitch_deg = {rng.uniform(-25, 25):.3g}
density = {WATER * density:.6g}
size = {min(0.025, 0.5 * height):.4f}
[body.elastic]
young_modulus = {stiffness * WATER * GRAVITY * LENGTH:.6g}
poisson_ratio = {rng.uniform(0, 0.45):.3g}
size = {max(0.02, 0.7 * height):.4f}
{coordinates}
""", density, stiffness, modal


def bodies(binary, seed, options, folder):
    """bodies: ends, energy of the body by the water's work, no NaN, few passes"""
    text, density, stiffness, modal = scene(random.Random(seed))
    out = members.run(binary, text, folder)
    solid, fluid = rows_of(out, "elastic.csv"), rows_of(out, "fluid.csv")
    finite = all(math.isfinite(v) for row in solid for v in row.values())
    # Strain and motion are those of t_{n-1/2}, places those of t_n; the water's work is told to t_n, its kick there half done.
    weight = [row["potential_energy"] for row in solid]
    own = [row["strain_energy"] + row["kinetic_energy"] + 0.5 * (weight[max(n - 1, 0)] + weight[n]) for n, row in enumerate(solid)]
    work = [flow["work_on_walls"] for flow in fluid]
    kept = [0.5 * (own[n] + own[n + 1]) - work[n] for n in range(1, len(own) - 1)]
    largest = max(max(abs(v) for v in values) for values in (own, work, weight))
    gained, lost = max(v - kept[0] for v in kept), max(kept[0] - v for v in kept)
    with open(os.path.join(out, "summary.json")) as f:
        passes = json.load(f)["coupling"]["passes_mean"]
    words = f"density {density:.2g}, stiffness {stiffness:.1e}, {'modes' if modal else 'nodes'}: energy +{100 * gained / largest:.2f} -{100 * lost / largest:.2f} %, {passes:.2f} passes"
    return finite and gained <= 0.02 * largest and (not modal or passes <= 3), words


if __name__ == "__main__":
    members.try_members(members.arguments(__doc__, [bodies]).parse_args(), [bodies])
