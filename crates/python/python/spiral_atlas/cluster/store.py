"""An atlas in a Zarr store, opened and looked up."""

import errno
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from math import ceil, prod
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import zarr
from numpy.typing import ArrayLike, NDArray
from zarr.errors import ArrayNotFoundError, GroupNotFoundError

from .._core import AtlasError, Outline, blake3

if TYPE_CHECKING:
    import xarray

METADATA = (
    *("format", "format_version", "generator", "name", "family", "chart", "chart_doc", "conventions"),
    *("axes", "flags", "counts", "scalars", "no_value", "recipe"),
)
"""Attributes of the group that are the metadata of an atlas file."""
UNWRITTEN = 255
"""What `flags` and `solutions` hold where no shard is written: no verdict has all bits. Scalars are NaN there."""
DIGESTS = "manifest/digests"
LONGEST_AXIS = 1 << 24
"""Nodes. A longer axis is refused before it is read; whole, it would be 128 MiB in every process."""


def absolute(place: str | os.PathLike[str]) -> str:
    """A place that every process understands: an absolute path, or the URL as it is."""
    text = os.fspath(place)
    return text if "://" in text else str(Path(text).absolute())


@contextmanager
def reading(place: str, what: str) -> Iterator[None]:
    """Makes one short `AtlasError` of whatever zarr says of metadata that are damaged or of another program."""
    try:
        yield
    except AtlasError:
        raise
    except Exception as error:
        # A refusal of the system is not the store's.
        if isinstance(error, OSError) and error.errno is not None:
            raise
        said = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise AtlasError(f"{place}: {what} cannot be read ({said})") from None


class Store:
    """An atlas in a Zarr store. Made by `spiral_atlas.open`; it answers as `Atlas` does.

    Its arrays are arrays of Zarr: indexing reads the chunks that are needed, and gives NumPy arrays.
    """

    def __init__(self, place: str | os.PathLike[str], *, mode: Literal["r", "r+"] = "r", complete: bool = True) -> None:
        self.path = absolute(place)
        with reading(self.path, "its metadata"):
            try:
                self.group = zarr.open_group(self.path, mode=mode, zarr_format=3)
            except (GroupNotFoundError, FileNotFoundError):
                raise FileNotFoundError(errno.ENOENT, "there is no store", self.path) from None
            attributes = dict(self.group.attrs)
        if attributes.get("format") != "spiral-atlas":
            raise AtlasError(f"{self.path}: it is no store of an atlas, or its making was interrupted")
        if complete and not attributes.get("complete"):
            raise AtlasError(f"{self.path}: shards are missing; `spiral-atlas-cluster generate` completes the store")
        metadata = {key: str(attributes[key]) for key in METADATA if key in attributes}
        with reading(self.path, "its axes"):
            names = [str(axis["name"]) for axis in json.loads(metadata["axes"])]
            axes = {name: self._axis(name) for name in names}
        self.outline = Outline.of_metadata(self.path, metadata, axes)
        self.fields = {name: self.array(name) for name in ("flags", "solutions", *self.outline.scalar_docs)}
        self.digests = self.array(DIGESTS)
        self._check_arrays()

    def array(self, name: str) -> Any:
        """An array of the store."""
        with reading(self.path, f"its array `{name}`"):
            try:
                mode = "r" if self.group.read_only else "r+"
                return zarr.open_array(self.group.store, path=name, mode=mode, zarr_format=3)
            except (ArrayNotFoundError, FileNotFoundError):
                raise AtlasError(f"{self.path}: it has no array `{name}`") from None

    def _axis(self, name: str) -> NDArray[np.float64]:
        array = self.array(name)
        if array.ndim != 1 or array.dtype != np.float64 or array.size > LONGEST_AXIS:
            raise AtlasError(f"{self.path}: the array `{name}` is no axis: {array.dtype} of shape {array.shape}")
        return np.asarray(array[:])

    def _check_arrays(self) -> None:
        shape = tuple(len(axis) for axis in self.axes.values())
        kinds = {name: np.dtype(np.uint8 if name in ("flags", "solutions") else np.float32) for name in self.fields}
        for name, array in self.fields.items():
            if (array.shape, array.dtype, array.shards) != (shape, kinds[name], self.shards):
                raise AtlasError(f"{self.path}: the array `{name}` does not fit the axes and the other arrays")
        if self.digests.shape != (*self.shard_counts, len(self.fields), 32) or self.digests.dtype != np.uint8:
            raise AtlasError(f"{self.path}: the array `{DIGESTS}` does not fit the shards")

    @property
    def shape(self) -> tuple[int, ...]:
        """Nodes along each axis."""
        return tuple(self.fields["flags"].shape)

    @property
    def chunks(self) -> tuple[int, ...]:
        """Nodes of a chunk along each axis: what a lookup reads."""
        return tuple(self.fields["flags"].chunks)

    @property
    def shards(self) -> tuple[int, ...]:
        """Nodes of a shard along each axis: what a file holds."""
        return tuple(self.fields["flags"].shards or ())

    @property
    def shard_counts(self) -> tuple[int, ...]:
        """Shards along each axis."""
        return tuple(ceil(count / side) for count, side in zip(self.shape, self.shards, strict=True))

    @property
    def shard_count(self) -> int:
        """Number of shards."""
        return prod(self.shard_counts)

    def box(self, shard: int) -> tuple[slice, ...]:
        """The nodes of a shard along each axis."""
        if not 0 <= shard < self.shard_count:
            raise ValueError(f"the store has shards 0 to {self.shard_count - 1}; given: {shard}")
        index = np.unravel_index(shard, self.shard_counts)
        sides = zip(index, self.shards, self.shape, strict=True)
        return tuple(slice(int(i) * side, min((int(i) + 1) * side, count)) for i, side, count in sides)

    def read(self, box: tuple[slice, ...]) -> dict[str, NDArray[Any]]:
        """The fields of a box of nodes."""
        with self.decoding():
            return {name: np.ascontiguousarray(array[box]) for name, array in self.fields.items()}

    @contextmanager
    def decoding(self) -> Iterator[None]:
        """Makes an `AtlasError` of whatever a decoder says of a file that is cut off or damaged."""
        try:
            yield
        except Exception as error:
            # A refusal of the system is not the file's.
            if isinstance(error, OSError) and error.errno is not None:
                raise
            what = f"{self.path}: a shard is damaged ({error}); `spiral-atlas-cluster check` names it"
            raise AtlasError(what) from error

    def digest_of(self, fields: Mapping[str, NDArray[Any]]) -> NDArray[np.uint8]:
        """BLAKE3 of each field of a shard: little-endian numbers, the last axis fastest."""
        raw = [np.ascontiguousarray(fields[name]).reshape(-1).view(np.uint8) for name in self.fields]
        return np.array([list(blake3(values)) for values in raw], dtype=np.uint8)

    def stored_digest(self, shard: int) -> NDArray[np.uint8]:
        """What the manifest has of a shard; zeros where it is not written."""
        with self.decoding():
            return np.asarray(self.digests[np.unravel_index(shard, self.shard_counts)])

    def look_at(self, shard: int) -> tuple[Literal["kept", "missing", "wrong"], dict[str, NDArray[Any]]]:
        """Reads a shard and compares it with its digest; the fields are those of a shard that is right."""
        box, stored = self.box(shard), self.stored_digest(shard)
        if not stored.any():
            return "missing", {}
        try:
            fields = self.read(box)
        except AtlasError:
            return "wrong", {}
        return ("kept", fields) if np.array_equal(stored, self.digest_of(fields)) else ("wrong", {})

    # What `Atlas` has, too.

    @property
    def family(self) -> str:
        """The family's name."""
        return self.metadata["family"]

    @property
    def chart(self) -> str:
        """The chart's name."""
        return self.metadata["chart"]

    @property
    def recipe(self) -> str:
        """The recipe's text."""
        return self.metadata["recipe"]

    @cached_property
    def metadata(self) -> dict[str, str]:
        """The metadata of the atlas file, without the hashes: text by name."""
        return self.outline.metadata

    @cached_property
    def axes(self) -> dict[str, NDArray[np.float64]]:
        """Axes by name, slowest first."""
        return self.outline.axes

    @property
    def angles(self) -> list[str]:
        """Names of the axes that are angles, in radians."""
        return self.outline.angles

    @property
    def flag_docs(self) -> dict[str, str]:
        """Names and meanings of the bits of `flags`, bit 0 first."""
        return self.outline.flag_docs

    @property
    def counts(self) -> dict[str, tuple[int, int]]:
        """Numbers in a `solutions` byte: name to (shift, bits)."""
        return self.outline.counts

    @property
    def scalar_docs(self) -> dict[str, str]:
        """Names and meanings of the scalar fields."""
        return self.outline.scalar_docs

    @property
    def id(self) -> str:
        """BLAKE3 of metadata, axes, shape of the shards and their digests, 64 hexadecimal digits.

        Stores of one id are equal node by node, whatever their codecs and chunks. (An atlas file has another id.)
        """
        about = json.dumps([sorted(self.metadata.items()), list(self.shards)]).encode()
        axes = b"".join(axis.tobytes() for axis in self.axes.values())
        return blake3(np.frombuffer(about + axes + np.asarray(self.digests[:]).tobytes(), dtype=np.uint8)).hex()

    @property
    def flags(self) -> Any:
        """The `flags` byte of every node."""
        return self.fields["flags"]

    @property
    def solutions(self) -> Any:
        """The `solutions` byte of every node."""
        return self.fields["solutions"]

    def scalar(self, name: str) -> Any:
        """A scalar field; `NO_VALUE` where a node has none."""
        if name not in self.scalar_docs:
            raise KeyError(f"the atlas has no scalar `{name}`; it has: {', '.join(self.scalar_docs)}")
        return self.fields[name]

    def lookup(self, points: ArrayLike) -> tuple[NDArray[np.int64], NDArray[np.uint8], NDArray[np.uint8]]:
        """The nearest node of each point, as `Atlas.lookup`; only the chunks of these nodes are read.

        Raises:
            AtlasError: a node is not written.
        """
        nodes = self.outline.nearest(points)
        inside = nodes >= 0
        index = np.unravel_index(nodes[inside], self.shape)
        found = []
        for array in (self.flags, self.solutions):
            values = np.zeros(nodes.shape, np.uint8)
            if inside.any():
                with self.decoding():
                    values[inside] = array.get_coordinate_selection(index)
            found.append(values)
        flags, solutions = found
        self.refuse_unwritten(flags)
        return nodes, flags, solutions

    def refuse_unwritten(self, flags: NDArray[np.uint8]) -> None:
        """Refuses flags of nodes that no shard has written."""
        if (flags == UNWRITTEN).any():
            raise AtlasError(f"{self.path}: a shard is missing; `spiral-atlas-cluster check` names it")

    def check(self) -> None:
        """Reads the whole store and checks every shard against its digest.

        Raises:
            AtlasError: naming the first shard that is missing or damaged.
        """
        for shard in range(self.shard_count):
            state, _ = self.look_at(shard)
            if state != "kept":
                raise AtlasError(f"{self.path}: shard {shard} is {state}")

    def to_xarray(self) -> "xarray.Dataset":
        """The atlas as an `xarray.Dataset`: what `xarray.open_dataset` makes of the store."""
        import xarray

        return xarray.open_dataset(self.path, engine="zarr")

    def __repr__(self) -> str:
        axes = " x ".join(f"{name} {len(axis)}" for name, axis in self.axes.items())
        return f"<spiral_atlas.cluster.Store of {self.family}: {axes}>"
