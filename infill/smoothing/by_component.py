"""Smooth every component of a mesh by itself: components that overlap or touch in the file stay apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from infill.errors import GeometryError, InfillError, ParameterError
from infill.inspection.deviation import Word
from infill.meshes.split_components import split_components
from infill.reports.common import report_head
from infill.reports.smoothing import ComponentSeconds
from infill.result import Clock, Result, share_progress
from infill.smoothing.meshes import mesh_ways
from infill.smoothing.remedies import first_sound
from infill.smoothing.request import SmoothRequest
from infill.surface import Surface
from infill.voxels.from_mesh import voxel_size

if TYPE_CHECKING:
    from PIL import Image

    from infill.reports.smoothing import ComponentsReport, SmoothReport

FEWEST_ACROSS = 8  # voxels along a component: a shorter one gets finer voxels unless their size is requested
SMALL = 100  # voxels along a component: one thread does it before others have begun
WORDS: tuple[str, ...] = get_args(Word)


@dataclass(frozen=True, kw_only=True, eq=False)
class ComponentStages:
    """The stages of `infill.smooth_mesh` with `by_component`.

    Parameters
    ----------
    given : Surface
        The input mesh, mm.
    voxel : float
        Size of the voxels, mm.
    components : mapping of str to Surface
        The part of the mesh that each surface, by its name, was made from, mm.
    failed : mapping of str to str
        Why a component has no surface, by its name.
    """

    given: Surface
    voxel: float
    components: Mapping[str, Surface]
    failed: Mapping[str, str] = field(default_factory=dict)

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return the mesh and its components, smoothed one by one."""
        from infill.pictures.before_and_after import draw_before_and_after

        before = f"given: {len(self.given.faces):,} triangles"
        after = f"smoothed: {len(report['components'])} components, {report['triangles']:,} triangles"
        return draw_before_and_after(self.given, surface, cell=self.voxel, report=report, captions=(before, after))


def smooth_components(
    surface: Surface, request: SmoothRequest, *, resolution: int | None = None, voxel: float | None = None
) -> Result[ComponentStages, ComponentsReport]:
    """Smooth every component of a mesh; return one surface for each.

    Parameters
    ----------
    surface : Surface, mm
    request : SmoothRequest
    resolution : int, optional
        Cells along the longest side of the whole mesh; 200 if neither this nor `voxel` is given.
    voxel : float, optional
        Cell size, mm.

    Returns
    -------
    Result
        A surface for each component, "component_1" the largest. docs/report.md lists the keys of the report.

    Raises
    ------
    GeometryError
        If part of a component is lost, with its name, or if no component encloses anything.
    ParameterError, MemoryLimitError
        As `infill.smooth_mesh`, with the name of the component.

    Notes
    -----
    A cavity belongs to the component around it: see `infill.meshes.split_components`. All components are smoothed with
    voxels of one size. If none is requested, those that are less than 8 voxels long get finer ones, and so do
    those that would lose something. If broken results are allowed, a component that cannot be smoothed is left
    out, and the report says so.
    """
    fixed = resolution is not None or voxel is not None
    corners = surface.vertices[np.unique(surface.faces)]
    longest = float(np.ptp(corners, axis=0).max()) if len(corners) else 0.0
    if not longest > 0:
        raise GeometryError("all corners of the mesh are one point, so nothing is inside; give a closed mesh")
    size = voxel_size(longest, voxel=voxel, resolution=resolution)
    clock = Clock(request.progress)
    with clock.stage("components", 0.0):
        parts = split_components(surface, size)
    if not parts.surfaces:
        raise GeometryError(
            f"none of the {parts.sheets} components of the mesh encloses anything (loose triangles or flat sheets); "
            "give a closed mesh"
        )
    named = {f"component_{number}": part for number, part in enumerate(parts.surfaces, start=1)}
    surfaces: dict[str, Surface] = {}
    reports: dict[str, SmoothReport] = {}
    failed: dict[str, str] = {}
    listeners = share_progress(request.progress, [len(part.faces) for part in parts.surfaces])
    with clock.stage("smooth", 0.0):
        for (name, part), progress in zip(named.items(), listeners, strict=True):
            longest = float(np.ptp(part.bounds, axis=0).max())
            part_voxel = size if fixed else min(size, longest / FEWEST_ACROSS)
            threads = 1 if longest < SMALL * part_voxel else request.threads
            component_request = replace(request, progress=progress, threads=threads)
            try:
                ways = mesh_ways(part, component_request, voxel=part_voxel, fixed=fixed)
                result = first_sound(ways, component_request)
            except (GeometryError, ParameterError) as error:
                if not request.allow_broken:
                    raise error.within(name) from error
                failed[name] = str(error)
                continue
            except InfillError as error:
                raise error.within(name) from error
            surfaces[name] = result.surface
            # A complete copy: measuring later would keep the field of every component in memory.
            reports[name] = result.report.copy()
    if not surfaces:
        raise GeometryError(f"no component can be smoothed; component_1: {failed['component_1']}")
    return Result(
        surfaces=surfaces,
        report=_report(request, surfaces, reports, failed, parts.sheets, surface.notes, clock),
        stages=ComponentStages(given=surface, voxel=size, components=named, failed=failed),
        joins=True,
    )


def _report(
    request: SmoothRequest,
    surfaces: Mapping[str, Surface],
    reports: Mapping[str, SmoothReport],
    failed: Mapping[str, str],
    sheets: int,
    notes: Sequence[str],
    clock: Clock,
) -> ComponentsReport:
    """Return the report: totals over all components, and the report of each."""
    component_reports = list(reports.values())
    corners = np.array([surface.bounds for surface in surfaces.values()])
    volume, data = (
        sum(part["volume"] for part in component_reports),
        sum(part["solid"]["data"] for part in component_reports),
    )
    words = [part["verdict"]["word"] for part in component_reports] + ["lost"] * bool(failed)
    return {
        **report_head("components"),
        "triangles": sum(part["triangles"] for part in component_reports),
        "closed": all(part["closed"] for part in component_reports),
        "extents": (corners[:, 1].max(axis=0) - corners[:, 0].min(axis=0)).tolist(),
        "volume": volume,
        "volume_change": volume / data - 1,
        "problems": [f"{name}: {problem}" for name, report in reports.items() for problem in report["problems"]],
        "verdict": {"word": max(words, key=WORDS.index)},
        "request": request.facts(),
        "components": [{"name": name, "report": report} for name, report in reports.items()],
        "failed": [{"name": name, "error": error} for name, error in failed.items()],
        "sheets": sheets,
        "notes": list(notes),
        "seconds": clock.timings(ComponentSeconds),
    }
