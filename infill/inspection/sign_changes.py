"""What smoothing changed, decided where cells changed sign; nothing can break, fuse or move away anywhere else.

    data  ──▶  bits of solid cells ──┐
    field ──▶  bits of solid cells ──┴──▶  flips  ──▶  the same connections?    (`connected_alike`)
                                                  ──▶  both surfaces near?      (`near_each_other`)

Both answer only if they are sure. Where they are not, the whole is compared: `infill.inspection.bricks.verdict` and
`infill.inspection.fidelity.fidelity`, whose findings these two foresee.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.isosurfaces.components import Components, cores, grown, opened
from infill.isosurfaces.sparse_marching import (
    Signs,
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
from infill.meshes.distance import Tree
from infill.meshes.hausdorff_samples import between
from infill.phasefield.sparse import SparseField
from infill.surface import Surface

Bits = NDArray[np.uint16]
Places = NDArray[np.int64]

MANY = 20_000  # cells: if more than this have changed, it is faster to look at the whole
SHARE = 0.5  # of all bricks: if more than this have to be looked at, it is faster to look at the whole
FEW = 200  # bricks: so many are looked at in any case
# Cells: how near the surfaces must be at places this far apart, so that they are nearer than 1.25 between them as well.
NEAR, APART = 1.0, 0.3
BESIDE = np.array(list(product(range(-1, 1), repeat=3)))  # the cubes around a cell, by their lowest corners
REACH = 2  # cubes around those in which the other surface is looked for
WORD = 4  # rows whose bits make a number of 64 bits
ENDS = np.array(list(product((-REACH - 1, REACH + 1), repeat=3)))


@dataclass(frozen=True, kw_only=True, eq=False)
class Flips:
    """The cells that changed sign.

    Parameters
    ----------
    field : SparseField
    level : float
        What of its values is above this is solid.
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
    places: Places
    doubt: Places
    euler_number: int

    @classmethod
    def of(
        cls, field: SparseField, data: Bits, level: float, *, signs: Signs | None = None, threads: int | None = None
    ) -> Flips:
        """Return the cells that changed sign between the data, whose bits are known, and the field.

        Its `signs` at the level are looked at if they are not known.
        """
        if signs is None:
            bits = rows_above(field, field.values, level, threads=threads)
            signs = Signs(bits=bits, doubt=doubt_and_euler_number(field, bits, threads=threads)[0])
        before, euler = doubt_and_euler_number(field, data, threads=threads)
        return cls(
            field=field,
            level=level,
            data=data,
            result=signs.bits,
            places=places_of(field, data ^ signs.bits),
            doubt=_each_once(before, signs.doubt),
            euler_number=euler_number_of_bits(field, data, threads=threads) if euler is None else euler,
        )


def _each_once(one: NDArray[np.int32], other: NDArray[np.int32]) -> Places:
    """Return the places of two lists, each once."""
    found: Places = np.concatenate([one, other]).astype(np.int64)
    return np.unique(found, axis=0) if len(found) else found


def places_of(field: SparseField, bits: Bits) -> Places:
    """Return the cells that are set in kept bricks, (N, 3), on the lattice."""
    words = np.flatnonzero(np.ascontiguousarray(bits).view(np.uint64))  # of four rows each: most are empty
    brick, row = np.divmod(words[:, None] * WORD + np.arange(WORD), ROWS)
    brick, row = (each[bits[brick, row] != 0] for each in (brick, row))
    which, k = np.nonzero(bits[brick, row, None] >> np.arange(BRICK[2], dtype=np.uint16) & 1)
    brick, row = brick[which], row[which]
    corner: Places = field.where[brick].astype(np.int64) * BRICK
    found: Places = corner + np.stack([row // BRICK[1], row % BRICK[1], k], axis=1)
    return found


def connected_alike(flips: Flips, before: Components, *, threads: int | None = None) -> bool:
    """Return whether it is sure that all components of solid and void are what they were, and no wall was lost.

    Parameters
    ----------
    flips : Flips
    before : Components
        Of the data: of solid, or of void.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    It is if the cells can change one after the other so that each is simple when its turn comes (Bertrand and
    Malandain 1994, "A new characterization of three-dimensional simple points", Pattern Recognition Letters 15): then
    components of solid, of void, and tunnels correspond. So must the solid without what is one cell thick, by whose
    voids it is told whether walls were lost.
    """
    field, result = flips.field, flips.result
    thick = opened(field, cores(field, flips.data, threads=threads), threads=threads)
    for start in (flips.data, thick) if (thick != flips.data).any() else (thick,):
        places = places_of(field, start ^ result)
        if len(places) > MANY or kernels.flip_simple(field.slots, start.copy(), places):
            return False
    if kernels.lonely(field.slots, result, flips.places):
        return False
    return all_stay(before, ~(flips.data ^ result))


def all_stay(every: Components, same: Bits) -> bool:
    """Return whether every component of solid, or of void, has a cell that did not change; those are in `same`."""
    marked = np.zeros(every.count, dtype=bool)
    mark_runs(every.bits, every.bricks, every.starts, every.names, same, marked)
    marked[every.names[every.alone[every.alone >= 0]]] = True
    return bool(marked.all())


def near_each_other(flips: Flips, *, spacing: tuple[float, ...], threads: int | None = None) -> bool:
    """Return whether it is sure that both surfaces are within `infill.inspection.fidelity.KEPT` cells everywhere.

    Where all corners of a cube keep their signs, both surfaces cross the same of its edges, and have the same triangles
    between these crossings: none is further away than an edge is long. All other cubes are measured.
    """
    if not len(flips.places) and not len(flips.doubt):
        return True
    cubes = (flips.places[:, None] + BESIDE).reshape(-1, 3)
    part = _around(flips.field, cubes, flips.doubt)
    chosen = None if part is None else _cubes(part, cubes, flips.doubt)
    if part is None or chosen is None:
        return False
    count = thread_count(threads)
    beside = grown(part, chosen, REACH, threads=count)
    try:
        surfaces = [
            extract_level(_of_data(part), spacing=spacing, threads=count).surface,
            extract_level(part, spacing=spacing, level=flips.level, threads=count).surface,
        ]
    except GeometryError:  # of one of them, there is nothing here
        return False
    near, around = ([_in_cubes(each, part, bits, spacing, count) for each in surfaces] for bits in (chosen, beside))
    cell = max(spacing)
    return all(_near(one, other, cell, count) for one, other in zip(near, reversed(around), strict=True))


def _around(field: SparseField, cubes: Places, doubt: Places) -> SparseField | None:
    """Return the field with nothing but the bricks around some cubes, and around some bricks; None if they are many.

    Where it is cut off, there is a surface that is not real, more than `REACH` cells away from these.
    """
    wanted = np.zeros(field.slots.shape, dtype=bool)
    steps = np.array(list(product(range(-1, 2), repeat=3)))
    for place in (*(doubt + step for step in steps), *((cubes + end) // BRICK for end in ENDS)):
        inside = ((place >= 0) & (place < field.slots.shape)).all(axis=1)
        wanted[tuple(place[inside].T)] = True
    kept = wanted[tuple(field.where.T)]
    if kept.sum() > max(FEW, SHARE * len(kept)):
        return None
    slots = np.where(wanted & (field.slots < 0), field.slots, np.int32(VOID_BRICK))
    where = field.where[kept]
    slots[tuple(where.T)] = np.arange(len(where), dtype=np.int32)
    return replace(field, slots=slots, where=where, values=field.values[kept], data=field.data[kept])


def _cubes(field: SparseField, cubes: Places, bricks: Places) -> Bits | None:
    """Return some cubes, and those of some bricks, as bits; None if one lies where no brick is kept."""
    bits = np.zeros((len(field.where), ROWS), dtype=np.uint16)
    place, cell = np.divmod(cubes, BRICK)
    if ((place < 0) | (place >= field.slots.shape)).any():
        return None
    slot, whole = field.slots[tuple(place.T)], field.slots[tuple(bricks.T)]
    if (slot < 0).any() or (whole < 0).any():
        return None
    np.bitwise_or.at(bits, (slot, cell[:, 0] * BRICK[1] + cell[:, 1]), np.uint16(1) << cell[:, 2].astype(np.uint16))
    bits[whole] = FULL
    return bits


def _of_data(field: SparseField) -> SparseField:
    return replace(field, values=field.data.astype(np.float32))


def _in_cubes(surface: Surface, field: SparseField, bits: Bits, spacing: tuple[float, ...], threads: int) -> Surface:
    """Return the triangles of a surface that lie in cubes of which bits are set, and their corners."""
    found = np.zeros(len(surface.faces), dtype=bool)
    arguments = (surface.vertices, surface.faces, np.array(spacing), field.slots, bits, found)
    in_threads(kernels.faces_in, *arguments, threads=threads)
    used, faces = np.unique(surface.faces[found], return_inverse=True)
    return replace(surface, vertices=surface.vertices[used], faces=faces.reshape(-1, 3))


def _near(part: Surface, other: Surface, cell: float, threads: int) -> bool:
    """Return whether all places on the faces of a surface are near another one."""
    if not len(part.faces) or not len(other.faces):
        return not len(part.faces)
    tree, near = Tree.of(other), NEAR * cell
    away, owner = tree.nearest(part.vertices, enough=near, threads=threads)
    if (away > near).any():
        return False
    return not len(between(tree, part, owner, away, APART * cell, near, all_places=False, threads=threads).points)
