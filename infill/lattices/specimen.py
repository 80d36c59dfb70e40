"""A specimen of a pattern in space: a small cube filled with it, and its picture with a corner cut away."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from infill.errors import GeometryError
from infill.lattices.job import fill
from infill.meshes.solids import subtract
from infill.surface import Surface

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from infill.arrays import Floats
    from patterns.cellular import Cells

SIDE, WALL = 18.0, 0.6  # mm: of the cube
VOXEL = 0.25  # mm: fine enough for the picture
PIXELS = 600
TOLERANCE = 1e-6  # mm: points this close to the faces of the cut belong to them


def write_specimen(
    pattern: str | Cells, file: BinaryIO, *, progress: Callable[[str, float], None] | None = None
) -> None:
    """Write a picture of a cube filled with a pattern at its default density, one corner cut away, as PNG.

    Parameters
    ----------
    pattern : str or Cells
        A name in `patterns.PATTERNS`, or a pattern.
    file : binary file
    progress : callable, optional
        Called with a stage and the share done.

    Raises
    ------
    GeometryError
        If the pattern leaves no room in a cube of 18 mm.
    """
    from PIL import Image

    from infill.pictures.cuts import BEHIND, CUT
    from infill.pictures.render import render

    options: dict[str, Any] = {"wall": WALL, "voxel": VOXEL, "progress": progress}
    solid = fill(_make_cube(np.full(3, -SIDE / 2), SIDE), pattern, **options).surface
    corner = np.array([-SIDE, SIDE, -SIDE]) / 4  # where the faces of the cut meet, seen from +x, -y and +z
    cut = subtract(solid, [_make_cube(corner - (0, SIDE, 0), SIDE)])
    if cut is None:
        raise GeometryError(
            "manifold3d rejects the cube with this pattern, so it cannot be cut open; draw it in a part"
        )

    def paint(points: Floats) -> NDArray[np.number]:
        is_cut = np.any(np.abs(points - corner) < TOLERANCE, axis=1)
        return np.where(is_cut[:, None], np.array(CUT), np.array(BEHIND))

    picture = Image.fromarray(render(cut, width=PIXELS, height=PIXELS, paint=paint))
    picture.save(file, format="PNG", optimize=True)


def _make_cube(lower: Floats, side: float) -> Surface:
    """Make a cube from its lower corner and its side, mm."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)
    squares = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = np.array([triangle for a, b, c, d in squares for triangle in ((a, b, c), (a, c, d))])
    return Surface(vertices=lower + side * corners, faces=faces)
