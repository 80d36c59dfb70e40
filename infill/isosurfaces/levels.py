"""Find the level of a field at which the solid has the volume of the data.

Smoothing by the paper's equation shrinks convex solid: a sphere of 40 cells by 2 % after 40 steps. The fault is
not in the field but in the level: {phi > c} with c a little below 0 has the volume of the data, and lies closer to
the true surface. Components differ, so each gets a separate level.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.graph import label_connected
from infill.isosurfaces.components import (
    Components,
    SurfaceShells,
    brick_sides_on_grid,
    data_bits,
    find_components,
    label_shells,
)
from infill.isosurfaces.sparse_marching import ExtractedLevel, LevelSigns, extract_level, measure_level
from infill.kernels import components as components_kernels
from infill.kernels import sparse_marching as marching_kernels
from infill.kernels.sparse import BRICK, CELLS, SOLID_BRICK
from infill.kernels.threads import in_threads, run_together, thread_count
from infill.phasefield.profile import PLAIN_PROFILE
from infill.phasefield.sparse import SparseField
from infill.surface import Surface

Found = TypeVar("Found")
Measured = TypeVar("Measured", bound="MeasuredLevel")

# Levels lie between minus and plus this: at +-1 the distance is cut off and there is no surface, while a surface this
# close to the limit still has cells on both sides that are not cut off.
LIMIT = 0.98
# Of the volume. A ball of 80 cells whose volume is this much too large has a radius 0.0013 cells too large, where
# smoothing itself is off by 0.02.
TOLERANCE = 5e-5
# The same for one component among several, which share the rounds: 0.005 cells on such a ball.
COMPONENT_TOLERANCE = 2e-4
# A step moves a surface by at most 0.3 artanh 0.9999 / artanh 0.9 = 1.01 interfaces, two cells: the slope of the volume
# belongs to the surface where it is now, and is valid no further. Four steps lead from 0 to the limit, and Newton's
# method then needs two or three; eight rounds are one more than that.
BIGGEST_STEP = 0.3
ROUNDS = 8
# Cells from a component within which its level applies: as far as a refined distance reaches, which is cut off
# artanh 0.995 / artanh 0.9 = 2.03 interfaces of two cells away.
REACH = 4
SMALLEST = 8  # cells, 2 x 2 x 2: a smaller component has no separate level


@dataclass(frozen=True, kw_only=True)
class LevelSurface:
    """A surface of the right volume, and the levels that give it.

    Parameters
    ----------
    field : SparseField
        The field, or the field minus the level of each component.
    surface : Surface
    rate : (V, 3) float32
        Movement of its vertices when the level rises by one, mm.
    signs : LevelSigns
        Of the cells that the surface lies between.
    height : float
        The level of the surface in that field.
    common : float
        The level of everything without a separate level.
    levels : (b,) float64
        The level of each component of the data.
    total : (float, float), optional
        Volume of the surface, mm³, and its slope over the level, if they are known.
    threads : int, optional
        Used to label the shells; see `infill.kernels.threads.thread_count`.
    """

    field: SparseField
    surface: Surface
    rate: NDArray[np.float32]
    signs: LevelSigns
    height: float
    common: float
    levels: NDArray[np.float64]
    total: tuple[float, float] | None = None
    threads: int | None = None

    @cached_property
    def shells(self) -> SurfaceShells:
        """The connected parts of the surface."""
        return label_shells(self.surface, self.rate, total=self.total, threads=self.threads)


def straighten_profile(
    field: SparseField, *, out: NDArray[np.float32] | None = None, threads: int | None = None
) -> SparseField:
    """Convert a field to a distance from the surface, scaled to [-1, 1]; in `out`, which may be the field's values."""
    return replace(field, values=PLAIN_PROFILE.distance(field.values, out=out, threads=threads))


@dataclass(frozen=True, kw_only=True)
class LevelTrial:
    """A surface at some level.

    Parameters
    ----------
    level : float
    found : ExtractedLevel
    volume, slope : float
        The enclosed volume, mm³, and its change when the level rises by one.
    """

    level: float
    found: ExtractedLevel
    volume: float
    slope: float


@dataclass(frozen=True, kw_only=True)
class LevelStart:
    """Known volumes with which the search for a level begins.

    Parameters
    ----------
    at_zero : (float, float) or None
        Volume at level 0, mm³, and its slope over the level.
    first : LevelTrial or None
        The surface at the level that these suggest for the volume of all cells.
    """

    at_zero: tuple[float, float] | None = None
    first: LevelTrial | None = None


class MeasuredLevel(Protocol):
    """A level, the volume inside it, mm³, and its change when the level rises by one."""

    @property
    def level(self) -> float:
        """The level."""

    @property
    def volume(self) -> float:
        """The volume inside it, mm³."""

    @property
    def slope(self) -> float:
        """The change of the volume when the level rises by one."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ComponentTrial(Generic[Found]):
    """A surface on which every component has a level of its own, in parts that are connected.

    Parameters
    ----------
    component : (s,) int64
        The component of the data nearest to each part, -1 for none.
    fused : (n, 2) int64
        Pairs of components that share a part.
    volume, slope : (s,) float64
        Volume of each part, mm³, and its change when the level rises by one.
    found : object
        The surface.
    """

    component: NDArray[np.int64]
    fused: NDArray[np.int64]
    volume: NDArray[np.float64]
    slope: NDArray[np.float64]
    found: Found


def try_level(field: SparseField, level: float, *, spacing: tuple[float, ...], threads: int) -> LevelTrial:
    """Extract the surface at a level, and measure its volume."""
    extracted = extract_level(field, spacing=spacing, level=level, threads=threads)
    surface = extracted.surface
    sums = np.empty((-(-len(surface.faces) // marching_kernels.BLOCK), 2))
    middle = surface.vertices[len(surface.vertices) // 2]
    in_threads(
        marching_kernels.sum_volumes, surface.vertices, extracted.rate, surface.faces, middle, sums, threads=threads
    )
    sixfold, slope = sums.sum(axis=0).tolist()
    return LevelTrial(level=level, found=extracted, volume=sixfold / 6, slope=slope / 6)


def prepare_levels(
    field: SparseField, *, spacing: tuple[float, ...], straighten: bool = True, threads: int | None = None
) -> tuple[Components, SparseField, LevelStart]:
    """Label the components of the data, straighten the field, and guess a level; return all three.

    The components are found in parallel. A field that is straightened has its values overwritten.
    """
    threads = thread_count(threads)
    bits = data_bits(field, threads=threads)

    def label_components() -> Components:
        return find_components(field, bits)

    def find_start() -> tuple[SparseField, LevelStart]:
        straight = straighten_profile(field, out=field.values, threads=threads) if straighten else field
        volume_and_slope = measure_level(straight, spacing=spacing, level=0.0, threads=threads)
        if volume_and_slope is None or volume_and_slope[1] >= 0 or field.data.dtype != np.int8:
            return straight, LevelStart(at_zero=volume_and_slope)
        total = math.prod(spacing) * _count_solid_cells(field, bits)
        try:
            first_trial = try_level(
                straight, _next_level(0.0, *volume_and_slope, total), spacing=spacing, threads=threads
            )
        except GeometryError:  # no solid remains above this level
            return straight, LevelStart(at_zero=volume_and_slope)
        return straight, LevelStart(at_zero=volume_and_slope, first=first_trial)

    (straight, start), labelled = run_together(find_start, label_components, threads=threads)
    return labelled, straight, start


def _count_solid_cells(field: SparseField, bits: NDArray[np.uint16]) -> int:
    """Count the solid cells of the grid; in the kept bricks, they are given by `bits`."""
    solid_bricks = np.argwhere(field.slots == SOLID_BRICK)
    return int(np.bitwise_count(bits).sum()) + int(brick_sides_on_grid(solid_bricks, field.shape).prod(axis=1).sum())


def component_volumes(
    field: SparseField, data: Components, *, spacing: tuple[float, ...], threads: int | None = None
) -> NDArray[np.float64]:
    """Measure the volume of each component of the data at level 0, (b,) mm³."""
    extracted = extract_level(field, spacing=spacing, threads=threads)
    surface_shells = label_shells(extracted.surface, extracted.rate, threads=threads)
    component, _ = _assign_components(surface_shells, extracted.surface, field, data, spacing)
    return _sums(component, surface_shells.volume, data.count)


def surface_at_level(
    field: SparseField, data: Components, *, spacing: tuple[float, ...], level: float, threads: int | None = None
) -> LevelSurface:
    """Extract the surface at one level; the paper's is at 0."""
    extracted = extract_level(field, spacing=spacing, level=level, threads=threads)
    return LevelSurface(
        field=field,
        height=level,
        surface=extracted.surface,
        rate=extracted.rate,
        signs=extracted.signs,
        common=level,
        levels=np.full(data.count, level),
        threads=threads,
    )


def surface_at_volume(
    field: SparseField,
    data: Components,
    *,
    spacing: tuple[float, ...],
    targets: NDArray[np.float64],
    start: LevelStart | None = None,
    threads: int | None = None,
) -> LevelSurface:
    """Extract the surface on which every component has the volume that it has in the data.

    Parameters
    ----------
    field : SparseField
    data : Components
        Components of solid in the data.
    spacing : (hx, hy, hz), mm
    targets : (b,) float64
        Volume of each component, mm³.
    start : LevelStart, optional
        Known volumes, from `prepare_levels`.

    Raises
    ------
    GeometryError
        If nothing is left above any level. Where no level gives the volume, the closest match is returned.
    """
    threads = thread_count(threads)
    total = float(targets.sum())
    start = start or LevelStart()
    at_zero = start.at_zero or measure_level(field, spacing=spacing, level=0.0, threads=threads)
    best = search_common_level(
        total, lambda level: try_level(field, level, spacing=spacing, threads=threads), at_zero, start.first
    )
    if data.count == 1:
        return LevelSurface(
            field=field,
            height=best.level,
            surface=best.found.surface,
            rate=best.found.rate,
            signs=best.found.signs,
            common=best.level,
            levels=np.array([best.level]),
            total=(best.volume, best.slope),
            threads=threads,
        )
    return _level_components(field, data, spacing=spacing, targets=targets, common=best.level, threads=threads)


def search_common_level(
    total: float,
    try_at: Callable[[float], Measured],
    at_zero: tuple[float, float] | None,
    first: Measured | None = None,
) -> Measured:
    """Search the level at which a surface encloses a volume, by Newton's method; return the best surface.

    Parameters
    ----------
    total : float, mm³
    try_at : callable
        Measures the surface at a level; raises GeometryError if nothing is left above it.
    at_zero : (float, float) or None
        Volume and slope at level 0, if they are known.
    first : MeasuredLevel or None
        The surface at the level that these suggest.

    Raises
    ------
    GeometryError
        If nothing is left above any level.
    """
    level = _next_level(0.0, *at_zero, total) if at_zero is not None and at_zero[1] < 0 else 0.0
    best: Measured | None = None
    for round_number in range(ROUNDS):
        try:
            trial = first if round_number == 0 else None
            trial = try_at(level) if trial is None else trial
        except GeometryError:
            level = (level - LIMIT) / 2  # nothing is left above this level
            if level < -LIMIT + 1e-3:
                break
            continue
        if best is None or abs(trial.volume - total) < abs(best.volume - total):
            best = trial
        if abs(trial.volume - total) <= TOLERANCE * total or trial.slope >= 0:
            break
        level = _next_level(trial.level, trial.volume, trial.slope, total)
    if best is None:
        raise GeometryError("nothing is left of the solid after smoothing, which is too thin for its voxels")
    return best


def _next_level(level: float, volume: float, slope: float, total: float) -> float:
    """Return the level of the right volume by a linear step of at most `BIGGEST_STEP`, within +-`LIMIT`."""
    change = min(max((total - volume) / slope, -BIGGEST_STEP), BIGGEST_STEP)
    return min(max(level + change, -LIMIT), LIMIT)


def _level_components(
    field: SparseField,
    data: Components,
    *,
    spacing: tuple[float, ...],
    targets: NDArray[np.float64],
    common: float,
    threads: int,
) -> LevelSurface:
    """Extract the surface on which every sufficiently large component has the right volume."""
    labels = label_field(field, data, threads)

    def try_levels(levels: NDArray[np.float64]) -> ComponentTrial[LevelSurface]:
        """Extract and measure the surface with these levels."""
        shifted = lower_to_levels(field, labels, levels, common, threads)
        extracted = extract_level(shifted, spacing=spacing, threads=threads)
        surface_shells = label_shells(extracted.surface, extracted.rate, threads=threads)
        shell_component, fused = _assign_components(surface_shells, extracted.surface, shifted, data, spacing)
        found = LevelSurface(
            field=shifted,
            height=0.0,
            surface=extracted.surface,
            rate=extracted.rate,
            signs=extracted.signs,
            common=common,
            levels=levels,
            threads=threads,
        )
        return ComponentTrial(
            component=shell_component,
            fused=fused,
            volume=surface_shells.volume,
            slope=surface_shells.slope,
            found=found,
        )

    return search_component_levels(data.cells, targets, common, try_levels)


def search_component_levels(
    cells: NDArray[np.int64],
    targets: NDArray[np.float64],
    common: float,
    try_levels: Callable[[NDArray[np.float64]], ComponentTrial[Found]],
) -> Found:
    """Search the levels at which every sufficiently large component has the right volume; return the best surface.

    Parameters
    ----------
    cells : (b,) int64
        Cells of each component.
    targets : (b,) float64
        Volume of each component, mm³.
    common : float
        The level of everything at first, and of what has none of its own.
    try_levels : callable
        Measures the surface with given levels (b,).
    """
    count = len(cells)
    has_level = cells >= SMALLEST
    group: NDArray[np.integer] = np.arange(count)  # components that fuse share a level from then on
    levels = np.full(count, common)
    low, high = np.full(count, -1.0), np.full(count, 1.0)  # levels known to be below and above the right one
    best: Found | None = None
    smallest_error = math.inf
    for _ in range(ROUNDS):
        trial = try_levels(levels)
        merged_group = _join_groups(group, trial.fused)
        changed = merged_group != group
        group = merged_group
        low, high = np.where(changed, -1.0, low), np.where(changed, 1.0, high)
        volume, slope = (
            _sums(group, _sums(trial.component, measure, count)) for measure in (trial.volume, trial.slope)
        )
        target = _sums(group, targets)
        error = np.abs(volume - target)
        heads = has_level & (group == np.arange(count))
        if best is None or error[heads].sum() < smallest_error:
            smallest_error = float(error[heads].sum())
            best = trial.found
        wrong = has_level & (error > COMPONENT_TOLERANCE * target)
        if not wrong.any():
            break
        low = np.where(wrong & (volume > target), levels, low)
        high = np.where(wrong & (volume < target), levels, high)
        with np.errstate(divide="ignore", invalid="ignore"):
            change = np.clip((target - volume) / slope, -BIGGEST_STEP, BIGGEST_STEP)
        stepped = levels + np.where(slope < 0, change, 0)
        stepped = np.where((slope < 0) & (stepped > low) & (stepped < high), stepped, (low + high) / 2)
        levels = np.where(wrong, np.clip(stepped, -1 + 1e-6, LIMIT), levels)[group]
    assert best is not None  # there is always a first round
    return best


def label_field(field: SparseField, data: Components, threads: int) -> NDArray[np.integer]:
    """Return the component nearest to every cell of the field's bricks, (bricks, cells); -1 for none."""
    kind = np.int16 if data.count <= np.iinfo(np.int16).max else np.int32
    labels = np.empty((len(field.where), CELLS), dtype=kind)
    in_threads(
        components_kernels.label_bricks,
        field.values.reshape(-1, CELLS),
        field.where,
        field.slots,
        data.bits,
        data.bricks,
        data.starts,
        data.alone,
        data.names,
        REACH,
        labels,
        threads=threads,
    )
    return labels


def lower_to_levels(
    field: SparseField, labels: NDArray[np.integer], levels: NDArray[np.float64], common: float, threads: int
) -> SparseField:
    """Subtract from the field the level of the nearest component: see `label_field`."""
    out = np.empty_like(field.values)
    in_threads(
        components_kernels.lower_to_levels,
        field.values.reshape(-1, CELLS),
        labels,
        levels.astype(np.float32),
        np.float32(common),
        out.reshape(-1, CELLS),
        threads=threads,
    )
    return replace(field, values=out)


def _sums(group: NDArray[np.integer], values: NDArray[np.float64], count: int | None = None) -> NDArray[np.float64]:
    """Sum the values in every group, ignoring group -1; with `count`, one sum per group, else one per member."""
    is_member = group >= 0
    sums = np.bincount(group[is_member], weights=values[is_member], minlength=count or len(values)).astype(np.float64)
    return sums if count is not None else sums[group]


def _join_groups(group: NDArray[np.integer], new_pairs: NDArray[np.integer]) -> NDArray[np.integer]:
    """Join groups by pairs (n, 2) of members; each group is named by its first member."""
    pairs = np.concatenate([new_pairs, np.stack([np.arange(len(group)), group], axis=1)])
    number, _ = label_connected(pairs[:, 0], pairs[:, 1], len(group))
    _, first_member = np.unique(number, return_index=True)
    merged: NDArray[np.integer] = first_member[number]
    return merged


def component_of_shells(levelled: LevelSurface, data: Components, *, spacing: tuple[float, ...]) -> NDArray[np.int64]:
    """Return for every shell of a surface the nearest component of the data; -1 for none."""
    return _assign_components(levelled.shells, levelled.surface, levelled.field, data, spacing)[0]


def nearest_components(points: NDArray[np.floating], field: SparseField, data: Components) -> NDArray[np.int32]:
    """Return the component nearest to points (N, 3), in cells from the lower corner of the grid; -1 if none is near."""
    place = np.floor(points + 1).astype(np.int32).clip(0, np.array(field.slots.shape) * BRICK - 1)
    label = np.empty(len(points), dtype=np.int32)
    components_kernels.label_cells(
        place, field.slots, data.bits, data.bricks, data.starts, data.alone, data.names, REACH, label
    )
    return label


def _assign_components(
    surface_shells: SurfaceShells, surface: Surface, field: SparseField, data: Components, spacing: tuple[float, ...]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return for every shell the component of the data nearest to most of its vertices, -1 for none.

    Also return pairs (n, 2) of components that are large enough for separate levels and share a shell.
    """
    label = nearest_components(surface.vertices / np.array(spacing), field, data)
    count = max(data.count, 1)
    has_label = label >= 0
    key, votes = np.unique(
        surface_shells.names[has_label].astype(np.int64) * count + label[has_label], return_counts=True
    )
    return elect_components(key, votes, len(surface_shells.volume), data.cells)


def elect_components(
    key: NDArray[np.int64], votes: NDArray[np.int64], shells: int, cells: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return for every shell the component with the most votes, -1 without any, and the pairs that share a shell.

    Parameters
    ----------
    key : (n,) int64, rising
        Shell times the number of components, plus the component.
    votes : (n,) int64
        Vertices of that shell nearest to that component.
    shells : int
    cells : (b,) int64
        Cells of each component.
    """
    shell, component = np.divmod(key, max(len(cells), 1))
    order = np.argsort(votes, kind="stable")  # the last write has the most votes
    nearest = np.full(shells, -1, dtype=np.int64)
    nearest[shell[order]] = component[order]
    contested = (nearest[shell] != component) & (cells[component] >= SMALLEST) & (votes >= SMALLEST)
    return nearest, np.stack([component[contested], nearest[shell[contested]]], axis=1)
