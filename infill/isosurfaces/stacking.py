"""Turn a layer into a solid: stack it with caps, or take the shortcut for equal layers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.checks import check_length, check_whole_number
from infill.errors import GeometryError, ParameterError
from infill.grid import VOID, spacing_of
from infill.isosurfaces.marching import extract_dense
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh


def stack(layer: ArrayLike, layers: int) -> NDArray[np.floating]:
    """Stack `layers` copies of a layer, with a cap of void below and above: (nx, ny, layers + 2).

    Parameters
    ----------
    layer : (nx, ny) array
        Phase field, +1 solid.
    layers : int
        At least 1.

    Notes
    -----
    Source: Wang et al. 2020, step 4 of the method. Where phi = 1 the solid is exactly `layers` layers
    tall; where phi = v < 1 its top lies v / (1 + v) of a layer above the centre of the last layer.

    >>> stack(np.ones((2, 2)), 3)[0, 0].tolist()
    [-1.0, 1.0, 1.0, 1.0, -1.0]
    """
    plane = _check_layer(layer)
    volume = np.full((*plane.shape, check_whole_number("the number of layers", layers, 1) + 2), VOID, dtype=plane.dtype)
    volume[:, :, 1:-1] = plane[:, :, None]
    return volume


def extrude(
    layer: ArrayLike,
    height: float,
    spacing: float | tuple[float, float] = 1.0,
    *,
    layer_height: float | None = None,
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> trimesh.Trimesh:
    """Extract the surface of a stacked layer, at the same cost for any height.

    Parameters
    ----------
    layer : (nx, ny) array
        Phase field, +1 solid.
    height : float
        Height of the solid, mm.
    spacing : float or (hx, hy)
        Cell size, mm.
    layer_height : float, optional
        Thickness of a stacked layer, mm, rounded so that a whole number of layers makes up the height; by default the
        smaller cell size. It is the height of the rounding at the top edge of thin walls.
    origin : (x, y, z)
        Lower corner of the solid, mm.

    Returns
    -------
    trimesh.Trimesh, mm, closed, normals outwards

    Raises
    ------
    GeometryError
        If nothing is solid, or the surface would not be closed.

    Notes
    -----
    Between equal layers the surface is vertical. Two layers with caps, stretched in the middle, therefore have
    the surface of any number of layers; the volume agrees to rounding.

    >>> round(float(extrude(np.ones((4, 4)), 600, 0.5).extents[2]), 3)
    600.0
    """
    sizes = spacing_of(spacing, 2)
    surface = extrude_surface(_check_layer(layer), height, sizes, layer_height=layer_height, origin=origin)
    if not surface.closed:
        raise GeometryError("the surface is not closed; smooth the layer a little, or use finer cells")
    return surface.to_trimesh()


def extrude_surface(
    layer: NDArray[np.floating],
    height: float,
    spacing: tuple[float, ...],
    *,
    layer_height: float | None = None,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
) -> Surface:
    """Extract the surface of a stacked layer as `extrude` does, without the check that it is closed."""
    height = check_length("height", height)
    layers = layer_count(height, min(spacing) if layer_height is None else check_length("layer height", layer_height))
    thickness = height / layers
    surface = extract_dense(
        stack(layer, min(layers, 2)), spacing=(*spacing, thickness), origin=(*origin[:2], origin[2] - thickness)
    )
    vertices = surface.vertices
    if layers > 2:
        middle = origin[2] + thickness  # between the two layers
        vertices[:, 2] += np.where(vertices[:, 2] > middle, height - 2 * thickness, 0)
    return Surface(vertices=vertices, faces=surface.faces)


def layer_count(height: float, layer_height: float) -> int:
    """Return the number of whole layers of about `layer_height` that make up `height`.

    >>> layer_count(6.0, 0.15)
    40
    """
    return max(1, round(height / layer_height))


def _check_layer(layer: ArrayLike) -> NDArray[np.floating]:
    """Return a layer as floating-point numbers, booleans as +1 and -1; raise ParameterError for NaN or wrong axes."""
    plane = np.asarray(layer)
    if plane.ndim != 2 or plane.size == 0:
        raise ParameterError(f"the layer has the shape {plane.shape}; give two axes [x, y] with cells")
    if not np.issubdtype(plane.dtype, np.floating):
        plane = np.where(plane, 1.0, -1.0) if plane.dtype == bool else plane.astype(np.float64)
    if np.isnan(plane.min()):
        raise ParameterError("the layer holds NaN; fill or cut those cells first")
    return plane
