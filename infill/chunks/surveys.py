"""Passes over the values of a volume that decide how it is smoothed: grey values, noise, and the scale of grey edges.

Each has the result of the whole volume: see `infill.smoothing.scans`, `infill.voxels.noise` and
`infill.voxels.segmentation.EdgeSums`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import Chunk, ChunkLayout
from infill.chunks.running import Runner
from infill.chunks.work import ValueSurvey, Work
from infill.voxels.noise import LAYERS, count_in_slab, share_of_counts, slab_starts, work_shape
from infill.voxels.segmentation import EdgeSums

RIM = 2  # cells around a cell that decide whether neighbours overrule it, and whether a surface is there afterwards

Span = tuple[int, int]


@dataclass(frozen=True, kw_only=True)
class SampledValues:
    """The values in those layers of a chunk that are sampled.

    Parameters
    ----------
    ends : tuple of numbers
        The lowest and the highest; empty if no layer is sampled.
    between : bool
        Whether any lies between these.
    fractions : bool
        Whether any is not a whole number.
    """

    ends: tuple[float, ...] = ()
    between: bool = False
    fractions: bool = False

    def has_grey(self, lowest: float, highest: float) -> bool:
        """Tell whether any value lies between the lowest and the highest of the whole volume."""
        return self.between or any(lowest < end < highest for end in self.ends)


def survey_samples(work: Work, chunk: Chunk, stride: int) -> tuple[ValueSurvey, SampledValues]:
    """Survey the values of a chunk that has cells, and those in layers whose number is a multiple of a stride."""
    values = work.read_own(chunk)
    lowest, highest = values.min().item(), values.max().item()
    finite = bool(np.isfinite(lowest) and np.isfinite(highest))
    survey = ValueSurvey(lowest=lowest, highest=highest, two=False, finite=finite)
    begin = chunk.cell_low[0] + chunk.own_cells[0].start
    layers = values[-begin % stride :: stride]
    if layers.size == 0 or not finite:
        return survey, SampledValues()
    low, high = layers.min().item(), layers.max().item()
    return survey, SampledValues(
        ends=(low, high),
        between=bool(((layers > low) & (layers < high)).any()),
        fractions=layers.dtype.kind == "f" and bool((np.mod(layers, 1) != 0).any()),
    )


def count_noise(work: Work, start: int, rows: Span, columns: Span) -> NDArray[np.int64]:
    """Count noise in rows and columns of a stretch of layers: see `infill.voxels.noise.count_in_slab`."""
    along_x, along_y, along_z = work.layout.shape
    box, inner = [slice(start, min(start + LAYERS, along_x))], []
    for (begin, end), count in ((rows, along_y), (columns, along_z)):
        low, high = max(begin - RIM, 0), min(end + RIM, count)
        box.append(slice(low, high))
        inner += [begin - low, end - low]
    slab, tally = work.rule.mark(work.source.read(tuple(box))), np.zeros(3, dtype=np.int64)
    first_row, end_row, first_column, end_column = inner
    count_in_slab(
        slab, np.empty(work_shape(slab), dtype=np.uint8), tally, (first_row, end_row, first_column, end_column)
    )
    return tally


def measure_noise(work: Work, runner: Runner, tell: Callable[[float], None]) -> float:
    """Measure the noise of the solid in the volume: see `infill.voxels.noise.noise_share`."""
    sides = [spans_of_chunks(work.layout, axis) for axis in (1, 2)]
    items = [
        (start, rows, columns)
        for start in slab_starts(work.layout.shape[0])
        for rows in sides[0]
        for columns in sides[1]
    ]
    return share_of_counts(np.array(runner.run(count_noise, work, items, tell)))


def spans_of_chunks(layout: ChunkLayout, axis: int) -> list[Span]:
    """Return the cells of the chunks along an axis, from which and up to but without which, without margins."""
    spans = {
        (part.start + low, part.stop + low)
        for chunk in layout
        for low, part in [(chunk.cell_low[axis], chunk.own_cells[axis])]
        if part.stop > part.start
    }
    return sorted(spans)


def sum_edges(work: Work, chunk: Chunk, level: float) -> EdgeSums | None:
    """Sum what `infill.voxels.segmentation.edge_window` is found from, in a chunk; None for one without cells."""
    if not chunk.has_cells:
        return None
    own = [part.stop - part.start for part in chunk.own_cells]
    low = [begin + part.start for begin, part in zip(chunk.cell_low, chunk.own_cells, strict=True)]
    box = tuple(slice(a, min(a + n + 1, count)) for a, n, count in zip(low, own, chunk.shape, strict=True))
    return EdgeSums.of(work.source.read(box), level, own)


def measure_window(work: Work, runner: Runner, level: float, tell: Callable[[float], None]) -> float:
    """Measure the window of grey values of the volume: see `infill.voxels.segmentation.edge_window`."""
    results: Sequence[EdgeSums | None] = runner.run(sum_edges, work, [(chunk, level) for chunk in work.layout], tell)
    return reduce(add, [sums for sums in results if sums is not None]).window
