"""Measure the exact surface and volume of a mesh inside cells, whatever the cells are."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.kernels.threads import in_threads, thread_count
from infill.meshes.winding import winding_numbers
from infill.phasefield.refining import cut_off_distance, phase_from_distance
from infill.ragged import expand_rows
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.scanlines import intersect_rows

FEWEST_ROWS, MOST_ROWS = 3, 16  # rows of a cell along x, and along y, on which overlaps are measured
MOST_CROSSINGS = 5_000_000  # crossings of these rows, roughly; more rows than that are too many
MOST_TRIANGLE_TESTS = 2_000_000_000  # most triangles examined to tell which points are hidden
TEST_OFFSET = 0.5  # cells from a face to the point that tells which solid the face bounds


@dataclass(frozen=True, kw_only=True, eq=False)
class EnclosedVolumes:
    """The volume inside a closed mesh, place by place, so that it can be summed for each component of the cells.

    Parameters
    ----------
    beside : (F, 3) float64, mm
        A point just inside each face.
    area : (F,) float64, mm²
    sign : (F,) int64
        -1 for a face that had to be turned.
    component : (F,) int
        Component of the mesh that each face belongs to.
    volumes : (B,) float64, mm³
        Volume of each component; negative for a cavity.
    over : (N, 3) float64, mm
        Places that components enclose more than once.
    excess : (N,) float64, mm³
        Volume that the sum counts too often there.
    """

    beside: Floats
    area: Floats
    sign: NDArray[np.int64]
    component: NDArray[np.integer]
    volumes: Floats
    over: Floats
    excess: Floats

    def solid_beside(
        self, mesh: Surface, points: Floats, faces: NDArray[np.integer], cells: float, *, threads: int | None = None
    ) -> NDArray[np.bool_]:
        """Tell whether the mesh is solid a number of cells outwards from points (N, 3) on its faces (N,).

        Below 0 is inwards. If there are very many points, only every n-th is examined; the next ones get its result.
        """
        if len(points) == 0:
            return np.zeros(0, dtype=bool)
        middle = np.asarray(mesh.vertices, dtype=np.float64)[mesh.faces[faces]].mean(axis=1)
        beside = points + cells / TEST_OFFSET * (middle - self.beside[faces])
        stride = -(-len(points) * len(mesh.faces) // MOST_TRIANGLE_TESTS)
        windings = winding_numbers(beside[::stride], mesh, sign=self.sign, threads=threads)
        return np.repeat(windings != 0, stride)[: len(points)]

    @property
    def total(self) -> float:
        """Volume of the union of all components, mm³."""
        return float(self.volumes.sum() - self.excess.sum())


def phase_field_of_mesh(
    mesh: Surface, inside: Volume, interface: float, *, several: bool, threads: int | None = None
) -> Volume:
    """Return the phase field whose surface is a mesh, from the distance of the cells from it.

    Parameters
    ----------
    mesh, inside, several, threads
        See `distances_in_cells`.
    interface : float
        Width of the interface, cells: see `infill.Smoothing`.
    """
    distance = distances_in_cells(mesh, inside, cut_off_distance(interface), several=several, threads=threads)
    return replace(inside, values=phase_from_distance(distance, interface, threads=threads))


def distances_in_cells(
    mesh: Surface, inside: Volume, reach: float, *, several: bool, threads: int | None = None
) -> NDArray[np.float32]:
    """Measure the distance of each cell centre from a mesh, (nx, ny, nz) in cells: positive inside, at most `reach`.

    Parameters
    ----------
    mesh : Surface, mm
        Closed.
    inside : Volume
        Which cells are inside, all sides of a cell equal.
    reach : float
        Cells.
    several : bool
        Whether components may overlap or touch: faces inside the solid are then passed over, as are gaps between
        components that no centre of a cell lies in.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    A cell whose neighbours are inside up to k cells away is at least k cells from the surface.
    """
    from infill.kernels.distances import lower_to_triangles

    solid: NDArray[np.bool_] = np.asarray(inside.values)
    size = float(inside.cell_size[0])
    corners = np.ascontiguousarray(((mesh.vertices - np.array(inside.origin)) / size - 0.5)[mesh.faces])
    distance_field = np.full(solid.shape, np.float32(reach * reach))
    in_threads(lower_to_triangles, corners, reach, distance_field, threads=thread_count(threads))
    np.sqrt(distance_field, out=distance_field)
    if several:
        core = solid
        for depth in range(1, int(np.ceil(reach)) + 1):
            core = _erode(core)
            np.maximum(distance_field, np.float32(min(depth, reach)), out=distance_field, where=core)
    np.negative(distance_field, out=distance_field, where=~solid)
    return distance_field


def _erode(solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Erode: keep the cells whose 26 neighbours are solid too; void is all around."""
    for axis in range(3):
        along = np.moveaxis(solid, axis, 0)
        out = np.zeros_like(solid)
        np.moveaxis(out, axis, 0)[1:-1] = along[1:-1] & along[:-2] & along[2:]
        solid = out
    return solid


def measure_enclosed(
    mesh: Surface,
    component: NDArray[np.integer],
    turned: NDArray[np.bool_],
    volumes: Floats,
    inside: Volume,
    *,
    overlap: bool,
) -> EnclosedVolumes:
    """Measure the volume inside a closed mesh.

    Parameters
    ----------
    mesh : Surface, mm
    component : (F,) int
    turned : (B,) bool
        Components that must be turned inside out.
    volumes : (B,) float64, mm³
        Signed volumes before that.
    inside : Volume
        The cells inside.
    overlap : bool
        Whether any cell is enclosed more than once.
    """
    signed = np.where(turned, -volumes, volumes)
    inverted = signed.sum() < 0
    flip = turned != inverted
    a, b, c = (np.asarray(mesh.vertices, dtype=np.float64)[mesh.faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    outwards = np.divide(normal, length[:, None], out=np.zeros_like(normal), where=length[:, None] > 0)
    outwards[flip[component]] *= -1
    size = float(inside.cell_size[0])
    sign = np.where(flip, -1, 1)[component]
    over, excess = _excess(mesh, sign, inside) if overlap else (np.empty((0, 3)), np.empty(0))
    return EnclosedVolumes(
        beside=(a + b + c) / 3 - TEST_OFFSET * size * outwards,
        area=length / 2,
        sign=sign,
        component=component,
        volumes=-signed if inverted else signed,
        over=over,
        excess=excess,
    )


def _excess(mesh: Surface, sign: NDArray[np.integer], inside: Volume) -> tuple[Floats, Floats]:
    """Find places (N, 3) that are enclosed more than once, mm; return them, and their volumes, mm³."""
    size, (nx, ny, nz) = float(inside.cell_size[0]), inside.values.shape
    points = (np.asarray(mesh.vertices, dtype=np.float64) - np.array(inside.origin)) / size
    (ax, ay), (bx, by), (cx, cy) = (points[mesh.faces[:, i], :2].T for i in range(3))
    flat = float(np.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).sum()) / 2  # as seen along the rows, cells²
    rows = int(np.clip((MOST_CROSSINGS / max(flat, 1)) ** 0.5, FEWEST_ROWS, MOST_ROWS))
    crossed = intersect_rows(points * (rows, rows, 1) - 0.5, mesh.faces, (nx * rows, ny * rows, nz))
    order = np.lexsort((crossed.depth, crossed.row))
    row, depth = crossed.row[order].astype(np.int64), crossed.depth[order].astype(np.float64)
    wound = np.cumsum(crossed.sign[order] * sign[crossed.face[order]])  # 0 again at the end of every row
    repeated = np.flatnonzero((row[:-1] == row[1:]) & (wound[:-1] != 0) & (wound[:-1] != 1))
    span = depth[repeated + 1] - depth[repeated]
    amount = span * (wound[repeated] - 1) * size**3 / rows**2
    # In pieces of a cell, so that each is counted in the right place.
    pieces = np.maximum(1, np.ceil(span)).astype(np.int64)
    places, shares = [], []
    for stretch, step in expand_rows(pieces):
        i, j = np.divmod(row[repeated[stretch]], ny * rows)
        z = depth[repeated[stretch]] + (step + 0.5) * (span[stretch] / pieces[stretch]) + 0.5
        places.append(np.stack([(i + 0.5) / rows, (j + 0.5) / rows, z], axis=1) * size + np.array(inside.origin))
        shares.append(amount[stretch] / pieces[stretch])
    if not places:
        return np.empty((0, 3)), np.empty(0)
    return np.concatenate(places), np.concatenate(shares)
