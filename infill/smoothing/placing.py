"""Place a result in space, simplify it, extract the surface of its data, and summarise distances."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.isosurfaces.components import shell_names
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.meshes.distance import distances
from infill.meshes.edge_collapse import collapse_edges
from infill.meshes.simplification import restore_volume, simplify_surface
from infill.phasefield.sparse import SparseField
from infill.surface import Surface
from infill.volume import Volume

if TYPE_CHECKING:
    from infill.report_keys import Spread
    from infill.smoothing.request import SmoothRequest

MAX_SAMPLES = 5_000  # vertices whose distance is measured
MAX_VOLUME_CHANGE = 0.05  # of the volume: how much simplification may change


def place_surface(surface: Surface, data: Volume) -> Surface:
    """Move a surface from grid coordinates to the place of the volume in space."""
    return surface.moved(data.place(surface.vertices), space=data.space, mirrored=data.mirrored)


def simplify_result(full: Surface, request: SmoothRequest) -> tuple[Surface, dict[str, Any] | None]:
    """Simplify the surface as requested; return it and the changes, None if it stays as it is.

    Raises
    ------
    GeometryError
        If the volume would change by more than 5 %, unless broken results are allowed.
    """
    if request.tolerance is None and request.max_triangles is None:
        return full, None
    assert not isinstance(request.tolerance, str)  # `Request.at` has made it a number
    if request.lenient and request.tolerance is not None:
        simplified_surface = collapse_edges(full, tolerance=request.tolerance, threads=request.threads)
        if simplified_surface is None or simplified_surface is full:
            return full, None
    else:
        simplified_surface = simplify_surface(
            full, tolerance=request.tolerance, triangles=request.max_triangles, threads=request.threads
        )
    result = replace(restore_volume(simplified_surface, full.volume), space=full.space)
    change = result.volume / full.volume - 1
    if abs(change) > MAX_VOLUME_CHANGE and not request.allow_broken:
        raise GeometryError(
            f"simplifying to {len(result.faces):,} triangles would change the volume by {change:+.0%}; "
            "allow more triangles or give a smaller tolerance"
        )
    return result, {
        "triangles_before": len(full.faces),
        "volume_change": change,
        "shells": shell_names(result)[1],
        "distance": summarise_distances(distances(subsample(full.vertices), result, threads=request.threads)),
    }


def raw_surface(field: SparseField, data: Volume, threads: int | None) -> Surface:
    """Extract the surface of the unsmoothed data in the bricks, placed in space."""
    grey = replace(field, values=field.data.astype(np.float32))
    return place_surface(extract_bricks(grey, spacing=tuple(data.cell_size), threads=threads), data)


def subsample(vertices: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return at most about 5000 vertices, spread evenly over all of them."""
    return vertices[:: max(1, len(vertices) // MAX_SAMPLES)]


def summarise_distances(distance: NDArray[np.float64]) -> Spread:
    """Return the mean, root mean square and maximum of the distances."""
    return {
        "mean": float(distance.mean()),
        "rms": float(np.sqrt((distance**2).mean())),
        "max": float(distance.max()),
    }
