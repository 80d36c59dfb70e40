"""A partition in chunks: what the search for offsets asks of it, added up over the chunks as whole numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from infill.chunks.layout import Chunk
from infill.chunks.partition_parts import (
    CellLines,
    Names,
    PartitionWork,
    PartSurvey,
    PartWalls,
    WallTask,
    count_part_shares,
    cross_part,
    list_rises,
    measure_part,
    place_part,
    survey_part,
)
from infill.chunks.running import Runner
from infill.partition.fields import brick_stride, slope_of, volumes_of_shares
from infill.partition.junctions import TAKEN_BACK_ROUNDS
from infill.partition.volumes import MARGINS, areas_of_sums, triangle_stride
from infill.partition.walls import MOST_INT16, Walls, volumes_of_sums


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredWalls:
    """Walls in chunks, whose volumes and areas were measured.

    Parameters
    ----------
    task : WallTask
        Where they lie.
    volumes : (labels,) float64
    areas : (labels, labels) sparse float64
    """

    task: WallTask
    volumes: NDArray[np.float64]
    areas: sparse.csr_array


@dataclass(frozen=True, kw_only=True, eq=False)
class ChunkedPartition:
    """A partition in chunks: see `infill.partition.volumes.WallSource`. Its walls are held by their offsets.

    Parameters
    ----------
    work : PartitionWork
    runner : Runner
    tell : callable, optional
        Called with the share of chunks that are smoothed.
    """

    work: PartitionWork
    runner: Runner
    tell: Callable[[float], None] | None = None
    chunks: list[Chunk] = field(init=False)

    def __post_init__(self) -> None:
        """List the chunks."""
        object.__setattr__(self, "chunks", list(self.work.layout))

    def _run(self, function: Callable[..., Any], *arguments: Any, tell: Callable[[float], None] | None = None) -> Any:  # noqa: ANN401
        """Run a function on all chunks."""
        return self.runner.run(function, self.work, [(chunk, *arguments) for chunk in self.chunks], tell)

    @cached_property
    def survey(self) -> PartSurvey:
        """The bricks and margins of all chunks, which are smoothed for it."""
        parts = self._run(survey_part, MARGINS, tell=self.tell)
        return PartSurvey(bricks=sum(part.bricks for part in parts), margins=sum(part.margins for part in parts))

    @property
    def count(self) -> int:
        """Labels, 0 among them."""
        return self.work.count

    def slope(self) -> float:
        """Return the slope of a field at its surface."""
        return slope_of(np.concatenate(self._run(list_rises, brick_stride(self.survey.bricks))))

    def margins(self, bins: int) -> NDArray[np.int64]:
        """Return the margins that were counted."""
        assert bins == self.survey.margins.shape[1]
        return self.survey.margins

    def shares(self, offsets: NDArray[np.float64], ramp: float) -> tuple[NDArray[np.float64], sparse.csr_array]:
        """Return volumes by shares of cells, and their changes."""
        parts = self._run(count_part_shares, offsets, ramp)
        sums = sum(part[0] for part in parts)
        pairs, samples = _add_up([part[1] for part in parts], [part[2] for part in parts])
        return volumes_of_shares(sums, pairs, samples, ramp, self.work.layout.shape)

    def extract(
        self, offsets: NDArray[np.float64], *, held: NDArray[np.float64] | None = None, shifts: CellLines | None = None
    ) -> tuple[NDArray[np.float64], MeasuredWalls]:
        """Measure the walls between labels; they are held by the offsets that decide which label wins in a cell."""
        held = offsets if held is None else held
        task = WallTask(held=held, offsets=offsets, lines=shifts)
        stride = triangle_stride(self.survey.bricks)
        parts = self._run(measure_part, task, stride)
        sums = sum(part[0] for part in parts)
        areas = areas_of_sums(*_add_up([part[1] for part in parts], [part[2] for part in parts]), stride, self.count)
        volumes = volumes_of_sums(sums, self.work.layout.shape, self.work.scale)
        return held, MeasuredWalls(task=task, volumes=volumes, areas=areas)

    def areas(self, walls: MeasuredWalls) -> sparse.csr_array:
        """Return the areas between labels."""
        return walls.areas

    def smooth_lines(self, graph: NDArray[np.float64], walls: MeasuredWalls) -> CellLines:  # noqa: ARG002 - as in memory
        """Return the shifts by which lines become smooth; each chunk makes them when it needs them."""
        return CellLines(offsets=walls.task.offsets, taken=np.empty(0, dtype=np.int64))

    def take_back(self, walls: MeasuredWalls, shifts: CellLines) -> tuple[CellLines, int]:
        """Take back shifts of crossing triangles: see `infill.partition.junctions.take_back_crossings`."""
        taken: list[Names] = []
        for number in range(TAKEN_BACK_ROUNDS + 1):
            parts = self._run(cross_part, walls.task, tuple(taken))
            pairs = sum(part[0] for part in parts)
            if not pairs or number == TAKEN_BACK_ROUNDS:
                break
            taken.append(np.concatenate([part[1] for part in parts]))
        if not taken:
            return shifts, pairs
        return CellLines(offsets=shifts.offsets, taken=np.concatenate([shifts.taken, *taken])), pairs

    def join(self, walls: MeasuredWalls) -> Walls:
        """Join the walls of all chunks; points and triangles have the order of those in memory."""
        return join_parts(self._run(place_part, walls.task), walls.volumes)


def _add_up(keys: Sequence[NDArray[Any]], numbers: Sequence[NDArray[np.int64]]) -> tuple[Any, NDArray[np.int64]]:
    """Add up the numbers of equal keys; return the keys, in order, and the sums."""
    listed, place = np.unique(np.concatenate(keys), return_inverse=True)
    sums = np.zeros(len(listed), dtype=np.int64)
    np.add.at(sums, place, np.concatenate(numbers))
    return listed, sums


def join_parts(parts: Sequence[PartWalls], volumes: NDArray[np.float64]) -> Walls:
    """Join walls of chunks, whose points are the same where their names are."""
    names, first = np.unique(np.concatenate([part.names for part in parts]), return_index=True)
    points = np.concatenate([part.points for part in parts])[first]
    kind = np.int32 if len(names) < 2**31 else np.int64
    triangles = np.concatenate([np.searchsorted(names, part.names).astype(kind)[part.triangles] for part in parts])
    sides = np.concatenate([part.sides.astype(np.int32) for part in parts])
    order = np.argsort(np.concatenate([part.cubes for part in parts]), kind="stable")
    sides = sides[order]
    if sides.max(initial=0) <= MOST_INT16:
        return Walls(points=points, triangles=triangles[order], sides=sides.astype(np.int16), volumes=volumes)
    return Walls(points=points, triangles=triangles[order], sides=sides, volumes=volumes)
