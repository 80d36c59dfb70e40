"""Branches below roofs that lean to the walls, grown layer by layer from the top: for solids and for prints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats
from infill.paths.forest import Forest

NEAR = 2.0  # cells: a foot follows a wall that moves by less than this from layer to layer
SLACK = 0.5  # cells: how well distances are known
ROUNDING = 1e-6  # cells: halfway between two cells, the same one is chosen wherever the pattern begins
DIGITS = 2  # of distances, in cells: distances that agree this far count as equal, and keep their order
TRIES = 40  # of the distance to a wall that gives way below
Twigs = list[tuple[int, Floats]]


def grow_branches(
    walls: LayerWalls, twigs: Twigs, *, reach: float, steps: Sequence[float]
) -> Iterator[tuple[Forest, bool]]:
    """Grow branches from the top layer down; yield the branches of each layer, and whether some begin in it.

    Parameters
    ----------
    walls : LayerWalls
    twigs : list of (int, (2,) float64)
        Places where branches may begin, in cells of the grid, each with the power of 2 of its place in their lattice.
    reach : float
        Distance from a wall or a branch within which a roof needs no other branch, in cells.
    steps : sequence of float
        How far tips draw back from the layer above to each layer, in cells, from the lowest layer on.
    """
    forest, tips = Forest(), _find_tips(twigs, walls, reach=reach)
    for layer in range(walls.depth.shape[2] - 1, -1, -1):
        forest.draw_back(steps[layer])
        forest.record_inside(walls.inside(forest.at, layer))
        for foot in forest.feet[walls.inside(forest.at[forest.feet], layer)].tolist():
            forest.move(foot, walls.foot(forest.at[foot], layer)[1], near=NEAR)
        planted = _sort_tips(tips.get(layer, ()), walls, layer)
        for tip, foot_at in planted:
            forest.plant(tip, foot_at, apart=reach)
        yield forest, bool(planted)


def lattice_twigs(counts: tuple[int, int], place: Floats, step: Floats, cells: int) -> Twigs:
    """Find the places of twigs on a grid, (2,) in its cells, each with the power of 2 of its place in their lattice.

    Parameters
    ----------
    counts : tuple of int
        Cells of the grid along x and y.
    place : (2,) float64
        The first twig, in cells of the grid.
    step : (2, 2) float64
        From each twig to the next ones, in cells of the grid.
    cells : int
        Period of the lattice: a power of 2.
    """
    nx, ny = counts
    corners = np.array([(x, y) for x in (0, nx - 1) for y in (0, ny - 1)])
    in_lattice = (corners - place) @ np.linalg.inv(step)
    low, high = np.ceil(in_lattice.min(axis=0)).astype(np.int64), np.floor(in_lattice.max(axis=0)).astype(np.int64)
    x, y = (np.arange(lowest, highest + 1) for lowest, highest in zip(low, high, strict=True))
    number = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    at = number @ step + place
    on_grid = np.all((at >= 0) & (at <= (nx - 1, ny - 1)), axis=1)
    number = number[on_grid] | cells
    return list(zip((number & -number).min(axis=1).tolist(), at[on_grid], strict=True))


def _sort_tips(tips: Iterable[tuple[int, Floats]], walls: LayerWalls, layer: int) -> list[tuple[Floats, Floats]]:
    """Sort the tips that begin in a layer, the coarsest lattice first; return each with a place for its foot."""
    rows = [(power, *walls.foot(tip, layer), tip) for power, tip in tips]
    rows.sort(key=lambda row: (-row[0], -round(row[1], DIGITS)))
    return [(tip, foot) for _, _, foot, tip in rows]


def _find_tips(twigs: Twigs, walls: LayerWalls, *, reach: float) -> dict[int, list[tuple[int, Floats]]]:
    """Find the twigs that begin in each layer: below a roof, where the walls further down stay a reach away."""
    by_layer: dict[int, list[tuple[int, Floats]]] = {}
    down = math.ceil(reach / walls.step)
    for power, twig in twigs:
        inside = walls.column(twig)
        for top in np.flatnonzero(inside & ~np.append(inside[1:], False)).tolist():
            floor = walls.floor(twig, top)
            if walls.distance_at(twig, max(floor, top - down)) > reach + SLACK:
                by_layer.setdefault(top, []).append((power, twig))
    return by_layer


@dataclass(kw_only=True)
class LayerWalls:
    """The space inside the walls, layer by layer.

    Parameters
    ----------
    depth : (nx, ny, nz) float32 or int8
        Depth below the inner side of the walls, in cells; of int8, 1 inside and -1 outside.
    step : float
        How far branches may lean out in a layer, in cells.
    deeper : float
        How far feet stand in the wall, in cells.
    """

    depth: NDArray[np.float32] | NDArray[np.int8]
    step: float
    deeper: float
    nearest: dict[int, NDArray[np.int16]] = field(default_factory=dict)

    def inside(self, places: Floats, layer: int) -> Flags:
        """Test which places (N, 2) of a layer are inside: (N,)."""
        x, y = self._cells_at(places)
        is_inside: Flags = self.depth[x, y, layer] > 0
        return is_inside

    def column(self, place: Floats) -> Flags:
        """Test which layers are inside at a place: (nz,)."""
        x, y = self._cells_at(place)
        is_inside: Flags = self.depth[x, y] > 0
        return is_inside

    def floor(self, place: Floats, layer: int) -> int:
        """Return the lowest layer from which all layers up to this one are inside at a place."""
        outside = np.flatnonzero(~self.column(place)[: layer + 1])
        return int(outside[-1]) + 1 if len(outside) else 0

    def distance_at(self, place: Floats, layer: int) -> float:
        """Return the distance of a place inside from the nearest wall of a layer, in cells."""
        return self._direction_to_wall(place, layer)[0]

    def foot(self, place: Floats, layer: int) -> tuple[float, Floats]:
        """Find the wall that a branch from here meets as it leans out; return its distance and a point in it."""
        distance, direction = self._direction_to_wall(place, layer)
        floor = self.floor(place, layer)
        for _ in range(TRIES):
            further, onwards = self._direction_to_wall(place, max(floor, layer - math.ceil(distance / self.step)))
            if further <= distance + SLACK:
                break
            distance, direction = further, onwards
        return distance, place + (distance + self.deeper) * direction

    def _direction_to_wall(self, place: Floats, layer: int) -> tuple[float, Floats]:
        """Return the distance of the nearest wall of a layer, in cells, and the direction to it, (2,)."""
        cell = np.array(self._cells_at(place))
        wall = self._nearest_walls(layer)[:, *cell].astype(np.float64)
        length = max(float(np.linalg.norm(wall - cell)), 1e-9)
        direction = (wall - cell) / length
        before, behind = (float(self.depth[(*self._cells_at(end), layer)]) for end in (wall - direction, wall))
        beyond = before / (before - behind) if before > 0 >= behind else 1.0
        return max(0.0, length - 1 + beyond - float((place - cell) @ direction)), direction

    def _nearest_walls(self, layer: int) -> NDArray[np.int16]:
        """Return the nearest cell of a wall for each cell of a layer, (2, nx, ny)."""
        from scipy.ndimage import distance_transform_edt

        if layer not in self.nearest:
            wall_cells = distance_transform_edt(
                self.depth[:, :, layer] > 0, return_distances=False, return_indices=True
            )
            self.nearest[layer] = wall_cells.astype(np.int16)
        return self.nearest[layer]

    def _cells_at(self, places: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return the cells that hold places (..., 2), as indices along x and along y; those outside are clipped."""
        upper = np.array(self.depth.shape[:2]) - 1
        cells = np.clip(np.floor(places + 0.5 + ROUNDING), 0, upper).astype(np.intp)
        return cells[..., 0], cells[..., 1]
