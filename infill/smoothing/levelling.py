"""The third stage: the surface at the level at which every component has the volume it has in the data."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.isosurfaces.components import Components, components, data_bits
from infill.isosurfaces.levels import Levelled, at_level, at_volume, counted, nearest_components, volumes_of
from infill.phasefield.profile import REFINED

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.smoothing.request import Given, Request
    from infill.volume import Volume
    from infill.voxels.partial import Enclosed

# Of the area of a component of a mesh that lies nearest to one component of the data: if less lies nearest to another
# one, that is by chance, as where two of them touch.
FEW = 0.02


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


def levelled(field: SparseField, given: Given, request: Request) -> Surfaced:
    """Return the surface of a smoothed field: at the level that keeps the volume, or at the requested one.

    If the field is straightened along the way, its values are overwritten.
    """
    threads, level, spacing = request.threads, request.level, tuple(given.data.cell_size.tolist())
    if isinstance(level, str):
        before, field, start = counted(field, spacing=spacing, straighten=not request.refined, threads=threads)
        targets = _targets(field, before, given, threads)
        found = at_volume(field, before, spacing=spacing, targets=targets, start=start, threads=threads)
        said = request.profile.phase_level
        common, levels = said(found.common), np.array([said(float(each)) for each in found.levels])
    else:
        before = components(field, data_bits(field, threads=threads))
        targets = _targets(field, before, given, threads)
        cut = request.profile.distance_level(level) if request.refined else level
        found = at_level(field, before, spacing=spacing, level=cut, threads=threads)
        common, levels = level, np.full(before.count, level)
    return Surfaced(found=found, before=before, targets=targets, common=common, levels=levels)


def _targets(field: SparseField, data: Components, given: Given, threads: int | None) -> NDArray[np.float64]:
    """Return the volume of each component of the data, mm³: its cells, or what their mesh or grey surface encloses."""
    spacing = tuple(given.data.cell_size.tolist())
    cells: NDArray[np.float64] = data.cells.astype(np.float64) * math.prod(spacing)
    if field.data.dtype == np.int8:
        return cells
    grey = replace(field, values=field.data.astype(np.float32))
    if given.enclosed is not None:
        grey = replace(grey, values=REFINED.distance(grey.values, threads=threads))
    volume = volumes_of(grey, data, spacing=spacing, threads=threads)
    volume = np.where(volume > 0, volume, cells)
    if given.volume is not None:
        whole: NDArray[np.float64] = volume * (given.volume / volume.sum())
        return whole
    return volume if given.enclosed is None else _enclosed(field, data, given.data, given.enclosed, volume)


def _enclosed(
    field: SparseField, data: Components, grid: Volume, held: Enclosed, volume: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the volume that a mesh encloses in each component of the data, mm³; `volume` is what its field encloses.

    Components of the mesh that lie in one of the data are summed up. Where one of the mesh lies in several, because a
    wall between them is too thin for the cells, those share its volume as they share that of the field.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    of_face = nearest_components((held.beside - np.array(grid.origin)) / grid.cell_size, field, data)
    known = of_face >= 0
    count = len(held.volumes)
    key, index = np.unique(held.component[known].astype(np.int64) * data.count + of_face[known], return_inverse=True)
    area = np.bincount(index, weights=held.area[known], minlength=len(key))
    of_mesh, of_data = np.divmod(key, data.count)
    most = np.zeros(count)
    np.maximum.at(most, of_mesh, area)
    real = area > FEW * most[of_mesh]
    graph = coo_array(
        (np.ones(int(real.sum()), dtype=np.int8), (of_mesh[real], count + of_data[real])),
        shape=(count + data.count,) * 2,
    )
    _, group = connected_components(graph, directed=False)
    groups = int(group.max()) + 1
    total = np.bincount(group[:count], weights=held.volumes, minlength=groups)
    if len(held.excess):
        over = nearest_components((held.over - np.array(grid.origin)) / grid.cell_size, field, data)
        total -= np.bincount(group[count + over[over >= 0]], weights=held.excess[over >= 0], minlength=groups)
    shared = np.bincount(group[count:], weights=volume, minlength=groups)
    own = np.bincount(group[:count], minlength=groups) > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = np.where(own & (total > 0) & (shared > 0), total / shared, 1.0)
    found: NDArray[np.float64] = volume * scale[group[count:]]
    return found
