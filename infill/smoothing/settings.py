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
from typing import TYPE_CHECKING, Any, cast

from infill.errors import ParameterError
from infill.options.keyword_options import (
    Reader,
    parse_flag,
    parse_level,
    parse_number,
    parse_numbers,
    parse_options,
    parse_whole,
    parse_wholes,
    parse_word,
)
from infill.options.toml import read_toml, write_rows
from infill.options.trust import check_trusted

if TYPE_CHECKING:
    from infill.smoothing.request import LevelMethod, Method, SmoothOptions

AUTO, REFINE, PLAIN = "auto", "refine", "plain"
# Options that exclude each other: a flag on the command line drops its rivals in the file.
RIVALS = (
    ("threshold", "range", "label", "otsu"),
    ("resolution", "voxel"),
    ("steps", "smooth_radius"),
    ("smooth", "refine", "fidelity"),
)
FIELDS = {"as": "kind", "range": "between", "smooth": "method"}  # names that Python reserves, or that say too little


@dataclass(frozen=True, kw_only=True)
class SmoothSettings:
    """How to smooth, described in terms of the command line.

    Parameters
    ----------
    kind, units, array, series, frame, spacing, roi
        Options of reading the input: see `infill.smoothing.sources.read_source`.
    resolution, voxel, shell, threshold, between, label, otsu, grey, by_component
        Choice of the solid and of the grid: see `infill.smooth_volume` and its siblings. `between` is ``--range``.
    each_label, labels, keep_going
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

    kind: str | None = None
    units: str | None = None
    array: str | None = None
    series: str | None = None
    frame: int | None = None
    spacing: tuple[float, ...] | None = None
    roi: tuple[float, ...] | None = None
    resolution: int | None = None
    voxel: float | None = None
    shell: float | None = None
    threshold: float | None = None
    between: tuple[float, ...] | None = None
    label: tuple[int, ...] | None = None
    otsu: bool = False
    grey: bool = False
    by_component: bool = False
    each_label: bool = False
    labels: Path | None = None
    keep_going: bool = False
    despeckle: float = 0.0
    steps: int = 20
    method: str = AUTO
    refine: bool = False
    smooth_radius: float | None = None
    crumbs: float | None = None
    fidelity: float | None = None
    interface: float = 2.0
    level: LevelMethod = "volume"
    tolerance: float | None = None
    max_triangles: int | None = None
    allow_broken: bool = False
    strict: bool = False

    def __post_init__(self) -> None:
        """Raise ParameterError for options that contradict each other."""
        if self.refine and self.method not in (AUTO, REFINE):
            raise ParameterError(f"refine is smooth = refine, and smooth is {self.method}; leave one of them out")
        if self.fidelity is not None and (self.refine or self.method not in (AUTO, PLAIN)):
            raise ParameterError("fidelity is for smooth = plain alone; leave one of them out")

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
        names = ("resolution", "voxel", "shell", "threshold", "between", "label", "otsu", "grey", "by_component")
        return {name: getattr(self, name) for name in names}

    @property
    def options(self) -> SmoothOptions:
        """Options that all smoothing functions share."""
        from infill.phasefield.allen_cahn import Smoothing

        fidelity = {} if self.fidelity is None else {"fidelity": self.fidelity}
        return {
            "smoothing": Smoothing(steps=self.steps, interface=self.interface, **fidelity),
            "method": self.chosen_method,
            "radius": self.smooth_radius,
            "crumbs": self.crumbs,
            "strict": self.strict,
            "level": self.level,
            "despeckle": self.despeckle,
            "allow_broken": self.allow_broken,
            "tolerance": "auto" if self.tolerance is None else self.tolerance or None,
            "max_triangles": self.max_triangles,
        }

    def check(self) -> None:
        """Raise ParameterError for options that suit no input."""
        from infill.smoothing.request import SmoothRequest

        SmoothRequest(**self.options)

    def to_toml(self) -> str:
        """Return all settings, defaults included, as a TOML document that `resolve` reads back."""
        plain = {name: getattr(self, FIELDS.get(name, name)) for name in READERS}
        plain["labels"] = None if self.labels is None else str(self.labels)
        return "\n".join(["# infill smooth INPUT --config THIS_FILE -o OUT", *write_rows(plain), ""])


def resolve(flags: Mapping[str, Any], config: Path | None = None, *, trust: bool = False) -> SmoothSettings:
    """Return the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    flags : mapping
        Options by their names on the command line; None counts as absent.
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
    typed = parse_options("smooth", READERS, {name: value for name, value in flags.items() if value is not None})
    read = read_toml(config, example="threshold = 226") if config else {}
    if config:
        check_trusted(
            {name: value for name, value in read.items() if name not in typed}, config, trust=trust, code=False
        )
    filed = parse_options("smooth", READERS, read)
    for rivals in RIVALS:
        if any(typed.get(name, False) is not False for name in rivals):  # a flag that is off excludes nothing
            filed = {name: value for name, value in filed.items() if name not in rivals}
    return SmoothSettings(**{FIELDS.get(name, name): value for name, value in {**filed, **typed}.items()})


def _path(name: str, value: object) -> Path:
    return value if isinstance(value, Path) else Path(parse_word(name, value))


READERS: Mapping[str, Reader] = {
    "as": parse_word,
    "units": parse_word,
    "array": parse_word,
    "series": parse_word,
    "frame": parse_whole,
    "spacing": partial(parse_numbers, counts=(1, 3)),
    "roi": partial(parse_numbers, counts=(6,)),
    "resolution": parse_whole,
    "voxel": parse_number,
    "shell": parse_number,
    "threshold": parse_number,
    "range": partial(parse_numbers, counts=(2,)),
    "label": parse_wholes,
    "otsu": parse_flag,
    "grey": parse_flag,
    "by_component": parse_flag,
    "each_label": parse_flag,
    "labels": _path,
    "keep_going": parse_flag,
    "despeckle": parse_number,
    "steps": parse_whole,
    "smooth": parse_word,
    "refine": parse_flag,
    "smooth_radius": parse_number,
    "crumbs": parse_number,
    "fidelity": parse_number,
    "interface": parse_number,
    "level": parse_level,
    "tolerance": parse_number,
    "max_triangles": parse_whole,
    "allow_broken": parse_flag,
    "strict": parse_flag,
}
