"""A density that changes from place to place: where it is higher, walls or bars are wider, or cells smaller."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.interior.conformal_map import slopes_of, stretched
from infill.interior.interior import Space
from infill.lattices.density_fields import Field

Varies = Literal["width", "cell"]
NODES = 48  # along the longest side of a part: where the field is asked for; it is straight in between
TABLE = 9  # densities of which widths are computed; they are straight in between
AT_ONCE = 100_000
SAMPLES = 20_000  # cells at which a field is asked for, to know where it is lowest and highest


@dataclass(frozen=True, kw_only=True, eq=False)
class Local:
    """How many times as wide as the line width walls are, at nodes of a grid of its own.

    Parameters
    ----------
    ratio : (n, m, k) float32
        The nodes are `step` cells of the space apart, and the first lies at its first.
    step : float
    mean : float
        The density that is asked for, on average inside the walls.
    shares : (n, m, k) float32
        The density that is asked for.
    within : (n, m, k) bool
        Which nodes lie inside the walls.
    spline : (n + 2, m + 2, k + 2, 3) float64 or None
        Where the nodes lie in a pattern whose cells follow the field: see `stretched`. None if cells are all alike.
    """

    ratio: NDArray[np.float32]
    step: float
    mean: float
    shares: NDArray[np.float32]
    within: NDArray[np.bool_]
    spline: NDArray[np.float64] | None = None

    @property
    def widths(self) -> tuple[float, float]:
        """How many times as wide as the line width walls are, inside, at least and at most."""
        inside = self.ratio[self.within]
        return float(inside.min()), float(inside.max())

    @property
    def cells(self) -> tuple[float, float]:
        """How many times as large as called the cells are, inside, at least and at most: as cubes of their volume."""
        if self.spline is None:
            return 1.0, 1.0
        sides = np.abs(np.linalg.det(slopes_of(self.spline)[self.within])) ** (-1 / 3)
        return float(sides.min()), float(sides.max())

    def in_box(self, first: NDArray[np.int64], shape: tuple[int, ...]) -> Local:
        """Return the same at nodes that begin at a cell, for a box of a shape."""
        from scipy.ndimage import map_coordinates

        counts = np.ceil((np.array(shape) - 1) / self.step).astype(int) + 1
        nodes = np.indices(tuple(counts.tolist())) + first.reshape(3, 1, 1, 1) / self.step
        ratio, shares = (map_coordinates(each, nodes, order=1, mode="nearest") for each in (self.ratio, self.shares))
        return replace(self, ratio=ratio, shares=shares, within=np.ones(ratio.shape, dtype=bool))


@dataclass(frozen=True, kw_only=True, eq=False)
class Grading:
    """A density that follows a field.

    Parameters
    ----------
    first, last : float
        Where the field is lowest, and where it is highest, inside the walls.
    by : Field
    name : str
        What the field is called.
    varies : {"width", "cell"}
        Whether walls are wider where it is denser, or cells smaller.
    known : dict
        What was found for a space.
    """

    first: float
    last: float
    by: Field
    name: str
    varies: Varies = "width"
    known: dict[tuple[object, ...], Local] = field(default_factory=dict)

    @property
    def middle(self) -> float:
        """The density whose walls are as wide as the line width."""
        return (self.first + self.last) / 2

    @property
    def thinnest(self) -> float:
        """The lower density, over the middle: about how many times as wide as the line width walls are there."""
        return 1.0 if self.varies == "cell" else min(self.first, self.last) / self.middle

    @property
    def smallest(self) -> float:
        """About how many times as large as called cells are where it is densest."""
        return self.middle / max(self.first, self.last) if self.varies == "cell" else 1.0

    def over(self, space: Space, widths: Callable[[float], float]) -> Local:
        """Return the widths of walls in a space; `widths` says which gives a density, in cells of the pattern."""
        if space.box_of is not None:
            whole, first = space.box_of
            return self.over(whole, widths).in_box(first, space.depth.shape)
        space = space.walled or space
        key = (space.depth.shape, space.size, *space.origin.tolist())
        if key not in self.known:
            self.known.clear()
            self.known[key] = self._found(space, widths)
        return self.known[key]

    def _found(self, space: Space, widths: Callable[[float], float]) -> Local:
        shape = np.array(space.depth.shape)
        step = max(1.0, float((shape.max() - 1) / NODES))
        counts = np.ceil((shape - 1) / step).astype(int) + 1
        nodes = [step * np.arange(count) for count in counts]
        points = np.stack(np.meshgrid(*nodes, indexing="ij"), axis=-1).reshape(-1, 3)
        where = space.origin + space.size * points
        found = np.concatenate([self.by.at(where[low : low + AT_ONCE], space) for low in range(0, len(where), AT_ONCE)])
        inside = _inside(space, points)
        if not np.isfinite(found[inside]).all():
            raise GeometryError(f"by is {self.name}, which is not finite everywhere in the part; check it")
        drawn, outermost = _drawn(space)
        drawn, outermost = (self.by.at(space.origin + space.size * each, space) for each in (drawn, outermost))
        known = np.concatenate([found[inside], drawn, outermost])
        low, high = float(np.nanmin(known)), float(np.nanmax(known))
        if high - low <= 1e-9 * max(abs(low), abs(high), 1e-30):
            raise GeometryError(
                f"by is {self.name}, which is {low:g} everywhere in the part; give one density, or a field"
            )
        share = np.clip((np.nan_to_num(found, nan=low) - low) / (high - low), 0, 1)
        shares = self.first + (self.last - self.first) * share
        table = np.linspace(min(self.first, self.last), max(self.first, self.last), TABLE)
        wide = np.array([widths(each) for each in table]) / widths(self.middle)
        ratio, spline = np.interp(shares, table, wide).reshape(counts), None
        if self.varies == "cell":
            # Walls twice as wide are as much as cells half as large; what cells cannot follow, widths do.
            spline, more = stretched(ratio)
            ratio = ratio / more
        return Local(
            ratio=ratio.astype(np.float32),
            step=step,
            mean=self.first + (self.last - self.first) * float(np.nanmean((drawn - low) / (high - low))),
            shares=shares.reshape(counts).astype(np.float32),
            within=inside.reshape(counts),
            spline=spline,
        )

    def correct(self, factors: Callable[[NDArray[np.float32]], NDArray[np.floating]]) -> None:
        """Make walls wider by what a function of the shares asked for returns."""
        ((key, local),) = self.known.items()
        self.known[key] = replace(local, ratio=(local.ratio * factors(local.shares)).astype(np.float32))


def _inside(space: Space, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which points, in cells, lie inside the walls; all, if the part is too thin for any of them to."""
    at = tuple(np.minimum(points.round().astype(int), np.array(space.depth.shape) - 1).T)
    inside = (space.depth[at] > 0) & (space.shares[at[2]] >= 0.5)
    return inside if inside.any() else np.ones(len(points), dtype=bool)


def _drawn(space: Space) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return cells inside the walls that are drawn by chance, (N, 3), and the outermost along each axis and deepest."""
    cells = np.argwhere(space.within)
    if not len(cells):
        cells = np.argwhere(np.ones(space.depth.shape, dtype=bool))
    deepest = np.array(np.unravel_index(int(space.depth.argmax()), space.depth.shape))[None]
    outermost = cells[np.concatenate([cells.argmin(axis=0), cells.argmax(axis=0)])]
    drawn = cells[np.random.default_rng(0).integers(len(cells), size=SAMPLES)]
    return drawn.astype(np.float64), np.concatenate([outermost, deepest]).astype(np.float64)


NONE = (np.ones((1, 1, 1), dtype=np.float32), 1.0)  # walls of one width everywhere, as kernels take it
