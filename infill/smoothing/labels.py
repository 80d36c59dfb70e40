"""Smooth every label of a segmentation by itself, in the part of the volume where it lies."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Literal, Unpack, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from infill.errors import InfillError, UsageError
from infill.grid import spacing_of
from infill.imaging.label_tables import Segment
from infill.imaging.segmentations import Segmentation, read_segmentation, segmentation_of_shares
from infill.kernels.compiling import log_compilation
from infill.lazy.dask_arrays import is_dask
from infill.lazy.names import is_lazy
from infill.lazy.volume import TOGETHER_ADVICE
from infill.result import Clock, Result
from infill.smoothing.kept_reports import keep_report
from infill.smoothing.label_pieces import (
    absent_names,
    box_of,
    find_pieces,
    labels_result,
    refuse_shares,
    smooth_box,
    split_outcomes,
)
from infill.smoothing.label_runs import run_labels
from infill.smoothing.label_stages import LabelPiece, LabelStages
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.volume import AXES, Volume
from infill.voxels.cropping import cut_cells

if TYPE_CHECKING:
    from infill.reports.smoothing import LabelsReport, SmoothReport, TogetherReport
    from infill.result import Progress
    from infill.smoothing.together_stages import TogetherStages
    from infill.surface import Surface

    _Outcome = tuple[Surface, SmoothReport]


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
