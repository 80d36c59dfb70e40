"""The paper's shapes as -1 and +1 on cells. Lengths are in cells, about the middle of the grid."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from benchmarks.solids import Shape

Field = NDArray[np.float32]


def centres(*counts: int) -> list[NDArray[np.float64]]:
    """Return the coordinates of the cell centres along each axis, shaped to be broadcast."""
    axes = [np.arange(n) + 0.5 - n / 2 for n in counts]
    return [axis.reshape([-1 if i == j else 1 for j in range(len(counts))]) for i, axis in enumerate(axes)]


def binary(solid: NDArray[np.bool_]) -> Field:
    """Return +1 where it is solid, -1 elsewhere."""
    return np.where(solid, np.float32(1), np.float32(-1))


def disc(n: int, radius: float) -> Field:
    """Return a disc on n x n cells."""
    x, y = centres(n, n)
    return binary(np.hypot(x, y) < radius)


def square(n: int, half: float) -> Field:
    """Return an upright square on n x n cells."""
    x, y = centres(n, n)
    return binary((np.abs(x) < half) & (np.abs(y) < half))


def covered(outline: shapely.Geometry, n: int) -> Field:
    """Return the cells of n x n whose centre lies in an outline; the first cell spans 0 to 1."""
    x, y = np.meshgrid(np.arange(n) + 0.5, np.arange(n) + 0.5, indexing="ij")
    return binary(shapely.contains_xy(outline, x, y))


def glyph(character: str, n: int, share: float = 0.8) -> shapely.Geometry:
    """Return the outline of a character of DejaVu Sans Bold, `share` of n cells high, about the middle of the grid."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    path = TextPath((0, 0), character, size=100, prop=FontProperties(family="DejaVu Sans", weight="bold"))
    rings = shapely.multipolygons([shapely.Polygon(ring) for ring in path.to_polygons()])
    outline = shapely.normalize(shapely.build_area(shapely.boundary(rings)))
    low, high = np.array(outline.bounds[:2]), np.array(outline.bounds[2:])
    scale = share * n / (high[1] - low[1])
    return shapely.transform(outline, lambda points: (points - (low + high) / 2) * scale + n / 2)


def pyramid() -> Field:
    """Return the stepped pyramid on 200³ cells.

    The text gives x, y in [-1 + h (3 m + 21.5), 1 - h (187.5 - 3 m)], which is empty for every m = 1 ... 27. Read with
    -1 + h (...) for the upper bounds too it is a pyramid; z in [-1 + h (6 m + 13.5), -1 + h (6 m + 19.5)]. All
    bounds fall on centres of cells, which count as inside: cell i has its centre at -1 + h (i + 1/2).
    """
    f = np.full((200, 200, 200), np.float32(-1))
    for m in range(1, 28):
        across, up = slice(3 * m + 21, 188 - 3 * m), slice(6 * m + 13, 6 * m + 20)
        f[across, across, up] = 1
    return f


def bell(n: int) -> Shape:
    """Return a bell on n³ cells: a round cone with a thick lip around its foot, blended.

    The paper's bell is not published; this is one of the kind.
    """
    foot, top, low, high, lip = (share * n / 2 for share in (0.42, 0.2, -0.45, 0.5, 0.12))
    slope = (foot - top) / (high - low)
    blend = 0.12 * n / 2

    def profile(r: NDArray[np.float64], z: NDArray[np.float64]) -> NDArray[np.float64]:
        z = z - low
        along = np.sqrt(1 - slope**2)
        ahead = -slope * r + along * z
        cone = np.where(
            ahead < 0,
            np.hypot(r, z) - foot,
            np.where(ahead > along * (high - low), np.hypot(r, z - (high - low)) - top, along * r + slope * z - foot),
        )
        ring = np.hypot(r - foot, z + 0.3 * foot) - lip
        near = np.maximum(blend - np.abs(cone - ring), 0)
        return np.minimum(cone, ring) - near**2 / (4 * blend)

    # Volume by rings of a tenth of a cell, those at the surface by the part that is inside.
    r, z = np.meshgrid(np.arange(0.05, 0.4 * n, 0.1), np.arange(-n / 2 + 0.05, n / 2, 0.1), indexing="ij")
    volume = 2 * np.pi * 0.01 * float((r * (0.5 - profile(r, z) / 0.1).clip(0, 1)).sum())
    return Shape(
        size=(n,) * 3, value=lambda p: profile(np.hypot(p[:, 0], p[:, 1]), p[:, 2]), exact=False, volume=volume
    )


def noisy(f: Field, chance: float, rng: np.random.Generator, reach: float = 2.0) -> Field:
    """Return the field with +1 at a share `chance` of the cells within `reach` cells of the surface: the paper's noise.

    Where no distance is known, that to the nearest cell of the other kind less half a cell is taken.
    """
    from scipy.ndimage import distance_transform_edt

    solid = f > 0
    near = distance_transform_edt(~solid) - 0.5 <= reach
    return binary(solid | (near & (rng.random(f.shape) <= chance)))


def spinodal(n: int, rng: np.random.Generator) -> Shape:
    """Return a two-phase labyrinth in a ball: a sum of 24 waves of one length in random directions."""
    ways = rng.normal(size=(24, 3))
    ways *= 2 * np.pi / (0.32 * n) / np.linalg.norm(ways, axis=1, keepdims=True)
    phases = rng.uniform(0, 2 * np.pi, 24)
    return _in_ball(n, lambda p: np.cos(p @ ways.T + phases).sum(axis=1) / np.sqrt(12) * 0.05 * n)


def sponge(n: int) -> Shape:
    """Return a Schwarz P surface, its walls thicker on one side, in a ball."""
    wave = 2 * np.pi / (0.4 * n)

    def value(p: NDArray[np.float64]) -> NDArray[np.float64]:
        level = np.cos(wave * p).sum(axis=1) - 0.6 * p[:, 0] / n
        return level * 0.06 * n

    return _in_ball(n, value)


def foam(n: int, rng: np.random.Generator) -> Shape:
    """Return a ball with round pores that run into each other, the edges between them blended."""
    middles, radii = rng.uniform(-0.36 * n, 0.36 * n, (40, 3)), rng.uniform(0.05 * n, 0.1 * n, 40)
    soft = 0.02 * n

    def value(p: NDArray[np.float64]) -> NDArray[np.float64]:
        inside = [radius - np.linalg.norm(p - middle, axis=1) for middle, radius in zip(middles, radii, strict=True)]
        return soft * np.logaddexp.reduce(np.array(inside) / soft, axis=0)

    return _in_ball(n, value)


def _in_ball(n: int, value: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> Shape:
    """Return what is solid in a ball of 0.45 n, the edge blended over 0.04 n."""
    blend = 0.04 * n

    def both(p: NDArray[np.float64]) -> NDArray[np.float64]:
        a, b = value(p), np.linalg.norm(p, axis=1) - 0.45 * n
        return np.maximum(a, b) + np.maximum(blend - np.abs(a - b), 0) ** 2 / (4 * blend)

    return Shape(size=(n,) * 3, value=both, exact=False)


def embedded(f: NDArray[np.bool_], shape: Sequence[int]) -> Field:
    """Return solid cells in the middle of a larger grid."""
    whole = np.zeros(tuple(shape), dtype=bool)
    low = [(many - few) // 2 for many, few in zip(shape, f.shape, strict=True)]
    whole[tuple(slice(a, a + few) for a, few in zip(low, f.shape, strict=True))] = f
    return binary(whole)
