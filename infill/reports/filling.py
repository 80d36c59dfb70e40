"""The reports of `infill fill`: of a filled part, and of a dry run."""

from __future__ import annotations

from typing import Annotated, Any, TypedDict

from infill.reports.common import GridKeys, Pair, ReportHead, Seconds, SurfaceKeys, Triple


class FillRequest(TypedDict):
    """Requested infill."""

    pattern: Annotated[str, "Name of the pattern"]
    parameters: Annotated[dict[str, Any], "Parameters of the pattern by name, angles in degrees"]
    density: Annotated[
        float | None, "Solid share of the space inside the walls; null if other sizes decide it, or there are two"
    ]
    densities: Annotated[Pair | None, "Density where the field is lowest and where it is highest"]
    by: Annotated[str | None, "Field that the density follows"]
    grade: Annotated[str | None, "Size that varies with the density: `width` or `cell`; null for one density"]
    region: Annotated[list[str], "Regions with other settings, as on the command line; later ones win"]
    cell: Annotated[float | None, "Period of the pattern, mm; null if it follows from the density"]
    line_width: Annotated[float | None, "Width of walls or bars, mm; null if it follows from the density"]
    wall: Annotated[float, "Thickness of the shell, mm"]
    angle: Annotated[float, "Angle of the pattern, degrees"]
    phase: Annotated[Triple, "Shift of the pattern, mm"]
    align: Annotated[str, "Origin of the pattern: `part`, `bed` or `body`"]
    form: Annotated[str, "Kind of result: `solid`, `infill` or `project`"]
    overlap: Annotated[float, "Distance by which the infill alone reaches into the shell, mm"]
    drain: Annotated[float | None, "Diameter of the drains, mm; null without drains"]
    vent: Annotated[bool, "Whether every void also has a hole up"]
    drain_at: Annotated[list[Triple], "Requested places of drains, mm; empty without places"]
    open: Annotated[str | None, "Sides without a shell: `top`, `bottom` or `both`; null for a closed part"]
    ties: Annotated[bool, "Whether islands of upright walls that nothing holds are tied to the rest"]
    smooth_radius: Annotated[float | None, "Radius of the fillets, mm; null for the default"]
    tolerance: Annotated[float, "Largest distance by which simplification may move the voids, mm"]
    resolution: Annotated[int | None, "Number of grid cells along the longest side, if requested"]
    voxel: Annotated[float | None, "Size of a grid cell, mm; null if the pattern decides it"]
    max_triangles: Annotated[
        int | None, "Largest number of triangles; null for a million, or 250,000 more than the part has"
    ]


class FillMesh(TypedDict):
    """Mesh of the result."""

    vertices: Annotated[int, "Number of vertices"]
    manifold: Annotated[str, "Verdict of manifold3d: `NoError` if it accepts the mesh"]
    skin: Annotated[
        str,
        "Repair of the mesh of the part. `as given`: none, so that its vertices remain, except those of open sides; "
        "`turned`: faces turned outwards; `closed`: holes closed; `parted`: touching components separated; `united`: "
        "overlapping components united",
    ]
    tolerance: Annotated[
        float | None,
        "Largest distance by which simplification may have moved the voids, mm: more than requested where there were "
        "too many triangles; null if unknown",
    ]


class PlannedSizes(TypedDict):
    """Expected sizes of the infill."""

    cell: Annotated[float, "Period of the pattern, mm"]
    line_width: Annotated[
        float,
        "Width of the walls or diameter of the bars in the mesh, mm: the median away from the walls of the part; as "
        "drawn where there is none, and of networks",
    ]


class FillTie(TypedDict):
    """Bars that tie islands of upright walls to the nearest wall or line; empty if nothing hung free."""

    at: Annotated[Pair, "Its middle in x and y, mm"]
    length: Annotated[float, "Length between what it joins, mm"]
    width: Annotated[float, "Width, mm: that of the lines, or three cells of a grid too coarse for that"]


class FillSizes(PlannedSizes):
    """Sizes of the infill."""

    radius: Annotated[float, "Radius of the fillets, mm"]
    cells: Annotated[Pair | None, "Where the density varies: smallest and largest cell, as cubes of equal volume, mm"]
    widths: Annotated[Pair | None, "Where the density varies: narrowest and widest walls or bars as drawn, mm"]
    phase: Annotated[Triple, "Shift of the pattern, mm: as requested, or in a project, where slicers print most of it"]
    narrow: Annotated[
        float | None, "In a project: share of the infill that is too narrow to print beside the walls; else null"
    ]
    left_out: Annotated[
        float,
        "Infill that was left out, mm³: in a project, what is too narrow, if it exceeds 4.5 % (2 % of a shifted "
        "pattern); in an open part, what was loose",
    ]
    ties: list[FillTie]
    untied: Annotated[int, "Number of islands that no straight bar reaches"]


class GradedStep(TypedDict):
    """Regions of similar requested density, by rising density; empty if the density is the same everywhere."""

    wanted: Annotated[float, "Requested density"]
    density: Annotated[float, "Actual density, at random cells inside the walls, to a hundredth"]


class FillRegion(TypedDict):
    """Regions with settings of their own, and the rest of the part first; empty if none were requested."""

    place: Annotated[str, "Place of the region; `rest` outside of all regions"]
    pattern: Annotated[str | None, "Name of the pattern; null if the region lies over several"]
    wanted: Annotated[float | None, "Requested density; null if none is requested there, or several are"]
    density: Annotated[float | None, "Actual density inside the walls; null where nothing of the region is left"]
    volume: Annotated[float, "Volume of the region inside the walls, mm³"]
    wall: Annotated[float | None, "Requested thickness of the shell, mm; null if the region lies over several"]
    least: Annotated[
        float | None,
        "Where walls differ: least distance of voids from the skin, mm, further from the border of regions than a cell "
        "of the grid; null without voids there, or if all walls are alike",
    ]


class FillPart(TypedDict):
    """Part that was filled."""

    triangles: Annotated[int, "Number of triangles of the part"]
    volume: Annotated[float, "Volume of the part if it were solid, mm³"]
    inside: Annotated[float, "Volume inside the walls, mm³: a layer as thick as the wall lies along all closed sides"]
    components: Annotated[int, "Number of parts of the mesh that share no vertex, cavities included"]
    turned: Annotated[int, "Number of components that were turned inside out"]
    holes: Annotated[int, "Number of loops of open edges that were capped"]
    notes: Annotated[list[str], "Parts of the file that were left out, such as modifiers in a 3MF, one phrase each"]


class ClosedVoid(TypedDict):
    """Voids that cannot drain, by falling volume; empty for the infill alone."""

    volume: Annotated[float, "Volume of the void, mm³"]
    at: Annotated[Triple, "Its lowest point, mm"]


class FillVoids(TypedDict):
    """Voids of the infill."""

    count: Annotated[int, "Number of voids before drains are made"]
    open: Annotated[int, "Number of voids that reach an open side and need no drain"]
    volume: Annotated[float, "Volume of the voids inside the walls, mm³"]
    triangles: Annotated[int, "Number of triangles of the voids"]
    specks: Annotated[int, "Number of voids too small for the grid, which were left solid"]
    islands: Annotated[int, "Number of loose pieces of infill, which were left out"]
    loose: Annotated[
        int, "Without a shell: number of bodies of infill that touch nothing and stay in the result, besides one a part"
    ]
    closed: list[ClosedVoid]


class FillHole(TypedDict):
    """Holes that leave the part, and branches from void to void."""

    kind: Annotated[str, "`drain`: down; `vent`: up; `place`: at a requested place; `branch`: into a void that drains"]
    at: Annotated[Triple, "Place where its axis leaves the part; of a branch, where it begins in its void, mm"]
    to: Annotated[Triple, "Place where its axis ends in the void; of a branch, in the other void, mm"]
    diameter: Annotated[float, "Diameter, mm; below the requested one only of a branch into a narrow void"]
    void: Annotated[int, "Number of its void; the largest is 0"]
    into: Annotated[int | None, "Number of the void to which a branch leads; else null"]
    wall: Annotated[
        float | None, "Least distance from all skin except the face that it leaves through, mm; null without other skin"
    ]
    above: Annotated[float, "Height of its start above the lowest place of the void, mm; of a vent, below the highest"]


class UndrainedVoid(TypedDict):
    """Voids that cannot be drained, by falling volume."""

    void: Annotated[int, "Number of the void; the largest is 0"]
    volume: Annotated[float, "Volume of the void, mm³"]
    at: Annotated[Triple, "Its lowest place, mm; its highest where a vent is missing"]
    fits: Annotated[
        float | None, "Widest of four narrower diameters, down to a quarter, for which there is a hole, mm; else null"
    ]


class FillDrains(TypedDict):
    """Drain holes."""

    count: Annotated[int, "Number of holes that leave the part"]
    at: Annotated[list[Triple], "Places where the holes leave the part, mm"]
    holes: list[FillHole]
    undrained: list[UndrainedVoid]
    unvented: Annotated[list[UndrainedVoid], "Voids that drain and lack a requested vent"]


class FillWalls(TypedDict):
    """Thickness of the shell."""

    requested: Annotated[float, "Requested thickness, mm"]
    least: Annotated[
        float | None,
        "Least distance of voids and drains from the skin, mm, except open sides and the faces that drains leave "
        "through; null in a project, whose walls the slicer makes",
    ]
    at: Annotated[Triple | None, "Place of the least distance, mm; null in a project"]


class FillSeconds(Seconds):
    """Time of each stage."""

    density: Annotated[float, "Search for the cell or the line width, s"]
    depth: Annotated[float, "Depth of each cell below the skin, s"]
    voids: Annotated[float, "Computation, smoothing and extraction of the voids, s"]
    simplify: Annotated[float, "Simplification, s"]
    shift: Annotated[float, "Trial places of the pattern in a project, s; 0 if it stayed"]
    check: Annotated[float, "Measurement of the walls, and check of the mesh, s"]


class UntimedFillReport(ReportHead, SurfaceKeys):
    """The report of `infill.fill` before the clock stops."""

    volume: Annotated[float, "Volume of skin and infill, mm³; in a project, of the infill alone"]
    density: Annotated[float, "Solid share of the space inside the walls, from the final meshes of the voids"]
    problems: Annotated[list[str], "Differences from the request, one phrase each; empty without differences"]
    request: FillRequest
    grid: GridKeys
    mesh: FillMesh
    infill: FillSizes
    graded: list[GradedStep]
    regions: list[FillRegion]
    part: FillPart
    voids: FillVoids
    drains: FillDrains
    walls: FillWalls


class FillReport(UntimedFillReport):
    """The report of `infill.fill`."""

    seconds: FillSeconds


class FillForecast(TypedDict):
    """The report of ``infill fill --dry-run``."""

    request: FillRequest
    infill: PlannedSizes
    grid: GridKeys
    memory: Annotated[int, "Expected memory, bytes"]
