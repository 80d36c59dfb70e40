"""Fewer triangles within a tolerance: ``python -m benchmarks.simplify [FILE ...]``.

The smooth surface of an annulus (voxels of 0.25 mm, tolerance 0.02 mm), and that of any meshes given (200 voxels along
the longest side, tolerance a tenth of a voxel), simplified by `infill.meshes.simplification`, and by two
others that are told to stay within the same tolerance: manifold3d collapses short edges, and fast-simplification
(quadric errors) is run with fewer and fewer triangles until it goes too far or opens the mesh. In pairs; distances both
ways, at 20 places drawn on each triangle.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import manifold3d
import numpy as np

from infill import Surface, read_mesh, smooth_mesh, smooth_volume
from infill.meshes.distance import TriangleTree
from infill.meshes.intersections import count_self_intersections
from infill.meshes.simplification import simplify_surface

PLACES = 20  # on each triangle
HALVINGS = 10


def annulus() -> Surface:
    """Return the smooth surface of a ring of 20 and 10 mm radius, 10 mm high, in voxels of 0.25 mm."""
    x, y, z = np.indices((180, 180, 60), dtype=np.float64)
    away = np.hypot(x - 89.5, y - 89.5)
    solid = (away < 80) & (away > 40) & (abs(z - 29.5) < 20)
    return smooth_volume(solid, spacing=0.25, refine=True, tolerance=None).surface


def farthest(one: Surface, other: Surface, places: int = PLACES) -> float:
    """Return how far one surface lies from the other at most, at places that are drawn, mm."""
    shares = np.random.default_rng(1).dirichlet([1, 1, 1], (len(one.faces), places))
    points = np.einsum("fpk,fkc->fpc", shares, np.asarray(one.vertices)[one.faces]).reshape(-1, 3)
    return float(TriangleTree.of(other).nearest(np.concatenate([points, np.asarray(one.vertices)]))[0].max())


def by_manifold(surface: Surface, tolerance: float) -> Surface:
    """Return the surface simplified by manifold3d, by half the tolerance: it moves up to twice as far as it is told."""
    mesh = manifold3d.Mesh64(
        vert_properties=np.asarray(surface.vertices, dtype=np.float64),
        tri_verts=np.asarray(surface.faces, dtype=np.uint64),
    )
    found = manifold3d.Manifold(mesh).simplify(tolerance / 2).to_mesh64()
    return Surface(vertices=found.vert_properties[:, :3], faces=found.tri_verts.astype(np.int64))


def by_quadrics(surface: Surface, tolerance: float) -> Surface:
    """Return the surface with as few triangles as fast-simplification can leave within the tolerance, closed."""
    import fast_simplification

    low, high, best = 4.0, float(len(surface.faces)), surface
    for _ in range(HALVINGS):
        count = float(np.sqrt(low * high))
        points, faces = fast_simplification.simplify(
            np.asarray(surface.vertices, dtype=np.float64), surface.faces.astype(np.int32), target_count=int(count)
        )
        found = Surface(vertices=np.asarray(points, dtype=np.float64), faces=np.asarray(faces))
        whole = found.closed and found.euler_number == surface.euler_number
        if whole and max(farthest(surface, found, 1), farthest(found, surface)) <= tolerance:
            best, high = found, count
        else:
            low = count
    return best


WAYS: dict[str, Callable[[Surface, float], Surface]] = {
    "ours": lambda surface, tolerance: simplify_surface(surface, tolerance=tolerance),
    "manifold3d": by_manifold,
    "fast-simplification, searched": by_quadrics,
}


def compare(name: str, surface: Surface, tolerance: float, runs: int) -> None:
    """Print a table: one line for each way."""
    print(f"\n{name}: {len(surface.faces):,} triangles, tolerance {tolerance:.3g} mm\n")
    print("| | triangles | times fewer | seconds | given to found | found to given | closed | crossing | volume |")
    print("|---|---|---|---|---|---|---|---|---|")
    seconds: dict[str, list[float]] = {way: [] for way in WAYS}
    for _ in range(runs):  # in turn, so that a drift of the machine's speed falls on all
        for way, simplify in WAYS.items():
            begin = time.perf_counter()
            simplify(surface, tolerance)
            seconds[way].append(time.perf_counter() - begin)
    for way, simplify in WAYS.items():
        found = simplify(surface, tolerance)
        whole = found.closed and found.euler_number == surface.euler_number
        crossing = count_self_intersections(np.asarray(found.vertices), found.faces)
        print(
            f"| {way} | {len(found.faces):,} | {len(surface.faces) / len(found.faces):.1f} | "
            f"{np.median(seconds[way]):.2f} | {farthest(surface, found, 3) / tolerance:.2f} tolerances | "
            f"{farthest(found, surface) / tolerance:.2f} | {'yes' if whole else 'NO'} | {crossing} | "
            f"{100 * (found.volume / surface.volume - 1):+.4f} % |"
        )


def main() -> None:
    """Compare the annulus and the files that are named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    compare("annulus", annulus(), 0.02, options.runs)
    for path in options.files:
        found = smooth_mesh(read_mesh(path), tolerance=None)
        compare(path.name, found.surface, 0.1 * min(found.report["grid"]["spacing"]), options.runs)


if __name__ == "__main__":
    main()
