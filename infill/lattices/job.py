"""`fill`: a part and its infill as one solid.

    depth below the wall, distance into the void  ->  the lesser  ->  smoothing  ->  surfaces, taken out of the part

The skin of the part is not computed: the triangles of the result are the part's own, and those of the voids, which lie
inside of it and apart from one another.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from infill.errors import UsageError
from infill.formats.units import to_surface
from infill.interior.interior import Interior
from infill.interior.opening import clip_to_opening, cut_open
from infill.lattices.at_skin import drop_crumbs, subtract_voids
from infill.lattices.bodies import Fields
from infill.lattices.density_map import DensityMap
from infill.lattices.drain_holes import DrainedSolid, check_drain_width, drill_drains
from infill.lattices.groups import Graded, Meshing, Shell, add_grading, add_group
from infill.lattices.joining import make_joined_voids
from infill.lattices.modifiers import add_modifiers
from infill.lattices.projected import ProjectInfill, make_project_infill
from infill.lattices.quality_checks import SolidMeasures, find_problems, measure_solid
from infill.lattices.regions import Region
from infill.lattices.request import TOLERANCE, FillSpec, check_request
from infill.lattices.settings import parse_slicers
from infill.lattices.stages import FillStages
from infill.lattices.surfacing import SHARE, extract_inner_side
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.flat_triangles import flip_flat_triangles
from infill.meshes.measuring import measure_surface
from infill.meshes.split_components import concatenate_surfaces
from infill.reports.common import report_head, surface_keys
from infill.reports.filling import FillSeconds
from infill.result import Clock, Progress, Result
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh

    from infill.reports.filling import FillReport, UntimedFillReport


def fill(
    part: Surface | trimesh.Trimesh | str | os.PathLike[str],
    pattern: object = "gyroid",
    *,
    density: float | tuple[float, float] | Graded | None = None,
    by: object = None,
    grade: str | None = None,
    regions: Sequence[Region | str] = (),
    cell: float | None = None,
    line_width: float | None = None,
    wall: float | None = None,
    as_: str = "solid",
    for_: str | None = None,
    align: str = "part",
    angle: float = 0.0,
    phase: tuple[float, ...] = (0.0, 0.0, 0.0),
    drain: float | None = None,
    vent: bool = False,
    drain_at: Sequence[Sequence[float]] = (),
    open_: str | None = None,
    ties: bool = True,
    smooth_radius: float | None = None,
    overlap: float | None = None,
    tolerance: float = TOLERANCE,
    max_triangles: int | None = None,
    resolution: int | None = None,
    voxel: float | None = None,
    shell: Shell | None = None,
    meshing: Meshing | None = None,
    threads: int | None = None,
    max_memory: int | None = None,
    progress: Progress | None = None,
    **parameters: Any,  # noqa: ANN401 - whatever the pattern takes
) -> Result[FillStages, FillReport]:
    """Fill a part: return its shell and infill as one closed mesh, with the skin of the part unchanged.

    Parameters
    ----------
    part : Surface or trimesh.Trimesh, mm; or a path
        A mesh, its file, or a result of phasefill. Closed; holes in it are closed first, and the report says so.
    pattern : str, Path, Pattern, Cells or callable
        A name in `patterns.PATTERNS`; a drawing, which is repeated; "module.py:name"; a pattern itself, such as
        `patterns.Gyroid(cell=6)`, which has that cell; or a function of x, y and z, of one shape, in radians (2 pi is
        a cell): walls are where it is 0.
    density : float, (float, float) or Graded, optional
        Solid share of the space inside the walls, 0.01 to 0.9. Two of density, cell and line width determine the third.
        By default 0.2 and a line width of 0.45 mm (0.9 in a project), or for bars, 0.2 and a cell of 8 mm (in a
        project, a diameter of 2.7 mm). Two densities hold where `by` is lowest and where it is highest.
    by : str, Path, array or callable, optional
        The field that the density follows: "x", "y", "z" (the default) or "skin", the depth below the walls; a .csv of
        x, y, z and a value; results of a simulation (.vtu or .frd, and one of their arrays as in "part.frd:SXX"); a
        .npy of three axes, or a picture seen from above, over the box around the part; "module.py:name"; or such an
        array, or a function of points (N, 3), mm, that returns (N,).
    grade : {"width", "cell"}, optional
        How the density rises: by wider walls in cells of one size, the default; or by smaller cells with walls of one
        width, for walls along a surface. Cells are whole everywhere, flatter or longer where they must be; where they
        cannot follow in a flat part, widths do, and the report says so.
    regions : sequence of Region or str, optional
        Other densities, patterns and walls in ranges of heights, boxes and meshes: `Region(density=0.4, z=(10, 20))`,
        or "z=10..20:density=40%,pattern=grid,wall=2". Where regions overlap, the last one with a setting counts for
        it. With another density alone, walls are wider or narrower there, and change within a few cells of the grid;
        with another pattern, both end at the border, where they cross; another wall is a step in the shell.
    cell : float, optional
        Period of the pattern, mm.
    line_width : float, optional
        Width of walls inside, or diameter of bars, mm.
    wall : float, optional
        Thickness of the shell, mm: 1.2 by default, and 0 for none, so that the infill ends at the skin. In a project,
        that of the slicer's perimeters: 0.9 by default.
    as_ : {"solid", "infill", "project"}
        Shell and infill as one; the infill alone, which reaches `overlap` into the shell; or the part and the infill as
        two surfaces for a slicer, which makes the shell itself: the infill goes on to the skin.
    for_ : {"prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"}, optional
        The slicer that `save_project` writes the project for; implies ``as_="project"``.
    align : {"part", "bed", "body"}
        Where the pattern begins: in the middle of the part, at x = y = 0 on the bottom of the part, or in the middle
        of each of its components.
    angle : float
        Turns the pattern counter-clockwise about z, degrees.
    phase : (x, y) or (x, y, z)
        Shifts the pattern, mm. In a project without a phase, a pattern of which slicers would print little is shifted.
    drain : float, optional
        Diameter of a hole straight down from the lowest place of every void, mm; by default there are no holes. A hole
        keeps a wall from all skin except the face that it leaves through: for that it moves inwards, or the void is
        joined to one that is drained. Voids that are open need no hole.
    vent : bool
        Whether every void also gets such a hole straight up from its highest place, so that air comes in.
    drain_at : sequence of (x, y, z), mm
        Places on the skin for holes straight in; the voids that these reach need no other drain.
    open_ : {"top", "bottom", "both"}, optional
        Where the shell is left out: the voids go through the flat side at the very top or bottom of the part, or both.
    ties : bool
        Where neither floor nor roof holds upright walls (`open_` both, or a wall of 0), tie islands of them to the
        nearest wall or line by bars as wide as the lines.
    smooth_radius : float, optional
        Least radius of the fillets where walls meet at right angles, mm: 0.25 by default, 0 for no fillets.
    overlap : float, optional
        mm; 0.15 by default, and at most half the wall.
    tolerance : float
        How far simplifying may move the surfaces of voids, mm; 0 keeps every triangle.
    max_triangles : int, optional
        The voids are simplified until this many remain, the part's own included.
    resolution : int, optional
        Cells of the grid along the longest side of the part; instead of `voxel`.
    voxel : float, optional
        Cell of the grid on which voids are computed, mm.
    shell, meshing : Shell and Meshing, optional
        Keywords above in groups: `wall` to `open`, and `tolerance` to `voxel`.
    threads, max_memory, progress
        As in `infill.smooth_mesh`.
    **parameters
        Further parameters of the pattern.

    Returns
    -------
    Result
        With the surface "solid" or "infill"; in a project, "part" and "infill".

    Raises
    ------
    ParameterError, patterns.PatternError
        If a number is out of range, or the pattern is unknown.
    GeometryError
        If the part encloses nothing, has no room inside its walls, has no flat side to be open at, cannot be filled to
        this density, is too narrow for the drains, cannot have one at a requested place, or has nothing in a region.
    MemoryLimitError
        If memory will not suffice; raised before anything is computed.

    Notes
    -----
    The field of a void is min(distance into the void, depth below the skin - wall), smoothed by the equation of Wang et
    al. 2020, whose motion by curvature makes the fillets; the density is that of the finished mesh.

    >>> import trimesh
    >>> box = trimesh.creation.box((20, 20, 20))
    >>> result = fill(box, "gyroid", density=0.3, wall=1, voxel=0.5)
    >>> result.surface.closed, abs(result.report["density"] - 0.3) < 0.005
    (True, True)
    """
    keywords: dict[str, Any] = {
        "density": density,
        "by": by,
        "grade": grade,
        "regions": regions,
        "cell": cell,
        "line_width": line_width,
        "wall": wall,
        "overlap": overlap,
        "angle": angle,
        "phase": phase,
        "align": align,
        "form": as_,
        "drain": drain,
        "vent": vent,
        "drain_at": drain_at,
        "open_": open_,
        "ties": ties,
        "smooth_radius": smooth_radius,
        "tolerance": tolerance,
        "resolution": resolution,
        "voxel": voxel,
        "max_triangles": max_triangles,
    }
    if isinstance(density, Graded):
        keywords = add_grading(keywords, density)
    if shell is not None:
        keywords = add_group(keywords, "shell", shell)
    if meshing is not None:
        keywords = add_group(keywords, "meshing", meshing)
    slicer = None
    if for_ is not None:
        (slicer,) = parse_slicers("for", for_)
        if as_ not in ("solid", "project"):
            raise UsageError.about("for", f"is {slicer!r}, which makes a project, and as is {as_!r}; leave one out")
        keywords["form"] = "project"
    request = check_request(pattern=pattern, own=parameters, **keywords)
    result = fill_request(to_surface(part), request, threads=threads, max_memory=max_memory, progress=progress)
    return result if slicer is None else replace(result, stages=replace(result.stages, slicer=slicer))


def fill_request(
    part: Surface,
    request: FillSpec,
    *,
    threads: int | None = None,
    max_memory: int | None = None,
    progress: Progress | None = None,
) -> Result[FillStages, FillReport]:
    """Fill a part as a request says: see `fill`."""
    part, request = add_modifiers(part, request)
    check_drain_width(request, part.bounds)
    task = FillTask.of(part, request, clock=Clock(progress), threads=threads, max_memory=max_memory)
    project = make_project_infill(task) if request.form == "project" else None
    hollow, fields = make_joined_voids(task) if project is None else (project.hollow, None)
    with task.clock.stage("check", 0.9):
        result, untimed, hollow = _assemble(task, hollow, fields, project)
    report: FillReport = {**untimed, "seconds": task.clock.timings(FillSeconds, shift=0.0)}
    stages = FillStages(
        part=hollow.space.part,
        voids=hollow.surface,
        shown=result,
        opening=hollow.space.opening,
        density=DensityMap.of(hollow.layout),
    )
    surfaces: dict[str, Surface] = (
        {"part": hollow.space.part, "infill": result} if request.form == "project" else {request.form: result}
    )
    return Result(surfaces=surfaces, report=report, stages=stages)


def _assemble(
    task: FillTask, hollow: VoidMeshes, fields: Fields | None, project: ProjectInfill | None
) -> tuple[Surface, UntimedFillReport, VoidMeshes]:
    """Return the requested surface, the report, and the voids, with counts of the pieces that were left out."""
    request, space = task.request, hollow.space
    if project is not None:
        solid = outer = project.infill
    elif request.wall == 0:
        outer = space.part
        solid, pieces, loose = drop_crumbs(task, subtract_voids(task, hollow), hollow)
        hollow = replace(hollow, islands=hollow.islands + pieces, loose=loose)
    else:
        outer = space.part if request.form == "solid" else _inner_surface(task, space)
        if space.opening is None:
            solid = concatenate_surfaces(
                [outer, *(replace(surface, faces=surface.faces[:, ::-1]) for surface in hollow.surfaces)]
            )
        else:
            solid, pieces, loose = cut_open(
                outer, hollow.surfaces, space.opening, space.size, keep_loose=request.is_block, threads=task.threads
            )
            if request.is_block:
                solid, pieces, loose = drop_crumbs(task, solid, hollow)
            hollow = replace(hollow, islands=hollow.islands + pieces, loose=loose)
    drained = drill_drains(task, solid, hollow)
    if drained.pieces:
        hollow = replace(hollow, islands=hollow.islands + drained.pieces)
    solid = measure_surface(flip_flat_triangles(drained.solid, unless_in=outer), threads=task.threads)
    facts = measure_solid(task, solid, outer, hollow, fields, drained)
    return solid, _fill_report(task.part, solid, hollow, request, facts, drained, project), hollow


def _fill_report(
    part: Surface,
    solid: Surface,
    hollow: VoidMeshes,
    request: FillSpec,
    facts: SolidMeasures,
    drained: DrainedSolid,
    project: ProjectInfill | None,
) -> UntimedFillReport:
    """Return the report without the seconds."""
    space = hollow.space
    narrow = None if project is None else project.narrow
    return {
        **report_head("fill"),
        **surface_keys(solid),
        "volume": solid.volume,
        "density": hollow.density,
        "problems": list(find_problems(request, hollow, facts, drained, narrow)),
        "request": request.facts(),
        "grid": {
            "shape": list(space.shape),
            "spacing": [space.size] * 3,
            "origin": (space.origin - space.size / 2).tolist(),
            "space": "",
        },
        "mesh": {
            "vertices": len(solid.vertices),
            "manifold": facts.verdict,
            "skin": space.skin,
            "tolerance": hollow.tolerance if math.isfinite(hollow.tolerance) else None,
        },
        "infill": {
            "cell": hollow.cell,
            "line_width": facts.width,
            "radius": request.radius(space.thickness),
            "cells": facts.cells,
            "widths": facts.widths,
            "phase": list(request.phase if project is None else project.phase),
            "narrow": None if narrow is None else narrow.all,
            "left_out": hollow.loose,
            "ties": hollow.ties.facts(),
            "untied": hollow.ties.loose,
        },
        "graded": facts.graded,
        "regions": facts.regions,
        "part": {
            "triangles": len(part.faces),
            "volume": space.repairs.volume,
            "inside": space.volume,
            "components": space.repairs.components,
            "turned": space.repairs.turned,
            "holes": space.repairs.holes,
            "notes": list(part.notes),
        },
        "voids": {
            "count": hollow.count,
            "open": hollow.open,
            "volume": hollow.volume,
            "triangles": hollow.triangles,
            "specks": hollow.specks,
            "islands": hollow.islands,
            "loose": facts.loose,
            "closed": [{"volume": volume, "at": place} for volume, place in facts.closed],
        },
        "drains": drained.facts(),
        "walls": {"requested": request.wall, "least": facts.least, "at": facts.at},
    }


def _inner_surface(task: FillTask, space: Interior) -> Surface:
    """Return the surface of the space inside the walls, extended into them by the overlap."""
    overlap = task.request.overlap
    tolerance = min(SHARE * task.request.tolerance, overlap / 2)
    inner = extract_inner_side(space, overlap=overlap, tolerance=tolerance, threads=task.threads)
    return inner if space.opening is None else clip_to_opening(inner, space.opening, space.size)
