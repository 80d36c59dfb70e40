"""Examples run, and each has one golden number."""

from __future__ import annotations

import importlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from examples.paper import models, page
from examples.paper.entry import LEFT_OUT, Entry, load
from infill import check
from tests.handmade_prints import Dialect, written
from tests.prints import PRINT, box

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "examples"
GOLDEN = {
    "01_make": 1022.024,
    "02_own_pattern": 36,
    "03_before_the_slicer": 0.199635,
    "04_smooth_a_scan": 15393.81,
}
# Of the figures of the paper, on small grids.
NUMBERS = {
    "fig02": ("length at lambda 100", 1.007407),
    "fig03": ("left", 0.1384175),
    "fig04": ("width at m = 2", 3.79581),
    "fig05": ("2 ours", 0.2263588),
    "fig06": ("bunny ours", 0.2251349),
    "fig07_08": ("sphere rms, level volume", 0.0277237),
    "fig09_10": ("20% ours rms", 0.0975269),
    "fig11": ("sponge level 0 rms", 0.3003055),
    "fig12_13": ("pig changed", 2.268800),
    "fig14": ("sphere, ours: mse", 0.0728565),
    "table1": ("sphere: mse", 0.0978320),
    "table2": ("sphere, 20% noise, ours, 20 steps, sigma", 0.00204145),
    "fig17_18": ("zigzag width", 1.199870),
    "fig19": ("mandible rms", 0.626427),
    "walls": ("width of a 3-cell wall after 10 steps", 2.830805),
}


@pytest.mark.long
@pytest.mark.parametrize("name", GOLDEN)
def test_the_example_gives_its_number(name: str, tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location(f"example_{name}", FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.main(tmp_path) == pytest.approx(GOLDEN[name], rel=1e-4)
    (file,) = tmp_path.iterdir()
    assert check(file).printable


def test_every_example_is_here() -> None:
    assert {path.stem for path in FOLDER.glob("*.py")} == set(GOLDEN)


@pytest.mark.parametrize("name", GOLDEN)
def test_what_a_newcomer_reads_is_short(name: str) -> None:
    """Ten to thirty lines, without docstrings and blank lines."""
    text = (FOLDER / f"{name}.py").read_text(encoding="utf-8")
    code = re.sub(r'^\s*""".*?"""$', "", text, flags=re.M | re.S)
    assert 10 <= len([line for line in code.splitlines() if line.strip()]) <= 30


def main_of(script: page.Script) -> Callable[..., Entry]:
    return importlib.import_module(f"examples.paper.{script.module}").main


@pytest.mark.long
@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("script", page.SCRIPTS, ids=lambda script: script.entry)
def test_the_figure_gives_its_number(script: page.Script, tmp_path: Path) -> None:
    try:
        entry = main_of(script)(tmp_path, small=True)
    except models.MissingModels as error:
        pytest.skip(str(error))
    which, value = NUMBERS[script.entry]
    assert entry.numbers[which] == pytest.approx(value, rel=1e-3)
    assert load(tmp_path, script.entry) == entry
    assert entry.name == script.entry
    assert {path.name for path in tmp_path.iterdir()} == {f"{entry.name}.png", f"{entry.name}.json"}
    with Image.open(tmp_path / f"{entry.name}.png") as picture:
        assert min(picture.size) > 200
        assert len(picture.getcolors(maxcolors=256)) > 10  # not blank


def test_pictures_draw_cells_and_contours_where_they_are() -> None:
    """Solid cells 1 and 2 along x of a grid that begins at 10: from 10.5 to 11.5; the contour runs half way to the next."""
    plots = importlib.import_module("examples.paper.plots")
    f = np.full((4, 3), -1.0)
    f[1:3, 1] = 1
    _, axes = plots.panels(1)
    plots.show_cells(axes[0, 0], f, h=0.5, origin=(10, 20))
    edges = np.concatenate([np.array(lines.get_segments()).reshape(-1, 2) for lines in axes[0, 0].collections])
    assert edges.min(axis=0).tolist() == [10.5, 20.5]
    assert edges.max(axis=0).tolist() == [11.5, 21.0]
    assert len(edges) == 2 * 6  # six edges of cells
    _, axes = plots.panels(1)
    plots.show_contour(axes[0, 0], f, h=0.5, origin=(10, 20))
    (contour,) = axes[0, 0].collections
    assert contour.get_paths()[0].get_extents().bounds == pytest.approx((10.5, 20.5, 1.0, 0.5))


def test_every_script_is_on_the_page() -> None:
    scripts = {path.stem for path in (FOLDER / "paper").glob("*.py") if path.stem.startswith(("fig", "table", "walls"))}
    assert scripts == {script.module for script in page.SCRIPTS}
    assert set(NUMBERS) == {script.entry for script in page.SCRIPTS}


def test_the_page_has_every_figure_and_table(tmp_path: Path) -> None:
    """The one in the repository, as `make paper` left it."""
    text = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
    shutil.copytree(ROOT / "docs" / "paper", tmp_path / "paper")
    assert page.write(tmp_path).read_text(encoding="utf-8") == text
    for script in page.SCRIPTS:
        assert (ROOT / "docs" / "paper" / f"{script.entry}.png").is_file()
        assert f"paper/{script.entry}.png" in text
    named = {int(number) for title in re.findall(r"^## (Figs?\..*?):", text, re.M) for number in numbers_in(title)}
    assert named == {*range(2, 15), 17, 18, 19}
    assert len(re.findall(r"^## Table [12]:", text, re.M)) == 2


def numbers_in(title: str) -> list[int]:
    """Return the figures that a title names.

    >>> numbers_in("Figs. 7 and 8"), numbers_in("Figs. 2 to 4")
    ([7, 8], [2, 3, 4])
    """
    found = [int(number) for number in re.findall(r"\d+", title)]
    return list(range(found[0], found[-1] + 1)) if " to " in title else found


@pytest.mark.longest
def test_a_page_without_models_says_so(tmp_path: Path) -> None:
    (tmp_path / "paper").mkdir()
    main_of(page.SCRIPTS[0])(tmp_path / "paper", small=True)
    text = page.write(tmp_path).read_text(encoding="utf-8")
    assert "## Fig. 2: " in text
    assert "## fig06\n\nNot run: " in text


@pytest.mark.longest
@pytest.mark.skipif(shutil.which("prusa-slicer") is None, reason="prusa-slicer is not installed: make slicers")
def test_the_example_before_the_slicer_slices(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, FOLDER / "03_before_the_slicer.py", tmp_path], capture_output=True, encoding="utf-8"
    )
    assert done.returncode == 0, done.stderr
    assert "sliced" in done.stdout
    used = re.search(r"filament used \[cm3\] = ([\d.]+)", (tmp_path / "block.gcode").read_text(encoding="utf-8"))
    assert float(used[1]) == pytest.approx(0.714, rel=0.15)  # the mesh; slicers draw such walls only roughly


@pytest.mark.longest
def test_without_models_a_script_says_so(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "examples.paper.fig06_silhouettes", tmp_path, "--small"],
        cwd=ROOT,
        env={**os.environ, "INFILL_DATA": str(tmp_path / "none")},
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == LEFT_OUT
    assert done.stderr.startswith("error: no models at ")
    assert done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_missing_models_are_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("INFILL_DATA", str(tmp_path / "none"))
    with pytest.raises(models.MissingModels, match="set INFILL_DATA"):
        models.folder()
    monkeypatch.setenv("INFILL_DATA", str(tmp_path))
    with pytest.raises(models.MissingModels, match="there is no"):
        models.voxels("pig", 20)


# --- with a slicer ---------------------------------------------------------------------------------------

SLICERS = FOLDER / "slicers"
needs_prusa = pytest.mark.skipif(
    shutil.which("prusa-slicer") is None, reason="prusa-slicer is not installed: make slicers"
)
needs_bash = pytest.mark.skipif(
    shutil.which("bash") is None or sys.platform == "win32", reason="there is no bash of a POSIX system here"
)
SECTIONS = 16  # of 20 layers, four are solid


def run_script(script: str, *words: str | Path, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a script beside a program `infill` that is ours."""
    programs = folder / "programs"
    programs.mkdir(exist_ok=True)
    program = programs / "infill"
    program.write_text(f"#!/bin/sh\nexec '{sys.executable}' -m infill.cli \"$@\"\n", encoding="utf-8")
    program.chmod(0o755)
    runs = "bash" if script.endswith(".sh") else sys.executable
    environment = {**os.environ, "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
    environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), environment.get("PYTHONPATH", "")])
    command = [runs, SLICERS / script, *words]
    return subprocess.run(command, capture_output=True, encoding="utf-8", env=environment, timeout=120, check=False)


def part_and_settings(folder: Path) -> tuple[Path, Path]:
    """A part with a blank in its name, and settings as PrusaSlicer exports them."""
    part = box(folder, (20, 20, 4)).rename(folder / "my part.stl")
    settings = {
        **PRINT,
        "top_solid_layers": 2,
        "bottom_solid_layers": 2,
        "gcode_flavor": "marlin2",
    }  # as fast as it can
    ini = folder / "my settings.ini"
    ini.write_text("".join(f"{name} = {value}\n" for name, value in settings.items()), encoding="utf-8")
    return part, ini


def loaded(name: str) -> Callable[..., float]:
    spec = importlib.util.spec_from_file_location(f"example_{name}", SLICERS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.main


def test_every_script_for_slicers_is_tried() -> None:
    """But for the one for PowerShell, which says so."""
    tried = {"slice_and_refill.sh", "slice_and_refill.py", "refill_folder.sh", "refill_folder.py"}
    assert {path.name for path in SLICERS.iterdir() if path.is_file()} == {*tried, "slice_and_refill.ps1"}
    assert "not run on Windows" in (SLICERS / "slice_and_refill.ps1").read_text(encoding="utf-8")


@pytest.mark.longest
@needs_prusa
def test_a_part_is_sliced_and_refilled_by_python(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    part, ini = part_and_settings(tmp_path)
    saved = loaded("slice_and_refill")(part, "--load", str(ini))
    assert f"{SECTIONS} of {SECTIONS} sections of infill replaced" in capsys.readouterr().out
    assert 0.1 < saved < 0.5  # of a honeycomb's time
    assert b"; refilled by" in (tmp_path / "my part.smooth.gcode").read_bytes()
    assert b"; refilled by" not in (tmp_path / "my part.gcode").read_bytes()


@pytest.mark.longest
@needs_prusa
@needs_bash
def test_a_part_is_sliced_and_refilled_by_bash(tmp_path: Path) -> None:
    part, ini = part_and_settings(tmp_path)
    done = run_script("slice_and_refill.sh", part, "--load", ini, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert f"{SECTIONS} of {SECTIONS} sections" in done.stderr
    change = re.search(r"sparse infill +\S+ +\S+ +(-[\d.]+)%", done.stdout)
    assert 10 < -float(change[1]) < 50
    assert b"; refilled by" in (tmp_path / "my part.smooth.gcode").read_bytes()
    assert run_script("slice_and_refill.sh", folder=tmp_path).returncode == 2
    assert run_script("slice_and_refill.sh", tmp_path / "none.stl", folder=tmp_path).returncode != 0


@pytest.mark.longest
@pytest.mark.parametrize("script", ["refill_folder.py", pytest.param("refill_folder.sh", marks=needs_bash)])
def test_a_folder_is_refilled(script: str, tmp_path: Path) -> None:
    """Three sections in each of two prints; what is no print stays as it was."""
    folder = tmp_path / "my prints"
    folder.mkdir()
    for name, slicer in (("a b.gcode", "prusa"), ("c.gcode", "orca")):
        (folder / name).write_bytes(written(Dialect(slicer=slicer, layers=5)))
    (folder / "broken.gcode").write_bytes(b"hello")
    (folder / "notes.txt").write_bytes(b"hello")
    done = run_script(script, folder, folder=tmp_path)
    said = done.stdout + done.stderr
    assert said.count("3 of 3 sections") == 2
    assert "the file has no line of G-code in it" in said
    assert done.returncode == (1 if script.endswith(".sh") else 0)
    for name in ("a b.gcode", "c.gcode"):
        assert b"; refilled by" in (folder / name).read_bytes()
    assert (folder / "broken.gcode").read_bytes() == b"hello"
    assert "refilled before" in (again := run_script(script, folder, folder=tmp_path)).stdout + again.stderr
