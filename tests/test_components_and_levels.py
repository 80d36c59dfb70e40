"""Components as scipy counts them on the whole grid, levels that keep volumes, and what counts as lost."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy import ndimage

from infill import Smoothing
from infill.inspection.bricks import TopologyCheck, check_topology, match_components
from infill.inspection.thickness import thinnest_walls
from infill.isosurfaces.components import (
    data_bits,
    dilate_cores,
    erase_components,
    erode_to_cores,
    find_components,
    label_shells,
    solid_bits,
)
from infill.isosurfaces.levels import straighten_profile, surface_at_level, surface_at_volume
from infill.isosurfaces.sparse_marching import extract_level
from infill.kernels.sparse import BRICK
from infill.phasefield.profile import PLAIN_PROFILE
from infill.phasefield.sparse import smooth_bricks

UNIT = (1.0, 1.0, 1.0)
EDGES = ndimage.generate_binary_structure(3, 2)


def ball(n: int, middle: tuple[float, ...], radius: float) -> np.ndarray:
    x = np.indices((n, n, n)) + 0.5
    return sum((x[i] - middle[i]) ** 2 for i in range(3)) < radius**2


def count(bits: np.ndarray) -> int:
    return int(np.unpackbits(bits.view(np.uint8)).sum())


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(
    shape=st.tuples(*[st.integers(1, 24)] * 2, st.integers(1, 50)),
    density=st.floats(0.03, 0.98),
    steps=st.integers(0, 3),
    seed=st.integers(0, 2**20),
)
@example(shape=(1, 1, 1), density=0.75, steps=0, seed=0)  # one brick, all solid, of which one cell lies on the grid
def test_components_are_those_of_scipy(shape: tuple[int, ...], density: float, steps: int, seed: int) -> None:
    f = np.random.default_rng(seed).random(shape) < density
    field = smooth_bricks(f, Smoothing(steps=steps))
    for bits, solid in ((data_bits(field), f), (solid_bits(field), field.to_dense() > 0)):
        found = find_components(field, bits, thickness=True)
        labels, number = ndimage.label(solid)
        assert found.count == number
        assert sorted(found.cells) == sorted(np.bincount(labels.ravel())[1:])
        core = ndimage.minimum_filter(np.pad(solid, (0, 1)), 2, origin=-1)[:-1, :-1, :-1]
        assert found.thick.sum() == len(np.unique(labels[core > 0]))
        assert count(erode_to_cores(field, bits)) + 1024 * (field.slots == -2).sum() >= core.sum()
        void = find_components(field, bits, void=True)
        _, number = ndimage.label(~np.pad(solid, 1), EDGES)
        assert void.count == number
        assert void.cells.sum() + found.cells.sum() == f.size


def test_opening_takes_what_is_one_cell_thick() -> None:
    f = np.zeros((20, 40, 40), dtype=bool)
    f[5:15, 5:15, 5:15] = True
    f[10, 10:35, 10:35] = True  # a sheet
    field = smooth_bricks(f, Smoothing(steps=0))
    found = dilate_cores(field, erode_to_cores(field, data_bits(field)))
    assert count(found) == 1000


def test_two_components_before_and_after() -> None:
    f = ball(40, (12, 12, 12), 8) | ball(40, (28, 28, 28), 8)
    field = smooth_bricks(f, Smoothing(steps=4))
    before = find_components(field, data_bits(field))
    same = match_components(before, find_components(field, solid_bits(field)))
    assert [len(each) for each in (same.vanished, same.broken, same.fused, same.appeared)] == [0, 0, 0, 0]


ONE, OTHER = (slice(2, 10),) * 3, (slice(2, 10), slice(2, 10), slice(20, 28))
BRIDGE = (slice(5, 7), slice(5, 7), slice(10, 20))
LOW_BRIDGE = (slice(2, 4), slice(2, 4), slice(10, 20))


def row(cells: int) -> tuple[slice, ...]:
    """So many cells behind the bridge."""
    return (slice(5, 6), slice(5, 6), slice(20, 20 + cells))


def block(*sides: int) -> tuple[slice, ...]:
    """A block behind the low bridge."""
    return tuple(slice(first, first + side) for first, side in zip((2, 2, 20), sides, strict=True))


def cubes(*parts: tuple[slice, ...]) -> np.ndarray:
    solid = np.zeros((12, 14, 40), dtype=bool)
    for part in parts:
        solid[part] = True
    return solid


@pytest.mark.parametrize(
    ("before", "after", "counts"),
    [
        ([ONE, OTHER], [ONE], (1, 0, 0, 0)),
        ([ONE, OTHER, BRIDGE], [ONE, OTHER], (0, 1, 0, 0)),
        ([ONE, OTHER], [ONE, OTHER, BRIDGE], (0, 0, 1, 0)),
        ([ONE], [ONE, OTHER], (0, 0, 0, 1)),
        ([ONE], [OTHER], (1, 0, 0, 1)),
        ([ONE, BRIDGE], [ONE], (0, 0, 0, 0)),  # what is cut off and gone leaves one part
        ([ONE, BRIDGE, row(7)], [ONE, row(7)], (0, 0, 0, 0)),  # a crumb is no part
        ([ONE, BRIDGE, row(8)], [ONE, row(8)], (0, 1, 0, 0)),
        ([ONE, block(3, 3, 11)], [ONE, LOW_BRIDGE, block(3, 3, 11)], (0, 0, 0, 0)),  # 99 cells may join unseen
        ([ONE, block(4, 5, 5)], [ONE, LOW_BRIDGE, block(4, 5, 5)], (0, 0, 1, 0)),
    ],
)
def test_what_became_of_components(before: list, after: list, counts: tuple[int, ...]) -> None:
    """Vanished, broken, fused, appeared: on the same bricks, as `check_topology` asks for it."""
    field = smooth_bricks(np.indices((12, 14, 40)).sum(axis=0) % 2 == 0, Smoothing(steps=0))  # every brick is kept
    was, now = (find_components(field, rows_of(cubes(*parts), len(field.where))) for parts in (before, after))
    found = match_components(was, now)
    assert tuple(len(each) for each in (found.vanished, found.broken, found.fused, found.appeared)) == counts


def rows_of(solid: np.ndarray, bricks: int) -> np.ndarray:
    """The bits of a field of which every brick is kept, in the order of the lattice."""
    count = [-(-(n + 2) // side) for n, side in zip(solid.shape, BRICK, strict=True)]
    whole = np.zeros([n * side for n, side in zip(count, BRICK, strict=True)], dtype=bool)
    whole[tuple(slice(1, n + 1) for n in solid.shape)] = solid
    parts = whole.reshape(count[0], BRICK[0], count[1], BRICK[1], count[2], BRICK[2]).transpose(0, 2, 4, 1, 3, 5)
    assert np.prod(count) == bricks
    return np.packbits(parts.reshape(bricks, -1, BRICK[2]), axis=-1, bitorder="little").view(np.uint16)[:, :, 0]


def test_shells_of_a_ball_in_a_hollow_ball() -> None:
    f = (ball(60, (30, 30, 30), 25) & ~ball(60, (30, 30, 30), 18)) | ball(60, (30, 30, 30), 8)
    found = extract_level(smooth_bricks(f, Smoothing(steps=4)), spacing=UNIT)
    parts = label_shells(found.surface, found.rate)
    assert (parts.components, parts.cavities, parts.tunnels) == (2, 1, 0)
    assert parts.volume.sum() == pytest.approx(found.surface.volume)


@pytest.mark.slow
@pytest.mark.parametrize("steps", [10, 20, 40])
def test_a_ball_keeps_its_volume_and_comes_nearer_to_the_truth(steps: int) -> None:
    """Faces of cells lie 0.29 cells off (rms of an even spread over one cell); a fifth of that may be left."""
    f = ball(80, (40, 40, 40), 32)
    field = smooth_bricks(f, Smoothing(steps=steps))
    data = find_components(field, data_bits(field))
    target = data.cells.astype(float)
    raw = surface_at_level(field, data, spacing=UNIT, level=0.0)
    kept = surface_at_volume(straighten_profile(field), data, spacing=UNIT, targets=target)
    assert raw.surface.volume < target.sum() * (1 - 2e-4 * steps)
    assert kept.surface.volume == pytest.approx(target.sum(), rel=6e-5)

    def distance(vertices: np.ndarray) -> float:
        return float(np.sqrt(((np.linalg.norm(vertices - 40, axis=1) - 32) ** 2).mean()))

    assert distance(kept.surface.vertices) < 0.06
    assert distance(kept.surface.vertices) < distance(raw.surface.vertices)


@pytest.mark.slow
def test_every_component_keeps_its_own_volume_and_its_cavity() -> None:
    f = ball(90, (30, 30, 30), 22) | ball(90, (68, 68, 68), 9) | ball(90, (68, 25, 25), 14) & ~ball(90, (68, 25, 25), 8)
    field = smooth_bricks(f, Smoothing(steps=20))
    data = find_components(field, data_bits(field))
    found = surface_at_volume(straighten_profile(field), data, spacing=UNIT, targets=data.cells.astype(float))
    assert found.surface.volume == pytest.approx(data.cells.sum(), rel=2e-4)
    assert len(found.shells.volume) == 4
    outer = sorted(found.shells.volume[found.shells.volume > 0])
    cavity = -found.shells.volume.min()
    assert outer[0] == pytest.approx(ball(90, (68, 68, 68), 9).sum(), rel=1e-3)
    assert outer[1] - cavity == pytest.approx(np.sort(data.cells)[1], rel=1e-3)
    assert len(np.unique(found.levels.round(4))) == 3


def test_components_that_run_together_keep_their_volume_together() -> None:
    f = ball(60, (22, 30, 30), 12) | ball(60, (40, 30, 30), 5)
    assert ndimage.label(f)[1] == 2
    field = smooth_bricks(f, Smoothing(steps=30))
    data = find_components(field, data_bits(field))
    found = surface_at_volume(straighten_profile(field), data, spacing=UNIT, targets=data.cells.astype(float))
    assert found.surface.volume == pytest.approx(f.sum(), rel=1e-3)
    assert found.surface.closed


def test_the_straight_profile_has_the_same_zero_and_sign() -> None:
    field = smooth_bricks(ball(40, (20, 20, 20), 12), Smoothing(steps=10))
    straight = straighten_profile(field)
    assert np.array_equal(np.sign(straight.values), np.sign(field.values))
    wanted = np.arctanh(np.clip(field.values.astype(float), -0.9999, 0.9999)) / np.arctanh(0.9999)
    inner = np.abs(field.values) < 0.9999
    assert np.abs(straight.values - wanted)[inner].max() < 2e-6
    assert (np.abs(straight.values[~inner]) == 1).all()
    assert PLAIN_PROFILE.phase_level(0.0) == 0


@pytest.mark.slow
def test_erasing_components() -> None:
    f = ball(40, (15, 15, 15), 8) | ball(40, (33, 33, 33), 2)
    field = smooth_bricks(f, Smoothing(steps=0))
    every = find_components(field, data_bits(field))
    cleaned = erase_components(f, field, every, every.cells < 100)
    assert np.array_equal(cleaned, ball(40, (15, 15, 15), 8))
    assert f.sum() > cleaned.sum()


def judged(f: np.ndarray, steps: int) -> TopologyCheck:
    smoothing = Smoothing(steps=steps)
    field = smooth_bricks(f, smoothing)
    data = find_components(field, data_bits(field), thickness=True)
    found = surface_at_level(field, data, spacing=UNIT, level=0.0)
    return check_topology(found, data, spacing=UNIT, blur=smoothing.blur, levels=np.zeros(data.count))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("thickness", "steps", "lost"), [(6, 20, False), (3, 5, False), (3, 40, True), (2, 20, True), (1, 10, False)]
)
def test_a_wall_more_than_one_cell_thick_that_vanishes_is_a_problem(thickness: int, steps: int, lost: bool) -> None:
    """Walls of 3 cells are gone after 40 steps, walls of 1 after 5, which is no problem but is told."""
    f = ball(60, (30, 30, 30), 20)
    f[30 : 30 + thickness, 2:58, 2:58] = True
    found = judged(f, steps)
    assert bool(found.problems) == lost
    if thickness == 1:
        assert found.result.components == 1


def test_the_largest_of_what_was_lost_is_told_first() -> None:
    f = ball(60, (30, 30, 30), 20)
    f[30:33, 2:58, 8:58] = True  # four corners beyond the ball, of two sizes
    voxels = [piece.voxels for piece in judged(f, 40).lost]
    assert len(set(voxels)) == 2
    assert voxels == sorted(voxels, reverse=True)


def test_a_hole_that_breaks_through_a_wall_is_a_problem() -> None:
    f = np.zeros((60, 60, 60), dtype=bool)
    f[8:52, 8:52, 8:52] = True
    f[16:44, 16:44, 16:44] = False
    f[20:40, 20:40, 44:49] = False  # three cells of wall are left
    assert judged(f, 5).problems == ()
    found = judged(f, 40)
    assert found.data.cavities == 1
    assert found.changes.voids_joined == 1
    assert any("between voids broke" in problem for problem in found.problems)


def boxes(shape: tuple[int, ...], *sides: tuple[tuple[int, int], ...]) -> np.ndarray:
    solid = np.zeros(shape, dtype=bool)
    for each in sides:
        solid[tuple(slice(*side) for side in each)] = True
    return solid


def membrane() -> np.ndarray:
    """A plate with a round hole in it that a skin of three cells closes."""
    solid = boxes((48, 48, 24), ((4, 44), (4, 44), (4, 20)))
    hole = np.hypot(*(np.indices((48, 48)) - 23.5)) < 12
    solid[hole, :10] = solid[hole, 13:] = False
    return solid


ENDS = (((4, 20), (4, 26), (4, 26)), ((40, 56), (4, 26), (4, 26)))
CHANGED = {
    "nothing": (ball(50, (18, 18, 18), 13), 20, {}, []),
    "a small ball goes": (
        ball(50, (18, 18, 18), 13) | ball(50, (40, 40, 40), 2.9),
        20,
        {"vanished": 1, "walls_lost": 1},
        ["1 component vanished", "1 wall vanished"],
    ),
    "a bar between two blocks goes": (
        boxes((60, 30, 30), *ENDS, ((20, 40), (13, 17), (13, 17))),
        20,
        {"broken": 1, "walls_lost": 1},
        ["1 component fell apart", "1 wall vanished"],
    ),
    "two blocks run together": (
        boxes((60, 30, 30), ((4, 28), (4, 26), (4, 26)), ((30, 54), (4, 26), (4, 26))),
        20,
        {"fused": 1},
        ["1 component fused from several"],
    ),
    "a skin gets a hole": (membrane(), 40, {"walls_pierced": 1}, ["1 hole broke through walls"]),
    "the same skin before": (membrane(), 20, {}, []),
}


@pytest.mark.slow
@pytest.mark.parametrize("what", CHANGED)
def test_each_change_is_told_and_no_other(what: str) -> None:
    solid, steps, changes, problems = CHANGED[what]
    found = judged(solid, steps)
    assert {name: count for name, count in found.changes.facts().items() if count} == changes
    assert list(found.problems) == [f"{problem} in smoothing" for problem in problems]


@pytest.mark.parametrize(("steps", "faint"), [(10, 0), (20, 1)])
def test_a_component_that_only_a_low_level_holds_is_faint(steps: int, faint: int) -> None:
    """The small ball of above keeps its volume, at a level of -0.78 after 10 steps and of -0.98 after 20."""
    smoothing = Smoothing(steps=steps)
    field = smooth_bricks(ball(50, (18, 18, 18), 13) | ball(50, (40, 40, 40), 2.9), smoothing)
    data = find_components(field, data_bits(field), thickness=True)
    targets = data.cells.astype(float)
    kept = surface_at_volume(straighten_profile(field), data, spacing=UNIT, targets=targets)
    levels = np.array([PLAIN_PROFILE.phase_level(float(level)) for level in kept.levels])
    found = check_topology(kept, data, spacing=UNIT, blur=smoothing.blur, levels=levels)
    assert found.changes.faint == faint
    assert found.changes.vanished == 0
    assert (levels.min() < -0.9) == bool(faint)


@pytest.mark.parametrize("thin", [2, 3, 5])
def test_the_thinnest_wall_is_that_of_a_small_part_of_the_surface(thin: int) -> None:
    """A fin of a tenth of the surface on a block too thick to be a wall, in cells of 0.5 mm, found to half a cell."""
    solid = boxes((40, 60, 40), ((5, 35), (5, 35), (5, 35)), ((18, 18 + thin), (35, 55), (10, 30)))
    field = smooth_bricks(solid, Smoothing(steps=0), spacing=(0.5, 0.5, 0.5))
    found = extract_level(field, spacing=(0.5, 0.5, 0.5))
    assert thinnest_walls(field, found.surface, (0.5, 0.5, 0.5)) == pytest.approx((thin * 0.5,) * 2, abs=0.25)


def test_what_is_no_wall_has_no_thinnest_one() -> None:
    field = smooth_bricks(ball(50, (25, 25, 25), 20), Smoothing(steps=5))
    assert thinnest_walls(field, extract_level(field, spacing=UNIT).surface, UNIT) == (None, None)


def test_a_wall_that_smoothing_thins_is_thinner_in_the_result() -> None:
    fin = boxes((40, 60, 40), ((5, 35), (5, 35), (5, 35)), ((18, 21), (35, 55), (10, 30)))
    field = smooth_bricks(fin, Smoothing(steps=20))
    data, result = thinnest_walls(field, extract_level(field, spacing=UNIT).surface, UNIT)
    assert data is not None
    assert result is not None
    assert data > 2
    assert result < 0.6 * data


def test_the_report_counts_a_speck_that_went() -> None:
    f = ball(40, (20, 20, 20), 12)
    f[2, 2, 2] = True
    found = judged(f, 10)
    assert found.changes.vanished_thin == 1
    assert found.problems == ()
    assert found.data.components == 2
