"""How much of the infill of a project lies where walls leave it less than a line of a slicer."""

from __future__ import annotations

import numpy as np

from infill.surface import Surface
from infill.surfaces.solids import FINE, solid_of, status_of

SECTIONS = 32


def in_narrow_room(part: Surface, infill: Surface, wall: float, line: float) -> float | None:
    """Return the share of infill inside the walls that lies in room narrower than a line, or None if that is unknown.

    Parameters
    ----------
    part, infill : Surface, mm
        The infill may reach into the walls.
    wall, line : float, mm

    Returns
    -------
    float or None
        Of horizontal sections; 0 without infill inside the walls, None where manifold3d does not take a surface.

    Notes
    -----
    Room is as wide as a line where a disc of that diameter fits: what the opening by such discs leaves of it.

    >>> import trimesh
    >>> plate, block = trimesh.creation.box((40, 2, 10)), trimesh.creation.box((10, 10, 10))
    >>> plate, block = (Surface(vertices=each.vertices, faces=each.faces) for each in (plate, block))
    >>> [round(in_narrow_room(part, part, 0.9, 0.45) or 0, 2) for part in (plate, block)]
    [1.0, 0.0]
    """
    import manifold3d

    whole, body = solid_of(part), solid_of(infill)
    if status_of(whole) != FINE or status_of(body) != FINE:
        return None
    around = manifold3d.JoinType.Round
    low, high = part.bounds[:, 2]
    there = narrow = 0.0
    for z in low + (np.arange(SECTIONS) + 0.5) / SECTIONS * (high - low):
        room = whole.slice(z).offset(-wall, around)
        filled = room ^ body.slice(z)
        wide = room.offset(-line / 2, around).offset(line / 2, around)
        there += filled.area()
        narrow += (filled - wide).area()
    return narrow / there if there else 0.0
