"""The cell and the width of a pattern that leave the requested density in a space."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from infill.lattices.bodies import Fields
from infill.lattices.grading import LocalWidths, densities_by_share
from infill.lattices.region_densities import CLOSE as REGION_CLOSE
from infill.lattices.region_densities import RegionSecant, measure_regions, sample_regions, widen_regions
from infill.lattices.request import Size, has_bars
from infill.lattices.root_finding import find_root
from infill.lattices.slabwise import count_filled_cells, defer_voids
from infill.lattices.surfacing import make_surfaces
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.lattices.voids import Layout, Periodic
from patterns.unit_cells import Network

CLOSE = 0.002  # of the density: a cell and a width nearer to it than this are good enough
LEAST = 1e-6  # densities below this count as none
TRIES, ROUNDS = 8, 9  # of the search before smoothing, and of that on meshes
TRIANGLES_A_CELL = 2.5  # for a cell within half a cell of the surface of a void, before simplifying
GRADING_STEPS, GRADING_ROUNDS, GRADING_CLOSE, MOST_OFF = 24, 4, 0.01, 0.5  # of a density that changes
REGION_ROUNDS = 6  # of widths in regions


def make_voids(task: FillTask, layout: Layout, known: Fields | None = None) -> tuple[VoidMeshes, Fields]:
    """Make the voids of a layout inside the walls; return them, and their fields for later drawings.

    In a large space that is kept in slabs, only their volume is computed for now.
    """
    fields = task.draw(replace(layout, space=task.space_for_voids(layout.space)), known)
    make = defer_voids if layout.space.layers.in_slabs else make_surfaces
    return make(task, fields), fields


def solid_share(fields: Fields) -> float:
    """Compute the solid share of the space inside the walls, as the pattern is drawn, before it is smoothed."""
    space = fields.layout.space
    if space.layers.in_slabs:
        filled = count_filled_cells(fields)
    else:
        depth, filled = space.depth, 0.0
        out = np.empty_like(depth)
        for which in range(fields.count):
            in_field = fields.write_sdf(out, which, depth)
            filled += in_field if space.opening is None else space.cells_in(out)
    return max(1 - filled / space.cells, LEAST)


def requested_density(task: FillTask, local: LocalWidths | None) -> float | None:
    """Return the density requested inside the walls, on average; None if cell and line width fix it."""
    return task.request.density if local is None else local.mean


def has_uniform_width(task: FillTask) -> bool:
    """Tell whether walls or bars have the same width everywhere, as all have except those of a network."""
    return not isinstance(task.request.kind, Network)


def find_sizes(
    task: FillTask, layout: Layout, varied: tuple[Size, ...]
) -> tuple[Layout, tuple[Size, ...], Fields | None]:
    """Find cell and width that leave the requested density before smoothing; return what may vary, and fields, too.

    A cell that is larger than the space is made smaller and walls thinner, if neither was requested; in a project,
    whose walls are to be lines of a slicer, only if the density cannot be reached otherwise.
    """
    fields: Fields | None = None
    if not varied:
        return layout, varied, fields
    request, density = task.request, requested_density(task, layout.local) or LEAST

    def log_error(layout: Layout) -> float:
        """Return the logarithm of the solid share of a layout over the density; keep its fields."""
        nonlocal fields
        fields = task.draw(layout, fields)
        return math.log(solid_share(fields) / density)

    def fit(start: Layout, vary: Size) -> Layout:
        """Scale one size of a layout until its solid share is the density."""
        return start.scale(
            find_root(lambda times: log_error(start.scale(times, vary)), CLOSE / 4 / density, TRIES), vary
        )

    if request.cell is None and request.line_width is None and layout.cell > (most := layout.space.second_longest_side):
        if request.form == "project":
            fitted = fit(layout, varied[0])
            if abs(log_error(fitted)) <= CLOSE / density:
                return fitted, varied, fields
        layout, varied = replace(layout, cell=most, width=layout.width * most / layout.cell), ("width",)
    return fit(layout, varied[0]), varied, fields


def estimate_triangles(task: FillTask, layout: Layout, known: Fields | None) -> tuple[float, Fields | None]:
    """Estimate the number of triangles of voids before they are simplified; return their fields too."""
    if not isinstance(task.pattern, Periodic):
        return 0, known
    fields, depth, crossed = task.draw(layout, known), layout.space.depth, 0
    out = np.empty_like(depth)
    for which in range(fields.count):
        fields.write_sdf(out, which, depth)
        crossed += sum(int((np.abs(layer) < 0.5).sum()) for layer in out)
    return TRIANGLES_A_CELL * crossed, fields


def fit_density(
    task: FillTask, layout: Layout, varied: tuple[Size, ...], fields: Fields | None
) -> tuple[VoidMeshes, Fields]:
    """Make voids whose meshes leave the requested density, as smoothing and the grid fill corners of voids."""
    hollow, fields = make_voids(task, layout, fields)
    if layout.local is not None and layout.local.regions is not None:
        return _match_region_densities(task, hollow, fields)
    if task.request.grading is not None:
        return _match_local_densities(task, hollow, fields)
    density = task.request.density or LEAST

    def log_error(hollow: VoidMeshes) -> float:
        """Return the logarithm of the density of voids over the requested one."""
        return math.log(max(hollow.density, LEAST) / density)

    def evaluate(times: float, start: Layout, vary: Size) -> float:
        """Make the voids of a scaled layout, keep the best, and return their error."""
        nonlocal hollow, fields
        candidate = hollow
        if times != 1:
            candidate, fields = make_voids(task, start.scale(times, vary), fields)
        hollow = min(hollow, candidate, key=lambda hollow: abs(log_error(hollow)))  # two are kept at most
        return log_error(candidate)

    for vary in varied:
        find_root(partial(evaluate, start=hollow.layout, vary=vary), CLOSE / density, ROUNDS)
    return hollow, fields


def _match_local_densities(task: FillTask, hollow: VoidMeshes, fields: Fields) -> tuple[VoidMeshes, Fields]:
    """Make voids whose meshes leave the density requested at every place."""
    power = 2 if has_bars(task.request.kind) else 1
    for _ in range(GRADING_ROUNDS):
        layout, local = hollow.layout, hollow.layout.local
        assert local is not None
        requested, measured = densities_by_share(
            layout.space, hollow.surface, local, GRADING_STEPS, mean=hollow.density
        )
        # Steps are thinner than cells of the pattern, so only the slope of the line through all of them counts; its
        # height follows from the density of the whole part.
        line = np.polynomial.Polynomial.fit(requested, np.log(requested / np.maximum(measured, LEAST)), 1)
        line += math.log(local.mean / max(hollow.density, LEAST)) - float(np.average(line(requested), weights=measured))
        if np.abs(line(requested)).max() < GRADING_CLOSE and abs(hollow.density / local.mean - 1) < GRADING_CLOSE:
            break
        factors = np.exp(np.clip(line(local.shares.astype(np.float64)), -MOST_OFF, MOST_OFF) / power)
        local = replace(local, ratio=(local.ratio * factors).astype(np.float32))
        hollow, fields = make_voids(task, replace(layout, local=local), fields)
    return hollow, fields


def _match_region_densities(task: FillTask, hollow: VoidMeshes, fields: Fields) -> tuple[VoidMeshes, Fields]:
    """Make voids whose meshes leave the density requested in every region; return the best that were tried."""
    local = hollow.layout.local
    assert local is not None
    assert local.regions is not None
    wanted, drawn = local.regions.wanted, local.regions.ratios
    sample = sample_regions(hollow.space, local.regions.regions)
    secant = RegionSecant(wanted=wanted, power=2 if has_bars(task.request.kind) else 1)
    best, least = hollow, math.inf
    for attempt in range(REGION_ROUNDS):
        measured = measure_regions(sample, hollow.space, hollow.surface, mean=hollow.density)
        worst = float(np.nanmax(np.abs(measured - wanted)))
        if worst < least:
            best, least = hollow, worst
        if worst < REGION_CLOSE or attempt == REGION_ROUNDS - 1:
            break
        assert local.regions is not None
        local = widen_regions(local, secant.step(local.regions.ratios, measured), drawn)
        hollow, fields = make_voids(task, replace(hollow.layout, local=local), fields)
    return best, fields
