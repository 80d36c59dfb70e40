"""Find the void that is reachable from outside the solid, by runs of cells rather than cell by cell."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.graph import label_connected
from infill.ragged import expand_rows
from infill.voxels.scanlines import SLAB, RowCrossings, fill_rows

LINKS = 2**20  # pairs of runs worked on at a time


def enclosed_void(solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark the void cells that no path of void cells, face to face, joins to the corner of the grid.

    Parameters
    ----------
    solid : (nx, ny, nz) bool
        Void along its border.

    Notes
    -----
    The void of a row consists of a few runs of cells. Runs that touch in neighbouring rows belong to one component of
    void, so that memory grows with the surface and not with the number of cells.

    >>> shell = np.zeros((5, 5, 5), dtype=bool)
    >>> shell[1:4, 1:4, 1:4] = True
    >>> shell[2, 2, 2] = False
    >>> np.argwhere(enclosed_void(shell)).tolist()
    [[2, 2, 2]]
    """
    _, ny, nz = solid.shape
    width = nz + 1  # one place more than there are cells keeps the runs of different rows apart
    start, end = _void_runs(solid)
    run_lists, neighbour_lists = [], []
    for shift in (width, ny * width):
        low = np.searchsorted(end, start + shift, side="right")
        high = np.searchsorted(start, end + shift, side="left")
        for run, place in expand_rows(np.maximum(high - low, 0), LINKS):
            run_lists.append(run.astype(np.int32))
            neighbour_lists.append((low[run] + place).astype(np.int32))
    first_run, second_run = np.concatenate(run_lists), np.concatenate(neighbour_lists)
    component, _ = label_connected(first_run, second_run, len(start))
    inner = component != component[0]
    index = np.concatenate([start[inner], end[inner]])
    sign = np.repeat(np.array([1, -1], dtype=np.int8), int(inner.sum()))
    order = np.argsort(index, kind="stable")
    row, place = np.divmod(index[order], width)
    ends = RowCrossings(
        row=row.astype(np.int32),
        place=place.astype(np.int32),
        face=np.zeros_like(row, np.int32),
        sign=sign[order],
        depth=place.astype(np.float32),
    )
    return fill_rows(ends, solid.shape)


def _void_runs(solid: NDArray[np.bool_]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Find the runs of void; return where they begin and end, as row * (nz + 1) + place."""
    nx, ny, nz = solid.shape
    thick = max(1, SLAB // (ny * nz))
    starts, ends = [], []
    for low in range(0, nx, thick):
        void = np.zeros((min(thick, nx - low), ny, nz + 2), dtype=np.int8)
        void[:, :, 1:-1] = ~solid[low : low + thick]
        change = np.diff(void, axis=2).ravel()
        starts.append(np.flatnonzero(change == 1) + low * ny * (nz + 1))
        ends.append(np.flatnonzero(change == -1) + low * ny * (nz + 1))
    return np.concatenate(starts), np.concatenate(ends)
