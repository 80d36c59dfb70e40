"""Closed cells between parallel planes that cross: cubes, and octahedra and tetrahedra."""

from __future__ import annotations

import math

from patterns.unit_cells import Planes

# A cube stands on one corner: its diagonal is upright, so that each plane is inclined alike.
UP, ACROSS = 1 / math.sqrt(3), (1 / math.sqrt(2), 1 / math.sqrt(6))
ON_A_CORNER = (
    (ACROSS[0], ACROSS[1], UP),
    (-ACROSS[0], ACROSS[1], UP),
    (0.0, -2 * ACROSS[1], UP),
)
TETRAHEDRON = ((1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0))

CUBIC = Planes(
    name="cubic",
    summary="cubes on their corners: strong in every direction, prints without support",
    normals=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    upright=ON_A_CORNER,
)
TETRAHEDRAL = Planes(
    name="tetrahedral",
    summary="octahedra and tetrahedra with closed faces: very stiff for its weight",
    normals=TETRAHEDRON,
)
QUARTER_CUBIC = Planes(
    name="quarter-cubic",
    summary="tetrahedra, with and without corners: very stiff for its weight",
    normals=TETRAHEDRON,
    offsets=(0.0, 0.0, 0.0, 0.5),
)

PLANES = (CUBIC, QUARTER_CUBIC, TETRAHEDRAL)
