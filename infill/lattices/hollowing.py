"""The voids of a part as closed surfaces: as dense as requested, smoothed, without pieces that are of no use."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.interior.hollow import VoidMeshes
from infill.interior.inside import SHARE
from infill.interior.interior import Interior, compute_interior
from infill.interior.root_finding import find_root
from infill.lattices.drawn_voids import Prismatic
from infill.lattices.local_density import densities_by_share
from infill.lattices.request import FillSpec, Size, has_bars
from infill.lattices.sizing import choose_sizes, choose_voxel, coarsest_voxel, enlarge, goes_by_slabs
from infill.lattices.slabwise import count_filled_cells, defer_voids
from infill.lattices.surfacing import choose_smoothing, drop_small_and_floating, make_surfaces, reachable_space
from infill.lattices.voids import Periodic, Voids, find_local_widths
from infill.machine import require_memory
from infill.meshes.shells import split_into_batches
from infill.meshes.simplification import simplify_surface
from infill.meshes.solids import simplify_solid
from infill.meshes.split_components import concatenate_surfaces
from infill.result import Clock
from infill.surface import Surface
from patterns.unit_cells import Network

CLOSE = 0.002  # of the density: a cell and a width nearer to it than this are good enough
LEAST = 1e-6  # densities below this count as none
TRIES, ROUNDS, REFITS = 8, 9, 3
WIDTH_CLOSE, REDRAWN = 0.03, 2  # of the line width: good enough; and how often walls are redrawn otherwise
SURE = 400  # points from which a median width is sure enough to redraw walls
MOST_LARGER = 3.0  # most that cells and walls grow at a time, where there are too many triangles
FEWER = 1.04  # margin on the size of cells, as triangles fall with its square
TRIANGLES_A_CELL, FAR_TOO_MANY = 2.5, 4.0  # of the room for them: with more, they are not even made
FARTHER_OFF = 0.005  # of the density: error that the right width of walls may not cost
FINEST, DOUBLINGS = 0.01, 4  # of a cell: where tolerances begin; how often they are doubled for fewer triangles
FIRST = 0.75  # of a tolerance, for the pieces of a surface that is made slab by slab; the rest is for all of it
AT_ONCE = 500_000  # triangles that are simplified at a time, if they are of several voids: this bounds memory
FEW_AT_ONCE = 30_000  # the same for voids made slab by slab, with few triangles from the beginning
COLLAPSE_BYTES = 4000  # for each triangle, at most
GRADING_STEPS, GRADING_ROUNDS, GRADING_CLOSE, MOST_OFF = 24, 4, 0.01, 0.5  # of a density that changes
LEAST_THICK = 1.5  # cells of the grid in the thickness of what lies inside the walls
FLAT = 0.01  # cells: the triangles of a void smaller than a cube of this side coincide


def make_void_meshes(
    part: Surface,
    request: FillSpec,
    voids: Voids,
    *,
    clock: Clock,
    threads: int | None = None,
    max_memory: int | None = None,
) -> tuple[VoidMeshes, Voids]:
    """Make the voids that a pattern leaves in a part, on a grid as fine as their triangles allow.

    If there are still too many triangles, and neither cell nor line width was requested, both are enlarged. Return also
    the pattern as it was drawn: where the density changes, with its local widths.

    Raises
    ------
    GeometryError
        If there is no room for a void, or for its triangles.
    MemoryLimitError
        If memory will not suffice.
    """
    extents = np.ptp(part.bounds, axis=0)
    with clock.stage("density", 0.0):
        sizes, varied = choose_sizes(request, voids, extents), request.varied
    voxel = choose_voxel(request, voids, extents, *sizes)
    is_last = False
    for attempt in range(REFITS + 1):
        progress, is_last = 0.2 * attempt, is_last or attempt == REFITS
        with clock.stage("depth", progress):
            space = compute_interior(
                part,
                wall=request.wall,
                voxel=voxel,
                open_=request.open_,
                beyond=request.beyond,
                held=request.held,
                slabs=goes_by_slabs(request, voids),
                threads=threads,
                max_memory=max_memory,
            )
        room = request.room(len(space.part.faces))
        with clock.stage("density", progress + 0.05):
            fit = DensityFit(space, voids, request, threads)
            sizes, varied = fit.find_sizes(sizes, varied)
            triangles = fit.estimate_triangles(sizes) if isinstance(voids, Periodic) else 0
        if is_last or triangles <= FAR_TOO_MANY * room:
            with clock.stage("voids", progress + 0.1):
                hollow = fit.make_voids(sizes, varied)
            with clock.stage("simplify", progress + 0.18):
                hollow = simplify_voids(hollow, request.tolerance)
            triangles = hollow.triangles
            if is_last or triangles <= room:
                with clock.stage("voids", progress + 0.19):
                    hollow = fit.match_width(hollow, sizes[1], varied)
                triangles = hollow.triangles
                if is_last or triangles <= room:
                    break
            sizes = (hollow.cell, sizes[1])
        new_sizes, coarser = _coarsen(request, voids, sizes, voxel, triangles / room)
        coarser = min(coarser, space.thickness / LEAST_THICK)
        is_last = coarser < 1.05 * voxel
        if not is_last:
            sizes, voxel = new_sizes, coarser
    if not hollow.surfaces:
        raise GeometryError(
            f"the pattern leaves no void inside walls of {request.wall:g} mm; give larger cells, narrower lines, a "
            "lower density or a thinner wall"
        )
    if hollow.triangles > room:
        with clock.stage("simplify", 0.8):
            hollow = _simplify_to_fit(hollow, room, threads=threads, max_memory=max_memory)
    return hollow, fit.voids


def has_uniform_width(voids: Voids) -> bool:
    """Tell whether walls or bars have the same width everywhere, as all have except those of a network."""
    return not (isinstance(voids, Periodic) and isinstance(voids.pattern, Network))


def _coarsen(
    request: FillSpec,
    voids: Voids,
    sizes: tuple[float, float],
    voxel: float,
    excess: float,
) -> tuple[tuple[float, float], float]:
    """Return sizes and voxel that leave a fraction of the triangles, as far as limits allow."""
    target, coarsest = voxel * max(1.1, FEWER * excess**0.5), coarsest_voxel(request, voids, *sizes)
    if target > coarsest and request.cell is None and request.line_width is None:
        sizes = enlarge(request, sizes, min(MOST_LARGER, max(1.2, target / coarsest)))
        coarsest = coarsest_voxel(request, voids, *sizes)
    return sizes, min(target, coarsest)


def simplify_voids(hollow: VoidMeshes, tolerance: float) -> VoidMeshes:
    """Simplify the voids: drop triangles that flat places do not need, and voids that this flattens."""
    budget, at_once = tolerance, AT_ONCE
    if hollow.unmade is not None:
        hollow, budget, at_once = hollow.unmade.made(FIRST * tolerance), (1 - FIRST) * tolerance, FEW_AT_ONCE
    if tolerance == 0:
        return hollow
    surfaces, results = hollow.surfaces[::-1], []
    hollow = replace(hollow, surfaces=[], tolerance=tolerance)
    while surfaces:  # popped, so that memory is freed as soon as possible
        simple = concatenate_surfaces(
            [simplify_solid(batch, SHARE * budget) for batch in split_into_batches(surfaces.pop(), at_once)]
        )
        results.append(drop_small_and_floating(simple, (FLAT * hollow.space.size) ** 3)[0])
    return replace(hollow, surfaces=[surface for surface in results if surface is not None])


def solid_share(space: Interior, voids: Voids, cell: float, width: float) -> float:
    """Return the solid share of the space inside the walls, as the pattern is drawn, before it is smoothed."""
    voids = voids.prepare(space, cell=cell, width=width)
    if space.layers.in_slabs and isinstance(voids, Prismatic):
        return max(1 - count_filled_cells(space, voids, cell=cell, width=width) / space.cells, LEAST)
    out = np.empty_like(space.depth)
    count = voids.count(space, cell=cell, width=width)
    filled = 0.0
    for which in range(count):
        in_field = voids.into(out, space, which, cell=cell, width=width)
        filled += in_field if space.opening is None else space.cells_in(out)
    return max(1 - filled / space.cells, LEAST)


def requested_density(request: FillSpec, space: Interior, voids: Voids) -> float | None:
    """Return the density requested inside the walls, on average; None if cell and line width fix it."""
    if request.grading is None:
        return request.density
    local = find_local_widths(voids, space)
    assert local is not None
    return local.mean


class DensityFit:
    """Finds cell and width for a density in one space.

    Attributes
    ----------
    voids : Voids
        The pattern as it was drawn last, with what that needs in the space: most changes of sizes need it again.
    """

    def __init__(self, space: Interior, voids: Voids, request: FillSpec, threads: int | None) -> None:
        local = find_local_widths(voids, space)
        self.space, self.request, self.threads = space, request, threads
        self.voids = voids if local is None else voids.with_widths(local)

    def find_sizes(
        self, sizes: tuple[float, float], varied: tuple[Size, ...]
    ) -> tuple[tuple[float, float], tuple[Size, ...]]:
        """Find cell and width, mm, that leave the requested density before smoothing; return what may vary too.

        A cell that is larger than the space is made smaller and walls thinner, if neither was requested; in a project,
        whose walls are to be lines of a slicer, only if the density cannot be reached otherwise.
        """
        if not varied:
            return sizes, varied
        request, density = self.request, requested_density(self.request, self.space, self.voids) or LEAST

        def off(at: float, sizes: tuple[float, float], vary: Size) -> float:
            return math.log(self._solid_share(_scale_sizes(sizes, at, vary)) / density)

        def fit(sizes: tuple[float, float], vary: Size) -> tuple[float, float]:
            times = find_root(lambda at: off(at, sizes, vary), CLOSE / 4 / density, TRIES)
            return _scale_sizes(sizes, times, vary)

        if request.cell is None and request.line_width is None and sizes[0] > (most := self.space.across):
            if request.form == "project":
                fitted = fit(sizes, varied[0])
                if abs(off(1.0, fitted, varied[0])) <= CLOSE / density:
                    return fitted, varied
            sizes, varied = (most, sizes[1] * most / sizes[0]), ("width",)
        return fit(sizes, varied[0]), varied

    def estimate_triangles(self, sizes: tuple[float, float]) -> float:
        """Estimate the number of triangles of the voids before they are simplified."""
        space, (cell, width) = self.space, sizes
        self.voids = self.voids.prepare(space, cell=cell, width=width)
        out = np.empty_like(space.depth)
        crossed = 0
        for which in range(self.voids.count(space, cell=cell, width=width)):
            self.voids.into(out, space, which, cell=cell, width=width)
            crossed += sum(int((np.abs(layer) < 0.5).sum()) for layer in out)
        return TRIANGLES_A_CELL * crossed

    def make_voids(self, sizes: tuple[float, float], varied: tuple[Size, ...]) -> VoidMeshes:
        """Make voids whose meshes leave the requested density, as smoothing and the grid fill corners of voids."""
        hollow = self._make_surfaces(sizes)
        if self.voids.grading is not None:
            return self._match_local_densities(hollow)
        for vary in varied:
            start = (hollow.cell, hollow.width)

            def make(times: float, start: tuple[float, float] = start, vary: Size = vary) -> VoidMeshes:
                return self._make_surfaces(_scale_sizes(start, times, vary))

            hollow = _closest_to_density(hollow, make, self.request.density or LEAST)
        return hollow

    def match_width(self, hollow: VoidMeshes, width: float, varied: tuple[Size, ...]) -> VoidMeshes:
        """Redraw voids until walls between them have the requested width, mm, unless the density fixes the width."""
        request = self.request
        if "width" in varied[:1] or self.voids.grading is not None or not has_uniform_width(self.voids):
            return hollow
        self._prepare((hollow.cell, width))
        if not choose_smoothing(self.space, self.voids, request, (hollow.cell, width)).steps:
            return hollow
        for _ in range(REDRAWN):
            median, seen = hollow.median
            if median is None or seen < SURE or abs(median / width - 1) <= WIDTH_CLOSE:
                break
            sizes = (hollow.cell, hollow.width * width / median)
            redrawn = simplify_voids(self.make_voids(sizes, varied), request.tolerance)
            if not redrawn.surfaces or abs(redrawn.density - (request.density or redrawn.density)) > FARTHER_OFF:
                break
            hollow = redrawn
        return hollow

    def _match_local_densities(self, hollow: VoidMeshes) -> VoidMeshes:
        """Make voids whose meshes leave the density requested at every place."""
        sizes, power = (hollow.cell, hollow.width), 2 if has_bars(self.request.kind) else 1
        for _ in range(GRADING_ROUNDS):
            local = find_local_widths(self.voids, self.space)
            assert local is not None
            requested, measured = densities_by_share(
                self.space, hollow.surface, local, GRADING_STEPS, mean=hollow.density
            )
            # Steps are thinner than cells of the pattern, so only the slope of the line through all of them counts; its
            # height follows from the density of the whole part.
            line = np.polynomial.Polynomial.fit(requested, np.log(requested / np.maximum(measured, LEAST)), 1)
            line += math.log(local.mean / max(hollow.density, LEAST)) - float(
                np.average(line(requested), weights=measured)
            )
            if np.abs(line(requested)).max() < GRADING_CLOSE and abs(hollow.density / local.mean - 1) < GRADING_CLOSE:
                break
            self.voids = self.voids.with_widths(local.widen(_width_factors(line, power)))
            hollow = self._make_surfaces(sizes)
        return hollow

    def _solid_share(self, sizes: tuple[float, float]) -> float:
        """Prepare the voids for a cell and a line width, keep them, and return the solid share."""
        cell, width = sizes
        self.voids = self.voids.prepare(self.space, cell=cell, width=width)
        return solid_share(self.space, self.voids, cell, width)

    def _prepare(self, sizes: tuple[float, float]) -> None:
        cell, width = sizes
        self.voids = self.voids.prepare(reachable_space(self.space, self.request), cell=cell, width=width)

    def _make_surfaces(self, sizes: tuple[float, float]) -> VoidMeshes:
        """Make the surfaces of the voids; if they are made slab by slab, compute only their volume for now."""
        self._prepare(sizes)
        if self.space.layers.in_slabs and isinstance(self.voids, Prismatic):
            return defer_voids(self.space, self.voids, self.request, sizes, threads=self.threads)
        return make_surfaces(self.space, self.voids, self.request, sizes, threads=self.threads)


def _closest_to_density(best: VoidMeshes, make: Callable[[float], VoidMeshes], density: float) -> VoidMeshes:
    """Return the candidate closest to a density, of the current voids and those that are made; two are kept at most."""

    def off(hollow: VoidMeshes) -> float:
        return math.log(max(hollow.density, LEAST) / density)

    def evaluate(times: float) -> float:
        nonlocal best
        candidate = best if times == 1 else make(times)
        best = min(best, candidate, key=lambda hollow: abs(off(hollow)))
        return off(candidate)

    find_root(evaluate, CLOSE / density, ROUNDS)
    return best


def _width_factors(line: np.polynomial.Polynomial, power: int) -> Callable[[NDArray[np.float32]], NDArray[np.floating]]:
    """Return a function from requested densities to factors of the width: exp(line(density) / power), within limits."""
    return lambda shares: np.exp(np.clip(line(shares.astype(np.float64)), -MOST_OFF, MOST_OFF) / power)


def _scale_sizes(sizes: tuple[float, float], times: float, vary: Size) -> tuple[float, float]:
    """Return cell and width for walls that are several times as dense."""
    cell, width = sizes
    return (cell, width * times) if vary == "width" else (cell / times, width)


def _simplify_to_fit(hollow: VoidMeshes, room: int, *, threads: int | None, max_memory: int | None) -> VoidMeshes:
    """Simplify the voids until few enough triangles remain, even beyond the requested tolerance."""
    tolerance = max(hollow.tolerance, FINEST * hollow.space.size)
    for _ in range(DOUBLINGS):
        tolerance *= 2
        simplified_hollow = simplify_voids(hollow, tolerance)
        if simplified_hollow.triangles <= room:
            return simplified_hollow
    needed = COLLAPSE_BYTES * max(len(surface.faces) for surface in simplified_hollow.surfaces)
    require_memory(needed, max_memory, f"the voids have {hollow.triangles:,} triangles; give larger cells or voxels")
    share = room / simplified_hollow.triangles
    fewest = [
        simplify_surface(surface, triangles=max(4, int(share * len(surface.faces))), threads=threads)
        for surface in simplified_hollow.surfaces
    ]
    return replace(hollow, surfaces=fewest, tolerance=math.inf)
