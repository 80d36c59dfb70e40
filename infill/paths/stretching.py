"""Families of paths whose cells change from place to place: drawn alike in a plane of their own, and stretched.

::

    plane of the pattern, (u, v)          bed, (x, y)
    |  |  |  |  |  |  |            |    |   |  |  |  | | |
    |  |  |  |  |  |  |    --->    |    |   |  |  |  | | |
    |  |  |  |  |  |  |            |    |   |  |  |  | | |

The map between the planes is smooth and turns nowhere inside out, so no line crosses another. Beads that touch lie on
one another in the plane of the pattern, and move apart on the bed, across their lines, so that they touch there too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.paths.families.family import Bounds, Family, NominalStrand, Path, PathSpec
from infill.ragged import concatenate_rows, split_rows

LONGEST_LEG = 0.5  # cells: longer legs of a line are divided before they are stretched
MOST_BEND = 0.006  # mm between a stretched leg and its chord; legs that bend more are divided
MOST_PIECES = 16  # of such a leg
EDGE_POINTS = 65  # on each side of a box whose place in the plane of the pattern is sought
SADDLE_ROOM = 1.1  # times the distance of touching beads that lines of a surface keep, in cells of the smallest size
STRETCHED_TOUCH = 0.98  # line widths between beads that touch: more than `TOUCH`, as stretching moves some by 2 %
LEAST_SPACING = 0.98  # line widths between joins along walls and other lines; 0.95 after rounding
MARGIN = 1.0  # cells around a box, in which lines are still drawn
NEWTON_STEPS = 12
CONVERGED = 1e-7  # mm
PADDING = 16  # nodes


@dataclass(frozen=True, kw_only=True, eq=False)
class PlaneSpline:
    """A smooth function of the plane: a cubic spline over nodes.

    Parameters
    ----------
    corner : (2,) float64, mm
        The first node.
    step : float, mm
    coefficients : (n + 2, m + 2, K) float64
        Over the nodes, and one more on either side.
    """

    corner: Floats
    step: float
    coefficients: Floats

    @property
    def shape(self) -> tuple[int, int]:
        """Number of nodes along each axis."""
        n, m, _ = self.coefficients.shape
        return n - 2, m - 2

    def nodes(self) -> Floats:
        """Return the nodes, (n, m, 2), mm."""
        axes = [low + self.step * np.arange(count) for low, count in zip(self.corner, self.shape, strict=True)]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)

    def holds(self, points: Floats) -> NDArray[np.bool_]:
        """Tell which points, (N, 2), mm, lie between the nodes."""
        places = (points - self.corner) / self.step
        inside: NDArray[np.bool_] = np.all((places >= 0) & (places <= np.array(self.shape) - 1), axis=1)
        return inside

    def at(self, points: Floats) -> Floats:
        """Evaluate the spline at points (N, 2) between the nodes, mm: (N, K)."""
        from scipy.ndimage import map_coordinates

        places = (points - self.corner).T / self.step + 1
        parts = [
            map_coordinates(part, places, order=3, prefilter=False) for part in np.moveaxis(self.coefficients, -1, 0)
        ]
        return np.stack(parts, axis=-1)


def pattern_bounds(forward: PlaneSpline, bounds: Bounds) -> Bounds:
    """Return the box around a box of the bed in the plane of the pattern, as far as the nodes of the map reach."""
    x0, y0, x1, y1 = bounds
    along_x, along_y = np.linspace(x0, x1, EDGE_POINTS), np.linspace(y0, y1, EDGE_POINTS)
    edge = np.concatenate(
        [np.stack(np.broadcast_arrays(along_x, y), axis=-1) for y in (y0, y1)]
        + [np.stack(np.broadcast_arrays(x, along_y), axis=-1) for x in (x0, x1)]
    )
    first, last = forward.corner, forward.corner + forward.step * (np.array(forward.shape) - 1)
    mapped = forward.at(np.clip(edge, first, last))
    low, high = mapped.min(axis=0), mapped.max(axis=0)
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


@dataclass(frozen=True, kw_only=True, eq=False)
class PlaneMap:
    """A map from the bed to the plane of a pattern, and back.

    Parameters
    ----------
    forward : PlaneSpline
        From the bed to the plane of the pattern.
    slopes : (n, m, 2, 2) float64
        Its derivatives at its nodes.
    inverse : PlaneSpline
        From the plane of the pattern to the bed: this one is exact by definition.
    """

    forward: PlaneSpline
    slopes: Floats
    inverse: PlaneSpline

    def slopes_at(self, points: Floats) -> Floats:
        """Return the derivatives of the forward map at points on the bed, (N, 2, 2)."""
        from scipy.ndimage import map_coordinates

        places = (points - self.forward.corner).T / self.forward.step
        parts = [
            map_coordinates(self.slopes[..., row, column], places, order=1, mode="nearest")
            for row in (0, 1)
            for column in (0, 1)
        ]
        return np.stack(parts, axis=-1).reshape(-1, 2, 2)

    def scale_at(self, points: Floats) -> Floats:
        """Return the number of cells in a length over that of the nominal cell, at points on the bed: (N,)."""
        scale: Floats = np.sqrt(np.maximum(np.linalg.det(self.slopes_at(points)), 0.0))
        return scale

    @cached_property
    def largest_scale(self) -> float:
        """The largest such number in any direction."""
        return float(np.linalg.svd(self.slopes, compute_uv=False)[..., 0].max())


def invert_map(forward: PlaneSpline, slopes: Floats, around: Bounds, margin: float) -> PlaneMap:
    """Invert a map over a box in the plane of the pattern, with a margin, mm.

    Newton's method begins at the nearest node. Beyond its nodes, the map goes on with the slopes of its edge.
    """
    from scipy.ndimage import spline_filter
    from scipy.spatial import cKDTree

    guess = PlaneMap(forward=forward, slopes=slopes, inverse=forward)
    x0, y0, x1, y1 = around
    low, high = np.array([x0, y0]) - margin, np.array([x1, y1]) + margin
    counts = np.ceil((high - low) / forward.step).astype(int) + 3
    corner = low - forward.step
    axes = [start + forward.step * np.arange(count) for start, count in zip(corner, counts.tolist(), strict=True)]
    targets = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    nodes = forward.nodes().reshape(-1, 2)
    first, last = nodes[0], nodes[-1]
    points = nodes[cKDTree(forward.at(nodes)).query(targets)[1]]
    for _ in range(NEWTON_STEPS):
        clamped = np.clip(points, first, last)
        local = guess.slopes_at(clamped)
        missing = targets - forward.at(clamped) - np.einsum("nij,nj->ni", local, points - clamped)
        if np.abs(missing).max() < CONVERGED:
            break
        step = np.linalg.solve(local, missing[..., None])[..., 0]
        length = np.hypot(*step.T)[:, None]
        points = points + step * np.minimum(1.0, 4 * forward.step / np.maximum(length, 1e-12))
    values = points.reshape(*counts.tolist(), 2)
    # Filtered with a wide border, whose own border has no effect inside, and less of it kept.
    padded = [np.pad(values[..., axis], PADDING, mode="reflect", reflect_type="odd") for axis in (0, 1)]
    kept = slice(PADDING - 1, 1 - PADDING)
    coefficients = np.stack([spline_filter(part, order=3)[kept, kept] for part in padded], axis=-1)
    return PlaneMap(
        forward=forward,
        slopes=slopes,
        inverse=PlaneSpline(corner=corner, step=forward.step, coefficients=coefficients),
    )


@dataclass(frozen=True, kw_only=True)
class StretchedFamily(Family):
    """The lines of another family, of which `cell` is the nominal one, in the plane of a map.

    Parameters
    ----------
    family : Family
    plane_map : PlaneMap
    rise : float
        Share of the height that the pattern rises: less than 1, so that lines move by no more from layer to layer
        where cells are largest.
    """

    family: Family
    plane_map: PlaneMap
    rise: float = 1.0
    least_spacing: ClassVar[float] = LEAST_SPACING

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the stretched lines near the box."""
        plane_map, margin = self.plane_map, MARGIN * spec.cell
        x0, y0, x1, y1 = bounds
        around = (x0 - margin, y0 - margin, x1 + margin, y1 + margin)
        # Lines of a surface keep their distance where cells are smallest; touching beads move apart later.
        wider = 1.0 if self.family.touches else SADDLE_ROOM * plane_map.largest_scale
        inner = replace(spec, z=self.rise * spec.z, line_width=wider * spec.line_width)
        strands = self.family.nominal_strands(pattern_bounds(plane_map.forward, around), inner)
        return stretch_strands(
            strands, plane_map, around, leg=LONGEST_LEG * spec.cell, half_gap=STRETCHED_TOUCH * spec.line_width / 2
        )

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the nominal cell of the family for a density."""
        return self.family.cell_for(density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius of the family where cells have their largest size."""
        return self.family.largest_radius(cell, line_width) / self.least_scale

    @cached_property
    def least_scale(self) -> float:
        """The least number of cells in a length over that of the nominal cell."""
        return float(np.sqrt(np.linalg.det(self.plane_map.slopes).min()))

    def radii_at(self, points: Floats, cell: float, line_width: float) -> Floats:
        """Return the largest radius of corners, mm, at points on the bed, (N, 2): (N,)."""
        return self.family.largest_radius(cell, line_width) / np.maximum(self.plane_map.scale_at(points), 1e-9)


@dataclass(frozen=True, kw_only=True)
class SteppedFamily(Family):
    """A family whose cells change in steps of height as well.

    Parameters
    ----------
    families : sequence of StretchedFamily
        From the lowest step to the highest.
    tops, middles : sequence of float, mm
        Where each step ends, the last one at infinity, and the middle of its layers.
    """

    families: Sequence[StretchedFamily]
    tops: Sequence[float]
    middles: Sequence[float]
    least_spacing: ClassVar[float] = LEAST_SPACING

    def at(self, z: float) -> StretchedFamily:
        """Return the family at a height, mm."""
        return self.families[int(np.searchsorted(self.tops, z))]

    def middle_of(self, z: float) -> float:
        """Return the middle of the step at a height, mm."""
        return self.middles[int(np.searchsorted(self.tops, z))]

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the lines at the height of the layer."""
        return self.at(spec.z).strands(bounds, spec)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the nominal cell of the families for a density."""
        return self.families[0].cell_for(density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius of the families at the nominal cell."""
        return self.families[0].family.largest_radius(cell, line_width)


def step_family(
    family: Family, families: Sequence[StretchedFamily], tops: Sequence[float], middles: Sequence[float]
) -> SteppedFamily:
    """Return a family whose cells follow another map in every step of height."""
    return SteppedFamily(
        name=family.name,
        summary=family.summary,
        prismatic=False,
        wide=family.wide,
        families=tuple(families),
        tops=tuple(tops),
        middles=tuple(middles),
    )


def stretch_family(family: Family, plane_map: PlaneMap, rise: float) -> StretchedFamily:
    """Return a family whose cells follow a map."""
    return StretchedFamily(
        name=family.name,
        summary=family.summary,
        prismatic=family.prismatic,
        wide=family.wide,
        family=family,
        plane_map=plane_map,
        rise=rise,
    )


def stretch_strands(
    strands: Sequence[NominalStrand], plane_map: PlaneMap, around: Bounds, *, leg: float, half_gap: float
) -> list[Path]:
    """Stretch strands onto the bed, as far as they lie in a box.

    Parameters
    ----------
    strands : sequence of NominalStrand
        In the plane of the pattern.
    plane_map : PlaneMap
    around : (x0, y0, x1, y1)
        mm. Strands are cut a little outside of it.
    leg : float, mm
        Longest leg of a line that is stretched as one.
    half_gap : float, mm
        Half the distance of beads that touch.
    """
    if not strands:
        return []
    points, first = concatenate_rows([strand.points for strand in strands], like=(2,))
    sides = np.concatenate([strand.sides for strand in strands])
    across = np.repeat(np.stack([strand.across for strand in strands]), np.diff(first), axis=0)
    is_leg = _legs(len(points), first)
    length = np.append(np.hypot(*np.diff(points, axis=0).T), 0.0)
    points, sides, across, first = _divide(
        points, sides, across, first, np.where(is_leg, np.maximum(np.ceil(length / leg), 1), 1).astype(np.intp)
    )
    points, sides, across, first = _keep_near(points, sides, across, first, plane_map, around)
    if not len(points):
        return []
    is_leg = _legs(len(points), first)
    bed = plane_map.inverse.at(points)
    middle = plane_map.inverse.at((points[:-1] + points[1:]) / 2)
    bend = np.append(np.hypot(*(middle - (bed[:-1] + bed[1:]) / 2).T), 0.0)
    pieces = np.clip(np.ceil(np.sqrt(bend / MOST_BEND)), 1, MOST_PIECES)
    pieces = np.where(is_leg, pieces, 1).astype(np.intp)
    if pieces.max() > 1:
        points, sides, across, first = _divide(points, sides, across, first, pieces)
        bed = plane_map.inverse.at(points)
    if sides.any():
        normal = np.einsum("ni,nij->nj", across, plane_map.slopes_at(bed))
        bed = bed + (half_gap * sides / np.hypot(*normal.T))[:, None] * normal
    return split_rows(bed, first)


def _legs(count: int, first: Places) -> NDArray[np.bool_]:
    """Tell which points begin a leg of their path."""
    is_leg = np.ones(count, dtype=bool)
    is_leg[first[1:][np.diff(first) > 0] - 1] = False
    return is_leg


def _divide(
    points: Floats, sides: Floats, across: Floats, first: Places, pieces: Places
) -> tuple[Floats, Floats, Floats, Places]:
    """Divide the leg after each point into equal pieces."""
    begins = np.concatenate([[0], np.cumsum(pieces)])
    source = np.repeat(np.arange(len(points)), pieces)
    share = (np.arange(len(source)) - begins[source]) / pieces[source]
    after = np.minimum(source + 1, len(points) - 1)
    divided = points[source] + share[:, None] * (points[after] - points[source])
    return divided, sides[source] + share * (sides[after] - sides[source]), across[source], begins[first]


def _keep_near(
    points: Floats, sides: Floats, across: Floats, first: Places, plane_map: PlaneMap, around: Bounds
) -> tuple[Floats, Floats, Floats, Places]:
    """Keep the legs of which an end lies in a box on the bed; each run of them is a path."""
    inside = plane_map.inverse.holds(points)
    bed = plane_map.inverse.at(points)
    x0, y0, x1, y1 = around
    near = inside & (bed >= (x0, y0)).all(axis=1) & (bed <= (x1, y1)).all(axis=1)
    # A loop is kept as a whole: cut in two, it would have an end in the middle.
    last = first[1:] - 1
    loops = (points[first[:-1]] == points[last]).all(axis=1)
    near_loops = loops & np.logical_or.reduceat(near, first[:-1])
    near |= inside & np.repeat(near_loops, np.diff(first))
    is_leg = _legs(len(points), first)[:-1]
    legs = is_leg & (near[:-1] | near[1:]) & inside[:-1] & inside[1:]
    keep = np.zeros(len(points), dtype=bool)
    keep[:-1] |= legs
    keep[1:] |= legs
    # A path ends where the leg to the next point is left out.
    ends = keep & ~np.append(legs, False)
    number = np.cumsum(keep)
    return points[keep], sides[keep], across[keep], np.concatenate([[0], number[ends]]).astype(np.intp)


def line_angles(strands: Sequence[NominalStrand], bounds: Bounds) -> tuple[Floats, Floats]:
    """Return the directions of the legs whose middles lie in a box, radians, and their lengths, mm: (K,) each."""
    x0, y0, x1, y1 = bounds
    angles, lengths = [], []
    for strand in strands:
        step, middle = np.diff(strand.points, axis=0), (strand.points[:-1] + strand.points[1:]) / 2
        inside = ((middle >= (x0, y0)) & (middle <= (x1, y1))).all(axis=1)
        angles.append(np.arctan2(step[inside, 1], step[inside, 0]))
        lengths.append(np.hypot(*step[inside].T))
    return np.concatenate(angles), np.concatenate(lengths)


def scaled_length(strands: Sequence[NominalStrand], bounds: Bounds, scale: float, half_gap: float) -> float:
    """Return the length per area, 1/mm, of strands in a box, all of whose cells are divided by `scale`."""
    x0, y0, x1, y1 = bounds
    total = 0.0
    for strand in strands:
        middle = (strand.points[:-1] + strand.points[1:]) / 2
        inside = ((middle >= (x0, y0)) & (middle <= (x1, y1))).all(axis=1)
        line = strand.points / scale + half_gap * strand.sides[:, None] * strand.across
        total += float(np.hypot(*np.diff(line, axis=0)[inside].T).sum())
    return total * scale**2 / ((x1 - x0) * (y1 - y0))


def equal_normals(angles: Floats, lengths: Floats, count: int) -> Floats:
    """Return directions across lines, each for an equal share of their length, (count, 2)."""
    across = (angles + math.pi / 2) % math.pi
    order = np.argsort(across, kind="stable")
    share = np.cumsum(lengths[order])
    places = np.searchsorted(share, (np.arange(count) + 0.5) / count * share[-1])
    normal = across[order][np.minimum(places, len(order) - 1)]
    return np.stack([np.cos(normal), np.sin(normal)], axis=-1)
