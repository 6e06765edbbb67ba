"""Zarr stores: the same atlas as the file, whoever made it, and read no further than asked."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import spiral_atlas
import xarray as xr
import zarr
from spiral_atlas.cluster import Store, check, create, generate, pictures, shapes, write_shard

RECIPE = """
family = "cubic"
fields = ["f0", "margin"]

[[atlas]]
name = "small"
[atlas.axes]
phi0 = { linear = ["5deg", 1.2], count = 21 }
phi1 = { linear = [0.9, 1.4], count = 9 }
kappa0 = { linear = [0.02, 1.0], count = 18 }
kappa1 = { log = [1.0, 100.0], count = 17 }

[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7, phi1 = 1.4 }

[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.5, phi1 = 1.2 }
field = "margin"
levels = [0.1, 0.3]
"""
# Neither divides the grid, so that shards and chunks stick out at its end.
SHAPES = {"chunks": (4, 4, 8, 8), "shards": (8, 8, 8, 16)}


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("small")
    (folder / "small.toml").write_text(RECIPE)
    return folder


@pytest.fixture(scope="module")
def atlas(folder) -> spiral_atlas.Atlas:
    return spiral_atlas.generate(folder / "small.toml", folder)[0]


@pytest.fixture(scope="module")
def place(folder) -> Path:
    place, told = folder / "small.atlas.zarr", []
    done = generate(
        folder / "small.toml", place, workers=2, **SHAPES, progress=lambda so_far: told.append(len(so_far.shards))
    )
    assert (
        told[0] == 0
        and told[-1] == 36
        and told == sorted(told)
        and done.count("written") == done.store.shard_count == 36
    )
    assert done.nodes == 21 * 9 * 18 * 17 and done.dashboard
    return place


def test_the_store_is_the_file_node_by_node(place, atlas):
    store = spiral_atlas.open(place)
    assert isinstance(store, Store) and store.shape == atlas.flags.shape
    for name in ("family", "chart", "recipe", "angles", "flag_docs", "counts", "scalar_docs"):
        assert getattr(store, name) == getattr(atlas, name)
    assert store.metadata == {key: text for key, text in atlas.metadata.items() if not key.startswith("blake3")}
    assert all(np.array_equal(axis, atlas.axes[name]) for name, axis in store.axes.items())
    assert list(store.axes) == list(atlas.axes)
    assert np.array_equal(store.flags[...], atlas.flags) and np.array_equal(store.solutions[...], atlas.solutions)
    for name in ("f0", "margin"):
        assert np.array_equal(store.scalar(name)[...], atlas.scalar(name))
    with pytest.raises(KeyError, match="no scalar `f9`; it has: f0, margin"):
        store.scalar("f9")
    store.check()


def test_files_and_stores_come_from_each_other_without_loss(place, atlas, tmp_path):
    back = spiral_atlas.to_safetensors(place, tmp_path / "back.atlas.safetensors")
    assert Path(back.path).read_bytes() == Path(atlas.path).read_bytes()
    # Of other chunks, and yet of one id.
    store = spiral_atlas.to_zarr(back.path, tmp_path / "again.zarr", chunks=(8, 8, 8, 8), shards=SHAPES["shards"])
    assert store.id == spiral_atlas.open(place).id
    with pytest.raises(spiral_atlas.AtlasError, match="cells|nodes"):
        axes = {name: {"linear": [0.2, 1.2]} for name in ("phi0", "phi1", "kappa0", "kappa1")}
        plan = {"name": "c", "kind": "cells", "resolution": 2, "budget": "1 MiB", "axes": axes}
        spiral_atlas.generate({"family": "cubic", "atlas": [plan]}, tmp_path)
        spiral_atlas.to_zarr(tmp_path / "c.atlas.safetensors", tmp_path / "c.zarr")


def test_files_come_in_slabs_within_a_budget(place, atlas, tmp_path, monkeypatch):
    from spiral_atlas.cluster import convert

    read = []
    monkeypatch.setattr(Store, "read", lambda self, box, plain=Store.read: read.append(box) or plain(self, box))
    # Of ten bytes a node: a few planes of the last two axes, in whole chunks.
    monkeypatch.setattr(convert, "BUDGET", 20_000)
    spiral_atlas.to_safetensors(place, tmp_path / "slabs")
    assert (tmp_path / "slabs").read_bytes() == Path(atlas.path).read_bytes()
    sizes = [10 * np.prod([side.stop - side.start for side in box]) for box in read]
    assert max(sizes) <= 20_000 and sum(sizes) == 10 * atlas.flags.size and len(read) == 21 * 3


def test_xarray_answers_alike(place, atlas):
    with xr.open_dataset(place) as dataset, xr.open_dataset(atlas.path) as other:
        xr.testing.assert_equal(dataset, other)
        assert dataset.flags.dims == tuple(atlas.axes) and dataset.attrs["complete"] is True
        for name, variable in other.variables.items():
            for key, value in variable.attrs.items():
                assert np.array_equal(dataset[name].attrs[key], value), (name, key)
        assert np.isnan(dataset.f0.values).any()
    xr.testing.assert_identical(spiral_atlas.open(place).to_xarray(), xr.open_dataset(place))


def test_lookups_answer_alike_and_read_only_what_they_need(place, atlas, monkeypatch):
    rng = np.random.default_rng(3)
    points = np.column_stack([rng.uniform(0.9 * axis[0], 1.1 * axis[-1], 500) for axis in atlas.axes.values()])
    points[7, 2] = np.nan
    store = spiral_atlas.open(place)
    for ours, theirs in zip(store.lookup(points), atlas.lookup(points), strict=True):
        assert np.array_equal(ours, theirs)
    with pytest.raises(ValueError, match="3 columns; the atlas has 4 axes"):
        store.lookup(points[:, :3])
    assert store.lookup(np.empty((0, 4)))[0].shape == (0,)
    read = {}
    plain = zarr.storage.LocalStore.get

    async def counted(self, key, prototype=None, byte_range=None):
        found = await plain(self, key, prototype, byte_range)
        read[key] = read.get(key, 0) + len(found)
        return found

    monkeypatch.setattr(zarr.storage.LocalStore, "get", counted)
    store.lookup([[0.7, 1.4, 0.4, 4.0]])
    # Node 11, 8, 7, 5: the shard 1, 1, 0, 0 of each field, and of it the index and one chunk.
    assert sorted(read) == ["flags/c/1/1/0/0", "solutions/c/1/1/0/0"]
    assert all(length < (place / key).stat().st_size for key, length in read.items())


def test_pictures_are_those_of_the_file_and_read_only_what_they_show(place, atlas, tmp_path, monkeypatch):
    read = set()
    plain = zarr.storage.LocalStore.get

    async def noted(self, key, prototype=None, byte_range=None):
        read.add(key)
        return await plain(self, key, prototype, byte_range)

    store = spiral_atlas.open(place)
    monkeypatch.setattr(zarr.storage.LocalStore, "get", noted)
    first, second = pictures(store)
    assert first.startswith(b"\x89PNG") and second.startswith(b"\x89PNG") and first != second
    # Of 36 shards those of two slices: 3 x 2 each.
    assert len({key for key in read if key.startswith("flags/c")}) == 12
    (drawn,) = pictures(store, x="kappa0", y="kappa1", at={"phi0": 0.7, "phi1": 1.4})
    assert drawn == first
    for wrong, words in [
        ({"x": "kappa0"}, "both x and y"),
        ({"x": "kappa0", "y": "kapa1", "at": {"phi0": 0.7}}, "kapa1"),
        ({"x": "kappa0", "y": "kappa1", "at": {"phi0": 0.7}}, "phi1"),
        ({"x": "kappa0", "y": "kappa1", "at": {"phi0": 9, "phi1": 1}}, "phi0 = 9"),
    ]:
        with pytest.raises(ValueError, match=words):
            list(pictures(store, **wrong))
    command = [sys.executable, "-m", "spiral_atlas.cluster", "render", place]
    subprocess.run([*command, "-o", tmp_path], check=True)
    assert (tmp_path / "small-1.png").read_bytes() == first
    one = tmp_path / "one.png"
    subprocess.run(
        [*command, "--x", "phi0", "--y", "kappa1", "--at", "phi1=70deg", "--at", "kappa0=0.5", "-o", one], check=True
    )
    assert one.read_bytes().startswith(b"\x89PNG") and len(list(tmp_path.iterdir())) == 3


def test_a_run_that_has_nothing_to_do_writes_nothing(place, folder):
    before = {path: path.stat().st_mtime_ns for path in place.rglob("*")}
    assert check(place, workers=1).count("kept") == 36
    again = subprocess.run(
        [
            sys.executable,
            "-m",
            "spiral_atlas.cluster",
            "generate",
            folder / "small.toml",
            place,
            "--workers",
            "1",
            "--json",
        ],
        check=True,
        capture_output=True,
    )
    told = json.loads(again.stdout)
    assert told["shards"] == {"all": 36, "written": 0, "kept": 36, "missing": 0, "wrong": 0}
    assert told["id"] == spiral_atlas.open(place).id and told["nodes"] == 57_834
    command = [sys.executable, "-m", "spiral_atlas.cluster", "info", place]
    about = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    for line in ("small, cubic, by spiral-atlas", "; complete\n", "grid of 57,834 nodes", "36 shards of 8,8,8,16, in"):
        assert line in about, about
    assert "bit 3 SPIRAL" in about and '  fields = ["f0", "margin"]' in about
    assert {path: path.stat().st_mtime_ns for path in place.rglob("*")} == before


def test_what_is_not_written_is_no_verdict(folder, tmp_path):
    store = create(folder / "small.toml", tmp_path / "part.zarr", **SHAPES)
    assert write_shard(store, 0, threads=1).state == "written" and write_shard(store, 0).state == "kept"
    assert store.flags[20, 8, 17, 16] == store.solutions[20, 8, 17, 16] == 255 and np.isnan(
        store.scalar("f0")[20, 8, 17, 16]
    )
    inside = [[axis[0] for axis in store.axes.values()]]
    assert store.lookup(inside)[0].tolist() == [0]
    with pytest.raises(spiral_atlas.AtlasError, match="shard is missing"):
        store.lookup([[axis[-1] for axis in store.axes.values()]])
    with pytest.raises(ValueError, match="shards 0 to 35; given: 36"):
        write_shard(store, 36)
    with pytest.raises(FileNotFoundError, match="there is no store"):
        Store(tmp_path / "nowhere.zarr")
    with pytest.raises(FileNotFoundError):
        spiral_atlas.open(tmp_path / "nowhere.zarr")


def test_an_object_store_holds_the_same_for_few_requests(folder, atlas, place, monkeypatch):
    """A store behind a URL, of fsspec's kind as those of clouds are."""
    url, requests = "memory://atlases/small.zarr", []
    create(folder / "small.toml", url, **SHAPES)
    for name in ("get", "set", "delete"):

        def noted(self, key, *rest, name=name, plain=getattr(zarr.storage.FsspecStore, name), **options):
            requests.append((name, key))
            return plain(self, key, *rest, **options)

        monkeypatch.setattr(zarr.storage.FsspecStore, name, noted)
    store = Store(url, mode="r+", complete=False)
    # The metadata of the group and of nine arrays, and the values of four axes.
    assert len(requests) == 1 + 9 + 4
    requests.clear()
    write_shard(store, 7, threads=1)
    # Of each field what may be there goes, zarr looks whether any is left, and the new comes. The digest is looked up
    # before and written after.
    fields, digest = [f"{name}/c/0/1/0/1" for name in store.fields], "manifest/digests/c/0/1/0/1/0/0"
    wanted = [(what, key) for key in fields for what in ("delete", "get", "set")]
    assert requests == [("get", digest), *wanted, ("set", digest)]
    with pytest.raises(spiral_atlas.AtlasError, match="shards are missing"):
        spiral_atlas.open(url)
    # Made complete from the file; what is there stays.
    assert spiral_atlas.to_zarr(atlas, url).id == spiral_atlas.open(place).id
    store = spiral_atlas.open(url)
    store.check()
    assert np.array_equal(store.flags[...], atlas.flags) and np.array_equal(store.scalar("f0")[...], atlas.scalar("f0"))
    assert [png for png in pictures(store)] == [png for png in pictures(place)]
    with pytest.raises(ValueError, match="holds another atlas"):
        create({"family": "cubic", "atlas": [{"name": "a", "axes": dict.fromkeys(atlas.axes, {"values": [0.5]})}]}, url)


def test_recipes_of_several_atlases_need_a_name(tmp_path):
    axes = {name: {"values": [0.5, 0.7]} for name in ("phi0", "phi1", "kappa0", "kappa1")}
    edges = {name: {"linear": [0.2, 1.2]} for name in axes}
    cells = {"name": "c", "kind": "cells", "resolution": 2, "budget": "1 MiB", "axes": edges}
    recipe = {"family": "cubic", "atlas": [{"name": "a", "axes": axes}, {"name": "b", "axes": axes}, cells]}
    with pytest.raises(ValueError, match="several atlases.*choose among a, b"):
        create(recipe, tmp_path / "x.zarr")
    with pytest.raises(ValueError, match="no atlas `d`; it has a, b, c"):
        create(recipe, tmp_path / "x.zarr", atlas="d")
    with pytest.raises(ValueError, match="of cells"):
        create(recipe, tmp_path / "x.zarr", atlas="c")
    with pytest.raises(ValueError, match="phi0"):
        create(
            {"family": "cubic", "atlas": [{"name": "a", "axes": axes | {"phi0": {"values": [4.0]}}}]},
            tmp_path / "x.zarr",
        )
    assert not list(tmp_path.iterdir())
    assert create(recipe, tmp_path / "x.zarr", atlas="b").metadata["name"] == "b"


def test_shapes_are_whole_chunks_of_about_a_size():
    for counts in [(512,) * 4, (128,) * 4, (41, 1, 37, 43), (5, 3), (1 << 22,), (100_000, 7, 90), (17, 300, 2, 2, 900)]:
        for node in (2, 10):
            chunks, shards = shapes.usual(counts, node)
            shapes.check(counts, chunks, shards)
            assert np.prod(chunks) <= shapes.CHUNK_NODES and node * np.prod(shards) <= shapes.SHARD_BYTES
            wanted = min(shapes.SHARD_BYTES / node, max(shapes.LEAST_NODES, np.prod(counts) / shapes.SHARDS))
            assert min(wanted, np.prod(counts)) / 2 < np.prod(shards) <= max(wanted, np.prod(chunks))
    # Planes of the last two axes are large, because blocks of nodes are proved in them.
    assert shapes.usual((128,) * 4, 2) == ((8, 8, 128, 128), (32, 32, 128, 128))
    assert shapes.usual((512,) * 4, 2) == ((8, 8, 128, 128), (16, 16, 256, 256))
    # Shards of a user's have whole chunks, whatever they are.
    for given in [(64,) * 4, (8, 8, 4, 4), (45, 45, 45, 45), (1, 3 << 20)]:
        chunks, shards = shapes.usual([1 << 22] * len(given), 2, shards=given)
        shapes.check([1 << 22] * len(given), chunks, shards)
        assert shards == given and (np.prod(chunks) <= shapes.CHUNK_NODES or 45 in given)
    assert shapes.usual((16,) * 4, 2, chunks=(4, 8, 4, 4))[0] == (4, 8, 4, 4)
    for chunks, shards, words in [
        ((2, 2), (4, 3), "whole chunks"),
        ((0, 2), (4, 4), "at least 1"),
        ((2,), (4, 4), "2 sides"),
    ]:
        with pytest.raises(ValueError, match=words):
            shapes.check((9, 9), chunks, shards)
