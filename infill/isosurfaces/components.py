"""Components of solid and of void in a field of bricks: their number, sizes and thickness, and the shells between.

The search works on rows of sixteen bits and on the bricks that are kept, so that the cost grows with the surface. Solid
cells are joined by faces, void cells by faces and edges, as marching cubes joins them on raw data.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.sparse_marching import rows_above
from infill.kernels import components as kernels
from infill.kernels.disjoint_sets import name_sets
from infill.kernels.sparse import BRICK, CELLS, SOLID_BRICK, VOID_BRICK
from infill.kernels.sparse_marching import ROWS, face_volumes
from infill.kernels.threads import in_threads, thread_count
from infill.meshes.shells import shell_volumes, vertex_components
from infill.phasefield.sparse import SparseField
from infill.surface import Surface

HIGH_BITS = 26  # of the largest value: as many add up exactly


@dataclass(frozen=True, kw_only=True)
class Components:
    """The components of solid, or of void, of one field.

    Parameters
    ----------
    cells : (b,) int64
        Cells of each component.
    thick : (b,) bool
        Whether a component contains 2 x 2 x 2 cells, and so is more than one cell thick; empty if not requested.
    bits, bricks, starts, alone, names
        Tables from cells to components: bits of every row, numbers of runs, bricks of one value, and names for both.
    """

    cells: NDArray[np.int64]
    thick: NDArray[np.bool_]
    bits: NDArray[np.uint16]
    bricks: NDArray[np.int64]
    starts: NDArray[np.int16]
    alone: NDArray[np.int32]
    names: NDArray[np.int32]

    @property
    def count(self) -> int:
        """Number of components."""
        return len(self.cells)


@dataclass(frozen=True, kw_only=True)
class SurfaceShells:
    """The connected parts of a surface.

    Parameters
    ----------
    names : (V,) int32
        Shell of each vertex; -1 for one that no face uses.
    volume : (s,) float64
        Enclosed volume, mm³; negative for the walls of a cavity.
    slope : (s,) float64
        Its change when the level rises by one, mm³.
    euler : (s,) int64
        Euler number.
    """

    names: NDArray[np.int32]
    volume: NDArray[np.float64]
    slope: NDArray[np.float64]
    euler: NDArray[np.int64]

    @property
    def components(self) -> int:
        """Components of solid."""
        return int((self.volume > 0).sum())

    @property
    def cavities(self) -> int:
        """Components of void that solid encloses."""
        return int((self.volume <= 0).sum())

    @property
    def tunnels(self) -> int:
        """Handles: holes that pass through."""
        return int((2 - self.euler).sum() // 2)


def solid_bits(field: SparseField, *, level: float = 0.0, threads: int | None = None) -> NDArray[np.uint16]:
    """Mark the cells of the kept bricks that are above the level, as bits: (n, rows) uint16."""
    return rows_above(field, field.values, level, threads=threads)


def data_bits(field: SparseField, *, threads: int | None = None) -> NDArray[np.uint16]:
    """Mark the cells of the kept bricks that are solid in the data, as bits: (n, rows) uint16."""
    return rows_above(field, field.data, 0.0, threads=threads)


def erode_to_cores(field: SparseField, bits: NDArray[np.uint16], *, threads: int | None = None) -> NDArray[np.uint16]:
    """Erode: mark the lower corners of all solid blocks of 2 x 2 x 2 cells, where solid is thicker than one cell."""
    return _meet_or_spread(field, bits, True, 1, threads)


def dilate_cores(field: SparseField, core: NDArray[np.uint16], *, threads: int | None = None) -> NDArray[np.uint16]:
    """Dilate: mark all cells of the 2 x 2 x 2 blocks whose lower corners are given."""
    return _meet_or_spread(field, core, False, -1, threads)


def open_by_blocks(
    field: SparseField,
    bits: NDArray[np.uint16],
    *,
    void: bool = False,
    cells: int = 2,
    threads: int | None = None,
) -> NDArray[np.uint16]:
    """Open by blocks of `cells` along each side: mark the cells of solid, or void, that is at least that thick."""
    kind = VOID_BRICK if void else SOLID_BRICK
    marked = ~bits if void else bits
    for _ in range(cells - 1):
        marked = _meet_or_spread(field, marked, True, 1, threads, kind)
    for _ in range(cells - 1):
        marked = _meet_or_spread(field, marked, False, -1, threads, kind)
    return marked


def dilate(
    field: SparseField, bits: NDArray[np.uint16], cells: int, *, threads: int | None = None
) -> NDArray[np.uint16]:
    """Dilate by a number of cells along each axis."""
    for _ in range(cells):
        bits = _meet_or_spread(field, _meet_or_spread(field, bits, False, -1, threads), False, 1, threads)
    return bits


def look_up_cells(
    field: SparseField, bits: NDArray[np.uint16], cells: NDArray[np.integer], *, void: bool = False
) -> NDArray[np.bool_]:
    """Look up cells (N, 3) of the grid: True where set. Beyond the grid lies void, not solid."""
    inside: NDArray[np.bool_] = np.all((cells >= 0) & (cells < field.shape), axis=1)
    brick, cell = np.divmod(np.where(inside[:, None], cells, 0) + 1, BRICK)
    slot = field.slots[tuple(brick.T)]
    row = bits[slot, cell[:, 0] * BRICK[1] + cell[:, 1]] if len(bits) else np.zeros(len(cells), dtype=np.uint16)
    state = np.where(
        slot >= 0, (row >> cell[:, 2].astype(np.uint16)) & 1, slot == (VOID_BRICK if void else SOLID_BRICK)
    )
    is_set: NDArray[np.bool_] = (state != 0) & inside | (void & ~inside)
    return is_set


def _meet_or_spread(
    field: SparseField,
    bits: NDArray[np.uint16],
    meet: bool,
    direction: int,
    threads: int | None,
    kind: int = SOLID_BRICK,
) -> NDArray[np.uint16]:
    """Erode (`meet`) or dilate a field of bits by one cell, from the side that `direction` tells."""
    out = np.empty_like(bits)
    in_threads(
        kernels.meet_or_spread,
        field.slots,
        field.where,
        bits,
        kind,
        meet,
        direction,
        out,
        threads=thread_count(threads),
    )
    return out


def find_components(
    field: SparseField, bits: NDArray[np.uint16], *, void: bool = False, whole: bool = True, thickness: bool = False
) -> Components:
    """Label the components of solid, whose cells are `bits`, or those of void, the outside first.

    Without `whole`, only the cells in `bits` count, not the bricks that are solid throughout. With `thickness`, the
    result says which components are more than one cell thick.
    """
    alone = np.full(field.slots.shape, -1, dtype=np.int32)
    if void:
        bits = ~bits
        single = (field.slots < 0) & (field.slots != SOLID_BRICK)
    else:
        single = (field.slots == SOLID_BRICK) & whole
    bricks = np.empty(len(bits), dtype=np.int64)
    starts = np.empty((len(bits), ROWS), dtype=np.int16)
    runs = kernels.number_runs(bits, bricks, starts)
    alone[single] = runs + np.arange(single.sum())
    parent = np.arange(runs + int(single.sum()))
    if void:
        kernels.join_beyond(field.where, bits, bricks, starts, field.shape, parent)
        rim = np.zeros(alone.shape, dtype=bool)
        for axis in range(3):
            rim[tuple([0, -1] if dimension == axis else slice(None) for dimension in range(3))] = True
        parent[alone[single & rim]] = 0
    kernels.join_alone(alone, parent)
    kernels.join_runs(field.slots, field.where, bits, bricks, starts, alone, parent, void)
    names = np.empty(len(parent), dtype=np.int32)
    count = name_sets(parent, names)
    cells = np.zeros(count, dtype=np.int64)
    kernels.count_cells(field.where, bits, bricks, starts, field.shape, names, cells)
    np.add.at(cells, names[alone[single]], brick_sides_on_grid(np.argwhere(single), field.shape).prod(axis=1))
    if not void:  # run 0 lies beyond the grid, which is not solid
        cells, names = cells[1:], names - 1
    labelled = Components(
        cells=cells, thick=np.empty(0, dtype=bool), bits=bits, bricks=bricks, starts=starts, alone=alone, names=names
    )
    return add_thickness(field, labelled, void=void) if thickness else labelled


def add_thickness(field: SparseField, labelled: Components, *, void: bool = False) -> Components:
    """Add to components whether each is more than one cell thick."""
    thick = np.zeros(labelled.count, dtype=bool)
    kind = VOID_BRICK if void else SOLID_BRICK
    core = _meet_or_spread(field, labelled.bits, True, 1, threads=1, kind=kind)
    kernels.mark_runs(labelled.bits, labelled.bricks, labelled.starts, labelled.names, core, thick)
    places = np.argwhere(labelled.alone >= 0)
    if not void:  # a solid brick that the grid cuts off may be a sheet there; void continues beyond the grid
        places = places[(brick_sides_on_grid(places, field.shape) > 1).all(axis=1)]
    thick[labelled.names[labelled.alone[tuple(places.T)]]] = True
    return replace(labelled, thick=thick)


def brick_sides_on_grid(places: NDArray[np.integer], shape: tuple[int, int, int]) -> NDArray[np.int64]:
    """Return the sides, in cells, of the part of whole bricks that lies on the grid: (n, 3)."""
    low = np.maximum(places * BRICK, 1)
    high = np.minimum((places + 1) * BRICK, np.array(shape) + 1)
    sides: NDArray[np.int64] = np.maximum(high - low, 0)
    return sides


def shared_cells(first: Components, second: Components) -> NDArray[np.int64]:
    """Count the cells that components share on the same bricks; return rows (n, 3), pair and count; pairs may recur."""
    shared = kernels.overlaps(
        first.bits, first.bricks, first.starts, first.names, second.bits, second.bricks, second.starts, second.names
    )
    single = first.alone >= 0
    own_names, other_names = first.names[first.alone[single]], second.names[second.alone[single]]
    alone = np.stack([own_names, other_names, np.full(len(own_names), CELLS)], axis=1).astype(np.int64)
    return np.concatenate([shared, alone])


def label_shells(
    surface: Surface,
    rate: NDArray[np.float32],
    *,
    total: tuple[float, float] | None = None,
    threads: int | None = None,
) -> SurfaceShells:
    """Label and measure the connected parts of a closed surface, whose vertices move by `rate`, mm, with the level.

    Parameters
    ----------
    surface : Surface, mm
    rate : (V, 3) float32
        Movement of each vertex when the level rises by one, mm.
    total : (float, float), optional
        Volume and slope of the whole surface, if they are known.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    names, count = shell_names(surface)
    if total is not None and count == 1 and names.min() == 0:
        return SurfaceShells(
            names=names,
            volume=np.array(total[:1]),
            slope=np.array(total[1:]),
            euler=np.array([len(names) - len(surface.faces) // 2]),
        )
    shell = names[surface.faces[:, 0]]
    volumes, change = face_sums(surface, rate, threads=threads)
    volume, slope = (sum_exactly(shell, weights, count) for weights in (volumes, change))
    used = names if names.min(initial=0) >= 0 else names[names >= 0]
    corners, sides = np.bincount(used, minlength=count), np.bincount(shell, minlength=count)
    return SurfaceShells(names=names, volume=volume, slope=slope, euler=corners - sides // 2)


def sum_exactly(group: NDArray[np.integer], values: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Sum the values of each group, almost without rounding: in any order, the same to the last bit or the one before.

    Each value is split in two: a multiple of 2^-26 of the largest, which add up exactly, and a rest, which is small.

    Parameters
    ----------
    group : (n,) int
    values : (n,) float64
        Up to 2^27 of them.
    count : int
        Number of groups.
    """
    largest = float(np.abs(values).max(initial=0.0))
    if not 0 < largest < math.inf:
        return np.bincount(group, weights=values, minlength=count).astype(np.float64)
    unit = 2.0 ** (math.frexp(largest)[1] - HIGH_BITS)
    high = np.rint(values / unit)
    rest = values - high * unit
    whole, fractions = (np.bincount(group, weights=part, minlength=count).astype(np.float64) for part in (high, rest))
    return whole * unit + fractions


def shell_names(surface: Surface) -> tuple[NDArray[np.int32], int]:
    """Label the connected parts of a surface; return the label of every vertex (V,), and the number of parts."""
    return vertex_components(surface.faces, len(surface.vertices))


def count_bodies(surface: Surface) -> int:
    """Count the components that face outwards: bodies that touch nowhere; cavities are none."""
    names, count = shell_names(surface)
    return int((shell_volumes(surface, names, count) > 0).sum())


def face_sums(
    surface: Surface, rate: NDArray[np.float32], *, threads: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return for every face the volume between it and a central point, mm³, and its slope over the level."""
    volumes, change = np.empty(len(surface.faces)), np.empty(len(surface.faces))
    middle = surface.vertices[len(surface.vertices) // 2]
    in_threads(
        face_volumes, surface.vertices, rate, surface.faces, middle, volumes, change, threads=thread_count(threads)
    )
    return volumes, change


def erase_components(
    values: NDArray[Any], field: SparseField, labelled: Components, small: NDArray[np.bool_]
) -> NDArray[Any]:
    """Turn the components marked in `small` (b,) void in data (nx, ny, nz); floating-point data become float32."""
    out = values.astype(np.float32) if values.dtype.kind == "f" else values.copy()
    void = False if values.dtype == bool else -1
    kernels.erase(out, field.where, labelled.bits, labelled.bricks, labelled.starts, labelled.names, small, void)
    single = np.argwhere(labelled.alone >= 0)
    for place in single[small[labelled.names[labelled.alone[tuple(single.T)]]]]:  # bricks that are solid throughout
        low = np.maximum(place * BRICK - 1, 0)
        out[tuple(slice(a, b) for a, b in zip(low, (place + 1) * BRICK - 1, strict=True))] = void
    return out


def component_cells(field: SparseField, labelled: Components, number: int) -> NDArray[np.int64]:
    """List the cells (n, 3) of a component that lie in kept bricks, counted from the first cell of the grid."""
    bricks, rows = np.nonzero(labelled.bits)
    solid = labelled.bits[bricks, rows, None] >> np.arange(BRICK[2], dtype=np.uint16) & 1
    row_index, k = np.nonzero(solid)
    brick, row = bricks[row_index], rows[row_index]
    place = field.where[brick].astype(np.int64) * BRICK + np.stack([row // BRICK[1], row % BRICK[1], k], axis=1)
    label = np.empty(len(place), dtype=np.int32)
    kernels.label_cells(
        place.astype(np.int32),
        field.slots,
        labelled.bits,
        labelled.bricks,
        labelled.starts,
        labelled.alone,
        labelled.names,
        0,
        label,
    )
    cells: NDArray[np.int64] = place[label == number] - 1
    return cells
