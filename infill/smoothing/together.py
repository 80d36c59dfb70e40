"""Smooth a whole segmentation as one: walls that neighbours share, and every label with its own volume."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError, UsageError
from infill.formats.mesh_files import TETRAHEDRA, WALL_WRITERS
from infill.formats.parts import hex_colour
from infill.inspection.partitions import PartitionCheck
from infill.machine import require_memory
from infill.partition.fields import PartitionFields, smooth_fields, smooth_to_distance
from infill.partition.simplifying import simplify_partition
from infill.partition.volumes import VolumePartition, keep_volumes
from infill.plain_numbers import count_noun
from infill.reports.common import declare, report_head
from infill.reports.sections import with_late_sections
from infill.reports.smoothing import Distance, TogetherSeconds
from infill.result import Clock, Result
from infill.smoothing.comparing import verdict_facts
from infill.smoothing.label_stages import FACES_PER_RUN, LabelPiece, field_reach
from infill.smoothing.label_surfaces import LabelMeasures, LabelSurfaces, NumberedSurfaces
from infill.smoothing.together_checks import (
    WORDS,
    find_label_differences,
    label_distance,
    label_topology,
    summarise_verdicts,
)
from infill.smoothing.together_stages import TogetherStages

if TYPE_CHECKING:
    from infill.inspection.bricks import TopologyCheck
    from infill.phasefield.sparse import SparseField
    from infill.reports.smoothing import TogetherLabel, TogetherReport, TogetherVerdict, Verdicts
    from infill.smoothing.request import SmoothRequest
    from infill.volume import Volume

# Options that do not apply to all labels at once.
UNFIT = ("level", "despeckle", "crumbs", "max_triangles", "allow_broken", "strict")
# Of the grid, and for each face of a label's cells, estimated from its runs: peaks were 170 to 450 bytes a face, and
# up to 2,100 where walls are simplified.
BYTES_PER_CELL, BYTES_PER_FACE, BYTES_SIMPLIFIED = 10, 450, 2200
NOTHING_LEFT = "nothing of it is left"


def smooth_together(
    volume: Volume,
    pieces: Sequence[LabelPiece],
    request: SmoothRequest,
    absent: Sequence[str],
    shares: NDArray[np.float32] | None = None,
) -> Result[TogetherStages, TogetherReport]:
    """Smooth labels of one volume together; the other values are the space between them.

    Parameters
    ----------
    volume : Volume
    pieces : sequence of LabelPiece
    request : SmoothRequest
    absent : sequence of str
        Names of the labels without a cell.
    shares : (labels, nx, ny, nz) float32, optional
        The share of every cell that labels 1, 2 ... have.

    Raises
    ------
    GeometryError
        If no label is left.
    MemoryLimitError
    UsageError
        For an option that does not apply.
    """
    refuse_unfit(request)
    request = request.for_cell(float(volume.cell_size.min()))
    clock = Clock(request.progress)
    needed = needed_memory(volume.values.size, pieces, request) + (0 if shares is None else shares.nbytes)
    require_memory(needed, request.max_memory, "give --roi for a part of it, or a volume of larger voxels")
    numbers = number_labels(volume, pieces)
    chosen = None if shares is None else shares[[piece.segment.value - 1 for piece in pieces]]
    counts = _count_cells(numbers, len(pieces), chosen)
    with clock.stage("smooth", 0.0):
        fields = _smooth_fields(numbers, volume, pieces, request, clock, chosen)
    with clock.stage("volumes", 0.5):
        partition = keep_volumes(
            fields,
            counts * float(np.prod(scale_of(volume))),
            scale=scale_of(volume),
            threads=request.threads,
            progress=lambda share: clock.tell("volumes", 0.5 + 0.2 * share),
        )
    del fields  # larger than anything that follows
    with clock.stage("simplify", 0.7):
        simple = simplify(partition, request.tolerance, volume, threads=request.threads)
    with clock.stage("surface", 0.85):
        names = [piece.name for piece in pieces]
        surfaces = LabelSurfaces.of(simple.walls, volume, names, threads=request.threads)
    with clock.stage("check", 0.9):
        if not surfaces:
            raise GeometryError("no label is left after smoothing; give fewer steps")
        labels, problems = _judge_labels(numbers, counts, partition, simple, surfaces, volume, pieces, request)
    left, gone = ([piece for piece in pieces if (piece.name in surfaces) is kept] for kept in (True, False))
    report: TogetherReport = {
        **report_head("together"),
        "triangles": len(simple.walls.triangles),
        "closed": all(facts.closed for facts in surfaces.measures.values()),
        "problems": [*problems, *_problems_of_all(labels, gone, simple.crossings)],
        "request": request.facts(),
        "labels": labels,
        "failed": [{**piece.place, "error": NOTHING_LEFT} for piece in gone],
        "absent": list(absent),
        "verdict": _verdict_of_all(labels, gone),
        "rounds": partition.rounds,
        "tetrahedra": None,
        "seconds": clock.timings(TogetherSeconds),
    }
    stages = TogetherStages(
        segments={piece.name: piece.segment for piece in pieces},
        failed={piece.name: NOTHING_LEFT for piece in gone},
        partition=partition,
        written=simple.walls,
        volume=volume,
        values=(0, *(piece.segment.value for piece in pieces)),
        max_memory=request.max_memory,
    )
    colours = {piece.name: piece.segment.colour for piece in left if piece.segment.colour is not None}
    writers: dict[str, Callable[[BinaryIO], None]] = {
        **{suffix: partial(stages.write_walls, write) for suffix, write in WALL_WRITERS.items()},
        TETRAHEDRA: stages.write_tetrahedra,
    }
    return Result(surfaces=surfaces, report=report, stages=stages, colours=colours, writers=writers)


def refuse_unfit(request: SmoothRequest) -> None:
    """Raise UsageError for an option that is given and does not apply to labels together."""
    plain = type(request)()
    for name in UNFIT:
        if getattr(request, name) != getattr(plain, name):
            raise UsageError.about(name, "does not go with labels together; leave it out")
    if request.method == "grey":
        raise UsageError.about("method", "is grey, and labels have no grey values; give plain or refine")


def refuse_layers(pieces: Sequence[LabelPiece]) -> None:
    """Raise UsageError if labels lie in several layers, which may overlap."""
    if len({piece.segment.layer for piece in pieces}) > 1:
        raise UsageError.about("together", "is given, and the labels lie in layers that may overlap; leave it out")


def number_labels(volume: Volume, pieces: Sequence[LabelPiece]) -> NDArray[np.uint16]:
    """Return the cells of labels numbered 1, 2 ... in the order of the pieces, and 0 elsewhere.

    Raises
    ------
    UsageError
        If labels lie in several layers, which may overlap.
    """
    refuse_layers(pieces)
    numbers = np.zeros(volume.values.shape, dtype=np.uint16)
    for number, piece in enumerate(pieces, 1):
        box = tuple(map(slice, piece.extent.low, piece.extent.high))
        numbers[box][volume.values[box] == piece.segment.value] = number
    return numbers


def needed_memory(cells: int, pieces: Sequence[LabelPiece], request: SmoothRequest) -> int:
    """Return the memory that fields and walls take, bytes."""
    faces = sum(FACES_PER_RUN * piece.extent.runs for piece in pieces)
    return cells * BYTES_PER_CELL + faces * (BYTES_PER_FACE if request.tolerance is None else BYTES_SIMPLIFIED)


def _smooth_fields(
    numbers: NDArray[np.uint16],
    volume: Volume,
    pieces: Sequence[LabelPiece],
    request: SmoothRequest,
    clock: Clock,
    shares: NDArray[np.float32] | None,
) -> PartitionFields:
    """Smooth the field of every label, and of the space between them; `shares` are those of the pieces."""
    spacing = tuple(volume.cell_size.tolist())
    is_plain = request.method == "plain"

    def smooth_data(data: NDArray[np.generic], threads: int) -> SparseField:
        """Smooth the cells of a label to distances from its surface."""
        return smooth_to_distance(data, request.smoothing, spacing=spacing, plain=is_plain, threads=threads)

    def phase_of_shares(number: int, box: tuple[slice, ...]) -> NDArray[np.float32]:
        """Return the shares of a label, or of the space between all, as a phase field."""
        assert shares is not None
        part = shares[number - 1][box] if number else np.maximum(1 - shares[(slice(None), *box)].sum(axis=0), 0)
        return np.asarray(2 * part - 1)

    boxes = [((0, 0, 0), numbers.shape), *((piece.extent.low, piece.extent.high) for piece in pieces)]
    if shares is not None:
        boxes[1:] = [_box_of(share > 0) for share in shares]
    return smooth_fields(
        numbers,
        boxes,
        smooth_data,
        data=None if shares is None else phase_of_shares,
        reach=field_reach(request.smoothing.interface),
        threads=request.threads,
        progress=lambda share: clock.tell("smooth", 0.5 * share),
    )


def _count_cells(numbers: NDArray[np.uint16], labels: int, shares: NDArray[np.float32] | None) -> NDArray[np.float64]:
    """Count the cells of the space between labels and of every label, (labels + 1,), with parts of cells."""
    if shares is None:
        return np.bincount(numbers.ravel(), minlength=labels + 1).astype(np.float64)
    counts = shares.sum(axis=(1, 2, 3), dtype=np.float64)
    return np.concatenate([[numbers.size - counts.sum()], counts])


def _box_of(cells: NDArray[np.bool_]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the lowest corner and the highest, exclusive, of marked cells."""
    places = [np.flatnonzero(cells.any(axis=tuple({0, 1, 2} - {axis}))) for axis in range(3)]
    return tuple(int(place[0]) for place in places), tuple(int(place[-1]) + 1 for place in places)


def simplify(
    partition: VolumePartition, tolerance: float | str | None, volume: Volume, *, threads: int | None
) -> VolumePartition:
    """Simplify the walls of a partition within a tolerance, mm; None keeps all triangles."""
    if tolerance is None or isinstance(tolerance, str):
        return partition
    cell = float(volume.cell_size.min())
    return simplify_partition(partition, tolerance / cell, scale=scale_of(volume), threads=threads)


def scale_of(volume: Volume) -> tuple[float, ...]:
    """Return the sides of a cell; the smallest is 1."""
    return tuple((volume.cell_size / volume.cell_size.min()).tolist())


def _judge_labels(
    numbers: NDArray[np.uint16],
    counts: NDArray[np.float64],
    partition: VolumePartition,
    simple: VolumePartition,
    surfaces: LabelSurfaces,
    volume: Volume,
    pieces: Sequence[LabelPiece],
    request: SmoothRequest,
) -> tuple[list[TogetherLabel], list[str]]:
    """Compare every label that is left with its voxels; return the rows of the report, and the problems.

    Parameters
    ----------
    numbers : (n0, n1, n2) uint16
        The label of every cell, from `number_labels`.
    counts : (labels,) float64
        Cells of each; parts of cells count as such.
    partition, simple : VolumePartition
        With all triangles, and as it is written.
    """
    is_simple = simple is not partition
    check = PartitionCheck(
        numbers=numbers,
        graph=partition.graph,
        points=partition.walls.points,
        volume=volume,
        count=len(pieces) + 1,
        cutter=None if is_simple else surfaces.cutter,
        written=NumberedSurfaces(surfaces=surfaces) if is_simple else {},
        leeway=float(request.tolerance) if is_simple and request.tolerance else 0.0,
        threads=request.threads,
    )
    topologies, deviations = check.topology(), check.deviations()
    labels: list[TogetherLabel] = []
    problems: list[str] = []
    for number, piece in enumerate(pieces, 1):
        if piece.name not in surfaces:
            continue
        cells, facts = float(counts[number]), surfaces.measures[piece.name]
        change = facts.volume / (cells * volume.cell_volume) - 1
        differences = find_label_differences(topologies[number], deviations[number], change, cells)
        verdict = verdict_facts(differences, deviations[number], check.cell)
        keys = _label_keys(piece, facts, cells * volume.cell_volume, topologies[number], verdict)
        labels.append(with_late_sections(keys, distance=partial(label_distance, check, number)))
        problems += [f"{piece.name}: {problem}" for problem in (*differences.losses, *differences.problems)]
    return labels, problems


def _label_keys(
    piece: LabelPiece, facts: LabelMeasures, data: float, topology: TopologyCheck, verdict: TogetherVerdict
) -> TogetherLabel:
    """Return the keys of a label in the report; its distances are measured when they are first read."""
    colour = piece.segment.colour
    return {
        **piece.place,
        "colour": None if colour is None else hex_colour(colour),
        "triangles": facts.triangles,
        "closed": facts.closed,
        "data": data,
        "volume": facts.volume,
        "volume_change": facts.volume / data - 1,
        "components_before": topology.data.components,
        "components": topology.result.components,
        "topology": label_topology(topology),
        "verdict": verdict,
        "distance": declare(Distance, {}),
    }


def _verdict_of_all(labels: Sequence[TogetherLabel], gone: Sequence[LabelPiece]) -> Verdicts:
    """Return the worst verdict, and a phrase for each."""
    word = "lost" if gone else max((keys["verdict"]["word"] for keys in labels), key=WORDS.index)
    return {"word": word, "summary": summarise_verdicts(labels, [piece.name for piece in gone])}


def _problems_of_all(labels: Sequence[TogetherLabel], gone: Sequence[LabelPiece], crossings: int) -> list[str]:
    """Return the problems that no comparison shows, one phrase each: open surfaces, labels gone, and crossings."""
    problems = [f"{keys['name']}: its surface is not closed" for keys in labels if not keys["closed"]]
    problems += [f"{piece.name}: {NOTHING_LEFT}" for piece in gone]
    if crossings:
        problems.append(f"all labels: {count_noun(crossings, 'pair')} of triangles pass through each other")
    return problems
