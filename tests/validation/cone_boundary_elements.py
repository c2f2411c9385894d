#!/usr/bin/env python3
"""Pressure and force of a cone that enters still water at constant speed, by boundary elements: what examples/cone_entry is held against.

    tests/validation/cone_boundary_elements.py DEADRISE_DEG [--panel 0.01] [--until 2.5]     (python3-numpy, python3-scipy; minutes)

Prints the side's pressure as CSV, s, z and Cp from the apex to where the jet carries none, after a line with F/(rho V^4 t^2), the
largest Cp and its largest mean over a sixteenth of V t in height (examples/cone_entry's patch).

Potential flow without gravity grows as t: x = V t xi, phi = V^2 t Phi(xi). With tau = ln t the free surface obeys

    d xi/d tau = grad Phi - xi,     d Phi/d tau = |grad Phi|^2/2 - Phi        (Heun, from a flat surface to where nothing changes)

and Phi the integral equation over the body, dPhi/dn given, and the free surface, Phi given, in rings of constant strength:

    Phi/2 = integral of (G dPhi/dn - Phi dG/dn) r ds,     G = K(m)/(pi A), A^2 = (r + r')^2 + (z - z')^2, m = 4 r r'/A^2

On the body Cp = -2 (Phi - xi . grad Phi + |grad Phi|^2/2). The jet is cut off where it is as thin as a panel is long, square to the
body and with the potential of its surface (Battistin, Iafrati 2003, J. Fluids Struct. 17, 643-664, cut it likewise).

Second order: at 30 degrees panels of 0.04, 0.02 and 0.01 V t give 24.52, 24.68 and 24.69.
"""
import argparse
import math

import numpy
from scipy.interpolate import CubicSpline
from scipy.special import ellipe, ellipkm1

GAUSS_X, GAUSS_W = numpy.polynomial.legendre.leggauss(8)
APEX = numpy.array([0.0, -1.0])
FAR = 25.0  # the surface is flat beyond, in V t
PATCH = 0.0625
NO_PRESSURE = 0.01  # of Cp


def ring(point, at, normal):
    """G r' and dG/dn' r' of rings at `at` for points `point`, 2 components in the last axis each."""
    r, q = point[..., 0], at[..., 0]
    dz = point[..., 1] - at[..., 1]
    a2, b2 = (r + q) ** 2 + dz ** 2, (r - q) ** 2 + dz ** 2
    k, e = ellipkm1(b2 / a2), ellipe(1 - b2 / a2)
    factor = q / (math.pi * numpy.sqrt(a2))
    in_r = ((r ** 2 - q ** 2 + dz ** 2) / b2 * e - k) / (2 * q)
    in_z = dz / b2 * e
    return factor * k, factor * (in_r * normal[..., 0] + in_z * normal[..., 1])


def matrices(vertices):
    """Integrals of G r' and dG/dn' r' over each panel (columns) seen from each panel's middle (rows); middles, normals, lengths."""
    along = numpy.diff(vertices, axis=0)
    length = numpy.hypot(along[:, 0], along[:, 1])
    middle = 0.5 * (vertices[1:] + vertices[:-1])
    normal = numpy.stack([-along[:, 1], along[:, 0]], 1) / length[:, None]

    def sum_up(rows, columns, places, weights):
        total = 0.0
        for x, w in zip(places, weights):
            values = ring(middle[rows], middle[columns] + 0.5 * x * along[columns], normal[columns])
            total = total + numpy.array(values) * w * 0.5 * length[columns]
        return total

    every = numpy.arange(len(length))
    both = sum_up(every[:, None], every[None, :], GAUSS_X, GAUSS_W)
    distance = numpy.hypot(*numpy.moveaxis(middle[:, None] - middle[None], 2, 0))
    rows, columns = numpy.nonzero((distance < 1.5 * length) & (distance > 0))
    quarters = numpy.array([-0.75, -0.25, 0.25, 0.75])
    both[:, rows, columns] = sum_up(rows, columns, (quarters[:, None] + GAUSS_X / 4).ravel(), numpy.tile(GAUSS_W / 4, 4))
    # The logarithm at a panel's own middle goes with x = u^3.
    u = 0.5 * (GAUSS_X + 1)
    both[:, every, every] = sum_up(every, every, numpy.r_[-u ** 3, u ** 3], numpy.tile(1.5 * u ** 2 * GAUSS_W, 2))
    return both[0], both[1], middle, normal, length


def graded(total, first, largest, ratio=1.06):
    """Places from 0 to total, at distances that grow."""
    places, step = [0.0], first
    while places[-1] < total:
        places.append(places[-1] + step)
        step = min(step * ratio, largest)
    return numpy.array(places) * total / places[-1]


def arclength(points):
    return numpy.r_[0, numpy.cumsum(numpy.hypot(*numpy.diff(points, axis=0).T))]


class Cone:
    def __init__(self, deadrise_deg, panel):
        angle = math.radians(deadrise_deg)
        self.panel = panel
        self.side = numpy.array([math.cos(angle), math.sin(angle)])
        self.normal = numpy.array([-math.sin(angle), math.cos(angle)])  # out of the water
        contact = 1 / math.tan(angle)
        places = graded(FAR - contact, panel, 2.0)
        self.surface = numpy.stack([contact + places, 0 * places], 1)
        self.phi = numpy.zeros(len(places))

    def thickness(self, points):
        return (APEX - points) @ self.normal

    def solve(self, surface, phi):
        """Phi on the body's panels, dPhi/dn on the surface's; the body's middles, lengths and dPhi/dn."""
        foot = (surface[0] - APEX) @ self.side
        half = graded(foot / 2, self.panel, 0.04, 1.03)
        body = APEX + numpy.r_[half, foot - numpy.flip(half)[1:]][:, None] * self.side
        cut = max(1, round(self.thickness(surface[0]) / self.panel)) if self.thickness(surface[0]) > 1e-9 else 0
        across = body[-1] + (numpy.arange(1, cut + 1) / max(cut, 1))[:, None] * (surface[0] - body[-1])
        g, h, middle, normal, length = matrices(numpy.concatenate([body, across, surface[1:]]))
        n = len(body) - 1
        known = numpy.r_[numpy.full(cut, phi[0]), 0.5 * (phi[1:] + phi[:-1])]
        given = -normal[:n, 1]
        c = 0.5 * numpy.eye(len(length)) + h
        found = numpy.linalg.solve(numpy.concatenate([c[:, :n], -g[:, n:]], 1), g[:, :n] @ given - c[:, n:] @ known)
        return found[:n], found[n + cut:], middle[:n], length[:n], given

    def rates(self, surface, phi):
        _, normal_speed, *_ = self.solve(surface, phi)
        s = arclength(surface)
        m = 0.5 * (s[1:] + s[:-1])
        at_nodes = numpy.interp(s, m, normal_speed)
        at_nodes[0] = normal_speed[0] + (normal_speed[0] - normal_speed[1]) * (m[0] - s[0]) / (m[1] - m[0])
        at_nodes[-1] = 0
        tangent = CubicSpline(s, surface)(s, 1)
        stretch = numpy.hypot(tangent[:, 0], tangent[:, 1])[:, None]
        tangent /= stretch
        outward = numpy.stack([-tangent[:, 1], tangent[:, 0]], 1)
        velocity = (CubicSpline(s, phi)(s, 1)[:, None] / stretch) * tangent + at_nodes[:, None] * outward
        return velocity - surface, 0.5 * (velocity ** 2).sum(1) - phi

    def within(self, surface, phi):
        """The far end stays where it is, the contact line out of the body."""
        surface[-1], phi[-1] = (FAR, 0.0), 0.0
        surface[0] += self.normal * min(0.0, self.thickness(surface[0]))
        return surface, phi

    def step(self):
        """One step of Heun; returns the change of tau."""
        drift, change = self.rates(self.surface, self.phi)
        panels = numpy.hypot(*numpy.diff(self.surface, axis=0).T)
        dt = min(0.02, 0.4 * numpy.min(panels / numpy.maximum(numpy.hypot(*drift[1:].T), 1e-9)))
        ahead = self.within(self.surface + dt * drift, self.phi + dt * change)
        drift_2, change_2 = self.rates(*ahead)
        self.surface, self.phi = self.within(self.surface + 0.5 * dt * (drift + drift_2), self.phi + 0.5 * dt * (change + change_2))
        self.cut_and_spread()
        return dt

    def cut_and_spread(self):
        """Cuts the jet where it is thinner than a panel is long; nodes a panel apart from there to beyond the root, then farther."""
        s = arclength(self.surface)
        shape, phi = CubicSpline(s, self.surface), CubicSpline(s, self.phi)
        fine = numpy.unique(numpy.r_[numpy.linspace(0, min(s[-1], 6), 6000), s])
        thickness = self.thickness(shape(fine))
        thin = numpy.nonzero(thickness < self.panel)[0]
        start = 0.0
        if len(thin):
            k = thin[-1]
            start = fine[k] + (self.panel - thickness[k]) / (thickness[k + 1] - thickness[k]) * (fine[k + 1] - fine[k])
        rest = fine[fine >= start]
        direction = shape(rest, 1)
        outward = numpy.nonzero(direction[:, 0] > 0.3 * numpy.hypot(direction[:, 0], direction[:, 1]))[0]
        even = (rest[outward[0]] - start if len(outward) else 0.0) + 0.25
        places = start + numpy.r_[numpy.linspace(0, even, max(4, math.ceil(even / self.panel)) + 1),
                                  even + graded(s[-1] - start - even, self.panel * 1.05, 2.0)[1:]]
        self.surface, self.phi = shape(places), phi(places)

    def pressure(self):
        """s, z, Cp on the side from the apex, to which it is extrapolated, to where the jet carries none, and F/(rho V^4 t^2)."""
        phi, _, middle, length, given = self.solve(self.surface, self.phi)
        s = (middle - APEX) @ self.side
        velocity = CubicSpline(s, phi)(s, 1)[:, None] * self.side + given[:, None] * self.normal
        cp = -2 * (phi - (middle * velocity).sum(1) + 0.5 * (velocity ** 2).sum(1))
        none = numpy.nonzero((middle[:, 1] > 0) & (cp < NO_PRESSURE))[0]
        end = none[0] if len(none) else len(cp)
        force = numpy.sum((math.pi * cp * middle[:, 0] * length)[:end]) * self.side[0]
        apex = cp[0] - (cp[1] - cp[0]) * s[0] / (s[1] - s[0])
        return numpy.r_[0, s[:end]], numpy.r_[-1, middle[:end, 1]], numpy.r_[apex, cp[:end]], force


def largest_mean(z, cp, width):
    """The largest mean of cp over a range of z that wide."""
    fine = numpy.linspace(z[0], z[-1], 20001)
    total = numpy.r_[0, numpy.cumsum(numpy.interp(fine, z, cp))]
    n = round(width / (fine[1] - fine[0]))
    return numpy.max(total[n:] - total[:-n]) / n


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("deadrise_deg", type=float)
    parser.add_argument("--panel", type=float, default=0.01, help="at the jet and its root, in V t")
    parser.add_argument("--until", type=float, default=2.5, help="of ln t")
    options = parser.parse_args()
    cone, tau = Cone(options.deadrise_deg, options.panel), 0.0
    while tau < options.until:
        tau += cone.step()
    s, z, cp, force = cone.pressure()
    print(f"# cone of {options.deadrise_deg:g} degrees, panels of {options.panel:g} V t: F/(rho V^4 t^2) {force:.5g}, largest Cp {cp.max():.5g}, "
          f"mean over {PATCH:g} V t {largest_mean(z, cp, PATCH):.5g}")
    print("s,z,Cp")
    for row in zip(s, z, cp):
        print("{:.6g},{:.6g},{:.6g}".format(*row))


if __name__ == "__main__":
    main()
