"""What hangs together, what smoothing broke, and how wide walls are."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st
from shapes import smooth_noise

from infill import Grid, ParameterError, Smoothing, extrude, smooth, stamp_lines, wall_width
from infill.inspection.changes import TopologyChanges
from infill.inspection.layers import LayerTopology, compare_layers, count_layer, label_regions, solid_area
from patterns import Honeycomb

NONE = TopologyChanges(pinholes=0, pinhole_share=0.0)


def drawn(text: str) -> np.ndarray:
    """A layer from rows of # and . of equal length."""
    return np.array([[1.0 if c == "#" else -1.0 for c in row] for row in text.split()])


def flooded(inside: np.ndarray, corners: bool) -> int:
    """Count components by walking from cell to cell."""
    left = {tuple(cell) for cell in np.argwhere(inside)}
    steps = [(1, 0), (-1, 0), (0, 1), (0, -1)] + ([(1, 1), (1, -1), (-1, 1), (-1, -1)] if corners else [])
    count = 0
    while left:
        count += 1
        todo = [left.pop()]
        while todo:
            x, y = todo.pop()
            for dx, dy in steps:
                if (x + dx, y + dy) in left:
                    left.remove((x + dx, y + dy))
                    todo.append((x + dx, y + dy))
    return count


@given(seed=st.integers(0, 2**32 - 1), share=st.floats(0.2, 0.8))
def test_counts_are_those_of_a_walk(seed: int, share: float) -> None:
    """On +1 and -1 an undecided saddle is void: solid hangs together at sides, void at corners too."""
    solid = np.random.default_rng(seed).random((11, 13)) < share
    found = count_layer(np.where(solid, 1.0, -1.0))
    assert found.components == flooded(solid, corners=False)
    assert found.holes == flooded(np.pad(~solid, 1, constant_values=True), corners=True) - 1


def test_a_saddle_decides_who_is_joined() -> None:
    strong_solid = np.array([[0.9, -0.1], [-0.1, 0.9]])
    assert count_layer(strong_solid) == LayerTopology(components=1, holes=0)
    assert count_layer(-strong_solid) == LayerTopology(components=2, holes=0)
    assert count_layer(strong_solid[::-1]) == LayerTopology(components=1, holes=0)
    assert count_layer(strong_solid).euler_number == 1


@pytest.mark.parametrize("much", [1e-6, 1e-4])
def test_a_saddle_that_is_all_but_undecided_is_that_of_the_mesh(much: float) -> None:
    """Solid counts 1e-5 less, here as in the surface: what is nearer to a tie is parted."""
    void = -0.5 * (1 - much)
    layer = np.array([[0.5, void], [void, 0.5]])
    mesh = extrude(layer, 3, 1)
    assert count_layer(layer).components == mesh.body_count == (2 if much < 1e-5 else 1)


def test_saddles_join_rings() -> None:
    ring = np.array([[-1, 0.9, -1.0], [0.9, -1, 0.9], [-1, 0.9, -1.0]])
    assert count_layer(ring) == LayerTopology(components=4, holes=0)
    joined = np.where(ring == -1, -0.2, ring)
    assert count_layer(joined) == LayerTopology(components=1, holes=1)


def compare(before: str, after: str) -> TopologyChanges:
    return compare_layers(label_regions(drawn(before)), label_regions(drawn(after)))


RING = """
#########
#.......#
#.......#
#.......#
#.......#
#########
"""


def test_no_change_is_none() -> None:
    assert compare(RING, RING) == NONE


def test_a_broken_ring_is_found() -> None:
    found = compare(RING, RING.replace("#.......#", "#........", 1))
    assert found == dataclasses.replace(NONE, voids_joined=1)


def test_a_wall_that_falls_apart_is_found() -> None:
    wall = ".........\n.#######.\n.#######.\n........."
    assert compare(wall, wall.replace("#######", "###.###")).broken == 1


def test_a_part_that_vanishes_is_found() -> None:
    two = ".........\n.##...##.\n.##...##.\n........."
    assert compare(two, two.replace("...##.", "......")).vanished == 1


def test_parts_that_run_together_are_found() -> None:
    two = ".........\n.##...##.\n.##...##.\n........."
    assert compare(two, two.replace("##...##", "#######")).fused == 1


def test_a_hole_that_closes_is_found() -> None:
    assert compare(RING, RING.replace(".", "#")).voids_closed == 1


def test_a_void_that_is_cut_in_two_is_found() -> None:
    assert compare(RING, RING.replace("#.......#", "#...#...#")).voids_cut == 1


def test_pinholes_are_counted_apart() -> None:
    """Every cell of a void two cells wide touches a wall; what is left of the void is told too."""
    narrow = "##############\n#.......#....#\n#.......#....#\n#########....#\n##############"
    found = compare(narrow, narrow.replace("#.......#", "#########"))
    assert found == dataclasses.replace(NONE, pinholes=1, pinhole_share=14 / 26)


def test_what_is_as_wide_as_a_line_is_no_pinhole() -> None:
    narrow = "#########\n#.......#\n#.......#\n#########"
    before, after = label_regions(drawn(narrow)), label_regions(drawn(narrow.replace(".", "#")))
    assert compare_layers(before, after, line_cells=5) == dataclasses.replace(NONE, pinholes=1, pinhole_share=1.0)
    for line_cells in (1, 2):
        assert compare_layers(before, after, line_cells=line_cells) == dataclasses.replace(NONE, voids_closed=1)


def test_a_neck_that_closes_is_a_pinhole() -> None:
    dumbbell = "###########\n#...###...#\n#.........#\n#...###...#\n###########"
    found = compare(dumbbell, dumbbell.replace("#.........#", "#...###...#"))
    assert found == dataclasses.replace(NONE, pinholes=1)


def test_a_part_out_of_nothing_is_found() -> None:
    empty = ".....\n" * 5
    assert compare(empty, empty[:14] + "#" + empty[15:]).appeared == 1


def test_a_wall_between_narrow_voids_is_a_wall() -> None:
    two = "########\n#..#..##\n#..#..##\n#..#..##\n########"
    assert compare(two, two.replace("#..#..#", "#.....#")).voids_joined == 1


@pytest.mark.slow
@given(seed=st.integers(0, 2**32 - 1))
def test_the_solid_area_is_the_extruded_volume(seed: int) -> None:
    """A tall prism with sharp edges: every layer but the rounded ends has the area of the layer."""
    layer = smooth(np.sign(smooth_noise(np.random.default_rng(seed), (14, 12))))
    assume(count_layer(layer).components)
    low, high = (extrude(layer, height, 1.0, layer_height=1.0).volume for height in (10, 11))
    # Float32, values moved off the level by 2^-10; saddles are joined here and may be parted there.
    assert high - low == pytest.approx(solid_area(layer), rel=2e-3, abs=0.5)


def test_a_new_hole_in_a_wall_is_a_break() -> None:
    solid = "#######\n" * 7
    assert compare(solid, solid[:25] + "." + solid[26:]) == dataclasses.replace(NONE, walls_pierced=1)


def test_what_kills_a_wall_is_seen() -> None:
    """A ring of walls 3 cells thick is whole after 10 steps and gone after 30."""
    f = -np.ones((60, 60))
    f[10:50, 10:50] = 1
    f[13:47, 13:47] = -1
    before = label_regions(f)
    assert compare_layers(before, label_regions(smooth(f, Smoothing(steps=10)))) == NONE
    assert compare_layers(before, label_regions(smooth(f, Smoothing(steps=60)))).vanished == 1


def wall(angle: float, width: float) -> tuple[shapely.MultiLineString, Grid]:
    along = 20 * np.array([math.cos(angle), math.sin(angle)])
    grid = Grid(shape=(200, 200), spacing=0.1, origin=(-10, -10))
    return shapely.MultiLineString([[tuple(-along), tuple(along)]]), grid


@pytest.mark.longest
@given(angle=st.floats(0, math.pi), width=st.floats(0.3, 2.0))
def test_a_straight_wall_has_its_width(angle: float, width: float) -> None:
    lines, grid = wall(angle, width)
    inside = shapely.MultiLineString([lines.geoms[0].intersection(shapely.box(-7, -7, 7, 7))])
    x, y = np.meshgrid(grid.centres(0), grid.centres(1), indexing="ij")
    field = width / 2 - shapely.distance(shapely.points(x, y), lines)
    found = wall_width(inside, field, grid, requested=width)
    # The distance is linear across the edges of the wall: nothing but rounding is left.
    assert found.mean == pytest.approx(width, abs=1e-6)
    assert found.p5 == pytest.approx(width, abs=1e-6)
    assert found.p95 == pytest.approx(width, abs=1e-6)


def test_a_missing_wall_has_no_width() -> None:
    lines, grid = wall(0.3, 0.5)
    found = wall_width(lines, -np.ones(grid.shape), grid, requested=0.5)
    assert (found.mean, found.p5, found.p95) == (0, 0, 0)


def test_half_a_missing_wall_shows_at_the_5th_percentile() -> None:
    lines, grid = wall(0.0, 0.5)
    field = stamp_lines(lines, grid, width=0.5)
    field[100:115] = -1
    found = wall_width(lines, field, grid, requested=0.5)
    assert found.p5 == 0
    assert found.p95 == pytest.approx(0.5, abs=0.01)


def test_nodes_are_left_out() -> None:
    lines = Honeycomb(cell=6, frame=False).lines(shapely.box(-9, -9, 9, 9))
    grid = Grid(shape=(250, 250), spacing=0.08, origin=(-10, -10))
    found = wall_width(lines, stamp_lines(lines, grid, width=0.4), grid, requested=0.4)
    assert found.samples > 50
    assert found.p95 == pytest.approx(0.4, rel=0.03)


def test_lines_with_no_clear_place_have_no_width() -> None:
    lines = shapely.MultiLineString([[(0, 0), (0.2, 0)]])
    grid = Grid(shape=(20, 20), spacing=0.1, origin=(-1, -1))
    found = wall_width(lines, -np.ones(grid.shape), grid, requested=0.5)
    assert found.samples == 0
    assert math.isnan(found.mean)


def test_the_layer_must_be_the_grids() -> None:
    lines, grid = wall(0.0, 0.5)
    with pytest.raises(ParameterError, match="shape"):
        wall_width(lines, np.ones((3, 3)), grid, requested=0.5)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 7, 15, 22.5, 45])
def test_the_exact_stamp_keeps_the_width_through_smoothing(degrees: float) -> None:
    """Five cells across, ten steps: 1 % in the mean, 2 % from the 5th to the 95th percentile."""
    width = 0.45
    grid = Grid(shape=(500, 500), spacing=width / 5, origin=(-22.5, -22.5))
    lines = Honeycomb(angle=degrees).lines(shapely.box(-22.275, -22.275, 22.275, 22.275))
    found = wall_width(lines, smooth(stamp_lines(lines, grid, width=width)), grid, requested=width)
    assert found.samples > 1000
    assert found.mean == pytest.approx(width, rel=0.01)
    assert found.p5 > 0.98 * width
    assert found.p95 < 1.02 * width
