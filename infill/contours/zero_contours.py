"""Trace the contours of a layer: closed rings where the field crosses zero, as marching squares draws them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats
from infill.errors import GeometryError
from infill.grid import VOID
from infill.plain_numbers import plain_argument

Indices = NDArray[np.intp]

# A value nearer to the level than this is moved away from it. Otherwise triangles shrink to a point
# at the centre of the cell, and a 32-bit file merges vertices that the mesh keeps apart. This moves the
# surface by at most half this fraction of a cell.
CLEARANCE = 2.0**-10
# Solid is weakened by this factor, so that two solid cells that touch only at an edge, with void on the
# other two sides, are separate rather than undecided: marching cubes would leave such a saddle open.
TIE = 1 - 1e-5


@dataclass(frozen=True, kw_only=True, eq=False)
class Contours:
    """Simple closed rings that do not touch, solid on the left of every edge.

    Rings around solid therefore run counter-clockwise, and rings around holes clockwise.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The corners of all rings, one ring after another; the last corner of a ring is joined to its first.
    first : (R + 1,) int
        Where each ring begins among the points, and N.
    """

    points: Floats
    first: Indices

    @property
    def ring(self) -> Indices:
        """Ring of every corner, (N,)."""
        return np.repeat(np.arange(len(self.first) - 1), np.diff(self.first))

    @property
    def ahead(self) -> Indices:
        """Index of the corner that follows each corner, (N,)."""
        following = np.arange(1, len(self.points) + 1)
        following[self.first[1:] - 1] = self.first[:-1]
        return following

    @property
    def areas(self) -> Floats:
        """Signed area of every ring, (R,), mm²: negative for holes; their sum is the area of the solid."""
        # Relative to a corner of the ring, so that small rings far out lose no digits.
        offsets = self.points - self.points[self.first[:-1]][self.ring]
        next_offsets = offsets[self.ahead]
        doubled = offsets[:, 0] * next_offsets[:, 1] - offsets[:, 1] * next_offsets[:, 0]
        return np.asarray(np.add.reduceat(doubled, self.first[:-1]) / 2)

    @property
    def lengths(self) -> Floats:
        """Length of every ring, (R,), mm."""
        x, y = (self.points[self.ahead] - self.points).T
        return np.asarray(np.add.reduceat(np.hypot(x, y), self.first[:-1]))


def trace_contours(
    layer: NDArray[np.floating],
    spacing: tuple[float, ...] = (1.0, 1.0),
    *,
    origin: tuple[float, ...] = (0.0, 0.0),
) -> Contours:
    """Trace the contours of {layer > 0}; beyond the edges of the layer is void.

    Parameters
    ----------
    layer : (nx, ny) array
        Phase field, +1 solid.
    spacing : (hx, hy), mm
    origin : (x, y, ...)
        Lower corner of the first cell, mm; its centre lies half a cell inside.

    Raises
    ------
    GeometryError
        If nothing is solid.

    Notes
    -----
    These are the horizontal sections of the surface that `infill.extrude` returns, between its rims: the same values,
    interpolated linearly along the edges of the grid. In a square whose corners alternate, solid is joined across the
    middle if the bilinear saddle there is solid (the asymptotic decider of Nielson and Hamann 1991), as the marching
    cubes of Lewiner et al. 2003 decide for two equal layers.

    >>> trace_contours(np.ones((4, 4))).areas.round(4).tolist()  # the four corners are cut off
    [15.5]
    """
    field = np.pad(np.asarray(layer, dtype=np.float32), 1, constant_values=np.float32(VOID))
    solid = nudge_field(field)
    crossings, along_x, along_y = _crossings(field, solid)
    order, first = permutation_cycles(_steps(field, solid, along_x, along_y, len(crossings)))
    # The centre of the first cell, now at index 1, lies half a cell inside the box.
    return Contours(points=(crossings[order] - 0.5) * np.array(spacing) + np.array(origin[:2]), first=first)


def _crossings(field: NDArray[np.float32], solid: Flags) -> tuple[Floats, Indices, Indices]:
    """Find the zeros on edges between neighbouring centres; return points (N, 2) in cells, and their numbers by edge.

    The edges along x come first. The numbers, (nx - 1, ny) and (nx, ny - 1), are -1 where nothing crosses.
    """
    points, numbers, count = [], [], 0
    for axis in (0, 1):
        low = tuple(slice(0, -1) if dimension == axis else slice(None) for dimension in (0, 1))
        high = tuple(slice(1, None) if dimension == axis else slice(None) for dimension in (0, 1))
        crossed = solid[low] != solid[high]
        cells = np.argwhere(crossed)
        low_value, high_value = (field[part][crossed].astype(np.float64) for part in (low, high))
        place = cells.astype(np.float64)
        place[:, axis] += low_value / (low_value - high_value)
        number = np.full(crossed.shape, -1, dtype=np.intp)
        number[crossed] = np.arange(count, count + len(cells))
        count += len(cells)
        points.append(place)
        numbers.append(number)
    return np.concatenate(points), numbers[0], numbers[1]


def _steps(field: NDArray[np.float32], solid: Flags, along_x: Indices, along_y: Indices, count: int) -> Indices:
    """Return the crossing that follows each crossing, (N,), with solid on the left: one step through every square."""
    parts = [(slice(i, i - 1 or None), slice(j, j - 1 or None)) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    corner = np.stack([solid[part] for part in parts])  # counter-clockwise
    mixed = np.nonzero((corner != corner[0]).any(axis=0))
    corner = corner[:, mixed[0], mixed[1]]
    i, j = mixed
    side = np.stack(
        [along_x[i, j], along_y[i + 1, j], along_x[i, j + 1], along_y[i, j]]
    )  # from each corner to the next
    value = np.stack([field[part][mixed] for part in parts]).astype(np.float64)
    leaving = corner & ~np.roll(corner, -1, axis=0)
    entering = ~corner & np.roll(corner, -1, axis=0)
    saddle = leaving.sum(axis=0) == 2
    ahead = np.empty(count, dtype=np.intp)
    plain = ~saddle
    # From the side where the ring leaves solid to the side where it enters again.
    ahead[side.T[plain][leaving.T[plain]]] = side.T[plain][entering.T[plain]]
    joined = saddle & (_diagonal(value, corner) > 0)
    for k in range(4):
        # Around the next, void corner where solid is joined across the middle; else around this solid corner.
        for where, to in ((joined, (k + 1) % 4), (saddle & ~joined, (k - 1) % 4)):
            chosen = where & leaving[k]
            ahead[side[k, chosen]] = side[to, chosen]
    return ahead


def _diagonal(value: Floats, corner: Flags) -> Floats:
    """Return the product of the solid corners minus that of the void corners: positive if the saddle is solid."""
    even, odd = value[0] * value[2], value[1] * value[3]
    return np.asarray(np.where(corner[0], even - odd, odd - even))


def permutation_cycles(ahead: Indices) -> tuple[Indices, Indices]:
    """Split a permutation (N,) into cycles, each from its lowest number on; return the order and the offsets, (C + 1,).

    >>> [array.tolist() for array in permutation_cycles(np.array([2, 1, 3, 0]))]
    [[0, 2, 3, 1], [0, 3, 4]]
    """
    following = ahead.tolist()
    order: list[int] = []
    first = [0]
    for start in range(len(following)):
        at = start
        while following[at] >= 0:
            order.append(at)
            following[at], at = -1, following[at]
        if len(order) > first[-1]:
            first.append(len(order))
    return np.array(order, dtype=np.intp), np.array(first, dtype=np.intp)


def nudge_field(field: NDArray[np.float32], level: float = 0.0) -> NDArray[np.bool_]:
    """Shift a field in place so that the surface of {field > level} lies at level 0; return the solid cells.

    No value stays within `CLEARANCE` of the level, and solid is weakened by `TIE`.

    Raises
    ------
    GeometryError
        If nothing is solid.
    """
    field -= np.float32(level)
    solid: NDArray[np.bool_] = field > 0
    if not solid.any():
        raise GeometryError(
            f"nothing is left above the level {plain_argument(level)}: no surface; smooth less, or use walls of more "
            "cells"
        )
    too_close = np.abs(field) < CLEARANCE
    field[too_close] = np.where(solid[too_close], np.float32(CLEARANCE), np.float32(-CLEARANCE))
    np.multiply(field, np.float32(TIE), out=field, where=solid)
    return solid
