"""Shards, one by one. Nothing here knows of Dask."""

import os
import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray
from zarr.core.sync import sync

from .._core import AtlasError, __version__
from .store import Store

GENERATOR = f"spiral-atlas {__version__}"


@dataclass(frozen=True)
class Shard:
    """What was done with a shard."""

    number: int
    state: str
    """`written`; `kept`, as it was there and right; or, of a check alone, `missing` or `wrong`."""
    nodes: int
    yes: dict[str, int]
    """Nodes with a proved yes, by flag."""
    undecided_f64: int = 0
    """Nodes that went to intervals, of a shard that was computed."""
    seconds: float = 0.0


def write_shard(store: Store | str | os.PathLike[str], number: int, *, threads: int | None = None) -> Shard:
    """Computes a shard and writes it with its digest, unless it is there and right.

    Any number of processes may write shards of one store at the same time. Two that write one shard write the same.

    Args:
        store: a store, or its place.
        number: 0 to `Store.shard_count - 1`.
        threads: workers; by default as many as there are cores.

    Raises:
        ValueError: there is no such shard.
        AtlasError: the store was made by another version.
        UndecidedError: naming the node whose verdict is not proved at the precision cap.
        OSError: the disk is full, or the system refuses otherwise.
    """
    began = time.perf_counter()
    store = store if isinstance(store, Store) else Store(store, mode="r+", complete=False)
    if store.metadata["generator"] != GENERATOR:
        raise AtlasError(
            f"{store.path} was made by {store.metadata['generator']}; this is {GENERATOR}, which makes another"
        )
    box = store.box(number)
    if (found := look_at(store, number)).state == "kept":
        return found
    sides = [side.stop - side.start for side in box]
    fields, report = store.outline.block([side.start for side in box], sides, threads=threads)
    put(store, number, fields)
    seconds = time.perf_counter() - began
    return Shard(number, "written", report["nodes"], report["yes"], report["undecided_f64"], seconds)


def look_at(store: Store, number: int) -> Shard:
    """Reads a shard and compares it with its digest: it is `kept`, `missing` or `wrong`."""
    began = time.perf_counter()
    state, fields = store.look_at(number)
    if state != "kept":
        return Shard(number, state, 0, {})
    flags = fields["flags"]
    yes = {name: int(np.count_nonzero(flags & (1 << bit))) for bit, name in enumerate(store.flag_docs)}
    return Shard(number, state, flags.size, yes, seconds=time.perf_counter() - began)


def put(store: Store, number: int, fields: Mapping[str, NDArray[Any]]) -> None:
    """Writes the fields of a shard and, once they are there, their digests."""
    sync(_put(store, number, fields))


async def _put(store: Store, number: int, fields: Mapping[str, NDArray[Any]]) -> None:
    # In one piece, since each call from outside wakes zarr's thread, and waits for it.
    box = store.box(number)
    index = tuple(int(i) for i in np.unravel_index(number, store.shard_counts))
    for name, array in store.fields.items():
        # What is there may be damaged, and zarr would read it to see whether parts of it must be kept.
        await store.group.store.delete(f"{name}/{array.metadata.encode_chunk_key(index)}")
        # Else zarr compares every chunk with the fill value, which none is made of; that takes as long as to write it.
        await array.async_array.with_config({"write_empty_chunks": True}).setitem(box, fields[name])
    await store.digests.async_array.setitem(index, store.digest_of(fields))


def finish(store: Store) -> None:
    """Says that all shards are there, and gathers all metadata in one file, as xarray expects."""
    if not store.group.attrs.get("complete"):
        store.group.update_attributes({"complete": True})
        with warnings.catch_warnings():
            # The specification of Zarr v3 does not have this file yet; who does not know it reads the others.
            warnings.filterwarnings("ignore", "Consolidated metadata")
            zarr.consolidate_metadata(store.group.store)
