"""Decompress meshes of Draco by DracoPy, where it is installed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def unpack_draco(data: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64]] | None:
    """Decompress a mesh; return vertices and triangles, or None if DracoPy is not installed.

    Raises
    ------
    ValueError
        If the data hold no mesh.
    """
    try:
        import DracoPy
    except ImportError:
        return None
    try:
        mesh = DracoPy.decode(data)
    except DracoPy.FileTypeException as error:
        raise ValueError("the Draco data cannot be unpacked") from error
    faces = getattr(mesh, "faces", None)
    if faces is None:
        raise ValueError("the Draco data hold points and no triangles")
    return np.asarray(mesh.points, dtype=np.float64).reshape(-1, 3), np.asarray(faces, dtype=np.int64).reshape(-1, 3)
