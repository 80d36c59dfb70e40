"""Hilbert's curve: one line that visits the squares of a lattice, each after a neighbour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.filling.families.protocol import TOUCH, Bounds, Path

ORDER = 24  # the curve visits 2^ORDER squares in each direction
# Square (0, 0) is a third of the way along both sides, where large quadrants never meet: 0101… in binary.
ORIGIN = (2**ORDER - 1) // 3


@dataclass(frozen=True, kw_only=True)
class Hilbert:
    """The one curve of order 24 about (0, 0), in squares of side `cell`, as far as the box reaches."""

    name: str = "hilbert"
    summary: str = "one line that folds itself through the region, equally stiff in both directions"
    prismatic: bool = True
    wide: bool = True

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,  # noqa: ARG002 - lines stand alone
        z: float,  # noqa: ARG002 - every layer is equal
        layer: int,  # noqa: ARG002
        radius: float,  # noqa: ARG002 - corners need no room
    ) -> list[Path]:
        """Return the parts of the curve in the box; see `Family`."""
        low, high = np.floor(np.array(bounds[:2]) / cell) - 1, np.ceil(np.array(bounds[2:]) / cell) + 1
        if max(-low.min(), high.max()) > ORIGIN:
            raise ParameterError(f"the cell is {cell:g} mm; Hilbert's curve reaches {ORIGIN} cells: give a larger one")
        axes = [np.arange(first, last + 1, dtype=np.int64) for first, last in zip(low, high, strict=True)]
        square = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
        number = numbers(square[:, 0] + ORIGIN, square[:, 1] + ORIGIN)
        order = np.argsort(number)
        square, number = square[order], number[order]
        breaks = np.flatnonzero(np.diff(number) != 1) + 1
        return [_corners(part) * cell for part in np.split(square, breaks) if len(part) > 1]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the radius at which the arcs of a step meet, mm: of corners taken wide."""
        return cell


def numbers(x: NDArray[np.int64], y: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the place of squares along the curve, int64; source: Hilbert, Math. Ann. 38 (1891).

    >>> numbers(np.array([0, 0, 1, 1]), np.array([0, 1, 1, 0])).tolist()
    [0, 3, 2, 1]
    """
    x, y, number = x.copy(), y.copy(), np.zeros(x.shape, dtype=np.int64)
    for bit in range(ORDER - 1, -1, -1):
        right, up = x >> bit & 1, y >> bit & 1
        number = number << 2 | (3 * right ^ up)
        # A lower quadrant is mirrored about a diagonal: about the falling one on the right, the rising one on the left.
        flip = (up == 0) & (right == 1)
        x, y = np.where(flip, ~x, x), np.where(flip, ~y, y)
        x, y = np.where(up == 0, y, x), np.where(up == 0, x, y)
    return number


def _corners(square: NDArray[np.int64]) -> Path:
    """Return the squares at which the curve turns, and its ends: (N, 2) float64."""
    step = np.diff(square, axis=0)
    turns = np.ones(len(square), dtype=bool)
    turns[1:-1] = (step[1:] != step[:-1]).any(axis=-1)
    return square[turns].astype(np.float64)
