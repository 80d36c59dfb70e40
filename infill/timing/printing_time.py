"""`motion`: printing time of a file of G-code, feature by feature, and the movements of the printer."""

from __future__ import annotations

import math
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from infill.errors import FormatError
from infill.gcode.dialect import role_of
from infill.gcode.found_limits import FIELDS_BY_MODEL, FileLimits
from infill.gcode.limits import Model
from infill.gcode.sliced_file import open_sliced
from infill.pictures.picturable import Picturable
from infill.plain_numbers import count_noun
from infill.planner.feature_sums import FeatureSums
from infill.planner.open_timeline import collect_limits, open_timeline
from infill.reports.common import declare
from infill.reports.timing import MotionReport

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


@dataclass(frozen=True, kw_only=True, repr=False)
class Motion(Picturable):
    """Result of `motion`.

    The attributes are the keys of `infill.reports.timing.MotionReport`, which docs/report.md explains; lengths are in
    mm, times in s. `source` is the file that was planned.
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
    limits: dict[str, Any]
    sources: dict[str, str]
    plate: int | None = None
    plates: tuple[int, ...] = ()
    unread_lines: int = 0
    first_unread_line: int = 0
    first_unread_text: str = ""
    missing_end: str = ""
    macros: tuple[str, ...] = ()
    volumetric: bool = False
    filament_diameter: float = 1.75
    source: Path | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        """Return the time, the slicer, the layers and the filament."""
        minutes, seconds = divmod(round(self.seconds), 60)
        time = f"{minutes // 60}:{minutes % 60:02}:{seconds:02}"
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
        return draw_speeds({caption: layer_speeds(self.source, layer, self.plate, **self._given())})

    def _given(self) -> dict[str, Any]:
        """Return the limits that were given, as arguments of `motion`."""
        given = {name: self.limits[name] for name, source in self.sources.items() if source == "given"}
        return {"model": self.limits["model"], **given}

    def to_dict(self) -> MotionReport:
        """Return plain numbers and strings, as printed by ``--json``."""
        return declare(MotionReport, {name: value for name, value in asdict(self).items() if name != "source"})

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
    model: Model | Literal["junction-deviation"] | None = None,
    acceleration: float | None = None,
    jerk: float | None = None,
    junction_deviation: float | None = None,
    square_corner_velocity: float | None = None,
    minimum_cruise_ratio: float | None = None,
    plate: int | None = None,
) -> Motion:
    """Plan every move of a file of G-code as a printer's firmware does, and sum up by feature.

    The limits of the machine come from the settings and commands of the file; missing ones are assumed, and
    `Motion.sources` says so. Arguments override both, for the entire file.

    Parameters
    ----------
    path : path
        G-code as text, binary G-code, or an archive of plates (.gcode.3mf).
    model : {"jerk", "vector-jerk", "junction-deviation", "klipper"}, optional
        Bound on the speed at corners. By default that of the file, or the one implied by the limits given here. The
        report calls junction deviation "junction", and so may you.
    acceleration : float, optional
        mm/s², of printing and travel.
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

    Raises
    ------
    FormatError
        If the file is not G-code, is damaged, or has no moves.
    ParameterError
        If a limit is out of range, or the file does not have this plate.
    """
    fixed = collect_limits(
        model=model,
        acceleration=acceleration,
        jerk=jerk,
        junction_deviation=junction_deviation,
        square_corner_velocity=square_corner_velocity,
        minimum_cruise_ratio=minimum_cruise_ratio,
    )
    strokes = FeatureSums()
    with open_sliced(Path(path)) as file:
        plate = file.part(plate)
        with open_timeline(file, plate, fixed) as timeline:
            for steps, plan in timeline:
                strokes.add(steps, plan)
    strokes.finish(timeline.pause, timeline.retractions)
    if timeline.trouble and not strokes.total("length").any():
        raise FormatError(f"{Path(path)}: {timeline.trouble}")
    file_limits = timeline.found
    features = [_sum_feature(number, name, strokes) for number, name in enumerate(timeline.features)]
    return Motion(
        seconds=float(strokes.total("seconds").sum()),
        estimate=file_limits.estimate,
        slicer=file_limits.slicer,
        layers=timeline.layers,
        filament=float(strokes.total("filament").sum()),
        length=float(strokes.total("length").sum()),
        travel=float(strokes.total("travel").sum()),
        retractions=round(float(strokes.total("retractions").sum())),
        features=tuple(feature for feature in features if feature.seconds > 0),
        limits=_used_limits(file_limits),
        sources=dict(file_limits.sources),
        plate=plate,
        plates=file.plates,
        unread_lines=timeline.unread.lines,
        first_unread_line=timeline.unread.first,
        first_unread_text=timeline.unread.text,
        missing_end=file_limits.missing_end,
        macros=tuple(timeline.macros),
        volumetric=timeline.state.volumetric,
        filament_diameter=timeline.state.diameter,
        source=Path(path),
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
