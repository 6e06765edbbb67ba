"""Stores and atlas files, each from the other without loss."""

import os
from collections.abc import Iterator, Sequence
from itertools import product
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Atlas, Outline
from .._core import open as open_file
from .layout import lay_out, refuse_others
from .lock import locked, sweep
from .shards import finish, look_at, put
from .store import Store, absolute

BUDGET = 1 << 28
"""Most bytes of fields that are read at a time, where an axis allows it."""


def to_zarr(
    atlas: Atlas | str | os.PathLike[str],
    place: str | os.PathLike[str],
    *,
    chunks: Sequence[int] | None = None,
    shards: Sequence[int] | None = None,
) -> Store:
    """See `spiral_atlas.to_zarr`."""
    atlas, place = atlas if isinstance(atlas, Atlas) else open_file(atlas), absolute(place)
    refuse_others(place)
    with locked(place):
        sweep(place)
        store = lay_out(Outline.of_atlas(atlas), place, chunks, shards)
        arrays: dict[str, NDArray[Any]] = {"flags": atlas.flags, "solutions": atlas.solutions}
        arrays |= {name: atlas.scalar(name) for name in atlas.scalar_docs}
        for shard in range(store.shard_count):
            fields = {name: np.ascontiguousarray(array[store.box(shard)]) for name, array in arrays.items()}
            digest = store.digest_of(fields)
            if not (np.array_equal(store.stored_digest(shard), digest) and look_at(store, shard).state == "kept"):
                put(store, shard, fields)
        finish(store)
    return Store(place)


def to_safetensors(store: Store | str | os.PathLike[str], path: str | os.PathLike[str]) -> Atlas:
    """See `spiral_atlas.to_safetensors`."""
    store = store if isinstance(store, Store) else Store(store)
    writer = store.outline.create(path)
    for box in _slabs(store):
        fields = {name: array.reshape(-1) for name, array in store.read(box).items()}
        store.refuse_unwritten(fields["flags"])
        writer.put(fields.pop("flags"), fields.pop("solutions"), list(fields.values()))
    writer.finish()
    return open_file(path)


def _slabs(store: Store) -> Iterator[tuple[slice, ...]]:
    """Boxes that follow each other in flat order, each of whole chunks where that is within the budget."""
    shape, node = store.shape, 2 + 4 * len(store.scalar_docs)
    # The first axis behind which everything is within the budget; those before it are walked node by node.
    axis = next(
        axis for axis in range(len(shape)) if axis + 1 == len(shape) or node * prod(shape[axis + 1 :]) <= BUDGET
    )
    step = max(1, BUDGET // (node * prod(shape[axis + 1 :])))
    for whole in (store.shards[axis], store.chunks[axis]):
        if step > whole:
            step -= step % whole
            break
    rest = tuple(slice(0, count) for count in shape[axis + 1 :])
    for index in product(*(range(count) for count in shape[:axis])):
        for start in range(0, shape[axis], step):
            yield (*(slice(i, i + 1) for i in index), slice(start, min(start + step, shape[axis])), *rest)
