"""A density that changes from place to place: where it is higher, walls or bars are wider, or cells smaller."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import GeometryError
from infill.interior.conformal_map import fit_conformal_map, spline_jacobians
from infill.interior.interior import Interior
from infill.lattices.field_place import LEAST_SHARE, InteriorPlace
from infill.lattices.region_nodes import SHIFTS, RegionNodes
from infill.options.density_fields import Field, SimulatedField, describe_box
from infill.plain_numbers import plain_argument
from infill.surface import Surface
from infill.voxels.scanlines import fill_rows, intersect_rows

Varies = Literal["width", "cell"]
NODES = 48  # along the longest side of a part, where the field is evaluated; it is linear in between
TABLE = 9  # densities for which widths are computed; they are linear in between
AT_ONCE = 100_000
SAMPLES = 20_000  # cells at which a field is evaluated, to find its lowest and highest values
POINTS = 200_000  # at which the density of a filled part is measured
UNIFORM_WIDTH = (np.ones((1, 1, 1), dtype=np.float32), 1.0)  # walls of one width everywhere, as kernels take it


@dataclass(frozen=True, kw_only=True, eq=False)
class LocalWidths:
    """Widths of walls over the line width, at nodes of a grid of their own.

    Parameters
    ----------
    ratio : (n, m, k) float32
        The nodes are `step` cells of the space apart; the first node lies at the first cell.
    step : float
    mean : float
        The requested density, on average inside the walls.
    shares : (n, m, k) float32
        The requested density.
    within : (n, m, k) bool
        True for nodes inside the walls.
    spline : (n + 2, m + 2, k + 2, 3) float64 or None
        Places of the nodes in a pattern whose cells follow the field: see `fit_conformal_map`. None if cells are alike.
    regions : RegionNodes or None
        The regions that have these densities; None if the density follows a field.
    """

    ratio: NDArray[np.float32]
    step: float
    mean: float
    shares: NDArray[np.float32]
    within: NDArray[np.bool_]
    spline: Floats | None = None
    regions: RegionNodes | None = None

    @property
    def widths(self) -> tuple[float, float]:
        """The smallest and the largest width of walls inside, over the line width."""
        inside = self.ratio[self.within]
        return float(inside.min()), float(inside.max())

    @property
    def cells(self) -> tuple[float, float]:
        """The smallest and the largest cell inside, over the nominal cell: sides of cubes of their volume."""
        if self.spline is None:
            return 1.0, 1.0
        sides = np.abs(np.linalg.det(spline_jacobians(self.spline)[self.within])) ** (-1 / 3)
        return float(sides.min()), float(sides.max())

    def in_box(self, corner: NDArray[np.int64], shape: tuple[int, ...]) -> LocalWidths:
        """Return the same at nodes that begin at a cell, for a box of a shape."""
        from scipy.ndimage import map_coordinates

        counts = np.ceil((np.array(shape) - 1) / self.step).astype(int) + 1
        nodes = np.indices(tuple(counts.tolist())) + corner.reshape(3, 1, 1, 1) / self.step
        ratio, shares = (map_coordinates(each, nodes, order=1, mode="nearest") for each in (self.ratio, self.shares))
        return replace(self, ratio=ratio, shares=shares, within=np.ones(ratio.shape, dtype=bool), regions=None)


@dataclass(frozen=True, kw_only=True, eq=False)
class Grading:
    """A density that follows a field.

    Parameters
    ----------
    first, last : float
        Densities where the field is lowest, and where it is highest, inside the walls.
    by : Field
    name : str
        Of the field.
    varies : {"width", "cell"}
        Wider walls or smaller cells where it is denser.
    """

    first: float
    last: float
    by: Field
    name: str
    varies: Varies = "width"

    @property
    def middle(self) -> float:
        """The density whose walls are as wide as the line width."""
        return (self.first + self.last) / 2

    @property
    def lowest(self) -> float:
        """The lower density."""
        return min(self.first, self.last)

    @property
    def thinnest(self) -> float:
        """The lower density over the middle: roughly the width of walls there over the line width."""
        return 1.0 if self.varies == "cell" else min(self.first, self.last) / self.middle

    @property
    def smallest(self) -> float:
        """Rough size of the cells over the nominal cell where it is densest."""
        return self.middle / max(self.first, self.last) if self.varies == "cell" else 1.0

    def widths_in(self, space: Interior, widths: Callable[[float], float]) -> LocalWidths:
        """Return the widths of walls in a space; `widths` gives the width for a density, in cells of the pattern."""
        shape = np.array(space.depth.shape)
        step = max(1.0, float((shape.max() - 1) / NODES))
        counts = np.ceil((shape - 1) / step).astype(int) + 1
        nodes = [step * np.arange(count) for count in counts]
        points = np.stack(np.meshgrid(*nodes, indexing="ij"), axis=-1).reshape(-1, 3)
        places = space.origin + space.size * points
        part = InteriorPlace(space=space)
        if isinstance(self.by, SimulatedField) and not self.by.covers(*part.bounds):
            lie = describe_box(self.by.points.min(axis=0), self.by.points.max(axis=0))
            raise GeometryError.about(
                "by",
                f"is {self.name}, whose points lie at {lie}, and the part at {describe_box(*part.bounds)}; "
                "give results of this part, in its place and in mm",
            )
        values = np.concatenate(
            [self.by.at(places[low : low + AT_ONCE], part) for low in range(0, len(places), AT_ONCE)]
        )
        inside = cells_inside(space, points)
        if not np.isfinite(values[inside]).all():
            raise GeometryError.about("by", f"is {self.name}, which is not finite everywhere in the part; check it")
        drawn, outermost = _sample_cells(space)
        drawn, outermost = (self.by.at(space.origin + space.size * cells, part) for cells in (drawn, outermost))
        inside_values = np.concatenate([values[inside], drawn, outermost])
        low, high = float(np.nanmin(inside_values)), float(np.nanmax(inside_values))
        if high - low <= 1e-9 * max(abs(low), abs(high), 1e-30):
            raise GeometryError.about(
                "by",
                f"is {self.name}, which is {plain_argument(low)} everywhere in the part; give one density, or a field",
            )
        share = np.clip((np.nan_to_num(values, nan=low) - low) / (high - low), 0, 1)
        shares = self.first + (self.last - self.first) * share
        table = np.linspace(min(self.first, self.last), max(self.first, self.last), TABLE)
        wide = np.array([widths(density) for density in table]) / widths(self.middle)
        ratio, spline = np.interp(shares, table, wide).reshape(counts), None
        if self.varies == "cell":
            # Doubling the width adds as much wall as halving the cells; widths make up for what cells cannot follow.
            spline, more = fit_conformal_map(ratio)
            ratio = ratio / more
        return LocalWidths(
            ratio=ratio.astype(np.float32),
            step=step,
            mean=self.first + (self.last - self.first) * float(np.nanmean((drawn - low) / (high - low))),
            shares=shares.reshape(counts).astype(np.float32),
            within=inside.reshape(counts),
            spline=spline,
        )


def cells_inside(space: Interior, points: Floats) -> NDArray[np.bool_]:
    """Test which points, in cells, lie inside the walls; all are, if none are because the part is too thin."""
    at = tuple(np.minimum(points.round().astype(int), np.array(space.depth.shape) - 1).T)
    inside = (space.depth[at] > 0) & (space.layer_shares[at[2]] >= LEAST_SHARE)
    return inside if inside.any() else np.ones(len(points), dtype=bool)


def _sample_cells(space: Interior) -> tuple[Floats, Floats]:
    """Draw random cells inside the walls, (N, 3); return also the outermost along each axis and the deepest."""
    cells = np.argwhere((space.depth > 0) & (space.layer_shares >= LEAST_SHARE))
    if not len(cells):
        cells = np.argwhere(np.ones(space.depth.shape, dtype=bool))
    deepest = np.array(np.unravel_index(int(space.depth.argmax()), space.depth.shape))[None]
    outermost = cells[np.concatenate([cells.argmin(axis=0), cells.argmax(axis=0)])]
    drawn = cells[np.random.default_rng(0).integers(len(cells), size=SAMPLES)]
    return drawn.astype(np.float64), np.concatenate([outermost, deepest]).astype(np.float64)


def densities_by_share(
    space: Interior, voids: Surface, local: LocalWidths, count: int, *, mean: float
) -> tuple[Floats, Floats]:
    """Return requested and measured densities, averaged over equal numbers of random cells: (count,) each.

    Whether a place is solid is tested on the meshes of the voids, on grids that are shifted by parts of a cell:
    vertices of the meshes lie between the centres of cells, and unshifted centres would make thin walls look thicker or
    thinner. Voids are scaled so that the mean density is exact, which removes the chance that remains.
    """
    depth, corners = space.depth, (np.asarray(voids.vertices, dtype=np.float64) - space.origin) / space.size
    candidates = np.argwhere((depth > -1) & (space.layer_shares >= LEAST_SHARE))  # at most a cell outside the walls
    cells = candidates[np.random.default_rng(0).integers(len(candidates), size=POINTS)]
    places, solid = cells.astype(np.float64), np.empty(POINTS, dtype=bool)
    for shift, indices in zip(SHIFTS, np.array_split(np.arange(POINTS), len(SHIFTS)), strict=True):
        void = fill_rows(intersect_rows(corners - shift, voids.faces, depth.shape), depth.shape)
        solid[indices] = ~void[tuple(cells[indices].T)]
        places[indices] += shift
    inside = interpolate_nodes(depth, places) > 0
    places, solid = places[inside], solid[inside]
    shares = interpolate_nodes(local.shares, places / local.step)
    groups = np.array_split(np.argsort(shares), count)
    scale = (1 - mean) / max(1 - float(solid.mean()), 1e-9)
    return (
        np.array([shares[group].mean() for group in groups]),
        np.array([1 - scale * (1 - solid[group].mean()) for group in groups]),
    )


def interpolate_nodes(nodes: NDArray[np.float32], at: Floats) -> Floats:
    """Interpolate linearly between nodes."""
    from scipy.ndimage import map_coordinates

    interpolated: Floats = map_coordinates(nodes, at.T, output=np.float64, order=1, mode="nearest")
    return interpolated
