"""The tasks on one chunk: plain functions of plain data, which any thread, process or machine may run.

    smooth ─▶ components, volumes at the first level        make_part ─▶ triangles to write

See `infill.chunks.work` for their input, and `infill.chunks.level_parts` for volumes at other levels.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.fields import uniform_sign
from infill.chunks.joining import ChunkComponents, look_up, named_cells, survey_components, survey_solid
from infill.chunks.layout import Chunk
from infill.chunks.level_parts import LevelParts, LevelTask, lower_field, measure_piece
from infill.chunks.pieces import (
    count_piece,
    make_piece,
    measure_parts,
)
from infill.chunks.specks import SpeckCount
from infill.chunks.work import ValueSurvey, Work, keep_field, open_field, read_data, smooth_field
from infill.kernels.sparse import BRICK

Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothedChunk:
    """A chunk after smoothing, in numbers.

    Parameters
    ----------
    values : ValueSurvey
        Of its own cells.
    solid : int
        Solid ones among its own cells, specks included.
    inside : bool
        Whether a chunk without surface lies inside the solid.
    specks : SpeckCount
    bricks : int
        Own bricks that are kept.
    components : ChunkComponents or None
        None without solid.
    start : LevelParts or None
        At level 0, or at the given level; None if no surface can cross the chunk.
    data : LevelParts or None
        Of the surface of the data as solid and void.
    """

    values: ValueSurvey
    solid: int
    inside: bool
    specks: SpeckCount
    bricks: int
    components: ChunkComponents | None
    start: LevelParts | None
    data: LevelParts | None


def smooth(work: Work, chunk: Chunk) -> SmoothedChunk:
    """Smooth a chunk, keep its field, and measure its surface at the first level."""
    read = read_data(work, chunk)
    facts: dict[str, Any] = {"values": read.values, "solid": read.solid, "specks": read.specks}
    chunk_field = smooth_field(work, chunk, read.data)
    if chunk_field is None:
        inside = chunk.has_cells and uniform_sign(read.data) > 0
        components = survey_solid(chunk) if inside else None
        return SmoothedChunk(**facts, inside=inside, bricks=0, components=components, start=None, data=None)
    del read
    keep_field(work, chunk, chunk_field)
    solid = replace(chunk_field, field=replace(chunk_field.field, values=chunk_field.field.data.astype(np.float32)))
    return SmoothedChunk(
        **facts,
        inside=False,
        bricks=int(chunk_field.own.sum()),
        components=survey_components(chunk_field, chunk, chunk_field.components()),
        start=measure_piece(work, chunk, chunk_field, 0.0 if work.level is None else work.level),
        data=measure_piece(work, chunk, solid, 0.0, any_numbers=True),
    )


def look_up_components(work: Work, chunk: Chunk, names: Numbers) -> NDArray[np.int32]:
    """Return the components of cells by their names: see `infill.chunks.joining`."""
    chunk_field = open_field(work, chunk)
    cells = named_cells(names, chunk.lattice) - np.array(chunk.kept_low) * BRICK
    return look_up(chunk_field, chunk_field.components(), cells)


@dataclass(frozen=True, kw_only=True, eq=False)
class ChunkTriangles:
    """The triangles of a chunk, as they are written.

    Parameters
    ----------
    vertices : (V, 3) float64, mm along the axes of the grid
    faces : (F, 3) int64
        Numbers below V are vertices of the chunk, V + n is the foreign vertex n.
    foreign : (W,) int64
        Names of foreign vertices.
    corners : (W, 3) float64
        The foreign vertices themselves.
    shared, shared_rank : (S,) int64
        Names of shared vertices that are left, and their numbers.
    """

    vertices: NDArray[np.float64]
    faces: Numbers
    foreign: Numbers
    corners: NDArray[np.float64]
    shared: Numbers
    shared_rank: Numbers


def make_part(work: Work, chunk: Chunk, task: LevelTask, removed: NDArray[np.bool_]) -> ChunkTriangles:
    """Make the triangles of a chunk at a level, without the parts that `removed` (s,) marks."""
    chunk_field = open_field(work, chunk)
    labelled = chunk_field.components() if task.names is not None and task.lowering else None
    lowered = lower_field(chunk_field, labelled, task)
    counted = count_piece(lowered, chunk, task.level)
    first_cubes = np.zeros(len(counted[2].bricks), dtype=np.int64) if task.first_cubes is None else task.first_cubes
    piece = make_piece(lowered, chunk, counted, level=task.level, spacing=work.spacing, first_cubes=first_cubes)
    names = measure_parts(piece, chunk, work.spacing).names
    stays = (names >= 0) & ~removed[names] if len(removed) else names >= 0
    is_owned, foreign = stays[: piece.own], stays[piece.own :]
    number = np.concatenate([np.cumsum(is_owned) - 1, int(is_owned.sum()) + np.cumsum(foreign) - 1])
    faces = piece.faces[stays[piece.faces[:, 0]]]
    is_left = is_owned[piece.shared_at]
    return ChunkTriangles(
        vertices=piece.vertices[: piece.own][is_owned],
        faces=number[faces],
        foreign=piece.foreign[foreign],
        corners=piece.vertices[piece.own :][foreign],
        shared=piece.shared[is_left],
        shared_rank=number[piece.shared_at[is_left]],
    )


def rank_shared(
    work: Work, chunk: Chunk, task: LevelTask, removed: NDArray[np.bool_]
) -> tuple[int, int, Numbers, Numbers]:
    """Count the vertices and triangles of `make_part`; return the names of shared vertices and their numbers, too."""
    part = make_part(work, chunk, task, removed)
    return len(part.vertices), len(part.faces), part.shared, part.shared_rank


def field_values(work: Work, chunk: Chunk, level: float, lowering: LevelTask) -> NDArray[np.float32]:
    """Return the field of a chunk's own cells, minus its level, within +-1, as `SmoothStages.field` does."""
    chunk_field = open_field(work, chunk)
    labelled = chunk_field.components() if lowering.names is not None and lowering.lowering else None
    field = lower_field(chunk_field, labelled, lowering).field
    dense = field.to_dense(threads=1)
    corner = np.maximum(np.array(chunk.low) * BRICK - 1, 0) - np.array(chunk.kept_low) * BRICK
    sizes = [part.stop - part.start for part in chunk.own_cells]
    values = dense[tuple(slice(a, a + n) for a, n in zip(corner.tolist(), sizes, strict=True))]
    values -= np.float32(level)
    return np.ascontiguousarray(values.clip(-1, 1))
