"""How long a machine takes: for paths, each from rest to rest, and for a whole print up to each of its lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.gcode.bounds import Moves
from infill.gcode.dialect import role_of
from infill.gcode.limits import Limits
from infill.gcode.planner import plan
from infill.gcode.sections import SPARSE
from infill.inspection.printing_time import timeline_of_text
from infill.inspection.sliced_file import SlicedText
from infill.inspection.strokes import Strokes as Sums

Floats = NDArray[np.float64]
Places = NDArray[np.intp]


def neutral_limits(square_corner_velocity: float = 5.0) -> Limits:
    """Return the limits that paths are compared by: corners by square corner velocity, arcs by acceleration.

    Nothing else limits: the paths compared share their axes, filament per mm and feed rates.
    """
    infinite = (np.inf,) * 4
    return Limits(
        model="klipper",
        feedrate=infinite,
        axis_acceleration=infinite,
        square_corner_velocity=square_corner_velocity,
        corner_extrusion_velocity=1e6,
        minimum_cruise_ratio=0.0,
    )


def path_seconds(points: Floats, first: Places, feedrate: Floats, acceleration: Floats, limits: Limits) -> Floats:
    """Return the seconds that each path takes.

    Parameters
    ----------
    points : (N, 2) float64, mm
    first : (M + 1,) int
    feedrate, acceleration : (M,) float64
        mm/s and mm/s².
    limits : Limits
        All others.
    """
    number = np.diff(first)
    if not len(number):
        return np.empty(0)
    path = np.repeat(np.arange(len(number)), number)
    move = np.flatnonzero(np.diff(path) == 0)
    owner = path[move]
    delta = np.zeros((len(move), 4))
    delta[:, :2] = points[move + 1] - points[move]
    delta[:, 3] = 1e-9
    levels, setting = np.unique(acceleration, return_inverse=True)
    several = [replace(limits, acceleration=float(level), travel_acceleration=float(level)) for level in levels]
    stop = np.concatenate([[True], np.diff(owner) != 0])
    moves = Moves(delta=delta, feedrate=feedrate[owner], setting=setting[owner], stop=stop)
    seconds: Floats = np.bincount(owner, plan(moves, several).seconds, len(number)).astype(np.float64)
    return seconds


@dataclass(frozen=True, kw_only=True)
class PrintTime:
    """How long a print takes, planned as `infill motion` does by the limits that the file tells.

    Parameters
    ----------
    seconds : float
        Of the whole print; 0 if it has no moves.
    infill : float
        Of its sparse infill, with what leads to it.
    first_layer : float
        Up to the end of the first layer.
    elapsed : (N,) float64
        Up to each of the places that were asked for, s.
    filament : float
        Laid, mm.
    unread, first_unread : int
        Lines that may move or extrude and are not understood, and the number of the first.
    """

    seconds: float = 0.0
    infill: float = 0.0
    first_layer: float = 0.0
    elapsed: Floats
    filament: float = 0.0
    unread: int = 0
    first_unread: int = 0


def print_time(given: SlicedText, text: BinaryIO | None = None, places: Sequence[int] = ()) -> PrintTime:
    """Plan a print.

    Parameters
    ----------
    given : SlicedText
        With what stands outside the text.
    text : binary file, optional
        Its text, if it is another one by now.
    places : sequence of int, ascending
        Bytes of the text at which to tell the time.
    """
    sums, asked = Sums(), np.asarray(places, dtype=np.int64)
    elapsed = np.zeros(len(asked))
    first_layer = total = 0.0
    known = 0  # of the places
    timeline = timeline_of_text(given, text)
    try:
        for steps, done in timeline:
            if not len(steps):
                continue
            sums.add(steps, done)
            seconds = done.seconds + steps.pause
            gone = np.concatenate([[0.0], np.cumsum(seconds)])
            first_layer += float(seconds[steps.layer < 2].sum())
            here = slice(known, known := int(np.searchsorted(asked, steps.place[-1], side="right")))
            elapsed[here] = total + gone[np.searchsorted(steps.place, asked[here], side="left")]
            total += float(gone[-1])
    except FormatError:
        if timeline.moved:
            raise
    sums.finish(timeline.pause, timeline.retractions)
    elapsed[known:] = total
    infill = [number for number, name in enumerate(timeline.features) if role_of(name) == SPARSE]
    by_feature = sums.total("seconds")
    return PrintTime(
        seconds=float(by_feature.sum()),
        infill=float(by_feature[[number for number in infill if number < len(by_feature)]].sum()),
        first_layer=first_layer,
        elapsed=elapsed,
        filament=float(sums.total("filament").sum()),
        unread=timeline.unread.lines,
        first_unread=timeline.unread.first,
    )
