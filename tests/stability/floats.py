#!/usr/bin/env python3
"""Random small bodies that float in small waves, in the plane, against linear theory.

    floats.py BINARY heave|free|sharp [--members 4] [--first SEED] [--elements 40] [--keep DIR]

heave  half-immersed circles and boxes with bilges, free in heave alone: their height over that of the waves
free   the same with all freedoms: heave, surge and pitch
sharp  boxes with sharp edges, free in heave alone. The flow separates there, in the program too, and its drag grows with the square of
       the speed: linear theory has none of it. Waves of two heights, 0.01 and 0.0025 of their length, tell the drag from the rest.

Waves are 0.01 of their length high, bodies 0.05 to 0.3 of it wide, depths from 0.12 of it to deep water. What is left of the start has died out
before the motions are read: members that ring for longer than 30 periods are drawn again, and those that pitch by more than 0.1. One line a member. Exit code 1 if a member breaks a law.
Standard library only.

The theory: floating_section.py."""
import csv
import math
import os
import random

from floating_section import HEAVE, ROLL, SWAY, Coefficients, about, box, circle, response, solved
from linear_waves import G
from members import arguments, run, try_members

DENSITY = 1000.0
STEEPNESS = 0.01
READ = 4  # periods


class Float:
    """A body, its waves and what linear theory says of them, for a metre of breadth."""

    def __init__(self, seed, freedoms, kinds):
        r = random.Random(seed)
        self.freedoms = freedoms
        self.draw(r, kinds)
        while 2 * self.draft > self.depth or self.ringing() > 30 or not self.is_small():
            self.draw(r, kinds)
        self.periods = self.ringing()

    def draw(self, r, kinds):
        """One try."""
        self.length = 10 ** r.uniform(-0.5, 1.5)
        self.depth = self.length * r.choice([r.uniform(0.12, 0.3), r.uniform(0.3, 0.8)])
        self.kind = r.choice(kinds)
        self.breadth = self.length * r.uniform(0.05, 0.3)
        self.draft = self.breadth * (0.5 if self.kind == "circle" else r.uniform(0.2, 1))
        self.bilge = min(0.5 * self.breadth, self.draft) * (r.uniform(0.3, 0.6) if self.kind == "round box" else 0)
        self.freeboard = self.draft if self.kind == "circle" else max(0.4 * self.draft, 0.03 * self.length)
        k = 2 * math.pi / self.length
        self.omega = math.sqrt(G * k * math.tanh(k * self.depth))
        area, moment = self.immersed()
        self.mass = DENSITY * area
        metacentre = moment / area + self.breadth ** 3 / 12 / area
        self.weight = metacentre - r.uniform(0.05, 0.3) * self.breadth  # height of the centre of mass
        self.inertia = self.mass * (self.breadth * r.uniform(0.25, 0.4)) ** 2
        self.stiffness = (0.0, DENSITY * G * self.breadth, self.mass * G * (metacentre - self.weight))

    def hull(self, panels):
        """Half of what is wet at rest, from the keel to the waterline."""
        return circle(self.draft, panels) if self.kind == "circle" else box(self.breadth, self.draft, panels, self.bilge)

    def immersed(self):
        """Area at rest and its moment about the waterline."""
        half = self.hull(200)
        return (sum((b[1] - a[1]) * (a[0] + b[0]) for a, b in zip(half, half[1:])),
                sum((b[1] - a[1]) * (a[0] * (2 * a[1] + b[1]) + b[0] * (a[1] + 2 * b[1])) / 3 for a, b in zip(half, half[1:])))

    def section(self, omega, modes):
        """Coefficients about the centre of mass."""
        return about(Coefficients(self.hull(30), self.depth, omega, modes, DENSITY, surface=50, line=32), self.weight)

    def shape(self):
        """The text of the whole hull; its origin is at the waterline."""
        if self.kind == "circle":
            return f'type = "circle", radius = {self.draft:.9g}'
        wet = [p for p in box(self.breadth, self.draft, 30, self.bilge) if p[0] >= 0.5 * self.breadth - self.bilge and p[1] <= self.bilge - self.draft]
        right = wet + [(0.5 * self.breadth, self.freeboard)]
        return 'type = "polygon", points = [' + ", ".join(f"[{x:.9g}, {y:.9g}]" for x, y in right + [(-x, y) for x, y in reversed(right)]) + "]"

    def scene(self, height, elements):
        """The text of the scene: at t = 0 a crest is in the middle, and the body moves with it."""
        names = {SWAY: "x", HEAVE: "y", ROLL: "rotation"}
        half, a = 2.5 * self.length + 0.5 * self.breadth, 0.5 * height
        along = self.omega * a / math.tanh(2 * math.pi * self.depth / self.length) if SWAY in self.freedoms else 0.0
        return f"""[time]
end = {self.periods * 2 * math.pi / self.omega:.9g}
[gravity]
[tank]
min = [{-half:.9g}, {-self.depth:.9g}]
max = [{half:.9g}, {self.freeboard + 0.1 * self.length:.9g}]
[fluid]
density = {DENSITY:.9g}
[fluid.size]
surface = {self.length / elements:.6g}
far = {self.length / 10:.6g}
[[fluid.region]]
shape = "box"
min = [{-half:.9g}, {-self.depth:.9g}]
max = [{half:.9g}, 0]
[waves]
type = "regular"
height = {height:.9g}
length = {self.length:.9g}
[[body]]
name = "float"
shape = {{{self.shape()}}}
mass = {self.mass:.9g}
inertia = {self.inertia:.9g}
centre_of_mass = [0, {self.weight:.9g}]
position = [0, {a:.9g}]
velocity = [{along:.9g}, 0]
free = [{", ".join(f'"{names[m]}"' for m in self.freedoms)}]
size = {min(self.length / elements, self.breadth / 16):.6g}
"""

    def ringing(self):
        """Until a hundredth of the first swing is left, and those that are read."""
        rings = []
        for m in self.freedoms:
            if m == SWAY:
                continue
            own = self.omega
            for _ in range(4):
                c = self.section(own, (m,) if m == HEAVE else (SWAY, ROLL))
                total = (self.mass if m == HEAVE else self.inertia) + c.added_mass[m][m]
                own = math.sqrt(self.stiffness[m] / total)
            rings.append(math.log(100) * 2 * total / max(c.damping[m][m], 1e-12) * self.omega / (2 * math.pi))
        return math.ceil(4 + max(rings)) + READ

    def is_small(self):
        """Whether it pitches by less than 0.1."""
        return ROLL not in self.freedoms or self.theory()[ROLL] * 0.5 * STEEPNESS * self.length < 0.1

    def theory(self):
        """Amplitudes over that of the waves: sway, heave, roll."""
        return {m: abs(x) for m, x in response(self.section(self.omega, self.freedoms), self.mass, self.inertia, self.stiffness, self.freedoms).items()}


def amplitude(signal, omega):
    """Of the part at `omega`, by least squares beside a mean, a slope and its double."""
    middle = 0.5 * (signal[0][0] + signal[-1][0])
    columns = [lambda t: 1.0, lambda t: t - middle]
    for w in (omega, 2 * omega):
        columns += [lambda t, w=w: math.cos(w * t), lambda t, w=w: math.sin(w * t)]
    rows = [([c(t) for c in columns], y) for t, y in signal]
    n = len(columns)
    normal = [[sum(r[i] * r[j] for r, _ in rows) for j in range(n)] for i in range(n)]
    x = solved(normal, [[sum(r[i] * y for r, y in rows) for i in range(n)]])[0]
    return math.hypot(x[2].real, x[3].real)


def motions(binary, text, folder):
    """Rows of bodies.csv as (time, x, y, angle)."""
    with open(os.path.join(run(binary, text, folder), "bodies.csv")) as rows:
        return [(float(q["time"]), float(q["x"]), float(q["y"]), 2 * math.atan2(float(q["qz"]), float(q["qw"]))) for q in csv.DictReader(rows)]


def measured(binary, body, steepness, options, folder):
    """Amplitudes over that of the waves: sway, heave, roll."""
    rows = motions(binary, body.scene(steepness * body.length, options.elements), folder)
    start = rows[-1][0] - READ * 2 * math.pi / body.omega
    return {m: amplitude([(q[0], q[1 + m]) for q in rows if q[0] >= start], body.omega) / (0.5 * steepness * body.length) for m in body.freedoms}


def words_of(body):
    """The member."""
    return f"{body.kind:9s} {body.breadth / body.length:.3f} L wide, draft {body.draft / body.breadth:.2f} of it, kd {2 * math.pi * body.depth / body.length:.2f}, {body.periods} periods: "


def heave(binary, seed, options, folder):
    """Heave within 5 %."""
    body = Float(seed, (HEAVE,), ("circle", "round box"))
    linear, found = body.theory(), measured(binary, body, STEEPNESS, options, folder)
    miss = found[HEAVE] / linear[HEAVE] - 1
    return abs(miss) <= 0.05, words_of(body) + f"heave {linear[HEAVE]:.3f}, found {100 * miss:+.1f} %"


def free(binary, seed, options, folder):
    """Heave within 5 %; surge and pitch are told, pitch over the slope of the waves."""
    body = Float(seed, (SWAY, HEAVE, ROLL), ("circle", "round box"))
    linear, found = body.theory(), measured(binary, body, STEEPNESS, options, folder)
    scale = {SWAY: 1.0, HEAVE: 1.0, ROLL: body.length / (2 * math.pi)}
    told = [f"{name} {scale[m] * linear[m]:.3f}, found {100 * (found[m] / linear[m] - 1):+.1f} %" for m, name in ((HEAVE, "heave"), (SWAY, "surge"), (ROLL, "pitch"))]
    return abs(found[HEAVE] / linear[HEAVE] - 1) <= 0.05, words_of(body) + "; ".join(told)


def without_drag(body, amplitudes, heights):
    """Ratio of measured to linear heave if the drag of the edges, 1/2 rho C B v^2 in the mean over a period, is taken off, and C.

    Two amplitudes over that of the waves, in waves of two heights: C, from 0 to 10, is what makes the ratio the same in both."""
    c = body.section(body.omega, (HEAVE,))

    def ratio(drag, found, height):
        extra = 4 / (3 * math.pi) * DENSITY * drag * body.breadth * body.omega * found * 0.5 * height
        left = body.stiffness[HEAVE] - body.omega ** 2 * (body.mass + c.added_mass[HEAVE][HEAVE]) - 1j * body.omega * (c.damping[HEAVE][HEAVE] + extra)
        return found * abs(left) / abs(c.force[HEAVE])

    low, high = 0.0, 10.0
    for _ in range(60):
        drag = 0.5 * (low + high)
        (r0, r1) = (ratio(drag, x, h) for x, h in zip(amplitudes, heights))
        low, high = (drag, high) if r0 < r1 else (low, drag)
    return r1, drag


def sharp(binary, seed, options, folder):
    """Heave without the drag of the edges within 5 %."""
    body = Float(seed, (HEAVE,), ("box",))
    linear, heights = body.theory()[HEAVE], [s * STEEPNESS * body.length for s in (1, 0.25)]
    found = [measured(binary, body, h / body.length, options, f"{folder}-{i}")[HEAVE] for i, h in enumerate(heights)]
    rest, drag = without_drag(body, found, heights)
    return abs(rest - 1) <= 0.05, (words_of(body) + f"heave {linear:.3f}, found {100 * (found[0] / linear - 1):+.1f} %, in waves of a quarter {100 * (found[1] / linear - 1):+.1f} %; "
                                   f"without the drag of its edges {100 * (rest - 1):+.1f} %, its coefficient {drag:.1f}")


if __name__ == "__main__":
    LAWS = (heave, free, sharp)
    try_members(arguments(__doc__, LAWS).parse_args(), LAWS)
