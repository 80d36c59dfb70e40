"""Strategies for a mesh: exact distances on a grid, refined; and finer voxels if that loses something."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, replace
from functools import partial

from infill.errors import ParameterError
from infill.inspection.changes import ConnectionCounts
from infill.machine import require_memory
from infill.phasefield.refining import cut_off_distance, phase_from_distance
from infill.phasefield.schedule import MIN_STEPS
from infill.smoothing.hints import hint_at_filters
from infill.smoothing.remedies import Strategy
from infill.smoothing.request import AUTO, Method, SmoothInput, SmoothRequest
from infill.surface import Surface
from infill.voxels.from_mesh import RESOLUTION, VoxelisedMesh, grid_around, voxelise_with_report

BYTES_PER_CELL = 22  # a measured peak: the mask of cells inside, their distances, and the field made from these
MARGIN = 8  # cells of void around a mesh or points, so that the edge of the grid has no effect
FINER = (1.5, 2.0, 3.0)  # times as many voxels along each side, tried in turn where something would be lost


def mesh_strategies(
    surface: Surface,
    request: SmoothRequest,
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    fixed: bool = True,
    hint: bool = False,
) -> Iterator[Strategy]:
    """Yield the strategies for a mesh: refined, then with finer voxels unless their size is fixed.

    Parameters
    ----------
    surface : Surface, mm
    request : SmoothRequest
    resolution, voxel
        See `infill.smooth_mesh`.
    fixed : bool
        Whether the size of the voxels is requested.
    hint : bool
        Whether to log a hint at filters that may stay nearer to the mesh: see `infill.smoothing.hints`.
    """
    auto: Method = "refine" if request.smoothing.steps >= MIN_STEPS and request.level == "volume" else "plain"
    base_request = replace(request, method=auto if request.method == AUTO else request.method, refine=None)
    if base_request.method == "grey":
        raise ParameterError("grey levels are those of scans; choose plain or refine for a mesh")

    def with_voxels(
        resolution: int | None, voxel: float | None, *, hint: bool = False
    ) -> tuple[SmoothInput, SmoothRequest]:
        if len(surface.faces):
            grid = grid_around(surface, voxel=voxel, resolution=resolution, margin=MARGIN)
            advice = f"the grid has {' x '.join(map(str, grid.shape))} cells; give larger voxels or a lower resolution"
            require_memory(BYTES_PER_CELL * grid.cells, request.max_memory, advice)
        voxelised = voxelise_with_report(
            surface, voxel=voxel, resolution=resolution, margin=MARGIN, max_memory=request.max_memory
        )
        if hint:
            hint_at_filters(surface, voxelised)
        return _mesh_input(surface, voxelised, base_request), base_request

    yield Strategy(name=base_request.method, make=partial(with_voxels, resolution, voxel, hint=hint))
    if request.method == AUTO and not fixed:
        for times in FINER:
            finer = round(times * RESOLUTION)
            size = (finer, None) if voxel is None else (None, voxel / times)
            yield Strategy(name=f"{finer} voxels", make=partial(with_voxels, *size), cost=times**2.5)


def _mesh_input(surface: Surface, voxelised: VoxelisedMesh, request: SmoothRequest) -> SmoothInput:
    """Return the distances from a mesh as data, with its topology if that is known."""
    interface = request.smoothing.interface
    distance = voxelised.distances(cut_off_distance(interface), threads=request.threads)
    enclosed = voxelised.enclosed
    # The topology of the mesh is known if its components neither touch nor overlap, and no caps had to be added.
    is_exact = (
        voxelised.closed.closed
        and voxelised.repairs.holes == 0
        and (not voxelised.several or len(enclosed.excess) == 0)
    )
    topology = None
    if is_exact:
        solids, cavities = int((enclosed.volumes > 0).sum()), int((enclosed.volumes < 0).sum())
        tunnels = solids + cavities - voxelised.closed.euler_number // 2
        topology = ConnectionCounts.of(components=solids, cavities=cavities, tunnels=tunnels) if tunnels >= 0 else None
    return SmoothInput(
        data=replace(voxelised.volume, values=phase_from_distance(distance, interface, threads=request.threads)),
        facts={
            "source": "mesh",
            "repairs": asdict(voxelised.repairs),
            "several": voxelised.several,
            "notes": list(surface.notes),
        },
        reference=voxelised.closed,
        mesh=surface,
        enclosed=enclosed,
        topology=topology,
    )
