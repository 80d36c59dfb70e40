"""Specks in the data of a chunk: the same as those of the whole volume, if enough cells around the chunk are read.

A speck of n cells lies within n cells of each of them. A component with at most as many cells that reaches a cell for
which data are needed is therefore read in full, if n more cells are read on each side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import Chunk
from infill.isosurfaces.components import data_bits, erase_components, find_components
from infill.kernels.chunk_sums import find_first_cells
from infill.kernels.sparse import CELLS
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import smooth_bricks


@dataclass(frozen=True, kw_only=True)
class SpeckCount:
    """The specks that begin in a chunk.

    Parameters
    ----------
    removed : int
    largest : int
        Cells of the largest; 0 without any.
    """

    removed: int = 0
    largest: int = 0


def remove_specks(
    data: NDArray[np.bool_] | NDArray[np.float32], widened: Chunk, limit: float, cell_volume: float
) -> tuple[NDArray[np.bool_] | NDArray[np.float32], SpeckCount]:
    """Remove components up to a volume from the data of a widened chunk; count those that begin in the chunk itself.

    Parameters
    ----------
    data : (n0, n1, n2) bool or float32
        Not changed.
    widened : Chunk
        See `Chunk.widened`.
    limit, cell_volume : float, mm³
    """
    field = smooth_bricks(data, Smoothing(steps=0), threads=1)
    labelled = find_components(field, data_bits(field, threads=1))
    small = labelled.cells * cell_volume <= limit
    if not small.any():
        return data, SpeckCount()
    first = np.full(labelled.count, -1, dtype=np.int64)
    everywhere, lattice = np.ones(len(field.where), dtype=bool), np.array(field.slots.shape)
    tables = (labelled.bits, labelled.bricks, labelled.starts, labelled.names)
    find_first_cells(field.where, everywhere, *tables, lattice, first)
    places = np.stack(np.unravel_index(np.maximum(first, 0) // CELLS, field.slots.shape), axis=1) + widened.read_low
    begins = small & (first >= 0) & ((places >= widened.low) & (places < widened.high)).all(axis=1)
    count = SpeckCount(removed=int(begins.sum()), largest=int(labelled.cells[begins].max(initial=0)))
    return erase_components(data, field, labelled, small), count
