"""The voids of a part as closed surfaces: as dense as asked, smoothed, and none that is of no use."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.interior.hollow import Hollow
from infill.interior.inside import SHARE
from infill.interior.interior import Space, space_inside
from infill.interior.root_finding import root
from infill.lattices.drawn_voids import Drawn
from infill.lattices.grading import Grading
from infill.lattices.local_density import densities_by_share
from infill.lattices.request import Request, Size, barred
from infill.lattices.sizing import coarsest_for, goes_by_slabs, larger, sizes_for, voxel_for
from infill.lattices.slabwise import cells_filled, unmade
from infill.lattices.surfacing import smoothing_for, surfaces_of, useful
from infill.lattices.voids import Repeating, Voids
from infill.machine import require_memory
from infill.meshes.shells import in_batches
from infill.meshes.simplification import simplified
from infill.meshes.solids import shortened
from infill.meshes.split_components import joined
from infill.result import Clock
from infill.surface import Surface
from patterns.unit_cells import Network

CLOSE = 0.002  # of the density: nearer than this, no other cell or width is tried
LEAST = 1e-6  # densities below this are none
TRIES, ROUNDS, REFITS = 8, 9, 3
WIDTH_CLOSE, REDRAWN = 0.03, 2  # of the line width: nearer than this, walls are not drawn anew; how often they are
SURE = 400  # points at which a width is known well enough to draw walls anew
MOST_LARGER = 3.0  # than cells and walls were before, where there were too many triangles
FEWER = 1.04  # on top of what the triangles of a grid, as the inverse square of its cells, ask for
TRIANGLES_A_CELL, FAR_TOO_MANY = 2.5, 4.0  # of the room for them: then they are not even made
FARTHER_OFF = 0.005  # of the density: not for walls of the right width
FINEST, DOUBLINGS = 0.01, 4  # of a cell: where tolerances begin; how often they are doubled for fewer triangles
FIRST = 0.75  # of a tolerance, for the pieces of a surface that is made slab by slab; the rest is for all of it
AT_ONCE = 500_000  # triangles that are simplified at a time, if they are of several voids: so much less memory
FEW_AT_ONCE = 30_000  # of voids that were made slab by slab, with few triangles from the beginning
COLLAPSE_BYTES = 4000  # for each triangle, at most
GRADING_STEPS, GRADING_ROUNDS, GRADING_CLOSE, MOST_OFF = 24, 4, 0.01, 0.5  # of a density that changes
LEAST_THICK = 1.5  # cells of the grid in the thickness of what lies inside the walls
FLAT = 0.01  # cells: the triangles of a void smaller than a cube of this side lie on one another


def hollowed(
    part: Surface,
    request: Request,
    voids: Voids,
    *,
    clock: Clock,
    threads: int | None = None,
    max_memory: int | None = None,
) -> Hollow:
    """Return the voids that a pattern leaves in a part, on a grid as fine as their triangles allow.

    If there are too many still, and neither cell nor line width was asked for, both are larger.

    Raises
    ------
    GeometryError
        If there is no room for a void, or for its triangles.
    MemoryLimitError
        If memory will not suffice.
    """
    extents = np.ptp(part.bounds, axis=0)
    with clock.stage("density", 0.0):
        sizes, varied = sizes_for(request, voids, extents), request.varied
    voxel = voxel_for(request, voids, extents, *sizes)
    last = False
    for attempt in range(REFITS + 1):
        done, last = 0.2 * attempt, last or attempt == REFITS
        with clock.stage("depth", done):
            space = space_inside(
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
        with clock.stage("density", done + 0.05):
            sizes, varied = _sized(space, voids, request, sizes, varied)
            triangles = _about(space, voids, sizes) if isinstance(voids, Repeating) else 0
        if last or triangles <= FAR_TOO_MANY * room:
            with clock.stage("voids", done + 0.1):
                found = _corrected(space, voids, request, sizes, varied, threads)
            with clock.stage("simplify", done + 0.18):
                found = few_triangles(found, request.tolerance)
            triangles = found.triangles
            if last or triangles <= room:
                with clock.stage("voids", done + 0.19):
                    found = _as_wide(found, sizes[1], voids, request, varied, threads)
                triangles = found.triangles
                if last or triangles <= room:
                    break
            sizes = (found.cell, sizes[1])
        more, coarser = _coarser(request, voids, sizes, voxel, triangles / room)
        coarser = min(coarser, space.thickness / LEAST_THICK)
        last = coarser < 1.05 * voxel
        if not last:
            sizes, voxel = more, coarser
    if not found.surfaces:
        raise GeometryError(
            f"the pattern leaves no void inside walls of {request.wall:g} mm; give larger cells, narrower lines, a "
            "lower density or a thinner wall"
        )
    if found.triangles > room:
        with clock.stage("simplify", 0.8):
            found = _cut_down(found, room, threads=threads, max_memory=max_memory)
    return found


def _as_wide(
    found: Hollow, width: float, voids: Voids, request: Request, varied: tuple[Size, ...], threads: int | None
) -> Hollow:
    """Return voids between which walls are as wide as asked for, mm, or bars as thick, if not the density says that."""
    space = found.space
    if "width" in varied[:1] or voids.grading is not None or not even(voids):
        return found
    if not smoothing_for(space, voids, request, (found.cell, width)).steps:
        return found
    for _ in range(REDRAWN):
        median, seen = found.median
        if median is None or seen < SURE or abs(median / width - 1) <= WIDTH_CLOSE:
            break
        sizes = (found.cell, found.width * width / median)
        again = few_triangles(_corrected(space, voids, request, sizes, varied, threads), request.tolerance)
        if not again.surfaces or abs(again.density - (request.density or again.density)) > FARTHER_OFF:
            break
        found = again
    return found


def even(voids: Voids) -> bool:
    """Return whether walls are as wide everywhere, or bars as thick: those of a network are not."""
    return not (isinstance(voids, Repeating) and isinstance(voids.pattern, Network))


def _coarser(
    request: Request,
    voids: Voids,
    sizes: tuple[float, float],
    voxel: float,
    many: float,
) -> tuple[tuple[float, float], float]:
    """Return sizes and voxel with which there would be a fraction of the triangles, as far as that may be."""
    wanted, coarsest = voxel * max(1.1, FEWER * many**0.5), coarsest_for(request, voids, *sizes)
    if wanted > coarsest and request.cell is None and request.line_width is None:
        sizes = larger(request, sizes, min(MOST_LARGER, max(1.2, wanted / coarsest)))
        coarsest = coarsest_for(request, voids, *sizes)
    return sizes, min(wanted, coarsest)


def few_triangles(found: Hollow, tolerance: float) -> Hollow:
    """Return the voids without the triangles that flat places need not, and without voids that this flattens."""
    left, at_once = tolerance, AT_ONCE
    if found.unmade is not None:
        found, left, at_once = found.unmade.made(FIRST * tolerance), (1 - FIRST) * tolerance, FEW_AT_ONCE
    if tolerance == 0:
        return found
    every, kept = found.surfaces[::-1], []
    found = replace(found, surfaces=[], tolerance=tolerance)
    while every:  # those of before are not kept too, if nobody else has them
        few = joined([shortened(batch, SHARE * left) for batch in in_batches(every.pop(), at_once)])
        kept.append(useful(few, (FLAT * found.space.size) ** 3)[0])
    return replace(found, surfaces=[each for each in kept if each is not None])


def _about(space: Space, voids: Voids, sizes: tuple[float, float]) -> float:
    """Return about how many triangles the surfaces of the voids will have, before they are simplified."""
    cell, width = sizes
    out = np.empty_like(space.depth)
    crossed = 0
    for which in range(voids.count(space, cell=cell, width=width)):
        voids.into(out, space, which, cell=cell, width=width)
        crossed += sum(int((np.abs(layer) < 0.5).sum()) for layer in out)
    return TRIANGLES_A_CELL * crossed


def share_of_cells(space: Space, voids: Voids, cell: float, width: float) -> float:
    """Return the solid share of what lies inside the walls, as the pattern has it before it is smoothed."""
    if space.layers.in_slabs and isinstance(voids, Drawn):
        return max(1 - cells_filled(space, voids, cell=cell, width=width) / space.cells, LEAST)
    out = np.empty_like(space.depth)
    count = voids.count(space, cell=cell, width=width)
    filled = 0.0
    for which in range(count):
        all_ = voids.into(out, space, which, cell=cell, width=width)
        filled += all_ if space.opening is None else space.cells_in(out)
    return max(1 - filled / space.cells, LEAST)


def wanted(request: Request, space: Space, voids: Voids) -> float | None:
    """Return the density that is asked for inside the walls, on average; None if cell and line width say it."""
    if request.grading is None:
        return request.density
    return request.grading.over(space, voids.widths).mean


def _sized(
    space: Space, voids: Voids, request: Request, sizes: tuple[float, float], varied: tuple[Size, ...]
) -> tuple[tuple[float, float], tuple[Size, ...]]:
    """Return cell and width, mm, with which the voids leave the density asked for in this space, before smoothing.

    A cell that is larger than the space is made smaller, and walls thinner instead, if neither was asked for: in a
    project, whose walls are to be lines of a slicer, only if the density cannot be had otherwise. What may still be
    varied is returned too.
    """
    if not varied:
        return sizes, varied
    density = wanted(request, space, voids) or LEAST

    def off(at: float, sizes: tuple[float, float], vary: Size) -> float:
        return math.log(share_of_cells(space, voids, *_scaled(sizes, at, vary)) / density)

    def fitted(sizes: tuple[float, float], vary: Size) -> tuple[float, float]:
        times = root(lambda at: off(at, sizes, vary), CLOSE / 4 / density, TRIES)
        return _scaled(sizes, times, vary)

    if request.cell is None and request.line_width is None and sizes[0] > (most := space.across):
        if request.form == "project":
            found = fitted(sizes, varied[0])
            if abs(off(1.0, found, varied[0])) <= CLOSE / density:
                return found, varied
        sizes, varied = (most, sizes[1] * most / sizes[0]), ("width",)
    return fitted(sizes, varied[0]), varied


def _corrected(
    space: Space,
    voids: Voids,
    request: Request,
    sizes: tuple[float, float],
    varied: tuple[Size, ...],
    threads: int | None,
) -> Hollow:
    """Return voids whose meshes leave the density asked for: smoothing and the grid fill corners of voids."""
    found = _surfaces(space, voids, request, sizes, threads)
    if voids.grading is not None:
        return _graded(found, voids, voids.grading, request, threads)
    for vary in varied:
        start = (found.cell, found.width)

        def made(times: float, start: tuple[float, float] = start, vary: Size = vary) -> Hollow:
            return _surfaces(space, voids, request, _scaled(start, times, vary), threads)

        found = _nearest(found, made, request.density or LEAST)
    return found


def _surfaces(space: Space, voids: Voids, request: Request, sizes: tuple[float, float], threads: int | None) -> Hollow:
    """Return the surfaces of the voids, or if they are made slab by slab, for now only what they enclose."""
    if space.layers.in_slabs and isinstance(voids, Drawn):
        return unmade(space, voids, request, sizes, threads=threads)
    return surfaces_of(space, voids, request, sizes, threads=threads)


def _nearest(found: Hollow, made: Callable[[float], Hollow], density: float) -> Hollow:
    """Return what comes nearest to a density, of what was found and what is made; two at most are kept meanwhile."""

    def off(hollow: Hollow) -> float:
        return math.log(max(hollow.density, LEAST) / density)

    def tried(times: float) -> float:
        nonlocal found
        now = found if times == 1 else made(times)
        found = min(found, now, key=lambda each: abs(off(each)))
        return off(now)

    root(tried, CLOSE / density, ROUNDS)
    return found


def _graded(found: Hollow, voids: Voids, grading: Grading, request: Request, threads: int | None) -> Hollow:
    """Return voids whose meshes leave everywhere the density asked for there."""
    space, sizes = found.space, (found.cell, found.width)
    power = 2 if barred(request.kind) else 1
    for _ in range(GRADING_ROUNDS):
        local = grading.over(space, voids.widths)
        asked, there = densities_by_share(space, found.surface, local, GRADING_STEPS, mean=found.density)
        # Steps are thinner than cells of the pattern, so only the slope of the line through all of them counts; where
        # it lies, the density of the whole says.
        line = np.polynomial.Polynomial.fit(asked, np.log(asked / np.maximum(there, LEAST)), 1)
        line += math.log(local.mean / max(found.density, LEAST)) - float(np.average(line(asked), weights=there))
        if np.abs(line(asked)).max() < GRADING_CLOSE and abs(found.density / local.mean - 1) < GRADING_CLOSE:
            break
        grading.correct(_factors(line, power))
        found = _surfaces(space, voids, request, sizes, threads)
    return found


def _factors(line: np.polynomial.Polynomial, power: int) -> Callable[[NDArray[np.float32]], NDArray[np.floating]]:
    """Return by how much walls are to be wider where a density is asked for, if it is off by a line, in logarithms."""
    return lambda shares: np.exp(np.clip(line(shares.astype(np.float64)), -MOST_OFF, MOST_OFF) / power)


def _scaled(sizes: tuple[float, float], times: float, vary: Size) -> tuple[float, float]:
    """Return cell and width with walls that many times as dense."""
    cell, width = sizes
    return (cell, width * times) if vary == "width" else (cell / times, width)


def _cut_down(found: Hollow, room: int, *, threads: int | None, max_memory: int | None) -> Hollow:
    """Return the voids with so few triangles, further from what they were than was asked for."""
    tolerance = max(found.tolerance, FINEST * found.space.size)
    for _ in range(DOUBLINGS):
        tolerance *= 2
        few = few_triangles(found, tolerance)
        if few.triangles <= room:
            return few
    needed = COLLAPSE_BYTES * max(len(each.faces) for each in few.surfaces)
    require_memory(needed, max_memory, f"the voids have {found.triangles:,} triangles; give larger cells or voxels")
    share = room / few.triangles
    fewest = [
        simplified(each, triangles=max(4, int(share * len(each.faces))), threads=threads) for each in few.surfaces
    ]
    return replace(found, surfaces=fewest, tolerance=math.inf)
