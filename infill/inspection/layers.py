"""The connections of a layer: components, holes and Euler number, and their changes by smoothing.

All decisions are those of marching cubes: the field is bilinear between cell centres, and two solid
cells that touch at a corner are joined if the saddle between them is solid. The Euler number of an
extruded layer is therefore twice the number found here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.contours.zero_contours import TIE
from infill.graph import label_connected
from infill.grid import VOID
from infill.inspection.changes import ConnectionCounts, TopologyChanges
from infill.inspection.component_matching import compare_components, count_overlaps
from infill.pixels import label_pixels, open_pixels

PINHOLE = 3  # cells: in a void with no room for a square of this side, every cell touches a wall


@dataclass(frozen=True, kw_only=True)
class LayerTopology:
    """Counts of one layer.

    Parameters
    ----------
    components : int
        Components of solid.
    holes : int
        Components of void that solid encloses.
    """

    components: int
    holes: int

    @property
    def euler_number(self) -> int:
        """Components minus holes; the surface of the extruded layer has twice that."""
        return self.components - self.holes

    @property
    def extruded(self) -> ConnectionCounts:
        """Connections of the extruded layer: holes become tunnels."""
        return ConnectionCounts.of(components=self.components, cavities=0, tunnels=self.holes)


@dataclass(frozen=True, kw_only=True)
class LayerRegions:
    """Every cell of a layer, with a shell of void around it, numbered by the component it belongs to.

    Parameters
    ----------
    solid : (nx + 2, ny + 2) int
        1, 2 … in the components of solid, 0 in void.
    void : (nx + 2, ny + 2) int
        The same for the void; the outside is one of its components.
    """

    solid: NDArray[np.integer]
    void: NDArray[np.integer]

    @property
    def topology(self) -> LayerTopology:
        """Count the components and the holes."""
        return LayerTopology(components=int(self.solid.max()), holes=int(self.void.max()) - 1)


def label_regions(layer: NDArray[np.floating]) -> LayerRegions:
    """Label the components of solid and of void of a layer (nx, ny)."""
    field = np.pad(layer, 1, constant_values=VOID)
    solid = field > 0
    joined, separated = _saddles(field, solid)
    return LayerRegions(solid=_label_cells(solid, joined), void=_label_cells(~solid, separated))


def count_layer(layer: NDArray[np.floating]) -> LayerTopology:
    """Count the components and holes of a layer (nx, ny).

    >>> count_layer(np.pad(-np.ones((2, 2)), 2, constant_values=1.0))
    LayerTopology(components=1, holes=1)
    """
    return label_regions(layer).topology


def compare_layers(before: LayerRegions, after: LayerRegions, *, line_cells: int = PINHOLE) -> TopologyChanges:
    """Compare two states of the same layer, component by component.

    A pinhole is a void that vanished, or a neck of a void that was cut, with no room for a square of `PINHOLE` cells a
    side, or of a line's width if that is fewer cells; or a void that is smaller than a square of a line's width.
    Pinholes remain where lines meet at an acute angle, run side by side or end at a side of the block, and are too
    small to print in.

    Parameters
    ----------
    before, after : LayerRegions
    line_cells : int
        Cells across a line: anything as wide as a line is not a pinhole.
    """
    void_overlaps = count_overlaps(before.void, after.void)
    solid, voids = compare_components(count_overlaps(before.solid, after.solid)), compare_components(void_overlaps)
    open_void = open_pixels(before.void > 0, min(PINHOLE, line_cells))
    cores = _label_cells(open_void, np.empty((0, 2), dtype=np.intp))
    has_room = np.zeros(void_overlaps.before, dtype=bool)
    has_room[np.unique(before.void[open_void]) - 1] = True
    cells = np.bincount(before.void.ravel(), minlength=void_overlaps.before + 1)[1:]
    has_room &= cells >= line_cells**2
    outside = cells[before.void[0, 0] - 1]
    narrow = ~voids.kept & ~has_room
    cut = compare_components(count_overlaps(cores, after.void)).breaks
    return TopologyChanges(
        vanished=len(solid.vanished),
        broken=solid.breaks,
        fused=solid.fusions,
        appeared=len(solid.appeared),
        voids_closed=int((~voids.kept & has_room).sum()),
        voids_cut=cut,
        voids_joined=voids.fusions,
        walls_pierced=len(voids.appeared),
        pinholes=int(narrow.sum()) + max(0, voids.breaks - cut),
        pinhole_share=float(cells[narrow].sum() / max(1, cells.sum() - outside)),
    )


@dataclass(frozen=True, kw_only=True)
class LayerInspection:
    """What smoothing did to a layer.

    Parameters
    ----------
    before, after : ConnectionCounts
        Of the layer, extruded.
    changes : TopologyChanges
        Component by component.
    area : float
        Solid area before, in cells.
    area_change : float
        As a share of it.
    """

    before: ConnectionCounts
    after: ConnectionCounts
    changes: TopologyChanges
    area: float
    area_change: float


def inspect_smoothing(before: NDArray[np.floating], after: NDArray[np.floating], *, line_cells: int) -> LayerInspection:
    """Compare a layer (nx, ny) with its smoothed state, whose lines are some cells wide."""
    regions, smoothed_regions = label_regions(before), label_regions(after)
    area = solid_area(before)
    return LayerInspection(
        before=regions.topology.extruded,
        after=smoothed_regions.topology.extruded,
        changes=compare_layers(regions, smoothed_regions, line_cells=line_cells),
        area=area,
        area_change=solid_area(after) / area - 1,
    )


def solid_area(layer: NDArray[np.floating]) -> float:
    """Measure the area, in cells, inside the zero contour that marching squares draws, saddles joined.

    >>> round(solid_area(np.ones((4, 4))), 9)  # the four corners are cut off
    15.5
    """
    field = np.pad(layer, 1, constant_values=VOID)
    is_solid = field > 0
    squares = [(slice(i, i - 1 or None), slice(j, j - 1 or None)) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    count = np.zeros(tuple(n - 1 for n in field.shape), dtype=np.int8)
    for square in squares:
        count += is_solid[square]
    mixed = np.nonzero((count > 0) & (count < 4))
    value = np.stack([field[square][mixed] for square in squares]).astype(np.float64)
    solid, following = value > 0, np.roll(value, -1, axis=0)
    crossed = solid != (following > 0)
    # Distance of the contour from a corner, along its sides to the next corner and to the previous one.
    ahead = np.where(crossed, value / np.where(crossed, value - following, 1), 0)
    behind = np.where(np.roll(crossed, 1, axis=0), 1 - np.roll(ahead, 1, axis=0), 0)
    corner = ahead * behind / 2
    solid_corners = count[mixed]
    adjacent = (solid_corners == 2) & (solid[0] != solid[2])  # two corners on one side: a trapezium
    area = np.where(
        adjacent,
        ((ahead + behind) * solid).sum(axis=0) / 2,
        np.where(solid_corners == 1, (corner * solid).sum(axis=0), 1 - (corner * ~solid).sum(axis=0)),
    )
    return float((count == 4).sum() + area.sum())


def _saddles(field: NDArray[np.floating], solid: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Find the diagonal pairs of cells joined by a saddle, of solid and of void; return (N, 2) flat indices each."""
    a, b, c, d = (solid[i : i - 1 or None, j : j - 1 or None] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    i, j = np.nonzero((a == c) & (b == d) & (a != b))
    values = np.stack([field[i, j], field[i + 1, j], field[i + 1, j + 1], field[i, j + 1]]).astype(np.float64)
    flat = np.stack([row * field.shape[1] + column for row, column in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))])
    falling = solid[i, j]  # the solid pair is (i, j) and (i + 1, j + 1)
    falling_pair, rising_pair = flat[[0, 2]].T, flat[[1, 3]].T
    solid_pair = np.where(falling[:, None], falling_pair, rising_pair)
    void_pair = np.where(falling[:, None], rising_pair, falling_pair)
    product, cross = values[0] * values[2], values[1] * values[3]
    joins = np.where(falling, product * TIE**2 > cross, cross * TIE**2 > product)
    return solid_pair[joins], void_pair[~joins]


def _label_cells(inside: NDArray[np.bool_], pairs: NDArray[np.intp]) -> NDArray[np.integer]:
    """Label cells that touch at a side, or at a corner listed in `pairs`."""
    numbers, count = label_pixels(inside)
    if len(pairs) == 0:
        return numbers
    ends = numbers.ravel()[pairs]
    merged, _ = label_connected(ends[:, 0], ends[:, 1], count + 1)
    # Number 0, for unlabelled cells, is in no pair: it stays alone, and components are numbered from 1.
    _, renumbered = np.unique(merged[1:], return_inverse=True)
    return np.asarray(np.concatenate([[0], renumbered + 1])[numbers])
