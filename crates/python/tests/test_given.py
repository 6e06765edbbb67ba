"""What is given wrongly is refused in a sentence that names it."""

import math

import numpy as np
import pytest
import spiral_atlas

DATUM = [0.7, 1.4, 0.4, 4.0]


@pytest.fixture(scope="module")
def curve() -> spiral_atlas.Curve:
    return spiral_atlas.fit((0, 0), (200, 0), -0.7, 1.4, 0.004, 0.04).curve


@pytest.mark.parametrize("ask", ["points", "curvature", "stations"])
@pytest.mark.parametrize(
    ("kind", "n", "words"),
    [
        (ValueError, 10**18, "n is 1000000000000000000; it must be from 2 to 1000000"),
        (ValueError, 10**40, "it must be from 2 to 1000000"),
        (ValueError, 1, "n is 1; it must be from 2 to 1000000"),
        (ValueError, -3, "n is -3; it must be from 2 to 1000000"),
        (TypeError, 2.5, "n is 2.5; it must be a whole number"),
        (TypeError, None, "n is None; it must be a whole number"),
    ],
)
def test_numbers_of_points_are_checked(curve, ask, kind, n, words):
    with pytest.raises(kind, match=words):
        getattr(curve, ask)(n)
    with pytest.raises(kind, match=words):
        curve.offset(1.0, n)


@pytest.mark.parametrize(
    ("kind", "rows", "words"),
    [
        (ValueError, [], r"have the shape \(0,\); it must be \(n, (4|k)\), a row for each"),
        (ValueError, DATUM, r"have the shape \(4,\); it must be \(n, (4|k)\), a row for each"),
        (ValueError, [[DATUM]], r"have the shape \(1, 1, 4\)"),
        (ValueError, [DATUM[:3]], "3 columns"),
        (ValueError, [DATUM, DATUM[:3]], "inhomogeneous"),
        (TypeError, [["0.7", "1.4", "0.4", "4"]], "are of the type <U3; they must be real numbers"),
        (TypeError, np.array([DATUM], dtype=complex), "are of the type complex128; they must be real numbers"),
        (TypeError, np.ma.masked_array([DATUM], mask=[[False, True, False, False]]), "are a masked array"),
    ],
)
def test_rows_are_checked(atlas, kind, rows, words):
    for ask in (atlas.lookup, lambda rows: spiral_atlas.solve_batch("cubic", rows)):
        with pytest.raises(kind, match=words):
            ask(rows)


def test_rows_of_any_layout_are_the_same_rows(atlas):
    # Several blocks, and a part of one.
    plain = np.tile(DATUM, (140_001, 1))
    plain[:, 3] += np.arange(len(plain)) / 1e4
    expected = atlas.lookup(plain)
    # One byte off what a double wants.
    apart = np.frombuffer(b"0" + plain.tobytes(), np.uint8)[1:].view(np.float64).reshape(plain.shape)
    for rows in (np.asfortranarray(plain), plain.astype(">f8"), np.repeat(plain, 2, axis=0)[::2], apart):
        assert all(map(np.array_equal, atlas.lookup(rows), expected))
    assert all(map(np.array_equal, spiral_atlas.solve_batch("cubic", apart), spiral_atlas.solve_batch("cubic", plain)))


def test_a_bad_row_of_a_later_block_is_counted_from_the_first():
    rows = np.tile(DATUM, (140_001, 1))
    rows[140_000, 0] = math.nan
    with pytest.raises(ValueError, match="row 140000: axis `phi0`"):
        spiral_atlas.solve_batch("cubic", rows)


@pytest.mark.parametrize("threads", [0, -1, 5000, 10**30])
def test_threads_are_checked(recipe, threads):
    words = f"threads is {threads}; it must be from 1 to 4096"
    with pytest.raises(ValueError, match=words):
        spiral_atlas.solve_batch("cubic", [DATUM], threads=threads)
    with pytest.raises(ValueError, match=words):
        spiral_atlas.generate(recipe, threads=threads)
    with pytest.raises(TypeError, match="whole number"):
        spiral_atlas.solve_batch("cubic", [DATUM], threads=1.5)


def test_counts_and_masks_are_checked(tmp_path):
    with pytest.raises(ValueError, match="most_pieces is -1; it must be 1 or more"):
        spiral_atlas.join((0, 0, 0, 0), (10, 5, 1, 0), 1, most_pieces=-1)
    with pytest.raises(ValueError, match="cells is -4; it must be from 1 to 4096"):
        spiral_atlas.boundary("cubic", ("kappa0", "kappa1"), ((0, 0.8), (0, 20)), cells=-4, phi0=0.7, phi1=1.4)
    axes = {"phi0": [0.2, 1.2], "phi1": [0.3, 1.4], "kappa0": [0.01, 1], "kappa1": [0.1, 100]}
    plan = {"name": "box", "kind": "cells", "resolution": 2, "budget": "1 MiB"}
    plan["axes"] = {name: {"linear": ends} for name, ends in axes.items()}
    (cells,) = spiral_atlas.generate({"family": "cubic", "atlas": [plan]})
    for flags in (-1, 256):
        with pytest.raises(ValueError, match=f"flags is {flags}; it must be from 0 to 255"):
            cells.verdict([DATUM], flags=flags)
    with pytest.raises(ValueError, match=r"shape \(0,\); it must be \(n, 4\)"):
        cells.lookup([])


def test_curves_of_a_family_without_control_points_are_refused():
    with pytest.raises(ValueError, match="^the answers of `reach-cubic` have no control points"):
        spiral_atlas.solve_batch("reach-cubic", np.empty((0, 3)), curves=True)


@pytest.mark.parametrize("opener", [spiral_atlas.open, spiral_atlas.open_cells])
def test_a_missing_file_is_named_once(opener):
    with pytest.raises(FileNotFoundError) as raised:
        opener("/none/x")
    assert str(raised.value).count("/none/x") == 1 and "os error" not in str(raised.value)
    assert raised.value.filename == "/none/x" and raised.value.errno == 2


def test_what_stands_in_the_way_of_a_folder_is_named(recipe, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError) as raised:
        spiral_atlas.generate(recipe, tmp_path / "file" / "x")
    assert str(raised.value).count(str(tmp_path)) == 1
