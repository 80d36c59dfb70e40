"""A grid: a box divided into equal cells."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.checks import check_positive, check_whole_number
from infill.errors import ParameterError

SOLID = 1.0
VOID = -1.0


def spacing_of(spacing: float | tuple[float, ...], dimensions: int) -> tuple[float, ...]:
    """Return the cell size of each axis, or raise ParameterError.

    >>> spacing_of(0.5, 2)
    (0.5, 0.5)
    """
    sizes = tuple(spacing) if np.ndim(spacing) else (spacing,)  # type: ignore[arg-type]
    if len(sizes) == 1:
        sizes = sizes * dimensions  # type: ignore[assignment]
    if len(sizes) != dimensions:
        raise ParameterError.about(
            "spacing", f"has {len(sizes)} numbers for {dimensions} axes; give one, or one per axis"
        )
    return tuple(check_positive("spacing", size, "mm") for size in sizes)  # type: ignore[arg-type]


@dataclass(frozen=True, kw_only=True)
class Grid:
    """Equal cells filling a box, in two or three dimensions (any number works).

    Parameters
    ----------
    shape : (nx, ny[, nz])
        Number of cells.
    spacing : float or (hx, hy[, hz])
        Cell size, mm.
    origin : (x, y[, z])
        Lower corner of the box, mm; zeros if left out.

    Raises
    ------
    ParameterError
        For sizes that are not finite and positive.

    Notes
    -----
    Cell i of an axis spans origin + i h to origin + (i + 1) h; its centre is midway.

    >>> Grid(shape=(4, 2), spacing=0.5).extents
    (2.0, 1.0)
    """

    shape: tuple[int, ...]
    spacing: float | tuple[float, ...]
    origin: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Check all sizes and turn scalars into one number per axis."""
        shape = tuple(check_whole_number("a number of cells", count, 1) for count in self.shape)
        if not shape:
            raise ParameterError("shape is empty; give one number of cells per axis")
        origin = tuple(float(x) for x in self.origin) or (0.0,) * len(shape)
        if len(origin) != len(shape) or not all(math.isfinite(x) for x in origin):
            raise ParameterError.about("origin", f"is {origin}; it must hold {len(shape)} finite numbers, one per axis")
        object.__setattr__(self, "shape", shape)
        object.__setattr__(self, "spacing", spacing_of(self.spacing, len(shape)))
        object.__setattr__(self, "origin", origin)

    @property
    def cell_size(self) -> NDArray[np.float64]:
        """Cell size of each axis, mm."""
        return np.array(self.spacing)

    @property
    def extents(self) -> tuple[float, ...]:
        """Size of the box, mm."""
        return tuple(float(x) for x in self.cell_size * self.shape)

    @property
    def cells(self) -> int:
        """Number of cells."""
        return math.prod(self.shape)

    def centres(self, axis: int) -> NDArray[np.float64]:
        """Return the cell centres along one axis, (n,), mm."""
        count, size, lower = self.shape[axis], self.cell_size[axis], self.origin[axis]
        centres: NDArray[np.float64] = lower + size * (np.arange(count) + 0.5)
        return centres
