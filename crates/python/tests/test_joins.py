"""Joins of two states, checked from their points alone."""

import json
import math

import numpy as np
import pytest
import spiral_atlas

EXIT = ((0.0, 0.0, 0.0, 0.0), (180.0, 150.0, math.radians(100), 0.0), 1 / 60)


@pytest.mark.parametrize("family", ["cubic", "ph-quintic", "trig-quintic", "involute", "clothoid"])
def test_a_join_meets_its_ends_and_keeps_the_limit(family):
    found = spiral_atlas.join(*EXIT, family=family, longest=600)
    assert found and found.reason is None and found.curve is not None
    curve = found.curve
    assert (curve.start, curve.kind) == ((0, 0), "path") and np.allclose(curve.end, (180, 150), atol=1e-9)
    at = curve.stations(2001)
    assert at["heading"][0] == pytest.approx(0, abs=1e-9) and at["heading"][-1] == pytest.approx(EXIT[1][2], abs=1e-9)
    assert np.abs(at["curvature"]).max() <= EXIT[2] * (1 + 1e-9)
    assert found.curvature_range[1] <= EXIT[2] and curve.length == pytest.approx(found.length, rel=1e-12)
    # Curvature is continuous: no step between neighbours is larger than the greatest rate allows.
    step = found.length / 2000
    assert np.abs(np.diff(at["curvature"])).max() <= 1.01 * step * max(map(abs, found.rate_range))
    assert sum(piece.length for piece in curve.pieces) == pytest.approx(curve.length, rel=1e-12)
    assert spiral_atlas.Curve.from_dict(json.loads(json.dumps(curve.to_dict()))) == curve


def test_objectives_and_bounds_are_kept():
    short = spiral_atlas.join(*EXIT)
    smooth = spiral_atlas.join(*EXIT, objective="greatest-rate", longest=400)
    assert smooth.length <= 400 and max(map(abs, smooth.rate_range)) < max(map(abs, short.rate_range))
    none = spiral_atlas.join(*EXIT, longest=200)
    assert not none and none.curve is None and math.isnan(none.length) and "200" in none.reason


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"greatest_curvature": 0}, "greatest curvature"),
        ({"end": (math.nan, 0, 0, 0)}, "end x is NaN"),
        ({"family": "spline"}, "spline"),
        ({"objective": "beauty"}, "beauty"),
    ],
)
def test_bad_requests_are_named(change, words):
    request = dict(zip(("start", "end", "greatest_curvature"), EXIT)) | change
    with pytest.raises(ValueError, match=words):
        spiral_atlas.join(**request)


def test_pieces_that_do_not_join_are_no_curve():
    line = {"kind": "line", "start": [0, 0], "end": [1, 0]}
    with pytest.raises(ValueError, match="must join"):
        spiral_atlas.Curve.from_dict({"pieces": [line, line]})
