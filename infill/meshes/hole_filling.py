"""Close a mesh as a sum: orient neighbouring faces alike, and put a cap on every hole."""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from infill.arrays import AnyIntegers, Floats
from infill.graph import label_connected
from infill.meshes.shells import vertex_components
from infill.surface import Edges

FLAT = 1e-9  # a component with less than this share of its longest side cubed has no volume

WELD = 0.01  # of a cell: corners of open edges that are closer together than this are merged


def open_edges(faces: AnyIntegers) -> AnyIntegers:
    """Return the directed edges (E, 2) that faces use more often one way than back, repeated by the surplus."""
    edges = Edges.of(faces)
    directed = np.where(edges.surplus[:, None] > 0, edges.ends, edges.ends[:, ::-1])
    return np.repeat(directed, np.abs(edges.surplus), axis=0)


def orient_faces(faces: AnyIntegers) -> AnyIntegers:
    """Reverse faces so that neighbours across an edge of two faces have one orientation; return all faces.

    Parameters
    ----------
    faces : (F, 3) int

    Notes
    -----
    Every face is represented twice, as it is and reversed; edges shared by two faces link the copies that agree.
    A patch is then two components, and the one with more faces as they are is used. A one-sided patch
    (a Möbius strip) is a single component, and stays as it is.
    """
    start, end = faces.ravel().astype(np.int64), np.roll(faces, -1, axis=1).ravel().astype(np.int64)
    key = np.minimum(start, end) * (int(faces.max()) + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    group_start = np.flatnonzero(np.diff(key[order], prepend=-1))
    pairs = group_start[np.diff(group_start, append=len(key)) == 2]
    edge_side, twin_side = order[pairs], order[pairs + 1]
    opposed = (start[edge_side] < end[edge_side]) == (start[twin_side] < end[twin_side])
    edge_side, twin_side, count = edge_side // 3, twin_side // 3, len(faces)
    source, target = np.concatenate([edge_side, edge_side + count]), np.concatenate([twin_side, twin_side + count])
    target = np.where(np.tile(opposed, 2), (target + count) % (2 * count), target)
    label, _ = label_connected(source, target, 2 * count)
    label_kept, label_reversed = label[:count], label[count:]
    size = np.bincount(label_kept, minlength=int(label.max()) + 1)
    reverse = (size[label_kept] < size[label_reversed]) | (
        (size[label_kept] == size[label_reversed]) & (label_kept > label_reversed)
    )
    return np.where(reverse[:, None], faces[:, ::-1], faces)


def weld_boundary(vertices: Floats, faces: AnyIntegers) -> AnyIntegers:
    """Merge corners on open edges that are closer than `WELD`, vertices in cells; return the faces."""
    from scipy.spatial import KDTree

    border = np.unique(open_edges(faces))
    pairs = KDTree(vertices[border]).query_pairs(WELD, output_type="ndarray")
    label, _ = label_connected(pairs[:, 0], pairs[:, 1], len(border))
    number = np.arange(len(vertices))
    number[border] = border[np.unique(label, return_index=True)[1]][label]
    return number[faces]


def split_loops(edges: AnyIntegers) -> list[list[int]]:
    """Split directed edges into loops that visit no vertex twice; every vertex must have as many edges in as out.

    >>> split_loops(np.array([[0, 1], [1, 2], [2, 0]]))
    [[0, 1, 2]]
    """
    ahead: dict[int, list[int]] = defaultdict(list)
    for start, end in edges.tolist():
        ahead[start].append(end)
    cycles = []
    for start in list(ahead):
        path, position = [start], {start: 0}
        while ahead[path[-1]]:
            following = ahead[path[-1]].pop()
            if following in position:
                loop = path[position[following] :]
                cycles.append(loop)
                del path[position[following] + 1 :]
                for vertex in loop[1:]:
                    del position[vertex]
            else:
                position[following] = len(path)
                path.append(following)
    return cycles


def fill_holes(vertices: Floats, faces: AnyIntegers) -> tuple[Floats, AnyIntegers, int]:
    """Put a cap on every hole; return vertices, faces and the number of holes.

    Parameters
    ----------
    vertices : (V, 3) float64
        In cells.
    faces : (F, 3) int

    Returns
    -------
    vertices : (V + n, 3) float64
    faces : (F + m, 3) int
        The caps come last. Every edge is traversed as often in one direction as in the other.
    holes : int

    Notes
    -----
    First, cracks are closed and faces whose orientation disagrees with their neighbours' are reversed: see
    `weld_boundary` and `orient_faces`. A cap is a fan from the centre of the hole's rim. Where a triangle occurs
    twice, its three edges are a "hole" whose cap cancels it.
    """
    if len(open_edges(faces)) == 0:
        return vertices, faces, 0
    faces = orient_faces(weld_boundary(vertices, faces))
    rims = split_loops(open_edges(faces))
    apexes: list[Floats] = []
    caps = []
    for loop in rims:
        if len(loop) == 3:
            caps.append([loop[::-1]])
            continue
        ring = np.array(loop)
        points = vertices[ring]
        lengths = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
        centroid = np.average((np.roll(points, -1, axis=0) + points) / 2, axis=0, weights=lengths)
        # Rounding must not move the sum out of a plane of the axes.
        apexes.append(np.clip(centroid, points.min(axis=0), points.max(axis=0)))
        apex = np.full(len(ring), len(vertices) + len(apexes) - 1)
        caps.append(np.column_stack([np.roll(ring, -1), ring, apex]).tolist())
    if not rims:
        return vertices, faces, 0
    cap_faces = np.concatenate([np.array(faces_of_cap, dtype=np.int64) for faces_of_cap in caps])
    return np.concatenate([vertices, np.reshape(apexes, (-1, 3))]), np.concatenate([faces, cap_faces]), len(rims)


def component_volumes(vertices: Floats, faces: AnyIntegers) -> tuple[AnyIntegers, Floats]:
    """Return the component of every face, by shared vertices, and the signed volume of each component.

    Parameters
    ----------
    vertices : (V, 3) float64
    faces : (F, 3) int
        Closed as a sum: see `fill_holes`.

    Returns
    -------
    component : (F,) int
    volumes : (B,) float64
        0 for a component that encloses nothing but rounding errors.
    """
    of_vertex, count = vertex_components(faces, len(vertices))
    component = of_vertex[faces[:, 0]]
    # Relative to a corner of the component, so that a small one far out loses no digits.
    first_face = np.unique(component, return_index=True)[1]
    a, b, c = (vertices[faces[:, i]] - vertices[faces[first_face, 0]][component] for i in range(3))
    sixfold = np.einsum("ij,ij->i", a, np.cross(b, c))
    reach = np.zeros(count)
    np.maximum.at(reach, component, np.abs([a, b, c]).max(axis=(0, 2)))
    volumes = np.bincount(component, weights=sixfold, minlength=count) / 6
    volumes[np.abs(volumes) <= FLAT * reach**3] = 0.0
    return component, volumes
