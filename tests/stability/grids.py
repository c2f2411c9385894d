#!/usr/bin/env python3
"""Random bodies in a fluid on a grid: polygons of any density, let go in a stream.

    tests/stability/grids.py build/release/splashdown polygons --members 10

Laws: the run ends at its end or where the body leaves the grid; all numbers are finite; the body gains no more energy than weight,
buoyancy and the stream have; what it gains of momentum the fluid loses, by a rectangle around it.
"""
import csv
import math
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import members  # noqa: E402

GRAVITY, SIZE = 1.0, 1 / 16  # m/s^2, m


def polygon(rng):
    """Corners in the order of their angles, 0.25 to 0.6 m from the middle, with an edge a square long at least."""
    angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(rng.randint(4, 9)))
    gaps = [(b - a) % (2 * math.pi) for a, b in zip(angles, angles[1:] + angles[:1])]
    if min(gaps) < 0.25 or max(gaps) > 2.6:
        return polygon(rng)
    radii = [rng.uniform(0.25, 0.6) for _ in angles]
    return [(r * math.cos(a), r * math.sin(a)) for r, a in zip(radii, angles)]


def scene(rng):
    """Its text, density over the fluid's, speed of the stream, area."""
    density, speed, way = 10 ** rng.uniform(-3, 2), rng.choice([0, rng.uniform(0, 1)]), rng.uniform(0, 2 * math.pi)
    corners = polygon(rng)
    area = 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, corners[1:] + corners[:1]))
    points = ", ".join(f"[{x:.6f}, {y:.6f}]" for x, y in corners)
    u, v = speed * math.cos(way), speed * math.sin(way)
    return f"""
[time]
end = 1.2
[gravity]
acceleration = [0.0, {-GRAVITY}]
[fluid]
formulation = "vortex"
density = 1.0
viscosity = {{dynamic = {1 / rng.uniform(50, 500):.6g}}}
stream = {{velocity = [{u:.6f}, {v:.6f}]}}
grid = {{min = [-2.5, -2.5], max = [2.5, 2.5], size = {SIZE}}}
[[body]]
name = "body"
density = {density:.6g}
pitch_deg = {rng.uniform(0, 360):.4g}
spin_deg = {rng.uniform(-90, 90):.4g}
shape = {{type = "polygon", points = [{points}]}}
""", density, speed, area


def rows_of(folder, name):
    with open(os.path.join(folder, name)) as f:
        return [{k: float(v) for k, v in row.items() if k != "body"} for row in csv.DictReader(f)]


def polygons(binary, seed, options, folder):
    """polygons: ends, momentum of fluid and body together, speed bound, no NaN"""
    text, density, speed, area = scene(random.Random(seed))
    try:
        out = members.run(binary, text, folder)
    except RuntimeError as error:
        if "leaves the grid" not in str(error):
            raise
        out = os.path.join(folder, "out")
    body, fluid = rows_of(out, "bodies.csv"), rows_of(out, "fluid.csv")
    finite = all(math.isfinite(row[k]) for row in body for k in ("x", "y", "vx", "vy", "wz", "fx", "fy", "mz"))
    lost, all_of_it, fastest = [0.0, 0.0], 0.0, 0.0
    for before, row, flow in zip(body, body[1:], fluid[1:]):
        dt = row["time"] - before["time"]
        way = math.hypot(row["x"] - body[0]["x"], row["y"] - body[0]["y"])
        free = 2 * speed + math.sqrt(2 * GRAVITY * abs(1 - density) / (density + 0.1) * (way + SIZE))
        fastest = max(fastest, math.hypot(row["vx"], row["vy"]) / (free + 0.05))
        if not math.isfinite(flow["control_fx_body"]):
            continue
        for k, axis in enumerate("xy"):
            lost[k] += dt * (row["f" + axis] - flow[f"control_f{axis}_body"])
        all_of_it += dt * (math.hypot(row["fx"], row["fy"]) + area * GRAVITY)  # a light body's load is next to none: what moves it is buoyancy
    share = math.hypot(*lost) / all_of_it
    words = f"density {density:.3g}, stream {speed:.2f} m/s: momentum {100 * share:.2f} %, speed {fastest:.2f} of the bound"
    return finite and share <= 0.01 and fastest <= 1, words


if __name__ == "__main__":
    members.try_members(members.arguments(__doc__, [polygons]).parse_args(), [polygons])
