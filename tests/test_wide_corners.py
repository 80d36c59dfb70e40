"""Laws of corners that are moved outwards before they are rounded."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import example, given
from hypothesis import strategies as st

from infill.paths.contact import TOUCHING
from infill.paths.corner_offset import ASIDE, HAIRPIN
from infill.paths.corners import COARSEST, Machine, round_corners
from infill.paths.curves import MOST_BULGE, recut_curves
from infill.paths.families.family import TOUCH, PathSpec
from infill.paths.families.one_line import HilbertPaths
from infill.paths.neighbours import BESIDE, index_beads
from infill.paths.rounding import Rounding, find_corners
from infill.ragged import concatenate_rows, split_rows
from tests.test_corners_and_curves import length_of, one, turns, walk, walks

WIDTH = 0.45  # mm
NOTHING = index_beads(np.empty((0, 2)))


def taken(
    paths: list[np.ndarray], *, deviation: float = math.inf, wide: bool = True, walls: np.ndarray | None = None
) -> list[np.ndarray]:
    """Return paths of one layer rounded."""
    points, first = concatenate_rows(paths)
    each = np.ones(len(paths))
    found = find_corners(
        points,
        first,
        walls=NOTHING if walls is None else index_beads(walls),
        layer=np.zeros(len(paths), dtype=int),
        acceleration=1000.0 * each,
        speed=80.0 * each,
        corner=9.0,
        line_width=WIDTH,
        wide=wide,
    )
    done = found.rounded(Rounding(deviation=deviation))
    return split_rows(done.points, done.first)


def smallest_radius(path: np.ndarray) -> float:
    """Return the smallest radius of a path of chords: what two chords of equal turn stand for."""
    step = np.hypot(*np.diff(path, axis=0).T)
    return float((np.minimum(step[1:], step[:-1]) / np.maximum(2 * np.tan(np.abs(turns(path)) / 2), 1e-9)).min())


def farthest(path: np.ndarray, other: np.ndarray) -> float:
    """Return how far a path is from another at most, both ways."""
    a, b = shapely.linestrings(path), shapely.linestrings(other)
    ways = ((shapely.get_coordinates(shapely.segmentize(one, 0.01)), two) for one, two in ((a, b), (b, a)))
    return max(float(shapely.distance(shapely.points(points), line).max()) for points, line in ways)


@pytest.mark.longest
@pytest.mark.parametrize("deviation", [0.1, 0.2])
def test_length_is_kept_and_arcs_are_larger(deviation: float) -> None:
    """On Hilbert's curve, at the same distance from it; arcs inside the corners lose a tenth of it."""
    curve = max(
        HilbertPaths().strands((0, 0, 40, 40), PathSpec(cell=3.0, line_width=WIDTH, z=0, layer=0, radius=0)), key=len
    )
    curve = curve[:120]
    wide, plain = (taken([curve], deviation=deviation, wide=wide)[0] for wide in (True, False))
    assert abs(length_of(wide) / length_of(curve) - 1) < 0.25 * (1 - length_of(plain) / length_of(curve))
    assert farthest(wide, curve) <= deviation + COARSEST
    assert smallest_radius(wide[5:-5]) > 1.4 * smallest_radius(plain[5:-5])


@given(path=walks(171, shortest=1.0), deviation=st.floats(0.02, 0.5))
@example(path=walk([(1.0, 0.0), (5.0, 5.0), (1.0, 0.0)]), deviation=0.03125)  # a curve, whose sagitta is 0.055 mm
def test_no_path_moves_farther_than_told(path: np.ndarray, deviation: float) -> None:
    """Both ways: neither is the new path far from the old one, nor any of the old one from the new; ends stay.

    Chords that stand for a curve are not moved, but the curve leaves them by their own sagitta: see `curves`.
    """
    (done,) = taken([path], deviation=deviation)
    if recut_curves(*concatenate_rows([path]), Machine(acceleration=1000.0, speed=80.0, corner=9.0)).curved.any():
        deviation = max(deviation, MOST_BULGE)
    assert np.allclose(done[[0, -1]], path[[0, -1]], atol=0.0006)
    new, old = shapely.linestrings(done), shapely.linestrings(path)
    assert shapely.distance(shapely.points(done), old).max() <= deviation + COARSEST
    sharp = np.flatnonzero(np.abs(turns(path)) < HAIRPIN) + 1
    assert all(shapely.distance(shapely.points(path[sharp]), new) <= deviation + COARSEST)


def waves(apart: float, count: int = 8, side: float = 2.7) -> list[np.ndarray]:
    """Return three lines of a honeycomb, whose level legs lie so many mm apart where they meet, the middle one first."""
    step = side * math.sqrt(3) / 2
    x = np.concatenate([[k * 1.5 * side, k * 1.5 * side + side] for k in range(count)])
    low = np.concatenate([[-step, -step] if k % 2 else [-apart / 2, -apart / 2] for k in range(count)])
    return [np.stack([x, y], axis=1) for y in (low, -low, -2 * step - apart - low)]


@pytest.mark.slow
@given(
    deviation=st.floats(0.02, 0.1),
    angle=st.floats(0, 2 * math.pi),
    apart=st.floats(TOUCH, 1.0).map(lambda share: share * WIDTH),
)
def test_lines_that_touch_stay_in_touch(deviation: float, angle: float, apart: float) -> None:
    """Their common walls stay straight and become longer, and no bead comes nearer to another."""
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    old = [path @ turn.T for path in waves(apart)]
    done = {wide: taken(old, deviation=deviation, wide=wide) for wide in (True, False)}
    touching = {}
    for wide, (one_wave, other, _) in done.items():
        lines = shapely.linestrings(one_wave), shapely.linestrings(other)
        assert shapely.distance(*lines) >= apart - 0.002
        points = shapely.points(shapely.get_coordinates(shapely.segmentize(lines[0], 0.01)))
        touching[wide] = (shapely.distance(points, lines[1]) <= apart + 0.01).mean()
    assert touching[True] > touching[False]
    # The single legs stay above those of the layer below: a sixteenth of a line width, and the chords.
    fine = shapely.get_coordinates(shapely.segmentize(shapely.linestrings(done[True][0]), 0.05))
    height = np.abs((fine @ turn)[:, 1])
    single = fine[(height > apart / 2 + 0.6) & (height < 2.7 * math.sqrt(3) / 2 - 0.6)]
    assert len(single) > 20
    assert shapely.distance(shapely.points(single), shapely.linestrings(old[0])).max() <= ASIDE * WIDTH + 0.003


@given(
    gap=st.floats(1.2, 6.0).map(lambda share: share * WIDTH), deviation=st.one_of(st.just(math.inf), st.floats(0.05, 1))
)
def test_peaks_do_not_run_into_one_another(gap: float, deviation: float) -> None:
    """Corners that point at each other keep room for their beads."""
    x = np.arange(12) * 2.0
    low = np.where(np.arange(12) % 2, 0.0, -2.0)
    old = [np.stack([x, low], axis=1), np.stack([x, gap - low], axis=1)]
    a, b = (shapely.linestrings(path) for path in taken(old, deviation=deviation))
    assert shapely.distance(a, b) >= min(gap, TOUCHING * WIDTH) - 0.002


@given(near=st.floats(0.3, 3.0), deviation=st.floats(0.05, 1.0))
def test_corners_stay_off_walls(near: float, deviation: float) -> None:
    """A corner that is taken wide never comes to lie beside a bead that it did not lie beside."""
    path = np.array([[0.0, 0.0], [4.0, 4.0], [8.0, 0.0], [12.0, 4.0], [16.0, 0.0]])
    wall = np.stack([np.linspace(-2, 18, 2001), np.full(2001, 4.0 + near)], axis=1)
    (done,) = taken([path], deviation=deviation, walls=wall)
    assert done[:, 1].max() <= max(4.0 + near - BESIDE * WIDTH, 4.0) + 0.001


@given(side=st.floats(2.0, 12.0), near=st.floats(0.6, 2.0), share=st.floats(0.05, 0.95), leg=st.integers(0, 2))
def test_legs_stay_off_walls(side: float, near: float, share: float, leg: int) -> None:
    """Nor does a leg that moves with its corners, in a hook, come beside a boss in its middle."""
    path = np.array([[0.0, 0.0], [0.0, side], [side, side], [side, 0.0]])
    outwards = np.array([[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])[leg]
    boss = path[leg] + share * (path[leg + 1] - path[leg]) + near * outwards
    (done,) = taken([path], walls=boss[None])
    assert shapely.distance(shapely.linestrings(done), shapely.points(boss)) >= min(near, BESIDE * WIDTH) - 0.002


def test_plain_rounding_is_the_same_without_room() -> None:
    """A corner between two walls that touch others cannot move: its arc is that of plain rounding."""
    path = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]])
    other = np.array([[0.0, -WIDTH], [5.0 + WIDTH, -WIDTH], [5.0 + WIDTH, 5.0]])
    (done, _) = taken([path, other], deviation=0.1)
    plain = round_corners(*one(path), deviation=0.1, machine=Machine(acceleration=1000.0), unit=0.001)
    assert np.allclose(done, plain.points, atol=0.0011)
