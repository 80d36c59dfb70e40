"""How noisy a solid on a grid is: a majority vote among neighbours overrules noise, and hardly anything else."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import thread_count, together

NOISY = 0.2  # what flipping one cell in 25 at random makes; scans of bone and skin have 0.02 to 0.12
SLABS = 12  # stretches of layers that are looked at
LAYERS = 8  # in each
FEWEST = 500  # cells at the surface
VOTERS = 27  # a cell and its neighbours


def noise_share(solid: NDArray[Any], *, threads: int | None = None) -> float:
    """Return how many cells a majority of the 27 around each overrules, over those at the surface that is left then.

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
    random, it is 0.5. Stretches of layers all along the first axis are looked at; a surface of a few cells shows
    nothing.

    >>> noise_share(np.indices((40, 40, 40)).sum(axis=0) < 60) < 0.1
    True
    """
    from infill.kernels.noise import count_overruled

    starts = sorted(set(np.linspace(0, max(0, len(solid) - LAYERS), SLABS).astype(int).tolist()))
    count = min(thread_count(threads), len(starts))

    def look(thread: int) -> NDArray[np.int64]:
        found = np.zeros(3, dtype=np.int64)
        room = np.empty(room_for(solid[:LAYERS]), dtype=np.uint8)
        for start in starts[thread::count]:
            slab = solid[start : start + LAYERS]
            slab = np.ascontiguousarray(slab if slab.dtype == bool else slab > 0).view(np.uint8)
            slab.flags.writeable = False  # compiled once, whether or not the array is writable
            count_overruled(slab, room, found)
        return found

    counts = np.array(together(*(partial(look, thread) for thread in range(count)), threads=count))
    taken, given, surface = counts.sum(axis=0).tolist()
    return 2 * min(taken, given) / surface if surface >= FEWEST else 0.0


def room_for(slab: NDArray[Any]) -> tuple[int, int, int]:
    """Return the shape of the room that counting in a slab takes."""
    return 3 * len(slab) + 1, slab.shape[1], slab.shape[2]


def overruled(slab: NDArray[np.bool_]) -> tuple[int, int, int]:
    """Return how many solid and void cells of some layers a majority overrules, and how many are at the surface then.

    That is the specification of `infill.kernels.noise.count_overruled`. The outermost two layers at either end are left
    out, if there are others.
    """
    most = _votes(slab) > VOTERS / 2
    again = _votes(most)
    inner = slice(2, -2) if len(slab) > 4 else slice(None)
    slab, most, again = slab[inner], most[inner], again[inner]
    counted = (slab & ~most, ~slab & most, (again > 0) & (again < VOTERS))
    taken, given, surface = (int(np.count_nonzero(each)) for each in counted)
    return taken, given, surface


def _votes(solid: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Return how many of the 27 cells around each are solid; beyond the edge, cells are those at it."""
    from scipy.ndimage import uniform_filter1d

    votes = solid.astype(np.float32)
    for axis in range(3):
        votes = uniform_filter1d(votes, 3, axis=axis, mode="nearest")
    found: NDArray[np.float32] = np.rint(votes * VOTERS)
    return found
