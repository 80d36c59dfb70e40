"""Smooth every label of a segmentation by itself, in the part of the volume where it lies."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, TypeVar, Unpack, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from infill.errors import InfillError, ParameterError, UsageError
from infill.formats.parts import hex_colour
from infill.grid import spacing_of
from infill.imaging.label_tables import Segment
from infill.imaging.segmentations import Segmentation, read_segmentation, segmentation_of_shares
from infill.kernels.compiling import log_compilation
from infill.kernels.sparse import BRICK
from infill.lazy.dask_arrays import is_dask
from infill.lazy.names import is_lazy
from infill.lazy.volume import TOGETHER_ADVICE
from infill.plain_numbers import list_some
from infill.reports.common import report_head
from infill.reports.smoothing import LabelSeconds
from infill.result import Clock, Result
from infill.smoothing.job import smooth_volume
from infill.smoothing.kept_reports import keep_report
from infill.smoothing.label_runs import run_labels
from infill.smoothing.label_stages import LabelPiece, LabelStages, field_reach
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.volume import AXES, Volume
from infill.voxels.cropping import cut_cells
from infill.voxels.labels import LabelExtent, is_label_map, label_extents

if TYPE_CHECKING:
    from infill.reports.smoothing import LabelsReport, SmoothReport, TogetherReport
    from infill.result import Progress
    from infill.smoothing.stages import SmoothStages
    from infill.smoothing.together_stages import TogetherStages
    from infill.surface import Surface

    _Outcome = tuple[Surface, SmoothReport]

Outcome = TypeVar("Outcome")

MOST_UNNAMED = 64  # values without names that are taken for labels even if they do not fill regions
MAX_LISTED_LABELS = 12  # labels in a message
SMALL = 2**20  # cells of a box: one thread does it before others have begun


@overload
def smooth_labels(
    volume: ArrayLike | Volume | Segmentation | str | os.PathLike[str],
    *,
    spacing: float | tuple[float, ...] | None = None,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    keep_going: bool = False,
    together: Literal[False] = False,
    **options: Unpack[SmoothOptions],
) -> Result[LabelStages, LabelsReport]: ...
@overload
def smooth_labels(
    volume: ArrayLike | Volume | Segmentation | str | os.PathLike[str],
    *,
    spacing: float | tuple[float, ...] | None = None,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    keep_going: bool = False,
    together: Literal[True],
    **options: Unpack[SmoothOptions],
) -> Result[TogetherStages, TogetherReport]: ...
@log_compilation("the smoother")
def smooth_labels(
    volume: ArrayLike | Volume | Segmentation | str | os.PathLike[str],
    *,
    spacing: float | tuple[float, ...] | None = None,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    keep_going: bool = False,
    together: bool = False,
    **options: Unpack[SmoothOptions],
) -> Result[LabelStages, LabelsReport] | Result[TogetherStages, TogetherReport]:
    """Smooth every label of a segmentation; return one surface for each.

    Parameters
    ----------
    volume : (nx, ny, nz) array, Volume, Segmentation or path
        A file or folder of labels, see `infill.read_segmentation`; or whole numbers [x, y, z], 0 for cells without a
        label; or, with `together`, the share of every cell that each label has, [label, x, y, z]: partial volumes, or
        probabilities of a network. See `infill.imaging.segmentations.segmentation_of_shares`. Of a Dask array, or a
        path of Zarr or HDF5, each label is read by itself (`infill.smoothing.lazy_labels`); with `together`, a Dask
        array is smoothed in chunks, without simplification (`infill.smoothing.together_chunks`), a file is read whole.
    spacing, origin
        See `infill.smooth_volume`.
    label : int or tuple of int, optional
        Only these, instead of every value but 0.
    table : iterable of Segment
        Names and colours, instead of those of the segmentation: see `infill.read_labels`.
    keep_going : bool
        Leave out a label that cannot be smoothed, and say so in the report, instead of raising.
    together : bool
        Smooth the labels as one partition: neighbours share their walls, with the same triangles and coordinates, and
        every label of 8 cells or more keeps its volume. Not simplified; the report is
        `infill.reports.smoothing.TogetherReport`.
    **options
        See `infill.smooth_volume`.

    Returns
    -------
    Result
        A surface for each label, by its name, in the order of layers and numbers; `label_7` where it has no name.
        `save` writes all of them into one .3mf or .glb; labels together also into one .ply or .vtp, with every wall
        once, and as tetrahedra into a .vtu. docs/report.md lists the keys of the report.

    Raises
    ------
    ParameterError
        If there is no label, or the requested one is missing; or as `infill.smooth_volume`.
    GeometryError, MemoryLimitError
        As `infill.smooth_volume`, with the name of the label.

    Notes
    -----
    Each label is smoothed in the smallest part of the volume beyond which nothing has an effect: the surface equals
    that of the whole volume, and many small labels take little more than their own share of time and memory. Labels
    are smoothed at the same time, one on each thread; those too large for that come first, one by one.

    >>> balls = np.zeros((60, 24, 24), int)
    >>> for n in range(2):
    ...     at = np.reshape((15 + 30 * n, 12, 12), (3, 1, 1, 1))
    ...     balls[((np.indices(balls.shape) - at) ** 2).sum(axis=0) < 64] = n + 1
    >>> {name: surface.closed for name, surface in smooth_labels(balls).surfaces.items()}
    {'label_1': True, 'label_2': True}
    """
    request = SmoothRequest(**options)  # so that a mistake in the options is not reported for the first label
    if is_dask(volume) or (isinstance(volume, (str, os.PathLike)) and is_lazy(volume)):
        from infill.smoothing.chunked_result import open_lazy
        from infill.smoothing.lazy_labels import smooth_lazy_labels
        from infill.smoothing.together_chunks import smooth_together_in_chunks

        lazy = open_lazy(volume, spacing=spacing, origin=origin)
        if not together:
            return smooth_lazy_labels(lazy, label=label, table=table, keep_going=keep_going, **options)
        if is_dask(volume):
            _refuse_going_on(keep_going)
            parted: Any = smooth_together_in_chunks(lazy, label=label, table=table, **options)
            return cast("Result[TogetherStages, TogetherReport]", parted)
        volume = lazy.load(advice=TOGETHER_ADVICE)
    if isinstance(volume, (str, os.PathLike)):
        segmentation = read_segmentation(volume, spacing=spacing)
    else:
        segmentation = _as_segmentation(volume, 1.0 if spacing is None else spacing, origin)
    clock = Clock(request.progress)
    with clock.stage("labels", 0.0):
        pieces = find_pieces(segmentation, label, tuple(table))
        absent = absent_names(segmentation.segments, pieces) if label is None else []
    if not together:
        refuse_shares(segmentation)
    else:
        _refuse_going_on(keep_going)
        from infill.smoothing.together import smooth_together

        volume = segmentation.layers[pieces[0].segment.layer]
        return smooth_together(volume, pieces, request, absent, segmentation.shares)
    with clock.stage("smooth", 0.0):
        outcomes = _smooth_pieces(segmentation, pieces, request, options, keep_going)
        done, failed = split_outcomes(pieces, outcomes, keep_going=keep_going)
    surfaces = {name: surface for name, (surface, _) in done.items()}
    reports = {name: report for name, (_, report) in done.items()}
    return labels_result(pieces, surfaces, reports, failed, absent, request, clock)


def split_outcomes(
    pieces: Sequence[LabelPiece], outcomes: Sequence[Outcome | InfillError | None], *, keep_going: bool
) -> tuple[dict[str, Outcome], dict[str, str]]:
    """Return what was made of labels, by name, and why others failed.

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


def _as_segmentation(
    volume: ArrayLike | Volume | Segmentation, spacing: float | tuple[float, ...], origin: tuple[float, ...]
) -> Segmentation:
    """Return a segmentation of an array, a volume or a segmentation."""
    if isinstance(volume, Segmentation):
        return volume
    if not isinstance(volume, Volume) and np.ndim(volume) == AXES + 1:
        return segmentation_of_shares(np.asarray(volume), spacing=spacing, origin=origin)
    if not isinstance(volume, Volume):
        volume = Volume(values=np.asarray(volume), spacing=spacing_of(spacing, AXES), origin=origin)
    return Segmentation(layers=(volume,))


def _refuse_going_on(keep_going: bool) -> None:
    """Raise UsageError if labels together should go on without one of them."""
    if keep_going:
        raise UsageError.about("keep_going", "does not go with labels together; leave it out")


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


def _smooth_pieces(
    segmentation: Segmentation,
    pieces: Sequence[LabelPiece],
    request: SmoothRequest,
    options: SmoothOptions,
    keep_going: bool,
) -> list[_Outcome | InfillError | None]:
    """Smooth all labels; return the surface and the report of each, or its error; None after an error that ends all."""

    def smooth_one(number: int, threads: int, progress: Progress | None) -> _Outcome | InfillError:
        """Smooth a label; return its error instead if there is one."""
        piece = pieces[number]
        label_options: SmoothOptions = {**options, "threads": threads, "progress": progress}
        try:
            return _smooth_piece(segmentation.layers[piece.segment.layer], piece, request, label_options)
        except InfillError as error:
            return error

    return run_labels(
        smooth_one,
        [piece.work(request) for piece in pieces],
        stop_early=not keep_going,
        threads=request.threads,
        max_memory=request.max_memory,
        progress=request.progress,
    )


def _smooth_piece(volume: Volume, piece: LabelPiece, request: SmoothRequest, options: SmoothOptions) -> _Outcome:
    """Smooth one label in its part of the volume, whose sides lie between bricks of the whole volume."""
    box = cut_cells(volume, *box_of(piece, request, volume.values.shape))
    result = smooth_box(box, piece, options)
    return result.surface, keep_report(result, request)


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


def title_of(piece: LabelPiece) -> str:
    """Return the number of a label and its name, if it has one."""
    number = f"label {piece.segment.value}"
    return number if piece.name == f"label_{piece.segment.value}" else f"{number} ({piece.name})"


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
