"""The surface of one chunk at a level, in numbers: its parts, their volumes, and the vertices that chunks share."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.chunks.fields import ChunkField
from infill.chunks.joining import look_up
from infill.chunks.layout import Chunk
from infill.chunks.pieces import (
    Piece,
    ShellParts,
    UndecidedCubes,
    count_piece,
    make_piece,
    measure_parts,
    vertex_places,
)
from infill.chunks.work import Work, open_field, unsmoothed_field
from infill.isosurfaces.components import Components
from infill.isosurfaces.levels import REACH, label_field, lower_to_levels

Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class LevelParts:
    """The piece of surface of a chunk at a level, in numbers.

    Parameters
    ----------
    cubes : UndecidedCubes
        If there are any and their numbers were not known, nothing else is right but this.
    complete : bool
        Whether everything is right.
    own : int
        Vertices of the chunk that a triangle takes.
    shells : ShellParts
        Without the names of vertices.
    foreign, foreign_in : (W,) int64, int32
        Names of foreign vertices, and their parts.
    shared, shared_in, shared_rank : (S,) int64, int32, int64
        Names of shared vertices, their parts, and their numbers among the vertices of the chunk.
    voters, votes : (v,) int64
        Part times the number of components, plus the component of the whole, and the vertices nearest to it.
    """

    cubes: UndecidedCubes
    complete: bool
    own: int
    shells: ShellParts
    foreign: Numbers
    foreign_in: NDArray[np.int32]
    shared: Numbers
    shared_in: NDArray[np.int32]
    shared_rank: Numbers
    voters: Numbers
    votes: Numbers


@dataclass(frozen=True, kw_only=True, eq=False)
class Lowering:
    """The levels of the components of a chunk, to be subtracted from its field.

    Parameters
    ----------
    levels : (c,) float64
        Of each of the chunk's own components.
    common : float
        The level of everything else.
    """

    levels: NDArray[np.float64]
    common: float


@dataclass(frozen=True, kw_only=True, eq=False)
class LevelTask:
    """How to measure the surface of one chunk.

    Parameters
    ----------
    level : float
        Of the field, or of the lowered one.
    lowering : Lowering or None
    names : (c,) int32 or None
        Component of the whole for each of the chunk's own; needed for votes.
    components : int
        Of the whole.
    first_cubes : (b,) int64 or None
        See `infill.chunks.pieces.make_piece`.
    votes : bool
        Whether to count the components nearest to the vertices.
    unsmoothed : bool
        Whether the surface is that of the grey data themselves.
    """

    level: float
    lowering: Lowering | None = None
    names: NDArray[np.int32] | None = None
    components: int = 1
    first_cubes: Numbers | None = None
    votes: bool = False
    unsmoothed: bool = False


def try_level(work: Work, chunk: Chunk, task: LevelTask) -> LevelParts:
    """Measure the surface of a chunk at a level."""
    chunk_field = open_field(work, chunk)
    labelled = chunk_field.components() if task.names is not None and (task.lowering or task.votes) else None
    if task.unsmoothed:
        chunk_field = unsmoothed_field(work, chunk, chunk_field)
    lowered = lower_field(chunk_field, labelled, task)
    return measure_piece(work, chunk, lowered, task.level, task=task, labelled=labelled)


def lower_field(chunk_field: ChunkField, labelled: Components | None, task: LevelTask) -> ChunkField:
    """Subtract the levels of components from a field."""
    if task.lowering is None or labelled is None or task.names is None:
        return chunk_field
    labels = label_field(chunk_field.field, labelled, 1)
    lowered = lower_to_levels(chunk_field.field, labels, task.lowering.levels, task.lowering.common, 1)
    return replace(chunk_field, field=lowered)


def measure_piece(
    work: Work,
    chunk: Chunk,
    chunk_field: ChunkField,
    level: float,
    *,
    task: LevelTask | None = None,
    labelled: Components | None = None,
    any_numbers: bool = False,
) -> LevelParts:
    """Measure the surface of a chunk; with `any_numbers`, wherever undecided cubes lie in a row."""
    counted = count_piece(chunk_field, chunk, level)
    cubes = counted[2]
    first_cubes = None if task is None else task.first_cubes
    if first_cubes is None:
        first_cubes = np.cumsum(cubes.counts) - cubes.counts
        complete = any_numbers or not len(cubes.bricks)
    else:
        complete = True
    if not complete:
        return _no_parts(cubes)
    piece = make_piece(chunk_field, chunk, counted, level=level, spacing=work.spacing, first_cubes=first_cubes)
    parts = measure_parts(piece, chunk, work.spacing)
    voters = votes = np.empty(0, dtype=np.int64)
    if task is not None and task.votes and labelled is not None and task.names is not None:
        voters, votes = _count_votes(work, chunk, chunk_field, piece, parts, labelled, task)
    used = parts.names[: piece.own] >= 0
    rank = np.cumsum(used) - 1
    return LevelParts(
        cubes=cubes,
        complete=True,
        own=int(used.sum()),
        shells=replace(parts, names=np.empty(0, dtype=np.int32)),
        foreign=piece.foreign,
        foreign_in=parts.names[piece.own :],
        shared=piece.shared,
        shared_in=parts.names[piece.shared_at],
        shared_rank=rank[piece.shared_at],
        voters=voters,
        votes=votes,
    )


def _no_parts(cubes: UndecidedCubes) -> LevelParts:
    """Return the undecided cubes alone."""
    none, no_parts = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int32)
    shells = ShellParts(names=no_parts, sums=np.empty((0, 4), dtype=np.int64), vertices=none, faces=none)
    return LevelParts(
        cubes=cubes,
        complete=False,
        own=0,
        shells=shells,
        foreign=none,
        foreign_in=no_parts,
        shared=none,
        shared_in=no_parts,
        shared_rank=none,
        voters=none,
        votes=none,
    )


def _count_votes(
    work: Work,
    chunk: Chunk,
    chunk_field: ChunkField,
    piece: Piece,
    parts: ShellParts,
    labelled: Components,
    task: LevelTask,
) -> tuple[Numbers, Numbers]:
    """Count for each part the vertices nearest to each component; return part times components plus component, too."""
    assert task.names is not None
    places = vertex_places(piece.vertices[: piece.own], work.spacing, chunk)
    label = look_up(chunk_field, labelled, places, reach=REACH)
    shell = parts.names[: piece.own]
    has_label = (label >= 0) & (shell >= 0)
    key = shell[has_label].astype(np.int64) * task.components + task.names[label[has_label]]
    voters, votes = np.unique(key, return_counts=True)
    return voters, votes
