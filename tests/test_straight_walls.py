"""Straight lines of a pattern stamp straight, wherever they lie on the grid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import example, given
from hypothesis import strategies as st
from shapes import BUILT_IN, DESIGNS

from infill import Grid, Smoothing, stamp
from infill.making.request import plan_block
from patterns import PATTERNS
from patterns.linework import sample_points
from patterns.straight import Grid as GridPattern

DEFAULT_BLOCK = {
    "size": (60.0, 60.0),
    "height": 6.0,
    "line_width": 0.45,
    "stamp": "block",
    "cells": None,
    "smoothing": Smoothing(),
    "parameters": {},
}
SAME = 1e-6  # mm between the ends of a line that runs along an axis
NOISE = 1e-12  # of a cell: what turning, clipping and sampling leave


def stamped_bounds(line: np.ndarray, grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Return the lower and upper end of the cells that each column along a line has, for its longer axis."""
    points = sample_points(shapely.MultiLineString([line]), min(grid.spacing) / 2)
    solid = stamp(points, grid, outside="clip") > 0
    along = int(np.argmax(np.ptp(line, axis=0)))
    columns = np.moveaxis(solid, along, 0)
    columns = columns[columns.any(axis=1)]
    return columns.argmax(axis=1), columns.shape[1] - columns[:, ::-1].argmax(axis=1)


def straight_pieces(lines: shapely.MultiLineString, shortest: float) -> list[np.ndarray]:
    """Return the straight pieces that run along an axis and are not short."""
    found = []
    for line in lines.geoms:
        points = np.array(line.coords)
        for start, end in zip(points[:-1], points[1:], strict=True):
            if np.abs(end - start).min() < SAME and np.abs(end - start).max() > shortest:
                found.append(np.array([start, end]))
    return found


DEFAULTS = [PATTERNS[name]() for name in BUILT_IN]


@pytest.mark.long
@pytest.mark.parametrize("pattern", [*DEFAULTS, *DESIGNS], ids=lambda pattern: repr(pattern)[:60])
def test_walls_along_an_axis_have_no_kink(pattern) -> None:
    """By the default block, whose lines lie on borders of cells as often as not; turned by a quarter too."""
    turned = [replace(pattern, angle=pattern.angle + 90)] if hasattr(pattern, "angle") else []
    for each in (pattern, *turned):
        block = plan_block(each, **DEFAULT_BLOCK)
        for piece in straight_pieces(block.lines, 5 * min(block.grid.spacing)):
            low, high = stamped_bounds(piece, block.grid)
            assert np.unique(low).size == np.unique(high).size == 1, f"{each} at {piece.tolist()}"


@given(
    place=st.integers(10, 90),
    angle=st.sampled_from([0, 45, 90, 135]),
    spacing=st.sampled_from([0.15, 0.1, 0.45 / 3, 1 / 3, 7.0]),
    rounding=st.lists(st.floats(-NOISE, NOISE), min_size=8, max_size=8),
)
@example(place=40, angle=45, spacing=0.15, rounding=[-NOISE, NOISE] * 4)
def test_rounding_moves_no_stamp(place: int, angle: int, spacing: float, rounding: list[float]) -> None:
    """A line through the corners of cells, in any rounding of its points, stamps the cells of the exact line."""
    grid = Grid(shape=(100, 100), spacing=spacing)
    steps = np.arange(-8, 9)[:, None] * np.round(np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))]))
    cells = np.full(2, float(place)) + steps
    exact = stamp(cells * spacing + spacing / 1e4, grid, outside="clip")
    rounded = stamp((cells + np.resize(rounding, cells.shape)) * spacing, grid, outside="clip")
    assert np.array_equal(exact, rounded)


def test_a_kink_would_be_seen() -> None:
    grid = Grid(shape=(40, 40), spacing=0.15)
    low, _ = stamped_bounds(np.array([[0.5, 3.0 + 1e-3], [5.5, 3.0 - 1e-3]]), grid)  # 2 µm across a border of cells
    assert np.unique(low).size == 2


@pytest.mark.slow
def test_default_grid_keeps_its_walls_straight_in_the_mesh() -> None:
    """`infill make grid`, all defaults: away from the crossings, every upright wall has one place and one width."""
    from infill import make

    mesh = make("grid").mesh
    section = mesh.section(plane_origin=(0, 0, 3), plane_normal=(0, 0, 1))
    points = np.asarray(section.vertices)[:, :2]
    cell = GridPattern().cell
    middles = np.abs((points[:, 1] / cell) % 1 - 0.5) < 0.2  # halfway between the walls along x
    inside = middles & (np.abs(points[:, 0]) < 29)
    places = np.unique(np.round(points[inside, 0], 3))
    walls = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
    assert len(walls) >= 9
    assert all(np.ptp(wall) < 0.5 for wall in walls), [wall.tolist() for wall in walls]
