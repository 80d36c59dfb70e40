"""Regions of a part on a grid: which cells lie in them, and how much of the box around each node they cover."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.meshes.distance import TriangleTree
from infill.meshes.winding import winding_numbers
from infill.options.resolve_pattern import Kind
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.partial import distances_in_cells
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
    density : float or None
        None for that of the part, as with the next two.
    kind, pattern : Kind and str, or None
        Its pattern, or a class of patterns, and the name of that.
    wall : float or None
        Thickness of the shell, mm.
    low, high : (3,) float64
        Its corners, mm.
    surface : Surface or None
        Its mesh, mm; None for a box.
    is_requested : bool
        False for a modifier that comes with the part.
    number : int
        Among all regions, from 1 on; 0 while it is alone.
    """

    text: str
    place: str
    low: Floats
    high: Floats
    density: float | None = None
    kind: Kind | None = None
    pattern: str | None = None
    wall: float | None = None
    surface: Surface | None = None
    is_requested: bool = True
    number: int = 0

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

    def ends(self, bounds: Floats) -> Floats:
        """Return the corners of its box, (2, 3) mm: not finite where it goes as far as the bounds (2, 3) of a part."""
        low, high = (
            np.where(self.low <= bounds[0], -np.inf, self.low),
            np.where(self.high >= bounds[1], np.inf, self.high),
        )
        return np.array([low, high])

    def measure_depths(self, cells: Volume, bounds: Floats, reach: float, threads: int | None) -> NDArray[np.float32]:
        """Measure how far the centres of cells lie inside the region, (nx, ny, nz) in cells; outside, it is negative.

        Parameters
        ----------
        cells : Volume
        bounds : (2, 3) float64
            Of the part, mm: a box that goes as far goes on.
        reach : float
            Cells at which distances are cut off.
        threads : int, optional
        """
        size, shape = float(cells.cell_size[0]), cells.values.shape
        start = np.array(cells.origin) + size / 2
        if self.surface is None:
            depths = np.full(shape, np.float32(reach))
            for axis, (low, high) in enumerate(self.ends(bounds).T):
                places = start[axis] + size * np.arange(shape[axis])
                sides = np.clip(np.minimum(places - low, high - places) / size, -reach, reach).astype(np.float32)
                np.minimum(depths, sides.reshape([-1 if i == axis else 1 for i in range(3)]), out=depths)
            return depths
        corners = (np.asarray(self.surface.vertices, dtype=np.float64) - start) / size
        inside = fill_rows(intersect_rows(corners, self.surface.faces, shape), shape)
        return distances_in_cells(self.surface, replace(cells, values=inside), reach, several=False, threads=threads)

    def depths_at(self, points: Floats, bounds: Floats, *, near: float, threads: int | None) -> Floats:
        """Measure how far points (N, 3), mm, lie inside the region, (N,) mm; outside, it is negative.

        Parameters
        ----------
        points : (N, 3) float64, mm
        bounds : (2, 3) float64
            Of the part, mm.
        near : float
            mm: points further outside of the box around a mesh are infinitely far.
        threads : int, optional
        """
        if self.surface is None:
            low, high = self.ends(bounds)
            depths: Floats = np.minimum(points - low, high - points).min(axis=1)
            return depths
        depths = np.full(len(points), -np.inf)
        is_near = ((points > self.low - near) & (points < self.high + near)).all(axis=1)
        if is_near.any():
            chosen = points[is_near]
            distances, _ = TriangleTree.of(self.surface).nearest(chosen, threads=threads)
            is_inside = winding_numbers(chosen, self.surface, threads=threads) != 0
            depths[is_near] = np.where(is_inside, distances, -distances)
        return depths

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
    is_matched : (R + 1,) bool
        Where the density matters: not where another pattern lies over this one.
    """

    regions: tuple[PlacedRegion, ...]
    densities: Floats
    covers: tuple[NDArray[np.uint8], ...]
    ratios: Floats
    is_matched: NDArray[np.bool_]

    @property
    def wanted(self) -> Floats:
        """The requested densities, (R + 1,); nan where they do not matter."""
        return np.where(self.is_matched, self.densities, np.nan)

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


def label_regions(regions: Sequence[PlacedRegion], space: Interior, shift: Sequence[float]) -> NDArray[np.int16]:
    """Return the number of the region in which each cell of a space lies, when all are shifted, (nx, ny, nz).

    Number 0 is the rest; later regions lie over earlier ones.
    """
    labels = np.zeros(space.shape, dtype=np.int16)
    for number, region in enumerate(regions, 1):
        labels[region.contains(space, space.shape, shift=shift)] = number
    return labels


def boxes_overlap(region: PlacedRegion, other: PlacedRegion) -> bool:
    """Tell whether the boxes around two regions overlap."""
    return bool(((region.low < other.high) & (region.high > other.low)).all())
