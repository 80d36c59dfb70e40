"""Drains: what they take from a part, how far they stay from its skin, and what they leave closed."""

from __future__ import annotations

from collections import Counter
from itertools import product
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from made_shapes import box, less, rod, together, union
from numpy.typing import NDArray
from typer.testing import CliRunner

from benchmarks import fill_drains
from benchmarks.fill_drains import PARTS, Case, distances, faults, mouth_of, run, tilted
from infill import GeometryError, Surface, UsageError, fill
from infill.cli.app import build_app
from infill.drains.drain_clearance import Skin
from infill.drains.drain_columns import DrainWays, LineLattice, find_crossings, find_ways
from infill.drains.drain_places import TURN_OVER
from infill.drains.drain_plan import DrainPlan, plan_drains
from infill.drains.holes import DrainNeeds
from infill.isosurfaces.components import shell_names
from infill.lattices.drain_holes import DrainedSolid, find_closed_voids
from infill.meshes.distance import TriangleTree

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

QUICK = {"voxel": 0.5, "density": 0.3}
WALL = 1.2


def surface(mesh: Any) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices, dtype=np.float64), faces=np.asarray(mesh.faces))


def plan(part: trimesh.Trimesh, *voids: trimesh.Trimesh, diameter: float, wall: float = WALL, **more: Any) -> DrainPlan:
    needs = DrainNeeds(diameter=diameter, wall=wall, cell=4.0, threads=1)
    return plan_drains(surface(part), surface(together(*voids)), needs, **more)


def inset(x: float, y: float, z: float, wall: float = WALL) -> trimesh.Trimesh:
    """The void of a box with walls all around."""
    return box(x - 2 * wall, y - 2 * wall, z - 2 * wall)


def kinds(found: DrainPlan) -> list[str]:
    return sorted(hole.kind for hole in found.holes)


# --- made parts, judged by the meshes ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def bolted() -> tuple[list[str], dict[str, Any]]:
    """Faults and report of a plate with bolt holes."""
    options = {**QUICK, "pattern": "grid", "density": 0.15}
    wrong, report = run(Case(name="bolted", part=PARTS["bolted"](), drain=2.0, wall=WALL, options=options))
    assert not isinstance(report, str)
    return wrong, report


@pytest.mark.longest
def test_drains_of_a_bolted_plate_keep_the_law(bolted: tuple[list[str], dict[str, Any]]) -> None:
    wrong, report = bolted
    assert wrong == []
    assert report["drains"]["holes"]


@pytest.mark.longest
@pytest.mark.parametrize(
    ("name", "pattern", "drain", "options"),
    [
        ("box", "grid", 3.0, {}),
        ("tower", "grid", 4.0, {"vent": True}),
        ("on its edge", "grid", 2.5, {"density": 0.15}),
        ("arch", "cubic-bars", 3.0, {"cell": 12.0}),
        ("stair", "grid", 2.0, {"vent": True, "density": 0.12}),
    ],
)
def test_drains_of_made_parts_keep_the_law(name: str, pattern: str, drain: float, options: dict[str, Any]) -> None:
    """By manifold3d and trimesh alone: see benchmarks/fill_drains.py, which has over a hundred parts."""
    wrong, report = run(
        Case(name=name, part=PARTS[name](), drain=drain, wall=WALL, options={**QUICK, "pattern": pattern, **options})
    )
    assert wrong == []
    assert not isinstance(report, str)
    assert report["drains"]["holes"]


@pytest.mark.longest
def test_the_judge_finds_holes_where_none_may_be() -> None:
    """Holes through a corner, beside a side and through a void that is not told are planted, and each is found."""
    part, quick = box(24, 24, 16), {"voxel": 0.5, "density": 0.15}
    result = fill(part, "grid", drain=3, wall=WALL, **quick)
    voids = result.stages.voids.to_trimesh()
    case = Case(name="planted", part=part, drain=3, wall=WALL)
    assert list(faults(case, result, voids)) == []

    class Planted:
        def __init__(self, mesh: trimesh.Trimesh, report: dict[str, Any]) -> None:
            self.mesh, self.report = mesh, report

    report = dict(result.report)
    corner = Planted(less(result.mesh, rod(1.5, 30, (11.5, 11.5, 0))), report)
    assert any("skin outside all mouths" in each for each in faults(case, corner, voids))  # type: ignore[arg-type]
    hole = {**report["drains"]["holes"][0], "at": [10.0, 0.1, -8.0], "to": [10.0, 0.1, -5.0], "kind": "drain"}
    listed = {**report, "drains": {**report["drains"], "holes": [*report["drains"]["holes"], hole]}}
    beside = Planted(less(result.mesh, rod(1.5, 6, (10.0, 0.1, -7.0))), listed)
    assert any("from other skin" in each for each in faults(case, beside, voids))  # type: ignore[arg-type]
    shut = fill(part, "grid", wall=WALL, **quick)
    assert any("not told" in each for each in faults(case, shut, voids))


@pytest.mark.slow
def test_the_wall_of_a_hole_is_what_trimesh_measures(bolted: tuple[list[str], dict[str, Any]]) -> None:
    """Exact to a hundredth: points on the mesh of the hole, against triangles of the part."""
    part, (_, report) = PARTS["bolted"](), bolted
    holes = [hole for hole in report["drains"]["holes"] if hole["kind"] == "drain"]
    assert holes
    for hole in holes[:6]:
        at, to = np.array(hole["at"]), np.array(hole["to"])
        other = part.triangles[~mouth_of(part, at, np.array([0.0, 0.0, -1.0]))]
        angle = np.linspace(0, 2 * np.pi, 180, endpoint=False)
        ring = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(180)]) * hole["diameter"] / 2
        points = np.concatenate([at + ring + share * (to - at) for share in np.linspace(0, 1, 12)])
        # A ring of 180 points misses less than a thousandth of a mm; the hole is measured with 0.02 mm to spare.
        assert hole["wall"] == pytest.approx(distances(points, other).min(), abs=0.03)
        assert hole["wall"] >= WALL
    assert report["walls"]["least"] <= min(hole["wall"] for hole in report["drains"]["holes"])


# --- where drains go ---------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("diameter", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("degrees", [0, 10, 30])
def test_a_drain_keeps_diameter_and_wall_from_every_side(diameter: float, degrees: float) -> None:
    part, void = (tilted(each, degrees) for each in (box(20, 16, 12), inset(20, 16, 12)))
    (hole,) = plan(part, void, diameter=diameter).holes
    assert hole.way == pytest.approx([0, 0, -1])
    axis = hole.at + np.linspace(0, 1, 40)[:, None] * (hole.to - hole.at)
    other = part.triangles[~mouth_of(part, hole.at, hole.way)]
    assert distances(axis, other).min() >= diameter / 2 + WALL
    assert hole.clearance >= WALL


@pytest.mark.parametrize("side", range(4))
def test_a_drain_moves_off_a_side_wall(side: int) -> None:
    """The lowest place of the void lies in a corner, where there is no room for a hole."""
    sloped = tilted(box(20, 20, 20), 12, (1, 1, 0) if side % 2 else (1, -1, 0))
    void = tilted(inset(20, 20, 20), 12, (1, 1, 0) if side % 2 else (1, -1, 0))
    turn = trimesh.transformations.rotation_matrix(side // 2 * np.pi, (0, 0, 1))
    for each in (sloped, void):
        each.apply_transform(turn)
    (hole,) = plan(sloped, void, diameter=3.0).holes
    assert hole.clearance >= WALL
    assert 0 < hole.above < 3.0
    # No place that is lower by more than a line of the lattice would do: the hole is as low as the wall lets it be.
    assert hole.clearance < WALL + 3.0 / 6 + 0.1


@pytest.mark.longest
def test_a_drain_passes_beside_a_bolt_hole_that_lies_in_its_way() -> None:
    """Across, below all of the middle of the void: the hole goes down beside it."""
    part = less(
        box(30, 20, 20),
        rod(2, 40, (0, 0, -6)).apply_transform(
            trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0), (0, 0, -6))
        ),
    )
    void = box(8, 16, 8, (0, 0, 4))
    assert plan(part, void, diameter=3.0).undrained  # 8 mm wide, and the bolt hole needs 4 + 2 walls + 3
    wide = box(22, 16, 8, (0, 0, 4))
    (hole,) = plan(part, wide, diameter=3.0).holes
    assert abs(hole.at[0]) >= 2 + WALL + 1.5
    assert hole.clearance >= WALL


def test_no_drain_goes_through_an_edge() -> None:
    """On its edge, a box is lowest there; a hole leaves through one of the faces beside it, a wall from the other."""
    part, void = (tilted(each, 45, (1, 0, 0)) for each in (box(26, 26, 26), inset(26, 26, 26)))
    (hole,) = plan(part, void, diameter=3.0).holes
    assert abs(hole.at[1]) > 1
    other = part.triangles[~mouth_of(part, hole.at, hole.way)]
    assert distances(hole.at[None], other).min() > WALL


def test_a_high_void_gets_no_shaft_through_what_lies_below() -> None:
    """It is joined to the void below, which has a drain: one hole in the skin."""
    part, low, high = box(20, 20, 30), box(17, 17, 12, (0, 0, -7)), box(17, 17, 12, (0, 0, 7))
    found = plan(part, low, high, diameter=3.0)
    assert kinds(found) == ["branch", "drain"]
    (branch,) = (hole for hole in found.holes if hole.kind == "branch")
    assert {branch.void, branch.into} == {0, 1}
    (drain,) = (hole for hole in found.holes if hole.kind == "drain")
    assert drain.to[2] < -7  # it ends in the void that it is for
    assert not found.undrained


@pytest.mark.slow
def test_a_void_that_nothing_reaches_is_told_with_its_place() -> None:
    """Below it lies a slot of the part, nearer than a hole of this width may come to its sides."""
    part = less(box(30, 12, 24), box(40, 2, 3, (0, 0, -6)))
    void = box(20, 5, 6, (0, 0, 5))
    (left,) = plan(part, void, diameter=3.0).undrained
    assert left.at[2] == pytest.approx(2.0)
    assert left.volume == pytest.approx(20 * 5 * 6)
    assert left.fits is None or left.fits < 1  # between the slot and the end of the void there is 1.5 mm


def between(first: str, last: str, said: str) -> str:
    return said.partition(first)[2].partition(last)[0]


def numbers(words: str) -> tuple[float, float, float]:
    x, y, z = (float(each) for each in words.split(","))
    return x, y, z


@pytest.mark.slow
@pytest.mark.parametrize(
    ("part", "voids", "diameter"),
    [
        (box(9, 9, 20), [inset(9, 9, 20)], 6.9),
        (less(box(40, 12, 24), box(50, 8, 3, (0, 0, -6))), [box(34, 9.6, 6, (0, 0, 5))], 6.0),
    ],
)
def test_each_diameter_that_is_said_to_fit_fits(
    part: trimesh.Trimesh, voids: list[trimesh.Trimesh], diameter: float
) -> None:
    """Every one is followed: planned with it, the void has a hole that keeps the wall."""
    left = plan(part, *voids, diameter=diameter).undrained
    assert left
    for each in left:
        if each.fits is not None:
            assert 0.5 <= each.fits < diameter
            then = plan(part, *voids, diameter=each.fits)
            assert each.void not in {other.void for other in then.undrained}
            assert all(hole.clearance >= WALL for hole in then.holes)
    assert plan(box(9, 9, 20), inset(9, 9, 20), diameter=6.9).undrained[0].fits == pytest.approx(5.1)


def test_a_void_that_no_diameter_drains_is_opened_from_the_place_that_is_told() -> None:
    """Nothing leads straight down, and the other void is a thick wall away; from above there is room."""
    part = less(box(30, 20, 24), box(28, 18, 4, (0, 0, -6)))
    void = box(14, 14, 6, (0, 0, 4))
    (left,) = plan(part, void, diameter=3.0).undrained
    assert left.blocked
    assert left.fits is None
    assert left.place is not None
    then = plan(part, void, diameter=3.0, places=(left.place,))
    assert then.undrained == ()
    assert [hole.kind for hole in then.holes] == ["place"]


def test_a_narrower_branch_is_told_with_a_place_that_has_room() -> None:
    """A thin cell at a side has room for half the width beside itself; straight in from there, for all of it."""
    part = box(70, 70, 50)
    large, thin = box(66, 67, 47, (0.5, 0, 0)), box(0.5, 3, 3, (-33.1, 20, 15))
    found = plan(part, large, thin, diameter=2.0)
    assert [hole.diameter for hole in found.narrow] == [1.0]
    assert found.beside is not None
    then = plan(part, large, thin, diameter=2.0, places=(found.beside,))
    assert then.narrow == ()
    assert sorted(hole.void for hole in then.holes) == [0, 1]


def test_a_void_that_is_far_from_the_middle_of_its_large_neighbour_is_joined_to_it() -> None:
    """Of 400 even samples of the large void, none is near a thin cell at its side."""
    part = box(70, 70, 50)
    large, thin = box(66, 67, 47, (0.5, 0, 0)), box(0.5, 3, 3, (-33.1, 20, 15))
    found = plan(part, large, thin, diameter=2.0)
    assert not found.undrained
    assert kinds(found) == ["branch", "drain"]
    (branch,) = (hole for hole in found.holes if hole.kind == "branch")
    assert np.linalg.norm(branch.at - branch.to) < 4  # mm, of walls and radii: it goes straight across
    assert branch.clearance >= WALL


def test_a_narrow_void_beside_a_wall_is_joined_to_its_neighbour() -> None:
    """As cells that the skin cuts off are: too narrow for a hole that keeps the wall."""
    part = box(20, 20, 20)
    narrow, wide = box(1, 17.6, 17.6, (-8.3, 0, 0)), box(15, 17.6, 17.6, (0.5, 0, 0))
    found = plan(part, narrow, wide, diameter=4.0)
    assert kinds(found) == ["branch", "drain"]
    assert all(hole.clearance >= WALL for hole in found.holes)


def test_a_drain_does_not_leave_into_a_closed_cavity() -> None:
    part = less(box(16, 16, 20), box(14, 14, 4, (0, 0, -6)))
    void = box(12, 12, 8, (0, 0, 4))
    assert plan(part, void, diameter=2.0).undrained


@pytest.mark.slow
def test_a_hole_does_not_reach_what_lies_below_its_mouth() -> None:
    """Across a slot that is narrower than a wall lies another part of the skin."""
    part, void = less(box(24, 24, 30), box(30, 18, 0.8, (0, 0, -5))), box(18, 14, 10, (0, 0, 5))
    found = plan(part, void, diameter=3.0)
    for hole in found.holes:
        other = part.triangles[~mouth_of(part, hole.at, hole.way)]
        end = hole.at + hole.out * hole.way
        assert distances(end[None], other).min() > 0.5
    assert found.undrained


def test_vents_are_drains_of_the_part_turned_over() -> None:
    part, void = PARTS["stair"](), box(20, 16, 5, (5, 0, 0))
    up = plan(part, void, diameter=2.0, vent=True)
    assert kinds(up) == ["drain", "vent"]
    over, hollow = part.copy(), void.copy()
    for each in (over, hollow):
        each.vertices = each.vertices @ TURN_OVER
    down = plan(over, hollow, diameter=2.0)
    (vent,) = (hole for hole in up.holes if hole.kind == "vent")
    assert TURN_OVER @ down.holes[0].at == pytest.approx(vent.at)
    assert vent.way == pytest.approx([0, 0, 1])


def test_a_drain_is_where_it_was_asked_for() -> None:
    part, void = box(20, 20, 20), inset(20, 20, 20)
    for place in ((3.0, -2.0, -10.0), (10.0, 1.0, 2.0), (0.0, 0.0, 10.0), (-2.0, -10.0, 4.0)):
        (hole,) = plan(part, void, diameter=3.0, places=(place,)).holes
        assert hole.kind == "place"
        assert hole.at == pytest.approx(np.array(place), abs=1e-3)
        assert hole.way == pytest.approx(np.round(np.array(place) / 10 - 0.01), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("place", "words"),
    [
        ((8.0, 0.0, -10.0), r"leaves 0\.\d+ mm of wall at|runs over"),
        ((0.0, 0.0, 0.0), "10 mm from the skin of the part"),
        ((9.5, 9.5, -10.0), "no void lies straight behind it|runs over"),
        ((10.0, 10.0, -10.0), "no void lies straight behind it|runs over"),
        ((10.0, 8.5, 3.0), "leaves|no void lies|runs over"),
        ((7.0, 7.0, 15.0), "5 mm from the skin of the part"),
    ],
)
def test_a_place_that_leaves_no_wall_is_refused(place: tuple[float, float, float], words: str) -> None:
    """The message names a place that does, and a diameter if one has room: both are followed."""
    part, void = box(20, 20, 20), inset(20, 20, 20)
    with pytest.raises(GeometryError, match=words) as error:
        plan(part, void, diameter=3.0, places=(place,))
    said = str(error.value)
    assert "\n" not in said
    assert said.startswith("drain_at is (")
    (hole,) = plan(part, void, diameter=3.0, places=(numbers(between("; give (", ")", said)),)).holes
    assert hole.clearance >= WALL
    if "or give drains of" in said:
        (thin,) = plan(part, void, diameter=float(between("drains of ", " mm", said)), places=(place,)).holes
        assert thin.clearance >= WALL


def test_a_side_without_a_place_is_said_to_have_none() -> None:
    part, void = box(20, 20, 20), box(1, 1, 16)
    with pytest.raises(GeometryError, match="leave it out: no place that was tried on that side keeps the wall"):
        plan(less(part, box(30, 30, 1, (0, 0, -8.5))), void, diameter=3.0, places=((5.0, 5.0, 10.0),))


# --- the command and the report ----------------------------------------------------------------------------------------


def test_a_drain_wider_than_the_part_is_refused_before_anything_is_computed() -> None:
    with pytest.raises(GeometryError, match=r"drain is 40 mm, and the part is 30 mm wide.*no more than 27\.6"):
        fill(box(30, 30, 30), "grid", drain=40)
    with pytest.raises(GeometryError, match="leave drain out"):
        fill(box(30, 30, 30), "grid", drain=4, wall=16)


@pytest.mark.longest
def test_every_void_that_stays_closed_is_told_with_its_place() -> None:
    part = box(9, 40, 12)
    result = fill(part, "honeycomb", drain=6.5, wall=WALL, **QUICK)
    closed = find_closed_voids(result.surface)
    report = result.report
    assert len(closed) == len(report["voids"]["closed"])
    told = [each for each in report["problems"] if "still sealed" in each]
    assert bool(told) == bool(closed)
    assert {each["void"] for each in report["drains"]["undrained"]} <= set(range(report["voids"]["count"]))
    for each in told:
        assert f"{closed[0][0]:.3g} mm³" in each


def test_options_for_drains_need_a_diameter() -> None:
    for option in ({"vent": True}, {"drain_at": [(0, 0, -10)]}):
        with pytest.raises(UsageError, match="drain is missing"):
            fill(box(20, 20, 20), "grid", **option)
    with pytest.raises(UsageError, match="three numbers"):
        fill(box(20, 20, 20), "grid", drain=2, drain_at=[(0, 0)])


@pytest.mark.slow
def test_the_command_takes_places_and_vents(tmp_path: Path) -> None:
    box(20, 20, 20).export(tmp_path / "part.stl")
    words = ["fill", str(tmp_path / "part.stl"), "--pattern", "cubic-bars", "--cell", "12", "--voxel", "0.5"]
    config = tmp_path / "drains.toml"
    drains = ["--drain", "3", "--vent", "--drain-at", "5,5,-10", "--drain-at=-10,5,5"]
    saved = ["--save-config", str(config), "-o", str(tmp_path / "a.stl")]
    done = CliRunner().invoke(build_app("fill"), [*words, *drains, *saved])
    assert done.exit_code == 0, done.output
    assert "2 drains of 3 mm; 1 vent of 3 mm" in done.output
    again = CliRunner().invoke(build_app("fill"), [*words[:2], "--config", str(config), "-o", str(tmp_path / "b.stl")])
    assert again.exit_code == 0, again.output
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()
    wrong = CliRunner().invoke(
        build_app("fill"), [*words, "--drain", "3", "--drain-at", "1,2", "-o", str(tmp_path / "c.stl")]
    )
    assert wrong.exit_code == 2
    assert not (tmp_path / "c.stl").exists()


# --- lines through a part ----------------------------------------------------------------------------------------------


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(
    corners=arrays(np.int64, st.tuples(st.integers(1, 12), st.just(3), st.just(3)), elements=st.integers(-6, 14)),
    step=st.sampled_from([0.5, 1.0, 2.0]),
)
def test_lines_cross_triangles_where_arithmetic_without_rounding_has_it(
    corners: NDArray[np.int64], step: float
) -> None:
    """Lines through corners and along edges included; coordinates are halves, of which products are exact."""
    lattice = LineLattice(low=np.array([-1.0, 0.5]), step=step, shape=(7, 5))
    soup = Surface(vertices=corners.reshape(-1, 3) / 2, faces=np.arange(3 * len(corners)).reshape(-1, 3))
    line, height, up, face = find_crossings(soup, lattice)
    found = Counter(zip(line.tolist(), height.round(9).tolist(), up.tolist(), face.tolist(), strict=True))
    expected: Counter[tuple[int, float, int, int]] = Counter()
    for (number, (a, b, c)), node in product(enumerate(corners / 2), range(35)):
        x, y = lattice.places(np.array([node]))[0]
        sides = [(p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x) for p, q in ((b, c), (c, a), (a, b))]
        area = sum(sides)
        if area and all(side * area >= 0 for side in sides):
            level = sum(side * p[2] for side, p in zip(sides, (a, b, c), strict=True)) / area
            expected[node, round(float(level), 9) + 0.0, -1 if area > 0 else 1, number] += 1
    assert found == expected
    order = np.lexsort((height, line))
    assert (order == np.arange(len(line))).all() or (np.diff(height)[np.diff(line) == 0] >= 0).all()


@pytest.mark.slow
def test_a_void_without_room_for_a_hole_costs_few_distances(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each hole that is tried is measured by twelve points first: there were two hundred, of every one."""
    asked = []
    nearest = TriangleTree.nearest

    def counted(tree: TriangleTree, points: NDArray[np.floating], **options: Any) -> Any:
        asked.append(len(points))
        return nearest(tree, points, **options)

    monkeypatch.setattr(TriangleTree, "nearest", counted)
    part, void = less(box(24, 24, 30), box(30, 18, 0.8, (0, 0, -5))), box(18, 14, 10, (0, 0, 5))
    assert plan(part, void, diameter=3.0).undrained
    assert sum(asked) < 1_000_000  # with four narrower diameters and five other directions; 10 million before


def test_lines_cross_a_solid_as_often_in_as_out() -> None:
    part = union(PARTS["bracket"](), box(5, 5, 5, (-20, 0, 30)))
    lattice = LineLattice(low=np.array([-30.13, -20.27]), step=0.91, shape=(70, 45))
    line, height, up, face = find_crossings(surface(part), lattice)
    assert (np.bincount(line, weights=up) == 0).all()
    corners = part.triangles[face]
    points = np.column_stack([lattice.places(line), height])
    normal = part.face_normals[face]
    assert np.abs(((points - corners[:, 0]) * normal).sum(axis=1)).max() < 1e-9  # rounding, at 50 mm
    # What lines enclose is the volume, to what lines that are a mm apart see of it.
    assert (-up * height).sum() * lattice.step**2 == pytest.approx(part.volume, rel=0.02)


def test_ways_lead_through_solid_alone() -> None:
    part, voids = box(20, 20, 30), [box(17, 17, 6, (0, 0, -8)), box(17, 17, 6, (0, 0, 4)), box(2, 2, 2, (0, 0, 12))]
    hollow = surface(together(*voids))
    names, _ = shell_names(hollow)
    ways = find_ways(surface(part), hollow, names, LineLattice(low=np.array([-9.9, -9.8]), step=0.7, shape=(29, 29)))
    assert set(ways.void.tolist()) == {0}
    assert ways.skin == pytest.approx(-15.0)
    assert ways.floor == pytest.approx(-11.0)
    assert ways.ceiling == pytest.approx(-5.0)


def test_a_solid_without_drains_is_left_as_it_is() -> None:
    solid = surface(box(4, 4, 4))
    assert DrainedSolid(solid=solid).facts()["holes"] == []


@pytest.mark.parametrize("degrees", [20, 45, 55])
def test_a_mouth_ends_where_its_face_does(degrees: float) -> None:
    """A hole down through a slope, or through a chamfer, is no hole through the edge beside it."""
    part = surface(tilted(box(30, 30, 30), degrees, (0, 1, 0)))
    skin = Skin(part=part)
    lowest = part.vertices[np.argmin(part.vertices[:, 2])]
    faces = np.flatnonzero(skin.leaving)
    assert len(faces)
    at = lowest[:2] + np.array([0.0, 15.0 if lowest[1] < 0 else -15.0])
    low = float(lowest[2])
    way = {
        "line": [0],
        "at": [at],
        "skin": [low],
        "face": faces[:1],
        "void": [0],
        "floor": [low + 4],
        "ceiling": [low + 9],
    }
    ways = DrainWays(**{name: np.asarray(value) for name, value in way.items()})
    shaft = skin.shaft(ways, 0, low + 6, DrainNeeds(diameter=4.0, wall=1.0, cell=4.0, threads=1))
    assert shaft is None or shaft.clearance < 1.0


def test_the_judge_measures_like_manifold() -> None:
    """Its distances are those of manifold3d, between solids."""
    one, other = box(4, 4, 4), rod(1, 4, (5, 1, 0))
    gap = manifold3d.Manifold.min_gap(fill_drains.solid_of(one), fill_drains.solid_of(other), 10.0)
    assert distances(other.vertices, one.triangles).min() == pytest.approx(gap, abs=1e-9)
