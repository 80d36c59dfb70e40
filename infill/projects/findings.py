"""Findings of the doctor of projects: volumes that a slicer prints, problems, and warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

from infill.files.excerpts import excerpt
from infill.surface import Surface

LONGEST = 1000  # signs of a sentence or a value

# Settings by which walls of volumes differ: a modifier with one of them gets its own walls all around.
WALL_KEYS = {
    "PrusaSlicer": {
        "perimeters",
        "perimeter_extruder",
        "perimeter_speed",
        "external_perimeter_speed",
        "perimeter_extrusion_width",
        "external_perimeter_extrusion_width",
        "external_perimeters_first",
        "extra_perimeters",
        "gap_fill_enabled",
        "gap_fill_speed",
        "infill_overlap",
        "overhangs",
        "thin_walls",
    },
    "Bambu": {
        "wall_filament",
        "wall_loops",
        "inner_wall_speed",
        "outer_wall_speed",
        "small_perimeter_speed",
        "gap_infill_speed",
        "filter_out_gap_fill",
        "detect_overhang_wall",
        "wall_direction",
        "inner_wall_line_width",
        "outer_wall_line_width",
        "detect_thin_wall",
        "infill_wall_overlap",
        "fuzzy_skin",
    },
}


class Severity(Enum):
    """The severity of a finding."""

    PROBLEM = "problem"
    WARNING = "warning"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """A sentence, and its severity."""

    kind: Severity
    text: str


@dataclass(frozen=True, kw_only=True)
class PrintedVolume:
    """A mesh that a slicer lists by name.

    The attributes are the keys of `infill.reports.checking.VolumeKeys`, which docs/report.md explains.
    """

    name: str
    role: str
    triangles: int
    closed: bool
    outward: bool
    shared: int
    settings: Mapping[str, str]

    @classmethod
    def of(cls, name: str, mesh: Surface, role: str, settings: Mapping[str, str]) -> PrintedVolume:
        """Measure a mesh and describe it as a volume."""
        edges = mesh.edges
        return cls(
            name=excerpt(name),
            role=excerpt(role),
            triangles=len(mesh.faces),
            closed=edges is not None and not edges.surplus.any(),
            outward=edges is not None and mesh.volume > 0,
            shared=0 if edges is None else int((edges.faces > 2).sum()),
            settings={excerpt(key): excerpt(value, LONGEST) for key, value in settings.items()},
        )

    @property
    def prints(self) -> bool:
        """True if the volume is solid by itself."""
        return self.role == "part"


def as_problem(text: str) -> Finding:
    """Wrap a text as a problem: the slicer loses or refuses something."""
    return Finding(kind=Severity.PROBLEM, text=excerpt(text, LONGEST))


def as_warning(text: str) -> Finding:
    """Wrap a text as a warning: the slicer does something surprising."""
    return Finding(kind=Severity.WARNING, text=excerpt(text, LONGEST))


def check_fill_settings(
    name: str, settings: Mapping[str, str], density: str, known: set[str], slicer: str
) -> Iterator[Finding]:
    """Yield findings about the density of a volume, and about names of settings that the slicer does not know."""
    value = settings.get(density)
    if value is not None:
        try:
            share = float(value.removesuffix("%"))
        except ValueError:
            share = float("nan")
        if not 0 <= share <= 100:
            yield as_problem(f"{density} of {name} is {value!r}; it must be a share from 0% to 100%")
        elif not value.endswith("%"):
            yield as_warning(f"{density} of {name} is {value!r}, without a % sign: older versions read 0.5 as 50%")
    for key in settings:
        if key not in known:
            yield as_warning(f"{key} of {name} is not a volume setting that {slicer} is known to read: it is ignored")


def check_shells(
    volumes: list[PrintedVolume], common: Mapping[str, str], keys: tuple[str, str], slicer: str, again: str
) -> Iterator[Finding]:
    """Yield findings on parts around an infill: 0% density, or below 1% with a limit that fills small rooms.

    Parameters
    ----------
    volumes : list of PrintedVolume
    common : mapping of str to str
        Settings of the object, which hold where a volume has none of its own.
    keys : (str, str)
        The names of the density, and of the area below which infill is solid.
    slicer, again : str
        The name of the slicer, and what ``--for`` takes for it.

    Yields
    ------
    Finding
    """
    density, area = keys
    if not any(volume.role == "modifier" for volume in volumes):
        return
    for volume in volumes:
        settings = {**common, **volume.settings}
        try:
            share = float(settings.get(density, "nan").removesuffix("%"))
            island = float(settings.get(area, "nan"))
        except ValueError:
            continue  # `of_filling` reports a density that is no number
        if not volume.prints:
            continue
        if share == 0:
            yield as_problem(
                f"{density} of {volume.name} is {settings[density]}: {slicer} takes the part for a vase, and slopes "
                f"and domes may lose their solid layers; make it again with --for {again}, or set 0.1% and {area} 0"
            )
        elif 0 < share < 1 and island != 0:
            yield as_warning(
                f"{volume.name} does not set {area} to 0: {slicer} fills small rooms between walls of the infill to "
                f"the full; make it again with --for {again}, or set {area} 0"
            )


def check_order(volumes: list[PrintedVolume]) -> Iterator[Finding]:
    """Yield the modifiers that come before the part that they are to change."""
    last_part = max((number for number, volume in enumerate(volumes) if volume.prints), default=-1)
    for volume in volumes[: max(last_part, 0)]:
        if volume.role == "modifier":
            yield as_problem(
                f"{volume.name} comes before {volumes[last_part].name}, which takes its place: it is lost; put it last"
            )
        elif volume.role == "negative":
            yield as_problem(
                f"{volume.name} comes before {volumes[last_part].name}, so it takes nothing off that part; put it last"
            )


def check_modifier_walls(volumes: list[PrintedVolume], keys: set[str]) -> Iterator[Finding]:
    """Yield the modifiers that get their own walls."""
    for volume in volumes:
        if volume.role == "modifier" and (wall_keys := sorted(keys & set(volume.settings))):
            yield as_warning(
                f"{volume.name} changes {', '.join(wall_keys)}: walls are made around all of it, as if it were a part"
            )
