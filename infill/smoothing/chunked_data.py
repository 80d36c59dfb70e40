"""The data and the method of a volume in chunks: the choices that `infill.smoothing.scans` makes for a whole volume."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from infill.chunks.running import Runner
from infill.chunks.solids import GreyScale, SolidRule
from infill.chunks.surveys import SampledValues, measure_noise, measure_window, survey_samples
from infill.chunks.work import ValueSurvey, Work
from infill.lazy.volume import LazyVolume
from infill.phasefield.profile import REFINED_PROFILE
from infill.reports.smoothing import SegmentationRule
from infill.smoothing.chunk_plans import ChunkPlan, check_speck_size, plan_chunks
from infill.smoothing.chunked_rule import find_rule, join_surveys
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import (
    Threshold,
    check_grey,
    choose_method,
    layer_stride,
    level_at_surface,
    single_threshold,
)
from infill.voxels.segmentation import require_level_between

RULE, NOISE, VALUES, WINDOW = (0.0, 0.4), (0.4, 0.6), (0.6, 0.8), (0.8, 1.0)  # shares of the passes over the values


@dataclass(frozen=True, kw_only=True, eq=False)
class ChosenWork:
    """The work on a volume in chunks.

    Parameters
    ----------
    work : Work
    plan : ChunkPlan
    request : SmoothRequest
        With the method that was chosen; lengths are in cells.
    used : SegmentationRule
        How the solid was found.
    noise : float
        See `infill.voxels.noise.noise_share`.
    grey : bool
        Whether grey values around the threshold are kept.
    """

    work: Work
    plan: ChunkPlan
    request: SmoothRequest
    used: SegmentationRule
    noise: float
    grey: bool


def choose_work(
    volume: LazyVolume,
    request: SmoothRequest,
    runner: Runner,
    tell: Callable[[float], None],
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool | None = None,
    side: int | None = None,
    size: tuple[int, int, int] | None = None,
    scratch: str = "",
) -> ChosenWork:
    """Find the solid, the method and the scale of grey values by the values of all chunks, and divide the volume.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
    runner : Runner
    tell : callable
        Called with the share of these passes that is done.
    threshold, label, grey
        See `infill.smooth_volume`.
    side, size
        See `plan_chunks`.
    scratch
        See `infill.chunks.work.Work`.

    Raises
    ------
    ParameterError
        If the values do not say what is solid, or the options contradict each other.
    """
    spacing = tuple(volume.spacing)
    cell_volume = volume.cell_volume
    check_speck_size(request, cell_volume)
    first_plan = plan_chunks(volume, replace(request, method="plain", refine=None), runner, side=side)
    work = Work(
        source=volume.array,
        rule=SolidRule(),
        layout=first_plan.layout,
        smoothing=request.smoothing,
        spacing=spacing,
        level=None,
    )
    rule, used = find_rule(work, runner, threshold, label, partial(_tell_part, tell, RULE))
    work = replace(work, rule=rule)
    level, phase = single_threshold(used), used["method"] == "phase"
    check_grey(request, grey, level)
    samples = _Samples(work, runner, partial(_tell_part, tell, VALUES))
    noise = measure_noise(work, runner, partial(_tell_part, tell, NOISE))
    chosen = choose_method(
        request,
        noise,
        grey=grey,
        has_grey=lambda: level is not None and not phase and samples.has_grey(),
        cell_volume=cell_volume,
    )
    scale: GreyScale | None = None
    grey = bool(grey) or chosen.method == "grey"
    if phase:
        scale = GreyScale()
    elif grey:
        surface_level = level_at_surface(used, samples.are_whole)
        require_level_between(surface_level, *samples.ends())
        window = measure_window(work, runner, surface_level, partial(_tell_part, tell, WINDOW))
        scale = GreyScale(level=surface_level, window=window)
    request = chosen.for_cell(min(spacing))
    plan = plan_chunks(volume, request, runner, grey=scale is not None, side=side, size=size)
    fixed = None if isinstance(request.level, str) else request.level
    return ChosenWork(
        work=replace(
            work,
            layout=plan.layout,
            smoothing=request.smoothing,
            level=REFINED_PROFILE.distance_level(fixed) if fixed is not None and request.refined else fixed,
            scratch=scratch,
            refined=request.refined,
            grey=scale,
            despeckle=request.despeckle,
        ),
        plan=plan,
        request=request,
        used=used,
        noise=noise,
        grey=grey,
    )


def _tell_part(tell: Callable[[float], None], part: tuple[float, float], share: float) -> None:
    """Tell the share of one of the passes that is done."""
    begin, end = part
    tell(begin + (end - begin) * share)


class _Samples:
    """The extremes of all values, and the values of sampled layers, which are read when they are asked for."""

    def __init__(self, work: Work, runner: Runner, tell: Callable[[float], None]) -> None:
        self.work, self.runner, self.tell = work, runner, tell
        self.surveys: list[tuple[ValueSurvey, SampledValues]] = []

    def read(self) -> tuple[ValueSurvey, list[SampledValues]]:
        """Return the survey of all values, and the samples of all chunks."""
        if not self.surveys:
            stride = layer_stride(self.work.layout.shape[0])
            items = [(chunk, stride) for chunk in self.work.layout if chunk.has_cells]
            self.surveys = self.runner.run(survey_samples, self.work, items, self.tell)
        return join_surveys([survey for survey, _ in self.surveys]), [samples for _, samples in self.surveys]

    def ends(self) -> tuple[float, float]:
        """Return the lowest and the highest value of the volume."""
        values, _ = self.read()
        return values.lowest, values.highest

    def has_grey(self) -> bool:
        """Tell whether sampled layers have values between the extremes: see `infill.smoothing.scans`."""
        values, samples = self.read()
        return any(part.has_grey(values.lowest, values.highest) for part in samples)

    def are_whole(self) -> bool:
        """Tell whether the values of sampled layers are whole numbers."""
        kind = self.work.source.dtype.kind
        return kind in "iu" or not any(part.fractions for part in self.read()[1])
