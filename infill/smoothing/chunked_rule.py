"""The solid in a volume in chunks, by its options or by the values of all chunks."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from infill.chunks.layout import Chunk
from infill.chunks.running import Runner
from infill.chunks.solids import SolidRule
from infill.chunks.solving import Solver
from infill.chunks.work import ValueSurvey, Work, count_values, survey_values
from infill.errors import ParameterError, UsageError
from infill.imaging.hounsfield import describe_bone
from infill.plain_numbers import plain_argument, plain_number, plain_size
from infill.reports.smoothing import SegmentationKeys, SegmentationRule
from infill.smoothing.scans import Threshold, threshold_range
from infill.voxels.segmentation import SIGNS, histogram_edges, otsu_of_histogram

if TYPE_CHECKING:
    pass

NOT_FINITE = "the volume holds NaN or infinite values; fill or cut those cells first"


def find_rule(
    work: Work,
    runner: Runner,
    threshold: Threshold,
    label: int | Sequence[int] | None,
    tell: Callable[[float], None],
) -> tuple[SolidRule, SegmentationRule]:
    """Return the rule by which cells are solid, and how it was found: see `infill.voxels.segmentation`.

    Raises
    ------
    ParameterError
        If the values do not say what is solid, or the options contradict each other.
    """
    low, high = threshold_range(threshold)
    otsu = isinstance(threshold, str)
    ranged = low is not None or high is not None
    if sum((ranged, label is not None, otsu)) > 1:
        raise UsageError.about(("threshold", "label", "otsu"), "exclude each other; give one of them")
    if label is not None:
        labels = tuple(label) if isinstance(label, (tuple, list, np.ndarray)) else (label,)
        if not labels or not all(
            isinstance(number, (int, np.integer)) and not isinstance(number, bool) for number in labels
        ):
            raise ParameterError.about("label", f"is {label!r}; give one whole number, or several")
        wholes = tuple(int(number) for number in labels)
        return SolidRule(labels=wholes), {"method": "label", "label": list(wholes)}
    if ranged:
        for value in (low, high):
            if value is not None and not math.isfinite(value):
                raise ParameterError.about("threshold", f"is {value}; give a finite number")
        if low is not None and high is not None and low > high:
            raise ParameterError.about(
                "threshold", f"goes from {plain_argument(low)} to {plain_argument(high)}; give the lower end first"
            )
        return SolidRule(low=low, high=high), {"method": "range", "low": low, "high": high}
    if work.source.dtype == bool and not otsu:
        return SolidRule(), {"method": "mask"}
    chunks = list(work.layout)
    half = 0.5 if otsu else 1.0
    surveys = runner.run(survey_values, work, [(chunk,) for chunk in chunks], lambda share: tell(half * share))
    values = join_surveys(surveys)
    if otsu:
        return _find_otsu(work, runner, chunks, values, tell)
    lowest, highest = values.lowest, values.highest
    if values.two and (lowest == 0 < highest or (lowest, highest) == SIGNS):
        return SolidRule(low=highest, high=highest), {"method": "mask"}
    if work.source.dtype.kind == "f" and -1 <= lowest < 0 < highest <= 1:
        return SolidRule(phase=True), {"method": "phase", "low": 0.0}
    raise ParameterError(
        f"the values go from {plain_argument(lowest)} to {plain_argument(highest)} and do not say what is solid; give "
        f"--threshold X, --range LOW,HIGH, --label N or --otsu{describe_bone(lowest, highest)}"
    )


def _find_otsu(
    work: Work, runner: Runner, chunks: Sequence[Chunk], values: ValueSurvey, tell: Callable[[float], None]
) -> tuple[SolidRule, SegmentationRule]:
    """Find the threshold by Otsu's method from the sum of the histograms of all chunks."""
    lowest, highest = values.lowest, values.highest
    if lowest == highest:
        raise ParameterError(f"all values are {plain_argument(lowest)}; there is nothing for Otsu's method to separate")
    items = [(chunk, lowest, highest) for chunk in chunks]
    counts = runner.run(count_values, work, items, lambda share: tell(0.5 + 0.5 * share))
    total = sum(counts[1:], counts[0])
    low = otsu_of_histogram(total, histogram_edges(work.source.dtype, lowest, highest))
    return SolidRule(low=low), {"method": "otsu", "low": low}


def join_surveys(surveys: Sequence[ValueSurvey]) -> ValueSurvey:
    """Join the surveys of all chunks; raise ParameterError for values that are not finite."""
    if not all(survey.finite for survey in surveys):
        raise ParameterError(NOT_FINITE)
    ends = {end for survey in surveys for end in (survey.lowest, survey.highest)}
    lowest, highest = min(ends), max(ends)
    two = all(survey.two for survey in surveys) and len(ends) <= 2
    return ValueSurvey(lowest=lowest, highest=highest, two=two, finite=True)


def require_some_solid(solver: Solver, used: SegmentationRule) -> SegmentationKeys:
    """Return the rule with the values and the solid share; raise ParameterError if no cell, or every cell, is solid."""
    values = join_surveys([outcome.values for outcome in solver.smoothed.values()])
    solid = sum(outcome.solid for outcome in solver.smoothed.values())
    cells = math.prod(solver.work.layout.shape)
    if solid in (0, cells):
        amount = "no cell" if solid == 0 else "every cell"
        problem = (
            f"leaves {amount} solid; the values go from {plain_argument(values.lowest)} to "
            f"{plain_argument(values.highest)}; choose within them"
        )
        parameter = {"label": "label", "range": "threshold"}.get(used["method"])
        raise ParameterError(f"the volume {problem}") if parameter is None else ParameterError.about(parameter, problem)
    return {**used, "values": [+values.lowest, +values.highest], "solid": solid / cells}


def count_specks(solver: Solver) -> int:
    """Return the number of specks that were taken out; raise ParameterError if nothing else is there."""
    outcomes = list(solver.smoothed.values())
    if solver.work.despeckle and not any(outcome.components is not None for outcome in outcomes):
        largest = max(outcome.specks.largest for outcome in outcomes)
        raise ParameterError.about(
            "despeckle",
            f"is {plain_number(solver.work.despeckle)} mm³ and the largest component has "
            f"{plain_size(largest * solver.work.cell_volume, power=3)}; give less",
        )
    return sum(outcome.specks.removed for outcome in outcomes)
