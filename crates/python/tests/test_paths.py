"""The path tools, checked from their points and by each other."""

import math

import numpy as np
import pytest
import spiral_atlas

LINE = {"kind": "line", "start": (0, 0), "direction": 0, "end": (1, 0)}


def test_a_spline_goes_through_its_points_and_is_measured():
    points = np.array([[0, 0], [1, 1], [2, 0], [3, 1]], float)
    found = spiral_atlas.path("spline", points=points)
    (path,) = found["paths"]
    assert [piece["start"] for piece in path["pieces"]] == points[:-1].tolist()
    measured = spiral_atlas.path("measure", paths=found["paths"], samples=3, offset=0.1)["paths"][0]
    assert measured["length"] == pytest.approx(path["length"], rel=1e-12) and len(measured["samples"]) == 3
    curve = spiral_atlas.Curve.from_dict(path)
    assert curve.length == pytest.approx(path["length"], rel=1e-12)
    again = spiral_atlas.path("measure", paths=[curve])["paths"][0]
    assert again["length"] == measured["length"] and "offset" not in again


def test_vehicles_that_arrive_together_are_told_apart():
    ends = [
        {"start": (0, y), "end": (10, y), "start_direction": "20deg", "end_direction": math.radians(-20)}
        for y in (0.0, 2.0)
    ]
    paths = spiral_atlas.path("equal-length", length=11, paths=ends)["paths"]
    assert all(path["length"] == pytest.approx(11, rel=1e-12) for path in paths)
    # The second is the first, moved: the distance of points of one time is that of the starts.
    kept = spiral_atlas.path("separation", paths=paths, minimum=1.99)
    assert kept["verdict"] == "kept" and kept["pairs"][0]["closest"]["at_most"] == pytest.approx(2, rel=1e-9)
    assert spiral_atlas.path("separation", paths=paths, minimum=2.01)["verdict"] == "violated"


def test_the_other_tools_answer_too():
    ends = {"start": (0, 0), "end": (1, 0)}
    hermite = spiral_atlas.path("hermite", **ends, start_derivative=(1, 1), end_derivative=(1, -1))["paths"][0]
    assert hermite["absolute_rotation"] == pytest.approx(math.pi / 2) and len(hermite["candidates"]) == 4
    least = spiral_atlas.path("least-curvature", **ends, start_direction=0.5, end_direction=-0.5, free="length")
    assert 0 < least["at_least"] <= least["paths"][0]["greatest_curvature"]
    scene = {"start": (0, 0), "goal": (10, 0), "obstacles": [[(4, -1), (6, -1), (6, 1), (4, 1)]], "clearance": 0.2}
    plan = spiral_atlas.path("plan", **scene, greatest_curvature=2)["paths"][0]
    assert plan["clearance"]["at_least"] >= 0.2 and plan["curvature_at_most"] <= 2
    ring = [[(4, -3), (5, -3), (5, 3), (4, 3)], [(-5, -3), (-4, -3), (-4, 3), (-5, 3)]]
    ring += [[(-5, 3), (5, 3), (5, 4), (-5, 4)], [(-5, -4), (5, -4), (5, -3), (-5, -3)]]
    none = spiral_atlas.path("plan", **{**scene, "obstacles": ring}, greatest_curvature=2)
    assert none["paths"] == [] and none["reason"]


@pytest.mark.parametrize(
    ("tool", "request_", "error", "words"),
    [
        ("splines", {}, ValueError, "unknown tool `splines`; known are `hermite`"),
        ("spline", {"points": [(0, 0), (1, "x")]}, ValueError, "points[1][1]"),
        ("spline", {"points": [(0, 0), (1, math.nan)]}, ValueError, "JSON compliant"),
        ("spline", {"points": {1, 2}}, TypeError, "no form in JSON"),
        ("spline", {"points": [(0, 0), (1, 1)], "close": True}, ValueError, "close"),
        ("separation", {"paths": [], "minimum": 1}, ValueError, "it takes two"),
        ("measure", {"paths": [{"pieces": []}]}, ValueError, "paths[0]"),
        ("measure", {"paths": [{"pieces": [LINE]}], "samples": 1}, ValueError, "samples"),
    ],
)
def test_what_is_wrong_is_named(tool, request_, error, words):
    with pytest.raises(error) as raised:
        spiral_atlas.path(tool, **request_)
    assert words in str(raised.value)
