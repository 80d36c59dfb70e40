"""From a field to a closed surface: marching cubes on a field with a shell of void."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.errors import GeometryError, ParameterError
from infill.grid import VOID, spacing_of

if TYPE_CHECKING:
    import trimesh

AT_ONCE = 50_000  # faces measured at a time, so that they stay in the cache
# A value nearer to the level than this is moved away from it. Otherwise triangles shrink to a point
# at the centre of the cell, and a 32-bit file merges what the mesh keeps apart. It moves the surface
# by at most half this part of a cell.
CLEARANCE = 2.0**-10
# Solid is made weaker by this factor, so that two solid cells that touch at an edge only, void on the
# other two sides, are apart and not undecided: marching cubes would leave such a saddle open.
TIE = 1 - 1e-5


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Triangles as plain arrays, so that the way to a file needs no mesh library.

    Parameters
    ----------
    vertices : (V, 3) float, mm
    faces : (F, 3) int, counter-clockwise seen from outside
    space : str
        Name of the axes, if they have one: "LPS" for medical images.
    """

    vertices: NDArray[np.floating]
    faces: NDArray[np.integer]
    space: str = ""

    @cached_property
    def closed(self) -> bool:
        """True if every edge has two faces that run along it in opposite directions."""
        if len(self.faces) == 0:
            return False
        count = len(self.vertices)
        rising, falling = [], []
        for i in range(3):
            start, end = self.faces[:, i].astype(np.int64), self.faces[:, (i + 1) % 3].astype(np.int64)
            if (start == end).any():
                return False
            up = start < end
            rising.append((start * count + end)[up])
            falling.append((end * count + start)[~up])
        there, back = np.concatenate(rising), np.concatenate(falling)
        helper = threading.Thread(target=back.sort)
        helper.start()
        there.sort()
        helper.join()
        return np.array_equal(there, back) and not bool((there[1:] == there[:-1]).any())

    @cached_property
    def _volume_and_area(self) -> tuple[float, float]:
        # Seen from the middle, so that far from the origin no digits are lost.
        vertices = self.vertices - self.vertices.mean(axis=0, dtype=np.float64)
        sixfold = doubled = 0.0
        for low in range(0, len(self.faces), AT_ONCE):
            a, b, c = (vertices[self.faces[low : low + AT_ONCE, i]].T for i in range(3))
            b, c = b - a, c - a
            normal = (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])
            sixfold += float(sum(part @ across for part, across in zip(a, normal, strict=True)))
            doubled += float(np.sqrt(sum(across**2 for across in normal)).sum())
        return sixfold / 6, doubled / 2

    @property
    def volume(self) -> float:
        """Enclosed volume, mm³; negative if the faces point inwards."""
        return self._volume_and_area[0]

    @property
    def area(self) -> float:
        """Area of all faces, mm²."""
        return self._volume_and_area[1]

    @cached_property
    def euler_number(self) -> int:
        """V - E + F of a closed surface, in which every face has one and a half edges of its own."""
        return len(self.vertices) - len(self.faces) // 2

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Lower and upper corner, (2, 3), mm."""
        return np.array([self.vertices.min(axis=0), self.vertices.max(axis=0)], dtype=np.float64)

    def to_trimesh(self) -> trimesh.Trimesh:
        """Return the same mesh as a trimesh.Trimesh; vertices are neither merged nor reordered."""
        import trimesh

        return trimesh.Trimesh(vertices=self.vertices, faces=self.faces, process=False)


def extract(
    volume: NDArray[np.floating], *, spacing: tuple[float, ...], origin: tuple[float, ...], level: float = 0.0
) -> Surface:
    """Return the surface of {volume > level}, closed and facing outwards: see `isosurface`."""
    from skimage.measure import marching_cubes

    nx, ny, nz = volume.shape
    # z comes first, so that marching cubes runs along the long axes of a thin stack. Turning (x, y, z)
    # into (z, x, y) keeps the handedness, and with it the direction of the faces.
    field = np.full((nz + 2, nx + 2, ny + 2), np.float32(VOID))
    field[1:-1, 1:-1, 1:-1] = np.moveaxis(volume, 2, 0)
    field -= np.float32(level)
    solid = field > 0
    if not solid.any():
        raise GeometryError(
            f"nothing is left above the level {level:g}: no surface; smooth less, or use walls of more cells"
        )
    near = np.abs(field) < CLEARANCE
    field[near] = np.where(solid[near], np.float32(CLEARANCE), np.float32(-CLEARANCE))
    np.multiply(field, np.float32(TIE), out=field, where=solid)
    # Gradient ascent: the solid is above the level, and faces shall point out of it.
    vertices, faces, _, _ = marching_cubes(field, 0.0, gradient_direction="ascent")  # type: ignore[no-untyped-call]
    # The centre of the first cell, now at index 1, lies half a cell inside the box.
    placed = (vertices[:, [1, 2, 0]] - 0.5) * np.array(spacing) + np.array(origin)
    return Surface(vertices=placed, faces=faces)


def isosurface(
    volume: ArrayLike,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    level: float = 0.0,
) -> trimesh.Trimesh:
    """Return the closed surface of the solid {volume > level}, normals outwards.

    Parameters
    ----------
    volume : (nx, ny, nz) array
        Phase field, [x, y, z], +1 solid.
    spacing : float or (hx, hy, hz)
        Cell size, mm.
    origin : (x, y, z)
        Lower corner of the first cell, mm; its centre lies half a cell inside.
    level : float
        Between -1 and 1.

    Returns
    -------
    trimesh.Trimesh, mm

    Raises
    ------
    GeometryError
        If nothing is solid, or the surface would not be closed.
    ParameterError
        If the volume does not have three axes, or holds NaN.

    Notes
    -----
    Marching cubes (Lewiner et al. 2003, scikit-image) on the volume in a shell of void one cell thick,
    so that solid that touches the edge of the grid is closed there, half a cell beyond the last centre.
    Cells that touch only along an edge are apart.

    >>> isosurface(np.ones((2, 2, 2)), spacing=0.5).is_volume
    True
    """
    field = np.asarray(volume)
    if field.ndim != 3 or field.size == 0:
        raise ParameterError(f"the volume has the shape {field.shape}; give three axes [x, y, z] with cells")
    if not -1 < level < 1:
        raise ParameterError(f"the level is {level:g}; it must lie between -1 and 1")
    if field.dtype == bool:
        field = np.where(field, np.float32(1), np.float32(-1))
    if np.isnan(field.min()):
        raise ParameterError("the volume holds NaN; fill or cut those cells first")
    if len(origin) != 3:
        raise ParameterError(f"origin has {len(origin)} numbers; give x, y and z")
    surface = extract(field, spacing=spacing_of(spacing, 3), origin=origin, level=level)
    if not surface.closed:
        raise GeometryError("the surface is not closed; smooth the volume a little, or use finer cells")
    return surface.to_trimesh()
