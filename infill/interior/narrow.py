"""How much of the infill of a project is too narrow for a line of a slicer, and the infill without that.

A slicer prints infill where perimeters leave room for a line, and a little way into the perimeters; and of what is
there, what is as wide as a line itself. A place is as wide as a line where a disc of that diameter fits: what the
opening by such discs leaves of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from infill.meshes.solids import FINE, solid_of, status_of, surface_from
from infill.surface import Surface

if TYPE_CHECKING:
    from collections.abc import Iterable

    import manifold3d

SECTIONS = 32
NARROW = 0.045  # of the infill: if more of it is where slicers print none, by an estimate, that is left out, and told
OVERLAP = 0.25  # of a line: how far slicers' infill reaches into perimeters
LAYER, OVER = 0.2, 0.03  # mm: height of what is left out at a time, and how far that reaches into the next
APART = 0.02  # mm: what is left out stays so far off what is kept, and hairlines between them do not count
REACH = 0.05  # mm: how far it reaches into voids and walls
CRUMB = 0.01  # mm²: smaller pieces do not count, even where nothing else is


@dataclass(frozen=True, kw_only=True)
class Narrow:
    """Shares of the infill, inside the walls, that slicers print none for.

    Parameters
    ----------
    room : float
        What lies in room narrower than a line.
    all : float
        That, and what is itself too narrow.
    """

    room: float
    all: float


@dataclass(frozen=True, kw_only=True, eq=False)
class _Section:
    """A horizontal section of a part and its infill.

    Parameters
    ----------
    around : CrossSection
        Where a slicer's infill would be, if there were room for it.
    filled : CrossSection
        What of the infill is there.
    roomy : CrossSection
        What of that has room as wide as a line.
    kept : CrossSection
        What of that is wide enough itself.
    gone : list of CrossSection
        Pieces of the rest.
    """

    around: manifold3d.CrossSection
    filled: manifold3d.CrossSection
    roomy: manifold3d.CrossSection
    kept: manifold3d.CrossSection
    gone: list[manifold3d.CrossSection]


def too_narrow(part: Surface, infill: Surface, wall: float, line: float, least: float) -> Narrow | None:
    """Return the shares of infill that slicers print none for, or None if manifold3d does not take a surface.

    Parameters
    ----------
    part, infill : Surface, mm
        The infill may reach into the walls.
    wall, line : float, mm
    least : float, mm
        Width of the narrowest infill that is printed.

    Returns
    -------
    Narrow or None
        Of horizontal sections; 0 without infill inside the walls.

    >>> import trimesh
    >>> plate, block = trimesh.creation.box((40, 2, 10)), trimesh.creation.box((10, 10, 10))
    >>> plate, block = (Surface(vertices=each.vertices, faces=each.faces) for each in (plate, block))
    >>> [round(too_narrow(part, part, 0.9, 0.45, 0.6).all, 2) for part in (plate, block)]
    [1.0, 0.0]
    """
    whole, body = solid_of(part), solid_of(infill)
    if status_of(whole) != FINE or status_of(body) != FINE:
        return None
    low, high = part.bounds[:, 2]
    areas = np.zeros(3)  # all, in too narrow a room, that and what is too narrow
    for z in low + (np.arange(SECTIONS) + 0.5) / SECTIONS * (high - low):
        found = _section(whole.slice(z), body.slice(z), wall, line, least)
        gone = sum(piece.area() for piece in found.gone)
        areas += [found.filled.area(), found.filled.area() - found.roomy.area(), gone]
    there, cramped, gone = areas.tolist()
    return Narrow(room=cramped / there if there else 0.0, all=gone / there if there else 0.0)


def without_narrow(part: Surface, infill: Surface, wall: float, line: float, least: float) -> Surface:
    """Return the infill without what slicers print none for, layer by layer; it may be empty.

    Parameters
    ----------
    part, infill : Surface, mm
        Solids for manifold3d; the infill may reach into the walls.
    wall, line : float, mm
    least : float, mm
        Width of the narrowest infill that is printed.

    >>> import trimesh
    >>> block, wall, sliver = (trimesh.creation.box((each, 9, 10)) for each in (10, 1, 0.3))
    >>> body = trimesh.util.concatenate([wall, sliver.apply_translation((2, 0, 0))])
    >>> block, body = (Surface(vertices=each.vertices, faces=each.faces) for each in (block, body))
    >>> left = without_narrow(block, body, 0.9, 0.45, 0.6)
    >>> round(body.volume - left.volume, 1)  # 0.3 by 7.42 by 10 mm, and a little of what lies in the walls
    22.6
    """
    import manifold3d

    whole, body = solid_of(part), solid_of(infill)
    low, high = part.bounds[:, 2]
    cut: list[manifold3d.Manifold] = []
    areas: list[tuple[manifold3d.CrossSection, int, int]] = []  # with the first layer and the last
    for layer in range(int(np.ceil((high - low) / LAYER))):
        middle = float(low) + LAYER * (layer + 0.5)
        found = _section(whole.slice(middle), body.slice(middle), wall, line, least)
        if not found.gone:
            continue
        gone = _united(found.gone)
        if areas and areas[-1][2] == layer - 1 and _fits(areas[-1][0], gone, found.kept):
            areas[-1] = (*areas[-1][:2], layer)
            continue
        # In turn a little larger, or sides that lie all but in one place would be cut to shreds.
        further = APART * (len(areas) % 2)
        room = _grown(found.around, REACH + further)
        area = (_grown(gone, REACH + further) - _grown(found.kept, APART + further)) ^ room
        areas.append((area.simplify(APART / 2), layer, layer))
    for area, first, last in areas:
        height = LAYER * (last + 1 - first) + OVER
        cut.append(area.extrude(height).translate((0.0, 0.0, float(low) + LAYER * first)))
    return surface_from(body - manifold3d.Manifold.batch_boolean(cut, manifold3d.OpType.Add)) if cut else infill


def _fits(area: manifold3d.CrossSection, gone: manifold3d.CrossSection, kept: manifold3d.CrossSection) -> bool:
    """Return whether to cut out an area takes what is to go, and nothing else."""
    return bool((gone - area).area() < CRUMB and (area ^ kept).area() < CRUMB / 10)


def _section(
    part: manifold3d.CrossSection, infill: manifold3d.CrossSection, wall: float, line: float, least: float
) -> _Section:
    """Return what a slicer prints of a section.

    Smaller pieces than a line is wide and long count only where they are alone: there are some in all corners.
    """
    inside, overlap = _grown(part, -wall), OVERLAP * line
    around = _grown(part, overlap - wall)
    filled = around ^ infill
    roomy = filled ^ _grown(_opened(inside, line), overlap)
    kept = _opened(roomy, least)
    beside = _grown(kept, 3 * APART)
    rest = _opened(filled - _grown(kept, APART), 2 * APART)
    pieces = [piece for piece in rest.decompose() if piece.area() > CRUMB]
    gone = [piece for piece in pieces if piece.area() > line**2 or (piece ^ beside).is_empty()]
    return _Section(around=around, filled=filled, roomy=roomy, kept=kept, gone=gone)


def _opened(section: manifold3d.CrossSection, width: float) -> manifold3d.CrossSection:
    return _grown(_grown(section, -width / 2), width / 2)


def _grown(section: manifold3d.CrossSection, far: float) -> manifold3d.CrossSection:
    import manifold3d

    return section.offset(far, manifold3d.JoinType.Round)


def _united(sections: Iterable[manifold3d.CrossSection]) -> manifold3d.CrossSection:
    return reduce(lambda one, other: one + other, sections)
