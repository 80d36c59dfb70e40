"""Values along rays through bricks, compiled: see `infill.inspection.thickness`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.sparse import B0, B1, B2, SOLID_BRICK


@njit(nogil=True, cache=True)
def sample_rays(slots, values, shape, start, direction, distance, size, level, out):
    """Set out[ray, place] to 1 where the cell that holds a place, mm, is above a level, else to -1."""
    n0, n1, n2 = shape
    for ray in range(len(start)):
        x, y, z = start[ray, 0] / size[0], start[ray, 1] / size[1], start[ray, 2] / size[2]
        dx, dy, dz = direction[ray, 0] / size[0], direction[ray, 1] / size[1], direction[ray, 2] / size[2]
        for place in range(len(distance)):
            travelled = distance[place]
            i, j, k = math.floor(x + travelled * dx), math.floor(y + travelled * dy), math.floor(z + travelled * dz)
            out[ray, place] = -1.0
            if i < 0 or j < 0 or k < 0 or i >= n0 or j >= n1 or k >= n2:
                continue
            i, j, k = i + 1, j + 1, k + 1
            slot = slots[i // B0, j // B1, k // B2]
            if slot == SOLID_BRICK or (slot >= 0 and values[slot, i % B0, j % B1, k % B2] > level):
                out[ray, place] = 1.0
