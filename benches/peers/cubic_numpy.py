#!/usr/bin/env python3
"""The cubic family's verdicts in NumPy: the peer that the evaluators are timed against.

The same recipe in vectorised double precision, nothing proved: count the roots of the two parabolas, find them by
Newton's method, judge them by Theorem 3.1 of Habib & Sakai and, where that fails, by halving the spiral polynomial.
Nodes that no spiral fits are dropped before the roots are sought, as in the library, and blocks fit the cache.

    cubic_numpy.py [FOLDER]

prints nodes a second and the counts of each flag. With a folder it leaves there `flags` and `solutions` (a byte a node,
as in an atlas) and `seconds`, for the bench beside it to compare.
"""

import pathlib
import sys
import time

import numpy as np

SOLVABLE, THEOREM31, THEOREM31_ANY, SPIRAL, ANY_SPIRAL = 1, 2, 4, 8, 16
NAMES = ["SOLVABLE", "THEOREM31", "THEOREM31_ANY", "SPIRAL", "ANY_SPIRAL"]
# Pairs of angles in a block: about 16 thousand nodes, 128 KiB an array.
PAIRS = 10
ROUNDS = 3
# How often the spiral polynomial is halved before a node still open counts as a spiral.
DEPTH = 12


def halving():
    """The matrix that turns the Bernstein coefficients of a quintic into those of its halves, side by side."""
    left, rows = np.zeros((6, 6)), np.eye(6)
    right = np.zeros((6, 6))
    for step in range(6):
        left[step], right[5 - step] = rows[0], rows[-1]
        rows = 0.5 * (rows[:-1] + rows[1:])
    return np.concatenate([left, right]).T


HALVING = halving()


def grid():
    """The bench's grid: four different counts."""
    return (
        np.linspace(0.1, 1.2, 37),
        np.linspace(0.2, 1.5, 41),
        np.linspace(0.02, 1.0, 39),
        np.geomspace(1.0, 100.0, 43),
    )


def side(x, y, p, g, r):
    """B0, B1, B2: the spiral polynomial's coefficients at one end, divided by positive factors."""
    u = 3 - x
    u2 = u * u
    xu = x * u
    x5 = 5 * x - 2
    b0 = 2 * p * u2 + g * (2 * xu + y * (3 * x - 10))
    b1 = (
        2 * p * u * (2 * u * (3 + x) + y * (7 * x - 17))
        + g * (2 * xu * (2 * x - 7 * y) + y * y * (22 - 9 * x))
        + 4 * r * u2 * u
    )
    b2 = (
        p * (u * (x * (5 * x + 3) - 6) + y * (x * (10 * x - 32) + 12))
        + g * (x * x * (5 * x - 12) + y * (x * (12 - 10 * x) + y * x5))
        + r * u2 * x5
    )
    return b0, b1, b2


def theorem31(start, end, x, y):
    """Theorem 3.1: both halves hold."""
    holds = np.ones(x.shape, bool)
    for (b0, b1, b2), w in ((start, y), (end, x)):
        product = b0 * b2
        holds &= (b0 >= 0) & (b2 >= 0) & ((b1 >= 0) | (8 * w * product >= b1 * b1))
    return holds


def never_negative(c):
    """Whether quintics in Bernstein form (one a row) are nowhere negative on [0, 1]."""
    spiral = (c[:, 0] >= 0) & (c[:, 5] >= 0)
    node = np.flatnonzero(spiral)
    c = c[node]
    for _ in range(DEPTH):
        unclear = (c < 0).any(axis=1)
        c, node = c[unclear], node[unclear]
        if not len(c):
            break
        pieces = c @ HALVING
        spiral[node[pieces[:, 5] < 0]] = False
        unclear = spiral[node]
        c, node = pieces[unclear].reshape(-1, 6), np.repeat(node[unclear], 2)
    return spiral


def newton(a, k, x):
    """The root of F(x) = 3 - x - k (3 - a x²)² that Newton's method reaches from x."""
    a2 = 4 * a
    for _ in range(5):
        y = 3 - a * x * x
        ky = k * y
        step = (3 - x - ky * y) / (a2 * x * ky - 1)
        x = x - step
    late = np.flatnonzero(np.abs(step) > 1e-8 * x)
    for _ in range(40):
        if not len(late):
            break
        (al, kl, xl) = (a[late], k[late], x[late])
        y = 3 - al * xl * xl
        ky = kl * y
        step = (3 - xl - ky * y) / (4 * al * xl * ky - 1)
        x[late] = xl - step
        late = late[np.abs(step) > 1e-8 * xl]
    return x


def block(phi0, phi1, kappa0, kappa1):
    """Flags and solutions of a few pairs of angles, shaped (pairs, kappa0, kappa1)."""
    shape = (len(phi0), len(kappa0), len(kappa1))
    column = lambda v: v[:, None, None]
    kappa0, kappa1 = kappa0[None, :, None], kappa1[None, None, :]
    sin0, sin1, total = np.sin(phi0), np.sin(phi1), np.sin(phi0 + phi1)
    g0, g1 = (sin0 / total) ** 2, (sin1 / total) ** 2
    a = column(g1 / sin0) * kappa0
    k = column(g0 / sin1) * kappa1
    room0, room1 = column(sin0) - kappa0, kappa1 - column(sin1)
    apart = room0 * room1 > column(np.sin(0.5 * (phi1 - phi0)) ** 2)
    any_spiral = (room0 > 0) & (room1 > 0) & apart & column(phi0 < phi1)

    ak = a * k
    real = ak * (768 * ak - 256 * (a + k) + 96) >= 1
    k_above, a_above = k > 1 / 3, np.broadcast_to(a > 1 / 3, shape)
    solvable = k_above & (real | a_above)
    two = (k_above != a_above) & real
    three = ~(k_above | a_above) & real
    roots = np.where(k_above == a_above, np.where(three, 3, 1), np.where(two, 2, 0)).astype(np.uint8)
    flags = solvable * np.uint8(SOLVABLE) | any_spiral * np.uint8(ANY_SPIRAL)
    spirals = np.zeros(shape, np.uint8)

    # From here on only nodes with a root and some spiral, as flat arrays.
    node = np.flatnonzero(any_spiral & (roots > 0))
    pair = node // (shape[1] * shape[2])
    a = np.broadcast_to(a, shape).ravel()[node]
    k = k.ravel()[node] if k.shape == shape else np.broadcast_to(k, shape).ravel()[node]
    number, solvable = roots.ravel()[node], solvable.ravel()[node]
    k_above, a_above = k > 1 / 3, a > 1 / 3
    bend = 1 / np.sqrt(a)
    at_bend = np.minimum(bend, 3)
    right_of_bend = 3 - at_bend - k * (3 - a * at_bend * at_bend) ** 2 > 0
    lone = (number == 1) & ~k_above
    first = np.where(k_above, bend, np.where(lone & right_of_bend, 3.0, 0.0))
    second = np.where(k_above, 3.0, bend)
    p = (sin0 * np.cos(phi1) / total)[pair]
    r = (np.cos(phi0) * sin1 / total)[pair]
    g0, g1 = g0[pair], g1[pair]
    for slot, start in enumerate((first, second, np.full(len(node), 3.0))):
        if slot:
            more = np.flatnonzero(number > slot)
            if not len(more):
                break
            node, number, a, k, p, r, g0, g1 = (v[more] for v in (node, number, a, k, p, r, g0, g1))
            second, start = second[more], start[more]
        x = newton(a, k, start)
        y = 3 - a * x * x
        b = side(x, y, p, g0, r)
        c = [-v for v in side(y, x, r, g1, p)]
        spiral = theorem31(b, c, x, y)
        found = spiral * np.uint8(THEOREM31_ANY)
        if slot == 0:
            found |= (spiral & solvable) * np.uint8(THEOREM31)
        unclear = np.flatnonzero(~spiral & (b[0] >= 0) & (c[0] >= 0))
        if len(unclear):
            xu, yu = x[unclear], y[unclear]
            (b0, b1, b2), (c0, c1, c2) = [v[unclear] for v in b], [v[unclear] for v in c]
            h = np.stack([5 * yu * yu * b0, yu * b1, yu * b2, xu * c2, xu * c1, 5 * xu * xu * c0], axis=1)
            spiral[unclear] = never_negative(h)
        flags.ravel()[node] |= found | spiral * np.uint8(SPIRAL)
        spirals.ravel()[node] += spiral
    return flags, roots | spirals << 2


def evaluate(axes):
    """Flags and solutions of a whole grid."""
    phi0, phi1, kappa0, kappa1 = axes
    shape = tuple(len(axis) for axis in axes)
    flags, solutions = (np.empty((shape[0] * shape[1], *shape[2:]), np.uint8) for _ in range(2))
    left, right = np.repeat(phi0, shape[1]), np.tile(phi1, shape[0])
    with np.errstate(all="ignore"):
        for at in range(0, len(left), PAIRS):
            part = slice(at, at + PAIRS)
            flags[part], solutions[part] = block(left[part], right[part], kappa0, kappa1)
    return flags.reshape(shape), solutions.reshape(shape)


def main():
    axes = grid()
    seconds = []
    for _ in range(ROUNDS):
        started = time.perf_counter()
        flags, solutions = evaluate(axes)
        seconds.append(time.perf_counter() - started)
    print(f"NumPy {np.__version__}: {flags.size / min(seconds) / 1e6:.2f} Mnodes/s, {flags.size} nodes")
    for bit, name in enumerate(NAMES):
        print(f"  {name:14} {np.count_nonzero(flags & 1 << bit):9}")
    if len(sys.argv) > 1:
        folder = pathlib.Path(sys.argv[1])
        flags.tofile(folder / "flags")
        solutions.tofile(folder / "solutions")
        (folder / "seconds").write_text(str(min(seconds)))


if __name__ == "__main__":
    main()
