"""Drawings and pictures, independent of the file format that they came from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.plain_numbers import plain_argument, plain_number

Line = NDArray[np.float64]
Bounds = tuple[float, float, float, float]

LARGEST_COORDINATE = 1e5  # mm: beyond a hundred metres, a drawing is a mistake in its units
MOST_POINTS = 500_000  # with those of curves, before they are simplified
MOST_AT_ONCE = 5_000  # points that are simplified together
CHORD_TOLERANCE = 1e-4  # of the size of a drawing: how far its chords may lie from its curves


@dataclass(frozen=True, kw_only=True, eq=False)
class Drawing:
    """Lines of a drawing.

    Parameters
    ----------
    lines : tuple of (N, 2) float64
        Points in mm, y upwards; the first equals the last where a line is closed.
    page : (x0, y0, x1, y1), optional
        The page in mm, for formats that have one.
    left_out : tuple of str
        Content of the file besides lines, in words: "2 texts".
    """

    lines: tuple[Line, ...]
    page: Bounds | None = None
    left_out: tuple[str, ...] = ()

    @property
    def bounds(self) -> Bounds:
        """The smallest box around the lines, mm."""
        points = np.concatenate(self.lines)
        (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        return x0, y0, x1, y1


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """A picture of dark shapes on a light ground.

    Parameters
    ----------
    field : (columns, rows) float32
        From -1 (light) to +1 (dark), 0 midway between both; [x, y], y upwards.
    """

    field: NDArray[np.float32]


class TooComplexError(FormatError):
    """A drawing exceeds one of the limits that keep reading it fast; the message lacks the path."""


def require_at_most(limit: int, count: float, what: str) -> None:
    """Raise TooComplexError if a drawing has more items than the limit.

    >>> require_at_most(3, 4, "elements")
    Traceback (most recent call last):
    ...
    infill.drawing.TooComplexError: has 4 elements; the limit is 3
    """
    if count > limit:
        raise TooComplexError(f"has {count:.0f} {what}; the limit is {limit}")


def count_points(lines: Iterable[Line]) -> Iterator[Line]:
    """Yield the lines; raise TooComplexError as soon as they have more than MOST_POINTS points together."""
    points = 0
    for line in lines:
        points += len(line)
        require_at_most(MOST_POINTS, points, "points or more")
        yield line


def build_drawing(
    path: object, lines: list[Line], *, page: Bounds | None = None, left_out: dict[str, int] | None = None
) -> Drawing:
    """Simplify lines and return them as a drawing; raise FormatError if none remains or one is not finite."""
    left_out = dict(left_out or {})
    polylines = list({line.tobytes(): line for line in lines if len(line) > 1}.values())
    repeated = sum(len(line) > 1 for line in lines) - len(polylines)
    if repeated:
        left_out["repeated line"] = repeated
    omissions = tuple(f"{count} {what}{'s' if count > 1 else ''}" for what, count in left_out.items())
    if not polylines:
        hint = f", only {' and '.join(omissions)}" if omissions else ""
        raise FormatError(f"{path} holds no lines{hint}; draw outlines or strokes, and turn texts into paths")
    points = np.concatenate(polylines)
    largest = np.abs(points).max()
    if not largest <= LARGEST_COORDINATE:
        raise FormatError(
            f"{path} holds a point at {plain_argument(largest)} mm; the limit is {plain_number(LARGEST_COORDINATE, 6)} "
            "mm; check its units"
        )
    size = float(np.ptp(points, axis=0).max())
    if size == 0:
        raise FormatError(f"{path} holds lines without length; draw outlines or strokes")
    simplified = (_simplify(line, size * CHORD_TOLERANCE / 2) for line in polylines)
    with_length = tuple(line for line in simplified if (line != line[0]).any())
    return Drawing(lines=with_length, page=page, left_out=omissions)


def _simplify(line: Line, tolerance: float) -> Line:
    """Reduce the points of a line, part by part: over a long zigzag, GEOS recurses until the process ends."""
    import shapely

    starts = range(0, len(line) - 1, MOST_AT_ONCE)
    parts = [shapely.linestrings(line[start : start + MOST_AT_ONCE + 1]) for start in starts]
    simple = [shapely.get_coordinates(part) for part in shapely.simplify(parts, tolerance)]
    return np.concatenate([*(part[:-1] for part in simple), simple[-1][-1:]])
