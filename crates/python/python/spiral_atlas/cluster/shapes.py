"""Shapes of chunks and shards."""

from collections.abc import Sequence
from math import ceil, prod

CHUNK_NODES = 1 << 20
"""Most nodes of a chunk, which is what a lookup reads: a mebibyte of flags, some ten kilobytes compressed."""
SHARD_BYTES = 1 << 25
"""Most bytes of a shard before compression. A shard is what a task computes and what a file holds, for each field."""
SHARDS = 16
"""Of small atlases shards are smaller, so that there are as many and all cores have work, but no smaller than these."""
LEAST_NODES = 1 << 18
PLANE = 16
"""How much longer the last two sides are. A family proves whole blocks of nodes in these two axes, and what it computes
for the other coordinates once is then shared by more nodes."""


def usual(
    counts: Sequence[int], node: int, chunks: Sequence[int] | None = None, shards: Sequence[int] | None = None
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Chunks and shards of a grid whose nodes have so many bytes; what is given stays."""
    for what, sides in (("chunks", chunks), ("shards", shards)):
        if sides is not None:
            _check(counts, what, sides)
    most = min(SHARD_BYTES // node, max(LEAST_NODES, prod(counts) // SHARDS))
    if chunks is None:
        chunks = _divided(counts, min(CHUNK_NODES, most)) if shards is None else _halved(shards)
    return tuple(chunks), tuple(shards or _doubled(counts, chunks, most))


def _divided(counts: Sequence[int], most: int) -> tuple[int, ...]:
    """Sides of at most so many nodes that are nearly equal, apart from the last two."""
    sides = list(counts)
    while prod(sides) > most:
        longest = max(range(len(sides)), key=lambda axis: _weighed(axis, sides))
        sides[longest] = ceil(sides[longest] / 2)
    return tuple(sides)


def _halved(shards: Sequence[int]) -> tuple[int, ...]:
    """Whole parts of shards that somebody chose."""
    sides = list(shards)
    while prod(sides) > CHUNK_NODES and (even := [axis for axis, side in enumerate(sides) if side % 2 == 0]):
        sides[max(even, key=lambda axis: _weighed(axis, sides))] //= 2
    return tuple(sides)


def _doubled(counts: Sequence[int], chunks: Sequence[int], most: int) -> tuple[int, ...]:
    """Whole chunks, again of nearly equal sides, apart from the last two."""
    sides = list(chunks)
    while True:
        # The shortest side that does not reach the end of its axis yet; of equal ones the last.
        open_axes = [axis for axis in reversed(range(len(sides))) if sides[axis] < counts[axis]]
        if not open_axes or 2 * prod(sides) > most:
            return tuple(sides)
        sides[min(open_axes, key=lambda axis: _weighed(axis, sides))] *= 2


def _weighed(axis: int, sides: Sequence[int]) -> float:
    """A side by how long it is to be."""
    return sides[axis] / (PLANE if axis >= len(sides) - 2 else 1)


def check(counts: Sequence[int], chunks: Sequence[int], shards: Sequence[int]) -> None:
    """Refuses shapes that no array can have."""
    for what, sides in (("chunks", chunks), ("shards", shards)):
        _check(counts, what, sides)
    if any(shard % chunk for shard, chunk in zip(shards, chunks, strict=True)):
        raise ValueError(f"shards of {told(shards)} do not consist of whole chunks of {told(chunks)}")


def _check(counts: Sequence[int], what: str, sides: Sequence[int]) -> None:
    if len(sides) != len(counts) or any(side < 1 for side in sides):
        raise ValueError(f"the {what} {told(sides)} must be {len(counts)} sides of at least 1, one for each axis")
    # A shard is a whole number of chunks, and may go on behind the end of an axis by less than one, so by less than it.
    if any(side >= 2 * count for side, count in zip(sides, counts, strict=True)):
        raise ValueError(f"the {what} {told(sides)} are longer than the axes, which have {told(counts)} nodes")


def told(sides: Sequence[int]) -> str:
    """As the command line takes them."""
    return ",".join(map(str, sides))
