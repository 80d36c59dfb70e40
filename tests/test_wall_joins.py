"""Lines of new patterns run into the walls along which they are joined, and still touch them."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import example, given
from hypothesis import strategies as st

from infill.paths.contact import sample_paths
from infill.paths.covering import cover
from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.family import TOUCH
from infill.paths.neighbours import BeadIndex, index_beads
from infill.paths.wall_joins import SHARE, round_wall_joins

WIDTH, OFFSET, SIDE = 0.45, 0.36, 20.0
AREA = shapely.box(0, 0, SIDE, SIDE)


def walls_around() -> BeadIndex:
    ring = np.array(shapely.box(-OFFSET, -OFFSET, SIDE + OFFSET, SIDE + OFFSET).exterior.coords)
    samples = sample_paths(ring, np.array([0, len(ring)]), 0.15)
    return index_beads(samples.points, half=samples.half)


def zigzag(spacing: float, lean: float, lines: int) -> np.ndarray:
    """Lines from side to side, joined along the walls."""
    points = []
    for k in range(lines):
        y = 3 + k * spacing
        ends = [(0.0, y), (SIDE, y + lean)]
        points += ends if k % 2 == 0 else ends[::-1]
    return np.array(points)


def turns(path: np.ndarray) -> np.ndarray:
    step = np.diff(path, axis=0)
    heading = np.arctan2(step[:, 1], step[:, 0])
    return np.abs((np.diff(heading) + np.pi) % (2 * np.pi) - np.pi)


@given(st.floats(1.0, 3.5), st.floats(-0.9, 0.9), st.integers(2, 4))
def test_corners_at_walls_become_curves(spacing: float, lean: float, lines: int) -> None:
    """No corner is left; the path stays in its area, begins and ends where it did, and half of each join touches the wall."""
    path = zigzag(spacing, lean, lines)
    shapely.prepare(AREA)
    (curved,) = round_wall_joins([path], walls_around(), AREA, line_width=WIDTH)
    assert turns(path).max() > 1.4
    assert turns(curved).max() < 0.45
    assert shapely.covers(AREA.buffer(1e-9), shapely.linestrings(curved))
    assert np.array_equal(curved[[0, -1]], path[[0, -1]])
    assert len(np.unique(curved, axis=0)) == len(curved)
    touching = [
        float(np.hypot(*np.diff(p[(p[:, 0] < 1e-9) | (p[:, 0] > SIDE - 1e-9)], axis=0).T)[:1].sum())
        for p in (path[1:3],)
    ]
    along = np.flatnonzero(
        (np.abs(np.diff(curved[:, 0])) < 1e-9) & ((curved[:-1, 0] < 1e-6) | (curved[:-1, 0] > SIDE - 1e-6))
    )
    length = np.hypot(*(curved[along + 1] - curved[along]).T).sum()
    assert length == pytest.approx((lines - 1) * touching[0] * (1 - 2 * SHARE), rel=0.01)


def test_a_curve_replaces_only_what_is_nearly_straight() -> None:
    """Lines that leave a wall at a small angle and then turn away do not cross their neighbours."""
    shapely.prepare(AREA)
    family, walls = FAMILIES["schwarz-d"], walls_around()
    cell = family.cell_for(0.5, WIDTH)
    for z in np.array([0.1, 0.34, 0.66, 0.9]) * cell:
        paths = cover(AREA, family, cell=cell, line_width=WIDTH, z=float(z), layer=0)
        assert shapely.MultiLineString(paths).is_simple
        curved = round_wall_joins(paths, walls, AREA, line_width=WIDTH)
        assert shapely.MultiLineString(curved).is_simple


def test_a_curve_is_tangent_to_both_legs() -> None:
    """Of straight legs that meet at a right angle: a quarter of a circle, to a thousandth of its radius."""
    shapely.prepare(AREA)
    path = np.array([[10.0, 4.0], [0.0, 4.0], [0.0, 8.0], [10.0, 8.0]])
    (curved,) = round_wall_joins([path], walls_around(), AREA, line_width=WIDTH)
    radius = SHARE * 4.0
    on_curve = curved[(curved[:, 0] < radius + 1e-9) & (curved[:, 1] < 4 + radius + 1e-9)]
    assert np.allclose(np.hypot(*(on_curve - [radius, 4 + radius]).T), radius, rtol=1e-3)


def test_a_largest_setback_and_a_radius_of_0_hold() -> None:
    shapely.prepare(AREA)
    path = zigzag(3.0, 0.0, 3)
    walls = walls_around()
    assert np.array_equal(round_wall_joins([path], walls, AREA, line_width=WIDTH, largest=0.0)[0], path)
    (curved,) = round_wall_joins([path], walls, AREA, line_width=WIDTH, largest=0.3)
    assert shapely.hausdorff_distance(shapely.linestrings(curved), shapely.linestrings(path)) <= 0.3 * math.sqrt(2)


@given(st.floats(0.42, 1.5), st.booleans())
@example(0.75, False)
@example(0.75, True)
def test_a_curve_comes_no_nearer_to_other_lines_than_beads_that_touch(inset: float, own: bool) -> None:
    """The tip of a line points into the corner that the curve cuts off: of another path, or of the same one further on."""
    shapely.prepare(AREA)
    gap, tip = TOUCH * WIDTH, np.array([inset, 4 + inset])
    corner = np.array([[10.0, 4.0], [0.0, 4.0], [0.0, 12.0]])
    neighbour = tip + np.array([[4.0, 6.0], [0.0, 0.0], [6.0, 4.0]])
    paths = [np.concatenate([corner, [[4.0, 12.0]], neighbour])] if own else [corner, neighbour]
    curved = round_wall_joins(paths, walls_around(), AREA, line_width=WIDTH, spacing=gap)
    assert len(curved[0]) > len(paths[0])
    line = shapely.linestrings(curved[0][:-5] if own else curved[0])
    assert shapely.distance(line, shapely.linestrings(neighbour)) > gap - 0.002
    free = round_wall_joins(paths, walls_around(), AREA, line_width=WIDTH)[0]
    if inset == 0.75:
        assert shapely.distance(shapely.linestrings(free[:-5] if own else free), shapely.linestrings(neighbour)) < gap


def test_corners_away_from_walls_stay() -> None:
    path = np.array([[5.0, 5.0], [15.0, 5.0], [15.0, 9.0], [5.0, 9.0]])
    shapely.prepare(AREA)
    assert np.array_equal(round_wall_joins([path], walls_around(), AREA, line_width=WIDTH)[0], path)


def test_a_curve_that_would_leave_its_area_is_smaller_or_none() -> None:
    """A line that comes back at the wall: its curve, tangent to it, would cross the wall."""
    path = np.array([[3.0, 9.0], [0.05, 5.2], [0.0, 5.0], [0.0, 9.0], [0.0, 13.0], [9.0, 13.0]])
    shapely.prepare(AREA)
    (curved,) = round_wall_joins([path], walls_around(), AREA, line_width=WIDTH)
    assert shapely.covers(AREA.buffer(1e-9), shapely.linestrings(curved))
