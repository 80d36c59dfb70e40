"""Periodic curves given by formulas: where to put their corners, and copies of them over a box."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from infill.paths.families.protocol import Bounds, Path

Floats = NDArray[np.float64]

SAGITTA = 0.005  # mm, that a chord may depart from its curve; a nozzle is placed to about 0.01 mm
SAMPLES = 512  # of one period, by which its curvature is judged
LONGEST = 1 / 12  # of a period, for a chord: straight parts have corners too, so that a spline may pass through them


def parameters(curve: Callable[[Floats], Path], last: float) -> Floats:
    """Return where from 0 to `last` a curve has its corners, both ends included.

    Chords are c = √(8 · SAGITTA / κ) long at a curvature κ, which makes every chord depart as far from the curve.

    >>> circle = parameters(lambda angle: 4 * np.stack([np.cos(angle), np.sin(angle)], axis=-1), math.tau)
    >>> bool(np.ptp(np.diff(circle)) < 1e-3), round(math.tau / len(circle), 2)
    (True, 0.1)
    """
    place = np.linspace(0, last, SAMPLES + 1)
    points = curve(place)
    first = np.gradient(points, axis=0, edge_order=2)
    second = np.gradient(first, axis=0, edge_order=2)
    speed = np.hypot(*first.T)
    curvature = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.maximum(speed, 1e-12) ** 3
    longest = LONGEST * float(speed.mean()) * SAMPLES
    per_sample = speed / np.minimum(longest, np.sqrt(8 * SAGITTA / np.maximum(curvature, 1e-12)))
    passed = np.concatenate([[0.0], np.cumsum((per_sample[1:] + per_sample[:-1]) / 2)])
    return np.interp(np.linspace(0, passed[-1], math.ceil(passed[-1]) + 1), passed, place)


def rows(curves: Sequence[Callable[[Floats], Floats]], unit: float, bounds: Bounds, frame: Floats) -> list[Path]:
    """Return lines v = curve(u) and their copies every 2π in u and in v.

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

        def points(angle: Floats, curve: Callable[[Floats], Floats] = curve) -> Path:
            return unit * np.stack([angle, curve(angle)], axis=-1)

        u = parameters(points, math.tau)[:-1]
        v = curve(u)
        row = np.arange(math.floor(v0 - v.max() / math.tau), math.ceil(v1 - v.min() / math.tau) + 1)
        along = np.tile(((column * math.tau)[:, None] + u).ravel(), (len(row), 1))
        across = np.tile(v, len(column)) + (row * math.tau)[:, None]
        paths.extend(unit * np.stack([along, across], axis=-1) @ frame)
    return paths


def copies(loop: Path, period: float, bounds: Bounds) -> list[Path]:
    """Return a closed line and its copies every `period` mm in x and y, all that reach into a box."""
    low, high = loop.min(axis=0), loop.max(axis=0)
    first = np.ceil((np.array(bounds[:2]) - high) / period)
    last = np.floor((np.array(bounds[2:]) - low) / period)
    shifts = np.stack(np.meshgrid(*(np.arange(a, b + 1) for a, b in zip(first, last, strict=True))), axis=-1)
    return list(loop + shifts.reshape(-1, 1, 2) * period)
