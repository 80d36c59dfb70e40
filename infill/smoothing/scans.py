"""How to smooth a scan: which of its values to keep, by which method, and what to try if that loses something."""

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

LAYERS = 16  # that are looked at for grey values
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
    """Return the ways to smooth what is solid in a volume, the right one first.

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
        else:  # a mask: what share of a larger voxel is solid tells where in it the surface lies
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
    """Return from which value on, and up to which, cells are solid; both None where Otsu's method is to find it.

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
    """Yield the ways to smooth a scan, the right one first.

    Parameters
    ----------
    scan, solid : Volume
        Its values, and which cells are solid.
    used : mapping
        How that was told: see `infill.voxels.segmentation.threshold`.
    facts : mapping
        For the report.
    request : Request
    grey : bool
        Whether grey levels were asked for.
    phase : bool
        Whether the values are a phase field, which is smoothed as it is.
    volume : float, optional
        Of the solid, mm³, if that is known better than by the values.

    Raises
    ------
    ParameterError
        If grey levels were asked for and there is no threshold.
    """
    level = used.get("low") if used.get("high") is None else None
    if (grey or request.method == "grey") and level is None:
        raise ParameterError("grey levels are kept around one threshold; give one, or otsu")
    noise = noise_share(np.asarray(solid.values), threads=request.threads)
    facts = {**facts, "noise": noise}
    method, despeckle, paper = request.method, request.despeckle, False
    if method == AUTO:
        kept = level is not None and not phase and _shaded(np.asarray(scan.values), used["values"])
        paper = request.level != "volume" or request.smoothing.steps < FEWEST
        method = "plain" if noise > NOISY or paper else "grey" if grey or kept else "refine"
        despeckle = despeckle or (SPECK * scan.cell_volume if noise > NOISY and not paper else 0.0)
    axis, count = layers_between(solid)
    data = scan if phase else solid
    if (grey or method == "grey") and not phase:
        data = grey_levels(scan, float(used["low"]))
    given = _given(data, solid, {**facts, "grey": grey or method == "grey"}, axis=axis, count=count)
    given = given if volume is None else replace(given, volume=volume)
    first = replace(request, method=method, refine=None, despeckle=despeckle)
    yield Way(name=method, make=partial(_same, given, first))
    if request.method == AUTO and method == "plain" and not paper:
        kept_more = replace(first, method="refine")
        yield Way(name="refine", make=partial(_same, given, kept_more), cost=2)
    for steps in fewer_steps(first):
        fewer = replace(first, smoothing=replace(first.smoothing, steps=steps), radius=None)
        yield Way(name=f"{method}, {steps} steps", make=partial(_same, given, fewer))
    if request.method == AUTO and method != "plain":
        plain = replace(first, method="plain")
        yield Way(name="plain", make=partial(_same, given, plain), cost=0.5)


def _same(given: Given, request: Request) -> tuple[Given, Request]:
    """Return both: what a way makes that needs no other data."""
    return given, request


def _shaded(values: NDArray[Any], ends: list[float]) -> bool:
    """Return whether any of some layers has values between the least and the greatest: a mask has none."""
    some = values[:: max(1, len(values) // LAYERS)]
    return bool(((some > ends[0]) & (some < ends[1])).any())


def _given(data: Volume, solid: Volume, facts: Mapping[str, Any], *, axis: int, count: int) -> Given:
    """Return the data to smooth, slices between thick ones included."""
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
