"""The voids of a part as closed surfaces: as dense as requested, on a grid as fine as their triangles allow."""

from __future__ import annotations

from dataclasses import replace

from infill.errors import GeometryError
from infill.interior.interior import compute_interior
from infill.lattices.bodies import Fields
from infill.lattices.density_search import estimate_triangles, find_sizes, fit_density, match_width
from infill.lattices.fill_job import Job
from infill.lattices.simplifying import simplify_to_fit, simplify_voids
from infill.lattices.sizing import choose_sizes, choose_voxel, coarsest_voxel, enlarge, goes_by_slabs
from infill.lattices.void_meshes import VoidMeshes
from infill.lattices.voids import Layout

REFITS = 3
MOST_LARGER = 3.0  # most that cells and walls grow at a time, where there are too many triangles
FEWER = 1.04  # margin on the size of cells, as triangles fall with its square
FAR_TOO_MANY = 4.0  # triangles, over the room for them: more are not even made
LEAST_THICK = 1.5  # cells of the grid in the thickness of what lies inside the walls


def make_void_meshes(job: Job) -> tuple[VoidMeshes, Fields]:
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
    request, clock = job.request, job.clock
    with clock.stage("density", 0.0):
        (cell, width), varied = choose_sizes(job), request.varied
    voxel = choose_voxel(job, cell, width)
    is_last = False
    for attempt in range(REFITS + 1):
        progress, is_last = 0.2 * attempt, is_last or attempt == REFITS
        with clock.stage("depth", progress):
            space = compute_interior(
                job.part,
                wall=request.wall,
                voxel=voxel,
                open_=request.open_,
                beyond=request.beyond,
                held=request.held,
                slabs=goes_by_slabs(job),
                threads=job.threads,
                max_memory=job.max_memory,
            )
        room = request.room(len(space.part.faces))
        with clock.stage("density", progress + 0.05):
            grading = request.grading
            local = None if grading is None else grading.over(space, job.pattern.widths)
            layout = Layout(space=space, cell=cell, width=width, local=local, threads=job.threads)
            layout, varied, known = find_sizes(job, layout, varied)
            triangles, known = estimate_triangles(job, layout, known)
        if is_last or triangles <= FAR_TOO_MANY * room:
            with clock.stage("voids", progress + 0.1):
                hollow, fields = fit_density(job, layout, varied, known)
            with clock.stage("simplify", progress + 0.18):
                hollow = simplify_voids(job, hollow, request.tolerance)
            if is_last or hollow.triangles <= room:
                with clock.stage("voids", progress + 0.19):
                    hollow, fields = match_width(job, hollow, layout.width, varied, fields)
                if is_last or hollow.triangles <= room:
                    break
            triangles, layout = hollow.triangles, replace(layout, cell=hollow.cell)
        cell, width, coarser = _coarsen(job, layout, voxel, triangles / room)
        coarser = min(coarser, space.thickness / LEAST_THICK)
        is_last = coarser < 1.05 * voxel
        if is_last:
            cell, width = layout.cell, layout.width
        else:
            voxel = coarser
    if not hollow.surfaces:
        raise GeometryError(
            f"the pattern leaves no void inside walls of {request.wall:g} mm; give larger cells, narrower lines, a "
            "lower density or a thinner wall"
        )
    if hollow.triangles > room:
        with clock.stage("simplify", 0.8):
            hollow = simplify_to_fit(job, hollow, room)
    return hollow, fields


def _coarsen(job: Job, layout: Layout, voxel: float, excess: float) -> tuple[float, float, float]:
    """Return a cell, a width and a voxel that leave a fraction of the triangles, as far as limits allow."""
    request, cell, width = job.request, layout.cell, layout.width
    target, coarsest = voxel * max(1.1, FEWER * excess**0.5), coarsest_voxel(job, cell, width)
    if target > coarsest and request.cell is None and request.line_width is None:
        cell, width = enlarge(request, (cell, width), min(MOST_LARGER, max(1.2, target / coarsest)))
        coarsest = coarsest_voxel(job, cell, width)
    return cell, width, min(target, coarsest)
