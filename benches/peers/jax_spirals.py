"""Spirals between two given ends in JAX: the peers of `cubic`, `ph-quintic` and `any-spiral`; see families_jax.py."""

import functools
import math

import jax.numpy as jnp
import numpy as np
from jax import Array, lax

Flags = dict[str, Array]


def least(quintic: list[Array], places: list[float]) -> Array:
    """The least value of a quintic in Bernstein form at some places in (0, 1), up to positive factors."""
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
    """Changes of sign along the ratio of both ends' speeds, Newton's method from there, then the sign of kappa'."""
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
        """Z where the sum of both equations holds, and by how much the first fails there."""
        first, second = sides(t)
        whole = [a + b for a, b in zip(first, second, strict=True)]
        for _ in range(steps):
            z = z - (value(z, whole) - right[0] - right[1]) / slope(z, whole)
        return z, value(z, first) - right[0]

    count = 40
    angles = 0.5 * math.pi * np.array(between(count))
    places, shrinks = jnp.tan(angles), jnp.cos(angles[1:]) ** 2 / jnp.cos(angles[:-1]) ** 2

    def scan(carry: tuple[Array, ...], place: tuple[Array, Array]) -> tuple[tuple[Array, ...], None]:
        z, before, last, t0, t1, t2, z0, z1, z2 = carry
        t = place[0] * scale
        # A^2 + B^2 changes little.
        z, off = level(t, z * place[1], 1)
        change = (off > 0) != (before > 0)
        root = last + (t - last) * before / (before - off)
        new = [(t2, t1), (t1, t0), (t0, root), (z2, z1), (z1, z0), (z0, z)]
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
