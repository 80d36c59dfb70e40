"""The labels of a volume that is read box by box: the labels in each box, and in all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.voxels.labels import MOST_LABELS, LabelExtent, as_whole_numbers, find_boxes, number_values, seem_labels


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelSurvey:
    """The values in a box of a volume, 0 among them.

    Parameters
    ----------
    values : (k,) int64 or uint64
        Each once, in order.
    low, high : (k, 3) int64
        The cells that hold each, from `low` up to but without `high`, in the whole volume.
    runs, cells : (k,) int64
        Rows of neighbouring cells along z that have the value, and its cells. A row that goes on from the box before
        is counted there.
    """

    values: NDArray[Any]
    low: NDArray[np.int64]
    high: NDArray[np.int64]
    runs: NDArray[np.int64]
    cells: NDArray[np.int64]

    @property
    def extents(self) -> tuple[LabelExtent, ...]:
        """The extent of every label, in the order of their numbers; 0 is not a label."""
        return tuple(
            LabelExtent(
                value=int(self.values[at]),
                low=tuple(self.low[at].tolist()),
                high=tuple(self.high[at].tolist()),
                runs=int(self.runs[at]),
                cells=int(self.cells[at]),
            )
            for at in np.flatnonzero(self.values != 0)
        )

    def is_label_map(self, rows: int) -> bool:
        """Tell whether the whole volume, of this number of rows, is one of labels: see `is_label_map`."""
        if self.values[0] < 0 or self.values[-1] < 2:
            return False
        is_label = self.values != 0
        alike = int((self.cells - self.runs)[is_label].sum())
        pairs = alike + int(self.runs.sum()) - rows
        return seem_labels(labels=int(is_label.sum()), pairs=pairs, alike=alike)


def survey_box(cells: NDArray[Any], corner: tuple[int, ...], *, overlap: bool = False) -> LabelSurvey:
    """Survey the cells of a box.

    Parameters
    ----------
    cells : (n0, n1, n2) array
    corner : (3,) int
        The first of its cells, in the whole volume.
    overlap : bool
        Whether the first layer along z is that before the box: it only tells which rows go on from there.

    Raises
    ------
    ParameterError
        If a value is not a whole number, or there are more labels than any segmentation has.

    >>> survey = survey_box(np.array([[[7, 7, 0, 7]]]), (0, 0, 4), overlap=True)
    >>> [part.tolist() for part in (survey.values, survey.low, survey.runs, survey.cells)]
    [[0, 7], [[0, 0, 5], [0, 0, 4]], [1, 1], [1, 2]]
    """
    whole = as_whole_numbers(cells)
    names, index = number_values(whole[:, :, 1:] if overlap else whole)
    low, high, runs, counts = find_boxes(index, len(names))
    if overlap:
        goes_on = whole[:, :, 0] == whole[:, :, 1]
        runs -= np.bincount(index[:, :, 0][goes_on].astype(np.int64), minlength=len(names))
    present = np.flatnonzero(counts)
    _require_labels(names[present])
    place = np.array(corner, dtype=np.int64)
    return LabelSurvey(
        values=names[present],
        low=low[present] + place,
        high=high[present] + place,
        runs=runs[present],
        cells=counts[present],
    )


def join_surveys(surveys: Sequence[LabelSurvey]) -> LabelSurvey:
    """Join the surveys of boxes that make up a volume; raise ParameterError as `survey_box`."""
    values, place = np.unique(np.concatenate([survey.values for survey in surveys]), return_inverse=True)
    _require_labels(values)
    low, high = np.full((len(values), 3), np.iinfo(np.int64).max), np.zeros((len(values), 3), dtype=np.int64)
    runs, cells = (np.zeros(len(values), dtype=np.int64) for _ in range(2))
    np.minimum.at(low, place, np.concatenate([survey.low for survey in surveys]))
    np.maximum.at(high, place, np.concatenate([survey.high for survey in surveys]))
    np.add.at(runs, place, np.concatenate([survey.runs for survey in surveys]))
    np.add.at(cells, place, np.concatenate([survey.cells for survey in surveys]))
    return LabelSurvey(values=values, low=low, high=high, runs=runs, cells=cells)


def _require_labels(values: NDArray[Any]) -> None:
    """Raise ParameterError for more values than a segmentation has."""
    if np.count_nonzero(values) > MOST_LABELS:
        raise ParameterError(
            f"the volume holds over {MOST_LABELS} values, more than the labels of a segmentation; give --threshold X "
            "for grey values, without {label}"
        )
