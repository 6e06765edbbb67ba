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
from jax_paths import ph_equal_length, ph_hermite
from jax_segments import reach_cubic, reach_ph, trig_quintic
from jax_spirals import Flags, any_spiral, cubic, ph_quintic

jax.config.update("jax_enable_x64", True)

# Nodes that a peer gets at a time: arrays of so many doubles stay in the cache.
BLOCK = 1 << 15
# Nodes of the finer grid, at least; and rounds, of which the best counts.
FINE = 2_500_000
ROUNDS = 3

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
    if len(sys.argv) != 2:
        sys.exit(__doc__)
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
