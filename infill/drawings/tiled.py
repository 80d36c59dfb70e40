"""A drawing that is repeated, as a pattern of upright walls."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.drawings.drawing_files import read_tile
from infill.plain_numbers import plain_argument
from patterns.declared import parameter
from patterns.errors import PatternError
from patterns.linework import clip, turn
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter

MOST_PLACED = 2_000_000  # points of all copies of a tile in a region
FINEST = 0.005  # mm: in more copies, points that lie nearer to the line through the others are left out


class TooManyCopiesError(PatternError):
    """The copies of a tile in a region have too many points; `excess` says how many, without a remedy."""

    excess = ""

    @classmethod
    def at(cls, cell: float, excess: str) -> Self:
        """Return the error for a cell, mm."""
        error = cls.about(
            "cell",
            f"is {plain_argument(cell, 3)} mm: {excess}; give a larger cell, a lower density or a simpler drawing",
        )
        error.excess = excess
        return error


@dataclass(frozen=True, kw_only=True, eq=False)
class Tiled(Pattern):
    """The lines of a tile that is repeated, or drawn once; one tile has its middle at (0, 0).

    Parameters
    ----------
    name : str
        Of the file.
    drawn : tuple of (N, 2) float64
        Lines about the middle of the tile, whose width is 1.
    height : float
        Of the tile.
    cell : float
        Width of the tile, mm.
    angle : float
        Degrees.
    repeat : bool
        False for a single tile.
    """

    name: str  # type: ignore[misc]
    summary: str = "a drawing, repeated"  # type: ignore[misc]
    drawn: tuple[NDArray[np.float64], ...]
    height: float
    cell: float = cell_parameter()
    angle: float = angle_parameter()
    repeat: bool = parameter(True, "the drawing again and again; false for once, in the middle", unit="")

    def lines(self, region: shapely.Polygon | shapely.MultiPolygon, z: float = 0.0) -> shapely.MultiLineString:  # noqa: ARG002 - prismatic
        """Return the lines of all tiles, clipped to a region; raise TooManyCopiesError for too many points."""
        corners = turn(shapely.get_coordinates(shapely.envelope(region)), -self.angle) / self.cell
        drawn, points = self.drawn, np.concatenate(self.drawn)
        size = np.array([1.0, self.height])
        lower = np.floor((corners.min(axis=0) - points.max(axis=0)) / size)
        upper = np.ceil((corners.max(axis=0) - points.min(axis=0)) / size)
        if not self.repeat:
            lower = upper = np.zeros(2)
        copies = int(np.prod(upper - lower + 1))
        if copies * len(points) > MOST_PLACED:
            drawn = _straighten(drawn, FINEST / self.cell)
            points = np.concatenate(drawn)
        if copies * len(points) > MOST_PLACED:
            excess = (
                f"{copies:,} copies of {self.name} have {copies * len(points):,} points; the limit is {MOST_PLACED:,}"
            )
            raise TooManyCopiesError.at(self.cell, excess)
        column, row = np.meshgrid(np.arange(lower[0], upper[0] + 1), np.arange(lower[1], upper[1] + 1), indexing="ij")
        shifts = np.stack([column.ravel(), row.ravel()], axis=-1) * size
        placed = [shapely.linestrings(turn((line[None] + shifts[:, None]) * self.cell, self.angle)) for line in drawn]
        return clip(np.concatenate(placed), region)

    def line_spacing(self, region: shapely.Polygon | shapely.MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the width of the tile, mm."""
        return self.cell


def _straighten(lines: tuple[NDArray[np.float64], ...], tolerance: float) -> tuple[NDArray[np.float64], ...]:
    """Leave out points of lines that lie within a tolerance of the rest."""
    simplified = shapely.simplify([shapely.linestrings(line) for line in lines], tolerance, preserve_topology=False)
    return tuple(shapely.get_coordinates(line) for line in simplified)


def is_drawn_once(pattern: object) -> bool:
    """Tell whether a pattern is a single drawing."""
    return isinstance(pattern, Tiled) and not pattern.repeat


def read_tiled(path: str | os.PathLike[str]) -> Tiled:
    """Read a drawing as a pattern.

    Parameters
    ----------
    path : str or Path
        As `read_drawing` takes it. The tile is that of `refill`: the page, or the box around the lines.

    Raises
    ------
    FormatError
        See `read_drawing`.
    """
    drawing = read_tile(path)
    assert drawing.page is not None
    x0, y0, x1, y1 = drawing.page
    middle, width = np.array([(x0 + x1) / 2, (y0 + y1) / 2]), x1 - x0
    lines = tuple((np.asarray(line, dtype=np.float64) - middle) / width for line in drawing.lines)
    lines = tuple(line for line in lines if len(line) > 1 and math.isfinite(float(line.sum())))
    return Tiled(name=Path(path).name, drawn=lines, height=(y1 - y0) / width)
