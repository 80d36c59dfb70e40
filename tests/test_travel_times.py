"""Times of a front from an outline: exact where they are known, the same as the NumPy form, and lines that obey them."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from infill.kernels.eikonal import sweep_times
from infill.paths.families.family import PathSpec
from infill.paths.families.nested import ConcentricPaths, GradedRings, RatioMap
from infill.paths.travel_times import find_travel_times, relax_times

WIDTH = 0.45


def lines_of(paths: list[np.ndarray]) -> shapely.MultiLineString:
    return shapely.MultiLineString(paths)


def ratios(low: float, high: float, size: float = 60.0) -> RatioMap:
    """Return ratios that change from left to right."""
    return RatioMap(corner=np.zeros(2), step=size, values=np.array([[low, low], [high, high]]))


@given(seed=st.integers(0, 2**16), rows=st.integers(3, 12), columns=st.integers(3, 12))
def test_the_kernel_repeats_the_formula_until_nothing_changes(seed: int, rows: int, columns: int) -> None:
    random = np.random.default_rng(seed)
    known = random.random((rows, columns)) < 0.2
    known[0, 0] = True
    delay = random.uniform(0.2, 3.0, known.shape)
    start = np.where(known, random.uniform(0, 2, known.shape), np.inf)
    swept = start.copy()
    sweep_times(swept, known, delay, 1e-13)
    relaxed = start
    for _ in range(4 * rows * columns):
        relaxed = relax_times(relaxed, known, delay)
    assert np.isfinite(swept).all()
    assert np.allclose(swept, relaxed, atol=1e-9)


@given(angle=st.floats(0, 90), slowness=st.floats(0.1, 5))
def test_a_front_from_a_straight_wall_takes_as_long_as_it_is_far(angle: float, slowness: float) -> None:
    """Far from the ends of a strip, to rounding: upwind differences are exact for straight fronts."""
    strip = shapely.affinity.rotate(shapely.box(-30, -4, 30, 4), angle, origin=(0, 0))
    times = find_travel_times(strip, lambda points: np.full(len(points), slowness), 0.25)
    x, y = np.meshgrid(
        *(times.corner[axis] + 0.25 * np.arange(times.times.shape[axis]) for axis in (0, 1)), indexing="ij"
    )
    across = -x * math.sin(math.radians(angle)) + y * math.cos(math.radians(angle))
    middle = (np.hypot(x, y) < 8) & (np.abs(across) < 3.4)
    assert (
        np.abs(times.times - slowness * (4 - np.abs(across)))[middle].max() < 0.16 * slowness
    )  # at the ridge, half a step


def test_a_front_that_slows_down_arrives_when_the_integral_says() -> None:
    """In a strip along y, t(x) = ∫ s dx from the nearer wall in time."""
    strip = shapely.box(0, -40, 10, 40)
    times = find_travel_times(strip, lambda points: 1 + points[:, 0] / 10, 0.1)
    x = times.corner[0] + 0.1 * np.arange(times.times.shape[0])
    row = times.times[:, times.times.shape[1] // 2]
    integral = x + x**2 / 20
    exact = np.minimum(integral, 15 - integral)
    inside = (x > 0.05) & (x < 9.95)
    assert np.abs(row - exact)[inside].max() < 0.04


@pytest.mark.parametrize(
    "region",
    [
        shapely.box(0, 0, 40, 40),
        shapely.Point(0, 0).buffer(20, quad_segs=64),
        shapely.box(0, 0, 40, 40).difference(shapely.box(15, 15, 25, 25)),
        shapely.affinity.rotate(shapely.box(0, 0, 40, 30), 17),
    ],
    ids=["box", "disc", "frame", "turned"],
)
def test_without_a_gradient_lines_are_those_of_concentric(region: shapely.Polygon) -> None:
    """To a tenth of a cell where fronts are round, and as long."""
    spec = PathSpec(cell=2.0, line_width=WIDTH)
    plain = ConcentricPaths().strands_inside(region, spec)
    graded = GradedRings(ratios=ratios(1, 1)).strands_inside(region, spec)
    assert len(graded) == len(plain)
    assert lines_of(graded).length == pytest.approx(lines_of(plain).length, rel=0.005)
    assert shapely.hausdorff_distance(lines_of(graded), lines_of(plain)) < 0.2


@settings(max_examples=8)
@given(dense=st.floats(0.5, 2.0), sparse=st.floats(0.5, 2.0), cell=st.floats(1.0, 4.0), seed=st.integers(0, 2**16))
def test_lines_are_as_long_as_the_density_integrates_to_and_keep_their_distance(
    dense: float, sparse: float, cell: float, seed: int
) -> None:
    """The length is ∫ r / cell (coarea formula), but for lines that end in the middle."""
    random = np.random.default_rng(seed)
    angles = np.sort(random.uniform(0, math.tau, 9))
    corners = 30 + (random.uniform(15, 29, 9) * np.stack([np.cos(angles), np.sin(angles)])).T
    region = shapely.Polygon(corners).buffer(0)
    region = max(shapely.get_parts(region), key=lambda part: part.area)
    ratio = ratios(dense, sparse)
    spec = PathSpec(cell=cell, line_width=WIDTH)
    paths = GradedRings(ratios=ratio).strands_inside(region, spec)
    lines = [shapely.LinearRing(path) for path in paths]
    assert all(shapely.covers(region, line) and line.is_simple for line in lines)
    if len(lines) > 1:
        tree = shapely.STRtree(lines)
        first, second = tree.query(lines, predicate="dwithin", distance=0.95 * WIDTH)
        assert (first == second).all()
    nodes = np.stack(np.meshgrid(np.arange(0.25, 60, 0.5), np.arange(0.25, 60, 0.5)), axis=-1).reshape(-1, 2)
    nodes = nodes[shapely.contains_xy(region, nodes[:, 0], nodes[:, 1])]
    wanted = 0.25 * ratio.at(nodes).sum() / cell
    assert (
        -0.08 < sum(line.length for line in lines) / wanted - 1 < 0.01
    )  # sharp corners are cut, and the last line ends
