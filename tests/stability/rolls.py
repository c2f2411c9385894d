#!/usr/bin/env python3
"""Random boxes with sharp edges that roll on still water, in the plane, against published damping.

    rolls.py BINARY decay [--members 6] [--first SEED] [--elements 10] [--set ARGUMENT]... [--keep DIR]

A box that can only roll, about its centre of mass, is let go at 12 to 16 degrees. Linear theory (floating_section.py) has its added inertia and the damping
by waves B_W. Eddies off its edges add, for a metre of breadth (Ikeda, Fujiwara and Katayama, Roll damping of a sharp-cornered barge, Proc. 3rd ISOPE, 1993),

    B_E = 2/pi rho d^4 (H^2 + 1 - s) (H^2 + (1 - s)^2) phi omega,   H = breadth/2d,   s = depth of the axis over the draft d,

at the amplitude phi. From the second turn on, when there are eddies, the amplitude should fall by pi (B_W + B_E)/(2 I omega), logarithmic, from turn to turn:
to a quarter, within 15 % of that. One line a member. Exit code 1 if a member breaks the law. Standard library only."""
import csv
import math
import os
import random

from floating_section import ROLL, SWAY, Coefficients, about, box
from linear_waves import G, wave_number
from members import arguments, run, try_members

DENSITY = 1000.0


class Barge:
    """A box, for a metre of breadth: wide enough to come back, and with an inertia that a real one might have."""

    def __init__(self, seed):
        r = random.Random(seed)
        self.draft = 10 ** r.uniform(-1.5, 0.5)
        self.inertia = self.breadth = 0.0
        while not self.is_real():
            self.breadth = self.draft * r.uniform(4, 7)
            self.axis = -r.uniform(-0.3, 0.3) * self.draft  # height of the centre of mass over still water
            self.omega = r.uniform(0.6, 0.95) * math.sqrt(2 * G / self.breadth)
            self.depth = max(4 * self.draft, math.pi * G / self.omega ** 2)
            c = about(Coefficients(box(self.breadth, self.draft), self.depth, self.omega, (SWAY, ROLL), DENSITY), self.axis)
            self.stiffness = DENSITY * G * (self.breadth ** 3 / 12 - self.breadth * self.draft * (self.axis + 0.5 * self.draft))
            self.inertia = self.stiffness / self.omega ** 2 - c.added_mass[ROLL][ROLL]
            self.waves = c.damping[ROLL][ROLL]
        self.angle = math.radians(r.uniform(12, 16))

    def mass(self):
        return DENSITY * self.breadth * self.draft

    def is_real(self):
        """Whether masses within the box could have its inertia."""
        return 0.04 < self.inertia / max(self.mass() * self.breadth ** 2, 1e-300) < 0.3

    def falls(self, angle):
        """By how much the logarithm of the amplitude falls until the next turn, `angle` the mean of both."""
        h, s = 0.5 * self.breadth / self.draft, -self.axis / self.draft
        eddies = 2 / math.pi * DENSITY * self.draft ** 4 * (h * h + 1 - s) * (h * h + (1 - s) ** 2) * angle * self.omega
        return math.pi * (self.waves + eddies) * self.omega / (2 * self.stiffness)

    def next(self, angle):
        """The amplitude at the next turn."""
        after = angle
        for _ in range(50):
            after = angle * math.exp(-self.falls(0.5 * (angle + after)))
        return after

    def scene(self, elements):
        half, high = max(4 * self.breadth, 1.5 * math.tau / wave_number(self.omega, self.depth)), max(self.draft, 0.2 * self.breadth)
        size = self.draft / elements
        return f"""[time]
end = {7 * math.tau / self.omega:.9g}
[gravity]
[tank]
min = [{-half:.9g}, {-self.depth:.9g}]
max = [{half:.9g}, {2 * high:.9g}]
[fluid]
density = {DENSITY:g}
[fluid.absorber]
ends = "both"
width = {half - 1.5 * self.breadth:.9g}
rate = {self.omega:.9g}
[fluid.size]
surface = {2.5 * size:.6g}
far = {8 * size:.6g}
growth = 0.25
[fluid.form_drag]
[[fluid.region]]
shape = "box"
min = [{-half:.9g}, {-self.depth:.9g}]
max = [{half:.9g}, 0]
[[body]]
name = "barge"
shape = {{type = "box", width = {self.breadth:.9g}, height = {2 * high:.9g}}}
mass = {self.mass():.9g}
inertia = {self.inertia:.9g}
centre_of_mass = [0, {self.axis + self.draft - high:.9g}]
position = [0, {self.axis:.9g}]
pitch_deg = {math.degrees(self.angle):.9g}
free = ["rotation"]
size = {size:.6g}
"""


def turns(out, period):
    """Amplitudes at the turns, the start among them [rad]."""
    rows = [(float(row["time"]), math.radians(float(row["pitch_deg"]))) for row in csv.DictReader(open(os.path.join(out, "bodies.csv")))]
    found = [(0.0, abs(rows[0][1]))]
    for (_, a), (t, b), (_, c) in zip(rows, rows[1:], rows[2:]):
        if (b - a) * (c - b) <= 0 and t - found[-1][0] > 0.3 * period:
            found.append((t, abs(b)))
    return [angle for _, angle in found]


def decay(binary, seed, options, folder):
    """Boxes that roll: the fall of their amplitude from the second turn on, until it should be a quarter; bar 15 %"""
    barge = Barge(seed)
    angles = turns(run(binary, barge.scene(options.elements), folder, options.set), math.tau / barge.omega)
    expected = [angles[1]]
    while expected[-1] > 0.25 * angles[1] and len(expected) + 1 < len(angles):
        expected.append(barge.next(expected[-1]))
    last = len(expected)
    off = math.log(angles[1] / angles[last]) / math.log(angles[1] / expected[-1]) - 1
    return abs(off) <= 0.15, (f"breadth/draft {barge.breadth / barge.draft:.2f}, axis {barge.axis / barge.draft:+.2f} drafts over still water: "
                              f"{math.degrees(angles[1]):.2f} to {math.degrees(angles[last]):.2f} deg in {last - 1} half periods, "
                              f"expected {math.degrees(expected[-1]):.2f}; fall {100 * off:+.1f} %")


def main():
    parser = arguments(__doc__, [decay])
    parser.set_defaults(elements=10, members=6)
    parser.add_argument("--set", action="append", default=[], help="of the scene, e.g. fluid.form_drag=")
    try_members(parser.parse_args(), [decay])


if __name__ == "__main__":
    main()
