#!/usr/bin/env python3
"""Writes pumping.json: albedos of Phong's and Blinn's models (n = 20) pumped up to five times, in three ways.

Shares nothing with the library: f is integrated over the azimuth by the trapezoidal rule, the kernel is a matrix over
one fixed grid of polar angles for L and V, and an integral over θ_V is the trapezoidal sum. cosθ_V = cosθ_L is a node
for every L, so that the sums have an expansion in h²: Romberg's extrapolation from four grids. The floor of control
has its kink between nodes, which leaves irregular errors there. `uncertainty` is ten times what the last two
extrapolations differ by, and with control no less than what the last grid changes of the first one.

    python3 derive_pumping.py > pumping.json
"""
import json

import numpy as np

THETAS = [0, 30, 45, 60, 75, 85, 89]
N = 20
ORDERS = 5


def power_20(x):
    fourth = np.square(np.square(x))
    return np.square(np.square(fourth)) * fourth


def power_10(x):
    square = np.square(x)
    return np.square(np.square(square)) * square


def phong(cos_l, sin_l, cos_v, sin_v, cos_phi):
    return (N + 2) / (2 * np.pi) * power_20(np.maximum(cos_l * cos_v - sin_l * sin_v * cos_phi, 0))


def blinn(cos_l, sin_l, cos_v, sin_v, cos_phi):
    c = (N + 2) * (N + 4) / (8 * np.pi * (2.0 ** (-N / 2) + N))
    square = 2 + 2 * (cos_l * cos_v + sin_l * sin_v * cos_phi)  # |L + V|²
    with np.errstate(divide="ignore", invalid="ignore"):
        cos2_h = np.where(square > 1e-12, (cos_l + cos_v) ** 2 / square, 0)
    return c * power_10(cos2_h)


def kernel(f, steps):
    """∫ f dφ cosθ_V sinθ_V over a grid of `steps` steps per quarter turn, times the trapezoidal weights."""
    theta = np.linspace(0, np.pi / 2, steps + 1)
    cos, sin = np.cos(theta), np.sin(theta)
    cos[-1] = 0
    azimuths = 768  # Blinn's lobe is narrow where L and V are both near the horizon, on opposite sides
    sums = np.zeros((steps + 1, steps + 1))
    for phi in (np.arange(azimuths) + 0.5) * np.pi / azimuths:
        sums += f(cos[:, None], sin[:, None], cos[None, :], sin[None, :], np.cos(phi))
    weights = np.full(steps + 1, np.pi / 2 / steps)
    weights[[0, -1]] /= 2
    return sums * (2 * np.pi / azimuths) * (cos * sin * weights)[None, :], cos


def sequence(matrix, cos, control):
    divisor = np.ones_like(matrix)
    floor = np.maximum(cos[:, None], cos[None, :])
    albedos = []
    for _ in range(ORDERS + 1):
        a = (matrix / divisor).sum(axis=1)
        albedos.append(a)
        g = np.maximum(a[:, None], a[None, :])
        if control == "step":
            g = np.maximum(g, floor)
        divisor = divisor * g
        if control == "total":
            divisor = np.maximum(divisor, floor)
    return np.array(albedos)


def main():
    grids = [180, 360, 720, 1440]
    entries = []
    for name, f in [("phong", phong), ("blinn", blinn)]:
        kernels = [kernel(f, steps) for steps in grids]
        for control in ["none", "step", "total"]:
            rows = []
            for steps, (matrix, cos) in zip(grids, kernels):
                a = sequence(matrix, cos, control)
                rows.append(a[:, [theta * steps // 90 for theta in THETAS]])
            doubt = 0
            for k in range(1, len(grids)):
                previous = rows
                rows = [(4**k * fine - coarse) / (4**k - 1) for coarse, fine in zip(rows, rows[1:])]
                if k == 1 and control != "none":  # where errors don't follow h², more extrapolation is no gain
                    doubt = np.abs(rows[-1] - rows[-2])
            error = np.maximum(10 * np.abs(rows[0] - previous[-1]), doubt)
            error = np.maximum(np.maximum.accumulate(error), 1e-11)  # an order inherits from those before
            for k in range(ORDERS + 1):
                entries.append({"model": name, "n": N, "control": control, "times": k, "theta_deg": THETAS,
                                "albedo": [float(f"{a:.12g}") for a in rows[0][k]],
                                "uncertainty": [float(f"{e:.2g}") for e in error[k]]})
    print("[\n" + ",\n".join(json.dumps(entry) for entry in entries) + "\n]")


main()
