"""Order paths for printing: next comes the path with an end nearest to the end of the previous one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from infill.paths.clipping import is_closed
from infill.paths.families.family import Path

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

FEW = 2000  # points whose distances are all computed each time
ENTRIES = 12  # places at which a closed path may be entered, for the comparison with other paths


def order_paths(paths: Sequence[Path], start: tuple[float, float] | None = None) -> list[Path]:
    """Order paths for short travel; open ones may be reversed, closed ones may begin at another corner.

    Parameters
    ----------
    paths : sequence of (N, 2) float64
        mm.
    start : (x, y), optional
        Position of the nozzle, mm. Default: the begin of the first path.

    >>> a, b = np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[5.0, 0.0], [1.0, 1.0]])
    >>> [path.tolist() for path in order_paths([a, b])]
    [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 1.0], [5.0, 0.0]]]
    """
    if not paths:
        return []
    closed = [is_closed(path) for path in paths]
    # A path may be entered at its ends, or a closed one at some of its corners.
    steps = [1 + len(path) // ENTRIES if ring else len(path) - 1 for path, ring in zip(paths, closed, strict=True)]
    entries = [path[: len(path) - ring : step] for path, ring, step in zip(paths, closed, steps, strict=True)]
    offsets = np.concatenate([[0], np.cumsum([len(points) for points in entries])])
    nearest_of = _RemainingPoints(np.concatenate(entries))
    position = np.array(paths[0][0] if start is None else start, dtype=np.float64)
    ordered: list[Path] = []
    for _ in paths:
        nearest = nearest_of(position)
        number = int(np.searchsorted(offsets, nearest, side="right")) - 1
        path = paths[number]
        if closed[number]:
            corner = int(((path[:-1] - position) ** 2).sum(axis=-1).argmin())
            path = np.concatenate([path[corner:], path[1 : corner + 1]])
        elif nearest != offsets[number]:
            path = path[::-1]
        ordered.append(path)
        position = path[-1]
        nearest_of.left[offsets[number] : offsets[number + 1]] = False
    return ordered


class _RemainingPoints:
    """The nearest of the remaining points: of few, by all distances; of many, by a search tree.

    The tree is built again as they become few. It also decides where two points are as near as each other.
    """

    def __init__(self, points: Path) -> None:
        self.left = np.ones(len(points), dtype=bool)
        self._points = points
        self._built: cKDTree[None, None] | None = None
        self._renew()

    def __call__(self, position: Path) -> int:
        if 2 * self.left.sum() < len(self._number):
            self._renew()
        if len(self._points) <= FEW:
            remaining = np.flatnonzero(self.left)
            away = self._points[remaining] - position
            square = away[:, 0] * away[:, 0] + away[:, 1] * away[:, 1]
            nearest = int(square.argmin())
            if np.count_nonzero(square == square[nearest]) == 1:
                return int(remaining[nearest])
        count = 4
        while True:
            _, neighbours = self._tree.query(position, k=list(range(1, min(count, len(self._number)) + 1)))
            numbers = self._number[neighbours]
            remaining = numbers[self.left[numbers]]
            if len(remaining):
                return int(remaining[0])
            count *= 4

    @property
    def _tree(self) -> cKDTree[None, None]:
        """Search tree of the points that remained when it was last renewed."""
        from scipy.spatial import cKDTree

        if self._built is None:
            self._built = cKDTree(self._points[self._number])
        return self._built

    def _renew(self) -> None:
        """Leave out the points that are gone from the search tree, which is built when it is needed."""
        self._number = np.flatnonzero(self.left)
        self._built = None
