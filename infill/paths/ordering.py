"""Paths in the order of printing: next the one that begins or ends nearest to where the last one ended."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from infill.paths.clipping import is_closed
from infill.paths.families.protocol import Path

ENTRIES = 12  # of a closed path that are compared with those of others


def order(paths: Sequence[Path], start: tuple[float, float] | None = None) -> list[Path]:
    """Return `paths` ordered for short travel; open ones may be reversed, closed ones may begin at another corner.

    Parameters
    ----------
    paths : sequence of (N, 2) float64
        mm.
    start : (x, y), optional
        Where the nozzle comes from, mm; the begin of the first path if it is not given.

    >>> a, b = np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[5.0, 0.0], [1.0, 1.0]])
    >>> [path.tolist() for path in order([a, b])]
    [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 1.0], [5.0, 0.0]]]
    """
    if not paths:
        return []
    closed = [is_closed(path) for path in paths]
    # Where a path may be entered: at its ends, or at some corners of a closed one.
    steps = [1 + len(path) // ENTRIES if ring else len(path) - 1 for path, ring in zip(paths, closed, strict=True)]
    entries = [path[: len(path) - ring : step] for path, ring, step in zip(paths, closed, steps, strict=True)]
    first = np.concatenate([[0], np.cumsum([len(each) for each in entries])])
    nearest_of = _Nearest(np.concatenate(entries))
    here = np.array(paths[0][0] if start is None else start, dtype=np.float64)
    ordered: list[Path] = []
    for _ in paths:
        nearest = nearest_of(here)
        number = int(np.searchsorted(first, nearest, side="right")) - 1
        path = paths[number]
        if closed[number]:
            corner = int(((path[:-1] - here) ** 2).sum(axis=-1).argmin())
            path = np.concatenate([path[corner:], path[1 : corner + 1]])
        elif nearest != first[number]:
            path = path[::-1]
        ordered.append(path)
        here = path[-1]
        nearest_of.left[first[number] : first[number + 1]] = False
    return ordered


class _Nearest:
    """The nearest of some points, (N, 2), of those that are `left`; the tree of them is renewed as they become few."""

    def __init__(self, points: Path) -> None:
        self.left = np.ones(len(points), dtype=bool)
        self._points = points
        self._renew()

    def __call__(self, here: Path) -> int:
        if 2 * self.left.sum() < len(self._number):
            self._renew()
        count = 4
        while True:
            _, found = self._tree.query(here, k=list(range(1, min(count, len(self._number)) + 1)))
            numbers = self._number[found]
            left = numbers[self.left[numbers]]
            if len(left):
                return int(left[0])
            count *= 4

    def _renew(self) -> None:
        from scipy.spatial import cKDTree

        self._number = np.flatnonzero(self.left)
        self._tree = cKDTree(self._points[self._number])


def travel(paths: Sequence[Path], start: tuple[float, float] | None = None) -> float:
    """Return the length of the ways between paths, mm, from `start` on if it is given.

    >>> travel([np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[1.0, 1.0], [5.0, 0.0]])])
    1.0
    """
    if not paths:
        return 0.0
    begins, ends = np.stack([path[0] for path in paths]), np.stack([path[-1] for path in paths])
    total = float(np.hypot(*(begins[1:] - ends[:-1]).T).sum())
    return total if start is None else total + float(np.hypot(*(begins[0] - np.array(start))))
