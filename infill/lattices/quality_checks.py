"""The ways in which a filled part differs from its request, measured on the final meshes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.drawings.tiled import Tiled
from infill.interior.interior import LEAST_OVERLAP
from infill.interior.narrow import NARROW, NarrowShares
from infill.interior.opening import Opening
from infill.isosurfaces.components import count_bodies, shell_names
from infill.lattices.bodies import Fields
from infill.lattices.density_search import has_uniform_width, requested_density, solid_share
from infill.lattices.drain_holes import DrainedSolid, drain_problems, find_closed_voids
from infill.lattices.grading import LocalWidths, densities_by_share
from infill.lattices.placed_regions import RegionDensities
from infill.lattices.region_densities import measure_joined_regions, measure_regions, sample_regions
from infill.lattices.region_nodes import REST, boxes_overlap
from infill.lattices.request import DENSITY, GAP, LINE_WIDTH, FillSpec
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.distance import TriangleTree
from infill.meshes.shells import first_vertex_of_shells, split_into_batches
from infill.meshes.solids import FINE, coincident_vertices, manifold_status
from infill.meshes.winding import winding_numbers
from infill.plain_numbers import count_noun, plain_argument, plain_place
from infill.surface import Surface
from patterns.lightning import Lightning

if TYPE_CHECKING:
    from infill.reports.filling import FillRegion, GradedStep

OFF = 0.005  # of the density: larger errors are reported
OFF_LOCAL = 0.03  # of the density in a step: chance alone causes an error of 0.01, in three of a thousand
OFF_WIDTH = 0.06  # of the line width: larger errors are reported
LEAST_WIDTH = 0.8  # of the line width, where cells follow the density: narrower walls are reported
STEPS = 3  # of a density that changes
LEAST_LEFT = 0.75  # of the pattern as drawn: fillets only add to it
THINNEST = 0.4  # mm: a nozzle
THIN = 0.8  # mm: two lines of a nozzle of 0.4
HAIRLINE = 0.2  # mm: the thinnest walls that printers with resin and powder are sure to make
USUAL = 2.0  # times the default density, or as many times less: a density outside was hardly wanted
AT_ONCE = 50_000  # triangles or points in a batch
MOST_POINTS = 100_000  # at which the walls of regions are measured
LEAST_WALL = 0.9  # of the requested wall


def measure_least_wall(
    part: Surface, voids: Sequence[Surface], threads: int | None, opening: Opening | None = None
) -> tuple[float, list[float]]:
    """Measure the least distance of the voids from the skin, mm, at corners and centres of triangles; return its place.

    Points beyond an open side do not count.
    """
    if opening is not None:
        part = opening.shell
    tree, least, place = TriangleTree.of(part), np.inf, np.full(3, np.nan)
    for points in chain.from_iterable(map(_point_batches, voids)):
        if opening is not None:
            points = points[opening.inside(points[:, 2])]
        least, number = tree.least_distance(points, least, threads=threads)
        if number >= 0:
            place = points[number]
    return least, place.tolist()


def _point_batches(surface: Surface) -> Iterator[NDArray[np.float64]]:
    """Yield the corners of a surface, (N, 3), and the centres of its triangles, in batches."""
    corners, faces = np.asarray(surface.vertices, dtype=np.float64), surface.faces
    for begin in range(0, len(corners), AT_ONCE):
        yield corners[begin : begin + AT_ONCE]
    for begin in range(0, len(faces), AT_ONCE):
        yield corners[faces[begin : begin + AT_ONCE]].mean(axis=1)


def count_outside(part: Surface, voids: Sequence[Surface], threads: int | None, middle: float | None = None) -> int:
    """Count the voids outside the part, as no void crosses its skin.

    Where a part is open, the points nearest to a height in its middle, mm, decide.
    """
    points = [_point_of_shells(surface, middle) for surface in voids]
    return int((winding_numbers(np.concatenate(points).astype(np.float64), part, threads=threads) <= 0).sum())


def _point_of_shells(surface: Surface, middle: float | None) -> NDArray[np.float64]:
    """Return a point of every component, (N, 3): its first vertex, or the point of its edges nearest to a height."""
    vertices = np.asarray(surface.vertices, dtype=np.float64)
    if middle is None:
        return vertices[first_vertex_of_shells(surface)]
    names, count = shell_names(surface)
    edges = np.concatenate([surface.faces[:, [i, (i + 1) % 3]] for i in range(3)])
    start, end = vertices[edges[:, 0]], vertices[edges[:, 1]]
    rise = end[:, 2] - start[:, 2]
    share = np.clip(np.divide(middle - start[:, 2], rise, out=np.zeros_like(rise), where=rise != 0), 0, 1)
    points = start + share[:, None] * (end - start)
    name = names[edges[:, 0]]
    order = np.lexsort((np.abs(points[:, 2] - middle), name))
    nearest: NDArray[np.float64] = points[order[np.searchsorted(name[order], np.arange(count))]]
    return nearest


@dataclass(frozen=True, kw_only=True)
class SolidMeasures:
    """Measurements of the final solid.

    Parameters
    ----------
    least : float or None
        Thickness of the wall, mm; None if a slicer makes the walls.
    at : list of float or None
        Its place, mm.
    astray : int
        Voids outside of the part.
    closed : list of (float, list of float)
        Voids without a drain: see `find_closed_voids`.
    loose : int
        Without a shell: bodies of infill that touch nothing, besides one for each body of the part.
    crowded : int
        Vertices that coincide with another one in single precision, not counting those of the skin.
    verdict : str
        Of manifold3d.
    width : float
        Of walls or bars in the mesh, mm; as drawn if it varies, or if hardly any are far from the walls of the part.
    drawn : float
        Density of the pattern before it was smoothed.
    wanted : float or None
        Requested density, on average.
    graded : list of dict
        Of a density that changes: requested and measured density, in steps.
    regions : list of dict
        Of regions: requested and measured density of each.
    cells, widths : list of float or None
        Of a density that changes: the smallest and the largest cell, as cubes of their volume, and the narrowest and
        the widest walls, mm.
    """

    least: float | None
    at: list[float] | None
    astray: int
    closed: list[tuple[float, list[float]]]
    loose: int
    crowded: int
    verdict: str
    width: float
    drawn: float
    wanted: float | None
    graded: list[GradedStep]
    regions: list[FillRegion]
    cells: list[float] | None = None
    widths: list[float] | None = None


def measure_solid(
    task: FillTask, solid: Surface, outer: Surface, hollow: VoidMeshes, fields: Fields | None, drained: DrainedSolid
) -> SolidMeasures:
    """Measure a solid with an outer surface, voids and drains."""
    request, space, local = task.request, hollow.space, hollow.layout.local
    least: float | None = None
    place: list[float] | None = None
    astray, crowded = 0, int(coincident_vertices(solid).sum())
    if not request.reaches_skin:
        part, opening = space.part, space.opening
        middle = None if opening is None else float(part.bounds[:, 2].mean())
        least, place = measure_least_wall(part, hollow.surfaces, task.threads, opening)
        for hole in drained.plan.holes:
            if hole.clearance < least:
                least, place = hole.clearance, hole.near.tolist()
        astray = count_outside(part, hollow.surfaces, task.threads, middle)
        crowded -= int(coincident_vertices(outer).sum())
    return SolidMeasures(
        least=least,
        at=place,
        astray=astray,
        closed=find_closed_voids(solid) if request.form == "solid" else [],
        loose=max(0, count_bodies(solid) - count_bodies(space.part)) if request.wall == 0 else 0,
        crowded=max(0, crowded),
        verdict=next((word for word in map(manifold_status, split_into_batches(solid, AT_ONCE)) if word != FINE), FINE),
        width=(hollow.median_width[0] if has_uniform_width(task) and not request.has_areas else None) or hollow.width,
        drawn=0.0 if request.has_areas else solid_share(task.draw(hollow.layout, fields)),
        wanted=requested_density(task, local),
        graded=[] if local is None or local.regions is not None else density_steps(hollow, local),
        regions=region_facts(task, hollow) if request.regions else [],
        cells=None if local is None else [hollow.cell * factor for factor in local.cells],
        widths=None if local is None else [hollow.width * factor for factor in local.widths],
    )


def density_steps(hollow: VoidMeshes, local: LocalWidths) -> list[GradedStep]:
    """Group places by requested density; return the requested and the measured density of each group, rising."""
    requested, actual = densities_by_share(hollow.space, hollow.surface, local, STEPS, mean=hollow.density)
    pairs = zip(requested.tolist(), actual.tolist(), strict=True)
    return [{"wanted": target, "density": density} for target, density in pairs]


def region_facts(task: FillTask, hollow: VoidMeshes) -> list[FillRegion]:
    """Return the requested and the actual settings of the rest and of each region, and their volumes, mm³."""
    request, regions = task.request, task.request.regions
    sample = sample_regions(hollow.space, regions)
    measured = (
        measure_joined_regions(hollow, regions, sample.volumes)
        if request.has_areas
        else measure_regions(sample, hollow.space, hollow.surface, mean=hollow.density)
    ).tolist()
    facts: list[FillRegion] = []
    walls = measure_region_walls(task, hollow) if len(request.walls) > 1 else [None] * len(measured)
    for number, (density, volume) in enumerate(zip(measured, sample.volumes.tolist(), strict=True)):
        region = regions[number - 1] if number else None
        facts.append(
            {
                "place": REST if region is None else region.place,
                "pattern": _pattern_at(request, number),
                "wanted": _density_at(request, number),
                "density": density if volume > 0 else None,
                "volume": volume,
                "wall": _wall_at(request, number),
                "least": walls[number],
            }
        )
    return facts


def _density_at(request: FillSpec, number: int) -> float | None:
    """Return the requested density in a region, 0 for the rest; None if none is requested there, or several are."""
    base = request.grading.base if isinstance(request.grading, RegionDensities) else None
    if number == 0:
        return base
    region = request.regions[number - 1]
    if isinstance(region.kind, Lightning):
        return None  # its branches follow roofs
    if region.density is not None or region.kind is None:
        return region.density
    return None if _lies_over(request, number, "density") else base


def _wall_at(request: FillSpec, number: int) -> float | None:
    """Return the requested wall in a region, 0 for the rest, mm; None if it has several."""
    own = request.regions[number - 1].wall if number else request.wall
    return own if own is not None or _lies_over(request, number, "wall") else request.wall


def _pattern_at(request: FillSpec, number: int) -> str | None:
    """Return the name of the pattern in a region, 0 for the rest; None if it has several."""
    if number and request.regions[number - 1].kind is not None:
        return request.regions[number - 1].pattern
    return None if _lies_over(request, number, "kind") else request.pattern


def _lies_over(request: FillSpec, number: int, setting: str) -> bool:
    """Tell whether a region lies over another one that has a setting; the rest, 0, does not."""
    if number == 0:
        return False
    *below, region = request.regions[:number]
    return any(getattr(other, setting) is not None and boxes_overlap(region, other) for other in below)


def measure_region_walls(task: FillTask, hollow: VoidMeshes) -> list[float | None]:
    """Measure the least distance of voids from the skin in the rest and in each region, mm; None without voids there.

    Points within a cell of the grid of any border do not count, nor do those beyond an open side. Of very many points,
    only every n-th is measured; the least wall of the whole part is that of all.
    """
    space, regions = hollow.space, task.request.regions
    bounds = np.asarray(space.part.bounds, dtype=np.float64)
    tree = TriangleTree.of(space.part if space.opening is None else space.opening.shell)
    if not hollow.surfaces:
        return [None] * (1 + len(regions))
    count = sum(len(surface.vertices) + len(surface.faces) for surface in hollow.surfaces)
    stride = max(1, count // MOST_POINTS)
    points = np.concatenate([batch[::stride] for batch in chain.from_iterable(map(_point_batches, hollow.surfaces))])
    if space.opening is not None:
        points = points[space.opening.inside(points[:, 2])]
    number, is_near = np.zeros(len(points), dtype=int), np.zeros(len(points), dtype=bool)
    for order, region in enumerate(regions, 1):
        depths = region.depths_at(points, bounds, near=space.size, threads=task.threads)
        number[depths > 0] = order
        is_near |= np.abs(depths) < space.size
    distances, _ = tree.nearest(points[~is_near], threads=task.threads)
    least = np.full(1 + len(regions), np.inf)
    np.minimum.at(least, number[~is_near], distances)
    return [wall if np.isfinite(wall) else None for wall in least.tolist()]


def is_width_ok(width: float, requested: float) -> bool:
    """Tell whether the width of walls or bars is nearly the requested one, neither less nor more."""
    return abs(width / requested - 1) <= OFF_WIDTH


def size_problems(request: FillSpec, hollow: VoidMeshes) -> Iterator[str]:
    """Yield a message for a requested cell that is too large for the part, or that alone decides the density."""
    room, cell = hollow.space.second_longest_side, request.cell
    if cell is None:
        return
    if cell >= room:
        yield (
            f"cells of {plain_argument(cell)} mm are as large as the inside of the part, {plain_argument(room, 3)} mm "
            "across, so that little of the pattern lies in it; give cells of "
            f"{plain_argument(room / 3, 2)} mm or less"
        )
    elif request.cell_alone and not DENSITY / USUAL <= hollow.density <= DENSITY * USUAL:
        yield (
            f"cells of {plain_argument(cell)} mm with walls of {plain_argument(hollow.width, 3)} mm leave a density of "
            f"{hollow.density:.1%}, and not {DENSITY:.0%}, the default without a cell; give a density beside the cell "
            "for wider walls"
        )


def slicer_problems(request: FillSpec, hollow: VoidMeshes, width: float, lost: NarrowShares | None) -> Iterator[str]:
    """Yield a message for what slicers leave out of the infill of a project, with walls or bars of a width, mm."""
    if request.form == "project" and width < THINNEST:
        yield (
            f"walls or bars inside are {plain_argument(width, 2)} mm wide, less than a line of a usual nozzle: "
            "slicers leave most of them out; give a line width of 0.9 mm, or print so small a part solid"
        )
    elif request.form == "project" and width < THIN:
        yield (
            f"walls or bars inside are {plain_argument(width, 2)} mm wide, less than two lines of a usual "
            "nozzle: slicers fill such bodies in many short moves, and extrude up to a tenth more or less; give a "
            "line width of 0.9 mm"
        )
    elif request.gaps_in(width):
        yield (
            f"walls inside are {plain_argument(width, 2)} mm wide, more than two lines of a usual nozzle and "
            "less than three: slicers leave gaps in them, 7 % of the infill in all; give a line width of 0.9 mm, or "
            f"{plain_argument(GAP[1])} or more"
        )
    if lost is not None and lost.all > NARROW:
        effect = ", so that was left out" if hollow.loose else ""
        yield (
            f"{lost.all:.0%} of the infill lies where walls of {plain_argument(request.wall)} mm leave less room than "
            f"a line of {plain_argument(LINE_WIDTH)} mm, or is itself as narrow there, and slicers print none of "
            f"it{effect}; shift the pattern by --phase, print with fewer perimeters and give their --wall, or with so "
            "many that they fill such places"
        )


def _remedy_for_worn_lines(request: FillSpec, width: float) -> str:
    """Say how lines of a width, mm, of which much was lost stay."""
    if request.is_block:
        return "give wider lines or a higher density"
    fine = plain_argument(width / 4, 2)
    voxels = f" and voxels of {fine} mm" if request.voxel is not None and request.voxel > width / 3 else ""
    return f"give a smooth radius of {fine} mm{voxels}, or wider lines"


def find_problems(
    request: FillSpec, hollow: VoidMeshes, facts: SolidMeasures, drained: DrainedSolid, lost: NarrowShares | None = None
) -> Iterator[str]:
    """Yield a message for everything that differs from the request, and for every change to the part."""
    overlap, moved, opening = hollow.space.overlap, hollow.tolerance, hollow.space.opening
    if (
        facts.wanted is not None
        and not isinstance(request.grading, RegionDensities)
        and not abs(hollow.density - facts.wanted) <= OFF
    ):  # nan too
        yield f"the density is {hollow.density:.1%}, and {facts.wanted:.1%} was asked for"
    for step in facts.graded:
        if not abs(step["density"] - step["wanted"]) <= OFF_LOCAL:
            yield (
                f"where {step['wanted']:.1%} was asked for, the density is {step['density']:.1%}; smaller cells follow "
                "the field better"
            )
    for region in facts.regions:
        place, density = region["place"], region["density"]
        if density is None:
            if place != REST:
                yield f"nothing is left of the region {place}: later regions or walls cover it"
        elif region["wanted"] is not None and not abs(density - region["wanted"]) <= OFF:
            yield (
                f"in the region {place}, the density is {density:.1%}, and {region['wanted']:.1%} was asked for; "
                "smaller cells follow regions better"
            )
    for region in facts.regions:
        if region["wall"] and region["least"] is not None and region["least"] < LEAST_WALL * region["wall"]:
            yield (
                f"in the region {region['place']}, the wall is {plain_argument(region['least'], 3)} mm thin, and "
                f"{plain_argument(region['wall'])} mm was asked for"
            )
    for place in hollow.divided:
        yield (
            f"a wall divides the region {place} from the rest, as pieces of the patterns would hang free there; "
            "choose patterns that cross"
        )
    if request.grading is not None and request.grading.varies == "cell" and facts.widths is not None:
        narrow, wide = facts.widths
        if narrow < LEAST_WIDTH * hollow.width:
            yield (
                f"cells cannot follow the density alone, so walls are {plain_argument(narrow, 2)} to "
                f"{plain_argument(wide, 2)} mm wide: there is too little room for cells of such sizes beside one "
                "another; give densities closer to each other"
            )
    if facts.loose and not request.is_block:
        verb = "touches nothing and comes apart" if facts.loose == 1 else "touch nothing and come apart"
        remedy = "give a wall, such as --wall 1.2" if request.ties else "leave out --no-ties"
        yield f"{count_noun(facts.loose, 'body', 'bodies')} of infill {verb}; {remedy}"
    share = hollow.density_before if request.reaches_skin else hollow.density
    if isinstance(request.kind, Tiled) and hollow.islands:
        remedy = "draw lines from them to the rest" if request.ties else "leave out --no-ties"
        if request.open_ is not None:
            remedy += ", or close the top or the bottom of the part"
        yield f"pieces of the drawing that touch no wall were left out: {hollow.islands}; {remedy}"
    elif share < LEAST_LEFT * facts.drawn * min(1.0, facts.width / hollow.width):  # narrower is told as a width
        yield (
            f"the infill was drawn with a density of {facts.drawn:.1%}, and {share:.1%} is left: walls or bars are too "
            f"thin for the grid, or were smoothed away; {_remedy_for_worn_lines(request, hollow.width)}"
        )
    if request.line_width is not None and request.grading is None and not is_width_ok(facts.width, request.line_width):
        yield (
            f"walls or bars inside are {plain_argument(facts.width, 3)} mm wide, and "
            f"{plain_argument(request.line_width)} mm was asked for"
        )
    elif request.form != "project" and request.grading is None and facts.width < HAIRLINE:
        yield (
            f"walls or bars inside are {plain_argument(facts.width, 2)} mm wide, thinner than most printers make; "
            "give a larger cell, a line width or a higher density"
        )
    yield from size_problems(request, hollow)
    yield from slicer_problems(request, hollow, facts.width, lost)
    if moved > request.tolerance:
        distance = f"up to {plain_argument(moved, 2)} mm" if np.isfinite(moved) else "an unknown distance"
        yield f"for so few triangles, the voids were moved by {distance}; give larger cells, or more triangles"
    if facts.least is not None and facts.least < LEAST_WALL * (thinnest := min(request.walls)):
        yield (
            f"the wall is {plain_argument(facts.least, 3)} mm thin at {plain_place(facts.at or ())}, and "
            f"{plain_argument(thinnest)} mm was asked for"
        )
    if opening is not None:
        for end in opening.closed_ends(hollow.surfaces):
            yield f"no void is open at the {end}: walls of the pattern lie along it; shift the pattern by --phase"
    if facts.astray:
        yield f"{count_noun(facts.astray, 'void')} outside of the part"
    if not hollow.space.part.closed:
        yield "the part has edges with more than two faces, and so has the result"
    if overlap > LEAST_OVERLAP:
        yield f"the part overlaps itself in {overlap:.2%} of its volume, and voids there may stay solid"
    yield from drain_problems(request, drained, facts.closed)
    if facts.crowded:
        yield f"{facts.crowded} vertices are in one place in single precision: an STL of it is not closed"
    if facts.verdict != FINE:
        yield f"manifold3d rejects the mesh: {facts.verdict}"
