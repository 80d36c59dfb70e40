"""A draft of a fill: its voids on a coarse grid, in a fraction of a second, without the checks of the result.

The density is near the requested one, and the walls have about their width; drains, ties and other patterns in regions
are left out. The depth of the cells of the grid stays the same from draft to draft: the caller keeps it.
"""

from __future__ import annotations

import math
from collections.abc import MutableMapping
from dataclasses import dataclass, replace

import numpy as np

from infill.errors import GeometryError
from infill.interior.interior import Interior, compute_interior
from infill.lattices.bodies import Fields
from infill.lattices.density_search import LEAST, find_sizes, make_voids
from infill.lattices.modifiers import add_modifiers
from infill.lattices.request import FillSpec, Size, has_bars
from infill.lattices.sizing import choose_sizes, coarsest_voxel
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.lattices.voids import Layout, Periodic
from infill.plain_numbers import plain_argument
from infill.result import Clock, Progress
from infill.surface import Surface

CELLS, MOST_CELLS = 64, 80  # along the longest side of the part, if neither voxel nor resolution is requested
OFF = 0.05  # of the density: a draft further off is drawn again
REDRAWN = 2  # times, at most
RESCALED = (0.25, 4.0)  # times that a second drawing changes a size
MOST_SPACES = 4  # that are kept
Spaces = MutableMapping[tuple[object, ...], Interior]


@dataclass(frozen=True, kw_only=True, eq=False)
class FillDraft:
    """A draft of a fill.

    Parameters
    ----------
    part : Surface, mm
        After repairs.
    hollow : VoidMeshes
    voxel : float
        Side of the cells of the grid, mm.
    """

    part: Surface
    hollow: VoidMeshes
    voxel: float

    @property
    def walls_inside(self) -> Surface:
        """The surfaces of the voids, facing into them, mm."""
        voids = self.hollow.surface
        return replace(voids, faces=voids.faces[:, ::-1])

    @property
    def volume(self) -> float:
        """Volume of the solid, mm³."""
        return self.part.volume - self.hollow.volume


def draft_fill(
    part: Surface,
    request: FillSpec,
    *,
    spaces: Spaces | None = None,
    threads: int | None = None,
    max_memory: int | None = None,
    progress: Progress | None = None,
) -> FillDraft:
    """Draft a fill with a shell.

    Parameters
    ----------
    part : Surface, mm
    request : FillSpec
        As for `infill.lattices.job.fill_request`.
    spaces : mutable mapping, optional
        Insides of this part from earlier drafts; new ones are added to it.
    threads, max_memory, progress
        As in `infill.fill`.

    Raises
    ------
    GeometryError
        If the part encloses nothing, has no room inside its walls, or the pattern leaves no void.
    MemoryLimitError
        If memory will not suffice.
    """
    clock = Clock(progress)
    part, request = add_modifiers(part, request)
    task = FillTask.of(part, request, clock=clock, threads=threads, max_memory=max_memory)
    with clock.stage("depth", 0.0):
        cell, width = choose_sizes(task)
        if task.request.voxel is None:
            longest = float(task.extents.max())
            voxel = float(np.clip(coarsest_voxel(task, cell, width), longest / MOST_CELLS, longest / CELLS))
            task = replace(task, request=replace(task.request, voxel=voxel))
        space = _find_space(task, {} if spaces is None else spaces)
    with clock.stage("density", 0.3):
        grading = task.request.grading
        local = None if grading is None else grading.widths_in(space, task.pattern.widths)
        layout = Layout(space=space, cell=cell, width=width, local=local, threads=threads)
        varied, fields = task.request.varied, None
        if isinstance(task.pattern, Periodic):  # others take long to draw
            layout, varied, fields = find_sizes(task, layout, varied)
    with clock.stage("voids", 0.6):
        hollow, fields = make_voids(task, layout, fields)
        if varied and grading is None:
            hollow = _correct_density(task, layout, hollow, fields, varied[-1])
    if not hollow.surfaces:
        raise GeometryError(
            f"the pattern leaves no void inside walls of {plain_argument(task.request.wall)} mm; give larger cells, "
            "narrower lines, a lower density or a thinner wall"
        )
    return FillDraft(part=space.part, hollow=hollow, voxel=space.size)


def _find_space(task: FillTask, spaces: Spaces) -> Interior:
    """Return the space inside the walls: a fields one, or a new one, which is kept."""
    request = task.request
    assert request.voxel is not None
    key = (request.wall, request.voxel, request.open_, request.beyond, tuple(region.text for region in request.regions))
    if key not in spaces:
        while len(spaces) >= MOST_SPACES:
            del spaces[next(iter(spaces))]
        spaces[key] = compute_interior(
            task.part,
            wall=request.wall,
            voxel=request.voxel,
            places=task.local_walls,
            open_=request.open_,
            beyond=request.beyond,
            extra_bytes_per_cell=request.extra_bytes_per_cell,
            threads=task.threads,
            max_memory=task.max_memory,
        )
    return spaces[key]


def _correct_density(
    task: FillTask, layout: Layout, hollow: VoidMeshes, fields: Fields | None, vary: Size
) -> VoidMeshes:
    """Draw voids again, twice at most, until their density is near the requested one: the grid swallows thin walls."""
    density = task.request.density or LEAST
    power = 0.5 if has_bars(task.request.kind) and vary == "width" else 1.0
    total = 1.0
    for _ in range(REDRAWN):
        if abs(hollow.density / density - 1) <= OFF:
            break
        task.clock.tell("voids", 0.8)
        times = total * float(np.clip(density / max(hollow.density, LEAST), *RESCALED)) ** power
        candidate, fields = make_voids(task, layout.scale(times, vary), fields)
        if abs(candidate.density - density) > abs(hollow.density - density):
            # Too much of a change: take the middle of both.
            times = math.sqrt(times * total)
            candidate, fields = make_voids(task, layout.scale(times, vary), fields)
        hollow, total = min(((hollow, total), (candidate, times)), key=lambda made: abs(made[0].density - density))
    return hollow
