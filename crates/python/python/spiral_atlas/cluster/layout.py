"""Making a store: its arrays and what it says about itself, without any shard."""

import base64
import json
import os
import struct
from collections.abc import Iterator, Sequence
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from zarr.codecs import ZstdCodec
from zarr.errors import GroupNotFoundError

from .._core import NO_VALUE, Outline
from . import shapes
from .lock import LOCK, locked
from .store import DIGESTS, UNWRITTEN, Store, absolute, reading


def create(
    recipe: Any,
    place: str | os.PathLike[str],
    *,
    atlas: str | None = None,
    chunks: Sequence[int] | None = None,
    shards: Sequence[int] | None = None,
) -> Store:
    """Makes a store without shards, or opens the one that is there.

    Args:
        recipe: a dictionary, or the path of a TOML file.
        place: a folder, or a URL that zarr understands. For a name that ends with `.zarr` xarray needs no engine.
        atlas: which atlas of the recipe, where it has several.
        chunks, shards: nodes along each axis; by default at most 2**20 nodes and 2**25 bytes.

    Raises:
        ValueError: the recipe is wrong; or another atlas is there, and the message says what differs.
        StoreLockedError: another run works on the store.
    """
    outline, place = Outline.of_recipe(recipe, atlas), absolute(place)
    refuse_others(place)
    with locked(place):
        return lay_out(outline, place, chunks, shards)


def refuse_others(place: str) -> None:
    """Refuses a place that has something else than a store. A store whose making was interrupted is one."""
    other = ValueError(f"{place}: something else than an atlas is there; choose another store")
    if "://" not in place:
        path = Path(place)
        if path.exists() and not (path.is_dir() and (not any(path.iterdir()) or (path / LOCK).exists())):
            raise other
    elif (found := _attributes(place)) and found.get("format") != "spiral-atlas":
        raise other


def _attributes(place: str) -> dict[str, Any] | None:
    with reading(place, "its metadata"):
        try:
            return dict(zarr.open_group(place, mode="r", zarr_format=3).attrs)
        except (GroupNotFoundError, FileNotFoundError):
            return None


def lay_out(
    outline: Outline, place: str, chunks: Sequence[int] | None = None, shards: Sequence[int] | None = None
) -> Store:
    """`create` for an outline, by the holder of the lock."""
    if not (_attributes(place) or {}).get("format"):
        counts = [len(axis) for axis in outline.axes.values()]
        chunks, shards = shapes.usual(counts, 2 + 4 * len(outline.scalar_docs), chunks, shards)
        shapes.check(counts, chunks, shards)
        _write(outline, place, chunks, shards)
        return Store(place, mode="r+", complete=False)
    store = Store(place, mode="r+", complete=False)
    differences = list(_differences(store, outline))
    for what, asked, has in (("chunks", chunks, store.chunks), ("shards", shards, store.shards)):
        if asked and tuple(asked) != has:
            differences.append(f"`{what}` are {shapes.told(has)} there and {shapes.told(asked)} here")
    if differences:
        raise ValueError(f"{place} holds another atlas: {'; '.join(differences)}. Choose another store, or remove it")
    return store


def _differences(store: Store, outline: Outline) -> Iterator[str]:
    """What a user can see the difference by; the rest follows from these."""
    ours = outline.metadata
    for key in ("family", "name", "chart", "generator"):
        if store.metadata[key] != ours[key]:
            yield f"`{key}` is {store.metadata[key]} there and {ours[key]} here"
    names = [[s["name"] for s in json.loads(metadata["scalars"])] for metadata in (store.metadata, ours)]
    if names[0] != names[1]:
        there, here = (", ".join(scalars) or "none" for scalars in names)
        yield f"the scalars are {there} there and {here} here"
    for name, axis in store.axes.items():
        other = outline.axes.get(name)
        if other is not None and not np.array_equal(axis, other):
            there, here = (f"{len(a)} nodes from {float(a[0])} to {float(a[-1])}" for a in (axis, other))
            yield f"the axis `{name}` has {there} there and {here} here"
    if store.recipe != ours["recipe"]:
        lines = [text.splitlines() for text in (store.recipe, ours["recipe"])]
        same = len(os.path.commonprefix(lines))
        there, here = (repr(text[same]) if same < len(text) else "missing" for text in lines)
        yield f"line {same + 1} of the recipe is {there} there and {here} here"


def _write(outline: Outline, place: str, chunks: tuple[int, ...], shards: tuple[int, ...]) -> None:
    counts, names = [len(axis) for axis in outline.axes.values()], list(outline.axes)
    group = zarr.open_group(place, mode="a", zarr_format=3)
    for name, values in outline.axes.items():
        unit = {"units": "radian"} if name in outline.angles else {}
        attributes: dict[str, Any] = {"long_name": name} | unit
        array = group.create_array(
            name, shape=values.shape, dtype="float64", dimension_names=[name], attributes=attributes, overwrite=True
        )
        array[:] = values
    docs = outline.flag_docs
    about: dict[str, dict[str, Any]] = {
        "flags": {
            "long_name": "proved conditions",
            "flag_masks": [1 << bit for bit in range(len(docs))],
            "flag_meanings": " ".join(docs),
            "comment": "; ".join(f"{name}: {doc}" for name, doc in docs.items()),
        },
        "solutions": {"long_name": "packed counts", "comment": outline.metadata["counts"]},
    }
    # Spelt as xarray reads it: a double in base 64.
    no_value = base64.standard_b64encode(struct.pack("<d", NO_VALUE)).decode()
    about |= {name: {"long_name": doc, "_FillValue": no_value} for name, doc in outline.scalar_docs.items()}
    for name, attributes in about.items():
        byte = name in ("flags", "solutions")
        group.create_array(
            name,
            shape=counts,
            dtype="uint8" if byte else "float32",
            chunks=chunks,
            shards=shards,
            fill_value=UNWRITTEN if byte else float("nan"),
            # Verdicts are of few kinds and scalars hardly compress, so that more effort gains little.
            compressors=ZstdCodec(level=-1),
            dimension_names=names,
            attributes=attributes,
            overwrite=True,
        )
    each = [ceil(count / side) for count, side in zip(counts, shards, strict=True)]
    # A chunk for each shard, so that whoever writes a shard writes a file of digests that is nobody else's.
    if "://" not in place:
        # Of an interrupted run. The folder is not overwritten as a whole, because the lock lies in it.
        (Path(place) / DIGESTS / "zarr.json").unlink(missing_ok=True)
    group.require_group("manifest").create_array(
        DIGESTS.partition("/")[2],
        overwrite="://" in place,
        shape=(*each, len(about), 32),
        dtype="uint8",
        chunks=(*(1 for _ in each), len(about), 32),
        compressors=None,
        fill_value=0,
        dimension_names=[*(f"shard_{name}" for name in names), "field", "byte"],
        attributes={"long_name": "BLAKE3 of each field of each shard, decoded", "fields": list(about)},
    )
    # Last: without these there is no store, and the next run makes it anew.
    title = {"Conventions": "CF-1.11", "title": f"atlas of {outline.metadata['family']}", "complete": False}
    group.update_attributes(title | outline.metadata)
