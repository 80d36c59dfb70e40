"""Cross: Sierpinski's curve, one line around a tree of crosses, with upright or winding walls."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar

from patterns.declared import format_decimal, parameter
from patterns.errors import PatternError
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

ORDER = 24
ORIGIN = (2**ORDER - 1) // 3  # of 2^ORDER nodes a side: 0101… in binary, where large crosses never meet
SIDE = math.sqrt(2) - 1  # of an octagon as wide as the distance between nodes


@dataclass(frozen=True, kw_only=True)
class Cross(Pattern):
    """Sierpinski's curve of order 24 in a frame, with all its steps `cell` long.

    It runs along regular octagons with squares between them: along the upright and level sides of those inside a cross,
    and the slanted sides of the others. Neighbouring lines are at least `cell` apart. There are
    4 (sqrt(2) - 1)^2 / `cell` mm of line per square millimetre: 0.69 / `cell`.

    Source: Sierpinski, "Sur une nouvelle courbe continue qui remplit toute une aire plane", Bull. Acad. Sci.
    Cracovie A (1912) 462-478; as drawn by Wirth, Algorithms + Data Structures = Programs (1976), section 3.3.
    """

    name: ClassVar[str] = "cross"
    summary: ClassVar[str] = "one line around a tree of crosses: soft in every direction"
    paths: ClassVar[bool] = True

    cell: float = cell_parameter(4.0)
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the parts of the curve in the region, and the frame."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, clip, turn

        pitch = self.cell / SIDE
        corners = turn(shapely.get_coordinates(shapely.envelope(region)) - self.phase, -self.angle) / pitch
        low, high = np.floor(corners.min(axis=0)), np.ceil(corners.max(axis=0))
        if max(-low.min(), high.max()) > ORIGIN:
            raise PatternError(
                f"the cell is {format_decimal(self.cell)} mm; the curve reaches {ORIGIN} octagons: give a larger one"
            )
        parts = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(curve_segments(low, high))))
        placed_lines = shapely.transform(parts, lambda ends: turn(ends * pitch, self.angle) + np.array(self.phase))
        lines = clip(placed_lines, region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the least distance between neighbouring lines, mm."""
        return self.cell


@dataclass(frozen=True, kw_only=True)
class Cross3D(Cross):
    """Sierpinski's curve whose walls wind upwards like the thread of a screw, half a cell about their place.

    Walls of every direction lean to and fro, never by more than `lean`: a part yields to pressure from above as it
    does to pressure from the side.
    """

    name: ClassVar[str] = "cross-3d"
    summary: ClassVar[str] = "the walls of cross, winding upwards: soft in every direction, from above too"
    prismatic: ClassVar[bool] = False
    paths: ClassVar[bool] = False

    lean: float = parameter(45.0, "how far walls lean from upright, at most", unit="deg", low=5.0, high=60.0)

    @property
    def height(self) -> float:
        """Height of one turn of the walls, mm."""
        return math.pi * self.cell / math.tan(math.radians(self.lean))

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:
        """Return the parts of the curve in the region at a height, and the frame."""
        x, y = self._shift(z)
        parameters = {field.name: getattr(self, field.name) for field in fields(Cross)}
        return Cross(**{**parameters, "phase": (float(x), float(y))}).lines(region)

    def level_set(self, x: NDArray[np.float64], y: NDArray[np.float64], z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return 1 on one side of the walls, in the connected octagons, and -1 on the other."""
        import numpy as np

        from patterns.linework import turn

        position = turn(np.stack([x, y], axis=-1) - np.stack(self._shift(z), axis=-1), -self.angle) / (self.cell / SIDE)
        node = np.round(position)
        distance = np.abs(position - node).sum(axis=-1)
        power = (node.astype(np.int64) + ORIGIN) & -(node.astype(np.int64) + ORIGIN)
        return np.where((distance < 0.5 + SIDE / 2) & (power[..., 0] != power[..., 1]), 1.0, -1.0)

    def _shift(self, z: float | NDArray[np.float64]) -> tuple[Any, Any]:
        """Return how far the cross is shifted in x and y at a height, mm."""
        import numpy as np

        turned = 2 * math.pi * np.asarray(z) / self.height + math.radians(self.angle)
        return self.phase[0] + self.cell / 2 * np.cos(turned), self.phase[1] + self.cell / 2 * np.sin(turned)


def curve_segments(low: NDArray[np.float64], high: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the segments of the curve around the nodes of a box from `low` to `high`, by their ends: (N, 2, 2).

    Lengths are distances between nodes; `low` and `high` are (2,).

    Notes
    -----
    Four curves of one order form a curve of the next order where their corners meet: it runs along the outside of the
    gap between them, instead of the four corners. Curves meet at a node if the same power of 2 divides both its
    coordinates. Two such nodes are never neighbours: one coordinate would be odd in both.

    >>> import numpy as np
    >>> len(curve_segments(np.array([0.0, 0.0]), np.array([9.0, 9.0])))
    400
    """
    import numpy as np

    axes = [np.arange(low_node, high_node + 1).astype(np.int64) for low_node, high_node in zip(low, high, strict=True)]
    node = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 1, 1, 2)
    power = (node + ORIGIN) & -(node + ORIGIN)
    is_meeting = (power[..., 0] == power[..., 1]).ravel()
    half_width, half_side = 0.5, SIDE / 2
    upright = np.array([[(x, -half_side), (x, half_side)] for x in (-half_width, half_width)])
    straight = np.concatenate([upright, upright[..., ::-1]])
    slanted = np.array(
        [[(x * half_width, y * half_side), (x * half_side, y * half_width)] for x in (-1, 1) for y in (-1, 1)]
    )
    return np.concatenate(
        [(node[is_meeting] + straight).reshape(-1, 2, 2), (node[~is_meeting] + slanted).reshape(-1, 2, 2)]
    )
