#!/usr/bin/env python3
"""Derives independent.json: directional albedos by brute-force quadrature in 30-digit arithmetic.

Every BRDF below is written from its published formula, as a function of the plain vectors L and V and nothing else; the
integrator (quadrature.py) uses Cartesian half-vector slopes or spherical coordinates. Every integral is done with two
orders, and `digits` is the number of leading digits on which they agree, less one.

    python3 derive_independent.py              writes independent.json beside this file
    python3 derive_independent.py --check      also integrates each case over (theta_V, phi_V) in double precision
    python3 derive_independent.py --only ward  shows the cases of one model, writes nothing
"""

import argparse
import json
import math
import os
import sys
import time

from mpmath import fp, mp, mpf

from quadrature import Lobe, direction, dot, half_vector_albedo, hemisphere_albedo

mp.dps = 30
HERE = os.path.dirname(os.path.abspath(__file__))


# ---- BRDFs, from vectors ---------------------------------------------------------------------------------------------

def half_vector(l, v):
    w = (l[0] + v[0], l[1] + v[1], l[2] + v[2])
    length = mp.sqrt(dot(w, w))
    return (w[0] / length, w[1] / length, w[2] / length)


def schlick(f0, cosine):
    return f0 + (1 - f0) * (1 - cosine) ** 5 if f0 != 1 else mpf(1)


def beckmann(h, mx, my):
    return mp.exp(-((h[0] / mx) ** 2 + (h[1] / my) ** 2) / h[2] ** 2) / (mp.pi * mx * my * h[2] ** 4)


def ward(ax, ay, rho_s=1, rho_d=0):
    def f(l, v):
        h = half_vector(l, v)
        e = mp.exp(-((h[0] / ax) ** 2 + (h[1] / ay) ** 2) / h[2] ** 2)
        return rho_s * e / (4 * mp.pi * ax * ay * mp.sqrt(l[2] * v[2])) + rho_d / mp.pi
    return f


def cook_torrance(m, masking, f0=1):
    def f(l, v):
        h = half_vector(l, v)
        lh = dot(l, h)
        g = min(mpf(1), 2 * h[2] * v[2] / lh, 2 * h[2] * l[2] / lh) if masking == "v_cavity" else mpf(1)
        return schlick(f0, lh) * beckmann(h, m, m) * g / (4 * l[2] * v[2])
    return f


def ashikhmin_shirley(nu, nv, r_s=1, projected=False):
    k = 2 if projected else 1
    c = mp.sqrt((nu + k) * (nv + k)) / (8 * mp.pi)

    def f(l, v):
        h = half_vector(l, v)
        lh = dot(l, h)
        e = nu if nu == nv else (nu * h[0] ** 2 + nv * h[1] ** 2) / (1 - h[2] ** 2)
        return c * mp.power(h[2], e) * schlick(r_s, lh) / (lh * max(l[2], v[2]))
    return f


def kurt(mx, my, equation, exponent=0, f0=1):
    def f(l, v):
        h = half_vector(l, v)
        lh = dot(l, h)
        g = max(l[2], v[2]) if equation == 9 else mp.power(l[2] * v[2], exponent)
        return schlick(f0, lh) * beckmann(h, mx, my) / (4 * lh * g)
    return f


def ggx(ax, ay, masking, f0=1):
    def lam(w):
        return (mp.sqrt(1 + ((ax * w[0]) ** 2 + (ay * w[1]) ** 2) / w[2] ** 2) - 1) / 2

    def f(l, v):
        h = half_vector(l, v)
        d = 1 / (mp.pi * ax * ay * ((h[0] / ax) ** 2 + (h[1] / ay) ** 2 + h[2] ** 2) ** 2)
        a, b = lam(l), lam(v)
        g = 1 / (1 + a + b) if masking == "correlated" else 1 / ((1 + a) * (1 + b))
        return schlick(f0, dot(l, h)) * d * g / (4 * l[2] * v[2])
    return f


def blinn(n, original=False):
    c = (n + 2) * (n + 4) / (8 * mp.pi * (mp.power(2, -mpf(n) / 2) + n))

    def f(l, v):
        h = half_vector(l, v)
        return c * h[2] ** n / (l[2] if original else 1)
    return f


def lafortune(cx, cy, cz, n):
    c = mpf(n + 2) / (2 * mp.pi * max(abs(cx), abs(cy), abs(cz)) ** n)

    def f(l, v):
        x = cx * l[0] * v[0] + cy * l[1] * v[1] + cz * l[2] * v[2]
        return c * x ** n if x > 0 else mpf(0)
    return f


def mirror_phong(n, kind):
    def f(l, v):
        x = -l[0] * v[0] - l[1] * v[1] + l[2] * v[2]
        if x <= 0:
            return mpf(0)
        if kind == "phong_original":
            return (n + 1) / (2 * mp.pi) * x ** n / l[2]
        return (n + 2) / (2 * mp.pi) * x ** n / (max(l[2], v[2]) if kind == "neumann_phong" else 1)
    return f


def scaled(k, brdf):
    return lambda l, v: k * brdf(l, v)


def ashikhmin_diffuse(r_s, r_d):
    def f(l, v):
        return (28 * r_d / (23 * mp.pi) * (1 - r_s) * (1 - (1 - l[2] / 2) ** 5) * (1 - (1 - v[2] / 2) ** 5))
    return f


def coupled_lambert(k_d, f0):
    return lambda l, v: k_d * (1 - schlick(f0, dot(l, half_vector(l, v)))) / mp.pi


# ---- kinks in slope space --------------------------------------------------------------------------------------------

def roots_real(coefficients):
    try:
        roots = mp.polyroots(coefficients, maxsteps=200, extraprec=60)
    except mp.NoConvergence:
        roots = mp.polyroots(coefficients, maxsteps=2000, extraprec=200)
    return [r.real for r in roots if abs(r.imag) < mpf(10) ** -18]


def equal_cosines_inner(y, l):
    """cos V = cos L is the circle x^2 + y^2 = slope . tan(theta_L): where max(N.L, N.V) switches."""
    tx, ty = l[0] / l[2], l[1] / l[2]
    disc = tx * tx - 4 * (y * y - ty * y)
    if disc <= 0:
        return []
    root = mp.sqrt(disc)
    return [(tx - root) / 2, (tx + root) / 2]


def equal_cosines_outer(l):
    tx, ty = l[0] / l[2], l[1] / l[2]
    radius = mp.sqrt(tx * tx + ty * ty) / 2
    return [ty / 2 - radius, ty / 2 + radius]


def v_cavity_inner(y, l):
    """L at azimuth 0, t = tan(theta_L): the L side switches on x = 1/t, the V side on (x^2+y^2)(3+tx) = 1+3tx."""
    t = l[0] / l[2]
    return [1 / t] + roots_real([t, 3, t * (y * y - 3), 3 * y * y - 1]) + equal_cosines_inner(y, l)


def v_cavity_outer(l):
    """Where those curves cross each other or turn back: double roots of the cubic, and the triple point."""
    t = l[0] / l[2]

    def discriminant(s):
        a, b, c, d = t, mpf(3), t * (s - 3), 3 * s - 1
        return 18 * a * b * c * d - 4 * b ** 3 * d + b * b * c * c - 4 * a * c ** 3 - 27 * a * a * d * d

    f0, f1, f2, f3 = (discriminant(mpf(s)) for s in range(4))
    c3 = (f3 - 3 * f2 + 3 * f1 - f0) / 6
    c2 = (f2 - 2 * f1 + f0) / 2 - 3 * c3
    c1 = f1 - f0 - c2 - c3
    squares = roots_real([c3, c2, c1, f0]) + [1 - 1 / (t * t)]
    return [mp.sqrt(s) for s in squares if s > 0] + equal_cosines_outer(l)


# ---- cases -----------------------------------------------------------------------------------------------------------

class Case:
    def __init__(self, model, parameters, theta, phi, brdf, integrate, orders, source):
        self.model, self.parameters, self.theta, self.phi = model, parameters, theta, phi
        self.brdf, self.integrate, self.orders, self.source = brdf, integrate, orders, source


def num(x):
    """The decimal number as written, not its nearest double."""
    return mpf(str(x))


def slopes(model, parameters, theta, phi, brdf, lobe, source, orders=(20, 28), isotropic=True):
    how = "Gauss rules of orders %d and %d over Cartesian half-vector slopes" % orders
    return Case(model, parameters, theta, phi, brdf,
                lambda l, count: half_vector_albedo(brdf, l, lobe, count, isotropic), orders, source + "; " + how)


def sphere(model, parameters, theta, phi, brdf, options, source, orders=(20, 28)):
    how = "Gauss rules of orders %d and %d over (theta_V, phi_V) around the lobe's azimuth" % orders
    return Case(model, parameters, theta, phi, brdf,
                lambda l, count: hemisphere_albedo(brdf, l, count, **options(l)), orders, source + "; " + how)


WARD = "f = rho_s exp(-tan^2 th_h (cos^2/ax^2 + sin^2/ay^2)) / (4 pi ax ay sqrt(ci co)), Walter 2005 eq. 3"
COOK = "f = F D G / (4 ci co), Beckmann D, Neumann 1999 eqs. 9-10"
ASHIKHMIN = "f = sqrt((nu+1)(nv+1)) / (8 pi) ch^e F / ((L.H) max(ci, co)), Ashikhmin & Shirley 2000 eq. 10"
KURT9 = "f = F D / (4 (L.H) max(ci, co)), Kurt 2010 eq. 9"
KURT10 = "f = F D / (4 (L.H) (ci co)^exponent), Kurt 2010 eq. 10"
GGX = "f = F D G2 / (4 ci co), Smith GGX, Heitz 2014 eqs. 98-99"
LAFORTUNE = "f = (n+2) / (2 pi max|C|^n) (C L.V)^n, Lafortune 1997 normalised"


def both(model, parameters, theta, phi, lobe_brdf, lobe, smooth_brdf, source, orders=(20, 28)):
    """A lobe integrated over half-vector slopes plus a smooth term integrated over (theta_V, phi_V)."""
    how = "; lobe by Gauss rules of orders %d and %d over half-vector slopes, diffuse over (theta_V, phi_V)" % orders
    return Case(model, parameters, theta, phi, lambda l, v: lobe_brdf(l, v) + smooth_brdf(l, v),
                lambda l, count: half_vector_albedo(lobe_brdf, l, lobe, count, True)
                + hemisphere_albedo(smooth_brdf, l, count), orders, source + how)


def power_lobe(nu, nv, kinks):
    wx, wy = 1 / mp.sqrt(mpf(nu)), 1 / mp.sqrt(mpf(nv))
    small = min(nu, nv)
    cut = mp.sqrt(mp.power(10, mpf(56) / small) - 1) if small >= 500 else None
    return Lobe(wx, wy, gaussian=small >= 500, cut=cut, inner=kinks[0], outer=kinks[1])


def around(cx, cy, cz):
    """phi about the lobe's axis C o L as far as the lobe is positive; theta cut where that sets in and at theta_L."""
    def options(l):
        w = (cx * l[0], cy * l[1], cz * l[2])
        r = mp.hypot(w[0], w[1])

        def limit(t):
            reach = -w[2] * mp.cos(t) / (r * mp.sin(t))
            return mp.pi if reach <= -1 else mp.acos(reach)
        return dict(theta_breaks=[mp.acos(l[2]), mp.atan2(w[2], r)], phi_axis=mp.atan2(w[1], w[0]), phi_limit=limit)
    return options


def cases():
    kinks_max = (equal_cosines_inner, equal_cosines_outer)
    kinks_cavity = (v_cavity_inner, v_cavity_outer)
    no_kinks = (None, None)

    for alpha, thetas in (("0.1", ("0", "60", "89", "89.99")), ("0.01", ("85",)), ("0.001", ("80",)),
                          ("0.0001", ("60",)), ("0.5", ("75",))):
        for theta in thetas:
            a = num(alpha)
            yield slopes("ward", {"alpha": float(alpha)}, theta, "0", ward(a, a), Lobe(a), WARD, orders=(24, 34))
    for phi in ("30", "90"):
        ax, ay = num("0.3"), num("0.05")
        yield slopes("ward", {"alpha_x": 0.3, "alpha_y": 0.05}, "60", phi, ward(ax, ay), Lobe(ax, ay), WARD,
                     isotropic=False)

    for m in ("0.1", "0.3"):
        for masking, kinks in (("v_cavity", kinks_cavity), ("none", no_kinks)):
            for theta in ("30", "60", "80"):
                yield slopes("cook_torrance", {"m": float(m), "masking": masking}, theta, "0",
                             cook_torrance(num(m), masking), Lobe(num(m), inner=kinks[0], outer=kinks[1]), COOK)
    for masking, kinks in (("v_cavity", kinks_cavity), ("none", no_kinks)):
        yield slopes("cook_torrance", {"m": 0.1, "masking": masking}, "89.9", "0", cook_torrance(num("0.1"), masking),
                     Lobe(num("0.1"), inner=kinks[0], outer=kinks[1]), COOK)
    yield slopes("cook_torrance", {"m": 0.2, "f0": 0.04, "masking": "v_cavity"}, "75", "0",
                 cook_torrance(num("0.2"), "v_cavity", num("0.04")),
                 Lobe(num("0.2"), inner=v_cavity_inner, outer=v_cavity_outer), COOK + ", Schlick F")

    for n in (10, 1000, 1000000):
        for theta in ("60", "85"):
            yield slopes("ashikhmin_shirley", {"n": n}, theta, "0", ashikhmin_shirley(mpf(n), mpf(n)),
                         power_lobe(n, n, kinks_max), ASHIKHMIN)
    for theta in ("60", "85"):
        yield slopes("ashikhmin_shirley", {"n_u": 10, "n_v": 1000}, theta, "25",
                     ashikhmin_shirley(mpf(10), mpf(1000)), power_lobe(10, 1000, kinks_max), ASHIKHMIN,
                     isotropic=False)
    yield slopes("ashikhmin_shirley", {"n": 10, "normalization": "projected"}, "85", "0",
                 ashikhmin_shirley(mpf(10), mpf(10), projected=True), power_lobe(10, 10, kinks_max),
                 ASHIKHMIN + " with n+2 for n+1 (Pharr & Humphreys)")
    yield slopes("ashikhmin_shirley", {"n": 100, "r_s": 0.05}, "70", "0",
                 ashikhmin_shirley(mpf(100), mpf(100), r_s=num("0.05")), power_lobe(100, 100, kinks_max),
                 ASHIKHMIN + ", Schlick F")

    yield both("ashikhmin_shirley", {"n": 100, "r_s": 0.05, "r_d": 0.5}, "70", "0",
               ashikhmin_shirley(mpf(100), mpf(100), r_s=num("0.05")), power_lobe(100, 100, kinks_max),
               ashikhmin_diffuse(num("0.05"), num("0.5")), ASHIKHMIN + ", Schlick F, plus the diffuse term of eq. 14")

    m = num("0.2")
    yield slopes("kurt", {"m": 0.2, "equation": 10, "exponent": 0.3}, "60", "0", kurt(m, m, 10, num("0.3")),
                 Lobe(m, edge_power=5), KURT10, orders=(32, 44))
    for theta in ("60", "85"):
        yield slopes("kurt", {"m": 0.2, "equation": 9}, theta, "0", kurt(m, m, 9),
                     Lobe(m, inner=equal_cosines_inner, outer=equal_cosines_outer), KURT9)
    yield both("kurt", {"m": 0.2, "equation": 13, "exponent": 0.5, "f0": 0.05, "k_s": 0.6, "k_d": 0.4}, "60", "0",
               scaled(num("0.6"), kurt(m, m, 10, num("0.5"), num("0.05"))), Lobe(m),
               coupled_lambert(num("0.4"), num("0.05")), "f = k_d (1 - F) / pi + k_s f_10, Schlick F, Kurt 2010 eq. 13")
    yield slopes("kurt", {"m_x": 0.4, "m_y": 0.1, "equation": 10, "exponent": 0.5, "f0": 0.1}, "70", "50",
                 kurt(num("0.4"), num("0.1"), 10, num("0.5"), num("0.1")), Lobe(num("0.4"), num("0.1")),
                 KURT10 + ", Schlick F", isotropic=False)

    for alpha in ("0.1", "0.5"):
        for masking in ("correlated", "separable"):
            for theta in ("60", "85"):
                a = num(alpha)
                yield slopes("ggx", {"alpha": float(alpha), "masking": masking}, theta, "0", ggx(a, a, masking),
                             Lobe(a, gaussian=False, step="0.5"), GGX, orders=(28, 38))
    for masking in ("correlated", "separable"):
        yield slopes("ggx", {"alpha_x": 0.5, "alpha_y": 0.1, "masking": masking}, "70", "40",
                     ggx(num("0.5"), num("0.1"), masking),
                     Lobe(num("0.5"), num("0.1"), gaussian=False, step="0.6"), GGX, orders=(28, 38), isotropic=False)
    yield slopes("ggx", {"alpha": 0.3, "f0": 0.04, "masking": "correlated"}, "80", "0",
                 ggx(num("0.3"), num("0.3"), "correlated", num("0.04")), Lobe(num("0.3"), gaussian=False, step="0.6"),
                 GGX + ", Schlick F")
    yield slopes("ggx", {"alpha": 0.001, "masking": "correlated"}, "89", "0",
                 ggx(num("0.001"), num("0.001"), "correlated"), Lobe(num("0.001"), gaussian=False, edge_power=6), GGX,
                 orders=(32, 44))

    for theta in ("45", "75", "89"):
        yield sphere("neumann_phong", {"n": 20}, theta, "0", mirror_phong(mpf(20), "neumann_phong"),
                     around(-1, -1, 1), "f = (n+2) / (2 pi) (R.V)^n / max(ci, co), Neumann 1999 eq. 22")
    yield sphere("lafortune", {"c_x": -0.577, "c_y": -0.577, "c_z": 0.577, "n": 20}, "50", "0",
                 lafortune(num("-0.577"), num("-0.577"), num("0.577"), 20),
                 around(num("-0.577"), num("-0.577"), num("0.577")), LAFORTUNE)
    yield sphere("lafortune", {"c_x": -1, "c_y": -0.8, "c_z": 0.5, "n": 5}, "50", "20",
                 lafortune(mpf(-1), num("-0.8"), num("0.5"), 5), around(mpf(-1), num("-0.8"), num("0.5")),
                 LAFORTUNE, orders=(30, 40))
    yield sphere("phong", {"n": 20}, "75", "0", mirror_phong(mpf(20), "phong"), around(-1, -1, 1),
                 "f = (n+2) / (2 pi) (R.V)^n, Lewis 1993")
    yield sphere("phong_original", {"n": 20}, "60", "0", mirror_phong(mpf(20), "phong_original"), around(-1, -1, 1),
                 "f = (n+1) / (2 pi) (R.V)^n / ci, L fixed, Neumann 1999 eq. 5")

    for n in (20, 1000):
        for theta in ("30", "60"):
            yield slopes("blinn", {"n": n}, theta, "0", blinn(n), power_lobe(n, n, no_kinks),
                         "f = c ch^n with a(0) = 1, c = (n+2)(n+4) / (8 pi (2^(-n/2) + n))")
    yield slopes("blinn_original", {"n": 20}, "60", "0", blinn(20, original=True), power_lobe(20, 20, no_kinks),
                 "f = c ch^n / ci, c of blinn, L fixed, Neumann 1999 eq. 5")


# ---- the third way: double precision, spherical coordinates, no knowledge of the lobe --------------------------------

def crude(case, theta_cells=700, phi_cells=700):
    """Midpoint rule over (theta_V, phi_V) in double precision, refined around the mirror direction by a sinh map."""
    l = [float(c) for c in direction(case.theta, case.phi)]
    theta_l, phi_r = math.acos(l[2]), math.atan2(-l[1], -l[0])
    f = case.brdf
    p = case.parameters
    width = min([p[k] for k in ("alpha", "alpha_x", "alpha_y", "m", "m_x", "m_y") if k in p]
                + [math.sqrt(2 / p[k]) for k in ("n", "n_u", "n_v") if k in p])
    lo, hi = math.asinh(-theta_l / width), math.asinh((math.pi / 2 - theta_l) / width)
    width_phi = 2 * width * max(l[2], 1e-3)
    end = math.asinh(math.pi / width_phi)
    total = 0.0
    for i in range(theta_cells):
        w = (i + 0.5) / theta_cells
        s, ds = w * w * w * (10 - 15 * w + 6 * w * w), 30 * w * w * (1 - w) * (1 - w)
        u = lo + (hi - lo) * s
        theta = theta_l + width * math.sinh(u)
        jac = (hi - lo) * ds * width * math.cosh(u) / theta_cells * math.sin(theta) * math.cos(theta)
        for j in range(phi_cells):
            t = -end + 2 * end * (j + 0.5) / phi_cells
            phi = phi_r + width_phi * math.sinh(t)
            v = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
            total += f(l, v) * jac * width_phi * math.cosh(t) * 2 * end / phi_cells
    return total


def crude_check(case):
    """Runs crude() with the formulas' mp functions replaced by those of double precision."""
    global mp, mpf
    saved = mp, mpf
    mp, mpf = fp, float
    try:
        rebuilt = next(c for c in cases() if (c.model, c.parameters, c.theta, c.phi) ==
                       (case.model, case.parameters, case.theta, case.phi))
        return crude(rebuilt)
    finally:
        mp, mpf = saved


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only")
    arguments = parser.parse_args()
    rows, start = [], time.time()
    for case in cases():
        if arguments.only and case.model != arguments.only:
            continue
        began = time.time()
        light = direction(case.theta, case.phi)
        low, high = (case.integrate(light, count) for count in case.orders)
        difference = abs(high - low) / abs(high)
        digits = min(24, int(-mp.log10(difference)) - 1 if difference else 24)
        value = mp.nstr(high, max(digits, 1), strip_zeros=False)
        print("%-18s %-62s %6s %3s  %-28s %2d digits %5.1f s" % (
            case.model, json.dumps(case.parameters), case.theta, case.phi, value, digits, time.time() - began),
            end="", file=sys.stderr)
        if arguments.check:
            print("  crude %+.1e" % float((mpf(crude_check(case)) - high) / high), end="", file=sys.stderr)
        print(file=sys.stderr, flush=True)
        rows.append({"model": case.model, "parameters": case.parameters, "theta_deg": float(case.theta),
                     "phi_deg": float(case.phi), "albedo": value, "digits": digits, "source": case.source})
    print("%d cases, %.0f s" % (len(rows), time.time() - start), file=sys.stderr)
    if not arguments.only:
        with open(os.path.join(HERE, "independent.json"), "w") as out:
            out.write("[\n" + ",\n".join(json.dumps(r) for r in rows) + "\n]\n")


if __name__ == "__main__":
    main()
