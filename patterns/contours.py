r"""Zero lines of a level set at one height: marching squares, with every corner on the zero set itself.

Step 1. Take the signs at the nodes of a grid. An edge between two nodes of different sign contains a zero.
Step 2. Find that zero by halving the edge, on the function itself, so that no grid shows in it.
Step 3. In every cell, join the zeros in pairs::

        + --o-- -          Two edges: one piece. Four edges (a saddle): the sign at the saddle of the
        |    \  |          bilinear interpolation of the corners says which of them are connected.
        |     `-o
        + ----- +

Step 4. Join pieces that share a zero into one line.

A feature smaller than a step of the grid may be missed; between zeros a line is a chord, at most
step² / 8 R away from a curve of radius R: for 32 steps per spacing s and R = s / 4, s / 2000.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import shapely
from numpy.typing import NDArray

from patterns.declared import format_decimal
from patterns.errors import PatternError

Floats = NDArray[np.float64]
Signs = NDArray[np.bool_]
Function = Callable[[Floats, Floats, Floats], Floats]

STEPS_PER_SPACING = 32
# Nodes are offset from multiples of the step, where straight patterns are zero and rounding decides the sign.
OFFSET = (math.sqrt(5) - 2, math.sqrt(2) - 1)
BISECTIONS = 26  # of a step: to 1e-8 of it
NODES_AT_ONCE = 1_000_000


def zero_lines(
    function: Function, bounds: tuple[float, float, float, float], z: float, spacing: float
) -> NDArray[np.object_]:
    """Return the lines on which `function` is zero at height `z`: an array of LineString, mm.

    Parameters
    ----------
    function : callable
        Takes x, y and z, three arrays of the same shape in mm; continuous.
    bounds : (x0, y0, x1, y1)
        mm. Lines cover this box and may extend a step beyond it.
    z : float
        mm.
    spacing : float
        Distance between neighbouring lines, mm; a step of the grid is a 32nd of it.

    >>> (circle,) = zero_lines(lambda x, y, z: 1 - np.hypot(x, y), (-2, -2, 2, 2), 0.0, 1.0)
    >>> circle.is_ring, float(np.abs(np.hypot(*circle.coords.xy) - 1).max()) < 1e-8
    (True, True)
    """
    if not (math.isfinite(spacing) and spacing > 0):
        raise PatternError(f"the spacing of lines is {format_decimal(spacing)} mm; it must be a number above 0")
    step = spacing / STEPS_PER_SPACING
    x, y = (_nodes(bounds[i], bounds[i + 2], step, OFFSET[i]) for i in (0, 1))

    def value(x: Floats, y: Floats) -> Floats:
        """Return the function at points of the height, or raise PatternError."""
        x, y = np.broadcast_arrays(x, y)
        values = np.broadcast_to(np.asarray(function(x, y, np.full(x.shape, float(z))), dtype=np.float64), x.shape)
        if not np.isfinite(values).all():
            raise PatternError("the level set has no finite value somewhere; make it a number everywhere")
        return values

    positive = _signs(x, y, value)
    zeros, pairs = _join_zeros(x, y, positive, value)
    ends = zeros[pairs]
    is_long = (ends[:, 0] != ends[:, 1]).any(axis=-1)  # two edges may contain the same zero, at the node between them
    pieces = shapely.multilinestrings(shapely.linestrings(ends[is_long]))
    lines: NDArray[np.object_] = shapely.get_parts(shapely.line_merge(pieces))
    return lines


def _nodes(low: float, high: float, step: float, offset: float) -> Floats:
    """Return the nodes (k + offset) * step from below `low` to above `high`, the same for every box."""
    number = np.arange(math.floor(low / step) - 1, math.ceil(high / step) + 1, dtype=np.float64)
    return (number + offset) * step


def _signs(x: Floats, y: Floats, value: Callable[[Floats, Floats], Floats]) -> Signs:
    """Return the mask of nodes with a value above 0, (len(x), len(y)), computed in blocks of columns."""
    positive = np.empty((len(x), len(y)), dtype=bool)
    columns = max(1, NODES_AT_ONCE // len(y))
    for start in range(0, len(x), columns):
        part = slice(start, start + columns)
        positive[part] = value(x[part, None], y[None]) > 0
    return positive


def _join_zeros(
    x: Floats, y: Floats, positive: Signs, value: Callable[[Floats, Floats], Floats]
) -> tuple[Floats, NDArray[np.intp]]:
    """Return the zeros on edges, (N, 2) float64, and the numbers of those joined by a piece of line, (M, 2)."""
    columns, rows = positive.shape
    # Edges along x have the number of their first node; edges along y follow.
    on_x = np.flatnonzero(positive[1:] != positive[:-1])
    on_y = np.flatnonzero(positive[:, 1:] != positive[:, :-1])
    i, j = np.divmod(on_x, rows)
    k, n = np.divmod(on_y, rows - 1)
    zeros = _bisect_zeros(
        np.concatenate([x[i], x[k]]),
        np.concatenate([y[j], y[n]]),
        np.concatenate([x[i + 1], x[k]]),
        np.concatenate([y[j], y[n + 1]]),
        np.concatenate([positive[i, j], positive[k, n]]),
        value,
    )
    numbered = np.concatenate([on_x, on_y + columns * rows])
    corners = (positive[:-1, :-1], positive[1:, :-1], positive[:-1, 1:], positive[1:, 1:])
    i, j = np.nonzero(np.logical_or.reduce(corners) & ~np.logical_and.reduce(corners))
    lower, left_edge = i * rows + j, columns * rows + i * (rows - 1) + j
    edges = np.stack([lower, left_edge + rows - 1, lower + 1, left_edge], axis=-1)  # below, right, above, left
    place = np.searchsorted(numbered, edges).clip(max=max(0, len(numbered) - 1))
    crossed = numbered[place] == edges
    saddle = crossed.all(axis=-1)
    pairs = [place[~saddle][crossed[~saddle]].reshape(-1, 2)]
    i, j, edge_zeros = i[saddle], j[saddle], place[saddle]
    lower_left, lower_right, upper_left, upper_right = (
        value(x[i + m], y[j + n]) for m, n in ((0, 0), (1, 0), (0, 1), (1, 1))
    )
    # Does the saddle of the interpolated corners have the sign of the lower left corner? If so, lines cut off the lower
    # right and the upper left one.
    lower_left_sign = (lower_left * upper_right > lower_right * upper_left)[:, None]
    pairs += [
        np.where(lower_left_sign, edge_zeros[:, [0, 1]], edge_zeros[:, [0, 3]]),
        np.where(lower_left_sign, edge_zeros[:, [2, 3]], edge_zeros[:, [1, 2]]),
    ]
    return zeros, np.concatenate(pairs)


def _bisect_zeros(
    x0: Floats,
    y0: Floats,
    x1: Floats,
    y1: Floats,
    positive: Signs,
    value: Callable[[Floats, Floats], Floats],
) -> Floats:
    """Return a zero between each point (x0, y0), where the sign is `positive`, and (x1, y1): (N, 2)."""
    low, high = np.zeros(len(x0)), np.ones(len(x0))
    for _ in range(BISECTIONS if len(x0) else 0):
        middle = (low + high) / 2
        has_start_sign = (value(x0 + middle * (x1 - x0), y0 + middle * (y1 - y0)) > 0) == positive
        low, high = np.where(has_start_sign, middle, low), np.where(has_start_sign, high, middle)
    part = (low + high) / 2
    return np.stack([x0 + part * (x1 - x0), y0 + part * (y1 - y0)], axis=-1)
