#!/usr/bin/env python3
"""Random seas in the plane, and what their theories say of the runs.

    seas.py BINARY regular|paddle|hinged|spectrum|irregular|zones|touchdown [--members 4] [--first SEED] [--elements 40] [--periods N] [--keep DIR]

regular    [waves] of any depth and steepness: over the second half of the run the wave has the length, the height and the level of the
           stream function
paddle     [wavemaker], piston or flap, in a flume with a beach: the height of linear wavemaker theory, nothing behind the paddle
hinged     the same with flaps whose hinge is above the floor
spectrum   an irregular sea of a piston or a flap: height and peak period of what theory sees at the same gauge, with the same ramp
irregular  JONSWAP and Pierson-Moskowitz: significant height and peak period of what was asked for, in the middle of the tank
zones      a box heaves in the middle of a sea that is almost calm: what the zones throw back of its waves, half to twice as long as theirs
touchdown  [waves.touchdown]: where on the wave a falling body touches the water first

One line a member. Exit code 1 if a member breaks a law. Standard library only.

Waves that run either way are told apart by their phases at all gauges, by least squares (Mansard and Funke 1980)."""
import cmath
import csv
import json
import math
import os
import random
from collections import defaultdict

from linear_waves import G, group_speed, wave_number
from members import arguments, run, try_members

def tank(low, high, depth, top, face=None):
    """The text of gravity, tank and water; its region begins at `face`."""
    return f"""[gravity]
[tank]
min = [{low:.9g}, {-depth:.9g}]
max = [{high:.9g}, {top:.9g}]
[fluid]
density = 1000
[[fluid.region]]
shape = "box"
min = [{low if face is None else face:.9g}, {-depth:.9g}]
max = [{high:.9g}, 0]
"""


def gauges(places):
    """Records of the surface at these x, g0, g1 ..."""
    return "".join(f'[[record]]\nkind = "surface_elevation"\nname = "g{i}"\nx = {x:.9g}\n' for i, x in enumerate(places))


def tables(binary, text, folder):
    """Signals by gauge as lists of (time, value), summary, rows of fluid.csv."""
    out = run(binary, text, folder)
    signals = defaultdict(list)
    with open(os.path.join(out, "probes.csv")) as rows:
        for row in csv.DictReader(rows):
            signals[row["probe"]].append((float(row["time"]), float(row["value"])))
    with open(os.path.join(out, "summary.json")) as summary, open(os.path.join(out, "fluid.csv")) as rows:
        return signals, json.load(summary), list(csv.DictReader(rows))


def at_time(signal, t):
    """The signal at `t`, between its neighbours."""
    for (t0, y0), (t1, y1) in zip(signal, signal[1:]):
        if t0 <= t <= t1:
            return y0 + (y1 - y0) * (t - t0) / (t1 - t0)
    return signal[-1][1]


def between(signal, start, end):
    """The signal from `start` to `end`, both interpolated."""
    out = []
    for (t0, y0), (t1, y1) in zip(signal, signal[1:]):
        for edge in (start, end):
            if t0 < edge <= t1:
                out.append((edge, y0 + (y1 - y0) * (edge - t0) / (t1 - t0)))
        if start < t1 < end:
            out.append((t1, y1))
    return sorted(set(out))


def mean(signal, of=lambda t, y: y):
    """Over time, by trapezoids."""
    total = sum(0.5 * (of(*a) + of(*b)) * (b[0] - a[0]) for a, b in zip(signal, signal[1:]))
    return total / (signal[-1][0] - signal[0][0])


def fundamental(signal, omega):
    """Complex amplitude A of Re(A exp(-i omega t)), over whole periods."""
    return 2 * mean(signal, lambda t, y: y * cmath.exp(1j * omega * t))


def two_ways(amplitudes, places, k):
    """Waves along and against x at x = 0 that fit the gauges best."""
    s = [[0j, 0j], [0j, 0j]]
    r = [0j, 0j]
    for a, x in zip(amplitudes, places):
        row = (cmath.exp(1j * k * x), cmath.exp(-1j * k * x))
        for i in range(2):
            r[i] += row[i].conjugate() * a
            for j in range(2):
                s[i][j] += row[i].conjugate() * row[j]
    det = s[0][0] * s[1][1] - s[0][1] * s[1][0]
    return (r[0] * s[1][1] - r[1] * s[0][1]) / det, (s[0][0] * r[1] - s[1][0] * r[0]) / det


def regular(binary, seed, options, folder):
    """Phase speed within 0.2 %, height within 1.5 % (0.7 % with 80 elements), level within 0.005 H, volume within 1e-8."""
    r = random.Random(seed)
    length, kd = 10 ** r.uniform(-0.5, 1.5), r.choice([r.uniform(0.7, 1.5), r.uniform(1.5, 6)])
    depth = kd * length / (2 * math.pi)
    steep = min(10 ** r.uniform(-2, -1), 0.8 * 0.142 * math.tanh(kd))
    height, omega = steep * length, math.sqrt(G * 2 * math.pi / length * math.tanh(kd))
    periods = options.periods or r.randint(10, 40)
    places = [length * x for x in (-0.75, -0.4, -0.05, 0.3, 0.65)]
    text = f"""[time]
end = {periods * 2 * math.pi / omega:.9g}
[waves]
type = "regular"
height = {height:.9g}
length = {length:.9g}
""" + tank(-2.5 * length, 2.5 * length, depth, 2.5 * height + 0.05 * length) + f"[fluid.size]\nsurface = {length / options.elements:.6g}\nfar = {length / 10:.6g}\n" + gauges(places)
    signals, _, rows = tables(binary, text, folder)
    end = signals["g0"][-1][0]
    period = period_of(signals["g2.undisturbed"])
    omega = 2 * math.pi / period
    start = end - period * max(4, periods // 2)
    ratios, shifts, crests, troughs, levels = [], [], [], [], []
    for i in range(len(places)):
        seen, sea = (between(signals[n], start, end) for n in (f"g{i}", f"g{i}.undisturbed"))
        ratio = fundamental(seen, omega) / fundamental(sea, omega)
        ratios.append(abs(ratio))
        shifts.append(cmath.phase(ratio))
        levels.append((mean(seen) - mean(sea)) / height)
        first = [between(signals[n], 0.6 * period, 1.7 * period) for n in (f"g{i}", f"g{i}.undisturbed")]
        crests.append((max(y for _, y in first[0]) - max(y for _, y in first[1])) / height)
        troughs.append((min(y for _, y in first[0]) - min(y for _, y in first[1])) / height)
    middle = sum(places) / len(places)
    slope = sum((x - middle) * s for x, s in zip(places, shifts)) / sum((x - middle) ** 2 for x in places)
    speed = -slope * length / (2 * math.pi)
    volume = max(abs(float(x["volume"]) + float(x["volume_spray"]) - float(rows[0]["volume"])) for x in rows) / float(rows[0]["volume"])
    amplitude = sum(ratios) / len(ratios) - 1
    level = sum(levels) / len(levels)
    worst = max(crests + troughs, key=abs)
    laws = [abs(speed) <= 0.002, abs(amplitude) <= (0.007 if options.elements >= 80 else 0.015), abs(level) <= 0.005, volume <= 1e-8, abs(worst) <= 0.01]
    return all(laws), (f"H/L {steep:.3f} kd {kd:4.2f} {periods:2d} periods: speed {100 * speed:+.2f} %, height {100 * amplitude:+.2f} % "
                       f"({100 * (min(ratios) - 1):+.1f} to {100 * (max(ratios) - 1):+.1f}), level {100 * level:+.2f} % of H, volume {volume:.0e}, "
                       f"first crest or trough {100 * worst:+.2f} % of H")


def period_of(signal):
    """Mean distance of upward crossings."""
    middle = mean(signal)
    ups = [t0 + (t1 - t0) * (middle - y0) / (y1 - y0) for (t0, y0), (t1, y1) in zip(signal, signal[1:]) if y0 < middle <= y1]
    return (ups[-1] - ups[0]) / (len(ups) - 1)


def paddle(binary, seed, options, folder, hinged=False):
    """Height within 3 % of the theory; no water behind the paddle; volume within 1e-8."""
    r = random.Random(seed)
    depth, kd = 10 ** r.uniform(-0.7, 0.6), r.uniform(0.6, 3.5)
    kind, end = r.choice(["piston", "flap"]), r.choice(["lower", "upper"])
    hinge = r.uniform(0.1, 0.6) * depth if hinged else 0
    kind = "flap" if hinged else kind
    k = kd / depth
    length, omega = 2 * math.pi / k, math.sqrt(G * k * math.tanh(kd))
    period, height = 2 * math.pi / omega, length * min(10 ** r.uniform(-2, -1.3), 0.5 * 0.142 * math.tanh(kd))
    speed = group_speed(omega, k, depth)
    back, far = 1.0 * length + depth, 7 * length
    sign = 1 if end == "lower" else -1
    places = [length * x for x in (2.5, 2.8, 3.1, 3.4, 3.7)]
    seen = 5 * period
    last = 2 * period + places[-1] / speed + 2 * period + seen
    low, high = (-back, far) if sign > 0 else (-far, back)
    text = f"""[time]
end = {last:.9g}
[wavemaker]
type = "{kind}"
end = "{end}"
height = {height:.9g}
period = {period:.9g}
{f"hinge = {hinge:.9g}" if hinged else ""}
""" + tank(low, high, depth, 2.5 * height + 0.05 * length, 0 if sign > 0 else None).replace(f"max = [{high:.9g}, 0]", "max = [0, 0]" if sign < 0 else f"max = [{high:.9g}, 0]")
    text += f"""[fluid.absorber]
ends = "{'upper' if sign > 0 else 'lower'}"
width = {2.5 * length:.6g}
rate = {omega:.6g}
[fluid.size]
surface = {length / options.elements:.6g}
far = {length / 10:.6g}
""" + gauges([sign * x for x in places])
    signals, summary, rows = tables(binary, text, folder)
    stop = signals["g0"][-1][0]
    amplitudes = [fundamental(between(signals[f"g{i}"], stop - seen, stop), omega) for i in range(len(places))]
    out, back_wave = two_ways(amplitudes, places, k)
    ratio, echo = 2 * abs(out) / height - 1, abs(back_wave) / abs(out)
    volume = max(abs(float(x["volume"]) + float(x["volume_spray"]) - float(rows[0]["volume"])) for x in rows) / float(rows[0]["volume"])
    spray = max(float(x["volume_spray"]) for x in rows) / float(rows[0]["volume"])
    gone = max(abs(float(rows[-1]["volume_remesh_deleted"])), float(rows[-1]["volume_remesh_created"])) / float(rows[0]["volume"])
    return abs(ratio) <= 0.03 and volume <= 1e-8 and spray <= 1e-4, (f"{kind:6s} {end} {f'hinge {hinge / depth:.2f} d ' if hinged else ''}H/L {height / length:.3f} kd {kd:4.2f}: height {100 * ratio:+.2f} % of the theory, "
                                                   f"echo {100 * echo:.1f} %, volume {volume:.0e}, remeshed {gone:.0e}, spray {spray:.0e}")


def hinged(binary, seed, options, folder):
    """Height within 3 % of the theory; no water behind the paddle; volume within 1e-8."""
    return paddle(binary, seed, options, folder, hinged=True)


def spectrum(binary, seed, options, folder):
    """Significant height and peak period within 3 % of the sea that theory has there."""
    r = random.Random(seed)
    peak, gamma = 10 ** r.uniform(-0.2, 0.9), r.choice([1, 3.3, 5])
    omega, kind = 2 * math.pi / peak, r.choice(["piston", "flap"])
    depth = G * peak * peak / (2 * math.pi) * r.uniform(0.15, 0.5)
    k = wave_number(omega, depth)
    length, speed = 2 * math.pi / k, group_speed(omega, k, depth)
    height = length * r.uniform(0.005, 0.02)
    repeat = options.periods or 40
    place = 2 * length
    begin = 2 * peak + 3 * place / speed  # the slow ones are there, too
    text = f"""[time]
end = {begin + repeat * peak:.9g}
[wavemaker]
type = "{kind}"
significant_height = {height:.9g}
peak_period = {peak:.9g}
gamma = {gamma}
repeat = {repeat}
seed = {seed}
""" + tank(-length, 5 * length, depth, 3 * height + 0.05 * length, 0)
    text += f"""[fluid.absorber]
ends = "upper"
width = {2.5 * length:.6g}
rate = {omega:.6g}
[fluid.size]
surface = {length / options.elements:.6g}
far = {length / 8:.6g}
""" + gauges([place])
    signals, _, _ = tables(binary, text, folder)
    stop = signals["g0"][-1][0]
    numbers = []
    for name in ("g0", "g0.undisturbed"):
        seen = between(signals[name], stop - repeat * peak, stop)
        level = mean(seen)
        rough = 4 * math.sqrt(mean(seen, lambda t, y: (y - level) ** 2))
        s = [(n / (repeat * peak), abs(fundamental(seen, 2 * math.pi * n / (repeat * peak))) ** 2) for n in range(int(0.6 * repeat), int(2 * repeat))]
        numbers.append((rough, sum(a ** 4 for _, a in s) / sum(f * a ** 4 for f, a in s)))
    (h, t), (h0, t0) = numbers
    return abs(h / h0 - 1) <= 0.03 and abs(t / t0 - 1) <= 0.03, (f"{kind:6s} Hs/L {height / length:.3f} kd {k * depth:4.2f} gamma {gamma}: Hs {100 * (h / h0 - 1):+.2f} %, "
                                                   f"Tp {100 * (t / t0 - 1):+.2f} %")


def irregular(binary, seed, options, folder):
    """Significant height and peak period within 3 %."""
    r = random.Random(seed)
    peak, gamma = 10 ** r.uniform(-0.2, 0.9), r.choice([1, 1, 3.3, 5])
    omega = 2 * math.pi / peak
    deep = G * peak * peak / (2 * math.pi)
    depth = deep * r.uniform(0.15, 0.6)
    k = wave_number(omega, depth)
    length = 2 * math.pi / k
    height = length * r.uniform(0.005, 0.03)
    repeat = options.periods or 100
    text = f"""[time]
end = {repeat * peak:.9g}
[waves]
type = "irregular"
significant_height = {height:.9g}
peak_period = {peak:.9g}
gamma = {gamma}
repeat = {repeat}
seed = {seed}
""" + tank(-2.5 * length, 2.5 * length, depth, 2.5 * height + 0.05 * length) + f"[fluid.size]\nsurface = {length / options.elements:.6g}\nfar = {length / 8:.6g}\n" + gauges([0, 0.3 * length])
    signals, _, _ = tables(binary, text, folder)
    stop = signals["g0"][-1][0]
    numbers = []
    for name in ("g0", "g0.undisturbed"):
        seen = between(signals[name], 0, stop)
        level = mean(seen)
        rough = 4 * math.sqrt(mean(seen, lambda t, y: (y - level) ** 2))
        # Peak period as that of the spectrum's centre around its peak: sum S^4 over sum S^4 f (Young 1995), on the sea's own frequencies.
        s = [(n / (repeat * peak), abs(fundamental(seen, 2 * math.pi * n / (repeat * peak))) ** 2) for n in range(int(0.6 * repeat), int(2 * repeat))]
        numbers.append((rough, sum(a ** 4 for _, a in s) / sum(f * a ** 4 for f, a in s)))
    (h, t), (h0, t0) = numbers
    return abs(h / height - 1) <= 0.03 and abs(t / t0 - 1) <= 0.03, (f"Hs/L {height / length:.3f} kd {k * depth:4.2f} gamma {gamma}: Hs {100 * (h / height - 1):+.2f} % "
                                                   f"(the sea's own {100 * (h0 / height - 1):+.2f} %), Tp {100 * (t / t0 - 1):+.2f} %")


def zones(binary, seed, options, folder):
    """Echo of a foreign wave within 5 %; of one near the zones' own length, 0.8 to 1.25 of it, within 3 %."""
    r = random.Random(seed)
    own, kd = 10 ** r.uniform(-0.3, 1), r.uniform(1, 5)
    depth = kd * own / (2 * math.pi)
    ratio = 2 ** r.uniform(-1, 1) if seed % 2 else 1.25 ** r.uniform(-1, 1)
    length = ratio * own
    k = 2 * math.pi / length
    omega = math.sqrt(G * k * math.tanh(k * depth))
    period, speed = 2 * math.pi / omega, group_speed(omega, k, depth)
    breadth, draft = 0.25 * length, min(0.1 * length, 0.3 * depth)
    heave = 0.015 * length
    first = 0.5 * breadth + 1.2 * min(depth, 0.5 * length)  # the box's own modes have died out
    places = [first + length * x for x in (0, 0.15, 0.3, 0.45, 0.6)]
    half = places[-1] + 0.2 * length + 1.5 * own
    seen = 4 * period
    last = 2 * period + 2 * (half - places[0]) / speed + 2 * period + seen
    rows = []
    for i in range(int(60 * last / period) + 2):
        t = i * period / 60
        s = min(t / (2 * period), 1)
        rows.append(f"[{t:.7g}, 0, {s * s * (3 - 2 * s) * heave * math.sin(omega * t):.7g}, 0]")
    text = f"""[time]
end = {last:.9g}
[waves]
type = "regular"
height = {1e-5 * own:.6g}
length = {own:.9g}
""" + tank(-half, half, depth, 0.3 * length) + f"""[fluid.size]
surface = {min(length, own) / options.elements:.6g}
far = {length / 10:.6g}
[[body]]
name = "box"
shape = {{type = "box", width = {breadth:.6g}, height = {2 * draft:.6g}}}
motion = "prescribed"
path = [{", ".join(rows)}]
size = {length / options.elements:.6g}
""" + gauges(places)
    signals, _, _ = tables(binary, text, folder)
    stop = signals["g0"][-1][0]
    amplitudes = [fundamental(between(signals[f"g{i}"], stop - seen, stop), omega) for i in range(len(places))]
    out, back = two_ways(amplitudes, places, k)
    echo, near = abs(back) / abs(out), 0.8 <= ratio <= 1.25
    return echo <= (0.03 if near else 0.05), f"wave {ratio:.2f} of the zones' own, kd {k * depth:.2f}, H/L {2 * abs(out) / length:.4f}: echo {100 * echo:.2f} %"


def touchdown(binary, seed, options, folder):
    """Within 2 % of a wavelength of the place that is asked for."""
    r = random.Random(seed)
    size = 10 ** r.uniform(-1, 0)
    length = size * r.uniform(5, 20)
    depth = length * r.uniform(0.15, 0.7)
    height = length * min(10 ** r.uniform(-1.9, -1.2), 0.5 * 0.142 * math.tanh(2 * math.pi * depth / length))
    kind, phase, pitch = r.choice(["circle", "box", "capsule"]), r.uniform(0, 360), r.uniform(5, 30)
    half = 0.5 * size
    shape, hull = {
        "circle": (f'{{type = "circle", radius = {half:.9g}}}', [(half * math.cos(a * math.pi / 360), half * math.sin(a * math.pi / 360)) for a in range(720)]),
        "box": (f'{{type = "box", width = {size:.9g}, height = {half:.9g}}}', [(x * half, y * half / 2) for x in (-1, 1) for y in (-1, 1)]),
        "capsule": (f'{{type = "capsule", radius = {half / 2:.9g}, length = {half:.9g}}}',
                    [(c * half / 2 + half / 2 * math.cos(a * math.pi / 360), half / 2 * math.sin(a * math.pi / 360)) for c in (-1, 1) for a in range(720)]),
    }[kind]
    up = height + 0.8 * size + r.uniform(0.1, 1) * size
    vx, vy = r.uniform(-1, 1) * math.sqrt(G * size), -r.uniform(0, 2) * math.sqrt(G * size)
    fall = (vy + math.sqrt(vy * vy + 2 * G * (up + height))) / G
    text = f"""[time]
end = {1.1 * fall + 0.02 * math.sqrt(size / G):.9g}
[waves]
type = "regular"
height = {height:.9g}
length = {length:.9g}
[waves.touchdown]
body = "hull"
phase_deg = {phase:.6g}
""" + tank(-2.5 * length, 2.5 * length, depth, up + 2 * size) + f"""[fluid.size]
surface = {length / options.elements:.6g}
far = {length / 8:.6g}
[[body]]
name = "hull"
shape = {shape}
density = {r.uniform(200, 900):.4g}
position = [0, {up:.9g}]
pitch_deg = {pitch:.6g}
velocity = [{vx:.6g}, {vy:.6g}]
size = {size / 20:.6g}
""" + gauges([length * (i / 40 - 0.5) for i in range(40)])
    signals, summary, _ = tables(binary, text, folder)
    contact = summary["bodies"]["hull"]["first_contact_time"]
    if not contact or contact < 0:
        return False, f"{kind}: stays dry"
    state = {}
    rows = list(csv.DictReader(open(os.path.join(folder, "out", "bodies.csv"))))
    for name in ("x", "y", "pitch_deg"):
        state[name] = at_time([(float(q["time"]), float(q[name])) for q in rows], contact)
    c, s = math.cos(math.radians(state["pitch_deg"])), math.sin(math.radians(state["pitch_deg"]))
    # The sea without the body at that instant, at forty places on a wavelength: around the crest a parabola.
    sea = [at_time(signals[f"g{i}.undisturbed"], contact) for i in range(40)]
    top = max(range(40), key=lambda i: sea[i])
    before, after = sea[top - 1], sea[(top + 1) % 40]
    crest = length * ((top + 0.5 * (before - after) / (before - 2 * sea[top] + after)) / 40 - 0.5)

    def elevation(x):
        i = (x / length + 0.5) * 40
        low = math.floor(i)
        return sea[low % 40] + (i - low) * (sea[(low + 1) % 40] - sea[low % 40])

    points = [(state["x"] + c * a - s * b, state["y"] + s * a + c * b) for a, b in hull]
    lowest = min(points, key=lambda p: p[1] - elevation(p[0]))
    found = 360 * ((crest - lowest[0]) / length % 1)
    miss = (found - phase + 180) % 360 - 180
    return abs(miss) <= 7.2, f"{kind} of {size / length:.3f} L, H/L {height / length:.3f}, asked for {phase:.0f} deg: {miss / 3.6:+.2f} % of a wavelength off"


if __name__ == "__main__":
    LAWS = (regular, paddle, hinged, spectrum, irregular, zones, touchdown)
    PARSER = arguments(__doc__, LAWS)
    PARSER.add_argument("--periods", type=int, default=0)
    try_members(PARSER.parse_args(), LAWS)
