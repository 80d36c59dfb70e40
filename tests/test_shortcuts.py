"""What is measured by a shorter way equals what the long way measures."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest
import shapely
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from infill.meshes.clipped_volume import find_box, volume_in_box
from infill.meshes.distance import TriangleTree
from infill.meshes.solids import shared_volume, to_manifold
from infill.paths.outlines import MOST_BOXES, outline_of
from infill.pixels import interpolate_pixels, label_pixels, open_pixels
from infill.surface import Surface

SIZES = st.floats(0.3, 4.0)
PLACES = st.floats(-2.0, 2.0)


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def box_at(sides, middle) -> Surface:
    return surface_of(trimesh.creation.box(sides).apply_translation(middle))


@given(st.tuples(SIZES, SIZES, SIZES), st.tuples(PLACES, PLACES, PLACES))
def test_the_volume_in_a_box_is_that_of_the_solid_cut_out(sides, middle):
    ring, box = surface_of(trimesh.creation.torus(1.5, 0.6)), box_at(sides, middle)
    cut = (to_manifold(ring) ^ to_manifold(box)).volume()
    assert shared_volume(ring, box) == pytest.approx(cut, abs=1e-9)  # rounding of sums of 2048 terms


def test_a_box_without_sides_holds_everything():
    ball = trimesh.creation.icosphere(3)
    everything = np.full(3, np.inf)
    assert volume_in_box(surface_of(ball), -everything, everything) == pytest.approx(ball.volume, rel=1e-12)


@pytest.mark.parametrize("kind", ["turned", "open", "cut off", "ball", "inside out"])
def test_only_a_box_along_the_axes_is_one(kind):
    box = trimesh.creation.box((2, 3, 4))
    mesh = {
        "turned": box.copy().apply_transform(trimesh.transformations.rotation_matrix(0.1, (0, 0, 1))),
        "open": trimesh.Trimesh(box.vertices, box.faces[1:], process=False),
        "cut off": trimesh.convex.convex_hull(box.vertices[1:]),
        "ball": trimesh.creation.icosphere(1),
        "inside out": trimesh.Trimesh(box.vertices, box.faces[:, ::-1], process=False),
    }[kind]
    assert find_box(surface_of(box)) is not None
    assert find_box(surface_of(mesh)) is None


def test_an_open_surface_shares_no_volume_with_a_box():
    ball = surface_of(trimesh.creation.icosphere(2))
    opened = Surface(vertices=ball.vertices, faces=ball.faces[2:])
    assert math.isnan(shared_volume(opened, box_at((1, 1, 1), (0.5, 0, 0))))


@pytest.mark.parametrize("threads", [1, 2, 3])
@pytest.mark.parametrize("rounded", [False, True])  # to a grid, where many points are equally near
def test_the_least_distance_is_the_least_of_all_distances(threads, rounded, rng):
    points = rng.uniform(-9, 9, (4000, 3))
    points = np.round(points) if rounded else points
    tree = TriangleTree.of(surface_of(trimesh.creation.box((20, 20, 20))))
    distances = tree.nearest(points)[0]
    assert tree.least_distance(points, threads=threads) == (distances.min(), distances.argmin())
    assert tree.least_distance(points, float(distances.min()), threads=threads) == (distances.min(), -1)


@pytest.mark.parametrize("corners", [4, 2 * MOST_BOXES + 3])
def test_no_segment_near_an_outline_is_left_out(corners, rng):
    angle = np.linspace(0.1, 2 * np.pi, corners, endpoint=False)
    around = 10 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    region = shapely.Polygon(around, [shapely.Point(1, 0).buffer(2.0).exterior.coords])
    begin = rng.uniform(-12, 12, (3000, 2))
    end = begin + rng.normal(0, 1, (3000, 2))
    outline = outline_of(region)
    for distance in (0.0, 0.4):
        is_near = shapely.dwithin(shapely.linestrings(np.stack([begin, end], axis=1)), region.boundary, distance)
        chosen = outline.may_reach(begin, end, distance)
        assert chosen[is_near].all()
        assert chosen.mean() < 0.95


@given(st.integers(0, 2**32 - 1))
def test_pixels_are_labelled_opened_and_interpolated_as_scipy_does(seed):
    rng = np.random.default_rng(seed)
    shape = rng.integers(1, 30, 2)
    inside = rng.random(shape) < rng.choice([0.3, 0.6, 0.9])
    labels, count = label_pixels(inside)
    expected, expected_count = ndimage.label(inside)
    assert count == expected_count
    np.testing.assert_array_equal(labels, expected)
    side = int(rng.integers(1, 5))
    np.testing.assert_array_equal(open_pixels(inside, side), ndimage.binary_opening(inside, np.ones((side, side))))
    values, places = rng.normal(size=shape), rng.uniform(-3, 33, (50, 2))
    expected_values = ndimage.map_coordinates(values, places.T, order=1, mode="nearest")
    np.testing.assert_array_equal(interpolate_pixels(values, places), expected_values)


def test_a_block_of_lines_loads_neither_scipy_nor_readers_of_other_formats(tmp_path):
    unneeded = ("scipy", "numba", "infill.formats.threemf_reading", "infill.formats.gltf_reader")
    check = (
        f"import atexit, sys; atexit.register(lambda: print(*(n for n in sys.modules if n.startswith({unneeded})))); "
        "from infill.cli import main; main()"
    )
    words = ["make", "honeycomb", "--size", "20x20", "--no-frame", "-q", "-o", str(tmp_path / "block.stl")]
    answer = subprocess.run([sys.executable, "-c", check, *words], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == ""
