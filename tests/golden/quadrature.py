"""Quadrature shared by the two scripts that derive the golden values; standard library and mpmath only.

Nothing here knows how albedo integrates: half-vector models are integrated in Cartesian slopes (x, y) of the half
vector, y outside and x inside, everything else in spherical coordinates of V. Both hand plain vectors L and V to
a BRDF.
"""

from functools import lru_cache

from mpmath import mp, mpf


@lru_cache(maxsize=None)
def _gauss_legendre(count, digits):
    nodes = []
    for i in range(1, count + 1):
        x = mp.cos(mp.pi * (i - mpf(1) / 4) / (count + mpf(1) / 2))
        for _ in range(100):
            p0, p1 = mpf(1), x
            for k in range(2, count + 1):
                p0, p1 = p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k
            slope = count * (x * p1 - p0) / (x * x - 1)
            step = p1 / slope
            x -= step
            if abs(step) < mpf(10) ** (5 - mp.dps):
                break
        nodes.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return tuple(reversed(nodes))


def gauss_legendre(count):
    """Nodes and weights of the Gauss-Legendre rule on [0, 1] at the working precision."""
    return _gauss_legendre(count, mp.dps)


@lru_cache(maxsize=None)
def _graded(count, left, right, digits):
    """The rule after u = w^left (towards 0), u = 1 - (1-w)^right (towards 1), or both (split at 1/2)."""
    base = gauss_legendre(count)
    if left > 1 and right > 1:
        half = mpf(1) / 2
        low = [(half * u, half * w) for u, w in _graded(count, left, 1, digits)]
        high = [(half + half * u, half * w) for u, w in _graded(count, 1, right, digits)]
        return tuple(low + high)
    if left > 1:
        return tuple((u ** left, left * u ** (left - 1) * w) for u, w in base)
    if right > 1:
        return tuple((1 - (1 - u) ** right, right * (1 - u) ** (right - 1) * w) for u, w in base)
    return base


def integrate(f, a, b, count, left=1, right=1):
    """Integral of f over [a, b]; left and right are the powers that grade the nodes towards a singular end."""
    length = b - a
    return length * mp.fsum(w * f(a + length * u) for u, w in _graded(count, left, right, mp.dps))


def panels(points, width):
    """Cuts [points[0], points[-1]] at every point and then into pieces no longer than width."""
    edges = [points[0]]
    for p in points[1:]:
        pieces = max(1, int(mp.ceil((p - edges[-1]) / width)))
        start = edges[-1]
        edges += [start + (p - start) * k / pieces for k in range(1, pieces + 1)]
    return edges


def between(low, high, candidates):
    """low, then the candidates strictly inside, sorted, then high."""
    tiny = (high - low) * mpf(10) ** (-15)
    inside = []
    for c in sorted(candidates):
        if low + tiny < c < high - tiny and (not inside or c - inside[-1] > tiny):
            inside.append(c)
    return [low] + inside + [high]


def direction(theta_deg, phi_deg=0):
    """Unit vector of decimal degrees, exact to the working precision."""
    theta, phi = mp.radians(mpf(str(theta_deg))), mp.radians(mpf(str(phi_deg)))
    return (mp.sin(theta) * mp.cos(phi), mp.sin(theta) * mp.sin(phi), mp.cos(theta))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


class Lobe:
    """Where a half-vector model has its mass in slope space, and where its formula has kinks.

    width_x, width_y   length scales of the lobe along the material axes
    gaussian           True: cut at 8.3 widths, equal panels; False: algebraic tails, panels equal in asinh(slope/width)
    cut                slope beyond which the lobe is below 1e-28 of its peak (algebraic lobes with a large exponent)
    edge_power         the grading at the horizon: 2 for half-integer powers of cos(theta_V), more for others
    step               the longest panel, in widths or in asinh(slope/width)
    inner(y, L)        slopes x at which the integrand along the line y has a kink
    outer(L)           slopes y at which those kinks appear, vanish or cross
    """

    def __init__(self, width_x, width_y=None, gaussian=True, cut=None, edge_power=2, step=None, inner=None,
                 outer=None):
        self.width_x = mpf(width_x)
        self.width_y = mpf(width_y if width_y is not None else width_x)
        self.gaussian = gaussian
        self.cut = cut
        self.edge_power = edge_power
        self.step = mpf(step) if step else mpf(2) if gaussian else mpf("0.9")
        self.inner = inner or (lambda y, light: [])
        self.outer = outer or (lambda light: [])


def half_vector_albedo(brdf, light, lobe, count, symmetric):
    """a(L) by iterated Gauss rules over the half vector's slopes (x, y): H ~ (x, y, 1), dV = 4 (L.H) dH,
    dH = (1+x^2+y^2)^(-3/2) dx dy; V is above the horizon inside the circle |slope - tan| = sec."""
    lx, ly, lz = light
    cx, cy, radius = lx / lz, ly / lz, 1 / lz

    def integrand(x, y):
        r2 = 1 + x * x + y * y
        lh = lx * x + ly * y + lz
        k = 2 * lh / r2
        view = (k * x - lx, k * y - ly, k - lz)
        return brdf(light, view) * view[2] * 4 * lh / (r2 * r2)

    def scale_of(width, offset):
        return width if lobe.gaussian else mp.sqrt(width * width + offset * offset)

    def to_panels(low, high, special, width, edges_low, edges_high):
        """Yields (a, b, forward, slope, left, right): panels in the chosen coordinate, with their grading."""
        if lobe.gaussian:
            points = [p / width for p in between(low, high, special)]
            forward, derivative = (lambda v: width * v), (lambda v: width)
        else:
            points = [mp.asinh(p / width) for p in between(low, high, special)]
            forward, derivative = (lambda v: width * mp.sinh(v)), (lambda v: width * mp.cosh(v))
        edges = panels(points, lobe.step)
        for a, b in zip(edges, edges[1:]):
            left = edges_low if a == edges[0] else 1
            right = edges_high if b == edges[-1] else 1
            yield a, b, forward, derivative, left, right

    def reach(width):
        if lobe.gaussian:
            return mpf("8.3") * width
        return lobe.cut if lobe.cut is not None else mp.inf

    def line(y):
        half_chord = mp.sqrt(radius * radius - (y - cy) ** 2)
        low, high = cx - half_chord, cx + half_chord
        limit = reach(lobe.width_x)
        low_edge, high_edge = lobe.edge_power, lobe.edge_power
        if low < -limit:
            low, low_edge = -limit, 1
        if high > limit:
            high, high_edge = limit, 1
        if low >= high:
            return mpf(0)
        offset = y * lobe.width_x / lobe.width_y
        pieces = to_panels(low, high, lobe.inner(y, light), scale_of(lobe.width_x, offset), low_edge, high_edge)
        return mp.fsum(
            integrate(lambda v: integrand(g(v), y) * d(v), a, b, count, left, right)
            for a, b, g, d, left, right in pieces)

    low, high = cy - radius, cy + radius
    limit = reach(lobe.width_y)
    low, high = max(low, -limit), min(high, limit)
    special = list(lobe.outer(light))
    factor = 1
    if symmetric:
        factor, low = 2, mpf(0)
        special = [abs(s) for s in special]
    total = mpf(0)
    cuts = between(low, high, special)
    for a, b in zip(cuts, cuts[1:]):
        # Square-root behaviour in y at the ends of the disk and wherever kinks meet: graded at every special point.
        for p, q, g, d, left, right in to_panels(a, b, [], lobe.width_y, 2, 2):
            total += integrate(lambda v: line(g(v)) * d(v), p, q, count, left, right)
    return factor * total


def hemisphere_albedo(brdf, light, count, theta_breaks=(), phi_axis=0, phi_limit=None):
    """a(L) in spherical coordinates of V; phi runs over [-phi_limit(theta), phi_limit(theta)] around phi_axis."""
    phi_limit = phi_limit or (lambda theta: mp.pi)

    def ring(theta):
        end = phi_limit(theta)
        if end <= 0:
            return mpf(0)
        st, ct = mp.sin(theta), mp.cos(theta)
        edges = panels([-end, mpf(0), end], mp.pi / 6)
        f = lambda phi: brdf(light, (st * mp.cos(phi_axis + phi), st * mp.sin(phi_axis + phi), ct))
        return st * ct * mp.fsum(integrate(f, a, b, count) for a, b in zip(edges, edges[1:]))

    edges = panels(between(mpf(0), mp.pi / 2, list(theta_breaks)), mp.pi / 10)
    return mp.fsum(integrate(ring, a, b, count, 2, 2) for a, b in zip(edges, edges[1:]))
