"""Times of a machine: for paths, each from rest to rest, and for an entire print up to each of its lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import BinaryIO

import numpy as np

from infill.arrays import Floats, Places
from infill.gcode.dialect import role_of
from infill.gcode.found_limits import FileLimits
from infill.gcode.limits import Limits
from infill.gcode.machine_state import MachineState
from infill.gcode.sections import SPARSE
from infill.gcode.sliced_file import SlicedText
from infill.gcode.table import GcodeTable
from infill.kernels.threads import in_order
from infill.planner.bounds import Moves
from infill.planner.feature_sums import FeatureSums
from infill.planner.lookahead import MotionPlan, plan_moves
from infill.planner.open_timeline import make_timeline
from infill.planner.timeline import Steps

BATCH = 1 << 19  # bytes: no slower than larger ones, which take 0.1 GB more


def neutral_limits(square_corner_velocity: float = 5.0) -> Limits:
    """Return the limits for comparing paths: corners by square corner velocity, arcs by acceleration.

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


def path_seconds(
    points: Floats, offsets: Places, feedrate: Floats, acceleration: Floats, limits: Limits | None = None
) -> Floats:
    """Compute the time of each path, s.

    Parameters
    ----------
    points : (N, 2) float64, mm
    offsets : (M + 1,) int
    feedrate, acceleration : (M,) float64
        mm/s and mm/s².
    limits : Limits, optional
        All others; by default, `neutral_limits`.
    """
    number = np.diff(offsets)
    if not len(number):
        return np.empty(0)
    path = np.repeat(np.arange(len(number)), number)
    move = np.flatnonzero(np.diff(path) == 0)
    owner = path[move]
    delta = np.zeros((len(move), 4))
    delta[:, :2] = points[move + 1] - points[move]
    delta[:, 3] = 1e-9
    limits = limits or neutral_limits()
    levels, setting = np.unique(acceleration, return_inverse=True)
    limits_by_setting = [
        replace(limits, acceleration=float(level), travel_acceleration=float(level)) for level in levels
    ]
    stop = np.concatenate([[True], np.diff(owner) != 0])
    moves = Moves(delta=delta, feedrate=feedrate[owner], setting=setting[owner], stop=stop)
    seconds: Floats = np.bincount(owner, plan_moves(moves, limits_by_setting).seconds, len(number)).astype(np.float64)
    return seconds


@dataclass(frozen=True, kw_only=True)
class PrintTime:
    """Times of a print, planned as `infill motion` does by the limits in the file.

    Parameters
    ----------
    seconds : float
        Of the entire print; 0 without moves.
    infill : float
        Of its sparse infill, with the travel to it.
    first_layer : float
        Up to the end of the first layer.
    elapsed : (N,) float64
        Up to each of the requested places, s.
    unread, first_unread : int
        Lines that may move or extrude and are not understood, and the number of the first.
    """

    seconds: float = 0.0
    infill: float = 0.0
    first_layer: float = 0.0
    elapsed: Floats
    unread: int = 0
    first_unread: int = 0


class ElapsedTimes:
    """Seconds of a print up to some places of its text, and up to the end of its first layer.

    Parameters
    ----------
    places : sequence of int, ascending
        Bytes of the text.
    """

    def __init__(self, places: Sequence[int] = ()) -> None:
        self._places = np.asarray(places, dtype=np.int64)
        self._elapsed = np.zeros(len(self._places))
        self._known = 0  # of the places
        self.total = self.first_layer = 0.0

    def add(self, steps: Steps, plan: MotionPlan) -> None:
        """Add moves that follow the previous ones."""
        if not len(steps):
            return
        seconds = plan.seconds + steps.pause
        cumulative = np.concatenate([[0.0], np.cumsum(seconds)])
        self.first_layer += float(seconds[steps.layer < 2].sum())
        begin, self._known = self._known, int(np.searchsorted(self._places, steps.place[-1], side="right"))
        reached = slice(begin, self._known)
        self._elapsed[reached] = (
            self.total + cumulative[np.searchsorted(steps.place, self._places[reached], side="left")]
        )
        self.total += float(cumulative[-1])

    def finish(self) -> Floats:
        """Return the seconds up to each place, (N,) float64."""
        self._elapsed[self._known :] = self.total
        return self._elapsed


class PrintClock:
    """The time of a print, batch by batch.

    Parameters
    ----------
    sliced : SlicedText
        The print, with its metadata.
    text : binary file, optional
        Its text, if it has changed.
    places : sequence of int, ascending
        Bytes of the text at which the time is needed.
    found : FileLimits, optional
        The limits that the file states, if they are known; else they are read from it.
    """

    def __init__(
        self,
        sliced: SlicedText,
        text: BinaryIO | None = None,
        places: Sequence[int] = (),
        *,
        found: FileLimits | None = None,
    ) -> None:
        self._timeline = make_timeline(sliced, text, found=found)
        self.found: FileLimits = self._timeline.found
        self.begin: MachineState = self._timeline.state
        self._sums, self._elapsed = FeatureSums(times_only=True), ElapsedTimes(places)

    def add(self, table: GcodeTable) -> None:
        """Take the next lines of the print."""
        self._count(*self._timeline.follow(table))

    def read(self) -> PrintTime:
        """Read the entire print."""
        for _ in in_order(self.add, self._timeline.tables(BATCH), threads=1):  # lines are read while moves are planned
            pass
        return self.finish()

    def finish(self) -> PrintTime:
        """Return the time of all lines that were added."""
        timeline, sums = self._timeline, self._sums
        if timeline.moved:
            self._count(*timeline.rest())
        sums.finish(timeline.pause, timeline.retractions)
        seconds = sums.total("seconds").tolist()
        return PrintTime(
            seconds=float(sums.total("seconds").sum()),
            infill=sum(
                (spent for name, spent in zip(timeline.features, seconds, strict=False) if role_of(name) == SPARSE), 0.0
            ),
            first_layer=self._elapsed.first_layer,
            elapsed=self._elapsed.finish(),
            unread=timeline.unread.lines,
            first_unread=timeline.unread.first,
        )

    def _count(self, steps: Steps, motion_plan: MotionPlan) -> None:
        """Add planned moves to all sums."""
        if len(steps):
            self._sums.add(steps, motion_plan)
            self._elapsed.add(steps, motion_plan)
