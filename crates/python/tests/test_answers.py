"""Answers for one datum and for many, and curves between two ends."""

import json
import math

import numpy as np
import pytest
import spiral_atlas

DATUM = {"phi0": 0.7, "phi1": 1.4, "kappa0": 0.4, "kappa1": 4.0}
ENDS = ((0.0, 0.0), (200.0, 0.0), -0.7, 1.4, 0.004, 0.04)


def test_solve_finds_the_published_root():
    # Habib & Sakai, section 3.2, example 1.
    answer = spiral_atlas.solve("cubic", **DATUM)
    chosen = answer["solutions"][answer["chosen"]]
    assert (round(chosen["f0"], 6), round(chosen["f1"], 6)) == (1.660103, 0.769851)
    assert answer["flags"]["SPIRAL"] is True
    assert answer["phi0"] == 0.7


def test_angles_may_be_texts():
    told = spiral_atlas.solve("cubic", **DATUM | {"phi0": "40deg"})
    assert told["phi0"] == math.radians(40)


@pytest.mark.parametrize(
    ("kind", "family", "change", "words"),
    [
        (ValueError, "cubique", {}, "no family is named `cubique`"),
        (TypeError, "cubic", {"phi2": 1.0}, "given: phi0, phi1, kappa0, kappa1, phi2"),
        (TypeError, "cubic", {"phi0": [1.0]}, "phi0 is [1.0]; it must be a number"),
        (ValueError, "cubic", {"phi0": math.nan}, "phi0"),
        (ValueError, "cubic", {"kappa0": -math.inf}, "kappa0"),
        (ValueError, "cubic", {"phi0": "forty"}, "phi0"),
    ],
)
def test_bad_data_are_told(kind, family, change, words):
    with pytest.raises(kind) as raised:
        spiral_atlas.solve(family, **DATUM | change)
    assert words in str(raised.value)


def test_a_batch_equals_single_answers():
    rng = np.random.default_rng(7)
    data = np.column_stack(
        [rng.uniform(0.05, 1.5, 300), rng.uniform(0.06, 1.5, 300), rng.uniform(0.01, 1, 300), rng.uniform(0.2, 60, 300)]
    )
    flags, solutions = spiral_atlas.solve_batch("cubic", data)
    about = next(f for f in spiral_atlas.families() if f["name"] == "cubic")
    for row, flag, count in zip(data, flags, solutions, strict=True):
        answer = spiral_atlas.solve("cubic", **dict(zip(DATUM, row, strict=True)))
        assert answer["flags"] == {f["name"]: bool(flag >> bit & 1) for bit, f in enumerate(about["flags"])}
        assert answer["counts"] == {c["name"]: count >> c["shift"] & (2 ** c["bits"] - 1) for c in about["counts"]}
    # Of any strides, number of threads and length.
    for threads in (1, 3):
        again, _ = spiral_atlas.solve_batch("cubic", np.asfortranarray(data), threads=threads)
        assert np.array_equal(flags, again)
    assert spiral_atlas.solve_batch("cubic", np.empty((0, 4)))[0].shape == (0,)


@pytest.mark.parametrize("family", ["cubic", "ph-quintic"])
def test_curves_of_a_batch_are_those_of_single_answers(family):
    rng = np.random.default_rng(8)
    data = np.column_stack(
        [rng.uniform(0.3, 1, 40), rng.uniform(0.9, 1.5, 40), rng.uniform(0.05, 0.6, 40), rng.uniform(1, 20, 40)]
    )
    flags, solutions, points = spiral_atlas.solve_batch(family, data, curves=True)
    assert all(map(np.array_equal, (flags, solutions), spiral_atlas.solve_batch(family, data)))
    each = next(f["control_points"] for f in spiral_atlas.families() if f["name"] == family)
    assert points.shape == (40, each, 2)
    chosen = 0
    for row, curve in zip(data, points, strict=True):
        answer = spiral_atlas.solve(family, **dict(zip(DATUM, row, strict=True)))
        if answer["chosen"] is None:
            assert np.isnan(curve).all()
        else:
            chosen += 1
            assert np.array_equal(curve, answer["solutions"][answer["chosen"]]["control_points"])
    assert 0 < chosen < 40
    assert spiral_atlas.solve_batch(family, np.empty((0, 4)), curves=True)[2].shape == (0, each, 2)
    with pytest.raises(ValueError, match="no control points"):
        spiral_atlas.solve_batch("any-spiral", data, curves=True)


def test_a_batch_names_the_bad_row():
    data = np.tile(np.array(list(DATUM.values())), (5, 1))
    data[3, 1] = np.nan
    with pytest.raises(ValueError, match="row 3: .*phi1"):
        spiral_atlas.solve_batch("cubic", data)
    with pytest.raises(ValueError, match="3 columns"):
        spiral_atlas.solve_batch("cubic", data[:, :3])


@pytest.mark.parametrize("family", ["cubic", "ph-quintic", "involute"])
def test_a_fit_meets_its_ends(family):
    fit = spiral_atlas.fit(*ENDS, family=family)
    assert fit and fit.reason is None and fit.curve in fit.solutions
    curve = fit.curve
    assert (curve.start, curve.end) == ENDS[:2]
    told = curve.stations(101)
    assert np.allclose([told["heading"][0], told["heading"][-1]], ENDS[2:4], rtol=0, atol=1e-12)
    assert np.allclose([told["curvature"][0], told["curvature"][-1]], ENDS[4:], rtol=1e-11)
    assert np.all(np.diff(told["curvature"]) > 0)
    assert told["station"][-1] == curve.length
    assert np.array_equal(curve.points(101), np.column_stack([told["x"], told["y"]]))
    beside = curve.offset(2.0, 101) - curve.points(101)
    assert np.allclose(np.hypot(*beside.T), 2.0)
    assert spiral_atlas.Curve.from_dict(json.loads(json.dumps(curve.to_dict()))) == curve


def test_a_fit_that_fails_says_why():
    fit = spiral_atlas.fit((0, 0), (200, 0), (1.0, -0.5), (1.0, 2.0), 0.03, 0.04)
    assert not fit and fit.curve is None and "curvature" in fit.reason
    too_long = spiral_atlas.fit(*ENDS, longest=200.5)
    assert not too_long and "200.5" in too_long.reason
    with pytest.raises(ValueError, match="both"):
        spiral_atlas.fit((1, 2), (1, 2), *ENDS[2:])
    with pytest.raises(ValueError, match="must be cubic, ph-quintic or involute"):
        spiral_atlas.fit(*ENDS, family="clothoid")


def test_a_curve_is_drawn():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    axes = spiral_atlas.fit(*ENDS).curve.plot(color="black")
    (line,) = axes.lines
    assert line.get_xydata().shape == (200, 2) and line.get_color() == "black"
