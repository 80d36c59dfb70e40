"""Infill of a project that is too narrow for a line of a slicer: its share, and the infill without it.

A slicer prints infill where perimeters leave room for a line, and a little way into the perimeters; there, it prints
infill that is as wide as a line itself. A region is as wide as a line where a disc of that diameter fits: in its
morphological opening by such a disc.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from infill.meshes.solids import FINE, from_manifold, solid_status, to_manifold
from infill.surface import Surface

if TYPE_CHECKING:
    from collections.abc import Iterable

    import manifold3d

SECTIONS = 32
NARROW = 0.045  # of the infill: if slicers do not print more than this, by an estimate, it is left out, and reported
OVERLAP = 0.25  # of a line: how far slicers' infill reaches into perimeters
LAYER, OVER = 0.2, 0.03  # mm: height of a layer in which infill is left out, and its overlap with the next layer
APART = 0.02  # mm: gap between infill that is left out and infill that stays; narrower hairlines do not count
REACH = 0.05  # mm: by which the region that is left out reaches into voids and walls
CRUMB = 0.01  # mm²: smaller pieces do not count, even where they are alone


@dataclass(frozen=True, kw_only=True)
class NarrowShares:
    """Shares of the infill inside the walls that slicers do not print.

    Parameters
    ----------
    room : float
        Infill in room narrower than a line.
    all : float
        That, and infill that is too narrow itself.
    """

    room: float
    all: float


@dataclass(frozen=True, kw_only=True, eq=False)
class _Section:
    """A horizontal section of a part and its infill.

    Parameters
    ----------
    around : CrossSection
        Region for a slicer's infill, if there were room for it.
    filled : CrossSection
        The infill in that region.
    roomy : CrossSection
        The part of that infill with room as wide as a line.
    kept : CrossSection
        The part of that infill that is wide enough itself.
    gone : list of CrossSection
        Pieces of the remaining infill.
    """

    around: manifold3d.CrossSection
    filled: manifold3d.CrossSection
    roomy: manifold3d.CrossSection
    kept: manifold3d.CrossSection
    gone: list[manifold3d.CrossSection]


def estimate_narrow(part: Surface, infill: Surface, wall: float, line: float, narrowest: float) -> NarrowShares | None:
    """Estimate the shares of infill that slicers do not print; return None if manifold3d rejects a surface.

    Parameters
    ----------
    part, infill : Surface, mm
        The infill may reach into the walls.
    wall, line : float, mm
    narrowest : float, mm
        Width of the narrowest infill that is printed.

    Returns
    -------
    NarrowShares or None
        Of horizontal sections; 0 without infill inside the walls.

    >>> import trimesh
    >>> plate, block = trimesh.creation.box((40, 2, 10)), trimesh.creation.box((10, 10, 10))
    >>> plate, block = (Surface(vertices=each.vertices, faces=each.faces) for each in (plate, block))
    >>> [round(estimate_narrow(part, part, 0.9, 0.45, 0.6).all, 2) for part in (plate, block)]
    [1.0, 0.0]
    """
    part_body, infill_body = to_manifold(part), to_manifold(infill)
    if solid_status(part_body) != FINE or solid_status(infill_body) != FINE:
        return None
    low, high = part.bounds[:, 2]
    areas = np.zeros(3)  # all, in too narrow a room, that and what is too narrow
    for z in low + (np.arange(SECTIONS) + 0.5) / SECTIONS * (high - low):
        section = _divide_section(part_body.slice(z), infill_body.slice(z), wall, line, narrowest)
        gone = sum(piece.area() for piece in section.gone)
        areas += [section.filled.area(), section.filled.area() - section.roomy.area(), gone]
    total, in_narrow_room, gone = areas.tolist()
    return NarrowShares(room=in_narrow_room / total if total else 0.0, all=gone / total if total else 0.0)


def drop_narrow(part: Surface, infill: Surface, wall: float, line: float, narrowest: float) -> Surface:
    """Drop the infill that slicers do not print, layer by layer; the rest may be empty.

    Parameters
    ----------
    part, infill : Surface, mm
        Solids for manifold3d; the infill may reach into the walls.
    wall, line : float, mm
    narrowest : float, mm
        Width of the narrowest infill that is printed.

    >>> import trimesh
    >>> block, wall, sliver = (trimesh.creation.box((each, 9, 10)) for each in (10, 1, 0.3))
    >>> body = trimesh.util.concatenate([wall, sliver.apply_translation((2, 0, 0))])
    >>> block, body = (Surface(vertices=each.vertices, faces=each.faces) for each in (block, body))
    >>> left = drop_narrow(block, body, 0.9, 0.45, 0.6)
    >>> round(body.volume - left.volume, 1)  # 0.3 by 7.42 by 10 mm, and a little in the walls
    22.6
    """
    import manifold3d

    part_body, infill_body = to_manifold(part), to_manifold(infill)
    low, high = part.bounds[:, 2]
    cut: list[manifold3d.Manifold] = []
    areas: list[tuple[manifold3d.CrossSection, int, int]] = []  # with the first and the last layer
    for layer in range(int(np.ceil((high - low) / LAYER))):
        middle = float(low) + LAYER * (layer + 0.5)
        section = _divide_section(part_body.slice(middle), infill_body.slice(middle), wall, line, narrowest)
        if not section.gone:
            continue
        gone = _unite(section.gone)
        if areas and areas[-1][2] == layer - 1 and _fits(areas[-1][0], gone, section.kept):
            areas[-1] = (*areas[-1][:2], layer)
            continue
        # Alternately a little larger, as sides that almost coincide would be cut to shreds.
        extra = APART * (len(areas) % 2)
        room = _offset(section.around, REACH + extra)
        area = (_offset(gone, REACH + extra) - _offset(section.kept, APART + extra)) ^ room
        areas.append((area.simplify(APART / 2), layer, layer))
    for area, start, stop in areas:
        height = LAYER * (stop + 1 - start) + OVER
        cut.append(area.extrude(height).translate((0.0, 0.0, float(low) + LAYER * start)))
    return from_manifold(infill_body - manifold3d.Manifold.batch_boolean(cut, manifold3d.OpType.Add)) if cut else infill


def _fits(area: manifold3d.CrossSection, gone: manifold3d.CrossSection, kept: manifold3d.CrossSection) -> bool:
    """Tell whether cutting out an area removes what is to go, and nothing else."""
    return bool((gone - area).area() < CRUMB and (area ^ kept).area() < CRUMB / 10)


def _divide_section(
    part: manifold3d.CrossSection, infill: manifold3d.CrossSection, wall: float, line: float, narrowest: float
) -> _Section:
    """Divide a section into infill that a slicer prints, and infill that it does not print.

    Pieces smaller than the square of a line's width count only where they are alone, as all corners have some.
    """
    room, overlap = _offset(part, -wall), OVERLAP * line
    around = _offset(part, overlap - wall)
    filled = around ^ infill
    roomy = filled ^ _offset(_open(room, line), overlap)
    kept = _open(roomy, narrowest)
    near_kept = _offset(kept, 3 * APART)
    unprinted = _open(filled - _offset(kept, APART), 2 * APART)
    pieces = [piece for piece in unprinted.decompose() if piece.area() > CRUMB]
    gone = [piece for piece in pieces if piece.area() > line**2 or (piece ^ near_kept).is_empty()]
    return _Section(around=around, filled=filled, roomy=roomy, kept=kept, gone=gone)


def _open(section: manifold3d.CrossSection, width: float) -> manifold3d.CrossSection:
    """Open a section by a disc: parts narrower than `width` vanish, the rest keeps its outline."""
    return _offset(_offset(section, -width / 2), width / 2)


def _offset(section: manifold3d.CrossSection, distance: float) -> manifold3d.CrossSection:
    """Offset the outlines of a section outwards by a distance, mm, inwards if negative, with round corners."""
    import manifold3d

    return section.offset(distance, manifold3d.JoinType.Round)


def _unite(sections: Iterable[manifold3d.CrossSection]) -> manifold3d.CrossSection:
    """Unite sections, at least one."""
    return reduce(lambda union, section: union + section, sections)
