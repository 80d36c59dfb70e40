r"""Rows of waves with straight flanks and flat crests, the common shape of families that touch but never cross.

::

        .------.          .------.      top
       /        \\        /        \
      /          \\      /          \\    height
    -'            '----'            '-  bottom
    |<---- period ---->|

Crests of neighbouring rows meet flat on flat. A flat keeps `bond` after both its corners are rounded, so
that rows touch at any radius: it is longer by twice what an arc takes from it, radius · tan(turn / 2).
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from infill.paths.families.family import TOUCH, Bounds, Family, NominalStrand, Path, PathSpec

BOND = 1.0  # line widths that crests touch along, at least


@dataclass(frozen=True, kw_only=True)
class Wave:
    """One wave of every row, mm: `base` is the height of its bottom, and `shift` the place of the middle of one."""

    period: float
    bottom: float
    top: float
    height: float
    base: float = 0.0
    shift: float = 0.0

    @property
    def length(self) -> float:
        """Return the length of line in one period, mm."""
        return self.bottom + self.top + 2 * math.hypot((self.period - self.bottom - self.top) / 2, self.height)


@dataclass(frozen=True, kw_only=True)
class Rows:
    """Waves that repeat every `pitch` mm across the rows, each row `slip` mm further on; turned by `angle` degrees."""

    waves: Sequence[Wave]
    pitch: float
    slip: float
    angle: float = 0.0

    @property
    def length_per_area(self) -> float:
        """Return mm of line per square millimetre."""
        return sum(wave.length for wave in self.waves) / (self.waves[0].period * self.pitch)


@dataclass(frozen=True, kw_only=True)
class WaveFamily(Family):
    """Rows of waves."""

    @abstractmethod
    def rows(self, spec: PathSpec) -> Rows:
        """Return the rows of waves of a layer."""

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return one line per row and wave."""
        return draw_rows(self.rows(spec), bounds)

    def nominal_strands(self, bounds: Bounds, spec: PathSpec) -> list[NominalStrand]:
        """Return the same lines, as if crests that touch lay on one another."""
        return draw_nominal_rows(self.rows(spec), spec.gap, bounds)

    def heights(self, cell: float) -> list[float]:  # noqa: ARG002 - where layers differ
        """Return the heights, mm, over which the mean of the density is taken."""
        return [0.0]

    def radius_of(self, spec: PathSpec) -> float:
        """Return the largest radius of corners, mm: as requested, or as large as lines allow."""
        return min(spec.radius, self.largest_radius(spec.cell, spec.line_width))

    def length_per_area(self, cell: float, line_width: float) -> float:
        """Return mm of line per square millimetre, in the mean over heights."""
        heights = self.heights(cell)
        rows = [self.rows(PathSpec(cell=cell, line_width=line_width, z=z)) for z in heights]
        return sum(layer.length_per_area for layer in rows) / len(heights)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density: lines come closer as cells shrink."""
        return solve_cell_for_density(lambda cell: self.length_per_area(cell, line_width), density, line_width)


def crest_length(line_width: float, radius: float, turn: float) -> float:
    """Return the length of a crest, mm, that keeps its bond after corners that turn by `turn` are rounded."""
    return BOND * line_width + 2 * radius * math.tan(turn / 2)


def draw_rows(rows: Rows, bounds: Bounds) -> list[Path]:
    """Draw one line per row and wave, from beyond one side of the box to beyond the other.

    >>> square = Wave(period=4, bottom=2, top=2, height=1)
    >>> [line[:3].tolist() for line in draw_rows(Rows(waves=[square], pitch=2, slip=0), (0, 0.2, 1, 0.8))][1]
    [[-5.0, 0.0], [-3.0, 0.0], [-3.0, 1.0]]
    """
    paths: list[Path] = []
    for wave in rows.waves:
        lines = repeat_line(
            _wave_corners(wave) + np.array([0.0, wave.base]),
            wave.period,
            rows.pitch,
            shift=wave.shift,
            slip=rows.slip,
            angle=rows.angle,
            bounds=bounds,
        )
        paths.extend(lines if wave.height else [line[[0, -1]] for line in lines])
    return paths


def draw_nominal_rows(rows: Rows, gap: float, bounds: Bounds) -> list[NominalStrand]:
    """Draw the lines of `draw_rows` as if crests that touch, `gap` mm apart, lay on one another.

    A crest that touches a straight line lies off by the entire gap, as the line stays in its place.
    """
    angle = math.radians(rows.angle)
    across = np.array([-math.sin(angle), math.cos(angle)])
    strands: list[NominalStrand] = []
    for number, wave in enumerate(rows.waves):
        below, above = rows.waves[number - 1], rows.waves[(number + 1) % len(rows.waves)]
        off = [0.0, 0.0] if not wave.height else [1.0 if beside.height else 2.0 for beside in (below, above)]
        nominal = replace(wave, base=wave.base - off[0] * gap / 2, height=wave.height + (off[0] + off[1]) * gap / 2)
        corners = _wave_corners(nominal)
        sides = np.where(corners[:, 1] > 0, -off[1], off[0])
        lines = draw_rows(replace(rows, waves=[nominal]), bounds)
        strands.extend(NominalStrand(points=line, sides=np.resize(sides, len(line)), across=across) for line in lines)
    return strands


def repeat_line(
    corners: Path,
    period: float,
    pitch: float,
    *,
    shift: float = 0.0,
    slip: float = 0.0,
    angle: float = 0.0,
    bounds: Bounds,
) -> list[Path]:
    """Repeat a line in rows, each from beyond one side of a box to beyond the other.

    Parameters
    ----------
    corners : (N, 2) float64
        Of one period, mm: the first at x <= 0, the last at x >= 0. The next ones begin `period` further along x.
    period, pitch, shift, slip : float
        mm: period along a row, distance of rows, offset of row 0 along the row, and of each row from the one below.
    angle : float
        Degrees by which all lines are turned.
    bounds : (x0, y0, x1, y1)
        mm.
    """
    x0, y0, x1, y1 = _turned_bounds(bounds, -angle)
    lowest = math.floor((y0 - corners[:, 1].max()) / pitch)
    highest = math.ceil((y1 - corners[:, 1].min()) / pitch)
    row = np.arange(lowest, highest + 1, dtype=np.float64)
    row_offset = (shift + row * slip) % period
    column = np.arange(math.floor(x0 / period) - 1, math.ceil(x1 / period) + 1, dtype=np.float64)
    x = ((column * period)[:, None] + corners[:, 0]).ravel() + row_offset[:, None]
    y = np.tile(corners[:, 1], len(column)) + (row * pitch)[:, None]
    return list(_turn(np.stack([x, y], axis=-1), angle))


def solve_cell_for_density(length_per_area: Callable[[float], float], density: float, line_width: float) -> float:
    """Solve for the cell, mm, of a density, for a family whose lines come closer as cells shrink."""
    target_length = density / (TOUCH * line_width)
    low, high = TOUCH * line_width, 1000 * line_width / density
    for _ in range(60):  # halvings in the logarithm: to 1e-15 of the cell
        middle = math.sqrt(low * high)
        low, high = (middle, high) if length_per_area(middle) > target_length else (low, middle)
    return math.sqrt(low * high)


def _wave_corners(wave: Wave) -> Path:
    """Return the corners of one period, (2 to 4, 2); a flat of no length is one corner."""
    middle = wave.period / 2
    low = [(-wave.bottom / 2, 0.0), (wave.bottom / 2, 0.0)] if wave.bottom > 0 else [(0.0, 0.0)]
    high = [(middle - wave.top / 2, wave.height), (middle + wave.top / 2, wave.height)]
    return np.array(low + (high if wave.top > 0 else [(middle, wave.height)]))


def _turn(points: Path, angle: float) -> Path:
    """Turn points (N, 2) by `angle` degrees about (0, 0)."""
    if not angle:
        return points
    from patterns.linework import turn

    return turn(points, angle)


def _turned_bounds(bounds: Bounds, angle: float) -> Bounds:
    """Return the bounding box of a box that is turned by `angle` degrees about (0, 0)."""
    corners = _turn(np.array([[x, y] for x in bounds[::2] for y in bounds[1::2]], dtype=np.float64), angle)
    (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return x0, y0, x1, y1
