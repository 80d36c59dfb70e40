"""How near `smooth_points` comes to shapes from points on them: ``python -m benchmarks.smooth_points``.

Points are scattered over five turned shapes, with and without noise of a quarter of a voxel, and smoothed with their
normals, without them, and by their cells alone (``method="plain"``).
"""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
import trimesh

from infill import GeometryError, Surface, smooth_points
from infill.meshes.distance import distances

COUNT, VOXEL, NOISE = 30_000, 0.4, 0.1
SHAPES = {
    "ball": trimesh.creation.icosphere(subdivisions=5, radius=10),
    "box": trimesh.creation.box((20, 14, 9)),
    "torus": trimesh.creation.torus(8, 3, major_sections=256, minor_sections=128),
    "plate": trimesh.creation.box((20, 14, 1.6)),
    "cylinder": trimesh.creation.cylinder(5, 15, sections=256),
}


def clouds() -> Iterator[tuple[str, float, trimesh.Trimesh, np.ndarray, np.ndarray]]:
    """Yield each shape with points on it, (N, 3), and their normals."""
    turn = trimesh.transformations.rotation_matrix(0.7, [1, 2, 3])
    for name, shape in SHAPES.items():
        mesh = shape.copy()
        mesh.apply_transform(turn)
        points, faces = trimesh.sample.sample_surface_even(mesh, COUNT, seed=1)
        for noise in (0.0, NOISE):
            scattered = points + np.random.default_rng(1).normal(0, noise, points.shape)
            yield name, noise, mesh, scattered, np.asarray(mesh.face_normals[faces])


def main() -> None:
    """Print a table."""
    print(f"{COUNT:,} points, voxels of {VOXEL:g} mm; distances from the surface to the shape in voxels")
    print(f"{'shape':9} {'noise':>5}  {'by':14} {'volume':>8} {'mean':>6} {'max':>5} {'s':>5}")
    for name, noise, mesh, points, normals in clouds():
        truth = Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))
        for by in ("normals", "points alone", "cells"):
            begin = time.perf_counter()
            given = normals if by == "normals" else None
            try:
                result = smooth_points(
                    points, voxel=VOXEL, normals=given, method="plain" if by == "cells" else "auto", tolerance=None
                )
            except GeometryError as error:
                print(f"{name:9} {noise:5g}  {by:14} refused: {str(error)[:60]}")
                continue
            seconds = time.perf_counter() - begin
            away = distances(result.surface.vertices, truth) / VOXEL
            off = f"{result.mesh.volume / mesh.volume - 1:+.2%}"
            print(f"{name:9} {noise:5g}  {by:14} {off:>8} {away.mean():6.3f} {away.max():5.2f} {seconds:5.1f}")


if __name__ == "__main__":
    main()
