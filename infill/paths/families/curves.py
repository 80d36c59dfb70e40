"""Periodic curves given by formulas: their division into chords, and copies of them over a box."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from infill.arrays import Floats
from infill.paths.families.family import Bounds, Path

SAGITTA = 0.005  # mm, that a chord may depart from its curve; a nozzle is placed to about 0.01 mm
SAMPLES = 512  # of one period, by which its curvature is judged
LONGEST = 1 / 12  # of a period, for a chord: straight parts have corners too, so that a spline may pass through them


def chord_parameters(curve: Callable[[Floats], Path], stop: float) -> Floats:
    """Divide a curve into chords; return their corners from 0 to `stop`, both ends included.

    Chords are c = √(8 · SAGITTA / κ) long at a curvature κ, which makes every chord depart as far from the curve.

    >>> circle = chord_parameters(lambda angle: 4 * np.stack([np.cos(angle), np.sin(angle)], axis=-1), math.tau)
    >>> bool(np.ptp(np.diff(circle)) < 1e-3), round(math.tau / len(circle), 2)
    (True, 0.1)
    """
    place = np.linspace(0, stop, SAMPLES + 1)
    points = curve(place)
    velocity = np.gradient(points, axis=0, edge_order=2)
    acceleration = np.gradient(velocity, axis=0, edge_order=2)
    speed = np.hypot(*velocity.T)
    curvature = (
        np.abs(velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0])
        / np.maximum(speed, 1e-12) ** 3
    )
    longest = LONGEST * float(speed.mean()) * SAMPLES
    per_sample = speed / np.minimum(longest, np.sqrt(8 * SAGITTA / np.maximum(curvature, 1e-12)))
    chord_count = np.concatenate([[0.0], np.cumsum((per_sample[1:] + per_sample[:-1]) / 2)])
    return np.interp(np.linspace(0, chord_count[-1], math.ceil(chord_count[-1]) + 1), chord_count, place)


def repeat_curves(
    curves: Sequence[Callable[[Floats], Floats]], unit: float, bounds: Bounds, frame: Floats
) -> list[Path]:
    """Draw lines v = curve(u) and their copies every 2π in u and in v.

    Parameters
    ----------
    curves : sequence of callable
        Periodic functions of an angle, in radians.
    unit : float
        mm per radian.
    bounds : (x0, y0, x1, y1)
        mm. Lines cover this box.
    frame : (2, 2) float64
        Its rows are the directions of u and of v: a turn or a mirror.
    """
    corners = np.array([[x, y] for x in bounds[::2] for y in bounds[1::2]]) @ frame.T / (unit * math.tau)
    (u0, v0), (u1, v1) = corners.min(axis=0), corners.max(axis=0)
    column = np.arange(math.floor(u0), math.ceil(u1) + 1)
    paths: list[Path] = []
    for curve in curves:

        def points_of_curve(angle: Floats, curve: Callable[[Floats], Floats] = curve) -> Path:
            """Return points of the curve at angles, mm."""
            return unit * np.stack([angle, curve(angle)], axis=-1)

        u = chord_parameters(points_of_curve, math.tau)[:-1]
        v = curve(u)
        row = np.arange(math.floor(v0 - v.max() / math.tau), math.ceil(v1 - v.min() / math.tau) + 1)
        along = np.tile(((column * math.tau)[:, None] + u).ravel(), (len(row), 1))
        across = np.tile(v, len(column)) + (row * math.tau)[:, None]
        paths.extend(unit * np.stack([along, across], axis=-1) @ frame)
    return paths


def repeat_loop(loop: Path, period: float, bounds: Bounds) -> list[Path]:
    """Copy a closed line every `period` mm in x and y, as far as copies reach into a box."""
    low, high = loop.min(axis=0), loop.max(axis=0)
    lowest = np.ceil((np.array(bounds[:2]) - high) / period)
    highest = np.floor((np.array(bounds[2:]) - low) / period)
    shifts = np.stack(np.meshgrid(*(np.arange(a, b + 1) for a, b in zip(lowest, highest, strict=True))), axis=-1)
    return list(loop + shifts.reshape(-1, 1, 2) * period)
