"""Units: what a format says is believed, what it does not say is guessed alike by `check` and `smooth`."""

from __future__ import annotations

import json
import logging
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from test_command_line import run

from infill import ParameterError, Surface, check, read_mesh, save
from infill.formats.mesh_files import READERS, WRITERS
from infill.imaging.units import STATED_UNITS, guess_unit
from infill.smoothing.sources import read_source

SIZES = [0.01, 0.3, 0.5, 0.51, 1.0, 1.5, 1.999, 2.0, 2.001, 7.0, 60.0, 500.0, 2000.0, 2001.0, 5000.0]


def box(size: float) -> trimesh.Trimesh:
    return trimesh.creation.box((size, size / 2, size / 3))


@pytest.mark.slow
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("suffix", [".stl", ".ply", ".xyz"])
def test_check_and_smooth_say_the_same(
    size: float, suffix: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / f"a{suffix}"
    if suffix == ".xyz":
        np.savetxt(path, box(size).vertices)
    else:
        save(box(size), path)
    unit = guess_unit(size)
    if suffix != ".xyz":
        found = check(path)
        assert found.unit_guess == unit
        assert any("the size suggests" in each for each in found.warnings) == (unit != "mm")
    try:
        with caplog.at_level(logging.WARNING, logger="infill"):
            read_source(path)
        questioned = "--units" in caplog.text
    except ParameterError as told:
        questioned = "--units m if they are metres" in str(told)
        assert size < 2
    assert questioned == (unit != "mm")
    assert np.ptp(
        getattr(read_source(path, units="mm"), "vertices", read_source(path, units="mm")), axis=0
    ).max() == pytest.approx(size)


@pytest.mark.slow
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("suffix", sorted(set(STATED_UNITS) & set(WRITERS)))
def test_a_format_that_says_its_unit_is_not_questioned(
    size: float, suffix: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = save(box(size), tmp_path / f"a{suffix}")
    found = check(path)
    assert found.unit_guess == "mm"
    assert not found.warnings
    assert max(found.extents) == pytest.approx(size)
    assert np.ptp(read_source(path).vertices, axis=0).max() == pytest.approx(size)
    assert not caplog.text


def test_formats_that_say_their_unit_are_formats() -> None:
    assert set(STATED_UNITS) <= set(READERS)
    assert set(WRITERS) <= set(READERS)
    assert set(STATED_UNITS) - set(WRITERS) == {".gltf"}  # which is read only


# --- glTF is in metres -----------------------------------------------------------------------------------


@pytest.mark.parametrize("scale", [1e-3, 1.0, 47.11, 1e5])
def test_a_glb_read_back_has_the_same_numbers(scale: float, tmp_path: Path, rng: np.random.Generator) -> None:
    """To the last bit of those that 32 bits hold."""
    ball = trimesh.creation.icosphere(2)
    vertices = ((ball.vertices + rng.normal(size=3)) * scale).astype(np.float32).astype(np.float64)
    back = read_mesh(save(Surface(vertices=vertices, faces=ball.faces), tmp_path / "a.glb"))
    assert np.array_equal(back.vertices, vertices)
    assert np.array_equal(back.faces, ball.faces)


def test_other_programs_see_metres(tmp_path: Path) -> None:
    path = save(trimesh.creation.box((60, 40, 6)), tmp_path / "a.glb")
    assert trimesh.load_scene(path).extents == pytest.approx([0.06, 0.04, 0.006])
    assert trimesh.load_mesh(path).volume == pytest.approx(60e-3 * 40e-3 * 6e-3)


def test_the_places_of_a_scene_are_taken(tmp_path: Path) -> None:
    """Two places of one mesh, one of them mirrored, and one within another; all in metres."""
    part = trimesh.creation.box((0.02, 0.01, 0.03))
    scene = trimesh.Scene()
    scene.add_geometry(part, node_name="a", geom_name="part", transform=np.diag([1, 1, -1, 1.0]))
    moved = trimesh.transformations.compose_matrix(translate=(0.1, 0, 0), angles=(0, 0, 0.5), scale=(2, 2, 2))
    scene.add_geometry(part, node_name="b", geom_name="part2", parent_node_name="a", transform=moved)
    scene.export(tmp_path / "a.glb")
    found = read_mesh(tmp_path / "a.glb")
    assert found.closed
    assert found.volume == pytest.approx(20 * 10 * 30 * (1 + 8), rel=1e-5)  # both face outwards
    assert found.bounds == pytest.approx(scene.bounds * 1000, rel=1e-5)


def test_points_in_a_scene_are_left_out(tmp_path: Path) -> None:
    scene = trimesh.Scene([trimesh.creation.box(), trimesh.PointCloud(np.eye(3))])
    scene.export(tmp_path / "a.glb")
    assert read_mesh(tmp_path / "a.glb").volume == pytest.approx(1e9)


def test_the_file_says_it_by_a_node(tmp_path: Path) -> None:
    data = save(box(6), tmp_path / "a.glb").read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    described = json.loads(data[20 : 20 + length])
    assert described["nodes"] == [{"mesh": 0, "scale": [0.001] * 3}]
    assert described["accessors"][0]["max"] == pytest.approx([3, 1.5, 1])


def test_a_unit_that_is_given_stands_above_the_format(tmp_path: Path) -> None:
    """A .glb whose numbers are mm, as some programs write it."""
    trimesh.creation.box((60, 40, 6)).export(tmp_path / "a.glb")
    assert np.ptp(read_source(tmp_path / "a.glb").vertices, axis=0).max() == pytest.approx(60_000)
    assert np.ptp(read_source(tmp_path / "a.glb", units="mm").vertices, axis=0).max() == pytest.approx(60)


@pytest.mark.slow
@pytest.mark.usefixtures("log_heard")
def test_smooth_takes_a_small_glb_and_writes_one(tmp_path: Path) -> None:
    save(trimesh.creation.icosphere(3, radius=0.7), tmp_path / "a.glb")
    done = run("smooth", tmp_path / "a.glb", "--resolution", "30", "-o", tmp_path / "b.glb")
    assert done.exit_code == 0, done.output
    assert read_mesh(tmp_path / "b.glb").volume == pytest.approx(4 / 3 * np.pi * 0.7**3, rel=0.02)
    save(trimesh.creation.icosphere(3, radius=0.7), tmp_path / "a.stl")
    asked = run("smooth", tmp_path / "a.stl", "--resolution", "30", "-o", tmp_path / "c.stl")
    assert asked.exit_code == 0
    assert "give --units m if they are metres" in asked.stderr
