"""Paths of our own in the place of the slicer's infill: in its regions, with its filament, section by section."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import Samples, sampled
from infill.filling.covering import cover, solve_cell, total_length
from infill.filling.families.catalogue import FAMILIES
from infill.filling.families.heart import ConcentricHeart
from infill.filling.families.protocol import TOUCH, Family
from infill.filling.keeping import Rounding, first_moves, line_width, points_of, smoothed
from infill.filling.regions import STEP, Region, region_of
from infill.filling.support import Sample
from infill.filling.surroundings import beads
from infill.gcode.bodies import ALIKE, Body, Ways, bodies
from infill.gcode.sections import Marks, Strokes
from infill.gcode.splicing import UNIT
from infill.gcode.table import Table

if TYPE_CHECKING:
    from shapely import Polygon

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Paths = list[Floats]

LEAST_WIDTH, MOST_WIDTH = 0.92, 1.08  # of the slicer's filament per mm, to meet the filament of a region
SHARED = 0.02  # of an area's infill may be another section's
LOST = 0.1  # of a section's infill may lie outside every area that was found
INSIDE = 0.01  # mm that a path may leave its region
AGAIN = 3  # times that paths are rounded, until all of them stay inside
REACHED = 1.5  # mm from where a path leaves its region to the corners that made it leave
USUAL_SPEED = 80.0  # mm/s, for lengths: it only decides how finely arcs are cut
LARGEST_RADIUS = 1000.0  # mm: as large as it gets
OFF = 0.08  # of the length that an area should have, which beads cannot make up for, before it gets a cell of its own
FAR_OFF = 0.12  # of it, before a column changes its cell, so that its layers no longer lie on one another
TRIES = 4
NEAR = 0.02  # of the length: near enough
SMALL = 300.0  # mm of lines, below which cells around are tried too: the length jumps there
SPREAD, SCANNED = 0.25, 26
LEAST_LENGTH = 5.0  # mm: areas with less keep the cell of their column
NEWEST = 0.2  # how much the last layer counts in the density of a column


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What fills the regions.

    Parameters
    ----------
    family : Family
    cell : float, mm
    line_width : float, mm
    rounding : Rounding
    density : float, optional
        mm of line per mm², if it was asked for; else every section keeps its filament.
    """

    family: Family
    cell: float
    line_width: float
    rounding: Rounding
    density: float | None


@dataclass(frozen=True, kw_only=True)
class Column:
    """Areas that stand on one another.

    Parameters
    ----------
    area : Polygon
        The topmost.
    cell : float, mm
    density : float
        mm of the slicer's infill per mm², over the last layers: it varies from layer to layer.
    fresh : bool
        Nothing stands below the area, so that its cell is still free.
    """

    area: Polygon
    cell: float
    density: float
    fresh: bool


@dataclass(kw_only=True)
class Memory:
    """What one layer leaves for the next.

    Parameters
    ----------
    region : Region, optional
    ways : Ways
    paths : dict of (area, layer) to paths
        Of the areas of the region; for a pattern that repeats in every layer, the layer is 0.
    columns : list of Column
        One for each area.
    owed : float
        mm of filament that beads could not be widened enough to take.
    radii : list of (N,) float64, mm
        Of the arcs that were drawn since this was last emptied; 0 or infinite where there is none.
    """

    region: Region | None = None
    ways: Ways = field(default_factory=Ways)
    paths: dict[tuple[int, int], Paths] = field(default_factory=dict)
    columns: list[Column] = field(default_factory=list)
    owed: float = 0.0
    radii: list[Floats] = field(default_factory=list)


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


def family_of(pattern: str) -> Family:
    """Return a family by its name, or that of a drawing by its path."""
    if pattern in FAMILIES:
        return FAMILIES[pattern]
    from infill.filling.drawn import drawn

    return drawn(pattern)


def layer_samples(infill: Strokes, some: Places) -> Samples:
    """Return samples of some strokes."""
    ends = np.concatenate([[0], np.cumsum(np.diff(infill.first)[some])])
    return sampled(infill.points[points_of(infill.first, some)], ends)


def planned(
    family: Family, some: Sequence[Sample], rounding: Rounding, *, density: float | None, acceleration: float
) -> Plan | None:
    """Choose the cell, so that the layers that were looked at take the filament that they should; None without infill.

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

    regions, walls, length, width, spacing = [], [], 0.0, 0.0, 1.0
    for sample in some:
        opens = first_moves(sample.infill)
        layer = sample.marks.layer[opens]
        others = beads(sample.table, sample.marks, sample.infill)
        width = float(np.median(line_width(sample.marks, opens)))
        for number in sample.filled:
            chosen = np.flatnonzero(layer == number)
            beside = others.of(number, STEP)
            region = region_of(beside, layer_samples(sample.infill, chosen).points)
            if not region.polygons:
                continue
            walls.append(beside)
            area = shapely.MultiPolygon(list(region.polygons))
            regions.append((area, float(sample.table.z[opens[chosen[0]]]), int(number)))
            spacing = _spacing(width, float(np.median(sample.marks.height[opens])))
            length += float(sample.infill.length[chosen].sum()) if density is None else density * area.area / spacing
    if not regions:
        return None
    if isinstance(family, ConcentricHeart):  # one centre for the whole print
        boxes = np.array([area.bounds for area, _, _ in regions])
        low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
        family = replace(family, middle=tuple(((low + high) / 2).tolist()))

    around = np.concatenate(walls)  # of all layers at once: where they differ, a few more corners stay sharp

    def measure(paths: Sequence[Floats], cell: float) -> float:
        arcs = replace(rounding, radius=min(rounding.radius, family.largest_radius(cell, width)))
        long = [path for path in paths if len(path) > 1]
        return total_length(_rounded(long, around, arcs, width, acceleration, USUAL_SPEED)[0])

    radius = min(rounding.radius, LARGEST_RADIUS)
    solved = solve_cell(regions, family, length, line_width=width, radius=radius, measure=measure)
    return Plan(
        family=family,
        cell=solved.cell,
        line_width=width,
        rounding=rounding,
        density=None if density is None else density / spacing,
    )


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
        region = region_of(walls, layer_samples(infill, some).points, memory.region)
        if region is not memory.region:
            memory.paths.clear()
        memory.region = region
        groups, lost = _grouped(region, infill, some, section)
        here = {body.section: body for body in found if body.layer == number}
        held: dict[int, float] = {}
        for group in groups:
            for area, length in group.lengths.items():
                held[area] = held.get(area, 0.0) + length
        columns = [_column(polygon, held.get(area, 0.0), plan, memory) for area, polygon in enumerate(region.polygons)]
        memory.columns = columns
        for group in groups:
            members = [here[each] for each in group.areas if each in here]
            reason = _unsure(group, members, lost)
            if reason:
                reasons[reason] = reasons.get(reason, 0) + len(members)
                continue
            layer_plan = _Layer(plan=plan, memory=memory, walls=walls, region=region, acceleration=acceleration)
            drawn = {body.section: _paths(body, group.areas[body.section], layer_plan) for body in members}
            pushed = sum(body.rate * total_length(drawn[body.section]) for body in members)
            if not pushed:
                reasons["no path fits"] = reasons.get("no path fits", 0) + len(members)
                continue
            wanted = sum(body.filament for body in members)
            if plan.density is not None:
                area = sum(region.polygons[each].area for some_areas in group.areas.values() for each in some_areas)
                wanted = members[0].rate * plan.density * area
            wanted += memory.owed
            factor = float(np.clip(wanted / pushed, LEAST_WIDTH, MOST_WIDTH))
            memory.owed = wanted - factor * pushed
            areas = tuple(region.polygons[area] for each in group.areas.values() for area in each)
            fresh += [
                Fresh(body=body, paths=drawn[body.section], rate=body.rate * factor, areas=areas) for body in members
            ]
    return sorted(fresh, key=lambda each: each.body.first), reasons


@dataclass(frozen=True, kw_only=True)
class _Group:
    """Sections of a layer that share areas; most are alone.

    Parameters
    ----------
    areas : dict of int to tuple of int
        By section, the areas that it is to fill: those of which it printed more than the others.
    lengths : dict of int to float
        mm of the slicer's infill in each area.
    """

    areas: dict[int, tuple[int, ...]]
    lengths: dict[int, float]


@dataclass(frozen=True, kw_only=True)
class _Layer:
    """What the paths of a layer are drawn from."""

    plan: Plan
    memory: Memory
    walls: Floats
    region: Region
    acceleration: float


def _column(area: Polygon, length: float, plan: Plan, memory: Memory) -> Column:
    """Return the column that an area continues, or begins."""
    density = length / area.area if plan.density is None else plan.density
    best, most = None, 0.0
    for column in memory.columns:
        if column.area is area:
            best, most = column, area.area
            break
        if column.area.envelope.intersects(area):
            shared = column.area.intersection(area).area
            if shared > max(most, area.area / 2):
                best, most = column, shared
    if best is None:
        return Column(area=area, cell=plan.cell, density=density, fresh=True)
    return Column(area=area, cell=best.cell, density=(1 - NEWEST) * best.density + NEWEST * density, fresh=False)


def _unsure(group: _Group, members: list[Body], lost: set[int]) -> str:
    """Say why a group of sections cannot be filled anew; nothing if it can."""
    if lost & set(group.areas):
        return "no sure region"
    if len(members) < len(group.areas):
        return "shares its region with a section that is kept"
    rates = [body.rate for body in members]
    return "lines of different widths" if rates and max(rates) > (1 + ALIKE) * min(rates) else ""


def _grouped(region: Region, infill: Strokes, some: Places, section: Places) -> tuple[list[_Group], set[int]]:
    """Return the sections of a layer in groups that share areas, and the sections whose areas are not sure."""
    import shapely

    grown = shapely.buffer(np.array(region.polygons, dtype=object), 0.1)
    shapely.prepare(grown)
    numbers = np.unique(section[some]).tolist()
    held = np.zeros((len(numbers), len(grown)))
    lost: set[int] = set()
    for place, number in enumerate(numbers):
        drawn = layer_samples(infill, some[section[some] == number])
        points = drawn.points
        inside = np.array([shapely.contains_xy(area, points[:, 0], points[:, 1]) for area in grown])
        held[place] = inside @ drawn.weight if len(grown) else 0.0
        if not len(grown) or inside.any(axis=0).mean() < 1 - LOST:
            lost.add(number)
    # A section that printed next to nothing of an area has no share in it.
    shares = held > SHARED * held.sum(axis=0)
    label = np.arange(len(numbers))
    for area in range(len(grown)):
        together = np.flatnonzero(shares[:, area])
        if len(together):
            label[np.isin(label, label[together])] = label[together[0]]
    groups = []
    for each in np.unique(label):
        areas: dict[int, tuple[int, ...]] = {}
        for place in np.flatnonzero(label == each).tolist():
            own = [area for area in range(len(grown)) if held[:, area].any() and held[:, area].argmax() == place]
            areas[numbers[place]] = tuple(own)
        amount = held[label == each].sum(axis=0)
        lengths = {area: float(amount[area]) for area in np.flatnonzero(amount).tolist()}
        groups.append(_Group(areas=areas, lengths=lengths))
    return groups, lost


def _paths(body: Body, areas: tuple[int, ...], layer: _Layer) -> Paths:
    """Return rounded paths in some areas, in the order of printing, from where the section begins."""
    memory = layer.memory
    paths: Paths = []
    for area in areas:
        key = (area, 0 if layer.plan.family.prismatic else body.layer)
        if key not in memory.paths:
            memory.paths[key] = _fitted(body, area, layer)
        paths.extend(memory.paths[key])
    if not paths:
        return paths
    # The same paths either way round: whichever begins nearer.
    back = [path[::-1] for path in paths[::-1]]

    def way(there: Paths) -> float:
        return float(np.hypot(*(there[0][0] - body.start)) + np.hypot(*(there[-1][-1] - body.end)))

    return min(paths, back, key=way)


def _fitted(body: Body, area: int, layer: _Layer) -> Paths:
    """Return paths in an area, at a cell that gives them the length they should have, if that of its column does not.

    The length jumps with the cell in small areas: the nearest of a few is taken.
    """
    memory, column = layer.memory, layer.memory.columns[area]
    wanted = column.density * column.area.area
    paths = _covered(body, column.area, column.cell, layer)
    best, cell = paths, column.cell
    # What varies with the height has one cell everywhere, or its layers would not fit one another.
    if layer.plan.family.prismatic and wanted > LEAST_LENGTH:
        error = total_length(paths) / wanted - 1
        if abs(error) > (OFF if column.fresh else FAR_OFF):
            around = cell * np.exp(np.linspace(-SPREAD, SPREAD, SCANNED)) if wanted < SMALL else ()
            for tried in range(TRIES + len(around)):
                cell = cell * float(np.clip(1 + error, 0.6, 1.6)) if tried < TRIES else float(around[tried - TRIES])
                cell = max(cell, TOUCH * layer.plan.line_width)
                paths = _covered(body, column.area, cell, layer)
                error = total_length(paths) / wanted - 1
                if abs(error) < abs(total_length(best) / wanted - 1):
                    best = paths
                    memory.columns[area] = replace(column, cell=cell)
                if abs(error) < NEAR:
                    break
    return best


def _covered(body: Body, area: Polygon, cell: float, layer: _Layer) -> Paths:
    """Return rounded paths in an area; where one would leave it, its corners stay."""
    import shapely

    plan = layer.plan
    strands = cover(
        area,
        plan.family,
        cell=cell,
        line_width=plan.line_width,
        z=body.z,
        layer=body.layer,
        radius=min(plan.rounding.radius, LARGEST_RADIUS),
    )
    strands = [path for path in strands if len(path) > 1]
    if not strands:
        return strands
    radius = min(plan.rounding.radius, plan.family.largest_radius(cell, plan.line_width))
    rounding = replace(plan.rounding, radius=radius)
    near = shapely.buffer(area, INSIDE)
    shapely.prepare(near)
    corners = shapely.points(np.concatenate(strands))
    hard = np.zeros(len(corners), dtype=bool)
    for _ in range(AGAIN):
        done, radii = _rounded(
            strands, layer.walls, rounding, plan.line_width, layer.acceleration, body.feed / 60, hard=hard
        )
        lines = np.array([shapely.linestrings(path) for path in done])
        inside = shapely.covers(near, lines)
        if inside.all():
            break
        hard |= shapely.dwithin(corners, shapely.union_all(shapely.difference(lines[~inside], near)), REACHED)
    layer.memory.radii.append(radii)
    plain = [np.rint(path / UNIT) * UNIT for path in strands]
    return [one if fits else other for one, other, fits in zip(done, plain, inside.tolist(), strict=True)]


def _rounded(
    paths: Paths,
    walls: Floats | None,
    rounding: Rounding,
    width: float,
    acceleration: float,
    speed: float,
    hard: NDArray[np.bool_] | None = None,
) -> tuple[Paths, Floats]:
    """Return paths with round corners, and the radii of their arcs; beside walls they hardly move."""
    if not paths:
        return paths, np.empty(0)
    first = np.concatenate([[0], np.cumsum([len(path) for path in paths])])
    done = smoothed(
        np.concatenate(paths),
        first,
        walls=walls,
        acceleration=np.full(len(paths), acceleration),
        speed=np.full(len(paths), speed),
        rounding=rounding,
        line_width=width,
        hard=hard,
    )
    return [done.points[low:high] for low, high in zip(done.first[:-1], done.first[1:], strict=True)], done.radius


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

    if not fresh.paths:
        return False
    near = shapely.buffer(shapely.union_all(list(fresh.areas)), INSIDE + UNIT)
    shapely.prepare(near)
    return not bool(shapely.covers(near, [shapely.linestrings(path) for path in fresh.paths]).all())
