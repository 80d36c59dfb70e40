"""Extract the closed surface of a field in bricks: marching cubes only where the surface runs.

The result is the surface that `infill.isosurfaces.marching` finds on the full field: the same vertices, to
rounding, and the same Euler number. Signs are examined sixteen cells at a time, as bits of one number; only cubes that
the surface crosses are examined individually. A cube whose signs alone decide its triangles takes them from a table
that is derived here; scikit-image handles the rest, so that saddles are decided in a single way (Lewiner 2003).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.contours.zero_contours import CLEARANCE, TIE
from infill.errors import GeometryError
from infill.kernels import sparse_marching as kernels
from infill.kernels.sparse import BRICK, CELLS, SOLID_BRICK
from infill.kernels.threads import in_threads, thread_count
from infill.phasefield.sparse import SparseField
from infill.plain_numbers import plain_argument
from infill.surface import Surface

# Corner i, j, k of a cube has number i + 2 j + 4 k. An edge leads from its lower corner along its axis.
EDGES = [(axis, corner) for axis in range(3) for corner in range(8) if not corner >> axis & 1]
CORNERS = 8
IN_A_ROW = 500  # cubes
LARGE = 2000  # bricks: fewer than this make a surface in a few milliseconds


@dataclass(frozen=True, kw_only=True)
class CubeTable:
    """Triangles of a cube by the number whose bits are its solid corners.

    Parameters
    ----------
    triangles : (256, 5, 3) int8
        The edges that the corners of each triangle lie on, as `EDGES` numbers them.
    counts : (256,) int8
        Number of triangles; `UNDECIDED` where the signs do not determine it.
    crossings : (256, 13) int8
        The edges whose ends have different signs, and last their number.
    edges : (12, 2) int8
        Axis and lower corner of each edge.
    """

    triangles: NDArray[np.int8]
    counts: NDArray[np.int8]
    crossings: NDArray[np.int8]
    edges: NDArray[np.int8]


@dataclass(frozen=True, kw_only=True)
class LevelSigns:
    """The cells above a level, and the bricks where their signs do not determine the surface.

    Parameters
    ----------
    bits : (n, 64) uint16
        The cells of the kept bricks, a number per row.
    doubt : (m, 3) int32
        Bricks with cubes whose triangles depend on values, not on signs alone.
    """

    bits: NDArray[np.uint16]
    doubt: NDArray[np.int32]


@dataclass(frozen=True, kw_only=True)
class ExtractedLevel:
    """A surface and how it responds to its level.

    Parameters
    ----------
    surface : Surface, mm
    rate : (V, 3) float32
        Movement of each vertex when the level rises by one, mm.
    signs : LevelSigns
        Signs of the cells around the surface.
    """

    surface: Surface
    rate: NDArray[np.float32]
    signs: LevelSigns


def extract_bricks(
    field: SparseField,
    *,
    spacing: tuple[float, ...],
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    level: float = 0.0,
    threads: int | None = None,
) -> Surface:
    """Extract the surface of {phi > level}, closed and facing outwards, mm: see `infill.isosurface`.

    Raises
    ------
    GeometryError
        If nothing is above the level.
    """
    return extract_level(field, spacing=spacing, origin=origin, level=level, threads=threads).surface


def extract_level(
    field: SparseField,
    *,
    spacing: tuple[float, ...],
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    level: float = 0.0,
    threads: int | None = None,
) -> ExtractedLevel:
    """Extract the surface as `extract_bricks` does, with the movement of its vertices as the level rises."""
    threads = thread_count(threads)
    bits = rows_above(field, field.values, level, threads=threads)
    bricks = count_bricks(field, bits, crossed_bricks(field, bits, threads), threads=threads)
    if bricks.offsets[-1, 0] == 0:
        raise nothing_left(level)
    raw = write_bricks(field, bricks, level=level, threads=threads)
    vertices, faces, rate = raw.vertices, raw.faces, raw.rate
    if len(raw.corners):
        extra, extra_faces = _triangulate_undecided(raw.corners, raw.edges, raw.lowest, len(vertices))
        vertices, faces = np.concatenate([vertices, extra]), np.concatenate([faces, extra_faces])
        rate = np.concatenate([rate, np.zeros((len(extra), 3), dtype=np.float32)])
    in_threads(kernels.scale_to_mm, vertices, rate, np.array(spacing), np.array(origin), threads=threads)
    signs = LevelSigns(bits=bits, doubt=bricks.places[np.diff(bricks.offsets[:, 2]) > 0])
    return ExtractedLevel(surface=Surface(vertices=vertices, faces=faces), rate=rate, signs=signs)


def nothing_left(level: float) -> GeometryError:
    """Return the error for a level above which there is no solid."""
    return GeometryError(
        f"nothing is left above the level {plain_argument(level)}: no surface; smooth less, or use finer voxels"
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class CountedBricks:
    """Bricks that a surface crosses, and what each of them adds to it.

    Parameters
    ----------
    places : (n, 3) int32
        Their places on the lattice.
    bits, masks, starts
        Tables of `infill.kernels.sparse_marching`.
    offsets : (n + 1, 3) int64
        Vertices, triangles and undecided cubes before each brick, and in all.
    """

    places: NDArray[np.int32]
    bits: NDArray[np.uint16]
    masks: NDArray[np.uint16]
    starts: NDArray[np.int16]
    offsets: NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class RawSurface:
    """The output of bricks, in cells from the centre of the first cell of the grid.

    Parameters
    ----------
    vertices, faces, rate
        As in `ExtractedLevel`.
    corners, edges, lowest
        Undecided cubes: the values at their corners, the vertices on their edges, and their lowest corners.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]
    rate: NDArray[np.float32]
    corners: NDArray[np.float32]
    edges: NDArray[np.int32]
    lowest: NDArray[np.int32]


def count_bricks(
    field: SparseField, bits: NDArray[np.uint16], places: NDArray[np.int32], *, threads: int
) -> CountedBricks:
    """Count the output of the bricks at `places`, in that order, where the cells in `bits` are solid."""
    masks = np.empty((len(places), kernels.ROWS, 3), dtype=np.uint16)
    starts = np.empty(masks.shape, dtype=np.int16)
    counts = np.zeros((len(places) + 1, 3), dtype=np.int64)  # vertices, triangles, undecided cubes
    arguments = (field.slots, places, bits, field.shape, cube_table().counts, masks, starts, counts[1:])
    in_threads(kernels.count_output, *arguments, threads=threads)
    return CountedBricks(places=places, bits=bits, masks=masks, starts=starts, offsets=np.cumsum(counts, axis=0))


def write_bricks(
    field: SparseField,
    bricks: CountedBricks,
    *,
    level: float,
    first: tuple[int, ...] = (0, 0, 0),
    threads: int,
) -> RawSurface:
    """Write the vertices and triangles of bricks; the first cell of the field is the cell `first` of the grid."""
    cubes, offsets = cube_table(), bricks.offsets
    index = np.full(field.slots.shape, -1, dtype=np.int32)
    index[tuple(bricks.places.T)] = np.arange(len(bricks.places))
    raw = RawSurface(
        vertices=np.empty((offsets[-1, 0], 3)),
        rate=np.zeros((offsets[-1, 0], 3), dtype=np.float32),
        faces=np.empty((offsets[-1, 1], 3), dtype=np.int32),
        corners=np.empty((offsets[-1, 2], CORNERS), dtype=np.float32),
        edges=np.empty((offsets[-1, 2], len(EDGES)), dtype=np.int32),
        lowest=np.empty((offsets[-1, 2], 3), dtype=np.int32),
    )
    in_threads(
        kernels.write_surface,
        field.slots,
        bricks.places,
        index,
        field.values.reshape(-1, CELLS),
        bricks.bits,
        field.shape,
        _level_and_tolerances(level),
        cubes.counts,
        cubes.triangles,
        cubes.crossings,
        bricks.masks,
        bricks.starts,
        offsets,
        cubes.edges,
        raw.vertices,
        raw.rate,
        raw.faces,
        raw.corners,
        raw.edges,
        raw.lowest,
        np.array(first, dtype=np.int64),
        threads=threads,
    )
    return raw


def measure_level(
    field: SparseField, *, spacing: tuple[float, ...], level: float, threads: int | None = None
) -> tuple[float, float] | None:
    """Measure volume inside a level, mm³, and its slope, without a surface; None if undecided or for few bricks.

    Return None if signs do not decide a cube: then the surface itself is needed. Also return None for a small surface,
    which takes no time to make.
    """
    if len(field.where) < LARGE:
        return None
    count = thread_count(threads)
    values, limits, cubes = field.values.reshape(-1, CELLS), _level_and_tolerances(level), cube_table()
    bits = rows_above(field, field.values, level, threads=count)
    parts = in_threads(
        kernels.measure,
        field.slots,
        crossed_bricks(field, bits, count),
        bits,
        values,
        field.shape,
        limits,
        cubes.counts,
        cubes.triangles,
        cubes.crossings,
        cubes.edges,
        np.array(field.shape) / 2,
        threads=count,
    )
    volume, slope, undecided = (sum(part[n] for part in parts) for n in range(3))
    sixth = math.prod(spacing) / 6
    return None if undecided else (volume * sixth, slope * sixth)


def _level_and_tolerances(level: float) -> tuple[np.float32, np.float32, np.float32]:
    """Return the level, the least distance of values from it, and the factor that breaks ties, in single precision."""
    return np.float32(level), np.float32(CLEARANCE), np.float32(TIE)


def rows_above(
    field: SparseField, values: NDArray[Any], level: float, *, threads: int | None = None
) -> NDArray[np.uint16]:
    """Mark the cells of the kept bricks with `values` (n, 8, 8, 16) above the level, as bits of one number per row."""
    bits = np.empty((len(field.where), kernels.ROWS), dtype=np.uint16)
    flat, limit = values.reshape(-1, CELLS), values.dtype.type(level)
    in_threads(kernels.bits_above, flat, field.where, limit, field.shape, bits, threads=thread_count(threads))
    return bits


def crossed_bricks(field: SparseField, bits: NDArray[np.uint16], threads: int | None) -> NDArray[np.int32]:
    """Return the bricks in which, or on whose upper sides, the surface around the cells in `bits` runs."""
    places = _near_surface(field.slots, field.shape)
    differs = np.empty(len(places), dtype=bool)
    in_threads(kernels.mark_differing, field.slots, places, bits, field.shape, differs, threads=thread_count(threads))
    return places[differs]


def _near_surface(slots: NDArray[np.int32], shape: tuple[int, int, int]) -> NDArray[np.int32]:
    """Return the bricks in which, or on whose upper sides, the surface may run: (n, 3)."""
    kind = (slots == SOLID_BRICK).astype(np.int8)
    kind[slots >= 0] = 2
    for axis, (count, size) in enumerate(zip(shape, BRICK, strict=True)):
        # Solid bricks that reach beyond the grid contain void.
        ends = [0] if (count + 1) % size == 0 else [0, (count + 1) // size]
        edge = tuple(ends if a == axis else slice(None) for a in range(3))
        kind[edge] = np.where(kind[edge] == 1, 2, kind[edge])
    low, high = kind, kind
    for axis in range(3):
        after = np.zeros([1 if a == axis else m for a, m in enumerate(kind.shape)], dtype=np.int8)
        inner = tuple(slice(1, None) if a == axis else slice(None) for a in range(3))
        low = np.minimum(low, np.concatenate([low[inner], after], axis=axis))
        high = np.maximum(high, np.concatenate([high[inner], after], axis=axis))
    return np.argwhere((low != high) | (high == 2)).astype(np.int32)


@cache
def cube_table() -> CubeTable:
    """Build the triangles of every cube whose signs decide them, by tracing around its faces."""
    triangles, counts = np.zeros((256, 5, 3), dtype=np.int8), np.zeros(256, dtype=np.int8)
    crossings = np.zeros((256, len(EDGES) + 1), dtype=np.int8)
    number = {edge: n for n, edge in enumerate(EDGES)}
    for signs in range(256):
        crossed_edges = [
            n
            for n, (axis, start_corner) in enumerate(EDGES)
            if (signs >> start_corner ^ signs >> (start_corner | 1 << axis)) & 1
        ]
        crossings[signs, : len(crossed_edges)], crossings[signs, -1] = crossed_edges, len(crossed_edges)
        next_edge: dict[int, int] = {}
        decided = signs not in _OPPOSITE
        for axis in range(3):
            for up in range(2):
                a, b = (axis + 1) % 3, (axis + 2) % 3
                ring = [up << axis, up << axis | 1 << a, up << axis | 1 << a | 1 << b, up << axis | 1 << b]
                if up:  # always in the same rotational sense, seen from outside
                    ring.reverse()
                leaving, entering = [], []
                for start, end in zip(ring, ring[1:] + ring[:1], strict=True):
                    direction = (start ^ end).bit_length() - 1
                    if signs >> start & 1 and not signs >> end & 1:
                        leaving.append(number[direction, min(start, end)])
                    elif signs >> end & 1 and not signs >> start & 1:
                        entering.append(number[direction, min(start, end)])
                if len(leaving) > 1:
                    decided = False
                elif leaving:
                    next_edge[leaving[0]] = entering[0]
        if not decided:
            counts[signs] = kernels.UNDECIDED
            continue
        traced: list[tuple[int, int, int]] = []
        while next_edge:
            first_edge = next(iter(next_edge))
            loop = [first_edge]
            while (following := next_edge.pop(loop[-1])) != first_edge:
                loop.append(following)
            traced += [(loop[0], loop[n], loop[n + 1]) for n in range(1, len(loop) - 1)]
        counts[signs] = len(traced)
        triangles[signs, : len(traced)] = traced or 0
    edges = np.array(EDGES, dtype=np.int8)
    return CubeTable(triangles=triangles, counts=counts, crossings=crossings, edges=edges)


@cache
def raw_cube_counts() -> NDArray[np.int8]:
    """Return for each of 256 sign patterns the triangles of a +-1 cube, minus two for each vertex inside it."""
    counts = cube_table().counts.copy()
    unsure = np.flatnonzero(counts == kernels.UNDECIDED)
    corners = np.where(unsure[:, None] >> np.arange(CORNERS) & 1, np.float32(TIE), np.float32(-1)).astype(np.float32)
    edges = np.tile(np.arange(len(EDGES), dtype=np.int32), (len(unsure), 1))
    for n in range(len(unsure)):
        inner, faces = _triangulate_undecided(corners[n : n + 1], edges[n : n + 1], np.zeros((1, 3), dtype=np.int32), 0)
        counts[unsure[n]] = len(faces) - 2 * len(inner)
    return counts


def euler_number_of_bits(field: SparseField, bits: NDArray[np.uint16], *, threads: int | None = None) -> int:
    """Return the Euler number of the surface of the bricks if the cells in `bits` were +1 and all others -1."""
    return _euler_number(
        _count_per_brick(field, bits, crossed_bricks(field, bits, threads), raw_cube_counts(), threads)
    )


def doubt_and_euler_number(
    field: SparseField, bits: NDArray[np.uint16], *, threads: int | None = None
) -> tuple[NDArray[np.int32], int | None]:
    """Return the bricks (n, 3) with cubes that the signs in `bits` do not decide, and the Euler number.

    The Euler number is None if there is such a brick.
    """
    places = crossed_bricks(field, bits, threads)
    counts = _count_per_brick(field, bits, places, cube_table().counts, threads)
    doubt = places[counts[:, 2] > 0]
    return doubt, None if len(doubt) else _euler_number(counts)


def _count_per_brick(
    field: SparseField,
    bits: NDArray[np.uint16],
    places: NDArray[np.int32],
    table: NDArray[np.int8],
    threads: int | None,
) -> NDArray[np.int64]:
    """Count the vertices, triangles and undecided cubes of each brick, (n, 3)."""
    masks = np.empty((len(places), kernels.ROWS, 3), dtype=np.uint16)
    starts = np.empty(masks.shape, dtype=np.int16)
    counts = np.zeros((len(places), 3), dtype=np.int64)
    arguments = (field.slots, places, bits, field.shape, table, masks, starts, counts)
    in_threads(kernels.count_output, *arguments, threads=thread_count(threads))
    return counts


def _euler_number(counts: NDArray[np.int64]) -> int:
    """Return the Euler number from the counts of all bricks."""
    vertices, faces, _ = counts.sum(axis=0)
    return int(vertices - faces // 2)


# Two opposite corners of a cube, solid in void or void in solid: either joined by a tube or not.
_OPPOSITE = {1 << c | 1 << 7 - c for c in range(4)} | {255 ^ (1 << c | 1 << 7 - c) for c in range(4)}


def triangulate_at(
    raw: RawSurface, chosen: NDArray[np.bool_], numbers: NDArray[np.int64], count: int
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Triangulate some undecided cubes as `extract_level` does those of the whole surface, to the last bit.

    Parameters
    ----------
    raw : RawSurface
    chosen : (u,) bool
        The cubes to triangulate.
    numbers : (u,) int64
        The number of each cube in the whole surface, which decides its place in a row of scikit-image.
    count : int
        The number of the first new vertex.

    Returns
    -------
    points : (v, 3) float64
        Vertices inside cubes, in cells from the centre of the first cell.
    faces : (f, 3) int32
    """
    points, faces = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int32)]
    rows = numbers // IN_A_ROW
    for row in np.unique(rows[chosen]).tolist():
        cubes = np.flatnonzero(chosen & (rows == row))
        places = numbers[cubes] % IN_A_ROW
        length = int(places.max()) + 1
        corners = np.full((length, CORNERS), np.float32(-1))  # void beside the cubes
        edges, lowest = np.full((length, len(EDGES)), -1, dtype=np.int32), np.zeros((length, 3), dtype=np.int32)
        corners[places], edges[places], lowest[places] = raw.corners[cubes], raw.edges[cubes], raw.lowest[cubes]
        inner, row_faces = _triangulate_row(corners, edges, lowest, count)
        points.append(inner)
        faces.append(row_faces)
        count += len(inner)
    return np.concatenate(points), np.concatenate(faces)


def _triangulate_undecided(
    corners: NDArray[np.float32], edges: NDArray[np.int32], lowest: NDArray[np.int32], count: int
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Triangulate the cubes that signs do not decide, by scikit-image; return vertices inside cubes, and triangles.

    This is done in batches: scikit-image uses single precision, in which a vertex far along a row leaves its edge.
    """
    points, faces = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int32)]
    for low in range(0, len(corners), IN_A_ROW):
        batch = slice(low, low + IN_A_ROW)
        inner, batch_faces = _triangulate_row(corners[batch], edges[batch], lowest[batch], count)
        points.append(inner)
        faces.append(batch_faces)
        count += len(inner)
    return np.concatenate(points), np.concatenate(faces)


def _triangulate_row(
    corners: NDArray[np.float32], edges: NDArray[np.int32], lowest: NDArray[np.int32], count: int
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Triangulate a few undecided cubes.

    They are lined up in a row, apart from each other, their axes permuted as in `extract_dense`.
    """
    from skimage.measure import marching_cubes

    cube_count = len(corners)
    row = corners.reshape(cube_count, 2, 2, 2)  # cube, k, j, i
    field = np.ascontiguousarray(row.transpose(1, 3, 0, 2).reshape(2, 2, 2 * cube_count))  # k, i, cube and j
    mask = np.zeros(field.shape, dtype=bool)
    mask[:, :, 1::2] = True
    points, faces, _, _ = marching_cubes(field, 0.0, gradient_direction="ascent", mask=mask)  # type: ignore[no-untyped-call]
    points = points[:, [1, 2, 0]].astype(np.float64)  # i, cube and j, k
    cube = (points[:, 1] // 2).astype(np.int64)
    points[:, 1] -= 2 * cube
    between = (points > 0) & (points < 1)
    inside = between.sum(axis=1) > 1
    axis = between.argmax(axis=1)
    lower = (np.where(between, 0, points).round().astype(np.int64) << np.arange(3)).sum(axis=1)
    lookup = np.full((3, CORNERS), -1)
    for n, (along, corner) in enumerate(EDGES):
        lookup[along, corner] = n
    number = np.where(inside, 0, edges[cube, lookup[axis, np.where(inside, 0, lower)]])
    number[inside] = count + np.arange(inside.sum())
    return (points + lowest[cube])[inside], number[faces].astype(np.int32)
