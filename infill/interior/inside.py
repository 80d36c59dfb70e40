"""The surface of the space inside the walls of a part."""

from __future__ import annotations

import numpy as np

from infill.interior.interior import Interior
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.meshes.solids import simplify_solid
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import phase_from_distance
from infill.phasefield.sparse import smooth_bricks
from infill.surface import Surface

INTERFACE = 2.0  # cells: in a thinner interface, curvature moves the surface slower than it should
SHARE = 0.8  # of the tolerance for simplifying; the rest covers the error of the grid


def extract_inner_side(space: Interior, *, overlap: float, tolerance: float, threads: int | None) -> Surface:
    """Extract the surface of the space inside the walls, extended into them by the overlap, mm."""
    field = smooth_bricks(
        phase_from_distance(space.depth + np.float32(overlap / space.size), INTERFACE, threads=threads),
        Smoothing(steps=0),
        spacing=(space.size,) * 3,
        threads=threads,
    )
    origin = tuple((space.origin - space.size / 2).tolist())
    surface = extract_bricks(field, spacing=(space.size,) * 3, origin=origin, threads=threads)
    return simplify_solid(surface, tolerance) if tolerance > 0 else surface
