"""Every label of a segmentation as a surface of its own, each smoothed in the part of the volume where it lies."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Unpack, cast

import numpy as np
from numpy.typing import ArrayLike

from infill.errors import InfillError, ParameterError
from infill.formats.parts import hexadecimal
from infill.grid import spacing_of
from infill.imaging.label_tables import Segment
from infill.imaging.segmentations import Segmentation
from infill.kernels.sparse import BRICK
from infill.report import FORM
from infill.result import Clock, Result, told_between
from infill.smoothing.request import Options, Request
from infill.smoothing.solids import smooth_volume
from infill.version import __version__
from infill.volume import AXES, Volume
from infill.voxels.cropping import part
from infill.voxels.labels import Extent, extents

if TYPE_CHECKING:
    from PIL import Image

    from infill.report_keys import LabelsReport, SmoothReport
    from infill.smoothing.stages import SmoothStages
    from infill.surface import Surface

# Cells around a label in which phi is not yet void to the last bit: 12 of them with the usual interface of 2 cells, a
# fraction of the interface for others; and 8 more, for averages that refining takes.
REACH, MORE = 6, 8
LISTED = 12  # labels in a message
SMALL = 2**20  # cells of a box: one thread does it before others have begun


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelStages:
    """What the surfaces of `infill.smooth_labels` came from.

    Parameters
    ----------
    segments : mapping of str to Segment
        The label that each surface, by its name, was made from.
    failed : mapping of str to str
        Why a label has no surface, by its name.
    """

    segments: Mapping[str, Segment]
    failed: Mapping[str, str] = field(default_factory=dict)

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return all labels as one picture."""
        from infill.pictures.sheet import mesh_panel, sheet

        caption = f"{len(report['labels'])} labels, {report['triangles']:,} triangles"
        return sheet({caption: mesh_panel(surface)}, "")


@dataclass(frozen=True, kw_only=True)
class _Piece:
    """One label to smooth: what it is called, what it is, and where it lies."""

    name: str
    segment: Segment
    extent: Extent

    @property
    def cells(self) -> int:
        """Cells of the box in which it lies."""
        return math.prod(high - low for low, high in zip(self.extent.low, self.extent.high, strict=True))


def smooth_labels(
    volume: ArrayLike | Volume | Segmentation,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    keep_going: bool = False,
    **options: Unpack[Options],
) -> Result[LabelStages, LabelsReport]:
    """Return a smooth surface around every label of a segmentation.

    Parameters
    ----------
    volume : (nx, ny, nz) array, Volume or Segmentation
        Whole numbers [x, y, z], 0 where no label is.
    spacing, origin
        See `infill.smooth_volume`; only for an array.
    label : int or tuple of int, optional
        Only these, instead of every value but 0.
    table : iterable of Segment
        Names and colours, in the place of those of the segmentation: see `infill.read_labels`.
    keep_going : bool
        Leave out a label that cannot be smoothed, and say so in the report, instead of raising.
    **options
        See `infill.smooth_volume`.

    Returns
    -------
    Result
        A surface for each label, by its name, in the order of layers and numbers; `label_7` where it has no name.
        `save` writes all of them into one .3mf or .glb. docs/report.md lists the keys of the report.

    Raises
    ------
    ParameterError
        If there is no label, or not the one asked for; or as `infill.smooth_volume`.
    GeometryError, MemoryLimitError
        As `infill.smooth_volume`, with the name of the label.

    Notes
    -----
    Each label is smoothed in the smallest part of the volume around which nothing else has an effect: the surface is
    that of the whole volume, and many small labels take little more than their own share of time and memory.

    >>> balls = np.zeros((60, 24, 24), int)
    >>> for n in range(2):
    ...     at = np.reshape((15 + 30 * n, 12, 12), (3, 1, 1, 1))
    ...     balls[((np.indices(balls.shape) - at) ** 2).sum(axis=0) < 64] = n + 1
    >>> {name: surface.closed for name, surface in smooth_labels(balls).surfaces.items()}
    {'label_1': True, 'label_2': True}
    """
    request = Request(**options)  # so that a mistake in the options is not one of the first label
    segmentation = _segmentation(volume, spacing, origin)
    clock = Clock(request.progress)
    with clock.stage("labels", 0.0):
        pieces = _pieces(segmentation, label, tuple(table))
        absent = _absent(segmentation, pieces) if label is None else []
    surfaces: dict[str, Surface] = {}
    reports: dict[str, SmoothReport] = {}
    failed: dict[str, str] = {}
    with clock.stage("smooth", 0.0):
        shares = np.cumsum([0, *(piece.cells for piece in pieces)]) / sum(piece.cells for piece in pieces)
        for piece, begin, end in zip(pieces, shares[:-1], shares[1:], strict=True):
            told: Options = {**options, "progress": told_between(request.progress, float(begin), float(end))}
            try:
                result = _smoothed(segmentation.layers[piece.segment.layer], piece, request, told)
            except InfillError as error:
                said = f"{_called(piece)}: {error}"
                if not keep_going:
                    raise type(error)(said) from error
                failed[piece.name] = str(error)
                if len(failed) == len(pieces):
                    raise type(error)(f"no label can be smoothed; {said}") from error
                continue
            surfaces[piece.name] = result.surface
            # Whole by now: what is measured later would hold on to the field of every one.
            reports[piece.name] = result.report.copy()
    done, broken = ([piece for piece in pieces if piece.name in some] for some in (surfaces, failed))
    return Result(
        surfaces=surfaces,
        report=_report(request, done, reports, broken, failed, absent, clock),
        stages=LabelStages(segments={piece.name: piece.segment for piece in pieces}, failed=failed),
        colours={piece.name: piece.segment.colour for piece in done if piece.segment.colour is not None},
    )


def _segmentation(
    volume: ArrayLike | Volume | Segmentation, spacing: float | tuple[float, ...], origin: tuple[float, ...]
) -> Segmentation:
    if isinstance(volume, Segmentation):
        return volume
    if not isinstance(volume, Volume):
        volume = Volume(values=np.asarray(volume), spacing=spacing_of(spacing, AXES), origin=origin)
    return Segmentation(layers=(volume,))


def _pieces(
    segmentation: Segmentation, label: int | tuple[int, ...] | None, table: tuple[Segment, ...]
) -> list[_Piece]:
    """Return the labels to smooth, each with a name of its own."""
    wanted = None if label is None else label if isinstance(label, tuple) else (label,)
    known = {(each.layer, each.value): each for each in segmentation.segments}
    given = {each.value: each for each in table}
    found = []
    for layer, volume in enumerate(segmentation.layers):
        for each in extents(volume):
            named = given.get(each.value) or known.get((layer, each.value)) or Segment(value=each.value)
            found.append((replace(named, layer=layer), each))
    there = sorted({segment.value for segment, _ in found})
    if not found:
        raise ParameterError("the volume holds no label, only 0; check that it is the right file")
    for value in wanted or ():
        if value not in there:
            listed = ", ".join(map(str, there[:LISTED])) + (", …" if len(there) > LISTED else "")
            raise ParameterError(f"label is {value}, and the volume holds {listed}; give one that is there")
    taken: set[str] = set()
    pieces = []
    for segment, extent in found:
        if wanted is not None and segment.value not in wanted:
            continue
        name = _name_beside(segment, taken)
        taken.add(name)
        pieces.append(_Piece(name=name, segment=segment, extent=extent))
    return pieces


def _name_beside(segment: Segment, taken: set[str]) -> str:
    """Return the name of a label, with its number or more where another one has that name."""
    plain = " ".join(segment.name.split()) or f"label_{segment.value}"
    candidates = (plain, f"{plain}_{segment.value}", f"{plain}_{segment.value}_layer_{segment.layer}")
    free = [each for each in candidates if each not in taken]
    number = 2
    while not free:
        free = [each for each in [f"{plain}_{number}"] if each not in taken]
        number += 1
    return free[0]


def _absent(segmentation: Segmentation, pieces: Sequence[_Piece]) -> list[str]:
    """Return the names of the segments that hold no cell."""
    there = {(piece.segment.layer, piece.segment.value) for piece in pieces}
    return [each.name for each in segmentation.segments if (each.layer, each.value) not in there]


def _smoothed(volume: Volume, piece: _Piece, request: Request, options: Options) -> Result[SmoothStages, SmoothReport]:
    """Return one label, smoothed in its part of the volume, which begins and ends where bricks of the whole do."""
    margin = math.ceil(REACH * request.smoothing.interface) + MORE
    low = tuple(max(0, (at - margin) // size * size) for at, size in zip(piece.extent.low, BRICK, strict=True))
    high = tuple(
        min(count, -(-(at + margin) // size) * size)
        for at, size, count in zip(piece.extent.high, BRICK, volume.values.shape, strict=True)
    )
    box = part(volume, low, high)
    chosen: Options = {**options, "threads": 1} if box.values.size < SMALL else options
    return smooth_volume(box, label=piece.segment.value, **chosen)


def _called(piece: _Piece) -> str:
    number = f"label {piece.segment.value}"
    return number if piece.name == f"label_{piece.segment.value}" else f"{number} ({piece.name})"


def _report(
    request: Request,
    done: Sequence[_Piece],
    reports: Mapping[str, SmoothReport],
    broken: Sequence[_Piece],
    failed: Mapping[str, str],
    absent: Sequence[str],
    clock: Clock,
) -> LabelsReport:
    """Return the report: what there is to say of all labels, and the report of each."""

    def described(piece: _Piece) -> dict[str, Any]:
        segment = piece.segment
        return {"name": piece.name, "number": segment.value, "layer": segment.layer}

    every = [reports[piece.name] for piece in done]
    report = {
        "form": FORM,
        "version": __version__,
        "product": "labels",
        "triangles": sum(each["triangles"] for each in every),
        "closed": all(each["closed"] for each in every),
        "problems": [f"{piece.name}: {each}" for piece in done for each in reports[piece.name]["problems"]],
        "request": request.facts(),
        "labels": [
            {
                **described(piece),
                "colour": None if piece.segment.colour is None else hexadecimal(piece.segment.colour),
                "report": reports[piece.name],
            }
            for piece in done
        ],
        "failed": [{**described(piece), "error": failed[piece.name]} for piece in broken],
        "absent": list(absent),
        "seconds": {**clock.seconds, "total": sum(clock.seconds.values())},
    }
    return cast("LabelsReport", report)
