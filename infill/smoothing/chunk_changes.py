"""The changes by smoothing in one chunk, in parts that add up to those of the whole volume.

compare_chunk     do the cells that changed sign keep all connections? How far apart are the surfaces?
match_chunk       components of walls, of the result and of lost walls, and the cells that they share

A chunk looks at its own cells and cubes; the brick around it shows the cells beside them. Distances are exact up to
`SEARCH` cells, and no less than that beyond.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from infill.arrays import Floats
from infill.chunks.fields import ChunkField
from infill.chunks.joining import ChunkComponents, look_up, survey_components
from infill.chunks.layout import Chunk
from infill.chunks.level_parts import LevelParts, LevelTask, lower_field, measure_piece
from infill.chunks.pieces import count_piece, make_piece, measure_parts
from infill.chunks.work import Work, open_field, unsmoothed_field
from infill.errors import GeometryError
from infill.inspection.component_matching import sum_overlaps
from infill.inspection.deviation import COUNTS, KEPT, LOST, PITCH, sample_surface
from infill.inspection.sign_changes import (
    CUBES_AROUND,
    MANY_CHANGES,
    SignChanges,
    cells_of_bits,
    mark_unchanged,
    part_in_cubes,
)
from infill.isosurfaces.components import (
    Components,
    add_thickness,
    data_bits,
    dilate,
    dilate_cores,
    erode_to_cores,
    find_components,
    shared_cells,
    solid_bits,
)
from infill.isosurfaces.sparse_marching import extract_level
from infill.kernels.flips import count_lonely, flip_simple
from infill.kernels.sparse import BRICK
from infill.kernels.sparse_marching import FULL, ROWS
from infill.meshes.distance import TriangleTree, morton_order
from infill.meshes.measuring import face_areas
from infill.meshes.shells import vertex_components
from infill.phasefield.sparse import SparseField
from infill.smoothing.comparing import classify_by_thickness
from infill.surface import Surface

Bits = NDArray[np.uint16]
Numbers = NDArray[np.int64]

SEARCH = 6  # cells: the brick around a chunk shows all that is this near, and twice `LOST` where cells are not cubes
SAME = 1e-3  # cells: two of a chunk's ways to compute a vertex differ by less
AROUND = np.array(list(product((-1, 0, 1), repeat=3)))
ROW_PLACES = np.stack(np.divmod(np.arange(ROWS), BRICK[1]), axis=1)  # of the rows of a brick


@dataclass(frozen=True, kw_only=True, eq=False)
class FarPoints:
    """Points of one surface that lie far from the other.

    Parameters
    ----------
    points : (n, 3) float64, mm along the axes of the grid
    distance : (n,) float64, mm
    area : (n,) float64, mm²
        That each stands for.
    """

    points: Floats
    distance: Floats
    area: Floats

    @classmethod
    def join(cls, parts: Sequence[FarPoints]) -> FarPoints:
        """Join the points of several chunks."""
        return cls(
            points=np.concatenate([np.empty((0, 3)), *(part.points for part in parts)]),
            distance=np.concatenate([np.empty(0), *(part.distance for part in parts)]),
            area=np.concatenate([np.empty(0), *(part.area for part in parts)]),
        )

    def take(self, chosen: NDArray[np.bool_] | NDArray[np.integer]) -> FarPoints:
        """Return some of them."""
        return FarPoints(points=self.points[chosen], distance=self.distance[chosen], area=self.area[chosen])

    def shift(self, by: Floats) -> FarPoints:
        """Return them moved by a vector, mm."""
        return replace(self, points=self.points + by)


@dataclass(frozen=True, kw_only=True, eq=False)
class ComparedChunk:
    """A chunk before and after smoothing.

    Parameters
    ----------
    same : bool
        Whether the cells of the chunk keep all connections while they change: see
        `infill.inspection.sign_changes.has_same_connections`.
    unchanged : (c,) bool
        Components of the data that hold a cell which did not change.
    data_area, result_area : float, mm²
        Of both surfaces in the chunk.
    added, lost, thin : FarPoints
        Points of the result, points of the data that count, and points of the data that are too thin to count, all
        more than `infill.inspection.deviation.LOST` cells from the other surface; besides, the furthest one of each.
    """

    same: bool
    unchanged: NDArray[np.bool_]
    data_area: float
    result_area: float
    added: FarPoints
    lost: FarPoints
    thin: FarPoints


def compare_chunk(
    work: Work, chunk: Chunk, task: LevelTask, removed: NDArray[np.bool_], thickness: int
) -> ComparedChunk:
    """Compare a chunk before and after smoothing.

    Parameters
    ----------
    work : Work
    chunk : Chunk
    task : LevelTask
        Of the final surface.
    removed : (s,) bool
        Parts of the chunk that were taken out as crumbs.
    thickness : int
        Cells: places where solid or void is thinner do not count.
    """
    chunk_field = open_field(work, chunk)
    labelled = chunk_field.components()
    field = lower_field(chunk_field, labelled, task).field
    flips = SignChanges.of(field, data_bits(field, threads=1), task.level, threads=1)
    result, crumbs = _extract(field, work.spacing, task.level), np.empty((0, 3), dtype=np.int64)
    if result is not None and removed.any():
        result, crumbs = _without_crumbs(result, chunk_field, chunk, work, task, removed)
    data = _extract(unsmoothed_field(work, chunk, chunk_field).field, work.spacing, 0.0)
    chunk_bits = np.where(chunk_field.own[:, None], FULL, 0).astype(np.uint16) * np.ones(ROWS, dtype=np.uint16)
    data_area, result_area = (_area_in_cubes(part, field, chunk_bits, work.spacing) for part in (data, result))
    cubes = _uncertain_cubes(field, flips, crumbs) & chunk_bits
    added, lost, thin = _far_places(data, result, field, cubes, work.spacing, thickness)
    corner = np.array(chunk.kept_low) * BRICK * np.array(work.spacing)
    return ComparedChunk(
        same=_keeps_connections(flips, chunk, work),
        unchanged=mark_unchanged(labelled, ~(flips.data ^ flips.result)),
        data_area=data_area,
        result_area=result_area,
        added=added.shift(corner),
        lost=lost.shift(corner),
        thin=thin.shift(corner),
    )


def _far_places(
    data: Surface | None,
    result: Surface | None,
    field: SparseField,
    cubes: Bits,
    spacing: tuple[float, ...],
    thickness: int,
) -> tuple[FarPoints, FarPoints, FarPoints]:
    """Return `added`, `lost` and `thin` of `ComparedChunk`, mm from the first kept brick, in some cubes."""
    if not cubes.any():
        return FarPoints.join([]), FarPoints.join([]), FarPoints.join([])
    around, cell = dilate(field, cubes, SEARCH, threads=1), max(spacing)
    added = _far_points(result, data, field, cubes, around, spacing)
    back = _far_points(data, result, field, cubes, around, spacing)
    changed = np.flatnonzero(back.distance > KEPT * cell)
    counts = np.ones(len(back.distance), dtype=bool)
    places = back.points[changed] / np.array(spacing)
    counts[changed] = classify_by_thickness(field, places, thickness, threads=1) == COUNTS
    return _furthest(added, cell), _furthest(back.take(counts), cell), _furthest(back.take(~counts), cell)


def _extract(field: SparseField, spacing: tuple[float, ...], level: float) -> Surface | None:
    """Return the surface of a chunk and the brick around it, mm from the first kept brick; None without one."""
    try:
        return extract_level(field, spacing=spacing, level=level, threads=1).surface
    except GeometryError:
        return None


def _area_in_cubes(surface: Surface | None, field: SparseField, bits: Bits, spacing: tuple[float, ...]) -> float:
    """Return the area of the triangles in cubes, mm²."""
    return 0.0 if surface is None else float(face_areas(part_in_cubes(surface, field, bits, spacing, 1)).sum())


def _without_crumbs(
    surface: Surface,
    chunk_field: ChunkField,
    chunk: Chunk,
    work: Work,
    task: LevelTask,
    removed: NDArray[np.bool_],
) -> tuple[Surface, Numbers]:
    """Take crumbs out of the surface of a chunk; return it, and the cubes in which they were."""
    lowered = lower_field(chunk_field, chunk_field.components() if task.lowering else None, task)
    counted = count_piece(lowered, chunk, task.level)
    first_cubes = np.zeros(len(counted[2].bricks), dtype=np.int64) if task.first_cubes is None else task.first_cubes
    piece = make_piece(lowered, chunk, counted, level=task.level, spacing=work.spacing, first_cubes=first_cubes)
    names = measure_parts(piece, chunk, work.spacing).names
    corner = np.array(chunk.kept_low) * BRICK
    gone = piece.vertices[(names >= 0) & removed[names]] - corner * np.array(work.spacing)
    if not len(gone):
        return surface, np.empty((0, 3), dtype=np.int64)
    shells, count = vertex_components(surface.faces, len(surface.vertices))
    distance, _ = KDTree(gone).query(surface.vertices, distance_upper_bound=SAME * min(work.spacing))
    is_crumb = np.zeros(count, dtype=bool)
    is_crumb[shells[np.isfinite(distance) & (shells >= 0)]] = True
    left = ~is_crumb[shells[surface.faces[:, 0]]]
    cubes: Numbers = np.unique(np.floor(gone / np.array(work.spacing) + 0.5).astype(np.int64), axis=0)
    return replace(surface, faces=surface.faces[left]), (cubes[:, None] + AROUND).reshape(-1, 3)


def _uncertain_cubes(field: SparseField, flips: SignChanges, crumbs: Numbers) -> Bits:
    """Mark the cubes in which the surfaces may be more than the side of a cube apart, by their lowest corners.

    See `infill.inspection.uncertain_places.UncertainPlaces`; here, besides, the cubes that crumbs were in.
    """
    bits = np.zeros((len(field.where), ROWS), dtype=np.uint16)
    cubes = np.concatenate([crumbs, *(flips.places + step for step in CUBES_AROUND)])
    place, cell = np.divmod(cubes, BRICK)
    inside = ((place >= 0) & (place < field.slots.shape)).all(axis=1)
    place, cell = place[inside], cell[inside]
    slot = field.slots[tuple(place.T)]
    is_stored = slot >= 0
    bit = np.uint16(1) << cell[is_stored, 2].astype(np.uint16)
    np.bitwise_or.at(bits, (slot[is_stored], cell[is_stored, 0] * BRICK[1] + cell[is_stored, 1]), bit)
    doubtful = field.slots[tuple(flips.doubt.T)]
    bits[doubtful[doubtful >= 0]] = FULL
    return bits


def _far_points(
    surface: Surface | None,
    target: Surface | None,
    field: SparseField,
    cubes: Bits,
    around: Bits,
    spacing: tuple[float, ...],
) -> FarPoints:
    """Measure a surface at points in some cubes, up to `SEARCH` cells from a target, by its part `around` them."""
    if surface is None:
        return FarPoints.join([])
    part = part_in_cubes(surface, field, cubes, spacing, 1)
    if not len(part.faces):
        return FarPoints.join([])
    points, _, area = sample_surface(part, PITCH * max(spacing))
    limit = SEARCH * min(spacing)
    distance = np.full(len(points), limit)
    target_part = None if target is None else part_in_cubes(target, field, around, spacing, 1)
    if target_part is not None and len(target_part.faces):
        order = morton_order(points)
        nearest, _ = TriangleTree.of(target_part).nearest(points[order], enough=KEPT * max(spacing), threads=1)
        distance[order] = np.minimum(nearest, limit)
    return FarPoints(points=points, distance=distance, area=area)


def _furthest(distant: FarPoints, cell: float) -> FarPoints:
    """Return the points that are further than `LOST`, and the furthest one, even if it is near."""
    if not len(distant.distance):
        return distant
    chosen = distant.distance > LOST * cell
    chosen[distant.distance.argmax()] = True
    return distant.take(chosen)


def _keeps_connections(flips: SignChanges, chunk: Chunk, work: Work) -> bool:
    """Tell whether the cells of a chunk keep all connections as they change, after those of the chunks before it."""
    field, result = flips.field, flips.result
    if count_lonely(field.slots, result, flips.places[chunk.owns(flips.places // BRICK)]):
        return False
    size, counts = np.array(work.layout.size), work.layout.counts
    along_x, along_y, along_z = ((field.where + np.array(chunk.kept_low)) // size).T.astype(np.int64)
    is_done = (along_x * counts[1] + along_y) * counts[2] + along_z < chunk.number
    thick = dilate_cores(field, erode_to_cores(field, flips.data, threads=1), threads=1)
    for start in (flips.data, thick) if (thick != flips.data).any() else (thick,):
        places = cells_of_bits(field, start ^ result)
        places = places[chunk.owns(places // BRICK)]
        state = np.where(is_done[:, None], result, start)
        if len(places) > MANY_CHANGES or flip_simple(field.slots, state, places):
            return False
    return True


@dataclass(frozen=True, kw_only=True, eq=False)
class MatchedChunk:
    """The components of a chunk before and after smoothing, and the cells that they share.

    Parameters
    ----------
    thick : (c,) bool
        Components of the data that are more than one cell thick.
    after, walls, gone : ChunkComponents
        Of the result; of the cores of the data; and of solid more than one cell thick without any solid near it.
    of_solid, of_walls : (n, 3) int64
        Component before (of the data, of the cores), component after, and cells that they share.
    middle : (g, 3) int64
        Sum of the cells of each component that is gone, along the axes of the grid.
    sturdy : LevelParts
        Of the surface of all solid more than one cell thick.
    """

    thick: NDArray[np.bool_]
    after: ChunkComponents
    walls: ChunkComponents
    gone: ChunkComponents
    of_solid: Numbers
    of_walls: Numbers
    middle: Numbers
    sturdy: LevelParts


def match_chunk(work: Work, chunk: Chunk, task: LevelTask, reach: int) -> MatchedChunk:
    """Match the components of a chunk before and after smoothing; `reach` is how far edges may recede, cells."""
    chunk_field = open_field(work, chunk)
    labelled = chunk_field.components()
    field = lower_field(chunk_field, labelled, task).field
    before, result = data_bits(field, threads=1), solid_bits(field, level=task.level, threads=1)
    core = erode_to_cores(field, before, threads=1)
    thick = dilate_cores(field, core, threads=1)
    seen = _seen_cells(field, chunk)
    gone = find_components(field, thick & ~dilate(field, result, reach, threads=1) & seen, whole=False)
    after, walls = (find_components(field, bits & seen) for bits in (result, core))
    mask = np.where(chunk_field.own[:, None], FULL, 0).astype(np.uint16)
    inside = [_part_inside(part, mask, chunk) for part in (labelled, after, walls)]
    sturdy = np.zeros((len(field.where), ROWS, BRICK[2]), dtype=np.float32)
    sturdy[:] = np.where(thick[..., None] >> np.arange(BRICK[2], dtype=np.uint16) & 1, 1, -1)
    solid = replace(chunk_field, field=replace(field, values=sturdy.reshape(-1, *BRICK)))
    return MatchedChunk(
        thick=add_thickness(field, labelled).thick,
        after=survey_components(chunk_field, chunk, after),
        walls=survey_components(chunk_field, chunk, walls),
        gone=survey_components(chunk_field, chunk, gone),
        of_solid=_share_cells(inside[0], inside[1]),
        of_walls=_share_cells(inside[2], inside[1]),
        middle=_sum_cells(chunk_field, chunk, gone),
        sturdy=measure_piece(work, chunk, solid, 0.0, any_numbers=True),
    )


def _share_cells(before: Components, after: Components) -> Numbers:
    """Count the cells that components share, a row (n, 3) for each pair: results of tasks should be small."""
    shared = sum_overlaps(shared_cells(before, after), before=before.count, after=after.count)
    return np.stack([shared.one, shared.other, shared.cells], axis=1)


def _seen_cells(field: SparseField, chunk: Chunk) -> Bits:
    """Mark the cells of a chunk and the layers beyond it that it joins its components in: see `chunks.joining`."""
    seen = np.full((len(field.where), ROWS), FULL, dtype=np.uint16)
    places = field.where + np.array(chunk.kept_low)
    for axis in range(3):
        seen[places[:, axis] < chunk.low[axis]] = 0
        beyond = places[:, axis] >= chunk.high[axis]
        if axis < 2:
            seen[np.ix_(beyond, ROW_PLACES[:, axis] > 0)] = 0
        else:
            seen[beyond] &= np.uint16(1)
    return seen


def _part_inside(labelled: Components, mask: Bits, chunk: Chunk) -> Components:
    """Return components without the cells beyond the chunk."""
    alone = np.full_like(labelled.alone, -1)
    low, high = np.array(chunk.low) - chunk.kept_low, np.array(chunk.high) - chunk.kept_low
    box = tuple(map(slice, low.tolist(), high.tolist()))
    alone[box] = labelled.alone[box]
    return replace(labelled, bits=labelled.bits & mask, alone=alone)


def _sum_cells(chunk_field: ChunkField, chunk: Chunk, labelled: Components) -> Numbers:
    """Sum the cells of the chunk in each component, (c, 3), counted from the first cell of the whole grid."""
    cells = cells_of_bits(chunk_field.field, labelled.bits)
    cells = cells[chunk.owns(cells // BRICK)]
    name = look_up(chunk_field, labelled, cells)
    total = np.zeros((labelled.count, 3), dtype=np.int64)
    np.add.at(total, name, cells + np.array(chunk.kept_low) * BRICK - 1)
    return total
