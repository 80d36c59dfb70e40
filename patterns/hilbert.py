"""Hilbert's curve: one line that visits the squares of a lattice, each after a neighbour."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import format_decimal
from patterns.errors import PatternError
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

ORDER = 24  # the curve visits 2^ORDER squares in each direction
# Square (0, 0) is a third of the way along both sides, where large quadrants never meet: 0101… in binary.
ORIGIN = (2**ORDER - 1) // 3


@dataclass(frozen=True, kw_only=True)
class Hilbert(Pattern):
    """The one curve of order 24, through the middles of squares of side `cell`, in a frame; (0, 0) is between squares.

    There is 1 / `cell` mm of line per square millimetre. Source: Hilbert, Math. Ann. 38 (1891) 459-460.
    """

    name: ClassVar[str] = "hilbert"
    summary: ClassVar[str] = "one line, folded through the region; equally stiff in x and y"
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

        corners = turn(shapely.get_coordinates(shapely.envelope(region)) - self.phase, -self.angle) - self.cell / 2
        parts = hilbert_curve(np.concatenate([corners.min(axis=0), corners.max(axis=0)]), self.cell)
        placed_parts = [turn(part + self.cell / 2, self.angle) + np.array(self.phase) for part in parts]
        lines = clip([shapely.LineString(part) for part in placed_parts], region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between neighbouring lines, mm."""
        return self.cell


def hilbert_curve(bounds: NDArray[np.float64], cell: float) -> list[NDArray[np.float64]]:
    """Return the parts of the curve that cover a box, by their corners: (N, 2) each, mm.

    Parameters
    ----------
    bounds : (x0, y0, x1, y1)
        mm.
    cell : float
        Side of a square, mm; the middle of one square is (0, 0).

    Raises
    ------
    PatternError
        If the box reaches beyond the curve, millions of squares away.
    """
    import numpy as np

    low, high = np.floor(np.array(bounds[:2]) / cell) - 1, np.ceil(np.array(bounds[2:]) / cell) + 1
    if max(-low.min(), high.max()) > ORIGIN:
        raise PatternError(
            f"the cell is {format_decimal(cell)} mm; Hilbert's curve reaches {ORIGIN} cells: give a larger one"
        )
    axes = [
        np.arange(low_square, high_square + 1, dtype=np.int64)
        for low_square, high_square in zip(low, high, strict=True)
    ]
    square = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    number = hilbert_index(square[:, 0] + ORIGIN, square[:, 1] + ORIGIN)
    order = np.argsort(number)
    square, number = square[order], number[order]
    breaks = np.flatnonzero(np.diff(number) != 1) + 1
    return [_corners(part) * cell for part in np.split(square, breaks) if len(part) > 1]


def hilbert_index(x: NDArray[np.int64], y: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the position of squares along the curve, int64; source: Hilbert, Math. Ann. 38 (1891).

    >>> import numpy as np
    >>> hilbert_index(np.array([0, 0, 1, 1]), np.array([0, 1, 1, 0])).tolist()
    [0, 3, 2, 1]
    """
    import numpy as np

    x, y, number = x.copy(), y.copy(), np.zeros(x.shape, dtype=np.int64)
    for bit in range(ORDER - 1, -1, -1):
        right, up = x >> bit & 1, y >> bit & 1
        number = number << 2 | (3 * right ^ up)
        # A lower quadrant is mirrored about a diagonal: about the falling one on the right, the rising one on the left.
        flip = (up == 0) & (right == 1)
        x, y = np.where(flip, ~x, x), np.where(flip, ~y, y)
        x, y = np.where(up == 0, y, x), np.where(up == 0, x, y)
    return number


def _corners(square: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the squares at which the curve turns, and its ends: (N, 2) float64."""
    import numpy as np

    step = np.diff(square, axis=0)
    turns = np.ones(len(square), dtype=bool)
    turns[1:-1] = (step[1:] != step[:-1]).any(axis=-1)
    return square[turns].astype(np.float64)
