"""The voids that a pattern leaves in a part, each as a field of distances, in cells of the grid.

Voids that lie next to each other are in separate fields, so a wall between them needs no cell of the grid in it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import BAND, Interior
from infill.kernels.threads import in_threads, thread_count
from infill.lattices.bodies import Bodies
from infill.lattices.fillets import corner_angle_between_walls
from infill.lattices.grading import UNIFORM_WIDTH, Grading, LocalWidths
from patterns.polyhedra import Polyhedra
from patterns.unit_cells import Bars, BinnedEdges, Cellular, Network, Planes, Surfaces

WIDE = 1000.0  # cells, in which planes at odd angles to each other lie in all relative positions
NODES = 48  # of the table of a period, along each axis
FIELD = NDArray[np.float32]


class Voids(Protocol):
    """The voids of a pattern."""

    def count(self, space: Interior, *, cell: float, width: float) -> int:
        """Count the fields that the voids need."""
        ...

    def into(self, out: FIELD, space: Interior, which: int, *, cell: float, width: float) -> float:
        """Write the lesser of the depth in the void and below the wall; return the number of cells it fills."""
        ...

    def widths(self, density: float) -> float:
        """Return the width of walls or bars, in cells of the pattern, that gives a density far from any skin."""
        ...

    def sharpest(self, space: Interior, *, cell: float, width: float) -> float:
        """Return the angle of the sharpest corners of voids, degrees, where walls of the pattern meet."""
        ...

    def prepare(self, space: Interior, *, cell: float, width: float) -> Self:
        """Return the same with all that depends on the space computed, so that drawing it again takes less time."""
        ...

    def with_widths(self, local: LocalWidths) -> Self:
        """Return the same with other local widths."""
        ...

    @property
    def grading(self) -> Grading | None:
        """Variation of the width from place to place; the nominal width is that of the middle density."""
        ...

    @property
    def local(self) -> LocalWidths | None:
        """Widths from place to place in the space; None if they are not computed yet."""
        ...


@dataclass(frozen=True, kw_only=True)
class Periodic:
    """The voids beside walls or bars that repeat along x, y and z.

    Parameters
    ----------
    pattern : Surfaces, Planes, Polyhedra, Network or Bars
    turn : (3, 3) float64
        From the part to the pattern.
    anchor : (3,) float64
        The point of the part at which a cell of the pattern begins, mm.
    threads : int, optional
    grading : Grading, optional
    bodies : Bodies, optional
        Set if the pattern starts over in each component of the part; the anchor is then relative to its middle.
    local : LocalWidths, optional
        Widths in the space, once they are computed.
    """

    pattern: Cellular
    turn: NDArray[np.float64]
    anchor: NDArray[np.float64]
    threads: int | None = None
    grading: Grading | None = None
    bodies: Bodies | None = None
    local: LocalWidths | None = None

    def prepare(self, space: Interior, *, cell: float, width: float) -> Periodic:
        """See `Voids`."""
        if self.bodies is None:
            return self
        return replace(self, bodies=self.bodies.prepare(self, space, cell=cell, width=width))

    def with_widths(self, local: LocalWidths) -> Periodic:
        """See `Voids`."""
        return replace(self, local=local, bodies=self.bodies and self.bodies.with_widths(local))

    def sharpest(self, space: Interior, *, cell: float, width: float) -> float:  # noqa: ARG002 - of the protocol
        """See `Voids`: the same for all cells."""
        return _sharpest_angle(self.pattern)

    def about(self, middle: NDArray[np.float64]) -> Periodic:
        """See `Anchored`."""
        return replace(self, anchor=middle + self.anchor, bodies=None)

    def count(self, space: Interior, *, cell: float, width: float) -> int:  # noqa: ARG002 - of the protocol
        """Count the fields: two beside a surface, one for each class of closed cells, one around bars."""
        if isinstance(self.pattern, (Planes, Polyhedra)):
            return self.pattern.classes
        return 1 if self.pattern.bars else 2

    def into(self, out: FIELD, space: Interior, which: int, *, cell: float, width: float) -> float:
        """See `Voids`."""
        from infill.kernels.cells import from_bars, from_period, from_planes, from_polyhedra

        if self.bodies is not None:
            return self.bodies.into(self, out, space, which, cell=cell, width=width)
        start = self.turn @ (space.origin - self.anchor) / space.size
        period, half = self.pattern.cells * cell / space.size, width / 2 / space.size
        local, threads = find_local_widths(self, space), thread_count(self.threads)
        sizes = UNIFORM_WIDTH if local is None else (local.ratio, local.step)
        if isinstance(self.pattern, Bars):
            filled = in_threads(
                from_bars,
                space.depth,
                -BAND,
                *_bin_bars(self.pattern),
                self.turn,
                start,
                period,
                half,
                *sizes,
                out,
                threads=threads,
            )
        elif isinstance(self.pattern, Planes):
            normals, offsets = self.pattern.families()
            filled = in_threads(
                from_planes,
                space.depth,
                -BAND,
                normals @ self.turn / period,
                normals @ start / period + offsets,
                period / np.linalg.norm(normals, axis=1),
                which,
                half,
                *sizes,
                out,
                threads=threads,
            )
        elif isinstance(self.pattern, Polyhedra):
            (normals, halves), (box, middles) = self.pattern.faces(), self.pattern.lattice()
            filled = in_threads(
                from_polyhedra,
                space.depth,
                -BAND,
                self.turn,
                start,
                normals,
                halves * period,
                box * period,
                middles[which] * period,
                half,
                *sizes,
                out,
                threads=threads,
            )
        elif local is not None and local.spline is not None:
            from infill.kernels.stretched import from_stretched_period

            filled = in_threads(
                from_stretched_period,
                space.depth,
                -BAND,
                period_table(self.pattern),
                self.turn,
                start,
                period,
                1.0 if which == 0 else -1.0,
                half,
                *sizes,
                local.spline,
                out,
                threads=threads,
            )
        else:
            filled = in_threads(
                from_period,
                space.depth,
                -BAND,
                period_table(self.pattern),
                self.turn,
                start,
                period,
                1.0 if which == 0 else -1.0,
                half,
                *sizes,
                out,
                threads=threads,
            )
        return float(sum(filled))

    def widths(self, density: float) -> float:
        """See `Voids`."""
        return float(2 * np.quantile(_sample_distances(self.pattern), density))


def local_widths(voids: Voids, space: Interior) -> tuple[NDArray[np.float32], float]:
    """Return the factors of the width of walls, and the step of their nodes, as kernels take them."""
    local = find_local_widths(voids, space)
    return UNIFORM_WIDTH if local is None else (local.ratio, local.step)


def find_local_widths(voids: Voids, space: Interior) -> LocalWidths | None:
    """Return the widths from place to place in a space; None if walls have the same width everywhere."""
    if voids.grading is None or voids.local is not None:
        return voids.local
    return voids.grading.over(space, voids.widths)


@cache
def period_table(pattern: Surfaces | Network) -> NDArray[np.float32]:
    """Compute the distances from a surface at the nodes of one period, in periods, as kernels read them."""
    line = np.arange(NODES) / NODES
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    return pattern.distance(points).reshape(NODES, NODES, NODES).astype(np.float32)


@cache
def _sharpest_angle(pattern: Cellular) -> float:
    return corner_angle_between_walls(pattern)


@cache
def _bin_bars(pattern: Bars) -> BinnedEdges:
    return pattern.around_cell()


@cache
def _sample_distances(pattern: Cellular) -> NDArray[np.floating]:
    """Return the distances of points spread evenly over a period from the walls or bars, in cells."""
    if isinstance(pattern, Planes):
        if not all(float(component).is_integer() for normal in pattern.normals for component in normal):
            # They do not repeat in any cube.
            return pattern.distance(np.random.default_rng(0).uniform(0, WIDE, (NODES**3, 3)))
        line = (np.arange(NODES) + 0.5) / NODES
        return pattern.distance(np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3))
    if isinstance(pattern, Polyhedra):
        from infill.kernels.cells import from_polyhedra

        box, middles = pattern.lattice()
        deep, distances = np.full((NODES,) * 3, np.float32(np.inf)), np.empty((NODES,) * 3, dtype=np.float32)
        all_middles, step = middles.reshape(-1, 3), box / NODES
        from_polyhedra(
            deep, 0.0, np.diag(step), step / 2, *pattern.faces(), box, all_middles, 0.0, *UNIFORM_WIDTH, distances, 0, 1
        )
        return distances.ravel()
    if not isinstance(pattern, Bars):
        return np.abs(period_table(pattern)).ravel()
    from infill.kernels.cells import from_bars

    nodes = NODES * pattern.cells
    deep, distances = np.full((nodes,) * 3, np.float32(np.inf)), np.empty((nodes,) * 3, dtype=np.float32)
    from_bars(
        deep, 0.0, *_bin_bars(pattern), np.eye(3), np.full(3, 0.5), float(nodes), 0.0, *UNIFORM_WIDTH, distances, 0, 1
    )
    return distances.ravel() / NODES
