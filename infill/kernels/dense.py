"""The scheme compiled, every cell in every step: one fused pass, in float32.

Every formula is arranged so that phi = f = +-1 among equal neighbours is a fixed point to the last bit:

    v = phi + sum of w (differences)            zero where neighbours are equal
    v = v / sqrt(E + (1 - E) v v)               divides by 1 where v = +-1: see `split_one` in `phasefield.dense`
    phi = v + p / (1 + p) (f - v)               adds zero where v = f

A kernel may therefore leave such cells out and give the same bits as one that does not. Importing this module loads
numba; each function is compiled when it is first called and then kept on disk.
"""

from __future__ import annotations

import math

import numpy as np
from numba import prange

from infill.kernels.compiling import njit


@njit(inline="always", cache=True, error_model="numpy")
def advance_cell(c, a, b, d, e, g, h, f, numbers):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the value of one cell after a step, given its own value, its six neighbours' and its datum."""
    w0, w1, w2, decay, rest, hold = numbers
    v = c + (w0 * ((a - c) + (b - c)) + w1 * ((d - c) + (e - c)) + w2 * ((g - c) + (h - c)))
    v = v / math.sqrt(decay + rest * (v * v))
    return v + hold * (f - v)


@njit(parallel=True, cache=True, error_model="numpy")
def sweep(u, f, inside, new, numbers):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Do one step from `u` to `new`, (n0, n1, n2); a neighbour that does not exist has the cell's own value."""
    n0, n1, n2 = u.shape
    masked = inside.size > 0
    for row in prange(n0 * n1):
        i, j = row // n1, row % n1
        below, above = max(i - 1, 0), min(i + 1, n0 - 1)
        before_j, after_j = max(j - 1, 0), min(j + 1, n1 - 1)
        if masked:
            for k in range(n2):
                if not inside[i, j, k]:
                    continue
                c = u[i, j, k]
                before, after = max(k - 1, 0), min(k + 1, n2 - 1)
                new[i, j, k] = advance_cell(
                    c,
                    u[below, j, k] if inside[below, j, k] else c,
                    u[above, j, k] if inside[above, j, k] else c,
                    u[i, before_j, k] if inside[i, before_j, k] else c,
                    u[i, after_j, k] if inside[i, after_j, k] else c,
                    u[i, j, before] if inside[i, j, before] else c,
                    u[i, j, after] if inside[i, j, after] else c,
                    np.float32(f[i, j, k]),
                    numbers,
                )
        else:
            line, data, out = u[i, j], f[i, j], new[i, j]
            a, b, d, e = u[below, j], u[above, j], u[i, before_j], u[i, after_j]
            last_k = n2 - 1
            for k in range(1, last_k):
                out[k] = advance_cell(
                    line[k], a[k], b[k], d[k], e[k], line[k - 1], line[k + 1], np.float32(data[k]), numbers
                )
            for k in (0, last_k):
                before, after = max(k - 1, 0), min(k + 1, last_k)
                out[k] = advance_cell(
                    line[k], a[k], b[k], d[k], e[k], line[before], line[after], np.float32(data[k]), numbers
                )
