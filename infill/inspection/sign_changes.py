"""Judge changes by the cells that changed sign; solid cannot break, fuse or move away anywhere else.

    data  ──▶  bits of solid cells ──┐
    field ──▶  bits of solid cells ──┴──▶  flips  ──▶  the same connections?    (`has_same_connections`)
                                                  ──▶  both surfaces near?      (`are_surfaces_near`)

Both answer True only if they are sure. Otherwise everything is compared: `infill.inspection.bricks.check_topology` and
`infill.inspection.deviation.measure_deviation`, whose results these two predict.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Integers
from infill.errors import GeometryError
from infill.isosurfaces.components import Components, dilate, dilate_cores, erode_to_cores
from infill.isosurfaces.sparse_marching import (
    LevelSigns,
    doubt_and_euler_number,
    euler_number_of_bits,
    extract_level,
    rows_above,
)
from infill.kernels import flips as kernels
from infill.kernels.components import mark_runs
from infill.kernels.sparse import BRICK, VOID_BRICK
from infill.kernels.sparse_marching import FULL, ROWS
from infill.kernels.threads import in_threads, thread_count
from infill.meshes.distance import TriangleTree
from infill.meshes.hausdorff_samples import sample_between_vertices
from infill.phasefield.sparse import SparseField
from infill.surface import Surface

Bits = NDArray[np.uint16]

MANY_CHANGES = 20_000  # cells: if more than this have changed, it is faster to compare everything
SHARE = 0.5  # of all bricks: if more than this have to be examined, it is faster to compare everything
FEW_BRICKS = 200  # bricks: up to this many are examined in any case
# Cells: largest distance of the surfaces at samples, and spacing of samples, so that it is at most 1.25 between them.
NEAR, SAMPLE_SPACING = 1.0, 0.3
CUBES_AROUND = np.array(list(product(range(-1, 1), repeat=3)))  # the cubes around a cell, by their lowest corners
REACH = 2  # cubes around the changed ones in which the other surface is searched
WORD = 4  # rows whose bits make a number of 64 bits
ENDS = np.array(list(product((-REACH - 1, REACH + 1), repeat=3)))


@dataclass(frozen=True, kw_only=True, eq=False)
class SignChanges:
    """The cells that changed sign.

    Parameters
    ----------
    field : SparseField
    level : float
        Values above this are solid.
    data, result : (n, rows) uint16
        Bits of solid cells before and after.
    places : (N, 3) int64
        The cells that changed, on the lattice of bricks.
    doubt : (m, 3) int64
        Bricks in which signs do not decide how the surface runs, before or after.
    euler_number : int
        Of the surface of the data.
    """

    field: SparseField
    level: float
    data: Bits
    result: Bits
    places: Integers
    doubt: Integers
    euler_number: int

    @classmethod
    def of(
        cls,
        field: SparseField,
        data: Bits,
        level: float,
        *,
        signs: LevelSigns | None = None,
        threads: int | None = None,
    ) -> SignChanges:
        """Find the cells that changed sign between the data, whose bits are known, and the field.

        The `signs` of the field at the level are computed if not given.
        """
        if signs is None:
            bits = rows_above(field, field.values, level, threads=threads)
            signs = LevelSigns(bits=bits, doubt=doubt_and_euler_number(field, bits, threads=threads)[0])
        before, euler = doubt_and_euler_number(field, data, threads=threads)
        return cls(
            field=field,
            level=level,
            data=data,
            result=signs.bits,
            places=cells_of_bits(field, data ^ signs.bits),
            doubt=_join_places(before, signs.doubt),
            euler_number=euler_number_of_bits(field, data, threads=threads) if euler is None else euler,
        )


def _join_places(places_a: NDArray[np.int32], places_b: NDArray[np.int32]) -> Integers:
    """Join two lists of places; return each place once."""
    joined: Integers = np.concatenate([places_a, places_b]).astype(np.int64)
    return np.unique(joined, axis=0) if len(joined) else joined


def cells_of_bits(field: SparseField, bits: Bits) -> Integers:
    """List the cells whose bits are set, (N, 3), on the lattice: their numbers are 1 more than on the grid."""
    words = np.flatnonzero(np.ascontiguousarray(bits).view(np.uint64))  # of four rows each: most are empty
    brick, row = np.divmod(words[:, None] * WORD + np.arange(WORD), ROWS)
    brick, row = (index[bits[brick, row] != 0] for index in (brick, row))
    entry, k = np.nonzero(bits[brick, row, None] >> np.arange(BRICK[2], dtype=np.uint16) & 1)
    brick, row = brick[entry], row[entry]
    corner: Integers = field.where[brick].astype(np.int64) * BRICK
    cells: Integers = corner + np.stack([row // BRICK[1], row % BRICK[1], k], axis=1)
    return cells


def has_same_connections(flips: SignChanges, before: Components, *, threads: int | None = None) -> bool:
    """Tell whether all components of solid and void are certain to correspond, and no wall was lost.

    Parameters
    ----------
    flips : SignChanges
    before : Components
        Of the data: of solid, or of void.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    They correspond if the cells can change one after the other so that each is simple when its turn comes (Bertrand and
    Malandain 1994, "A new characterization of three-dimensional simple points", Pattern Recognition Letters 15): then
    components of solid, of void, and tunnels correspond. The same must hold for the solid more than one cell thick,
    whose voids show whether walls were lost.
    """
    field, result = flips.field, flips.result
    thick = dilate_cores(field, erode_to_cores(field, flips.data, threads=threads), threads=threads)
    for start in (flips.data, thick) if (thick != flips.data).any() else (thick,):
        places = cells_of_bits(field, start ^ result)
        if len(places) > MANY_CHANGES or kernels.flip_simple(field.slots, start.copy(), places):
            return False
    if kernels.count_lonely(field.slots, result, flips.places):
        return False
    return has_unchanged_cells(before, ~(flips.data ^ result))


def has_unchanged_cells(labelled: Components, same: Bits) -> bool:
    """Tell whether every component of solid, or of void, has a cell in `same`, the cells that did not change."""
    return bool(mark_unchanged(labelled, same).all())


def mark_unchanged(labelled: Components, same: Bits) -> NDArray[np.bool_]:
    """Mark the components of solid, or of void, that have a cell in `same`, the cells that did not change, (b,)."""
    marked = np.zeros(labelled.count, dtype=bool)
    mark_runs(labelled.bits, labelled.bricks, labelled.starts, labelled.names, same, marked)
    marked[labelled.names[labelled.alone[labelled.alone >= 0]]] = True
    return marked


def are_surfaces_near(flips: SignChanges, *, spacing: tuple[float, ...], threads: int | None = None) -> bool:
    """Tell whether both surfaces are certain to be within `infill.inspection.deviation.KEPT` cells everywhere.

    Where all corners of a cube keep their signs, both surfaces cross the same edges and have the same triangles between
    these crossings, so they are within the length of an edge. All other cubes are measured.
    """
    if not len(flips.places) and not len(flips.doubt):
        return True
    cubes = (flips.places[:, None] + CUBES_AROUND).reshape(-1, 3)
    part = _cut_out(flips.field, cubes, flips.doubt)
    cube_bits = None if part is None else _mark_cubes(part, cubes, flips.doubt)
    if part is None or cube_bits is None:
        return False
    count = thread_count(threads)
    around_bits = dilate(part, cube_bits, REACH, threads=count)
    try:
        surfaces = [
            extract_level(_field_of_data(part), spacing=spacing, threads=count).surface,
            extract_level(part, spacing=spacing, level=flips.level, threads=count).surface,
        ]
    except GeometryError:  # one of the surfaces is absent here
        return False
    near_parts, wide_parts = (
        [part_in_cubes(surface, part, bits, spacing, count) for surface in surfaces]
        for bits in (cube_bits, around_bits)
    )
    cell = max(spacing)
    return all(
        _is_near(part_surface, wide_surface, cell, count)
        for part_surface, wide_surface in zip(near_parts, reversed(wide_parts), strict=True)
    )


def _cut_out(field: SparseField, cubes: Integers, doubt: Integers) -> SparseField | None:
    """Cut out the bricks around some cubes and around some bricks; return None if they are many.

    The cut makes a surface that is not real, more than `REACH` cells away from these cubes and bricks.
    """
    needed = np.zeros(field.slots.shape, dtype=bool)
    steps = np.array(list(product(range(-1, 2), repeat=3)))
    for place in (*(doubt + step for step in steps), *((cubes + end) // BRICK for end in ENDS)):
        inside = ((place >= 0) & (place < field.slots.shape)).all(axis=1)
        needed[tuple(place[inside].T)] = True
    chosen = needed[tuple(field.where.T)]
    if chosen.sum() > max(FEW_BRICKS, SHARE * len(chosen)):
        return None
    slots = np.where(needed & (field.slots < 0), field.slots, np.int32(VOID_BRICK))
    where = field.where[chosen]
    slots[tuple(where.T)] = np.arange(len(where), dtype=np.int32)
    return replace(field, slots=slots, where=where, values=field.values[chosen], data=field.data[chosen])


def _mark_cubes(field: SparseField, cubes: Integers, bricks: Integers) -> Bits | None:
    """Mark some cubes, and those of some bricks, as bits; return None if one lies where no brick is kept."""
    bits = np.zeros((len(field.where), ROWS), dtype=np.uint16)
    place, cell = np.divmod(cubes, BRICK)
    if ((place < 0) | (place >= field.slots.shape)).any():
        return None
    slot, full_slot = field.slots[tuple(place.T)], field.slots[tuple(bricks.T)]
    if (slot < 0).any() or (full_slot < 0).any():
        return None
    np.bitwise_or.at(bits, (slot, cell[:, 0] * BRICK[1] + cell[:, 1]), np.uint16(1) << cell[:, 2].astype(np.uint16))
    bits[full_slot] = FULL
    return bits


def _field_of_data(field: SparseField) -> SparseField:
    """Return the field with the data as its values."""
    return replace(field, values=field.data.astype(np.float32))


def part_in_cubes(
    surface: Surface, field: SparseField, bits: Bits, spacing: tuple[float, ...], threads: int
) -> Surface:
    """Return the triangles of a surface that lie in cubes with set bits, and their corners."""
    inside = np.zeros(len(surface.faces), dtype=bool)
    arguments = (surface.vertices, surface.faces, np.array(spacing), field.slots, bits, inside)
    in_threads(kernels.mark_faces_in, *arguments, threads=threads)
    faces, used = surface.faces[inside], np.zeros(len(surface.vertices), dtype=bool)
    used[faces] = True
    numbers = np.cumsum(used) - 1
    return replace(surface, vertices=surface.vertices[used], faces=numbers[faces])


def _is_near(part: Surface, reference: Surface, cell: float, threads: int) -> bool:
    """Tell whether all places on the faces of one surface are near another."""
    if not len(part.faces) or not len(reference.faces):
        return not len(part.faces)
    tree, limit = TriangleTree.of(reference), NEAR * cell
    distance, owner = tree.nearest(part.vertices, enough=limit, threads=threads)
    if (distance > limit).any():
        return False
    return not len(
        sample_between_vertices(
            tree, part, owner, distance, SAMPLE_SPACING * cell, limit, all_places=False, threads=threads
        ).points
    )
