"""The work on one chunk: plain functions of plain data, which any thread, process or machine may run.

    survey_values ─▶ extremes          smooth ─▶ components, volumes at the first level
    count_values  ─▶ histogram         try_level ─▶ volumes at other levels       make_part ─▶ triangles to write

A field that was computed once is kept in a scratch folder, as long as the disk has room; where it is not found, it is
computed again, with the same result.
"""

from __future__ import annotations

import contextlib
import math
import os
import shutil
import zipfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from infill.chunks.fields import ChunkField, gather_data, pack_field, smooth_chunk, uniform_sign, unpack_field
from infill.chunks.joining import ChunkComponents, look_up, named_cells, survey_components, survey_solid
from infill.chunks.layout import Chunk, ChunkLayout
from infill.chunks.pieces import (
    Piece,
    ShellParts,
    UndecidedCubes,
    count_piece,
    make_piece,
    measure_parts,
    vertex_places,
)
from infill.chunks.solids import GreyScale, SolidRule
from infill.chunks.specks import SpeckCount, remove_specks
from infill.isosurfaces.components import Components
from infill.isosurfaces.levels import REACH, label_field, lower_to_levels
from infill.kernels.sparse import BRICK
from infill.phasefield.allen_cahn import Smoothing
from infill.voxels.segmentation import count_solid_cells, histogram_edges, histogram_of

DAMAGED = (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile)  # of a file that is missing or not whole
FREE_SPACE = 0.1  # of the disk of the scratch folder: it stays free

Numbers = NDArray[np.int64]


class CellReader(Protocol):
    """An array of which parts can be read, and that can be sent to other processes."""

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""


@dataclass(frozen=True, kw_only=True)
class Work:
    """The work that is the same for all chunks.

    Parameters
    ----------
    source : CellReader
    rule : SolidRule
    layout : ChunkLayout
    smoothing : Smoothing
    spacing : (hx, hy, hz), mm
    level : float or None
        The level of the field at which the surface lies; None if it is found, by the distance from the surface.
    scratch : str
        Folder in which fields are kept; "" for none.
    refined : bool
        Whether fields are refined. They are distances then, not phi.
    grey : GreyScale or None
        The scale of grey values, which are smoothed instead of the solid cells.
    despeckle : float
        Components of the data up to this volume are taken out first, mm³.
    """

    unkeyed: ClassVar = ("source", "scratch")  # they do not tell one task from another: see `digest_data`

    source: CellReader
    rule: SolidRule
    layout: ChunkLayout
    smoothing: Smoothing
    spacing: tuple[float, ...]
    level: float | None
    scratch: str = ""
    refined: bool = False
    grey: GreyScale | None = None
    despeckle: float = 0.0

    @property
    def cell_volume(self) -> float:
        """Volume of a cell, mm³."""
        return float(np.prod(np.array(self.spacing)))

    @property
    def speck_cells(self) -> int:
        """Cells of the largest speck that is taken out, or one more."""
        return int(self.despeckle / self.cell_volume) + 1 if self.despeckle else 0

    def read(self, chunk: Chunk) -> NDArray[Any]:
        """Read the cells of a chunk with its margin."""
        return self.source.read(tuple(map(slice, chunk.cell_low, chunk.cell_high)))

    def read_own(self, chunk: Chunk) -> NDArray[Any]:
        """Read the cells of a chunk without its margin."""
        return self.source.read(
            tuple(
                slice(part.start + low, part.stop + low)
                for part, low in zip(chunk.own_cells, chunk.cell_low, strict=True)
            )
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class ChunkData:
    """The cells that are read for a chunk.

    Parameters
    ----------
    data : (n0, n1, n2) bool or float32
        Its cells with their margin: solid or not, or grey values in [-1, 1]; without specks.
    values : ValueSurvey
        The values of its own cells.
    solid : int
        Solid ones among its own cells, specks included.
    specks : SpeckCount
    """

    data: NDArray[np.bool_] | NDArray[np.float32]
    values: ValueSurvey
    solid: int
    specks: SpeckCount


def read_data(work: Work, chunk: Chunk) -> ChunkData:
    """Read the cells of a chunk, and find their data."""
    widened = chunk.widened(work.speck_cells) if work.despeckle else chunk
    values = work.read(widened)
    own_values = values[widened.own_cells]
    survey = _survey(own_values if chunk.has_cells else values)
    solid = np.ascontiguousarray(work.rule.mark(values))
    count = count_solid_cells(np.ascontiguousarray(solid[widened.own_cells]))
    data: NDArray[np.bool_] | NDArray[np.float32] = solid
    if work.grey is not None:
        data = work.grey.scale(np.ascontiguousarray(values))
    del values, own_values, solid
    specks = SpeckCount()
    if work.despeckle:
        data, specks = remove_specks(data, widened, work.despeckle, work.cell_volume)
        low = np.array(chunk.cell_low) - np.array(widened.cell_low)
        sizes = np.array(chunk.cell_high) - np.array(chunk.cell_low)
        box = tuple(slice(a, a + n) for a, n in zip(low, sizes, strict=True))
        data = np.require(data[box], data.dtype, "C")
    return ChunkData(data=data, values=survey, solid=count, specks=specks)


@dataclass(frozen=True, kw_only=True)
class ValueSurvey:
    """The values of a chunk.

    Parameters
    ----------
    lowest, highest : number
    two : bool
        Whether the chunk holds no other values.
    finite : bool
        Whether no cell is NaN or infinite.
    """

    lowest: Any
    highest: Any
    two: bool
    finite: bool


def survey_values(work: Work, chunk: Chunk) -> ValueSurvey:
    """Find the extremes of the values in a chunk."""
    return _survey(work.read_own(chunk) if chunk.has_cells else work.read(chunk))


def _survey(values: NDArray[Any]) -> ValueSurvey:
    """Survey values: their extremes, and whether all cells have one of these two."""
    lowest, highest = values.min().item(), values.max().item()
    finite = math.isfinite(lowest) and math.isfinite(highest)
    two = finite and bool(((values == lowest) | (values == highest)).all())
    return ValueSurvey(lowest=lowest, highest=highest, two=two, finite=finite)


def count_values(work: Work, chunk: Chunk, lowest: float, highest: float) -> NDArray[np.float64]:
    """Count the values in each bin of the histogram of the whole volume."""
    if not chunk.has_cells:
        return np.zeros(len(histogram_edges(work.source.dtype, lowest, highest)) - 1)
    return histogram_of(work.read_own(chunk), lowest, highest)[0]


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
        ChunkTriangles times the number of components plus the component of the whole, and the vertices nearest to it.
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
    chunk_field = _smooth(work, chunk, read.data)
    if chunk_field is None:
        inside = chunk.has_cells and uniform_sign(read.data) > 0
        components = survey_solid(chunk) if inside else None
        return SmoothedChunk(**facts, inside=inside, bricks=0, components=components, start=None, data=None)
    del read
    _keep(work, chunk, chunk_field)
    solid = replace(chunk_field, field=replace(chunk_field.field, values=chunk_field.field.data.astype(np.float32)))
    return SmoothedChunk(
        **facts,
        inside=False,
        bricks=int(chunk_field.own.sum()),
        components=survey_components(chunk_field, chunk, chunk_field.components()),
        start=measure_piece(work, chunk, chunk_field, 0.0 if work.level is None else work.level),
        data=measure_piece(work, chunk, solid, 0.0, any_numbers=True),
    )


def _smooth(work: Work, chunk: Chunk, data: NDArray[np.bool_] | NDArray[np.float32]) -> ChunkField | None:
    """Smooth the cells of a chunk."""
    return smooth_chunk(
        data,
        chunk,
        work.smoothing,
        work.spacing,
        refined=work.refined,
        straighten=work.level is None and not work.refined,
        threads=1,
    )


def _path(work: Work, chunk: Chunk) -> Path | None:
    """Return the file of a chunk in the scratch folder; None without one, as on another machine."""
    return Path(work.scratch) / f"{chunk.number}.npz" if work.scratch and Path(work.scratch).is_dir() else None


def _keep(work: Work, chunk: Chunk, chunk_field: ChunkField) -> None:
    """Keep a field in the scratch folder, if there is room for it."""
    path = _path(work, chunk)
    if path is None:
        return
    part = path.with_suffix(f".{os.getpid()}")
    with contextlib.suppress(OSError):
        space = shutil.disk_usage(path.parent)
        if space.free - chunk_field.field.values.nbytes < FREE_SPACE * space.total:
            return
        try:
            with part.open("wb") as file:
                np.savez(file, **pack_field(chunk_field))  # type: ignore[arg-type]
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)


def open_field(work: Work, chunk: Chunk) -> ChunkField:
    """Return the field of a chunk that a surface may cross: kept, or computed again."""
    path = _path(work, chunk)
    if path is not None:
        with contextlib.suppress(*DAMAGED), np.load(path) as arrays:
            return unpack_field(dict(arrays))
    chunk_field = _smooth(work, chunk, read_data(work, chunk).data)
    assert chunk_field is not None  # it was not when it was smoothed first
    _keep(work, chunk, chunk_field)
    return chunk_field


def unsmoothed_field(work: Work, chunk: Chunk, chunk_field: ChunkField) -> ChunkField:
    """Return the data in the bricks of a chunk's field, in place of its values; grey ones are read again."""
    if work.grey is None:
        field = chunk_field.field
        return replace(chunk_field, field=replace(field, values=field.data.astype(np.float32)))
    return gather_data(chunk_field, chunk, read_data(work, chunk).data.astype(np.float32, copy=False))


def look_up_components(work: Work, chunk: Chunk, names: Numbers) -> NDArray[np.int32]:
    """Return the components of cells by their names: see `infill.chunks.joining`."""
    chunk_field = open_field(work, chunk)
    cells = named_cells(names, chunk.lattice) - np.array(chunk.kept_low) * BRICK
    return look_up(chunk_field, chunk_field.components(), cells)


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
