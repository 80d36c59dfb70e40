"""How noisy a solid on a grid is: a majority vote among neighbours overrules noise, and hardly anything else."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SLABS = 12  # stretches of layers that are looked at
LAYERS = 6  # in each
FEWEST = 1000  # cells at the surface
VOTERS = 27  # a cell and its neighbours


def noise_share(solid: NDArray[np.bool_]) -> float:
    """Return the share of the cells at the surface that a majority of the 27 cells around each overrules, both ways.

    Parameters
    ----------
    solid : (nx, ny, nz) bool

    Notes
    -----
    A cell is at the surface if not all 27 are alike. Noise flips solid and void alike, so what counts is twice the
    lesser of both shares: thin walls and specks are overruled one way only. A flat face in any direction is overruled
    along its steps, a tenth of it at most; where cells are flipped at random with a probability of 10 %, about a third
    is. Stretches of layers all along the first axis are looked at; a surface of a few cells shows nothing.

    >>> noise_share(np.indices((20, 20, 20)).sum(axis=0) < 30) < 0.1
    True
    """
    from scipy.ndimage import uniform_filter1d

    count = len(solid)
    starts = np.unique(np.linspace(0, max(0, count - LAYERS), SLABS).astype(int))
    taken = given = mixed = 0
    for start in starts:
        slab = solid[start : start + LAYERS].astype(np.float32)
        votes = slab
        for axis in range(3):
            votes = uniform_filter1d(votes, 3, axis=axis, mode="nearest")
        votes = np.rint(votes * VOTERS)
        inner = slice(1, -1) if len(slab) > 2 else slice(None)
        some = (votes[inner] > 0) & (votes[inner] < VOTERS)
        mixed += int(np.count_nonzero(some))
        most, own = votes[inner] > VOTERS / 2, slab[inner] > 0
        taken += int(np.count_nonzero(some & own & ~most))
        given += int(np.count_nonzero(some & most & ~own))
    return 2 * min(taken, given) / mixed if mixed >= FEWEST else 0.0
