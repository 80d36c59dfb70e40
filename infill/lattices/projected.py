"""The infill of a slicer's project: the infill that slicers can print, with the pattern placed where it is most.

In a part that is small beside a cell, chance decides whether a wall of the pattern runs through the middle, or along a
wall of the part, where little of it remains for a line. If too much is lost, the pattern is shifted, and infill that is
still too narrow is left out.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain

from infill.errors import GeometryError, ParameterError
from infill.interior.narrow import NARROW, NarrowShares, drop_narrow, estimate_narrow
from infill.lattices.at_skin import SHORT, subtract_voids
from infill.lattices.joining import make_joined_voids
from infill.lattices.request import LINE_WIDTH, FillSpec
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.solids import shared_volume, simplify_solid
from infill.surface import Surface

# Of a line, and of walls: PrusaSlicer prints plates of 0.45 mm with lines of 0.45 mm, and none of 0.4 mm; but where a
# wall of a part cuts through a wall of the pattern, it drops more. Of limits from 0.5 to 0.72 mm tried, 0.6 mm
# left bodies nearest to the extruded ones. Of thinner walls, it prints most as they are.
LEAST_LINE, LEAST_LINES, LEAST_WIDTH = 0.9, 4 / 3, 0.9
MUCH = 0.1  # of the infill: if more of it is lost, the pattern is shifted, until hardly any is
HARDLY = 0.02
MOST_CELLS = 3_000_000  # of the grid: shifts of the pattern in larger parts would take long, and matter less
FIRST, SHIFTED = 0.25, 0.75  # of the work: where shifting begins and ends
SHIFTS = (  # of a cell, evenly spread from the start: the beginning of Halton's sequence
    (1 / 2, 1 / 3, 1 / 5),
    (1 / 4, 2 / 3, 2 / 5),
    (3 / 4, 1 / 9, 3 / 5),
    (1 / 8, 4 / 9, 4 / 5),
    (5 / 8, 7 / 9, 1 / 25),
    (3 / 8, 2 / 9, 6 / 25),
    (7 / 8, 5 / 9, 11 / 25),
    (1 / 16, 8 / 9, 16 / 25),
)


@dataclass(frozen=True, kw_only=True, eq=False)
class ProjectInfill:
    """The infill of a project.

    Parameters
    ----------
    infill : Surface, mm
    hollow : VoidMeshes
    phase : (x, y, z)
        mm by which it is shifted.
    narrow : NarrowShares or None
        The infill that slicers do not print, before it was left out.
    """

    infill: Surface
    hollow: VoidMeshes
    phase: tuple[float, float, float]
    narrow: NarrowShares | None

    @property
    def lost(self) -> float:
        """Share of the infill that slicers do not print; 1 if unknown."""
        return 1.0 if self.narrow is None else self.narrow.all


def make_project_infill(task: FillTask) -> ProjectInfill:
    """Make the infill of a project for a part, mm.

    Raises
    ------
    GeometryError
        If there is no room for a void, or the voids cannot be taken out of the part.
    MemoryLimitError
        If memory will not suffice.
    """
    project = _make_infill(task)
    if _can_shift(task, project):
        project = min(chain([project], _try_shifts(task, project)), key=lambda candidate: candidate.lost)
    # A shifted pattern may have little infill in a part, and soon loses a twentieth of it.
    limit = NARROW if project.phase == task.request.phase else HARDLY
    is_printed = project.narrow is None or project.narrow.all <= limit
    return project if is_printed else _drop_unprintable(project, task.request)


def _make_infill(task: FillTask) -> ProjectInfill:
    """Make the infill with the pattern where the task has it."""
    hollow, _ = make_joined_voids(task)
    infill, narrowest = subtract_voids(task, hollow), _narrowest_printed(hollow, task.request)
    narrow = estimate_narrow(hollow.space.part, infill, task.request.wall, LINE_WIDTH, narrowest)
    return ProjectInfill(infill=infill, hollow=hollow, phase=task.request.phase, narrow=narrow)


def _can_shift(task: FillTask, project: ProjectInfill) -> bool:
    """Tell whether shifting a pattern may help: its place was not requested, and more is lost than the lack of room."""
    request, narrow, size = task.request, project.narrow, math.prod(project.hollow.space.shape)
    is_placed = any(request.phase) or request.align == "bed" or request.grading is not None or request.is_drawn_once
    is_placed = is_placed or request.has_areas
    return narrow is not None and not is_placed and size <= MOST_CELLS and narrow.all - narrow.room > MUCH


def _try_shifts(task: FillTask, project: ProjectInfill) -> Iterator[ProjectInfill]:
    """Yield the infill with the pattern in other places."""
    cell = project.hollow.cell
    for attempt, (x, y, z) in enumerate(SHIFTS):
        with task.clock.stage("shift", FIRST + (SHIFTED - FIRST) * attempt / len(SHIFTS)):
            try:
                candidate = _make_infill(task.shift((x * cell, y * cell, z * cell)))
            except (GeometryError, ParameterError):  # no void is left, or the pattern follows the part
                continue
        yield candidate
        if candidate.lost < HARDLY:
            break


def _drop_unprintable(project: ProjectInfill, request: FillSpec) -> ProjectInfill:
    """Drop infill that slicers do not print, unless nothing would remain."""
    hollow = project.hollow
    part, walls = hollow.space.part, hollow.walls
    printable = drop_narrow(part, project.infill, request.wall, LINE_WIDTH, _narrowest_printed(hollow, request))
    if walls is None or printable is project.infill:
        return project
    remaining = shared_volume(printable, walls)
    if not remaining > 0:  # nan too
        return project
    dropped = shared_volume(project.infill, walls) - remaining
    return replace(project, infill=simplify_solid(printable, SHORT), hollow=replace(hollow, loose=dropped))


def _narrowest_printed(hollow: VoidMeshes, request: FillSpec) -> float:
    """Return the width of the narrowest infill that slicers print, mm."""
    narrowest = LEAST_WIDTH * hollow.width * request.thinnest
    return min(max(narrowest, LEAST_LINE * LINE_WIDTH), LEAST_LINES * LINE_WIDTH)
