"""Cubes that are split where the skin of a part is near: the tree, its colours, its kernel, and what it follows."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import trimesh
from made_shapes import box
from scipy.ndimage import distance_transform_edt
from shapes import IN_SPACE

from infill import ParameterError, fill
from infill.interior.interior import Interior, compute_interior
from infill.kernels.cells import colour_of_cube, colours_of_cubes, from_cubes
from infill.lattices.choosing import place_pattern
from infill.lattices.grading import UNIFORM_WIDTH
from infill.lattices.request import check_request
from infill.lattices.subdivided import CubeTree, Subdivided
from infill.lattices.voids import Layout
from infill.meshes.merging import surface_of
from infill.meshes.winding import winding_numbers
from infill.voxels.scanlines import fill_rows, intersect_rows
from patterns.errors import PatternError
from patterns.octree import cube_levels

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

NAMES = ["adaptive-cubic", "support-cubic"]
GIVEN: dict[str, Any] = {
    "cell": 4.0,
    "line_width": 0.6,
    "voxel": 0.6,
    "wall": 1.0,
    "tolerance": 0,
    "smooth_radius": 0.0,
}


def cubes(levels: np.ndarray) -> np.ndarray:
    """The cubes of a tree: corner, side and colour of each, (N, 5)."""
    found = set()
    for index in np.ndindex(levels.shape):
        level = int(levels[index])
        corner = [(each >> level) << level for each in index]
        found.add((*corner, 1 << level, colour_of_cube(level, *index)))
    return np.array(sorted(found))


def scattered(seed: int, levels: int) -> list[np.ndarray]:
    """Which cubes are whole, level by level: all but a few at random, near one end where large ones are to have room."""
    rng = np.random.default_rng(seed)
    whole = []
    for level in range(1, levels + 1):
        shape = np.array([32, 16, 16]) >> level
        some = np.ones(tuple(shape.tolist()), dtype=bool)
        some[tuple(rng.integers(0, [max(1, 2 >> level), *shape[1:]], (4, 3)).T)] = False
        whole.append(
            some & whole[-1].reshape(*np.ravel([(n, 2) for n in shape])).all(axis=(1, 3, 5)) if whole else some
        )
        if level == 1 and levels < 3:
            whole[0][13, 2, 5] = False
    return whole


@pytest.mark.slow
@pytest.mark.parametrize("levels", [1, 2, 3, 4])
@pytest.mark.parametrize("seed", [0, 1])
def test_cubes_fill_space_and_those_that_touch_differ_by_a_level_and_in_colour(seed: int, levels: int) -> None:
    whole = scattered(seed, levels)
    tree = cube_levels(whole)
    found = cubes(tree)
    assert (found[:, 3] ** 3).sum() == tree.size  # each of the smallest is in one cube, so they are as many
    corner, side, colour = found[:, :3], found[:, 3], found[:, 4]
    touch = ((corner[:, None] <= corner + side[:, None]) & (corner <= (corner + side[:, None])[:, None])).all(axis=2)
    np.fill_diagonal(touch, False)
    one, other = np.nonzero(touch)
    assert (np.maximum(side[one], side[other]) <= 2 * np.minimum(side[one], side[other])).all()
    assert (colour[one] != colour[other]).all()
    for level, each in enumerate(whole, start=1):
        assert not (~spread(each, level) & (tree == level)).any()
    assert tree.max() == levels


def spread(flags: np.ndarray, level: int) -> np.ndarray:
    """The flags of cubes of a level at each of the smallest."""
    return np.kron(flags, np.ones((1 << level,) * 3, dtype=bool))


def test_no_cube_is_split_without_need() -> None:
    """Of all trees that may be, the one with the largest cubes: found by splitting what is wrong, from the top."""
    whole = scattered(3, 3)
    tree = np.full((32, 16, 16), 3, dtype=np.uint8)
    while True:
        wrong = np.any([(tree == level) & ~spread(each, level) for level, each in enumerate(whole, start=1)], axis=0)
        low = np.pad(tree, 1, mode="edge")
        least = np.min(
            [
                low[1 + a : 33 + a, 1 + b : 17 + b, 1 + c : 17 + c]
                for a in (-1, 0, 1)
                for b in (-1, 0, 1)
                for c in (-1, 0, 1)
            ],
            axis=0,
        )
        wrong |= _block_any(least < tree.astype(int) - 1, tree)
        if not wrong.any():
            break
        tree = np.where(wrong, tree - 1, tree).astype(np.uint8)
    assert (tree == cube_levels(whole)).all()


def _block_any(flags: np.ndarray, tree: np.ndarray) -> np.ndarray:
    """Whether any of the smallest cubes in the same cube has a flag."""
    found = np.zeros(flags.shape, dtype=bool)
    for x, y, z, side, _ in cubes(tree):
        block = np.s_[x : x + side, y : y + side, z : z + side]
        found[block] = flags[block].any()
    return found


@pytest.mark.longest
def test_the_kernel_is_its_definition() -> None:
    """By every cube: within it, the least distance to its faces; outside, the largest along an axis, up to `reach`."""
    rng = np.random.default_rng(7)
    tree = cube_levels(scattered(5, 2))[:16]
    assert set(np.unique(tree)) == {0, 1, 2}
    shape, period, half, reach = (24, 20, 22), 2.6, 0.4, 0.45
    depth = rng.uniform(-2, 6, shape).astype(np.float32)
    turn = trimesh.transformations.rotation_matrix(0.6, (1, 2, 3))[:3, :3] / period
    index = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1)
    places = index @ turn.T
    start = (np.array(tree.shape) - places.reshape(-1, 3).max(axis=0) - places.reshape(-1, 3).min(axis=0)) / 2
    places = places + start
    assert (places.reshape(-1, 3).min(axis=0) > 0.5).all()
    assert (places.reshape(-1, 3).max(axis=0) < np.array(tree.shape) - 0.5).all()
    ratio = rng.uniform(0.5, 2, (4, 4, 4)).astype(np.float32)
    exact = {colour: np.full(shape, -reach) for colour in range(16)}
    for x, y, z, side, colour in cubes(tree):
        beside = places - (x, y, z)
        exact[colour] = np.maximum(exact[colour], np.minimum(beside, side - beside).min(axis=-1))
    seen = colours_of_cubes(depth, tree, turn, start, 0, 1)
    out = np.empty_like(depth)
    for colour in range(16):
        wanted = np.where(depth <= -1, depth, np.minimum(exact[colour] * period - half, depth))
        count = from_cubes(depth, -1.0, tree, turn, start, period, reach, colour, half, *UNIFORM_WIDTH, out, 0, 1)
        assert out == pytest.approx(wanted, abs=1e-5)
        assert count == pytest.approx(np.clip(wanted + 0.5, 0, 1).sum(), rel=1e-4)
        assert seen[colour] == ((exact[colour] > 0) & (depth > 0)).any()
        from_cubes(depth, -1.0, tree, turn, start, period, reach, colour, half, ratio, 100.0, out, 0, 1)
        assert ((out < wanted - 1e-3) & (depth > -1)).any()  # walls that are wider from place to place
    assert seen.sum() > 10


def tree_in(part: trimesh.Trimesh, name: str, cell: float, **more: Any) -> tuple[Interior, CubeTree, Subdivided]:
    request = check_request(pattern=name, own=more, cell=cell, line_width=0.45)
    surface = surface_of(part)
    voids, space = place_pattern(request, surface.bounds), compute_interior(surface, wall=1.0, voxel=0.5)
    assert isinstance(voids, Subdivided)
    tree = voids.draw(Layout(space=space, cell=cell, width=0.45)).basis
    assert isinstance(tree, CubeTree)
    return space, tree, voids


def at_cells(
    space: Interior, tree: CubeTree, voids: Subdivided, cell: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of each cell of the grid: how often its cube is doubled, and corner and side of this, in the smallest ones."""
    index = np.stack(np.meshgrid(*map(np.arange, space.depth.shape), indexing="ij"), axis=-1)
    places = (space.origin + space.size * index - voids.anchor) @ voids.turn.T / cell + voids.pattern.middle
    at = np.floor(places).astype(int) - tree.first
    level = tree.doubled[tuple(np.moveaxis(at, -1, 0))].astype(int)
    return level, (at >> level[..., None]) << level[..., None], 1 << level


@pytest.mark.longest
def test_cubes_larger_than_the_smallest_keep_half_their_side_from_the_walls_and_are_large_far_inside() -> None:
    cell = 2.0
    space, tree, voids = tree_in(box(60, 50, 70), "adaptive-cubic", cell)
    level, corner, side = at_cells(space, tree, voids, cell)
    inside = space.depth > 0
    middles = (corner + side[..., None] / 2 + tree.first - voids.pattern.middle) @ voids.turn * cell + voids.anchor
    room = (np.array([30, 25, 35]) - 1.0 - np.abs(middles)).min(axis=-1)
    deep = inside & (room > 0)
    assert (deep == inside)[level > 0].mean() > 0.99  # corners of cubes beyond the walls at most
    assert room[(level > 0) & deep].min() > 2.0 - space.size  # the wall is known to a cell of the grid
    assert room[(level > 1) & deep].min() > 4.0 - space.size
    away = distance_transform_edt(inside) * space.size
    # No cube of four, and none of two beside it, reaches further than the diagonal of six.
    core = level[away > 6 * math.sqrt(3) * cell]
    assert (core == 2).all()
    assert len(core) > 1000
    assert (level[(away < 1.0) & inside] == 0).mean() > 0.6


@pytest.mark.slow
def test_support_follows_roofs_alone() -> None:
    """Below a roof, and not at a floor, at walls, or where it is as steep as a cone's of 30 degrees."""
    cell = 2.0
    space, tree, voids = tree_in(box(50, 50, 50), "support-cubic", cell)
    level, _, _ = at_cells(space, tree, voids, cell)
    inside = space.depth > 0
    top = np.flatnonzero(inside.any(axis=(0, 1)))[-1]
    below = np.broadcast_to((top - np.arange(inside.shape[2])) * space.size, inside.shape)
    assert (level[inside & (below == 0)] == 0).mean() > 0.6
    core = level[inside & (below > 6 * math.sqrt(3) * cell)]  # at walls and the floor, too
    assert (core == 2).all()
    assert len(core) > 1000
    small = {}
    for lean, cone in ((27, trimesh.creation.cone(15.0, 30.0)), (68, trimesh.creation.cone(30.0, 12.0))):
        space, tree, voids = tree_in(cone, "support-cubic", cell)
        small[lean] = (at_cells(space, tree, voids, cell)[0][space.depth > 0] == 0).mean()
    assert small[27] < 0.1  # a tip is a roof
    assert small[68] > 0.4


@pytest.mark.longest
def test_where_no_cube_may_be_doubled_it_is_cubic() -> None:
    """A plate so thin that walls run through all larger cubes: the same voids, in fields of their own."""
    plate = box(30, 24, 7)
    one, other = fill(plate, "cubic", **GIVEN), fill(plate, "adaptive-cubic", **GIVEN)
    assert other.surface.volume == pytest.approx(one.surface.volume, rel=1e-6)
    assert other.report["voids"]["count"] == one.report["voids"]["count"] > 20


@pytest.mark.longest
def test_a_core_is_lighter_than_that_of_cubic_and_the_skin_is_not() -> None:
    part = box(44, 44, 44)
    core, roof, floor = [], [], []
    for name in ("cubic", *NAMES):
        voids = fill(part, name, **GIVEN).stages.voids
        line = np.arange(-23, 23, 0.5)
        corners = (np.asarray(voids.vertices, dtype=np.float64) - line[0]) / 0.5
        solid = ~fill_rows(intersect_rows(corners, voids.faces, (92,) * 3), (92,) * 3)
        away = np.abs(line) < 8
        core.append(solid[np.ix_(away, away, away)].mean())
        roof.append(solid[np.ix_(away, away, (line > 17) & (line < 20.5))].mean())
        floor.append(solid[np.ix_(away, away, (line < -16) & (line > -20.5))].mean())
    assert max(core[1:]) < 0.65 * core[0]
    assert roof[1:] == pytest.approx([roof[0]] * 2, rel=0.15)
    assert floor[1] == pytest.approx(floor[0], rel=0.15)
    assert floor[2] < 0.65 * floor[0]


@pytest.mark.longest
def test_levels_say_how_much_larger_cubes_may_be() -> None:
    part, given, sizes = box(50, 50, 50), {**GIVEN, "cell": 8.0}, []
    for levels in (1, 2, 3):
        space, tree, voids = tree_in(part, "adaptive-cubic", 1.0, levels=levels)
        sizes.append(int(at_cells(space, tree, voids, 1.0)[0][space.depth > 0].max()))
    assert sizes == [1, 2, 3]
    with pytest.raises(PatternError, match="levels of adaptive-cubic is 7; it must be a whole number from 1 to 4"):
        fill(part, "adaptive-cubic", levels=7, **given)
    with pytest.raises(ParameterError, match="no parameter 'level'"):
        fill(part, "adaptive-cubic", level=2, **given)


@pytest.mark.longest
@pytest.mark.parametrize("name", NAMES)
def test_the_tree_is_that_of_the_inner_side_of_the_wall_in_a_project_too(name: str) -> None:
    """So a cut through the middle, away from the walls, is the same."""
    part = box(30, 30, 30)
    one, other = (fill(part, name, as_=form, **GIVEN) for form in ("infill", "project"))
    points = np.random.default_rng(4).uniform(-12, 12, (1500, 3))
    alike = (winding_numbers(points, one.stages.voids) > 0) == (winding_numbers(points, other.stages.voids) > 0)
    assert alike.mean() > 0.995


@pytest.mark.longest
@pytest.mark.parametrize("name", NAMES)
def test_a_part_far_from_the_origin_has_the_same_tree(name: str) -> None:
    part = box(40, 40, 40)
    one = fill(part, name, **GIVEN).surface
    far = fill(part.copy().apply_translation((1000, -2000, 500)), name, **GIVEN).surface
    assert far.volume == pytest.approx(one.volume, rel=1e-4)


def test_the_catalogue_has_them() -> None:
    assert [each for each in IN_SPACE if each in NAMES] == NAMES
