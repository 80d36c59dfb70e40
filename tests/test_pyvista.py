"""phasefill inside of PyVista: `make hosts` installs it, and these tests are skipped without it.

Laws: a dataset gives the surface of the library's own call, vertex by vertex, where the dataset lies, with its report.
"""

from __future__ import annotations

import re
import subprocess
import sys
import textwrap
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np
import pytest

import infill
from infill import ParameterError, Segment, Volume

pv = pytest.importorskip("pyvista", reason="PyVista is not here: `make hosts` installs it", minversion="0.48")

TURN = np.array([[0.0, -1.0, 0.0], [0.6, 0.0, -0.8], [0.8, 0.0, 0.6]])  # columns of length 1, square to each other
SPACING = (0.5, 0.6, 0.7)
MIDDLE = np.array([30.0, -20.0, 10.0])
RADIUS = 6.0


def scan(dimensions: tuple[int, ...] = (34, 32, 30), *, cells: bool = False, offset: tuple[int, ...] = (0, 0, 0)):
    """Return an image, turned and shifted, with depths in a ball around `MIDDLE`, at points or in cells."""
    half = np.array(SPACING) * (np.array(dimensions) - 1) / 2
    image = pv.ImageData(dimensions=dimensions, spacing=SPACING, direction_matrix=TURN)
    image.origin = MIDDLE - TURN @ (half + np.array(SPACING) * offset)
    image.offset = offset
    places = image.cell_centers().points if cells else image.points
    depth = RADIUS - np.linalg.norm(places - MIDDLE, axis=1)
    (image.cell_data if cells else image.point_data)["depth"] = depth
    (image.cell_data if cells else image.point_data)["organ"] = np.where(
        depth < 0, 0, np.where(places[:, 2] > 10, 5, 2)
    )
    image.set_active_scalars("depth")
    return image


def assert_same(mesh: pv.PolyData, surface: infill.Surface) -> None:
    """A mesh has the vertices and faces of a surface, and nothing is rounded."""
    assert np.array_equal(mesh.points, surface.vertices)
    assert mesh.points.dtype == surface.vertices.dtype
    assert np.array_equal(mesh.regular_faces, surface.faces)
    assert mesh.is_manifold
    assert mesh.volume > 0


@pytest.mark.longest
def test_pyvista_finds_the_accessors_by_their_entry_point() -> None:
    """In a process that imports nothing of phasefill before it is asked for."""
    (entry,) = (entry for entry in entry_points(group="pyvista.accessors") if entry.name == "phasefill")
    assert entry.value == "infill.hosts.pyvista"
    code = (
        "import sys, pyvista as pv; mesh = pv.Sphere(); assert 'phasefill' in dir(mesh); "
        "assert not any(name.split('.')[0] == 'infill' for name in sys.modules); "
        "print(type(mesh.phasefill).__name__, type(pv.ImageData().phasefill).__name__)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert done.stdout.split() == ["MeshAccessor", "ImageAccessor"]


def test_a_mesh_is_smoothed_as_by_the_library() -> None:
    ball = pv.Sphere(radius=RADIUS, center=MIDDLE)
    smooth = ball.phasefill.smooth(voxel=0.6, tolerance=0)
    faces = ball.regular_faces
    own = infill.smooth_mesh(infill.Surface(vertices=np.asarray(ball.points), faces=faces), voxel=0.6, tolerance=0)
    assert_same(smooth, own.surface)
    assert smooth.volume == pytest.approx(ball.volume, rel=1e-3)
    assert np.allclose(smooth.center, MIDDLE, atol=0.05)
    assert smooth.user_dict["phasefill"]["volume"] == own.report["volume"]


@pytest.mark.longest
def test_polygons_of_any_kind_are_filled() -> None:
    """A cube of PyVista has squares, and each side its own corners."""
    cube = pv.Cube(center=MIDDLE, x_length=20, y_length=16, z_length=10)
    filled = cube.phasefill.fill("gyroid", density=0.2, cell=6, voxel=0.5)
    assert filled.is_manifold
    assert np.allclose(filled.bounds, cube.bounds)
    report = filled.user_dict["phasefill"]
    assert report["density"] == pytest.approx(0.2, abs=0.005)
    assert filled.volume == pytest.approx(report["volume"])
    assert filled.volume < 0.7 * cube.volume
    project = cube.phasefill.fill(density=0.2, cell=6, voxel=0.5, as_="project")
    assert project.keys() == ["part", "infill"]
    assert project.user_dict["phasefill"]["product"] == "fill"


@pytest.mark.parametrize("cells", [False, True], ids=["points", "cells"])
@pytest.mark.parametrize("offset", [(0, 0, 0), (4, -3, 2)], ids=["from zero", "from elsewhere"])
def test_the_surface_lies_where_the_image_does(cells: bool, offset: tuple[int, ...]) -> None:
    """A part cut out of a larger image keeps its place by its offset."""
    smooth = scan(cells=cells, offset=offset).phasefill.smooth(threshold=0, scalars="depth", tolerance=0)
    assert smooth.is_manifold
    assert np.linalg.norm(smooth.center_of_mass() - MIDDLE) < 1e-3
    distances = np.abs(np.linalg.norm(np.asarray(smooth.points) - MIDDLE, axis=1) - RADIUS)
    # Less than half a voxel everywhere, as where the pole lies between layers; else, a tenth.
    assert distances.max() < 0.5 * max(SPACING)
    assert np.percentile(distances, 90) < 0.1 * max(SPACING)


def test_an_image_is_smoothed_as_by_the_library() -> None:
    image = scan()
    smooth = image.phasefill.smooth(threshold=1.0)
    values = np.asarray(image["depth"]).reshape(image.dimensions, order="F")
    corner = np.array(image.origin) - TURN @ (np.array(SPACING) / 2)
    volume = Volume(values=values, spacing=SPACING, origin=tuple(corner), direction=TURN)
    own = infill.smooth_volume(volume, threshold=1.0)
    assert np.allclose(smooth.points, own.surface.vertices, atol=1e-12)
    assert np.array_equal(smooth.regular_faces, own.surface.faces)
    assert smooth.user_dict["phasefill"]["distance"] == own.report["distance"]


@pytest.mark.long
@pytest.mark.parametrize("together", [False, True])
def test_labels_have_names_and_places(together: bool) -> None:
    table = [Segment(value=5, name="upper half"), Segment(value=2)]
    halves = scan().phasefill.labels(scalars="organ", table=table, together=together)
    assert halves.keys() == ["label_2", "upper half"]
    assert all(half.is_manifold and half.volume > 0 for half in halves)
    assert halves["upper half"].center[2] > 11 > 9 > halves["label_2"].center[2]
    whole = 4 / 3 * np.pi * RADIUS**3
    assert sum(half.volume for half in halves) == pytest.approx(whole, rel=0.02)
    report = halves.user_dict["phasefill"]
    assert [label["name"] for label in report["labels"]] == halves.keys()


def test_one_label_is_still_a_block_of_its_name() -> None:
    halves = scan().phasefill.labels(scalars="organ", label=5)
    assert halves.keys() == ["label_5"]


def test_the_report_outlives_filters_and_files(tmp_path: Path) -> None:
    smooth = scan().phasefill.smooth(threshold=0)
    smooth.save(tmp_path / "ball.vtp")
    for kept in (smooth.translate((1, 0, 0)), smooth.copy(), pv.read(tmp_path / "ball.vtp")):
        assert kept.user_dict["phasefill"]["components"] == 1


def test_the_dataset_stays_as_it_was() -> None:
    image, cube = scan(), pv.Cube(x_length=20, y_length=20, z_length=20)
    before = image.copy(), cube.copy()
    image.phasefill.labels(scalars="organ", tolerance=0)
    cube.phasefill.smooth(voxel=1)
    assert (image, cube) == before


def test_errors_are_a_line_that_says_what_to_do() -> None:
    image = scan()
    image["colour"] = np.zeros((image.n_points, 3), dtype=np.uint8)
    with pytest.raises(
        ParameterError, match="^scalars is 'bone', and the image has depth, organ, colour; give the name"
    ):
        image.phasefill.smooth(scalars="bone", threshold=0)
    with pytest.raises(
        ParameterError, match="^scalars is 'colour', with 3 numbers for each voxel; give an array with one"
    ):
        image.phasefill.labels(scalars="colour")
    with pytest.raises(ParameterError, match="^scalars is None, and the image has no arrays"):
        pv.ImageData(dimensions=(3, 3, 3)).phasefill.labels()
    with pytest.raises(infill.GeometryError, match="^the mesh has no faces"):
        pv.PolyData(np.zeros((4, 3))).phasefill.smooth()
    with pytest.raises(ParameterError, match="^voxel is -1 mm"):
        pv.Sphere().phasefill.smooth(voxel=-1)


@pytest.mark.longest
def test_results_are_drawn_off_screen() -> None:
    picture = (
        scan()
        .phasefill.labels(scalars="organ")
        .plot(off_screen=True, screenshot=True, return_img=True, window_size=(160, 120), show_axes=False)
    )
    assert picture.shape == (120, 160, 3)
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 50


@pytest.mark.longest
@pytest.mark.usefixtures("coarse_grids")
def test_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As a person runs it, with a part and an image of theirs; what it would show is drawn off screen."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pv, "OFF_SCREEN", True)
    pv.Cube(x_length=24, y_length=20, z_length=16).save("part.stl")
    image = scan()
    image.set_active_scalars("organ")
    image.save("labels.vti")
    page = (Path(__file__).resolve().parents[1] / "docs" / "pyvista.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^ *```python\n(.*?)^ *```$", page, re.M | re.S)
    assert len(blocks) == 2
    names: dict[str, object] = {}
    for block in blocks:
        exec(textwrap.dedent(block), names)
    assert names["filled"].user_dict["phasefill"]["problems"] == []
    assert names["organs"].keys() == ["liver", "spleen"]
