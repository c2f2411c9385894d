#!/usr/bin/env python3
"""Random elastic bodies in water.

    tests/stability/elastics.py build/release/splashdown bodies --members 6
    tests/stability/elastics.py build/release/splashdown plates --members 6

bodies: they land on water, or are let go under it; shapes, stiffness, density down to a thousandth of water's. Laws: the run ends at
its end; all numbers are finite; strain, motion and what damping has taken are what the body began with and the water's work on it,
to 2 % of the largest of these, wherever two steps are equal; with modes as coordinates passes do not exceed two in the mean.

plates: held at their ends, clamped or simply supported, as the bottom of a column of water or afloat on deep water; they are let go
with a velocity. Law: the lowest frequency is that of the plate with the added mass of its lowest dry mode, to 2 %.
"""
import csv
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


def works(fluid, first):
    """The water's work on walls after each whole kick, W_{n+1/2}. Tables have it at t_n, where a part dt_{n-1}/2 of the kick
    (dt_{n-1} + dt_n)/2 is done. That of the first kick they do not have."""
    dt, told, after = [row["dt"] for row in fluid], [row["work_on_walls"] for row in fluid], [first]
    for n in range(1, len(fluid) - 1):
        after.append(after[-1] + (told[n] - after[-1]) * (dt[n - 1] + dt[n]) / dt[n - 1])
    return after


def bodies(binary, seed, options, folder):
    """bodies: ends, energy of the body by the water's work, no NaN, few passes"""
    text, density, stiffness, modal = scene(random.Random(seed))
    out = members.run(binary, text, folder)
    solid, fluid = rows_of(out, "elastic.csv"), rows_of(out, "fluid.csv")
    finite = all(math.isfinite(v) for row in solid for v in row.values())
    # Strain, motion and damping are those of t_{n-1/2}, places those of t_n.
    weight = [row["potential_energy"] for row in solid]
    own = [row["strain_energy"] + row["kinetic_energy"] + 0.5 * (weight[n] + weight[max(n - 1, 0)]) for n, row in enumerate(solid)]
    taken = [row["dissipated_energy"] for row in solid]
    work = works(fluid, own[1] + taken[1] - own[0])
    kept = [e + d - w for e, d, w in zip(own[1:], taken[1:], work)]
    largest = max(max(abs(v) for v in values) for values in (own, work, weight))
    # Where steps change their length, energies between them are not comparable: strain is that of their middles.
    level = [kept[n] for n in range(1, len(kept)) if fluid[n]["dt"] == fluid[n - 1]["dt"]]
    gained, lost = max(v - level[0] for v in level), max(level[0] - v for v in level)
    with open(os.path.join(out, "summary.json")) as f:
        passes = json.load(f)["coupling"]["passes_mean"]
    words = (f"density {density:.2g}, stiffness {stiffness:.1e}, {'modes' if modal else 'nodes'}: energy +{100 * gained / largest:.2f} "
             f"-{100 * lost / largest:.2f} %, damped {100 * taken[-1] / largest:.2f} %, {passes:.2f} passes")
    return finite and max(gained, lost) <= 0.02 * largest and (not modal or passes <= 2), words


class Plate:
    """Of a length and a thickness [m], held at both ends, with its lowest dry mode."""

    def __init__(self, rng):
        self.clamped, self.bottom = rng.random() < 0.5, rng.random() < 0.5
        self.length = 10 ** rng.uniform(-1, 0.5)
        self.thickness = self.length / rng.uniform(35, 100)
        self.modulus, self.ratio = 10 ** rng.uniform(9, 11.5), rng.uniform(0, 0.4)
        self.depth = self.length * rng.uniform(0.3, 1.5)  # of the column on it
        self.draft = self.length * rng.uniform(0.005, 0.01)  # of the one afloat, which weighs what it displaces
        self.density = 10 ** rng.uniform(2, 4) if self.bottom else WATER * self.draft / self.thickness

    def shape(self, x):
        """Deflection at x from 0 to 1, over that of the middle."""
        if not self.clamped:
            return math.sin(math.pi * x)
        beta = 4.730041  # cosh b cos b = 1
        slope = (math.cosh(beta) - math.cos(beta)) / (math.sinh(beta) - math.sin(beta))
        bend = [math.cosh(beta * y) - math.cos(beta * y) - slope * (math.sinh(beta * y) - math.sin(beta * y)) for y in (x, 0.5)]
        return bend[0] / bend[1]

    def added_mass(self):
        """Of the mode, 1 in the middle: phi = 0 on the water's surface; per depth. Afloat: integral equation of a strip with one
        side wet. Column: a sum over cosines across it."""
        if not self.bottom:
            return (0.646412 if self.clamped else 0.854631) * WATER * (self.length / 2) ** 2
        n, terms = 1000, 100
        values = [self.shape((i + 0.5) / n) for i in range(n)]
        total = self.depth * self.length * (sum(values) / n) ** 2
        for m in range(2, 2 * terms, 2):
            k, c = m * math.pi / self.length, 2 / n * sum(v * math.cos(m * math.pi * (i + 0.5) / n) for i, v in enumerate(values))
            total += c * c * self.length / 2 * math.tanh(k * self.depth) / k
        return WATER * total

    def frequency(self):
        """Angular, in water [rad/s]."""
        stiffness = self.modulus * self.thickness**3 / (12 * (1 - self.ratio**2))
        beta, share = (4.730041, 0.396478) if self.clamped else (math.pi, 0.5)  # share: of int shape^2 in the length
        mass = self.density * self.thickness * share * self.length + self.added_mass()
        return math.sqrt(stiffness * (beta / self.length) ** 4 * share * self.length / mass)

    def scene(self):
        """Forty steps a period, two and a half periods; gravity so weak that it presses the water on and bends nothing."""
        L, h, w = self.length, self.thickness, self.frequency()
        sides = L / 2 if self.bottom else 10 * L
        floor, level = (-h, self.depth) if self.bottom else (-10 * L, 0.0)
        ends = ""
        for x in (-L / 2, L / 2):
            place = f"min = [{x - 1e-6 * L}, {-h}]\nmax = [{x + 1e-6 * L}, {h}]" if self.clamped else f"centre = [{x}, 0.0]\nradius = {0.1 * h}"
            ends += f"[[body.elastic.clamp]]\n{place}\n"
        size = L / 30 if self.bottom else L / 80
        return f"""
dimension = 2
[time]
end = {2.5 * 2 * math.pi / w}
dt_max = {2 * math.pi / w / 40}
[gravity]
acceleration = [0.0, {-(1e-6 if self.bottom else 1e-5) * w * w * L}]
[tank]
min = [{-sides}, {floor}]
max = [{sides}, {level + L}]
[fluid]
density = {WATER}
[fluid.size]
surface = {L / 15 if self.bottom else L / 2}
far = {L / 15 if self.bottom else 2 * L}
growth = 0.2
[[fluid.region]]
shape = "box"
min = [{-sides}, {0.0 if self.bottom else floor}]
max = [{sides}, {level}]
[[body]]
name = "plate"
shape = {{type = "box", width = {L}, height = {h}}}
position = [0.0, {-h / 2 if self.bottom else h / 2 - self.draft}]
velocity = [0.0, {-1e-8 * L * w}]
density = {self.density}
size = {size}
[body.elastic]
young_modulus = {self.modulus}
poisson_ratio = {self.ratio}
size = {h}
coordinates = "modes"
modes = 6
{ends}[[body.elastic.point]]
name = "middle"
point = [0.0, 0.0]
"""


def misfit(w, times, values):
    """Of a sin wt + b cos wt + c fitted to the values, squared, over theirs."""
    rows = [(math.sin(w * t), math.cos(w * t), 1.0, v) for t, v in zip(times, values)]
    m = [[sum(r[i] * r[j] for r in rows) for j in range(4)] for i in range(3)]
    for i in range(3):
        for k in range(i + 1, 3):
            m[k] = [a - m[k][i] / m[i][i] * b for a, b in zip(m[k], m[i])]
    x = [0.0] * 3
    for i in (2, 1, 0):
        x[i] = (m[i][3] - sum(m[i][j] * x[j] for j in range(i + 1, 3))) / m[i][i]
    return sum((r[3] - sum(x[i] * r[i] for i in range(3))) ** 2 for r in rows) / sum(v * v for v in values)


def plates(binary, seed, options, folder):
    """plates: the lowest frequency in water is that of the plate and the water that moves with it, 2 %"""
    plate = Plate(random.Random(seed))
    out, w = members.run(binary, plate.scene(), folder), plate.frequency()
    with open(os.path.join(out, "probes.csv")) as f:
        rows = [row for row in csv.DictReader(f) if row["probe"] == "middle.uy"]
    times, values = [float(row["time"]) for row in rows], [float(row["value"]) for row in rows]
    found = min((misfit(w * k / 1000, times, values), k / 1000) for k in range(850, 1151))
    words = (f"{'clamped' if plate.clamped else 'supported'}, {'bottom' if plate.bottom else 'afloat'}, 1/{plate.length / plate.thickness:.0f} thick, "
             f"density {plate.density:.0f}: {100 * (found[1] - 1):+.1f} % of the frequency, misfit {found[0]:.1g}")
    return abs(found[1] - 1) <= 0.02 and found[0] < 0.02, words


if __name__ == "__main__":
    members.try_members(members.arguments(__doc__, [bodies, plates]).parse_args(), [bodies, plates])
