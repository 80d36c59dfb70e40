"""Places of drains: the lowest place of every void from which a hole straight down keeps the wall from other skin."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.drains.drain_clearance import Skin
from infill.drains.drain_columns import DrainWays, LineLattice, find_ways
from infill.drains.holes import DrainNeeds, Shaft
from infill.interior.opening import Opening
from infill.isosurfaces.components import shell_names
from infill.surface import Surface

ACROSS, IN_A_CELL = 6, 10  # lines in the diameter of a drain, and in a cell of the pattern
MOST_LINES = 250_000
ASIDE = 0.377, 0.291  # of a step: shift of lines off round numbers, where edges of parts are
UP = 0.5, 0.15  # diameters by which a drain reaches into the void; the second if there is no room for the first
CENTRED = 0.5  # mm of height that a drain is worth for each mm that it cuts into the walls around its void
AT_ONCE = 64  # places that are measured together
BEST, MOST = 300, 1500  # places of a void that are tried: the best, and in all with a selection of the others
TRIES = 60  # holes that are measured exactly, for each void
MOUTHS = 8  # faces for which the tree of the other skin is built ahead
TURN_OVER = np.diag([1.0, -1.0, -1.0])  # half a turn about x: up becomes down


@dataclass(frozen=True, kw_only=True, eq=False)
class TurnedPart:
    """A part and its voids, turned so that drains go straight down.

    Parameters
    ----------
    part, voids : Surface, mm
    names : (V,) int
        The void of every vertex of the voids.
    count : int
        Of voids.
    rotation : (3, 3) float64
        Rotation from the original part to this one.
    """

    part: Surface
    voids: Surface
    names: NDArray[np.integer]
    count: int
    rotation: Floats
    skin: Skin = field(repr=False)

    @classmethod
    def of(cls, part: Surface, voids: Surface, names: NDArray[np.integer], count: int, rotation: Floats) -> TurnedPart:
        """Turn a part and its voids."""
        turned_part, turned_voids = _turn(part, rotation), _turn(voids, rotation)
        return cls(
            part=turned_part,
            voids=turned_voids,
            names=names,
            count=count,
            rotation=rotation,
            skin=Skin(part=turned_part),
        )

    def back(self, points: Floats) -> Floats:
        """Turn points (..., 3) back to the original part."""
        original: Floats = points @ self.rotation
        return original

    def lattice(self, needs: DrainNeeds, most: int = MOST_LINES) -> LineLattice:
        """Lay lines through all of the part, close enough for drains and cells if that takes few enough lines."""
        low, high = (np.asarray(corner, dtype=np.float64)[:2] for corner in self.part.bounds)
        sides = high - low
        step = min(needs.diameter / ACROSS, needs.cell / IN_A_CELL)
        step = max(step, math.sqrt(float(sides.prod()) / most))
        nx, ny = (np.ceil(sides / step).astype(int) + 1).tolist()
        return LineLattice(low=low + step * (np.array(ASIDE) - 1), step=step, shape=(nx + 1, ny + 1))

    def lattice_of(self, needs: DrainNeeds, void: int) -> LineLattice:
        """Select the lines that may pass through a void."""
        lattice = self.lattice(needs)
        places = np.asarray(self.voids.vertices, dtype=np.float64)[self.names == void, :2]
        node = np.floor((places.min(axis=0) - lattice.low) / lattice.step)
        nx, ny = (np.ceil((places.max(axis=0) - lattice.low) / lattice.step) - node).astype(int).tolist()
        return LineLattice(low=lattice.low + lattice.step * node, step=lattice.step, shape=(nx + 1, ny + 1))

    @cached_property
    def lowest(self) -> Floats:
        """Height of the lowest place of every void, (N,) mm."""
        heights = np.full(self.count, np.inf)
        used = self.names >= 0
        np.minimum.at(heights, self.names[used], np.asarray(self.voids.vertices, dtype=np.float64)[used, 2])
        return heights

    @cached_property
    def boxes(self) -> NDArray[np.float32]:
        """Lowest and highest coordinates of every face of the voids, (2, F, 3) mm."""
        vertices, faces = np.asarray(self.voids.vertices, dtype=np.float32), self.voids.faces
        a, b, c = (vertices[faces[:, corner]] for corner in range(3))
        return np.stack([np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)])

    @cached_property
    def owners(self) -> Integers:
        """Void of every face of the voids, (F,)."""
        owners: Integers = self.names[self.voids.faces[:, 0]].astype(np.int64)
        return owners


@dataclass(frozen=True, kw_only=True, eq=False)
class DrainTask:
    """The holes to plan for the voids of a part: see `infill.drains.drain_plan.plan_drains`.

    Parameters
    ----------
    part, voids : Surface, mm
    needs : DrainNeeds
    vent : bool
    places : tuple of (x, y, z), mm
    opening : Opening or None
    names : (V,) int64
        The void of every vertex of the voids: they are numbered by falling volume.
    volumes : tuple of float
        Of the voids, mm³.
    """

    part: Surface
    voids: Surface
    needs: DrainNeeds
    vent: bool
    places: tuple[tuple[float, float, float], ...]
    opening: Opening | None
    names: NDArray[np.int64]
    volumes: tuple[float, ...]
    _views: dict[bytes, TurnedPart] = field(default_factory=dict)

    def with_diameter(self, diameter: float) -> DrainTask:
        """Return the same task with holes of another diameter, mm."""
        return replace(self, needs=replace(self.needs, diameter=diameter))

    def along(self, rotation: NDArray[np.float64]) -> TurnedPart:
        """Return the part and its voids turned by a rotation (3, 3), from a cache."""
        key = rotation.round(12).tobytes()
        if key not in self._views:
            self._views[key] = TurnedPart.of(self.part, self.voids, self.names, len(self.volumes), rotation)
        return self._views[key]

    @property
    def opened(self) -> set[int]:
        """The voids that reach out of an open side of the part."""
        if self.opening is None:
            return set()
        shells, _ = shell_names(self.voids)
        starts = np.unique(shells, return_index=True)[1]
        numbers = self.names[starts[shells[starts] >= 0]]
        return set(numbers[self.opening.reaches_out(self.voids)].tolist())


@dataclass(frozen=True, kw_only=True, eq=False)
class DrainPlaces:
    """Places at which voids may be drained.

    Parameters
    ----------
    below : TurnedPart
    needs : DrainNeeds
    ways : DrainWays
    order : list of (N,) int64
        Numbers of the ways of each void, the best first.
    """

    below: TurnedPart
    needs: DrainNeeds
    ways: DrainWays
    order: list[Integers]

    @classmethod
    def of(cls, below: TurnedPart, needs: DrainNeeds, *, void: int | None = None) -> DrainPlaces:
        """Find the places, of all voids or one, from which a line straight down leaves the part through solid alone."""
        lattice = below.lattice(needs) if void is None else below.lattice_of(needs, void)
        ways = find_ways(below.part, below.voids, below.names, lattice)
        free = below.skin.leaving[ways.face]
        if needs.closed_at is not None:
            level = 1e-5 * float(np.ptp(below.part.bounds, axis=0).max())
            free &= np.abs(ways.skin - needs.closed_at) > level
        room = _room_around(ways, lattice, needs.radius)
        cost = ways.floor - below.lowest[ways.void] + CENTRED * np.clip(needs.radius - room, 0, None)
        selected = np.flatnonzero(free)
        selected = selected[np.lexsort((cost[selected], ways.void[selected]))]
        ends = np.searchsorted(ways.void[selected], np.arange(below.count + 1))
        order = [selected[begin:end] for begin, end in pairwise(ends.tolist())]
        _build_trees(below.skin, ways.face[selected])
        return cls(below=below, needs=needs, ways=ways, order=[_select_ways(numbers) for numbers in order])

    def shaft(self, void: int, taken: Floats | None) -> Shaft | None:
        """Find the best hole for a void that keeps the wall from other skin, or return None.

        Parameters
        ----------
        void : int
        taken : (N, 2) float64, mm
            Places of holes from which it also keeps a wall; None if it need not.
        """
        needs, ways = self.needs, self.order[void]
        if taken is not None and len(taken) and len(ways):
            apart = np.linalg.norm(self.ways.at[ways][:, None] - taken, axis=2).min(axis=1)
            ways = ways[apart >= needs.diameter + needs.wall]
        return self._first_clear_shaft(ways)

    def nearest(self, at: Floats, skin: float) -> Shaft | None:
        """Find the hole for any void that is nearest to a place of the skin, or return None."""
        ways = np.concatenate(self.order) if self.order else np.empty(0, dtype=np.int64)
        distance = np.linalg.norm(self.ways.at[ways] - at, axis=1) + np.abs(self.ways.skin[ways] - skin)
        return self._first_clear_shaft(ways[np.argsort(distance, kind="stable")][:MOST])

    def _first_clear_shaft(self, ways: Integers) -> Shaft | None:
        """Return the first of the holes along some ways that keeps a wall from other skin, or None."""
        needs = self.needs
        for up in UP:
            for way, high in islice(self._filter_ways(ways, up), TRIES):
                shaft = self.below.skin.shaft(self.ways, way, high, needs)
                if shaft is not None and shaft.clearance >= needs.wall:
                    return shaft
        return None

    def _filter_ways(self, ways: Integers, up: float) -> Iterator[tuple[int, float]]:
        """Yield the ways that roughly keep a wall from other skin, each with the height at which the hole ends."""
        needs, skin = self.needs, self.below.skin
        for begin in range(0, len(ways), AT_ONCE):
            batch = ways[begin : begin + AT_ONCE]
            high = np.minimum(self.ways.floor[batch] + up * needs.diameter, self.ways.ceiling[batch])
            is_passing = np.empty(len(batch), dtype=bool)
            mouths = skin.smooth_faces[self.ways.face[batch]]
            mouths = np.where([skin.has_tree(name) for name in mouths.tolist()], mouths, -1)
            for mouth in np.unique(mouths).tolist():
                at_mouth = mouths == mouth
                is_passing[at_mouth] = skin.may_keep(self.ways, batch[at_mouth], high[at_mouth], needs, mouth)
            for index in np.flatnonzero(is_passing).tolist():
                yield int(batch[index]), float(high[index])


def _turn(surface: Surface, rotation: Floats) -> Surface:
    """Turn a surface by a rotation (3, 3) about the origin."""
    return Surface(vertices=np.asarray(surface.vertices, dtype=np.float64) @ rotation.T, faces=surface.faces)


def _select_ways(ways: Integers) -> Integers:
    """Keep the best ways, and an even selection of the others."""
    if len(ways) <= MOST:
        return ways
    rest = ways[BEST:]
    return np.concatenate([ways[:BEST], rest[np.linspace(0, len(rest) - 1, MOST - BEST).astype(np.int64)]])


def _build_trees(skin: Skin, faces: Integers) -> None:
    """Build the trees of the other skin for the faces that most ways leave through."""
    names, counts = np.unique(skin.smooth_faces[faces], return_counts=True)
    for mouth in names[np.argsort(-counts)][:MOUTHS].tolist():
        skin.tree(mouth)


def _room_around(ways: DrainWays, lattice: LineLattice, radius: float) -> Floats:
    """Return the distance of each way from the rim of its void, or from a much higher floor, seen from above, mm."""
    from scipy.ndimage import distance_transform_edt

    void, floor = np.full(lattice.shape, -1, dtype=np.int64), np.full(lattice.shape, np.inf)
    backwards = ways.line[::-1]  # of several ways on a line, the lowest is written last
    void.ravel()[backwards], floor.ravel()[backwards] = ways.void[::-1], ways.floor[::-1]
    inside = void >= 0
    for axis in (0, 1):
        for way in (1, -1):
            neighbour = np.roll(void, way, axis=axis)
            higher = np.full(lattice.shape, True)
            np.less_equal(np.roll(floor, way, axis=axis), floor + radius, out=higher, where=inside)
            inside &= (neighbour == void) & higher
    distance: Floats = distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1] * lattice.step
    return distance.ravel()[ways.line]
