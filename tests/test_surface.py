"""Layers, stacks and their surfaces."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from shapes import assert_printable, smooth_noise

from infill import GeometryError, ParameterError, Smoothing, Surface, extrude, isosurface, smooth, stack
from infill.inspection.layers import count_layer
from infill.isosurfaces.stacking import layer_count


def ball(radius: float = 12.0, half: int = 16) -> np.ndarray:
    """A ball as a distance, cut off at one cell on both sides; centred on the middle of the grid."""
    x = np.arange(-half, half) + 0.5
    distance = np.sqrt(x[:, None, None] ** 2 + x[:, None] ** 2 + x**2)
    return np.clip(radius - distance, -1, 1)


def test_a_ball_has_the_volume_of_a_ball() -> None:
    mesh = isosurface(ball(), spacing=0.5, origin=(-8, -8, -8))
    assert_printable(mesh)
    exact = 4 / 3 * math.pi * 6**3
    assert mesh.volume == pytest.approx(exact, rel=5e-3)  # chords cut off up to 1/8 of a cell, radius 12 cells
    assert mesh.euler_number == 2
    assert np.linalg.norm(mesh.vertices, axis=1) == pytest.approx(6, abs=0.01)


def test_solid_at_the_edge_is_closed_there() -> None:
    mesh = isosurface(np.ones((2, 3, 4)), spacing=(1, 2, 3), origin=(5, 6, 7))
    assert_printable(mesh)
    # The cut by TIE moves faces by 2.5e-6 of a cell.
    assert mesh.bounds == pytest.approx(np.array([[5, 6, 7], [7, 12, 19]]), abs=1e-4)


@given(seed=st.integers(0, 2**32 - 1), kind=st.sampled_from(["binary", "grey", "coarse"]))
def test_any_field_has_a_closed_surface(seed: int, kind: str) -> None:
    """Also with undecided saddles, exact zeros and solid at every edge."""
    rng = np.random.default_rng(seed)
    f = rng.uniform(-1, 1, (7, 6, 5))
    if kind == "binary":
        f = np.sign(f)
    elif kind == "coarse":
        f = np.round(f * 2) / 2
    assert_printable(isosurface(f))


@pytest.mark.parametrize("unit", [1e-3, 1.0, 25.4])
def test_scaling_all_lengths_scales_the_mesh(unit: float, rng: np.random.Generator) -> None:
    f = smooth_noise(rng, (9, 9, 9))
    plain = isosurface(f, spacing=(1, 2, 3), origin=(1, 1, 1))
    scaled = isosurface(f, spacing=(unit, 2 * unit, 3 * unit), origin=(unit,) * 3)
    assert scaled.vertices == pytest.approx(plain.vertices * unit)
    assert np.array_equal(scaled.faces, plain.faces)


def test_the_level_moves_the_surface() -> None:
    volumes = [isosurface(ball(), level=level).volume for level in (-0.9, -0.3, 0.0, 0.3, 0.9)]
    assert volumes == sorted(volumes, reverse=True)
    # Level c of this field lies at a distance of -c.
    assert volumes[1] == pytest.approx(4 / 3 * math.pi * 12.3**3, rel=5e-3)


@pytest.mark.parametrize(
    ("volume", "options", "says"),
    [
        (np.ones((3, 3)), {}, "three axes"),
        (np.ones((0, 3, 3)), {}, "three axes"),
        (np.ones((2, 2, 2)), {"level": 1}, "level"),
        (np.full((2, 2, 2), np.nan), {}, "NaN"),
        (np.ones((2, 2, 2)), {"origin": (0, 0)}, "origin"),
        (np.ones((2, 2, 2)), {"spacing": -1}, "spacing"),
    ],
)
def test_bad_volumes_are_refused(volume: np.ndarray, options: dict, says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        isosurface(volume, **options)


def test_nothing_solid_is_an_error() -> None:
    with pytest.raises(GeometryError, match="nothing is left"):
        isosurface(-np.ones((3, 3, 3)))
    with pytest.raises(GeometryError, match="nothing is left"):
        extrude(-np.ones((3, 3)), 1)


def test_booleans_are_volumes_too() -> None:
    assert isosurface(np.ones((9, 9, 9), dtype=bool)).volume == pytest.approx(729, rel=0.02)  # cut edges
    assert stack(np.ones((2, 2), dtype=bool), 1)[0, 0].tolist() == [-1, 1, -1]
    assert stack(np.ones((2, 2), dtype=np.int8), 1)[0, 0].tolist() == [-1, 1, -1]


def test_a_stack_has_caps() -> None:
    layer = np.array([[1.0, -1.0], [0.25, 0.5]], dtype=np.float32)
    volume = stack(layer, 3)
    assert volume.shape == (2, 2, 5)
    assert volume.dtype == np.float32
    assert (volume[:, :, [0, -1]] == -1).all()
    assert all(np.array_equal(volume[:, :, i], layer) for i in (1, 2, 3))


@pytest.mark.parametrize("layers", [0, -1, 1.5])
def test_a_stack_needs_layers(layers: float) -> None:
    with pytest.raises(ParameterError, match="number of layers"):
        stack(np.ones((2, 2)), layers)


def test_a_layer_has_two_axes() -> None:
    with pytest.raises(ParameterError, match="holds NaN"):
        extrude(np.array([[1, np.nan], [1, 1]]), 1)
    for bad in (np.ones(3), np.ones((2, 2, 2)), np.ones((0, 2))):
        with pytest.raises(ParameterError, match="two axes"):
            stack(bad, 1)


@pytest.mark.slow
@pytest.mark.parametrize("layers", [1, 2, 5, 40])
@pytest.mark.parametrize("kind", ["smoothed", "binary", "saddles"])
def test_extruding_is_stacking(layers: int, kind: str, rng: np.random.Generator) -> None:
    f = np.sign(smooth_noise(rng, (40, 33)))
    layer = {
        "smoothed": smooth(f),
        "binary": f,
        "saddles": smooth(np.sign(rng.uniform(-1, 1, (40, 33))), Smoothing(steps=1)),
    }
    thickness = 0.3
    short = extrude(layer[kind], layers * thickness, (0.2, 0.25), layer_height=thickness, origin=(1, 2, 3))
    full = isosurface(stack(layer[kind], layers), spacing=(0.2, 0.25, thickness), origin=(1, 2, 3 - thickness))
    assert_printable(short)
    assert short.euler_number == full.euler_number
    assert short.volume == pytest.approx(full.volume, rel=1e-6)
    assert short.bounds == pytest.approx(full.bounds, abs=1e-6)
    if layers >= 2:
        assert len(short.faces) <= len(full.faces)


def test_height_costs_no_triangles(rng: np.random.Generator) -> None:
    layer = smooth(np.sign(smooth_noise(rng, (30, 30))))
    low, high = extrude(layer, 6, 0.15), extrude(layer, 600, 0.15)
    assert np.array_equal(low.faces, high.faces)
    assert high.extents[2] == pytest.approx(600, abs=1e-3)
    assert high.volume == pytest.approx(100 * low.volume, rel=0.01)  # but for the rounded edges, 2 of 80 half layers


def test_the_cap_of_a_weak_wall_is_rounded() -> None:
    """Where phi = v < 1 the top lies v / (1 + v) of a layer above the last centre."""
    layer = np.full((6, 6), 0.5)
    mesh = extrude(layer, 2.0, 1.0)
    assert mesh.bounds[:, 2] == pytest.approx([0.5 - 1 / 3, 1.5 + 1 / 3], abs=1e-4)


@pytest.mark.slow
@given(seed=st.integers(0, 2**32 - 1))
def test_the_layer_predicts_the_euler_number_of_the_mesh(seed: int) -> None:
    rng = np.random.default_rng(seed)
    f = np.sign(rng.uniform(-1, 1, (12, 9)))
    for layer in (f, smooth(f, Smoothing(steps=1)), rng.uniform(-1, 1, (12, 9))):
        mesh = extrude(layer, 3, 1)
        assert mesh.euler_number == 2 * count_layer(layer).euler_number
        assert mesh.body_count == count_layer(layer).components


def test_layer_counts() -> None:
    assert [layer_count(height, 0.15) for height in (0.01, 0.15, 0.2, 6)] == [1, 1, 1, 40]


@pytest.mark.parametrize("height", [0, -1, math.nan, math.inf])
def test_bad_heights_are_refused(height: float) -> None:
    with pytest.raises(ParameterError, match="height"):
        extrude(np.ones((3, 3)), height)
    with pytest.raises(ParameterError, match="layer height"):
        extrude(np.ones((3, 3)), 1, layer_height=height)


def as_surface(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def test_a_surface_measures_itself_as_trimesh_does(rng: np.random.Generator) -> None:
    mesh = isosurface(smooth_noise(rng, (12, 12, 12)), origin=(1000, 0, 0))
    surface = as_surface(mesh)
    assert surface.closed
    assert surface.volume == pytest.approx(mesh.volume)
    assert surface.area == pytest.approx(mesh.area)
    assert surface.euler_number == mesh.euler_number
    assert surface.bounds == pytest.approx(mesh.bounds)
    assert np.array_equal(surface.to_trimesh().faces, mesh.faces)


@pytest.mark.parametrize("harm", ["hole", "turned", "double", "collapsed", "empty"])
def test_a_harmed_surface_is_not_closed(harm: str) -> None:
    faces = np.asarray(trimesh.creation.box().faces).copy()
    if harm == "hole":
        faces = faces[1:]
    elif harm == "turned":
        faces[3] = faces[3, ::-1]
    elif harm == "double":
        faces = np.concatenate([faces, faces])
    elif harm == "collapsed":
        faces[0, 0] = faces[0, 1]
    else:
        faces = faces[:0]
    assert not Surface(vertices=trimesh.creation.box().vertices, faces=faces).closed
