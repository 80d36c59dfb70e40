"""Read the input of tasks on chunks: the cells, their values, and fields that were smoothed before.

    survey_values ─▶ extremes          count_values ─▶ histogram          open_field ─▶ the field of a chunk

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

from infill.chunks.fields import ChunkField, gather_data, pack_field, smooth_chunk, unpack_field
from infill.chunks.layout import Chunk, ChunkLayout
from infill.chunks.solids import GreyScale, SolidRule
from infill.chunks.specks import SpeckCount, remove_specks
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


def smooth_field(work: Work, chunk: Chunk, data: NDArray[np.bool_] | NDArray[np.float32]) -> ChunkField | None:
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


def keep_field(work: Work, chunk: Chunk, chunk_field: ChunkField) -> None:
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
    chunk_field = smooth_field(work, chunk, read_data(work, chunk).data)
    assert chunk_field is not None  # it was not when it was smoothed first
    keep_field(work, chunk, chunk_field)
    return chunk_field


def unsmoothed_field(work: Work, chunk: Chunk, chunk_field: ChunkField) -> ChunkField:
    """Return the data in the bricks of a chunk's field, in place of its values; grey ones are read again."""
    if work.grey is None:
        field = chunk_field.field
        return replace(chunk_field, field=replace(field, values=field.data.astype(np.float32)))
    return gather_data(chunk_field, chunk, read_data(work, chunk).data.astype(np.float32, copy=False))
