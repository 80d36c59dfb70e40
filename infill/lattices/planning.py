"""The grid and memory that a fill will take, before anything is computed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from infill.interior.interior import BYTES_PER_CELL, added_length, grid_for_part
from infill.lattices.choosing import choose_voids
from infill.lattices.request import FillSpec
from infill.lattices.sizing import choose_sizes, choose_voxel, resolve_voxel
from infill.surface import Surface


def planned_fill(part: Surface, request: FillSpec, *, threads: int | None = None) -> dict[str, Any]:
    """Return cell, line width, grid and memory, as the report of `fill` has them."""
    request = resolve_voxel(request, part.bounds)
    voids = choose_voids(request, part.bounds, threads)
    extents = np.ptp(part.bounds, axis=0)
    cell, width = choose_sizes(request, voids, extents)
    voxel = choose_voxel(request, voids, extents, cell, width)
    grid = grid_for_part(part, voxel=voxel, further=added_length(request.open_, request.wall, request.beyond, voxel))
    return {
        "request": request.facts(),
        "infill": {"cell": cell, "line_width": width},
        "grid": {"shape": list(grid.shape), "spacing": [voxel] * 3, "origin": list(grid.origin), "space": ""},
        "memory": (BYTES_PER_CELL + request.held) * math.prod(grid.shape),
    }
