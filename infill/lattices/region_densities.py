"""The density of each region on the meshes of the voids, and the widths of walls that make it what was requested."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior
from infill.lattices.field_place import LEAST_SHARE
from infill.lattices.grading import LocalWidths, interpolate_nodes
from infill.lattices.region_nodes import SHIFTS, PlacedRegion, label_regions
from infill.lattices.region_solids import make_region_solid
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.solids import to_manifold
from infill.surface import Surface
from infill.voxels.scanlines import fill_rows, intersect_rows

POINTS = 50_000  # in each region and grid: a density of a half has an error of 0.11 points by chance, or less
CLOSE = 0.002  # density
LEAST = 1e-6
GENTLE, STEEP, LONGEST = 0.2, 5.0, 0.5  # slopes that a secant may have, and its longest step, in logarithms
MOST = 1.5  # of the width that the pattern has far from any skin, in logarithms


@dataclass(frozen=True, kw_only=True, eq=False)
class RegionSample:
    """Points inside the walls, on grids that are shifted by parts of a cell: see `densities_by_share`.

    Parameters
    ----------
    cells : tuple of (N, 3) int64
        The cells of each grid.
    groups : tuple of (N,) int64
        The region of each point.
    volumes : (R,) float64
        The volume of each region inside the walls, mm³.
    shape : (nx, ny, nz)
    """

    cells: tuple[NDArray[np.int64], ...]
    groups: tuple[NDArray[np.int64], ...]
    volumes: Floats
    shape: tuple[int, ...]


def sample_regions(space: Interior, regions: Sequence[PlacedRegion]) -> RegionSample:
    """Draw points of the rest and of each region: in all of its cells, or in as many as suffice."""
    depth, count, rng = space.depth, 1 + len(regions), np.random.default_rng(0)
    is_near = (depth > -1) & (space.layer_shares >= LEAST_SHARE)  # at most a cell outside the walls
    x, y, z = (np.arange(cells, dtype=np.uint8) for cells in depth.shape)
    turn = (x[:, None, None] + y[:, None] + z) % len(SHIFTS)  # each cell has a point in one of the grids
    drawn, groups, volumes = [], [], np.zeros(count)
    for number, shift in enumerate(SHIFTS):
        labels = np.where(is_near & (turn == number), label_regions(regions, space, shift), np.int16(-1))
        chosen = [np.argwhere(labels == region) for region in range(count)]
        most = [
            cells if len(cells) <= POINTS else cells[rng.choice(len(cells), POINTS, replace=False)] for cells in chosen
        ]
        is_inside = [interpolate_nodes(depth, cells + np.array(shift)) > 0 for cells in most]
        drawn.append(np.concatenate([cells[inside] for cells, inside in zip(most, is_inside, strict=True)]))
        groups.append(np.repeat(np.arange(count), [int(inside.sum()) for inside in is_inside]))
        volumes += [
            len(cells) * inside.mean() if len(cells) else 0 for cells, inside in zip(chosen, is_inside, strict=True)
        ]
    return RegionSample(cells=tuple(drawn), groups=tuple(groups), volumes=space.size**3 * volumes, shape=depth.shape)


def measure_regions(sample: RegionSample, space: Interior, voids: Surface, *, mean: float) -> Floats:
    """Measure the solid share of each region, (R,); nan where there are no points.

    Voids are scaled so that the density of the whole part is `mean`, which removes the chance that remains.
    """
    corners = (np.asarray(voids.vertices, dtype=np.float64) - space.origin) / space.size
    points, void_points = np.zeros((2, len(sample.volumes)))
    for shift, cells, groups in zip(SHIFTS, sample.cells, sample.groups, strict=True):
        void = fill_rows(intersect_rows(corners - shift, voids.faces, sample.shape), sample.shape)
        points += np.bincount(groups, minlength=len(points))
        void_points += np.bincount(groups, weights=void[tuple(cells.T)], minlength=len(points))
    shares = np.divide(void_points, points, out=np.full(len(points), np.nan), where=points > 0)
    total = float(np.nansum(shares * sample.volumes) / sample.volumes.sum())
    densities: Floats = 1 - shares * (1 - mean) / max(total, LEAST)
    return densities


def measure_joined_regions(hollow: VoidMeshes, regions: Sequence[PlacedRegion], volumes: Floats) -> Floats:
    """Measure the solid share of the rest and of each region, (R + 1,), from the exact volumes of the voids in them.

    Parameters
    ----------
    hollow : VoidMeshes
    regions : sequence of PlacedRegion
        Later ones lie over earlier ones.
    volumes : (R + 1,) float64
        Of the rest and the regions inside the walls, mm³; where there is none, the share is nan.
    """
    voids, bounds = to_manifold(hollow.surface), np.asarray(hollow.space.part.bounds, dtype=np.float64)
    opening = hollow.space.opening
    if hollow.walls is not None:
        voids ^= to_manifold(hollow.walls)
    if opening is not None and math.isfinite(opening.low):
        voids = voids.trim_by_plane((0.0, 0.0, 1.0), opening.low)
    if opening is not None and math.isfinite(opening.high):
        voids = voids.trim_by_plane((0.0, 0.0, -1.0), -opening.high)
    in_regions = []
    for region in reversed(regions):
        inside, voids = voids.split(make_region_solid(region, bounds))
        in_regions.append(inside.volume())
    void_volumes = np.array([voids.volume(), *reversed(in_regions)])
    rooms = volumes * (hollow.room_volume / volumes.sum())
    densities: Floats = 1 - np.divide(void_volumes, rooms, out=np.full(len(rooms), np.nan), where=volumes > 0)
    return densities


@dataclass(kw_only=True, eq=False)
class RegionSecant:
    """Steps of a secant for the width of walls in each region, all at once.

    Parameters
    ----------
    wanted : (R,) float64
        Requested densities; nan where they do not matter.
    power : int
        Of the width, to which the density is roughly proportional.
    """

    wanted: Floats
    power: int
    tried: tuple[Floats, Floats] | None = None

    def step(self, ratios: Floats, measured: Floats) -> Floats:
        """Return the next widths (R,) from the present ones and the measured densities."""
        logarithm = np.log(ratios)
        error = np.log(np.maximum(measured, LEAST) / self.wanted)
        error[np.isnan(error)] = 0
        slope = np.full(len(ratios), float(self.power))
        if self.tried is not None:
            run = logarithm - self.tried[0]
            rise = error - self.tried[1]
            secant = np.divide(rise, run, out=slope.copy(), where=np.abs(run) > LEAST)
            slope = np.where((secant > GENTLE) & (secant < STEEP), secant, slope)
        self.tried = logarithm, error
        stepped: Floats = np.exp(logarithm - np.clip(error / slope, -LONGEST, LONGEST))
        return stepped


def widen_regions(local: LocalWidths, ratios: Floats, drawn: Floats) -> LocalWidths:
    """Return the same regions with other widths (R,), no further from those of the pattern as drawn than is sound."""
    assert local.regions is not None
    bounded = np.clip(ratios, drawn * np.exp(-MOST), drawn * np.exp(MOST))
    regions = replace(local.regions, ratios=bounded)
    return replace(local, ratio=regions.paint(bounded), regions=regions)
