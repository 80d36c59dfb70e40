"""phasefill inside of napari: `make hosts` installs it, and these tests are skipped without it.

Laws: the manifest is one that napari accepts; surfaces are the library's own, in the place of their layer.
"""

from __future__ import annotations

import importlib
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import infill
from infill import ParameterError

pytest.importorskip("napari", reason="napari is not here: `make hosts` installs it", minversion="0.9.2")
pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::FutureWarning", "ignore::UserWarning")

SCALE, TRANSLATE = (2.0, 0.5, 0.6), (10.0, -20.0, 30.0)
RADIUS, MIDDLE = 6.0, np.array([19.0, -12.0, 38.0])  # z, y, x in the world


@pytest.fixture
def layers():
    from napari import layers

    return layers


def depths() -> np.ndarray:
    """Return depths in a ball around `MIDDLE`, [z, y, x]."""
    indices = np.moveaxis(np.indices((10, 34, 30)), 0, -1)
    return RADIUS - np.linalg.norm(indices * SCALE + TRANSLATE - MIDDLE, axis=-1)


def organs() -> np.ndarray:
    depth = depths()
    return np.where(depth < 0, 0, np.where(np.arange(30) > 13, 5, 2))


def in_world(data, attributes) -> np.ndarray:
    """Return the vertices of a surface as napari places them."""
    from napari.layers import Surface

    layer = Surface(data, **attributes)
    return np.array([layer.data_to_world(vertex) for vertex in layer.vertices])


# --- what napari reads ---------------------------------------------------------------------------------------


def test_the_manifest_is_valid_and_found_by_the_entry_point() -> None:
    from npe2 import PluginManifest

    manifest = PluginManifest.from_distribution("phasefill")
    assert manifest.name == "phasefill"
    assert manifest.package_metadata.version == infill.__version__
    beside = Path(infill.__file__).parent / "hosts" / "napari.yaml"
    assert manifest.contributions == PluginManifest.from_file(beside).contributions
    commands = {command.id: command for command in manifest.contributions.commands}
    used = [*manifest.contributions.widgets, *manifest.contributions.writers]
    assert {each.command for each in used} == set(commands)
    (writer,) = manifest.contributions.writers
    assert {*writer.filename_extensions} == {".stl", ".3mf", ".obj", ".ply", ".glb"}


@pytest.mark.longest
def test_reading_the_manifest_imports_nothing_of_phasefill() -> None:
    code = (
        "import sys; from npe2 import PluginManifest; PluginManifest.from_distribution('phasefill'); "
        "print(*(name for name in sys.modules if name.split('.')[0] == 'infill'))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert set(done.stdout.split()) <= {"infill", "infill.version", "infill.hosts"}


# --- layers --------------------------------------------------------------------------------------------------


def test_labels_become_surfaces_in_their_place_and_colour(layers) -> None:
    from infill.hosts.napari_layers import labels_to_surfaces

    layer = layers.Labels(organs(), scale=SCALE, translate=TRANSLATE, name="organs", units="mm")
    own = infill.smooth_labels(organs(), spacing=SCALE, origin=tuple(-np.array(SCALE) / 2))
    made = labels_to_surfaces(layer)
    assert [attributes["name"] for _, attributes, _ in made] == ["organs label_2", "organs label_5"]
    for (data, attributes, kind), (name, surface) in zip(made, own.surfaces.items(), strict=True):
        assert kind == "surface"
        assert np.array_equal(data[0] * SCALE, surface.vertices / SCALE * SCALE)
        assert np.array_equal(data[1], surface.faces)
        assert attributes["metadata"]["phasefill"]["closed"]
        shown = layers.Surface(data, **attributes)
        assert np.array_equal(shown.scale, SCALE)
        assert np.array_equal(shown.translate, TRANSLATE)
        assert np.allclose(shown.colormap.map([1.0])[0], layer.get_color(int(name[-1])), atol=0.01)
    left, right = (in_world(data, attributes)[:, 2].mean() for data, attributes, _ in made)
    assert left < MIDDLE[2] < right


def test_an_image_becomes_a_surface_where_it_lies(layers) -> None:
    """Also where the layer is turned, sheared and moved by a matrix: the surface has all of these."""
    from infill.hosts.napari_layers import image_to_surface

    layer = layers.Image(depths(), scale=SCALE, translate=TRANSLATE, name="scan")
    ((data, attributes, kind),) = image_to_surface(layer, threshold=0.0)
    assert (kind, attributes["name"]) == ("surface", "scan surface")
    distances = np.linalg.norm(in_world(data, attributes) - MIDDLE, axis=1)
    assert abs(np.median(distances) - RADIUS) < 0.05
    turned = layers.Image(
        depths(), scale=SCALE, rotate=(10.0, 20.0, 30.0), shear=(0.1, 0.0, 0.2), affine=np.diag([1.0, 2.0, 1.0, 1.0])
    )
    ((data, attributes, _),) = image_to_surface(turned, threshold=0.0)
    middle = turned.data_to_world((MIDDLE - TRANSLATE) / SCALE)
    assert np.allclose(
        np.ptp(in_world(data, attributes), axis=0) / 2 + in_world(data, attributes).min(0), middle, atol=0.3
    )


@pytest.mark.parametrize("suffix", [".stl", ".3mf", ".glb"])
def test_surfaces_are_saved_as_shown(suffix: str, layers, tmp_path: Path) -> None:
    """x first, closed, outside out, also from a layer that is mirrored."""
    from infill.hosts.napari_layers import image_to_surface, write_surfaces

    for scale in (SCALE, (2.0, 0.5, -0.6)):
        layer = layers.Image(depths(), scale=scale, translate=TRANSLATE, name="scan")
        made = image_to_surface(layer, threshold=0.0)
        passed = [layers.Surface(data, **attributes).as_layer_data_tuple() for data, attributes, _ in made]
        assert write_surfaces(str(tmp_path / f"ball{suffix}"), passed) == [str(tmp_path / f"ball{suffix}")]
        mesh = infill.read_mesh(tmp_path / f"ball{suffix}")
        assert mesh.closed
        shown = in_world(*made[0][:2])[:, ::-1]
        corners = shown[np.asarray(made[0][0][1])]
        enclosed = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        assert mesh.volume == pytest.approx(abs(enclosed), rel=1e-4)
        assert mesh.volume == pytest.approx(4 / 3 * np.pi * RADIUS**3, rel=0.04), "of a ball of six slices"
        expected = np.sort(shown, axis=0)
        assert np.allclose(mesh.bounds, expected[[0, -1]], atol=1e-3)


def test_other_layers_are_refused_with_a_line(layers) -> None:
    from infill.hosts.napari_layers import image_to_surface, labels_to_surfaces, write_surfaces

    with pytest.raises(ParameterError, match="^layer 'flat' has 2 axes; give one of three axes"):
        labels_to_surfaces(layers.Labels(np.ones((4, 4), dtype=int), name="flat"))
    with pytest.raises(ParameterError, match="^layer 'photo' has colours"):
        image_to_surface(layers.Image(np.zeros((3, 4, 4, 3)), name="photo", rgb=True), threshold=0.5)
    with pytest.raises(infill.FormatError, match="cannot tell a mesh format from the suffix '.xyz'"):
        write_surfaces("ball.xyz", [])


# --- panels --------------------------------------------------------------------------------------------------


@pytest.fixture
def window(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Qt without a screen."""
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    try:
        importlib.import_module("napari.qt.threading")
    except (ImportError, RuntimeError) as error:  # no Qt, or one that lacks a library of the system
        pytest.skip(f"Qt is not here: {error}")
    from napari.qt import get_qapp

    get_qapp()
    return


@pytest.mark.longest
def test_the_panels_smooth_beside_the_window(window: None, layers) -> None:
    from magicgui import magicgui
    from qtpy.QtWidgets import QApplication

    from infill.hosts import napari_widgets as panels
    from infill.hosts.napari_layers import image_to_surface, labels_to_surfaces

    labels = layers.Labels(organs(), scale=SCALE, name="organs")
    image = layers.Image(depths(), scale=SCALE, name="scan")
    expected = labels_to_surfaces(labels), image_to_surface(image, threshold=0.0, tolerance=0)
    for function, layer, chosen, own in (
        (panels.smooth_labels_layer, labels, {}, expected[0]),
        (panels.smooth_image_layer, image, {"threshold": 0.0, "otsu": False, "tolerance": 0.0}, expected[1]),
    ):
        panel = magicgui(function, auto_call=False)
        assert {"method", "tolerance"} < {widget.name for widget in panel}
        returned: list = []
        worker = function(layer, **chosen)
        worker.returned.connect(returned.append)
        end = time.monotonic() + 120
        while not returned and time.monotonic() < end:
            QApplication.processEvents()
            time.sleep(0.01)
        (made,) = returned
        assert [attributes["name"] for _, attributes, _ in made] == [attributes["name"] for _, attributes, _ in own]
        assert all(np.array_equal(a[0][0], b[0][0]) for a, b in zip(made, own, strict=True))
