"""Compare the labels of a partition before and after smoothing: connections, and places where walls are far apart.

Before smoothing, walls are cut between the given labels in the same way, through the middles of edges, faces and
tetrahedra. Where no corner of a tetrahedron has changed its label, both walls have the same triangles in it, and no
point of one is further from the other than their corners are: so only the triangles at other places are measured.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
from infill.kernels.threads import in_order, thread_count
from infill.kernels.wall_points import find_thick
from infill.meshes.distance import TriangleTree
from infill.partition.wall_points import mark_beside, mark_far, mark_labels, place_middles
from infill.partition.walls import LabelCutter, WallGraph, cut_triangles, trace_walls
from infill.surface import Surface
from infill.volume import Volume

# In units of distance around changed cells: where points are measured, and the walls to which they are measured first.
NEAR, AROUND = 2, 4
MOST_BOXES = 8  # of the grid: cells in the boxes of all labels, up to which walls are traced in each
UNSETTLED_SHARE = 0.25  # of the triangles of a surface
LAYERS = 32  # of a grid at a time
LARGE = 2**20  # triangles of a label: it alone is measured by several threads


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelPart:
    """The surface of a label, or parts of it, and where its points lie.

    Parameters
    ----------
    surface : Surface, mm
    cells : (V, 3) float
        Its points, in cells.
    unsettled : (V,) bool
        Points whose edge, face or tetrahedron has a corner in a changed cell.
    """

    surface: Surface
    cells: NDArray[np.floating]
    unsettled: NDArray[np.bool_]

    def within(self, chosen: NDArray[np.bool_]) -> Surface:
        """Return the triangles with chosen points (V,), and their points alone."""
        faces = self.surface.faces
        kept = faces[mark_faces(faces, chosen)]
        used = np.zeros(len(chosen), dtype=bool)
        used[kept] = True
        rank = np.cumsum(used, dtype=kept.dtype) - 1
        return Surface(vertices=self.surface.vertices[used], faces=rank[kept])


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
    cutter : LabelCutter, optional
        Of these walls, if there is one already.
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
    cutter: LabelCutter | None = None
    written: Mapping[int, Surface] = field(default_factory=dict)
    leeway: float = 0.0
    threads: int | None = None

    @property
    def cell(self) -> float:
        """Unit in which distances are judged, mm, as for a single label."""
        return float(self.volume.cell_size.max())

    @cached_property
    def _cutter(self) -> LabelCutter:
        """Cuts the surfaces of labels after smoothing out of all walls."""
        return self.cutter or LabelCutter.of(self.graph.triangles, self.graph.sides, self.count)

    @cached_property
    def _boxes(self) -> list[tuple[slice, ...] | None]:
        """The cells that hold each label before smoothing and one around them, that of 1 first."""
        boxes = ndimage.find_objects(self.numbers, max_label=self.count - 1)
        return [box and tuple(slice(max(0, side.start - 1), side.stop + 1) for side in box) for box in boxes]

    @cached_property
    def whole(self) -> tuple[WallGraph, LabelCutter] | None:
        """The walls between all given labels, where tracing them in the box of every label would take longer."""
        shape = self.numbers.shape
        cells = sum(
            np.prod([len(range(*side.indices(n))) for side, n in zip(box, shape, strict=True)])
            for box in self._boxes
            if box
        )
        if cells <= MOST_BOXES * self.numbers.size:
            return None
        graph = trace_walls(self.numbers, threads=self.threads)
        return graph, LabelCutter.of(graph.triangles, graph.sides, self.count)

    def given(self, number: int) -> LabelPart:
        """Return the surface of a label before smoothing."""
        box = self._boxes[number - 1]
        if box is None:
            return LabelPart(
                surface=Surface(vertices=np.empty((0, 3)), faces=np.empty((0, 3), dtype=np.int32)),
                cells=np.empty((0, 3)),
                unsettled=np.empty(0, dtype=bool),
            )
        if self.whole is not None:
            graph, cutter = self.whole
            cut, corner, changed = cutter.cut(number), (0, 0, 0), self.changed
        else:
            graph = trace_walls(np.ascontiguousarray(self.numbers[box]), threads=1)
            behind, before = (np.flatnonzero(side == number) for side in graph.sides.T)
            cut, corner = cut_triangles(graph.triangles, behind, before, number), tuple(side.start for side in box)
            changed = np.ascontiguousarray(self.changed[box])
        cells = place_middles(graph, corner=corner, shape=self.numbers.shape)[cut.points]
        unsettled = mark_beside(graph, changed, threads=1)[cut.points]
        return LabelPart(surface=self._place(cells, cut.faces), cells=cells, unsettled=unsettled)

    def result(self, number: int) -> LabelPart:
        """Return the surface of a label after smoothing, with all triangles."""
        cut = self._cutter.cut(number)
        cells = self.points[cut.points]
        return LabelPart(surface=self._place(cells, cut.faces), cells=cells, unsettled=self._unsettled[cut.points])

    def surface(self, number: int) -> Surface:
        """Return the surface of a label after smoothing, as it is written."""
        return self.written[number] if number in self.written else self.result(number).surface

    def _place(self, cells: NDArray[np.floating], faces: NDArray[np.integer]) -> Surface:
        """Place a surface in space."""
        vertices = self.volume.place(cells.astype(np.float64) * self.volume.cell_size)
        return Surface(vertices=vertices, faces=faces[:, ::-1] if self.volume.mirrored else faces)

    @cached_property
    def changed(self) -> NDArray[np.bool_]:
        """Cells whose label has changed, or beside which a point of a wall lies far from the middle."""
        changed = np.asarray(self.graph.winners != self.numbers)
        limit = KEPT * self.cell - self.leeway
        mark_far(self.graph, self.points, self.volume.cell_size, limit, changed, threads=self.threads)
        return changed

    @cached_property
    def _unsettled(self) -> NDArray[np.bool_]:
        """The points of walls after smoothing (P,) whose edge, face or tetrahedron has a corner in a changed cell."""
        return mark_beside(self.graph, self.changed, threads=self.threads)

    def topology(self) -> list[TopologyCheck]:
        """Compare the connections of every label, 0 first; that of 0 counts nothing."""
        before, after = (
            count_connections(winners, self.count, threads=self.threads)
            for winners in (self.numbers, self.graph.winners)
        )
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
        is_unsettled = mark_labels(self.graph, self._unsettled, self.count, threads=self.threads)
        reach = self.cell / self.volume.cell_size  # of a unit, along each axis, in cells
        around, near = (
            dilate_cells(self.changed, tuple(np.ceil(cells * reach).astype(int).tolist())) for cells in (AROUND, NEAR)
        )
        _ = self.whole, self._cutter, self._boxes  # made before threads ask for them

        def compare(number: int) -> Deviation | None:
            return self._compare(number, around, near, is_unsettled=bool(is_unsettled[number]))

        for number, deviation in in_order(compare, range(1, self.count), threads=thread_count(self.threads)):
            deviations[number] = deviation
        return deviations

    def _compare(
        self, number: int, around: NDArray[np.bool_], near: NDArray[np.bool_], *, is_unsettled: bool
    ) -> Deviation | None:
        """Measure where the walls of a label are far apart; None if they are sure to be near.

        Parameters
        ----------
        number : int
        around, near : (n0, n1, n2) bool
            Cells beside changed ones: see `AROUND`.
        is_unsettled : bool
            Whether its walls after smoothing have unsettled points.
        """
        box = self._boxes[number - 1]
        if not is_unsettled and (box is None or not self.changed[box].any()):
            return None
        given = self.given(number)
        if not is_unsettled and not given.unsettled.any():
            return None
        sides = [given]
        if number in self.written:
            written = self.written[number]
        else:
            sides.append(self.result(number))
            written = sides[1].surface
        wholes = given.surface, written
        if not all(len(surface.faces) for surface in wholes):  # it is gone
            return None
        parts = [side.within(side.unsettled) for side in sides]
        # Where much is unsettled, the tree of all of a surface serves twice.
        trees = [
            TriangleTree.of(surface) if len(part.faces) > UNSETTLED_SHARE * len(surface.faces) else None
            for part, surface in zip(parts, wholes, strict=False)
        ]
        beside = [
            side.within(look_up(around, side.cells)) if tree is None else side.surface
            for side, tree in zip(sides, trees, strict=True)
        ]
        places, limits = _Places(cells=near, volume=self.volume), None
        if number in self.written:  # its triangles are not those of the walls, so places decide what is measured
            parts.append(written)
            beside.append(written)
            trees.append(TriangleTree.of(written))
            limits = places
        if all(len(surface.faces) for surface in (*parts, *beside)):
            deviation = self._measure(number, *beside, uncertain=limits, sampled=(parts[0], parts[1]), trees=trees)
            far = max(deviation.there.max, deviation.back.max, deviation.thin_distance)
            if far <= LOST * self.cell:  # exact: what is further away would be further than that
                return deviation if far > KEPT * self.cell else None
        return self._measure(number, *wholes, uncertain=places, trees=trees)

    def exact_deviation(self, number: int) -> Deviation:
        """Measure the distances between both surfaces of a label everywhere."""
        surfaces = self.given(number).surface, self.surface(number)
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
        trees: Sequence[TriangleTree | None],
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
            trees=(trees[0], trees[1]),
            # Others are measured at the same time.
            threads=1 if len(result.faces) < LARGE else self.threads,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Places:
    """Cells at which points may be far from the other surface."""

    cells: NDArray[np.bool_]
    volume: Volume

    def hold(self, points: Floats, *, threads: int | None = None) -> NDArray[np.bool_]:  # noqa: ARG002 - as others
        """Tell for points (N, 3), mm, whether they lie in the cells."""
        return look_up(self.cells, _to_cells(points, self.volume))


@dataclass(frozen=True, kw_only=True, eq=False)
class _ThicknessOf:
    """Classifies places of a label: those between solid and void more than one cell thick count."""

    number: int
    check: PartitionCheck

    def __call__(self, points: Floats, faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG002 - a `Kinds`
        """Return the kind of points (N, 3), mm: `COUNTS` or `THIN`."""
        is_thick = np.empty(len(points), dtype=bool)
        find_thick(_to_cells(points, self.check.volume), self.check.numbers, self.number, is_thick)
        return np.where(is_thick, COUNTS, THIN)


def _to_cells(points: Floats, volume: Volume) -> Floats:
    """Convert points in space, mm, to cells of a grid."""
    turn, places = np.asarray(volume.direction), points - np.array(volume.origin)
    return np.asarray((places if (turn == np.eye(3)).all() else places @ turn) / volume.cell_size)


def look_up(cells: NDArray[np.bool_], points: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Return the values of the cells that hold points (N, 3), in cells; points outside are in the nearest one."""
    at = points.astype(np.int32)  # towards 0: the nearest cell is the first, there
    return np.asarray(cells[tuple(np.clip(at[:, axis], 0, cells.shape[axis] - 1) for axis in range(3))])


def dilate_cells(cells: NDArray[np.bool_], reach: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark all cells up to `reach` from marked ones along each axis.

    >>> dilate_cells(np.array([[[False, False, True, False, False, False]]]), (2, 2, 2)).astype(int).tolist()
    [[[1, 1, 1, 1, 1, 0]]]
    """
    wider = np.empty_like(cells)
    for begin in range(0, len(cells), LAYERS):  # in slabs, since lists of places are larger than cells
        low, end = max(0, begin - reach[0]), min(len(cells), begin + LAYERS)
        wider[begin:end] = _dilate_slab(cells[low : end + reach[0]], reach)[begin - low : end - low]
    return wider


def _dilate_slab(cells: NDArray[np.bool_], reach: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark the cells up to `reach` from marked ones, in a part of a grid."""
    wider = cells
    for axis, steps in enumerate(reach):
        at = np.nonzero(wider)
        wider = wider.copy()
        for step in range(-steps, steps + 1):
            moved = list(at)
            moved[axis] = np.clip(at[axis] + step, 0, cells.shape[axis] - 1)
            wider[tuple(moved)] = True
    return wider


def mark_faces(faces: NDArray[np.integer], chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark the faces (F, 3) with a chosen corner."""
    return np.asarray(chosen[faces[:, 0]] | chosen[faces[:, 1]] | chosen[faces[:, 2]])
