"""Match components before and after: one comparison of two labellings of the same cells, whatever made the labels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

TABLE = 4  # times the number of cells: beyond this size, a table of pairs costs more than sorting the cells


@dataclass(frozen=True, kw_only=True)
class Overlaps:
    """Pairs of components, before and after, that share cells.

    Parameters
    ----------
    before, after : int
        Numbers of components.
    one, other : (n,) int
        Pairs of a component before and one after that share cells, each pair once; components are numbered from 0.
    cells : (n,) int
        Number of cells they share.
    """

    before: int
    after: int
    one: NDArray[np.integer]
    other: NDArray[np.integer]
    cells: NDArray[np.integer]


@dataclass(frozen=True, kw_only=True)
class ComponentFate:
    """The fate of each component before, and the origin of each one after.

    Parameters
    ----------
    kept, known : (before,) and (after,) bool
        Whether the component shares a cell with any on the other side of the comparison.
    parts : (before,) int
        Number of parts it broke into.
    pieces : (after,) int
        Number of components it was formed from.
    """

    kept: NDArray[np.bool_]
    known: NDArray[np.bool_]
    parts: NDArray[np.integer]
    pieces: NDArray[np.integer]

    @property
    def vanished(self) -> NDArray[np.integer]:
        """Numbers of the components before that have no cell left."""
        return np.flatnonzero(~self.kept)

    @property
    def appeared(self) -> NDArray[np.integer]:
        """Numbers of the components after that appeared where there was no component."""
        return np.flatnonzero(~self.known)

    @property
    def broken(self) -> NDArray[np.integer]:
        """Numbers of the components before that fell apart."""
        return np.flatnonzero(self.parts > 1)

    @property
    def fused(self) -> NDArray[np.integer]:
        """Numbers of the components after that contain several from before."""
        return np.flatnonzero(self.pieces > 1)

    @property
    def breaks(self) -> int:
        """Number of parts that breaking components added."""
        return int((self.parts - 1).clip(0).sum())

    @property
    def fusions(self) -> int:
        """Number of components that fusions removed."""
        return int((self.pieces - 1).clip(0).sum())


def count_overlaps(before: NDArray[np.integer], after: NDArray[np.integer]) -> Overlaps:
    """Count the shared cells of two labellings of the same shape, numbered from 1; 0 means no component."""
    rows, columns = int(before.max()) + 1, int(after.max()) + 1
    key = (before.astype(np.intp) * columns + after).ravel()
    if rows * columns <= TABLE * key.size:
        table = np.bincount(key, minlength=rows * columns)
        pair = np.flatnonzero(table)
        cells = table[pair]
    else:
        pair, cells = np.unique(key, return_counts=True)
    before_number, after_number = np.divmod(pair, columns)
    real = (before_number > 0) & (after_number > 0)
    return Overlaps(
        before=rows - 1, after=columns - 1, one=before_number[real] - 1, other=after_number[real] - 1, cells=cells[real]
    )


def sum_overlaps(stretches: NDArray[np.integer], *, before: int, after: int) -> Overlaps:
    """Sum the shared cells of rows (n, 3): component before, component after, cells shared; pairs may recur."""
    key, index = np.unique(stretches[:, 0] * max(after, 1) + stretches[:, 1], return_inverse=True)
    cells = np.bincount(index, weights=stretches[:, 2], minlength=len(key)).astype(np.int64)
    before_number, after_number = np.divmod(key, max(after, 1))
    return Overlaps(before=before, after=after, one=before_number, other=after_number, cells=cells)


def compare_components(
    matched: Overlaps, *, part: int = 1, piece: int = 1, counted: NDArray[np.bool_] | None = None
) -> ComponentFate:
    """Compare the components before and after.

    Parameters
    ----------
    matched : Overlaps
    part : int
        Cells: anything smaller that comes off a component is a crumb, not a part of it.
    piece : int
        Cells that a component must contribute to count where several run together.
    counted : (before,) bool, optional
        Which components count where several run together; by default, all of them.
    """
    contributes = matched.cells >= piece
    if counted is not None:
        contributes &= counted[matched.one]
    return ComponentFate(
        kept=np.bincount(matched.one, minlength=matched.before) > 0,
        known=np.bincount(matched.other, minlength=matched.after) > 0,
        parts=np.bincount(matched.one[matched.cells >= part], minlength=matched.before),
        pieces=np.bincount(matched.other[contributes], minlength=matched.after),
    )
