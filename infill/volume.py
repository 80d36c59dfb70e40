"""A volume: numbers on cells, and the position of those cells in space."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.errors import ParameterError
from infill.grid import spacing_of

AXES = 3
SKEW = 1e-4  # tolerance for stored directions against a rotation: files keep few digits


@dataclass(frozen=True, kw_only=True)
class Volume:
    """Values on a grid that may be rotated and mirrored in space.

    Parameters
    ----------
    values : (nx, ny, nz) array
        [x, y, z] of the grid; booleans or real numbers.
    spacing : float or (hx, hy, hz)
        Cell size along each axis of the grid, mm.
    origin : (x, y, z)
        Lower corner of the first cell, mm; its centre lies half a cell further along every axis.
    direction : (3, 3) float
        Column i is the direction in space of axis i of the grid.
    space : str
        Name of the coordinate system of space: "LPS" (left, posterior, superior) for medical images, else empty.
    warnings : tuple of str
        Assumptions and warnings of the reader of the file, a line each.

    Raises
    ------
    ParameterError
        If there are not three axes with cells, or sizes or directions are invalid.

    >>> Volume(values=np.ones((2, 2, 2)), spacing=0.5).place(np.array([[0.0, 0.0, 4.0]])).tolist()
    [[0.0, 0.0, 4.0]]
    """

    values: NDArray[np.generic]
    spacing: float | tuple[float, ...] = 1.0
    origin: tuple[float, ...] = (0.0, 0.0, 0.0)
    direction: ArrayLike = field(default_factory=lambda: np.eye(AXES))
    space: str = ""
    warnings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Check all sizes."""
        values = np.asarray(self.values)
        if values.ndim != AXES or values.size == 0:
            raise ParameterError(f"the volume has the shape {values.shape}; give three axes [x, y, z] with cells")
        if not (values.dtype == bool or np.issubdtype(values.dtype, np.integer) or values.dtype.kind == "f"):
            raise ParameterError(f"the volume is of type {values.dtype}; give real numbers or booleans")
        origin = tuple(float(x) for x in self.origin)
        if len(origin) != AXES or not all(math.isfinite(x) for x in origin):
            raise ParameterError.about("origin", f"is {origin}; it must hold 3 finite numbers")
        direction = np.asarray(self.direction, dtype=np.float64)
        if direction.shape != (AXES, AXES) or not np.allclose(direction.T @ direction, np.eye(AXES), atol=SKEW):
            raise ParameterError.about(
                "direction", f"is {direction.tolist()}; it must be 3 x 3, its columns of length 1 and square"
            )
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "spacing", spacing_of(self.spacing, AXES))
        object.__setattr__(self, "origin", origin)
        object.__setattr__(self, "direction", direction)

    @property
    def cell_size(self) -> NDArray[np.float64]:
        """Cell size of each axis, mm."""
        return np.array(self.spacing)

    @property
    def cell_volume(self) -> float:
        """Volume of one cell, mm³."""
        return float(np.prod(self.cell_size))

    @property
    def mirrored(self) -> bool:
        """True if the axes of the grid are left-handed, so that a surface placed in space is turned inside out."""
        return bool(np.linalg.det(np.asarray(self.direction)) < 0)

    def place(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Convert points (N, 3), mm along the grid's axes from its lower corner, to coordinates in space.

        Where the grid lies at the origin, these are the points themselves, not a copy.
        """
        turn, origin = np.asarray(self.direction), np.array(self.origin)
        if (turn == np.eye(AXES)).all():
            return points + origin if origin.any() else np.asarray(points, dtype=np.float64)
        placed: NDArray[np.float64] = points @ turn.T + origin
        return placed
