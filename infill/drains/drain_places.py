"""Where every void is drained: the lowest place from which a hole straight down keeps the wall from all other skin."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_clearance import Shaft, Skin
from infill.drains.drain_columns import Lattice, Ways, find_ways
from infill.surface import Surface

ACROSS, IN_A_CELL = 6, 10  # lines in the diameter of a drain, and in a cell of the pattern
MOST_LINES = 250_000
ASIDE = 0.377, 0.291  # of a step: so far lines stand from round numbers, where edges of parts are
UP = 0.5, 0.15  # diameters by which a drain reaches into the void; the second where there is no room for the first
CENTRED = 0.5  # mm higher that a drain may begin for each mm that it cuts into the walls around its void
AT_ONCE = 64  # places that are measured together
BEST, MOST = 300, 1500  # places of a void that are tried: all of the best, and some of the others
TRIES = 60  # holes that are measured well, for each void
MOUTHS = 8  # faces, of which the other skin is put in order ahead
TURN_OVER = np.diag([1.0, -1.0, -1.0])  # about x: what was above is below

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Needs:
    """What a drain needs.

    Parameters
    ----------
    diameter, wall : float, mm
    cell : float
        Of the pattern, mm.
    closed_at : float or None
        Height of a side of the part that is open already, through which no drain leaves, mm.
    threads : int or None
    """

    diameter: float
    wall: float
    cell: float
    closed_at: float | None = None
    threads: int | None = None

    @property
    def radius(self) -> float:
        """Of a drain, mm."""
        return self.diameter / 2


@dataclass(frozen=True, kw_only=True, eq=False)
class Below:
    """A part and its voids, turned so that drains go straight down.

    Parameters
    ----------
    part, voids : Surface, mm
    names : (V,) int
        The void of every vertex of the voids.
    count : int
        Of voids.
    turned : (3, 3) float64
        Takes a place of the part as it was given to where it is here.
    """

    part: Surface
    voids: Surface
    names: NDArray[np.integer]
    count: int
    turned: Floats
    skin: Skin = field(repr=False)

    @classmethod
    def of(cls, part: Surface, voids: Surface, names: NDArray[np.integer], count: int, turned: Floats) -> Below:
        """Return a part and voids, turned."""
        whole, hollow = _turned(part, turned), _turned(voids, turned)
        return cls(part=whole, voids=hollow, names=names, count=count, turned=turned, skin=Skin(part=whole))

    def back(self, points: Floats) -> Floats:
        """Return where points (..., 3) are in the part as it was given."""
        found: Floats = points @ self.turned
        return found

    def lattice(self, needs: Needs, most: int = MOST_LINES) -> Lattice:
        """Return lines through all of the part, close enough for drains and cells if so many suffice."""
        low, high = (np.asarray(each, dtype=np.float64)[:2] for each in self.part.bounds)
        sides = high - low
        step = min(needs.diameter / ACROSS, needs.cell / IN_A_CELL)
        step = max(step, math.sqrt(float(sides.prod()) / most))
        nx, ny = (np.ceil(sides / step).astype(int) + 1).tolist()
        return Lattice(low=low + step * (np.array(ASIDE) - 1), step=step, shape=(nx + 1, ny + 1))

    def lattice_of(self, needs: Needs, void: int) -> Lattice:
        """Return those of the lines that may pass through a void."""
        whole = self.lattice(needs)
        own = np.asarray(self.voids.vertices, dtype=np.float64)[self.names == void, :2]
        first = np.floor((own.min(axis=0) - whole.low) / whole.step)
        nx, ny = (np.ceil((own.max(axis=0) - whole.low) / whole.step) - first).astype(int).tolist()
        return Lattice(low=whole.low + whole.step * first, step=whole.step, shape=(nx + 1, ny + 1))

    @cached_property
    def lowest(self) -> Floats:
        """The height of the lowest place of every void, (N,) mm."""
        found = np.full(self.count, np.inf)
        used = self.names >= 0
        np.minimum.at(found, self.names[used], np.asarray(self.voids.vertices, dtype=np.float64)[used, 2])
        return found

    @cached_property
    def boxes(self) -> NDArray[np.float32]:
        """The lowest and highest coordinates of every face of the voids, (2, F, 3) mm."""
        vertices, faces = np.asarray(self.voids.vertices, dtype=np.float32), self.voids.faces
        a, b, c = (vertices[faces[:, corner]] for corner in range(3))
        return np.stack([np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)])

    @cached_property
    def owners(self) -> Integers:
        """The void of every face of the voids, (F,)."""
        owners: Integers = self.names[self.voids.faces[:, 0]].astype(np.int64)
        return owners


@dataclass(frozen=True, kw_only=True, eq=False)
class Places:
    """Places at which voids may be drained.

    Parameters
    ----------
    below : Below
    needs : Needs
    ways : Ways
    order : list of (N,) int64
        Of every void, its ways, the best first.
    lowest : (V,) float64
        mm
    """

    below: Below
    needs: Needs
    ways: Ways
    order: list[Integers]
    lowest: Floats

    @classmethod
    def of(cls, below: Below, needs: Needs, *, void: int | None = None) -> Places:
        """Find the places from which a line straight down leaves the part through solid alone; of one void if given."""
        lattice = below.lattice(needs) if void is None else below.lattice_of(needs, void)
        ways = find_ways(below.part, below.voids, below.names, lattice)
        lowest = below.lowest
        free = below.skin.leaving[ways.face]
        if needs.closed_at is not None:
            level = 1e-5 * float(np.ptp(below.part.bounds, axis=0).max())
            free &= np.abs(ways.skin - needs.closed_at) > level
        room = _room(ways, lattice, needs.radius)
        cost = ways.floor - lowest[ways.void] + CENTRED * np.clip(needs.radius - room, 0, None)
        kept = np.flatnonzero(free)
        kept = kept[np.lexsort((cost[kept], ways.void[kept]))]
        ends = np.searchsorted(ways.void[kept], np.arange(below.count + 1))
        order = [kept[begin:end] for begin, end in pairwise(ends.tolist())]
        _order_skin(below.skin, ways.face[kept])
        return cls(below=below, needs=needs, ways=ways, order=[_some(each) for each in order], lowest=lowest)

    def shaft(self, void: int, taken: Floats | None) -> Shaft | None:
        """Return the best hole for a void that keeps the wall from other skin, or None.

        Parameters
        ----------
        void : int
        taken : (N, 2) float64, mm
            Where there are holes, from which it also keeps a wall; None if that is not asked for.
        """
        needs, mine = self.needs, self.order[void]
        if taken is not None and len(taken) and len(mine):
            apart = np.linalg.norm(self.ways.at[mine][:, None] - taken, axis=2).min(axis=1)
            mine = mine[apart >= needs.diameter + needs.wall]
        return self._first(mine)

    def nearest(self, at: Floats, skin: float) -> Shaft | None:
        """Return the hole for any void that is nearest to a place of the skin, or None."""
        mine = np.concatenate(self.order) if self.order else np.empty(0, dtype=np.int64)
        away = np.linalg.norm(self.ways.at[mine] - at, axis=1) + np.abs(self.ways.skin[mine] - skin)
        return self._first(mine[np.argsort(away, kind="stable")][:MOST])

    def _first(self, mine: Integers) -> Shaft | None:
        """Return the hole along the first of some ways that keeps the wall from other skin, or None."""
        needs = self.needs
        for up in UP:
            for way, high in islice(self._passing(mine, up), TRIES):
                shaft = self.below.skin.shaft(
                    self.ways.at[way],
                    int(self.ways.face[way]),
                    float(self.ways.skin[way]),
                    float(self.ways.floor[way]),
                    high,
                    radius=needs.radius,
                    wall=needs.wall,
                    threads=needs.threads,
                )
                if shaft is not None and shaft.clearance >= needs.wall:
                    return shaft
        return None

    def _passing(self, ways: Integers, up: float) -> Iterator[tuple[int, float]]:
        """Yield the ways that keep about a wall from other skin, each with the height at which the hole ends."""
        needs, skin = self.needs, self.below.skin
        for begin in range(0, len(ways), AT_ONCE):
            some = ways[begin : begin + AT_ONCE]
            high = np.minimum(self.ways.floor[some] + up * needs.diameter, self.ways.ceiling[some])
            kept = np.empty(len(some), dtype=bool)
            mouths = skin.mouths[self.ways.face[some]]
            mouths = np.where([skin.knows(each) for each in mouths.tolist()], mouths, -1)
            for mouth in np.unique(mouths).tolist():
                own = mouths == mouth
                kept[own] = skin.may_keep(
                    self.ways.at[some[own]],
                    self.ways.face[some[own]],
                    self.ways.skin[some[own]],
                    high[own],
                    radius=needs.radius,
                    wall=needs.wall,
                    mouth=mouth,
                    threads=needs.threads,
                )
            for index in np.flatnonzero(kept).tolist():
                yield int(some[index]), float(high[index])


def _turned(surface: Surface, turned: Floats) -> Surface:
    return Surface(vertices=np.asarray(surface.vertices, dtype=np.float64) @ turned.T, faces=surface.faces)


def _some(ways: Integers) -> Integers:
    """Return the best ways, and some of the others."""
    if len(ways) <= MOST:
        return ways
    rest = ways[BEST:]
    return np.concatenate([ways[:BEST], rest[np.linspace(0, len(rest) - 1, MOST - BEST).astype(np.int64)]])


def _order_skin(skin: Skin, faces: Integers) -> None:
    """Have the other skin of the faces that most ways leave through put in order."""
    names, counts = np.unique(skin.mouths[faces], return_counts=True)
    for mouth in names[np.argsort(-counts)][:MOUTHS].tolist():
        skin.tree(mouth)


def _room(ways: Ways, lattice: Lattice, radius: float) -> Floats:
    """Return how far each way is from where another void, or a much higher floor, is above the skin, mm."""
    from scipy.ndimage import distance_transform_edt

    void, floor = np.full(lattice.shape, -1, dtype=np.int64), np.full(lattice.shape, np.inf)
    backwards = ways.line[::-1]  # of several ways on a line, the lowest is written last
    void.ravel()[backwards], floor.ravel()[backwards] = ways.void[::-1], ways.floor[::-1]
    inside = void >= 0
    for axis in (0, 1):
        for way in (1, -1):
            beside = np.roll(void, way, axis=axis)
            higher = np.full(lattice.shape, True)
            np.less_equal(np.roll(floor, way, axis=axis), floor + radius, out=higher, where=inside)
            inside &= (beside == void) & higher
    away: Floats = distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1] * lattice.step
    return away.ravel()[ways.line]
