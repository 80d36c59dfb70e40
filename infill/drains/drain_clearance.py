"""The distance of a hole straight down out of a part from its skin, except the face that it leaves through.

mouth      the smooth face around the place where the axis leaves, as far as it looks down
other skin everything else: sides, bolt holes, chamfers, whatever lies above or below
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from infill.arrays import Flags, Floats, Integers
from infill.drains.drain_columns import DrainWays
from infill.drains.holes import DrainNeeds, Shaft
from infill.graph import label_connected
from infill.isosurfaces.components import shell_names
from infill.meshes.distance import TriangleTree
from infill.meshes.shells import shell_volumes
from infill.surface import Surface

LEAVING, FACING = 0.5, 0.35  # cosines of the largest slopes of a face for a hole to leave through it, and for its mouth
SMOOTH = math.cos(math.radians(30))  # triangles that meet at a larger angle belong to different faces
ENDS = (0.0, 0.4, 0.75)  # of the radius: circles on the ends of a hole
FEW, COARSE, FINE = (4, 3, ()), (16, 8, ENDS), (64, 24)  # points around a hole and along it, and circles on its ends
CERTAIN = 0.999  # of the wall: smaller distances need not be exact
RIM = 24  # lines along a hole by which its mouth is found
NEAR = 1.0  # of diameter and wall: within this of a hole, faces are joined to its mouth
OUT = 0.25, 0.4  # of the diameter and of the wall; the lesser is the length of a hole outside


@dataclass(frozen=True, kw_only=True, eq=False)
class Skin:
    """The skin of a part, which holes go straight down through.

    Parameters
    ----------
    part : Surface, mm
        Closed, facing outwards.
    """

    part: Surface
    _trees: dict[int, TriangleTree | None] = field(default_factory=dict, repr=False)

    @cached_property
    def corners(self) -> Floats:
        """Corners of every face, (F, 3, 3) mm."""
        corners: Floats = np.asarray(self.part.vertices, dtype=np.float64)[self.part.faces]
        return corners

    @cached_property
    def normals(self) -> Floats:
        """Normals of all faces, (F, 3); 0 for a face without area."""
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
        before, after = owner[:-1][same], owner[1:][same]
        smooth = (self.normals[before] * self.normals[after]).sum(axis=1) >= SMOOTH
        is_pair = smooth & self.facing[before] & self.facing[after]
        return np.stack([before[is_pair], after[is_pair]], axis=1)

    @cached_property
    def facing(self) -> Flags:
        """True for faces that look down."""
        return -self.normals[:, 2] >= FACING

    @cached_property
    def smooth_faces(self) -> Integers:
        """Number of the smooth face that each face of the mesh belongs to, (F,); -1 if it does not look down."""
        names = _label_components(self.neighbours, len(self.part.faces))
        return np.where(self.facing, names, -1)

    @cached_property
    def leaving(self) -> Flags:
        """True for faces a hole may leave through: nearly level, and not those of a closed cavity."""
        names, count = shell_names(self.part)
        outer = shell_volumes(self.part, names, count) > 0
        level: Flags = (-self.normals[:, 2] >= LEAVING) & outer[names[self.part.faces[:, 0]]]
        return level

    @cached_property
    def whole(self) -> TriangleTree:
        """Search tree of all faces."""
        return TriangleTree.of(self.part)

    def tree(self, mouth: int) -> TriangleTree | None:
        """Build the tree of triangles outside a smooth face, or, for -1, of all that do not look down; else None."""
        if mouth not in self._trees:
            is_outside = ~self.facing if mouth < 0 else self.smooth_faces != mouth
            self._trees[mouth] = None
            if is_outside.any():
                self._trees[mouth] = TriangleTree.of(
                    Surface(vertices=self.part.vertices, faces=self.part.faces[is_outside])
                )
        return self._trees[mouth]

    def has_tree(self, mouth: int) -> bool:
        """Tell whether `tree` was built before for a mouth, the number of a smooth face."""
        return mouth in self._trees

    def may_keep(self, ways: DrainWays, numbers: Integers, high: Floats, needs: DrainNeeds, mouth: int) -> Flags:
        """Test which holes may keep the wall from the skin outside a mouth, (N,), by points on them, few at first.

        Parameters
        ----------
        ways : DrainWays
        numbers : (N,) int64
            Of the ways along which the holes lead.
        high : (N,) float64, mm
            Heights at which they end.
        needs : DrainNeeds
        mouth : int
            Number of a smooth face, or -1: see `tree`.
        """
        tree, at, low = self.tree(mouth), ways.at[numbers], ways.skin[numbers]
        remaining = np.arange(len(at))
        if tree is not None:
            z = -self.normals[ways.face[numbers], 2]
            slope = needs.radius * np.sqrt(np.clip(1 - z**2, 0, None)) / z
            for around, along, ends in (FEW, COARSE):
                points = _surface_points(
                    at[remaining], (low - slope)[remaining], high[remaining], needs.radius, around, along, ends
                )
                distances, _ = tree.nearest(points.reshape(-1, 3), enough=CERTAIN * needs.wall, threads=needs.threads)
                nearest = distances.reshape(points.shape[:2]).min(axis=1, initial=np.inf)
                remaining = remaining[nearest >= needs.wall]
        may_keep = np.zeros(len(at), dtype=bool)
        may_keep[remaining] = True
        return may_keep

    def shaft(self, ways: DrainWays, way: int, high: float, needs: DrainNeeds) -> Shaft | None:
        """Measure the hole along a way, up to a height, mm.

        Return the heights at which its rim leaves the part, and its distance from the other skin; None if the hole runs
        over the edge of the face that it leaves through.
        """
        at, face, low = ways.at[way], int(ways.face[way]), float(ways.skin[way])
        radius, wall, threads = needs.radius, needs.wall, needs.threads
        reach = NEAR * (2 * radius + wall)
        mouth_faces, stray = self._split_mouth(at, face, low - reach, high, radius + reach)
        rim = self._find_rim(at, mouth_faces, low, radius)
        if rim is None:
            return None
        lowest, highest = min(low, *rim), max(low, *rim)
        if highest > high:
            return None
        points, spacing = _fine_points(at, lowest, high, radius)
        trees = [self.tree(int(self.smooth_faces[face]))]
        if len(stray):
            trees.append(TriangleTree.of(Surface(vertices=self.part.vertices, faces=self.part.faces[stray])))
        distances = np.full(len(points), np.inf)
        for tree in trees:
            if tree is not None:
                distances = np.minimum(distances, tree.nearest(points, threads=threads)[0])
        nearest = int(np.argmin(distances))
        # Between two of these points the hole may come nearer, so the distance of the nearest point is reduced.
        distance = float(distances[nearest])
        clearance = (
            math.sqrt(max(distance**2 - spacing**2 * (1 + distance / radius), 0.0))
            if math.isfinite(distance)
            else distance
        )
        return Shaft(
            at=at,
            low=lowest - min(OUT[0] * 2 * radius, OUT[1] * wall),
            high=high,
            skin=low,
            floor=float(ways.floor[way]),
            clearance=clearance,
            near=points[nearest],
        )

    def _split_mouth(
        self, at: Floats, face: int, low: float, high: float, distance: float
    ) -> tuple[Integers, Integers]:
        """Divide the faces of the mouth near a hole into those connected to a face there, and the others."""
        lower, upper = np.array([*(at - distance), low]), np.array([*(at + distance), high])
        nearby = np.flatnonzero(self.smooth_faces == self.smooth_faces[face])
        boxes = self.corners[nearby]
        nearby = nearby[(boxes.min(axis=1) <= upper).all(axis=1) & (boxes.max(axis=1) >= lower).all(axis=1)]
        inside = np.zeros(len(self.part.faces), dtype=bool)
        inside[nearby] = True
        pairs = self.neighbours[inside[self.neighbours].all(axis=1)]
        number = np.full(len(inside), -1, dtype=np.int64)
        number[nearby] = np.arange(len(nearby))
        names = _label_components(number[pairs], len(nearby))
        reached = names == names[number[face]]
        return nearby[reached], nearby[~reached]

    def _find_rim(self, at: Floats, faces: Integers, low: float, radius: float) -> Floats | None:
        """Return the heights at which a hole leaves faces, all around and half way in; None if it runs off them."""
        angle = 2 * np.pi * np.arange(RIM) / RIM
        circle = radius * np.column_stack([np.cos(angle), np.sin(angle)])
        offsets = np.abs(
            (heights := _crossing_heights(self.corners[faces], at + np.concatenate([circle, circle / 2]))) - low
        )
        nearest = np.argmin(np.where(np.isnan(offsets), np.inf, offsets), axis=0)
        rim: Floats = heights[nearest, np.arange(2 * RIM)]
        return None if np.isnan(rim).any() else rim


def _crossing_heights(corners: Floats, places: Floats) -> Floats:
    """Return the heights at which vertical lines at places (M, 2) cross triangles (F, 3, 3): (F, M), or nan."""
    x, y = (corners[:, None, :, axis] - places[None, :, None, axis] for axis in (0, 1))
    following, before = [1, 2, 0], [2, 0, 1]
    shares = x[:, :, following] * y[:, :, before] - x[:, :, before] * y[:, :, following]
    area = shares.sum(axis=2)
    hit = (area != 0) & ((shares * np.sign(area)[:, :, None]) >= 0).all(axis=2)
    height: Floats = np.full(hit.shape, np.nan)
    np.divide((shares * corners[:, None, :, 2]).sum(axis=2), area, out=height, where=hit)
    return height


def _label_components(pairs: Integers, count: int) -> Integers:
    """Label items 0 to `count` - 1, joined by pairs (N, 2); return the component of each, (count,)."""
    return label_connected(pairs[:, 0], pairs[:, 1], count)[0].astype(np.int64)


def _surface_points(
    at: Floats, low: Floats, high: Floats, radius: float, around: int, along: int, ends: tuple[float, ...] = ENDS
) -> Floats:
    """Place points on holes, (N, M, 3): on circles along them, and on both ends."""
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
    """Place many points on a hole about (x, y), (M, 3); also return how far from these its surface goes, mm."""
    around, least = FINE
    arc = 2 * np.pi * radius / around
    along = max(least, math.ceil((high - low) / arc) + 1)
    points = _surface_points(at[None], np.array([low]), np.array([high]), radius, around, along)[0]
    return points, math.hypot(arc, (high - low) / (along - 1)) / 2
