"""One number for a set of triangles, whatever the order in which they come."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from infill.kernels.chunk_sums import HIGH, LOW, sum_faces

BITS = 64


def face_sums(vertices: NDArray[np.floating], faces: NDArray[np.integer], unit: float) -> NDArray[np.int64]:
    """Return the sums over triangles that `infill.kernels.chunk_sums.sum_faces` names, (4,) int64.

    Parameters
    ----------
    vertices : (V, 3) float, mm
    faces : (F, 3) int
    unit : float, mm²
        Unit of the area.
    """
    points = np.ascontiguousarray(vertices, dtype=np.float64) + 0.0  # without negative zeros
    sums = np.zeros(4, dtype=np.int64)
    sum_faces(points, points.view(np.uint64), np.ascontiguousarray(faces, dtype=np.int64), unit, sums)
    return sums


def add_up(sums: Iterable[NDArray[np.int64]], unit: float) -> tuple[str, bool, float]:
    """Return the hash of all triangles as 16 digits, whether they are closed, and their area, mm²."""
    total = [0, 0, 0, 0]
    for piece in sums:
        total = [before + number for before, number in zip(total, piece.tolist(), strict=True)]
    area = ((total[2] << LOW) + total[3]) / (1 << (HIGH + LOW)) * unit
    return f"{total[0] % 2**BITS:016x}", total[1] % 2**BITS == 0, area


def hash_surface(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> str:
    """Return the hash of a surface: 16 digits that do not depend on the order of its triangles and vertices.

    >>> corners, face = np.eye(3), np.array([[0, 1, 2]])
    >>> hash_surface(corners, face) == hash_surface(corners[[2, 0, 1]], face)
    True
    >>> hash_surface(corners, face) == hash_surface(corners, face[:, ::-1])
    False
    """
    return add_up([face_sums(vertices, faces, 1.0)], 1.0)[0]
