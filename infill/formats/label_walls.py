"""Labels as files hold them: walls, each once with the labels on both sides, and tetrahedra that fill the labels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

OUTSIDE = 0  # instead of a label: outside all of them


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelWalls:
    """Triangles that part labels from each other and from the outside; each is there once, for both its labels.

    Parameters
    ----------
    points : (P, 3) float64, mm
        Each is there once, for all its triangles.
    triangles : (T, 3) int64
        They face the second of their labels; at the outside, they face outwards.
    labels : (T, 2) int64
        The labels behind and in front of each triangle; 0 for the outside, which is never the first.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    labels: NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelTetrahedra:
    """Tetrahedra of labels, face to face.

    Parameters
    ----------
    points : (P, 3) float64, mm
    tetrahedra : (T, 4) int64
        Their volume is positive: the first three corners run anticlockwise, seen from the fourth.
    labels : (T,) int64
    """

    points: NDArray[np.float64]
    tetrahedra: NDArray[np.int64]
    labels: NDArray[np.int64]


def label_type(labels: NDArray[np.int64]) -> np.dtype[np.generic]:
    """Return the type that holds labels in a file: 32 bits if they fit, which every program reads.

    >>> [str(label_type(np.array(labels))) for labels in ([-1, 7], [0, 2**32 - 1], [-1, 2**31])]
    ['int32', 'uint32', 'float64']
    """
    low, high = int(labels.min(initial=0)), int(labels.max(initial=0))
    for kind in (np.int32, np.uint32):
        if np.iinfo(kind).min <= low and high <= np.iinfo(kind).max:
            return np.dtype(kind)
    return np.dtype(np.float64)
