"""Atlases as xarray datasets: ``xarray.open_dataset("x.atlas.safetensors")`` finds this module by itself."""

import os
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing

from ._core import NO_VALUE, Atlas, open

SUFFIX = ".atlas.safetensors"


class _Mapped(BackendArray):
    """An array over the mapped file: what is asked for is copied, and nothing before."""

    def __init__(self, array: np.ndarray) -> None:
        self.array = array
        self.shape = array.shape
        self.dtype = array.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        support = indexing.IndexingSupport.OUTER
        return indexing.explicit_indexing_adapter(key, self.shape, support, self._take)

    def _take(self, key: tuple[Any, ...]) -> Any:
        out = self.array
        # Each axis by itself, from the last on, so that lists of indices make an outer product.
        for axis in reversed(range(len(key))):
            out = out[(slice(None),) * axis + (key[axis],)]
        return np.array(out)


def to_dataset(atlas: Atlas, drop_variables: Iterable[str] = ()) -> xr.Dataset:
    """The atlas as a dataset, lazily.

    Variables: ``flags`` (uint8, CF ``flag_masks`` and ``flag_meanings``), one for each count that ``solutions`` packs
    (uint8), one for each scalar (float32, NaN where a node has no value). Coordinates are the axes; angles have the
    unit ``radian``.
    """
    dropped = {drop_variables} if isinstance(drop_variables, str) else set(drop_variables)
    dims = tuple(atlas.axes)

    def lazy(array: np.ndarray, attrs: dict[str, Any], encoding: dict[str, Any] | None = None) -> xr.Variable:
        return xr.Variable(dims, indexing.LazilyIndexedArray(_Mapped(array)), attrs, encoding)

    flag_docs = atlas.flag_docs
    masks = np.array([1 << bit for bit in range(len(flag_docs))], dtype=np.uint8)
    about = "; ".join(f"{name}: {doc}" for name, doc in flag_docs.items())
    variables = {
        "flags": lazy(
            atlas.flags,
            {
                "long_name": "proved conditions",
                "flag_masks": masks,
                "flag_meanings": " ".join(flag_docs),
                "comment": about,
            },
        ),
        "solutions": lazy(atlas.solutions, {"long_name": "packed counts", "comment": atlas.metadata["counts"]}),
    }
    for name, doc in atlas.scalar_docs.items():
        values = lazy(atlas.scalar(name), {"long_name": doc, "_FillValue": np.float32(NO_VALUE)})
        variables[name] = xr.conventions.decode_cf_variable(name, values)
    coords = {}
    for name, axis in atlas.axes.items():
        unit = {"units": "radian"} if name in atlas.angles else {}
        coords[name] = xr.Variable((name,), axis, {"long_name": name} | unit)
    kept = {name: variable for name, variable in variables.items() if name not in dropped}
    return xr.Dataset(kept, coords, {"Conventions": "CF-1.11", "title": f"atlas of {atlas.family}", **atlas.metadata})


class AtlasBackend(BackendEntrypoint):
    """Opens ``*.atlas.safetensors``."""

    description = "Atlases of spiral regions (Spiral Atlas)"
    url = "https://pypi.org/project/spiral-atlas/"

    def open_dataset(self, filename_or_obj: Any, *, drop_variables: str | Iterable[str] | None = None) -> xr.Dataset:
        dataset = to_dataset(open(filename_or_obj), drop_variables or ())
        # The file is mapped as long as an array of it is alive.
        dataset.set_close(lambda: None)
        return dataset

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        try:
            return os.fspath(filename_or_obj).endswith(SUFFIX)
        except TypeError:
            return False
