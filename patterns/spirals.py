"""Evenly spaced spirals of two arms: one line from the edge of the region to its middle and out again.

Nested rings become a spiral when their upper halves are moved half a gap to the right, and their lower halves half a
gap to the left: each half then ends where another begins. Neighbours keep their distance, and the line has no end
inside a region: everywhere it is a wall between two voids.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

SAGITTA = 5e-4  # of a cell: deviation of a chord from its arc
TIPS = 8  # of an octagram
BEYOND = 2  # turns beyond the farthest corner


@dataclass(frozen=True, kw_only=True)
class Spiral(Pattern):
    """One line about the middle of the region, in a frame; `phase` moves its middle.

    There is 1 / `cell` mm of line per square millimetre.

    Attributes
    ----------
    half : callable
        Takes the number of rings inside a ring, and returns its upper half: (N, 2), from (1, 0) to (-1, 0).
    inscribed : float
        Radius of the circle that the sides of such a ring touch.
    """

    half: ClassVar[Callable[[int], NDArray[np.float64]]]
    inscribed: ClassVar[float]

    cell: float = cell_parameter()
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the spiral in the region, and the frame."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, bounds_centre, clip, turn

        centre = bounds_centre(region) + self.phase
        farthest = float(np.linalg.norm(shapely.get_coordinates(shapely.envelope(region)) - centre, axis=1).max())
        spiral = turn(self.draw_turns(farthest / self.cell) * self.cell, self.angle) + centre
        lines = clip([shapely.LineString(spiral)], region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between neighbouring turns, mm."""
        return self.cell

    def draw_turns(self, reach: float) -> NDArray[np.float64]:
        """Return a spiral whose turns are 1 apart, about (0, 0), to beyond `reach`: (N, 2)."""
        import numpy as np

        gap = 1 / self.inscribed  # along the axis
        arm = []
        for number in range(math.ceil(reach) + BEYOND):
            ring = type(self).half(number) * (number + 0.5) * gap
            if number % 2 == 0:  # above the axis, clockwise; ends on the right, where the next one begins
                ring = ring[::-1] + np.array([gap / 2, 0.0])
            else:
                ring = ring * np.array([1.0, -1.0]) - np.array([gap / 2, 0.0])
            ring[[0, -1]] = np.round(ring[[0, -1]] / gap) * gap  # on the axis, to the last bit
            arm.append(ring[1:])
        half_line = np.concatenate(arm)
        return np.concatenate([-half_line[::-1], [(0.0, 0.0)], half_line])


def half_circle(inside: int) -> NDArray[np.float64]:
    """Return points (N, 2) of half a unit circle, more of them the more circles are inside it; see `Spiral`."""
    import numpy as np

    chords = math.ceil(math.pi / math.acos(1 - SAGITTA / (inside + 0.5)) / 2)
    angle = np.linspace(0, math.pi, chords + 1)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def half_star(inside: int = 0) -> NDArray[np.float64]:  # noqa: ARG001 - all are alike
    """Return half the outline of two squares, one turned by 45 degrees, by its tips and notches; see `Spiral`.

    >>> half_star().round(3)[:3].tolist()
    [[1.0, 0.0], [0.707, 0.293], [0.707, 0.707]]
    """
    import numpy as np

    angle = np.arange(TIPS + 1) * math.pi / TIPS
    notch = math.cos(math.pi / 4) / math.cos(math.pi / TIPS)
    radius = np.where(np.arange(TIPS + 1) % 2 == 0, 1.0, notch)
    tips: NDArray[np.float64] = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return tips


@dataclass(frozen=True, kw_only=True)
class ArchimedeanChords(Spiral):
    """A round spiral in a frame: half circles about two middles.

    From its second turn on it is nowhere more than 0.15 `cell` away from Archimedes' spiral of two arms, whose radius
    is `cell` / pi times the angle. The arms of that spiral converge in the middle; these are evenly spaced.
    """

    name: ClassVar[str] = "archimedean-chords"
    summary: ClassVar[str] = "a round spiral, in and out again; no corners"
    paths: ClassVar[bool] = True
    half: ClassVar[Callable[[int], NDArray[np.float64]]] = staticmethod(half_circle)
    inscribed: ClassVar[float] = 1.0


@dataclass(frozen=True, kw_only=True)
class OctagramSpiral(Spiral):
    """A spiral of stars with eight tips in a frame; parallel sides of neighbours are `cell` apart."""

    name: ClassVar[str] = "octagram-spiral"
    summary: ClassVar[str] = "a spiral of eight-pointed stars: walls in four directions"
    paths: ClassVar[bool] = True
    half: ClassVar[Callable[[int], NDArray[np.float64]]] = staticmethod(half_star)
    inscribed: ClassVar[float] = math.cos(math.pi / 4)
