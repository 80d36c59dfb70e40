"""Compiled functions one by one, each against what NumPy or SciPy says; the scheme itself is in test_kernels.py."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage
from scipy.ndimage import convolve1d, map_coordinates

from infill import Smoothing, Surface
from infill.inspection.deviation import GOLDEN, sample_surface
from infill.isosurfaces.components import (
    Components,
    component_cells,
    data_bits,
    dilate,
    dilate_cores,
    erode_to_cores,
    find_components,
)
from infill.kernels import components as parts
from infill.kernels import refining
from infill.kernels.compiling import njit
from infill.kernels.distances import interleave_bits, lower_to_triangles, squared_distance
from infill.kernels.sparse import (
    ALL,
    B2,
    BRICK,
    CELLS,
    FACES,
    MASKS,
    MIXED,
    OUTER,
    ROWS,
    SOLID_BRICK,
    VOID_BRICK,
    repeat_edges,
    update_faces,
)
from infill.kernels.sparse_marching import BLOCK, face_volumes, scale_to_mm, sum_volumes
from infill.kernels.threads import MAX_THREADS, VARIABLE, in_threads, thread_count
from infill.kernels.transfer import gather
from infill.meshes.distance import TriangleTree
from infill.meshes.measuring import face_areas
from infill.phasefield.sparse import SparseField, brick_states, smooth_bricks

SINGLE = 2e-6  # of numbers about 1: some ten roundings of float32


def blobs(shape: tuple[int, int, int], width: float = 4, seed: int = 3) -> np.ndarray:
    """Solid of some parts, with bricks of one value in it and around it."""
    return ndimage.gaussian_filter(np.random.default_rng(seed).normal(size=shape), width) > 0.01


@pytest.fixture(scope="module")
def field() -> SparseField:
    found = smooth_bricks(blobs((60, 50, 90)), Smoothing(steps=1))
    for kind in (VOID_BRICK, SOLID_BRICK):
        assert (found.slots == kind).any()
    return found


def on_lattice(field: SparseField, bricks: np.ndarray, void: float, solid: float) -> np.ndarray:
    """Return one array of what every brick holds, (n, *brick), where none is kept what stands for it."""
    side = bricks.shape[1:]
    out = np.full([m * n for m, n in zip(field.slots.shape, side, strict=True)], void, dtype=bricks.dtype)
    for p, q, r in np.ndindex(*field.slots.shape):
        at = tuple(slice(x * n, (x + 1) * n) for x, n in zip((p, q, r), side, strict=True))
        if (slot := field.slots[p, q, r]) >= 0:
            out[at] = bricks[slot]
        elif slot == SOLID_BRICK:
            out[at] = solid
    return out


def of_bricks(field: SparseField, whole: np.ndarray, side: tuple[int, ...] = BRICK) -> np.ndarray:
    """Return what the kept bricks hold of an array on the lattice: the way back."""
    return np.stack(
        [whole[tuple(slice(x * n, (x + 1) * n) for x, n in zip(at, side, strict=True))] for at in field.where]
    )


def unpacked(bits: np.ndarray) -> np.ndarray:
    """Return the cells (n, 8, 8, 16) of rows of bits, the lowest first."""
    return (bits.reshape(-1, *BRICK[:2])[..., None] >> np.arange(B2, dtype=np.uint16) & 1).astype(bool)


def test_the_way_to_the_lattice_and_back(field: SparseField) -> None:
    whole = on_lattice(field, field.values, -1, 1)
    assert np.array_equal(of_bricks(field, whole), field.values)
    n0, n1, n2 = field.shape
    assert np.array_equal(whole[1 : n0 + 1, 1 : n1 + 1, 1 : n2 + 1], field.to_dense())
    assert not np.array_equal(of_bricks(field, np.roll(whole, 1, axis=2)), field.values)


# --- rows of bits ----------------------------------------------------------------------------------------


@pytest.mark.slow
@given(bits=st.integers(0, 2**16 - 1), k=st.integers(0, 15))
def test_runs_of_bits(bits: int, k: int) -> None:
    cells = [bits >> n & 1 for n in range(16)]
    found = [n for n in range(16) if cells[n] and (n == 0 or not cells[n - 1])]
    assert int(parts.beginnings(np.uint16(bits))) == sum(1 << n for n in found)
    length = [*cells[k:], 0].index(0)
    assert parts.run_length(np.uint16(bits), k) == length


def test_cells_of_which_all_or_any_are_set(field: SparseField) -> None:
    """Bricks that are solid throughout are full, to beyond the grid."""
    bits = data_bits(field)
    solid = on_lattice(field, unpacked(bits), False, True)
    core = ndimage.minimum_filter(solid, 2, origin=-1, mode="constant", cval=False)
    assert np.array_equal(unpacked(erode_to_cores(field, bits)), of_bricks(field, core))
    # Only what bricks keep is spread: where nothing is kept, cores are those of solid bricks, all of them.
    core = on_lattice(field, unpacked(erode_to_cores(field, bits)), False, True)
    wide = ndimage.maximum_filter(core, 2, origin=0, mode="constant", cval=False)
    assert np.array_equal(unpacked(dilate_cores(field, erode_to_cores(field, bits))), of_bricks(field, wide))
    near = ndimage.maximum_filter(solid, 3, mode="constant", cval=False)
    kept = unpacked(dilate(field, bits, 1))
    inside = of_bricks(field, on_lattice(field, np.ones_like(kept), False, True))  # as far as bricks are kept
    assert inside.all()
    assert np.array_equal(kept, of_bricks(field, near))


def pairs(one: np.ndarray, other: np.ndarray) -> dict[tuple[int, int], int]:
    """How many cells two sets of numbered components have in common."""
    both = (one >= 0) & (other >= 0)
    keys, counts = np.unique(np.stack([one[both], other[both]]), axis=1, return_counts=True)
    return {(int(a), int(b)): int(n) for (a, b), n in zip(keys.T, counts, strict=True)}


def names_of(every: Components) -> np.ndarray:
    """The component of each cell kept, by a plain count of the beginnings of runs; -1 where there is none."""
    cells = unpacked(every.bits)
    before = np.concatenate([np.zeros_like(cells[..., :1]), cells[..., :-1]], axis=-1)
    run = np.cumsum((cells & ~before).reshape(-1))  # run 0 is what lies beyond the grid
    return np.where(cells, every.names[run].reshape(cells.shape), -1)


def test_overlaps_are_those_of_the_cells(field: SparseField) -> None:
    bits = data_bits(field)
    rng = np.random.default_rng(4)
    fewer = bits & rng.integers(0, 2**16, bits.shape, dtype=np.uint16)
    before, after = find_components(field, bits), find_components(field, fewer, whole=False)
    assert before.count > 1
    assert after.count > 100
    found = parts.overlaps(
        before.bits, before.bricks, before.starts, before.names, after.bits, after.bricks, after.starts, after.names
    )
    summed: dict[tuple[int, int], int] = {}
    for one, other, cells in found.tolist():
        summed[one, other] = summed.get((one, other), 0) + cells
    assert summed == pairs(names_of(before), names_of(after))


def nearest(names: np.ndarray, at: tuple[int, ...], reach: int) -> int:
    """The component of a cell, or of the nearest along the axes: low before high, i before j before k."""
    if names[at] >= 0:
        return int(names[at])
    for distance in range(1, reach + 1):
        for axis in range(3):
            for way in (-distance, distance):
                other = tuple(x + way * (a == axis) for a, x in enumerate(at))
                if all(0 <= x < n for x, n in zip(other, names.shape, strict=True)) and names[other] >= 0:
                    return int(names[other])
    return -1


def lattice_of_names(field: SparseField, every: Components) -> np.ndarray:
    whole = on_lattice(field, names_of(every), -1, -1)
    for p, q, r in np.argwhere(every.alone >= 0):
        at = tuple(slice(x * n, (x + 1) * n) for x, n in zip((p, q, r), BRICK, strict=True))
        whole[at] = every.names[every.alone[p, q, r]]
    return whole


@pytest.mark.slow
def test_cells_take_the_nearest_component_and_its_level(field: SparseField) -> None:
    every = find_components(field, data_bits(field))
    names = lattice_of_names(field, every)
    labels, number = ndimage.label(names >= 0)
    assert number == every.count > 1
    assert len(pairs(names, np.where(labels, labels, -1))) == number  # SciPy numbers them in another order
    rng = np.random.default_rng(8)
    places = rng.integers(0, names.shape, (400, 3)).astype(np.int32)
    found = np.empty(len(places), dtype=np.int32)
    how = (field.slots, every.bits, every.bricks, every.starts, every.alone, every.names)
    for reach in (0, 3, 9):
        parts.label_cells(places, *how, reach, found)
        assert found.tolist() == [nearest(names, tuple(at), reach) for at in places.tolist()]
    values = field.values.reshape(-1, CELLS)
    levels, common, out = rng.uniform(-0.5, 0.5, every.count).astype(np.float32), np.float32(0.25), values.copy()
    for kind in (np.int16, np.int32):
        labels = np.full(values.shape, 7, dtype=kind)
        parts.label_bricks(values, field.where, *how, 3, labels, 0, 1)
        assert (labels[abs(values) == 1] == -1).all()
        parts.lower_to_levels(values, labels, levels, common, out, 0, 1)
    for s, t in zip(rng.integers(0, len(values), 600), rng.integers(0, CELLS, 600), strict=True):
        at = tuple(field.where[s] * BRICK + np.unravel_index(t, BRICK))
        component = nearest(names, at, 3)
        lowered = values[s, t] - (levels[component] if component >= 0 else common)
        assert out[s, t] == (values[s, t] if abs(values[s, t]) == 1 else lowered)


@pytest.mark.slow
def test_cells_of_a_component(field: SparseField) -> None:
    every = find_components(field, data_bits(field))
    names = of_bricks(field, lattice_of_names(field, every))
    for number in range(every.count):
        brick, *inner = np.nonzero(names == number)
        expected = field.where[brick] * BRICK + np.stack(inner, axis=1) - 1
        assert sorted(map(tuple, component_cells(field, every, number))) == sorted(map(tuple, expected))


# --- faces and edges of bricks ---------------------------------------------------------------------------


@pytest.mark.parametrize("value", [None, 1.0, -1.0, 0.5])
def test_faces_are_copied_and_flat_ones_are_noted(value: float | None) -> None:
    """One face of a brick of noise has one value; only +1 and -1 are flat."""
    for side in range(6):
        brick = np.random.default_rng(side).uniform(-1, 1, BRICK).astype(np.float32)
        axis, last = side // 2, side % 2
        if value is not None:
            np.moveaxis(brick, axis, 0)[-last] = value
        faces, flat = np.full(FACES, np.nan, dtype=np.float32), np.full(6, 9, dtype=np.int8)
        rows = np.zeros(MASKS, dtype=np.uint64)
        update_faces(brick.reshape(-1), faces, flat, rows, ALL)
        cuts = [np.moveaxis(brick, a, 0)[end].reshape(-1) for a in range(3) for end in (0, -1)]
        expected = [0] * 6
        expected[side] = int(value) if value in (1.0, -1.0) else 0
        assert flat.tolist() == expected
        sizes = np.cumsum([len(cut) for cut in cuts])[:-1]
        for copied, cut, one in zip(np.split(faces, sizes), cuts, expected, strict=True):
            assert one or np.array_equal(copied, cut)  # nobody reads a flat face
        cells = (brick.reshape(ROWS, -1), brick.reshape(ROWS, -1)[:, :1], brick.reshape(ROWS, -1)[:, -1:])
        noted = [(part == sign).all(axis=1) for part in cells for sign in (1, -1)]
        assert [int(each) for each in rows] == [sum(1 << int(n) for n in np.flatnonzero(each)) for each in noted]


@pytest.mark.slow
@pytest.mark.parametrize("where", [(0, 0, 0), (1, 0, 2), (2, 1, 3), (1, 1, 1)])
def test_cells_beyond_the_grid_repeat_its_edge(where: tuple[int, int, int]) -> None:
    shape = (19, 9, 50)
    brick = np.random.default_rng(2).uniform(-1, 1, BRICK).astype(np.float32)
    places = [np.arange(n) + n * at for n, at in zip(BRICK, where, strict=True)]
    inner = [np.clip(x, 1, n) - x[0] for x, n in zip(places, shape, strict=True)]
    expected = brick[np.ix_(*inner)]
    flat = brick.reshape(-1).copy()
    repeat_edges(flat, np.array(where), shape)
    assert np.array_equal(flat.reshape(BRICK), expected)


# --- gates of refining -----------------------------------------------------------------------------------


def gates(field: SparseField, size: int) -> np.ndarray:
    """Sums on coarse cells as large as those of real data, (n, 3, 8 / size, 8 / size, 16 / size)."""
    rng = np.random.default_rng(size)
    side = tuple(n // size for n in BRICK)
    return rng.uniform(0.1, 1, (len(field.where), refining.SUMS, *side)).astype(np.float32)


@pytest.mark.parametrize("size", [2, 4])
def test_coarse_cells_are_means(size: int) -> None:
    rng = np.random.default_rng(1)
    low, high, phase = rng.uniform(-1, 1, (3, 7, CELLS)).astype(np.float32)
    side = tuple(n // size for n in BRICK)
    sums = np.empty((7, refining.SUMS, *side), dtype=np.float32)
    refining.average(low, high, phase, np.float32(1.7), size, sums, 0, 1)
    w, r = 1 - phase.astype(float) ** 2, 1.7 * (high.astype(float) - low)
    for m in range(refining.SUMS):
        cells = (w * r**m).reshape(7, side[0], size, side[1], size, side[2], size)
        assert np.abs(sums[:, m] - cells.mean(axis=(2, 4, 6))).max() < 5 * SINGLE  # r is up to 3.4, and squared


@pytest.mark.parametrize("size", [2, 4])
def test_coarse_cells_are_averaged_along_each_axis(size: int, field: SparseField) -> None:
    sums = gates(field, size)
    out = np.empty_like(sums)
    refining.blur(sums, field.slots, field.where, out, 0, 1)
    far, near, own = refining.TAPS
    for m in range(refining.SUMS):
        whole = on_lattice(field, sums[:, m], 0, 0).astype(float)
        for axis in range(3):
            whole = convolve1d(whole, [far, near, own, near, far], axis=axis, mode="constant")
        assert np.abs(out[:, m] - of_bricks(field, whole, sums.shape[2:])).max() < SINGLE


@pytest.mark.slow
@pytest.mark.parametrize("size", [2, 4])
def test_gates_open_by_the_means_around_a_cell(size: int, field: SparseField) -> None:
    """The means are linear between the middles of coarse cells, and 0 where no brick is kept."""
    rng = np.random.default_rng(9)
    sums = gates(field, size)
    low, high = rng.uniform(-1, 1, (2, len(sums), CELLS)).astype(np.float32)
    signed, unsigned, tiny = (np.float32(x) for x in (0.8, 0.9, 1e-6))
    found = low.copy()
    refining.blend(found, high, sums, field.slots, field.where, field.shape, signed, unsigned, tiny, 0, 1)
    means = []
    for m in range(refining.SUMS):
        whole = np.pad(on_lattice(field, sums[:, m], 0, 0).astype(float), 1)
        fine = [(np.arange((n - 2) * size) + 0.5) / size + 0.5 for n in whole.shape]
        means.append(map_coordinates(whole, np.meshgrid(*fine, indexing="ij"), order=1))
    bias, spread = means[1] / (means[0] + tiny), means[2] / (means[0] + tiny)
    gate = np.maximum(bias**4 / (bias**4 + 0.8**4), spread**4 / (spread**4 + 0.9**8))
    gate = of_bricks(field, gate).reshape(len(sums), -1)
    expected = low + gate * (high - low)
    n0, n1, n2 = field.shape
    inside = np.zeros([m * n for m, n in zip(field.slots.shape, BRICK, strict=True)], dtype=bool)
    inside[1 : n0 + 1, 1 : n1 + 1, 1 : n2 + 1] = True
    inside = of_bricks(field, inside).reshape(len(sums), -1)
    assert np.abs(found - expected)[inside].max() < 5 * SINGLE  # eighth powers
    for s in np.flatnonzero(~inside.all(axis=1)):
        again = found[s].copy()
        repeat_edges(again, field.where[s], field.shape)
        assert np.array_equal(found[s], again)


# --- triangles -------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_volumes_and_slopes_of_faces() -> None:
    """Against the determinant, and, of all faces together, against moving every vertex by a little of its rate."""
    rng = np.random.default_rng(12)
    sphere = trimesh.creation.icosphere(subdivisions=1)
    vertices = sphere.vertices * rng.uniform(0.5, 1.5, (len(sphere.vertices), 1))
    rate, faces = rng.uniform(-1, 1, vertices.shape), sphere.faces.astype(np.int32)
    middle = np.array([0.2, -0.4, 0.1])

    def exact(step: float) -> np.ndarray:
        return np.linalg.det((vertices + step * rate - middle)[faces]) / 6

    slope = (exact(1e-5).sum() - exact(-1e-5).sum()) / 2e-5  # a cubic: error 1e-10
    for threads in (1, 3):
        own, change = np.full((2, len(faces)), np.nan)
        sums = np.full((-(-len(faces) // BLOCK), 2), np.nan)
        for thread in range(threads):
            face_volumes(vertices, rate, faces, middle, own, change, thread, threads)
            sum_volumes(vertices, rate, faces, middle, sums, thread, threads)
        assert own == pytest.approx(exact(0), abs=1e-14)
        assert change.sum() == pytest.approx(slope, abs=1e-8)
        assert sums.sum(axis=0) / 6 == pytest.approx([own.sum(), change.sum()], abs=1e-12)


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_vertices_are_placed_in_mm(threads: int) -> None:
    rng = np.random.default_rng(13)
    vertices, rate = rng.uniform(0, 9, (2, 12, 3))
    spacing, origin = np.array([0.3, 0.5, 2.0]), np.array([5.0, -1.0, 0.0])
    there, moved = vertices.copy(), rate.copy()
    for thread in range(threads):
        scale_to_mm(there, moved, spacing, origin, thread, threads)
    assert there == pytest.approx((vertices + 0.5) * spacing + origin)
    assert moved == pytest.approx(rate * spacing)


# --- between a grid and its bricks ------------------------------------------------------------------------


def state(cells: np.ndarray, grey: bool) -> int:
    """The value that all cells of a brick have, +1 or -1, else mixed; without a cell of the grid it is outside."""
    if cells.size == 0:
        return OUTER
    solid, void = (cells == 1, cells == -1) if grey else (cells > 0, cells <= 0)
    return 1 if solid.all() else -1 if void.all() else MIXED


@pytest.mark.parametrize("kind", ["bool", "int8", "float32"])
@pytest.mark.parametrize("shape", [(15, 9, 31), (40, 33, 70), (1, 1, 1)])
def test_states_of_bricks(shape: tuple[int, int, int], kind: str) -> None:
    solid = blobs(shape)
    data = solid if kind == "bool" else np.where(solid, 1, -1).astype(kind)
    grey = kind == "float32"
    if grey and shape[0] > 1:
        data[0, 0, 0] = 0.5
    _, found = brick_states(data, threads=2)
    for at in np.ndindex(*found.shape):
        sides = [slice(max(n * x - 1, 0), max(n * (x + 1) - 1, 0)) for n, x in zip(BRICK, at, strict=True)]
        assert found[at] == state(data[tuple(sides)], grey)
    assert (found[-1] == OUTER).all() == (shape[0] == 15)  # which ends a cell before a brick begins


@pytest.mark.slow
def test_bricks_repeat_the_edge_of_what_they_are_taken_from() -> None:
    whole = np.random.default_rng(3).uniform(-1, 1, (19, 9, 50)).astype(np.float32)
    where = np.array([(0, 0, 0), (2, 1, 3), (1, 1, 1)], dtype=np.int32)
    expected = np.stack(
        [
            whole[
                np.ix_(
                    *[
                        np.clip(np.arange(n) + n * x - 1, 0, m - 1)
                        for n, x, m in zip(BRICK, at, whole.shape, strict=True)
                    ]
                )
            ]
            for at in where
        ]
    )
    values, signs = np.empty((3, CELLS), dtype=np.float32), np.empty((3, CELLS), dtype=np.int8)
    gather(whole, where, values, 3, None, 0, 1)
    gather(whole, where, signs, 3, 0.2, 0, 1)
    assert np.array_equal(values.reshape(-1, *BRICK), expected)
    assert np.array_equal(signs.reshape(-1, *BRICK), np.where(expected > 0.2, 1, -1))


# --- compiling, and sharing among threads ----------------------------------------------------------------


def test_where_nothing_can_be_kept_it_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """As numba says it of a folder that cannot be written to."""
    compiler, asked = numba.njit, []

    def unkept(*function: Any, **options: Any) -> Any:
        if "cache" in options:
            asked.append(options["cache"])
        if options.get("cache"):
            raise RuntimeError("cannot cache function 'twice': no locator available")
        return compiler(*function, **options)

    monkeypatch.setattr(numba, "njit", unkept)
    assert njit(cache=True)(lambda x: 2 * x)(21) == 42
    assert asked == [True, False]


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_every_piece_is_taken_once_and_answers_come_in_order(threads: int) -> None:
    taken: list[int] = []

    def kernel(count: int, thread: int, of: int) -> int:
        taken.extend(range(thread, count, of))
        return thread

    assert in_threads(kernel, 23, threads=threads) == list(range(threads))
    assert sorted(taken) == list(range(23))


@pytest.mark.parametrize("failing", [0, 1, 2])
def test_a_thread_that_fails_is_heard(failing: int) -> None:
    def kernel(thread: int, of: int) -> None:
        if thread == failing:
            raise ZeroDivisionError(f"thread {thread} of {of}")

    with pytest.raises(ZeroDivisionError, match=f"thread {failing} of 3"):
        in_threads(kernel, threads=3)


def test_how_many_threads_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("infill.kernels.threads.usable_cores", lambda: 7)
    for said, expected in (("3", 3), ("0", 7), ("many", 7), ("", 7), ("100000", MAX_THREADS)):
        monkeypatch.setenv(VARIABLE, said)
        assert thread_count() == expected
        assert thread_count(2) == 2
    monkeypatch.delenv(VARIABLE)
    assert thread_count() == 7
    assert thread_count(10**6) == MAX_THREADS


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["any", "slender", "line", "point", "upright"])
def test_cells_are_lowered_to_the_exact_distance_from_the_nearest_triangle(kind: str) -> None:
    """The form without branches, against the distance of each cell from each triangle by its regions."""
    rng = np.random.default_rng(11)
    corners = rng.uniform(2, 14, (9, 1, 3)) + rng.normal(0, 3, (9, 3, 3))
    if kind == "slender":
        corners[:, 2] = (corners[:, 0] + corners[:, 1]) / 2 + rng.normal(0, 1e-5, (9, 3))
    elif kind == "line":
        corners[:, 2] = corners[:, 0] + (corners[:, 1] - corners[:, 0]) * 0.3
    elif kind == "point":
        corners[:, 1:] = corners[:, :1]
    elif kind == "upright":
        corners[:, :, 2] = corners[:, :1, 2]  # level, so that rows are upright on it
    reach, shape = 3.3, (17, 16, 18)
    found = np.full(shape, np.float32(reach**2))
    in_threads(lower_to_triangles, corners, reach, found, threads=2)
    cells = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    wanted = np.full(len(cells), reach**2)
    for a, b, c in corners:
        if kind == "line":  # c lies between a and b
            share = np.clip((cells - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            away = ((cells - a - share[:, None] * (b - a)) ** 2).sum(axis=1)
        else:
            away = np.array([squared_distance(*cell, a, b, c) for cell in cells])
        wanted = np.minimum(wanted, away)
    np.testing.assert_allclose(found.ravel(), wanted, rtol=1e-6, atol=1e-9)
    assert (found < np.float32(reach**2)).sum() > 100


# --- surfaces --------------------------------------------------------------------------------------------


def triangles(rng: np.random.Generator, vertices: int, faces: int) -> Surface:
    """Triangles between random points, some of which none uses."""
    points = rng.normal(size=(vertices, 3)) * [1, 5, 2] + [100, -3, 0]
    return Surface(vertices=points, faces=rng.integers(0, max(1, vertices - 2), (faces, 3)).astype(np.int32))


@pytest.mark.parametrize("count", [1, 2, 7, 5000])
def test_the_curve_of_morton_interleaves_bits(count: int, rng: np.random.Generator) -> None:
    points = rng.normal(size=(count, 3)) * [1, 5, 2]
    codes = np.empty(count, dtype=np.uint64)
    interleave_bits(points, 10, codes)
    side = max(float(np.ptp(points, axis=0).max()), 1e-300)
    cells = ((points - points.min(axis=0)) * (1023 / side)).astype(int)
    for code, cell in zip(codes.tolist(), cells.tolist(), strict=True):
        assert code == sum((cell[axis] >> bit & 1) << 3 * bit + axis for bit in range(10) for axis in range(3))


@pytest.mark.parametrize("count", [1, 4, 5, 9, 1000])
def test_boxes_of_a_tree_hold_what_is_below_them_and_no_more(count: int, rng: np.random.Generator) -> None:
    tree = TriangleTree.of(triangles(rng, 50, count))
    first_leaf = len(tree.low) // 2

    def below(box: int) -> np.ndarray:
        if box < first_leaf:
            return np.concatenate([below(2 * box + 1), below(2 * box + 2)])
        return tree.corners[4 * (box - first_leaf) : 4 * (box - first_leaf) + 4].reshape(-1, 3)

    assert sorted(tree.order) == list(range(count))
    for box in range(len(tree.low)):
        points = below(box)
        assert np.array_equal(tree.low[box], points.min(axis=0, initial=np.inf))
        assert np.array_equal(tree.high[box], points.max(axis=0, initial=-np.inf))


@pytest.mark.parametrize("pitch", [0.3, 10.0, 1e6])
def test_points_are_spread_evenly_over_a_surface(pitch: float, rng: np.random.Generator) -> None:
    """Number by number what NumPy says: a face by the sum of areas before it, and places that fill a face."""
    surface = triangles(rng, 40, 60)
    corners = surface.vertices[surface.faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert np.array_equal(face_areas(surface), areas)
    points, face, area = sample_surface(surface, pitch)
    count = int(min(80_000, np.ceil(areas.sum() / pitch**2)))
    spread = np.searchsorted(np.cumsum(areas), (np.arange(count) + 0.5) * (areas.sum() / count)).clip(0, 59)
    u, v = ((np.arange(count) * share) % 1 for share in GOLDEN)
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    a, b, c = (corners[spread, k] for k in range(3))
    used, first = np.unique(surface.faces, return_index=True)
    assert np.array_equal(
        points, np.concatenate([a + u[:, None] * (b - a) + v[:, None] * (c - a), surface.vertices[used]])
    )
    assert np.array_equal(face, np.concatenate([spread, first // 3]))
    assert area.sum() == pytest.approx(areas.sum())
    assert not area[count:].any()
