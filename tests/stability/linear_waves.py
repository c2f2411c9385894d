"""Small waves on water of constant depth. Standard library only."""
import math

G = 9.81


def wave_number(omega, depth):
    """From omega^2 = g k tanh(k depth) [1/m]."""
    k = omega * omega / G
    for _ in range(200):
        k = 0.5 * (k + omega * omega / (G * math.tanh(k * depth)))
    return k


def group_speed(omega, k, depth):
    """Speed of the energy [m/s]."""
    return 0.5 * omega / k * (1 + 2 * k * depth / math.sinh(2 * k * depth) if k * depth < 300 else 1)
