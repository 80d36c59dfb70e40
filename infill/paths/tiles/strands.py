"""The zero contours of a tile as paths over the plane: followed from tile to tile, resampled, and repeated.

A contour that leaves the tile goes on in the next one. So each is followed on the torus, until it comes back to where
it began: in the same tile, then it is closed, or in another one, then it goes on for ever and repeats itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.paths.tiles.nodes import TileGrid

Floats = NDArray[np.float64]
Bounds = tuple[float, float, float, float]

DEVIATION = 0.008  # mm between a path and its contour
LONGEST = 2.0  # mm, of a chord
SHORTEST = 0.05  # mm
TURN = 0.35  # rad, from chord to chord, where that asks for more than the deviation: radii below 0.5 mm
LEAST = 1e-6
EVENED = 1.5  # grid cells over which the steps of the grid are evened out
PER_CELL = 4  # points of a contour per grid cell while it is evened out


@dataclass(frozen=True, kw_only=True, eq=False)
class Strand:
    """One contour over the plane.

    Parameters
    ----------
    points : (N, 2) float64
        mm, from its beginning to where it comes back.
    tiles : (int, int)
        Tiles from there to its beginning; (0, 0) for a closed one.
    """

    points: Floats
    tiles: tuple[int, int]


def tile_strands(field: Floats, grid: TileGrid) -> list[Strand]:
    """Return the zero contours of a padded tile's field, each once, as long as the least period."""
    from skimage.measure import find_contours

    nx, ny = grid.shape
    inner = field[grid.pad : grid.pad + nx + 1, grid.pad : grid.pad + ny + 1].copy()
    # No contour may pass through a node, least of all through a corner, where it would change sides.
    inner[np.abs(inner) < LEAST] = LEAST
    # The last nodes are the first of the next tile, in the same colours or in the opposite ones.
    inner[-1] = inner[0] * _alike(inner[0], inner[-1])
    inner[:, -1] = inner[:, 0] * _alike(inner[:, 0], inner[:, -1])
    contours = find_contours(inner, 0.0)  # type: ignore[no-untyped-call]
    strands = []
    for points, tiles in _followed(contours, (nx, ny)):
        smooth = _resampled(points * grid.spacing, np.array(tiles) * grid.size, grid)
        if len(smooth) > 2:
            strands.append(Strand(points=smooth + _origin(grid), tiles=tiles))
    return strands


def _origin(grid: TileGrid) -> Floats:
    origin: Floats = grid.first + np.array(grid.spacing) * grid.pad
    return origin


def _alike(first: Floats, last: Floats) -> float:
    """Return 1 where two opposite edges of a tile have the same colours, -1 where they have opposite ones."""
    return 1.0 if float(first @ last) >= 0 else -1.0


def _followed(contours: list[Floats], shape: tuple[int, int]) -> list[tuple[Floats, tuple[int, int]]]:
    """Return contours of a tile put together across its edges, and by how many tiles each moves on."""
    box = np.array(shape)
    closed = [np.array_equal(points[0], points[-1]) for points in contours]
    whole = [(points, (0, 0)) for points, is_closed in zip(contours, closed, strict=True) if is_closed]
    pieces = [points for points, is_closed in zip(contours, closed, strict=True) if not is_closed]
    if not pieces:
        return whole
    # End 2 k is the first of piece k, 2 k + 1 its last. Exactly two ends lie at a place on the torus.
    places = np.mod(np.concatenate([points[[0, -1]] for points in pieces]), box)
    order = np.lexsort(places.T)
    other = np.empty(len(order), dtype=int)
    other[order[::2]], other[order[1::2]] = order[1::2], order[::2]
    left = set(range(len(pieces)))
    while left:
        first = end = 2 * min(left)
        shift = np.zeros(2, dtype=int)
        chain: list[Floats] = []
        while not chain or end != first:
            left.discard(end // 2)
            points = pieces[end // 2] if end % 2 == 0 else pieces[end // 2][::-1]
            chain.append(points[:-1] + shift * box)
            end = int(other[end ^ 1])
            arriving = pieces[end // 2][-(end % 2)]
            shift = shift + np.round((points[-1] - arriving) / box).astype(int)
        whole.append((np.vstack([*chain, chain[0][:1] + shift * box]), (int(shift[0]), int(shift[1]))))
    return whole


def _resampled(points: Floats, period: Floats, grid: TileGrid) -> Floats:
    """Return a contour in chords, the shorter the more it bends, and freed of the steps of the grid.

    Points are spread evenly, averaged with their neighbours by a Gaussian over `EVENED` cells, and then taken where
    the integral of sqrt(curvature / (8 deviation)) passes whole numbers: a chord of length s lies s² / 8 R away.
    """
    h = min(grid.spacing)
    steps = np.hypot(*np.diff(points, axis=0).T)
    arc = np.concatenate([[0], np.cumsum(steps)])
    count = max(16, math.ceil(PER_CELL * arc[-1] / h))
    even = np.linspace(0, arc[-1], count, endpoint=False)
    line = np.stack([np.interp(even, arc, axis) for axis in points.T], axis=1)
    drift = period * (even / arc[-1])[:, None]
    frequency = np.fft.rfftfreq(count, d=arc[-1] / count)
    damping = np.exp(-2 * (math.pi * EVENED * h * frequency) ** 2)[:, None]
    spectrum = np.fft.rfft(line - drift, axis=0) * damping
    angular = 2j * math.pi * frequency[:, None]
    line = np.fft.irfft(spectrum, count, axis=0) + drift
    first = np.fft.irfft(spectrum * angular, count, axis=0) + period / arc[-1]
    second = np.fft.irfft(spectrum * angular**2, count, axis=0)
    speed = np.maximum(np.hypot(*first.T), 1e-9)
    curvature = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3
    density = np.maximum(np.sqrt(curvature / (8 * DEVIATION)), curvature / TURN)
    density = np.clip(density, 1 / LONGEST, 1 / SHORTEST)
    done = np.concatenate([[0], np.cumsum(density) * arc[-1] / count])
    wanted = np.linspace(0, done[-1], max(8, math.ceil(done[-1])) + 1)
    place = np.interp(wanted, done, np.arange(count + 1))
    around = np.vstack([line, line[:1] + period])
    chosen: Floats = np.stack([np.interp(place, np.arange(count + 1), axis) for axis in around.T], axis=1)
    return chosen


def repeated(strands: list[Strand], size: tuple[float, float], bounds: Bounds) -> list[Floats]:
    """Return the strands over a box, in every tile in which they touch it; what goes on is one long path."""
    paths: list[Floats] = []
    for strand in strands:
        low, high = strand.points.min(axis=0), strand.points.max(axis=0)
        first = np.ceil((np.array(bounds[:2]) - high) / size).astype(int)
        last = np.floor((np.array(bounds[2:]) - low) / size).astype(int)
        tiles = [(i, j) for i in range(first[0], last[0] + 1) for j in range(first[1], last[1] + 1)]
        if strand.tiles == (0, 0):
            paths += [strand.points + np.array(tile) * size for tile in tiles]
            continue
        there = set(tiles)
        a, b = strand.tiles
        for i, j in tiles:
            if (i - a, j - b) in there:
                continue
            row = [(i, j)]
            while (row[-1][0] + a, row[-1][1] + b) in there:
                row.append((row[-1][0] + a, row[-1][1] + b))
            parts = [strand.points[:-1] + np.array(tile) * size for tile in row]
            paths.append(np.vstack([*parts, strand.points[-1:] + np.array(row[-1]) * size]))
    return paths
