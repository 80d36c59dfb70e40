"""The wheel in an environment of its own, with each program that phasefill works in or with, on real files: `make hosts`.

Tests of one program alone are in files of their own, which `make hosts` runs on the wheel, too. Nothing here is skipped
because a program is missing, only in a checkout, where the package beside the tests would be the one that is tried.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import sysconfig
from importlib.metadata import distribution
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy import ndimage

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = Path(sys.executable).with_name("infill")
SITE = Path(sysconfig.get_path("purelib")).resolve()

pytestmark = [
    pytest.mark.skipif((ROOT / "infill").is_dir(), reason="this is a checkout: `make hosts` installs the wheel"),
    pytest.mark.longest,
]


@pytest.fixture(scope="module")
def labels() -> np.ndarray:
    """Flesh as 1 and bone as 2, [x, y, z]: of a real head, or of the sample of a finger where that was not fetched."""
    path = Path(os.environ.get("INFILL_DATA", ROOT / "data")) / "volumes" / "ct_headsq_64x64x93_uint16.npz"
    if path.is_file():
        values, borders = np.load(path)["value"], (500, 1150)
    else:
        from infill.samples.bone import bone_scan

        values, borders = bone_scan().values, (-500, 226)
    flesh, bone = (largest_component(values >= border) for border in borders)
    return flesh.astype(np.uint8) + (flesh & bone)


def largest_component(solid: np.ndarray) -> np.ndarray:
    """Return the largest component of voxels that share faces, as a person cleans a segmentation."""
    numbers, _ = ndimage.label(solid)
    return numbers == np.bincount(numbers.ravel())[1:].argmax() + 1


def run_program(*words: str | Path, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run the installed command in a folder."""
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, encoding="utf-8", check=False)


# --- what is installed ----------------------------------------------------------------------------------


def test_what_is_imported_and_started_is_the_wheel(tmp_path: Path) -> None:
    """Here, and in the processes that tests start in other folders."""
    installed = distribution("phasefill")
    origin = json.loads(installed.read_text("direct_url.json"))
    assert origin["url"].endswith(".whl")
    assert "archive_info" in origin
    code = "import infill, patterns, sys; print(infill.__file__, patterns.__file__, infill.__version__)"
    for folder in (ROOT, ROOT / "tests", tmp_path):
        done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True)
        *files, version = done.stdout.split()
        assert [Path(file).resolve().parent for file in files] == [SITE / "infill", SITE / "patterns"]
        assert version == installed.version
    import infill
    import patterns

    assert [Path(module.__file__).resolve().parent.parent for module in (infill, patterns)] == [SITE, SITE]
    assert run_program("--version", folder=tmp_path).stdout == f"infill {installed.version} (phasefill)\n"


def test_the_wheel_brings_the_files_that_are_no_code() -> None:
    for name in (
        "studio/gallery/facts.json",
        "slicer_profiles/cura/InfillRefill.py",
        "hosts/napari.yaml",
        "viewer/bundle/viewer.js",
        "studio/bundle/studio.js",
    ):
        assert (SITE / "infill" / name).stat().st_size > 100, name
    assert (SITE / "infill" / "py.typed").is_file()
    script = (SITE / "infill" / "slicer_profiles" / "cura" / "InfillRefill.py").read_bytes()
    assert script == (ROOT / "examples" / "cura" / "InfillRefill.py").read_bytes()


# --- assistants, PyVista, napari, 3D Slicer ---------------------------------------------------------------


def test_an_assistant_smooths_and_checks_a_mesh(real_mesh: Path, tmp_path: Path) -> None:
    """By the SDK's client, which starts the installed command and talks to it over stdin and stdout."""
    from tool_client import run_client

    (tmp_path / "bone.stl").write_bytes(real_mesh.read_bytes())
    with run_client(tmp_path, "--folder", str(tmp_path), program=[str(PROGRAM)]) as client:
        smooth = client.call("smooth", source="bone.stl", output="smooth.stl").report
        before, after = client.call("check", files=["bone.stl", "smooth.stl"]).report["files"]
    assert before["printable"]
    assert after["printable"]
    assert after["volume"] == pytest.approx(before["volume"], rel=1e-3)
    assert smooth["closed"]
    assert smooth["problems"] == []


def test_a_mesh_that_pyvista_read_is_smoothed_by_its_accessor(real_mesh: Path) -> None:
    """In a process that imports PyVista alone: the accessor is found by its entry point."""
    code = f"""if True:
        import sys, pyvista
        mesh = pyvista.read({str(real_mesh)!r})
        assert "infill" not in sys.modules
        smooth = mesh.phasefill.smooth()
        print(sys.modules["infill"].__file__)
        assert smooth.is_manifold
        assert abs(smooth.volume / mesh.volume - 1) < 1e-3, (smooth.volume, mesh.volume)
        assert smooth.user_dict["phasefill"]["problems"] == []
    """
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert Path(done.stdout.strip()).resolve().parent == SITE / "infill"


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::FutureWarning", "ignore::UserWarning")
def test_napari_discovers_the_plug_in_and_saves_by_it(labels: np.ndarray, tmp_path: Path) -> None:
    """As napari does: npe2 looks through what is installed, and hands layers to the commands of the manifest."""
    from napari.layers import Labels
    from npe2 import PluginManager

    import infill

    manager = PluginManager.instance()
    manager.discover()
    commands = {command.id for command in manager.get_manifest("phasefill").contributions.commands}
    functions = {name: manager.commands.get(name) for name in commands}
    files = {Path(sys.modules[function.__module__].__file__).resolve() for function in functions.values()}
    assert files == {SITE / "infill" / "hosts" / name for name in ("napari_widgets.py", "napari_layers.py")}
    layer = Labels(labels, scale=(1.5, 3.2, 3.2), name="head")
    made = sys.modules["infill.hosts.napari_layers"].labels_to_surfaces(layer, together=True)
    (writer,) = (each for each in manager.iter_compatible_writers(["surface"]) if each.command.startswith("phasefill"))
    assert writer.exec(args=[str(tmp_path / "head.stl"), made]) == [str(tmp_path / "head.stl")]
    mesh = infill.read_mesh(tmp_path / "head.stl")
    assert mesh.volume == pytest.approx((labels > 0).sum() * 1.5 * 3.2 * 3.2, rel=0.01)


def test_slicers_core_has_the_segments_smoothed(labels: np.ndarray, monkeypatch: pytest.MonkeyPatch) -> None:
    from slicer_core import vtkSegment, vtkSegmentation
    from test_3d_slicer import SPACING, image_of, surface_of

    monkeypatch.syspath_prepend(ROOT / "examples" / "3d-slicer" / "PhasefillSmooth")
    from PhasefillSmoothLib import segments

    segmentation = vtkSegmentation()
    segmentation.SetSourceRepresentationName("Binary labelmap")
    for number in (1, 2):
        segment = vtkSegment()
        segment.SetName(f"label {number}")
        segment.AddRepresentation("Binary labelmap", image_of(labels == number))
        segmentation.AddSegment(segment, f"label {number}")
    report = segments.smooth_segments(segmentation)
    assert report["closed"]
    for number, line in zip((1, 2), segments.describe(report), strict=False):
        assert line.startswith(f"label {number}: ")
        assert "cm³" in line
        volume = (labels == number).sum() * np.prod(SPACING)
        assert surface_of(segmentation, f"label {number}").volume == pytest.approx(volume, rel=0.01)


# --- slicers and repositories ------------------------------------------------------------------------------


def test_setup_writes_a_line_that_refills_a_print(real_print: Path, tmp_path: Path) -> None:
    """Into a copied folder of profiles; the line is run as the slicer runs it, with the print as its last word."""
    profile = tmp_path / "OrcaSlicer" / "user" / "default" / "process" / "mine.json"
    profile.parent.mkdir(parents=True)
    profile.write_text('{\n    "name": "mine",\n    "post_process": []\n}\n')
    before = profile.read_bytes()
    words = ["setup", "orcaslicer", "--folder", str(tmp_path / "OrcaSlicer"), "--force"]
    written = run_program(*words, "--write", folder=tmp_path)
    assert written.returncode == 0, written.stderr
    (line,) = json.loads(profile.read_text())["post_process"]
    assert line == f"{PROGRAM} refill"
    sliced = tmp_path / "sliced.gcode"
    sliced.write_bytes(real_print.read_bytes())
    subprocess.run(f"{line} {sliced}", shell=True, check=True, capture_output=True)
    assert b"; refilled by phasefill" in sliced.read_bytes()
    assert run_program("verify", real_print, sliced, folder=tmp_path).returncode == 0
    assert run_program(*words, "--remove", folder=tmp_path).returncode == 0
    assert profile.read_bytes() == before


def test_setup_puts_its_script_into_curas_folder(tmp_path: Path) -> None:
    """From the wheel, where the script lies beside the code."""
    (tmp_path / "cura" / "5.10").mkdir(parents=True)
    words = ["setup", "cura", "--folder", str(tmp_path / "cura"), "--force"]
    assert run_program(*words, "--write", folder=tmp_path).returncode == 0
    script = (tmp_path / "cura" / "5.10" / "scripts" / "InfillRefill.py").read_text()
    assert repr(str(PROGRAM)).strip("'") in script
    assert run_program(*words, "--remove", folder=tmp_path).returncode == 0
    assert not list((tmp_path / "cura").rglob("InfillRefill.py"))


def test_pre_commit_checks_meshes_in_an_environment_of_its_own(real_mesh: Path, tmp_path: Path) -> None:
    """Made by pre-commit by the hook's own lines, from the wheel; a broken mesh stops the commit."""
    from test_repository_checks import HOOKS, add_open_mesh, git

    (wheel,) = (ROOT.parent / "wheel").glob("*.whl")
    (hook,) = (hook for hook in yaml.safe_load(HOOKS.read_text(encoding="utf-8")) if hook["id"] == "infill-check")
    hook["additional_dependencies"] = [str(wheel)]
    folder = tmp_path / "models"
    folder.mkdir()
    git(folder, "init", "-q")
    (folder / "bone.stl").write_bytes(real_mesh.read_bytes())
    (folder / ".pre-commit-config.yaml").write_text(yaml.safe_dump({"repos": [{"repo": "local", "hooks": [hook]}]}))
    git(folder, "add", ".")
    environment = {**os.environ, "PRE_COMMIT_HOME": str(tmp_path / "home"), "PATH": "/usr/bin:/bin"}

    def pre_commit(*words: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "pre_commit", *words]
        return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)

    made = pre_commit("install-hooks")
    if made.returncode and re.search(r"No matching distribution|ConnectionError|ReadTimeoutError", made.stdout):
        pytest.skip("pre-commit cannot install what the wheel requires: no network here")
    fine = pre_commit("run", "--color", "never")
    assert fine.returncode == 0, fine.stdout + fine.stderr
    assert fine.stdout.splitlines()[-1].endswith("Passed")
    (program,) = (tmp_path / "home").rglob("bin/infill")
    assert program != PROGRAM
    add_open_mesh(folder)
    broken = pre_commit("run", "--color", "never")
    assert broken.returncode == 1
    assert "open.stl" in broken.stdout
    assert broken.stdout.splitlines()[0].endswith("Failed")
