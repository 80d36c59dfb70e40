"""Solids whose true surface is known, as voxels and as distances. All lengths are in cells."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Points = NDArray[np.float64]
STEP, STILL = 1e-4, 1e-3  # cells
TURN = Rotation.from_euler("xyz", [20, 35, 10], degrees=True).as_matrix()


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A solid {value < 0} about the origin, in cells.

    Parameters
    ----------
    size : (nx, ny, nz)
        Cells of its grid.
    value : function of (N, 3) points
        The signed distance if `exact`, else any smooth function with the same zero surface.
    volume : float, optional
        Cells³; the number of solid cells if left out.
    euler : int
        Its Euler number; every shape is one piece.
    """

    size: tuple[int, int, int]
    value: Callable[[Points], NDArray[np.float64]]
    exact: bool = True
    volume: float | None = None
    euler: int = 2

    def voxels(self, noise: float = 0.0) -> NDArray[np.float32]:
        """Return -1 and +1 at the cell centres, in a band of 2 cells about the surface +1 with chance `noise`."""
        x, y, z = (np.arange(n) + 0.5 - n / 2 for n in self.size)
        value = np.empty(self.size)
        for i, across in enumerate(x):
            points = np.stack(np.broadcast_arrays(across, *np.meshgrid(y, z, indexing="ij")), axis=-1)
            value[i] = self.value(points.reshape(-1, 3)).reshape(points.shape[:2])
        band = np.abs(value) <= 2
        solid = (value < 0) | (band & (np.random.default_rng(0).random(self.size) <= noise))
        return np.where(solid, np.float32(1), np.float32(-1))

    def slope(self, points: Points) -> Points:
        """Return the gradient of the value."""
        differences = [self.value(points + d) - self.value(points - d) for d in STEP * np.eye(3)]
        return np.stack(differences, axis=1) / (2 * STEP)

    def foot(self, points: Points) -> tuple[NDArray[np.float64], Points]:
        """Return the signed distance of points near the surface, and the normal where they are nearest to it.

        A value that is no distance takes a projected Newton method: onto the surface along the normal,
        then back under the point within the tangent plane, until no point moves by `STILL` cells.
        """
        if self.exact:
            slope = self.slope(points)
            return self.value(points), slope / np.linalg.norm(slope, axis=1, keepdims=True)
        at = points.copy()
        for _ in range(12):
            slope = self.slope(at)
            steep = np.linalg.norm(slope, axis=1, keepdims=True)
            normal = slope / steep
            moved = at - np.clip(self.value(at)[:, None] / steep, -2, 2) * normal
            aside = points - moved
            moved += 0.8 * (aside - (aside * normal).sum(axis=1, keepdims=True) * normal)
            still = np.abs(moved - at).max() < STILL
            at = moved
            if still:
                break
        return ((points - at) * normal).sum(axis=1), normal


def sphere(n: int = 200) -> Shape:
    """Return a sphere of 0.8 of the half side on n³ cells."""
    radius = 0.4 * n
    return Shape(size=(n,) * 3, value=lambda p: np.linalg.norm(p, axis=1) - radius, volume=4 / 3 * math.pi * radius**3)


def ellipsoid(n: int = 200) -> Shape:
    """Return an ellipsoid with half axes 0.8 n, 0.4 n and 0.4 n on 2n x n x n cells."""
    axes = 0.4 * n * np.array([2.0, 1, 1])
    value, volume = (lambda p: (np.linalg.norm(p / axes, axis=1) - 1) * axes[1]), 4 / 3 * math.pi * axes.prod()
    return Shape(size=(2 * n, n, n), value=value, exact=False, volume=volume)


def torus() -> Shape:
    """Return a torus of radii 55 and 22, tilted."""

    def value(points: Points) -> NDArray[np.float64]:
        x, y, z = (points @ TURN).T
        return np.hypot(np.hypot(x, y) - 55, z) - 22

    return Shape(size=(200,) * 3, value=value, volume=2 * math.pi**2 * 55 * 22**2, euler=0)


def rbox() -> Shape:
    """Return a box of half sizes 60, 42 and 30 with edges of radius 8, turned."""
    radius, core = 8.0, np.array([52.0, 34, 22])

    def value(points: Points) -> NDArray[np.float64]:
        q = np.abs(points @ TURN) - core
        return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0) - radius

    a, b, c = 2 * core
    volume = a * b * c + 2 * radius * (a * b + b * c + c * a) + math.pi * radius**2 * (a + b + c)
    return Shape(size=(200,) * 3, value=value, volume=volume + 4 / 3 * math.pi * radius**3)


def gyroid() -> Shape:
    """Return a gyroid sheet of period 80, 5 to 7 thick, in a ball of radius 90, blended over 8."""
    wave = 2 * math.pi / 80

    def value(points: Points) -> NDArray[np.float64]:
        x, y, z = (points * wave).T
        sheet = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        a, b = np.abs(sheet) / (1.5 * wave) - 2.75, np.linalg.norm(points, axis=1) - 90
        return np.maximum(a, b) + np.maximum(8 - np.abs(a - b), 0) ** 2 / 32

    return Shape(size=(200,) * 3, value=value, exact=False, euler=-74)


def honeycomb() -> Shape:
    """Return a plate 20 high with 37 hexagonal holes, walls of exactly 3, turned by 7 degrees, edges sharp."""

    def hexagon(centre: Points, apothem: float) -> shapely.Polygon:
        angle = np.radians(np.arange(30, 390, 60) + 7)
        return shapely.Polygon(centre + apothem / math.cos(math.pi / 6) * np.stack([np.cos(angle), np.sin(angle)], 1))

    i, j = np.mgrid[-3:4, -3:4].reshape(2, -1)
    i, j = (part[np.abs(i + j) <= 3][:, None] for part in (i, j))
    angle = np.radians([7, 67])
    centres = 24 * (i * [math.cos(angle[0]), math.sin(angle[0])] + j * [math.cos(angle[1]), math.sin(angle[1])])
    plate = shapely.union_all([hexagon(c, 13.5) for c in centres])
    plate = plate.difference(shapely.union_all([hexagon(c, 10.5) for c in centres]))
    edge = plate.boundary
    shapely.prepare([plate, edge])

    def value(points: Points) -> NDArray[np.float64]:
        flat, which = np.unique(points[:, :2], axis=0, return_inverse=True)
        spots = shapely.points(flat)
        side = (shapely.distance(edge, spots) * np.where(shapely.contains(plate, spots), -1, 1))[which.ravel()]
        top = np.abs(points[:, 2]) - 10
        return np.hypot(np.maximum(side, 0), np.maximum(top, 0)) + np.minimum(np.maximum(side, top), 0)

    return Shape(size=(210, 210, 40), value=value, volume=plate.area * 20, euler=-72)
