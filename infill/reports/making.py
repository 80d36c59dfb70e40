"""The reports of `infill make`: of a block, and of a dry run."""

from __future__ import annotations

from typing import Annotated, Any, TypedDict

from infill.reports.common import (
    ChangeKeys,
    GridKeys,
    MeshKeys,
    Pair,
    Report,
    ReportHead,
    SmoothingKeys,
    SmoothSeconds,
    Solid,
    SurfaceKeys,
)
from infill.reports.filling import FillSeconds, PlannedSizes


class BlockRequest(SmoothingKeys):
    """Requested block."""

    pattern: Annotated[str, "Name of the pattern"]
    parameters: Annotated[dict[str, Any], "Parameters of the pattern by name; `infill list PATTERN` lists them"]
    size: Annotated[Pair, "Size of the block in x and y, mm"]
    height: Annotated[float, "Height of the block, mm"]
    line_width: Annotated[float, "Width of the walls, mm"]
    stamp: Annotated[str, "Shape of the stamp: `block` or `exact`"]
    cells_per_line: Annotated[int, "Number of grid cells across a line"]
    surface: Annotated[str, "Kind of surface: `prism` or `grid`"]
    tolerance: Annotated[float, "Largest distance by which simplification may move the contour, mm"]


class BlockMesh(MeshKeys):
    """Mesh of the block."""

    surface: Annotated[str, "`prism`: vertical walls between flat caps; `grid`: the isosurface of the layers"]
    tolerance: Annotated[float, "Largest distance of the contour from that of the isosurface at mid height, mm"]


class BlockSolid(Solid):
    """Volumes and density of the block."""

    density: Annotated[float, "Volume over that of the full block"]


class BlockChanges(ChangeKeys):
    """Changes of components and walls by smoothing."""

    pinholes: Annotated[int, "Number of closed or cut voids that were too narrow to print"]
    pinhole_share: Annotated[float, "Cells of the pinholes over the cells of all voids inside"]


class Width(TypedDict):
    """Width of the walls across the lines, away from nodes."""

    requested: Annotated[float, "Requested width, mm"]
    mean: Annotated[float | None, "Mean width, mm; null where every wall is too close to another"]
    p5: Annotated[float | None, "5th percentile, mm"]
    p95: Annotated[float | None, "95th percentile, mm"]
    samples: Annotated[int, "Number of places that were measured"]


class BlockWalls(TypedDict):
    """Thickness of the walls."""

    width: Width
    exact: Annotated[
        float | None,
        "Mean width that the exact stamp would give, from a sample, mm; null unless walls are off by more than 5 % and "
        "that width is closer",
    ]


class BlockSeconds(SmoothSeconds):
    """Time of each stage."""

    points: Annotated[float, "Lines and points of the pattern, s"]
    stamp: Annotated[float, "Stamping, s"]


class MakeReport(Report):
    """The report of `infill.make`."""

    density: Annotated[float, "Volume over that of the full block, as `solid.density`"]
    wall_width: Width
    request: BlockRequest
    mesh: BlockMesh
    solid: BlockSolid
    changes: BlockChanges
    walls: BlockWalls
    seconds: BlockSeconds


class LatticeRequest(TypedDict):
    """Requested block."""

    pattern: Annotated[str, "Name of the pattern"]
    parameters: Annotated[dict[str, Any], "Parameters of the pattern by name, angles in degrees"]
    size: Annotated[Pair, "Size of the block in x and y, mm"]
    height: Annotated[float, "Height of the block, mm"]
    density: Annotated[float | None, "Solid share of the whole block; null if other sizes decide it"]
    cell: Annotated[float | None, "Period of the pattern, mm; null if it follows from the density"]
    line_width: Annotated[float | None, "Width of walls or bars, mm; null if it follows from the density"]
    angle: Annotated[float, "Angle of the pattern, degrees"]
    phase: Annotated[Pair, "Shift of the pattern, mm"]
    frame: Annotated[float, "Width of the frame, mm; 0 without a frame"]
    tolerance: Annotated[float, "Largest distance by which simplification may move the walls, mm"]


class LatticeMesh(TypedDict):
    """Mesh of the block."""

    vertices: Annotated[int, "Number of vertices"]
    manifold: Annotated[str, "Verdict of manifold3d: `NoError` if it accepts the mesh"]
    tolerance: Annotated[
        float | None,
        "Largest distance by which simplification may have moved the walls, mm: more than requested where there were "
        "too many triangles; null if unknown",
    ]


class LatticeInfill(PlannedSizes):
    """Sizes of the infill."""

    radius: Annotated[float, "Radius of the fillets, mm"]
    density: Annotated[float, "Solid share inside the frame; of the whole block without one"]
    crumbs: Annotated[int, "Number of loose pieces, cut off the pattern by the sides, which were left out"]


class LatticeReport(ReportHead, SurfaceKeys):
    """The report of `infill.make` for a pattern in space, or for a density."""

    volume: Annotated[float, "Volume of the block, mm³"]
    components: Annotated[int, "Number of pieces that hang together"]
    density: Annotated[float, "Volume over that of the full block"]
    problems: Annotated[list[str], "Differences from the request, one phrase each; empty without differences"]
    request: LatticeRequest
    grid: GridKeys
    mesh: LatticeMesh
    infill: LatticeInfill
    seconds: FillSeconds


class LatticePlan(TypedDict):
    """The report of ``infill make --dry-run`` for a pattern in space, or for a density."""

    request: LatticeRequest
    infill: PlannedSizes
    grid: GridKeys
    memory: Annotated[int, "Expected memory, bytes"]


class MakePlan(TypedDict):
    """The report of ``infill make --dry-run``."""

    request: BlockRequest
    grid: GridKeys
    memory: Annotated[int, "Expected memory, bytes"]
    triangles: Annotated[int, "Expected number of triangles, accurate to about a quarter"]
    stl_bytes: Annotated[int, "Expected size of a binary STL file, bytes"]
