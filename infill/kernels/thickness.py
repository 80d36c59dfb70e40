"""Whether the solid and the void beside a place are more than one cell thick, compiled."""
# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit

SOLID, VOID = 1, 2  # kinds of blocks of 2 x 2 x 2 cells that are all alike


@njit(from_python=False, nogil=True, cache=True)
def _kind_of_block(numbers, number, i, j, k):
    """Return SOLID or VOID if all cells of a block are in a label or outside it, else 0."""
    n0, n1, n2 = numbers.shape
    solid = 0
    for a in range(2):
        for b in range(2):
            for c in range(2):
                x, y, z = min(max(i + a, 0), n0 - 1), min(max(j + b, 0), n1 - 1), min(max(k + c, 0), n2 - 1)
                solid += numbers[x, y, z] == number
    return SOLID if solid == 8 else VOID if solid == 0 else 0


@njit(nogil=True, cache=True)
def find_thick(places, numbers, number, is_thick):
    """Tell whether both the cells of a label and those outside it are more than one cell thick beside places.

    The specification is a binary opening by a block of 2 x 2 x 2 cells.

    Parameters
    ----------
    places : (N, 3) float64
        In cells.
    numbers : (n0, n1, n2) uint16
        The label of every cell.
    number : int
    is_thick : (N,) bool
        Written.
    """
    for n in range(len(places)):
        i, j, k = (
            np.int64(math.floor(places[n, 0] - 0.5)),
            np.int64(math.floor(places[n, 1] - 0.5)),
            np.int64(math.floor(places[n, 2] - 0.5)),
        )
        # A cell beside the place lies in a thick part if one of the eight blocks that hold it is alike.
        kinds = 0
        for a in range(-1, 2):
            for b in range(-1, 2):
                for c in range(-1, 2):
                    if kinds != SOLID | VOID:
                        kinds |= _kind_of_block(numbers, number, i + a, j + b, k + c)
        is_thick[n] = kinds == SOLID | VOID
