"""The first stage: check that memory suffices, and remove specks."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.errors import ParameterError
from infill.isosurfaces.components import data_bits, erase_components, find_components
from infill.machine import available_memory, require_memory
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import smooth_bricks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from infill.smoothing.request import SmoothRequest
    from infill.volume import Volume

BYTES_PER_SURFACE_CELL = 600  # bricks, faces, labels and mesh, for every cell at the surface; a measured peak
BYTES_TO_REFINE = 500  # three filtered fields and the last but one, on top of that
SAMPLED_LAYERS = 16  # layers that are sampled to estimate the surface
FACES_PER_CROSSING = 1.5  # along two of the three axes


def require_room(data: Volume, request: SmoothRequest) -> None:
    """Raise MemoryLimitError if the surface does not fit into memory; its cells are estimated from a few layers."""
    values: NDArray[Any] = data.values
    steps = max(1, values.shape[0] // SAMPLED_LAYERS)
    layers = values[::steps] > 0
    crossings = sum(int(np.count_nonzero(np.diff(layers, axis=axis))) for axis in (1, 2)) * steps * FACES_PER_CROSSING
    bytes_per_cell = BYTES_PER_SURFACE_CELL + (BYTES_TO_REFINE if request.refined else 0)
    needed = crossings * bytes_per_cell
    allowed = available_memory() if request.max_memory is None else request.max_memory
    # Half as many voxels along each side leave an eighth of the cells of a surface that fills the volume, like noise.
    larger = float(data.cell_size.max()) * 1.1 * (needed / max(allowed or needed, 1)) ** (1 / 3)
    require_memory(int(needed), request.max_memory, f"give --voxel {larger:.2g} or more, or --roi for a part of it")


def remove_specks(data: Volume, request: SmoothRequest) -> tuple[Volume, int]:
    """Remove components up to the requested volume; return the data and the number removed.

    Raises
    ------
    ParameterError
        If no component would remain.
    """
    largest = request.despeckle
    if not largest:
        return data, 0
    field = smooth_bricks(data.values, Smoothing(steps=0), threads=request.threads)
    solid_components = find_components(field, data_bits(field, threads=request.threads))
    small = solid_components.cells * data.cell_volume <= largest
    if small.all():
        raise ParameterError(
            f"despeckle is {largest:g} mm³ and the largest component has "
            f"{solid_components.cells.max() * data.cell_volume:g} mm³; give less"
        )
    if not small.any():
        return data, 0
    return replace(data, values=erase_components(data.values, field, solid_components, small)), int(small.sum())
