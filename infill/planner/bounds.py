"""Moves within the limits of a machine: length, direction, top speed, acceleration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.limits import Limits
from infill.gcode.lines import fill_missing
from infill.kernels.compiling import is_compiler_loaded, log_compilation

MIN_FEEDRATE = 0.01  # mm/s: replaces a feed rate of zero
DEFAULT_FEEDRATE = 25.0  # mm/s: that of Marlin and Klipper before a file states one


@dataclass(frozen=True, kw_only=True)
class Moves:
    """Straight moves, one after the other.

    Parameters
    ----------
    delta : (N, 4) float64
        Travel in x, y, z, and filament pushed, mm. Rows of zeros are invalid.
    feedrate : (N,) float64
        Requested mm/s: along x, y, z, or of the filament where nothing else moves. NaN before the first request.
    setting : (N,) int
        Index of the `Limits` in force.
    stop : (N,) bool
        The machine stands still before the move, as it does to dwell.
    """

    delta: Floats
    feedrate: Floats
    setting: NDArray[np.intp]
    stop: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.feedrate)


@dataclass(frozen=True, kw_only=True)
class BoundedMoves:
    """Moves within the limits of the machine.

    Parameters
    ----------
    distance : (N,) float64
        mm, along x, y, z, or of filament where nothing else moves.
    direction : (N, 4) float64
        Change of x, y, z and e per mm of the distance.
    turning_only : (N,) bool
        Only the extruder moves.
    speed, acceleration : (N,) float64
        mm/s and mm/s² along the distance.
    path_acceleration : (N,) float64
        mm/s², before the limits of axes.
    """

    distance: Floats
    direction: Floats
    turning_only: NDArray[np.bool_]
    speed: Floats
    acceleration: Floats
    path_acceleration: Floats

    @property
    def reach(self) -> Floats:
        """Largest possible change of the squared speed along each move: 2 a d, mm²/s²."""
        return 2 * self.acceleration * self.distance

    def slower_reach(self, cruise_ratio: Floats) -> Floats:
        """Return the reach at the acceleration that Klipper's minimum cruise ratio leaves, mm²/s².

        The ratio lowers the acceleration of the path; the limits of axes, which may be lower still, it leaves as they
        are.
        """
        return np.minimum(self.reach, 2 * self.path_acceleration * (1 - cruise_ratio) * self.distance)


def limit_values(limits: Sequence[Limits], name: str, setting: NDArray[np.intp]) -> Floats:
    """Return one of the limits for every move, (N,) or (N, 4); (1,) or (1, 4) if it is constant."""
    table = np.array([getattr(setting_limits, name) for setting_limits in limits], dtype=np.float64)
    return table[:1] if (table == table[:1]).all() else table[setting]


def row_lengths(rows: Floats) -> Floats:
    """Return the length of vectors of three or four numbers, (N,); sums are in this order on all machines."""
    x, y, z, *pushed = rows.T
    return np.asarray(np.sqrt((x * x + z * z) + (y * y + pushed[0] * pushed[0] if pushed else y * y)))


def bound_moves(moves: Moves, limits: Sequence[Limits]) -> BoundedMoves:
    """Limit moves to the speed and acceleration of the path and of every axis."""
    return (bound_compiled_moves if is_compiler_loaded() else bound_plain_moves)(moves, limits)


def bound_compiled_moves(moves: Moves, limits: Sequence[Limits]) -> BoundedMoves:
    """Limit moves as `bound_moves` does, in compiled code."""
    from infill.kernels.moves import limit_moves

    count = len(moves)
    rates = (
        "minimum_travel_feedrate",
        "minimum_feedrate",
        "travel_acceleration",
        "acceleration",
        "retract_acceleration",
    )
    distance, speed, acceleration, path_acceleration = (np.empty(count) for _ in range(4))
    direction, turning_only = np.empty((count, 4)), np.empty(count, dtype=bool)
    with log_compilation("speeds"):
        limit_moves(
            np.ascontiguousarray(moves.delta),
            fill_missing(moves.feedrate, DEFAULT_FEEDRATE),
            moves.setting,
            limits[0].model == "klipper",
            np.array([[float(getattr(setting, name)) for name in rates] for setting in limits]),
            np.array([setting.feedrate for setting in limits], dtype=np.float64),
            np.array([setting.axis_acceleration for setting in limits], dtype=np.float64),
            MIN_FEEDRATE,
            distance,
            direction,
            turning_only,
            speed,
            acceleration,
            path_acceleration,
        )
    return BoundedMoves(
        distance=distance,
        direction=direction,
        turning_only=turning_only,
        speed=speed,
        acceleration=acceleration,
        path_acceleration=path_acceleration,
    )


def bound_plain_moves(moves: Moves, limits: Sequence[Limits]) -> BoundedMoves:
    """Limit moves as `bound_moves` does, with NumPy."""
    delta = moves.delta
    travelled = row_lengths(delta[:, :3])
    pushed = delta[:, 3]
    turning_only = travelled == 0
    distance = np.where(turning_only, np.abs(pushed), travelled)
    direction = delta / distance[:, None]

    def limit(name: str) -> Floats:
        """Return a limit for every move."""
        return limit_values(limits, name, moves.setting)

    lowest = np.where(pushed == 0, limit("minimum_travel_feedrate"), limit("minimum_feedrate"))
    speed = np.maximum(np.maximum(fill_missing(moves.feedrate, DEFAULT_FEEDRATE), lowest), MIN_FEEDRATE)
    path_acceleration = np.where(pushed == 0, limit("travel_acceleration"), limit("acceleration"))
    acceleration = np.where(turning_only, limit("retract_acceleration"), path_acceleration)
    share = np.abs(direction)
    if limits[0].model == "klipper":  # which limits x and y together, and filament only where it is drawn or alone
        share = share.copy()
        share[:, :2] = 0.0
        share[(pushed > 0) & delta[:, :2].any(axis=1), 3] = 0.0
        speed = np.where(turning_only, speed, np.minimum(speed, limit("feedrate")[:, :2].min(axis=1)))
    speed = _limit_by_axes(speed, limit("feedrate"), share)
    acceleration = _limit_by_axes(acceleration, limit("axis_acceleration"), share)
    return BoundedMoves(
        distance=distance,
        direction=direction,
        turning_only=turning_only,
        speed=speed,
        acceleration=acceleration,
        path_acceleration=path_acceleration,
    )


def _limit_by_axes(requested: Floats, limit: Floats, share: Floats) -> Floats:
    """Return the requested values along moves, (N,), reduced to the limits of all axes that take part."""
    with np.errstate(divide="ignore"):
        for axis in range(4):  # NumPy is slow along the short axis of an array
            if not np.isinf(limit[:, axis]).all():
                requested = np.minimum(requested, limit[:, axis] / share[:, axis])
    return requested
