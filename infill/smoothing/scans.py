"""Strategies for a scan: the values to keep, the method, and remedies if that loses something."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.schedule import MIN_STEPS
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.placing import raw_surface
from infill.smoothing.remedies import Strategy, fewer_steps
from infill.smoothing.request import AUTO, SmoothInput, SmoothRequest
from infill.volume import Volume
from infill.voxels.coarsening import coarsen
from infill.voxels.noise import NOISY, noise_share
from infill.voxels.segmentation import count_solid_cells
from infill.voxels.segmentation import scale_grey_values as grey_levels
from infill.voxels.segmentation import segment_volume as segment
from infill.voxels.slices import interpolate_slices, plan_sublayers

Threshold = float | tuple[float | None, float | None] | Literal["otsu"] | None

SAMPLED_LAYERS = 16  # sampled for grey values
SPECK_CELLS = 27  # cells: specks up to this size are taken out of noisy data


def volume_strategies(
    scan: Volume,
    request: SmoothRequest,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool = False,
    voxel: float | None = None,
) -> Iterator[Strategy]:
    """Return the strategies for the solid in a volume, the preferred one first.

    Parameters
    ----------
    scan : Volume
    request : SmoothRequest
    threshold, label, grey, voxel
        See `infill.smooth_volume`.
    """
    low, high = threshold_range(threshold)
    solid, used = segment(scan, low=low, high=high, label=label, otsu=isinstance(threshold, str))
    phase = used["method"] == "phase"
    if voxel is not None:
        if phase or used["method"] in ("range", "otsu"):
            scan = coarsen(scan, voxel)
            solid, _ = segment(scan, low=used["low"], high=used.get("high"))
        else:  # a mask: the solid share of a larger voxel gives the place of the surface in it
            scan = coarsen(replace(solid, values=np.asarray(solid.values) > 0), voxel)
            scan, phase = replace(scan, values=2 * np.asarray(scan.values) - 1), True
            solid = replace(scan, values=np.asarray(scan.values) > 0)
        if not np.asarray(solid.values).any():
            raise ParameterError(f"voxel is {voxel:g} mm, and nothing of the solid fills half of one; give less")
    facts = {
        "source": "volume",
        "segmentation": used,
        "coarse": voxel is not None,
        "warnings": list(scan.warnings),
    }
    return scan_strategies(scan, solid, used, facts, request, grey=grey, phase=phase)


def threshold_range(threshold: Threshold) -> tuple[float | None, float | None]:
    """Return the lowest and highest value of solid cells; both None if Otsu's method is to find them.

    >>> threshold_range(226), threshold_range((None, 900.0)), threshold_range("otsu")
    ((226.0, None), (None, 900.0), (None, None))
    """
    if isinstance(threshold, str):
        if threshold != "otsu":
            raise ParameterError(f"there is no threshold {threshold!r}; give a number, two for a range, or otsu")
        return None, None
    low, high = threshold if isinstance(threshold, tuple) else (threshold, None)
    return None if low is None else float(low), high


def scan_strategies(
    scan: Volume,
    solid: Volume,
    used: Mapping[str, Any],
    facts: Mapping[str, Any],
    request: SmoothRequest,
    *,
    grey: bool,
    phase: bool,
    volume: float | None = None,
) -> Iterator[Strategy]:
    """Yield the strategies for a scan, the preferred one first.

    Parameters
    ----------
    scan, solid : Volume
        The values, and the mask of solid cells.
    used : mapping
        How the solid was determined: see `infill.voxels.segmentation.segment_volume`.
    facts : mapping
        For the report.
    request : SmoothRequest
    grey : bool
        Whether grey levels are requested.
    phase : bool
        Whether the values are a phase field, which is smoothed as it is.
    volume : float, optional
        Of the solid, mm³, if that is known better than by the values.

    Raises
    ------
    ParameterError
        If grey levels are requested without a threshold.
    """
    level = used.get("low") if used.get("high") is None else None
    if (grey or request.method == "grey") and level is None:
        raise ParameterError("grey levels are kept around one threshold; give one, or otsu")
    noise = noise_share(np.asarray(solid.values), threads=request.threads)
    facts = {**facts, "noise": noise}
    method, despeckle, paper = request.method, request.despeckle, False
    if method == AUTO:
        keeps_grey = level is not None and not phase and _has_grey_values(np.asarray(scan.values), used["values"])
        paper = request.level != "volume" or request.smoothing.steps < MIN_STEPS
        method = "plain" if noise > NOISY or paper else "grey" if grey or keeps_grey else "refine"
        despeckle = despeckle or (SPECK_CELLS * scan.cell_volume if noise > NOISY and not paper else 0.0)
    axis, count = plan_sublayers(solid)
    data = scan if phase else solid
    if (grey or method == "grey") and not phase:
        data = grey_levels(scan, float(used["low"]))
    smooth_input = _scan_input(data, solid, {**facts, "grey": grey or method == "grey"}, axis=axis, count=count)
    smooth_input = smooth_input if volume is None else replace(smooth_input, volume=volume)
    base_request = replace(request, method=method, refine=None, despeckle=despeckle)
    yield Strategy(name=method, make=partial(_pass_through, smooth_input, base_request))
    if request.method == AUTO and method == "plain" and not paper:
        refined_request = replace(base_request, method="refine")
        yield Strategy(name="refine", make=partial(_pass_through, smooth_input, refined_request), cost=2)
    for steps in fewer_steps(base_request):
        fewer = replace(base_request, smoothing=replace(base_request.smoothing, steps=steps), radius=None)
        yield Strategy(name=f"{method}, {steps} steps", make=partial(_pass_through, smooth_input, fewer))
    if request.method == AUTO and method != "plain":
        plain = replace(base_request, method="plain")
        yield Strategy(name="plain", make=partial(_pass_through, smooth_input, plain), cost=0.5)


def _pass_through(smooth_input: SmoothInput, request: SmoothRequest) -> tuple[SmoothInput, SmoothRequest]:
    """Return both arguments: `make` of a strategy that needs no other data."""
    return smooth_input, request


def _has_grey_values(values: NDArray[Any], ends: list[float]) -> bool:
    """Tell whether sampled layers have values between the lowest and the highest: those of a mask have none."""
    sampled_layers = values[:: max(1, len(values) // SAMPLED_LAYERS)]
    return bool(((sampled_layers > ends[0]) & (sampled_layers < ends[1])).any())


def _scan_input(data: Volume, solid: Volume, facts: Mapping[str, Any], *, axis: int, count: int) -> SmoothInput:
    """Return the input of a scan; thick slices are interpolated."""
    facts = {**facts, "slices": count}
    if count == 1:
        return SmoothInput(data=data, facts=facts)
    mask = smooth_bricks(solid.values, Smoothing(steps=0))
    return SmoothInput(
        data=interpolate_slices(data, axis, count),
        facts=facts,
        raw=raw_surface(mask, solid, None),
        volume=None if data is not solid else count_solid_cells(np.asarray(solid.values)) * solid.cell_volume,
        cell=float(solid.cell_size.max()),
    )
