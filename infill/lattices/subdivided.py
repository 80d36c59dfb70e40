"""The voids of a pattern that depends on the part: cubes that are split where its skin is near."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import BAND, Interior
from infill.kernels.threads import in_threads, thread_count
from infill.lattices.root_finding import find_root
from infill.lattices.voids import Layout, VoidFields
from patterns.octree import FLAT, Octree, divide_cubes

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

SHELL = 1.5  # cells of the grid: width of the band outside the inner side of a wall that counts as skin
SHARES = (0.6, 0.3, 0.1)  # of a part, taken by the smallest cubes and by larger ones: a guess
NEAR, TRIES = 1e-4, 40  # of the density: error that is good enough, and tries at most
ONCE = 1 << 20  # cells of the grid in a batch


@dataclass(frozen=True, kw_only=True, eq=False)
class CubeTree:
    """Cubes in the space of a part.

    Parameters
    ----------
    doubled : (n, m, k) uint8
        For each of the smallest cubes, how often the cube around it is doubled.
    first : (3,) int64
        The number of the first of these, along each axis of the pattern.
    colours : tuple of int
        Of cubes that lie in the part: see `infill.kernels.cells.from_cubes`.
    skin : cKDTree
        The skin that the cubes follow.
    """

    doubled: NDArray[np.uint8]
    first: NDArray[np.int64]
    colours: tuple[int, ...]
    skin: cKDTree

    @property
    def reach(self) -> float:
        """Distance from cubes up to which distances are exact, in sides of the smallest cubes."""
        return 0.5 * float(1 << int(self.doubled.min()))


@dataclass(frozen=True, kw_only=True)
class Subdivided:
    """Cubes that are split where the skin of a part is near.

    Parameters
    ----------
    pattern : Octree
    turn : (3, 3) float64
        From the part to the pattern.
    anchor : (3,) float64
        The point of the part in the middle of a cube of twice the smallest side, mm.
    """

    pattern: Octree
    turn: NDArray[np.float64]
    anchor: NDArray[np.float64]

    def draw(self, layout: Layout, known: VoidFields | None = None) -> VoidFields:
        """Draw a field for each colour; the cubes depend on the space and the cell alone."""
        from infill.kernels.cells import from_cubes

        space, period = layout.space, layout.cell / layout.space.size
        tree = layout.basis_of(known)
        if not isinstance(tree, CubeTree):
            earlier = known.basis if known is not None and known.layout.space is space else None
            tree = self._build_tree(layout, earlier.skin if isinstance(earlier, CubeTree) else self._find_skin(space))
        cubes = tree.doubled, self.turn / period, self._start(space, layout.cell) - tree.first, period
        reach, sizes = min(tree.reach, BAND / period), (layout.half, *layout.ratio)
        return VoidFields(
            layout=layout,
            kernels=tuple((from_cubes, (-BAND, *cubes, reach, colour, *sizes)) for colour in tree.colours),
            find_sharpest=lambda: 90.0,
            basis=tree,
        )

    def widths(self, density: float) -> float:
        """Return a width of walls, in cells, for a density: a guess that does not depend on the part."""
        shares = np.array(SHARES[: self.pattern.levels + 1])
        shares, sides = shares / shares.sum(), 2.0 ** np.arange(len(shares))

        def log_error(times: float) -> float:
            voids = np.maximum(1 - times * density / 3 / sides, 0) ** 3
            return float(np.log((1 - shares @ voids) / density))

        return density / 3 * find_root(log_error, NEAR, TRIES)

    def _start(self, space: Interior, cell: float) -> NDArray[np.float64]:
        """Return the place of the first cell of the grid in the pattern, in sides of the smallest cubes."""
        start: NDArray[np.float64] = self.turn @ (space.origin - self.anchor) / cell + self.pattern.middle
        return start

    def _build_tree(self, layout: Layout, skin: cKDTree) -> CubeTree:
        """Divide the space into cubes that are smaller the nearer they lie to the skin of the pattern."""
        from infill.kernels.cells import colours_of_cubes

        space, cell, threads = layout.space, layout.cell, thread_count(layout.threads)
        start, step = self._start(space, cell), self.turn * space.size / cell
        to_grid, depth = np.linalg.inv(step).T, space.below_walls

        def look(places: NDArray[np.float64], farthest: float) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
            cells = (places - start) @ to_grid
            distances = np.asarray(skin.query(cells, distance_upper_bound=farthest, workers=threads)[0])
            return distances, _are_inside(depth, cells)

        ends = np.array(np.meshgrid(*[(0, n - 1) for n in space.depth.shape])).reshape(3, -1).T @ step.T + start
        cubes, lowest = divide_cubes(self.pattern, ends, cell / space.size, look)
        seen = in_threads(colours_of_cubes, space.depth, cubes, step, start - lowest, threads=threads)
        colours = tuple(np.flatnonzero(np.any(seen, axis=0)).tolist())
        return CubeTree(doubled=cubes, first=lowest, colours=colours, skin=skin)

    def _find_skin(self, space: Interior) -> cKDTree:
        """Find the cells of a grid where the pattern follows the inner side of a wall, as a search tree of places.

        They are the cells just outside it, or just inside it below a roof, where depths rise downwards by `FLAT` or
        more.
        """
        from scipy.spatial import cKDTree

        depth = space.below_walls
        rows = max(1, ONCE // depth[0].size)
        places = []
        for low in range(0, len(depth), rows):
            slab = depth[low : low + rows]
            if self.pattern.roofs:
                is_skin = np.zeros(slab.shape, dtype=bool)
                below, above = slab[:, :, :-1], slab[:, :, 1:]
                is_skin[:, :, :-1] = (below > 0) & (above <= 0) & (below - above >= FLAT)
            else:
                is_skin = (slab <= 0) & (slab > -SHELL)
            places.append(np.argwhere(is_skin) + np.array([low, 0, 0]))
        return cKDTree(np.concatenate(places))


def _are_inside(depth: NDArray[np.float32], cells: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Test which points (N, 3), in cells of the grid, lie inside the walls."""
    at, upper = np.round(cells).astype(np.int64), np.array(depth.shape) - 1
    inside: NDArray[np.bool_] = depth[tuple(np.clip(at, 0, upper).T)] > 0
    inside &= np.all((at >= 0) & (at <= upper), axis=1)
    return inside
