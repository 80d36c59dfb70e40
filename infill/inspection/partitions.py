"""Compare the labels of a partition before and after smoothing: connections, and places where walls are far apart.

Before smoothing, walls are cut between the given labels in the same way, through the middles of edges, faces and
tetrahedra. Where no corner of a tetrahedron has changed its label, both walls have the same triangles in it, and no
point of one is further from the other than their corners are: so only the triangles at other places are measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from infill.arrays import Floats
from infill.inspection.bricks import TopologyCheck
from infill.inspection.changes import TopologyChanges
from infill.inspection.deviation import COUNTS, KEPT, LOST, THIN, Deviation, measure_deviation
from infill.inspection.label_connections import count_connections
from infill.partition.simplices import cells_at, middle_points, simplices
from infill.partition.walls import WallGraph, trace_walls
from infill.surface import Surface
from infill.volume import Volume

# In units of distance around changed cells: where points are measured, and the walls to which they are measured first.
NEAR, AROUND = 2, 4
OPENED = np.ones((2, 2, 2), dtype=bool)  # thicker than one cell: this fits in


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelPoints:
    """The points of a partition's walls in space, and its triangles, grouped by label.

    Parameters
    ----------
    points : (P, 3) float64, mm
    triangles : (T, 3) int64
    sides : (T, 2) int32
        Numbers of the labels behind and before each triangle.
    """

    points: Floats
    triangles: NDArray[np.integer]
    sides: NDArray[np.int32]

    @cached_property
    def _orders(self) -> tuple[NDArray[np.int64], ...]:
        """The triangles by the label behind them, and by that before them."""
        return tuple(np.argsort(side, kind="stable") for side in self.sides.T)

    @cached_property
    def _sorted(self) -> tuple[NDArray[np.int32], ...]:
        """The labels in these orders."""
        return tuple(side[order] for side, order in zip(self.sides.T, self._orders, strict=True))

    def faces(self, number: int) -> NDArray[np.int64]:
        """Return the triangles of a label, which face away from it, (F, 3)."""
        behind, before = (
            order[slice(*np.searchsorted(labels, [number, number + 1]))]
            for order, labels in zip(self._orders, self._sorted, strict=True)
        )
        return np.concatenate([self.triangles[behind], self.triangles[before][:, ::-1]])

    def surface(self, number: int) -> Surface:
        """Return the surface of a label, with its own points alone."""
        used, corners = np.unique(self.faces(number), return_inverse=True)
        return Surface(vertices=self.points[used], faces=corners.reshape(-1, 3))

    def within(self, chosen: NDArray[np.bool_]) -> LabelPoints:
        """Return the triangles of those points alone."""
        kept = chosen[self.triangles].any(axis=1)
        return LabelPoints(points=self.points, triangles=self.triangles[kept], sides=self.sides[kept])


@dataclass(frozen=True, kw_only=True, eq=False)
class PartitionCheck:
    """Labels of a partition before and after smoothing.

    Parameters
    ----------
    numbers : (n0, n1, n2) uint16
        Given labels, numbered 1, 2 ...; 0 elsewhere.
    graph : WallGraph
        The walls after smoothing.
    points : (P, 3) float32
        Their points, in cells.
    volume : Volume
        The place of the cells in space.
    count : int
        Labels, 0 among them.
    written : mapping of int to Surface
        The surfaces that are written, by the number of the label, where they have fewer triangles than these walls.
    leeway : float, mm
        How far they may lie from these walls.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """

    numbers: NDArray[np.uint16]
    graph: WallGraph
    points: NDArray[np.float32]
    volume: Volume
    count: int
    written: Mapping[int, Surface] = field(default_factory=dict)
    leeway: float = 0.0
    threads: int | None = None

    @property
    def cell(self) -> float:
        """Unit in which distances are judged, mm, as for a single label."""
        return float(self.volume.cell_size.max())

    @cached_property
    def original(self) -> LabelPoints:
        """The walls between the given labels."""
        return self._place(self._original_graph, self._original_points)

    @cached_property
    def _original_points(self) -> Floats:
        """The points of these walls, in cells."""
        return middle_points(self._original_graph)

    @cached_property
    def result(self) -> LabelPoints:
        """The walls after smoothing."""
        return self._place(self.graph, self.points)

    @cached_property
    def _original_graph(self) -> WallGraph:
        """The walls between the given labels, as they are numbered."""
        return trace_walls(self.numbers, threads=self.threads)

    def _place(self, graph: WallGraph, points: NDArray[np.floating]) -> LabelPoints:
        """Place the walls in space."""
        triangles = graph.triangles[:, ::-1] if self.volume.mirrored else graph.triangles
        places = self.volume.place(points.astype(np.float64) * self.volume.cell_size)
        return LabelPoints(points=places, triangles=triangles, sides=graph.sides)

    @cached_property
    def changed(self) -> NDArray[np.bool_]:
        """Cells whose label has changed, or beside which a point of a wall lies far from the middle."""
        changed = np.asarray(self.graph.winners != self.numbers)
        shift = (self.points - middle_points(self.graph)) * self.volume.cell_size
        far = np.linalg.norm(shift, axis=1) > KEPT * self.cell - self.leeway
        if far.any():
            last = np.array(changed.shape) - 1
            for chosen, corners in simplices(self.graph):
                for corner in corners:
                    changed[tuple(np.clip(corner[far[chosen]] - 1, 0, last).T)] = True
        return changed

    def topology(self) -> list[TopologyCheck]:
        """Compare the connections of every label, 0 first; that of 0 counts nothing."""
        before, after = (count_connections(graph, self.count) for graph in (self._original_graph, self.graph))
        return [
            TopologyCheck(
                data=data,
                result=result,
                changes=TopologyChanges(
                    walls_pierced=max(0, result.tunnels - data.tunnels), walls_lost=0, vanished_thin=0
                ),
                lost=(),
            )
            for data, result in zip(before, after, strict=True)
        ]

    def deviations(self) -> list[Deviation | None]:
        """Measure for every label, 0 first, where its walls are far apart; None if they are sure to be near."""
        deviations: list[Deviation | None] = [None] * self.count
        if not self.changed.any():
            return deviations
        reach = self.cell / self.volume.cell_size  # of a unit, along each axis, in cells
        is_around, is_near = (
            dilate_cells(self.changed, tuple(np.ceil(cells * reach).astype(int).tolist())) for cells in (AROUND, NEAR)
        )
        places = _Places(cells=is_near, volume=self.volume)
        sides = (self.original, self._original_graph, self._original_points), (self.result, self.graph, self.points)
        around = [walls.within(_look_up(is_around, points)) for walls, _, points in sides]
        unsettled = [walls.within(find_unsettled(graph, self.changed)) for walls, graph, _ in sides]
        numbers = np.unique(np.concatenate([walls.sides.ravel() for walls in unsettled]))
        for number in numbers[numbers > 0].tolist():
            parts = [walls.surface(number) for walls in unsettled]
            near = [Surface(vertices=walls.points, faces=walls.faces(number)) for walls in around]
            limits: _Places | None = None
            if number in self.written:  # its triangles are not those of the walls, so places decide what is measured
                parts[1] = near[1] = self.written[number]
                limits = places
            if all(len(surface.faces) for surface in (*parts, *near)):
                deviation = self._measure(number, *near, uncertain=limits, sampled=(parts[0], parts[1]))
                far = max(deviation.there.max, deviation.back.max, deviation.thin_distance)
                if far <= LOST * self.cell:  # exact: what is further away would be further than that
                    deviations[number] = deviation if far > KEPT * self.cell else None
                    continue
            surfaces = self.original.surface(number), self.surface(number)
            if all(len(surface.faces) for surface in surfaces):  # else it is gone
                deviations[number] = self._measure(number, *surfaces, uncertain=places)
        return deviations

    def surface(self, number: int) -> Surface:
        """Return the surface of a label after smoothing, as it is written."""
        return self.written[number] if number in self.written else self.result.surface(number)

    def exact_deviation(self, number: int) -> Deviation:
        """Measure the distances between both surfaces of a label everywhere."""
        surfaces = self.original.surface(number), self.surface(number)
        return measure_deviation(
            *surfaces, cell=self.cell, kinds=_ThicknessOf(number=number, check=self), threads=self.threads
        )

    def _measure(
        self,
        number: int,
        original: Surface,
        result: Surface,
        *,
        uncertain: _Places | None = None,
        sampled: tuple[Surface, Surface] | None = None,
    ) -> Deviation:
        """Measure the distances between both surfaces of a label where they may be large."""
        return measure_deviation(
            original,
            result,
            cell=self.cell,
            kinds=_ThicknessOf(number=number, check=self),
            exact=False,
            uncertain=uncertain,
            sampled=sampled,
            threads=self.threads,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Places:
    """Cells at which points may be far from the other surface."""

    cells: NDArray[np.bool_]
    volume: Volume

    def hold(self, points: Floats, *, threads: int | None = None) -> NDArray[np.bool_]:  # noqa: ARG002 - as others
        """Tell for points (N, 3), mm, whether they lie in the cells."""
        return _look_up(self.cells, _to_cells(points, self.volume))


@dataclass(frozen=True, kw_only=True, eq=False)
class _ThicknessOf:
    """Classifies places of a label: those between solid and void more than one cell thick count."""

    number: int
    check: PartitionCheck

    def __call__(self, points: Floats, faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG002 - a `Kinds`
        """Return the kind of points (N, 3), mm: `COUNTS` or `THIN`."""
        places = _to_cells(points, self.check.volume)
        low, high = (
            np.clip(end, 0, self.check.numbers.shape) for end in (places.min(axis=0) - 3, places.max(axis=0) + 4)
        )
        box = tuple(slice(int(a), int(b)) for a, b in zip(low, high, strict=True))
        solid = np.pad(self.check.numbers[box] == self.number, 2, mode="edge")
        position = places - low.astype(np.int64) + 2
        thick = [ndimage.binary_opening(side, OPENED) for side in (solid, ~solid)]
        beside = np.zeros((2, len(points)), dtype=bool)
        for step in np.ndindex(2, 2, 2):
            cell = np.floor(position - 0.5).astype(np.int64) + step
            cell = np.clip(cell, 0, np.array(solid.shape) - 1)
            for side in range(2):
                beside[side] |= thick[side][tuple(cell.T)]
        return np.where(beside.all(axis=0), COUNTS, THIN)


def _to_cells(points: Floats, volume: Volume) -> Floats:
    """Convert points in space, mm, to cells of a grid."""
    return np.asarray((points - np.array(volume.origin)) @ np.asarray(volume.direction) / volume.cell_size)


def _look_up(cells: NDArray[np.bool_], points: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Return the values of the cells that hold points (N, 3), in cells; points outside are in the nearest one."""
    at = points.astype(np.int32)  # towards 0: the nearest cell is the first, there
    return np.asarray(cells[tuple(np.clip(at[:, axis], 0, cells.shape[axis] - 1) for axis in range(3))])


def dilate_cells(cells: NDArray[np.bool_], reach: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark all cells up to `reach` from marked ones along each axis.

    >>> dilate_cells(np.array([[[False, False, True, False, False, False]]]), (2, 2, 2)).astype(int).tolist()
    [[[1, 1, 1, 1, 1, 0]]]
    """
    wider = cells
    for axis, steps in enumerate(reach):
        at = np.nonzero(wider)
        wider = wider.copy()
        for step in range(-steps, steps + 1):
            moved = list(at)
            moved[axis] = np.clip(at[axis] + step, 0, cells.shape[axis] - 1)
            wider[tuple(moved)] = True
    return wider


def find_unsettled(graph: WallGraph, changed: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark the points of walls (P,) whose edge, face or tetrahedron has a corner in a changed cell."""
    unsettled = np.zeros(graph.point_count, dtype=bool)
    for chosen, corners in simplices(graph):
        unsettled[chosen] = np.any([cells_at(changed, corner) for corner in corners], axis=0)
    return unsettled
