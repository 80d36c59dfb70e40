"""The keys that several reports share, and how a report is declared.

At run time, a report is a plain dict of numbers, strings, lists and dicts. Each key is a field of a `TypedDict`,
annotated with its meaning; a section without one has the first sentence of the docstring of its type. A whole number in
an annotation is the length of a list. `tools/write_report_page.py` writes docs/report.md from these declarations, and
`tests/test_report.py` compares real reports with them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Annotated, Any, NotRequired, TypedDict, TypeVar

from infill.version import __version__

if TYPE_CHECKING:
    from infill.surface import Surface

FORM = 1  # increases when a key is renamed or changes its type or meaning; new keys leave it unchanged

Declared = TypeVar("Declared")
Pair = Annotated[list[float], 2]
Triple = Annotated[list[float], 3]
Corners = Annotated[list[Triple], 2]


def declare(declaration: Callable[..., Declared], values: Mapping[str, Any]) -> Declared:
    """Build a `TypedDict`, by its declaration, from values whose keys are known only at run time.

    >>> declare(Spread, {"mean": 0.1, "rms": 0.2, "max": 0.3})
    {'mean': 0.1, 'rms': 0.2, 'max': 0.3}
    """
    return declaration(**values)


class ReportForm(TypedDict):
    """Form and product of a report."""

    form: Annotated[int, "Version of the form of this report"]
    version: Annotated[str, "Version of phasefill"]
    product: Annotated[
        str, "`make`, `smooth`, `chunks`, `labels`, `together`, `components`, `fill`, `refill`, `verify` or `setup`"
    ]


class ReportHead(ReportForm):
    """First keys of the report of a product that writes files."""

    files: NotRequired[Annotated[list[str], "Names of the files written; from the command line only"]]


def report_head(product: str) -> ReportHead:
    """Return the first keys of the report of a product."""
    return {"form": FORM, "version": __version__, "product": product}


class GridKeys(TypedDict):
    """Grid of the computation."""

    shape: Annotated[list[int], 3, "Number of cells in x, y and z; z of a block counts its layers"]
    spacing: Annotated[Triple, "Size of a cell in x, y and z, mm"]
    origin: Annotated[Triple, "Lower corner of the first cell, mm"]
    space: Annotated[str, "Name of the axes: `LPS` for medical images, else empty"]


class SurfaceKeys(TypedDict):
    """Size of a surface."""

    triangles: Annotated[int, "Number of triangles"]
    closed: Annotated[bool, "Whether every edge has two faces that run along it in opposite directions"]
    area: Annotated[float, "Area of all triangles, mm²"]
    extents: Annotated[Triple, "Size in x, y and z, mm"]
    bounds: Annotated[Corners, "Lower and upper corner, mm"]


def surface_keys(surface: Surface) -> SurfaceKeys:
    """Return triangles, closed, area, extents and bounds of a surface, as report keys."""
    bounds = surface.bounds
    return {
        "triangles": len(surface.faces),
        "closed": surface.closed,
        "area": surface.area,
        "extents": (bounds[1] - bounds[0]).tolist(),
        "bounds": bounds.tolist(),
    }


class MeshKeys(SurfaceKeys):
    """Mesh of the result."""

    vertices: Annotated[int, "Number of vertices"]
    euler_number: Annotated[int, "Vertices − edges + triangles"]


def mesh_keys(surface: Surface) -> MeshKeys:
    """Return the keys of `surface_keys` with the number of vertices and the Euler number."""
    return {
        "vertices": len(surface.vertices),
        **surface_keys(surface),
        "euler_number": surface.euler_number,
    }


class Level(TypedDict):
    """Level of phi on which the surface lies."""

    method: Annotated[str, "`volume`: each component keeps its volume; `fixed`: one level for all components"]
    common: Annotated[float, "Level where no component has its own"]
    lowest: Annotated[float, "Lowest level of a component"]
    highest: Annotated[float, "Highest level of a component"]
    components: Annotated[int, "Number of components with a level"]


class Solid(TypedDict):
    """Volumes of the solid."""

    volume: Annotated[float, "Volume that the mesh encloses, mm³"]
    data: Annotated[float, "Volume of the data, mm³: of solid cells, of grey values, or of the stamped layers"]
    change: Annotated[float, "Volume over that of the data, minus 1; of a block, before its rims are rounded (`grid`)"]
    level: Level


class CountKeys(TypedDict):
    """Connections of a solid: its components share faces of cells, those of void share faces or edges."""

    components: Annotated[int, "Number of connected parts"]
    cavities: Annotated[int, "Number of voids that solid encloses, in which resin and powder stay"]
    tunnels: Annotated[int, "Number of holes that lead through"]
    euler_number: Annotated[int, "2 (components + cavities − tunnels)"]


class Topology(TypedDict):
    """Connections of the solid before and after smoothing."""

    data: Annotated[CountKeys, "Before smoothing; parts share faces of cells, voids share faces or edges"]
    result: Annotated[CountKeys, "After smoothing, before simplification"]


class ChangeKeys(TypedDict):
    """Changes of components and walls by smoothing."""

    vanished: Annotated[int, "Number of components that disappeared"]
    broken: Annotated[int, "Number of components or walls that fell apart"]
    fused: Annotated[int, "Number of components that merged"]
    appeared: Annotated[int, "Number of components where there was none before"]
    voids_closed: Annotated[int, "Number of voids that disappeared"]
    voids_cut: Annotated[int, "Number of voids that were cut in two"]
    voids_joined: Annotated[int, "Number of voids that merged because the wall between them broke"]
    walls_pierced: Annotated[int, "Number of holes that broke through walls"]


class SmoothingKeys(TypedDict):
    """Parameters of smoothing."""

    steps: Annotated[int, "Number of smoothing steps"]
    fidelity: Annotated[float, "Strength of the attraction to the data; refinement uses none and has 0"]
    interface: Annotated[float, "Number of cells from the surface to phi = 0.9"]
    alpha: Annotated[float, "Time step over the square of the cell size"]


class Spread(TypedDict):
    """Summary of distances."""

    mean: Annotated[float, "Mean, mm"]
    rms: Annotated[float, "Root mean square, mm"]
    max: Annotated[float, "Maximum, mm"]


class Seconds(TypedDict):
    """Time of each stage."""

    total: Annotated[float, "Sum of all stages, s"]


class SmoothSeconds(Seconds):
    """Time of each stage."""

    smooth: Annotated[float, "Smoothing, s; of a solid, also the removal of specks"]
    surface: Annotated[float, "Extraction of the surface and of its level, s"]
    check: Annotated[float, "Comparison of the result with the data, s"]


class Report(ReportHead, SurfaceKeys):
    """Keys that the reports of blocks and solids share."""

    volume: Annotated[float, "Volume that the mesh encloses, mm³, as `solid.volume`"]
    volume_change: Annotated[float, "Relative change of the volume, as `solid.change`"]
    components: Annotated[int, "Number of components, as `topology.result.components`"]
    problems: Annotated[list[str], "Problems of the result, one phrase each; empty without problems"]
    grid: GridKeys
    topology: Topology
