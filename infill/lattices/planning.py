"""The grid and memory that a fill will take, before anything is computed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from infill.interior.interior import BYTES_PER_CELL, further_for, grid_of
from infill.lattices.choosing import voids_of
from infill.lattices.request import Request
from infill.lattices.sizing import on_grid_of, sizes_for, voxel_for
from infill.surface import Surface


def planned_fill(part: Surface, request: Request, *, threads: int | None = None) -> dict[str, Any]:
    """Return cell, line width, grid and memory, as the report of `fill` has them."""
    request = on_grid_of(request, part.bounds)
    voids = voids_of(request, part.bounds, threads)
    extents = np.ptp(part.bounds, axis=0)
    cell, width = sizes_for(request, voids, extents)
    voxel = voxel_for(request, voids, extents, cell, width)
    grid = grid_of(part, voxel=voxel, further=further_for(request.open_, request.wall, request.beyond, voxel))
    return {
        "request": request.facts(),
        "infill": {"cell": cell, "line_width": width},
        "grid": {"shape": list(grid.shape), "spacing": [voxel] * 3, "origin": list(grid.origin), "space": ""},
        "memory": (BYTES_PER_CELL + request.held) * math.prod(grid.shape),
    }
