"""How long a machine takes for paths, each from rest to rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bounds import Moves
from infill.gcode.limits import Limits
from infill.gcode.planner import plan

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
