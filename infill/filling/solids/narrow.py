"""How much of the infill of a project is too narrow for a line of a slicer, or lies where there is no room for one."""

from __future__ import annotations

import numpy as np

from infill.surface import Surface
from infill.surfaces.solids import FINE, solid_of, status_of

SECTIONS = 32
LEAST_LINE = 0.85  # of a line: of 0.25 to 1, what best foretold the losses above 5 % when PrusaSlicer sliced parts


def too_narrow(part: Surface, infill: Surface, wall: float, line: float) -> float | None:
    """Return the share of infill inside the walls that slicers print none for, or None if that is unknown.

    Parameters
    ----------
    part, infill : Surface, mm
        The infill may reach into the walls.
    wall, line : float, mm

    Returns
    -------
    float or None
        Of horizontal sections: the larger of what lies in room narrower than a line, and of what is itself narrower
        than the thinnest line. 0 without infill inside the walls, None where manifold3d does not take a surface.

    Notes
    -----
    A place is as wide as a line where a disc of that diameter fits: what the opening by such discs leaves of it. The
    two shares are not added up: corners are in either, and slicers print most of those.

    >>> import trimesh
    >>> plate, block = trimesh.creation.box((40, 2, 10)), trimesh.creation.box((10, 10, 10))
    >>> plate, block = (Surface(vertices=each.vertices, faces=each.faces) for each in (plate, block))
    >>> [round(too_narrow(part, part, 0.9, 0.45) or 0, 2) for part in (plate, block)]
    [1.0, 0.0]
    """
    import manifold3d

    whole, body = solid_of(part), solid_of(infill)
    if status_of(whole) != FINE or status_of(body) != FINE:
        return None
    around = manifold3d.JoinType.Round

    def opened(section: manifold3d.CrossSection, width: float) -> manifold3d.CrossSection:
        return section.offset(-width / 2, around).offset(width / 2, around)

    low, high = part.bounds[:, 2]
    areas = np.zeros(3)  # all, in room as wide as a line, as wide itself
    for z in low + (np.arange(SECTIONS) + 0.5) / SECTIONS * (high - low):
        room = whole.slice(z).offset(-wall, around)
        filled = room ^ body.slice(z)
        areas += [filled.area(), (filled ^ opened(room, line)).area(), opened(filled, LEAST_LINE * line).area()]
    there, roomy, wide = areas.tolist()
    return max(0.0, 1 - min(roomy, wide) / there) if there else 0.0
