"""Proved atlases of spiral regions.

Given two end points, tangents and curvatures: is there a transition curve of monotone curvature of a given family, and
which one? Every verdict is proved for the float64 numbers given.

>>> import spiral_atlas
>>> answer = spiral_atlas.solve("cubic", phi0="40deg", phi1="80deg", kappa0=0.4, kappa1=4)
>>> answer["flags"]["SPIRAL"]
True
"""

from ._core import (
    NO_VALUE,
    Atlas,
    AtlasError,
    Cells,
    Curve,
    Fit,
    Join,
    NoPathError,
    UndecidedError,
    __version__,
    boundary,
    families,
    fit,
    generate,
    join,
    nearest,
    open_cells,
    ranges,
    solve,
    solve_batch,
)
from ._paths import path
from ._stores import open, to_safetensors, to_zarr

__all__ = [
    "NO_VALUE",
    "Atlas",
    "AtlasError",
    "Cells",
    "Curve",
    "Fit",
    "Join",
    "NoPathError",
    "UndecidedError",
    "__version__",
    "boundary",
    "families",
    "fit",
    "generate",
    "join",
    "nearest",
    "open",
    "open_cells",
    "path",
    "ranges",
    "solve",
    "solve_batch",
    "to_safetensors",
    "to_zarr",
]
