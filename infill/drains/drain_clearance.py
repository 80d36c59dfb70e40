"""How far a hole straight down out of a part stays from its skin, the face that it leaves through left aside.

mouth      the smooth face around the place where the axis leaves, as far as it looks down
other skin everything else: sides, bolt holes, chamfers, whatever lies above or below
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.components import shell_names
from infill.meshes.distance import Tree
from infill.meshes.shells import shell_volumes
from infill.surface import Surface

LEAVING, FACING = 0.5, 0.35  # cosines: how far a face may be from level for a hole to leave through it, or be its mouth
SMOOTH = math.cos(math.radians(30))  # faces that meet at more are two
ENDS = (0.0, 0.4, 0.75)  # of the radius: circles on the ends of a hole
FEW, COARSE, FINE = (4, 3, ()), (16, 8, ENDS), (64, 24)  # points around a hole and along it, and circles on its ends
CERTAIN = 0.999  # of the wall: what is nearer need not be measured
RIM = 24  # lines along a hole by which its mouth is found
NEAR = 1.0  # of diameter and wall: within this of a hole, faces are joined to its mouth
OUT = 0.25, 0.4  # of the diameter and of the wall, the lesser: how far a hole goes on outside

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Integers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Shaft:
    """A round hole along z.

    Parameters
    ----------
    at : (2,) float64, mm
    low, high : float
        Heights of its ends, mm.
    skin : float
        Height at which its axis leaves the part, mm.
    floor : float
        Height at which its axis enters the void, mm.
    clearance : float
        Least distance of the hole from the other skin, mm.
    near : (3,) float64, mm
        Where on the hole that is.
    """

    at: Floats
    low: float
    high: float
    skin: float
    floor: float
    clearance: float
    near: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Skin:
    """The skin of a part that holes leave straight down.

    Parameters
    ----------
    part : Surface, mm
        Closed, facing outwards.
    """

    part: Surface
    _trees: dict[int, Tree | None] = field(default_factory=dict, repr=False)

    @cached_property
    def corners(self) -> Floats:
        """Of every face, (F, 3, 3) mm."""
        corners: Floats = np.asarray(self.part.vertices, dtype=np.float64)[self.part.faces]
        return corners

    @cached_property
    def normals(self) -> Floats:
        """Of every face, (F, 3); 0 for a face without area."""
        a, b, c = self.corners[:, 0], self.corners[:, 1], self.corners[:, 2]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        unit: Floats = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
        return unit

    @cached_property
    def neighbours(self) -> Integers:
        """Pairs of faces that meet smoothly and both look down, (N, 2)."""
        faces = self.part.faces.astype(np.int64)
        edges = np.sort(np.concatenate([faces[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
        owner = np.tile(np.arange(len(faces)), 3)
        order = np.lexsort(edges.T)
        edges, owner = edges[order], owner[order]
        same = (edges[1:] == edges[:-1]).all(axis=1)
        one, other = owner[:-1][same], owner[1:][same]
        smooth = (self.normals[one] * self.normals[other]).sum(axis=1) >= SMOOTH
        kept = smooth & self.facing[one] & self.facing[other]
        return np.stack([one[kept], other[kept]], axis=1)

    @cached_property
    def facing(self) -> Bools:
        """Which faces look down."""
        return -self.normals[:, 2] >= FACING

    @cached_property
    def mouths(self) -> Integers:
        """The smooth face that each face of the mesh belongs to, (F,); -1 for one that does not look down."""
        names = _components(self.neighbours, len(self.part.faces))
        return np.where(self.facing, names, -1)

    @cached_property
    def leaving(self) -> Bools:
        """Which faces a hole may leave through: near level, and not those of a closed cavity."""
        names, count = shell_names(self.part)
        outer = shell_volumes(self.part, names, count) > 0
        level: Bools = (-self.normals[:, 2] >= LEAVING) & outer[names[self.part.faces[:, 0]]]
        return level

    @cached_property
    def whole(self) -> Tree:
        """All faces."""
        return Tree.of(self.part)

    def tree(self, mouth: int) -> Tree | None:
        """Return the faces that do not belong to a mouth; None if there are none. -1 for all that do not look down."""
        if mouth not in self._trees:
            kept = ~self.facing if mouth < 0 else self.mouths != mouth
            self._trees[mouth] = None
            if kept.any():
                self._trees[mouth] = Tree.of(Surface(vertices=self.part.vertices, faces=self.part.faces[kept]))
        return self._trees[mouth]

    def knows(self, mouth: int) -> bool:
        """Return whether the tree of a mouth is there already."""
        return mouth in self._trees

    def may_keep(
        self,
        at: Floats,
        face: Integers,
        low: Floats,
        high: Floats,
        *,
        radius: float,
        wall: float,
        mouth: int,
        threads: int | None,
    ) -> Bools:
        """Return which holes may keep the wall from the skin besides a mouth, (N,): by points on them, few at first.

        Parameters
        ----------
        at : (N, 2) float64, mm
        face : (N,) int64
            Where the axis leaves.
        low, high : (N,) float64, mm
            Where the axis leaves, and where the hole ends.
        radius, wall : float, mm
        mouth : int
        threads : int, optional
        """
        tree = self.tree(mouth)
        left = np.arange(len(at))
        if tree is not None:
            z = -self.normals[face, 2]
            slope = radius * np.sqrt(np.clip(1 - z**2, 0, None)) / z
            for around, along, ends in (FEW, COARSE):
                points = _surface_points(at[left], (low - slope)[left], high[left], radius, around, along, ends)
                away, _ = tree.nearest(points.reshape(-1, 3), enough=CERTAIN * wall, threads=threads)
                left = left[away.reshape(points.shape[:2]).min(axis=1, initial=np.inf) >= wall]
        kept = np.zeros(len(at), dtype=bool)
        kept[left] = True
        return kept

    def shaft(
        self,
        at: Floats,
        face: int,
        low: float,
        floor: float,
        high: float,
        *,
        radius: float,
        wall: float,
        threads: int | None,
    ) -> Shaft | None:
        """Measure a hole: where its rim leaves the part, and how far it stays from the other skin.

        Parameters
        ----------
        at : (2,) float64, mm
        face : int
            Where the axis leaves.
        low, floor, high : float
            Heights at which the axis leaves the part and enters the void, and at which the hole ends, mm.
        radius, wall : float, mm
        threads : int, optional

        Returns
        -------
        Shaft or None
            None if the hole runs over the edge of the face that it leaves through.
        """
        reach = NEAR * (2 * radius + wall)
        mine, stray = self._around(at, face, low - reach, high, radius + reach)
        rim = self._rim(at, mine, low, radius)
        if rim is None:
            return None
        lowest, highest = min(low, *rim), max(low, *rim)
        if highest > high:
            return None
        points, spacing = _fine_points(at, lowest, high, radius)
        trees = [self.tree(int(self.mouths[face]))]
        if len(stray):
            trees.append(Tree.of(Surface(vertices=self.part.vertices, faces=self.part.faces[stray])))
        away = np.full(len(points), np.inf)
        for tree in trees:
            if tree is not None:
                away = np.minimum(away, tree.nearest(points, threads=threads)[0])
        nearest = int(np.argmin(away))
        # Between two of these points the hole may come nearer: the distance is that of the nearest of them, less this.
        near = float(away[nearest])
        clearance = math.sqrt(max(near**2 - spacing**2 * (1 + near / radius), 0.0)) if math.isfinite(near) else near
        return Shaft(
            at=at,
            low=lowest - min(OUT[0] * 2 * radius, OUT[1] * wall),
            high=high,
            skin=low,
            floor=floor,
            clearance=clearance,
            near=points[nearest],
        )

    def _around(self, at: Floats, face: int, low: float, high: float, far: float) -> tuple[Integers, Integers]:
        """Return the faces of the mouth near a hole that go on from a face there, and those that do not."""
        least, most = np.array([*(at - far), low]), np.array([*(at + far), high])
        own = np.flatnonzero(self.mouths == self.mouths[face])
        boxes = self.corners[own]
        own = own[(boxes.min(axis=1) <= most).all(axis=1) & (boxes.max(axis=1) >= least).all(axis=1)]
        inside = np.zeros(len(self.part.faces), dtype=bool)
        inside[own] = True
        pairs = self.neighbours[inside[self.neighbours].all(axis=1)]
        number = np.full(len(inside), -1, dtype=np.int64)
        number[own] = np.arange(len(own))
        names = _components(number[pairs], len(own))
        reached = names == names[number[face]]
        return own[reached], own[~reached]

    def _rim(self, at: Floats, faces: Integers, low: float, radius: float) -> Floats | None:
        """Return the heights at which a hole leaves faces, all around and half way in; None if it runs off them."""
        angle = 2 * np.pi * np.arange(RIM) / RIM
        circle = radius * np.column_stack([np.cos(angle), np.sin(angle)])
        heights = np.abs((found := _heights(self.corners[faces], at + np.concatenate([circle, circle / 2]))) - low)
        nearest = np.argmin(np.where(np.isnan(heights), np.inf, heights), axis=0)
        rim: Floats = found[nearest, np.arange(2 * RIM)]
        return None if np.isnan(rim).any() else rim


def _heights(corners: Floats, places: Floats) -> Floats:
    """Return the heights at which vertical lines at places (M, 2) cross triangles (F, 3, 3), (F, M); or nan."""
    x, y = (corners[:, None, :, axis] - places[None, :, None, axis] for axis in (0, 1))
    after, last = [1, 2, 0], [2, 0, 1]
    shares = x[:, :, after] * y[:, :, last] - x[:, :, last] * y[:, :, after]
    area = shares.sum(axis=2)
    hit = (area != 0) & ((shares * np.sign(area)[:, :, None]) >= 0).all(axis=2)
    height: Floats = np.full(hit.shape, np.nan)
    np.divide((shares * corners[:, None, :, 2]).sum(axis=2), area, out=height, where=hit)
    return height


def _components(pairs: Integers, count: int) -> Integers:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(pairs), dtype=np.int8), tuple(pairs.T)), shape=(count, count))
    names: Integers = connected_components(graph, directed=False)[1].astype(np.int64)
    return names


def _surface_points(
    at: Floats, low: Floats, high: Floats, radius: float, around: int, along: int, ends: tuple[float, ...] = ENDS
) -> Floats:
    """Return points on holes, (N, M, 3): on circles along them, and on both ends."""
    angle = 2 * np.pi * np.arange(around) / around
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    shares = np.linspace(0, 1, along)
    rings = [(1.0, share) for share in shares] + [(inner, end) for inner in ends for end in (0.0, 1.0)]
    flat = np.concatenate([size * radius * circle for size, _ in rings])
    share = np.repeat([share for _, share in rings], around)
    points = np.empty((len(at), len(flat), 3))
    points[:, :, :2] = at[:, None] + flat
    points[:, :, 2] = low[:, None] + share * (high - low)[:, None]
    return points


def _fine_points(at: Floats, low: float, high: float, radius: float) -> tuple[Floats, float]:
    """Return many points on a hole, (M, 3), and how far any other is from one of them at most, mm."""
    around, least = FINE
    arc = 2 * np.pi * radius / around
    along = max(least, math.ceil((high - low) / arc) + 1)
    points = _surface_points(at[None], np.array([low]), np.array([high]), radius, around, along)[0]
    return points, math.hypot(arc, (high - low) / (along - 1)) / 2
