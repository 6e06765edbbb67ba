"""Shapes of chunks and shards."""

from collections.abc import Sequence
from math import ceil, prod

CHUNK_NODES = 1 << 18
"""Most nodes of a chunk, which is what a lookup reads: 256 KiB of flags before compression."""
SHARD_NODES = 1 << 22
"""Most nodes of a shard, which is what a task computes and a file holds."""


def usual_chunks(counts: Sequence[int]) -> tuple[int, ...]:
    """Chunks of nearly equal sides, the later ones longer."""
    sides = list(counts)
    while prod(sides) > CHUNK_NODES:
        longest = sides.index(max(sides))
        sides[longest] = ceil(sides[longest] / 2)
    return tuple(sides)


def usual_shards(counts: Sequence[int], chunks: Sequence[int]) -> tuple[int, ...]:
    """Shards of whole chunks, of nearly equal sides, the later ones longer."""
    sides = list(chunks)
    while True:
        # The shortest side that does not reach the end of its axis yet; of equal ones the last.
        open_axes = [axis for axis in reversed(range(len(sides))) if sides[axis] < counts[axis]]
        if not open_axes:
            return tuple(sides)
        axis = min(open_axes, key=lambda axis: sides[axis])
        if 2 * prod(sides) > SHARD_NODES:
            return tuple(sides)
        sides[axis] *= 2


def check(counts: Sequence[int], chunks: Sequence[int], shards: Sequence[int]) -> None:
    """Refuses shapes that no array can have."""
    for what, sides in (("chunks", chunks), ("shards", shards)):
        if len(sides) != len(counts) or any(side < 1 for side in sides):
            raise ValueError(f"the {what} {told(sides)} must be {len(counts)} sides of at least 1, one for each axis")
    if any(shard % chunk for shard, chunk in zip(shards, chunks, strict=True)):
        raise ValueError(f"shards of {told(shards)} do not consist of whole chunks of {told(chunks)}")


def told(sides: Sequence[int]) -> str:
    """As the command line takes them."""
    return ",".join(map(str, sides))
