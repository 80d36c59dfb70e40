"""Crumbs: pieces that smoothing breaks off, too small to be part of the input."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.levels import LevelSurface, component_of_shells
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.smoothing.levelling import SurfaceAtLevel
    from infill.smoothing.request import SmoothInput, SmoothRequest

CRUMB_CELLS = 8.0  # cells, a block of 2 x 2 x 2: pieces of this size remain of a wall that breaks up


@dataclass(frozen=True, kw_only=True)
class Crumbs:
    """Number and volume of the crumbs that were removed.

    Parameters
    ----------
    count : int
    volume, limit : float, mm³
        Volume of all of them, and the size up to which a piece was a crumb.
    """

    count: int
    volume: float
    limit: float


def remove_crumbs(
    surfaced: SurfaceAtLevel, smooth_input: SmoothInput, request: SmoothRequest
) -> tuple[SurfaceAtLevel, Crumbs]:
    """Remove crumbs from a surface; return it and their number and volume.

    A piece of solid is a crumb if it has at most `request.crumbs` mm³, by default the volume of 8 cells, and is not
    the largest piece of a component of the data. If all components of a mesh are larger than that, every such piece
    is a crumb, and every such cavity too: the surface around it is removed, so that it is filled.
    """
    limit = CRUMB_CELLS * smooth_input.data.cell_volume if request.crumbs is None else request.crumbs
    levelled = surfaced.found
    volume = levelled.shells.volume
    if levelled.shells.names.min(initial=0) < 0:  # vertices that no face uses
        levelled = _without_shells(levelled, np.zeros(len(volume), dtype=bool))
        surfaced = replace(surfaced, found=levelled)
    enclosed = smooth_input.enclosed
    all_small = enclosed is not None and not (np.abs(enclosed.volumes[enclosed.volumes != 0]) <= limit).any()
    small = (np.abs(volume) if all_small else np.where(volume > 0, volume, np.inf)) <= limit
    if not small.any() or small.all():
        return surfaced, Crumbs(count=0, volume=0.0, limit=limit)
    if all_small:
        return replace(surfaced, found=_without_shells(levelled, small)), Crumbs(
            count=int(small.sum()), volume=float(np.abs(volume[small]).sum()), limit=limit
        )
    spacing = tuple(smooth_input.data.cell_size.tolist())
    component = component_of_shells(levelled, surfaced.before, spacing=spacing)
    largest = np.full(surfaced.before.count, -math.inf)
    has_component = component >= 0
    np.maximum.at(largest, component[has_component], volume[has_component])
    is_largest = np.where(has_component, largest[component], math.inf) <= volume
    crumb = small & ~is_largest
    if not crumb.any():
        return surfaced, Crumbs(count=0, volume=0.0, limit=limit)
    crumbless = _without_shells(levelled, crumb)
    return replace(surfaced, found=crumbless), Crumbs(
        count=int(crumb.sum()), volume=float(volume[crumb].sum()), limit=limit
    )


def _without_shells(levelled: LevelSurface, removed: NDArray[np.bool_]) -> LevelSurface:
    """Remove shells from a surface; `removed` marks them."""
    names = levelled.shells.names
    vertices = (names >= 0) & ~removed[names]
    number = np.cumsum(vertices) - 1
    faces = levelled.surface.faces
    remaining = faces[vertices[faces[:, 0]]]
    surface = Surface(
        vertices=levelled.surface.vertices[vertices],
        faces=number[remaining].astype(faces.dtype),
        space=levelled.surface.space,
    )
    return replace(levelled, surface=surface, rate=levelled.rate[vertices], total=None)
