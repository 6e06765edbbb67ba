"""Atlases in files and in stores, under one name each. Stores need the extra `cluster`."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from . import _core

if TYPE_CHECKING:
    from .cluster import Store

_Place = str | os.PathLike[str]


def open(path: _Place) -> "_core.Atlas | Store":
    """Opens an atlas: a file (`Atlas`), or a Zarr store (`spiral_atlas.cluster.Store`), which answers alike.

    Of a file the header and the axes are checked; `check` reads the fields, too. A store needs `pip install
    'spiral-atlas[cluster]'`.

    Raises:
        OSError: it cannot be opened.
        AtlasError: it is not a valid atlas, or a store of which shards are missing.
    """
    if "://" in os.fspath(path) or Path(path).is_dir():
        _need_zarr()
        from .cluster.store import Store

        return Store(path)
    return _core.open(path)


def to_zarr(
    atlas: "_core.Atlas | _Place",
    store: _Place,
    *,
    chunks: Sequence[int] | None = None,
    shards: Sequence[int] | None = None,
) -> "Store":
    """Writes an atlas into a Zarr store, without loss: `to_safetensors` gives the same bytes back.

    Args:
        atlas: an atlas, or its file.
        store: a folder or a URL. A store of the same atlas that is there is completed.
        chunks, shards: nodes along each axis; by default at most 2**20 nodes and 2**25 bytes.

    Raises:
        ValueError: another atlas is there, and the message says what differs.
        OSError: the system refuses to write.
    """
    _need_zarr()
    from .cluster import convert

    return convert.to_zarr(atlas, store, chunks=chunks, shards=shards)


def to_safetensors(store: "Store | _Place", path: _Place) -> _core.Atlas:
    """Writes the atlas of a Zarr store into a file, whole or not at all: the bytes that `generate` writes.

    Memory: some 256 MiB, whatever the size of the store.

    Raises:
        AtlasError: a shard is missing.
        OSError: the system refuses to write.
    """
    _need_zarr()
    from .cluster import convert

    return convert.to_safetensors(store, path)


def _need_zarr() -> None:
    try:
        import zarr  # noqa: F401
    except ImportError as error:
        raise ImportError("stores need more packages: pip install 'spiral-atlas[cluster]'") from error
