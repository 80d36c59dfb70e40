"""Read well-known text: one geometry, or one on each line; mm."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from infill.drawing import MOST_POINTS, Drawing, build_drawing, require_at_most
from infill.errors import FormatError
from infill.files.broken import error_text, wrap_reader_errors

if TYPE_CHECKING:
    from shapely import Geometry

LARGEST_FILE = 50_000_000  # bytes
DEEPEST = 20  # parentheses: a polygon has two, and collections hold others
WKT_ADVICE = "write lines as well-known text, such as LINESTRING (0 0, 10 5)"


def read_wkt(path: Path) -> Drawing:
    """Read the lines and the outlines of areas in a file of well-known text; points are left out."""
    import shapely

    with wrap_reader_errors(path, advice=WKT_ADVICE), np.errstate(invalid="ignore"):
        require_at_most(LARGEST_FILE, path.stat().st_size, "bytes")
        text = path.read_text(encoding="utf-8-sig").strip()
        _require_bounds(text)
        try:
            geometries = [shapely.from_wkt(text)]
        except shapely.errors.GEOSException:
            geometries = _parse_lines(path, text)
    parts = shapely.get_parts(geometries)
    while (shapely.get_type_id(parts) > 3).any():  # collections in collections
        parts = shapely.get_parts(parts)
    kinds = shapely.get_type_id(parts)
    areas = np.isin(kinds, [3])
    rings = shapely.get_rings(parts[areas])
    lines = [shapely.get_coordinates(line_or_ring) for line_or_ring in [*parts[np.isin(kinds, [1, 2])], *rings]]
    points = int((kinds == 0).sum())
    return build_drawing(path, lines, left_out={"point": points} if points else {})


def _require_bounds(text: str) -> None:
    """Raise TooComplexError for too many points, or too deep parentheses for a parser."""
    require_at_most(MOST_POINTS, text.count(","), "points or more")
    brackets = np.frombuffer(text.encode(), dtype=np.uint8)
    brackets = brackets[(brackets == ord("(")) | (brackets == ord(")"))]
    depth = np.where(brackets == ord("("), 1, -1).cumsum(dtype=np.int64)
    require_at_most(DEEPEST, depth.max(initial=0), "parentheses in one another")


def _parse_lines(path: Path, text: str) -> list[Geometry]:
    """Parse one geometry per line."""
    import shapely

    try:
        return [shapely.from_wkt(line) for line in text.splitlines() if line.strip()]
    except shapely.errors.GEOSException as error:
        raise FormatError(f"{path} is broken or not a .wkt file ({error_text(error)}); {WKT_ADVICE}") from error
