"""Linear theory of a floating section in regular waves: what floats.py holds free bodies against. Standard library only.

The section is symmetric about x = 0 and floats in water of constant depth. Small motions at one frequency make a potential phi exp(-i omega t),

    d phi/dz = omega^2/g phi on still water,   d phi/dz = 0 on the bed,   d phi/dn = n . V on the hull,   outgoing waves far away.

Half of the water is enough, for even and odd potentials. On its boundary, hull, still water and a vertical line `REACH` depths from the hull, Green's identity

    phi/2 = integral of (phi dG/dn - G d phi/dn) ds,   G = ln(r)/2 pi and its images in the bed and in x = 0,

is an equation for phi on panels of constant strength. Beyond the line phi is a sum of the modes of the depth, one that travels and others that decay
(hybrid method, after Yeung 1975). Pressures on the hull give added mass and damping, Haskind's relation (Newman 1962) the force of the waves.

`python3 floating_section.py` holds it against the energy that waves carry off (Newman 1962), multipoles (Ursell 1949) and eigenfunctions
(Black, Mei and Bray 1971). It says how well: within 1 %."""
import cmath
import math

from linear_waves import G, group_speed, wave_number

SWAY, HEAVE, ROLL = range(3)
REACH = 1.0  # of the vertical line from the hull, in depths or wavelengths: modes that decay have lost 96 % and are still taken into account


def circle(radius, panels=40):
    """Half of a half-immersed circle, from the keel to the waterline; panels crowd at both ends."""
    turn = [0.25 * math.pi * (1 - math.cos(math.pi * i / panels)) for i in range(panels + 1)]
    return [(radius * math.sin(a), -radius * math.cos(a)) for a in turn]


def box(breadth, draft, panels=40, bilge=0.0):
    """Half of a box with bilges of this radius, from the middle of its bottom to the waterline; panels crowd at its corner and the waterline."""
    bottom, side = 0.5 * breadth - bilge, draft - bilge
    round_ = 8 if bilge > 0 else 0
    under = max(panels // 4, min(3 * panels // 4, round((panels - round_) * bottom / (bottom + side))))
    up = panels - round_ - under
    return ([(bottom * math.sin(0.5 * math.pi * i / under), -draft) for i in range(under + 1)]
            + [(bottom + bilge * math.sin(0.5 * math.pi * i / round_), -side - bilge * math.cos(0.5 * math.pi * i / round_)) for i in range(1, round_ + 1)]
            + [(0.5 * breadth, -0.5 * side * (1 + math.cos(math.pi * i / up))) for i in range(1, up + 1)])


class Panels:
    """The boundary of half of the water, clockwise: hull, still water, vertical line."""

    def __init__(self, hull, depth, length, surface, line):
        half = hull[-1][0]
        far = half + REACH * min(depth, length)

        def crowded(n):
            return [0.5 * (1 - math.cos(math.pi * i / n)) for i in range(n + 1)]

        points = list(hull) + [(half + (far - half) * s, 0.0) for s in crowded(surface)[1:]] + [(far, -depth * s) for s in crowded(line)[1:]]
        self.ends = list(zip(points, points[1:]))
        self.middles = [(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])) for a, b in self.ends]
        self.lengths = [math.dist(a, b) for a, b in self.ends]
        self.normals = [((a[1] - b[1]) / l, (b[0] - a[0]) / l) for (a, b), l in zip(self.ends, self.lengths)]  # out of the water
        self.hull, self.surface = len(hull) - 1, surface
        self.count = len(self.ends)


def source_and_dipole(x, z, a, b, length):
    """Integrals of ln r and of its derivative out of the water over the panel from `a` to `b`, seen from (x, z)."""
    tx, tz = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    u, w = (x - a[0]) * tx + (z - a[1]) * tz, (x - a[0]) * tz - (z - a[1]) * tx
    v = u - length
    angle = math.atan(u / w) - math.atan(v / w) if abs(w) > 1e-12 * length else 0.0
    return 0.5 * (u * math.log(u * u + w * w) - v * math.log(v * v + w * w)) - length + w * angle, angle


def solved(matrix, rights):
    """Solutions of matrix x = right for each right-hand side: elimination with pivots. Both are overwritten."""
    n = len(matrix)
    rows = [m + [r[i] for r in rights] for i, m in enumerate(matrix)]
    for c in range(n):
        p = max(range(c, n), key=lambda i: abs(rows[i][c]))
        rows[c], rows[p] = rows[p], rows[c]
        pivot = rows[c]
        for i in range(c + 1, n):
            f = rows[i][c] / pivot[c]
            if f:
                rows[i][c + 1:] = [y - f * x for y, x in zip(rows[i][c + 1:], pivot[c + 1:])]
    out = []
    for k in range(len(rights)):
        x = [0j] * n
        for i in reversed(range(n)):
            x[i] = (rows[i][n + k] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
        out.append(x)
    return out


def radiated(panels, parity, modes, omega, k, depth):
    """Potentials on the hull's panels for unit velocity in each of `modes`, all even (parity 1) or odd (-1)."""
    n, wet, rest = panels.count, panels.hull, panels.hull + panels.surface
    single, double = [[0.0] * n for _ in range(n)], [[0.0] * n for _ in range(n)]
    for i, (x, z) in enumerate(panels.middles):
        # The image of the point sees the panel as the point sees the panel's image.
        places = ((x, z, 1), (x, -2 * depth - z, 1), (-x, z, parity), (-x, -2 * depth - z, parity))
        for j, ((a, b), length) in enumerate(zip(panels.ends, panels.lengths)):
            for px, pz, sign in places:
                s, d = source_and_dipole(px, pz, a, b, length)
                single[i][j] += sign * s / (2 * math.pi)
                double[i][j] += sign * d / (2 * math.pi)
    # On the line d phi/dx = sum of kappa_m a_m Z_m(z), with a_m the parts of phi.
    nu, line = omega * omega / G, range(rest, n)
    modes_of_depth = [(1j * k, [math.cosh(k * (panels.middles[j][1] + depth)) / math.cosh(k * depth) for j in line])]
    for m in range(1, max(4, len(line) // 4)):
        low, high = (m - 0.5) * math.pi / depth * (1 + 1e-12), m * math.pi / depth
        for _ in range(60):
            q = 0.5 * (low + high)
            low, high = (low, q) if nu + q * math.tan(q * depth) > 0 else (q, high)
        modes_of_depth.append((-q, [math.cos(q * (panels.middles[j][1] + depth)) for j in line]))
    matrix = [[(0.5 if i == j else 0.0) - double[i][j] for j in range(n)] for i in range(n)]
    for i in range(n):
        for j in range(wet, rest):
            matrix[i][j] += nu * single[i][j]
    for kappa, shape in modes_of_depth:
        weight = [s * panels.lengths[j] for s, j in zip(shape, line)]
        norm = sum(s * w for s, w in zip(shape, weight))
        for i in range(n):
            part = kappa / norm * sum(single[i][j] * s for j, s in zip(line, shape))
            for j, w in zip(line, weight):
                matrix[i][j] += part * w
    rights = [[-sum(single[i][j] * normal(panels, j)[m] for j in range(wet)) for i in range(n)] for m in modes]
    return [x[:wet] for x in solved(matrix, rights)]


def normal(panels, j):
    """Of sway, heave and roll about the origin, on panel j."""
    (x, z), (nx, nz) = panels.middles[j], panels.normals[j]
    return nx, nz, x * nz - z * nx


class Coefficients:
    """Added mass, damping and the force of waves along x with unit amplitude, of sway, heave and roll about the origin; only those in `modes`.

    A force is Re(F exp(-i omega t)), waves are exp(i(k x - omega t)), roll is counter-clockwise: from x to z."""

    def __init__(self, hull, depth, omega, modes=(SWAY, HEAVE, ROLL), density=1000.0, surface=60, line=40):
        self.omega, self.depth, self.density = omega, depth, density
        self.k = wave_number(omega, depth)
        panels = Panels(hull, depth, 2 * math.pi / self.k, surface, line)
        wet = range(panels.hull)
        self.added_mass = [[0.0] * 3 for _ in range(3)]
        self.damping = [[0.0] * 3 for _ in range(3)]
        self.force = [0j] * 3
        for parity, kinds in ((1, [m for m in modes if m == HEAVE]), (-1, [m for m in modes if m != HEAVE])):
            if not kinds:
                continue
            potentials = dict(zip(kinds, radiated(panels, parity, kinds, omega, self.k, depth)))
            for i in kinds:
                for j in kinds:
                    total = 2 * density * sum(potentials[j][p] * normal(panels, p)[i] * panels.lengths[p] for p in wet)
                    self.added_mass[i][j], self.damping[i][j] = total.real, omega * total.imag
                self.force[i] = 2j * omega * density * sum(
                    (self._incident(panels, p, parity)[0] * normal(panels, p)[i] - potentials[i][p] * self._incident(panels, p, parity)[1]) * panels.lengths[p]
                    for p in wet)

    def _incident(self, panels, p, parity):
        """Even or odd part of the incident wave's potential and of its derivative out of the water, on a panel."""
        (x, z), (nx, nz) = panels.middles[p], panels.normals[p]
        k, d = self.k, self.depth
        height = G / (1j * self.omega)
        up, slope = math.cosh(k * (z + d)) / math.cosh(k * d), k * math.sinh(k * (z + d)) / math.cosh(k * d)
        along, turned = (math.cos(k * x), -k * math.sin(k * x)) if parity > 0 else (1j * math.sin(k * x), 1j * k * math.cos(k * x))
        return height * up * along, height * (up * turned * nx + slope * along * nz)


def about(c, height):
    """`c` with roll about (0, height) instead of the origin: its lever gains `height` times sway."""
    t = [[1, 0, 0], [0, 1, 0], [height, 0, 1]]

    def turned(m):
        return [[sum(t[i][a] * m[a][b] * t[j][b] for a in range(3) for b in range(3)) for j in range(3)] for i in range(3)]

    c.added_mass, c.damping = turned(c.added_mass), turned(c.damping)
    c.force = [sum(t[i][a] * c.force[a] for a in range(3)) for i in range(3)]
    return c


def response(c, mass, inertia, stiffness, free=(SWAY, HEAVE, ROLL)):
    """Complex amplitudes over that of the waves, by freedom; mass, inertia and stiffness (zero, in heave, in roll) for a metre of breadth."""
    inert = (mass, mass, inertia)
    matrix = [[-c.omega ** 2 * (c.added_mass[i][j] + (inert[i] if i == j else 0)) - 1j * c.omega * c.damping[i][j] + (stiffness[i] if i == j else 0)
               for j in free] for i in free]
    return dict(zip(free, solved(matrix, [[c.force[i] for i in free]])[0]))


# (hull, depth, omega^2/g): added mass and damping over omega in heave and in sway [kg/m], both None: not known.
# The circle by multipoles (Ursell 1949), the box by eigenfunctions below and beside it (Black, Mei and Bray 1971), each summed for this table.
EXACT = {
    ("circle, deep", 0.6): (965.13, 1093.56, None, None), ("circle, deep", 1.0): (950.32, 622.67, None, None), ("circle, deep", 1.5): (1044.45, 332.50, None, None),
    ("box, shallow", 0.3): (1738.21, 2472.59, 1190.97, 1216.97), ("box, shallow", 1.0): (2041.81, 704.85, 322.41, 1009.76),
    ("box, deep", 0.3): (1735.87, 1577.65, 1704.19, 647.81), ("box, deep", 1.0): (1615.48, 378.01, 362.39, 1132.35),
}
HULLS = {"circle, deep": (circle(1.0), 12.0, 500 * math.pi), "circle, depth 2 R": (circle(1.0), 2.0, 500 * math.pi),
         "box, deep": (box(2.0, 0.7), 12.0, 1400.0), "box, shallow": (box(2.0, 0.7), 1.5, 1400.0)}


def main():
    """The laws that the coefficients obey, each within 1 %: energy, symmetry, and other methods, in shares of the displaced mass."""
    worst = 0.0
    for name, nu in sorted({*EXACT, ("circle, depth 2 R", 0.3), ("circle, depth 2 R", 1.0)}):
        hull, depth, displaced = HULLS[name]
        omega = math.sqrt(nu * G)
        c = Coefficients(hull, depth, omega)
        power = 2 * c.density * G * group_speed(omega, c.k, depth)
        misses = [abs(c.force[m]) ** 2 / power / c.damping[m][m] - 1 for m in (SWAY, HEAVE)]
        misses.append((c.added_mass[SWAY][ROLL] - c.added_mass[ROLL][SWAY]) / c.added_mass[SWAY][SWAY])
        found = (c.added_mass[HEAVE][HEAVE], c.damping[HEAVE][HEAVE] / omega, c.added_mass[SWAY][SWAY], c.damping[SWAY][SWAY] / omega)
        misses += [(x - exact) / displaced for x, exact in zip(found, EXACT.get((name, nu), ())) if exact is not None]
        print(f"{name:18s} omega^2/g {nu:3.1f}: " + " ".join(f"{x:7.1f}" for x in found) + ", off by " + " ".join(f"{100 * x:+.2f}" for x in misses) + " %")
        worst = max([worst] + [abs(x) for x in misses])
    print(f"worst {100 * worst:.2f} %")
    return worst > 0.01


if __name__ == "__main__":
    raise SystemExit(main())
