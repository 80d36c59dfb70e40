"""Closedness, volume and area of a surface, the same values as `Surface` computes, by all cores in one pass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.surface import Surface

MOST_INT32_VERTICES = 2**29  # vertices, whose numbers and two bits more fit into 32


def measure_surface(surface: Surface, *, threads: int | None = None) -> Surface:
    """Measure a surface; return it with closedness, volume and area known.

    The specification is what `Surface` computes by itself: `closed` is the same, volume and area agree to rounding,
    whatever the number of threads.

    Parameters
    ----------
    surface : Surface
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    volume, area = volume_and_area(surface, threads=threads)
    closed = surface.closed if surface.knows_closed else _is_closed(surface, thread_count(threads))
    return surface.with_measures(closed=closed, volume=volume, area=area)


def volume_and_area(surface: Surface, *, threads: int | None = None) -> tuple[float, float]:
    """Return the volume inside a surface, mm³, and its area, mm²."""
    from infill.kernels.measures import BLOCK, sum_up

    vertices, faces = np.ascontiguousarray(surface.vertices, dtype=np.float64), faces_for_kernels(surface)
    middle = vertices[len(vertices) // 2] if len(vertices) else np.zeros(3)
    sums = np.empty((-(-len(faces) // BLOCK), 2))
    in_threads(sum_up, vertices, faces, middle, sums, threads=thread_count(threads))
    sixfold, doubled = sums.sum(axis=0).tolist()
    return sixfold / 6, doubled / 2


def faces_for_kernels(surface: Surface) -> NDArray[np.integer]:
    """Return the faces as int32 in one block, whatever they are stored as, so that kernels are compiled once.

    >>> faces_for_kernels(Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]]))).dtype.name
    'int32'
    """
    fits = len(surface.vertices) <= np.iinfo(np.int32).max
    return np.ascontiguousarray(surface.faces, dtype=np.int32 if fits else np.int64)


def face_areas(surface: Surface) -> NDArray[np.float64]:
    """Return the area of every face, (F,) mm².

    >>> corners = np.array([[0.0, 0, 0], [3, 0, 0], [0, 4, 0]])
    >>> face_areas(Surface(vertices=corners, faces=np.array([[0, 1, 2]]))).tolist()
    [6.0]
    """
    from infill.kernels.measures import measure_areas

    areas = np.empty(len(surface.faces))
    measure_areas(np.ascontiguousarray(surface.vertices, dtype=np.float64), faces_for_kernels(surface), areas)
    return areas


def _is_closed(surface: Surface, threads: int) -> bool:
    """Tell whether every edge has two faces that run along it in opposite directions."""
    from infill.kernels.measures import find_edge_starts, match_sides

    faces, count = faces_for_kernels(surface), len(surface.vertices)
    if not len(faces):
        return False
    index_type = np.int32 if count < MOST_INT32_VERTICES else np.int64
    edge_start = np.zeros(count + 1, dtype=index_type)
    if not find_edge_starts(faces, edge_start):
        return False
    higher = np.full(int(edge_start[-1]), -1, dtype=index_type)
    return all(in_threads(match_sides, faces, edge_start, higher, threads=threads))
