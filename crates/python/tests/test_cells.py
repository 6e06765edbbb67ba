"""Certified cells from Python: they never contradict the family, and know most of the box."""

import numpy as np
import pytest
import spiral_atlas

AXES = {
    "phi0": {"linear": [0.2, 1.2]},
    "phi1": {"linear": [0.3, 1.4]},
    "kappa0": {"linear": [0.01, 1]},
    "kappa1": {"log": [0.1, 100]},
}
RECIPE = {
    "family": "cubic",
    "atlas": [{"name": "small", "kind": "cells", "resolution": 16, "budget": "1 MiB", "axes": AXES}],
}


@pytest.fixture(scope="module")
def cells() -> spiral_atlas.Cells:
    heard = []
    (made,) = spiral_atlas.generate(RECIPE, progress=lambda *all: heard.append(all))
    assert heard and all(name == "small" and of is None for name, _, of in heard)
    return made


@pytest.fixture(scope="module")
def points(cells) -> np.ndarray:
    rng = np.random.default_rng(2)
    return np.column_stack([rng.uniform(low, high, 20_000) for low, high in cells.bounds.values()])


def test_cells_agree_with_the_family(cells, points):
    inside, outside = cells.lookup(points)
    truth, _ = spiral_atlas.solve_batch("cubic", points)
    assert not np.any(inside & ~truth) and not np.any(outside & truth)
    spiral = 1 << list(cells.flag_docs).index("SPIRAL")
    assert ((inside | outside) & spiral != 0).mean() > 0.5
    assert np.array_equal(cells.verdict(points), truth)
    assert np.array_equal(cells.verdict(points, flags=spiral), truth & spiral)


def test_outside_the_box_nothing_is_known_and_verdict_solves(cells):
    point = [[0.7, 1.4, 0.4, 400.0]]
    inside, outside = cells.lookup(point)
    assert inside.tolist() == [0] and outside.tolist() == [0]
    truth, _ = spiral_atlas.solve_batch("cubic", point)
    assert cells.verdict(point).tolist() == truth.tolist()


def test_a_file_comes_back(tmp_path):
    (made,) = spiral_atlas.generate(RECIPE, tmp_path)
    opened = spiral_atlas.open_cells(tmp_path / "small.atlas.safetensors")
    opened.check()
    assert opened.resolution == 16 and opened.family == "cubic" and opened.path == made.path
    with pytest.raises(spiral_atlas.AtlasError, match="cells"):
        spiral_atlas.open(opened.path)


def test_bad_points_are_named(cells):
    with pytest.raises(ValueError, match="3 columns"):
        cells.lookup([[1.0, 2.0, 3.0]])
    with pytest.raises(ValueError, match="row 1.*phi0"):
        cells.verdict([[0.7, 1.4, 0.4, 4.0], [float("nan"), 1.4, 0.4, 4.0]])
