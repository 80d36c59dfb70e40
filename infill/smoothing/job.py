"""`smooth_volume`, `smooth_mesh`, `smooth_points`: from a scan, a mesh or points to a smooth closed mesh.

    data  ->  solid on a grid  ->  bricks, smoothed  ->  level of the right volume  ->  closed surface

Each of the three functions lists the ways to smooth its input, the preferred one first, and `first_sound` of
`infill.smoothing.remedies` runs them until nothing is lost. The stages of a run are the same for all: see
`infill.smoothing.attempt`.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Unpack, overload

import numpy as np
from numpy.typing import ArrayLike

from infill.errors import MemoryLimitError, UsageError
from infill.formats.point_files import read_points_and_normals
from infill.formats.units import to_surface, unit_in_mm
from infill.grid import spacing_of
from infill.imaging.volume_files import read_volume
from infill.lazy.dask_arrays import is_dask
from infill.lazy.names import is_lazy
from infill.reports.sections import add_late_section
from infill.result import Result
from infill.smoothing.by_component import ComponentStages, smooth_components
from infill.smoothing.grey_isosurface import compare_with_isosurface
from infill.smoothing.kept_components import keep_in_mesh, keep_in_scan
from infill.smoothing.meshes import mesh_ways
from infill.smoothing.points import compare_with_points, points_ways
from infill.smoothing.remedies import first_sound
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.smoothing.scans import Threshold, has_grey_values, surface_value, threshold_range, volume_ways
from infill.smoothing.stages import SmoothStages
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.segmentation import fill_masked_with_void

if TYPE_CHECKING:
    import trimesh

    from infill.reports.smoothing import ComponentsReport, SmoothReport


def smooth_volume(
    volume: ArrayLike | Volume | str | os.PathLike[str],
    *,
    spacing: float | tuple[float, ...] | None = None,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    threshold: float | tuple[float | None, float | None] | Literal["otsu"] | None = None,
    label: int | Sequence[int] | None = None,
    grey: bool | None = None,
    keep_components: str | Sequence[int] | None = None,
    voxel: float | None = None,
    resume: str | os.PathLike[str] | None = None,
    **options: Unpack[SmoothOptions],
) -> Result[SmoothStages, SmoothReport]:
    """Return a smooth surface around the solid in a volume.

    Parameters
    ----------
    volume : (nx, ny, nz) array, Volume or path
        A file or folder of a volume, see `infill.read_volume`; or booleans, a mask, a phase field in [-1, 1], labels or
        grey values, [x, y, z]. Cells that a numpy.ma.MaskedArray masks are void. A Dask array, or a path of Zarr or
        HDF5, is smoothed in chunks if it does not fit into memory or `max_memory`, and always with the method "plain"
        or `resume`: see `infill.smoothing.chunked`.
    spacing : float or (hx, hy, hz), optional
        Cell size, mm, of an array, 1 by default; or of a file, instead of the one that it states.
    origin : (x, y, z)
        Lower corner of the first cell, mm; only for an array.
    threshold : float, (low, high) or "otsu", optional
        Cells are solid that have at least this value, a value in this range, or a value above the threshold of Otsu's
        method.
    label : int or sequence of int, optional
        Cells are solid that have this label, or one of these labels.
    grey : bool, optional
        Keep the grey levels around the threshold (2): they show where between two cells the surface lies. By default,
        if there are any, and the method is "auto" or "grey".
    keep_components : str or sequence of int, optional
        Only these components of the solid, counted from 1, the largest first: (1, 3), or "1,3-5" or "2-". The others
        are void before anything else is done.
    voxel : float, optional
        Larger cells than those of the volume, mm: each has the mean of the cells it covers. Smaller features are gone
        before anything is compared.
    resume : path, optional
        Of a volume in chunks: folder for finished work, from which a run that was interrupted goes on.
    smoothing : Smoothing
        By default 20 steps, which the paper uses for complex models; it uses 30 for medical data.
    method : {"auto", "plain", "refine", "grey"}
        "plain" is the paper's way, for noise. "refine" preserves edges, curvature and thin walls: see
        `infill.phasefield.refining`; smoothing takes five times as long, the whole run twice as long; specks are
        preserved too, it takes at least 4 steps, and does not use fidelity. "grey" keeps grey levels, and is refined.
        "auto" takes "grey" for values above one threshold, "refine" for labels, masks, meshes and points, and "plain"
        for noise (which is despeckled) or a fixed level.
    radius : float, optional
        Instead of steps: smooth as a Gaussian of this standard deviation would, mm.
    level : "volume" or float
        "volume" puts the surface where every component has the volume it has in the data; 0 is the paper's surface.
    despeckle : float
        Components up to this volume are removed first, mm³.
    crumbs : float, optional
        Pieces up to this volume that smoothing breaks off are removed, mm³; by default, those of up to 8 cells.
    allow_broken : bool
        Return a result in which something was lost, and say so in the report, instead of raising.
    strict : bool
        Try no remedies, and raise if anything breaks, fuses or vanishes.
    tolerance, max_triangles : float (mm) or "auto", and int, optional
        Simplify the mesh: "auto", the default, moves it by at most a tenth of a cell; 0 or None keeps all triangles.
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
        If the values do not determine the solid, or a number is out of range.
    GeometryError
        If parts thicker than two cells are lost in every way: fewer steps, finer cells for a mesh.
    MemoryLimitError
        If memory will not suffice; raised before anything is computed.

    Notes
    -----
    Source: Wang et al. 2020, sections 2.2 and 3.3. Choosing the level is this package's own addition: see
    `infill.isosurfaces.levels`.

    >>> ball = np.sum((np.indices((30, 30, 30)) - 14.5) ** 2, axis=0) < 100
    >>> result = smooth_volume(ball)
    >>> bool(abs(result.mesh.volume / ball.sum() - 1) < 1e-4)
    True
    """
    request = SmoothRequest(**options)
    if is_dask(volume) or (isinstance(volume, (str, os.PathLike)) and is_lazy(volume)):
        from infill.smoothing.chunk_plans import check_chunked, suits_chunks
        from infill.smoothing.chunked_result import open_lazy, smooth_lazy

        lazy = open_lazy(volume, spacing=spacing, origin=origin)
        if request.method != "plain" and resume is None:
            try:
                return _smooth_whole(
                    lazy.load(request.max_memory),
                    request,
                    threshold=threshold,
                    label=label,
                    grey=grey,
                    keep_components=keep_components,
                    voxel=voxel,
                )
            except MemoryLimitError:
                if not suits_chunks(request, voxel=voxel, keep_components=keep_components):
                    raise
        check_chunked(request, voxel=voxel, keep_components=keep_components)
        return smooth_lazy(lazy, request, threshold=threshold, label=label, grey=grey, resume=resume)
    if resume is not None:
        raise UsageError.about("resume", "is for a volume in chunks, a Dask array, Zarr or HDF5; leave it out")
    low, _ = threshold_range(threshold)
    chosen = threshold is not None or label is not None
    if isinstance(volume, (str, os.PathLike)):
        volume = read_volume(volume, spacing=spacing)
    elif not isinstance(volume, Volume):
        values = fill_masked_with_void(np.asanyarray(volume), low, chosen=chosen)
        volume = Volume(values=values, spacing=spacing_of(1.0 if spacing is None else spacing, 3), origin=origin)
    return _smooth_whole(
        volume, request, threshold=threshold, label=label, grey=grey, keep_components=keep_components, voxel=voxel
    )


def _smooth_whole(
    volume: Volume,
    request: SmoothRequest,
    *,
    threshold: Threshold,
    label: int | Sequence[int] | None,
    grey: bool | None,
    keep_components: str | Sequence[int] | None,
    voxel: float | None,
) -> Result[SmoothStages, SmoothReport]:
    """Smooth a volume in memory: see `smooth_volume`."""
    if keep_components is not None:
        volume, threshold = keep_in_scan(volume, keep_components, threshold=threshold, label=label)
    ways = volume_ways(volume, request, threshold=threshold, label=label, grey=grey, voxel=voxel)
    result = first_sound(ways, request)
    rule = result.report["input"]["segmentation"]
    level = rule.get("low") if rule.get("high") is None else None
    if threshold is not None and level is not None and has_grey_values(volume.values, rule["values"]):
        surface_level = surface_value(volume, rule)
        compare = partial(compare_with_isosurface, result.surface.volume, volume, surface_level, request.threads)
        add_late_section(result.report, "isosurface", compare)
    return result


@overload
def smooth_mesh(
    mesh: trimesh.Trimesh | Surface | str | os.PathLike[str],
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    keep_components: str | Sequence[int] | None = None,
    by_component: Literal[False] = False,
    **options: Unpack[SmoothOptions],
) -> Result[SmoothStages, SmoothReport]: ...
@overload
def smooth_mesh(
    mesh: trimesh.Trimesh | Surface | str | os.PathLike[str],
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    keep_components: str | Sequence[int] | None = None,
    by_component: Literal[True],
    **options: Unpack[SmoothOptions],
) -> Result[ComponentStages, ComponentsReport]: ...
def smooth_mesh(
    mesh: trimesh.Trimesh | Surface | str | os.PathLike[str],
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    keep_components: str | Sequence[int] | None = None,
    by_component: bool = False,
    **options: Unpack[SmoothOptions],
) -> Result[SmoothStages, SmoothReport] | Result[ComponentStages, ComponentsReport]:
    """Return the smooth surface of a mesh, by way of voxels.

    Parameters
    ----------
    mesh : trimesh.Trimesh or Surface, mm; or a path
        A mesh, its file, or a result of phasefill. It may be open, inside out, intersect itself, or have several
        components.
    resolution : int, optional
        Cells along the longest side; 200 if neither this nor `voxel` is given.
    voxel : float, optional
        Cell size, mm.
    keep_components : str or sequence of int, optional
        Only these components of the mesh, with their cavities, counted from 1, the largest first: (1, 3), or "1,3-5".
    by_component : bool
        Smooth each component by itself, so that those that overlap or touch stay apart: see
        `infill.smoothing.by_component`. The result then has a surface for each, "component_1" being the largest.
    **options
        See `smooth_volume`.

    >>> import trimesh
    >>> smooth_mesh(trimesh.creation.icosphere(radius=10), voxel=0.5).report["components"]
    1
    """
    surface, request = to_surface(mesh), SmoothRequest(**options)
    if keep_components is not None:
        surface = keep_in_mesh(surface, keep_components, resolution=resolution, voxel=voxel)
    if by_component:
        return smooth_components(surface, request, resolution=resolution, voxel=voxel)
    fixed = resolution is not None or voxel is not None
    ways = mesh_ways(surface, request, resolution=resolution, voxel=voxel, fixed=fixed, hint=True)
    return first_sound(ways, request)


def smooth_points(
    points: ArrayLike | str | os.PathLike[str],
    *,
    voxel: float,
    shell: float | None = None,
    normals: ArrayLike | None = None,
    **options: Unpack[SmoothOptions],
) -> Result[SmoothStages, SmoothReport]:
    """Return the smooth surface of a cloud of points.

    Parameters
    ----------
    points : (N, 3) float, mm; or a path
        Points on a surface, or their file, with normals if it has them.
    voxel : float
        Cell size, mm.
    shell : float, optional
        Width of the narrow volume around the points, mm (section 3.5 of the paper); if left out, the solid that
        the points enclose.
    normals : (N, 3) float, optional
        Across the surface, of any length, inwards or outwards. Estimated if left out, or where of no length.
    **options
        See `smooth_volume`.

    Raises
    ------
    ParameterError
        If there is not one normal for each point, or they are given for a shell. Otherwise as `smooth_volume`.
    GeometryError
        If the solid leaves out points with all their neighbours, as in a groove that is too narrow for points this far
        apart. Otherwise as `smooth_volume`.

    Notes
    -----
    The cells show the solid that the points enclose; points and normals place the surface within a cell: see
    `infill.voxels.point_fields.distance_from_points`. A shell, or `method="plain"`, smooths the cells alone.
    """
    request = SmoothRequest(**options)
    if isinstance(points, (str, os.PathLike)):
        path = Path(points)
        points, read_normals = read_points_and_normals(path)
        points = points * unit_in_mm(path, points, None)
        normals = read_normals if normals is None else normals
    cloud = np.asarray(points, dtype=np.float64)
    result = first_sound(points_ways(cloud, request, voxel=voxel, shell=shell, normals=normals), request)
    return compare_with_points(result, cloud, voxel, request) if shell is None else result
