"""A part hollowed and a lattice united with it by trimesh: ``python -m benchmarks.peers.lattice_boolean``.

The inside of the walls is an isosurface of distances between voxels, the lattice a mesh of its own, and manifold3d cuts
and unites. A lattice that another program made may be given instead.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from scipy import ndimage
from skimage.measure import marching_cubes


def inside_of_walls(part: trimesh.Trimesh, wall: float, pitch: float) -> trimesh.Trimesh:
    """Return what lies a wall below the surface, by distances between voxels."""
    voxels = part.voxelized(pitch).fill()
    solid = np.pad(voxels.matrix, 2)
    depth = ndimage.distance_transform_edt(solid) * pitch - pitch / 2
    found = isosurface(depth - wall, pitch)
    origin = voxels.transform[:3, 3] - 2 * pitch
    return found.apply_translation(origin)


def isosurface(field: np.ndarray, pitch: float) -> trimesh.Trimesh:
    """Return the surface of {field > 0}, facing outwards, closed at the border."""
    vertices, faces, *_ = marching_cubes(np.pad(field, 1, constant_values=-1), 0.0)
    found = trimesh.Trimesh((vertices - 1) * pitch, faces)
    if found.volume < 0:
        found.invert()
    return found


def gyroid(bounds: np.ndarray, cell: float, density: float, pitch: float) -> trimesh.Trimesh:
    """Return sheets of the usual formula between two of its levels, which give the density."""
    axes = [np.arange(low, high + pitch, pitch) * 2 * np.pi / cell for low, high in bounds.T]
    x, y, z = np.meshgrid(*axes, indexing="ij", sparse=True)
    field = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    level = np.quantile(np.abs(field), density)
    return isosurface(level - np.abs(field), pitch).apply_translation(bounds[0])


def octet(bounds: np.ndarray, cell: float, diameter: float) -> trimesh.Trimesh:
    """Return the bars of octet cells as cylinders with balls at their ends, united."""
    import manifold3d

    count = np.ceil((bounds[1] - bounds[0]) / cell).astype(int) + 1
    nodes = np.stack(np.meshgrid(*(np.arange(2 * n + 1) for n in count), indexing="ij"), axis=-1).reshape(-1, 3)
    nodes = nodes[nodes.sum(axis=1) % 2 == 0]
    steps = np.array([(1, 1, 0), (1, -1, 0), (1, 0, 1), (1, 0, -1), (0, 1, 1), (0, 1, -1)])
    known = set(map(tuple, nodes.tolist()))
    bar = manifold3d.Manifold.cylinder(cell / np.sqrt(2), diameter / 2, circular_segments=16)
    ball = manifold3d.Manifold.sphere(diameter / 2, 16)
    pieces: list[Any] = [ball.translate(node * cell / 2 + bounds[0]) for node in nodes]
    for step in steps:
        turn = trimesh.geometry.align_vectors((0, 0, 1), step / np.sqrt(2))[:3]
        turned = bar.transform(turn)
        pieces += [
            turned.translate(node * cell / 2 + bounds[0]) for node in nodes if tuple((node + step).tolist()) in known
        ]
    found = manifold3d.Manifold.batch_boolean(pieces, manifold3d.OpType.Add).to_mesh()
    return trimesh.Trimesh(found.vert_properties[:, :3], found.tri_verts)


def mended(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Return a lattice closed where a few edges gape, facing outwards; manifold3d makes nothing of an open one."""
    mesh.process(validate=True)
    trimesh.repair.fill_holes(mesh)
    if not mesh.is_watertight:
        raise ValueError("the lattice is not closed, and filling its holes did not close it")
    if mesh.volume < 0:
        mesh.invert()
    return mesh


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--lattice", help="gyroid, octet, or a mesh of it")
    parser.add_argument("--inside", type=Path, help="write what lies inside the walls, and end")
    parser.add_argument("--cell", type=float)
    parser.add_argument("--diameter", type=float, help="of the bars of octet")
    parser.add_argument("--density", type=float)
    parser.add_argument("--wall", type=float)
    parser.add_argument("--pitch", type=float, default=0.3)
    given = parser.parse_args()
    part = trimesh.load_mesh(given.part)
    inside = inside_of_walls(part, given.wall, given.pitch)
    if given.inside:
        inside.export(given.inside)
        return
    if given.lattice == "gyroid":
        lattice = gyroid(inside.bounds, given.cell, given.density, given.pitch)
    elif given.lattice == "octet":
        lattice = octet(inside.bounds, given.cell, given.diameter)
    else:
        lattice = mended(trimesh.load_mesh(given.lattice))
    shell = trimesh.boolean.difference([part, inside], engine="manifold", check_volume=False)
    within = trimesh.boolean.intersection([lattice, part], engine="manifold", check_volume=False)
    trimesh.boolean.union([shell, within], engine="manifold", check_volume=False).export(given.output)


if __name__ == "__main__":
    main()
