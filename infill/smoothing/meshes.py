"""Smooth a mesh: its exact distances on a grid, refined; and finer voxels if that loses something."""

from __future__ import annotations

import logging
from dataclasses import asdict, replace

import numpy as np

from infill.errors import ParameterError
from infill.inspection.changes import ConnectionCounts
from infill.machine import require_memory
from infill.phasefield.schedule import MIN_STEPS
from infill.plain_numbers import plain_argument, plain_number
from infill.reports.common import declare
from infill.reports.smoothing import RepairKeys
from infill.result import Clock
from infill.smoothing.request import AUTO, MeshOnGrid, Method, SmoothInput, SmoothRequest, Way
from infill.surface import Surface
from infill.voxels.from_mesh import RESOLUTION, VoxelisedMesh, grid_around, voxelise_with_report
from infill.voxels.partial import phase_field_of_mesh

LOG = logging.getLogger("infill")
BYTES_PER_CELL = 22  # a measured peak: the mask of cells inside, their distances, and the field made from these
MARGIN = 8  # cells of void around a mesh or points, so that the edge of the grid has no effect
FINER = (1.5, 2.0, 3.0)  # times as many voxels along each side, tried in turn where something would be lost
SMALLER = (1.5, 2.0, 3.0, 5.0)  # times as small a radius, tried before it is recommended
COST_POWER = 2.5  # of these: the surface grows with the square, the volume with the cube
DENSE = 1  # voxels: a mesh whose edges are longer in the mean has no detail that voxels lose


def mesh_ways(
    surface: Surface,
    request: SmoothRequest,
    *,
    resolution: int | None = None,
    voxel: float | None = None,
    fixed: bool = True,
    hint: bool = False,
) -> list[Way]:
    """List the ways to smooth a mesh: refined, then with finer voxels, which are only recommended if the size is fixed.

    Parameters
    ----------
    surface : Surface, mm
    request : SmoothRequest
    resolution, voxel
        See `infill.smooth_mesh`.
    fixed : bool
        Whether the size of the voxels is requested.
    hint : bool
        Whether to log a hint at filters that may stay nearer to the mesh.
    """
    auto: Method = "refine" if request.smoothing.steps >= MIN_STEPS and request.level == "volume" else "plain"
    chosen = replace(request, method=auto if request.method == AUTO else request.method, refine=None)
    if chosen.method == "grey":
        raise ParameterError("grey levels are those of scans; choose plain or refine for a mesh")
    data = MeshOnGrid(surface=surface, resolution=resolution, voxel=voxel, hint=hint)
    ways = [Way(name=chosen.method, data=data, request=chosen)]
    is_free = request.method == AUTO and not fixed
    for times in FINER:
        finer, size = round(times * (resolution or RESOLUTION)), None if voxel is None else voxel / times
        if size is not None and not is_free:
            size = float(f"{size:.3g}")
        name = f"{round(times * RESOLUTION)} voxels"
        option = f"--resolution {finer}" if size is None else f"--voxel {plain_number(size, separator='')}"
        data = MeshOnGrid(surface=surface, resolution=finer if size is None else None, voxel=size)
        cost = times**COST_POWER
        ways.append(
            Way(name=name, data=data, request=chosen, cost=cost)
            if is_free
            else Way(name=option, data=data, request=chosen, cost=cost, option=option)
        )
    return [*ways, *_smaller_radii(ways[0])]


def _smaller_radii(first: Way) -> list[Way]:
    """Return ways with smaller radii than the one that is requested, to recommend."""
    radius = first.request.radius
    if radius is None:
        return []
    smaller = [float(plain_argument(radius / times, 2)) for times in SMALLER]
    return [
        replace(
            first,
            name=f"--smooth-radius {plain_argument(size)}",
            request=replace(first.request, radius=size),
            option=f"--smooth-radius {plain_argument(size)}",
        )
        for size in smaller
    ]


def voxelise_input(mesh: MeshOnGrid, request: SmoothRequest) -> SmoothInput:
    """Voxelise a mesh; return its distances as data, with its topology if that is known.

    Raises
    ------
    ParameterError, GeometryError, MemoryLimitError
        See `infill.voxels.from_mesh.voxelise`.
    """
    clock = Clock(request.progress)
    with clock.stage("voxels", 0.01):
        made = _voxelise(mesh, request)
    return replace(made, seconds=clock.seconds["voxels"])


def _voxelise(mesh: MeshOnGrid, request: SmoothRequest) -> SmoothInput:
    """Voxelise a mesh, as `voxelise_input` does, without telling the time."""
    surface, voxel, resolution = mesh.surface, mesh.voxel, mesh.resolution
    if len(surface.faces):
        grid = grid_around(surface, voxel=voxel, resolution=resolution, margin=MARGIN)
        advice = f"the grid has {' x '.join(map(str, grid.shape))} cells; give larger voxels or a lower resolution"
        require_memory(BYTES_PER_CELL * grid.cells, request.max_memory, advice)
    voxelised = voxelise_with_report(
        surface, voxel=voxel, resolution=resolution, margin=MARGIN, max_memory=request.max_memory
    )
    if request.progress is not None:
        request.progress("voxels", 0.03)
    if mesh.hint:
        _hint_at_filters(surface, voxelised)
    cells, interface, several = voxelised.volume, request.smoothing.interface, voxelised.several
    data = phase_field_of_mesh(voxelised.closed, cells, interface, several=several, threads=request.threads)
    return SmoothInput(
        data=data,
        facts={
            "source": "mesh",
            "repairs": declare(RepairKeys, asdict(voxelised.repairs)),
            "several": several,
            "notes": list(surface.notes),
        },
        closed_mesh=voxelised.closed,
        mesh=surface,
        mesh_volumes=voxelised.enclosed,
        topology=_mesh_topology(voxelised),
    )


def _mesh_topology(voxelised: VoxelisedMesh) -> ConnectionCounts | None:
    """Count solids, cavities and tunnels; None if components touch or overlap, or caps had to be added."""
    enclosed, closed = voxelised.enclosed, voxelised.closed
    overlaps = voxelised.several and len(enclosed.excess) > 0
    if not closed.closed or voxelised.repairs.holes > 0 or overlaps:
        return None
    solids, cavities = int((enclosed.volumes > 0).sum()), int((enclosed.volumes < 0).sum())
    tunnels = solids + cavities - closed.euler_number // 2
    return ConnectionCounts.of(components=solids, cavities=cavities, tunnels=tunnels) if tunnels >= 0 else None


def _hint_at_filters(surface: Surface, voxelised: VoxelisedMesh) -> None:
    """Log a hint if a filter of the mesh itself may stay nearer to it than voxels.

    That is so for a closed mesh of one component, without overlaps, whose edges are shorter than a voxel in the
    mean: filters move the corners of such a mesh, while voxels take its noise for its shape.
    """
    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces]
    edge_length = float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())
    cell_size = float(voxelised.volume.cell_size.max())
    if edge_length >= DENSE * cell_size or voxelised.several or voxelised.repairs.holes:
        return
    LOG.info(
        "hint: the mesh is closed, and its edges (%s mm in the mean) are short for voxels of %s mm; if it is a noisy "
        "scan, a filter of the mesh itself, such as Taubin's or Humphrey's in trimesh, keeps its triangles and may "
        "be nearer",
        plain_argument(edge_length, 3),
        plain_argument(cell_size, 3),
    )
