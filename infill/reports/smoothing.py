"""The reports of `infill smooth`: of one solid, of every label, of every component, and of a dry run."""

from __future__ import annotations

from typing import Annotated, NotRequired, TypedDict

from infill.reports.common import (
    ChangeKeys,
    GridKeys,
    MeshKeys,
    Report,
    ReportHead,
    Seconds,
    SmoothingKeys,
    SmoothSeconds,
    Solid,
    Spread,
    SurfaceKeys,
    Topology,
    Triple,
)


class SolidRequest(SmoothingKeys):
    """Requested smoothing."""

    method: Annotated[str, "`plain`, `refine` or `grey`; `auto` if it is chosen for each label or component"]
    crumbs: Annotated[float | None, "Largest volume of crumbs to remove, mm³; null for 8 voxels"]
    refine: Annotated[bool, "Whether edges and thin walls are refined"]
    level: Annotated[float | str, "`volume`, or the level of phi"]
    despeckle: Annotated[float, "Largest volume of components to remove beforehand, mm³"]
    tolerance: Annotated[
        float | str | None,
        "Largest distance by which simplification may move the surface, mm; `auto` if it follows from the voxels of "
        "each label or component",
    ]
    max_triangles: Annotated[int | None, "Largest number of triangles after simplification"]


class SegmentationRule(TypedDict):
    """Rule that decides which cells are solid."""

    method: Annotated[str, "`mask`, `phase`, `label`, `range` or `otsu`"]
    low: NotRequired[Annotated[float | None, "Lowest value that is solid"]]
    high: NotRequired[Annotated[float | None, "Highest value that is solid"]]
    label: NotRequired[Annotated[list[int], "Labels that are solid"]]


class SegmentationKeys(SegmentationRule):
    """Volumes: rule that decides which cells are solid."""

    values: Annotated[list[int | float], 2, "Lowest and highest value"]
    solid: Annotated[float, "Solid share of all cells"]


class RepairKeys(TypedDict):
    """Meshes: repairs, and assumptions about the mesh."""

    components: Annotated[int, "Number of parts that share no vertex"]
    turned: Annotated[int, "Number of components that faced inwards while others faced outwards"]
    holes: Annotated[int, "Number of loops of open edges that were capped"]
    hole_share: Annotated[float, "Area of the caps over the area of mesh and caps"]
    volume: Annotated[float, "Volume inside the mesh and its caps, mm³; overlaps count once"]


class CoarseChange(TypedDict):
    """Change of the solid by larger voxels, from its cells before and after."""

    volume_before: Annotated[float, "Volume of the voxels of the file, mm³"]
    change: Annotated[float, "Relative change of the volume by larger voxels"]
    fitting: Annotated[float | None, "Smaller voxels that keep the volume to 5 %, where those requested do not, mm"]


class KnownInput(TypedDict):
    """Input, as far as it is known before a run."""

    source: Annotated[str, "Kind of input: `volume`, `mesh` or `points`"]
    noise: NotRequired[Annotated[float, "Volumes and points: share of surface cells that their neighbours overrule"]]
    slices: NotRequired[Annotated[int, "Volumes and points: number of cells that each thick slice became"]]
    coarse: NotRequired[Annotated[bool, "Volumes: whether larger voxels were requested"]]
    coarsened: NotRequired[Annotated[CoarseChange, "Volumes: change of the solid by larger voxels, if requested"]]
    warnings: NotRequired[Annotated[list[str], "Volumes: assumptions and warnings of the reader"]]
    grey: NotRequired[Annotated[bool, "Volumes and points: whether grey values around the threshold were kept"]]
    segmentation: NotRequired[SegmentationKeys]
    points: NotRequired[Annotated[int, "Points: number of points"]]
    shell: NotRequired[Annotated[float | None, "Points: width of the shell around them, mm; null for the solid inside"]]


class InputKeys(KnownInput):
    """Input of the run, before specks are removed."""

    several: NotRequired[Annotated[bool, "Meshes: whether there are several components, or overlaps"]]
    notes: NotRequired[Annotated[list[str], "Meshes: parts of the file that were left out, such as modifiers in a 3MF"]]
    repairs: NotRequired[RepairKeys]
    normals: NotRequired[Annotated[bool, "Points: whether they came with normals; else normals are estimated"]]


class Input(InputKeys):
    """Input of the run."""

    despeckled: Annotated[int, "Number of components that were removed beforehand"]


class Simplified(TypedDict):
    """Costs of simplification; missing without simplification."""

    triangles_before: Annotated[int, "Number of triangles of the full mesh"]
    volume_change: Annotated[float, "Volume over that of the full mesh, minus 1"]
    shells: Annotated[int, "Number of connected surfaces that remain"]
    distance: Annotated[Spread, "Distance of vertices of the full mesh from the simplified one"]


class SolidMesh(MeshKeys):
    """Mesh of the solid."""

    simplified: NotRequired[Simplified]


class SolidChanges(ChangeKeys):
    """Changes of components and walls by smoothing; only `vanished_thin` counts parts one cell thick."""

    walls_lost: Annotated[int, "Number of pieces of wall that disappeared"]
    faint: Annotated[int, "Number of components that only a very low level keeps"]
    vanished_thin: Annotated[int, "Number of components at most one cell thick that disappeared"]


class Thinnest(TypedDict):
    """Thickness behind the thinnest hundredth of the surface."""

    data: Annotated[float | None, "In the data, mm; null where nothing is thin"]
    result: Annotated[float | None, "In the result, mm"]


class LostWall(TypedDict):
    """Largest pieces of wall that disappeared."""

    voxels: Annotated[int, "Size of the piece, voxels"]
    at: Annotated[Triple, "Middle of the piece, mm"]


class SolidWalls(TypedDict):
    """Thickness of the walls."""

    thinnest: Thinnest
    lost: list[LostWall]


class Place(TypedDict):
    """A place that was lost or added."""

    at: Annotated[Triple, "The furthest point of the place, mm"]
    area: Annotated[float, "Area of the place, mm²"]
    distance: Annotated[float, "Distance of that point from the other surface, mm"]


class CrumbKeys(TypedDict):
    """Small pieces that smoothing broke off and that were removed."""

    removed: Annotated[int, "Number of crumbs"]
    volume: Annotated[float, "Volume of all crumbs, mm³"]
    limit: Annotated[float, "Largest volume of a crumb, mm³"]


class ReplacedSmoothing(TypedDict):
    """Smoothing that was asked for and lost something, so that another was taken; null if it was taken."""

    steps: Annotated[int, "Number of steps, at the size of the voxels"]
    radius: Annotated[float | None, "Radius, mm; null if steps were asked for"]


class DifferenceKeys(TypedDict):
    """Verdict on the result, compared with the input."""

    word: Annotated[str, "`kept`, `changed a little` or `lost`"]
    changes: Annotated[list[str], "Changes, one phrase each"]
    lost: Annotated[list[Place], "Five largest places of the input more than 2 voxels from the result"]
    added: Annotated[list[Place], "Five largest places of the result more than 2 voxels from the input"]
    far: Annotated[float, "2 voxels, mm: what lies further away is missing or new"]
    missing: Annotated[float, "Area of the input that is missing, mm²"]
    thin: Annotated[float, "Area of the input that is gone but was too thin to count, mm²: walls or slits of one voxel"]
    new: Annotated[float, "Area of the result that is new, mm²"]


class Judgement(DifferenceKeys):
    """Verdict on the result, compared with the input."""

    crumbs: CrumbKeys


class VerdictKeys(Judgement):
    """Verdict on the result, compared with the input."""

    tried: Annotated[list[str], "Ways of smoothing that were tried, in order"]
    taken: Annotated[str, "Way of smoothing that was chosen"]
    instead_of: ReplacedSmoothing | None


class Distances(Spread):
    """Distances, and the place of the largest one."""

    p95: Annotated[float, "95th percentile over the area, mm"]
    at: Annotated[Triple, "Place of the maximum, mm"]


class PointDistances(Distances):
    """Points: distance of the points from the result."""

    far: Annotated[int, "Number of points more than two voxels away"]
    lost: Annotated[int, "Number of these whose six neighbours are as far away"]


# As a call, since `from` is a keyword of Python.
Distance = TypedDict(
    "Distance",
    {
        "from": Annotated[str, "Surface to compare with: `voxels`, or the `mesh` of the input"],
        "result": Annotated[Distances, "From the result to the input: additions"],
        "input": Annotated[Distances, "From the input to the result: losses"],
        "thin": Annotated[float, "The same as `verdict.thin`"],
        "sheet": Annotated[float, "Area of faces that bound no solid, mm²"],
        "hidden": Annotated[float, "Area of faces inside the solid, far from its surface, mm²"],
        "data": NotRequired[Annotated[Spread, "Meshes: distance of the surface of the voxels from the mesh"]],
        "points": NotRequired[PointDistances],
    },
)


class FlatFacetKeys(TypedDict):
    """Meshes: flat facets that are as flat as before, if they are half of the surface or more; else null."""

    share: Annotated[float, "Share of the surface of the mesh"]
    width: Annotated[float, "Median width of a facet, mm"]
    radius: Annotated[float, "Radius of smoothing that rounds facets of this width, mm"]
    voxel: Annotated[float, "Size of the voxels for that radius, mm"]


class FacetKeys(FlatFacetKeys):
    """Meshes: flat facets that are as flat as before, if they are half of the surface or more; else null."""

    fits: Annotated[bool, "Whether the thinnest walls are thick enough for that radius"]


class Isosurface(TypedDict):
    """Isosurface of the unsmoothed grey values."""

    volume: Annotated[float, "Volume inside it, mm³"]
    change: Annotated[float | None, "Volume of the result over it, minus 1; null if it encloses nothing"]


class SolidSeconds(SmoothSeconds):
    """Time of each stage."""

    voxels: Annotated[float, "Voxels of a mesh, s; 0 for other input"]
    simplify: Annotated[float, "Fewer triangles, s; 0 where all are kept"]
    measure: Annotated[float, "Distances of the simplified surface from the input, s"]


class SmoothReport(Report):
    """The report of `infill.smooth_volume`, `infill.smooth_mesh` and `infill.smooth_points`."""

    request: SolidRequest
    input: Input
    mesh: SolidMesh
    solid: Solid
    changes: SolidChanges
    walls: SolidWalls
    verdict: VerdictKeys
    distance: Annotated[Distance, "Distance between result and input, measured when it is first read"]
    facets: FacetKeys | None
    seconds: SolidSeconds
    isosurface: Annotated[
        Isosurface | None,
        "Grey values with one threshold: their isosurface, measured when it is first read; null for other input",
    ]


class LabelName(TypedDict):
    """A label."""

    name: Annotated[str, "Name of the label"]
    number: Annotated[int, "Value of its cells"]
    layer: Annotated[int, "Volume of the file in which it lies, counted from 0"]


class LabelKeys(LabelName):
    """Labels with a surface, by layer and number."""

    colour: Annotated[str | None, "Colour as `#RRGGBB`, if the table has one"]
    report: Annotated[SmoothReport, "Report of the label; its grid is the part of the volume where the label lies"]


class FailedLabel(LabelName):
    """Labels that could not be smoothed; empty unless the run was asked to keep going."""

    error: Annotated[str, "Reason"]


class LabelSeconds(Seconds):
    """Time of each stage."""

    labels: Annotated[float, "Search for the place of each label, s"]
    smooth: Annotated[float, "Smoothing of all labels, s"]


class SeveralReport(ReportHead):
    """Keys that the reports of labels and of components share."""

    triangles: Annotated[int, "Number of triangles of all surfaces"]
    closed: Annotated[bool, "Whether all surfaces are closed"]
    problems: Annotated[list[str], "Problems of the results, one phrase each, which begins with a name"]
    request: SolidRequest


class LabelsReport(SeveralReport):
    """The report of `infill.smooth_labels`."""

    labels: list[LabelKeys]
    failed: list[FailedLabel]
    absent: Annotated[list[str], "Names in the file without a cell"]
    seconds: LabelSeconds


class TogetherVerdict(DifferenceKeys):
    """Verdict on the label, compared with its voxels."""


class TogetherLabel(LabelName):
    """Labels with a surface, in order; neighbours share their walls."""

    colour: Annotated[str | None, "Colour as `#RRGGBB`, if the table has one"]
    triangles: Annotated[int, "Number of triangles, those of shared walls included"]
    closed: Annotated[bool, "Whether every edge is shared by two of its triangles"]
    data: Annotated[float, "Volume of its cells, mm³"]
    volume: Annotated[float, "Volume of its surface, mm³"]
    volume_change: Annotated[float, "Relative difference of both"]
    components_before: Annotated[int, "Components of its cells"]
    components: Annotated[int, "Components after smoothing"]
    topology: Topology
    verdict: TogetherVerdict
    distance: Annotated[Distance, "Distance between the surface and that of its voxels, measured when it is first read"]


class Verdicts(TypedDict):
    """Verdicts on all labels."""

    word: Annotated[str, "The worst: `kept`, `changed a little` or `lost`"]
    summary: Annotated[str, "How many labels have each verdict, and the names of some, the worst first"]


class TogetherSeconds(Seconds):
    """Time of each stage."""

    smooth: Annotated[float, "Fields of all labels, s"]
    volumes: Annotated[float, "Search for walls with which every label keeps its volume, s"]
    simplify: Annotated[float, "Fewer triangles in all walls, s"]
    surface: Annotated[float, "Surfaces of all labels, s"]
    check: Annotated[float, "Comparison with the voxels, s"]


class PartedLabel(LabelName):
    """Labels with a surface, in order; neighbours share their walls."""

    colour: Annotated[str | None, "Colour as `#RRGGBB`, if the table has one"]
    triangles: Annotated[int, "Number of triangles, those of shared walls included"]
    closed: Annotated[bool, "Whether every edge is shared by two of its triangles"]
    data: Annotated[float, "Volume of its cells, mm³"]
    volume: Annotated[float, "Volume of its surface, mm³"]
    volume_change: Annotated[float, "Relative difference of both"]


class PartedChunks(TypedDict):
    """Division of the volume."""

    count: Annotated[int, "Number of chunks"]
    cells: Annotated[list[int], 3, "Number of cells of a chunk along x, y and z, without its margin"]
    margin: Annotated[list[int], 3, "Number of cells read beside it along x, y and z"]
    workers: Annotated[int, "Number of chunks at work at once"]


class PartedSeconds(Seconds):
    """Time of each stage."""

    labels: Annotated[float, "Search for the place of each label, s"]
    smooth: Annotated[float, "Fields of all labels in all chunks, s"]
    volumes: Annotated[float, "Search for walls with which every label keeps its volume, s"]
    surface: Annotated[float, "Walls of all chunks joined, and surfaces of all labels, s"]


class PartedReport(SeveralReport):
    """The report of labels that were smoothed together in chunks. `triangles` counts shared walls once."""

    labels: list[PartedLabel]
    failed: list[FailedLabel]
    absent: Annotated[list[str], "Names in the file without a cell"]
    rounds: Annotated[int, "How often volumes were measured until they were right"]
    chunks: PartedChunks
    seconds: PartedSeconds


class TetrahedraKeys(TypedDict):
    """Tetrahedra that fill the labels, face to face; null unless the command writes a .vtu."""

    tetrahedra: Annotated[int, "Number of tetrahedra"]
    points: Annotated[int, "Number of their points"]
    smallest_angle: Annotated[float, "Smallest angle between two faces of a tetrahedron, degrees"]
    slivers: Annotated[float, "Share of tetrahedra whose radius ratio is below 0.1; it is 1 in a regular one"]
    mean_radius_ratio: Annotated[float, "Mean of the radius ratios: 3 times that of the inner over the outer sphere"]
    moved: Annotated[int, "Number of points of walls that moved, so that no tetrahedron is inside out"]


class TogetherReport(SeveralReport):
    """The report of `infill.smooth_labels` with `together`. `triangles` counts shared walls once."""

    labels: list[TogetherLabel]
    failed: list[FailedLabel]
    absent: Annotated[list[str], "Names in the file without a cell"]
    verdict: Verdicts
    rounds: Annotated[int, "How often volumes were measured until they were right"]
    seconds: TogetherSeconds
    tetrahedra: TetrahedraKeys | None


class ComponentKeys(TypedDict):
    """Components with a surface, by falling volume in the input."""

    name: Annotated[str, "`component_1` and so on"]
    report: Annotated[SmoothReport, "Report of the component"]


class FailedComponent(TypedDict):
    """Components that could not be smoothed; empty unless broken results are allowed."""

    name: Annotated[str, "Name of the component"]
    error: Annotated[str, "Reason"]


class Worst(TypedDict):
    """Worst verdict of all components."""

    word: Annotated[str, "`kept`, `changed a little` or `lost`"]


class ComponentSeconds(Seconds):
    """Time of each stage."""

    components: Annotated[float, "Separation of the components, s"]
    smooth: Annotated[float, "Smoothing of all components, s"]


class ComponentsReport(SeveralReport):
    """The report of `infill.smooth_mesh` with `by_component`."""

    extents: Annotated[Triple, "Size of all components together in x, y and z, mm"]
    volume: Annotated[float, "Sum of all volumes, mm³; overlaps count for each component"]
    volume_change: Annotated[float, "Sum of all volumes over the volume of the data, minus 1"]
    verdict: Worst
    components: list[ComponentKeys]
    failed: list[FailedComponent]
    sheets: Annotated[int, "Number of components that enclose nothing and are left out"]
    notes: Annotated[list[str], "Parts of the file that were left out, such as modifiers in a 3MF, one phrase each"]
    seconds: ComponentSeconds


class ChunksInput(TypedDict):
    """Input of the run."""

    name: Annotated[str, "Path or URL"]
    segmentation: SegmentationKeys
    noise: Annotated[float, "Share of surface cells that their neighbours overrule"]
    grey: Annotated[bool, "Whether grey values around the threshold were kept"]
    warnings: Annotated[list[str], "Assumptions and warnings of the reader"]


class ChunkKeys(TypedDict):
    """Division of the volume."""

    count: Annotated[int, "Number of chunks"]
    crossed: Annotated[int, "Number of chunks that a surface may cross; the others were only looked at"]
    cells: Annotated[list[int], 3, "Number of cells of a chunk along x, y and z, without its margin"]
    margin: Annotated[list[int], 3, "Number of cells read beside it along x, y and z"]
    workers: Annotated[int, "Number of chunks at work at once"]
    passes: Annotated[int, "Number of passes over the chunks after they were smoothed, to find the level"]


class ChunksSimplified(TypedDict):
    """Simplification of the surface; None if all triangles are kept."""

    triangles_before: Annotated[int, "Number of triangles before"]
    tolerance: Annotated[float, "Largest distance between the surfaces before and after, mm"]
    volume_change: Annotated[float, "Relative change of the volume by it"]


class ChunksSeconds(Seconds):
    """Time of each stage."""

    read: Annotated[float, "Passes over the values, to find what is solid, s"]
    smooth: Annotated[float, "Smoothing of all chunks, s"]
    surface: Annotated[float, "Search for the level, s"]
    check: Annotated[float, "Crumbs, the verdict and the numbers of vertices, s"]
    simplify: Annotated[float, "Simplification, s"]
    write: Annotated[float, "Triangles, made and written, s"]


class ChunksReport(ReportHead, SurfaceKeys):
    """The report of a volume that was smoothed in chunks."""

    vertices: Annotated[int, "Number of vertices"]
    hash: Annotated[
        str, "Hash of all triangles before they are simplified, 16 digits: the same for any chunks and order"
    ]
    volume: Annotated[float, "Volume that the mesh encloses, mm³"]
    volume_change: Annotated[float, "Relative change of the volume"]
    components: Annotated[int, "Number of components"]
    problems: Annotated[list[str], "Problems of the result, one phrase each; empty without problems"]
    verdict: VerdictKeys
    request: SolidRequest
    grid: GridKeys
    input: ChunksInput
    solid: Solid
    topology: Topology
    chunks: ChunkKeys
    simplified: ChunksSimplified | None
    seconds: ChunksSeconds


class PlannedInput(KnownInput):
    """Input, as far as it is known before the run."""

    triangles: NotRequired[Annotated[int, "Meshes: number of triangles"]]
    sampled: NotRequired[Annotated[int, "Large DICOM folders: number of slices that were read for the estimate"]]
    of: NotRequired[Annotated[int, "Large DICOM folders: number of slices of the folder"]]


class PlannedSolid(TypedDict):
    """Volume of the solid."""

    data: Annotated[float, "Volume of the data, mm³; of a mesh or points, about"]


class PlannedSeconds(TypedDict):
    """Expected time."""

    total: Annotated[float, "Time of the first way on this machine, right to a factor of two, s"]


class FleetHours(TypedDict):
    """Time with some number of workers."""

    workers: Annotated[int, "Number of workers, of one core each"]
    hours: Annotated[float, "Expected time, h"]


class ChunksForecast(TypedDict):
    """The report of ``infill smooth --dry-run`` for a volume in chunks."""

    request: SolidRequest
    grid: GridKeys
    chunks: Annotated[int, "Number of chunks"]
    crossed: Annotated[float, "Share of the sampled chunks that a surface may cross"]
    read: Annotated[int, "Bytes of cells to read in one pass, with margins"]
    sent: Annotated[int, "Bytes that tasks send back, besides the triangles that are written, about"]
    tasks: Annotated[int, "Number of tasks, about"]
    memory: Annotated[int, "Expected memory of all chunks at work at once, bytes"]
    memory_per_worker: Annotated[int, "Expected memory of one of them, bytes"]
    hours: list[FleetHours]
    seconds: PlannedSeconds
    triangles: Annotated[int, "Number of triangles before they are simplified, about"]
    files: NotRequired[Annotated[list[str], "Names of the files that a run would write; from the command line only"]]


class SmoothForecast(TypedDict):
    """The report of ``infill smooth --dry-run``."""

    request: SolidRequest
    grid: GridKeys
    input: PlannedInput
    solid: PlannedSolid
    ways: Annotated[list[str], "Ways of smoothing to try in turn until nothing is lost"]
    triangles_before: Annotated[int, "Number of triangles before simplification, right to a tenth"]
    memory: Annotated[int, "Expected memory, bytes"]
    seconds: PlannedSeconds
    files: NotRequired[Annotated[list[str], "Names of the files that a run would write; from the command line only"]]


class PlannedLabel(LabelName):
    """Labels that would be smoothed, by layer and number."""

    data: Annotated[float, "Volume of its cells, mm³"]
    triangles_before: Annotated[int, "Number of triangles before simplification, about"]


class LabelsForecast(TypedDict):
    """The report of ``infill smooth --dry-run`` for every label."""

    request: SolidRequest
    labels: list[PlannedLabel]
    memory: Annotated[int, "Expected memory of the largest label, or of all together, bytes"]
    seconds: PlannedSeconds
    files: NotRequired[Annotated[list[str], "Names of the files that a run would write; from the command line only"]]
