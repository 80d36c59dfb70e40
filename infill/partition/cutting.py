"""The walls of single labels, cut out of the complex of all."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.kernels import cutting as kernels
from infill.kernels.threads import in_order, thread_count
from infill.partition.walls import Walls


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelWalls:
    """The triangles around one label, which face away from it.

    Parameters
    ----------
    label : int
    points : (V,) int64
        Numbers of points in the complex, in order.
    faces : (F, 3) int32, int64 from 2³¹ points on
        Places in `points`.
    """

    label: int
    points: NDArray[np.int64]
    faces: NDArray[np.integer]


def cut_labels(walls: Walls, labels: int, *, threads: int | None = None) -> Iterator[LabelWalls]:
    """Yield the walls of labels 1, 2 ... up to but without `labels`; labels without any are left out."""
    count = thread_count(threads)
    starts = np.zeros((labels + 1, 2), dtype=np.int64)
    kernels.count_sides(walls.sides, starts)
    kind = np.int32 if len(walls.triangles) < np.iinfo(np.int32).max else np.int64
    orders = [np.empty(starts[-1, side], dtype=kind) for side in range(2)]
    kernels.sort_sides(walls.sides, starts[:-1].copy(), *orders)
    tables = [np.full(len(walls.points), -1, dtype=walls.triangles.dtype) for _ in range(count)]

    def cut(label: int) -> LabelWalls:
        behind, before = (order[starts[label, side] : starts[label + 1, side]] for side, order in enumerate(orders))
        faces = np.empty((len(behind) + len(before), 3), dtype=walls.triangles.dtype)
        points = np.empty(3 * len(faces), dtype=np.int64)
        table = tables.pop()  # each thread has one
        points = np.sort(points[: kernels.list_points(walls.triangles, behind, before, table, points)])
        kernels.number_faces(walls.triangles, behind, before, table, points, faces)
        tables.append(table)
        return LabelWalls(label=label, points=points, faces=faces)

    for _, piece in in_order(cut, range(1, labels), threads=count):
        if len(piece.faces):
            yield piece
