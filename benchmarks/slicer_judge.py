"""What is measured on the G-code of the slicer report: time by one planner, and what holds the infill together.

The time is that of `infill motion` for the feature sparse infill, with what leads to it: travel and retractions. Three
planners tell whether the gain hangs on the model of the firmware. Support and contact are measured on a few runs of
layers, spread over the print, by the second implementation that the tests have (tests/gcode_structure.py).
"""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from infill.timing.printing_time import motion
from tests.gcode_judge import replayed
from tests.gcode_structure import held_up, touched

ROLE = "sparse infill"
WINDOWS, TALL = 3, 14  # runs of layers, and layers in a run: half a period of a gyroid, whose support comes and goes
LAYER = re.compile(rb"^;(?:LAYER_CHANGE|LAYER:\d+)\b", re.MULTILINE)
SPARSE = re.compile(rb"^;TYPE:(?:Internal infill|FILL)\b", re.MULTILINE)


@dataclass(frozen=True, kw_only=True)
class Judged:
    """What was measured on one file, of its sparse infill.

    Parameters
    ----------
    seconds : float
        Klipper's rules, square corner velocity 5 mm/s, acceleration of the printer, no minimum cruise ratio.
    seconds_cruise : float
        The same, with Klipper's default minimum cruise ratio of 0.5.
    seconds_jerk : float
        Jerk of 8 mm/s by axis, as PrusaSlicer estimates.
    whole : float
        Seconds of the whole print, by the first planner.
    filament, length, travel : float
        mm
    supported, bonded : float
        Shares of the length.
    """

    seconds: float
    seconds_cruise: float
    seconds_jerk: float
    whole: float
    filament: float
    length: float
    travel: float
    paths: int
    retractions: int
    turns: int
    segments: int
    supported: float
    bonded: float
    bytes: int

    def to_dict(self) -> dict[str, float]:
        return asdict(self)


def judged(path: Path, acceleration: float) -> Judged:
    """Measure a file."""
    planned = motion(path, acceleration=acceleration, square_corner_velocity=5.0, minimum_cruise_ratio=0.0)
    cruise = motion(path, acceleration=acceleration, square_corner_velocity=5.0, minimum_cruise_ratio=0.5)
    jerk = motion(path, acceleration=acceleration, jerk=8.0)
    infill = [each for each in planned.features if each.role == ROLE]
    supported, bonded = structure(path.read_bytes())
    return Judged(
        seconds=planned.of_role(ROLE),
        seconds_cruise=cruise.of_role(ROLE),
        seconds_jerk=jerk.of_role(ROLE),
        whole=planned.seconds,
        filament=sum(each.filament for each in infill),
        length=sum(each.length for each in infill),
        travel=sum(each.travel for each in infill),
        paths=sum(each.paths for each in infill),
        retractions=sum(each.retractions for each in infill),
        turns=sum(each.turns for each in infill),
        segments=sum(each.segments for each in infill),
        supported=supported,
        bonded=bonded,
        bytes=path.stat().st_size,
    )


def structure(data: bytes) -> tuple[float, float]:
    """Return the shares of the infill's length that are supported and bonded, in a few runs of layers."""
    held = whole = touching = length = 0.0
    for window in windows(data):
        some = held_up(window)
        held, whole = held + some[0], whole + some[1]
        some = touched(window)
        touching, length = touching + some[0], length + some[1]
        replayed.cache_clear()
    return (held / whole if whole else 1.0), (touching / length if length else 0.0)


def windows(data: bytes, count: int = WINDOWS, tall: int = TALL) -> list[bytes]:
    """Return pieces of so many layers each, evenly spread over the layers that have sparse infill."""
    starts = [found.start() for found in LAYER.finditer(data)]
    ends = [*starts[1:], len(data)]
    filled = [
        number for number, (start, end) in enumerate(zip(starts, ends, strict=True)) if SPARSE.search(data, start, end)
    ]
    if not filled:
        return []
    mode = b"G90\nM83\n" if b"M83" in data[: starts[0] + 4096] else b"G90\nM82\n"
    # From places that share no period with the layers; where one begins, positions are not known, so that its first
    # layer is only what the second lies on.
    places = np.round((np.arange(count) + 0.5) / count * len(filled)).astype(int)
    lowest = [max(filled[place] - tall // 2, 0) for place in places]
    pieces, done = [], 0
    for low in lowest:
        first, last = max(low, done), min(low + tall, len(starts))
        if last - first > 1:
            pieces.append(mode + data[starts[first] : ends[last - 1]])
        done = last - 1
    return pieces
