"""The surface of bricks is that of the whole field; it is closed, and cost grows with the surface."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from infill import GeometryError, Smoothing
from infill.isosurfaces.components import data_bits
from infill.isosurfaces.levels import try_level
from infill.isosurfaces.marching import extract_dense
from infill.isosurfaces.sparse_marching import (
    cube_table,
    euler_number_of_bits,
    extract_bricks,
    extract_level,
    measure_level,
    raw_cube_counts,
)
from infill.kernels.sparse_marching import UNDECIDED
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.surface import Surface

UNIT = (1.0, 1.0, 1.0)
NOTHING = (0.0, 0.0, 0.0)


def same(one: Surface, other: Surface) -> bool:
    """Whether two surfaces have the same vertices to rounding, in any order, and the same Euler number."""
    if len(one.vertices) != len(other.vertices) or len(one.faces) != len(other.faces):
        return False
    distance, _ = cKDTree(one.vertices).query(other.vertices)
    # scikit-image weighs corners with 1e-7 added, and gives 32-bit vertices: some 1e-5 of a cell.
    return bool(distance.max() < 1e-4) and one.euler_number == other.euler_number


def both(f: np.ndarray, steps: int, level: float = 0.0) -> tuple[Surface, Surface]:
    field = smooth_bricks(f, Smoothing(steps=steps))
    whole = extract_dense(field.to_dense(), spacing=UNIT, origin=NOTHING, level=level)
    return extract_bricks(field, spacing=UNIT, level=level), whole


def test_the_comparison_can_fail(rng: np.random.Generator) -> None:
    one, other = both(rng.random((12, 12, 20)) < 0.3, 1)
    assert same(one, other)
    moved = one.vertices.copy()
    moved[0] += 1e-3
    assert not same(Surface(vertices=moved, faces=one.faces), other)
    assert not same(Surface(vertices=one.vertices, faces=one.faces[1:]), other)


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(
    shape=st.tuples(*[st.integers(1, 20)] * 2, st.integers(1, 40)),
    density=st.floats(0.05, 0.97),
    steps=st.integers(0, 4),
    level=st.sampled_from([0.0, 0.0, 0.1, -0.3]),
    seed=st.integers(0, 2**20),
)
def test_it_is_the_surface_of_the_whole_field(
    shape: tuple[int, ...], density: float, steps: int, level: float, seed: int
) -> None:
    """Random cells have every cube that signs do not decide, and touch every edge of the grid."""
    f = np.random.default_rng(seed).random(shape) < density
    f[0, 0, 0] = True
    field = smooth_bricks(f, Smoothing(steps=steps))
    if not (field.to_dense() > level).any():
        with pytest.raises(GeometryError, match="nothing is left above the level"):
            extract_bricks(field, spacing=UNIT, level=level)
        return
    one, other = both(f, steps, level)
    assert same(one, other)
    assert one.closed
    assert one.volume > 0


@pytest.mark.slow
def test_thousands_of_saddles_leave_no_gap(rng: np.random.Generator) -> None:
    """Noise, in which a cube in ten has a saddle: each is decided as exactly as the first."""
    field = smooth_bricks(rng.normal(0, 0.3, (60, 60, 60)).clip(-1, 1).astype(np.float32), Smoothing(steps=0))
    surface = extract_bricks(field, spacing=UNIT)
    assert surface.closed
    assert np.linalg.norm(np.diff(surface.vertices[surface.faces[:, :2]], axis=1), axis=2).max() < 3**0.5 + 1e-6


@pytest.mark.parametrize("shape", [(6, 6, 14), (7, 7, 15), (8, 8, 16), (14, 30, 31), (15, 31, 47), (16, 32, 48)])
def test_solid_up_to_the_edge_is_closed_there(shape: tuple[int, int, int]) -> None:
    """Grids that end one cell before, at and behind the end of a brick."""
    one, other = both(np.ones(shape, dtype=bool), 2)
    assert same(one, other)
    assert one.volume == pytest.approx(np.prod(shape), rel=0.03)  # edges are cut off
    assert np.allclose(one.bounds, [[0, 0, 0], shape], atol=1e-4)  # solid is a little weaker: see `TIE`


def test_spacing_and_origin_place_it(rng: np.random.Generator) -> None:
    field = smooth_bricks(rng.random((20, 20, 20)) < 0.3, Smoothing(steps=2), spacing=(0.25, 0.5, 0.75))
    plain = extract_bricks(field, spacing=UNIT)
    placed = extract_bricks(field, spacing=(0.25, 0.5, 0.75), origin=(10, -20, 3))
    assert np.allclose(placed.vertices, plain.vertices * (0.25, 0.5, 0.75) + (10, -20, 3))


def test_threads_do_not_change_it(rng: np.random.Generator) -> None:
    field = smooth_bricks(rng.random((40, 40, 40)) < 0.3, Smoothing(steps=2), threads=1)
    one, three = (extract_bricks(field, spacing=UNIT, threads=n) for n in (1, 3))
    assert np.array_equal(one.vertices, three.vertices)
    assert np.array_equal(one.faces, three.faces)


def test_the_rate_tells_how_vertices_move() -> None:
    x = np.indices((24, 24, 24)) - 11.5
    field = smooth_bricks((x**2).sum(axis=0) < 64, Smoothing(steps=6))
    step = 1e-3
    low, high = (extract_level(field, spacing=UNIT, level=level) for level in (0.05, 0.05 + step))
    assert np.array_equal(low.surface.faces, high.surface.faces)
    assert np.allclose(high.surface.vertices - low.surface.vertices, low.rate * step, atol=2e-6)


def test_the_table_knows_the_cubes_that_signs_do_not_decide() -> None:
    counts = cube_table().counts
    for signs in range(256):
        mirrored = 255 ^ signs
        assert (counts[signs] == UNDECIDED) == (counts[mirrored] == UNDECIDED)
    assert counts[0] == counts[255] == 0
    assert (counts == UNDECIDED).sum() == 128
    assert (raw_cube_counts() != UNDECIDED).all()
    # An edge that is crossed is a corner of some triangle.
    for signs in np.flatnonzero(counts > 0):
        edges = {int(e) for t in cube_table().triangles[signs, : counts[signs]] for e in t}
        assert counts[signs] == len(edges) - 2 or len(edges) == 6  # one loop, or two of three


@pytest.mark.parametrize("density", [0.2, 0.5, 0.8, 0.97])
def test_the_euler_number_of_bits_is_that_of_their_surface(density: float, rng: np.random.Generator) -> None:
    f = rng.random((20, 33, 50)) < density
    field = smooth_bricks(f, Smoothing(steps=3))
    raw = extract_dense(np.where(f, np.float32(1), np.float32(-1)), spacing=UNIT, origin=NOTHING)
    assert euler_number_of_bits(field, data_bits(field)) == raw.euler_number


def test_a_thousandfold_volume_costs_bricks_at_the_surface_only() -> None:
    """A small ball in a large grid keeps the same bricks as in a small one."""

    def kept(n: int) -> SparseField:
        f = np.zeros((n, n, n), dtype=np.int8) - 1
        f[16:32, 16:32, 16:32] = 1
        return smooth_bricks(f, Smoothing(steps=10))

    small, large = kept(60), kept(300)
    assert len(large.where) == len(small.where)
    assert same(extract_bricks(large, spacing=UNIT), extract_bricks(small, spacing=UNIT))


def test_int8_booleans_and_floats_give_the_same_bits(rng: np.random.Generator) -> None:
    solid = rng.random((17, 19, 33)) < 0.4
    signs = np.where(solid, 1, -1)
    fields = [
        smooth_bricks(f, Smoothing(steps=5)).to_dense()
        for f in (solid, signs.astype(np.int8), signs.astype(np.float32), signs.astype(np.int64))
    ]
    assert all(np.array_equal(fields[0], other) for other in fields[1:])


def test_a_surface_is_measured_as_it_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Volume and slope without the surface, where it is large: made small here."""
    x = np.indices((30, 30, 40)) - np.array([14.2, 15.1, 19.7])[:, None, None, None]
    field = smooth_bricks((x**2).sum(axis=0) < 121, Smoothing(steps=8), spacing=(0.5, 0.5, 0.4))
    assert measure_level(field, spacing=(0.5, 0.5, 0.4), level=-0.02) is None
    monkeypatch.setattr("infill.isosurfaces.sparse_marching.LARGE", 0)
    volume, slope = measure_level(field, spacing=(0.5, 0.5, 0.4), level=-0.02, threads=2)
    made = extract_level(field, spacing=(0.5, 0.5, 0.4), level=-0.02)
    assert volume == pytest.approx(made.surface.volume, rel=1e-9)
    assert slope == pytest.approx(try_level(field, -0.02, spacing=(0.5, 0.5, 0.4), threads=1).slope, rel=1e-6)
    rough = smooth_bricks(np.random.default_rng(0).random((20, 20, 20)) < 0.4, Smoothing(steps=1))
    assert measure_level(rough, spacing=UNIT, level=0.0) is None  # signs do not decide every cube
