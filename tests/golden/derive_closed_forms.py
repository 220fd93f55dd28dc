#!/usr/bin/env python3
"""Derives closed_forms.json: directional albedos that have a closed form or a one-dimensional integral, to 30 digits.

Each formula is derived in the comment above it, evaluated in 50-digit arithmetic, and checked in this script against a
different computation: another closed form or the 1-D integral (25 digits), or the two-dimensional integral of the BRDF
written from plain vectors (20 digits). A failed check stops the script and nothing is written.

Notation: c = cos(theta_L), s = sin(theta_L), x = N.V, t = tan^2(theta_H), mu = m^2.
At normal incidence with t = tan^2(theta_H): N.H = L.H = (1+t)^(-1/2), N.V = (1-t)/(1+t), V above the horizon is t < 1,
dV = 4 (L.H) dH and dH = pi (1+t)^(-3/2) dt for an isotropic lobe.
"""

import json
import os
import sys
import time

from mpmath import mp, mpf

import derive_independent as vectors
from quadrature import Lobe, direction, half_vector_albedo, hemisphere_albedo

mp.dps = 50
HERE = os.path.dirname(os.path.abspath(__file__))
ANGLES = ("0", "30", "60", "80", "89", "89.9")
rows, checks = [], 0


def num(x):
    return mpf(str(x))


def add(model, parameters, theta, value, source, phi="0"):
    rows.append({"model": model, "parameters": parameters, "theta_deg": float(theta), "phi_deg": float(phi),
                 "albedo": mp.nstr(mpf(value), 30, strip_zeros=False), "source": source})


def check(what, a, b, digits):
    """Stops unless a and b agree to that many digits."""
    global checks
    error = abs(a - b) / max(abs(b), mpf(10) ** -40)
    checks += 1
    if not error < mpf(10) ** -digits:
        raise SystemExit("%s: %s against %s, relative difference %s" % (what, mp.nstr(a, 30), mp.nstr(b, 30),
                                                                         mp.nstr(error, 3)))


def cosines(theta):
    if theta == "90":
        return mpf(0), mpf(1)
    angle = mp.radians(num(theta))
    return mp.cos(angle), mp.sin(angle)


def check_lobe(what, value, brdf, theta, lobe, phi="0", count=26, isotropic=True, digits=20):
    with mp.workdps(34):
        check(what, half_vector_albedo(brdf, direction(theta, phi), lobe, count, isotropic), value, digits)


# ---- Lambert ---------------------------------------------------------------------------------------------------------

def lambert():
    for rho in ("0.18", "0.5", "1"):
        for theta in ("0", "60", "89.9", "90"):
            add("lambert", {"rho": float(rho)}, theta, num(rho), "a = rho: integral of rho/pi cos over the hemisphere")


# ---- Phong and its kin -----------------------------------------------------------------------------------------------
# Write V by its component u across the plane of R and N and the angle psi from R in that plane, r = sqrt(1-u^2):
# dV = du dpsi, R.V = r cos(psi), N.V = r cos(psi - theta), where theta is the angle between R and N, so the integral is
# a product:  a = (n+2)/(2 pi) * int_-1^1 r^(n+1) du * K,   K = int_{theta-pi/2}^{pi/2} cos^n(psi) cos(psi - theta) dpsi
# = c C_{n+1} + s^(n+2)/(n+1),   C_k = int_{theta-pi/2}^{pi/2} cos^k, which obeys
# C_k = (s^(k-1) c + (k-1) C_{k-2})/k,  C_0 = pi - theta,  C_1 = 1 + c:  elementary for every whole n.

def cosine_power_integral(k, theta_rad):
    c, s = mp.cos(theta_rad), mp.sin(theta_rad)
    value = mp.pi - theta_rad if k % 2 == 0 else 1 + c
    for j in range(2 + k % 2, k + 1, 2):
        value = (s ** (j - 1) * c + (j - 1) * value) / j
    return value


def phong_recurrence(n, theta_rad):
    c, s = mp.cos(theta_rad), mp.sin(theta_rad)
    across = mp.sqrt(mp.pi) * mp.gamma(mpf(n + 3) / 2) / mp.gamma(mpf(n) / 2 + 2)
    return (n + 2) / (2 * mp.pi) * across * (c * cosine_power_integral(n + 1, theta_rad) + s ** (n + 2) / (n + 1))


def phong_beta(n, c, s):
    """The same with C_k by the regularised incomplete beta function; any real n > 0, axis above the horizon."""
    ratio = mp.exp(mp.loggamma((n + 1) / 2) - mp.loggamma(n / 2 + 1)) / (2 * mp.sqrt(mp.pi))
    tail = mp.betainc(n / 2 + 1, mpf(1) / 2, 0, s * s, regularized=True) / 2
    return c * (1 - tail) + s ** (n + 2) * ratio


def phong_at_90(n):
    return mp.exp(mp.loggamma((n + 1) / 2) - mp.loggamma(n / 2 + 1)) / (2 * mp.sqrt(mp.pi))


def phong():
    source = ("a = (n+2)/(2 sqrt(pi)) G((n+3)/2)/G(n/2+2) (c C_{n+1} + s^(n+2)/(n+1)), "
              "C_k = (s^(k-1) c + (k-1) C_{k-2})/k, C_0 = pi - theta, C_1 = 1 + c; "
              "the integral factorises in (component across the R,N plane, angle in it)")
    source_90 = "a(90) = G((n+1)/2) / (2 sqrt(pi) G(n/2+1)): the same at s = 1, c = 0"
    for n in (1, 2, 5, 20, 50, 150):
        for theta in ANGLES:
            c, s = cosines(theta)
            value = phong_recurrence(n, mp.radians(num(theta)))
            check("phong n=%d theta=%s by the beta form" % (n, theta), phong_beta(mpf(n), c, s), value, 40)
            add("phong", {"n": n}, theta, value, source)
        check("phong n=%d at 90" % n, phong_recurrence(n, mp.pi / 2), phong_at_90(mpf(n)), 40)
        add("phong", {"n": n}, "90", phong_at_90(mpf(n)), source_90)
    for n, theta in (("0.5", "60"), ("2.5", "80"), ("1000.5", "85"), ("1000000", "60"), ("1000000", "89.9")):
        c, s = cosines(theta)
        add("phong", {"n": float(n)}, theta, phong_beta(num(n), c, s),
            "a = c (1 - I_{s^2}(n/2+1, 1/2)/2) + s^(n+2) G((n+1)/2) / (2 sqrt(pi) G(n/2+1)), I the regularised "
            "incomplete beta function; real n, from the same factorisation")
    with mp.workdps(34):
        options = vectors.around(-1, -1, 1)
        for n, theta in ((1, "30"), (2, "80"), (5, "60"), (20, "60"), (50, "30"), (150, "89")):
            light = direction(theta)
            value = hemisphere_albedo(vectors.mirror_phong(mpf(n), "phong"), light, 44, **options(light))
            check("phong n=%d theta=%s by 2-D quadrature" % (n, theta), value,
                  phong_recurrence(n, mp.radians(num(theta))), 25 if n > 2 else 15)


def phong_kin():
    for theta in ("0", "45", "75"):
        value = mpf(21) / 22 * phong_recurrence(20, mp.radians(num(theta))) / cosines(theta)[0]
        add("phong_original", {"n": 20}, theta, value,
            "a = (n+1)/(n+2) a_phong / cos(theta_L), L fixed: f differs from phong by (n+1)/(n+2) / N.L only")
    for n in (1, 20, 150):
        # max(N.L, N.V) = 1 at normal incidence; at grazing it is N.V, which leaves half the lobe: pi/(n+1).
        add("neumann_phong", {"n": n}, "0", 1, "a(0) = 1: max(N.L, N.V) = 1, then (n+2) int x^(n+1) dx")
        add("neumann_phong", {"n": n}, "90", mpf(n + 2) / (2 * (n + 1)),
            "a(90) = (n+2)/(2(n+1)): max = N.V cancels the cosine, half of the lobe's volume 2 pi/(n+1) is above "
            "the horizon")
    for (cx, cy, cz, n), theta, phi in (((-1, -0.8, 0.5, 5), "50", "20"), ((-1, -1, 1, 20), "60", "0"),
                                        ((1, 1, 1, 10), "30", "0"), ((-0.5, -0.5, 1, 50), "80", "0")):
        l = direction(theta, phi)
        w = (num(cx) * l[0], num(cy) * l[1], num(cz) * l[2])
        length = mp.sqrt(sum(k * k for k in w))
        value = (length / max(abs(num(k)) for k in (cx, cy, cz))) ** n * phong_recurrence(n, mp.acos(w[2] / length))
        add("lafortune", {"c_x": cx, "c_y": cy, "c_z": cz, "n": n}, theta, value,
            "a = (|w|/max|C|)^n a_phong(angle(w, N)), w = C o L", phi)
        with mp.workdps(34):
            brdf = vectors.lafortune(num(cx), num(cy), num(cz), n)
            check("lafortune by 2-D quadrature",
                  hemisphere_albedo(brdf, l, 44, **vectors.around(num(cx), num(cy), num(cz))(l)), value, 20)


# ---- Blinn -----------------------------------------------------------------------------------------------------------
# Normal incidence: f cos dV = c (N.H)^n (2 x^2 - 1) 4 x 2 pi dx over x = N.H in [1/sqrt 2, 1] = 8 pi c (2^(-n/2) + n) /
# ((n+2)(n+4)) = 1. Grazing: N.V = 2 Hx Hz and dV = 4 Hx dH over Hx > 0: 8 c int Hz^(n+1) Hx^2 = 8 pi c / ((n+2)(n+4)).

def blinn():
    for n in (1, 20, 150, 1000):
        k = (mpf(n) + 2) * (n + 4) / (8 * mp.pi * (mp.power(2, -mpf(n) / 2) + n))
        value = 8 * mp.pi * k * mp.quad(lambda x: x ** (n + 1) * (2 * x * x - 1), mp.linspace(1 / mp.sqrt(2), 1, 9))
        check("blinn n=%d at 0" % n, value, mpf(1), 25)
        add("blinn", {"n": n}, "0", 1, "a(0) = 1 by the constant (n+2)(n+4) / (8 pi (2^(-n/2) + n))")
        at_90 = 1 / (n + mp.power(2, -mpf(n) / 2))
        value = 4 * mp.pi * k * mp.quad(lambda z: z ** (n + 1) * (1 - z * z), mp.linspace(0, 1, 9))
        check("blinn n=%d at 90" % n, value, at_90, 25)
        add("blinn", {"n": n}, "90", at_90,
            "a(90) = 1/(n + 2^(-n/2)): N.V = 2 Hx Hz, dV = 4 Hx dH over the half Hx > 0")


# ---- Ashikhmin-Shirley -----------------------------------------------------------------------------------------------
# Normal incidence: max = 1 and f cos dV = p_h F (2 x^2 - 1) dH, x = N.H. With F = 1 and exponent e along an azimuth,
# g(e) = int_{1/sqrt 2}^1 x^e (2 x^2 - 1) dx = 2 (1 - q^(e+3))/(e+3) - (1 - q^(e+1))/(e+1), q = 1/sqrt 2.
# Grazing: max = N.V cancels the cosine, the horizon is Hx > 0: half of the normalised p_h.

def ashikhmin_shirley():
    q = 1 / mp.sqrt(2)

    def moment(e):
        return 2 * (1 - q ** (e + 3)) / (e + 3) - (1 - q ** (e + 1)) / (e + 1)

    source = "a(0) = (n - 1 + 2^((1-n)/2)) / (n + 3): (n+1) int_{1/sqrt 2}^1 x^n (2 x^2 - 1) dx, x = N.H"
    for n in (1, 10, 100, 1000, 1000000):
        value = (n - 1 + mp.power(2, mpf(1 - n) / 2)) / (n + 3)
        check("ashikhmin_shirley n=%d at 0" % n, (n + 1) * moment(mpf(n)), value, 40)
        add("ashikhmin_shirley", {"n": n}, "0", value, source)
        if n <= 1000:
            numeric = (n + 1) * mp.quad(lambda x: x ** n * (2 * x * x - 1), mp.linspace(q, 1, 9))
            check("ashikhmin_shirley n=%d at 0 by quadrature" % n, numeric, value, 25)
        add("ashikhmin_shirley", {"n": n}, "90", mpf(1) / 2,
            "a(90) = 1/2: max = N.V cancels the cosine, the half Hx > 0 of p_h remains")
        add("ashikhmin_shirley", {"n": n, "normalization": "projected"}, "0", mpf(n + 2) / (n + 1) * value,
            "(n+2)/(n+1) times the paper's normalisation; " + source)
    add("ashikhmin_shirley", {"n_u": 10, "n_v": 1000}, "90", mpf(1) / 2,
        "a(90) = 1/2: max = N.V cancels the cosine, the half Hx > 0 of p_h remains", "30")

    for nu, nv in ((10, 1000), (100, 20)):
        def ring(phi):
            return moment(nu * mp.cos(phi) ** 2 + nv * mp.sin(phi) ** 2)
        value = mp.sqrt(mpf(nu + 1) * (nv + 1)) * 2 / mp.pi * mp.quad(ring, mp.linspace(0, mp.pi / 2, 9))
        for phi in ("0", "25"):
            add("ashikhmin_shirley", {"n_u": nu, "n_v": nv}, "0", value,
                "a(0) = sqrt((nu+1)(nv+1)) / (2 pi) int g(nu cos^2 + nv sin^2) dphi, "
                "g(e) = int_{1/sqrt 2}^1 x^e (2x^2-1) dx in closed form, phi by quadrature", phi)

    for n, r in ((10, "0.05"), (100, "0.5")):
        def fresnel(x):
            return num(r) + (1 - num(r)) * (1 - x) ** 5
        value = (n + 1) * mp.quad(lambda x: x ** n * (2 * x * x - 1) * fresnel(x), mp.linspace(q, 1, 9))
        # (1-x)^5 expanded: a sum of moments
        terms = mp.fsum((-1) ** k * mp.binomial(5, k) * moment(mpf(n + k)) for k in range(6))
        check("ashikhmin_shirley with Schlick", (n + 1) * (num(r) * moment(mpf(n)) + (1 - num(r)) * terms), value, 25)
        add("ashikhmin_shirley", {"n": n, "r_s": float(r)}, "0", value,
            "a(0) = (n+1) int_{1/sqrt 2}^1 x^n (2 x^2 - 1) F(x) dx, Schlick's F, (1-x)^5 expanded into moments")

    # Diffuse term alone (k_s = 0): 28/(23 pi) int (1 - (1-x/2)^5) x dV = 1, so a = r_d (1 - r_s)(1 - (1 - c/2)^5).
    check("28/23", 2 * mp.quad(lambda x: (1 - (1 - x / 2) ** 5) * x, [0, 1]), mpf(23) / 28, 25)
    for theta in ("0", "60", "89.9"):
        c = cosines(theta)[0]
        add("ashikhmin_shirley", {"n": 10, "r_s": 0.05, "r_d": 0.5, "k_s": 0}, theta,
            num("0.5") * num("0.95") * (1 - (1 - c / 2) ** 5),
            "a = r_d (1 - r_s)(1 - (1 - cos/2)^5): eq. 14 integrated, specular term scaled to 0")


# ---- Ward ------------------------------------------------------------------------------------------------------------
# f cos dV = E/(4 pi ax ay) sqrt(N.V) 4 (L.H) dH; isotropic: int_0^1 e^(-t/mu)/mu (1-t)^(1/2) (1+t)^(-5/2) dt.
# Anisotropic: the azimuth of E integrates to a Bessel function, mean of exp(-t (A + B cos 2 phi)) = e^(-tA) I0(tB).

def decade(limit, scale):
    """Break points that resolve a lobe of that scale in [0, limit]."""
    return [mpf(0)] + [k * scale for k in (1, 2, 4, 8, 16, 32, 64, 128) if k * scale < limit] + [mpf(limit)]


def ward():
    for a in ("0.01", "0.05", "0.1", "0.3", "0.5", "1", "2"):
        mu = num(a) ** 2
        value = mp.quad(lambda t: mp.exp(-t / mu) / mu * mp.sqrt(1 - t) * (1 + t) ** mpf(-2.5), decade(1, mu))
        add("ward", {"alpha": float(a)}, "0", value,
            "a(0) = int_0^1 e^(-t/mu)/mu (1-t)^(1/2) (1+t)^(-5/2) dt, t = tan^2 theta_H, mu = alpha^2, 1-D quadrature")
        if a in ("0.1", "0.5", "2"):
            check_lobe("ward alpha=%s at 0 by 2-D quadrature" % a, value, vectors.ward(num(a), num(a)), "0",
                       Lobe(num(a)))
    for ax, ay in (("0.3", "0.05"), ("0.5", "0.2")):
        p, q = num(ax) ** -2, num(ay) ** -2
        big, small = (p + q) / 2, (q - p) / 2
        value = mp.quad(lambda t: mp.exp(-t * big) * mp.besseli(0, t * small) * mp.sqrt(1 - t) * (1 + t) ** mpf(-2.5),
                        decade(1, 1 / q)) / (num(ax) * num(ay))
        check_lobe("anisotropic ward at 0 by 2-D quadrature", value, vectors.ward(num(ax), num(ay)), "0",
                   Lobe(num(ax), num(ay)), isotropic=False, digits=15)
        add("ward", {"alpha_x": float(ax), "alpha_y": float(ay)}, "0", value,
            "a(0) = 1/(ax ay) int_0^1 e^(-tA) I0(tB) (1-t)^(1/2) (1+t)^(-5/2) dt, A, B = (1/ax^2 +- 1/ay^2)/2, "
            "1-D quadrature")


# ---- Cook-Torrance ---------------------------------------------------------------------------------------------------
# f cos dV = D (N.H) G dH = e^(-t/mu)/mu G dt, G = min(1, 2 N.V) = 1 for t < 1/3, 2 (1-t)/(1+t) beyond.
# Grazing with V-cavities: for Hx > 0 the L side decides, G = 2 (N.H)(N.L)/(L.H), and f cos dV = 2 D (N.H) dH on half of
# the normalised hemisphere: the limit is 1 for every m. Without G it diverges like 1/N.L.

def cook_torrance():
    for m in ("0.1", "0.3", "0.5", "1", "2"):
        mu = num(m) ** 2
        closed = (1 - mp.exp(-1 / (3 * mu)) + 4 / mu * mp.exp(1 / mu) * (mp.e1(4 / (3 * mu)) - mp.e1(2 / mu))
                  - 2 * (mp.exp(-1 / (3 * mu)) - mp.exp(-1 / mu)))
        numeric = (mp.quad(lambda t: mp.exp(-t / mu) / mu, decade(mpf(1) / 3, mu)) + mp.quad(
            lambda t: mp.exp(-t / mu) / mu * 2 * (1 - t) / (1 + t), mp.linspace(mpf(1) / 3, 1, 5)))
        check("cook_torrance m=%s at 0" % m, numeric, closed, 25)
        if m in ("0.3", "1"):
            check_lobe("cook_torrance m=%s at 0 by 2-D quadrature" % m, closed,
                       vectors.cook_torrance(num(m), "v_cavity"), "0",
                       Lobe(num(m), inner=lambda y, l: [k * mp.sqrt(mpf(1) / 3 - y * y) for k in (-1, 1)]
                            if 3 * y * y < 1 else [], outer=lambda l: [1 / mp.sqrt(mpf(3))]), count=36)
        add("cook_torrance", {"m": float(m), "masking": "v_cavity"}, "0", closed,
            "a(0) = 1 - 3 e^(-1/(3 mu)) + 2 e^(-1/mu) + (4/mu) e^(1/mu) (E1(4/(3 mu)) - E1(2/mu)), mu = m^2: "
            "int_0^1 e^(-t/mu)/mu min(1, 2(1-t)/(1+t)) dt")
        add("cook_torrance", {"m": float(m), "masking": "none"}, "0", 1 - mp.exp(-1 / mu), "a(0) = 1 - e^(-1/m^2)")
        add("cook_torrance", {"m": float(m), "masking": "v_cavity"}, "90", 1,
            "a(90) = 1: the L side of G leaves 2 D (N.H) dH over the half Hx > 0")
        f = lambda t: num("0.04") + num("0.96") * (1 - 1 / mp.sqrt(1 + t)) ** 5
        value = (mp.quad(lambda t: mp.exp(-t / mu) / mu * f(t), decade(mpf(1) / 3, mu)) + mp.quad(
            lambda t: mp.exp(-t / mu) / mu * f(t) * 2 * (1 - t) / (1 + t), mp.linspace(mpf(1) / 3, 1, 5)))
        add("cook_torrance", {"m": float(m), "f0": 0.04, "masking": "v_cavity"}, "0", value,
            "a(0) = int_0^1 e^(-t/mu)/mu min(1, 2(1-t)/(1+t)) F dt, Schlick's F at cos = (1+t)^(-1/2), 1-D quadrature")


# ---- Kurt ------------------------------------------------------------------------------------------------------------
# f cos dV = D (N.V)^(1-e) dH (eq. 10); eq. 9 has max = 1, which is e = 0:
# int_0^1 e^(-t/mu)/mu (1-t)^(1-e) (1+t)^(e-1/2) dt.
# e = 0: (1-t)(1+t)^(-1/2) = 2 (1+t)^(-1/2) - (1+t)^(1/2), incomplete gammas. e = 1/2: (1-t)^(1/2), Kummer's function.
# Grazing: eq. 9 leaves D dH over the half Hx > 0, int e^(-t/mu)/mu (1+t)^(1/2) dt / 2; eq. 10 with e = 0 leaves
# D 2 Hx Hz dH, (2/pi) int e^(-t/mu)/mu (t/(1+t))^(1/2) dt.

def kurt():
    for m in ("0.1", "0.2", "0.5", "1", "2"):
        mu = num(m) ** 2
        z = 1 / mu

        def at_0(e):
            return mp.quad(lambda t: mp.exp(-t * z) * z * (1 - t) ** (1 - e) * (1 + t) ** (e - mpf(1) / 2),
                           decade(1, mu))

        def part(a):
            # int_0^1 z e^(-tz) (1+t)^a dt
            return mp.exp(z) * z ** -a * (mp.gammainc(a + 1, z) - mp.gammainc(a + 1, 2 * z))
        half = mpf(1) / 2
        closed_0 = 2 * part(-half) - part(half)
        check("kurt m=%s exponent 0" % m, at_0(mpf(0)), closed_0, 25)
        closed_half = z * mp.beta(1, mpf(3) / 2) * mp.hyp1f1(1, mpf(5) / 2, -z)
        check("kurt m=%s exponent 1/2" % m, at_0(half), closed_half, 25)
        if m == "0.5":
            check_lobe("kurt eq. 9 at 0 by 2-D quadrature", closed_0, vectors.kurt(num(m), num(m), 9), "0",
                       Lobe(num(m)))
            check_lobe("kurt eq. 10 at 0 by 2-D quadrature", closed_half, vectors.kurt(num(m), num(m), 10, half), "0",
                       Lobe(num(m)))
        source = ("a(0) = z (2 P(-1/2) - P(1/2)), P(a) = int_0^1 e^(-tz) (1+t)^a dt by incomplete gammas, z = 1/m^2: "
                  "z int_0^1 e^(-tz) (1-t)(1+t)^(-1/2) dt")
        add("kurt", {"m": float(m), "equation": 9}, "0", closed_0, source)
        add("kurt", {"m": float(m), "equation": 10, "exponent": 0}, "0", closed_0, source)
        add("kurt", {"m": float(m), "equation": 10, "exponent": 0.5}, "0", closed_half,
            "a(0) = (2z/3) 1F1(1; 5/2; -z), z = 1/m^2: z int_0^1 e^(-tz) (1-t)^(1/2) dt")
        limit = mp.exp(z) / mp.sqrt(z) * mp.gammainc(mpf(3) / 2, z) / 2
        check("kurt eq. 9 m=%s at 90" % m, mp.quad(lambda t: z * mp.exp(-t * z) * mp.sqrt(1 + t) / 2,
                                                   decade(200 * mu, mu) + [mp.inf]), limit, 25)
        add("kurt", {"m": float(m), "equation": 9}, "90", limit,
            "a(90) = e^z z^(-1/2) Gamma(3/2, z) / 2, z = 1/m^2: max = N.V cancels the cosine, "
            "D dH over the half Hx > 0")
        limit = z * mp.gamma(mpf(3) / 2) * mp.hyperu(mpf(3) / 2, 2, z) * 2 / mp.pi
        check("kurt eq. 10 m=%s at 90" % m, 2 / mp.pi * mp.quad(lambda t: z * mp.exp(-t * z) * mp.sqrt(t / (1 + t)),
                                                                decade(200 * mu, mu) + [mp.inf]), limit, 20)
        add("kurt", {"m": float(m), "equation": 10, "exponent": 0}, "90", limit,
            "a(90) = z U(3/2, 2, z) / sqrt(pi), z = 1/m^2: N.V = 2 Hx Hz, D 2 Hx Hz dH over the half Hx > 0")


# ---- GGX -------------------------------------------------------------------------------------------------------------
# alpha = 1: D = 1/pi, Lambda = (1/x - 1)/2, so f = 1/(2 pi (c+x)) with correlated and 1/(pi (1+c)(1+x)) with separable
# masking: functions of the cosines alone, a = 2 pi int_0^1 f x dx:
#   correlated  a = int x/(c+x) dx = 1 - c ln((1+c)/c);     separable  a = 2/(1+c) int x/(1+x) dx = 2 (1 - ln 2)/(1+c).
# Normal incidence, a = alpha^2: both maskings agree (Lambda_L = 0), f cos dV = D (N.H) G1(V) dH:
#   int_0^1 a/(a+t)^2 2 (1-t) / ((1-t) + sqrt((1-t)^2 + 4 a t)) dt, and the antiderivative below.
# Grazing, correlated: Lambda_L dominates, what remains is the projected area over itself: 1 for every alpha.

def ggx_normal_closed(alpha):
    a = alpha * alpha
    b, q = 2 * a - 1, mp.sqrt((1 - a) * (1 + 3 * a))

    def antiderivative(t):
        r = mp.sqrt(t * t + 2 * b * t + 1)
        l = mp.log(t + b + r)
        j = -mp.log((q * q + (a - 1) * (t + a) + q * r) / (t + a)) / q
        i1 = r + b * l - mp.log(1 + b * t + r)
        i2 = r + (a - 1) * l + q * q * j
        i3 = -r / (t + a) + l + (a - 1) * j
        rest = (1 - 1 / (a * a)) * mp.log(t + a) + (1 + a) ** 2 / (a * (t + a))
        return (i1 / a ** 2 - i2 / a ** 2 - (1 + a) / a * i3 - rest) / 2
    return antiderivative(mpf(1)) - antiderivative(mpf(0))


def ggx():
    for masking in ("correlated", "separable"):
        for theta in ANGLES + ("90",):
            c = cosines(theta)[0]
            if masking == "correlated":
                value = 1 - c * mp.log((1 + c) / c) if c else mpf(1)
                source = "a = 1 - c ln((1+c)/c): f = 1/(2 pi (N.L + N.V)) at alpha = 1"
            else:
                value = 2 * (1 - mp.log(2)) / (1 + c)
                source = "a = 2 (1 - ln 2)/(1 + c): f = 1/(pi (1 + N.L)(1 + N.V)) at alpha = 1"
            if c:
                brdf = vectors.ggx(mpf(1), mpf(1), masking)
                light = direction(theta)
                # f does not depend on the azimuth; an arbitrary one shows the vector form agrees with the reduction.
                view = lambda x: (mp.sqrt(1 - x * x) * mp.cos(1), mp.sqrt(1 - x * x) * mp.sin(1), x)
                numeric = 2 * mp.pi * mp.quad(lambda x: brdf(light, view(x)) * x,
                                              sorted({mpf(0), c / 100, c / 10, c, mpf(1)}))
                check("ggx alpha=1 %s %s" % (masking, theta), numeric, value, 25)
            add("ggx", {"alpha": 1, "masking": masking}, theta, value, source)

    def at_0(a, fresnel=lambda t: 1):
        return mp.quad(lambda t: fresnel(t) * a / (a + t) ** 2 * 2 * (1 - t)
                       / ((1 - t) + mp.sqrt((1 - t) ** 2 + 4 * a * t)), decade(1, a))

    for alpha in ("0.01", "0.1", "0.3", "0.5", "0.8"):
        with mp.workdps(90):
            closed = ggx_normal_closed(num(alpha))
        check("ggx alpha=%s at 0" % alpha, at_0(num(alpha) ** 2), closed, 25)
        for masking in ("correlated", "separable"):
            add("ggx", {"alpha": float(alpha), "masking": masking}, "0", closed,
                "a(0) = int_0^1 a/(a+t)^2 2(1-t)/((1-t) + sqrt((1-t)^2 + 4at)) dt, a = alpha^2, by its antiderivative "
                "in 90-digit arithmetic; both maskings agree")
    check_lobe("ggx alpha=0.5 at 0 by 2-D quadrature", closed_at("ggx", 0.5),
               vectors.ggx(num("0.5"), num("0.5"), "separable"), "0",
               Lobe(num("0.5"), gaussian=False, step="0.5"), count=34)
    for alpha in ("0.1", "0.5"):
        value = at_0(num(alpha) ** 2, lambda t: num("0.04") + num("0.96") * (1 - 1 / mp.sqrt(1 + t)) ** 5)
        add("ggx", {"alpha": float(alpha), "f0": 0.04, "masking": "correlated"}, "0", value,
            "the integral of F = 1 with Schlick's F at cos = (1+t)^(-1/2), 1-D quadrature")
        add("ggx", {"alpha": float(alpha), "masking": "correlated"}, "90", 1,
            "a(90) = 1 for every alpha: G2 -> 1/Lambda_L, and the integral of D (L.H)+ is Lambda_L N.L")


def closed_at(model, alpha):
    return next(mpf(r["albedo"]) for r in rows if r["model"] == model and r["parameters"]["alpha"] == alpha
                and r["theta_deg"] == 0)


def main():
    start = time.time()
    for part in (lambert, phong, phong_kin, blinn, ashikhmin_shirley, ward, cook_torrance, kurt, ggx):
        began = time.time()
        part()
        print("%-18s %5.1f s" % (part.__name__, time.time() - began), file=sys.stderr)
    with open(os.path.join(HERE, "closed_forms.json"), "w") as out:
        out.write("[\n" + ",\n".join(json.dumps(r) for r in rows) + "\n]\n")
    print("%d values, %d checks passed, %.0f s" % (len(rows), checks, time.time() - start), file=sys.stderr)


if __name__ == "__main__":
    main()
