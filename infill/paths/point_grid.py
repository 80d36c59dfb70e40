"""Points on beads in the squares of a grid: neighbours of a place are found sooner there than in a tree."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from infill.arrays import Flags, Floats, Places
from infill.checks import FARTHEST
from infill.kernels.compiling import log_compilation

POINTS_A_SQUARE = 0.5  # on average
FEWEST_SQUARES = 1024
SEARCHED = 8  # middles of pieces that are sought: some may be as near as each other
SLACK = 1e-9  # so that rounding leaves out no piece
SEARCHES = "searches"  # what is compiled


@dataclass(frozen=True, kw_only=True)
class PointGrid:
    """Points, sorted by the squares in which they lie.

    Parameters
    ----------
    low : (2,) float64, mm
        The corner of the grid.
    cell : float, mm
        The side of a square.
    shape : (2,) int64
        Numbers of squares along x and y.
    begins : (X * Y + 1,) int64
        Where the points of each square begin, x running fastest.
    points : (N, 2) float64, mm
        Sorted.
    number : (N,) int64
        Their places among the points as they were.
    """

    low: Floats
    cell: float
    shape: Places
    begins: Places
    points: Floats
    number: Places

    @property
    def squares(self) -> tuple[Floats, float, Places, Places, Floats]:
        """The grid as kernels take it."""
        return self.low, self.cell, self.shape, self.begins, self.points

    def distances(self, places: Floats, distance: float) -> Floats:
        """Compute the distance from each place, (M, 2), to the nearest point, mm; infinite from `distance` on."""
        from infill.kernels.point_grids import find_nearest

        nearest = np.empty(len(places))
        with log_compilation(SEARCHES):
            find_nearest(*self.squares, np.ascontiguousarray(places), float(distance), nearest)
        return nearest

    def several(self, places: Floats, distance: float, count: int) -> tuple[Places, Floats]:
        """Find the `count` points nearest to each place, (M, 2), and nearer than a distance, mm, the nearest first.

        Returns
        -------
        number : (M, count) int64
            -1 where fewer are as near.
        square : (M, count) float64, mm²
            Of their distances; infinite there.
        """
        from infill.kernels.point_grids import find_several

        number = np.empty((len(places), count), dtype=np.int64)
        square = np.empty((len(places), count))
        with log_compilation(SEARCHES):
            find_several(*self.squares, self.number, np.ascontiguousarray(places), float(distance), number, square)
        return number, square

    def project(
        self, places: Floats, half: Floats, count: int, *, reach: float, longest: float, same: float
    ) -> tuple[Floats, Floats, Flags]:
        """Project places to the nearest of the pieces of paths whose middles, `count` of them, are the nearest ones.

        Parameters
        ----------
        places : (M, 2) float64, mm
        half : (N, 2) float64, mm
            From each point, the middle of a piece, to the end of the piece.
        count : int
        reach : float, mm
            Farther pieces need not be found.
        longest : float, mm
            Of `half`.
        same : float, mm
            Places so near to each other are one.

        Returns
        -------
        onto : (M, 2) float64, mm
        apart : (M,) float64, mm
            Their distances; infinite beyond `reach`.
        is_unsure : (M,) bool
            Whether middles or pieces that are as near as each other would give another place.
        """
        from infill.kernels.point_grids import project_to_nearest

        farthest = min((reach + longest) * (1 + SLACK) + SLACK, 8 * FARTHEST)
        onto, apart = np.empty((len(places), 2)), np.empty(len(places))
        is_unsure = np.empty(len(places), dtype=np.bool_)
        names, squares = np.empty(SEARCHED, dtype=np.int64), np.empty(SEARCHED)
        given = (np.ascontiguousarray(places), count, float(reach), farthest, same, names, squares)
        with log_compilation(SEARCHES):
            project_to_nearest(*self.squares, self.number, half, *given, onto, apart, is_unsure)
        return onto, apart, is_unsure


def sort_into_grid(points: Floats) -> PointGrid:
    """Sort points, (N, 2), N > 0, into a grid with about two squares for each."""
    from infill.kernels.point_grids import sort_points

    low = np.array([points[:, axis].min() for axis in (0, 1)])
    wide, deep = (float(points[:, axis].max()) - float(low[axis]) for axis in (0, 1))
    cells = len(points) / POINTS_A_SQUARE
    # At most twice as many squares as wanted, however narrow the box around the points is.
    cell = max((wide * deep / cells) ** 0.5, (wide + deep) / (cells + FEWEST_SQUARES), 1e-9)
    shape = np.array([int(wide / cell) + 1, int(deep / cell) + 1])
    begins, number = np.zeros(int(shape.prod()) + 1, dtype=np.int64), np.empty(len(points), dtype=np.int64)
    with log_compilation(SEARCHES):
        sort_points(np.ascontiguousarray(points), low, cell, shape, begins, number)
    return PointGrid(low=low, cell=cell, shape=shape, begins=begins, points=points[number], number=number)


def join_near_paths(points: Floats, path: Places, reach: float) -> Places:
    """Join the paths of which two points, (N, 2), are within reach, mm; return the group of each path, (P,)."""
    from infill.kernels.disjoint_sets import name_sets
    from infill.kernels.point_grids import join_near

    grid, parent = sort_into_grid(points), np.arange(int(path.max()) + 1)
    group = np.empty(len(parent), dtype=np.int64)
    with log_compilation(SEARCHES):
        join_near(*grid.squares, path[grid.number], float(reach), parent)
        name_sets(parent, group)
    return group
