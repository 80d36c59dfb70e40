"""The sample part: a bracket with two screw holes in its foot and one hole in its wall."""

from __future__ import annotations

import shapely

from infill.meshes.solids import from_manifold
from infill.surface import Surface

LENGTH, WIDTH, HEIGHT = 60.0, 40.0, 40.0  # mm
FOOT, WALL = 12.0, 14.0  # mm thick
FILLET, EDGE = 8.0, 2.0  # mm, radii of the inner corner and of the outer ones
SCREW, AXLE = 6.0, 12.0  # mm, diameters of the holes
SIDES = 48  # of a hole
QUARTER = 8  # sides of a quarter of a rounded corner


def bracket() -> Surface:
    """Make a bracket of 60 x 40 x 40 mm, as a closed mesh that stands on z = 0.

    Returns
    -------
    Surface
        mm

    >>> import numpy as np
    >>> part = bracket()
    >>> part.closed, np.ptp(part.bounds, axis=0).round(3).tolist()
    (True, [60.0, 40.0, 40.0])
    """
    import manifold3d

    corner = shapely.union(shapely.box(0, 0, LENGTH, FOOT), shapely.box(0, 0, WALL, HEIGHT))
    rounded = corner.buffer(FILLET, quad_segs=QUARTER).buffer(-FILLET - EDGE, quad_segs=QUARTER)
    profile = rounded.buffer(EDGE, quad_segs=QUARTER)  # [x, z] of the bracket
    outline = shapely.get_coordinates(shapely.orient_polygons(profile))[:-1]
    # Extruded along z and turned, so that the profile stands upright and the extrusion runs along y.
    solid = manifold3d.CrossSection([outline]).extrude(WIDTH).rotate((90, 0, 0)).translate((0, WIDTH, 0))
    screw = manifold3d.Manifold.cylinder(2 * HEIGHT, SCREW / 2, circular_segments=SIDES)
    for y in (WIDTH / 4, WIDTH * 3 / 4):
        solid -= screw.translate(((WALL + FILLET + LENGTH) / 2, y, -HEIGHT / 2))
    axle = manifold3d.Manifold.cylinder(2 * LENGTH, AXLE / 2, circular_segments=SIDES)
    solid -= axle.rotate((0, 90, 0)).translate((-LENGTH, WIDTH / 2, HEIGHT * 0.65))
    return from_manifold(solid)
