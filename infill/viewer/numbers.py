"""The most important numbers of a report, as a page shows them beside the picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final

from infill.plain_numbers import count_noun, plain_size

# By key of the report, a section's keys with a dot: the name of the row, and the text of the value.
ROWS: Final[Mapping[str, tuple[str, Callable[[Any], str]]]] = {
    "request.pattern": ("pattern", str),
    "density": ("density", lambda density: f"{density:.1%}"),
    "extents": ("size", lambda size: plain_size(*size, digits=4)),
    "volume": ("volume", lambda volume: plain_size(volume, digits=6, power=3)),
    "volume_change": ("volume, changed", lambda change: f"{change:+z.2%}"),
    "infill.cell": ("cell", lambda cell: plain_size(cell, digits=4)),
    "infill.line_width": ("line width", lambda width: plain_size(width, digits=4)),
    "wall_width.mean": ("wall width", plain_size),
    "walls.least": ("thinnest shell", plain_size),
    "components": ("components", lambda count: f"{count:,}"),
    "voids.count": ("voids", lambda count: f"{count:,}"),
    "drains.count": ("drains", lambda count: f"{count:,}"),
    "triangles": ("triangles", lambda count: f"{count:,}"),
    "closed": ("watertight", lambda closed: "yes" if closed else "no"),
    "verdict.word": ("verdict", str),
    "problems": ("problems", "; ".join),
}


def list_numbers(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the rows of a page: names and values of those numbers that a report has.

    >>> list_numbers({"triangles": 1200, "density": 0.2, "problems": [], "closed": True})
    [('density', '20.0%'), ('triangles', '1,200'), ('watertight', 'yes')]
    """
    rows = []
    for key, (name, text) in ROWS.items():
        value: Any = report
        for part in key.split("."):
            value = value.get(part) if isinstance(value, Mapping) else None
        if value is not None and value != []:
            rows.append((name, text(value)))
    return rows


def describe_surfaces(triangles: int, surfaces: int) -> str:
    """Return a sentence about a picture, for those who cannot see it.

    >>> describe_surfaces(1200, 1)
    '1,200 triangles'
    >>> describe_surfaces(1200, 3)
    '3 surfaces, 1,200 triangles'
    """
    counted = f"{triangles:,} triangles"
    return counted if surfaces == 1 else f"{count_noun(surfaces, 'surface')}, {counted}"
