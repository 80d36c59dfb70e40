"""Smooth a whole segmentation as one: walls that neighbours share, and every label with its own volume."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from infill.errors import GeometryError, UsageError
from infill.formats.parts import hex_colour
from infill.machine import require_memory
from infill.partition.cutting import cut_labels
from infill.partition.fields import PartitionFields, smooth_fields
from infill.partition.volumes import SMALLEST, VolumePartition, keep_volumes
from infill.phasefield.profile import PLAIN_PROFILE, REFINED_PROFILE
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.plain_numbers import count_noun
from infill.reports.common import report_head
from infill.reports.smoothing import TogetherSeconds
from infill.result import Clock, Result
from infill.smoothing.label_stages import FACES_PER_RUN, LabelPiece, LabelStages, field_reach
from infill.smoothing.request import AUTO
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.reports.smoothing import TogetherLabel, TogetherReport
    from infill.smoothing.request import SmoothRequest
    from infill.volume import Volume

# Options that do not apply to all labels at once.
UNFIT = ("level", "despeckle", "crumbs", "max_triangles", "allow_broken", "strict")
# Of the grid, and for each face of a label's cells, estimated from its runs: peaks were 210 to 550 bytes a face, the
# surfaces of all labels among them, and 950 for noise.
BYTES_PER_CELL, BYTES_PER_FACE = 10, 600
# Cells are neighbours along every edge of the tetrahedra that they are cut into.
NEIGHBOURS = np.array(
    [[[1, 1, 0], [1, 1, 0], [0, 0, 0]], [[1, 1, 0], [1, 1, 1], [0, 1, 1]], [[0, 0, 0], [0, 1, 1], [0, 1, 1]]]
)
NOTHING_LEFT = "nothing of it is left"
PRECISION = 1e-4  # of a label's volume that counts as kept


def smooth_together(
    volume: Volume, pieces: Sequence[LabelPiece], request: SmoothRequest, absent: Sequence[str]
) -> Result[LabelStages, TogetherReport]:
    """Smooth labels of one volume together; the other values are the space between them.

    Raises
    ------
    GeometryError
        If no label is left.
    MemoryLimitError
    UsageError
        For an option that does not apply.
    """
    refuse_unfit(request)
    request = request.at(float(volume.cell_size.min()))
    clock = Clock(request.progress)
    _require_memory(volume.values.size, pieces, request)
    numbers = number_labels(volume, pieces)
    scale = tuple((volume.cell_size / volume.cell_size.min()).tolist())
    with clock.stage("smooth", 0.0):
        fields = _smooth_fields(numbers, volume, pieces, request, clock)
    counts = np.bincount(numbers.ravel(), minlength=len(pieces) + 1)
    with clock.stage("volumes", 0.5):
        partition = keep_volumes(
            fields,
            counts * float(np.prod(scale)),
            scale=scale,
            threads=request.threads,
            progress=lambda share: clock.tell("volumes", 0.5 + 0.3 * share),
        )
    del fields  # larger than anything that follows
    with clock.stage("surface", 0.8):
        surfaces = cut_surfaces(partition, volume, pieces, threads=request.threads)
    with clock.stage("check", 0.9):
        before = count_components(numbers, pieces)
        after = count_components(partition.graph.winners, pieces)
    if not surfaces:
        raise GeometryError("no label is left after smoothing; give fewer steps")
    labels = [
        _label_keys(
            piece, surfaces[piece.name], int(counts[number]) * volume.cell_volume, before[number], after[number]
        )
        for number, piece in enumerate(pieces, 1)
        if piece.name in surfaces
    ]
    left, gone = ([piece for piece in pieces if (piece.name in surfaces) is kept] for kept in (True, False))
    report: TogetherReport = {
        **report_head("together"),
        "triangles": len(partition.walls.triangles),
        "closed": all(surface.closed for surface in surfaces.values()),
        "problems": [
            *(problem for keys in labels for problem in _problems(keys, volume)),
            *(f"{piece.name}: {NOTHING_LEFT}" for piece in gone),
            *_crossing_problems(partition.crossings),
        ],
        "request": request.facts(),
        "labels": labels,
        "failed": [{**piece.place, "error": NOTHING_LEFT} for piece in gone],
        "absent": list(absent),
        "rounds": partition.rounds,
        "seconds": clock.timings(TogetherSeconds),
    }
    stages = LabelStages(
        segments={piece.name: piece.segment for piece in pieces},
        failed={piece.name: NOTHING_LEFT for piece in gone},
    )
    colours = {piece.name: piece.segment.colour for piece in left if piece.segment.colour is not None}
    return Result(surfaces=surfaces, report=report, stages=stages, colours=colours)


def refuse_unfit(request: SmoothRequest) -> None:
    """Raise UsageError for an option that is given and does not apply to labels together."""
    plain = type(request)()
    for name in UNFIT:
        if getattr(request, name) != getattr(plain, name):
            raise UsageError.about(name, "does not go with labels together; leave it out")
    if request.tolerance not in (AUTO, None):
        raise UsageError.about("tolerance", "does not go with labels together, which keep all triangles; leave it out")
    if request.method == "grey":
        raise UsageError.about("method", "is grey, and labels have no grey values; give plain or refine")


def number_labels(volume: Volume, pieces: Sequence[LabelPiece]) -> NDArray[np.uint16]:
    """Return the cells of labels numbered 1, 2 ... in the order of the pieces, and 0 elsewhere.

    Raises
    ------
    UsageError
        If labels lie in several layers, which may overlap.
    """
    if len({piece.segment.layer for piece in pieces}) > 1:
        raise UsageError.about("together", "is given, and the labels lie in layers that may overlap; leave it out")
    numbers = np.zeros(volume.values.shape, dtype=np.uint16)
    for number, piece in enumerate(pieces, 1):
        box = tuple(map(slice, piece.extent.low, piece.extent.high))
        numbers[box][volume.values[box] == piece.segment.value] = number
    return numbers


def _require_memory(cells: int, pieces: Sequence[LabelPiece], request: SmoothRequest) -> None:
    """Raise MemoryLimitError if fields and walls do not fit into memory."""
    faces = sum(FACES_PER_RUN * piece.extent.runs for piece in pieces)
    require_memory(
        cells * BYTES_PER_CELL + faces * BYTES_PER_FACE,
        request.max_memory,
        "give --voxel for larger voxels, or --roi for a part of it",
    )


def _smooth_fields(
    numbers: NDArray[np.uint16], volume: Volume, pieces: Sequence[LabelPiece], request: SmoothRequest, clock: Clock
) -> PartitionFields:
    """Smooth the field of every label, and of the space between them."""
    spacing = tuple(volume.cell_size.tolist())
    is_plain = request.method == "plain"
    smoother, profile = (smooth_bricks, PLAIN_PROFILE) if is_plain else (refine_bricks, REFINED_PROFILE)

    def smooth(mask: NDArray[np.bool_], threads: int) -> SparseField:
        field = smoother(mask, request.smoothing, spacing=spacing, threads=threads)
        # Distances change evenly from cell to cell, as walls between them assume.
        return replace(field, values=profile.distance(field.values, out=field.values, threads=threads))

    boxes = [((0, 0, 0), numbers.shape), *((piece.extent.low, piece.extent.high) for piece in pieces)]
    return smooth_fields(
        numbers,
        boxes,
        smooth,
        reach=field_reach(request.smoothing.interface),
        threads=request.threads,
        progress=lambda share: clock.tell("smooth", 0.5 * share),
    )


def cut_surfaces(
    partition: VolumePartition, volume: Volume, pieces: Sequence[LabelPiece], *, threads: int | None = None
) -> dict[str, Surface]:
    """Return the surface of every label that is left, by its name; neighbours have the same coordinates at walls."""
    points, sides = partition.walls.points, volume.cell_size
    # A turn is done for all points at once: then neighbours have the same coordinates to the last bit.
    placed = None if (np.asarray(volume.direction) == np.eye(3)).all() else volume.place(points * sides)
    surfaces = {}
    for cut in cut_labels(partition.walls, len(pieces) + 1, threads=threads):
        faces = cut.faces[:, ::-1] if volume.mirrored else cut.faces
        vertices = volume.place(points[cut.points] * sides) if placed is None else placed[cut.points]
        surface = Surface(vertices=vertices, faces=faces, space=volume.space)
        if surface.volume > 0:
            surfaces[pieces[cut.label - 1].name] = surface
    return surfaces


def count_components(numbers: NDArray[np.uint16], pieces: Sequence[LabelPiece]) -> list[int]:
    """Count the components of every label, 0 for the space between; cells are neighbours as tetrahedra join them."""
    boxes = ndimage.find_objects(numbers, max_label=len(pieces))
    return [0] + [
        0 if box is None else int(ndimage.label(numbers[box] == number, structure=NEIGHBOURS)[1])
        for number, box in enumerate(boxes, 1)
    ]


def _label_keys(piece: LabelPiece, surface: Surface, data: float, before: int, after: int) -> TogetherLabel:
    """Return the keys of a label in the report."""
    colour = piece.segment.colour
    return {
        **piece.place,
        "colour": None if colour is None else hex_colour(colour),
        "triangles": len(surface.faces),
        "closed": surface.closed,
        "data": data,
        "volume": surface.volume,
        "volume_change": surface.volume / data - 1,
        "components_before": before,
        "components": after,
    }


def _problems(keys: TogetherLabel, volume: Volume) -> list[str]:
    """Return the problems of a label, one phrase each."""
    problems = []
    if keys["data"] >= SMALLEST * volume.cell_volume and abs(keys["volume_change"]) > PRECISION:
        problems.append(f"{keys['name']}: its volume changes by {keys['volume_change']:+z.2%}")
    if keys["components"] != keys["components_before"]:
        problems.append(
            f"{keys['name']}: {count_noun(keys['components_before'], 'component')} became {keys['components']}"
        )
    if not keys["closed"]:
        problems.append(f"{keys['name']}: its surface is not closed")
    return problems


def _crossing_problems(count: int) -> list[str]:
    """Return the problem of triangles that pass through each other, if any do."""
    return [f"all labels: {count_noun(count, 'pair')} of triangles pass through each other"] if count else []
