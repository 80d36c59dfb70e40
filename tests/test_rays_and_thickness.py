"""Rays that leave a solid, and the thinnest walls that they find."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from infill import Grid, Smoothing, smooth_mesh
from infill.inspection.rays import length_inside
from infill.inspection.thickness import thinnest_walls
from infill.inspection.width import wall_width
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.kernels.rays import sample_rays
from infill.phasefield.sparse import smooth_bricks

UNIT = (1.0, 1.0, 1.0)


def thinnest(solid: NDArray[np.bool_], spacing: tuple[float, ...] = UNIT, steps: int = 0) -> float | None:
    """Return the thinnest wall of a solid as it stands, and see that the data say the same."""
    field = smooth_bricks(solid, Smoothing(steps=steps), spacing=spacing)
    data, result = thinnest_walls(field, extract_bricks(field, spacing=spacing), spacing)
    assert steps or data == pytest.approx(result, abs=0.3 * min(spacing))
    return result


def ball(radius: float) -> NDArray[np.bool_]:
    side = math.ceil(2 * radius) + 10
    return ((np.indices((side,) * 3) - (side - 1) / 2) ** 2).sum(axis=0) < radius**2


@pytest.mark.slow
@pytest.mark.parametrize("cells", range(1, 31))
def test_a_slab_is_as_thick_as_it_is(cells: int) -> None:
    """To the last digit up to 16 cells; what is thicker is no wall."""
    slab = np.zeros((50, 44, cells + 10), dtype=bool)
    slab[:, :, 5 : 5 + cells] = True  # over the edge of the grid: no narrow sides
    assert thinnest(slab) == (cells if cells <= 16 else None)
    assert thinnest(slab, (0.25,) * 3) == (cells / 4 if cells <= 16 else None)


@pytest.mark.slow
@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("cells", [3, 7, 12, 20])
def test_a_slab_of_cells_of_three_lengths(cells: int, axis: int) -> None:
    """The reach is 16 cells of the shortest side, and so are the steps of a quarter."""
    spacing = np.roll([0.5, 0.8, 1.1], axis)
    shape = np.roll([cells + 10, 40, 40], axis)
    slab = np.zeros(shape, dtype=bool)
    slab[tuple(slice(5, 5 + cells) if a == axis else slice(None) for a in range(3))] = True
    thick = cells * 0.5
    assert thinnest(slab, tuple(spacing.tolist())) == (pytest.approx(thick) if thick <= 8 else None)


@pytest.mark.parametrize("radius", [3, 4, 5, 6, 7])
def test_a_small_ball_is_as_thick_as_it_is_wide(radius: float) -> None:
    assert thinnest(ball(radius), steps=3) == pytest.approx(2 * radius, abs=1.5)


@pytest.mark.slow
@pytest.mark.parametrize("radius", [10, 12, 16, 17, 20, 33, 60])
def test_a_large_ball_has_no_walls(radius: float) -> None:
    assert thinnest(ball(radius), steps=5) is None
    assert thinnest(ball(radius), (0.2, 0.2, 0.3), steps=5) is None


@pytest.mark.slow
def test_a_ball_of_320_mm_has_no_walls() -> None:
    report = smooth_mesh(trimesh.creation.icosphere(4, radius=160), voxel=4.0, tolerance=None).report
    assert report["walls"]["thinnest"] == {"data": None, "result": None}


@pytest.mark.slow
@pytest.mark.parametrize("cells", [4, 8, 12, 14, 18, 24])
@pytest.mark.parametrize("scale", [1.0, 0.05])
def test_a_shell_around_a_void(cells: int, scale: float) -> None:
    """The staircases of both its sides make its thinnest hundredth up to a cell thinner."""
    shell = ball(36)
    inner = ball(36 - cells)
    margin = (len(shell) - len(inner)) // 2
    shell[(slice(margin, margin + len(inner)),) * 3] &= ~inner
    found = thinnest(shell, (scale,) * 3, steps=3)
    assert found is None if cells > 16 else cells - 1.3 <= found / scale <= cells + 0.3


def test_one_thin_wall_of_a_thick_part_is_found() -> None:
    part = np.zeros((70, 70, 60), dtype=bool)
    part[5:65, 5:65, 5:45] = True
    part[20:25, 5:65, 45:58] = True
    assert thinnest(part) == 5


@pytest.mark.parametrize("dimensions", [1, 2, 3, 4])
def test_rays_from_the_middle_of_a_ball(dimensions: int, rng: np.random.Generator) -> None:
    direction = rng.normal(size=(50, dimensions))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    middle = np.zeros((50, dimensions))

    def ball(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return 3.3 - np.linalg.norm(points, axis=1)

    assert length_inside(ball, middle, direction, np.arange(0, 5, 0.25)) == pytest.approx(3.3)
    assert np.isinf(length_inside(ball, middle, direction, np.arange(0, 3, 0.25))).all()
    outside = length_inside(ball, middle - 3.5 * direction, direction, np.arange(0, 9, 0.25))
    assert (outside == 0).all()  # it begins in the void
    late = length_inside(ball, middle - 3.5 * direction, direction, np.arange(0, 9, 0.25), leeway=1)
    assert late == pytest.approx(6.6)


@pytest.mark.parametrize("steps", [0, 3])
def test_rays_through_bricks_find_what_the_whole_field_says(steps: int, rng: np.random.Generator) -> None:
    """Bricks that are kept, solid and void ones, and what lies beyond the grid."""
    spacing = np.array([0.5, 0.8, 1.1])
    solid = ball(20)
    solid[:, :6] = True
    field = smooth_bricks(solid, Smoothing(steps=steps), spacing=tuple(spacing.tolist()))
    whole = field.to_dense()
    start = rng.uniform(-3, np.array(whole.shape) * spacing + 3, (500, 3))
    direction = rng.normal(size=start.shape)
    distance = np.arange(0, 12, 0.25)
    found = np.empty((len(start), len(distance)))
    for values, level in ((field.values, 0.1), (field.data, 0.0)):
        sample_rays(field.slots, values, field.shape, start, direction, distance, spacing, level, found)
        cells = np.floor((start[:, None] + distance[:, None] * direction[:, None]) / spacing).astype(int)
        inside = ((cells >= 0) & (cells < whole.shape)).all(axis=2)
        dense = whole if values is field.values else np.where(solid, 1.0, -1.0)
        expected = np.full(inside.shape, -1.0)
        expected[inside] = np.where(dense[tuple(cells[inside].T)] > level, 1.0, -1.0)
        assert 0.1 < (expected > 0).mean() < 0.9
        assert np.array_equal(found, expected)


def test_the_width_of_a_wall_between_cells_is_exact() -> None:
    """A layer that is linear across a wall: the zeros lie where the line between two centres crosses 0."""
    import shapely

    grid = Grid(shape=(80, 60), spacing=0.1)
    x = np.arange(80)[:, None] * 0.1 + 0.05 + np.zeros((80, 60))
    layer = np.clip((0.47 - np.abs(x - 4.03)) / 0.5, -1, 1)
    lines = shapely.MultiLineString([[(4.03, 0.5), (4.03, 5.5)]])
    found = wall_width(lines, layer, grid, requested=0.9)
    assert found.mean == pytest.approx(0.94, abs=1e-9)
    assert wall_width(lines, np.ones((80, 60)), grid, requested=0.9).mean == pytest.approx(2 * 0.9 * 2, rel=0.05)
    assert wall_width(lines, -np.ones((80, 60)), grid, requested=0.9).mean == 0
