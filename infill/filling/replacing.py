"""Paths of our own in the place of the slicer's infill: in its regions, with its filament, section by section."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.filling.contact import sampled
from infill.filling.covering import cover, solve_cell
from infill.filling.families.protocol import Family
from infill.filling.keeping import Rounding, first_moves, line_width, points_of, smoothed
from infill.filling.regions import STEP, Region, region_of
from infill.filling.support import Sample
from infill.filling.surroundings import beads
from infill.gcode.bodies import Body, Ways, bodies
from infill.gcode.sections import Marks, Strokes
from infill.gcode.table import Table

if TYPE_CHECKING:
    from shapely import Polygon

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Paths = list[Floats]

LEAST_WIDTH, MOST_WIDTH = 0.92, 1.08  # of the slicer's filament per mm, to meet the filament of a region
SHARED = 0.02  # of an area's infill may be another section's
LOST = 0.1  # of a section's infill may lie outside every area that was found
INSIDE = 0.02  # mm that a path may leave its region


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What fills the regions.

    Parameters
    ----------
    family : Family
    cell : float, mm
    line_width : float, mm
    rounding : Rounding
    same_filament : bool
        Every section keeps its filament; else the beads keep their width.
    """

    family: Family
    cell: float
    line_width: float
    rounding: Rounding
    same_filament: bool


@dataclass(kw_only=True)
class Memory:
    """What one layer leaves for the next: its region, the paths of areas that repeat, and how the print travels."""

    region: Region | None = None
    ways: Ways = field(default_factory=Ways)
    paths: dict[tuple[int, int], Paths] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Fresh:
    """New paths for a section.

    Parameters
    ----------
    body : Body
    paths : list of (N, 2) float64, mm
    rate : float
        mm of filament per mm.
    areas : tuple of Polygon
    """

    body: Body
    paths: Paths
    rate: float
    areas: tuple[Polygon, ...]


def layer_samples(infill: Strokes, some: Places) -> Floats:
    """Return points on some strokes, (N, 2) float64, mm."""
    ends = np.concatenate([[0], np.cumsum(np.diff(infill.first)[some])])
    return sampled(infill.points[points_of(infill.first, some)], ends).points


def planned(
    family: Family, some: Sequence[Sample], rounding: Rounding, *, density: float | None, acceleration: float
) -> Plan:
    """Choose the cell, so that the layers that were looked at take the filament that they should.

    Parameters
    ----------
    family : Family
    some : sequence of Sample
    rounding : Rounding
    density : float, optional
        Share of the volume; without it, the filament of the slicer's own infill.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    import shapely

    regions, length, width = [], 0.0, 0.0
    for sample in some:
        opens = first_moves(sample.infill)
        layer = sample.marks.layer[opens]
        others = beads(sample.table, sample.marks, sample.infill)
        width = float(np.median(line_width(sample.marks, opens)))
        number = sample.pairs[-1][1]
        chosen = np.flatnonzero(layer == number)
        region = region_of(others.of(number, STEP), layer_samples(sample.infill, chosen))
        if not region.polygons:
            continue
        area = shapely.MultiPolygon(list(region.polygons))
        regions.append((area, float(sample.table.z[opens[chosen[0]]]), int(number)))
        spacing = _spacing(width, float(np.nanmedian(sample.marks.height[opens])))
        length += float(sample.infill.length[chosen].sum()) if density is None else density * area.area / spacing
    if not regions:
        raise ParameterError("no region of infill was found to fit a pattern into; give --pattern keep")

    def measure(paths: Sequence[Floats]) -> float:
        done = _rounded(list(paths), None, rounding, width, acceleration, 80.0)
        return float(sum(np.hypot(*np.diff(path, axis=0).T).sum() for path in done))

    radius = min(rounding.radius, 1e3)
    solved = solve_cell(regions, family, length, line_width=width, radius=radius, measure=measure)
    return Plan(family=family, cell=solved.cell, line_width=width, rounding=rounding, same_filament=density is None)


def _spacing(width: float, height: float) -> float:
    """Return the spacing, mm, at which beads with rounded sides fill the plane."""
    return width - (0.2 if np.isnan(height) else min(height, width)) * (1 - np.pi / 4)


def fresh_sections(
    table: Table, marks: Marks, infill: Strokes, plan: Plan, memory: Memory, acceleration: float
) -> tuple[list[Fresh], dict[str, int]]:
    """Return new paths for the sections of a batch, and how many sections keep theirs, by reason."""
    found, reasons = bodies(table, marks, infill)
    others = beads(table, marks, infill)
    layer = marks.layer[first_moves(infill)]
    section = marks.section[first_moves(infill)]
    fresh: list[Fresh] = []
    for number in np.unique(layer):
        some = np.flatnonzero(layer == number)
        walls = others.of(int(number), STEP)
        region = region_of(walls, layer_samples(infill, some), memory.region)
        if region is not memory.region:
            memory.paths.clear()
        memory.region = region
        owned, lost = _owned(region, infill, some, section)
        for body in (body for body in found if body.layer == number):
            if body.section in lost:
                reasons["no sure region"] = reasons.get("no sure region", 0) + 1
                continue
            areas = owned.get(body.section, ())
            paths = _paths(body, areas, walls, plan, memory, acceleration, region)
            length = sum(float(np.hypot(*np.diff(path, axis=0).T).sum()) for path in paths)
            if not length:
                reasons["no path fits"] = reasons.get("no path fits", 0) + 1
                continue
            rate = body.rate
            if plan.same_filament:
                rate *= float(np.clip(body.filament / (body.rate * length), LEAST_WIDTH, MOST_WIDTH))
            chosen = tuple(region.polygons[place] for place in areas)
            fresh.append(Fresh(body=body, paths=paths, rate=rate, areas=chosen))
    return fresh, reasons


def _owned(
    region: Region, infill: Strokes, some: Places, section: Places
) -> tuple[dict[int, tuple[int, ...]], set[int]]:
    """Return the areas of each section of a layer, and the sections whose areas are not sure."""
    import shapely

    counts: dict[int, NDArray[np.int64]] = {}
    lost: set[int] = set()
    grown = shapely.buffer(np.array(region.polygons, dtype=object), 0.1)
    tree = shapely.STRtree(grown) if len(grown) else None
    for number in np.unique(section[some]).tolist():
        points = layer_samples(infill, some[section[some] == number])
        if tree is None:
            lost.add(number)
            continue
        which, area = tree.query(shapely.points(points), predicate="within")
        counts[number] = np.bincount(area, minlength=len(grown))
        if len(np.unique(which)) < (1 - LOST) * len(points):
            lost.add(number)
    owned: dict[int, tuple[int, ...]] = {}
    for area in range(len(grown)):
        held = {number: int(count[area]) for number, count in counts.items() if count[area]}
        if not held:
            continue
        owner = max(held, key=lambda number: held[number])
        if sum(held.values()) - held[owner] > SHARED * sum(held.values()):
            lost.update(held)  # printed in two visits
        owned[owner] = (*owned.get(owner, ()), area)
    return owned, lost


def _paths(
    body: Body,
    areas: tuple[int, ...],
    walls: Floats,
    plan: Plan,
    memory: Memory,
    acceleration: float,
    region: Region,
) -> Paths:
    """Return rounded paths in some areas, in the order of printing, from where the section begins."""
    import shapely

    paths: Paths = []
    for area in areas:
        key = (area, 0 if plan.family.prismatic else body.layer)
        if key not in memory.paths:
            polygon = region.polygons[area]
            strands = cover(
                polygon,
                plan.family,
                cell=plan.cell,
                line_width=plan.line_width,
                z=body.z,
                layer=body.layer,
                radius=min(plan.rounding.radius, 1e3),
            )
            done = _rounded(strands, walls, plan.rounding, plan.line_width, acceleration, body.feed / 60)
            near = shapely.buffer(polygon, INSIDE)
            shapely.prepare(near)
            memory.paths[key] = [path for path in done if shapely.contains_xy(near, path[:, 0], path[:, 1]).all()]
        paths.extend(memory.paths[key])
    if not paths:
        return paths
    # The same paths either way round: whichever begins nearer.
    back = [path[::-1] for path in paths[::-1]]

    def way(there: Paths) -> float:
        return float(np.hypot(*(there[0][0] - body.start)) + np.hypot(*(there[-1][-1] - body.end)))

    return min(paths, back, key=way)


def _rounded(
    paths: Paths, walls: Floats | None, rounding: Rounding, width: float, acceleration: float, speed: float
) -> Paths:
    """Return paths with round corners; beside walls they hardly move."""
    paths = [path for path in paths if len(path) > 1]
    if not paths:
        return paths
    first = np.concatenate([[0], np.cumsum([len(path) for path in paths])])
    done = smoothed(
        np.concatenate(paths),
        first,
        walls=walls,
        acceleration=np.full(len(paths), acceleration),
        speed=np.full(len(paths), speed),
        rounding=rounding,
        line_width=width,
    )
    return [done.points[low:high] for low, high in zip(done.first[:-1], done.first[1:], strict=True)]


def retractions(fresh: Fresh, least: float) -> list[bool]:
    """Return whether to retract on the way to each path and to the end: where the way leaves the region."""
    import shapely

    begins = [fresh.body.start, *(path[-1] for path in fresh.paths)]
    ends = [*(path[0] for path in fresh.paths), fresh.body.end]
    ways = shapely.linestrings(np.stack([np.array(begins), np.array(ends)], axis=1))
    whole = shapely.buffer(shapely.union_all(list(fresh.areas)), 0.1)
    shapely.prepare(whole)
    long = shapely.length(ways) > least
    return [bool(each) for each in long & ~shapely.covers(whole, ways)]


def outside(fresh: Fresh) -> bool:
    """Return whether a path leaves its region."""
    import shapely

    near = shapely.buffer(shapely.union_all(list(fresh.areas)), INSIDE + 0.001)
    shapely.prepare(near)
    points = np.concatenate(fresh.paths)
    return not bool(shapely.contains_xy(near, points[:, 0], points[:, 1]).all())
