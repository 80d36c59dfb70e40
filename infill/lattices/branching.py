"""Branches below the roofs of a part, layer by layer from its top: see `patterns.lightning`."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.lattices.forest import Forest
from patterns.lightning import Lightning

DEEPER = 1.5  # cells by which feet stand in the wall, so that walls join
NEAR = 2.0  # cells: a foot follows a wall that moves by less than this from layer to layer
SLACK = 0.5  # cells: how well distances are known
ROUNDING = 1e-6  # cells: halfway between two cells, the same one is chosen wherever the pattern begins
DIGITS = 2  # of distances, in cells: distances that agree this far count as equal, and keep their order
TRIES = 40  # of the distance to a wall that gives way below
SHARE = 1.0  # width of branches over the cell, for a density of 1: a guess


@dataclass(frozen=True, kw_only=True)
class BranchLines:
    """The branches of a part.

    Parameters
    ----------
    pattern : Lightning
    turn : (3, 3) float64
        From the part to the pattern, about z.
    anchor : (3,) float64
        The point of the part that is (0, 0) of the pattern, mm; its height does not matter.
    """

    pattern: Lightning
    turn: Floats
    anchor: Floats

    @property
    def steepest(self) -> float:
        """Distance by which tips draw back in a layer, in cells, and its uncertainty."""
        return math.tan(math.radians(self.pattern.overhang)) + SLACK

    def sharpest(self, space: Interior, cell: float) -> float:  # noqa: ARG002 - as of `LayerLines`
        """Return the angle of the corners where branches meet walls, degrees."""
        return 90.0

    def widths(self, density: float) -> float:
        """Return a width of branches, in cells, for a density: a guess that does not depend on the part."""
        return SHARE * density

    def lines(self, space: Interior, cell: float) -> list[Floats]:
        """Draw the branches in each layer, for cells of a size, mm: (S, 2, 2), in cells from the first centre."""
        step = math.tan(math.radians(self.pattern.overhang))
        walls = _Walls(depth=space.below_walls, step=step, deeper=DEEPER + space.through)
        reach = cell / 2 / space.size
        node = self.anchor[:2] + cell * np.array(self.pattern.first) @ self.turn[:2, :2]
        twigs = _find_twigs(space, cell, self.turn[:2, :2], node)
        forest, branches, new_branches = Forest(), list[Floats](), list[Floats]()
        tips = _find_tips(twigs, walls, reach=reach)
        for layer in range(space.shape[2] - 1, -1, -1):
            forest.draw_back(step)
            forest.record_inside(walls.inside(forest.at, layer))
            for foot in forest.feet[walls.inside(forest.at[forest.feet], layer)].tolist():
                forest.move(foot, walls.foot(forest.at[foot], layer)[1], near=NEAR)
            planted = _sort_tips(tips.get(layer, ()), walls, layer)
            for tip, foot_at in planted:
                forest.plant(tip, foot_at, apart=reach)
            branches.append(forest.branches)
            new_branches.append(forest.branches if planted else np.empty((0, 2, 2)))
        layers_up = math.ceil(space.through)  # in a project, branches go through the roofs too
        return [np.concatenate([lines, *new_branches[k + 1 : k + 1 + layers_up]]) for k, lines in enumerate(branches)][
            ::-1
        ]


def _sort_tips(tips: Iterable[tuple[int, Floats]], walls: _Walls, layer: int) -> list[tuple[Floats, Floats]]:
    """Sort the tips that begin in a layer, the coarsest lattice first; return each with a place for its foot."""
    rows = [(power, *walls.foot(tip, layer), tip) for power, tip in tips]
    rows.sort(key=lambda row: (-row[0], -round(row[1], DIGITS)))
    return [(tip, foot) for _, _, foot, tip in rows]


def _find_twigs(space: Interior, cell: float, turn: Floats, node: Floats) -> list[tuple[int, Floats]]:
    """Find the places of twigs, (2,) in cells of the grid, each with the power of 2 of its place in the lattice."""
    nx, ny, _ = space.shape
    corners = np.array([(x, y) for x in (0, nx - 1) for y in (0, ny - 1)])
    in_lattice = (space.origin[:2] - node + space.size * corners) @ turn.T / cell
    low, high = np.ceil(in_lattice.min(axis=0)).astype(np.int64), np.floor(in_lattice.max(axis=0)).astype(np.int64)
    x, y = (np.arange(lowest, highest + 1) for lowest, highest in zip(low, high, strict=True))
    number = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    cells = (number * cell @ turn + node - space.origin[:2]) / space.size
    on_grid = np.all((cells >= 0) & (cells <= (nx - 1, ny - 1)), axis=1)
    number = number[on_grid] | Lightning.cells
    return list(zip((number & -number).min(axis=1).tolist(), cells[on_grid], strict=True))


def _find_tips(twigs: list[tuple[int, Floats]], walls: _Walls, *, reach: float) -> dict[int, list[tuple[int, Floats]]]:
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
class _Walls:
    """The space inside the walls, layer by layer.

    Parameters
    ----------
    depth : (nx, ny, nz) float32
        Depth below the inner side of the walls, in cells.
    step : float
        How far branches may lean out in a layer, in cells.
    deeper : float
        How far feet stand in the wall, in cells.
    """

    depth: NDArray[np.float32]
    step: float
    deeper: float
    nearest: dict[int, NDArray[np.int16]] = field(default_factory=dict)

    def inside(self, places: Floats, layer: int) -> NDArray[np.bool_]:
        """Test which places (N, 2) of a layer are inside: (N,)."""
        x, y = self._cells_at(places)
        is_inside: NDArray[np.bool_] = self.depth[x, y, layer] > 0
        return is_inside

    def column(self, place: Floats) -> NDArray[np.bool_]:
        """Test which layers are inside at a place: (nz,)."""
        x, y = self._cells_at(place)
        is_inside: NDArray[np.bool_] = self.depth[x, y] > 0
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
