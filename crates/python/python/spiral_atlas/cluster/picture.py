"""Pictures of a store, from the chunks that they show."""

import os
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from .store import Store


def pictures(
    store: Store | str | os.PathLike[str],
    *,
    x: str | None = None,
    y: str | None = None,
    at: Mapping[str, float | str] | None = None,
) -> Iterator[bytes]:
    """Draws pictures of a store: PNG files. Only the chunks that they show are read.

    Args:
        store: a store, or its place.
        x, y: axes of a slice. Without them the pictures are those of the recipe that the store carries or, where it has
            none, a slice over the last two axes.
        at: of a slice, where on each of the other axes: the nearest node is drawn. Angles may be texts such as "40deg".

    Raises:
        ValueError: there is no such axis, or a value lies outside it.
        AtlasError: a shard is missing.
    """
    store = store if isinstance(store, Store) else Store(store)
    for picture in store.outline.pictures(None if x is None and y is None else _slice(store, x, y, at or {})):
        # Zarr reads ranges faster than lists of all their members.
        nodes = tuple(_range(chosen) for chosen in picture.nodes)
        with store.decoding():
            flags = store.flags.oindex[nodes].reshape(-1)
            scalar = store.scalar(picture.scalar).oindex[nodes].reshape(-1) if picture.scalar else None
        store.refuse_unwritten(flags)
        yield picture.draw(flags, scalar)


def _range(nodes: list[int]) -> slice | list[int]:
    return slice(nodes[0], nodes[-1] + 1) if nodes[-1] - nodes[0] + 1 == len(nodes) else nodes


def _slice(store: Store, x: str | None, y: str | None, at: Mapping[str, float | str]) -> dict[str, Any]:
    """The recipe of the store with this slice alone."""
    if x is None or y is None:
        raise ValueError("a slice has two axes; give both x and y")
    try:
        recipe = tomllib.loads(store.recipe)
        atlas = next(atlas for atlas in recipe["atlas"] if atlas["name"] == store.metadata["name"])
    except (tomllib.TOMLDecodeError, KeyError, StopIteration):
        raise ValueError(f"{store.path} carries no recipe of itself, so that its slices cannot be drawn") from None
    atlas["picture"] = [{"kind": "slice", "x": x, "y": y, "at": dict(at)}]
    return {key: recipe[key] for key in ("family", "fields") if key in recipe} | {"atlas": [atlas]}
