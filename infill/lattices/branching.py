"""Branches below the roofs of a part, layer by layer from its top: see `patterns.lightning`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import Space
from infill.lattices.forest import Floats, Forest
from patterns.lightning import Lightning

DEEPER = 1.5  # cells by which feet stand in the wall, so that walls join
NEAR = 2.0  # cells by which a wall may give way from layer to layer, for a foot to go with it
SLACK = 0.5  # cells: how well distances are known
ROUNDING = 1e-6  # cells: between two cells it is the same one, wherever the pattern begins
DIGITS = 2  # of distances, in cells: those that are equal so far are equal, and their order counts
TRIES = 40  # of the distance to a wall that gives way below
SHARE = 1.0  # of the density at which walls of a cell's width would be as dense: a guess


@dataclass(frozen=True, kw_only=True)
class Branches:
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
    def two_sided(self) -> bool:
        """Branches have ends."""
        return False

    def sides(self, space: Space, cell: float) -> Iterator[NDArray[np.bool_]]:  # noqa: ARG002 - of the protocol
        """See `LineLayers`: none."""
        return iter(())

    @property
    def steepest(self) -> float:
        """How far tips draw back in a layer, in cells, and how well that is known."""
        return math.tan(math.radians(self.pattern.overhang)) + SLACK

    def sharpest(self, space: Space, cell: float) -> float:  # noqa: ARG002 - of the protocol
        """See `Voids`."""
        return 90.0

    def about(self, middle: Floats) -> Branches:
        """See `Anchored`."""
        return replace(self, anchor=middle + self.anchor)

    def widths(self, density: float) -> float:
        """See `Voids`: a guess, as nothing is known of the part."""
        return SHARE * density

    def lines(self, space: Space, cell: float) -> list[Floats]:
        """See `LineLayers`."""
        step = math.tan(math.radians(self.pattern.overhang))
        walls = _Walls(depth=space.below_walls, step=step, deeper=DEEPER + space.through)
        reach = cell / 2 / space.size
        first = self.anchor[:2] + cell * np.array(self.pattern.first) @ self.turn[:2, :2]
        twigs = _twigs(space, cell, self.turn[:2, :2], first)
        forest, found, begun = Forest(), list[Floats](), list[Floats]()
        tips = _tips(twigs, walls, reach=reach)
        for layer in range(space.shape[2] - 1, -1, -1):
            forest.draw_back(step)
            forest.stand(walls.inside(forest.at, layer))
            for foot in forest.feet[walls.inside(forest.at[forest.feet], layer)].tolist():
                forest.move(foot, walls.foot(forest.at[foot], layer)[1], near=NEAR)
            planted = _in_order(tips.get(layer, ()), walls, layer)
            for tip, foot_at in planted:
                forest.plant(tip, foot_at, apart=reach)
            found.append(forest.branches)
            begun.append(forest.branches if planted else np.empty((0, 2, 2)))
        up = math.ceil(space.through)  # in a project, branches go through the roofs too
        return [np.concatenate([one, *begun[k + 1 : k + 1 + up]]) for k, one in enumerate(found)][::-1]


def _in_order(tips: Iterable[tuple[int, Floats]], walls: _Walls, layer: int) -> list[tuple[Floats, Floats]]:
    """Return the tips that begin in a layer, each with a place for its foot: those on the coarsest lattice first."""
    some = [(power, *walls.foot(tip, layer), tip) for power, tip in tips]
    some.sort(key=lambda each: (-each[0], -round(each[1], DIGITS)))
    return [(tip, foot) for _, _, foot, tip in some]


def _twigs(space: Space, cell: float, turn: Floats, first: Floats) -> list[tuple[int, Floats]]:
    """Return where twigs may be, (2,) in cells of the grid, each after the power of 2 of its place in the lattice."""
    nx, ny, _ = space.shape
    corners = np.array([(x, y) for x in (0, nx - 1) for y in (0, ny - 1)])
    there = (space.origin[:2] - first + space.size * corners) @ turn.T / cell
    low, high = np.ceil(there.min(axis=0)).astype(np.int64), np.floor(there.max(axis=0)).astype(np.int64)
    x, y = (np.arange(least, most + 1) for least, most in zip(low, high, strict=True))
    number = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    cells = (number * cell @ turn + first - space.origin[:2]) / space.size
    kept = np.all((cells >= 0) & (cells <= (nx - 1, ny - 1)), axis=1)
    number = number[kept] | Lightning.cells
    return list(zip((number & -number).min(axis=1).tolist(), cells[kept], strict=True))


def _tips(twigs: list[tuple[int, Floats]], walls: _Walls, *, reach: float) -> dict[int, list[tuple[int, Floats]]]:
    """Return the twigs that begin in each layer: below a roof, from which the walls stay a reach away further down."""
    found: dict[int, list[tuple[int, Floats]]] = {}
    down = math.ceil(reach / walls.step)
    for power, twig in twigs:
        inside = walls.column(twig)
        for top in np.flatnonzero(inside & ~np.append(inside[1:], False)).tolist():
            floor = walls.floor(twig, top)
            if walls.away(twig, max(floor, top - down)) > reach + SLACK:
                found.setdefault(top, []).append((power, twig))
    return found


@dataclass(kw_only=True)
class _Walls:
    """What is inside the walls, layer by layer.

    Parameters
    ----------
    depth : (nx, ny, nz) float32
        Below the inner side of the walls, in cells.
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
        """Return which places (N, 2) of a layer are inside."""
        x, y = self._cells(places)
        found: NDArray[np.bool_] = self.depth[x, y, layer] > 0
        return found

    def column(self, place: Floats) -> NDArray[np.bool_]:
        """Return which layers are inside at a place, (nz,)."""
        x, y = self._cells(place)
        found: NDArray[np.bool_] = self.depth[x, y] > 0
        return found

    def floor(self, place: Floats, layer: int) -> int:
        """Return the lowest layer that is inside at a place, and from which all up to this one are."""
        outside = np.flatnonzero(~self.column(place)[: layer + 1])
        return int(outside[-1]) + 1 if len(outside) else 0

    def away(self, place: Floats, layer: int) -> float:
        """Return how far a place inside is from the nearest wall of a layer, in cells."""
        return self._way(place, layer)[0]

    def foot(self, place: Floats, layer: int) -> tuple[float, Floats]:
        """Return how far a wall is that a branch from here will meet as it leans out, in cells, and a point in it."""
        away, way = self._way(place, layer)
        floor = self.floor(place, layer)
        for _ in range(TRIES):
            further, there = self._way(place, max(floor, layer - math.ceil(away / self.step)))
            if further <= away + SLACK:
                break
            away, way = further, there
        return away, place + (away + self.deeper) * way

    def _way(self, place: Floats, layer: int) -> tuple[float, Floats]:
        """Return how far the nearest wall of a layer is, in cells, and the direction (2,)."""
        cell = np.array(self._cells(place))
        wall = self._nearest(layer)[:, *cell].astype(np.float64)
        long = max(float(np.linalg.norm(wall - cell)), 1e-9)
        way = (wall - cell) / long
        before, behind = (float(self.depth[(*self._cells(each), layer)]) for each in (wall - way, wall))
        beyond = before / (before - behind) if before > 0 >= behind else 1.0
        return max(0.0, long - 1 + beyond - float((place - cell) @ way)), way

    def _nearest(self, layer: int) -> NDArray[np.int16]:
        """Return the cell of a wall that is nearest to each cell of a layer, (2, nx, ny)."""
        from scipy.ndimage import distance_transform_edt

        if layer not in self.nearest:
            found = distance_transform_edt(self.depth[:, :, layer] > 0, return_distances=False, return_indices=True)
            self.nearest[layer] = found.astype(np.int16)
        return self.nearest[layer]

    def _cells(self, places: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        most = np.array(self.depth.shape[:2]) - 1
        cells = np.clip(np.floor(places + 0.5 + ROUNDING), 0, most).astype(np.intp)
        return cells[..., 0], cells[..., 1]
