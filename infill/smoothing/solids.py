"""`smooth_volume`, `smooth_mesh`, `smooth_points`: from a scan, a mesh or points to a smooth closed mesh.

    data  ->  solid on a grid  ->  bricks, smoothed  ->  level of the right volume  ->  closed surface

Each of the three functions finds what is solid in its own way. The rest is the same, five stages in `_smooth`:

    cleaned     the data without specks
    smoothed    the field in bricks
    levelled    the surface at the level at which every component has its volume
    judged      what smoothing did to components, cavities, tunnels and walls, and which of it is a problem
    delivered   the surface in its place, simplified if requested, and how far it lies from the data
"""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np
from numpy.typing import ArrayLike

from infill.errors import GeometryError, ParameterError
from infill.grid import spacing_of
from infill.inspection.bricks import Verdict, verdict
from infill.inspection.thickness import thinnest_walls
from infill.kernels.compiling import told_of_compiling
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import smooth_bricks
from infill.report import report_of
from infill.result import Clock, Result
from infill.smoothing.cleaning import cleaned, require_room
from infill.smoothing.levelling import Surfaced, levelled
from infill.smoothing.placing import lightened, moved, placed
from infill.smoothing.request import Given, Options, Request
from infill.smoothing.stages import SmoothStages
from infill.surface import Surface
from infill.surfaces.merging import surface_of
from infill.volume import Volume
from infill.voxels.from_mesh import voxelise_reported
from infill.voxels.from_points import voxelise_points
from infill.voxels.segmentation import grey as grey_levels
from infill.voxels.segmentation import threshold as segment

if TYPE_CHECKING:
    import trimesh

    from infill.phasefield.sparse import SparseField

MARGIN = 8  # cells of void around a mesh or points, so that the edge of the grid has no effect
OFF = 0.01  # of the volume: how far the volume may be off, because of specks that are gone
ROUGH = 0.03  # of the volume: how much more or less than a mesh its voxels may hold
ADVICE = "use --refine, finer voxels, fewer steps or more fidelity (or --allow-broken, to have it anyway)"
ADVICE_REFINED = "use finer voxels or fewer steps (or --allow-broken, to have it anyway)"


def smooth_volume(
    volume: ArrayLike | Volume,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    threshold: float | tuple[float | None, float | None] | Literal["otsu"] | None = None,
    label: int | tuple[int, ...] | None = None,
    grey: bool = False,
    **options: Unpack[Options],
) -> Result[SmoothStages]:
    """Return a smooth surface around what is solid in a volume.

    Parameters
    ----------
    volume : (nx, ny, nz) array or Volume
        Booleans, a mask, a phase field in [-1, 1], labels or grey values, [x, y, z].
    spacing : float or (hx, hy, hz)
        Cell size, mm; only for an array.
    origin : (x, y, z)
        Lower corner of the first cell, mm; only for an array.
    threshold : float, (low, high) or "otsu", optional
        Solid is what has at least this value, has a value in this range, or lies above the threshold that Otsu's
        method finds.
    label : int or tuple of int, optional
        Solid is what has this label, or one of these labels.
    grey : bool
        Keep the grey levels around the threshold (2): they show where between two cells the surface lies.
    smoothing : Smoothing
        By default 20 steps, which the paper uses for complex models; it uses 30 for medical data.
    refine : bool
        Preserve edges, curvature and thin walls better: see `infill.phasefield.refining`. Smoothing takes five times
        as long, the whole run twice as long. Meant for clean data: specks are preserved too, so despeckle. Requires at
        least 4 steps, and does not use fidelity.
    level : "volume" or float
        "volume" puts the surface where every component has the volume it has in the data; 0 is the paper's surface.
    despeckle : float
        Components up to this volume are removed first, mm³.
    allow_broken : bool
        Return a result in which walls broke or components vanished, and say so in the report, instead of raising.
    tolerance, max_triangles : float (mm) and int, optional
        Simplify the mesh.
    threads, max_memory : int, optional
        Threads and bytes to use; by default, all that are available.
    progress : callable, optional
        Called with the name of a stage and the share of the work done.

    Returns
    -------
    Result
        Placed in space where the volume lies. The report gives lengths in mm.

    Raises
    ------
    ParameterError
        If the values do not show what is solid, or a number is out of range.
    GeometryError
        If a component or a wall more than one cell thick breaks or vanishes.
    MemoryLimitError
        If memory will not suffice; raised before anything is computed.

    Notes
    -----
    Source: Wang et al. 2020, sections 2.2 and 3.3. Choosing the level is this package's own addition: see
    `infill.surfaces.levels`.

    >>> ball = np.sum((np.indices((30, 30, 30)) - 14.5) ** 2, axis=0) < 100
    >>> result = smooth_volume(ball)
    >>> bool(abs(result.mesh.volume / ball.sum() - 1) < 1e-4)
    True
    """
    scan = volume if isinstance(volume, Volume) else _volume(volume, spacing, origin)
    low, high = threshold if isinstance(threshold, tuple) else (threshold, None)
    otsu = isinstance(low, str)
    if otsu and low != "otsu":
        raise ParameterError(f"there is no threshold {low!r}; give a number, two for a range, or otsu")
    number = None if otsu or low is None else float(low)
    solid, used = segment(scan, low=number, high=high, label=label, otsu=otsu)
    data: Volume = solid
    if grey:
        level = used.get("low")
        if level is None or high is not None:
            raise ParameterError("grey levels are kept around one threshold; give one, or otsu")
        data = grey_levels(scan, level)
    elif used["method"] == "phase":
        data = scan
    facts = {"source": "volume", "segmentation": used, "grey": grey}
    return _smooth(Given(data=data, facts=facts), Request(**options))


def _volume(values: ArrayLike, spacing: float | tuple[float, ...], origin: tuple[float, ...]) -> Volume:
    return Volume(values=np.asarray(values), spacing=spacing_of(spacing, 3), origin=origin)


def smooth_mesh(
    mesh: trimesh.Trimesh | Surface,
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    **options: Unpack[Options],
) -> Result[SmoothStages]:
    """Return the smooth surface of a mesh, by way of voxels.

    Parameters
    ----------
    mesh : trimesh.Trimesh or Surface, mm
        It may be open, inside out, intersect itself, or have several components.
    resolution : int, optional
        Cells along the longest side; 200 if neither this nor `voxel` is given.
    voxel : float, optional
        Cell size, mm.
    **options
        See `smooth_volume`.

    >>> import trimesh
    >>> smooth_mesh(trimesh.creation.icosphere(radius=10), voxel=0.5).report["components"]
    1
    """
    surface = surface_of(mesh)
    found = voxelise_reported(
        surface, voxel=voxel, resolution=resolution, margin=MARGIN, max_memory=options.get("max_memory")
    )
    given = Given(
        data=found.volume,
        facts={"source": "mesh", "repairs": asdict(found.repairs)},
        reference=found.closed,
        volume=found.repairs.volume,
        overlapping=found.repairs.components > 1,
    )
    return _smooth(given, Request(**options))


def smooth_points(
    points: ArrayLike, *, voxel: float, shell: float | None = None, **options: Unpack[Options]
) -> Result[SmoothStages]:
    """Return the smooth surface of a cloud of points.

    Parameters
    ----------
    points : (N, 3) float, mm
        Points on a surface.
    voxel : float
        Cell size, mm.
    shell : float, optional
        Width of the narrow volume around the points, mm (section 3.5 of the paper); if left out, the solid that
        the points enclose.
    **options
        See `smooth_volume`.
    """
    cloud = np.asarray(points, dtype=np.float64)
    solid = voxelise_points(
        cloud,
        voxel=voxel,
        shell=shell,
        margin=MARGIN,
        max_memory=options.get("max_memory"),
        threads=options.get("threads"),
    )
    facts = {"source": "points", "points": len(cloud), "shell": shell}
    return _smooth(Given(data=solid, facts=facts), Request(**options))


@told_of_compiling("the smoother")
def _smooth(given: Given, request: Request) -> Result[SmoothStages]:
    """Run the five stages, which all three functions have in common."""
    clock = Clock(request.progress)
    with clock.stage("smooth", 0.05):
        require_room(given.data, request)
        data, specks = cleaned(given.data, request)
        field = _smoothed(data, request, clock)
    spacing = tuple(data.cell_size.tolist())
    with clock.stage("surface", 0.4):
        surfaced = levelled(field, request, spacing=spacing)
        if not surfaced.found.surface.closed:
            raise GeometryError(f"the surface is not closed; {ADVICE}")
    with clock.stage("check", 0.6):
        judged, problems = _judged(surfaced, given, request, spacing=spacing)
    with clock.stage("measure", 0.75):
        full = placed(surfaced.found.surface, data)
        distance = moved(full, field, data, given.reference, request.threads)
        surface, simplified = lightened(full, request)
        walls = _walls(judged, surfaced, data, spacing=spacing)
    report = report_of(
        product="smooth",
        surface=surface,
        request=request.facts(),
        grid={
            "shape": list(data.values.shape),
            "spacing": list(spacing),
            "origin": list(data.origin),
            "space": data.space,
        },
        solid={"data": float(surfaced.targets.sum()), "level": _level(surfaced, request)},
        data=judged.data,
        result=judged.result,
        changes=judged.changes,
        walls=walls,
        problems=problems,
        seconds=clock.seconds,
        simplified=simplified,
        input={**given.facts, "despeckled": specks},
        distance=distance,
    )
    stages = SmoothStages(data=data, levelled=surfaced.found)
    return Result(surfaces={"solid": surface}, report=report, stages=stages)


def _smoothed(data: Volume, request: Request, clock: Clock) -> SparseField:
    """Return the field in bricks: the second stage."""
    method = refine_bricks if request.refine else smooth_bricks
    return method(
        data.values,
        request.smoothing,
        spacing=tuple(data.cell_size.tolist()),
        threads=request.threads,
        progress=lambda share: clock.tell("smooth", 0.05 + 0.3 * share),
    )


def _judged(
    surfaced: Surfaced, given: Given, request: Request, *, spacing: tuple[float, ...]
) -> tuple[Verdict, list[str]]:
    """Return what smoothing did, and which of it is a problem: the fourth stage.

    Raises
    ------
    GeometryError
        If there is a problem, unless broken results are allowed.
    """
    found = verdict(
        surfaced.found,
        surfaced.before,
        spacing=spacing,
        blur=request.smoothing.blur,
        levels=surfaced.levels,
        threads=request.threads,
    )
    total = float(surfaced.targets.sum())
    problems = [*found.problems, *_of_voxels(total, given)]
    off = surfaced.volume / total - 1
    if request.level == "volume" and abs(off) > OFF:
        problems.append(f"the volume is off by {off:+.1%}, which no level can correct")
    if problems and not request.allow_broken:
        raise GeometryError(f"{'; '.join(problems)}; {ADVICE_REFINED if request.refine else ADVICE}")
    return found, problems


def _of_voxels(total: float, given: Given) -> list[str]:
    """Report whether the voxels hold much more or less than the mesh they represent."""
    if not given.volume:
        return []
    off = total / given.volume - 1
    if off > ROUGH or (off < -ROUGH and not given.overlapping):  # overlapping components are united
        word = "more" if off > 0 else "less"
        return [f"the voxels hold {abs(off):.0%} {word} than the mesh, whose walls are thin for them"]
    return []


def _level(surfaced: Surfaced, request: Request) -> dict[str, Any]:
    """Return the levels of phi at which the surface lies, for the report."""
    return {
        "method": "volume" if request.level == "volume" else "fixed",
        "common": surfaced.common,
        "lowest": float(surfaced.levels.min()),
        "highest": float(surfaced.levels.max()),
        "components": len(surfaced.levels),
    }


def _walls(judged: Verdict, surfaced: Surfaced, data: Volume, *, spacing: tuple[float, ...]) -> dict[str, Any]:
    """Return how thin the walls are, and which were lost, for the report."""
    found = surfaced.found
    before, after = thinnest_walls(found.against, found.surface, spacing, found.height)
    lost = [{"voxels": each.voxels, "at": data.place(each.at[None])[0].tolist()} for each in judged.lost]
    return {"thinnest": {"data": before, "result": after}, "lost": lost}
