#!/usr/bin/env python3
"""The verdicts of every family in JAX: the peers that the dense grids are timed against.

Each peer finds the main flags of its family as one would without a proof: in float64, jitted, by closed forms, a fixed
number of Newton's steps, and a look at some points of the curve. Each answers every node of a grid.

    SPIRAL_ATLAS_DENSE=FOLDER cargo bench --bench answers
    families_jax.py FOLDER

The first leaves each family's grid and proved flags in the folder. The second prints for each family both rates and how
many nodes the peer has otherwise. JAX takes all cores and is timed after it has compiled: on the same grid and, since
small arrays cost it calls, on a finer one of the same ranges; the better rate counts.
"""

import functools
import json
import math
import os
import pathlib
import sys
import time
from collections.abc import Callable

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array, lax

jax.config.update("jax_enable_x64", True)

Flags = dict[str, Array]

# Nodes that a peer gets at a time: arrays of so many doubles stay in the cache.
BLOCK = 1 << 15
# Nodes of the finer grid, at least; and rounds, of which the best counts.
FINE = 2_500_000
ROUNDS = 3


def least(quintic: list[Array], places: list[float]) -> Array:
    """The least value of the form `sum c_i s^i`, in Bernstein coefficients by `t = 1/(1+s)`, at some places t in (0, 1)."""
    value = None
    for place in places:
        s, start, end = (1 - place) / place, 0, 5
        if s > 1:
            # From the other end, so that no power grows.
            s, start, end = 1 / s, 5, 0
        step = 1 if start < end else -1
        terms = [math.comb(5, i) * quintic[i] for i in range(start, end + step, step)]
        at = functools.reduce(lambda total, term: total * s + term, reversed(terms))
        value = at if value is None else jnp.minimum(value, at)
    assert value is not None
    return value


def between(count: int) -> list[float]:
    """Places in (0, 1), closer to each other near the ends, as Chebyshev's are."""
    return [0.5 - 0.5 * math.cos(math.pi * (i + 0.5) / count) for i in range(count)]


def rises(quintic: list[Array], count: int) -> Array:
    """Whether a quintic in Bernstein form is nowhere seen negative."""
    return (quintic[0] >= 0) & (quintic[5] >= 0) & (least(quintic, between(count)) >= 0)


def outer(phi0: Array, phi1: Array, kappa0: Array, kappa1: Array) -> Array:
    """Whether any spiral of rising curvature has these ends: Kurnosenko's bound."""
    room0, room1 = jnp.sin(phi0) - kappa0, kappa1 - jnp.sin(phi1)
    return (room0 > 0) & (room1 > 0) & (room0 * room1 > jnp.sin(0.5 * (phi1 - phi0)) ** 2) & (phi0 < phi1)


def cubic_side(x: Array, y: Array, p: Array, g: Array, r: Array) -> list[Array]:
    """Three coefficients of the spiral polynomial at one end, divided by positive factors (Habib & Sakai)."""
    u = 3 - x
    u2, xu, x5 = u * u, x * u, 5 * x - 2
    return [
        2 * p * u2 + g * (2 * xu + y * (3 * x - 10)),
        2 * p * u * (2 * u * (3 + x) + y * (7 * x - 17))
        + g * (2 * xu * (2 * x - 7 * y) + y * y * (22 - 9 * x))
        + 4 * r * u2 * u,
        p * (u * (x * (5 * x + 3) - 6) + y * (x * (10 * x - 32) + 12))
        + g * (x * x * (5 * x - 12) + y * (x * (12 - 10 * x) + y * x5))
        + r * u2 * x5,
    ]


def cubic(phi0: Array, phi1: Array, kappa0: Array, kappa1: Array) -> Flags:
    """Newton's method from three starts on the quartic in f0, then the spiral polynomial at some points."""
    sin0, sin1, total = jnp.sin(phi0), jnp.sin(phi1), jnp.sin(phi0 + phi1)
    g0, g1 = (sin0 / total) ** 2, (sin1 / total) ** 2
    a, k = g1 / sin0 * kappa0, g0 / sin1 * kappa1
    p, r = sin0 * jnp.cos(phi1) / total, jnp.cos(phi0) * sin1 / total

    def judged(start: Array | float) -> Array:
        def step(_: int, x: Array) -> Array:
            y = 3 - a * x * x
            ky = k * y
            return x - (3 - x - ky * y) / (4 * a * x * ky - 1)

        x = lax.fori_loop(0, 9, step, start + 0 * (a * k), unroll=True)
        y = 3 - a * x * x
        root = (x > 0) & (x < 3) & (y > 0) & (y < 3) & (jnp.abs(3 - x - k * y * y) < 1e-4)
        b, c = cubic_side(x, y, p, g0, r), cubic_side(y, x, r, g1, p)
        form = [5 * y * y * b[0], y * b[1], y * b[2], -x * c[2], -x * c[1], -5 * x * x * c[0]]
        return root & rises(form, 20)

    found = judged(0.0) | judged(1 / jnp.sqrt(a)) | judged(3.0)
    return {"SPIRAL": found & outer(phi0, phi1, kappa0, kappa1)}


def ph_quintic(phi0: Array, phi1: Array, kappa0: Array, kappa1: Array) -> Flags:
    """Changes of sign along the ratio of both ends' speeds, Newton's method in two numbers, then the numerator of kappa'."""
    half = 0.5 * (phi0 + phi1)
    sin, c = jnp.sin(half), 2 * jnp.cos(half)
    al, be = kappa0 / (4 * sin), kappa1 / (4 * sin)
    right = [30 * jnp.sin(phi0) / sin, 30 * jnp.sin(phi1) / sin]
    scale = jnp.cbrt(kappa0 / kappa1)

    def sides(t: Array) -> list[list[Array]]:
        """Both left-hand sides as cubics in Z = A^2, where B = t A."""
        t2 = t * t
        t3 = t2 * t
        both = [t, 3 * (al + be * t2 * t2), 4 * al * be * t3]
        start = [3.0 + 0 * t, 3 * be * t3, 2 * (be * t3) ** 2]
        end = [3 * t2, 3 * al * t, 2 * al * al]
        return [[m + c * e for m, e in zip(both, side, strict=True)] for side in (end, start)]

    def value(z: Array, f: list[Array]) -> Array:
        return z * (f[0] + z * (f[1] + z * f[2]))

    def slope(z: Array, f: list[Array]) -> Array:
        return f[0] + z * (2 * f[1] + 3 * z * f[2])

    def level(t: Array, z: Array, steps: int) -> tuple[Array, Array]:
        """Z where both equations hold on the whole, and by how much the first fails there."""
        first, second = sides(t)
        whole = [a + b for a, b in zip(first, second, strict=True)]
        for _ in range(steps):
            z = z - (value(z, whole) - right[0] - right[1]) / slope(z, whole)
        return z, value(z, first) - right[0]

    count = 40
    angles = np.linspace(0, 0.5 * math.pi, count + 2)[1:-1]
    places, shrinks = jnp.tan(angles), jnp.cos(angles[1:]) ** 2 / jnp.cos(angles[:-1]) ** 2

    def scan(carry: tuple[Array, ...], place: tuple[Array, Array]) -> tuple[tuple[Array, ...], None]:
        z, before, last, t0, t1, t2, z0, z1, z2 = carry
        t = place[0] * scale
        # A^2 + B^2 changes little.
        z, off = level(t, z * place[1], 1)
        change = (off > 0) != (before > 0)
        between = last + (t - last) * before / (before - off)
        new = [(t2, t1), (t1, t0), (t0, between), (z2, z1), (z1, z0), (z0, z)]
        t2, t1, t0, z2, z1, z0 = (jnp.where(change, now, old) for old, now in new)
        return (z, off, t, t0, t1, t2, z0, z1, z2), None

    zero = 0 * (al + be)
    first = places[0] * scale
    z, off = level(first, zero + 3, 12)
    found, _ = lax.scan(scan, (z, off, first, *(6 * (zero,))), (places[1:], shrinks), unroll=4)

    def judged(t: Array, z: Array) -> tuple[Array, Array]:
        """Whether there is a solution nearby, and whether it is a spiral."""
        there = t > 0
        for _ in range(5):
            t2 = t * t
            first, second = sides(t)
            # Derivatives by t, term by term.
            both = [1, 12 * be * t2 * t, 12 * al * be * t2]
            start = [0, 9 * be * t2, 12 * be * be * t2 * t2 * t]
            end = [6 * t, 3 * al, 0]
            by0, by1 = ([m + c * e for m, e in zip(both, side, strict=True)] for side in (end, start))
            # In logarithms both are graphs of concave functions.
            f0, f1 = value(z, first), value(z, second)
            a, b = t * value(z, by0) / f0, z * slope(z, first) / f0
            d, e = t * value(z, by1) / f1, z * slope(z, second) / f1
            off0, off1, det = jnp.log(f0 / right[0]), jnp.log(f1 / right[1]), a * e - b * d
            t, z = t * jnp.exp((off1 * b - off0 * e) / det), z * jnp.exp((d * off0 - a * off1) / det)
        there &= jnp.abs(off0) + jnp.abs(off1) < 1e-4
        t2, cos = t * t, 0.5 * c
        u, v = be * t2 * t, al
        cross, square = cos * t, u * (u + 2 * cos * v) + v * v
        speed = [1, z * (u + cos * v), (2 * square * z * z + cross) / 3, z * t * (v + cos * u), t2]
        turn = [2 * v * z, t, 2 * u * t * z]

        def near(h: list[Array], s: list[Array]) -> list[Array]:
            return [
                10 * h[1] * s[0] + 30 * h[0] * s[0] - 40 * h[0] * s[1],
                16 * h[0] * s[1] + 14 * h[1] * s[0] + 2 * h[2] * s[0] - 24 * h[0] * s[2] - 8 * h[1] * s[1],
                6 * h[0] * s[2] + 20 * h[1] * s[1] + 4 * h[2] * s[0] - 12 * h[0] * s[3] - 18 * h[1] * s[2],
            ]

        b, e = near(turn, speed), near(turn[::-1], speed[::-1])
        return there, there & rises([*b, *(-x for x in reversed(e))], 20)

    t0, t1, t2, z0, z1, z2 = found[3:]
    found = [judged(t0, z0), judged(t1, z1), judged(t2, z2)]
    there, spiral = (functools.reduce(jnp.logical_or, flags) for flags in zip(*found, strict=True))
    return {"SOLVABLE": there, "SPIRAL": spiral & outer(phi0, phi1, kappa0, kappa1)}


def any_spiral(alpha: Array, beta: Array, k1: Array, k2: Array) -> Flags:
    """The closed form (Kurnosenko)."""
    omega = 0.5 * (alpha + beta)
    q = (k1 + jnp.sin(alpha)) * (k2 - jnp.sin(beta)) + jnp.sin(omega) ** 2
    return {"EXISTS": (q < 0) & jnp.where(k2 > k1, omega > 0, (k2 < k1) & (omega < 0))}


def reach_cubic(theta: Array, xi: Array, eta: Array) -> Flags:
    """The inverse in closed form, then the spiral polynomial at some points; case 2 is the mirror of case 1."""
    sin, cos = jnp.sin(theta), jnp.cos(theta)

    def judged(a: Array, b: Array) -> Array:
        # The end point of (8) in u = sin(theta) / q.
        u = sin * sin / (3 * a)
        m = 6 * b / (sin * sin) * u * u - 1
        gu = cos * u
        form = [
            4 * u * (3 * cos - (4 + m) * u),
            0.4 * (6 - 2 * (5 - 4 * m) * gu - 10 * m * u * u),
            0.2 * (13 * m - 2 - 4 * m * (4 - m) * gu),
            0.2 * m * (10 * m - 3 - 4 * m * gu),
            m * m * m,
            m * m * m,
        ]
        return (a > 0) & (m > 0) & rises(form, 40)

    h = xi * sin - eta * cos
    return {"CASE1_EXACT": judged(eta, h), "CASE2_EXACT": judged(h, eta)}


def reach_ph(theta: Array, xi: Array, eta: Array) -> Flags:
    """Newton's method kept in a bracket for the shape, then the spiral polynomial at some points."""
    tan = jnp.tan(0.5 * theta)
    g = 1 / (1 + tan * tan)
    unit = 1 / (tan * tan)

    def judged(a: Array, b: Array) -> Array:
        al, be = 60 * unit * a, 120 * unit * b
        # Both shapes positive: u begins where m is 0, and there the equation must still fail.
        low = (12 * g + jnp.sqrt(144 * g * g + 3 * al)) / al

        def equation(u: Array) -> tuple[Array, Array]:
            m, by = u * (al * u - 24 * g) - 3, 2 * al * u - 24 * g
            n = 3 + m
            return 2 * n * u + 2 + 3 * m * (1 + m) - be * u**3, 2 * n + by * (2 * u + 3 + 6 * m) - 3 * be * u * u

        there = (a > 0) & (equation(low)[0] < 0)
        # For large u 3 m^2 outweighs be u^3, from where on Newton's method falls to the last root.
        u = jnp.maximum(2 * low, be / (al * al)) + 24 * g / al
        for _ in range(14):
            f, slope = equation(u)
            u = jnp.maximum(u - f / slope, low)
        m = u * (al * u - 24 * g) - 3
        gu = g * u
        form = [
            16 * gu * (2 - (6 + m) * u),
            3.2 * (1 - (4 - 3 * m) * gu - 7 * m * gu * u),
            0.4 * (9 * m - 2 - 6 * m * (4 - m) * gu),
            0.4 * m * (7 * m - 3 - 6 * m * gu),
            0.2 * m * m * (7 * m - 2),
            m * m * m,
        ]
        return there & (m > 0) & rises(form, 40)

    sin, cos = jnp.sin(theta), jnp.cos(theta)
    h = xi * sin - eta * cos
    return {"CASE1_EXACT": judged(eta, h), "CASE2_EXACT": judged(h, eta)}


def basis(t: float) -> list[np.ndarray]:
    """The rates of the basis (2) of Misro, Ramli & Ali by the angle, first to third: what each side is multiplied with.

    Of the first side and of the last also what p or q adds.
    """

    def times(*factors: tuple[float, float, float]) -> np.ndarray:
        a, a1, a2 = 1.0, 0.0, 0.0
        for b, b1, b2 in factors:
            a, a1, a2 = a * b, a1 * b + a * b1, a2 * b + 2 * a1 * b1 + a * b2
        return np.array([a, a1, a2])

    sine, cosine = math.sin(0.5 * math.pi * t), math.cos(0.5 * math.pi * t)
    s, c = (sine, cosine, -sine), (cosine, -sine, -cosine)
    from_s, from_c = (1 - sine, -cosine, sine), (1 - cosine, sine, cosine)
    over = (sine + cosine - 1, cosine - sine, -sine - cosine)
    whole = (16 * (sine + cosine) + 18, 16 * (cosine - sine), -16 * (sine + cosine))
    first, last = times(c, *3 * [from_s]), times(s, *3 * [from_c])
    return [
        4 * first,
        first - 5 * times(c, s, *3 * [from_s]),
        12 * times(s, c, from_s, from_s),
        times(from_s, from_c, over, whole),
        12 * times(s, c, from_c, from_c),
        4 * last,
        last - 5 * times(s, c, *3 * [from_c]),
    ]


def trig_quintic(ratio: Array, theta: Array, m: Array, p: Array, q: Array) -> Flags:
    """The sign of kappa' at some points."""
    tan = jnp.tan(0.5 * theta)
    y = 0.25 * ratio * (1 + tan * tan)
    # The sides of the control polygon (9), upwards in units of tan(theta/2).
    s0, s1 = 3 * m * m * y * y, 3 * m * y * y
    forward = [y * (2 * y + m), 3 * y, 3 * (1 - tan * tan)]
    upward = [m * y, 3 * y, 6.0]
    square = tan * tan
    # The curvature starts level; places begin where it has left 0.
    places = np.linspace(0, 1, 121)[1:]
    table = jnp.array(np.array([basis(t) for t in places]).transpose(0, 2, 1))

    def look(seen: Array, rates: Array) -> tuple[Array, None]:
        x, h = [], []
        for r in rates:
            end = r[5] + q * r[6]
            x.append(s0 * (r[0] + p * r[1]) + s1 * r[2] + forward[0] * r[3] + forward[1] * r[4] + forward[2] * end)
            h.append(upward[0] * r[3] + upward[1] * r[4] + upward[2] * end)
        turn, change = x[0] * h[1] - x[1] * h[0], x[0] * h[2] - x[2] * h[0]
        speed, gain = x[0] * x[0] + square * h[0] * h[0], x[0] * x[1] + square * h[0] * h[1]
        return seen & (change * speed >= 3 * turn * gain), None

    shape = jnp.broadcast_shapes(*(v.shape for v in (ratio, theta, m, p, q)))
    return {"SPIRAL": lax.scan(look, jnp.ones(shape, bool), table, unroll=4)[0]}


Complex = tuple[Array, Array]


def dot(a: Complex, b: Complex) -> Array:
    """`Re(conj(a) b)`."""
    return a[0] * b[0] + a[1] * b[1]


def cross(a: Complex, b: Complex) -> Array:
    """`Im(conj(a) b)`."""
    return a[0] * b[1] - a[1] * b[0]


def bending(w0: Complex, w1: Complex, w2: Complex) -> tuple[Array, Array, Array]:
    """The greatest curvature of a PH quintic, the greater one of its ends, and whether it turns one way."""
    h = [4 * cross(w0, w1), 2 * cross(w0, w2), 4 * cross(w1, w2)]
    s = [dot(w0, w0), 4 * dot(w0, w1), 4 * dot(w1, w1) + 2 * dot(w0, w2), 4 * dot(w1, w2), dot(w2, w2)]
    ends = jnp.maximum(jnp.abs(h[0]) / s[0] ** 2, jnp.abs(h[2]) / s[4] ** 2)

    count = 64
    places = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, count) / count)

    def turned(t: Array, u: Array) -> Array:
        return u * (u * h[0] + 2 * t * h[1]) + t * t * h[2]

    def speed(t: Array, u: Array) -> Array:
        t2, u2 = t * t, u * u
        return u2 * (u2 * s[0] + u * t * s[1] + t2 * s[2]) + t2 * (u * t * s[3] + t2 * s[4])

    def look(carry: tuple[Array, Array], t: Array) -> tuple[tuple[Array, Array], None]:
        most, at = carry
        value = jnp.abs(turned(t, 1 - t)) / speed(t, 1 - t) ** 2
        return (jnp.maximum(value, most), jnp.where(value > most, t, at)), None

    most, at = lax.scan(look, (ends, 0 * ends + 0.5), jnp.array(places), unroll=4)[0]
    # Newton's method on kappa' = 0 from there, on the polynomials' coefficients by powers.
    a = [h[0], 2 * (h[1] - h[0]), h[0] - 2 * h[1] + h[2]]
    b = [
        s[0],
        s[1] - 4 * s[0],
        6 * s[0] - 3 * s[1] + s[2],
        3 * s[1] - 4 * s[0] - 2 * s[2] + s[3],
        s[0] - s[1] + s[2] - s[3] + s[4],
    ]
    for _ in range(3):
        k, k1, k2 = a[0] + at * (a[1] + at * a[2]), a[1] + 2 * at * a[2], 2 * a[2]
        v = b[0] + at * (b[1] + at * (b[2] + at * (b[3] + at * b[4])))
        v1 = b[1] + at * (2 * b[2] + at * (3 * b[3] + at * 4 * b[4]))
        v2 = 2 * b[2] + at * (6 * b[3] + at * 12 * b[4])
        f, slope = k1 * v - 2 * k * v1, k2 * v - k1 * v1 - 2 * k * v2
        at = jnp.clip(at - f / slope, 0, 1)
    peak = jnp.abs(turned(at, 1 - at)) / speed(at, 1 - at) ** 2
    most = jnp.where(peak > most, peak, most)
    one_way = (h[0] * h[2] >= 0) & ((h[1] * (h[0] + h[2]) >= 0) | (h[1] * h[1] <= h[0] * h[2]))
    return most, ends, one_way


def least_bending(ends: list[tuple[Complex, Complex]]) -> Flags:
    """The flags of the solution that bends least: of w0 and w2 with w2 of either sign, the paper's first, either root."""
    best = None
    for paper, (first, last) in zip((True, False), ends, strict=True):
        re = 120 - 15 * (first[0] ** 2 - first[1] ** 2 + last[0] ** 2 - last[1] ** 2)
        re += 10 * (first[0] * last[0] - first[1] * last[1])
        im = 10 * (first[0] * last[1] + first[1] * last[0]) - 30 * (first[0] * first[1] + last[0] * last[1])
        root = jnp.sqrt(lax.complex(re, im))
        for sign in (0.25, -0.25):
            middle = (
                sign * root.real - 0.75 * (first[0] + last[0]),
                sign * root.imag - 0.75 * (first[1] + last[1]),
            )
            found = [*bending(first, middle, last), paper]
            if best is None:
                best = found
            else:
                less = found[0] < best[0]
                best = [jnp.where(less, new, old) for new, old in zip(found, best, strict=True)]
    assert best is not None
    most, ends, one_way, paper = best
    return {"ONE_WAY": one_way, "PEAK_INSIDE": most > ends * (1 + 1e-12), "PAPER": paper}


def ph_hermite(theta0: Array, theta1: Array, l0: Array, l1: Array) -> Flags:
    """Four solutions in closed form, their curvature at some points, then Newton's method for the peak."""
    a, b = jnp.sqrt(l0), jnp.sqrt(l1)
    first = a * jnp.cos(0.5 * theta0), a * jnp.sin(0.5 * theta0)
    last = b * jnp.cos(0.5 * theta1), b * jnp.sin(0.5 * theta1)
    return least_bending([(first, last), (first, (-last[0], -last[1]))])


def ph_equal_length(theta0: Array, theta1: Array, length: Array) -> Flags:
    """The same; the ends' speed follows from the length in closed form (Farouki et al.)."""
    c0, s0 = jnp.cos(0.5 * theta0), jnp.sin(0.5 * theta0)
    p, q = 60 * (length + 1), 60 * (length - 1)

    def ends(sign: float) -> tuple[Complex, Complex]:
        c1, s1 = sign * jnp.cos(0.5 * theta1), sign * jnp.sin(0.5 * theta1)
        g = 5 * (c0 * s1 + c1 * s0 - 3 * (c0 * s0 + c1 * s1))
        a, b = (u * (5 * (x - y) ** 2 + 10 * (x * x + y * y)) for u, x, y in ((p, s0, s1), (q, c0, c1)))
        z = jnp.sqrt(2 * p * q / (a + b + jnp.sqrt((a - b) ** 2 + 4 * g * g * p * q)))
        return (z * c0, z * s0), (z * c1, z * s1)

    return least_bending([ends(1), ends(-1)])


PEERS: dict[str, Callable[..., Flags]] = {
    "cubic": cubic,
    "ph-quintic": ph_quintic,
    "any-spiral": any_spiral,
    "reach-cubic": reach_cubic,
    "reach-ph": reach_ph,
    "trig-quintic": trig_quintic,
    "ph-equal-length": ph_equal_length,
    "ph-hermite": ph_hermite,
}


# XLA takes half the width of a vector unless it is told otherwise.
@functools.partial(jax.jit, static_argnums=0, compiler_options={"xla_cpu_prefer_vector_width": 512})
def evaluate(peer: Callable[..., Flags], axes: list[Array]) -> Flags:
    """All nodes of a grid, a few values of the first axis at a time."""
    rest = [jnp.expand_dims(axis, [j for j in range(len(axes) - 1) if j != i]) for i, axis in enumerate(axes[1:])]
    inner = math.prod(len(axis) for axis in axes[1:])
    return lax.map(lambda value: peer(value, *rest), axes[0], batch_size=max(1, BLOCK // inner))


def rate(peer: Callable[..., Flags], axes: list[np.ndarray]) -> tuple[float, dict[str, np.ndarray]]:
    """Million nodes a second, compiling left out, and the flags."""
    given = [jnp.asarray(axis) for axis in axes]
    flags = jax.block_until_ready(evaluate(peer, given))
    seconds = []
    for _ in range(ROUNDS):
        started = time.perf_counter()
        jax.block_until_ready(evaluate(peer, given))
        seconds.append(time.perf_counter() - started)
    nodes = math.prod(len(axis) for axis in axes)
    return nodes / min(seconds) / 1e6, {name: np.asarray(flag).ravel() for name, flag in flags.items()}


def finer(axes: list[np.ndarray]) -> list[np.ndarray]:
    """A grid of the same ranges with `FINE` nodes or more."""
    factor = (FINE / math.prod(len(axis) for axis in axes)) ** (1 / len(axes))

    def axis(values: np.ndarray) -> np.ndarray:
        places = np.linspace(0, len(values) - 1, math.ceil(len(values) * factor))
        return np.interp(places, np.arange(len(values)), values)

    return [axis(values) for values in axes]


def main() -> None:
    """Prints the table."""
    folder = pathlib.Path(sys.argv[1])
    print(f"JAX {jax.__version__}, float64, {os.cpu_count()} cores; million nodes a second, and nodes that differ")
    print(f"{'':16}{'JAX':>10}{'ours, all cores':>18}{'one thread':>12}{'ratio':>8}   differ")
    for name, peer in PEERS.items():
        file = folder / f"{name}.json"
        if not file.exists():
            continue
        ours = json.loads(file.read_text())
        proved = np.fromfile(folder / f"{name}.flags", np.uint8)
        axes = [np.array(values) for values in ours["values"]]
        own, flags = rate(peer, axes)
        best = max(own, rate(peer, finer(axes))[0])
        off = np.zeros(len(proved), bool)
        for flag, found in flags.items():
            off |= found != (proved >> ours["flags"].index(flag) & 1).astype(bool)
        ratio = ours["rate_of_all"] / best
        print(
            f"{name:16}{best:10.2f}{ours['rate_of_all']:18.2f}{ours['rate']:12.2f}{ratio:8.2f}"
            f"   {np.count_nonzero(off)} of {len(off)} ({', '.join(flags)})"
        )


if __name__ == "__main__":
    main()
