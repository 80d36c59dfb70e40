"""Files that are broken, empty, cut off or absurd: a closed mesh, or one clear line and nothing written."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile
import trimesh
from PIL import Image
from test_command_line import one_line_error, run

from infill import Volume, read_mesh
from infill.imaging.volume_files import write_field

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

COARSE = ["--resolution", "48"]

# What each file of data/nasty gives: a line, or the volume by SOURCES.md and how near 48 cells come to it.
NASTY: dict[str, tuple[str, float, float]] = {
    "20mmbox_CR_line_ends.stl": ("", 8000, 0.001),
    "20mmbox_nonstandard.stl": ("", 8000, 0.001),
    "cubes_touching_edge.stl": ("", 2, 0.02),
    "empty_0bytes.stl": ("is empty .0 bytes.", 0, 0),
    "empty_binary.stl": ("holds no triangles", 0, 0),
    "extruder_idler_overlapping.obj": ("", 5420, 0.02),
    "frog_legs_open.obj": ("", 1317, 0.15),  # 2 mm thick: two cells
    "huge_150m_inverted.stl": ("", 1e15, 0.03),
    "invalid_vertex.stl": ("a vertex that is not three numbers", 0, 0),
    "metres_part_47um.stl": ("", 2.819e-5, 0.07),
    "multibody_ascii.stl": ("", 0, 0),  # two components, one of them inside out: see its own test
    "nonmanifold.stl": ("", 1, 0.001),
    "prusa_extruder-cover_nonmanifold.stl": ("", 13490, 0.07),
    "prusa_raspberry_cover_nonmanifold.stl": ("", 2540, 0.2),  # walls of 1.5 mm: one cell
    "triangle_soup.stl": ("encloses nothing", 0, 0),
    "unit_cube_1mm.stl": ("", 1, 0.001),
    "unparseable.stl": ("a vertex that is not three numbers", 0, 0),
    "wall_hole_degenerate.obj": ("", 1067, 0.03),
    "zero_area_triangle.stl": ("", 1000, 0.001),
}


def test_every_nasty_file_is_named_here(data: Path) -> None:
    assert {path.name for path in (data / "nasty").iterdir() if path.suffix != ".md"} == set(NASTY)


@pytest.mark.long
@pytest.mark.parametrize("name", NASTY)
def test_nasty_meshes_are_closed_or_told(name: str, data: Path, tmp_path: Path) -> None:
    says, volume, near = NASTY[name]
    out = tmp_path / "a.ply"
    result = run("smooth", data / "nasty" / name, *COARSE, "--units", "mm", "-o", out, "--json", "--allow-broken")
    if says:
        one_line_error(result, says)
        assert name in result.stderr or "the mesh" in result.stderr
        assert list(tmp_path.iterdir()) == []
        return
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    mesh = read_mesh(out).to_trimesh()
    assert mesh.is_volume
    assert mesh.volume == pytest.approx(report["volume"], rel=1e-4)
    assert abs(report["volume_change"]) < 2e-3
    if volume:
        assert mesh.volume == pytest.approx(volume, rel=near)


@pytest.mark.long
@pytest.mark.usefixtures("log_heard")
@pytest.mark.parametrize(
    "name", ["unit_cube_1mm.stl", "metres_part_47um.stl", "nonmanifold.stl", "multibody_ascii.stl"]
)
def test_what_may_be_in_metres_is_told(name: str, data: Path, tmp_path: Path) -> None:
    done = run("smooth", data / "nasty" / name, "-o", tmp_path / "a.stl", "--resolution", "60")
    assert done.exit_code == 0
    assert "give --units m if they are metres" in done.stderr
    assert read_mesh(tmp_path / "a.stl").closed


@pytest.mark.slow
def test_components_that_face_two_ways_are_both_solid(data: Path) -> None:
    mesh = trimesh.load(data / "nasty" / "multibody_ascii.stl", force="mesh")
    volume = sum(abs(component.convex_hull.volume) for component in mesh.split(only_watertight=False))
    words = ["--units", "mm", "--resolution", "100", "--json", "--allow-broken"]
    report = json.loads(run("smooth", data / "nasty" / "multibody_ascii.stl", *words).stdout)
    assert report["input"]["repairs"]["components"] == 2
    assert report["topology"]["result"]["components"] == 2
    assert 0 < report["volume"] <= volume * 1.05


# --- volumes ---------------------------------------------------------------------------------------------

BALL = ((np.indices((20, 18, 16)) - np.reshape((9, 8, 7), (3, 1, 1, 1))) ** 2).sum(axis=0) <= 36


def save_tiff(path: Path, values: np.ndarray) -> None:
    tifffile.imwrite(path, values.T)


def save_nrrd(path: Path, values: np.ndarray) -> None:
    write_field(Volume(values=values), path)


def save_medical(path: Path, values: np.ndarray) -> None:
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    sitk.WriteImage(sitk.GetImageFromArray(np.ascontiguousarray(values.T)), str(path))


SAVERS: dict[str, Callable[[Path, np.ndarray], Any]] = {
    ".npy": np.save,
    ".npz": lambda path, values: np.savez_compressed(path, a=values),
    ".tif": save_tiff,
    ".nrrd": save_nrrd,
    ".nii.gz": save_medical,
    ".nii": save_medical,
    ".mha": save_medical,
}


def saved(folder: Path, suffix: str, values: np.ndarray) -> Path:
    path = folder / f"in{suffix}"
    SAVERS[suffix](path, values)
    return path


@pytest.mark.slow
@pytest.mark.parametrize("suffix", SAVERS)
def test_every_format_of_volumes_gives_the_same_mesh(suffix: str, tmp_path: Path) -> None:
    path = saved(tmp_path, suffix, BALL.astype(np.uint8))
    result = run("smooth", path, "-o", tmp_path / "a.stl", "--json", "--spacing", "1")
    assert result.exit_code == 0, result.output
    assert json.loads(result.stdout)["volume"] == pytest.approx(BALL.sum(), rel=1e-4)
    assert read_mesh(tmp_path / "a.stl").closed


@pytest.mark.slow
@pytest.mark.parametrize("suffix", SAVERS)
def test_volumes_cut_off_anywhere_are_told_or_whole(suffix: str, tmp_path: Path) -> None:
    """Where the end is missing nothing may be made up: cells that are not there are not void."""
    path = saved(
        tmp_path, suffix, np.random.default_rng(1).permutation(BALL.astype(np.int16).ravel() * 500).reshape(BALL.shape)
    )
    whole = path.read_bytes()
    for part in (0.0, 0.01, 0.3, 0.7, 0.97):
        path.write_bytes(whole[: int(len(whole) * part)])
        one_line_error(run("smooth", path, "--threshold", "250", "-o", tmp_path / "a.stl"), re.escape(path.name))
        assert list(tmp_path.iterdir()) == [path]


@pytest.mark.long
@pytest.mark.parametrize(
    "suffix", [*SAVERS, ".stl", ".obj", ".off", ".ply", ".glb", ".3mf", ".xyz", ".csv", ".dcm", ".tiff"]
)
@pytest.mark.parametrize(
    "content", [b"", b"\0" * 5000, b"hello, this is no volume\n" * 200, bytes(range(256)) * 40, b"\xff" * 84]
)
def test_files_of_something_else_are_told(suffix: str, content: bytes, tmp_path: Path) -> None:
    if suffix == ".dcm":
        pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    path = tmp_path / f"in{suffix}"
    path.write_bytes(content)
    one_line_error(run("smooth", path, "-o", tmp_path / "a.stl"), re.escape(path.name))
    assert list(tmp_path.iterdir()) == [path]


ABSURD: dict[str, tuple[np.ndarray, str]] = {
    "NaN": (np.full((6, 6, 6), np.nan), "NaN or infinite"),
    "one NaN": (np.where(np.arange(216).reshape(6, 6, 6) == 99, np.nan, 1.0), "NaN or infinite"),
    "infinite": (np.where(np.arange(216).reshape(6, 6, 6) == 99, np.inf, 1.0), "NaN or infinite"),
    "zeros": (np.zeros((6, 6, 6)), "in all cells, so no surface"),
    "ones": (np.ones((6, 6, 6), np.uint8), "in all cells, so no surface"),
    "one voxel": (np.ones((1, 1, 1), np.uint8), "in all cells, so no surface"),
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("suffix", "kind"),
    [
        *((".npy", kind) for kind in ABSURD),
        *((suffix, "one NaN") for suffix in (".npz", ".tif", ".nrrd", ".mha")),
        (".tif", "one voxel"),
    ],
)
def test_absurd_volumes_are_told(suffix: str, kind: str, tmp_path: Path) -> None:
    """Every absurdity, and every format."""
    values, says = ABSURD[kind]
    if suffix == ".tif" and values.size == 1:
        says = "save three axes|in all cells"  # one page of one cell has no third axis
    path = saved(tmp_path, suffix, values)
    one_line_error(run("smooth", path, "-o", tmp_path / "a.stl"), says)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(2, 1, 1), (1, 2, 1), (1, 1, 2), (2, 2, 2), (1, 3, 3), (3, 3, 3)])
def test_one_solid_voxel_gives_a_closed_mesh(shape: tuple[int, int, int], tmp_path: Path) -> None:
    solid = np.zeros(shape, dtype=bool)
    solid[tuple(count // 2 for count in shape)] = True
    result = run("smooth", saved(tmp_path, ".npy", solid), "-o", tmp_path / "a.stl", "--json")
    assert result.exit_code == 0, result.output
    mesh = read_mesh(tmp_path / "a.stl").to_trimesh()
    assert mesh.is_volume
    assert mesh.volume == pytest.approx(1, rel=0.01)


@pytest.mark.slow
def test_folders_of_slices(tmp_path: Path) -> None:
    (tmp_path / "scan").mkdir()
    for k in range(BALL.shape[2]):
        Image.fromarray(BALL[:, :, k].T.astype(np.uint8) * np.uint8(255)).save(tmp_path / "scan" / f"slice{k}.png")
    result = run("smooth", tmp_path / "scan", "--spacing", "0.5", "-o", tmp_path / "a.stl", "--json")
    assert json.loads(result.stdout)["volume"] == pytest.approx(BALL.sum() / 8, rel=1e-4)
    (tmp_path / "scan" / "slice3.png").write_bytes(b"no picture")
    one_line_error(run("smooth", tmp_path / "scan", "-o", tmp_path / "b.stl"), "slice3.png")


# --- meshes and points -----------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".stl", ".obj", ".off", ".ply", ".glb"])
def test_meshes_cut_off_are_told_or_closed(suffix: str, tmp_path: Path) -> None:
    """Text without its last lines may be read as a mesh with a hole; what comes out is closed, or told."""
    path, out = tmp_path / f"in{suffix}", tmp_path / "a.ply"
    trimesh.creation.icosphere(subdivisions=2, radius=10.0).export(path)
    whole = path.read_bytes()
    for part in (0.01, 0.3, 0.7, 0.97):
        path.write_bytes(whole[: int(len(whole) * part)])
        result = run("smooth", path, "--resolution", "20", "-o", out, "--allow-broken")
        if result.exit_code == 0:
            assert suffix in (".obj", ".off", ".ply")
            assert read_mesh(out).closed
            out.unlink()
        else:
            one_line_error(result, r"in\.|the mesh|the part")
            assert list(tmp_path.iterdir()) == [path]


TEXT: list[tuple[str, str, str]] = [
    ("a.xyz", "", "is empty .0 bytes."),
    ("a.xyz", "1 2 3\n", "1 point"),
    ("a.xyz", "1 2\n3 4\n5 6\n7 8\n", "column|three|axes|numbers"),
    ("a.xyz", "1 2 x\n" * 9, "broken|numbers|could not"),
    ("a.xyz", "nan nan nan\n" * 9, "not three finite numbers|NaN"),
    ("a.xyz", "5 5 5\n" * 9, "9 points are one point"),
    ("a.xyz", "\n".join(f"{5 * i} {7 * i % 40} 0" for i in range(40)), "lie in a plane"),
    ("a.csv", "x,y,z\n", "no points"),
    ("a.csv", "x,y,z\n1,2,3\n4,5\n", "broken|column"),
    ("a.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n", "encloses nothing"),
    ("a.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 7\n", "corners that do not exist|corner 7 does not exist|broken"),
    ("a.obj", "v 0 0 nan\nv 9 0 0\nv 0 9 0\nf 1 2 3\n", "not numbers|not finite"),
    ("a.off", "OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n", "encloses nothing"),
    ("a.off", "OFF\n300 1 0\n0 0 0\n", "a.off"),
    ("a.stl", "solid x\nendsolid x\n", "holds no triangles|neither text"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "text", "says"), TEXT, ids=[f"{i}-{name}" for i, (name, _, _) in enumerate(TEXT)])
def test_small_texts_of_nonsense_are_told(name: str, text: str, says: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    one_line_error(run("smooth", tmp_path / name, "--units", "mm", "-o", tmp_path / "out.stl"), says)
    assert list(tmp_path.iterdir()) == [tmp_path / name]


@pytest.mark.slow
@pytest.mark.parametrize(
    "values",
    [
        np.zeros((0, 3)),
        np.zeros((5, 2)),
        np.full((9, 3), np.nan),
        np.zeros((9, 3)),
        np.zeros(9),
        np.zeros((2, 2, 2, 2)),
        np.zeros((9, 3), complex),
        np.array("x"),
    ],
)
def test_arrays_that_are_no_points_and_no_volume(values: np.ndarray, tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", values)
    one_line_error(run("smooth", tmp_path / "a.npy", "--units", "mm", "-o", tmp_path / "a.stl"), r"a\.npy|point|units")
    if values.ndim != 2:
        one_line_error(run("smooth", tmp_path / "a.npy", "-o", tmp_path / "a.stl"), r"a\.npy")
    assert list(tmp_path.iterdir()) == [tmp_path / "a.npy"]
