"""The result of a volume in chunks in memory, for Python: its surface, its report, and the volume."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from infill.errors import ParameterError
from infill.grid import spacing_of
from infill.lazy.dask_arrays import DaskArray, is_dask, require_readable_anywhere
from infill.lazy.opening import open_volume
from infill.lazy.volume import LazyVolume, require_volume
from infill.result import Result
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import Threshold
from infill.surface import Surface
from infill.volume import AXES

if TYPE_CHECKING:
    from PIL import Image

    from infill.reports.smoothing import SmoothReport
    from infill.smoothing.stages import SmoothStages


@dataclass(frozen=True, kw_only=True, eq=False)
class ChunkedStages:
    """The volume that was smoothed in chunks.

    Parameters
    ----------
    volume : LazyVolume
    """

    volume: LazyVolume

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:  # noqa: ARG002 - as all stages
        """Raise ParameterError: the voxels of before are not in memory."""
        raise ParameterError("a volume in chunks has no picture of before and after; give a part of it as an array")


def open_lazy(
    volume: object, *, spacing: float | tuple[float, ...] | None, origin: tuple[float, ...] = (0.0, 0.0, 0.0)
) -> LazyVolume:
    """Return a Dask array, or the volume of a path, without reading it.

    Parameters
    ----------
    volume : dask.array.Array or path
    spacing, origin
        See `infill.smooth_volume`.
    """
    if not is_dask(volume):
        return open_volume(cast("str | os.PathLike[str]", volume), spacing=spacing)
    require_readable_anywhere(volume)
    array = DaskArray(volume)
    require_volume("the array", array.shape, array.dtype)
    sizes = spacing_of(1.0 if spacing is None else spacing, AXES)
    return LazyVolume(array=array, spacing=sizes, origin=tuple(float(x) for x in origin))


def smooth_lazy(
    volume: LazyVolume,
    request: SmoothRequest,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool | None = None,
    side: int | None = None,
    resume: str | os.PathLike[str] | None = None,
) -> Result[SmoothStages, SmoothReport]:
    """Smooth a volume in chunks, on the current client of Dask or else on threads; return its surface in memory.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
    threshold, label, grey, side, resume
        See `infill.smoothing.chunked.smooth_in_chunks`.

    Returns
    -------
    Result
        Its report is a `infill.reports.smoothing.ChunksReport`: distances are not measured.
    """
    with smooth_in_chunks(
        volume, request, threshold=threshold, label=label, grey=grey, side=side, resume=resume
    ) as chunked:
        surface = chunked.whole()
        report = chunked.report()
    result: Any = Result(surfaces={"solid": surface}, report=report, stages=ChunkedStages(volume=volume))
    return cast("Result[SmoothStages, SmoothReport]", result)
