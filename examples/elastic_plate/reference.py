"""Writes reference.csv: a plate with clamped ends, driven flat into still water at V, by linear theory.

  reference.py > reference.csv

Water hits the whole plate at once (Wagner), phi = 0 on the free surface. With x = a cos th on the underside,

  phi = sum b_n sin(n th),   a v sin(th) = sum n b_n sin(n th),

for the velocity v of the plate against the water. Deflection against the ends: w = sum q_k psi_k, the symmetric modes of a beam in vacuum.
At the first instant (M + A) q' = A_1 V, A_kl = rho int psi_k phi(psi_l) dx, A_1k = rho int psi_k phi(1) dx; then (M + A) q'' + K q = 0.
"""

import sys

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

speed, half, thick, modulus, poisson, density, water = 1.0, 0.25, 0.008, 210e9, 0.3, 7850.0, 1000.0
modes, terms, points = 8, 400, 4001

stiffness, mass = modulus * thick**3 / 12 / (1 - poisson**2), density * thick
roots = [brentq(lambda b: np.cos(b) * np.cosh(b) - 1, (k + 1.5) * np.pi - 0.5, (k + 1.5) * np.pi + 0.5) for k in range(0, 2 * modes, 2)]
th = (np.arange(points) + 0.5) * np.pi / points
x, weight = half * np.cos(th), half * np.sin(th) * np.pi / points


def mode(b):
    z = 0.5 - np.abs(x) / (2 * half)  # symmetric: from the nearer end
    share = (np.cosh(b) - np.cos(b)) / (np.sinh(b) - np.sin(b))
    shape = np.cosh(b * z) - np.cos(b * z) - share * (np.sinh(b * z) - np.sin(b * z))
    return shape / np.abs(shape).max()


n = np.arange(1, terms + 1)
sines = np.sin(np.outer(n, th))


def potential(v):
    return (2 / points * (sines @ (v * half * np.sin(th))) / n) @ sines


psi = np.array([mode(b) for b in roots])
added = water * (psi * weight) @ np.array([potential(p) for p in psi]).T
of_plate = (psi * weight) @ psi.T
inertia = mass * of_plate + 0.5 * (added + added.T)
squares, shapes = eigh(np.diag(np.diag(stiffness * of_plate) * (np.array(roots) / (2 * half)) ** 4), inertia)
first = np.linalg.solve(inertia, water * (psi * weight) @ potential(np.ones(points)) * speed)
amplitudes = shapes.T @ inertia @ first / np.sqrt(squares)
t = np.linspace(0, 4e-3, 201)
deflection = (psi[:, points // 2] @ shapes) @ (amplitudes[:, None] * np.sin(np.outer(np.sqrt(squares), t)))

print("# Deflection of the middle, linear theory; reference.py")
print(f"# periods in water {2e3 * np.pi / np.sqrt(squares[0]):.4g} and {2e3 * np.pi / np.sqrt(squares[1]):.4g} ms")
print("t_s,w_m")
np.savetxt(sys.stdout, np.c_[t, deflection], fmt="%.6e", delimiter=",")
