"""Lines straight up through a part: the place where each enters its solid, and the first void above that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.meshes.split_components import concatenate_surfaces
from infill.surface import Surface

PART = -1  # the owner of a crossing of the skin of the part


@dataclass(frozen=True, kw_only=True, eq=False)
class LineLattice:
    """Vertical lines through the nodes of a square lattice.

    Parameters
    ----------
    low : (2,) float64, mm
        The first node.
    step : float, mm
    shape : (nx, ny)
    """

    low: Floats
    step: float
    shape: tuple[int, int]

    def places(self, lines: Integers) -> Floats:
        """Return the places of lines, (N, 2) mm."""
        return self.low + self.step * np.stack(np.divmod(lines, self.shape[1]), axis=1)


@dataclass(frozen=True, kw_only=True, eq=False)
class DrainWays:
    """Lines that enter the solid of a part and meet a void next, (N,) each.

    Parameters
    ----------
    line : (N,) int64
        Number of the line in its lattice.
    at : (N, 2) float64, mm
    skin : (N,) float64, mm
        Height at which the line enters the solid.
    face : (N,) int64
        The face of the part at that height.
    void : (N,) int64
        The void above.
    floor, ceiling : (N,) float64, mm
        Heights between which the line lies in that void.
    """

    line: Integers
    at: Floats
    skin: Floats
    face: Integers
    void: Integers
    floor: Floats
    ceiling: Floats


def find_ways(part: Surface, voids: Surface, names: NDArray[np.integer], lattice: LineLattice) -> DrainWays:
    """Find the lines of a lattice that pass from outside a part through solid alone into a void.

    Parameters
    ----------
    part : Surface, mm
        Closed, facing outwards.
    voids : Surface, mm
        Closed, each facing outwards from itself.
    names : (V,) int
        The void of every vertex.
    lattice : LineLattice

    Notes
    -----
    Upwards along a line, the skins of the part and of the voids are crossed in the order of their heights. A way is a
    crossing into the part that is directly followed by one into a void. Lines that leave the part or a void more or
    less often than they enter it run along an edge, and are left out.
    """
    both = concatenate_surfaces([part, voids])
    owner = np.full(len(both.faces), PART, dtype=np.int64)
    owner[len(part.faces) :] = names[voids.faces[:, 0]]
    lines, heights, rising, faces = find_crossings(both, lattice)
    owners = owner[faces]
    of_part, count = owners == PART, int(np.prod(lattice.shape))
    is_balanced = np.ones(count, dtype=bool)
    for selection in (of_part, ~of_part):
        is_balanced &= np.bincount(lines[selection], weights=rising[selection], minlength=count) == 0
    depth = np.cumsum(np.where(of_part, rising, 0))  # of all lines before too
    correction = np.concatenate(
        [
            [0.0],
            np.cumsum(np.where(~is_balanced, np.bincount(lines[of_part], weights=rising[of_part], minlength=count), 0)),
        ]
    )
    depth = depth - correction[lines]
    first = np.arange(max(len(lines) - 2, 0))
    second, third = first + 1, first + 2
    is_way = (
        (lines[first] == lines[third])
        & is_balanced[lines[first]]
        & of_part[first]
        & (rising[first] > 0)
        & (depth[first] == 1)
        & ~of_part[second]
        & (rising[second] > 0)
        & (owners[third] == owners[second])
        & (rising[third] < 0)
    )
    ways = np.flatnonzero(is_way)
    return DrainWays(
        line=lines[ways],
        at=lattice.places(lines[ways]),
        skin=heights[ways],
        face=faces[ways],
        void=owners[ways + 1],
        floor=heights[ways + 1],
        ceiling=heights[ways + 2],
    )


def find_crossings(surface: Surface, lattice: LineLattice) -> tuple[Integers, Floats, Integers, Integers]:
    """Find the crossings of lines with a surface: the line, the height in mm, 1 into it or -1 out, and the face.

    Crossings are in the order of the lines, and of the heights on each line.

    >>> import trimesh
    >>> box = trimesh.creation.box((2, 2, 2))
    >>> lattice = LineLattice(low=np.array([0.1, 0.3]), step=1.0, shape=(1, 1))
    >>> line, height, up, _ = find_crossings(Surface(vertices=box.vertices, faces=box.faces), lattice)
    >>> sorted(zip(height.round(9).tolist(), up.tolist()))
    [(-1.0, 1), (1.0, -1)]
    """
    from infill.kernels.upright import count_crossings, list_crossings

    vertices = np.asarray(surface.vertices, dtype=np.float64)
    nodes, faces = (vertices[:, :2] - lattice.low) / lattice.step, np.ascontiguousarray(surface.faces)
    heights, (nx, ny) = np.ascontiguousarray(vertices[:, 2]), lattice.shape
    counts = np.zeros(nx * ny, dtype=np.int64)
    count_crossings(nodes, faces, nx, ny, counts)
    total = int(counts.sum())
    height, rising, owner = np.empty(total), np.empty(total, dtype=np.int64), np.empty(total, dtype=np.int64)
    list_crossings(nodes, heights, faces, nx, ny, np.cumsum(counts) - counts, height, rising, owner)
    return np.repeat(np.arange(nx * ny), counts), height, rising, owner
