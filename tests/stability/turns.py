#!/usr/bin/env python3
"""Random ellipses that turn in deep water, and what the coefficient of their form drag says of the runs.

    turns.py BINARY [--members 4] [--first SEED] [--elements 10] [--keep DIR]

A section starts with a rate in water at rest. At once it keeps the share I/(I + I_a) of it, I_a = pi rho (a^2 - b^2)^2/8 (Lamb 1932), within 2 %.
Then its rate falls to half in the time that strips with the coefficient C and ways of their own give, within 15 %:

    (I + I_a) dw/dt = -w^2 1/2 rho C int over the rear r^2 (e_t . n) g(theta r / 1.8 D) ds

D the diameter of the circle that holds as much. One line a member. Exit code 1 if a member breaks a law. Standard library only."""
import argparse
import csv
import math
import os
import random
import subprocess
import sys
import tempfile

RHO, COEFFICIENT, DEVELOPS = 1000.0, 1.2, 1.8


def moment(a, b, angle, pieces=800):
    """Over the square of the rate, after a turn by `angle` from rest [kg m]."""
    length, total = DEVELOPS * 2 * math.sqrt(a * b), 0.0
    for i in range(pieces):
        t = [2 * math.pi * (i + k) / pieces for k in (0, 1)]
        (x0, x1), (y0, y1) = [a * math.cos(s) for s in t], [b * math.sin(s) for s in t]
        x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
        leaves = y * (y1 - y0) + x * (x1 - x0)  # of the facet from the water, at unit rate
        if leaves > 0:
            q = min(1, angle * math.hypot(x, y) / length)
            total += leaves * (x * x + y * y) * q * q * (3 - 2 * q)
    return 0.5 * RHO * COEFFICIENT * total


def half_time(a, b, rate, inertia):
    """Until the rate is half of what it was [s]."""
    t, angle, now = 0.0, 0.0, rate
    step = 0.005 / rate
    while now > 0.5 * rate:
        now -= step * moment(a, b, angle, 200) / inertia * now * now
        angle += step * now
        t += step
    return t


def member(binary, seed, elements, folder):
    """Two laws of one ellipse, and a line about them."""
    r = random.Random(seed)
    a = 10 ** r.uniform(-1, 0.5)
    b = a / r.uniform(3, 5)
    rate = r.uniform(3, 5) / math.sqrt(a / 0.5)
    mass = math.pi * a * b * RHO
    own, added = mass * (a * a + b * b) / 4, math.pi * RHO * (a * a - b * b) ** 2 / 8
    kept = rate * own / (own + added)
    expected = half_time(a, b, kept, own + added)
    wide, size = 5 * a, a / elements
    os.makedirs(folder, exist_ok=True)
    scene = os.path.join(folder, "scene.toml")
    with open(scene, "w") as f:
        f.write(f"""[time]
end = {1.4 * expected:.6g}
[gravity]
[tank]
min = [{-wide:.6g}, {-wide:.6g}]
max = [{wide:.6g}, {1.2 * wide:.6g}]
[fluid]
density = {RHO:g}
[fluid.size]
surface = {4 * size:.6g}
far = {4 * size:.6g}
growth = 0.2
[fluid.form_drag]
[[fluid.region]]
shape = "box"
min = [{-wide:.6g}, {-wide:.6g}]
max = [{wide:.6g}, {wide:.6g}]
[[body]]
name = "hull"
shape = {{type = "ellipse", semi_axes = [{a:.9g}, {b:.9g}]}}
density = {RHO:g}
position = [0, 0]
spin_deg = {math.degrees(rate):.9g}
free = ["rotation"]
size = {size:.6g}
""")
    out = os.path.join(folder, "out")
    done = subprocess.run([binary, "run", scene, "--out", out, "--threads", "1", "--quiet", "--no-report"], capture_output=True, text=True)
    if done.returncode != 0:
        return False, f"exit {done.returncode}: {done.stderr.strip()[-300:]}"
    rows = [(float(x["time"]), float(x["wz"])) for x in csv.DictReader(open(os.path.join(out, "bodies.csv")))]
    begin, first = rows[2]
    half = next((t - begin for t, w in rows if t > begin and w < 0.5 * first), math.inf)
    start, time = first / kept - 1, half / expected - 1
    return abs(start) <= 0.02 and abs(time) <= 0.15, f"a/b {a / b:.2f}, a {a:.3g} m: rate at once {100 * start:+.1f} %, time to half of it {100 * time:+.1f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--members", type=int, default=4)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--elements", type=int, default=10, help="on half of the length")
    parser.add_argument("--keep")
    options = parser.parse_args()
    folder, broken = options.keep or tempfile.mkdtemp(prefix="turns-"), 0
    for seed in range(options.first, options.first + options.members):
        holds, words = member(options.binary, seed, options.elements, os.path.join(folder, f"turns-{seed}"))
        broken += not holds
        print(f"{seed:5d} {'holds ' if holds else 'BROKEN'} {words}", flush=True)
    print(f"{options.members - broken} of {options.members} hold")
    sys.exit(broken > 0)


if __name__ == "__main__":
    main()
