"""Compare a solid in bricks before and after smoothing: its connections, and the walls that were lost.

    data  ──▶  solid, void                        every cell above 0, and the rest
          ──▶  cores  ──▶  walls, sturdy solid    2 x 2 x 2 cells, all solid: solid more than one cell thick
    field ──▶  solid, void                        every cell above the level
    surface ─▶ shells                             the final surface

The equation removes solid that is one cell thick; thicker solid must stay. So components are compared directly, but
walls by their cores, which a bridge of single cells does not join, and voids around the sturdy solid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.inspection.changes import ConnectionCounts, TopologyChanges
from infill.inspection.component_matching import ComponentFate, Overlaps, compare_components, sum_overlaps
from infill.inspection.sign_changes import SignChanges, has_same_connections, has_unchanged_cells
from infill.isosurfaces.components import (
    Components,
    add_thickness,
    component_cells,
    data_bits,
    dilate,
    dilate_cores,
    erode_to_cores,
    find_components,
    shared_cells,
    solid_bits,
)
from infill.isosurfaces.levels import LevelSurface
from infill.isosurfaces.sparse_marching import euler_number_of_bits
from infill.kernels.threads import run_together, thread_count
from infill.phasefield.sparse import SparseField

LARGE = 100  # cells: a fusion of two components of this size or more is reported
SMALLEST_PART = 8  # cells: anything smaller that comes off a component is a crumb, not a part of it
WALL = 16  # cells: a piece of wall more than one cell thick but smaller than this may vanish
MOST_LOST_WALLS = 5  # of the lost walls are listed
FAINT = -0.9  # a component that needs a level as low as this would be gone at level 0
ROUNDED = 2  # cells by which edges and corners recede, in addition to the blur of the smoothing

Bits = NDArray[np.uint16]


@dataclass(frozen=True, kw_only=True)
class LostWallPiece:
    """A piece of wall that was lost.

    Parameters
    ----------
    voxels : int
        Its size.
    at : (3,) float
        Its centre, mm along the axes of the grid from the lower corner of the grid.
    """

    voxels: int
    at: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class TopologyCheck:
    """The changes of a solid by smoothing.

    Parameters
    ----------
    data, result : ConnectionCounts
        Connections of the solid before and after.
    changes : TopologyChanges
    lost : tuple of LostWallPiece
        The largest pieces of wall that were lost.
    """

    data: ConnectionCounts
    result: ConnectionCounts
    changes: TopologyChanges
    lost: tuple[LostWallPiece, ...]

    @property
    def problems(self) -> tuple[str, ...]:
        """Losses of anything more than one cell thick, one phrase each."""
        return tuple(
            phrase.format(f"{count} {words[count > 1]}") + " in smoothing"
            for name, phrase, words in PROBLEMS
            if (count := getattr(self.changes, name))
        )


PROBLEMS = (
    ("vanished", "{} vanished", ("component", "components")),
    ("broken", "{} fell apart", ("component", "components")),
    ("fused", "{} fused from several", ("component", "components")),
    ("walls_lost", "{} vanished", ("wall", "walls")),
    ("walls_pierced", "{} broke through walls", ("hole", "holes")),
    ("voids_joined", "{} between voids broke", ("wall", "walls")),
)


@dataclass(frozen=True, kw_only=True)
class _States:
    """The components to compare, and their counts."""

    solid: Components
    solid_after: Components
    walls: Components
    voids: Components
    voids_after: Components
    gone: Components
    data: ConnectionCounts
    sturdy: ConnectionCounts


def check_topology(
    levelled: LevelSurface,
    before: Components,
    *,
    spacing: tuple[float, ...],
    blur: float,
    levels: NDArray[np.float64],
    threads: int | None = None,
) -> TopologyCheck:
    """Compare a solid before and after smoothing.

    Parameters
    ----------
    levelled : LevelSurface
        The surface, and its field.
    before : Components
        Components of the data.
    spacing : (hx, hy, hz), mm
    blur : float
        Standard deviation of the diffusion, cells: edges may recede this far, plus `ROUNDED` cells.
    levels : (b,) float64
        Level of phi of each component.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    states = _find_states(levelled, before, ROUNDED + int(np.ceil(blur)), threads)
    result = _count_surface(levelled)
    of_solid, of_walls, of_voids = (
        match_components(earlier, later)
        for earlier, later in (
            (states.solid, states.solid_after),
            (states.walls, states.solid_after),
            (states.voids, states.voids_after),
        )
    )
    thick = states.solid.thick
    changes = TopologyChanges(
        vanished=int(thick[of_solid.vanished].sum()),
        vanished_thin=int((~thick[of_solid.vanished]).sum()),
        broken=int((states.walls.cells[of_walls.broken] >= WALL).sum()),
        fused=len(of_solid.fused),
        appeared=len(of_solid.appeared),
        voids_closed=int(states.voids.thick[of_voids.vanished].sum()),
        voids_cut=int(states.voids.thick[of_voids.broken].sum()),
        voids_joined=len(of_voids.fused),
        walls_pierced=max(0, result.tunnels - max(states.data.tunnels, states.sturdy.tunnels)),
        walls_lost=int((states.gone.cells >= WALL).sum()),
        faint=int((thick & (states.solid.cells >= WALL) & (levels < FAINT)).sum()),
    )
    largest = np.argsort(-states.gone.cells)[:MOST_LOST_WALLS]
    lost = tuple(
        _describe_loss(levelled.field, states.gone, int(number), spacing)
        for number in largest
        if states.gone.cells[number] >= WALL
    )
    return TopologyCheck(data=states.data, result=result, changes=changes, lost=lost)


def check_topology_by_signs(
    levelled: LevelSurface,
    before: Components,
    flips: SignChanges,
    *,
    levels: NDArray[np.float64],
    threads: int | None = None,
) -> TopologyCheck | None:
    """Judge as `check_topology` does by the cells that changed sign alone; return None if they do not settle it.

    Parameters
    ----------
    levelled, before, levels, threads
        See `check_topology`.
    flips : SignChanges
        The cells that changed sign between the data and the surface.
    """
    if not has_same_connections(flips, before, threads=threads):
        return None
    result, euler = _count_surface(levelled), flips.euler_number
    cavities = result.cavities
    if len(flips.doubt) or cavities or (before.count, euler) != (result.components, result.euler_number):
        voids = find_components(levelled.field, flips.data, void=True)
        if not has_unchanged_cells(voids, ~(flips.data ^ flips.result)):
            return None
        cavities = voids.count - 1
    data = ConnectionCounts.of(components=before.count, cavities=cavities, tunnels=before.count + cavities - euler // 2)
    faint = 0
    if (levels < FAINT).any():
        thick = add_thickness(levelled.field, before).thick
        faint = int((thick & (before.cells >= WALL) & (levels < FAINT)).sum())
    changes = TopologyChanges(
        vanished_thin=0, walls_lost=0, faint=faint, walls_pierced=max(0, result.tunnels - data.tunnels)
    )
    return TopologyCheck(data=data, result=result, changes=changes, lost=())


def _find_states(levelled: LevelSurface, before: Components, reach: int, threads: int | None) -> _States:
    """Find all components to be compared, in parallel."""
    field = levelled.field
    before_bits, after_bits = (
        data_bits(field, threads=threads),
        solid_bits(field, level=levelled.height, threads=threads),
    )
    core = erode_to_cores(field, before_bits, threads=threads)
    thick = dilate_cores(field, core, threads=threads)
    lost = thick & ~dilate(field, after_bits, reach, threads=threads)
    solid, after, walls, sturdy, voids, sturdy_voids, voids_after, gone = run_together(
        lambda: add_thickness(field, before),
        lambda: find_components(field, after_bits),
        lambda: find_components(field, core),
        lambda: find_components(field, thick),
        lambda: find_components(field, before_bits, void=True),
        lambda: find_components(field, thick, void=True, thickness=True),
        lambda: find_components(field, after_bits, void=True),
        lambda: find_components(field, lost, whole=False),
        threads=thread_count(threads),
    )
    return _States(
        solid=solid,
        solid_after=after,
        walls=walls,
        voids=sturdy_voids,
        voids_after=voids_after,
        gone=gone,
        data=_count_connections(solid, voids, euler_number_of_bits(field, before_bits, threads=threads)),
        sturdy=_count_connections(sturdy, sturdy_voids, euler_number_of_bits(field, thick, threads=threads)),
    )


def match_components(before: Components, after: Components) -> ComponentFate:
    """Match components on the same bricks; solid only one cell thick does not fuse them."""
    shared: Overlaps = sum_overlaps(shared_cells(before, after), before=before.count, after=after.count)
    counted = before.thick if len(before.thick) else None
    return compare_components(shared, part=SMALLEST_PART, piece=LARGE, counted=counted)


def _count_connections(solid: Components, void: Components, surface_euler_number: int) -> ConnectionCounts:
    """Count the components, cavities and tunnels of a solid whose void has the outside as its first component."""
    cavities = void.count - 1
    return ConnectionCounts.of(
        components=solid.count, cavities=cavities, tunnels=solid.count + cavities - surface_euler_number // 2
    )


def _count_surface(levelled: LevelSurface) -> ConnectionCounts:
    """Count the components, cavities and tunnels of the final surface."""
    shells = levelled.shells
    return ConnectionCounts(
        components=shells.components,
        cavities=shells.cavities,
        tunnels=shells.tunnels,
        euler_number=int(shells.euler.sum()),
    )


def _describe_loss(field: SparseField, pieces: Components, number: int, spacing: tuple[float, ...]) -> LostWallPiece:
    """Describe one of the lost pieces of wall."""
    cells = component_cells(field, pieces, number)
    return LostWallPiece(voxels=len(cells), at=(cells.mean(axis=0) + 0.5) * spacing)
