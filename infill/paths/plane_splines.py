"""Smooth maps between the bed and the plane of a pattern, as cubic splines, and their inverses."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.paths.families.family import Bounds

EDGE_POINTS = 65  # on each side of a box whose place in the plane of the pattern is sought
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
