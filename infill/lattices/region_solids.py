"""Regions as solids, to cut the voids of a part with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats
from infill.errors import GeometryError
from infill.lattices.region_nodes import PlacedRegion
from infill.meshes.solids import FINE, solid_status, to_manifold

if TYPE_CHECKING:
    import manifold3d

FAR = 100.0  # mm: how far regions reach beyond a part whose box they leave, besides its length


def make_region_solid(region: PlacedRegion, bounds: Floats, width: float = 0.0) -> manifold3d.Manifold:
    """Make the solid of a region of a part with bounds, (2, 3) mm; a box may be smaller by a width, mm, on all sides.

    Where a box goes as far as the box around the part, it goes on, so that it leaves no border in the part.

    Raises
    ------
    GeometryError
        If its mesh is not a solid.
    """
    import manifold3d

    reach = FAR + float(np.ptp(bounds, axis=0).max())
    around = np.array([bounds[0] - reach, bounds[1] + reach])
    if region.surface is None:
        low, high = region.ends(bounds) + np.array([[width], [-width]])
        return _make_box(*np.clip([low, high], *around)) if (low < high).all() else manifold3d.Manifold()
    mesh = to_manifold(region.surface)
    if solid_status(mesh) != FINE:
        raise GeometryError.about(
            "region", f"is {region.place}, whose mesh is not a solid; make one of it first: 'infill smooth' does"
        )
    return mesh ^ _make_box(*around)


def _make_box(low: Floats, high: Floats) -> manifold3d.Manifold:
    """Make a box between two corners, mm."""
    import manifold3d

    return manifold3d.Manifold.cube((high - low).tolist()).translate(low.tolist())
