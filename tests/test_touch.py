"""Infill that touches walls goes on to touch them, judged by Shapely on walls and paths made by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from plain_touch import measure_plainly

from infill.paths.neighbours import index_beads
from infill.paths.rounding import Rounding, find_corners
from infill.paths.touch import MOST_LOST, REACH, measure_wall_touch, touch_preserving_deviations

WIDTH = 0.45
# What arcs lose where they leave a wall before the slanted leg would have, and chords: 0.47 % at most of 60 such paths.
LEAVING = 0.006
# The rule looks at one reach. Nearer, of paths of which a tenth lies just within: 4.5 % at most of these.
NEARER = 0.05


def wall(y: float = 0.0) -> np.ndarray:
    return np.stack([np.arange(-5.0, 65.0, 0.02), np.full(3500, y)], axis=1)


def waves(rng: np.random.Generator) -> np.ndarray:
    """Return a path that comes down to a wall along y = 0 and leaves it again: with flats along it, and with tips."""
    points, x = [(0.0, 6.0)], 0.5
    while x < 55:
        low, lean, flat = rng.uniform(0.5, 1.3) * WIDTH, rng.uniform(-1.0, 1.0), rng.choice([0.0, rng.uniform(0.3, 4)])
        points.append((x, low))
        if flat:
            x += flat
            points.append((x, low))
        x += abs(lean) + rng.uniform(0.2, 1.5)
        top = rng.uniform(1.2, 6.0)
        points.append((x, top))
        x += rng.uniform(0.3, 2.0)
        if rng.random() < 0.5:
            points.append((x, top))
            x += rng.uniform(0.3, 2.0)
    return np.array(points)


def rounded(path: np.ndarray, *, keep_touch: bool, deviation: float = math.inf) -> np.ndarray:
    corners = find_corners(
        path,
        np.array([0, len(path)]),
        walls=index_beads(wall()),
        layer=np.zeros(1, dtype=np.intp),
        acceleration=np.array([2000.0]),
        speed=np.array([80.0]),
        corner=9.0,
        line_width=WIDTH,
        wide=True,
        keep_touch=keep_touch,
    )
    return corners.rounded(Rounding(deviation=deviation)).points


def touching(path: np.ndarray, reach: float = REACH * WIDTH) -> float:
    near = shapely.box(-10.0, -reach, 70.0, reach)  # a buffer about the wall, without the error of its round ends
    return float(shapely.intersection(shapely.linestrings(path), near).length)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("deviation", [math.inf, 0.1])
def test_a_path_touches_a_wall_along_as_much_of_its_length(seed: int, deviation: float) -> None:
    path = waves(np.random.default_rng(seed))
    before = touching(path)
    assert before > 5
    done = rounded(path, keep_touch=True, deviation=deviation)
    assert len(done) > 1.5 * len(path)  # it was rounded
    assert touching(done) >= (1 - MOST_LOST - LEAVING) * before
    assert touching(done, WIDTH) >= (1 - NEARER) * touching(path, WIDTH)


def test_without_it_touch_is_lost() -> None:
    """The law above can fail: the same paths, rounded as far as their legs allow, lose three times as much."""
    lost = []
    for seed in range(12):
        path = waves(np.random.default_rng(seed))
        lost.append(1 - touching(rounded(path, keep_touch=False)) / touching(path))
    assert max(lost) > 3 * (MOST_LOST + LEAVING)


def test_an_arc_may_reach_to_where_its_leg_comes_to_touch() -> None:
    """A corner 2 mm above a wall, on a leg that goes straight down to it: its arc ends before the leg touches."""
    path = np.array([[0.0, 2.0], [5.0, 2.0], [5.0, 0.3]])
    walls = index_beads(wall())
    layer = np.zeros(3, dtype=np.intp)
    (most,) = touch_preserving_deviations(path, np.array([0, 3]), np.array([1]), layer, walls, line_width=WIDTH)
    assert most == pytest.approx((2 - REACH * WIDTH) * math.tan(math.pi / 8), rel=1e-3)


def test_corners_far_from_walls_may_move_as_they_like() -> None:
    path = np.array([[0.0, 9.0], [5.0, 9.0], [5.0, 4.0]])
    for walls in (index_beads(wall()), index_beads(np.empty((0, 2)))):
        (most,) = touch_preserving_deviations(
            path, np.array([0, 3]), np.array([1]), np.zeros(3, dtype=np.intp), walls, line_width=WIDTH
        )
        assert most == math.inf


@pytest.mark.parametrize("walls", [0, 1, 400])
@pytest.mark.parametrize("seed", range(9))
def test_compiled_touch_is_that_of_numpy(seed: int, walls: int) -> None:
    """Of short and long legs, inside and outside the box around the walls, in layers with walls and without."""
    random = np.random.default_rng(seed)
    paths = [
        random.random(2) * 20 + np.cumsum(random.normal(0, random.choice([0.05, 0.5, 3.0]), (count, 2)), axis=0)
        for count in random.integers(2, 40, 12)
    ]
    first = np.append(0, np.cumsum([len(path) for path in paths]))
    layer = np.repeat(random.integers(0, 4, len(paths)), np.diff(first))
    beads = index_beads(random.random((walls, 2)) * 20, np.sort(random.integers(0, 3, walls)))
    names = ("amount", "begins", "ends", "near")
    plain = measure_plainly(np.concatenate(paths), first, layer, beads, REACH * WIDTH)
    compiled = measure_wall_touch(np.concatenate(paths), first, layer, beads, REACH * WIDTH)
    assert plain[0].any() == (walls > 1)
    for name, one, other in zip(names, compiled, plain, strict=True):
        np.testing.assert_array_equal(one, other, err_msg=name)
