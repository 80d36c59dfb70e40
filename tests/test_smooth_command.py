"""`infill smooth` as a user types it: units, space, outputs, reports, and one clear line for every mistake."""

from __future__ import annotations

import json
import logging
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from shapes import assert_printable
from test_command_line import one_line_error, refused, run

from infill import Volume, read_mesh, read_volume
from infill.cli.console import print_log
from infill.imaging.volume_files import write_field

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

RUN = [sys.executable, "-m", "infill.cli"]
CELLS = (26, 22, 24)
MIDDLE = (12.0, 10.0, 11.0)
BALL = ((np.indices(CELLS) - np.reshape(MIDDLE, (3, 1, 1, 1))) ** 2).sum(axis=0) <= 8.0**2


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One small input of each kind."""
    folder = tmp_path_factory.mktemp("inputs")
    np.save(folder / "ball.npy", BALL)
    np.save(folder / "ct.npy", np.where(BALL, 1000, -1000).astype(np.int16))
    np.savez(folder / "two.npz", a=BALL, b=~BALL)
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=10.0)
    sphere.export(folder / "s.stl")
    np.savetxt(folder / "p.xyz", sphere.vertices)
    trimesh.PointCloud(sphere.vertices).export(folder / "p.ply")
    for name in ("part.step", "part.stl.gz", "bare"):
        (folder / name).write_text("ISO-10303-21;")
    (folder / "nothing").mkdir()
    (folder / "junk").mkdir()
    (folder / "junk" / "notes.md").write_text("hello")
    (folder / "old.stl").write_text("precious")
    return folder


@pytest.fixture
def folder(inputs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a copy of the inputs, in which the command runs."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(inputs, tmp_path, dirs_exist_ok=True)
    return tmp_path


def report(*words: str | Path) -> dict[str, Any]:
    """Run `infill smooth … --json` and return the report: one JSON object, alone on stdout."""
    result = run("smooth", *words, "--json")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert isinstance(found, dict)
    return found


# --- what it says ----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [[], ["ball.npy"], ["ball.npy", "--nonsense"], ["ball.npy", "-o", "a.stl", "--steps", "few"]]
)
def test_usage_errors_exit_2(words: list[str], folder: Path) -> None:
    assert run("smooth", *words).exit_code == 2
    assert not (folder / "a.stl").exists()


@pytest.mark.longest
@pytest.mark.parametrize(
    ("source", "suffix"),
    [("ball.npy", ".stl"), ("s.stl", ".3mf"), ("p.xyz", ".obj"), ("p.ply", ".ply"), ("ball.npy", ".glb")],
)
def test_every_kind_is_smoothed_and_every_format_written(source: str, suffix: str, folder: Path) -> None:
    """Each once: what is written knows nothing of what was read."""
    words = [] if source == "ball.npy" else ["--resolution", "24"]
    result = run("smooth", source, *words, "-o", f"a{suffix}")
    assert result.exit_code == 0, result.output
    assert result.stdout == ""
    assert "closed" in result.stderr
    mesh = read_mesh(folder / f"a{suffix}").to_trimesh()
    assert mesh.is_volume
    # 24 cells across, and points with an edge of 1.3 voxels between them.
    volume = float(BALL.sum()) if source == "ball.npy" else 4 / 3 * math.pi * 1000
    assert mesh.volume == pytest.approx(volume, rel=0.001 if source == "ball.npy" else 0.05)


@pytest.mark.long
@pytest.mark.parametrize(("source", "is_ct"), [("ct.npy", True), ("grey.npy", False)])
def test_otsu_of_a_ct_names_the_threshold_of_bone(source: str, is_ct: bool, folder: Path) -> None:
    np.save(folder / "grey.npy", np.where(BALL, 1000, 0).astype(np.int16))
    result = run("smooth", source, "--otsu", "-o", "a.stl")
    assert result.exit_code == 0, result.output
    assert ("found by Otsu's method; in a CT, bone is from about --threshold 226" in result.stderr) == is_ct
    assert ("threshold" in result.stderr) == is_ct


@pytest.mark.slow
def test_the_report_is_one_object_on_stdout_and_talk_goes_to_stderr(folder: Path) -> None:
    result = run("smooth", "ball.npy", "-o", "a.stl", "-o", "b.ply", "--preview", "c.png", "--json", "-v")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert found["files"] == ["a.stl", "b.ply", "c.png"]
    assert all((folder / name).stat().st_size > 1000 for name in found["files"])
    assert found["closed"] is True
    assert found["problems"] == []
    assert found["input"]["segmentation"]["method"] == "mask"
    assert abs(found["volume_change"]) < 1e-4
    assert read_mesh(folder / "a.stl").volume == pytest.approx(found["volume"], rel=1e-5)
    for word in ("ball.npy", "closed", "of the data", "voxels", "components", "distance", "seconds", "wrote a.stl"):
        assert word in result.stderr
    assert report("ball.npy")["files"] == []


@pytest.mark.slow
def test_quiet_means_quiet(folder: Path) -> None:
    result = run("smooth", "ball.npy", "-o", "a.stl", "-q")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "")


@pytest.mark.longest
def test_a_real_process_says_the_same(folder: Path) -> None:
    """Nothing of a library comes onto the streams, and no number depends on who calls."""
    done = subprocess.run(
        [*RUN, "smooth", "ball.npy", "-o", "a.stl", "--json"], capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    found, here = json.loads(done.stdout), report("ball.npy", "-o", "b.stl")
    assert {**found, "seconds": 0, "files": 0} == {**here, "seconds": 0, "files": 0}
    assert (folder / "a.stl").read_bytes() == (folder / "b.stl").read_bytes()
    assert "Warning" not in done.stderr


# --- units -----------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_one_part_in_four_units_gives_one_mesh(folder: Path) -> None:
    part = trimesh.creation.box(extents=(40, 20, 10))
    volumes, meshes = [], []
    for unit, size in {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "um": 1e-3}.items():
        part.copy().apply_scale(1 / size).export(f"{unit}.ply")
        found = report(f"{unit}.ply", "--units", unit, "--resolution", "40", "-o", f"{unit}.obj")
        volumes.append(found["volume"])
        meshes.append(np.sort(read_mesh(folder / f"{unit}.obj").vertices, axis=0))
    assert volumes == pytest.approx([volumes[0]] * len(volumes), rel=1e-5)
    for vertices in meshes[1:]:
        assert np.allclose(vertices, meshes[0], atol=1e-3)  # 32-bit coordinates in the file


@pytest.mark.longest
@pytest.mark.usefixtures("log_heard")
@pytest.mark.parametrize("name", ["nasty/metres_part_47um.stl", "medical/mandible_raw_m.stl"])
def test_a_part_in_metres_is_questioned(name: str, data: Path, folder: Path) -> None:
    result = run("smooth", data / name, "-o", "a.stl", "--resolution", "40")
    assert result.exit_code == 0
    assert "long if its numbers are millimetres; give --units m if they are metres" in result.stderr
    small, large = (
        report(data / name, "--resolution", "60", "--units", unit, "--allow-broken") for unit in ("mm", "m")
    )
    assert large["volume"] == pytest.approx(small["volume"] * 1e9, rel=1e-4)
    assert large["extents"] == pytest.approx([1000 * x for x in small["extents"]], rel=1e-4)
    assert 10 < max(large["extents"]) < 200


@pytest.mark.longest
@pytest.mark.usefixtures("log_heard")
def test_a_fine_closed_mesh_is_told_of_filters_and_nothing_else_is(folder: Path) -> None:
    """A ball of 1280 triangles whose edges are 1.4 mm long, on the average."""
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=10.0)
    (mesh := sphere.copy()).update_faces(np.arange(len(sphere.faces)) > 0)
    mesh.export("open.stl")
    trimesh.util.concatenate([sphere, sphere.copy().apply_translation((30, 0, 0))]).export("pair.stl")
    trimesh.util.concatenate([sphere, sphere.copy().apply_translation((4, 0, 0))]).export("overlap.stl")

    def hints(*words: str) -> int:
        result = run("smooth", *words, "-o", "o.stl", "--force", "--allow-broken")
        assert result.exit_code == 0
        return result.stderr.count("hint: the mesh is closed, and its edges")

    assert hints("s.stl", "--voxel", "2.0") == 1
    for words in (
        ("s.stl", "--voxel", "0.6"),
        ("s.stl", "--voxel", "2.0", "--quiet"),
        ("open.stl", "--voxel", "2.0"),
        ("pair.stl", "--voxel", "2.0"),
        ("overlap.stl", "--voxel", "2.0"),
        ("p.xyz", "--voxel", "2.0"),
        ("ball.npy",),
    ):
        assert hints(*words) == 0, words


@pytest.mark.longest
@pytest.mark.usefixtures("log_heard")
def test_points_in_metres_are_questioned_too(folder: Path) -> None:
    np.savetxt("m.xyz", np.loadtxt("p.xyz") / 1000)
    asked = run("smooth", "m.xyz", "-o", "a.stl", "--resolution", "30")
    assert "--units m if they are metres (20 mm long)" in asked.stderr
    one, other = (report(*words, "--resolution", "30") for words in (["m.xyz", "--units", "m"], ["p.xyz"]))
    assert one["volume"] == pytest.approx(other["volume"], rel=1e-5)


# --- where things lie ------------------------------------------------------------------------------------


def turn() -> np.ndarray:
    """A rotation about no axis of the grid."""
    a, b = 0.4, -0.9
    about_z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    about_x = np.array([[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    return about_z @ about_x


@pytest.mark.longest
@pytest.mark.parametrize("mirror", [(1, 1, 1), (-1, 1, 1), (1, 1, -1), (-1, -1, 1)])
def test_a_ball_in_a_turned_scan_lies_at_its_physical_point(mirror: tuple[int, ...], folder: Path) -> None:
    """Written by SimpleITK, with uneven cells; the mesh stands where SimpleITK says the middle is."""
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    spacing, middle, radius = np.array([0.8, 0.9, 1.4]), (14, 12, 9), 7.0
    away = (np.indices((28, 26, 20)) - np.reshape(middle, (3, 1, 1, 1))) * np.reshape(spacing, (3, 1, 1, 1))
    values = np.clip((radius - np.sqrt((away**2).sum(axis=0))) * 1000, -1000, 1000).astype(np.int16)
    image = sitk.GetImageFromArray(values.T)
    image.SetSpacing(spacing.tolist())
    image.SetOrigin((-120.0, 33.5, 410.0))
    image.SetDirection((turn() @ np.diag(mirror)).ravel().tolist())
    sitk.WriteImage(image, "scan.nrrd")
    sitk.WriteImage(image, "scan.nii.gz")
    expected = image.TransformIndexToPhysicalPoint(middle)
    for name in ("scan.nrrd", "scan.nii.gz"):
        found = report(name, "--threshold", "0", "--grey", "-o", "a.stl", "-o", "a.ply", "-o", "a.npz", "--force")
        assert found["grid"]["space"] == "LPS"
        assert b"SPACE=LPS" in (folder / "a.stl").read_bytes()[:80]
        mesh = read_mesh(folder / "a.stl").to_trimesh()
        assert_printable(mesh)
        assert mesh.centroid == pytest.approx(expected, abs=0.02)
        assert mesh.volume == pytest.approx(4 / 3 * math.pi * radius**3, rel=0.025)  # chords: it is 5 cells high
        field = read_volume(folder / "a.npz")
        assert field.mirrored is (math.prod(mirror) < 0)
        assert field.place(np.array([(np.array(middle) + 0.5) * spacing]))[0] == pytest.approx(expected, abs=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".npz", ".nrrd"])
def test_the_field_is_written_and_read_back_in_its_place(suffix: str, folder: Path) -> None:
    write_field(
        Volume(
            values=BALL.astype(np.uint8), spacing=(0.5, 0.6, 0.7), origin=(10, -20, 30), direction=turn(), space="LPS"
        ),
        folder / "scan.npz",
    )
    found = report("scan.npz", "-o", f"field{suffix}", "-o", "a.stl")
    field, scan = read_volume(folder / f"field{suffix}"), read_volume(folder / "scan.npz")
    assert field.values.shape == BALL.shape
    assert field.values.dtype == np.float32
    assert np.abs(field.values).max() <= 1
    assert field.spacing == pytest.approx(scan.spacing)
    assert field.origin == pytest.approx(scan.origin)
    assert np.allclose(field.direction, scan.direction)
    assert field.space == "LPS"
    assert found["volume"] == pytest.approx(BALL.sum() * 0.5 * 0.6 * 0.7, rel=1e-4)


@pytest.mark.slow
def test_the_mesh_is_the_zero_set_of_the_field(folder: Path) -> None:
    """The field goes in again as it is: not smoothed, it gives the volume of the mesh."""
    found = report("ball.npy", "-o", "field.npz")
    again = report("field.npz", "--steps", "0")
    assert again["input"]["segmentation"]["method"] == "phase"
    assert again["volume"] == pytest.approx(found["volume"], rel=0.01)


# --- what is solid ---------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ["--threshold", "0"],
        ["--range", "500,1500"],
        ["--label", "1000"],
        ["--label", "7", "--label", "1000"],
        ["--otsu"],
        ["--threshold", "0", "--grey"],
        ["--otsu", "--grey"],
    ],
)
def test_ways_to_say_what_is_solid(words: list[str], folder: Path) -> None:
    found = report("ct.npy", *words, "--spacing", "0.5")
    assert found["volume"] == pytest.approx(BALL.sum() / 8, rel=0.01 if "--grey" in words else 1e-4)
    assert found["grid"]["spacing"] == [0.5] * 3


@pytest.mark.slow
def test_spacing_may_differ_by_axis(folder: Path) -> None:
    found = report("ball.npy", "--spacing", "0.5, 1,2")
    assert found["grid"]["spacing"] == [0.5, 1, 2]  # twice as high as wide is not too thick
    assert found["volume"] == pytest.approx(BALL.sum(), rel=1e-4)
    assert found["extents"][2] > 3.5 * found["extents"][0]


@pytest.mark.slow
def test_a_named_array(folder: Path) -> None:
    assert report("two.npz", "--array", "a")["solid"]["data"] == BALL.sum()
    assert report("two.npz", "--array", "b")["solid"]["data"] == (~BALL).sum()


@pytest.mark.slow
def test_specks_are_taken_out_and_counted(folder: Path) -> None:
    solid = BALL.copy()
    solid[0, 0, 0] = solid[-1, 0, 0] = True
    np.save("specks.npy", solid)
    result = run("smooth", "specks.npy", "--despeckle", "1", "-o", "a.stl", "--json")
    found = json.loads(result.stdout)
    assert (
        found["input"]["despeckled"],
        found["topology"]["data"]["components"],
        found["topology"]["result"]["components"],
    ) == (2, 1, 1)
    assert "2 specks of up to 1 mm³ taken out beforehand" in result.stderr
    assert run("smooth", "ball.npy", "-o", "b.stl").exit_code == 0
    assert (folder / "a.stl").read_bytes() == (folder / "b.stl").read_bytes()


# --- the surface -----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_level_0_shrinks_and_volume_does_not(folder: Path) -> None:
    kept, paper = report("ball.npy"), report("ball.npy", "--level", "0")
    assert abs(kept["volume_change"]) < 1e-4
    assert paper["volume_change"] < -0.02
    assert (kept["solid"]["level"]["method"], paper["solid"]["level"]["method"]) == ("volume", "fixed")


@pytest.mark.slow
@pytest.mark.parametrize("words", [["--tolerance", "0.05"], ["--max-triangles", "1000"]])
def test_simplified_meshes_are_closed(words: list[str], folder: Path) -> None:
    result = run("smooth", "ball.npy", *words, "-o", "a.stl", "--json")
    found = json.loads(result.stdout)
    assert_printable(read_mesh(folder / "a.stl").to_trimesh())
    assert found["triangles"] < found["mesh"]["simplified"]["triangles_before"]
    assert found["triangles"] <= 1000 or "--tolerance" in words
    assert "simplified" in result.stderr


@pytest.mark.longest
def test_broken_walls_are_an_error_and_allowed_on_request(folder: Path) -> None:
    solid = np.zeros((60, 30, 30), dtype=bool)
    solid[4:16, 6:24, 6:24] = solid[44:56, 6:24, 6:24] = solid[16:44, 6:24, 14:16] = True
    np.save("plate.npy", solid)
    words = ["smooth", "plate.npy", "-o", "a.stl", "--steps", "60", "--smooth", "plain"]
    one_line_error(run(*words, "--strict"), r"mm² of the input \(.*%\) is missing.*leave out --strict")
    assert not (folder / "a.stl").exists()
    assert "tried" in run(*words).stderr
    (folder / "a.stl").unlink()
    result = run(*words, "--allow-broken", "--json")
    assert result.exit_code == 0
    assert "LOST" in result.stderr
    assert json.loads(result.stdout)["problems"]
    assert_printable(read_mesh(folder / "a.stl").to_trimesh())


@pytest.mark.slow
def test_a_speck_that_vanishes_is_told(folder: Path) -> None:
    solid = BALL.copy()
    solid[0, 0, 0] = True
    np.save("speck.npy", solid)
    result = run("smooth", "speck.npy", "-o", "a.stl")
    assert result.exit_code == 0
    assert "1 speck or flake one voxel thick is gone" in result.stderr


# --- errors: one clear line, exit 1, nothing written -----------------------------------------------------

BAD = [
    ("ball.npy --as picture", "'--as': .*'picture' is not one of 'mesh', 'points', 'volume'"),
    ("s.stl --units yard", "'--units': .*'yard' is not one of 'um', 'mm', 'cm', 'm', 'in'"),
    *[
        (f"s.stl --{option}", f"--{option.split()[0]} is for")
        for option in ("threshold 3", "label 3", "otsu", "grey", "range 1,2", "shell 3")
    ],
    *[
        (f"s.stl --{option} 1", f"--{option} is for volumes, and s.stl is read as mesh")
        for option in ("spacing", "array", "series")
    ],
    *[(f"ball.npy --{option} 2", f"--{option} is for") for option in ("shell", "resolution")],
    ("ball.npy --voxel 0.5", "voxel is 0.5 mm and the volume has 1 mm; give no less, or leave it out"),
    ("ball.npy --voxel 20", "voxel is 20 mm and the volume 26 mm long; give at most 13 mm"),
    ("ball.npy --units mm", "give the spacing of a volume in mm"),
    *[(f"p.xyz --{option}", f"--{option.split()[0]} is for") for option in ("threshold 3", "label 3", "otsu", "grey")],
    *[
        (f"{name} --resolution 30 --voxel 1", "--voxel and --resolution are both given; give one")
        for name in ("s.stl", "p.xyz")
    ],
    ("ct.npy", r"from -1000 to 1000 and do not say .* give --threshold X.* bone is from about --threshold 226$"),
    ("ct.npy --threshold 3 --otsu", "--threshold and --otsu exclude each other"),
    ("ct.npy --threshold 3 --range 3,4", "--threshold and --range exclude each other"),
    ("ct.npy --threshold 3 --label 4", "exclude each other; give one of them"),
    ("ct.npy --threshold 3000", "--threshold is 3000, and no cell would be solid; .* from -1000 to 1000"),
    ("ct.npy --threshold -3000", "every cell would be solid"),
    ("ct.npy --threshold nan", "nan; it must be a number"),
    ("ct.npy --label 5", "--label is 5, and no cell would be solid"),
    ("ct.npy --label 1000 --grey", "one threshold"),
    ("ct.npy --range 5,2", "--range goes from 5 to 2; give the lower end first"),
    *[(f"ct.npy --range {text}", f"--range is '{text}'; give") for text in ("5", "a,b", "5,inf", "1,2,3")],
    *[(f"ball.npy --spacing {text}", f"--spacing is '{text}'; give") for text in ("1,2", "x", "1,2,3,4", "nan")],
    ("ball.npy --spacing 0", "spacing is 0 mm; it must be a finite number above 0"),
    ("ball.npy --spacing 1,-1,1", "spacing is -1 mm"),
    ("ball.npy --level middle", "level is? .*'middle'"),
    ("ball.npy --level 2", "level is 2; it must be a number from -0.999 to 0.999"),
    *[
        (f"{name} --resolution {number}", f"resolution is {number}; it must be a whole number of at least 1")
        for name in ("s.stl", "p.xyz")
        for number in (0, -3)
    ],
    *[
        (f"{name} --voxel {number}", rf"voxel is {number} mm; it must be a finite number above 0")
        for name in ("s.stl", "p.xyz")
        for number in ("0", "-1", "nan")
    ],
    *[
        (f"{name} --voxel 1e-9", "voxel is 0.000000001; it must be a number from 0.000001")
        for name in ("s.stl", "p.xyz")
    ],
    *[(f"{name} --voxel 0.001", "GiB is at hand; the grid has .* give larger voxels") for name in ("s.stl", "p.xyz")],
    *[(f"{name} --resolution 1000000", "GiB is at hand; the grid has") for name in ("s.stl", "p.xyz")],
    ("p.xyz --voxel 100", "voxel is 100 mm and the points are 20 mm thick"),
    ("p.xyz --shell 0.05", "shell of at least one voxel"),
    ("p.xyz --shell 0", "shell is 0 mm"),
    ("ball.npy --steps -1", "--steps is -1"),
    ("ball.npy --fidelity -1", "fidelity is -1"),
    ("ball.npy --fidelity nan", "fidelity is nan"),
    ("ball.npy --interface 0", "interface is 0; it must be a number from 0.25"),
    ("ball.npy --despeckle 1e9", r"despeckle is 1,000,000,000 mm³ and the largest component has .* mm³; give less"),
    ("ball.npy --despeckle -1", "despeckle is -1"),
    ("ball.npy --tolerance -1", "tolerance is -1; it must be a number from 0"),
    ("ball.npy --smooth best", "'--smooth': .*'best' is not one of 'auto', 'plain', 'refine', 'grey'"),
    ("s.stl --smooth grey", "grey levels are those of scans; choose plain or refine for a mesh"),
    ("ball.npy --max-triangles 3", "--max-triangles is 3; .* at least 4"),
    ("ball.npy --threads 0", "--threads is 0; .* at least 1"),
    ("ball.npy --max-memory lots", "--max-memory is 'lots'"),
    ("ball.npy --max-memory 1K", "is allowed; give --voxel"),
    ("s.stl --max-memory 1M", "is allowed; the grid has 216 x 216 x 216 cells; give larger voxels"),
    *[
        (f"gone{suffix}", f"there is no file gone{suffix}; check the name")
        for suffix in (".stl", ".npy", ".nrrd", ".xyz", ".ply", ".abc", "")
    ],
    ("nothing", "nothing holds no files"),
    ("junk", "junk holds no DICOM series and no .tif or .png slices"),
    ("nothing --as mesh", "cannot tell a mesh format from 'nothing'"),
    *[
        (name, rf"cannot tell what '{name}' holds; export it as a mesh \(\.stl .*\.npy .* \.h5\) or points \(\.xyz")
        for name in ("part.step", "part.stl.gz", "bare")
    ],
    ("s.stl --tolerance -1", "is -1; it must be a number from 0 to 1000000 mm"),
    ("s.stl --tolerance inf", "is inf; it must be a number from 0 to 1000000 mm"),
    ("s.stl --as volume", "cannot tell a volume from 's.stl'"),
    ("s.stl --as points", "cannot tell a format of points from 's.stl'"),
    ("ball.npy --as mesh", "cannot tell a mesh format from 'ball.npy'"),
    ("ball.npy --as points", "type bool; save points as numbers"),
    ("p.ply --as mesh", "holds no triangles"),
    ("two.npz", "holds 2 arrays with three axes .a, b."),
    ("two.npz --array c", "holds no array 'c'; it holds a, b"),
    ("ball.npy --array a", "only an .npz holds named arrays"),
    ("ball.npy --series 1.2", "is not a folder; give the one that holds the series"),
]


@pytest.mark.long
@pytest.mark.parametrize(("words", "says"), BAD, ids=[words for words, _ in BAD])
def test_bad_input_is_one_clear_line(words: str, says: str, folder: Path) -> None:
    before = sorted(folder.iterdir())
    refused(run("smooth", *words.split(), "-o", "a.stl", "--preview", "a.png"), says)
    assert sorted(folder.iterdir()) == before


def test_a_voxel_larger_than_the_part_is_an_error(folder: Path) -> None:
    one_line_error(run("smooth", "s.stl", "--voxel", "100", "-o", "a.stl"), "voxel is 100 mm and the part")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a.xyz", "a", "a.stl.zip", "a.npy"])
def test_an_unknown_suffix_is_told_before_the_work(name: str, folder: Path) -> None:
    """Before the input is even looked for."""
    one_line_error(run("smooth", "gone.stl", "-o", name), r"use one of \.stl, .*\.npz, \.nrrd")
    assert not (folder / name).exists()


@pytest.mark.slow
def test_outputs_are_checked_before_the_work(folder: Path) -> None:
    one_line_error(run("smooth", "s.stl", "-o", "old.stl"), "old.stl exists; .* --force")
    one_line_error(run("smooth", "s.stl", "-o", "no/a.stl"), "there is no folder no")
    one_line_error(run("smooth", "s.stl", "-o", "a.stl", "-o", "./a.stl"), "is named twice")
    one_line_error(run("smooth", "gone.stl", "-o", "a.stl", "--preview", "a.jpg"), r"ends in \.png")
    one_line_error(run("smooth", "gone.stl", "-o", "a.obj", "--ascii"), "only .stl can be written as text")
    (folder / "d.stl").mkdir()
    one_line_error(run("smooth", "s.stl", "-o", "d.stl", "--force"), "is a folder")
    one_line_error(run("smooth", "gone.stl", "-o", "old.stl"), "there is no file gone.stl")
    assert (folder / "old.stl").read_text() == "precious"


@pytest.mark.slow
def test_force_overwrites_even_the_input(folder: Path) -> None:
    """The input is read as a whole before the output takes its place."""
    assert run("smooth", "s.stl", "-o", "old.stl", "--resolution", "20", "--force").exit_code == 0
    assert run("smooth", "s.stl", "-o", "s.stl", "--resolution", "20", "--force").exit_code == 0
    assert (folder / "s.stl").read_bytes() == (folder / "old.stl").read_bytes()
    write_field(Volume(values=np.where(BALL, 0.5, -0.5)), folder / "f.npz")
    assert run("smooth", "f.npz", "-o", "f.npz", "--force").exit_code == 0
    assert np.abs(read_volume(folder / "f.npz").values).max() <= 1


def test_a_failed_run_keeps_the_old_file(folder: Path) -> None:
    one_line_error(run("smooth", "ct.npy", "-o", "old.stl", "--force"), "do not say what is solid")
    assert (folder / "old.stl").read_text() == "precious"


def test_all_outputs_appear_or_none(folder: Path) -> None:
    before = sorted(folder.iterdir())
    one_line_error(run("smooth", "ball.npy", "-o", "a.stl", "-o", "x" * 300 + ".obj"), "cannot write|too long")
    assert sorted(folder.iterdir()) == before


@pytest.mark.slow
def test_text_is_written_on_request(folder: Path) -> None:
    assert run("smooth", "ball.npy", "-o", "a.stl", "--ascii").exit_code == 0
    assert (folder / "a.stl").read_bytes().startswith(b"solid")
    assert read_mesh(folder / "a.stl").closed


@pytest.mark.longest
def test_names_that_a_console_cannot_show(folder: Path) -> None:
    (folder / "ball.npy").rename(folder / "球 ü.npy")
    done = subprocess.run(
        [*RUN, "smooth", "球 ü.npy", "-o", "网.stl", "--json"],
        capture_output=True,
        check=False,
        env={**os.environ, "PYTHONIOENCODING": "cp1252"},
    )
    assert done.returncode == 0, done.stderr
    assert read_mesh(folder / "网.stl").closed


def test_the_log_is_said(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    log = logging.getLogger("infill")
    monkeypatch.setattr(log, "disabled", False)  # which the fixture that is silent of the compiler sets
    for shown in (True, False):
        with print_log(shown=shown):
            log.warning("compiling %s", "it")
    assert capsys.readouterr().err == "compiling it\n"
    assert log.propagate
    assert not log.handlers
