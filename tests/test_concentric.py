"""Walls parallel to the outline of a part: where they lie, that they stand upright, and that they hold together."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from made_shapes import ball, box, less, rod, together, union
from test_slabs import asked, in_slabs, surface

from infill import ParameterError, Result, Surface, fill
from infill.interior.interior import compute_interior
from infill.interior.layer_stack import LayerStack
from infill.lattices.choosing import place_pattern
from infill.lattices.drawn_voids import Prismatic, silhouette
from infill.lattices.voids import Layout
from infill.meshes.distance import TriangleTree
from infill.meshes.solids import FINE, manifold_status, to_manifold
from infill.meshes.winding import winding_numbers

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

WALL, CELL, WIDTH = 1.2, 2.5, 0.5
EXACT: dict[str, Any] = {"wall": WALL, "cell": CELL, "line_width": WIDTH, "voxel": 0.25, "tolerance": 0}
SHARP: dict[str, Any] = {**EXACT, "smooth_radius": 0.0}
LINED = shapely.LineString([(-14, 0), (14, 0)])  # the middle of a torus that stands


def torus() -> trimesh.Trimesh:
    return trimesh.creation.torus(14, 6, major_sections=96, minor_sections=48)


def turned_by(mesh: trimesh.Trimesh, degrees: float, axis: tuple[int, int, int]) -> trimesh.Trimesh:
    return mesh.copy().apply_transform(trimesh.transformations.rotation_matrix(np.radians(degrees), axis))


def disc(radius: float) -> shapely.Polygon:
    return shapely.Point(0, 0).buffer(radius, quad_segs=128)


def angled() -> trimesh.Trimesh:
    return union(box(34, 12, 12), box(12, 34, 12, (11, 11, 0)))


PARTS = {
    "ball": ball(14),
    "cone": trimesh.creation.cone(radius=15, height=28, sections=96),
    "torus": torus(),
    "standing torus": turned_by(torus(), 90, (1, 0, 0)),
    "L": angled(),
}
INSIDE = {  # what lies inside the walls, from above
    "box": (box(31, 22, 9), shapely.box(-15.5 + WALL, -11 + WALL, 15.5 - WALL, 11 - WALL)),
    "ring": (less(rod(18, 9), rod(6, 40)), disc(18 - WALL).difference(disc(6 + WALL))),
    "ball": (ball(14), disc(14 - WALL)),
    "torus": (torus(), disc(20 - WALL).difference(disc(8 + WALL))),
    "standing torus": (PARTS["standing torus"], LINED.buffer(6 - WALL, quad_segs=64)),
}


# --- from above -------------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("turned", [0.0, 17.0])
@pytest.mark.parametrize("name", INSIDE)
def test_the_shadow_is_what_lies_inside_the_walls(name: str, turned: float) -> None:
    """Within half a cell, which is at corners, and in area within what polygons of 48 corners lack of their circles."""
    mesh, wanted = INSIDE[name]
    voxel = 0.4
    space = compute_interior(surface(turned_by(mesh, turned, (0, 0, 1))), wall=WALL, voxel=voxel)
    found, wanted = silhouette(space), shapely.affinity.rotate(wanted, turned, origin=(0, 0))
    assert found.area == pytest.approx(wanted.area, rel=0.012)
    assert shapely.hausdorff_distance(found.boundary, wanted.boundary, densify=0.01) < 0.5 * voxel
    assert len(shapely.get_rings(found)) == len(shapely.get_rings(wanted))
    assert silhouette(in_slabs(space)).equals(found)
    assert found.length == pytest.approx(wanted.length, rel=0.02)  # a staircase is longer
    # Where voids reach through the walls, these are no part of it; which corners are left out may differ.
    assert shapely.hausdorff_distance(silhouette(space.through_walls).boundary, found.boundary) < 0.05 * voxel


def test_a_part_with_hardly_any_room_has_no_shadow_and_no_lines() -> None:
    space = compute_interior(surface(box(20, 20, 8)), wall=WALL, voxel=0.4)
    space = replace(space, layers=LayerStack.of(np.minimum(space.depth, np.float32(0.05))))
    assert silhouette(space).is_empty
    voids = place_pattern(asked("concentric", phase=(0, 0)), space.part.bounds)
    assert voids.draw(Layout(space=space, cell=CELL, width=WIDTH)).count == 1


# --- where walls lie --------------------------------------------------------------------------------------------------


def astray(result: Result[Any, Any], inside: shapely.Polygon, away: float, *, height: float) -> np.ndarray:
    """How far points at a height, in rings about the walls or between them, lie on the wrong side, as a share of each.

    Walls end at whole cells from the inner side of the part's, and are `WIDTH` wide.
    """
    x, y = np.random.default_rng(5).uniform(
        np.array(inside.bounds)[:2, None], np.array(inside.bounds)[2:, None], (2, 9000)
    )
    deep = np.where(shapely.contains_xy(inside, x, y), shapely.distance(shapely.points(x, y), inside.boundary), np.nan)
    rings = map(shapely.Polygon, to_manifold(result.stages.voids).slice(height).to_polygons())
    turns = [(1 if ring.exterior.is_ccw else -1) * shapely.contains_xy(ring, x, y) for ring in rings]
    solid = np.sum(turns, axis=0) <= 0
    place = deep % CELL
    wall = (place > CELL - WIDTH + away) & (place < CELL - away)
    void = (place > away) & (place < CELL - WIDTH - away)
    assert min(wall.sum(), void.sum()) > 300
    return np.array([(~solid[wall]).mean(), solid[void].mean()])


@pytest.mark.longest
@pytest.mark.parametrize("name", ["box", "ring", "ball", "torus"])
def test_walls_lie_at_whole_cells_from_the_wall_of_the_part(name: str) -> None:
    """So that every void is as wide; a fifth of a line width is left for the grid and for chords of circles."""
    mesh, inside = INSIDE[name]
    result = fill(mesh, "concentric", **SHARP)
    assert astray(result, inside, 0.1, height=0.0).max() < 0.01


@pytest.mark.longest
def test_walls_that_lie_elsewhere_are_found() -> None:
    mesh, inside = INSIDE["box"]
    result = fill(mesh, "concentric", **SHARP)
    assert astray(result, inside.buffer(-0.3, join_style="mitre"), 0.1, height=0.0).max() > 0.2


@pytest.mark.longest
def test_voids_for_a_slicer_lie_between_the_same_walls() -> None:
    mesh, inside = INSIDE["box"]
    for align in ("part", "body"):
        result = fill(mesh, "concentric", as_="project", align=align, **SHARP)
        assert astray(result, inside, 0.1, height=0.0).max() < 0.01


@pytest.mark.longest
def test_turning_the_part_turns_the_result() -> None:
    one = fill(angled(), "concentric", **EXACT).stages.voids
    other = fill(turned_by(angled(), 33, (0, 0, 1)), "concentric", **EXACT).stages.voids
    assert other.volume == pytest.approx(one.volume, rel=5e-3)
    back = turned_by(other.to_trimesh(), -33, (0, 0, 1)).vertices
    away = TriangleTree.of(one).nearest(np.asarray(back))[0]
    assert np.quantile(away, 0.99) < 0.1
    assert away.max() < 0.5  # in corners


@pytest.mark.longest
@pytest.mark.parametrize("name", PARTS)
def test_walls_stand_upright_from_skin_to_skin(name: str) -> None:
    """Straight above and below what is solid deep inside, all is solid: nothing hangs, nothing needs support."""
    part = PARTS[name]
    result = fill(part, "concentric", **(SHARP | {"voxel": 0.4, "tolerance": 0.01}))
    points = np.random.default_rng(1).uniform(*part.bounds, (8000, 3))
    inside = winding_numbers(points, surface(part)) > 0
    points = points[inside][TriangleTree.of(surface(part)).nearest(points[inside])[0] > WALL + 0.5]
    solid = points[winding_numbers(points, result.stages.voids) <= 0]
    assert len(solid) > 60
    heights = np.linspace(part.bounds[0, 2], part.bounds[1, 2], 40)
    above = np.repeat(solid, len(heights), axis=0)
    above[:, 2] = np.tile(heights, len(solid))
    assert (winding_numbers(above, result.stages.voids) > 0).mean() < 0.002  # by what walls lean in a grid


# --- what fill promises -----------------------------------------------------------------------------------------------


@pytest.mark.longest
@pytest.mark.parametrize(("name", "density"), list(zip(PARTS, (0.15, 0.3, 0.3, 0.15, 0.3), strict=True)))
def test_a_part_is_one_solid_of_the_density_asked_for(name: str, density: float) -> None:
    result = fill(PARTS[name], "concentric", density=density)
    report, solid = result.report, result.surface
    assert report["problems"] == []
    assert report["density"] == pytest.approx(density, abs=0.005)
    assert report["voids"]["islands"] == 0
    assert manifold_status(solid) == FINE
    outer = [each for each in solid.to_trimesh().split(only_watertight=False) if each.volume > 0]
    assert len(outer) == 1


def test_lines_are_about_as_dense_as_their_share_of_a_cell() -> None:
    voids = place_pattern(asked("concentric", phase=(0, 0)), np.array([[0.0, 0, 0], [30, 30, 30]]))
    assert isinstance(voids, Prismatic)
    for density in (0.1, 0.2, 0.5):
        assert voids.widths(density) == pytest.approx(density, rel=0.06)
    assert voids.sample.spacing == 1.0


def test_rings_of_a_box_meet_at_right_angles() -> None:
    space = compute_interior(surface(box(31, 22, 9)), wall=WALL, voxel=0.5)
    voids = place_pattern(asked("concentric", phase=(0, 0)), space.part.bounds)
    assert voids.draw(Layout(space=space, cell=CELL, width=WIDTH)).find_sharpest() == pytest.approx(90, abs=1)


@pytest.mark.longest
def test_every_body_has_its_own_outline() -> None:
    """One above the other: aligned by part, both have that of the two; by body, each has what it has alone."""
    low, high = box(30, 30, 8), box(14, 20, 10, (4, 3, 12))
    alone = [fill(each, "concentric", **SHARP).stages.voids for each in (low, high)]
    shared, own = (fill(together(low, high), "concentric", align=a, **SHARP).stages.voids for a in ("part", "body"))

    def farthest(voids: Surface) -> float:
        points = np.asarray(voids.vertices)
        below = points[:, 2] < 6
        away = (
            TriangleTree.of(each).nearest(points[side])[0] for each, side in zip(alone, (below, ~below), strict=True)
        )
        return float(np.concatenate(list(away)).max())

    assert own.volume == pytest.approx(sum(each.volume for each in alone), rel=0.01)
    assert farthest(own) < 0.15 < 0.8 < farthest(shared)


@pytest.mark.longest
def test_a_density_that_rises_makes_walls_wider() -> None:
    report = fill(box(40, 40, 30), "concentric", density=(0.1, 0.4), by="z").report
    assert report["problems"] == []
    assert report["density"] == pytest.approx(0.25, abs=0.01)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"angle": 20}, "^angle is 20 degrees, and concentric cannot be turned; leave it out$"),
        ({"phase": (1, 2)}, "^phase is 1, 2, 0 mm, and concentric follows the part; leave it out$"),
        (
            {"density": (0.2, 0.4), "by": "skin"},
            "^by is 'skin', and every wall of concentric lies at one depth; choose",
        ),
        ({"phase": (0, 0, 3)}, "^phase is 0, 0, 3 mm, and concentric follows the part; leave it out$"),
    ],
)
def test_what_follows_the_part_is_neither_turned_nor_shifted(given: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        fill(box(20, 20, 20), "concentric", **given)
