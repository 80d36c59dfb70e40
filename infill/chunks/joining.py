"""Components of the whole volume from those of its chunks: joined where two chunks see the same cell.

A chunk labels the solid in its bricks and one brick around them. It names the cells of the layers at its borders that
its neighbours see too: one for each run of solid in a layer. Cells with one name join the components of two chunks.

A component that lies only in the brick around a chunk is looked up in the chunk that owns one of its cells
(`ChunkComponents.strange`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.fields import ChunkField
from infill.chunks.layout import Chunk
from infill.graph import label_connected
from infill.isosurfaces.components import Components, brick_sides_on_grid
from infill.kernels.chunk_sums import count_cells_of, find_first_cells
from infill.kernels.components import label_cells
from infill.kernels.sparse import BRICK, CELLS

Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class ChunkComponents:
    """The components of the solid in a chunk and the brick around it.

    Parameters
    ----------
    cells : (c,) int64
        Cells of each in the chunk itself.
    first : (c,) int64
        The least cell of each in its own bricks that were kept before the first step, -1 for none: their order.
    seen, seen_by : (n,) int64
        Names of cells in border layers, and their components.
    strange, strange_by : (m,) int64
        Names of cells beyond the chunk, one for each component without a cell of its own, and these components.
    """

    cells: Numbers
    first: Numbers
    seen: Numbers
    seen_by: Numbers
    strange: Numbers
    strange_by: Numbers


def survey_components(chunk_field: ChunkField, chunk: Chunk, labelled: Components) -> ChunkComponents:
    """Count and name the components of a chunk, for `join_components`."""
    field, count = chunk_field.field, labelled.count
    lattice = np.array(chunk.lattice)
    tables = (labelled.bits, labelled.bricks, labelled.starts, labelled.names)
    where = (field.where + np.array(chunk.kept_low)).astype(np.int32)
    own_cells, lowest, anywhere = np.zeros(count, dtype=np.int64), np.full(count, -1), np.full(count, -1)
    count_cells_of(where, chunk_field.own, *tables, own_cells)
    find_first_cells(where, chunk_field.own & chunk_field.begun, *tables, lattice, lowest)
    find_first_cells(where, np.ones(len(where), dtype=bool), *tables, lattice, anywhere)
    single = np.argwhere(labelled.alone >= 0)
    alone_names = labelled.names[labelled.alone[tuple(single.T)]]
    is_owned = chunk.owns(single)
    places = single + np.array(chunk.kept_low)
    np.add.at(own_cells, alone_names[is_owned], brick_sides_on_grid(places[is_owned], chunk.shape).prod(axis=1))
    numbers = cell_names(np.maximum(places * BRICK, 1), chunk)  # a cell of the grid in each
    order = np.argsort(-numbers, kind="stable")
    missing = anywhere[alone_names[order]] < 0
    anywhere[alone_names[order][missing]] = numbers[order][missing]
    seen, seen_by = _border_cells(chunk, lambda places: look_up(chunk_field, labelled, places))
    is_strange = own_cells == 0
    return ChunkComponents(
        cells=own_cells,
        first=lowest,
        seen=seen,
        seen_by=seen_by,
        strange=anywhere[is_strange],
        strange_by=np.flatnonzero(is_strange),
    )


def look_up(
    chunk_field: ChunkField, labelled: Components, places: NDArray[Any], *, reach: int = 0
) -> NDArray[np.int32]:
    """Return the component of cells (N, 3), on the lattice from the first kept brick; or the nearest in reach."""
    label = np.empty(len(places), dtype=np.int32)
    label_cells(
        np.ascontiguousarray(places, dtype=np.int32),
        chunk_field.field.slots,
        labelled.bits,
        labelled.bricks,
        labelled.starts,
        labelled.alone,
        labelled.names,
        reach,
        label,
    )
    return label


def survey_solid(chunk: Chunk) -> ChunkComponents:
    """Return the only component of a chunk that is solid throughout, for `join_components`."""
    cells = math.prod(part.stop - part.start for part in chunk.own_cells)
    seen, seen_by = _border_cells(chunk, lambda places: np.zeros(len(places), dtype=np.int32))
    nothing = np.empty(0, dtype=np.int64)
    return ChunkComponents(
        cells=np.array([cells]),
        first=np.array([-1]),
        seen=seen,
        seen_by=seen_by,
        strange=nothing,
        strange_by=nothing,
    )


def _border_cells(chunk: Chunk, label: Callable[[NDArray[Any]], NDArray[np.int32]]) -> tuple[Numbers, Numbers]:
    """Name a cell of every run of equal components in the layers that two chunks see; return their components, too.

    The first layer of a chunk is seen by itself and by the chunk below it. `label` takes cells (N, 3) on the lattice
    from the first kept brick.
    """
    names, components = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    low = np.maximum(np.array(chunk.low) * BRICK, 1)  # of the grid
    high = np.minimum(np.array(chunk.high) * BRICK, np.array(chunk.shape) + 1)
    start = np.array(chunk.kept_low) * BRICK
    for axis in range(3):
        heights = [chunk.low[axis] * BRICK[axis]] if chunk.low[axis] > 0 else []
        if chunk.high[axis] < chunk.lattice[axis]:
            heights.append(chunk.high[axis] * BRICK[axis])
        along, across = (2, 1 - axis) if axis < 2 else (1, 0)  # the axis of the runs, and the other one
        for height in heights:
            if height > chunk.shape[axis]:  # beyond the grid
                continue
            cells = np.empty((high[across] - low[across], high[along] - low[along], 3), dtype=np.int64)
            cells[..., axis] = height
            cells[..., across] = np.arange(low[across], high[across])[:, None]
            cells[..., along] = np.arange(low[along], high[along])[None]
            labels = label((cells - start).reshape(-1, 3)).reshape(cells.shape[:2])
            begins = labels >= 0
            begins[:, 1:] &= labels[:, 1:] != labels[:, :-1]
            names.append(cell_names(cells[begins], chunk))
            components.append(labels[begins].astype(np.int64))
    return np.concatenate(names), np.concatenate(components)


def cell_names(cells: NDArray[Any], chunk: Chunk) -> Numbers:
    """Name cells (N, 3) of the whole lattice: the number of their brick, then their place in it."""
    brick, cell = np.divmod(cells, BRICK)
    number = (brick[:, 0] * chunk.lattice[1] + brick[:, 1]) * chunk.lattice[2] + brick[:, 2]
    names: Numbers = number * CELLS + (cell[:, 0] * BRICK[1] + cell[:, 1]) * BRICK[2] + cell[:, 2]
    return names


def named_cells(names: Numbers, lattice: tuple[int, ...]) -> Numbers:
    """Return the cells (N, 3) of the whole lattice that have these names."""
    number, cell = np.divmod(names, CELLS)
    rest, k = np.divmod(cell, BRICK[2])
    i, j = np.divmod(rest, BRICK[1])
    plane, third = np.divmod(number, lattice[2])
    lowest, second = np.divmod(plane, lattice[1])
    cells: Numbers = np.stack([lowest, second, third], axis=1) * BRICK + np.stack([i, j, k], axis=1)
    return cells


@dataclass(frozen=True, kw_only=True, eq=False)
class JoinedComponents:
    """The components of the whole volume.

    Parameters
    ----------
    cells : (b,) int64
        Cells of each, in the order in which `infill.isosurfaces.components.find_components` has them.
    names : dict of int to (c,) int32
        For each chunk with a surface, the component of the whole that each of its own is part of.
    """

    cells: Numbers
    names: dict[int, NDArray[np.int32]]

    def volumes(self, cell_volume: float) -> NDArray[np.float64]:
        """Return the volume of each, mm³."""
        return self.cells.astype(np.float64) * cell_volume


def join_components(
    surveys: Mapping[int, ChunkComponents], answers: Sequence[tuple[int, Numbers, int, Numbers]]
) -> JoinedComponents:
    """Join the components of all chunks.

    Parameters
    ----------
    surveys : mapping
        By the numbers of chunks.
    answers : sequence of (chunk, components, other chunk, its components)
        Where strange components were looked up.
    """
    begins, total = {}, 0
    for number, survey in surveys.items():
        begins[number] = total
        total += len(survey.cells)
    nothing = np.empty(0, dtype=np.int64)
    name = np.concatenate([nothing, *(survey.seen for survey in surveys.values())])
    node = np.concatenate([nothing, *(survey.seen_by + begins[number] for number, survey in surveys.items())])
    order = np.argsort(name, kind="stable")
    name, node = name[order], node[order]
    same = name[1:] == name[:-1]
    ends = [(node[1:][same], node[:-1][same])]
    ends += [(owned + begins[number], others + begins[other]) for number, owned, other, others in answers]
    first_ends, second_ends = (np.concatenate(side) for side in zip(*ends, strict=True))
    joined, count = label_connected(first_ends, second_ends, total)
    cells, lowest = np.zeros(count, dtype=np.int64), np.full(count, np.iinfo(np.int64).max)
    for number, survey in surveys.items():
        owned = joined[begins[number] : begins[number] + len(survey.cells)]
        np.add.at(cells, owned, survey.cells)
        np.minimum.at(lowest, owned[survey.first >= 0], survey.first[survey.first >= 0])
    order = np.argsort(lowest, kind="stable")
    rank = np.empty(count, dtype=np.int32)
    rank[order] = np.arange(count, dtype=np.int32)
    return JoinedComponents(
        cells=cells[order],
        names={
            number: rank[joined[begins[number] : begins[number] + len(survey.cells)]]
            for number, survey in surveys.items()
        },
    )
