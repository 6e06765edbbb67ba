"""The path tools, with fields as keywords."""

import json
from typing import Any, Literal

from . import _core


def path(
    tool: Literal["hermite", "equal-length", "least-curvature", "spline", "plan", "separation", "measure"],
    /,
    **request: Any,
) -> dict[str, Any]:
    """Answers a request to a path tool: `path("spline", points=[(0, 0), (1, 1), (2, 0), (3, 1)])`.

    Args:
        tool: "hermite", "equal-length", "least-curvature", "spline", "plan", "separation" or "measure".
        request: the fields of docs/path.md; numbers, lists, NumPy arrays, curves. The options of the commands are
            fields too: `minimum` of separation, `samples` and `offset` of measure, `paper` of equal-length. Angles are
            radians, or text such as "40deg".

    Returns:
        The dictionary that the command prints. `paths` of one answer may be `paths` of the next request, and
        `Curve.from_dict` reads each of them. Where there is no path such as was asked for, `paths` is empty, and
        `reason` says why.

    Raises:
        ValueError: an unknown tool, a field that is wrong, or a value outside its domain.
        TypeError: a value that has no form in JSON.
    """
    text = json.dumps(request, allow_nan=False, default=_plain)
    answer: dict[str, Any] = json.loads(_core.path(tool, text))
    return answer


def _plain(value: Any) -> Any:
    for name in ("tolist", "to_dict"):
        if hasattr(value, name):
            return getattr(value, name)()
    raise TypeError(f"{value!r} has no form in JSON")
