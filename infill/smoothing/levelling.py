"""The third stage: find the surface at the level at which every component keeps its volume, and remove crumbs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.graph import label_connected
from infill.isosurfaces.components import Components, data_bits, find_components
from infill.isosurfaces.levels import (
    LevelSurface,
    component_of_shells,
    component_volumes,
    nearest_components,
    prepare_levels,
    surface_at_level,
    surface_at_volume,
)
from infill.meshes.distance import TriangleTree
from infill.phasefield.profile import PLAIN_PROFILE, REFINED_PROFILE
from infill.plain_numbers import count_noun, plain_argument, plain_number, plain_size
from infill.smoothing.stages import place_surface
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.reports.smoothing import CrumbKeys
    from infill.smoothing.request import SmoothedInput, SmoothRequest
    from infill.volume import Volume
    from infill.voxels.partial import EnclosedVolumes

# Of the largest area of a mesh component that is nearest to one component of the data: smaller areas nearest to other
# components are chance, as where two components touch.
MIN_AREA_SHARE = 0.02
REMNANT_SHARE = 0.25  # of its volume: a small piece that has less of a component is what is left where it vanished
DUST_CELLS = 0.125  # cells, a block of half a cell: no component of the data is as small
VOTERS = 500  # vertices of a shell, about, that say which mesh component it belongs to
LEAST_CRUMBS = 0.1  # of the largest crumb: less than this, of all crumbs together, is not worth its digits
CRUMB_CELLS = 8.0  # cells, a block of 2 x 2 x 2: pieces of this size remain of a wall that breaks up


@dataclass(frozen=True, kw_only=True, eq=False)
class SurfaceAtLevel:
    """A surface, the components of the data, and its levels in terms of phi.

    Parameters
    ----------
    levelled : LevelSurface
    components : Components
        Of the data.
    targets : (b,) float64
        Volume of each component, mm³.
    common : float
        Level of phi of components without their own level.
    levels : (b,) float64
        Level of phi of each component.
    """

    levelled: LevelSurface
    components: Components
    targets: NDArray[np.float64]
    common: float
    levels: NDArray[np.float64]

    @property
    def volume(self) -> float:
        """Volume enclosed by the surface, mm³."""
        return float(self.levelled.shells.volume.sum())


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

    def facts(self) -> CrumbKeys:
        """Return the numbers by name, for the report."""
        return {"removed": self.count, "volume": self.volume, "limit": self.limit}


def extract_surface(smoothed: SmoothedInput) -> SurfaceAtLevel:
    """Extract the surface of a field, which may be changed: at the level that keeps the volume, or the requested one.

    If the field is straightened along the way, its values are overwritten.
    """
    field, request = smoothed.field, smoothed.request
    threads, level, spacing = smoothed.threads, request.level, smoothed.spacing
    if isinstance(level, str):
        components, field, start = prepare_levels(
            field, spacing=spacing, straighten=not request.refined, threads=threads
        )
        targets = _target_volumes(field, components, smoothed)
        levelled = surface_at_volume(field, components, spacing=spacing, targets=targets, start=start, threads=threads)
        to_phase_level = (REFINED_PROFILE if request.refined else PLAIN_PROFILE).phase_level
        common, levels = (
            to_phase_level(levelled.common),
            np.array([to_phase_level(float(height)) for height in levelled.levels]),
        )
    else:
        components = find_components(field, data_bits(field, threads=threads))
        targets = _target_volumes(field, components, smoothed)
        threshold = REFINED_PROFILE.distance_level(level) if request.refined else level
        levelled = surface_at_level(field, components, spacing=spacing, level=threshold, threads=threads)
        common, levels = level, np.full(components.count, level)
    return SurfaceAtLevel(levelled=levelled, components=components, targets=targets, common=common, levels=levels)


def _target_volumes(field: SparseField, data: Components, smoothed: SmoothedInput) -> NDArray[np.float64]:
    """Return the volume of each component of the data, mm³: of its cells, or inside its mesh or grey surface."""
    smooth_input, spacing, threads = smoothed.smooth_input, smoothed.spacing, smoothed.threads
    cells: NDArray[np.float64] = data.cells.astype(np.float64) * math.prod(spacing)
    if field.data.dtype == np.int8:
        return cells
    grey = replace(field, values=field.data.astype(np.float32))
    if smooth_input.mesh_volumes is not None:
        grey = replace(grey, values=REFINED_PROFILE.distance(grey.values, threads=threads))
    volume = component_volumes(grey, data, spacing=spacing, threads=threads)
    volume = np.where(volume > 0, volume, cells)
    if smooth_input.volume is not None:
        scaled: NDArray[np.float64] = volume * (smooth_input.volume / volume.sum())
        return scaled
    if smooth_input.mesh_volumes is None:
        return volume
    return _mesh_targets(field, data, smooth_input.data, smooth_input.mesh_volumes, volume)


def _mesh_targets(
    field: SparseField, data: Components, grid: Volume, enclosed: EnclosedVolumes, volume: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the volume of the mesh in each component of the data, mm³; `volume` is that inside its field.

    Mesh components that lie in the same component of the data are summed up. Where a mesh component lies in several,
    because a wall between them is too thin for the cells, these share its volume as they share that of the field.
    """
    of_face = nearest_components((enclosed.beside - np.array(grid.origin)) / grid.cell_size, field, data)
    has_component = of_face >= 0
    count = len(enclosed.volumes)
    key, index = np.unique(
        enclosed.component[has_component].astype(np.int64) * data.count + of_face[has_component], return_inverse=True
    )
    area = np.bincount(index, weights=enclosed.area[has_component], minlength=len(key))
    of_mesh, of_data = np.divmod(key, data.count)
    largest_area = np.zeros(count)
    np.maximum.at(largest_area, of_mesh, area)
    is_linked = area > MIN_AREA_SHARE * largest_area[of_mesh]
    group, groups = label_connected(of_mesh[is_linked], count + of_data[is_linked], count + data.count)
    mesh_volume = np.bincount(group[:count], weights=enclosed.volumes, minlength=groups)
    if len(enclosed.excess):
        excess_component = nearest_components((enclosed.over - np.array(grid.origin)) / grid.cell_size, field, data)
        mesh_volume -= np.bincount(
            group[count + excess_component[excess_component >= 0]],
            weights=enclosed.excess[excess_component >= 0],
            minlength=groups,
        )
    field_volume = np.bincount(group[count:], weights=volume, minlength=groups)
    has_mesh = np.bincount(group[:count], minlength=groups) > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = np.where(has_mesh & (mesh_volume > 0) & (field_volume > 0), mesh_volume / field_volume, 1.0)
    targets: NDArray[np.float64] = volume * scale[group[count:]]
    return targets


def remove_crumbs(surfaced: SurfaceAtLevel, smoothed: SmoothedInput) -> tuple[SurfaceAtLevel, Crumbs]:
    """Remove crumbs from a surface; return it and their number and volume.

    A piece of solid is a crumb if it has at most `request.crumbs` mm³, by default the volume of 8 cells, and is not
    the largest piece of a component of the data. Of a scan, the largest piece is one too if it has at most a quarter
    of the volume of its component, and so is every piece and cavity of an eighth of a cell. Of a mesh component larger
    than the limit, every such piece and every such cavity is a crumb. The surface around a cavity is removed, so that
    it is filled.
    """
    smooth_input, request = smoothed.smooth_input, smoothed.request
    limit = CRUMB_CELLS * smooth_input.data.cell_volume if request.crumbs is None else request.crumbs
    levelled = surfaced.levelled
    volume = levelled.shells.volume
    if levelled.shells.names.min(initial=0) < 0:  # vertices that no face uses
        levelled = _without_shells(levelled, np.zeros(len(volume), dtype=bool))
        surfaced = replace(surfaced, levelled=levelled)
    enclosed = smooth_input.mesh_volumes
    small = np.abs(volume) <= limit
    if not small.any() or small[volume > 0].all():
        return surfaced, Crumbs(count=0, volume=0.0, limit=limit)
    if enclosed is not None and not (np.abs(enclosed.volumes[enclosed.volumes != 0]) <= limit).any():
        crumb = small
    else:
        component = component_of_shells(levelled, surfaced.components, spacing=smoothed.spacing)
        if enclosed is None:
            crumb = find_crumbs(volume, component, surfaced.targets, limit, smooth_input.data.cell_volume)
        else:
            crumb = small & (volume > 0) & _is_debris(volume, component, surfaced.targets, 0.0)
            crumb |= small & _is_of_large_body(levelled, smoothed, enclosed, limit)
    if not crumb.any():
        return surfaced, Crumbs(count=0, volume=0.0, limit=limit)
    return replace(surfaced, levelled=_without_shells(levelled, crumb)), Crumbs(
        count=int(crumb.sum()), volume=float(np.abs(volume[crumb]).sum()), limit=limit
    )


def find_crumbs(
    volume: NDArray[np.float64],
    component: NDArray[np.int64],
    targets: NDArray[np.float64],
    limit: float,
    cell_volume: float,
) -> NDArray[np.bool_]:
    """Mark the shells of a smoothed scan that are crumbs: see `remove_crumbs`.

    Parameters
    ----------
    volume : (s,) float64, mm³
        Of the shells, negative around cavities.
    component : (s,) int64
        The component of the data nearest to each, -1 for none.
    targets : (b,) float64, mm³
        Volume of each component.
    limit : float, mm³
    cell_volume : float, mm³
    """
    small = np.abs(volume) <= limit
    crumbs: NDArray[np.bool_] = small & (volume > 0) & _is_debris(volume, component, targets, REMNANT_SHARE)
    return crumbs | (small & (np.abs(volume) <= DUST_CELLS * cell_volume))


def _is_debris(
    volume: NDArray[np.float64], component: NDArray[np.int64], targets: NDArray[np.float64], remnant_share: float
) -> NDArray[np.bool_]:
    """Mark the shells to drop: all but the largest of a component of the data, and those with a small share of it."""
    largest = np.full(len(targets), -math.inf)
    has_component = component >= 0
    np.maximum.at(largest, component[has_component], volume[has_component])
    is_largest = np.where(has_component, largest[component], math.inf) <= volume
    is_remnant = has_component & (volume <= remnant_share * targets[component])
    broken_off: NDArray[np.bool_] = ~is_largest | is_remnant
    return broken_off


def _is_of_large_body(
    levelled: LevelSurface, smoothed: SmoothedInput, enclosed: EnclosedVolumes, limit: float
) -> NDArray[np.bool_]:
    """Tell for every shell whether the mesh component nearest to it is large, and has a larger shell, too."""
    smooth_input, volume = smoothed.smooth_input, np.abs(levelled.shells.volume)
    assert smooth_input.closed_mesh is not None
    names, count = levelled.shells.names, len(enclosed.volumes)
    numbers, sizes = np.unique(names, return_counts=True)
    stride = np.ones(len(volume), dtype=np.int64)
    stride[numbers] = np.maximum(1, sizes // VOTERS)
    chosen = np.arange(len(names)) % stride[names] == 0
    points = place_surface(levelled.surface, smooth_input.data).vertices[chosen]
    _, face = TriangleTree.of(smooth_input.closed_mesh).nearest(np.asarray(points), threads=smoothed.threads)
    key, votes = np.unique(names[chosen].astype(np.int64) * count + enclosed.component[face], return_counts=True)
    shell, voted = np.divmod(key, count)
    order = np.argsort(votes, kind="stable")  # the last write has the most votes
    body = np.zeros(len(volume), dtype=np.int64)
    body[shell[order]] = voted[order]
    largest = np.zeros(count)
    np.maximum.at(largest, body, volume)
    of_large: NDArray[np.bool_] = (np.abs(enclosed.volumes[body]) > limit) & (volume < largest[body])
    return of_large


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


def describe_cleaning(crumbs: Crumbs, specks: int, request: SmoothRequest) -> list[str]:
    """Describe crumbs and specks that were removed on purpose, one phrase each."""
    phrases = []
    if crumbs.count:
        limit = f"{plain_argument(CRUMB_CELLS)} voxels" if request.crumbs is None else plain_size(crumbs.limit, power=3)
        in_all = f", {plain_size(crumbs.volume, power=3)} in all" if crumbs.volume > LEAST_CRUMBS * crumbs.limit else ""
        phrases.append(f"{count_noun(crumbs.count, 'crumb')} of up to {limit} taken out{in_all}")
    if specks:
        limit = plain_number(request.despeckle)
        phrases.append(f"{count_noun(specks, 'speck')} of up to {limit} mm³ taken out beforehand")
    return phrases
