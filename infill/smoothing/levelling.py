"""The third stage: the surface at the level at which every component has the volume it has in the data."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.surfaces.components import Components, components, data_bits
from infill.surfaces.levels import Levelled, at_level, at_volume, counted, volumes_of

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.smoothing.request import Request


@dataclass(frozen=True, kw_only=True, eq=False)
class Surfaced:
    """A surface, what it was found from, and its levels in terms of phi.

    Parameters
    ----------
    found : Levelled
    before : Components
        Of the data.
    targets : (b,) float64
        Volume of each component, mm³.
    common : float
        Level of phi of everything that has no level of its own.
    levels : (b,) float64
        Level of phi of each component.
    """

    found: Levelled
    before: Components
    targets: NDArray[np.float64]
    common: float
    levels: NDArray[np.float64]

    @property
    def volume(self) -> float:
        """Volume enclosed by the surface, mm³."""
        return float(self.found.shells.volume.sum())


def levelled(field: SparseField, request: Request, *, spacing: tuple[float, ...]) -> Surfaced:
    """Return the surface of a smoothed field: at the level that keeps the volume, or at the requested one.

    If the field is straightened along the way, its values are overwritten.
    """
    threads, level = request.threads, request.level
    if isinstance(level, str):
        before, field, guess = counted(field, spacing=spacing, straighten=not request.refine, threads=threads)
        targets = _targets(field, before, spacing, threads)
        found = at_volume(field, before, spacing=spacing, targets=targets, guess=guess, threads=threads)
        said = request.profile.phase_level
        common, levels = said(found.common), np.array([said(float(each)) for each in found.levels])
    else:
        before = components(field, data_bits(field, threads=threads))
        targets = _targets(field, before, spacing, threads)
        cut = request.profile.distance_level(level) if request.refine else level
        found = at_level(field, before, spacing=spacing, level=cut, threads=threads)
        common, levels = level, np.full(before.count, level)
    return Surfaced(found=found, before=before, targets=targets, common=common, levels=levels)


def _targets(
    field: SparseField, data: Components, spacing: tuple[float, ...], threads: int | None
) -> NDArray[np.float64]:
    """Return the volume of each component of the data, mm³: its cells, or what the surface of grey data encloses."""
    cells: NDArray[np.float64] = data.cells.astype(np.float64) * math.prod(spacing)
    if field.data.dtype == np.int8:
        return cells
    grey = replace(field, values=field.data.astype(np.float32))
    volume = volumes_of(grey, data, spacing=spacing, threads=threads)
    return np.where(volume > 0, volume, cells)
