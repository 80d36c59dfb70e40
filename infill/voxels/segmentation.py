"""Segment grey values into a solid: by threshold, range, label or Otsu's method, or with grey edges."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.checks import check_positive, check_range
from infill.errors import LabelChoiceError, ParameterError, UsageError
from infill.imaging.hounsfield import describe_bone
from infill.kernels.threads import in_threads, thread_count
from infill.plain_numbers import plain_argument
from infill.volume import Volume
from infill.voxels.exact_sums import exact_sum, sums_by_side
from infill.voxels.labels import LABEL_ADVICE, describe_labels, is_label_map

if TYPE_CHECKING:
    from infill.reports.smoothing import SegmentationKeys, SegmentationRule

SIGNS = (-1, 1)  # void and solid, as in a phase field
EXACT = 65536  # a histogram of whole numbers up to this range has one bin per value
BINS = 4096  # bins otherwise
MOST_NAMED_LABELS = 12  # labels listed in a message
STRAIGHT = 2 / 3  # mean of 1 / (|x| + |y| + |z|) over a surface's unit normals, weighted by that sum
SLAB = 2**22  # cells examined in one go


def segment_volume(
    volume: Volume,
    *,
    low: float | None = None,
    high: float | None = None,
    label: int | Sequence[int] | None = None,
    otsu: bool = False,
) -> tuple[Volume, SegmentationKeys]:
    """Segment a volume; return it with True in solid cells, and the criterion that was used.

    Parameters
    ----------
    volume : Volume
        Numbers or booleans. It is not changed.
    low, high : float, optional
        Solid is low <= value <= high; giving only one leaves the other side open.
    label : int or sequence of int, optional
        Solid is every cell with one of these values.
    otsu : bool
        Solid lies above the threshold that Otsu's method finds.

    Returns
    -------
    Volume
        Booleans, True is solid, in the same place; a mask of −1 and 1 in single bytes is returned unchanged.
    SegmentationKeys
        The criterion, for the report.

    Raises
    ------
    ParameterError
        If more than one criterion is given; if none is, and the values do not define the solid by themselves; if
        nothing or everything would be solid; if values are NaN or infinite.

    Notes
    -----
    If no criterion is given, booleans are used directly; 0 and one value above it are a mask whose void is 0; −1 and 1
    are a mask whose void is −1; and floating-point numbers in [-1, 1] of both signs are a phase field, solid above 0.

    >>> segment_volume(Volume(values=np.arange(8.0).reshape(2, 2, 2)), low=6)[1]["solid"]
    0.25
    """
    criteria = [low is not None or high is not None, label is not None, otsu]
    if sum(criteria) > 1:
        raise UsageError.about(("threshold", "label", "otsu"), "exclude each other; give one of them")
    values = volume.values
    lowest, highest = _value_range(values)
    used: SegmentationRule
    if values.dtype == bool and not any(criteria):
        solid, used = values, {"method": "mask"}
    elif label is not None:
        labels = tuple(label) if isinstance(label, tuple | list | np.ndarray) else (label,)
        solid, used = _mark_labels(values, labels), {"method": "label", "label": list(labels)}
    elif otsu:
        low = otsu_threshold(volume)
        solid, used = _mark_range(values, low, None), {"method": "otsu", "low": low}
    elif any(criteria):
        _check_ends(low, high)
        solid, used = _mark_range(values, low, high), {"method": "range", "low": low, "high": high}
    else:
        solid, used = _interpret_values(volume, lowest, highest)
    count = count_solid_cells(solid)
    if count in (0, solid.size):
        amount = "no cell" if count == 0 else "every cell"
        problem = (
            f"{_describe(used)}, and {amount} would be solid; the values go from {plain_argument(lowest)} to "
            f"{plain_argument(highest)}{_labels(values)}; choose within them"
        )
        parameter = {"label": "label", "range": "threshold"}.get(used["method"])
        raise ParameterError(problem) if parameter is None else ParameterError.about(parameter, problem)
    ends = [+lowest, +highest]  # of booleans, 0 and 1
    return replace(volume, values=solid), {**used, "values": ends, "solid": count / solid.size}


def fill_masked_with_void(values: NDArray[Any], low: float | None, *, chosen: bool) -> NDArray[Any]:
    """Give masked cells a value that no threshold, range or label takes for solid; return a plain array.

    Parameters
    ----------
    values : array or numpy.ma.MaskedArray
        An array without a mask is returned unchanged.
    low : float, optional
        The lowest value that is solid, if there is a threshold or a range.
    chosen : bool
        Whether a threshold, a range or a label selects the solid; else void is False, 0 or -1.

    >>> fill_masked_with_void(np.ma.MaskedArray([3, 5, 9], mask=[False, False, True]), 4.0, chosen=True).tolist()
    [3, 5, 2]
    """
    # Code that made a masked array has loaded the module already; loading it takes 20 ms.
    if "numpy.ma" not in sys.modules or not isinstance(values, np.ma.MaskedArray):
        return np.asarray(values)
    data = np.asarray(values.data)
    masked = np.ma.getmaskarray(values)
    if not masked.any():
        return data
    visible = data[~masked]
    if data.dtype == bool:
        fill: Any = False
    elif not chosen:
        fill = -1 if (visible < 0).any() else 0
    else:
        lowest = float(visible.min()) if visible.size else 0.0
        fill = np.floor(min(lowest, lowest if low is None else low)) - 1
        fill = int(fill) if data.dtype.kind in "iu" else fill
    kind = data.dtype if data.dtype == bool else np.result_type(data.dtype, np.min_scalar_type(fill))
    filled: NDArray[Any] = np.where(masked, np.asarray(fill, dtype=kind), data.astype(kind, copy=False))
    return filled


def count_solid_cells(solid: NDArray[Any]) -> int:
    """Count the solid cells in the result of `segment_volume`."""
    if solid.dtype in (bool, np.int8) and solid.flags.c_contiguous and solid.size > SLAB:
        from infill.kernels.transfer import count_solid

        cells = solid.view(np.int8).reshape(-1)
        cells.flags.writeable = False  # compiled once, whether or not the array is writable
        return sum(in_threads(count_solid, cells, threads=thread_count()))
    if solid.dtype == bool:
        return int(np.count_nonzero(solid))
    return sum(int(np.count_nonzero(part > 0)) for part in _slabs(solid))


def otsu_threshold(volume: Volume) -> float:
    """Find the threshold by Otsu's method: it separates two classes that each vary as little as possible.

    Notes
    -----
    Source: Otsu, IEEE Transactions on Systems, Man and Cybernetics 9 (1979). The histogram has one bin per
    value for whole numbers that span up to 65,536, else 4,096 bins. The threshold is the upper edge of the last
    bin of the lower class or, if empty bins follow, the middle of those. value >= threshold is the upper class.

    >>> otsu_threshold(Volume(values=np.array([[[0, 1, 9, 10]]])))
    5.0
    """
    lowest, largest = _value_range(volume.values)
    if lowest == largest:
        raise ParameterError(f"all values are {plain_argument(lowest)}; there is nothing for Otsu's method to separate")
    return otsu_of_histogram(*_histogram(volume.values))


def otsu_of_histogram(counts: NDArray[np.float64], edges: NDArray[np.float64]) -> float:
    """Find the threshold of `otsu_threshold` by the counts of equal bins and their edges."""
    from skimage.filters import threshold_otsu

    middles = (edges[:-1] + edges[1:]) / 2
    highest = threshold_otsu(hist=(counts, middles))  # type: ignore[no-untyped-call]
    boundary = int(np.searchsorted(middles, highest + (edges[1] - edges[0]) / 2))
    below, above = np.flatnonzero(counts[:boundary])[-1], boundary + np.flatnonzero(counts[boundary:])[0]
    return float((middles[below] + middles[above]) / 2)


def scale_grey_values(volume: Volume, level: float, window: float | None = None) -> Volume:
    """Scale grey values to data in [-1, 1] that preserve where between two cells the surface lies.

    Parameters
    ----------
    volume : Volume
        Numbers, solid above `level`.
    level : float
        Value at the surface.
    window : float, optional
        Difference of values from void to solid; by default, `edge_window(volume, level)`.

    Returns
    -------
    Volume
        float32, +1 solid and -1 void, grey between, in the same place. This is the only copy made.

    Raises
    ------
    ParameterError
        If the window is not above 0, or no surface lies at the level.

    Notes
    -----
    f = clip((v - level) / (window / 2), -1, 1), the scaling of Wang et al. 2020, Eq. (2), confined to a window
    so that bright and dark spots far from the surface carry no weight. With the default, the grey edge is
    about one cell wide, as for a shape whose edge cells are partly filled. On a ball of 20 cells made this way,
    f = 0 lies 0.05 cells rms from the true surface, and that of a mask 0.19. A smaller window ends in the
    staircase of a mask; a larger one leaves interior cells grey, and holes where the part is faint.

    >>> scale_grey_values(Volume(values=np.array([[[0, 25, 100]]])), 50, 100).values.tolist()
    [[[-1.0, -0.5, 1.0]]]
    """
    level = check_range("level", level, -math.inf, math.inf)
    require_level_between(level, *_value_range(volume.values))
    width = edge_window(volume, level) if window is None else check_positive("window", window)
    return replace(volume, values=scale_values(volume.values, level, width))


def require_level_between(level: float, lowest: float, highest: float) -> None:
    """Raise ParameterError unless a level lies between the extremes of the values."""
    if not lowest <= level < highest:
        raise ParameterError.about(
            "level",
            f"is {plain_argument(level)} and the values go from {plain_argument(lowest)} to "
            f"{plain_argument(highest)}; choose within them",
        )


def scale_values(values: NDArray[Any], level: float, width: float) -> NDArray[np.float32]:
    """Return clip((v - level) / (width / 2), -1, 1) for a volume or a part of one: see `scale_grey_values`."""
    field: NDArray[np.float32] = np.subtract(values, np.float32(level), dtype=np.float32, casting="unsafe")
    field *= np.float32(2 / width)
    return np.clip(field, -1, 1, out=field)


def edge_window(volume: Volume, level: float) -> float:
    """Return the change of values over one cell perpendicular to the surface, for `scale_grey_values`.

    It is the `contrast` of neighbours divided by 2/3, the mean directness with which the axes of the grid
    cross a surface that faces all directions equally. It is at most the mean of the values above the level
    minus the mean of those below, so that the two values of a mask stay +1 and -1.

    >>> edge_window(Volume(values=np.array([[[0, 0, 255, 255]]])), 127.5)
    255.0
    """
    sums = EdgeSums.of(volume.values, level)
    if sums.pairs == 0:
        raise _no_surface(volume, level)
    return sums.window


def contrast(volume: Volume, level: float) -> float:
    """Average the difference of values across the surface over all pairs of neighbours with the level between.

    For a sharp picture it is the full step from void to solid; for a blurred one, it is the change of values
    from one cell to the next, averaged over the directions of the surface.

    Raises
    ------
    ParameterError
        If no two neighbours lie on opposite sides of the level.

    >>> contrast(Volume(values=np.array([[[0, 0, 40, 100, 100]]])), 50)
    60.0
    """
    values: NDArray[Any] = _in_memory_order(volume.values)
    total, pairs = _steps_across(values, level, values.shape)
    if pairs == 0:
        raise _no_surface(volume, level)
    return float(total / pairs)


def _no_surface(volume: Volume, level: float) -> ParameterError:
    """Return the error for a level that lies between no two neighbours."""
    lowest, highest = _value_range(volume.values)
    return ParameterError(
        f"no surface lies at {plain_argument(level)}; the values go from {plain_argument(lowest)} to "
        f"{plain_argument(highest)}"
    )


@dataclass(frozen=True, kw_only=True)
class EdgeSums:
    """What `edge_window` is found from: of a volume, or of a part of one, whose sums add up to those of the whole.

    Parameters
    ----------
    values, cells : (number, number)
        Sum of the values that are not above the level, and above it, without rounding; and their cells.
    steps : number
        Sum of the differences between neighbours on opposite sides of the level, without rounding.
    pairs : int
        Number of such neighbours.
    """

    values: tuple[Fraction, Fraction]
    cells: tuple[int, int]
    steps: Fraction
    pairs: int

    @classmethod
    def of(cls, values: NDArray[Any], level: float, own: Sequence[int] | None = None) -> EdgeSums:
        """Sum over the first `own` (3,) cells along each axis of some values, by default all, and the pairs they begin.

        Parameters
        ----------
        values : (nx, ny, nz)
        level : float
        own : (3,) int, optional
            Cells along each axis that count; of the others, the first along each axis is the end of a pair.
        """
        sums, cells = [Fraction(0), Fraction(0)], [0, 0]
        order = _axes_in_memory(values)
        values, count = values.transpose(order), [(values.shape if own is None else own)[axis] for axis in order]
        for part in _slabs(values[tuple(map(slice, count))]):
            above = part > level
            for side, total in enumerate(sums_by_side(part, above)):
                sums[side] += total
            inside = int(np.count_nonzero(above))
            cells[0] += part.size - inside
            cells[1] += inside
        steps, pairs = _steps_across(values, level, count)
        return cls(values=(sums[0], sums[1]), cells=(cells[0], cells[1]), steps=steps, pairs=pairs)

    def __add__(self, other: EdgeSums) -> EdgeSums:
        """Return the sums of two parts together."""
        (below, above), (other_below, other_above) = self.values, other.values
        return EdgeSums(
            values=(below + other_below, above + other_above),
            cells=(self.cells[0] + other.cells[0], self.cells[1] + other.cells[1]),
            steps=self.steps + other.steps,
            pairs=self.pairs + other.pairs,
        )

    @property
    def window(self) -> float:
        """The change of values over one cell perpendicular to the surface: see `edge_window`."""
        below, solid = (float(total) / max(cells, 1) for total, cells in zip(self.values, self.cells, strict=True))
        return min(float(self.steps / self.pairs) / STRAIGHT, solid - below)


def _steps_across(values: NDArray[Any], level: float, own: Sequence[int]) -> tuple[Fraction, int]:
    """Sum the differences of values over all pairs of neighbours with the level between; return the number of pairs.

    Only pairs count whose first cell is among the first `own` (3,) cells along each axis. The sum is not rounded.
    """
    total, pairs = Fraction(0), 0
    for axis in range(values.ndim):
        end = list(own)
        end[axis] = min(end[axis] + 1, values.shape[axis])
        along = np.moveaxis(values[tuple(map(slice, end))], axis, 0)
        if along.size == 0:
            continue
        rows = max(1, SLAB * len(along) // along.size)
        for start in range(0, len(along) - 1, rows):
            part = along[start : start + rows + 1]
            above: NDArray[np.bool_] = part > level
            across = above[1:] != above[:-1]
            # Only the pairs at the surface are copied: they are few, and unsigned types need more room.
            step = part[1:][across].astype(np.float64) - part[:-1][across].astype(np.float64)
            total, pairs = total + exact_sum(np.abs(step)), pairs + step.size
    return total, pairs


def _interpret_values(volume: Volume, lowest: float, highest: float) -> tuple[NDArray[Any], SegmentationRule]:
    """Return the solid of a mask or a phase field, as booleans or as int8 -1 and 1, and its rule for the report."""
    values: NDArray[Any] = volume.values
    if values.dtype.itemsize == 1 and values.dtype.kind in "iu":  # two values of one byte are not copied
        if (lowest, highest) == (0, 1):
            return values.view(bool), {"method": "mask"}
        if (lowest, highest) == SIGNS and np.count_nonzero(values) == values.size:
            return values, {"method": "mask"}
    masked = lowest == 0 < highest or (lowest, highest) == SIGNS
    if masked and all(bool(((part == lowest) | (part == highest)).all()) for part in _slabs(values)):
        return values == highest, {"method": "mask"}
    if values.dtype.kind == "f" and -1 <= lowest < 0 < highest <= 1:
        return values > 0, {"method": "phase", "low": 0.0}
    if is_label_map(volume):
        raise LabelChoiceError(f"the volume holds {describe_labels([volume])}; {LABEL_ADVICE}")
    hint = f" (finds {plain_argument(otsu_threshold(volume))})" if lowest < highest else ""
    raise ParameterError(
        f"the values go from {plain_argument(lowest)} to {plain_argument(highest)} and do not say what is solid; give "
        f"--threshold X, --range LOW,HIGH, --label N or --otsu{hint}{describe_bone(lowest, highest)}"
    )


def _check_ends(low: float | None, high: float | None) -> None:
    """Raise ParameterError unless the ends of a range are finite and in order."""
    for value in (low, high):
        if value is not None:
            check_range("threshold", value, -math.inf, math.inf)
    if low is not None and high is not None and low > high:
        raise ParameterError.about(
            "threshold", f"goes from {plain_argument(low)} to {plain_argument(high)}; give the lower end first"
        )


def _mark_range(values: NDArray[Any], low: float | None, high: float | None) -> NDArray[np.bool_]:
    """Mark the values in a range."""
    if values.dtype.kind in "iu":  # compared as whole numbers: nothing is converted
        low = math.ceil(low) if low is not None and math.isfinite(low) else low
        high = math.floor(high) if high is not None and math.isfinite(high) else high
    solid = np.ones_like(values, dtype=bool) if low is None else values >= low
    if high is not None:
        solid &= values <= high
    return solid


def _mark_labels(values: NDArray[Any], labels: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark the values that are one of the labels."""
    if not labels:
        raise ParameterError.about("label", "is empty; give one, or several")
    solid = np.zeros_like(values, dtype=bool)
    for label in labels:
        if isinstance(label, bool) or not isinstance(label, int | np.integer):
            raise ParameterError.about("label", f"is {label!r}; it must be a whole number")
        solid |= values == label
    return solid


def _value_range(values: NDArray[Any]) -> tuple[Any, Any]:
    """Return the lowest and the highest value as plain numbers."""
    lowest, highest = values.min().item(), values.max().item()
    if not (math.isfinite(lowest) and math.isfinite(highest)):
        raise ParameterError("the volume holds NaN or infinite values; fill or cut those cells first")
    return lowest, highest


def _histogram(values: NDArray[Any]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return counts and edges of equal bins over all values."""
    return histogram_of(values, *_value_range(values))


def histogram_of(values: NDArray[Any], lowest: Any, highest: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:  # noqa: ANN401
    """Count the values of a volume, or of a part of one, in equal bins; return the counts and the edges of the bins.

    Parameters
    ----------
    values : array
    lowest, highest : number
        Extremes of the values of the whole volume.
    """
    if values.dtype.kind in "iub" and highest - lowest < EXACT:
        counts = np.zeros(int(highest - lowest) + 1)
        for part in _slabs(values):
            counts += np.bincount(part.ravel(order="K").astype(np.int64) - lowest, minlength=len(counts))
    else:
        counts = np.zeros(BINS)
        for part in _slabs(values):
            counts += np.histogram(part.ravel(order="K").astype(np.float64), BINS, (lowest, highest))[0]
    return counts, histogram_edges(values.dtype, lowest, highest)


def histogram_edges(kind: np.dtype[Any], lowest: Any, highest: Any) -> NDArray[np.float64]:  # noqa: ANN401
    """Return the edges of the bins of `histogram_of`, for values of a type."""
    if kind.kind in "iub" and highest - lowest < EXACT:
        edges: NDArray[np.float64] = np.arange(int(highest - lowest) + 2) + (lowest - 0.5)
        return edges
    return np.linspace(lowest, highest, BINS + 1)


def _slabs(values: NDArray[Any]) -> Iterator[NDArray[Any]]:
    """Yield all cells in batches, in memory order."""
    ordered = _in_memory_order(values)
    rows = max(1, SLAB * len(ordered) // ordered.size)
    for start in range(0, len(ordered), rows):
        yield ordered[start : start + rows]


def _in_memory_order(values: NDArray[Any]) -> NDArray[Any]:
    """Return a view with the axes ordered from the widest step in memory to the smallest."""
    return values.transpose(_axes_in_memory(values))


def _axes_in_memory(values: NDArray[Any]) -> list[int]:
    """Return the axes from the widest step in memory to the smallest."""
    return [int(axis) for axis in np.argsort([-abs(step) for step in values.strides], kind="stable")]


def _labels(values: NDArray[Any]) -> str:
    """List the values that occur, for a message, if they are few."""
    if values.dtype.kind not in "iu" or int(values.max()) - int(values.min()) >= EXACT:
        return ""
    counts, edges = _histogram(values)
    occurring = (edges[:-1][counts > 0] + 0.5).astype(np.int64).tolist()
    return f" ({', '.join(str(value) for value in occurring)})" if len(occurring) <= MOST_NAMED_LABELS else ""


def _describe(used: SegmentationRule) -> str:
    """Describe the criterion, for a message that begins with its option if it has one."""
    if used["method"] == "label":
        return f"is {', '.join(str(label) for label in used['label'])}"
    if used["method"] != "range":
        low = used.get("low")
        threshold_text = "" if low is None else f", {plain_argument(low)}"
        return f"what is solid is found by {used['method']}{threshold_text}"
    low, high = used.get("low"), used.get("high")
    words = [] if low is None else [plain_argument(low)]
    words += [] if high is None else [f"{'up ' if low is None else ''}to {plain_argument(high)}"]
    return f"is {' '.join(words)}"
