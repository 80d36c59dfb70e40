"""Pictures: the mesh renderer and the four stages."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from infill import FormatError, Surface, make
from infill.pictures.preview import preview, save_preview
from infill.pictures.render import render

WHITE = 255


def surface(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def test_a_square_seen_from_above_is_a_square() -> None:
    picture = render(
        surface(trimesh.creation.box((10, 10, 10))), width=100, height=100, elevation=math.pi / 2, azimuth=0
    )
    covered = (picture != WHITE).any(axis=2)
    assert covered.sum() == pytest.approx((0.94 * 100) ** 2, rel=0.03)
    assert covered[50, 50]
    assert not covered[1, 1]


def test_the_nearer_face_hides_the_farther() -> None:
    """A small box above a large one, seen from above, in whatever order they come."""
    large, small = trimesh.creation.box((10, 10, 1)), trimesh.creation.box((4, 4, 1))
    small.apply_translation((0, 0, 3))
    small.apply_transform(trimesh.transformations.rotation_matrix(0.3, (1, 0, 0), (0, 0, 3)))
    pictures = [
        render(surface(trimesh.util.concatenate(order)), width=80, height=80, elevation=math.pi / 2, azimuth=0)
        for order in ([large, small], [small, large])
    ]
    assert np.array_equal(*pictures)
    assert not np.array_equal(pictures[0][40, 40], pictures[0][40, 10])


def test_faces_seen_from_behind_are_not_drawn() -> None:
    triangle = Surface(vertices=np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), faces=np.array([[0, 2, 1]]))
    assert (render(triangle, width=20, height=20, elevation=math.pi / 2) == WHITE).all()


def test_many_fragments_are_drawn_some_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    ball = surface(trimesh.creation.icosphere(subdivisions=3))
    whole = render(ball, width=60, height=60)
    monkeypatch.setattr("infill.pictures.render.FRAGMENTS_AT_ONCE", 50)
    assert np.array_equal(render(ball, width=60, height=60), whole)


def test_the_preview_shows_four_stages(tmp_path: Path) -> None:
    result = make("honeycomb", size=(40, 20))
    path = save_preview(result, tmp_path / "stages.png")
    with Image.open(path) as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    panels = np.array_split(pixels, 4, axis=1)
    assert pixels.shape[1] > 3 * pixels.shape[0]
    for panel in panels:  # each stage has ink of its own
        assert (panel.min(axis=2) < 200).mean() > 0.01
    red = (pixels[..., 0] > 150) & (pixels[..., 1:].max(axis=2) < 80)
    assert [bool(part.any()) for part in np.array_split(red, 4, axis=1)] == [False, False, True, False]


def test_y_points_up() -> None:
    """The tip of the heart, at the lower left, is drawn at the lower left."""
    sheet = np.asarray(preview(make("concentric-heart", hearts=1, size=40)).convert("L")).astype(int)
    panel = sheet[34:454, 14:434] < 100
    assert panel[-40:, :40].any()
    assert not panel[:40, -40:].any()


@pytest.mark.parametrize("name", ["x.jpg", "x", "x.stl"])
def test_only_png_is_written(name: str, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"ends in \.png"):
        save_preview(make("honeycomb", size=20), tmp_path / name)


def test_a_window_shows_lengths_where_they_are() -> None:
    """A box seen along y: from -0.5 to 0.25 across and 0 to 0.5 up, in a frame of -1 to 1."""
    box = trimesh.creation.box(bounds=[(-0.5, -1, 0), (0.25, 1, 0.5)])
    surface = Surface(vertices=np.asarray(box.vertices), faces=np.asarray(box.faces))
    picture = render(surface, width=80, height=80, azimuth=math.radians(-90), elevation=0, window=(-1, 1, -1, 1))
    rows, columns = np.nonzero(picture.min(axis=2) < 255)
    assert (columns.min(), columns.max()) == (20, 49)  # pixels of 1/40
    assert (rows.min(), rows.max()) == (20, 39)  # row 0 is at the top
