"""What newcomers give `infill smooth`, `check` and `refill` by mistake: one clear line that says what it is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from test_command_line import one_line_error, run

pytestmark = pytest.mark.usefixtures("silent_compiler")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["a.stl", "a.obj", "a.ply", "a.3mf", "a.glb", "a.npy", "a.npz", "a.nrrd", "a.tif", "a.vti", "a.xyz"]
)
def test_a_file_without_a_byte_is_called_empty(name: str, folder: Path) -> None:
    """Whatever it would hold; its reader would only say what it missed first."""
    (folder / name).touch()
    one_line_error(run("smooth", name, "-o", "b.stl"), rf"{name} is empty .0 bytes.; ")
    assert sorted(folder.iterdir()) == [folder / name]


def test_a_picture_is_no_list_of_points(folder: Path) -> None:
    for kind in (bool, float):
        np.save("slice.npy", np.zeros((40, 50), dtype=kind))
        one_line_error(run("smooth", "slice.npy", "-o", "b.stl"), r"shape .40, 50.; with two axes .* stack the slices")


def test_a_folder_is_no_mesh(folder: Path) -> None:
    (folder / "part.stl").mkdir()
    one_line_error(run("check", "part.stl"), "part.stl is a folder; give a file")
    one_line_error(run("check", "."), r"cannot tell a mesh format from '\.'")
    one_line_error(run("refill", ".", "-o", "-"), r"^error: (?!.*tmp)")


@pytest.mark.parametrize("words", [[], ["--dry-run"]])
def test_a_flat_sheet_encloses_nothing(words: list[str]) -> None:
    trimesh.Trimesh([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]]).export("sheet.stl")
    one_line_error(run("smooth", "sheet.stl", "--resolution", "20", "-o", "b.stl", *words), "encloses nothing")


def test_memory_is_asked_for_before_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of all that is kept of a cell of a mesh's grid: which are inside would fit."""
    trimesh.creation.icosphere(radius=10).export("ball.stl")

    def worked(*given: object, **options: object) -> None:
        raise AssertionError

    monkeypatch.setattr("infill.smoothing.meshes.voxelise_with_report", worked)
    words = ["--resolution", "200", "--max-memory", "100M", "-o", "b.stl"]
    one_line_error(run("smooth", "ball.stl", *words), "216 x 216 x 216 cells; give larger voxels")


def test_names_may_have_blanks_and_umlauts(folder: Path) -> None:
    (folder / "mit ü leer").mkdir()
    ball = trimesh.creation.icosphere(radius=10)
    ball.export("mit ü leer/kugel ö.stl")
    result = run("check", "mit ü leer/kugel ö.stl", "mit ü leer/kugel ö.stl")
    assert result.exit_code == 0
    assert result.stdout.count("mit ü leer/kugel ö.stl  yes") == 2
    one_line_error(run("smooth", "mit ü leer/kugel ö.stl", "-o", "mit ü leer/kugel ö.stl"), "exists; .* --force")
