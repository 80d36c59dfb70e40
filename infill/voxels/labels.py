"""The labels of a volume of whole numbers, and the extent of each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.plain_numbers import count_noun, plain_size
from infill.volume import Volume

DIRECT = 65536  # labels up to here are looked up by their number
MOST_LABELS = 4096  # labels; a volume with more is one of grey values
SLAB = 2**22  # cells examined in one go
BOX_SLAB = 2**18  # cells whose numbers are copied in one go, which fit into the second cache of a processor
ALIKE = 0.5  # of all pairs of neighbours, without those of two zeros: labels fill regions, grey values change
MOST_LISTED = 12  # labels in a message
LABEL_ADVICE = (
    'give -o "{label}.stl" for a file of each, --label N for one of them, or --threshold X if the values are grey '
    "levels"
)


@dataclass(frozen=True, kw_only=True)
class LabelExtent:
    """The box of cells that holds a label.

    Parameters
    ----------
    value : int
    low, high : (3,) int
        The cells from `low` up to but without `high` hold all of it.
    runs : int
        Rows of neighbouring cells with this label, along the axis that lies together in memory: a measure of its
        surface, which has about six faces of cells for each.
    cells : int
    """

    value: int
    low: tuple[int, ...]
    high: tuple[int, ...]
    runs: int
    cells: int


def label_extents(volume: Volume) -> tuple[LabelExtent, ...]:
    """Return the extent of every label, in the order of their numbers; 0 is not a label.

    Raises
    ------
    ParameterError
        If a value is not a whole number, or there are more labels than any segmentation has.

    >>> [extent.value for extent in label_extents(Volume(values=np.array([[[0, 7, 3, 7]]])))]
    [3, 7]
    """
    values = as_whole_numbers(volume.values)
    order = np.argsort([-abs(step) for step in values.strides], kind="stable")
    names, index = number_values(values.transpose(order))  # as it lies in memory
    low, high, runs, cells = find_boxes(index, len(names))
    present = np.flatnonzero((runs > 0) & (names != 0))
    if len(present) > MOST_LABELS:
        raise ParameterError(
            f"the volume holds {len(present)} values, more than the {MOST_LABELS} labels of a segmentation; "
            "give --threshold X "
            "for grey values, without {label}"
        )
    axes = np.argsort(order)
    return tuple(
        LabelExtent(
            value=int(names[number]),
            low=tuple(low[number, axes].tolist()),
            high=tuple(high[number, axes].tolist()),
            runs=int(runs[number]),
            cells=int(cells[number]),
        )
        for number in present
    )


def number_values(values: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return names of values, of which some may not occur, and for each cell the place of its value among them.

    >>> [part.tolist() for part in number_values(np.array([[[-5, 7, -5]]]))]
    [[-5, 7], [[[0, 1, 0]]]]
    """
    lowest, highest = int(values.min()), int(values.max())
    if lowest >= 0 and highest <= DIRECT:
        return np.arange(highest + 1), values
    names, numbers = np.unique(values, return_inverse=True)
    return names, numbers.reshape(values.shape)


def find_boxes(index: NDArray[Any], count: int) -> tuple[NDArray[np.int64], ...]:
    """Return the lower and upper ends of the box of each number below `count`, (count, 3); its runs, its cells."""
    from infill.kernels.transfer import extend_boxes

    low, high = np.full((count, 3), np.iinfo(np.int64).max), np.zeros((count, 3), dtype=np.int64)
    runs, cells = (np.zeros(count, dtype=np.int64) for _ in range(2))
    first = 0
    for part in _slabs(index, BOX_SLAB):
        # A copy of one type, whatever that of the labels is: the kernel is compiled once.
        extend_boxes(np.array(part, dtype=np.int32, order="C"), first, low, high, runs, cells)
        first += len(part)
    return low, high, runs, cells


def is_label_map(volume: Volume) -> bool:
    """Tell whether a volume holds labels rather than grey values: whole numbers that fill regions, from 0 upwards.

    >>> levels = np.arange(64).reshape(4, 4, 4)
    >>> is_label_map(Volume(values=levels // 32)), is_label_map(Volume(values=levels // 16)), is_label_map(
    ...     Volume(values=levels))
    (False, True, False)
    """
    try:
        values = as_whole_numbers(volume.values)
    except ParameterError:
        return False
    if values.min() < 0 or values.max() < 2:  # 0 and 1 are a mask
        return False
    distinct: set[int] = set()
    pairs = alike = 0
    for part in _slabs(values.transpose(np.argsort([-abs(step) for step in values.strides], kind="stable"))):
        distinct.update(np.unique(part).tolist())
        if len(distinct) > MOST_LABELS:
            return False
        first, second = part[..., :-1], part[..., 1:]
        labelled = (first != 0) | (second != 0)
        pairs += int(labelled.sum())
        alike += int(((first == second) & labelled).sum())
    return seem_labels(labels=len(distinct - {0}), pairs=pairs, alike=alike)


def seem_labels(*, labels: int, pairs: int, alike: int) -> bool:
    """Tell whether values fill regions: their number, pairs of neighbours without those of zeros, and equal pairs."""
    return labels > 1 and alike >= ALIKE * pairs


def describe_labels(layers: Iterable[Volume], names: Mapping[tuple[int, int], str] | None = None) -> str:
    """List the labels of layers for a message, with their sizes, and their names by layer and number where known.

    >>> describe_labels([Volume(values=np.array([[[0, 7, 3, 7]]]))], {(0, 7): "femur"})
    '2 labels: 3 (1 mm³), 7 femur (2 mm³)'
    """
    labels = [
        f"{value} {(names or {}).get((layer, value), '')}".rstrip()
        + f" ({plain_size(volume.cell_volume * count, power=3)})"
        for layer, volume in enumerate(layers)
        for value, count in count_labels(volume)
    ]
    shown = (
        labels if len(labels) <= MOST_LISTED else [*labels[: MOST_LISTED - 1], f"{len(labels) - MOST_LISTED + 1} more"]
    )
    return f"{count_noun(len(labels), 'label')}: {', '.join(shown)}"


def count_labels(volume: Volume) -> Iterator[tuple[int, int]]:
    """Yield each label and the number of its cells."""
    counts: dict[int, int] = {}
    for part in _slabs(as_whole_numbers(volume.values)):
        for value, count in zip(*np.unique(part, return_counts=True), strict=True):
            counts[int(value)] = counts.get(int(value), 0) + int(count)
    counts.pop(0, None)
    yield from sorted(counts.items())


def as_whole_numbers(values: NDArray[Any]) -> NDArray[Any]:
    """Convert values to whole numbers, or raise ParameterError."""
    if values.dtype == bool:
        return values.view(np.uint8)
    if values.dtype.kind in "iu":
        return values
    for part in _slabs(values):
        if not (part == np.rint(part)).all() or np.abs(part).max() > np.iinfo(np.int32).max:
            raise ParameterError(
                "the volume holds values that are not whole numbers, and so not labels; give --threshold X for grey "
                "values, without {label}"
            )
    return values.astype(np.int32)


def _slabs(values: NDArray[Any], cells: int = SLAB) -> list[NDArray[Any]]:
    """Split values into slabs of about a number of cells along the first axis."""
    rows = max(1, cells * len(values) // values.size)
    return [values[start : start + rows] for start in range(0, len(values), rows)]
