"""The infill of a slicer's project: what slicers can print of it, with the pattern where that is most.

In a part that is small beside a cell, chance decides whether a wall of the pattern runs through the middle, or along a
wall of the part, where little of it is left for a line. If too much is lost, the pattern is shifted, and what still is
too narrow is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import chain

from infill.errors import GeometryError, ParameterError
from infill.interior.hollow import Hollow
from infill.interior.inside import SHARE, inner_side
from infill.interior.interior import Space
from infill.interior.narrow import NARROW, Narrow, too_narrow, without_narrow
from infill.lattices.choosing import voids_of
from infill.lattices.hollowing import hollowed
from infill.lattices.request import LINE_WIDTH, Request
from infill.lattices.voids import Voids
from infill.meshes.solids import shortened, volume_within, without
from infill.result import Clock
from infill.surface import Surface

SHORT = 1e-3  # mm: edges of the infill of a project are longer than that, or nearly
INTO_WALL = 0.75  # how far infill reaches into the walls of a part from which it cannot be cut
# Of a line, and of walls: PrusaSlicer prints plates of 0.45 mm with lines of 0.45 mm, and none of 0.4 mm; but where a
# wall of a part cuts through a wall of the pattern, it drops more. Without what is narrower than 0.6 mm, of 0.5 to 0.72
# that were tried, bodies were nearest to what it extrudes. Of thinner walls, it prints most as they are.
LEAST_LINE, LEAST_LINES, LEAST_WIDTH = 0.9, 4 / 3, 0.9
MUCH = 0.1  # of the infill: if more of it is lost, the pattern is shifted, until hardly any is
HARDLY = 0.02
MOST_CELLS = 3_000_000  # of the grid: shifts of the pattern in larger parts would take long, and matter less
FIRST, SHIFTED = 0.25, 0.75  # of the work: where shifting begins and ends
SHIFTS = (  # of a cell, as even as few of them are: the beginning of Halton's sequence
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
class Projected:
    """The infill of a project.

    Parameters
    ----------
    infill : Surface, mm
    hollow : Hollow
    voids : Voids
        Of the pattern, where it is.
    phase : (x, y, z)
        mm by which it is shifted.
    narrow : Narrow or None
        What slicers print none for, before it was left out.
    """

    infill: Surface
    hollow: Hollow
    voids: Voids
    phase: tuple[float, float, float]
    narrow: Narrow | None

    @property
    def lost(self) -> float:
        """Share of the infill that slicers print none for; 1 if that is not known."""
        return 1.0 if self.narrow is None else self.narrow.all


def projected(
    part: Surface, request: Request, *, clock: Clock, threads: int | None = None, max_memory: int | None = None
) -> Projected:
    """Return the infill of a project for a part, mm.

    Raises
    ------
    GeometryError
        If there is no room for a void, or the voids cannot be taken out of the part.
    MemoryLimitError
        If memory will not suffice.
    """

    def placed(request: Request, clock: Clock) -> Projected:
        voids = voids_of(request, part.bounds, threads)
        hollow = hollowed(part, request, voids, clock=clock, threads=threads, max_memory=max_memory)
        infill = _through_walls(hollow.space, hollow.surfaces, request, threads)
        narrow = too_narrow(hollow.space.part, infill, request.wall, LINE_WIDTH, _least(hollow, request))
        return Projected(infill=infill, hollow=hollow, voids=voids, phase=request.phase, narrow=narrow)

    found = placed(request, clock)
    if _may_be_shifted(found, request):
        found = min(chain([found], _shifted(found, request, placed, clock)), key=lambda each: each.lost)
    # Shifted, a pattern has little infill in a part, and what is lost of that is soon a twentieth.
    most = NARROW if found.phase == request.phase else HARDLY
    return _printable(found, request) if found.narrow is not None and found.narrow.all > most else found


def _may_be_shifted(found: Projected, request: Request) -> bool:
    """Return whether shifting a pattern may help: nobody said where it is, and it is not the room that lacks."""
    narrow, size = found.narrow, math.prod(found.hollow.space.shape)
    asked = any(request.phase) or request.align == "bed" or request.grading is not None
    return narrow is not None and not asked and size <= MOST_CELLS and narrow.all - narrow.room > MUCH


def _shifted(
    found: Projected, request: Request, placed: Callable[[Request, Clock], Projected], clock: Clock
) -> Iterator[Projected]:
    """Yield what a part is filled with, if the pattern is elsewhere."""
    cell = found.hollow.cell
    for tried, (x, y, z) in enumerate(SHIFTS):
        with clock.stage("shift", FIRST + (SHIFTED - FIRST) * tried / len(SHIFTS)):
            try:
                other = placed(replace(request, phase=(x * cell, y * cell, z * cell)), Clock(None))
            except (GeometryError, ParameterError):  # no void is left, or the pattern follows the part
                continue
        yield other
        if other.lost < HARDLY:
            break


def _printable(found: Projected, request: Request) -> Projected:
    """Return infill without what slicers print none for, or all of it if nothing else is left."""
    hollow = found.hollow
    part, walls = hollow.space.part, hollow.walls
    kept = without_narrow(part, found.infill, request.wall, LINE_WIDTH, _least(hollow, request))
    if walls is None or kept is found.infill:
        return found
    left = volume_within(kept, walls)
    if not left > 0:  # nan too
        return found
    out = volume_within(found.infill, walls) - left
    return replace(found, infill=shortened(kept, SHORT), hollow=replace(hollow, loose=out))


def _least(hollow: Hollow, request: Request) -> float:
    """Return the width of the narrowest infill that slicers print, mm."""
    narrowest = LEAST_WIDTH * hollow.width * request.thinnest
    return min(max(narrowest, LEAST_LINE * LINE_WIDTH), LEAST_LINES * LINE_WIDTH)


def _through_walls(space: Space, voids: list[Surface], request: Request, threads: int | None) -> Surface:
    """Return the surface of what the voids leave of the part, or of most of it, if manifold3d does not take that.

    Where voids meet the skin, they leave edges so short that single precision, as files have it, takes their ends for
    one place: such edges are taken out.
    """
    found = without(space.part, voids)
    if found is None:
        inside = inner_side(
            space, overlap=INTO_WALL * request.wall, tolerance=SHARE * request.tolerance, threads=threads
        )
        found = without(inside, voids)
    if found is None or not len(found.faces):
        raise GeometryError("manifold3d does not take the voids as solids; give another cell or smaller voxels")
    return shortened(found, SHORT)
