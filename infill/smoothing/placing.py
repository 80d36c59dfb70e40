"""A result beside the data it was made from: where it lies, what it looked like before, and how far it moved."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.machine import require_memory
from infill.phasefield.sparse import SparseField
from infill.result import Result
from infill.surface import Surface
from infill.surfaces.distance import distances
from infill.surfaces.sparse_marching import extract_bricks
from infill.volume import Volume

COMPARED = 5_000  # vertices of which the distance is measured


def placed(surface: Surface, data: Volume) -> Surface:
    """Return the surface where the volume lies in space."""
    faces = surface.faces[:, ::-1] if data.mirrored else surface.faces
    return Surface(vertices=data.place(surface.vertices), faces=faces, space=data.space)


def staircase(result: Result) -> Surface:
    """Return the surface of the data that a result was smoothed from, in the same place."""
    return raw_surface(result.fields["levelled"].against, result.fields["data"], None)


def field_volume(result: Result) -> Volume:
    """Return the field of a result as a whole, less its level, so that the surface lies at 0: float32, [x, y, z].

    Of a surface at the level of the volume it is the distance from the surface, +-1 some cells away from it.
    """
    data, found = result.fields["data"], result.fields["levelled"]
    require_memory(4 * data.values.size, None, "write a mesh instead of the field, or use larger voxels")
    values = found.against.to_dense()
    values -= np.float32(found.height)
    whole: Volume = replace(data, values=values.clip(-1, 1, out=values))
    return whole


def raw_surface(field: SparseField, data: Volume, threads: int | None) -> Surface:
    """Return the surface of the data in bricks, placed in space."""
    raw = extract_bricks(replace(field, values=as_float(field)), spacing=tuple(data.cell_size), threads=threads)
    return placed(raw, data)


def moved(
    surface: Surface, field: SparseField, data: Volume, reference: Surface | None, threads: int | None
) -> dict[str, Any]:
    """Return how far the voxels and the result lie from the mesh they were made from, or from one another, mm."""
    raw = raw_surface(field, data, threads)
    if reference is None:
        return {"from": "voxels", "result": summary(distances(some(surface.vertices), raw))}
    return {
        "from": "mesh",
        "data": summary(distances(some(raw.vertices), reference)),
        "result": summary(distances(some(surface.vertices), reference)),
    }


def as_float(field: SparseField) -> NDArray[np.float32]:
    """Return the data of the bricks as phase field."""
    values: NDArray[np.float32] = field.data.astype(np.float32)
    return values


def some(vertices: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return so many of the vertices as are compared, spread evenly over them."""
    return vertices[:: max(1, len(vertices) // COMPARED)]


def summary(distance: NDArray[np.float64]) -> dict[str, float]:
    """Return mean, root mean square and largest of distances."""
    return {
        "mean": float(distance.mean()),
        "rms": float(np.sqrt((distance**2).mean())),
        "max": float(distance.max()),
    }
