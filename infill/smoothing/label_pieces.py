"""The labels to smooth, each by itself: their names and their places, the work on one, and the result of all."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from infill.errors import InfillError, ParameterError, UsageError
from infill.formats.parts import hex_colour
from infill.imaging.label_tables import Segment
from infill.imaging.segmentations import Segmentation
from infill.kernels.sparse import BRICK
from infill.plain_numbers import list_some
from infill.reports.common import report_head
from infill.reports.smoothing import LabelSeconds
from infill.result import Clock, Result
from infill.smoothing.job import smooth_volume
from infill.smoothing.label_stages import LabelPiece, LabelStages, field_reach
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.volume import Volume
from infill.voxels.labels import LabelExtent, is_label_map, label_extents

if TYPE_CHECKING:
    from infill.reports.smoothing import LabelsReport, SmoothReport
    from infill.smoothing.stages import SmoothStages
    from infill.surface import Surface

Outcome = TypeVar("Outcome")

MOST_UNNAMED = 64  # values without names that are taken for labels even if they do not fill regions
MAX_LISTED_LABELS = 12  # labels in a message
SMALL = 2**20  # cells of a box: one thread does it before others have begun


def refuse_shares(segmentation: Segmentation) -> None:
    """Raise UsageError if labels share cells: they are smoothed together alone."""
    if segmentation.shares is not None:
        raise UsageError.about("together", "is left out, and the labels share cells; give it")


def find_pieces(
    segmentation: Segmentation, label: int | tuple[int, ...] | None, table: tuple[Segment, ...]
) -> list[LabelPiece]:
    """Return the labels to smooth, each with a unique name."""
    return name_pieces(
        [label_extents(volume) for volume in segmentation.layers],
        lambda: any(is_label_map(volume) for volume in segmentation.layers),
        segmentation.segments,
        label,
        table,
    )


def name_pieces(
    layers: Sequence[Sequence[LabelExtent]],
    fill_regions: Callable[[], bool],
    segments: Sequence[Segment],
    label: int | tuple[int, ...] | None,
    table: tuple[Segment, ...],
) -> list[LabelPiece]:
    """Return the labels to smooth by the extents of those in each layer, each with a unique name.

    Parameters
    ----------
    layers : sequence of sequence of LabelExtent
    fill_regions : callable
        Tells whether the values fill regions, as labels do, and grey values do not.
    segments : sequence of Segment
        Of the file.
    label, table
        See `smooth_labels`.
    """
    requested = None if label is None else label if isinstance(label, tuple) else (label,)
    file_segments = {(segment.layer, segment.value): segment for segment in segments}
    table_segments = {segment.value: segment for segment in table}
    present = []
    for layer, extents in enumerate(layers):
        for extent in extents:
            template = (
                table_segments.get(extent.value)
                or file_segments.get((layer, extent.value))
                or Segment(value=extent.value)
            )
            present.append((replace(template, layer=layer), extent))
    values = sorted({segment.value for segment, _ in present})
    are_unnamed = requested is None and not table and not segments and len(values) > MOST_UNNAMED
    if are_unnamed and not fill_regions():
        raise ParameterError(
            f"the volume holds {len(values)} values that change from voxel to voxel, as grey levels do, and not "
            "labels; give --threshold X or --otsu, without {label}, or --label N,M for those that are labels"
        )
    if not present:
        raise ParameterError("the volume holds no label, only 0; check that it is the right file")
    for value in requested or ():
        if value not in values:
            listed = list_some(values, MAX_LISTED_LABELS)
            raise ParameterError.about("label", f"is {value}, and the volume holds {listed}; give one that is there")
    used_names: set[str] = set()
    pieces = []
    for segment, extent in present:
        if requested is not None and segment.value not in requested:
            continue
        name = _unique_name(segment, used_names)
        used_names.add(name)
        pieces.append(LabelPiece(name=name, segment=segment, extent=extent))
    return pieces


def _unique_name(segment: Segment, used_names: set[str]) -> str:
    """Return the name of a label, made unique with its number, layer or a counter if the name is taken."""
    base = " ".join(segment.name.split()) or f"label_{segment.value}"
    candidates = (base, f"{base}_{segment.value}", f"{base}_{segment.value}_layer_{segment.layer}")
    unused = [name for name in candidates if name not in used_names]
    number = 2
    while not unused:
        unused = [name for name in [f"{base}_{number}"] if name not in used_names]
        number += 1
    return unused[0]


def absent_names(segments: Sequence[Segment], pieces: Sequence[LabelPiece]) -> list[str]:
    """Return the names of the segments that hold no cell."""
    present = {(piece.segment.layer, piece.segment.value) for piece in pieces}
    return [segment.name for segment in segments if (segment.layer, segment.value) not in present]


def box_of(
    piece: LabelPiece, request: SmoothRequest, shape: tuple[int, ...]
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the part of a volume of this shape in which a label is smoothed: from `low` up to but without `high`."""
    margin = field_reach(request.smoothing.interface)
    low = tuple(max(0, (at - margin) // size * size) for at, size in zip(piece.extent.low, BRICK, strict=True))
    high = tuple(
        min(count, -(-(at + margin) // size) * size)
        for at, size, count in zip(piece.extent.high, BRICK, shape, strict=True)
    )
    return low, high


def smooth_box(box: Volume, piece: LabelPiece, options: SmoothOptions) -> Result[SmoothStages, SmoothReport]:
    """Smooth one label in its part of the volume; one thread does what is small."""
    chosen: SmoothOptions = {**options, "threads": 1} if box.values.size < SMALL else options
    return smooth_volume(box, label=piece.segment.value, **chosen)


def split_outcomes(
    pieces: Sequence[LabelPiece], outcomes: Sequence[Outcome | InfillError | None], *, keep_going: bool
) -> tuple[dict[str, Outcome], dict[str, str]]:
    """Return the results of labels, by name, and why others failed.

    Raises
    ------
    InfillError
        The first of the outcomes unless `keep_going`, else the last if there is nothing else.
    """
    done: dict[str, Outcome] = {}
    failed: dict[str, str] = {}
    for piece, outcome in zip(pieces, outcomes, strict=True):
        if isinstance(outcome, InfillError):
            error = outcome.within(title_of(piece))
            if not keep_going:
                raise error from outcome
            failed[piece.name] = str(outcome)
            if len(failed) == len(pieces):
                raise type(outcome)(f"no label can be smoothed; {error}") from outcome
        elif outcome is not None:
            done[piece.name] = outcome
    return done, failed


def title_of(piece: LabelPiece) -> str:
    """Return the number of a label and its name, if it has one."""
    number = f"label {piece.segment.value}"
    return number if piece.name == f"label_{piece.segment.value}" else f"{number} ({piece.name})"


def labels_result(
    pieces: Sequence[LabelPiece],
    surfaces: Mapping[str, Surface],
    reports: Mapping[str, SmoothReport],
    failed: Mapping[str, str],
    absent: Sequence[str],
    request: SmoothRequest,
    clock: Clock,
) -> Result[LabelStages, LabelsReport]:
    """Return the result of labels that were smoothed each by itself."""
    smoothed_pieces, failed_pieces = (
        [piece for piece in pieces if piece.name in names] for names in (surfaces, failed)
    )
    return Result(
        surfaces=surfaces,
        report=_report(request, smoothed_pieces, reports, failed_pieces, failed, absent, clock),
        stages=LabelStages(segments={piece.name: piece.segment for piece in pieces}, failed=dict(failed)),
        colours={piece.name: piece.segment.colour for piece in smoothed_pieces if piece.segment.colour is not None},
    )


def _report(
    request: SmoothRequest,
    smoothed_pieces: Sequence[LabelPiece],
    reports: Mapping[str, SmoothReport],
    failed_pieces: Sequence[LabelPiece],
    failed: Mapping[str, str],
    absent: Sequence[str],
    clock: Clock,
) -> LabelsReport:
    """Return the report: totals over all labels, and the report of each."""
    label_reports = [reports[piece.name] for piece in smoothed_pieces]
    return {
        **report_head("labels"),
        "triangles": sum(part["triangles"] for part in label_reports),
        "closed": all(part["closed"] for part in label_reports),
        "problems": [
            f"{piece.name}: {problem}" for piece in smoothed_pieces for problem in reports[piece.name]["problems"]
        ],
        "request": request.facts(),
        "labels": [
            {
                **piece.place,
                "colour": None if piece.segment.colour is None else hex_colour(piece.segment.colour),
                "report": reports[piece.name],
            }
            for piece in smoothed_pieces
        ],
        "failed": [{**piece.place, "error": failed[piece.name]} for piece in failed_pieces],
        "absent": list(absent),
        "seconds": clock.timings(LabelSeconds),
    }
