"""The voids that a pattern leaves in a space, each as a field of distances, in cells of the grid.

Voids that lie next to each other are in separate fields, so a wall between them needs no cell of the grid in it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Field
from infill.interior.interior import BAND, Interior
from infill.kernels.threads import in_threads, thread_count
from infill.lattices.fillets import corner_angle_between_walls
from infill.lattices.grading import UNIFORM_WIDTH, LocalWidths
from infill.lattices.request import Size
from infill.paths.ties import Ties
from patterns.polyhedra import Polyhedra
from patterns.unit_cells import Bars, BinnedEdges, Cellular, Network, Planes, Surfaces

WIDE = 1000.0  # cells, in which planes at odd angles to each other lie in all relative positions
NODES = 48  # of the table of a period, along each axis


@dataclass(frozen=True, kw_only=True, eq=False)
class Layout:
    """A space in which a pattern is drawn, and the sizes of the pattern there.

    Parameters
    ----------
    space : Interior
    cell, width : float
        Period of the pattern, and width of its walls or bars, mm.
    local : LocalWidths, optional
        Factors of the width from place to place, where the density changes.
    threads : int, optional
    """

    space: Interior
    cell: float
    width: float
    local: LocalWidths | None = None
    threads: int | None = None

    @property
    def half(self) -> float:
        """Half of the width, in cells of the grid."""
        return self.width / 2 / self.space.size

    @property
    def ratio(self) -> tuple[Field, float]:
        """Factors of the width, and the step of their nodes, as kernels take them."""
        return UNIFORM_WIDTH if self.local is None else (self.local.ratio, self.local.step)

    def scale(self, times: float, vary: Size) -> Layout:
        """Change one of the sizes so that walls are several times as dense."""
        return replace(self, width=self.width * times) if vary == "width" else replace(self, cell=self.cell / times)

    def basis_of(self, known: VoidFields | None) -> object:
        """Return the basis of an earlier drawing, if that was in the same space with the same cell, or None."""
        if known is None or known.layout.space is not self.space or known.layout.cell != self.cell:
            return None
        return known.basis


@dataclass(frozen=True, kw_only=True, eq=False)
class VoidFields:
    """The voids of a pattern in a layout: each field is computed by a kernel.

    Parameters
    ----------
    layout : Layout
    kernels : tuple of (callable, tuple)
        The kernel of each field, and its arguments between the depths and the output.
    find_sharpest : callable
        Finds the angle of the sharpest corners of voids, degrees, where walls of the pattern meet; few are sharper.
    basis : object
        What a drawing of other sizes uses again.
    ties : Ties
        Bars that tie islands of lines to the rest, mm.
    """

    layout: Layout
    kernels: tuple[tuple[Callable[..., Any], tuple[Any, ...]], ...]
    find_sharpest: Callable[[], float]
    basis: object = None
    ties: Ties = field(default_factory=Ties.none)

    @property
    def count(self) -> int:
        """Number of fields."""
        return len(self.kernels)

    def write_sdf(self, out: Field, which: int, depth: Field) -> float:
        """Write the lesser of the depth in a void and below the wall, in cells; return the number of cells it fills.

        Parameters
        ----------
        out : (nx, ny, n) float32
        which : int
            Number of the field.
        depth : (nx, ny, n) float32
            Depths in the space; of some of its layers, if the pattern is the same in all of them.
        """
        kernel, arguments = self.kernels[which]
        return float(sum(in_threads(kernel, depth, *arguments, out, threads=thread_count(self.layout.threads))))


class VoidPattern(Protocol):
    """A pattern in its place in a part."""

    def widths(self, density: float) -> float:
        """Return the width of walls or bars, in cells of the pattern, that gives a density far from any skin."""
        ...

    def draw(self, layout: Layout, known: VoidFields | None = None) -> VoidFields:
        """Draw the voids beside the pattern; what suits of an earlier drawing is used again."""
        ...


@dataclass(frozen=True, kw_only=True)
class Periodic:
    """Walls or bars that repeat along x, y and z.

    Parameters
    ----------
    pattern : Surfaces, Planes, Polyhedra, Network or Bars
    turn : (3, 3) float64
        From the part to the pattern.
    anchor : (3,) float64
        The point of the part at which a cell of the pattern begins, mm.
    """

    pattern: Cellular
    turn: NDArray[np.float64]
    anchor: NDArray[np.float64]

    def draw(self, layout: Layout, known: VoidFields | None = None) -> VoidFields:  # noqa: ARG002 - of the protocol
        """Draw two fields beside a surface, one for each class of closed cells, or one around bars."""
        from infill.kernels.cells import from_bars, from_period, from_planes, from_polyhedra

        pattern, turn, space = self.pattern, self.turn, layout.space
        start = turn @ (space.origin - self.anchor) / space.size
        period, sizes = pattern.cells * layout.cell / space.size, (layout.half, *layout.ratio)
        kernel: Callable[..., Any]
        fields: list[tuple[Any, ...]]
        if isinstance(pattern, Bars):
            kernel, fields = from_bars, [(*_bin_bars(pattern), turn, start, period, *sizes)]
        elif isinstance(pattern, Planes):
            normals, offsets = pattern.families()
            apart = period / np.linalg.norm(normals, axis=1)
            planes = normals @ turn / period, normals @ start / period + offsets, apart
            kernel, fields = from_planes, [(*planes, which, *sizes) for which in range(pattern.classes)]
        elif isinstance(pattern, Polyhedra):
            (normals, halves), (box, middles) = pattern.faces(), pattern.lattice()
            faces = turn, start, normals, halves * period, box * period
            kernel, fields = from_polyhedra, [(*faces, middle * period, *sizes) for middle in middles]
        else:
            signs = (1.0,) if pattern.bars else (1.0, -1.0)
            kernel, last = from_period, tuple[Any, ...]()
            if layout.local is not None and layout.local.spline is not None:
                from infill.kernels.stretched import from_stretched_period

                kernel, last = from_stretched_period, (layout.local.spline,)
            fields = [(period_table(pattern), turn, start, period, sign, *sizes, *last) for sign in signs]
        return VoidFields(
            layout=layout,
            kernels=tuple((kernel, (-BAND, *arguments)) for arguments in fields),
            find_sharpest=partial(corner_angle_between_walls, pattern),
        )

    def widths(self, density: float) -> float:
        """Return the width of walls or bars, in cells, that gives a density far from any skin."""
        return float(2 * np.quantile(_sample_distances(self.pattern), density))


@cache
def period_table(pattern: Surfaces | Network) -> NDArray[np.float32]:
    """Compute the distances from a surface at the nodes of one period, in periods, as kernels read them."""
    line = np.arange(NODES) / NODES
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    return pattern.distance(points).reshape(NODES, NODES, NODES).astype(np.float32)


@cache
def _bin_bars(pattern: Bars) -> BinnedEdges:
    """Return the bars of a pattern, sorted for the search of the nearest; cached."""
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
