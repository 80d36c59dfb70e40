"""Smooth a scan: the values to keep, the method, and remedies if that loses something."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError, ParameterError, UsageError
from infill.phasefield.schedule import MIN_STEPS
from infill.plain_numbers import plain_argument, plain_number
from infill.smoothing.comparing import COARSE_LOSS, LOST_VOLUME, describe_coarsening
from infill.smoothing.request import AUTO, SmoothInput, SmoothRequest, Way
from infill.smoothing.stages import surface_of_data
from infill.volume import Volume
from infill.voxels.coarsening import coarsen
from infill.voxels.noise import NOISY, noise_share
from infill.voxels.segmentation import count_solid_cells, scale_grey_values, segment_volume
from infill.voxels.slices import interpolate_slices, plan_sublayers

if TYPE_CHECKING:
    from infill.reports.smoothing import CoarseChange, InputKeys

Threshold = float | tuple[float | None, float | None] | Literal["otsu"] | None

SAMPLED_LAYERS = 16  # sampled for grey values
SPECK_CELLS = 27  # cells: specks up to this size are taken out of noisy data
DESPECKLE_CELLS = (SPECK_CELLS, 125)  # cells: sizes of specks to take out that are tried before one is recommended
SMALLER = 1.25, 1.5, 2.0, 3.0, 4.0  # times smaller voxels, tried before they are recommended
LARGER = 2.0  # times the size of voxels, tried before it is recommended
HELD = 1.0  # a fidelity at which the data hold, tried before it is recommended


def volume_ways(
    scan: Volume,
    request: SmoothRequest,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool | None = None,
    voxel: float | None = None,
) -> list[Way]:
    """List the ways to smooth the solid in a volume, the preferred one first.

    Parameters
    ----------
    scan : Volume
    request : SmoothRequest
    threshold, label, grey, voxel
        See `infill.smooth_volume`.
    """
    given, (low, high) = scan, threshold_range(threshold)
    solid, used = segment_volume(scan, low=low, high=high, label=label, otsu=isinstance(threshold, str))
    phase = used["method"] == "phase"
    change: CoarseChange | None = None
    if voxel is not None:
        fine_scan, fine_solid = scan, solid
        scan, solid, phase = _coarsen_solid(fine_scan, fine_solid, used, voxel)
        if np.asarray(solid.values).any():
            change = _measure_coarsening(fine_scan, fine_solid, solid, used, voxel)
            if abs(change["change"]) >= LOST_VOLUME and not request.allow_broken:
                raise GeometryError(f"{describe_coarsening(change)}; give --allow-broken to have it anyway")
        else:
            raise ParameterError.about(
                "voxel", f"is {plain_argument(voxel)} mm, and nothing of the solid fills half of one; give less"
            )
    facts: InputKeys = {
        "source": "volume",
        "segmentation": used,
        "coarse": voxel is not None,
        "warnings": list(scan.warnings),
    }
    if change is not None:
        facts["coarsened"] = change
    ways = scan_ways(scan, solid, used, facts, request, grey=grey, phase=phase)
    if voxel is None:
        larger = plain_argument(LARGER * float(given.cell_size.max()), 3)
        option = f"--voxel {larger}"

        def coarsen_scan() -> Way:
            size = float(larger)
            ways = volume_ways(given, request, threshold=threshold, label=label, grey=grey, voxel=size)
            return replace(ways[0], name=option, option=option)

        ways.append(replace(ways[0], name=option, option=option, later=coarsen_scan))
    return ways


def _coarsen_solid(scan: Volume, solid: Volume, used: Mapping[str, Any], voxel: float) -> tuple[Volume, Volume, bool]:
    """Return values and solid cells in larger voxels, mm, and whether the values are a phase field."""
    phase = used["method"] == "phase"
    if phase or used["method"] in ("range", "otsu"):
        coarse = coarsen(scan, voxel)
        return coarse, segment_volume(coarse, low=used["low"], high=used.get("high"))[0], phase
    # A mask: the solid share of a larger voxel gives the place of the surface in it.
    shares = coarsen(replace(solid, values=np.asarray(solid.values) > 0), voxel)
    coarse = replace(shares, values=2 * np.asarray(shares.values) - 1)
    return coarse, replace(coarse, values=np.asarray(coarse.values) > 0), True


def _measure_coarsening(
    scan: Volume, fine: Volume, coarse: Volume, used: Mapping[str, Any], voxel: float
) -> CoarseChange:
    """Measure the change of a solid's volume by larger voxels, mm, and find smaller ones if it is large."""

    def volume_change(solid: Volume) -> float:
        """Return the change of the volume by larger voxels, as a share."""
        cells = int(np.count_nonzero(np.asarray(solid.values) > 0))
        return cells * solid.cell_volume / before - 1

    before = int(np.count_nonzero(np.asarray(fine.values) > 0)) * fine.cell_volume
    change, fitting = volume_change(coarse), None
    if abs(change) >= COARSE_LOSS:
        smallest = float(scan.cell_size.min())
        for smaller in (float(plain_argument(voxel / by, 2)) for by in SMALLER):
            if smaller < smallest:
                break
            if abs(volume_change(_coarsen_solid(scan, fine, used, smaller)[1])) < COARSE_LOSS:
                fitting = smaller
                break
    return {"volume_before": before, "change": change, "fitting": fitting}


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


def scan_ways(
    scan: Volume,
    solid: Volume,
    used: Mapping[str, Any],
    facts: InputKeys,
    request: SmoothRequest,
    *,
    grey: bool | None = None,
    phase: bool = False,
    volume: float | None = None,
) -> list[Way]:
    """List the ways to smooth a scan: the best method by its noise, the same with fewer steps, and others.

    Parameters
    ----------
    scan, solid : Volume
        The values, and the mask of solid cells.
    used : mapping
        How the solid was determined: see `infill.voxels.segmentation.segment_volume`.
    facts : InputKeys
        For the report.
    request : SmoothRequest
    grey : bool, optional
        Whether grey levels are requested, or refused.
    phase : bool
        Whether the values are a phase field, which is smoothed as it is.
    volume : float, optional
        Of the solid, mm³, if that is known better than by the values.

    Raises
    ------
    ParameterError
        If grey levels are requested without a threshold.
    """
    level = single_threshold(used)
    check_grey(request, grey, level)
    noise = noise_share(np.asarray(solid.values), threads=request.threads)
    preferred = choose_method(
        request,
        noise,
        grey=grey,
        has_grey=lambda: level is not None and not phase and has_grey_values(np.asarray(scan.values), used["values"]),
        cell_volume=scan.cell_volume,
    )
    method, paper = preferred.method, request.method == AUTO and is_for_plain(request)
    grey = grey is True or method == "grey"
    data = scan if phase else scale_grey_values(scan, surface_value(scan, used)) if grey else solid
    smooth_input = _scan_input(data, solid, {**facts, "noise": noise, "grey": grey}, request.threads)
    smooth_input = smooth_input if volume is None else replace(smooth_input, volume=volume)
    ways = [Way(name=method, data=smooth_input, request=preferred)]
    if request.method == AUTO and method == "plain" and not paper:
        ways.append(Way(name="refine", data=smooth_input, request=replace(preferred, method="refine"), cost=2))
    steps = request.smoothing.steps
    while steps > MIN_STEPS:
        steps = max(MIN_STEPS, steps // 2)
        fewer = replace(preferred, smoothing=replace(preferred.smoothing, steps=steps), radius=None)
        ways.append(Way(name=f"{method}, {steps} steps", data=smooth_input, request=fewer))
    if request.method == AUTO and method != "plain":
        ways.append(Way(name="plain", data=smooth_input, request=replace(preferred, method="plain"), cost=0.5))
    gentlest = replace(preferred, smoothing=replace(preferred.smoothing, steps=steps), radius=None)
    return [*ways, *_remedies(gentlest if steps < request.smoothing.steps else preferred, smooth_input)]


def single_threshold(used: Mapping[str, Any]) -> float | None:
    """Return the value from which on cells are solid, None if there is no such value, or values have an upper end."""
    return used.get("low") if used.get("high") is None else None


def check_grey(request: SmoothRequest, grey: bool | None, level: float | None) -> None:
    """Raise ParameterError if grey levels are requested and refused, or requested without one threshold `level`."""
    if grey is False and request.method == "grey":
        raise UsageError.about("grey", "is left out, and method is grey; leave one of them out")
    if (grey or request.method == "grey") and level is None:
        raise ParameterError("grey levels are kept around one threshold; give one, or otsu")


def is_for_plain(request: SmoothRequest) -> bool:
    """Tell whether a fixed level, or few steps, ask for the paper's way."""
    return request.level != "volume" or request.smoothing.steps < MIN_STEPS


def choose_method(
    request: SmoothRequest, noise: float, *, grey: bool | None, has_grey: Callable[[], bool], cell_volume: float
) -> SmoothRequest:
    """Return the request with the method that suits the data instead of "auto", and with specks to take out of noise.

    Parameters
    ----------
    request : SmoothRequest
    noise : float
        See `infill.voxels.noise.noise_share`.
    grey : bool, optional
        Whether grey levels are requested, or refused.
    has_grey : callable
        Tells whether there are grey values around one threshold.
    cell_volume : float, mm³
    """
    if request.method != AUTO:
        return replace(request, refine=None)
    if is_for_plain(request):
        return replace(request, method="plain", refine=None)
    if noise > NOISY:
        despeckle = request.despeckle or SPECK_CELLS * cell_volume
        return replace(request, method="plain", refine=None, despeckle=despeckle)
    keeps_grey = grey or (grey is not False and has_grey())
    return replace(request, method="grey" if keeps_grey else "refine", refine=None)


def _remedies(request: SmoothRequest, smooth_input: SmoothInput) -> list[Way]:
    """List the ways that a message may recommend if they work: without specks, and held to the data.

    Parameters
    ----------
    request : SmoothRequest
        The gentlest way of those that are tried whatever options are given.
    smooth_input : SmoothInput
    """
    remedies = []
    for cells in DESPECKLE_CELLS:
        volume = float(f"{cells * smooth_input.data.cell_volume:.3g}")
        if volume > request.despeckle:
            option = f"--despeckle {plain_number(volume, separator='')}"
            remedies.append(
                Way(name=option, data=smooth_input, request=replace(request, despeckle=volume), option=option)
            )
    if request.method != "grey" and request.smoothing.fidelity < HELD:
        held = replace(request, method="plain", smoothing=replace(request.smoothing, fidelity=HELD))
        option = f"--fidelity {plain_argument(HELD)}"
        remedies.append(Way(name=option, data=smooth_input, request=held, option=option))
    return remedies


def surface_value(scan: Volume, used: Mapping[str, Any]) -> float:
    """Return the value at the surface: the threshold, or half a unit below it if it and all values are whole numbers.

    Cells that have the value of the threshold are solid, not cells that the surface halves.

    >>> whole = Volume(values=np.arange(8).reshape(2, 2, 2))
    >>> surface_value(whole, {"method": "range", "low": 3.0}), surface_value(whole, {"method": "otsu", "low": 2.5})
    (2.5, 2.5)
    """
    values = np.asarray(scan.values)
    return level_at_surface(
        used, lambda: values.dtype.kind in "iu" or not (np.mod(_sample_layers(values), 1) != 0).any()
    )


def level_at_surface(used: Mapping[str, Any], are_whole: Callable[[], bool]) -> float:
    """Return the value at the surface; `are_whole` tells whether sampled values are whole: see `surface_value`."""
    low = float(used["low"])
    is_exact = used["method"] != "range" or not low.is_integer()
    return low if is_exact or not are_whole() else low - 0.5


def layer_stride(layers: int) -> int:
    """Return the number of layers from one that is sampled to the next."""
    return max(1, layers // SAMPLED_LAYERS)


def _sample_layers(values: NDArray[Any]) -> NDArray[Any]:
    """Return some layers of a volume, evenly spaced."""
    return values[:: layer_stride(len(values))]


def has_grey_values(values: NDArray[Any], ends: list[float]) -> bool:
    """Tell whether sampled layers have values between the lowest and the highest: those of a mask have none."""
    sampled_layers = _sample_layers(values)
    return bool(((sampled_layers > ends[0]) & (sampled_layers < ends[1])).any())


def _scan_input(data: Volume, solid: Volume, facts: InputKeys, threads: int | None) -> SmoothInput:
    """Return the input of a scan; thick slices are interpolated."""
    axis, count = plan_sublayers(solid)
    facts = {**facts, "slices": count}
    if count == 1:
        return SmoothInput(data=data, facts=facts)
    return SmoothInput(
        data=interpolate_slices(data, axis, count),
        facts=facts,
        voxel_surface=surface_of_data(solid, threads),
        volume=None if data is not solid else count_solid_cells(np.asarray(solid.values)) * solid.cell_volume,
        cell=float(solid.cell_size.max()),
    )
