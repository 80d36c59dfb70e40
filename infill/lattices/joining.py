"""Patterns of regions joined with that of the rest: the voids of whole fills, cut along the regions and united.

    voids of the whole part with the pattern of the rest
    voids of the whole part with the pattern of a region   ->  cut along its border, joined  ->  voids of the part

The walls of the region end at its border, and those of the rest as far inside of it as they are wide. In between, both
are solid: there they cross and hold one another, and voids of both run into one another. Where they would not hold, a
wall along the border divides them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import GeometryError
from infill.interior.interior import compute_interior
from infill.lattices.areas import find_areas
from infill.lattices.bodies import Fields
from infill.lattices.density_search import make_voids
from infill.lattices.hollowing import make_void_meshes, simplify_to_fit, simplify_voids
from infill.lattices.region_densities import CLOSE, measure_joined_regions, sample_regions, widen_regions
from infill.lattices.region_nodes import PlacedRegion
from infill.lattices.region_solids import make_region_solid
from infill.lattices.request import has_bars
from infill.lattices.surfacing import drop_small_and_floating, drop_useless, extract_inner_side
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.solids import FINE, coincident_vertices, from_manifold, simplify_solid, solid_status, to_manifold
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

SHORT = 1e-3  # mm: edges that cutting leaves are longer than that, or nearly
MOST_LOOSE = 0.01  # of the infill of a region: if more of it would hang free, a wall divides the patterns
SMALL = 1e-6
ROUNDS = 3  # of densities that are corrected for the border, at most
MOST = 2.0  # times that a round changes a width, at most
MOST_CELLS = 1e6  # of the grid on which the mesh of a region is made smaller


@dataclass(frozen=True, kw_only=True, eq=False)
class PatternVoids:
    """The voids of a whole part with one pattern.

    Parameters
    ----------
    region : PlacedRegion or None
        Where the pattern is; None for the rest.
    task : FillTask
        To fill the whole part so.
    hollow : VoidMeshes
    fields : VoidFields or BodyFields
    wanted : (R,) float64
        Requested densities in the regions of the task; nan where they do not matter.
    numbers : (R,) int
        Of these regions among those of the part.
    """

    region: PlacedRegion | None
    task: FillTask
    hollow: VoidMeshes
    fields: Fields
    wanted: Floats
    numbers: NDArray[np.int_]

    @classmethod
    def make(cls, task: FillTask, region: PlacedRegion | None) -> PatternVoids:
        """Make the voids of a task whose pattern is in a region, or outside of all."""
        hollow, fields = make_void_meshes(task)
        local = hollow.layout.local
        nodes = None if local is None else local.regions
        return cls(
            region=region,
            task=task,
            hollow=hollow,
            fields=fields,
            wanted=np.empty(0) if nodes is None else nodes.wanted,
            numbers=np.array([] if nodes is None else [0, *(each.number for each in nodes.regions)], dtype=int),
        )

    def correct(self, measured: Floats) -> PatternVoids:
        """Return the same with other widths where densities of the joined part, (regions + 1,), are not as requested.

        The infill of the border is of both patterns, which adds to the density of the region.
        """
        if not len(self.wanted):
            return self
        layout, actual = self.hollow.layout, measured[self.numbers]
        is_off = np.abs(actual - self.wanted) > CLOSE  # False for nan
        is_off[1:] &= self.numbers[1:] > 0
        if not is_off.any():
            return self
        assert layout.local is not None
        assert layout.local.regions is not None
        nodes, power = layout.local.regions, 2 if has_bars(self.task.request.kind) else 1
        factors = np.where(is_off, np.clip(self.wanted / np.maximum(actual, SMALL), 1 / MOST, MOST), 1.0)
        local = widen_regions(layout.local, nodes.ratios * factors ** (1 / power), nodes.ratios)
        hollow, fields = make_voids(self.task, replace(layout, local=local), self.fields)
        return replace(self, hollow=simplify_voids(self.task, hollow, self.task.request.tolerance), fields=fields)


def make_joined_voids(task: FillTask) -> tuple[VoidMeshes, Fields]:
    """Make the voids of a part whose regions may have other patterns; return them, and the fields of the rest.

    Raises
    ------
    GeometryError
        If there is no room for a void, or the mesh of a region is not a solid.
    MemoryLimitError
        If memory will not suffice.
    """
    areas = find_areas(task.request)
    if not areas:
        return make_void_meshes(task)
    tasks = [
        FillTask.of(task.part, area.request, clock=task.clock, threads=task.threads, max_memory=task.max_memory)
        for area in areas
    ]
    rest = PatternVoids.make(task, None)
    pieces = [PatternVoids.make(own, area.region) for area, own in zip(areas, tasks, strict=True)]
    with task.clock.stage("voids", 0.7):
        volumes = sample_regions(rest.hollow.space, task.request.regions).volumes
        joined = _join(rest, pieces)
        for _ in range(ROUNDS):
            measured = measure_joined_regions(joined, task.request.regions, volumes)
            before = [rest, *pieces]
            rest, *pieces = (piece.correct(measured) for piece in before)
            if all(after is piece for after, piece in zip([rest, *pieces], before, strict=True)):
                break
            joined = _join(rest, pieces)
    room = task.request.triangles_left(len(joined.space.part.faces))
    if joined.triangles > room:
        with task.clock.stage("simplify", 0.8):
            joined = simplify_to_fit(task, joined, room)
    return joined, rest.fields


def _join(rest: PatternVoids, pieces: list[PatternVoids]) -> VoidMeshes:
    """Join the voids of regions with those of the rest."""
    hollow, divided = rest.hollow, list[str]()
    voids, width = _unite_voids(hollow.surfaces), _widest(hollow)
    for piece in pieces:
        region, inner = _cut_region(piece, max(width, _widest(piece.hollow)))
        inside = _unite_voids(piece.hollow.surfaces)
        joined, cut = (voids + inner) - (region - inside), inside ^ region
        infill = cut.volume() * piece.hollow.density / max(1 - piece.hollow.density, SMALL)
        if _loose_volume(joined) > MOST_LOOSE * infill:
            joined = (voids - region) + (cut ^ inner)
            divided.append("" if piece.region is None else piece.region.place)
        voids, width = joined, max(width, _widest(piece.hollow))
    if solid_status(voids) != FINE:
        raise GeometryError("manifold3d rejects the voids as solids; give another cell or smaller voxels")
    surface = from_manifold(voids)
    if coincident_vertices(surface).any():
        surface = simplify_solid(surface, SHORT)
    useful = drop_useless(iter([surface]), hollow.layout)
    return replace(
        hollow,
        surfaces=useful.surfaces,
        islands=sum(each.islands for each in (hollow, useful, *(piece.hollow for piece in pieces))),
        specks=sum(each.specks for each in (hollow, useful, *(piece.hollow for piece in pieces))),
        divided=tuple(divided),
    )


def _widest(hollow: VoidMeshes) -> float:
    """Return the width of the widest walls or bars, mm."""
    local = hollow.layout.local
    return hollow.width * (1.0 if local is None else local.widths[1])


def _unite_voids(surfaces: tuple[Surface, ...]) -> manifold3d.Manifold:
    """Unite the voids of all fields, which do not overlap."""
    import manifold3d

    return manifold3d.Manifold.batch_boolean([to_manifold(surface) for surface in surfaces], manifold3d.OpType.Add)


def _loose_volume(voids: manifold3d.Manifold) -> float:
    """Return the volume of the pieces of infill that hang free in voids, mm³."""
    *_, loose = drop_small_and_floating(from_manifold(voids), 0.0)
    return 0.0 if loose is None else loose.volume


def _cut_region(piece: PatternVoids, width: float) -> tuple[manifold3d.Manifold, manifold3d.Manifold]:
    """Return the solid of a region, and what of it is further from its border than a width, mm."""
    import manifold3d

    region, bounds = piece.region, np.asarray(piece.hollow.space.part.bounds, dtype=np.float64)
    assert region is not None
    solid = make_region_solid(region, bounds)
    if region.surface is None or solid.is_empty():
        return solid, make_region_solid(region, bounds, width)
    mesh = from_manifold(solid)
    voxel = max(width, math.cbrt(float(np.prod(np.ptp(mesh.bounds, axis=0))) / MOST_CELLS))
    space = compute_interior(mesh, wall=0.0, voxel=voxel, threads=piece.task.threads)
    if not (space.depth > width / voxel).any():
        return solid, manifold3d.Manifold()
    inner = extract_inner_side(space, overlap=-width, tolerance=voxel / 10, threads=piece.task.threads)
    return solid, to_manifold(inner)
