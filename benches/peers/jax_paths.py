"""The PH quintics that bend least, in JAX: the peers of `ph-equal-length` and `ph-hermite`."""

import jax.numpy as jnp
import numpy as np
from jax import Array, lax
from jax_spirals import Flags

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
    """The flags of the solution that bends least, of both ends' w0 and w2, the paper's first, and either root."""
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
