"""Branches below roofs: how they grow and draw back, what carries them and what they carry, and their kernel."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from made_shapes import box
from scipy.ndimage import distance_transform_edt

from infill import ParameterError, UsageError, fill
from infill.interior.interior import Interior, compute_interior
from infill.kernels.layered import distances_to_lines, from_layers
from infill.lattices.choosing import place_pattern
from infill.lattices.grading import UNIFORM_WIDTH as EVEN
from infill.lattices.layered import NonPrismatic
from infill.lattices.request import check_request
from infill.meshes.merging import surface_of
from infill.paths.forest import NONE, Forest
from patterns.errors import PatternError

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

CELL = 4.0
PARTS = {
    "block": lambda: box(40, 30, 25),
    "ball": lambda: trimesh.creation.icosphere(subdivisions=4, radius=18),
    "flat cone": lambda: trimesh.creation.cone(25, 12),
    "ring": lambda: trimesh.creation.annulus(8, 25, 14),
    "lying tube": lambda: trimesh.creation.annulus(9, 16, 30).apply_transform(
        trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0))
    ),
    "two floors": lambda: trimesh.boolean.difference([box(36, 36, 30), box(28, 44, 4, (0, 0, 2))]),
}


def point(*numbers: float) -> np.ndarray:
    return np.array(numbers, dtype=np.float64)


# --- a forest --------------------------------------------------------------------------------------------------------


def test_a_branch_draws_back_from_its_tip_until_it_is_gone() -> None:
    forest = Forest()
    forest.plant(point(5.25, 0), point(0, 0))
    lengths = []
    while len(forest.to):
        (one, other) = forest.branches[0]
        lengths.append(float(np.linalg.norm(one - other)))
        assert (other == 0).all()
        forest.draw_back(1.0)
    assert lengths == pytest.approx([5.25, 4.25, 3.25, 2.25, 1.25, 0.25])


def test_twigs_join_the_nearest_branch_and_it_stays_as_long_as_they_do() -> None:
    forest = Forest()
    forest.plant(point(10, 0), point(0, 0))
    forest.plant(point(6, 7), point(6, 20))
    assert len(forest.branches) == 3
    assert sorted(np.linalg.norm(np.diff(forest.branches, axis=1)[:, 0], axis=1)) == pytest.approx([4, 6, 7])
    for _ in range(5):
        forest.draw_back(1.0)
    # The rest of the trunk beyond the joint is gone, and the twig is 2 long.
    assert sorted(np.linalg.norm(np.diff(forest.branches, axis=1)[:, 0], axis=1)) == pytest.approx([2, 6])
    for _ in range(20):
        forest.draw_back(1.0)
    assert len(forest.at) == 0


def test_a_wall_that_is_as_near_as_a_branch_is_taken() -> None:
    forest = Forest()
    forest.plant(point(10, 0), point(0, 0))
    forest.plant(point(5, 5), point(5, 10))
    assert len(forest.feet) == 2
    forest.plant(point(8, 2), point(8, 10))
    assert len(forest.feet) == 2


def test_what_comes_into_a_wall_stands_there() -> None:
    forest = Forest()
    forest.plant(point(10, 0), point(0, 0))
    forest.plant(point(4, 6), point(4, 20))
    joint = int(np.flatnonzero((forest.at == (4, 0)).all(axis=1))[0])
    inside = np.ones(len(forest.at), dtype=bool)
    inside[forest.feet] = False
    forest.record_inside(inside)
    assert len(forest.feet) == 1
    inside[joint] = False
    forest.record_inside(inside)
    # Two branches end there now, and from there to the old foot it is one of its own, which draws back.
    assert sorted(forest.at[forest.feet].tolist()) == [[0.0, 0.0], [4.0, 0.0]]
    assert len(forest.branches) == 3
    for _ in range(5):
        forest.draw_back(1.0)
    assert forest.at[forest.feet].tolist() == [[4.0, 0.0]]
    assert len(forest.branches) == 2


def test_a_foot_goes_with_its_wall_or_stretches_to_it() -> None:
    forest = Forest()
    forest.plant(point(10, 0), point(0, 0))
    forest.move(int(forest.feet[0]), point(-1, 0), near=2.0)
    assert forest.branches.tolist() == [[[10, 0], [-1, 0]]]
    forest.move(int(forest.feet[0]), point(-6, 1), near=2.0)
    assert len(forest.branches) == 2
    assert forest.at[forest.feet].tolist() == [[-6.0, 1.0]]
    assert (forest.to == NONE).sum() == 1


# --- branches in a part ----------------------------------------------------------------------------------------------


def branches_in(part: trimesh.Trimesh, **more: Any) -> tuple[Interior, list[np.ndarray]]:
    """The inside of a part, and the branches of each of its layers."""
    request = check_request(pattern="lightning", own=more, cell=CELL, line_width=0.8)
    surface = surface_of(part)
    voids, space = place_pattern(request, surface.bounds), compute_interior(surface, wall=1.0, voxel=0.4)
    assert isinstance(voids, NonPrismatic)
    return space, voids.layers.lines(space, CELL)


@pytest.mark.long
@pytest.mark.parametrize("overhang", [30.0, 45.0, 60.0])
@pytest.mark.parametrize("name", PARTS)
def test_every_branch_lies_on_a_branch_or_a_wall_not_much_further_out(name: str, overhang: float) -> None:
    """Point by point: a layer further down there is one within the overhang, of a layer and a cell of the grid."""
    space, layers = branches_in(PARTS[name](), overhang=overhang)
    reach, seen = math.tan(math.radians(overhang)) + 1.0, 0
    for layer in range(1, space.shape[2]):
        if not len(layers[layer]):
            continue
        inside, below = space.depth[:, :, layer] > 0, space.depth[:, :, layer - 1] > 0
        lines = shapely.linestrings(layers[layer])
        points = shapely.get_coordinates(shapely.segmentize(lines, 0.5))
        cells = np.round(points).astype(int)
        points = points[inside[tuple(cells.T)]]
        cells = np.round(points).astype(int)
        wall = (
            distance_transform_edt(below)[tuple(cells.T)] - 0.7
        )  # the wall begins half a diagonal before a cell of it
        carried = np.full(len(points), np.inf)
        if len(layers[layer - 1]):
            carried = shapely.distance(shapely.points(points), shapely.multilinestrings(list(layers[layer - 1])))
        assert np.minimum(wall, carried).max(initial=0) <= reach
        seen += len(points)
    assert seen > 1000


@pytest.mark.slow
@pytest.mark.parametrize("name", PARTS)
def test_roofs_are_carried_about_every_cell(name: str) -> None:
    """From what is flatter than 34 degrees, a branch is within a cell, seen from above.

    Walls are further than one and a half cells there a cell further down. Where the roof slopes, branches may begin a
    little lower.
    """
    space, layers = branches_in(PARTS[name]())
    inside, cell = space.depth > 0, int(CELL / space.size)
    looked = 0
    for layer in range(cell, space.shape[2] - 1):
        roof = inside[:, :, layer] & ~inside[:, :, layer + 1]
        flat = roof & (distance_transform_edt(inside[:, :, layer - cell]) > 1.5 * cell)
        if flat.any():
            lines = shapely.multilinestrings(np.concatenate(layers[layer - cell : layer + 1]))
            away = shapely.distance(shapely.points(np.argwhere(flat)), lines)
            assert away.max() <= cell
            looked += len(away)
    assert looked > 100


@pytest.mark.slow
def test_steep_roofs_need_none() -> None:
    for height in (30, 60):
        _, layers = branches_in(trimesh.creation.cone(16, height))
        assert sum(map(len, layers)) == 0
    _, layers = branches_in(trimesh.creation.cone(16, 9))
    assert sum(map(len, layers)) > 100


@pytest.mark.longest
@pytest.mark.parametrize("name", PARTS)
def test_nothing_hangs_free_and_it_is_light(name: str) -> None:
    given: dict[str, Any] = {"cell": CELL, "line_width": 0.8, "wall": 1.0, "voxel": 0.4}
    result = fill(PARTS[name](), "lightning", **given)
    assert result.report["problems"] == []
    assert result.report["voids"]["islands"] == 0
    assert result.report["density"] < 0.4 * fill(PARTS[name](), "cubic", **given).report["density"]


@pytest.mark.longest
def test_without_a_density_it_is_as_roofs_need_it_and_lighter_than_all_others() -> None:
    part = box(24, 24, 24)
    free = fill(part, "lightning").report
    assert free["request"]["density"] is None
    assert free["infill"]["cell"] == 5.0
    assert free["infill"]["line_width"] == pytest.approx(0.45, rel=0.06)
    assert 0.01 < free["density"] < 0.04
    thick = fill(part, "lightning", density=0.15).report
    assert thick["density"] == pytest.approx(0.15, abs=0.005)
    assert thick["infill"]["cell"] == 5.0
    with pytest.raises(UsageError, match="density and line_width are both given, and lightning has as many branches"):
        fill(part, "lightning", density=0.15, line_width=0.45)
    with pytest.raises(UsageError, match="branches of lightning follow roofs; give one"):
        fill(part, "lightning", density=(0.1, 0.3))
    with pytest.raises(PatternError, match=r"overhang of lightning is 70.*10 to 60"):
        fill(part, "lightning", overhang=70)
    with pytest.raises(ParameterError, match="no parameter 'lean'"):
        fill(part, "lightning", lean=30)


# --- the kernel ------------------------------------------------------------------------------------------------------


def test_the_kernel_is_its_definition() -> None:
    rng = np.random.default_rng(11)
    shape, reach, steepest, half = (19, 23, 12), 6.0, 1.5, 1.3
    depth = rng.uniform(-2, 6, shape).astype(np.float32)
    layers = [rng.uniform(-2, 24, (count, 2, 2)) for count in rng.integers(0, 4, shape[2])]
    first = np.cumsum([0, *map(len, layers)])
    away = np.empty(shape, dtype=np.float32)
    for thread in range(2):
        distances_to_lines(np.concatenate(layers), first, reach, away, thread, 2)
    cells = shapely.points(np.argwhere(np.ones(shape[:2])))
    for layer, lines in enumerate(layers):
        exact = np.full(len(cells), reach)
        if len(lines):
            exact = np.minimum(shapely.distance(cells, shapely.multilinestrings(list(lines))), reach)
        assert away[:, :, layer].ravel() == pytest.approx(exact, abs=1e-4)
    away *= rng.choice(np.float32([-1, 1]), shape)
    padded = np.pad(away, ((0, 0), (0, 0), (1, 1)), mode="edge")
    changes = np.stack([np.abs(padded[:, :, 2:] - away), np.abs(padded[:, :, :-2] - away)])
    slope = np.where(np.abs(away) < reach, np.where(changes <= steepest, changes, 0).max(axis=0), 0)
    out = np.empty_like(depth)
    for sign in (1.0, -1.0):
        wanted = np.where(depth <= -1, depth, np.minimum(sign * away / np.sqrt(1 + slope**2) - half, depth))
        given = (depth, -1.0, away, reach, steepest, sign, half, *EVEN, out)
        count = sum(from_layers(*given, thread, 2) for thread in range(2))
        assert out == pytest.approx(wanted, abs=1e-5)
        assert count == pytest.approx(np.clip(wanted[depth > -1] + 0.5, 0, 1).sum(), rel=1e-4)


@pytest.mark.parametrize("lean", [0.0, 0.4, 1.0])
def test_a_wall_that_leans_is_as_wide_as_one_that_does_not(lean: float) -> None:
    shape, half = (60, 9, 40), 2.0
    places = 10 + lean * np.arange(shape[2])
    segments = np.array([[(x, -9.0), (x, 20.0)] for x in places])
    away = np.empty(shape, dtype=np.float32)
    distances_to_lines(segments, np.arange(shape[2] + 1), 12.0, away, 0, 1)
    deep, out = np.full(shape, np.float32(9)), np.empty(shape, dtype=np.float32)
    from_layers(deep, -1.0, away, 12.0, 1.5, 1.0, half, *EVEN, out, 0, 1)
    x, z = np.meshgrid(np.arange(shape[0]), np.arange(shape[2]), indexing="ij")
    exact = np.abs(x - 10 - lean * z) / math.hypot(1, lean) - half
    near = np.abs(exact) < 1.5
    near[:, [0, -1]] = False
    assert out[:, 4][near] == pytest.approx(exact[near], abs=1e-4)


@pytest.mark.longest
def test_in_a_project_branches_go_through_the_walls_to_the_skin() -> None:
    part = box(40, 40, 30)
    result = fill(part, "lightning", as_="project")
    body = result.surfaces["infill"].to_trimesh()
    assert result.report["problems"] == []
    assert result.report["voids"]["islands"] == 0
    pieces = body.split(only_watertight=False)
    assert len(pieces) > 3
    # Each is at the top, and at a side or the floor: they are where the branches of the solid are.
    for piece in pieces:
        assert piece.bounds[1][2] > 15 - 0.3
        assert np.abs(piece.vertices[:, :2]).max() > 20 - 0.3
