"""`smooth_volume`, `smooth_mesh`, `smooth_points`: from a scan, a mesh or points to a smooth closed mesh.

    data  ->  solid on a grid  ->  bricks, smoothed  ->  level of the right volume  ->  closed surface

and a report of what smoothing did: to the volume, to components, cavities and tunnels, and to the thinnest walls.
"""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.checks import within
from infill.errors import GeometryError, ParameterError
from infill.grid import spacing_of
from infill.inspection.changes import verdict
from infill.kernels.compiling import told_of_compiling
from infill.machine import require_memory
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.profile import REFINED
from infill.result import Clock, Progress, Result
from infill.smoothing.placing import as_float, moved, placed, some, summary
from infill.surface import Surface
from infill.surfaces.capping import capped
from infill.surfaces.distance import distances
from infill.surfaces.merging import closed_or_merged, surface_of
from infill.surfaces.simplification import simplified
from infill.version import __version__
from infill.volume import Volume
from infill.voxels.from_mesh import Repairs, voxelise_reported
from infill.voxels.from_points import voxelise_points
from infill.voxels.segmentation import grey as grey_levels
from infill.voxels.segmentation import threshold as segment

if TYPE_CHECKING:
    import trimesh

    from infill.phasefield.sparse import SparseField
    from infill.surfaces.components import Components

LevelMethod = Literal["volume"] | float
MARGIN = 8  # cells of void around a mesh or points, so that the edge of the grid is not felt
BYTES_PER_SURFACE_CELL = 600  # bricks, faces, labels and mesh, for every cell at the surface
BYTES_TO_REFINE = 500  # three filtered fields and the last but one, over that
OFF = 0.01  # of the volume: what the level of the volume may miss, by specks that are gone
SIMPLER = 0.05  # of the volume: what simplifying may change
ROUGH = 0.03  # of the volume: what voxels may hold more or less than a mesh
ADVICE = "use --refine, finer voxels, fewer steps or more fidelity (or --allow-broken, to have it anyway)"
ADVICE_REFINED = "use finer voxels or fewer steps (or --allow-broken, to have it anyway)"


class Options(TypedDict, total=False):
    """What the three functions take alike; see `smooth_volume`."""

    smoothing: Smoothing
    refine: bool
    level: LevelMethod
    despeckle: float
    allow_broken: bool
    tolerance: float | None
    max_triangles: int | None
    threads: int | None
    max_memory: int | None
    progress: Progress | None


def smooth_volume(
    volume: ArrayLike | Volume,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    threshold: float | tuple[float | None, float | None] | Literal["otsu"] | None = None,
    label: int | tuple[int, ...] | None = None,
    grey: bool = False,
    **options: Unpack[Options],
) -> Result:
    """Return the smooth surface of what is solid in a volume.

    Parameters
    ----------
    volume : (nx, ny, nz) array or Volume
        Booleans, a mask, a phase field in [-1, 1], labels or grey values, [x, y, z].
    spacing : float or (hx, hy, hz)
        Cell size, mm; of an array.
    origin : (x, y, z)
        Lower corner of the first cell, mm; of an array.
    threshold : float, (low, high) or "otsu", optional
        Solid is what has at least this value, or one in this range, or lies above the threshold by Otsu's method.
    label : int or tuple of int, optional
        Solid is what has this label.
    grey : bool
        Keep the grey levels around the threshold (2): they tell where between two cells the surface lies.
    smoothing : Smoothing
        20 steps if left out, as the paper takes for complex models; 30 for medical data.
    refine : bool
        Keep edges, curvature and thin walls better: see `infill.phasefield.refining`. Smoothing takes five times as
        long, the whole twice. For clean data: specks are kept too, so despeckle. It takes 4 steps or more, and no
        fidelity.
    level : "volume" or float
        "volume" puts the surface where every component has the volume it has in the data; 0 is the paper's surface.
    despeckle : float
        Components up to this volume are taken out first, mm³.
    allow_broken : bool
        Return a result in which walls broke or components vanished, and say so in the report, instead of raising.
    tolerance, max_triangles : float (mm) and int, optional
        Simplify the mesh.
    threads, max_memory : int, optional
        Threads to work with, and bytes to use; what there is if left out.
    progress : callable, optional
        Called with the name of a stage and the share of the work done.

    Returns
    -------
    Result
        In the place of the volume in space. The report has lengths in mm.

    Raises
    ------
    ParameterError
        If the values do not tell what is solid, or a number is out of its range.
    GeometryError
        If a component or a wall more than one cell thick breaks or vanishes.
    MemoryLimitError
        Before anything is computed.

    Notes
    -----
    Source: Wang et al. 2020, sections 2.2 and 3.3. The level is this package's own: see `infill.surfaces.levels`.

    >>> ball = np.sum((np.indices((30, 30, 30)) - 14.5) ** 2, axis=0) < 100
    >>> result = smooth_volume(ball)
    >>> bool(abs(result.mesh.volume / ball.sum() - 1) < 1e-4)
    True
    """
    scan = volume if isinstance(volume, Volume) else Volume(
        values=np.asarray(volume), spacing=spacing_of(spacing, 3), origin=origin
    )  # fmt: skip
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
    return _smoothed(data, {"source": "volume", "segmentation": used, "grey": grey}, None, **options)


def smooth_mesh(
    mesh: trimesh.Trimesh | Surface,
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    **options: Unpack[Options],
) -> Result:
    """Return the smooth surface of a mesh, by way of voxels.

    Parameters
    ----------
    mesh : trimesh.Trimesh or Surface, mm
        It may be open, inside out, pass through itself, or have several components.
    resolution : int, optional
        Cells along the longest side; 200 if neither this nor `voxel` is given.
    voxel : float, optional
        Cell size, mm.
    **options
        See `smooth_volume`.

    >>> import trimesh
    >>> smooth_mesh(trimesh.creation.icosphere(radius=10), voxel=0.5).report["result"]["components"]
    1
    """
    surface = surface_of(mesh)
    solid, repairs = voxelise_reported(
        surface, voxel=voxel, resolution=resolution, margin=MARGIN, max_memory=options.get("max_memory")
    )
    source = {"source": "mesh", "repairs": asdict(repairs)}
    return _smoothed(solid, source, _closed(surface, solid, repairs), repairs=repairs, **options)


def smooth_points(points: ArrayLike, *, voxel: float, shell: float | None = None, **options: Unpack[Options]) -> Result:
    """Return the smooth surface of a cloud of points.

    Parameters
    ----------
    points : (N, 3) float, mm
        Points on a surface.
    voxel : float
        Cell size, mm.
    shell : float, optional
        Width of the narrow volume around the points, mm (section 3.5 of the paper); the solid that the points
        enclose if left out.
    **options
        See `smooth_volume`.
    """
    cloud = np.asarray(points, dtype=np.float64)
    solid = voxelise_points(cloud, voxel=voxel, shell=shell, margin=MARGIN, max_memory=options.get("max_memory"))
    return _smoothed(solid, {"source": "points", "points": len(cloud), "shell": shell}, None, **options)


@told_of_compiling("the smoother, about 15 s")
def _smoothed(
    data: Volume,
    source: dict[str, Any],
    reference: Surface | None,
    *,
    repairs: Repairs | None = None,
    smoothing: Smoothing = Smoothing(steps=20),  # noqa: B008 - frozen
    refine: bool = False,
    level: LevelMethod = "volume",
    despeckle: float = 0.0,
    allow_broken: bool = False,
    tolerance: float | None = None,
    max_triangles: int | None = None,
    threads: int | None = None,
    max_memory: int | None = None,
    progress: Progress | None = None,
) -> Result:
    """Do what the three functions have in common."""
    from infill.phasefield.refining import refine_bricks
    from infill.phasefield.sparse import smooth_bricks
    from infill.surfaces.components import components, data_bits, shell_names
    from infill.surfaces.levels import as_straightened, at_level, at_volume, counted

    if isinstance(level, str) and level != "volume":
        raise ParameterError(f"there is no level {level!r}; give volume, or a number between -1 and 1")
    clock = Clock(progress)
    size: tuple[float, ...] = tuple(float(x) for x in data.cell_size)
    values, specks = data.values, 0
    with clock.stage("smooth", 0.05):
        _require(data, max_memory, BYTES_PER_SURFACE_CELL + (BYTES_TO_REFINE if refine else 0))
        if despeckle:
            values, specks = _despeckled(data, within("despeckle", despeckle, 0, math.inf, "mm³"), threads)

        def report_step(share: float) -> None:
            if progress is not None:
                progress("smooth", 0.05 + 0.3 * share)

        smoothed = refine_bricks if refine else smooth_bricks
        field = smoothed(values, smoothing, spacing=size, threads=threads, progress=report_step)
    with clock.stage("surface", 0.4):
        by_volume, guess = level == "volume", None
        if by_volume:
            before, field, guess = counted(field, spacing=size, straighten=not refine, threads=threads)
        else:
            before = components(field, data_bits(field, threads=threads))
        targets: NDArray[np.float64] = before.cells.astype(np.float64) * data.cell_volume
        if field.data.dtype != np.int8:
            targets = _grey_volumes(field, before, size, threads)
        if by_volume:
            found = at_volume(field, before, spacing=size, targets=targets, guess=guess, threads=threads)
            found = as_straightened(found) if refine else found
        else:
            most = 0.99 if refine else 0.999
            height = within("level", float(level), -most, most)
            cut = REFINED.distance_level(height) if refine else height
            found = replace(
                at_level(field, before, spacing=size, level=cut, threads=threads),
                common=height, levels=np.full(before.count, height),
            )  # fmt: skip
        closed = found.surface.closed
        if not closed:
            raise GeometryError(f"the surface is not closed; {ADVICE}")
    with clock.stage("check", 0.6):
        report = verdict(found, before, targets, level, smoothing.steps, size, threads)
        for piece in report["lost"]:
            piece["at"] = data.place(np.array([piece["at"]]))[0].tolist()
        report["problems"] += _of_voxels(float(targets.sum()), repairs)
        if by_volume and abs(report["volume_change"]) > OFF:
            report["problems"].append(f"the volume is off by {report['volume_change']:+.1%}, which no level mends")
        if report["problems"] and not allow_broken:
            raise GeometryError(f"{'; '.join(report['problems'])}; {ADVICE_REFINED if refine else ADVICE}")
    with clock.stage("measure", 0.75):
        surface = placed(found.surface, data)
        report["distance"] = moved(surface, field, data, reference, threads)
        full = surface
        if tolerance is not None or max_triangles is not None:
            surface = replace(simplified(full, tolerance=tolerance, triangles=max_triangles), space=data.space)
            change = surface.volume / full.volume - 1
            if abs(change) > SIMPLER and not allow_broken:
                raise GeometryError(
                    f"simplifying to {len(surface.faces):,} triangles would change the volume by {change:+.0%}; "
                    "allow more triangles or give a smaller tolerance"
                )
            report["simplified"] = {
                "triangles_before": len(full.faces),
                "volume_change": change,
                "shells": shell_names(surface)[1],
                "distance": summary(distances(some(full.vertices), surface)),
            }
    closed = closed if surface is full else surface.closed
    bounds = surface.bounds
    report = {
        "version": __version__, **source, "grid": list(data.values.shape), "spacing": list(size),
        "space": data.space, "steps": smoothing.steps, "refined": refine,
        "fidelity": 0.0 if refine else smoothing.fidelity,
        "interface": smoothing.interface, "alpha": smoothing.alpha, "despeckled": specks,
        "triangles": len(surface.faces), "closed": closed, "volume": surface.volume, "area": surface.area,
        "extents": (bounds[1] - bounds[0]).tolist(), "bounds": bounds.tolist(), **report,
    }  # fmt: skip
    report["seconds"] = {**clock.seconds, "total": sum(clock.seconds.values())}
    return Result(
        surface=surface,
        report=report,
        fields={"levelled": found, "data": replace(data, values=values)},
    )


def _of_voxels(total: float, repairs: Repairs | None) -> list[str]:
    """Say whether the voxels hold much more or less than the mesh they stand for."""
    if repairs is None or repairs.volume == 0:
        return []
    off = total / repairs.volume - 1
    if off > ROUGH or (off < -ROUGH and repairs.components == 1):  # components that overlap are united
        word = "more" if off > 0 else "less"
        return [f"the voxels hold {abs(off):.0%} {word} than the mesh, whose walls are thin for them"]
    return []


def _closed(mesh: Surface, solid: Volume, repairs: Repairs) -> Surface:
    """Return a mesh with its holes capped as for the voxels."""
    if not repairs.holes:
        return mesh
    size, origin = solid.cell_size, np.array(solid.origin)
    whole = closed_or_merged(mesh.vertices, mesh.faces)
    vertices, faces, _ = capped((whole.vertices - origin) / size - 0.5, whole.faces)
    return Surface(vertices=(vertices + 0.5) * size + origin, faces=faces)


def _require(data: Volume, limit: int | None, each: int) -> None:
    """Raise MemoryLimitError if the surface will not fit into memory, at `each` bytes a cell, guessed from layers."""
    values: NDArray[Any] = data.values
    steps = max(1, values.shape[0] // 16)
    layers = values[::steps] > 0
    crossings = sum(int(np.count_nonzero(np.diff(layers, axis=axis))) for axis in (1, 2)) * steps * 1.5
    require_memory(int(crossings * each), limit, "use larger voxels, a part of the volume, or despeckle it")


def _despeckled(data: Volume, largest: float, threads: int | None) -> tuple[NDArray[Any], int]:
    """Return the data without components up to a volume, mm³, and how many those were."""
    from infill.phasefield.sparse import smooth_bricks
    from infill.surfaces.components import components, data_bits, without

    field = smooth_bricks(data.values, Smoothing(steps=0), threads=threads)
    every = components(field, data_bits(field, threads=threads))
    small = every.cells * data.cell_volume <= largest
    if small.all():
        raise ParameterError(
            f"despeckle is {largest:g} mm³ and the largest component has {every.cells.max() * data.cell_volume:g} mm³; "
            "give less"
        )
    return (without(data.values, field, every, small), int(small.sum())) if small.any() else (data.values, 0)


def _grey_volumes(
    field: SparseField, data: Components, size: tuple[float, ...], threads: int | None
) -> NDArray[np.float64]:
    """Return the volume of each component of grey data as its surface at level 0 encloses it, mm³."""
    from infill.surfaces.levels import volumes_of

    volume = volumes_of(replace(field, values=as_float(field)), data, spacing=size, threads=threads)
    return np.where(volume > 0, volume, data.cells * math.prod(size))
