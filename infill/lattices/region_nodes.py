"""Regions of a part on a grid: which cells lie in them, and how much of the box around each node they cover."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.surface import Surface
from infill.voxels.scanlines import fill_rows, intersect_rows

SHIFTS = (  # of a cell: along every axis, the middles of its four quarters
    (-0.375, -0.125, 0.125),
    (0.125, 0.375, -0.375),
    (-0.125, 0.125, 0.375),
    (0.375, -0.375, -0.125),
)
FULL = np.float32(255)  # of a cover: the region covers all of the box
REST = "rest"  # the name of what is in no region


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedRegion:
    """A region whose numbers are checked and whose mesh is read.

    Parameters
    ----------
    text : str
        The region as the command line has it.
    place : str
        The place alone.
    density : float
    low, high : (3,) float64
        Its corners, mm.
    surface : Surface or None
        Its mesh, mm; None for a box.
    is_requested : bool
        False for a modifier that comes with the part.
    """

    text: str
    place: str
    density: float
    low: Floats
    high: Floats
    surface: Surface | None = None
    is_requested: bool = True

    def contains(
        self, space: Interior, counts: tuple[int, ...], *, step: float = 1.0, shift: Sequence[float] = (0, 0, 0)
    ) -> NDArray[np.bool_]:
        """Mark the points of a grid, `counts`, that lie in the region.

        Parameters
        ----------
        space : Interior
        counts : (nx, ny, nz)
        step : float
            From point to point, in cells of the space; the first point is its first cell.
        shift : (3,) float
            Of all points, in steps.
        """
        pitch = step * space.size
        if self.surface is None:
            sides = []
            for axis, count in enumerate(counts):
                places = space.origin[axis] + pitch * (np.arange(count) + shift[axis])
                sides.append((places >= self.low[axis]) & (places < self.high[axis]))
            within: NDArray[np.bool_] = sides[0][:, None, None] & sides[1][:, None] & sides[2]
            return within
        corners = (np.asarray(self.surface.vertices, dtype=np.float64) - space.origin) / pitch - shift
        return fill_rows(intersect_rows(corners, self.surface.faces, counts), counts)

    def cover(self, space: Interior, counts: tuple[int, ...], *, step: float) -> NDArray[np.uint8]:
        """Return how much of the box around each point of a grid the region covers, `counts`, from 0 to `FULL`."""
        if self.surface is None:
            sides = []
            for axis, count in enumerate(counts):
                ends = ((end[axis] - space.origin[axis]) / (step * space.size) for end in (self.low, self.high))
                low, high = (np.clip(end - np.arange(count), -0.5, 0.5) for end in ends)
                sides.append((high - low).astype(np.float32))
            shares: NDArray[np.float32] = np.einsum("i,j,k->ijk", *sides)
            return (shares * FULL).round().astype(np.uint8)
        covered = np.zeros(counts, dtype=np.uint8)
        for shift in SHIFTS:
            covered += self.contains(space, counts, step=step, shift=shift)
        return (covered * (FULL / len(SHIFTS))).astype(np.uint8)


@dataclass(frozen=True, kw_only=True, eq=False)
class RegionNodes:
    """Regions of different densities on the nodes of a grid; number 0 is the rest.

    Parameters
    ----------
    regions : tuple of PlacedRegion
        R of them; later ones lie over earlier ones.
    densities : (R + 1,) float64
        The requested ones.
    covers : tuple of (n, m, k) uint8
        How much of the box around a node a region covers, from 0 to `FULL`.
    ratios : (R + 1,) float64
        The widths of walls over the line width.
    """

    regions: tuple[PlacedRegion, ...]
    densities: Floats
    covers: tuple[NDArray[np.uint8], ...]
    ratios: Floats

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the rest and of the regions."""
        return (REST, *(region.place for region in self.regions))

    def paint(self, numbers: Floats) -> NDArray[np.float32]:
        """Return the number of the region at each node, (n, m, k); at borders, a mean."""
        painted = np.full(self.covers[0].shape, np.float32(numbers[0]))
        for cover, number in zip(self.covers, numbers[1:], strict=True):
            painted += cover * ((np.float32(number) - painted) / FULL)
        return painted

    def label(self, space: Interior, shift: Sequence[float]) -> NDArray[np.int16]:
        """Return the number of the region in which each cell of a space lies, when all are shifted, (nx, ny, nz)."""
        labels = np.zeros(space.shape, dtype=np.int16)
        for number, region in enumerate(self.regions, 1):
            labels[region.contains(space, space.shape, shift=shift)] = number
        return labels
