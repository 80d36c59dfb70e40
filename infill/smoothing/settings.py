"""The settings of `infill smooth`: defaults, overridden by a TOML file, overridden by flags.

In the file, the options have the names that they have on the command line::

    range = [200, 900]
    smooth = "refine"
    despeckle = 20
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, cast

from infill.errors import UsageError
from infill.options.declaration import Option, by_field, by_key, drop_replaced, read_options
from infill.options.keyword_options import parse_level, parse_numbers, parse_range_text, parse_wholes
from infill.options.toml import format_rows, read_toml
from infill.options.trust import check_trusted

if TYPE_CHECKING:
    from infill.smoothing.request import Method, SmoothOptions

AUTO, REFINE, PLAIN = "auto", "refine", "plain"
FILES, LABELS, GRID, SOLID = "Files", "Every label in one run", "Grid", "What is solid"
SURFACE, RUN, ADVANCED = "Surface", "Run", "Advanced"
# Options of one solid, by key, which the labels of a segmentation do not have.
NOT_FOR_LABELS = (
    "units",
    "resolution",
    "voxel",
    "shell",
    "threshold",
    "range",
    "otsu",
    "grey",
    "keep_components",
    "by_component",
)


@dataclass(frozen=True, kw_only=True)
class SmoothSettings:
    """How to smooth, described in terms of the command line.

    Parameters
    ----------
    kind, units, array, series, frame, spacing, roi
        Options of reading the input: see `infill.smoothing.sources.read_source`.
    resolution, voxel, shell, threshold, between, label, otsu, grey, keep_components,
    by_component
        Choice of the solid and of the grid: see `infill.smooth_volume` and its siblings. `between` is ``--range``.
    each_label, labels, keep_going, together
        See `infill.smooth_labels`; `labels` is a file of names and colours.
    steps, fidelity, interface
        As in `infill.Smoothing`; None for its default.
    method, refine
        ``--smooth``, and ``--refine``, which is the same as ``--smooth refine``.
    tolerance : float, optional
        mm; 0 for all triangles, None for a tenth of a voxel.
    despeckle, smooth_radius, crumbs, level, max_triangles, allow_broken, strict
        See `infill.smooth_volume`.

    Raises
    ------
    ParameterError
        If two of them contradict each other.
    """

    kind: Annotated[
        Literal["mesh", "points", "volume"] | None,
        Option("How to read INPUT.", FILES, name="as", default="by the file"),
    ] = None
    units: Annotated[
        Literal["um", "mm", "cm", "m", "in"] | None,
        Option("Unit of a mesh or of points.", FILES, default="as in the file, or mm"),
    ] = None
    array: Annotated[str | None, Option("Name of the array, if a .npz holds several.", FILES, unit="NAME")] = None
    series: Annotated[str | None, Option("UID of the series, if a DICOM folder holds several.", FILES, unit="UID")] = (
        None
    )
    frame: Annotated[
        int | None,
        Option(
            "Which volume of a file with several, counted from 0: a frame of a series, a layer of segments.",
            FILES,
            unit="N",
        ),
    ] = None
    each_label: Annotated[
        bool,
        Option(
            "A surface for every label, named and coloured, into one .3mf or .glb; {label} or {number} in the name of "
            "an output implies it, and writes a file for each.",
            LABELS,
            negatable=True,
        ),
    ] = False
    labels: Annotated[
        Path | None,
        Option(
            "Names and colours of the labels: label descriptions of ITK-SNAP, a lookup table of FreeSurfer, a .ctbl "
            "of 3D Slicer.",
            LABELS,
            unit="FILE",
            default="as in a .seg.nrrd or a DICOM segmentation",
        ),
    ] = None
    keep_going: Annotated[
        bool,
        Option(
            "If a label fails, write the others, list what failed and exit with 1.",
            LABELS,
            negatable=True,
            default="write nothing",
        ),
    ] = False
    together: Annotated[
        bool,
        Option(
            "Smooth all labels as one: neighbours share their walls exactly, and each keeps its volume. All triangles "
            "are written.",
            LABELS,
            negatable=True,
            default="each by itself",
        ),
    ] = False
    resolution: Annotated[
        int | None,
        Option(
            "Voxels along the longest side of a mesh or of points.",
            GRID,
            unit="N",
            default="200",
            replaces=("voxel",),
        ),
    ] = None
    voxel: Annotated[
        float | None,
        Option("Voxel size instead; of a scan: larger voxels.", GRID, unit="MM", replaces=("resolution",)),
    ] = None
    spacing: Annotated[
        tuple[float, ...] | None,
        Option(
            "Voxel size of a volume: 0.9,0.9,1.5, or 1.",
            GRID,
            unit="MM,MM,MM",
            default="as in the file",
            read=partial(parse_numbers, counts=(1, 3)),
            typed=str,
        ),
    ] = None
    roi: Annotated[
        tuple[float, ...] | None,
        Option(
            "Only the part of a volume in this box, mm, where the mesh will lie (LPS for medical images). The surface "
            "is closed where the box cuts it.",
            GRID,
            unit="X0,X1,Y0,Y1,Z0,Z1",
            read=partial(parse_numbers, counts=(6,)),
            typed=str,
        ),
    ] = None
    shell: Annotated[
        float | None,
        Option("Points: a wall of this width along them, instead of the solid inside.", SOLID, unit="MM"),
    ] = None
    threshold: Annotated[
        float | None,
        Option("Values from this one upwards are solid.", SOLID, unit="VALUE", replaces=("range", "label", "otsu")),
    ] = None
    between: Annotated[
        tuple[float, ...] | None,
        Option(
            "Values between these two are solid.",
            SOLID,
            unit="LOW,HIGH",
            name="range",
            read=partial(parse_numbers, counts=(2,)),
            typed=str,
            replaces=("threshold", "label", "otsu"),
        ),
    ] = None
    label: Annotated[
        tuple[int, ...] | None,
        Option(
            "Cells with this label are solid. May be given again.",
            SOLID,
            unit="N",
            read=parse_wholes,
            typed=list[int],
            replaces=("threshold", "range", "otsu"),
        ),
    ] = None
    otsu: Annotated[
        bool,
        Option(
            "Find the threshold from the values (Otsu's method).",
            SOLID,
            negatable=True,
            replaces=("threshold", "range", "label"),
        ),
    ] = False
    grey: Annotated[
        bool | None,
        Option(
            "Keep the grey levels around the threshold, which show where between two voxels the surface lies.",
            SOLID,
            default="if there are any, and little noise",
            negatable=True,
        ),
    ] = None
    by_component: Annotated[
        bool,
        Option(
            "Smooth each component of a mesh by itself: what overlaps or touches stays apart. A .3mf or .glb names "
            "them.",
            SOLID,
            negatable=True,
        ),
    ] = False
    keep_components: Annotated[
        str | None,
        Option(
            "Only these components of a scan or mesh, counted from 1, the largest first: 1,3-5 or 2-.",
            SOLID,
            unit="N,N-N",
            default="all",
            read=parse_range_text,
            typed=str,
        ),
    ] = None
    despeckle: Annotated[
        float, Option("First remove components up to this volume.", SOLID, unit="MM3", default="0")
    ] = 0.0
    steps: Annotated[
        int,
        Option(
            "Smoothing steps: more are smoother; 30 suit medical data.",
            SURFACE,
            unit="N",
            default="20",
            replaces=("smooth_radius",),
        ),
    ] = 20
    method: Annotated[
        Literal["auto", "plain", "refine", "grey"],
        Option(
            "auto: by the data; plain: for noise; refine: keeps edges and thin walls; "
            "grey: keeps the grey levels of a scan, too.",
            SURFACE,
            name="smooth",
            default="auto",
            replaces=("refine", "fidelity"),
        ),
    ] = "auto"
    refine: Annotated[
        bool,
        Option("The same as --smooth refine.", SURFACE, negatable=True, replaces=("smooth", "fidelity")),
    ] = False
    smooth_radius: Annotated[
        float | None,
        Option(
            "Instead of steps: how far smoothing reaches, as the radius of a Gaussian blur.",
            SURFACE,
            unit="MM",
            replaces=("steps",),
        ),
    ] = None
    crumbs: Annotated[
        float | None,
        Option("Remove pieces up to this volume that smoothing broke off.", SURFACE, unit="MM3", default="8 voxels"),
    ] = None
    fidelity: Annotated[
        float | None,
        Option(
            "How strongly the data hold, 0 to 1 or more; not with --refine.",
            ADVANCED,
            unit="NUMBER",
            default="0.01",
            replaces=("smooth", "refine"),
        ),
    ] = None
    interface: Annotated[
        float, Option("Distance from the surface to phi = 0.9.", ADVANCED, unit="VOXELS", default="2")
    ] = 2.0
    level: Annotated[
        Literal["volume"] | float,
        Option(
            "Where the surface lies. volume: each part keeps its volume; 0: at phi = 0, as in the paper, "
            "which shrinks.",
            ADVANCED,
            unit="volume|NUMBER",
            default="volume",
            read=parse_level,
            typed=str,
        ),
    ] = "volume"
    tolerance: Annotated[
        float | None,
        Option(
            "Simplify the mesh: move it by at most this; 0 for all triangles.",
            SURFACE,
            unit="MM",
            default="0.1 voxels",
        ),
    ] = None
    max_triangles: Annotated[
        int | None, Option("Simplify the mesh to at most this many triangles.", SURFACE, unit="N")
    ] = None
    allow_broken: Annotated[bool, Option("Write the mesh even if something is lost.", RUN, negatable=True)] = False
    strict: Annotated[
        bool,
        Option("Try no remedies, and refuse whatever breaks, fuses or vanishes.", RUN, negatable=True),
    ] = False

    def __post_init__(self) -> None:
        """Raise ParameterError for options that contradict each other."""
        if self.refine and self.method not in (AUTO, REFINE):
            raise UsageError.about("refine", f"is smooth = refine, and smooth is {self.method}; leave one of them out")
        if self.fidelity is not None and (self.refine or self.method not in (AUTO, PLAIN)):
            raise UsageError.about("fidelity", "is for smooth = plain alone; leave one of them out")

    @property
    def chosen_method(self) -> Method:
        """Method of smoothing: a fidelity implies the plain method."""
        return cast("Method", REFINE if self.refine else self.method if self.fidelity is None else PLAIN)

    @property
    def reading(self) -> dict[str, Any]:
        """Keywords of `read_source`: how to read the input."""
        return {name: getattr(self, name) for name in ("kind", "units", "array", "series", "frame", "spacing", "roi")}

    @property
    def choice(self) -> dict[str, Any]:
        """Keywords of `infill.smoothing.sources.smooth_source`: the choice of the solid and of the grid."""
        from infill.smoothing.sources import CHOICES

        return {name: getattr(self, name) for name in CHOICES}

    @property
    def options(self) -> SmoothOptions:
        """Options that all smoothing functions share, by the names that these have."""
        from infill.phasefield.allen_cahn import Smoothing
        from infill.smoothing.request import SmoothOptions

        shared = {name: value for name, value in vars(self).items() if name in SmoothOptions.__annotations__}
        fidelity = {} if self.fidelity is None else {"fidelity": self.fidelity}
        shared |= {
            "smoothing": Smoothing(steps=self.steps, interface=self.interface, **fidelity),
            "method": self.chosen_method,
            "refine": None,  # `method` says it
            "radius": self.smooth_radius,
            "tolerance": "auto" if self.tolerance is None else self.tolerance,
        }
        return cast("SmoothOptions", shared)

    def check(self) -> None:
        """Raise ParameterError for options that suit no input."""
        from infill.smoothing.request import SmoothRequest

        SmoothRequest(**self.options)

    def to_toml(self) -> str:
        """Return all settings, defaults included, as a TOML document that `resolve` reads back."""
        labels = None if self.labels is None else str(self.labels)
        values = {**by_key(self), "labels": labels}
        if self.smooth_radius is not None:
            del values["steps"]  # which the radius replaces
        rows = format_rows(values)
        return "\n".join(["# infill smooth INPUT --config THIS_FILE -o OUT", *rows, ""])


def _refuse_both(values: dict[str, Any]) -> dict[str, Any]:
    """Return the options of one source; raise UsageError if they have both steps and the radius that replaces them."""
    if "steps" in values and "smooth_radius" in values:
        raise UsageError.about(
            ("steps", "smooth_radius"), "are both given, and each decides the other; give one of them"
        )
    return values


def resolve(typed: Mapping[str, Any], config: Path | None = None, *, trust: bool = False) -> SmoothSettings:
    """Return the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    typed : mapping
        Options by their names on the command line.
    config : Path, optional
        A TOML file.
    trust : bool
        Whether the file may name files from elsewhere: see `infill.options.trust`.

    Raises
    ------
    ParameterError
        If a name is unknown, a value is of the wrong type, or two options contradict each other.
    FormatError
        If the file is missing or not TOML.
    """
    typed = _refuse_both(read_options("smooth", SmoothSettings, typed))
    filed: dict[str, Any] = {}
    if config:
        read = read_toml(config, example="threshold = 226")
        check_trusted(
            {name: value for name, value in read.items() if name not in typed}, config, trust=trust, code=False
        )
        filed = drop_replaced(SmoothSettings, typed, _refuse_both(read_options("smooth", SmoothSettings, read)))
    return SmoothSettings(**by_field(SmoothSettings, {**filed, **typed}))
