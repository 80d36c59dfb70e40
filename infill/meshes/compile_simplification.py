"""Compile the kernels of simplification: `python -m infill.meshes.compile_simplification`.

A ring is simplified, with the number types that smoothing gives to all surfaces, so that a second process can do
this while the first one still smooths: see `infill.kernels.second_compiler`.
"""

from __future__ import annotations

import numpy as np

from infill.meshes.edge_collapse import collapse_edges
from infill.surface import Surface

SIDES = 200  # squares around each way: enough triangles for two patches


def make_ring() -> Surface:
    """Make a ring of triangles, a torus with radii of 2 and 1 mm."""
    angle = np.arange(SIDES) * (2 * np.pi / SIDES)
    across, along = np.meshgrid(angle, angle, indexing="ij")
    reach = 2 + np.cos(across)
    vertices = np.stack([reach * np.cos(along), reach * np.sin(along), np.sin(across)], axis=2)
    index = np.arange(SIDES * SIDES, dtype=np.int32).reshape(SIDES, SIDES)
    right, above = np.roll(index, -1, axis=1), np.roll(index, -1, axis=0)
    beyond = np.roll(right, -1, axis=0)
    faces = np.stack([np.stack([index, right, beyond], axis=2), np.stack([index, beyond, above], axis=2)])
    return Surface(vertices=vertices.reshape(-1, 3), faces=faces.reshape(-1, 3))


if __name__ == "__main__":
    collapse_edges(make_ring(), tolerance=0.01)
