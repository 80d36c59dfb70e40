"""`motion`: printing time of a file of G-code, feature by feature, and the movements of the printer."""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from infill.errors import FormatError
from infill.gcode.dialect import role_of
from infill.gcode.found_limits import FileLimits
from infill.gcode.given_limits import GivenLimits
from infill.gcode.limits import FIELDS_BY_MODEL, Model
from infill.gcode.printer_limits import LimitNote
from infill.gcode.sliced_file import SlicedFile, open_sliced
from infill.pictures.picturable import Picturable
from infill.plain_numbers import count_noun, plain_clock
from infill.planner.feature_sums import FeatureSums
from infill.planner.layer_sums import LayerSums, neighbour_spread
from infill.planner.open_timeline import collect_given, make_timeline
from infill.planner.print_clock import ElapsedTimes
from infill.planner.timeline import Timeline
from infill.reports.common import declare
from infill.reports.timing import MotionReport
from infill.timing.restating import (
    TimeEdits,
    TimeStatements,
    check_written,
    edit_times,
    find_time_statements,
    write_times,
)

if TYPE_CHECKING:
    from PIL import Image


@dataclass(frozen=True, kw_only=True)
class FeatureMotion:
    """Time and movements of one feature, including travel, retractions and pauses before it.

    The attributes are the keys of `infill.reports.timing.FeatureKeys`, which docs/report.md explains.
    """

    name: str
    role: str
    seconds: float
    drawing_seconds: float
    filament: float
    length: float
    travel: float
    paths: int
    segments: int
    retractions: int
    turns: int
    turning: float
    median_segment: float | None
    short_segments: float | None
    peak_flow: float


@dataclass(frozen=True, kw_only=True)
class LayerTimes:
    """Seconds and filament of every layer; the attributes are the keys of `LayerTimeKeys`."""

    seconds: tuple[float, ...]
    filament: tuple[float, ...]
    seconds_spread: float
    filament_spread: float


@dataclass(frozen=True, kw_only=True)
class WrittenTimes:
    """A print that was written with the planned time; the attributes are the keys of `WrittenKeys`."""

    file: str
    statements: int


NOT_REPORTED = ("source", "arguments")


@dataclass(frozen=True, kw_only=True, repr=False)
class Motion(Picturable):
    """Result of `motion`.

    The attributes are the keys of `infill.reports.timing.MotionReport`, which docs/report.md explains; lengths are in
    mm, times in s. `source` is the file that was planned, and `arguments` are those that it was planned with.
    """

    seconds: float
    estimate: float | None
    slicer: str
    layers: int
    filament: float
    length: float
    travel: float
    retractions: int
    features: tuple[FeatureMotion, ...]
    by_layer: LayerTimes
    limits: dict[str, Any]
    sources: dict[str, str]
    plate: int | None = None
    plates: tuple[int, ...] = ()
    unread_lines: int = 0
    first_unread_line: int = 0
    first_unread_text: str = ""
    missing_end: str = ""
    macros: tuple[str, ...] = ()
    macro_seconds: dict[str, float] = field(default_factory=dict)
    printer: str = ""
    notes: tuple[LimitNote, ...] = ()
    written: WrittenTimes | None = None
    volumetric: bool = False
    filament_diameter: float = 1.75
    source: Path | None = field(default=None, compare=False)
    arguments: Mapping[str, Any] = field(default_factory=dict, compare=False)

    def __repr__(self) -> str:
        """Return the time, the slicer, the layers and the filament."""
        time = plain_clock(self.seconds)
        slicer = self.slicer or "unknown slicer"
        return f"Motion({time}, {slicer}, {count_noun(self.layers, 'layer')}, {self.filament / 1000:.2f} m of filament)"

    def picture(self) -> Image.Image:
        """Return the layer in the middle, coloured by speed; raise FormatError without a file."""
        from infill.pictures.speeds import draw_speeds
        from infill.planner.layer_speeds import layer_speeds

        if self.source is None or not self.source.is_file():
            raise FormatError("the file that was planned is gone; plan it again")
        layer = max(self.layers // 2, 1)
        caption = f"{self.source.name}, layer {layer}"
        return draw_speeds({caption: layer_speeds(self.source, layer, self.plate, **self.arguments)})

    def to_dict(self) -> MotionReport:
        """Return plain numbers and strings, as printed by ``--json``."""
        plain = asdict(replace(self, source=None, arguments={}))
        return declare(MotionReport, {name: value for name, value in plain.items() if name not in NOT_REPORTED})

    def of_role(self, role: str) -> float:
        """Return the seconds of all features of a role.

        Parameters
        ----------
        role : str
            Such as "sparse infill".
        """
        return sum(feature.seconds for feature in self.features if feature.role == role)


def motion(
    path: str | os.PathLike[str],
    *,
    printer: str | os.PathLike[str] | None = None,
    limits: Mapping[str, float | str] | str | Sequence[str] | None = None,
    macros: Mapping[str, float | str] | str | Sequence[str] | None = None,
    model: Model | Literal["junction-deviation"] | None = None,
    acceleration: float | None = None,
    jerk: float | None = None,
    junction_deviation: float | None = None,
    square_corner_velocity: float | None = None,
    minimum_cruise_ratio: float | None = None,
    plate: int | None = None,
    write: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
) -> Motion:
    """Plan every move of a file of G-code as a printer's firmware does, and sum up by feature.

    The limits of the machine come from the printer's own file (`printer`), or else from the settings of the slicer;
    commands in the file then change them. Missing ones are assumed, and `Motion.sources` says so.

    Parameters
    ----------
    path : path
        G-code as text, binary G-code, or an archive of plates (.gcode.3mf).
    printer : path, optional
        Klipper's printer.cfg, an answer of Moonraker as JSON, or Marlin's answer to M503.
    limits : mapping, str or sequence of str, optional
        Limits of the printer by name, in place of those in its file: {"max_accel": 3000}, or "max_accel=3000,jerk=8".
        docs/motion.md lists the names. mm/s, mm/s² and mm; commands in the file change them.
    macros : mapping, str or sequence of str, optional
        Time of each call of a macro or command, s: {"START_PRINT": 45}, or "START_PRINT=45s".
    model : {"jerk", "vector-jerk", "junction-deviation", "klipper"}, optional
        Bound on the speed at corners. By default that of the file, or the one implied by the limits given here. The
        report calls junction deviation "junction", and so may you.
    acceleration : float, optional
        mm/s², of printing and travel; like the following, for the entire file, whatever its commands say.
    jerk : float, optional
        mm/s, of x and y.
    junction_deviation : float, optional
        mm
    square_corner_velocity : float, optional
        mm/s
    minimum_cruise_ratio : float, optional
        From 0 to less than 1.
    plate : int, optional
        Plate of an archive; by default the first that has G-code.
    write : path, optional
        File to write: the print with its statements of time (M73, comments) as planned, and every other byte the same.
        Of an archive, those of all plates, or of the one that was named.
    overwrite : bool
        Whether `write` may replace a file, such as the print itself.

    Raises
    ------
    FormatError
        If the file is not G-code, is damaged, or has no moves; or the printer's file cannot be read.
    ParameterError
        If a limit is unknown or out of range, or the file does not have this plate.
    OutputError
        If the file cannot be written.
    """
    arguments: dict[str, Any] = {
        "printer": printer,
        "limits": limits,
        "macros": macros,
        "model": model,
        "acceleration": acceleration,
        "jerk": jerk,
        "junction_deviation": junction_deviation,
        "square_corner_velocity": square_corner_velocity,
        "minimum_cruise_ratio": minimum_cruise_ratio,
    }
    arguments = {name: value for name, value in arguments.items() if value is not None}
    source = Path(path)
    given = collect_given(**arguments)
    with open_sliced(source) as file, contextlib.ExitStack() as texts:
        target = None if write is None else check_written(source, Path(write), overwrite=overwrite)
        parts = file.parts if write is not None and plate is None else (file.part_of_plate(plate),)
        plans = [_plan_part(file, part, given, texts, target) for part in parts]
        written = None
        if target is not None:
            edits = {part: plan.edits for part, plan in zip(parts, plans, strict=True) if plan.edits is not None}
            write_times(source, file, target, edits)
            written = WrittenTimes(file=str(write), statements=sum(part.statements for part in edits.values()))
        return _sum_up(
            plans[0],
            plate=parts[0],
            plates=file.plates,
            printer="" if printer is None else os.fspath(printer),
            written=written,
            source=source,
            arguments=arguments,
        )


@dataclass(frozen=True, kw_only=True)
class _PartPlan:
    """The plan of one print of a file, and its new statements of time if they are to be written."""

    sums: FeatureSums
    layers: LayerSums
    timeline: Timeline
    edits: TimeEdits | None


def _plan_part(
    file: SlicedFile, part: int | None, given: GivenLimits, texts: contextlib.ExitStack, target: Path | None
) -> _PartPlan:
    """Plan one of the prints of a file; its text stays open for the statements of time that are to be written."""
    sliced = texts.enter_context(file.text(part, None if target is None else target.parent))
    statements = TimeStatements() if target is None else find_time_statements(sliced.text)
    timeline = make_timeline(sliced, given=given)
    sums, elapsed, layers = FeatureSums(), ElapsedTimes(statements.places), LayerSums()
    for steps, plan in timeline:
        sums.add(steps, plan)
        elapsed.add(steps, plan)
        layers.add(steps, plan)
    sums.finish(timeline.pause, timeline.retractions)
    if timeline.trouble and not sums.total("length").any():
        raise FormatError(timeline.trouble)
    edits = None
    if target is not None:
        seconds = float(sums.total("seconds").sum())
        edits = edit_times(sliced, statements, seconds, elapsed.first_layer, elapsed.finish().tolist())
    return _PartPlan(sums=sums, layers=layers, timeline=timeline, edits=edits)


def _sum_up(plan: _PartPlan, **facts: Any) -> Motion:  # noqa: ANN401 - attributes of a Motion
    """Return the result for one print, with facts about its file."""
    sums, timeline = plan.sums, plan.timeline
    file_limits = timeline.found
    features = [_sum_feature(number, name, sums) for number, name in enumerate(timeline.features)]
    absent = [name for name in file_limits.macro_seconds if name not in timeline.macro_seconds]
    return Motion(
        seconds=float(sums.total("seconds").sum()),
        estimate=file_limits.estimate,
        slicer=file_limits.slicer,
        layers=timeline.layers,
        filament=float(sums.total("filament").sum()),
        length=float(sums.total("length").sum()),
        travel=float(sums.total("travel").sum()),
        retractions=round(float(sums.total("retractions").sum())),
        features=tuple(feature for feature in features if feature.seconds > 0),
        by_layer=_layer_times(plan.layers),
        limits=_used_limits(file_limits),
        sources=dict(file_limits.sources),
        unread_lines=timeline.unread.lines,
        first_unread_line=timeline.unread.first,
        first_unread_text=timeline.unread.text,
        missing_end=file_limits.missing_end,
        macros=tuple(timeline.macros),
        macro_seconds=dict(timeline.macro_seconds),
        notes=(*file_limits.notes, *(LimitNote(name=name, note="has a time, and no line calls it") for name in absent)),
        volumetric=timeline.state.volumetric,
        filament_diameter=timeline.state.diameter,
        **facts,
    )


def _layer_times(layers: LayerSums) -> LayerTimes:
    """Return seconds, filament and spread of the layers from the first on."""
    seconds, filament = layers.seconds[1:].tolist(), layers.filament[1:].tolist()
    return LayerTimes(
        seconds=tuple(seconds),
        filament=tuple(filament),
        seconds_spread=neighbour_spread(seconds),
        filament_spread=neighbour_spread(filament),
    )


def _sum_feature(number: int, name: bytes, strokes: FeatureSums) -> FeatureMotion:
    """Return time, lengths and counts of one feature as `FeatureMotion`."""
    row = {
        column: float(strokes.total(column)[number]) if number < len(strokes.sums) else 0.0
        for column in ("seconds", "drawing", "filament", "length", "travel", "turning", "short")
    }
    counts = {
        column: round(float(strokes.total(column)[number])) if number < len(strokes.sums) else 0
        for column in ("paths", "segments", "retractions", "turns")
    }
    return FeatureMotion(
        name=name.decode("utf-8", "replace"),
        role=role_of(name),
        seconds=row["seconds"],
        drawing_seconds=row["drawing"],
        filament=row["filament"],
        length=row["length"],
        travel=row["travel"],
        **counts,
        turning=math.degrees(row["turning"]) / row["length"] if row["length"] else 0.0,
        median_segment=strokes.median_length(number) if counts["segments"] else None,
        short_segments=row["short"] / counts["segments"] if counts["segments"] else None,
        peak_flow=float(strokes.flow[number]) if number < len(strokes.flow) else 0.0,
    )


def _used_limits(file_limits: FileLimits) -> dict[str, Any]:
    """Return the limits of the model, as plain numbers."""
    limits = file_limits.limits
    values = {name: getattr(limits, name) for name in FIELDS_BY_MODEL[limits.model]}
    plain = {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()}
    return {"model": limits.model, **plain, "travel_acceleration": limits.travel_acceleration}
