"""Voids with fewer triangles."""

from __future__ import annotations

import math
from dataclasses import replace

from infill.lattices.fill_job import Job
from infill.lattices.slabwise import surfaces_by_slabs
from infill.lattices.surfacing import SHARE, drop_small_and_floating
from infill.lattices.void_meshes import VoidMeshes
from infill.machine import require_memory
from infill.meshes.shells import split_into_batches
from infill.meshes.simplification import simplify_surface
from infill.meshes.solids import simplify_solid
from infill.meshes.split_components import concatenate_surfaces

FINEST, DOUBLINGS = 0.01, 4  # of a cell: where tolerances begin; how often they are doubled for fewer triangles
FIRST = 0.75  # of a tolerance, for the pieces of a surface that is made slab by slab; the rest is for all of it
AT_ONCE = 500_000  # triangles that are simplified at a time, if they are of several voids: this bounds memory
FEW_AT_ONCE = 30_000  # the same for voids made slab by slab, with few triangles from the beginning
COLLAPSE_BYTES = 4000  # for each triangle, at most
FLAT = 0.01  # cells: the triangles of a void smaller than a cube of this side coincide


def simplify_voids(job: Job, hollow: VoidMeshes, tolerance: float) -> VoidMeshes:
    """Simplify the voids: drop triangles that flat places do not need, and voids that this flattens."""
    budget, at_once = tolerance, AT_ONCE
    if hollow.deferred is not None:
        hollow = surfaces_by_slabs(job, hollow.deferred.fields, tolerance=FIRST * tolerance)
        budget, at_once = (1 - FIRST) * tolerance, FEW_AT_ONCE
    if tolerance == 0:
        return hollow
    surfaces, results = list(hollow.surfaces[::-1]), []
    hollow = replace(hollow, surfaces=(), tolerance=tolerance)
    while surfaces:  # popped, so that memory is freed as soon as possible
        simple = concatenate_surfaces(
            [simplify_solid(batch, SHARE * budget) for batch in split_into_batches(surfaces.pop(), at_once)]
        )
        results.append(drop_small_and_floating(simple, (FLAT * hollow.space.size) ** 3)[0])
    return replace(hollow, surfaces=tuple(surface for surface in results if surface is not None))


def simplify_to_fit(job: Job, hollow: VoidMeshes, room: int) -> VoidMeshes:
    """Simplify the voids until few enough triangles remain, even beyond the requested tolerance."""
    tolerance = max(hollow.tolerance, FINEST * hollow.space.size)
    for _ in range(DOUBLINGS):
        tolerance *= 2
        simple = simplify_voids(job, hollow, tolerance)
        if simple.triangles <= room:
            return simple
    needed = COLLAPSE_BYTES * max(len(surface.faces) for surface in simple.surfaces)
    advice = f"the voids have {hollow.triangles:,} triangles; give larger cells or voxels"
    require_memory(needed, job.max_memory, advice)
    share = room / simple.triangles
    fewest = [
        simplify_surface(surface, triangles=max(4, int(share * len(surface.faces))), threads=job.threads)
        for surface in simple.surfaces
    ]
    return replace(hollow, surfaces=tuple(fewest), tolerance=math.inf)
