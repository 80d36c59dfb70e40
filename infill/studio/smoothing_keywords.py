"""The keywords of the smoothing functions, from options by the names of the command line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from infill.studio.equivalents import Code

SMOOTHING = ("steps", "fidelity", "interface", "alpha")  # fields of `infill.Smoothing`
RENAMED = {"smooth_radius": "radius"}


def smoothing_code(values: Mapping[str, Any]) -> dict[str, Code]:
    """Return the keyword `smoothing`, if an option decides it.

    >>> smoothing_code({"steps": 5, "voxel": 1.0})
    {'smoothing': Code(text='Smoothing(steps=5)')}
    """
    parameters = [f"{name}={values[name]!r}" for name in SMOOTHING if values.get(name) is not None]
    return {"smoothing": Code(f"Smoothing({', '.join(parameters)})")} if parameters else {}


def shared_keywords(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keywords that all smoothing functions share, from options by field."""
    keywords: dict[str, Any] = dict(smoothing_code(values))
    for name, value in values.items():
        if name == "refine":
            if value:
                keywords["method"] = "refine"
        elif name not in SMOOTHING:
            keywords[RENAMED.get(name, name)] = value
    if values.get("fidelity") is not None:
        keywords["method"] = "plain"
    return keywords
