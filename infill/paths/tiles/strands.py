"""The zero contours of a tile as paths over the plane: followed from tile to tile, resampled, and repeated.

A contour that leaves the tile continues in the next one. So each is followed on the torus, until it returns to its
beginning: a contour that returns in the same tile is closed; one that returns in another tile repeats without end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.arrays import Floats
from infill.paths.tiles.nodes import TileGrid

Bounds = tuple[float, float, float, float]

DEVIATION = 0.008  # mm between a path and its contour
LONGEST = 2.0  # mm, of a chord
SHORTEST = 0.05  # mm
TURN = 0.35  # rad, from chord to chord, the stricter limit at radii below 0.5 mm
LEAST = 1e-6
SMOOTHING_CELLS = 1.5  # grid cells over which the steps of the grid are evened out
PER_CELL = 4  # points of a contour per grid cell while it is evened out


@dataclass(frozen=True, kw_only=True, eq=False)
class Strand:
    """One contour over the plane.

    Parameters
    ----------
    points : (N, 2) float64
        mm, from its beginning to its return.
    tiles : (int, int)
        Tiles from its beginning to its return; (0, 0) for a closed one.
    """

    points: Floats
    tiles: tuple[int, int]


def tile_strands(field: Floats, grid: TileGrid) -> list[Strand]:
    """Trace the zero contours of a padded tile's field, each once, as long as the least period."""
    from skimage.measure import find_contours

    nx, ny = grid.shape
    inner = field[grid.pad : grid.pad + nx + 1, grid.pad : grid.pad + ny + 1].copy()
    # No contour may pass through a node, least of all through a corner, where it would change sides.
    inner[np.abs(inner) < LEAST] = LEAST
    # The last nodes are the first of the next tile, in the same colours or in the opposite ones.
    inner[-1] = inner[0] * _edge_sign(inner[0], inner[-1])
    inner[:, -1] = inner[:, 0] * _edge_sign(inner[:, 0], inner[:, -1])
    contours = find_contours(inner, 0.0)  # type: ignore[no-untyped-call]
    strands = []
    for points, tiles in _follow_contours(contours, (nx, ny)):
        smooth = _resample_contour(points * grid.spacing, np.array(tiles) * grid.size, grid)
        if len(smooth) > 2:
            strands.append(Strand(points=smooth + _origin(grid), tiles=tiles))
    return strands


def _origin(grid: TileGrid) -> Floats:
    """Return the first node of the tile itself, behind the padding, mm."""
    origin: Floats = grid.first + np.array(grid.spacing) * grid.pad
    return origin


def _edge_sign(a: Floats, b: Floats) -> float:
    """Return 1 if two opposite edges of a tile have the same colours, -1 if they have opposite ones."""
    return 1.0 if float(a @ b) >= 0 else -1.0


def _follow_contours(contours: list[Floats], shape: tuple[int, int]) -> list[tuple[Floats, tuple[int, int]]]:
    """Join contours of a tile across its edges; return each with the number of tiles that it moves on."""
    box = np.array(shape)
    closed = [np.array_equal(points[0], points[-1]) for points in contours]
    joined = [(points, (0, 0)) for points, is_closed in zip(contours, closed, strict=True) if is_closed]
    pieces = [points for points, is_closed in zip(contours, closed, strict=True) if not is_closed]
    if not pieces:
        return joined
    # End 2 k is the first of piece k, 2 k + 1 its last. Exactly two ends lie at a place on the torus.
    places = np.mod(np.concatenate([points[[0, -1]] for points in pieces]), box)
    order = np.lexsort(places.T)
    partner = np.empty(len(order), dtype=int)
    partner[order[::2]], partner[order[1::2]] = order[1::2], order[::2]
    unused = set(range(len(pieces)))
    while unused:
        start = end = 2 * min(unused)
        shift = np.zeros(2, dtype=int)
        chain: list[Floats] = []
        while not chain or end != start:
            unused.discard(end // 2)
            points = pieces[end // 2] if end % 2 == 0 else pieces[end // 2][::-1]
            chain.append(points[:-1] + shift * box)
            end = int(partner[end ^ 1])
            arriving = pieces[end // 2][-(end % 2)]
            shift = shift + np.round((points[-1] - arriving) / box).astype(int)
        joined.append((np.vstack([*chain, chain[0][:1] + shift * box]), (int(shift[0]), int(shift[1]))))
    return joined


def _resample_contour(points: Floats, period: Floats, grid: TileGrid) -> Floats:
    """Resample a contour in chords that are shorter where it bends more, without the steps of the grid.

    Points are spread evenly, averaged by a Gaussian over `SMOOTHING_CELLS` cells, and then taken where
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
    damping = np.exp(-2 * (math.pi * SMOOTHING_CELLS * h * frequency) ** 2)[:, None]
    spectrum = np.fft.rfft(line - drift, axis=0) * damping
    angular = 2j * math.pi * frequency[:, None]
    line = np.fft.irfft(spectrum, count, axis=0) + drift
    velocity = np.fft.irfft(spectrum * angular, count, axis=0) + period / arc[-1]
    acceleration = np.fft.irfft(spectrum * angular**2, count, axis=0)
    speed = np.maximum(np.hypot(*velocity.T), 1e-9)
    curvature = np.abs(velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0]) / speed**3
    density = np.maximum(np.sqrt(curvature / (8 * DEVIATION)), curvature / TURN)
    density = np.clip(density, 1 / LONGEST, 1 / SHORTEST)
    chord_count = np.concatenate([[0], np.cumsum(density) * arc[-1] / count])
    positions = np.linspace(0, chord_count[-1], max(8, math.ceil(chord_count[-1])) + 1)
    place = np.interp(positions, chord_count, np.arange(count + 1))
    closed_line = np.vstack([line, line[:1] + period])
    resampled: Floats = np.stack([np.interp(place, np.arange(count + 1), axis) for axis in closed_line.T], axis=1)
    return resampled


def repeat_strands(strands: list[Strand], size: tuple[float, float], bounds: Bounds) -> list[Floats]:
    """Repeat the strands over a box, in every tile in which they touch it; connected copies form one long path."""
    paths: list[Floats] = []
    for strand in strands:
        low, high = strand.points.min(axis=0), strand.points.max(axis=0)
        lowest = np.ceil((np.array(bounds[:2]) - high) / size).astype(int)
        highest = np.floor((np.array(bounds[2:]) - low) / size).astype(int)
        tiles = [(i, j) for i in range(lowest[0], highest[0] + 1) for j in range(lowest[1], highest[1] + 1)]
        if strand.tiles == (0, 0):
            paths += [strand.points + np.array(tile) * size for tile in tiles]
            continue
        tile_set = set(tiles)
        a, b = strand.tiles
        for i, j in tiles:
            if (i - a, j - b) in tile_set:
                continue
            row = [(i, j)]
            while (row[-1][0] + a, row[-1][1] + b) in tile_set:
                row.append((row[-1][0] + a, row[-1][1] + b))
            parts = [strand.points[:-1] + np.array(tile) * size for tile in row]
            paths.append(np.vstack([*parts, strand.points[-1:] + np.array(row[-1]) * size]))
    return paths
