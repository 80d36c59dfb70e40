"""Measure the noise of a solid on a grid: a majority vote among neighbours overrules little else than noise."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import run_together, thread_count

NOISY = 0.2  # the share when one cell in 25 is flipped at random; scans of bone and skin have 0.02 to 0.12
SLABS = 12  # stretches of layers that are examined
LAYERS = 8  # in each
FEWEST = 500  # cells at the surface
VOTERS = 27  # a cell and its neighbours


def noise_share(solid: NDArray[Any], *, threads: int | None = None) -> float:
    """Estimate noise: twice the lesser of solid and void cells that neighbours overrule, per surface cell.

    Parameters
    ----------
    solid : (nx, ny, nz)
        Booleans, or numbers that are above 0 where it is solid.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    Noise flips solid and void alike, so what counts is twice the lesser of both: thin walls and specks are overruled
    one way only. Smooth solids have 0 to 0.1, for the steps along their faces; where one cell in ten is flipped at
    random, it is 0.5. Stretches of layers all along the first axis are examined; a surface of a few cells says
    nothing.

    >>> noise_share(np.indices((40, 40, 40)).sum(axis=0) < 60) < 0.1
    True
    """
    starts = slab_starts(len(solid))
    count = min(thread_count(threads), len(starts))

    def count_in_slabs(thread: int) -> NDArray[np.int64]:
        """Count overruled and surface cells in the slabs of a thread."""
        tally = np.zeros(3, dtype=np.int64)
        work = np.empty(work_shape(solid[:LAYERS]), dtype=np.uint8)
        for start in starts[thread::count]:
            slab = solid[start : start + LAYERS]
            count_in_slab(slab if slab.dtype == bool else slab > 0, work, tally)
        return tally

    counts = np.array(run_together(*(partial(count_in_slabs, thread) for thread in range(count)), threads=count))
    return share_of_counts(counts)


def slab_starts(length: int) -> list[int]:
    """Return the first layer of each stretch of `LAYERS` layers that is examined, of a number of layers."""
    return sorted(set(np.linspace(0, max(0, length - LAYERS), SLABS).astype(int).tolist()))


def count_in_slab(
    slab: NDArray[np.bool_],
    work: NDArray[np.uint8],
    tally: NDArray[np.int64],
    inner: tuple[int, int, int, int] | None = None,
) -> None:
    """Add to `tally` (3,) the solid and the void cells that a majority overrules, and the surface cells after the vote.

    Parameters
    ----------
    slab : (n0, n1, n2) bool
    work : uint8
        Of the shape `work_shape(slab)`.
    tally : (3,) int64
    inner : (j0, j1, k0, k1), optional
        Only cells in these rows and columns are counted: with two more around them, as if the slab had no border there.
    """
    from infill.kernels.noise import count_overruled

    cells = np.ascontiguousarray(slab).view(np.uint8)
    cells.flags.writeable = False  # compiled once, whether or not the array is writable
    count_overruled(cells, work, inner or (0, slab.shape[1], 0, slab.shape[2]), tally)


def share_of_counts(counts: NDArray[np.int64]) -> float:
    """Return the noise from the tallies (n, 3) of all slabs."""
    solid_overruled, void_overruled, surface = counts.sum(axis=0).tolist()
    return float(2 * min(solid_overruled, void_overruled) / surface) if surface >= FEWEST else 0.0


def work_shape(slab: NDArray[Any]) -> tuple[int, int, int]:
    """Return the shape of the work array that counting in a slab needs."""
    return 3 * len(slab) + 1, slab.shape[1], slab.shape[2]


def count_overruled_cells(slab: NDArray[np.bool_]) -> tuple[int, int, int]:
    """Count the solid and the void cells that a majority overrules, and the surface cells left after the vote.

    This is the specification of `infill.kernels.noise.count_overruled`. The outermost two layers at either end are left
    out, if there are others.
    """
    majority = _votes(slab) > VOTERS / 2
    second_votes = _votes(majority)
    inner = slice(2, -2) if len(slab) > 4 else slice(None)
    slab, majority, second_votes = slab[inner], majority[inner], second_votes[inner]
    counted = (slab & ~majority, ~slab & majority, (second_votes > 0) & (second_votes < VOTERS))
    solid_overruled, void_overruled, surface = (int(np.count_nonzero(mask)) for mask in counted)
    return solid_overruled, void_overruled, surface


def _votes(solid: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Count the solid cells among the 27 around each cell; beyond the border, its cells repeat."""
    from scipy.ndimage import uniform_filter1d

    votes = solid.astype(np.float32)
    for axis in range(3):
        votes = uniform_filter1d(votes, 3, axis=axis, mode="nearest")
    counts: NDArray[np.float32] = np.rint(votes * VOTERS)
    return counts
