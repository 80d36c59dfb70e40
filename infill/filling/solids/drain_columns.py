"""Lines straight up through a part: where each enters its solid, and the void it meets first above that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.ragged import spread
from infill.surface import Surface

PAIRS_AT_ONCE = 2_000_000  # of triangles and lines that are looked at together
PART = -1  # the owner of a crossing of the skin of the part

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Lattice:
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
        """Return where lines stand, (N, 2) mm."""
        return self.low + self.step * np.stack(np.divmod(lines, self.shape[1]), axis=1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Ways:
    """Lines that enter the solid of a part and meet a void next, (N,) each.

    Parameters
    ----------
    line : (N,) int64
        Number of the line in its lattice.
    at : (N, 2) float64, mm
    skin : (N,) float64, mm
        Height at which the line enters the solid.
    face : (N,) int64
        The face of the part there.
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


def find_ways(part: Surface, voids: Surface, names: NDArray[np.integer], lattice: Lattice) -> Ways:
    """Find the lines of a lattice that pass from outside a part through solid alone into a void.

    Parameters
    ----------
    part : Surface, mm
        Closed, facing outwards.
    voids : Surface, mm
        Closed, each facing outwards from itself.
    names : (V,) int
        The void of every vertex.
    lattice : Lattice

    Notes
    -----
    Upwards along a line, the skin of the part and those of the voids are crossed in the order of their heights. A way
    is a crossing into the part that is followed at once by one into a void. Lines that leave the part or a void more or
    less often than they enter it run along an edge, and are left out.
    """
    line, height, up, face = cross(part, lattice)
    own, tops, ups, crossed = cross(voids, lattice)
    owner = names[voids.faces[crossed, 0]] if len(voids.faces) else np.empty(0, dtype=np.int64)
    lines = np.concatenate([line, own])
    heights = np.concatenate([height, tops])
    rising = np.concatenate([up, ups])
    owners = np.concatenate([np.full(len(line), PART, dtype=np.int64), owner.astype(np.int64)])
    faces = np.concatenate([face, np.full(len(own), -1, dtype=np.int64)])
    order = np.lexsort((heights, lines))
    lines, heights, rising, owners, faces = (each[order] for each in (lines, heights, rising, owners, faces))
    kind, count = owners == PART, int(np.prod(lattice.shape))
    even = np.ones(count, dtype=bool)
    for some in (kind, ~kind):
        even &= np.bincount(lines[some], weights=rising[some], minlength=count) == 0
    depth = np.cumsum(np.where(kind, rising, 0))  # of all lines before too
    odd = np.concatenate(
        [[0.0], np.cumsum(np.where(~even, np.bincount(lines[kind], weights=rising[kind], minlength=count), 0))]
    )
    depth = depth - odd[lines]
    first = np.arange(max(len(lines) - 2, 0))
    second, third = first + 1, first + 2
    kept = (
        (lines[first] == lines[third])
        & even[lines[first]]
        & kind[first]
        & (rising[first] > 0)
        & (depth[first] == 1)
        & ~kind[second]
        & (rising[second] > 0)
        & (owners[third] == owners[second])
        & (rising[third] < 0)
    )
    found = np.flatnonzero(kept)
    return Ways(
        line=lines[found],
        at=lattice.places(lines[found]),
        skin=heights[found],
        face=faces[found],
        void=owners[found + 1],
        floor=heights[found + 1],
        ceiling=heights[found + 2],
    )


def cross(surface: Surface, lattice: Lattice) -> tuple[Integers, Floats, Integers, Integers]:
    """Find where the lines of a lattice cross a surface: the line, the height in mm, 1 into it or -1 out, and the face.

    >>> import trimesh
    >>> box = trimesh.creation.box((2, 2, 2))
    >>> lattice = Lattice(low=np.array([0.1, 0.3]), step=1.0, shape=(1, 1))
    >>> line, height, up, _ = cross(Surface(vertices=box.vertices, faces=box.faces), lattice)
    >>> sorted(zip(height.round(9).tolist(), up.tolist()))
    [(-1.0, 1), (1.0, -1)]
    """
    nodes = (np.asarray(surface.vertices, dtype=np.float64)[:, :2] - lattice.low) / lattice.step
    heights = np.asarray(surface.vertices, dtype=np.float64)[:, 2]
    corners = nodes[surface.faces]
    most = np.array(lattice.shape) - 1
    low = np.clip(np.ceil(corners.min(axis=1)), 0, most + 1).astype(np.int64)
    high = np.clip(np.floor(corners.max(axis=1)), -1, most).astype(np.int64)
    across = np.clip(high - low + 1, 0, None)
    found = []
    for face, place in spread(across.prod(axis=1), PAIRS_AT_ONCE):
        i, j = np.divmod(place, across[face, 1])
        i, j = i + low[face, 0], j + low[face, 1]
        a, b, c = (corners[face, corner] - np.stack([i, j], axis=1) for corner in range(3))
        shares = np.stack([_turn(b, c), _turn(c, a), _turn(a, b)], axis=1)
        area = shares.sum(axis=1)
        hit = (area != 0) & ((shares * np.sign(area)[:, None]) >= 0).all(axis=1)
        face, shares, area = face[hit], shares[hit], area[hit]
        height = (shares * heights[surface.faces[face]]).sum(axis=1) / area
        found.append((i[hit] * lattice.shape[1] + j[hit], height, np.where(area < 0, 1, -1), face))
    if not found:
        none = np.empty(0, dtype=np.int64)
        return none, np.empty(0), none, none
    line, height, up, face = (np.concatenate(each) for each in zip(*found, strict=True))
    return line, height, up, face


def _turn(one: Floats, other: Floats) -> Floats:
    turned: Floats = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return turned
