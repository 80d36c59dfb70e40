"""Reports that are kept for many results, whose distances are measured when they are read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.components import data_bits
from infill.kernels.sparse import BRICK
from infill.reports.sections import with_late_sections
from infill.smoothing.comparing import distance_facts
from infill.smoothing.request import SmoothedInput, SmoothInput

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.reports.smoothing import Distance, SmoothReport
    from infill.result import Result
    from infill.smoothing.request import SmoothRequest
    from infill.smoothing.stages import SmoothStages
    from infill.surface import Surface
    from infill.volume import Volume


@dataclass(frozen=True, kw_only=True, eq=False)
class PackedSolid:
    """A solid on a grid, a bit for each cell near its surface, and what it takes to measure the distance from it.

    Parameters
    ----------
    field : SparseField
        Its values and data are empty.
    bits : (n, 64) uint16
        The solid cells of its bricks.
    place : Volume
        The grid in space; it holds no values.
    noise : float
    """

    field: SparseField
    bits: NDArray[np.uint16]
    place: Volume
    noise: float

    def distance(self, surface: Surface, request: SmoothRequest) -> Distance:
        """Measure the distances between a surface and the solid, for the report."""
        cells = (
            np.unpackbits(self.bits.astype("<u2").view(np.uint8), bitorder="little").astype(np.int8).reshape(-1, *BRICK)
        )
        cells *= 2
        cells -= 1
        smooth_input = SmoothInput(data=self.place, facts={"source": "volume", "noise": self.noise})
        field = replace(self.field, data=cells)
        return distance_facts(surface, SmoothedInput(smooth_input=smooth_input, request=request, field=field))


def keep_report(result: Result[SmoothStages, SmoothReport], request: SmoothRequest) -> SmoothReport:
    """Return the report of a scan without the field that it would hold until its distances are read.

    Instead, it holds a bit for every cell near the surface. Distances from thick slices, whose cells are grey, are
    measured at once.
    """
    known, solid = pack_report(result)
    return known if solid is None else late_report(known, partial(solid.distance, result.surface, request))


def pack_report(result: Result[SmoothStages, SmoothReport]) -> tuple[SmoothReport, PackedSolid | None]:
    """Return the report of a scan without its distances, and the solid from which to measure them.

    Distances from thick slices, whose cells are grey, are measured at once; no solid is needed then.
    """
    report, field = result.report, result.stages.levelled.field
    if field.data.dtype != np.int8:
        return report.copy(), None
    data = result.stages.data
    solid = PackedSolid(
        field=replace(field, where=field.where.copy(), values=field.values[:0].copy(), data=field.data[:0].copy()),
        bits=data_bits(field, threads=1),
        place=replace(data, values=np.broadcast_to(np.False_, data.values.shape)),
        noise=report["input"]["noise"],
    )
    sections: Mapping[str, Any] = report
    known = {name: None if name == "distance" else sections[name] for name in sections}
    return cast("SmoothReport", known), solid


def late_report(known: SmoothReport, measure: Callable[[], Distance]) -> SmoothReport:
    """Return a report of `pack_report` whose distances are measured when they are first read."""
    return with_late_sections(known, distance=measure)
