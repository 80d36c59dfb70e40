"""Laws of the lines of a level set: where they lie, what they part, and that no grid shows."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import box
from shapes import REGIONS, Ripples, SchwarzP, assert_printable

import patterns.contours
from infill import make
from patterns import Pattern, PatternError
from patterns.contours import zero_lines

ON_THE_SET = 1e-6  # mm; a step of 0.2 mm halved 26 times is 3e-9
EDGE = 1e-9  # mm: clipping computes the cut points

every_level_set = pytest.mark.parametrize(
    ("pattern", "z"),
    [
        (Ripples(frame=False), 0.0),
        (Ripples(frame=False, cell=7, angle=23, phase=(1.0, -2.0)), 3.0),
        (SchwarzP(), 0.0),
        (SchwarzP(), 2.0),
        (SchwarzP(cell=9.3), 4.0),
    ],
    ids=repr,
)
every_region = pytest.mark.parametrize("region", REGIONS, ids=["square", "rectangle", "disc", "notched"])


def distance_to_the_zero_set(pattern: Pattern, points: np.ndarray, z: float) -> np.ndarray:
    """Return how far points lie from the zero set, to first order, mm."""

    def value(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return pattern.level_set(x, y, np.full(len(x), z))

    (x, y), step = points.T, 1e-5
    along_x = (value(x + step, y) - value(x - step, y)) / (2 * step)
    along_y = (value(x, y + step) - value(x, y - step)) / (2 * step)
    return np.abs(value(x, y)) / np.hypot(along_x, along_y)


def test_the_distance_to_the_zero_set_can_be_large() -> None:
    far = distance_to_the_zero_set(Ripples(swing=0), np.array([[3.0, 0.01], [1.0, 5.0]]), 0.0)
    assert far == pytest.approx([0.01, 0], abs=1e-6)


@pytest.mark.slow
@every_level_set
@every_region
def test_corners_lie_on_the_zero_set_inside_the_region(pattern: Pattern, z: float, region: shapely.Polygon) -> None:
    lines = pattern.lines(region, z)
    assert lines.length > 0
    assert region.buffer(EDGE).contains(lines)
    corners = shapely.get_coordinates(lines)
    cut = shapely.distance(region.exterior, shapely.points(corners)) < EDGE
    assert distance_to_the_zero_set(pattern, corners[~cut], z).max() < ON_THE_SET
    # Where the region cuts a chord, the cut lies as far from the curve as the chord: spacing / 2000 and a bit.
    assert distance_to_the_zero_set(pattern, corners[cut], z).max(initial=0) < pattern.line_spacing(region) / 500


@pytest.mark.slow
@every_level_set
@every_region
def test_lines_end_at_the_region_only_and_never_cross(pattern: Pattern, z: float, region: shapely.Polygon) -> None:
    lines = pattern.lines(region, z)
    assert lines.is_simple
    ends = [line.boundary for line in lines.geoms if not line.is_ring]
    assert all(
        region.exterior.distance(shapely.Point(end)) < EDGE for pair in ends for end in shapely.get_coordinates(pair)
    )


@pytest.mark.slow
@every_level_set
def test_lines_part_the_colours(pattern: Pattern, z: float, rng: np.random.Generator) -> None:
    """Between two places of different sign runs a line, and an odd number of them; else an even number."""
    region = REGIONS[0]
    lines = pattern.lines(region, z)
    one, other = rng.uniform(-29, 29, (2, 400, 2))
    near = pattern.line_spacing(region) / 500  # what lies between chord and curve
    clear = [shapely.distance(shapely.points(each), lines) > near for each in (one, other)]
    one, other = one[clear[0] & clear[1]], other[clear[0] & clear[1]]
    assert len(one) > 300
    signs = [pattern.level_set(*each.T, np.full(len(each), z)) > 0 for each in (one, other)]
    crossings = shapely.intersection(shapely.linestrings(np.stack([one, other], axis=1)), lines)
    odd = shapely.get_num_geometries(crossings) % 2 == 1
    odd &= ~shapely.is_empty(crossings)
    assert np.array_equal(odd, signs[0] != signs[1])


@pytest.mark.slow
@given(
    z=st.floats(-20, 20),
    x=st.floats(-20, 20),
    y=st.floats(-20, 20),
)
def test_a_ball_is_cut_in_circles(z: float, x: float, y: float) -> None:
    radius = 21.0
    if math.hypot(0, z) > 20.5:
        return

    def ball(px: np.ndarray, py: np.ndarray, pz: np.ndarray) -> np.ndarray:
        return radius - np.sqrt((px - x) ** 2 + (py - y) ** 2 + pz**2)

    (circle,) = zero_lines(ball, (-50, -50, 50, 50), z, 8.0)
    assert circle.is_ring
    cut = math.sqrt(radius**2 - z**2)
    assert np.hypot(*(shapely.get_coordinates(circle) - (x, y)).T) == pytest.approx(cut, abs=ON_THE_SET)
    # Chords of up to 0.35 mm on a radius of 6 mm or more are shorter than their arcs by (0.35 / 6)² / 24.
    assert circle.length == pytest.approx(2 * math.pi * cut, rel=2e-4)


@pytest.mark.slow
@pytest.mark.parametrize(
    "function", [lambda x, y, z: np.sin(math.pi * x / 3), lambda x, y, z: np.sin(math.pi * x / 3) + 0 * y]
)
def test_straight_lines_are_straight(function: Callable[..., np.ndarray]) -> None:
    """Zeros at the multiples of the step, where rounding has the sign of a sine."""
    lines = zero_lines(function, (-30, -30, 30, 30), 0.0, 3.0)
    assert len(lines) == 21
    for line in lines:
        x = shapely.get_coordinates(line)[:, 0]
        assert x == pytest.approx(3 * round(x[0] / 3), abs=ON_THE_SET)


@pytest.mark.parametrize("shift", [-1e-4, 1e-4])
def test_a_saddle_is_joined_as_the_function_is(shift: float) -> None:
    lines = zero_lines(lambda x, y, z: x * y - shift, (-1, -1, 1, 1), 0.0, 3.0)
    assert len(lines) == 2
    for line in lines:
        x, y = shapely.get_coordinates(line).T
        assert len(np.unique(np.sign(x))) == len(np.unique(np.sign(y))) == 1
        assert (x * y * shift > 0).all()


def test_the_region_does_not_move_the_lines() -> None:
    pattern = Ripples(frame=False)
    inner = box(-11.3, -7.7, 4.1, 9.9)
    cut = pattern.lines(REGIONS[0]).intersection(inner)
    assert shapely.hausdorff_distance(pattern.lines(inner), cut) < EDGE


@pytest.mark.slow
def test_a_large_grid_is_taken_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = SchwarzP().lines(REGIONS[0], 1.0)
    monkeypatch.setattr(patterns.contours, "NODES_AT_ONCE", 1000)
    assert SchwarzP().lines(REGIONS[0], 1.0).equals(whole)


def test_turned_and_shifted_waves_are_turned_and_shifted() -> None:
    small = box(-12, -12, 12, 12)
    plain = Ripples(frame=False).lines(REGIONS[0])
    moved = Ripples(frame=False, angle=30, phase=(3.0, -1.0)).lines(REGIONS[0])
    turned = shapely.affinity.rotate(plain, 30, origin=(0, 0))
    expected = shapely.affinity.translate(turned, 3, -1).intersection(small)
    # Both are chords of the same curves: a step of 0.14 mm, squared, over 8 radii of 6.7 mm; twice.
    assert shapely.hausdorff_distance(moved.intersection(small), expected) < 2e-3


@pytest.mark.slow
def test_the_frame_is_added_to_the_lines_of_a_level_set() -> None:
    for region in REGIONS:
        bare, framed = (Ripples(frame=frame).lines(region) for frame in (False, True))
        assert framed.length == pytest.approx(bare.length + region.length)


def test_height_changes_what_is_not_prismatic() -> None:
    low, high = (SchwarzP().lines(REGIONS[0], z) for z in (0.0, 4.5))
    assert not low.equals(high)
    assert SchwarzP().lines(REGIONS[0], 12.0).equals_exact(low, ON_THE_SET)  # a period higher


def test_nothing_is_found_where_nothing_is() -> None:
    assert len(zero_lines(lambda x, y, z: np.ones_like(x), (0, 0, 1, 1), 0.0, 0.3)) == 0


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_level_set_is_a_number_everywhere(value: float) -> None:
    with pytest.raises(PatternError, match="no finite value"):
        zero_lines(lambda x, y, z: np.where(x > 0, value, 1.0), (-1, -1, 1, 1), 0.0, 0.5)


@pytest.mark.parametrize("spacing", [0, -1, math.nan, math.inf])
def test_a_bad_spacing_of_lines_is_refused(spacing: float) -> None:
    with pytest.raises(PatternError, match="the spacing of lines is"):
        zero_lines(lambda x, y, z: x, (-1, -1, 1, 1), 0.0, spacing)


@pytest.mark.slow
@pytest.mark.parametrize("stamp", ["block", "exact"])
def test_a_block_is_made_of_a_level_set(stamp: str) -> None:
    result = make(Ripples(), size=30, height=3, stamp=stamp)
    assert_printable(result.mesh)
    assert result.report["request"]["pattern"] == "ripples"
    assert result.report["problems"] == []


@pytest.mark.longest
def test_what_changes_with_height_is_a_block_too() -> None:
    block = make(SchwarzP(), size=8, height=4, density=0.3)
    assert block.surface.closed
    assert block.report["density"] == pytest.approx(0.3, abs=0.005)
