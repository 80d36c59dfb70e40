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
from infill.phasefield.schedule import FEWEST
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.placing import raw_surface
from infill.smoothing.remedies import Way, fewer_steps
from infill.smoothing.request import AUTO, Given, Request
from infill.volume import Volume
from infill.voxels.coarsening import coarser
from infill.voxels.noise import NOISY, noise_share
from infill.voxels.segmentation import grey as grey_levels
from infill.voxels.segmentation import solid_cells
from infill.voxels.segmentation import threshold as segment
from infill.voxels.slices import interpolated, layers_between

Threshold = float | tuple[float | None, float | None] | Literal["otsu"] | None

LAYERS = 16  # sampled for grey values
SPECK = 27  # cells: specks up to this size are taken out of noisy data


def ways_of_volume(
    scan: Volume,
    request: Request,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool = False,
    voxel: float | None = None,
) -> Iterator[Way]:
    """Return the strategies for the solid in a volume, the preferred one first.

    Parameters
    ----------
    scan : Volume
    request : Request
    threshold, label, grey, voxel
        See `infill.smooth_volume`.
    """
    low, high = range_of(threshold)
    solid, used = segment(scan, low=low, high=high, label=label, otsu=isinstance(threshold, str))
    phase = used["method"] == "phase"
    if voxel is not None:
        if phase or used["method"] in ("range", "otsu"):
            scan = coarser(scan, voxel)
            solid, _ = segment(scan, low=used["low"], high=used.get("high"))
        else:  # a mask: the solid share of a larger voxel gives the place of the surface in it
            scan = coarser(replace(solid, values=np.asarray(solid.values) > 0), voxel)
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
    return ways_of_scan(scan, solid, used, facts, request, grey=grey, phase=phase)


def range_of(threshold: Threshold) -> tuple[float | None, float | None]:
    """Return the lowest and highest value of solid cells; both None if Otsu's method is to find them.

    >>> range_of(226), range_of((None, 900.0)), range_of("otsu")
    ((226.0, None), (None, 900.0), (None, None))
    """
    if isinstance(threshold, str):
        if threshold != "otsu":
            raise ParameterError(f"there is no threshold {threshold!r}; give a number, two for a range, or otsu")
        return None, None
    low, high = threshold if isinstance(threshold, tuple) else (threshold, None)
    return None if low is None else float(low), high


def ways_of_scan(
    scan: Volume,
    solid: Volume,
    used: Mapping[str, Any],
    facts: Mapping[str, Any],
    request: Request,
    *,
    grey: bool,
    phase: bool,
    volume: float | None = None,
) -> Iterator[Way]:
    """Yield the strategies for a scan, the preferred one first.

    Parameters
    ----------
    scan, solid : Volume
        The values, and the mask of solid cells.
    used : mapping
        How the solid was determined: see `infill.voxels.segmentation.threshold`.
    facts : mapping
        For the report.
    request : Request
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
        paper = request.level != "volume" or request.smoothing.steps < FEWEST
        method = "plain" if noise > NOISY or paper else "grey" if grey or keeps_grey else "refine"
        despeckle = despeckle or (SPECK * scan.cell_volume if noise > NOISY and not paper else 0.0)
    axis, count = layers_between(solid)
    data = scan if phase else solid
    if (grey or method == "grey") and not phase:
        data = grey_levels(scan, float(used["low"]))
    smooth_input = _scan_input(data, solid, {**facts, "grey": grey or method == "grey"}, axis=axis, count=count)
    smooth_input = smooth_input if volume is None else replace(smooth_input, volume=volume)
    base_request = replace(request, method=method, refine=None, despeckle=despeckle)
    yield Way(name=method, make=partial(_pass_through, smooth_input, base_request))
    if request.method == AUTO and method == "plain" and not paper:
        refined_request = replace(base_request, method="refine")
        yield Way(name="refine", make=partial(_pass_through, smooth_input, refined_request), cost=2)
    for steps in fewer_steps(base_request):
        fewer = replace(base_request, smoothing=replace(base_request.smoothing, steps=steps), radius=None)
        yield Way(name=f"{method}, {steps} steps", make=partial(_pass_through, smooth_input, fewer))
    if request.method == AUTO and method != "plain":
        plain = replace(base_request, method="plain")
        yield Way(name="plain", make=partial(_pass_through, smooth_input, plain), cost=0.5)


def _pass_through(smooth_input: Given, request: Request) -> tuple[Given, Request]:
    """Return both arguments: `make` of a strategy that needs no other data."""
    return smooth_input, request


def _has_grey_values(values: NDArray[Any], ends: list[float]) -> bool:
    """Tell whether sampled layers have values between the lowest and the highest: those of a mask have none."""
    sampled_layers = values[:: max(1, len(values) // LAYERS)]
    return bool(((sampled_layers > ends[0]) & (sampled_layers < ends[1])).any())


def _scan_input(data: Volume, solid: Volume, facts: Mapping[str, Any], *, axis: int, count: int) -> Given:
    """Return the input of a scan; thick slices are interpolated."""
    facts = {**facts, "slices": count}
    if count == 1:
        return Given(data=data, facts=facts)
    mask = smooth_bricks(solid.values, Smoothing(steps=0))
    return Given(
        data=interpolated(data, axis, count),
        facts=facts,
        raw=raw_surface(mask, solid, None),
        volume=None if data is not solid else solid_cells(np.asarray(solid.values)) * solid.cell_volume,
        cell=float(solid.cell_size.max()),
    )
