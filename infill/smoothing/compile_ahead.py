"""Compile the kernels of the later stages of smoothing: `python -m infill.smoothing.compile_ahead`.

A second process does this while the first one compiles and runs the earlier stages: see
`infill.kernels.second_compiler`. The kernels of the checks come first, since the first process needs them before those
of simplification, for which alone it waits. Each process then has about as much to do as the other.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from infill.kernels import components, distances, flips, measures, rays
from infill.kernels.compiling import collect_garbage_rarely, compile_for
from infill.meshes.compile_simplification import make_ring
from infill.meshes.edge_collapse import collapse_edges

SHAPE = (1, 1, 1)
THREADS = (0, 1)  # the number of a thread, and how many there are


def array_of(dtype: DTypeLike, axes: int) -> NDArray[Any]:
    """Return an array of one value: an example for its type."""
    return np.zeros((1,) * axes, dtype=dtype)


def compile_check_kernels() -> None:
    """Compile the kernels of the checks, for the types that smoothing a mesh gives them."""
    line, rows = array_of(np.float64, 1), array_of(np.float64, 2)
    slots, faces, signs = array_of(np.int32, 3), array_of(np.int32, 2), array_of(np.uint16, 2)
    ints, names, cells = array_of(np.int64, 1), array_of(np.int32, 1), array_of(np.int64, 2)
    runs = (signs, ints, array_of(np.int16, 2))
    compile_for(components.label_cells, cells, slots, *runs, slots, names, 1, names)
    compile_for(measures.sum_up, rows, faces, line, rows, *THREADS)
    compile_for(measures.find_edge_starts, faces, names)
    compile_for(measures.match_sides, faces, names, names, *THREADS)
    compile_for(components.meet_or_spread, slots, faces, signs, 1, True, 1, signs, *THREADS)
    compile_for(flips.flip_simple, slots, signs, cells)
    compile_for(flips.count_lonely, slots, signs, cells)
    compile_for(components.mark_runs, *runs, names, signs, array_of(np.bool_, 1))
    compile_for(components.join_beyond, faces, *runs, SHAPE, ints)
    compile_for(rays.sample_rays, slots, array_of(np.float32, 4), SHAPE, rows, rows, line, line, 1.0, rows)
    compile_for(measures.measure_areas, rows, faces, line)
    compile_for(measures.find_first_corners, faces, ints)
    compile_for(measures.spread_points, rows, faces, line, 1.0, line, rows, ints)
    compile_for(distances.interleave_bits, rows, 1, array_of(np.uint64, 1))
    compile_for(distances.box_leaves, array_of(np.float64, 3), 1, rows, rows)
    boxes = (array_of(np.float64, 3), rows, rows)
    compile_for(distances.nearest_triangles, rows, *boxes, 1, 1.0, line, ints, *THREADS)


if __name__ == "__main__":
    collect_garbage_rarely()
    compile_check_kernels()
    collapse_edges(make_ring(), tolerance=0.01)
