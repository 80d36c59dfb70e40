"""How to smooth a mesh: by way of its exact distances on a grid, refined, and what to try if that loses something."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, replace
from functools import partial

from infill.errors import ParameterError
from infill.inspection.changes import Counts
from infill.machine import require_memory
from infill.phasefield.refining import cut_off, on_profile
from infill.phasefield.schedule import FEWEST
from infill.smoothing.hints import tell_of_filters
from infill.smoothing.remedies import Way
from infill.smoothing.request import AUTO, Given, Method, Request
from infill.surface import Surface
from infill.voxels.from_mesh import RESOLUTION, Voxelised, grid_around, voxelise_reported

BYTES_PER_CELL = 22  # a measured peak: which cells are inside, their distances, and the field that is made of those
MARGIN = 8  # cells of void around a mesh or points, so that the edge of the grid has no effect
FINER = (1.5, 2.0, 3.0)  # times as many voxels along each side: what is tried where something would be lost


def ways_of_mesh(
    surface: Surface,
    request: Request,
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    fixed: bool = True,
    hint: bool = False,
) -> Iterator[Way]:
    """Yield the ways to smooth a mesh: refined, and with finer voxels unless their size was asked for.

    Parameters
    ----------
    surface : Surface, mm
    request : Request
    resolution, voxel
        See `infill.smooth_mesh`.
    fixed : bool
        Whether the size of the voxels was asked for.
    hint : bool
        Whether to tell of filters that may be nearer: see `infill.smoothing.hints`.
    """
    auto: Method = "refine" if request.smoothing.steps >= FEWEST and request.level == "volume" else "plain"
    first = replace(request, method=auto if request.method == AUTO else request.method, refine=None)
    if first.method == "grey":
        raise ParameterError("grey levels are those of scans; choose plain or refine for a mesh")

    def with_voxels(resolution: int | None, voxel: float | None, *, hint: bool = False) -> tuple[Given, Request]:
        if len(surface.faces):
            grid = grid_around(surface, voxel=voxel, resolution=resolution, margin=MARGIN)
            advice = f"the grid has {' x '.join(map(str, grid.shape))} cells; give larger voxels or a lower resolution"
            require_memory(BYTES_PER_CELL * grid.cells, request.max_memory, advice)
        found = voxelise_reported(
            surface, voxel=voxel, resolution=resolution, margin=MARGIN, max_memory=request.max_memory
        )
        if hint:
            tell_of_filters(surface, found)
        return _given_mesh(surface, found, first), first

    yield Way(name=first.method, make=partial(with_voxels, resolution, voxel, hint=hint))
    if request.method == AUTO and not fixed:
        for times in FINER:
            finer = round(times * RESOLUTION)
            size = (finer, None) if voxel is None else (None, voxel / times)
            yield Way(name=f"{finer} voxels", make=partial(with_voxels, *size), cost=times**2.5)


def _given_mesh(surface: Surface, found: Voxelised, request: Request) -> Given:
    """Return the distances from a mesh as data, and what is known about it."""
    interface = request.smoothing.interface
    distance = found.distances(cut_off(interface), threads=request.threads)
    held = found.enclosed
    # How the mesh is connected is known if its components neither touch nor overlap, and nothing had to be added.
    whole = found.closed.closed and found.repairs.holes == 0 and (not found.several or len(held.excess) == 0)
    topology = None
    if whole:
        solids, cavities = int((held.volumes > 0).sum()), int((held.volumes < 0).sum())
        tunnels = solids + cavities - found.closed.euler_number // 2
        topology = Counts.of(components=solids, cavities=cavities, tunnels=tunnels) if tunnels >= 0 else None
    return Given(
        data=replace(found.volume, values=on_profile(distance, interface, threads=request.threads)),
        facts={
            "source": "mesh",
            "repairs": asdict(found.repairs),
            "several": found.several,
            "notes": list(surface.notes),
        },
        reference=found.closed,
        mesh=surface,
        enclosed=held,
        topology=topology,
    )
