"""What the judge of smoothing measures with: VTK, trimesh, SciPy and a ray cast of its own; nothing of infill.

Meshes are those of trimesh. Lengths are in whatever the coordinates are in; the judge gives voxels.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numba
import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial.transform import Rotation

Points = NDArray[np.float64]


class Nearest:
    """Where a surface, or a set of line segments, comes nearest to points: VTK's cell locator.

    Parameters
    ----------
    vertices : (V, 3) float
    cells : (C, 3) int for triangles, (C, 2) int for segments
    """

    def __init__(self, vertices: Points, cells: NDArray[np.integer]) -> None:
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator

        count, corners = cells.shape
        points, array, data = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices, dtype=np.float64), deep=True))
        array.SetData(
            numpy_to_vtkIdTypeArray(np.arange(0, corners * count + 1, corners, dtype=np.int64), deep=True),
            numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, dtype=np.int64).ravel(), deep=True),
        )
        data.SetPoints(points)
        (data.SetPolys if corners == 3 else data.SetLines)(array)
        self._locator = vtkStaticCellLocator()
        self._locator.SetDataSet(data)
        self._locator.BuildLocator()

    def __call__(self, points: Points) -> tuple[Points, NDArray[np.int64]]:
        """Return the nearest point for each of (N, 3) points, and the cell on which it lies."""
        from vtkmodules.vtkCommonCore import reference
        from vtkmodules.vtkCommonDataModel import vtkGenericCell

        feet, cells = np.empty((len(points), 3)), np.empty(len(points), dtype=np.int64)
        foot, cell, generic = [0.0, 0.0, 0.0], reference(0), vtkGenericCell()
        part, squared = reference(0), reference(0.0)
        for n, point in enumerate(points.tolist()):
            self._locator.FindClosestPoint(point, foot, generic, cell, part, squared)
            feet[n], cells[n] = foot, cell.get()
        return feet, cells


def nearest(mesh: trimesh.Trimesh) -> Nearest:
    """Return where the mesh comes nearest to points."""
    return Nearest(mesh.vertices, mesh.faces)


@dataclass(frozen=True)
class Sample:
    """Points spread evenly over a surface, each with the normal of its triangle."""

    points: Points
    normals: Points


def sampled(mesh: trimesh.Trimesh, count: int, seed: int = 0) -> Sample:
    """Return `count` points, uniform over the area."""
    points, faces = trimesh.sample.sample_surface(mesh, count, seed=seed)
    return Sample(np.array(points), mesh.face_normals[faces])


def some_vertices(mesh: trimesh.Trimesh, count: int, seed: int = 0) -> Points:
    """Return the vertices that faces use, or `count` of them if there are more."""
    used = np.unique(mesh.faces)
    if len(used) > count:
        used = np.random.default_rng(seed).choice(used, count, replace=False)
    return np.asarray(mesh.vertices)[used]


def borders(mesh: trimesh.Trimesh) -> NDArray[np.integer]:
    """Return the edges with one face, (E, 2)."""
    return mesh.edges[trimesh.grouping.group_rows(mesh.edges_sorted, require_count=1)]


def winding(mesh: trimesh.Trimesh, points: Points, rays: int = 3) -> NDArray[np.int64]:
    """Return how often the mesh winds around each point: the median over rays of skew directions.

    A ray counts the triangles it leaves through less those it enters through; on an open mesh it may miss some.
    """
    counts = np.empty((rays, len(points)), dtype=np.int64)
    for n, turn in enumerate(Rotation.random(rays, rng=np.random.default_rng(7)).as_matrix()):
        counts[n] = _upwards(mesh.triangles @ turn.T, points @ turn.T)
    return np.sort(counts, axis=0)[rays // 2]


def _upwards(triangles: NDArray[np.float64], points: Points) -> NDArray[np.int64]:
    """Return the signed crossings above each point, by bins of the plane of x and y."""
    flat = triangles[:, :, :2]
    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    side = int(np.clip(np.sqrt(len(triangles)), 1, 700))
    scale = side / np.maximum(high - low, 1e-30)
    first, last = (((each(flat, axis=1) - low) * scale).astype(np.int64) for each in (np.min, np.max))
    first, last = np.clip(first, 0, side - 1), np.clip(last, 0, side - 1)
    starts, members = _binned(first, last, side)
    at = (points[:, :2] - low) * scale
    inside = ((at >= 0) & (at <= side)).all(axis=1)
    out = np.zeros(len(points), dtype=np.int64)
    cell = np.clip(at[inside].astype(np.int64), 0, side - 1)
    out[inside] = _crossings(triangles, points[inside], cell[:, 0] * side + cell[:, 1], starts, members)
    return out


@numba.njit(cache=True)
def _binned(first, last, side):  # pragma: no cover
    starts = np.zeros(side * side + 1, dtype=np.int64)
    for n in range(len(first)):
        for i in range(first[n, 0], last[n, 0] + 1):
            for j in range(first[n, 1], last[n, 1] + 1):
                starts[i * side + j + 1] += 1
    starts = np.cumsum(starts)
    members, filled = np.empty(starts[-1], dtype=np.int64), starts[:-1].copy()
    for n in range(len(first)):
        for i in range(first[n, 0], last[n, 0] + 1):
            for j in range(first[n, 1], last[n, 1] + 1):
                members[filled[i * side + j]] = n
                filled[i * side + j] += 1
    return starts, members


@numba.njit(cache=True)
def _crossings(triangles, points, cells, starts, members):  # pragma: no cover
    out = np.zeros(len(points), dtype=np.int64)
    for n in range(len(points)):
        x, y, z = points[n]
        for m in members[starts[cells[n]] : starts[cells[n] + 1]]:
            t = triangles[m]
            a = (t[1, 0] - x) * (t[2, 1] - y) - (t[2, 0] - x) * (t[1, 1] - y)
            b = (t[2, 0] - x) * (t[0, 1] - y) - (t[0, 0] - x) * (t[2, 1] - y)
            c = (t[0, 0] - x) * (t[1, 1] - y) - (t[1, 0] - x) * (t[0, 1] - y)
            crossed = (a > 0 and b > 0 and c > 0) or (a < 0 and b < 0 and c < 0)
            if crossed and (a * t[0, 2] + b * t[1, 2] + c * t[2, 2]) / (a + b + c) > z:
                out[n] += 1 if a > 0 else -1
    return out


def hidden(mesh: trimesh.Trimesh, sample: Sample, step: float) -> NDArray[np.bool_]:
    """Tell which points of a sample have solid on both sides: faces inside another body, or inside their own."""
    rays = 3 if mesh.is_watertight else 5
    before, behind = (winding(mesh, sample.points + way * step * sample.normals, rays) for way in (1, -1))
    return (before != 0) & (behind != 0)


def united_volume(mesh: trimesh.Trimesh, side: int = 160) -> float:
    """Return the volume of all places that the mesh winds around, overlaps counted once: by one point in each cell."""
    low, high = mesh.bounds
    cells = np.maximum(np.ceil((high - low) / (high - low).max() * side), 8).astype(int)
    places = np.indices(cells).reshape(3, -1).T + np.random.default_rng(3).random((int(cells.prod()), 3))
    inside = winding(mesh, low + places / cells * (high - low)) != 0
    return float(inside.mean() * np.prod(high - low))


@dataclass(frozen=True)
class Topology:
    """How the triangles of a mesh hang together.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Vertices at the same place are one.
    """

    mesh: trimesh.Trimesh

    @cached_property
    def closed(self) -> bool:
        """Whether every edge has two faces, that run along it in opposite directions."""
        return bool(self.mesh.is_watertight and self.mesh.is_winding_consistent)

    @cached_property
    def manifold(self) -> bool:
        """Whether the mesh is closed and the faces around each vertex are one fan."""
        if not self.closed:
            return False
        faces, count = self.mesh.faces, 3 * len(self.mesh.faces)
        corner = np.arange(count).reshape(-1, 3)
        edges = np.concatenate([np.column_stack([corner[:, i], corner[:, (i + 1) % 3]]) for i in range(3)])
        ends = faces.ravel()[edges]
        back = ends[:, 0] > ends[:, 1]
        edges[back], ends[back] = edges[back, ::-1], ends[back, ::-1]
        order = np.lexsort((ends[:, 1], ends[:, 0]))
        one, other = edges[order[::2]], edges[order[1::2]]
        links = np.concatenate([np.column_stack([one[:, i], other[:, i]]) for i in range(2)])
        graph = coo_array((np.ones(len(links), dtype=np.int8), (links[:, 0], links[:, 1])), shape=(count, count))
        return connected_components(graph, directed=False)[0] == len(np.unique(faces))

    @cached_property
    def shells(self) -> int:
        """How many connected surfaces there are; a cavity has one of its own."""
        faces = np.unique(self.mesh.faces, return_inverse=True)[1].reshape(-1, 3)
        ones = np.ones(2 * len(faces), dtype=np.int8)
        graph = coo_array((ones, (faces[:, [0, 1]].ravel(), faces[:, [1, 2]].ravel())), shape=(faces.max() + 1,) * 2)
        return int(connected_components(graph, directed=False)[0])

    @cached_property
    def tunnels(self) -> int:
        """The genus of all shells together."""
        return self.shells - int(self.mesh.euler_number) // 2
