"""The reports of `infill check`, of meshes, prints and projects, and of `infill list`."""

from __future__ import annotations

from typing import Annotated, Any, NotRequired, TypedDict

from infill.reports.common import Corners, Triple


class CheckReport(TypedDict):
    """The report of `infill.check`: `Inspection.to_dict`. Units are those of the file, or mm if it states its unit."""

    file: NotRequired[Annotated[str, "Name of the file; only among several meshes"]]
    printable: Annotated[bool, "Whether there are no problems"]
    problems: Annotated[tuple[str, ...], "Reasons why the mesh is not printable, one phrase each"]
    warnings: Annotated[
        tuple[str, ...],
        "Objects of a 3MF that are not parts and were left out, and flaws that slicers handle, one phrase each",
    ]
    triangles: Annotated[int, "Number of triangles"]
    components: Annotated[int, "Number of connected surfaces: a solid with a sealed void has two"]
    closed: Annotated[bool, "Whether every edge has two faces that run along it in opposite directions"]
    outward: Annotated[bool, "Whether every component faces outwards, and every cavity inwards"]
    sealed_voids: Annotated[
        int | None, "Number of voids without a way out, in which resin and powder stay; null if the mesh is open"
    ]
    open_edges: Annotated[int, "Number of edges that do not have exactly two faces"]
    manifold: Annotated[str, "Verdict of manifold3d: `NoError` if it accepts the mesh"]
    self_intersections: Annotated[int, "Number of pairs of triangles that pass through each other"]
    degenerate: Annotated[int, "Number of triangles without an area"]
    duplicate: Annotated[int, "Number of triangles with the corners of another triangle"]
    volume: Annotated[float, "Volume"]
    area: Annotated[float, "Area"]
    extents: Annotated[Triple, "Size in x, y and z"]
    bounds: Annotated[Corners, "Lower and upper corner"]
    unit_guess: Annotated[str, "`mm`, or another unit that the size suggests if the file states none"]


class PrintCheckReport(TypedDict):
    """The report of ``infill check`` on a sliced print."""

    file: NotRequired[Annotated[str, "Name of the file; only among several files"]]
    printable: Annotated[bool, "Whether there are no problems"]
    problems: Annotated[tuple[str, ...], "Reasons why the print is not whole, one phrase each"]
    warnings: Annotated[tuple[str, ...], "Lines that were not understood, and layers that are not marked"]
    slicer: Annotated[str, "Slicer that wrote the print; empty if it does not say"]
    layers: Annotated[int, "Number of marked layers"]
    seconds: Annotated[float, "Printing time as `infill motion` plans it, s"]
    filament: Annotated[float, "Length of filament, mm"]


class FailedCheck(TypedDict):
    """The report of ``infill check`` on one of several files that cannot be read."""

    file: Annotated[str, "Name of the file"]
    error: Annotated[str, "Reason"]


class VolumeKeys(TypedDict):
    """Volumes that the slicer prints, in its order."""

    name: Annotated[str, "Name of the volume"]
    role: Annotated[str, "`part`, `modifier`, or another role that the slicer gives it"]
    triangles: Annotated[int, "Number of triangles"]
    closed: Annotated[bool, "Whether as many faces run along every edge one way as the other"]
    outward: Annotated[bool, "Whether it faces outwards"]
    shared: Annotated[int, "Number of edges with more than two faces"]
    settings: Annotated[dict[str, str], "Settings that the slicer reads"]


class ProjectReport(TypedDict):
    """The report of ``infill check --for``: `Diagnosis.to_dict`."""

    file: NotRequired[Annotated[str, "Name of the file; from the command line only"]]
    slicer: Annotated[str, "Name of the slicer"]
    fine: Annotated[bool, "Whether there are no problems"]
    problems: Annotated[tuple[str, ...], "Losses and refusals of the slicer, one phrase each"]
    warnings: Annotated[tuple[str, ...], "Surprises, one phrase each"]
    application: Annotated[str, "Program that wrote the file, as it states"]
    unit: Annotated[str, "Unit of the file"]
    volumes: tuple[VolumeKeys, ...]


class ParameterKeys(TypedDict):
    """Parameters of the pattern by name."""

    help: Annotated[str, "Meaning of the parameter"]
    unit: Annotated[str, "Its unit; empty without one"]
    default: Annotated[Any, "Its default; angles in degrees"]
    low: NotRequired[Annotated[int | float, "Lowest value"]]
    high: NotRequired[Annotated[int | float, "Highest value"]]


class PatternKeys(TypedDict):
    """Patterns for blocks, by name."""

    summary: Annotated[str, "Purpose of the pattern"]
    prismatic: Annotated[bool, "Whether it is the same at every height"]
    gives: Annotated[list[str], "Ways in which it describes itself: `lines`, `level set`"]
    options: dict[str, ParameterKeys]


class PatternList(TypedDict):
    """The report of ``infill list``."""

    patterns: dict[str, PatternKeys]
    in_space: NotRequired[Annotated[dict[str, str], "Purposes of the patterns in space, by name"]]
