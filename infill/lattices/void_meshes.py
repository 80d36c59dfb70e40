"""The voids of a part as closed surfaces, and their measurements."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.isosurfaces.components import shell_names
from infill.lattices.bodies import Fields
from infill.lattices.voids import Layout
from infill.meshes.distance import TriangleTree
from infill.meshes.measuring import face_areas, volume_and_area
from infill.meshes.solids import shared_volume
from infill.meshes.split_components import concatenate_surfaces
from infill.paths.ties import Ties
from infill.surface import Surface

SAMPLES, FEWEST = 2000, 50  # points, and the least number of them for a median
START, MOST = 0.25, 3.0  # of the width as drawn: where the search across begins, and where it is given up
AWAY = 1.5  # widths from the walls of the part, at least
STEPS = 12  # of the search; the final ones are far too short to matter
AT_A_TIME = 100_000  # triangles in a tree, roughly


@dataclass(frozen=True, kw_only=True, eq=False)
class DeferredVoids:
    """Voids whose surfaces are made later, slab by slab.

    Parameters
    ----------
    volume : float
        mm³
    fields : VoidFields or BodyFields
    """

    volume: float
    fields: Fields


@dataclass(frozen=True, kw_only=True, eq=False)
class VoidMeshes:
    """The voids of a part.

    Parameters
    ----------
    layout : Layout
        Of the pattern inside the walls: smoothing makes walls between narrow voids wider, and bars thinner.
    surfaces : tuple of Surface, mm
        The voids, facing outwards from them, one surface for each field.
    tolerance : float
        Largest distance by which simplifying has moved them, mm; not finite if unknown.
    islands, specks : int
        Numbers of floating pieces of solid, which were dropped, and of voids that were too small.
    walls : Surface or None, mm
        The inner side of the walls, if voids reach through them.
    loose : float
        mm³ of infill that was left out: pieces that float where the part was cut open, or that slicers do not print.
    deferred : DeferredVoids or None
        Set in place of surfaces until they are made.
    ties : Ties
        Bars that tie islands of lines to the rest, mm.
    divided : tuple of str
        The regions that a wall divides from other patterns: see `infill.lattices.joining`.
    """

    layout: Layout
    surfaces: tuple[Surface, ...] = ()
    tolerance: float = 0.0
    islands: int = 0
    specks: int = 0
    walls: Surface | None = None
    loose: float = 0.0
    deferred: DeferredVoids | None = None
    ties: Ties = field(default_factory=Ties.none)
    divided: tuple[str, ...] = ()

    @property
    def space(self) -> Interior:
        """The space inside the walls."""
        return self.layout.space

    @property
    def cell(self) -> float:
        """Of the pattern as it was drawn, mm."""
        return self.layout.cell

    @property
    def width(self) -> float:
        """Of its walls or bars as they were drawn, mm."""
        return self.layout.width

    @property
    def surface(self) -> Surface:
        """All voids, mm."""
        return concatenate_surfaces(list(self.surfaces))

    @cached_property
    def count(self) -> int:
        """Number of voids."""
        return sum(shell_names(surface)[1] for surface in self.surfaces)

    @property
    def open(self) -> int:
        """Number of voids that reach out of an open side of the part."""
        opening = self.space.opening
        return 0 if opening is None else sum(int(opening.reaches_out(surface).sum()) for surface in self.surfaces)

    @property
    def triangles(self) -> int:
        """Number of triangles of all voids."""
        return sum(len(surface.faces) for surface in self.surfaces)

    @cached_property
    def volume(self) -> float:
        """Volume of all voids inside the walls, mm³."""
        opening = self.space.opening
        if self.deferred is not None:
            return self.deferred.volume
        if opening is not None:
            return self.loose + sum(opening.volume(surface) for surface in self.surfaces)
        if self.walls is None:
            return sum(volume_and_area(surface)[0] for surface in self.surfaces)
        return self.loose + sum(shared_volume(surface, self.walls) for surface in self.surfaces)

    @cached_property
    def median_width(self) -> tuple[float | None, int]:
        """Median width of walls, or thickness of bars, away from the part's walls, mm; and the number of points."""
        if not self.surfaces:
            return None, 0
        space, threads = self.space, self.layout.threads
        return median_width(space.part, self.surface, wall=space.wall, width=self.width, threads=threads)

    @property
    def density(self) -> float:
        """Solid share of the space inside the walls."""
        return 1 - self.volume / self.room_volume

    @property
    def density_before(self) -> float:
        """Density before anything was left out."""
        return 1 - (self.volume - self.loose) / self.room_volume

    @cached_property
    def room_volume(self) -> float:
        """Volume inside the walls, mm³."""
        return self.space.volume if self.walls is None else self.walls.volume


def median_width(
    part: Surface, voids: Surface, *, wall: float, width: float, threads: int | None = None
) -> tuple[float | None, int]:
    """Measure the median width of walls, or diameter of bars, between voids, mm; return it and the number of points.

    From points spread evenly over the voids, the distance straight across to the next void is measured. Points near the
    walls of the part do not count. The width is None if there are too few points.

    Parameters
    ----------
    part, voids : Surface, mm
        Voids face outwards: into the solid.
    wall : float
        Of the part, mm.
    width : float
        As drawn, mm.
    """
    areas = np.cumsum(face_areas(voids))
    if not areas[-1] > 0:
        return None, 0
    sampled = np.searchsorted(areas, areas[-1] * np.random.default_rng(0).random(SAMPLES), side="right")
    del areas
    a, b, c = (np.asarray(voids.vertices, dtype=np.float64)[voids.faces[sampled, corner]] for corner in range(3))
    points, across = (a + b + c) / 3, np.cross(b - a, c - a)
    normals = across / np.linalg.norm(across, axis=1, keepdims=True)
    distance, face = TriangleTree.of(part).nearest(points, threads=threads)
    a, b, c = (np.asarray(part.vertices, dtype=np.float64)[part.faces[face, corner]] for corner in range(3))
    is_below_skin = np.einsum("ij,ij->i", points - a, np.cross(b - a, c - a)) < 0  # open voids come out of the part
    is_inside = is_below_skin & (distance > wall + AWAY * width)
    points, normals = points[is_inside], normals[is_inside]
    if len(points) < FEWEST:
        return None, len(points)
    longest = MOST * width
    along = np.full(len(points), START * width)
    for batch, tree in _trees_near(
        points, voids, 2 * longest
    ):  # queries lie up to `longest` from points, and reach as far
        for _ in range(STEPS):
            # No void is nearer than this, so the way across is free up to there.
            free, _ = tree.nearest(points[batch] + along[batch, None] * normals[batch], threads=threads)
            along[batch] = np.minimum(along[batch] + free, longest)
    return float(np.median(along)), len(points)


def _trees_near(points: Floats, surface: Surface, reach: float) -> Iterator[tuple[NDArray[np.intp], TriangleTree]]:
    """Yield batches of points, (n,), each with a tree of at least the faces within a reach of them, mm.

    Batches follow each other along the longest side of the surface, so that trees do not grow with its length.
    """
    axis = int(np.argmax(np.ptp(surface.bounds, axis=0)))
    place, height, faces = points[:, axis], surface.vertices[:, axis], surface.faces
    for batch in np.array_split(np.argsort(place), -(-len(faces) // AT_A_TIME)):
        if not len(batch):
            continue
        below, above = height < place[batch[0]] - reach, height > place[batch[-1]] + reach
        is_near = ~(below[faces].all(axis=1) | above[faces].all(axis=1))
        if is_near.any():
            yield batch, TriangleTree.of(replace(surface, faces=faces[is_near]))
