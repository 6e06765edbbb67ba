"""Ranges, the nearest datum and outlines."""

import math

import numpy as np
import pytest
import spiral_atlas

ANGLES = {"phi0": "40deg", "phi1": "80deg"}


def holds(**datum):
    return spiral_atlas.solve("cubic", **datum)["flags"]["SPIRAL"]


def test_ranges_end_where_the_verdict_changes():
    found = spiral_atlas.ranges("cubic", "kappa1", (0, 100), **ANGLES, kappa0=0.4)
    [only] = found["ranges"]
    low, high = only["ends"]
    assert holds(**ANGLES, kappa0=0.4, kappa1=low) and holds(**ANGLES, kappa0=0.4, kappa1=high)
    assert not holds(**ANGLES, kappa0=0.4, kappa1=math.nextafter(low, 0))
    assert not holds(**ANGLES, kappa0=0.4, kappa1=math.nextafter(high, 100))
    assert found["open"] == []


def test_the_nearest_datum_has_the_property():
    keep = {"phi0": math.inf, "phi1": math.inf}
    found = spiral_atlas.nearest("cubic", weights=keep, **ANGLES, kappa0=1, kappa1=2)
    assert holds(**found["point"]) and found["point"]["phi0"] == math.radians(40)
    assert found["at_least"] <= found["distance"] <= 1.01 * found["at_least"]


def test_an_outline_parts_yes_from_no():
    found = spiral_atlas.boundary("cubic", ("kappa0", "kappa1"), ((0, 0.8), (0, 20)), cells=64, **ANGLES)
    [(points, closed)] = found["outlines"]
    assert closed and points.shape[1] == 2 and points.dtype == np.float64
    inside = points.mean(axis=0)
    assert holds(**ANGLES, kappa0=inside[0], kappa1=inside[1])
    assert not holds(**ANGLES, kappa0=0.05, kappa1=19)


@pytest.mark.parametrize(
    ("kind", "call", "words"),
    [
        (TypeError, lambda: spiral_atlas.ranges("cubic", "kappa1", (0, 1), **ANGLES), "given: phi0, phi1, kappa1"),
        (TypeError, lambda: spiral_atlas.ranges("cubic", "phi0", (0, 1), **ANGLES), "phi0 is given"),
        (ValueError, lambda: spiral_atlas.ranges("cubic", "kappa1", (1, 1), kappa0=0.4, **ANGLES), "1.0 to 1.0"),
        (ValueError, lambda: spiral_atlas.nearest("cubic", weights={"x": 1}, kappa0=1, kappa1=2, **ANGLES), '"x"'),
        (ValueError, lambda: spiral_atlas.nearest("cubic", flag="LOOP", kappa0=1, kappa1=2, **ANGLES), "LOOP"),
    ],
)
def test_what_cannot_be_asked_is_told(kind, call, words):
    with pytest.raises(kind) as raised:
        call()
    assert words in str(raised.value)
