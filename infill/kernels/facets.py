"""The triangles of a surface in the layout of STL, compiled: see `infill.formats.stl`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy")
def write_facets(vertices, faces, facets, thread, threads):
    """Set the unit normal of every face, 0 if it has no area, and its three corners: (n, 12) float32."""
    size = (len(faces) + threads - 1) // threads
    for f in range(thread * size, min(len(faces), (thread + 1) * size)):
        out = facets[f]
        for corner in range(3):
            for axis in range(3):
                out[3 * corner + 3 + axis] = vertices[faces[f, corner], axis]
        ax, ay, az = out[6] - out[3], out[7] - out[4], out[8] - out[5]
        bx, by, bz = out[9] - out[3], out[10] - out[4], out[11] - out[5]
        x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
        length = np.float32(math.sqrt(x * x + y * y + z * z))
        if length > 0:
            out[0], out[1], out[2] = x / length, y / length, z / length
        else:
            out[0] = out[1] = out[2] = np.float32(0)
