"""Segments between a line and a circle in JAX: the peers of `reach-cubic`, `reach-ph` and `trig-quintic`."""

import math

import jax.numpy as jnp
import numpy as np
from jax import Array, lax
from jax_spirals import Flags, rises


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
