"""Atlases: made, opened, looked up, as xarray datasets, and what happens to bad ones."""

import os
import signal
import subprocess
import sys
import time
import tomllib

import numpy as np
import pytest
import spiral_atlas
import xarray as xr


def test_arrays_are_views_of_the_file(atlas):
    shape = tuple(len(axis) for axis in atlas.axes.values())
    assert atlas.flags.shape == atlas.solutions.shape == shape
    assert not atlas.flags.flags.writeable and not atlas.flags.flags.owndata
    with pytest.raises(ValueError, match="WRITEABLE"):
        atlas.flags.setflags(write=True)
        atlas.flags[...] = 0
    atlas.check()


def test_arrays_outlive_the_atlas(atlas_path):
    flags = spiral_atlas.open(atlas_path).flags
    assert int(flags.sum()) > 0


def test_lookup_finds_the_nearest_node(atlas):
    rng = np.random.default_rng(3)
    axes = list(atlas.axes.values())
    points = np.column_stack([rng.uniform(axis[0], axis[-1], 2000) for axis in axes])
    nodes, flags, solutions = atlas.lookup(points)
    expected = [np.abs(axis[:, None] - points[:, i]).argmin(axis=0) for i, axis in enumerate(axes)]
    assert np.array_equal(nodes, np.ravel_multi_index(expected, atlas.flags.shape))
    assert np.array_equal(flags, atlas.flags.ravel()[nodes])
    assert np.array_equal(solutions, atlas.solutions.ravel()[nodes])
    outside = points[:3].copy()
    outside[:, 2] = [1e9, np.nan, -np.inf]
    assert atlas.lookup(outside)[0].tolist() == [-1, -1, -1]
    with pytest.raises(ValueError, match="3 columns; the atlas has 4 axes"):
        atlas.lookup(points[:, :3])


def test_nodes_have_the_verdicts_of_their_data(atlas):
    nodes = np.random.default_rng(5).integers(0, atlas.flags.size, 500)
    index = np.unravel_index(nodes, atlas.flags.shape)
    data = np.column_stack([axis[i] for axis, i in zip(atlas.axes.values(), index, strict=True)])
    flags, solutions = spiral_atlas.solve_batch("cubic", data)
    assert np.array_equal(flags, atlas.flags[index]) and np.array_equal(solutions, atlas.solutions[index])


def test_xarray_opens_the_file_by_itself(atlas, atlas_path):
    with xr.open_dataset(atlas_path) as dataset:
        assert dataset.flags.dims == tuple(atlas.axes)
        assert dataset.phi0.attrs["units"] == "radian" and "units" not in dataset.kappa0.attrs
        bit = dataset.flags.attrs["flag_meanings"].split().index("SPIRAL")
        spiral = (dataset.flags & dataset.flags.attrs["flag_masks"][bit]) != 0
        assert int(spiral.sum()) == int((atlas.flags >> bit & 1).sum())
        part = dataset.flags.isel(phi0=[3, 1], kappa1=slice(2, 9, 3))
        assert np.array_equal(part.values, atlas.flags[[3, 1]][..., 2:9:3])
        assert dataset.attrs["family"] == "cubic"
    without = xr.open_dataset(atlas_path, drop_variables=["solutions"])
    assert without.data_vars.keys() == {"flags"} | set(atlas.scalar_docs)


def test_a_dictionary_is_a_recipe(recipe, atlas):
    told = []
    (made,) = spiral_atlas.generate(tomllib.loads(recipe.read_text()), progress=lambda *done: told.append(done))
    assert np.array_equal(made.flags, atlas.flags)
    assert told[-1] == (told[-1][0], atlas.flags.size, atlas.flags.size)
    # It has no file of its own.
    assert not os.path.exists(made.path)


def test_scalars_have_nan_where_there_is_no_value():
    values = {"phi0": [0.7], "phi1": [1.4], "kappa0": [0.4, 0.99], "kappa1": [4]}
    axes = {name: {"values": each} for name, each in values.items()}
    recipe = {"family": "cubic", "fields": ["f0"], "atlas": [{"name": "two", "axes": axes}]}
    (atlas,) = spiral_atlas.generate(recipe)
    f0 = atlas.scalar("f0").ravel()
    assert f0[0] == np.float32(1.66010274767) and f0[1] == spiral_atlas.NO_VALUE
    assert np.isnan(atlas.to_xarray().f0.values.ravel()).tolist() == [False, True]
    with pytest.raises(KeyError, match="no scalar `f9`; it has: f0"):
        atlas.scalar("f9")


def test_bad_files_and_recipes_are_told(tmp_path, atlas_path):
    with pytest.raises(FileNotFoundError):
        spiral_atlas.open(tmp_path / "missing.atlas.safetensors")
    cut = tmp_path / "cut.atlas.safetensors"
    cut.write_bytes(atlas_path.read_bytes()[:-1])
    with pytest.raises(spiral_atlas.AtlasError, match="cut.atlas.safetensors"):
        spiral_atlas.open(cut)
    damaged = bytearray(atlas_path.read_bytes())
    damaged[-1] ^= 1
    cut.write_bytes(damaged)
    with pytest.raises(spiral_atlas.AtlasError, match="`solutions`"):
        spiral_atlas.open(cut).check()
    with pytest.raises(ValueError, match="famly"):
        spiral_atlas.generate({"famly": "cubic"})
    with pytest.raises(TypeError, match="dictionary or the path"):
        spiral_atlas.generate(7)


def test_ctrl_c_stops_a_run_and_leaves_nothing(tmp_path):
    names = ("phi0", "phi1", "kappa0", "kappa1")
    axes = ", ".join(f"'{name}': {{'linear': [0.1, 1.4], 'count': 90}}" for name in names)
    code = (
        "import spiral_atlas, sys\n"
        f"recipe = {{'family': 'ph-quintic', 'atlas': [{{'name': 'slow', 'axes': {{{axes}}}}}]}}\n"
        "print('ready', flush=True)\n"
        "try: spiral_atlas.generate(recipe, sys.argv[1])\n"
        "except KeyboardInterrupt: sys.exit(7)\n"
    )
    with subprocess.Popen([sys.executable, "-c", code, str(tmp_path)], stdout=subprocess.PIPE) as run:
        assert run.stdout is not None and run.stdout.readline() == b"ready\n"
        while not any(tmp_path.iterdir()):
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        assert run.wait(timeout=60) == 7
    assert list(tmp_path.iterdir()) == []
