"""Compile the kernels of simplification: `python -m infill.meshes.compile_simplification`.

A small ball is simplified, with the number types that smoothing gives to all surfaces, so that a second process can do
this while the first one still smooths: see `infill.kernels.second_compiler`.
"""

from __future__ import annotations

import numpy as np

from infill.meshes.edge_collapse import collapse_edges
from infill.surface import Surface

RINGS, SIDES = 200, 200  # enough triangles for two patches


def make_ball() -> Surface:
    """Make a ball of triangles, radius 1 mm."""
    polar, around = np.linspace(0, np.pi, RINGS + 1)[1:-1], np.arange(SIDES) * (2 * np.pi / SIDES)
    across, along = np.meshgrid(polar, around, indexing="ij")
    rings = np.stack([np.sin(across) * np.cos(along), np.sin(across) * np.sin(along), np.cos(across)], axis=2)
    index = 1 + np.arange((RINGS - 1) * SIDES).reshape(RINGS - 1, SIDES)
    ahead, last = np.roll(index, -1, axis=1), 1 + index.size
    upper, lower = (index[:-1], ahead[:-1]), (index[1:], ahead[1:])
    faces = [
        np.stack([np.zeros_like(index[0]), index[0], ahead[0]], axis=1),
        np.stack([upper[0], lower[0], upper[1]], axis=2).reshape(-1, 3),
        np.stack([upper[1], lower[0], lower[1]], axis=2).reshape(-1, 3),
        np.stack([np.full_like(index[0], last), ahead[-1], index[-1]], axis=1),
    ]
    vertices = np.concatenate([[[0, 0, 1.0]], rings.reshape(-1, 3), [[0, 0, -1.0]]])
    return Surface(vertices=vertices, faces=np.concatenate(faces).astype(np.int32))


if __name__ == "__main__":
    collapse_edges(make_ball(), tolerance=0.01)
