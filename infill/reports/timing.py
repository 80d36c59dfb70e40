"""The reports of `infill motion`: of one print, and of two."""

from __future__ import annotations

from typing import Annotated, NotRequired, TypedDict

# Numbers for x, y, z and e.
Axes = Annotated[list[float], 4]


class FeatureKeys(TypedDict):
    """Features by name in the order of the file, each with the travel, retractions and pauses before it."""

    name: Annotated[str, "Name by the slicer; empty before the first"]
    role: Annotated[str, "Role, the same for all slicers: `sparse infill`, `external perimeter`, … or `other`"]
    seconds: Annotated[float, "Time, s"]
    drawing_seconds: Annotated[float, "Time in which filament is laid, s"]
    filament: Annotated[float, "Filament, mm"]
    length: Annotated[float, "Length that is laid, mm"]
    travel: Annotated[float, "Length of travel, mm"]
    paths: Annotated[int, "Number of paths: runs of lines without a gap"]
    segments: Annotated[int, "Number of segments"]
    retractions: Annotated[int, "Number of retractions"]
    turns: Annotated[int, "Number of turns by more than 30° within a path"]
    turning: Annotated[float, "Turning, degrees per mm"]
    median_segment: Annotated[float | None, "Median length of a segment, mm, to 0.6 %; null where nothing is laid"]
    short_segments: Annotated[float | None, "Share of segments under 0.1 mm; null where nothing is laid"]
    peak_flow: Annotated[float, "Largest flow in segments of 0.1 mm and more, mm³/s"]


class LimitKeys(TypedDict):
    """Limits of the machine at the end of the file, as far as the model uses them."""

    model: Annotated[str, "Bound on the speed at corners: `jerk`, `vector-jerk`, `junction` or `klipper`"]
    feedrate: Annotated[Axes, "Largest speed of x, y, z and e, mm/s"]
    axis_acceleration: Annotated[Axes, "Largest acceleration of x, y, z and e, mm/s²"]
    acceleration: Annotated[float, "Acceleration of moves that extrude, mm/s²"]
    travel_acceleration: Annotated[float, "Acceleration of travel, mm/s²"]
    jerk: NotRequired[
        Annotated[Axes, "Models `jerk` and `vector-jerk`: largest jump of the speed of x, y, z and e, mm/s"]
    ]
    junction_deviation: NotRequired[Annotated[float, "Model `junction`: junction deviation, mm"]]
    square_corner_velocity: NotRequired[Annotated[float, "Model `klipper`: speed at a corner of 90°, mm/s"]]
    minimum_cruise_ratio: NotRequired[Annotated[float, "Model `klipper`: least share of a move at constant speed"]]
    corner_extrusion_velocity: NotRequired[
        Annotated[float, "Model `klipper`: largest jump of the speed of filament between moves, mm/s"]
    ]


class LayerTimeKeys(TypedDict):
    """Every layer, from the slicer's mark to the next, in the order of the file, and how much neighbours differ."""

    seconds: Annotated[tuple[float, ...], "Time of each layer, s"]
    filament: Annotated[tuple[float, ...], "Filament that each layer lays, mm"]
    seconds_spread: Annotated[float, "Standard deviation of the difference in time between neighbouring layers, s"]
    filament_spread: Annotated[float, "The same of the filament, mm"]


class NoteKeys(TypedDict):
    """Limits that the printer states, or that were given, and the plan does not follow or had to assume."""

    name: Annotated[str, "The limit, as the printer spells it, such as `[extruder] pressure_advance`"]
    note: Annotated[str, "The rest of the sentence: why it is not followed, or what is assumed"]


class WrittenKeys(TypedDict):
    """The print that was written with the planned time."""

    file: Annotated[str, "Name of the file"]
    statements: Annotated[int, "Number of lines and values that state time, such as `M73`; 0 if the print states none"]


class MotionReport(TypedDict):
    """The report of `infill.motion`: `Motion.to_dict`."""

    file: NotRequired[Annotated[str, "Name of the file; from the command line only"]]
    seconds: Annotated[float, "Time of the entire file without heating, homing and tool changes, s"]
    estimate: Annotated[float | None, "Estimate of the slicer in the file, s"]
    slicer: Annotated[str, "Name and version of the slicer; empty if unknown"]
    layers: Annotated[int, "Number of layers"]
    filament: Annotated[float, "Filament, mm"]
    length: Annotated[float, "Length that is laid, mm"]
    travel: Annotated[float, "Length of travel, mm"]
    retractions: Annotated[int, "Number of retractions"]
    features: tuple[FeatureKeys, ...]
    by_layer: LayerTimeKeys
    limits: LimitKeys
    sources: Annotated[
        dict[str, str], "Source of each limit: `settings`, `printer`, `limits`, `commands`, `given` or `assumed`"
    ]
    plate: Annotated[int | None, "Plate of an archive; null for other files"]
    plates: Annotated[tuple[int, ...], "All plates of the archive"]
    unread_lines: Annotated[int, "Number of lines that may move or extrude and are left out"]
    first_unread_line: Annotated[int, "Number of the first of these lines, from 1; 0 without one"]
    first_unread_text: Annotated[str, "Text of that line"]
    missing_end: Annotated[
        str, "Line with which its slicer ends a file, if this one lacks it and was cut off; else empty"
    ]
    macros: Annotated[tuple[str, ...], "Macros of the printer that may move, such as `PRINT_START`; they are left out"]
    macro_seconds: Annotated[dict[str, float], "Time of all calls of each macro whose time was given, s, by its name"]
    printer: Annotated[str, "File of the printer's limits; empty without one"]
    notes: tuple[NoteKeys, ...]
    written: WrittenKeys | None
    volumetric: Annotated[bool, "Whether E counts mm³ at the end of the file"]
    filament_diameter: Annotated[float, "Diameter of the filament, mm"]


class MotionReports(TypedDict):
    """The report of ``infill motion`` for two files."""

    files: Annotated[list[MotionReport], "Report of each file"]
