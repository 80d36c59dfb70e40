"""The keys and types of reports, for editors and type checkers: at run time a report is a plain dict.

docs/report.md explains each key; a test compares that page, these types and real reports. Keys that only some reports
of a product have are `NotRequired`.
"""

from __future__ import annotations

from typing import Any, NotRequired, TypedDict

Vector = list[float]  # x, y(, z), mm


class GridKeys(TypedDict):
    """The grid of the computation."""

    shape: list[int]
    spacing: Vector
    origin: Vector
    space: str


class Spread(TypedDict):
    """A summary of distances, mm."""

    mean: float
    rms: float
    max: float


class Distances(Spread):
    """Distances and the place of the largest one."""

    p95: float
    at: Vector


class PointDistances(Distances):
    """Distances of points."""

    far: int
    lost: int


class Simplified(TypedDict):
    """Costs of simplification."""

    triangles_before: int
    volume_change: float
    shells: int
    distance: Spread


class MeshKeys(TypedDict):
    """The resulting surface."""

    vertices: int
    triangles: int
    closed: bool
    area: float
    extents: Vector
    bounds: list[Vector]
    euler_number: int


class BlockMesh(MeshKeys):
    """The surface of a block."""

    surface: str
    tolerance: float


class SolidMesh(MeshKeys):
    """The surface of a solid."""

    simplified: NotRequired[Simplified]


class Level(TypedDict):
    """The level of phi on which the surface lies."""

    method: str
    common: float
    lowest: float
    highest: float
    components: int


class Solid(TypedDict):
    """Volumes, mm³."""

    volume: float
    data: float
    change: float
    level: Level


class BlockSolid(Solid):
    """Volumes and density of a block."""

    density: float


class CountKeys(TypedDict):
    """Connectivity of a solid."""

    components: int
    cavities: int
    tunnels: int
    euler_number: int


class Topology(TypedDict):
    """Connectivity before and after smoothing."""

    data: CountKeys
    result: CountKeys


class ChangeKeys(TypedDict):
    """Changes of components and walls by smoothing."""

    vanished: int
    broken: int
    fused: int
    appeared: int
    voids_closed: int
    voids_cut: int
    voids_joined: int
    walls_pierced: int


class BlockChanges(ChangeKeys):
    """Changes in a block."""

    pinholes: int
    pinhole_share: float


class SolidChanges(ChangeKeys):
    """Changes in a solid."""

    walls_lost: int
    faint: int
    vanished_thin: int


class Width(TypedDict):
    """Width of the walls of a block across their lines, mm."""

    requested: float
    mean: float | None
    p5: float | None
    p95: float | None
    samples: int


class BlockWalls(TypedDict):
    """Thickness of the walls of a block."""

    width: Width
    exact: float | None


class Thinnest(TypedDict):
    """Thickness of the thinnest hundredth, mm."""

    data: float | None
    result: float | None


class LostWall(TypedDict):
    """A piece of wall that smoothing removed."""

    voxels: int
    at: Vector


class SolidWalls(TypedDict):
    """Thickness of the walls of a solid."""

    thinnest: Thinnest
    lost: list[LostWall]


class SmoothingKeys(TypedDict):
    """Parameters of smoothing."""

    steps: int
    fidelity: float
    interface: float
    alpha: float


class BlockRequest(SmoothingKeys):
    """The request for a block."""

    pattern: str
    parameters: dict[str, Any]
    size: Vector
    height: float
    line_width: float
    stamp: str
    cells_per_line: int
    surface: str
    tolerance: float | None


class SolidRequest(SmoothingKeys):
    """The request for a solid."""

    method: str
    crumbs: float | None
    refine: bool
    level: float | str
    despeckle: float
    tolerance: float | None
    max_triangles: int | None


class SegmentationKeys(TypedDict):
    """The rule that decides which cells are solid."""

    method: str
    low: NotRequired[float | None]
    high: NotRequired[float | None]
    label: NotRequired[list[int]]
    values: list[int | float]
    solid: float


class RepairKeys(TypedDict):
    """Repairs and assumptions about a mesh."""

    components: int
    turned: int
    holes: int
    hole_share: float
    volume: float


class Input(TypedDict):
    """The input."""

    source: str
    despeckled: int
    noise: NotRequired[float]
    slices: NotRequired[int]
    coarse: NotRequired[bool]
    warnings: NotRequired[list[str]]
    several: NotRequired[bool]
    notes: NotRequired[list[str]]
    grey: NotRequired[bool]
    segmentation: NotRequired[SegmentationKeys]
    repairs: NotRequired[RepairKeys]
    points: NotRequired[int]
    shell: NotRequired[float | None]
    normals: NotRequired[bool]


class Place(TypedDict):
    """A place that was lost or added."""

    at: Vector
    area: float
    distance: float


class CrumbKeys(TypedDict):
    """Small pieces that smoothing broke off and that were removed."""

    removed: int
    volume: float
    limit: float


class VerdictKeys(TypedDict):
    """Comparison of the result with the input."""

    word: str
    changes: list[str]
    lost: list[Place]
    added: list[Place]
    crumbs: CrumbKeys
    tried: list[str]
    taken: str


# As a call, since `from` is a keyword of Python.
Distance = TypedDict(
    "Distance",
    {
        "from": str,
        "result": Distances,
        "input": Distances,
        "thin": float,
        "sheet": float,
        "hidden": float,
        "data": NotRequired[Spread],
        "points": NotRequired[PointDistances],
    },
)


class Seconds(TypedDict):
    """Seconds by stage."""

    smooth: float
    surface: float
    check: float
    total: float


class BlockSeconds(Seconds):
    """Seconds by stage for a block."""

    points: float
    stamp: float


class SolidSeconds(Seconds):
    """Seconds by stage for a solid."""

    measure: float


class Report(TypedDict):
    """Keys that the reports of blocks and solids have in common."""

    form: int
    version: str
    product: str
    triangles: int
    closed: bool
    area: float
    extents: Vector
    bounds: list[Vector]
    volume: float
    volume_change: float
    components: int
    problems: list[str]
    files: NotRequired[list[str]]
    grid: GridKeys
    topology: Topology


class MakeReport(Report):
    """The report of `infill.make`."""

    density: float
    wall_width: Width
    request: BlockRequest
    mesh: BlockMesh
    solid: BlockSolid
    changes: BlockChanges
    walls: BlockWalls
    seconds: BlockSeconds


class SmoothReport(Report):
    """The report of `infill.smooth_volume`, `infill.smooth_mesh` and `infill.smooth_points`."""

    request: SolidRequest
    input: Input
    mesh: SolidMesh
    solid: Solid
    changes: SolidChanges
    walls: SolidWalls
    verdict: VerdictKeys
    distance: Distance
    seconds: SolidSeconds


class LabelKeys(TypedDict):
    """A label and its report."""

    name: str
    number: int
    layer: int
    colour: str | None
    report: SmoothReport


class FailedLabel(TypedDict):
    """A label that could not be smoothed."""

    name: str
    number: int
    layer: int
    error: str


class LabelSeconds(TypedDict):
    """Seconds by stage for labels."""

    labels: float
    smooth: float
    total: float


class LabelsReport(TypedDict):
    """The report of `infill.smooth_labels`."""

    form: int
    version: str
    product: str
    files: NotRequired[list[str]]
    triangles: int
    closed: bool
    problems: list[str]
    request: SolidRequest
    labels: list[LabelKeys]
    failed: list[FailedLabel]
    absent: list[str]
    seconds: LabelSeconds


class ComponentKeys(TypedDict):
    """A component and its report."""

    name: str
    report: SmoothReport


class FailedComponent(TypedDict):
    """A component that could not be smoothed."""

    name: str
    error: str


class Worst(TypedDict):
    """The worst verdict of all components."""

    word: str


class ComponentSeconds(TypedDict):
    """Seconds by stage for components."""

    components: float
    smooth: float
    total: float


class ComponentsReport(TypedDict):
    """The report of `infill.smooth_mesh` with `by_component`."""

    form: int
    version: str
    product: str
    files: NotRequired[list[str]]
    triangles: int
    closed: bool
    extents: Vector
    volume: float
    volume_change: float
    problems: list[str]
    verdict: Worst
    request: SolidRequest
    components: list[ComponentKeys]
    failed: list[FailedComponent]
    sheets: int
    notes: list[str]
    seconds: ComponentSeconds


class FillMesh(TypedDict):
    """The resulting mesh."""

    vertices: int
    manifold: str
    skin: str
    tolerance: float | None


class FillSizes(TypedDict):
    """Sizes of the infill, mm."""

    cell: float
    line_width: float
    radius: float
    cells: list[float] | None
    widths: list[float] | None
    phase: Vector
    narrow: float | None
    left_out: float


class FillPart(TypedDict):
    """The part that was filled."""

    triangles: int
    volume: float
    inside: float
    components: int
    turned: int
    holes: int
    notes: list[str]


class ClosedVoid(TypedDict):
    """A void that cannot drain."""

    volume: float
    at: Vector


class FillHole(TypedDict):
    """A drain hole of a void."""

    kind: str
    at: Vector
    to: Vector
    diameter: float
    void: int
    into: int | None
    wall: float | None
    above: float


class UndrainedVoid(TypedDict):
    """A void without a drain hole."""

    void: int
    volume: float
    at: Vector
    fits: float | None


class FillDrains(TypedDict):
    """Drain holes."""

    count: int
    at: list[Vector]
    holes: list[FillHole]
    undrained: list[UndrainedVoid]
    unvented: list[UndrainedVoid]


class GradedStep(TypedDict):
    """A region of similar requested density, for densities that vary."""

    wanted: float
    density: float


class FillVoids(TypedDict):
    """Voids of the infill."""

    count: int
    open: int
    volume: float
    triangles: int
    specks: int
    islands: int
    closed: list[ClosedVoid]


class FillWalls(TypedDict):
    """Thickness of the shell, mm."""

    requested: float
    least: float | None
    at: Vector | None


class FillRequest(TypedDict):
    """The request for an infill."""

    pattern: str
    parameters: dict[str, Any]
    density: float | None
    densities: list[float] | None
    by: str | None
    grade: str | None
    cell: float | None
    line_width: float | None
    wall: float
    angle: float
    phase: Vector
    align: str
    form: str
    overlap: float
    drain: float | None
    vent: bool
    drain_at: list[Vector]
    open: str | None
    smooth_radius: float | None
    tolerance: float
    resolution: int | None
    voxel: float | None
    max_triangles: int | None


class FillSeconds(TypedDict):
    """Seconds by stage for an infill."""

    density: float
    depth: float
    voids: float
    simplify: float
    shift: float
    check: float
    total: float


class FillReport(TypedDict):
    """The report of `infill.fill`."""

    form: int
    version: str
    product: str
    files: NotRequired[list[str]]
    triangles: int
    closed: bool
    area: float
    extents: Vector
    bounds: list[Vector]
    volume: float
    density: float
    problems: list[str]
    request: FillRequest
    grid: GridKeys
    mesh: FillMesh
    infill: FillSizes
    graded: list[GradedStep]
    part: FillPart
    voids: FillVoids
    drains: FillDrains
    walls: FillWalls
    seconds: FillSeconds
