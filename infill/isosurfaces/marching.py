"""Extract a closed surface from a field: marching cubes on a field with a shell of void."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.contours.zero_contours import nudge_field
from infill.errors import GeometryError, ParameterError
from infill.grid import VOID, spacing_of
from infill.plain_numbers import plain_argument
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh


def extract_dense(
    volume: NDArray[np.floating], *, spacing: tuple[float, ...], origin: tuple[float, ...], level: float = 0.0
) -> Surface:
    """Extract the surface of {volume > level}, closed and facing outwards: see `isosurface`."""
    from skimage.measure import marching_cubes

    nx, ny, nz = volume.shape
    # z comes first, so that marching cubes runs along the long axes of a thin stack. Permuting (x, y, z)
    # to (z, x, y) preserves the handedness, and with it the orientation of the faces.
    field = np.full((nz + 2, nx + 2, ny + 2), np.float32(VOID))
    field[1:-1, 1:-1, 1:-1] = np.moveaxis(volume, 2, 0)
    nudge_field(field, level)
    # Gradient ascent: the solid is above the level, and its faces must point outwards.
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
    """Extract the closed surface of the solid {volume > level}, normals outwards.

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
    Cells that touch only along an edge are kept apart.

    >>> isosurface(np.ones((2, 2, 2)), spacing=0.5).is_volume
    True
    """
    field = np.asarray(volume)
    if field.ndim != 3 or field.size == 0:
        raise ParameterError(f"the volume has the shape {field.shape}; give three axes [x, y, z] with cells")
    if not -1 < level < 1:
        raise ParameterError(f"the level is {plain_argument(level)}; it must lie between -1 and 1")
    if field.dtype == bool:
        field = np.where(field, np.float32(1), np.float32(-1))
    if np.isnan(field.min()):
        raise ParameterError("the volume holds NaN; fill or cut those cells first")
    if len(origin) != 3:
        raise ParameterError.about("origin", f"has {len(origin)} numbers; give x, y and z")
    surface = extract_dense(field, spacing=spacing_of(spacing, 3), origin=origin, level=level)
    if not surface.closed:
        raise GeometryError("the surface is not closed; smooth the volume a little, or use finer cells")
    return surface.to_trimesh()
