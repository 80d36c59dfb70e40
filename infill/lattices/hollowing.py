"""The voids of a part as closed surfaces: as dense as requested, on a grid as fine as their triangles allow."""

from __future__ import annotations

import math
from dataclasses import replace

from infill.errors import GeometryError
from infill.interior.interior import compute_interior
from infill.lattices.bodies import Fields
from infill.lattices.density_search import estimate_triangles, find_sizes, fit_density, has_uniform_width
from infill.lattices.request import Size
from infill.lattices.sizing import choose_sizes, choose_voxel, coarsest_voxel, enlarge, goes_by_slabs
from infill.lattices.slabwise import surfaces_by_slabs
from infill.lattices.surfacing import SHARE, choose_smoothing, drop_small_and_floating
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.lattices.voids import Layout
from infill.machine import require_memory
from infill.meshes.shells import split_into_batches
from infill.meshes.simplification import simplify_surface
from infill.meshes.solids import simplify_solid
from infill.meshes.split_components import concatenate_surfaces
from infill.plain_numbers import plain_argument

REFITS = 3
MOST_LARGER = 3.0  # most that cells and walls grow at a time, where there are too many triangles
FEWER = 1.04  # margin on the size of cells, as triangles fall with its square
FAR_TOO_MANY = 4.0  # triangles, over the room for them: more are not even made
WIDTH_CLOSE, REDRAWN = 0.03, 2  # of the line width: good enough; and how often walls are redrawn otherwise
SURE = 400  # points from which a median width is sure enough to redraw walls
FARTHER_OFF = 0.005  # of the density: error that the right width of walls may not cost
LEAST_THICK = 1.5  # cells of the grid in the thickness of what lies inside the walls
FINEST, DOUBLINGS = 0.01, 4  # of a cell: where tolerances begin; how often they are doubled for fewer triangles
FIRST = 0.75  # of a tolerance, for the pieces of a surface that is made slab by slab; the rest is for all of it
AT_ONCE = 500_000  # triangles that are simplified at a time, if they are of several voids: this bounds memory
FEW_AT_ONCE = 30_000  # the same for voids made slab by slab, with few triangles from the beginning
COLLAPSE_BYTES = 4000  # for each triangle, at most
FLAT = 0.01  # cells: the triangles of a void smaller than a cube of this side coincide


def make_void_meshes(task: FillTask) -> tuple[VoidMeshes, Fields]:
    """Make the voids that a pattern leaves in a part, on a grid as fine as their triangles allow.

    If there are still too many triangles, and neither cell nor line width was requested, both are enlarged. Return also
    the fields that were drawn last.

    Raises
    ------
    GeometryError
        If there is no room for a void, or for its triangles.
    MemoryLimitError
        If memory will not suffice.
    """
    request, clock = task.request, task.clock
    with clock.stage("density", 0.0):
        (cell, width), varied = choose_sizes(task), request.varied
    voxel = choose_voxel(task, cell, width)
    is_last = False
    for attempt in range(REFITS + 1):
        progress, is_last = 0.2 * attempt, is_last or attempt == REFITS
        with clock.stage("depth", progress):
            space = compute_interior(
                task.part,
                wall=request.wall,
                voxel=voxel,
                places=task.local_walls,
                open_=request.open_,
                beyond=request.beyond,
                extra_bytes_per_cell=request.extra_bytes_per_cell,
                slabs=goes_by_slabs(task),
                threads=task.threads,
                max_memory=task.max_memory,
            )
        room = request.triangles_left(len(space.part.faces))
        with clock.stage("density", progress + 0.05):
            grading = request.grading
            local = None if grading is None else grading.widths_in(space, task.pattern.widths)
            layout = Layout(space=space, cell=cell, width=width, local=local, threads=task.threads)
            layout, varied, known = find_sizes(task, layout, varied)
            triangles, known = estimate_triangles(task, layout, known)
        if is_last or triangles <= FAR_TOO_MANY * room:
            with clock.stage("voids", progress + 0.1):
                hollow, fields = fit_density(task, layout, varied, known)
            with clock.stage("simplify", progress + 0.18):
                hollow = simplify_voids(task, hollow, request.tolerance)
            if is_last or hollow.triangles <= room:
                with clock.stage("voids", progress + 0.19):
                    hollow, fields = match_width(task, hollow, layout.width, varied, fields)
                if is_last or hollow.triangles <= room:
                    break
            triangles, layout = hollow.triangles, replace(layout, cell=hollow.cell)
        cell, width, coarser = _coarsen(task, layout, voxel, triangles / room)
        coarser = min(coarser, space.thickness / LEAST_THICK)
        is_last = coarser < 1.05 * voxel
        if is_last:
            cell, width = layout.cell, layout.width
        else:
            voxel = coarser
    if not hollow.surfaces:
        raise GeometryError(
            f"the pattern leaves no void inside walls of {plain_argument(request.wall)} mm; give larger cells, "
            "narrower lines, a lower density or a thinner wall"
        )
    if hollow.triangles > room:
        with clock.stage("simplify", 0.8):
            hollow = simplify_to_fit(task, hollow, room)
    return hollow, fields


def _coarsen(task: FillTask, layout: Layout, voxel: float, excess: float) -> tuple[float, float, float]:
    """Return a cell, a width and a voxel that leave a fraction of the triangles, as far as limits allow."""
    request, cell, width = task.request, layout.cell, layout.width
    target, coarsest = voxel * max(1.1, FEWER * excess**0.5), coarsest_voxel(task, cell, width)
    if target > coarsest and request.cell is None and request.line_width is None:
        cell, width = enlarge(request, (cell, width), min(MOST_LARGER, max(1.2, target / coarsest)))
        coarsest = coarsest_voxel(task, cell, width)
    return cell, width, min(target, coarsest)


def match_width(
    task: FillTask, hollow: VoidMeshes, width: float, varied: tuple[Size, ...], fields: Fields
) -> tuple[VoidMeshes, Fields]:
    """Redraw voids until walls between them have the requested width, mm, unless the density fixes the width."""
    request = task.request
    if "width" in varied[:1] or request.grading is not None or not has_uniform_width(task):
        return hollow, fields
    fields = task.draw(replace(hollow.layout, space=task.space_for_voids(hollow.space)), fields)
    if not choose_smoothing(task, fields).steps:
        return hollow, fields
    for _ in range(REDRAWN):
        median, seen = hollow.median_width
        if median is None or seen < SURE or abs(median / width - 1) <= WIDTH_CLOSE:
            break
        layout = replace(hollow.layout, width=hollow.width * width / median)
        redrawn, fields = fit_density(task, layout, varied, fields)
        redrawn = simplify_voids(task, redrawn, request.tolerance)
        if not redrawn.surfaces or abs(redrawn.density - (request.density or redrawn.density)) > FARTHER_OFF:
            break
        hollow = redrawn
    return hollow, fields


def simplify_voids(task: FillTask, hollow: VoidMeshes, tolerance: float) -> VoidMeshes:
    """Simplify the voids: drop triangles that flat places do not need, and voids that this flattens."""
    budget, at_once = tolerance, AT_ONCE
    if hollow.deferred is not None:
        hollow = surfaces_by_slabs(task, hollow.deferred.fields, tolerance=FIRST * tolerance)
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


def simplify_to_fit(task: FillTask, hollow: VoidMeshes, room: int) -> VoidMeshes:
    """Simplify the voids until few enough triangles remain, even beyond the requested tolerance."""
    tolerance = max(hollow.tolerance, FINEST * hollow.space.size)
    for _ in range(DOUBLINGS):
        tolerance *= 2
        simple = simplify_voids(task, hollow, tolerance)
        if simple.triangles <= room:
            return simple
    needed = COLLAPSE_BYTES * max(len(surface.faces) for surface in simple.surfaces)
    advice = f"the voids have {hollow.triangles:,} triangles; give larger cells or voxels"
    require_memory(needed, task.max_memory, advice)
    share = room / simple.triangles
    fewest = [
        simplify_surface(surface, triangles=max(4, int(share * len(surface.faces))), threads=task.threads)
        for surface in simple.surfaces
    ]
    return replace(hollow, surfaces=tuple(fewest), tolerance=math.inf)
