"""A draft of a fill: its voids on a coarse grid, in a fraction of a second, without the checks of the result.

The density is near the requested one, and the walls have about their width; drains, ties and other patterns in regions
are left out. The depth of the cells of the grid stays the same from draft to draft: the caller keeps it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from infill.errors import GeometryError
from infill.interior.interior import Interior, compute_interior
from infill.lattices.bodies import Fields
from infill.lattices.density_search import LEAST, find_sizes, make_voids
from infill.lattices.modifiers import add_modifiers
from infill.lattices.request import FillSpec, Size, has_bars
from infill.lattices.sizing import choose_sizes
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.lattices.voids import Layout, Periodic
from infill.plain_numbers import plain_argument
from infill.result import Clock, Progress
from infill.surface import Surface

CELLS = 72  # along the longest side of the part, if neither voxel nor resolution is requested
OFF = 0.05  # of the density: a draft further off is drawn again
REDRAWN = 2  # times, at most
RESCALED = (0.25, 4.0)  # times that a second drawing changes a size
MOST_SPACES, MOST_SIZES = 4, 32  # that are remembered


@dataclass(kw_only=True, eq=False)
class DraftMemory:
    """Results of drafts of one part that the next ones use again.

    Parameters
    ----------
    spaces : dict of Interior
        By wall and grid.
    sizes : dict of (cell, width, density)
        Of the latest draft with a pattern, in mm, by the options other than the density.
    """

    spaces: dict[tuple[object, ...], Interior] = field(default_factory=dict)
    sizes: dict[tuple[object, ...], tuple[float, float, float]] = field(default_factory=dict)

    def keep_sizes(self, key: tuple[object, ...], sizes: tuple[float, float, float]) -> None:
        """Remember the sizes of a draft; forget the oldest."""
        self.sizes.pop(key, None)
        while len(self.sizes) >= MOST_SIZES:
            del self.sizes[next(iter(self.sizes))]
        self.sizes[key] = sizes


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
    memory: DraftMemory | None = None,
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
    memory : DraftMemory, optional
        Of earlier drafts of this part.
    threads, max_memory, progress
        As in `infill.fill`.

    Raises
    ------
    GeometryError
        If the part encloses nothing, has no room inside its walls, or the pattern leaves no void.
    MemoryLimitError
        If memory will not suffice.
    """
    clock, memory = Clock(progress), DraftMemory() if memory is None else memory
    part, request = add_modifiers(part, request)
    if request.voxel is None and request.resolution is None:
        request = replace(request, resolution=CELLS)
    task = FillTask.of(part, request, clock=clock, threads=threads, max_memory=max_memory)
    with clock.stage("depth", 0.0):
        space = _find_space(task, memory)
    with clock.stage("density", 0.3):
        layout, varied, fields = _start_layout(task, space, memory)
    with clock.stage("voids", 0.6):
        hollow, fields = make_voids(task, layout, fields)
        if varied and task.request.grading is None:
            hollow = _correct_density(task, hollow, fields, varied)
    if not hollow.surfaces:
        raise GeometryError(
            f"the pattern leaves no void inside walls of {plain_argument(task.request.wall)} mm; give larger cells, "
            "narrower lines, a lower density or a thinner wall"
        )
    if varied:
        memory.keep_sizes(_sizes_key(task), (hollow.cell, hollow.width, hollow.density))
    return FillDraft(part=space.part, hollow=hollow, voxel=space.size)


def _sizes_key(task: FillTask) -> tuple[object, ...]:
    """Return the options by which the sizes of drafts of one density follow from those of another."""
    request = task.request
    pattern = (request.pattern, repr(sorted(request.parameters.items())), request.cell, request.line_width)
    return (*pattern, request.wall, request.voxel, request.open_, request.align, request.form, request.smooth_radius)


def _start_layout(
    task: FillTask, space: Interior, memory: DraftMemory
) -> tuple[Layout, tuple[Size, ...], Fields | None]:
    """Return a first layout, the sizes that may vary, and its fields: from the draft before, or from the density."""
    request, varied = task.request, task.request.varied
    grading = request.grading
    if varied and grading is None and request.density is not None and (before := memory.sizes.get(_sizes_key(task))):
        cell, width, density = before
        layout = Layout(space=space, cell=cell, width=width, threads=task.threads)
        times = request.density / max(density, LEAST)
        return layout.scale(times ** _power(task, varied[0]), varied[0]), varied, None
    cell, width = choose_sizes(task)
    local = None if grading is None else grading.widths_in(space, task.pattern.widths)
    layout = Layout(space=space, cell=cell, width=width, local=local, threads=task.threads)
    # Patterns that do not repeat take long to draw.
    return find_sizes(task, layout, varied) if isinstance(task.pattern, Periodic) else (layout, varied, None)


def _power(task: FillTask, vary: Size) -> float:
    """Return the power of a density with which a size grows: bars fill as their thickness squared."""
    return 0.5 if vary == "width" and has_bars(task.request.kind) else 1.0


def _find_space(task: FillTask, memory: DraftMemory) -> Interior:
    """Return the space inside the walls: that of an earlier draft, or a new one, which is remembered."""
    request, spaces = task.request, memory.spaces
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


def _correct_density(task: FillTask, hollow: VoidMeshes, fields: Fields | None, varied: tuple[Size, ...]) -> VoidMeshes:
    """Draw voids again, twice at most, until their density is near the requested one: the grid swallows thin walls."""
    density, vary, layout = task.request.density or LEAST, varied[-1], hollow.layout
    power, total = _power(task, vary), 1.0
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
