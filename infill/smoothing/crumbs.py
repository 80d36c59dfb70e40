"""Crumbs: pieces that smoothing itself breaks off, too small to be anything that was given."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.levels import Levelled, component_of_shells
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.smoothing.levelling import Surfaced
    from infill.smoothing.request import Given, Request

CRUMB = 8.0  # cells, a block of 2 x 2 x 2: what the steps leave of a wall that breaks up


@dataclass(frozen=True, kw_only=True)
class Crumbs:
    """What was taken out.

    Parameters
    ----------
    count : int
    volume, limit : float, mm³
        Volume of all of them, and the size up to which a piece was a crumb.
    """

    count: int
    volume: float
    limit: float


def without_crumbs(surfaced: Surfaced, given: Given, request: Request) -> tuple[Surfaced, Crumbs]:
    """Return the surface without crumbs, and what they were.

    A piece of solid is a crumb if it has at most `request.crumbs` mm³, by default as much as 8 cells, and is not the
    largest piece of what was one component of the data. Of a mesh none of whose components is so small, every such
    piece is one, and so is every such cavity: the surface around it goes, and it is filled.
    """
    limit = CRUMB * given.data.cell_volume if request.crumbs is None else request.crumbs
    found = surfaced.found
    volume = found.shells.volume
    if found.shells.names.min(initial=0) < 0:  # vertices that no face uses
        found = _without_shells(found, np.zeros(len(volume), dtype=bool))
        surfaced = replace(surfaced, found=found)
    held = given.enclosed
    every = held is not None and not (np.abs(held.volumes[held.volumes != 0]) <= limit).any()
    small = (np.abs(volume) if every else np.where(volume > 0, volume, np.inf)) <= limit
    if not small.any() or small.all():
        return surfaced, Crumbs(count=0, volume=0.0, limit=limit)
    if every:
        return replace(surfaced, found=_without_shells(found, small)), Crumbs(
            count=int(small.sum()), volume=float(np.abs(volume[small]).sum()), limit=limit
        )
    spacing = tuple(given.data.cell_size.tolist())
    component = component_of_shells(found, surfaced.before, spacing=spacing)
    largest = np.full(surfaced.before.count, -math.inf)
    known = component >= 0
    np.maximum.at(largest, component[known], volume[known])
    own = np.where(known, largest[component], math.inf) <= volume
    crumb = small & ~own
    if not crumb.any():
        return surfaced, Crumbs(count=0, volume=0.0, limit=limit)
    lean = _without_shells(found, crumb)
    return replace(surfaced, found=lean), Crumbs(count=int(crumb.sum()), volume=float(volume[crumb].sum()), limit=limit)


def _without_shells(found: Levelled, gone: NDArray[np.bool_]) -> Levelled:
    """Return the surface without some of its shells."""
    names = found.shells.names
    vertices = (names >= 0) & ~gone[names]
    number = np.cumsum(vertices) - 1
    faces = found.surface.faces
    kept = faces[vertices[faces[:, 0]]]
    surface = Surface(
        vertices=found.surface.vertices[vertices],
        faces=number[kept].astype(faces.dtype),
        space=found.surface.space,
    )
    return replace(found, surface=surface, rate=found.rate[vertices], total=None)
