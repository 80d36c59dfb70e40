"""Python takes what the command takes: files, and results of one function as input of the next."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from handmade_prints import Dialect, written
from typer.testing import CliRunner

from infill import (
    FormatError,
    GeometryError,
    check,
    fill,
    make,
    motion,
    read_mesh,
    read_points,
    read_volume,
    refill,
    smooth_labels,
    smooth_mesh,
    smooth_points,
    smooth_volume,
)
from infill.cli.app import build_app
from infill.formats.units import read_mesh_in_mm
from infill.pictures.picture_files import SUFFIXES

SPHERE = trimesh.creation.icosphere(3, 8.0)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    SPHERE.export("ball.stl")
    grid = np.indices((24, 24, 24)) - 11.5
    np.save("ball.npy", ((grid**2).sum(axis=0) < 80).astype(np.uint8))
    np.savetxt("cloud.xyz", SPHERE.vertices)
    Path("print.gcode").write_bytes(written(Dialect(layers=6)))
    return tmp_path


def same(one: Any, other: Any) -> None:
    np.testing.assert_array_equal(one.surface.vertices, other.surface.vertices)
    np.testing.assert_array_equal(one.surface.faces, other.surface.faces)


@pytest.mark.slow
def test_a_path_is_the_file_that_its_reader_reads(folder: Path) -> None:
    same(fill("ball.stl", voxel=0.5), fill(read_mesh("ball.stl"), voxel=0.5))
    same(
        smooth_mesh(Path("ball.stl"), resolution=24, tolerance=None),
        smooth_mesh(read_mesh("ball.stl"), resolution=24, tolerance=None),
    )
    volume = read_volume("ball.npy", spacing=0.5)
    same(smooth_volume("ball.npy", spacing=0.5, tolerance=None), smooth_volume(volume, tolerance=None))
    same(smooth_labels("ball.npy", spacing=0.5, tolerance=None), smooth_labels(volume, tolerance=None))
    same(
        smooth_points("cloud.xyz", voxel=1.0, tolerance=None),
        smooth_points(read_points("cloud.xyz"), voxel=1.0, tolerance=None),
    )


def test_results_are_meshes(folder: Path) -> None:
    block = make("honeycomb", size=20, height=3)
    report = check(block)
    assert report.printable
    assert report == check(block.surface)
    solid = smooth_mesh(SPHERE, resolution=24, tolerance=None)
    same(fill(solid, voxel=0.5), fill(solid.surface, voxel=0.5))


def test_what_is_no_mesh_is_told(folder: Path) -> None:
    with pytest.raises(GeometryError, match="a list is not a mesh; give a trimesh.Trimesh, a Surface or a path"):
        fill([1, 2])  # type: ignore[arg-type]
    with pytest.raises(FormatError, match="there is no file lost.stl"):
        fill("lost.stl")


def test_units_are_guessed_by_all_alike(folder: Path, caplog: pytest.LogCaptureFixture) -> None:
    small = SPHERE.copy()
    small.apply_scale(0.001)
    small.export("metres.stl")
    with caplog.at_level(logging.WARNING, "infill"):
        read_mesh_in_mm("metres.stl")
    assert "give --units m if they are metres" in caplog.text
    assert "the size suggests that the unit is m, not mm" in check("metres.stl").warnings
    for times, factor in (("um", 1e-3), ("in", 25.4), ("inch", 25.4), ("mm", 1.0)):
        extents = np.ptp(read_mesh_in_mm("ball.stl", times).bounds, axis=0)
        np.testing.assert_allclose(extents, 16 * factor, rtol=1e-5)


def test_motion_and_refill_are_shown_in_a_line_and_a_picture(folder: Path) -> None:
    result, planned = refill("print.gcode", output="new.gcode"), motion("print.gcode")
    assert repr(result).startswith("RefillResult(new.gcode: ")
    assert "sections, infill " in repr(result)
    assert repr(planned).startswith("Motion(0:0")
    assert "PrusaSlicer" in repr(planned)
    assert len(repr(planned)) < 100
    assert "source" not in planned.to_dict()
    assert ".png" in SUFFIXES
    both, one = result.picture(), planned.picture()
    assert both.width > one.width > 100  # two layers beside one
    assert planned._repr_png_() is not None
    Path("print.gcode").unlink()
    assert planned._repr_png_() is None
    with pytest.raises(FormatError, match="plan it again"):
        planned.picture()


def test_lines_have_no_picture_and_are_said_so(folder: Path) -> None:
    text = Path("print.gcode").read_text().splitlines(keepends=True)
    result = refill(text)
    assert repr(result).startswith("RefillResult(no file: ")
    assert result._repr_png_() is None
    again = refill("print.gcode", dry_run=True)
    assert again.picture().width < refill("print.gcode", output="new.gcode").picture().width


# Each command line, and the call that must write the same bytes: nothing but the input and what has no default.
ALIKE: dict[str, tuple[list[str], Callable[[], Any]]] = {
    "mesh": (["smooth", "ball.stl"], lambda: smooth_mesh("ball.stl")),
    "mask": (["smooth", "ball.npy"], lambda: smooth_volume("ball.npy")),
    "grey": (["smooth", "grey.npy", "--threshold", "3"], lambda: smooth_volume("grey.npy", threshold=3)),
    "points": (["smooth", "cloud.xyz", "--voxel", "1"], lambda: smooth_points("cloud.xyz", voxel=1)),
    "labels": (["smooth", "ball.npy", "--each-label"], lambda: smooth_labels("ball.npy")),
    "fill": (["fill", "ball.stl"], lambda: fill("ball.stl")),
    "make": (["make", "honeycomb"], lambda: make("honeycomb")),
    "make a block": (["make", "octet", "--size", "12"], lambda: make("octet", size=12)),
}


@pytest.mark.longest
@pytest.mark.parametrize("name", ALIKE)
def test_the_command_and_the_function_have_the_same_defaults(name: str, folder: Path) -> None:
    grid = np.indices((24, 24, 24)) - 11.5
    np.save("grey.npy", (12 - np.sqrt((grid**2).sum(axis=0))).astype(np.float32))
    command, call = ALIKE[name]
    done = CliRunner().invoke(build_app(), [*command, "-o", "command.3mf"])
    assert done.exit_code == 0, done.stderr
    call().save("function.3mf")
    assert Path("command.3mf").read_bytes() == Path("function.3mf").read_bytes()


def test_meshes_and_inspections_are_shown_on_one_short_line() -> None:
    solid = make("honeycomb", size=20, height=3)
    assert re.fullmatch(r"Surface\([\d,]+ vertices, [\d,]+ triangles\)", repr(solid.surface))
    assert re.fullmatch(r"Inspection\(printable; [\d,]+ triangles, 20 x 20 x 3 mm\)", repr(check(solid)))
