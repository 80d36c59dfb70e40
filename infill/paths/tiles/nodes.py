"""The periodic grid of a tile, distances from its nodes to lines, and the colours between lines."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import GeometryError
from infill.plain_numbers import plain_argument
from infill.ragged import expand_rows

CELLS_PER_LINE = 8  # grid cells in a line width, so that touching paths stay seven cells apart
COARSEST = 5
MOST_CELLS = 6_000_000
MOST_WORK = 2e8  # cells times squared blurs in cells: some seconds of smoothing
GRID_OFFSET = (math.sqrt(2) - 1, math.sqrt(5) - 2)  # drawings have no lines there
MARGIN = 4.0  # blurs beyond which smoothing does not reach
LEAST_FINE = COARSEST / CELLS_PER_LINE  # limit of the coarsening that saves work
AT_ONCE = 2_000_000


@dataclass(frozen=True, kw_only=True)
class TileGrid:
    """Nodes of a grid with the period of a tile.

    Parameters
    ----------
    size : (width, height)
        Of the tile, mm.
    shape : (nx, ny)
        Cells of the tile.
    pad : int
        Cells around it that are copies of its other side.
    """

    size: tuple[float, float]
    shape: tuple[int, int]
    pad: int

    @property
    def spacing(self) -> tuple[float, float]:
        """Distance between nodes, mm."""
        return self.size[0] / self.shape[0], self.size[1] / self.shape[1]

    @property
    def first(self) -> Floats:
        """The first node, that of the padding, mm."""
        return (np.array(GRID_OFFSET) - self.pad) * self.spacing

    @property
    def nodes(self) -> tuple[int, int]:
        """Number of nodes along each axis, with the padding; the tile's last node is the first of the next one."""
        return self.shape[0] + 2 * self.pad + 1, self.shape[1] + 2 * self.pad + 1


def tile_grid(size: tuple[float, float], *, line_width: float, blur: float) -> TileGrid:
    """Return a grid fine enough for the line width, or raise GeometryError where it would hold too many cells."""
    cells = size[0] * size[1] * (CELLS_PER_LINE / line_width) ** 2
    work = cells * (CELLS_PER_LINE * blur / line_width) ** 2
    fine = CELLS_PER_LINE * min(1.0, math.sqrt(MOST_CELLS / cells), max((MOST_WORK / work) ** 0.25, LEAST_FINE))
    if fine < COARSEST:
        limit = math.sqrt(MOST_CELLS) * line_width / COARSEST
        raise GeometryError(
            f"a tile of {plain_argument(size[0], 4)} × {plain_argument(size[1], 4)} mm is too large for lines of "
            f"{plain_argument(line_width)} mm; the limit is {limit:.0f} × {limit:.0f} mm or the same area; make the "
            "cell smaller"
        )
    spacing = line_width / fine
    shape = max(16, round(size[0] / spacing)), max(16, round(size[1] / spacing))
    return TileGrid(size=size, shape=shape, pad=math.ceil(MARGIN * blur / spacing) + CELLS_PER_LINE)


def distance_field(edges: Floats, grid: TileGrid, band: float) -> Floats:
    """Compute the distance to the nearest edge at every node, at most `band`, mm."""
    distance = np.full(grid.nodes, band)
    edges = split_edges(edges, 4 * max(grid.spacing))
    low = np.floor((edges.min(axis=1) - band - grid.first) / grid.spacing).astype(int) + 1
    high = np.floor((edges.max(axis=1) + band - grid.first) / grid.spacing).astype(int)
    low, high = np.maximum(low, 0), np.minimum(high, np.array(grid.nodes) - 1)
    wide = np.maximum(high - low + 1, 0)
    direction = edges[:, 1] - edges[:, 0]
    squared = np.maximum((direction**2).sum(axis=1), 1e-30)
    flat = distance.ravel()
    for edge, place in expand_rows(wide[:, 0] * wide[:, 1], AT_ONCE):
        i = low[edge, 0] + place // wide[edge, 1]
        j = low[edge, 1] + place % wide[edge, 1]
        offset = np.stack([i, j], axis=1) * grid.spacing + grid.first - edges[edge, 0]
        part = np.clip((offset * direction[edge]).sum(axis=1) / squared[edge], 0, 1)[:, None]
        np.minimum.at(flat, i * grid.nodes[1] + j, np.hypot(*(offset - part * direction[edge]).T))
    return distance


def periodic_copies(shapes: Floats, grid: TileGrid, band: float) -> Floats:
    """Copy shapes (N, ..., 2) to the next tiles, as far as the padding and `band` reach."""
    if not len(shapes):
        return shapes
    points = shapes.reshape(len(shapes), -1, 2)
    size = np.array(grid.size)
    low, high = points.min(axis=1), points.max(axis=1)
    lowest = np.floor((grid.first - band - high.max(axis=0)) / size).astype(int)
    high_corner = grid.first + np.array(grid.nodes) * grid.spacing
    highest = np.ceil((high_corner + band - low.min(axis=0)) / size).astype(int)
    copies = []
    for i in range(lowest[0], highest[0] + 1):
        for j in range(lowest[1], highest[1] + 1):
            shift = size * (i, j)
            # Shapes to the left or below stay: the colours of a row are counted from there.
            is_close = ((low + shift < high_corner + band) & (high + shift > grid.first - band)).all(axis=1)
            copies.append(shapes[is_close] + shift)
    return np.concatenate(copies)


def split_edges(edges: Floats, longest: float) -> Floats:
    """Cut edges into pieces no longer than `longest`."""
    counts = np.maximum(1, np.ceil(np.hypot(*(edges[:, 1] - edges[:, 0]).T) / longest)).astype(int)
    pieces = []
    for edge, place in expand_rows(counts, AT_ONCE):
        start, along = edges[edge, 0], edges[edge, 1] - edges[edge, 0]
        share = np.stack([place, place + 1], axis=1) / counts[edge, None]
        pieces.append(start[:, None] + share[..., None] * along[:, None])
    return np.concatenate(pieces) if pieces else edges


def colour_parity(edges: Floats, grid: TileGrid) -> NDArray[np.bool_]:
    """Compute the colour of every node: the parity of the borders crossed from the first node, along y, then x."""
    scaled = (edges - grid.first) / grid.spacing
    flips = np.zeros(grid.nodes, dtype=np.int64)
    row, x = _crossed_lines(scaled, 1, grid.nodes[1])
    column = np.floor(x).astype(int) + 1
    is_inside = (column > 0) & (column < grid.nodes[0])
    np.add.at(flips, (column[is_inside], row[is_inside]), 1)
    _, y = _crossed_lines(scaled, 0, 1)
    start = np.floor(y).astype(int) + 1
    start = start[(start > 0) & (start < grid.nodes[1])]
    sides = np.cumsum(np.bincount(start, minlength=grid.nodes[1]))
    parity: NDArray[np.bool_] = (np.cumsum(flips, axis=0) + sides) % 2 == 1
    return parity


def _crossed_lines(edges: Floats, axis: int, count: int) -> tuple[NDArray[np.int64], Floats]:
    """Find the lines 0, 1, 2 … across an axis that each edge crosses, and where; an end on one lies above it."""
    line_above = np.ceil(np.nextafter(edges[..., axis], np.inf)).astype(int)  # the first line above each end
    low, high = np.clip(np.sort(line_above, axis=1), 0, count).T
    rows, places = [np.empty(0, dtype=np.int64)], [np.empty(0)]
    for edge, place in expand_rows(high - low, AT_ONCE):
        row = low[edge] + place
        a, b = edges[edge, 0], edges[edge, 1]
        share = (row - a[:, axis]) / (b[:, axis] - a[:, axis])
        rows.append(row)
        places.append(a[:, 1 - axis] + share * (b[:, 1 - axis] - a[:, 1 - axis]))
    return np.concatenate(rows), np.concatenate(places)
