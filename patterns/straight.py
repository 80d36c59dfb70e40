"""Patterns of straight lines: parallel ones, in one or several directions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

Direction = tuple[float, float]  # degrees, and the shift of lines to their left, in distances


@dataclass(frozen=True, kw_only=True)
class Straight(Pattern):
    """Parallel lines, `cell` apart, in one or several directions.

    There are `len(directions)` / `cell` mm of line per square millimetre.
    """

    directions: ClassVar[tuple[Direction, ...]] = ()

    cell: float = cell_parameter()
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the lines, each from one side of the region to the other, and the frame."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, clip

        corners = shapely.get_coordinates(shapely.envelope(region)) - self.phase
        line_sets = [
            parallel_lines(corners, distance=self.cell, angle=self.angle + direction, shift=shift)
            for direction, shift in self.directions
        ]
        lines = clip(shapely.linestrings(np.concatenate(line_sets) + np.array(self.phase)), region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between neighbouring parallel lines, mm."""
        return self.cell


def parallel_lines(
    corners: NDArray[np.float64], *, distance: float, angle: float, shift: float = 0.0
) -> NDArray[np.float64]:
    """Return parallel lines across the box around points (N, 2): (L, 2, 2), in their unit; `shift` is in distances.

    Parameters
    ----------
    distance : float
        Distance between neighbours.
    angle : float
        Angle of the lines to the x axis, degrees.
    shift : float
        Shift of the lines to the left of a line through (0, 0), in distances.

    >>> import numpy as np
    >>> parallel_lines(np.array([[0.0, 0.0], [2.0, 1.0]]), distance=1, angle=0, shift=0.5)[:, 0, 1].tolist()
    [-0.5, 0.5, 1.5]
    """
    import numpy as np

    from patterns.linework import turn

    along, across = turn(np.asarray(corners, dtype=np.float64), -angle).T
    low_number, high_number = (np.floor(across.min() / distance - shift), np.ceil(across.max() / distance - shift))
    position = (np.arange(low_number, high_number + 1) + shift) * distance
    ends = np.stack(np.broadcast_arrays([along.min() - distance, along.max() + distance], position[:, None]), axis=-1)
    return turn(ends, angle)


@dataclass(frozen=True, kw_only=True)
class Rectilinear(Straight):
    """Parallel lines in a frame."""

    name: ClassVar[str] = "rectilinear"
    summary: ClassVar[str] = "parallel walls; stiff along them, and open from end to end"
    paths: ClassVar[bool] = True
    directions: ClassVar[tuple[Direction, ...]] = ((0.0, 0.0),)


@dataclass(frozen=True, kw_only=True)
class Grid(Straight):
    """Squares in a frame."""

    name: ClassVar[str] = "grid"
    summary: ClassVar[str] = "squares: stiff in two directions"
    paths: ClassVar[bool] = True
    directions: ClassVar[tuple[Direction, ...]] = ((0.0, 0.0), (90.0, 0.0))


@dataclass(frozen=True, kw_only=True)
class Triangles(Straight):
    """Equilateral triangles, `cell` high, in a frame."""

    name: ClassVar[str] = "triangles"
    summary: ClassVar[str] = "equilateral triangles: as stiff in every direction as walls can be"
    paths: ClassVar[bool] = True
    directions: ClassVar[tuple[Direction, ...]] = ((0.0, 0.0), (60.0, 0.0), (120.0, 0.0))


@dataclass(frozen=True, kw_only=True)
class TriHexagon(Straight):
    """Hexagons with triangles between them, in a frame: never more than two lines meet."""

    name: ClassVar[str] = "tri-hexagon"
    summary: ClassVar[str] = "hexagons and triangles: as stiff as triangles, with fewer crossings"
    paths: ClassVar[bool] = True
    directions: ClassVar[tuple[Direction, ...]] = ((0.0, 0.0), (60.0, 0.0), (120.0, 0.5))
