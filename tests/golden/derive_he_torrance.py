#!/usr/bin/env python3
"""Derives he_torrance.json and wave_series.json.

wave_series.json: T(g, b) = sum_{m>=1} g^m e^-g / (m! m) e^(-b/m), g a double, added up term by term in 45 digits, from far below the
largest term to far above it.

he_torrance.json: the albedo of He, Torrance, Sillion and Greenberg's model. The BRDF is written from the published
equations as a function of plain vectors, with polarisation vectors in G, z0 by Newton's iteration and the series from its
first term on; 22 digits. It is integrated in spherical coordinates of V: the midpoint rule over the azimuth, of which it is
an analytic periodic function, and Gauss rules over theta_V, on panels cut at theta_L and graded towards the horizon. The
coherent part is added. Every integral is done with two orders; `digits` is what they agree on, less one.
"""

import json
import os
import sys
import time

from mpmath import mp, mpf

from quadrature import between, direction, dot, integrate, panels

HERE = os.path.dirname(os.path.abspath(__file__))


def num(text):
    return mpf(str(text))


# ---- the series ------------------------------------------------------------------------------------------------------

def wave_series(g, b):
    """All terms that matter: the largest is near the root p of p^2 ln(p/g) = b."""
    peak = max(mpf(1), g)
    if b > 0:
        low, high = max(mpf(1), g), 2 * (g + mp.sqrt(b) + 2)
        while high * high * mp.log(high / g) < b:
            high *= 2
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if middle * middle * mp.log(middle / g) < b else (low, middle)
        peak = max(mpf(1), low)
    first, last = max(1, int(peak - 18 * mp.sqrt(peak) - 60)), int(peak + 18 * mp.sqrt(peak) + 160)
    weight = mp.exp(first * mp.log(g) - g - mp.loggamma(first + 1))
    total = mpf(0)
    for m in range(first, last + 1):
        total += weight / m * mp.exp(-b / m)
        weight *= g / (m + 1)
    return total


def series_rows():
    mp.dps = 45
    for g in ("1e-6", "1e-4", "0.01", "0.3", "1", "3", "6.3", "10", "20", "30", "38", "42", "45", "50", "60", "80", "100",
              "300", "1000", "1e4", "1e5", "1e6"):
        seen = ["%s" % b for b in (0, 0.1, 1, 10, 50, 100, 300, 1000, 5000)]
        exact = mpf(float(g))  # the double itself
        cases = [num(b) for b in seen] + [num(r) * exact for r in ("0.3", "3", "10", "30")]
        for b in cases if exact < 1e5 else cases[:2] + cases[-3:]:
            value = wave_series(exact, b)
            if value > mpf(10) ** -290:
                yield {"g": float(g), "b": mp.nstr(b, 36), "value": mp.nstr(value, 32)}


# ---- the BRDF, from vectors ------------------------------------------------------------------------------------------

def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalised(a):
    length = mp.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def schlick(f0, cosine):
    return f0 + (1 - f0) * (1 - cosine) ** 5


def z0_over_sigma0(k):
    """sqrt(pi/2) z0 = sigma0/4 k exp(-z0^2 / 2 sigma0^2), eq. 81"""
    target = k / (4 * mp.sqrt(mp.pi / 2))
    x = target if target <= 1 else mp.sqrt(2 * mp.log(target))
    for _ in range(60):
        e = mp.exp(x * x / 2)
        step = (x * e - target) / ((1 + x * x) * e)
        x -= step
        if abs(step) < mpf(10) ** (3 - mp.dps):
            break
    return x


class HeTorrance:
    def __init__(self, sigma0, tau, wavelength, f0=1):
        self.sigma0, self.tau, self.wavelength, self.f0 = num(sigma0), num(tau), num(wavelength), num(f0)
        self.sides = {}

    def side(self, w):
        """S1 (eq. 24) and K (eqs. 82, 83) of a direction."""
        found = self.sides.get(w[2])
        if found is None:
            sine = mp.sqrt(1 - w[2] ** 2)
            if sine < mpf(10) ** -18:
                found = (mpf(1), mpf(0))
            else:
                x = self.tau * w[2] / sine / (2 * self.sigma0)
                erfc = mp.erfc(x)
                lam = (mp.exp(-x * x) / (x * mp.sqrt(mp.pi)) - erfc) / 2
                found = ((1 - erfc / 2) / (1 + lam), sine / w[2] * erfc)
            self.sides[w[2]] = found
        return found

    def g(self, ci, co, k):
        sigma = self.sigma0 / mp.sqrt(1 + z0_over_sigma0(k) ** 2)
        return (2 * mp.pi * sigma / self.wavelength * (ci + co)) ** 2

    def series(self, g, b):
        weight, total, m = g * mp.exp(-g), mpf(0), 1
        tiny = mpf(10) ** (-mp.dps)
        while True:
            total += weight / m * mp.exp(-b / m)
            m += 1
            weight *= g / m
            if m > g and weight / m < tiny * (total + tiny):
                return total

    def geometry(self, l, v):
        """Eq. 76, with k_i = -L, k_r = V."""
        ki, kr = tuple(-x for x in l), v
        w = tuple(a - b for a, b in zip(kr, ki))
        across = cross(kr, ki)
        area2 = dot(across, across)
        if area2 < mpf(10) ** -20 or l[2] > 1 - mpf(10) ** -12 or v[2] > 1 - mpf(10) ** -12:
            return (dot(w, w) / w[2]) ** 2  # where the polarisation vectors have no direction
        n = (mpf(0), mpf(0), mpf(1))
        si, sr = normalised(cross(ki, n)), normalised(cross(kr, n))
        pi, pr = cross(si, ki), cross(sr, kr)
        return ((dot(w, w) / w[2]) ** 2 / area2 ** 2 * (dot(sr, ki) ** 2 + dot(pr, ki) ** 2)
                * (dot(si, kr) ** 2 + dot(pi, kr) ** 2))

    def __call__(self, l, v):
        (s_l, k_l), (s_v, k_v) = self.side(l), self.side(v)
        w = tuple(a + b for a, b in zip(l, v))
        g = self.g(l[2], v[2], k_l + k_v)
        b = (2 * mp.pi / self.wavelength) ** 2 * self.tau ** 2 * (w[0] ** 2 + w[1] ** 2) / 4
        d = mp.pi ** 2 * self.tau ** 2 / (4 * self.wavelength ** 2) * self.series(g, b)
        fresnel = schlick(self.f0, mp.sqrt(dot(w, w)) / 2)
        return fresnel / mp.pi * self.geometry(l, v) * s_l * s_v * d / (l[2] * v[2])

    def coherent(self, l):
        s, k = self.side(l)
        return schlick(self.f0, l[2]) * mp.exp(-self.g(l[2], l[2], 2 * k)) * s * s


def directional_diffuse(model, theta, count, turns):
    l = direction(theta)
    angle, half = mp.radians(num(theta)), mp.pi / 2
    sine = mp.sin(angle)

    def ring(t):
        s, c = mp.sin(t), mp.cos(t)
        steps = turns if sine > 0 else 1
        cosines = [mp.cos(mp.pi * (2 * j + 1) / (2 * steps)) for j in range(steps)]
        total = mp.fsum(model(l, (s * x, s * mp.sqrt(1 - x * x), c)) for x in cosines)
        return 2 * mp.pi / steps * s * c * total

    width = 2 * max(2 * model.sigma0 / model.tau, model.wavelength / (2 * mp.pi * model.tau))
    near = [angle + side * k * width for side in (-1, 1) for k in (1, 2, 4)]
    # a layer of the width of the slopes along the horizon, and a logarithm at its end; a cone at the zenith
    alpha = 2 * model.sigma0 / model.tau
    layers = [half - min(mpf(1), 6 * alpha) / 3 ** k for k in range(6)]
    cone = [1 / (12 * alpha) * 2 ** k for k in range(5)] if alpha > num("0.3") else []
    edges = panels(between(mpf(0), half, [angle] + near + layers + cone), mpf("0.2"))
    return mp.fsum(integrate(ring, a, b, count, 1, 3 if b == half else 1) for a, b in zip(edges, edges[1:]))


CASES = [
    ("0.1", "1.7", "1", ("0", "30", "60", "80", "85")),
    ("0.01", "1.7", "1", ("0", "60", "85")),
    ("0.5", "1.7", "1", ("45", "75")),
    ("0.05", "3", "0.04", ("60",)),
    ("0.3", "0.2", "1", ("50",)),
    ("0.02", "0.5", "0.3", ("70",)),
]


def albedo_rows():
    mp.dps = 22
    for sigma0, tau, f0, thetas in CASES:
        turns = 26 + int(12 * float(tau) / 0.5)
        for theta in thetas:
            began = time.time()
            model = HeTorrance(sigma0, tau, "0.5", f0)
            low = directional_diffuse(model, theta, 13, turns)
            high = directional_diffuse(model, theta, 18, turns + turns // 4)
            coherent = model.coherent(direction(theta))
            difference = abs(high - low) / high
            digits = min(18, int(-mp.log10(difference)) - 1 if difference else 18)
            parameters = {"sigma0": float(sigma0), "tau": float(tau), "wavelength": 0.5}
            if f0 != "1":
                parameters["f0"] = float(f0)
            for part, value in (("directional_diffuse", high), ("total", high + coherent), ("specular", coherent)):
                text = mp.nstr(value, digits if part != "specular" else 18, strip_zeros=False)
                yield {"model": "he_torrance", "parameters": {**parameters, "part": part}, "theta_deg": float(theta),
                       "phi_deg": 0.0, "albedo": text, "digits": digits if part != "specular" else 18,
                       "source": "He et al. 1991 eqs. 69-84, erratum to eq. 25, v_xy in wave numbers"}
            print("%-5s %-4s %-5s %3s  %-22s + %-12s %2d digits %5.1f s" % (
                sigma0, tau, f0, theta, mp.nstr(high, 18), mp.nstr(coherent, 8), digits, time.time() - began),
                file=sys.stderr, flush=True)


def write(name, rows):
    rows = list(rows)
    with open(os.path.join(HERE, name), "w") as out:
        out.write("[\n" + ",\n".join(json.dumps(r) for r in rows) + "\n]\n")
    print("%s: %d values" % (name, len(rows)), file=sys.stderr)


if __name__ == "__main__":
    write("wave_series.json", series_rows())
    write("he_torrance.json", albedo_rows())
