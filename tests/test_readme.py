"""What README and the pages show works: their blocks run in order, each page in a folder of its own.

README and the tutorials begin in an empty folder; the pages that say how, in one with a user's own files.
"""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from handmade_prints import Dialect, written
from PIL import Image
from test_command_line import run
from test_label_tables import FIELDS, seg_nrrd
from test_scans import write_series
from test_simulation_fields import bricks, frd

from infill.lattices import sizing

pytestmark = pytest.mark.usefixtures("coarse_grids", "coarse_lines")

ROOT = Path(__file__).resolve().parents[1]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# The pages whose blocks run: README and the tutorials, which bring all they need, and the pages that say how.
COMPLETE = [
    "README.md",
    *sorted(page.relative_to(ROOT).as_posix() for page in (ROOT / "docs" / "tutorials").glob("*.md")),
]
HOW_TO = [f"docs/{name}.md" for name in ("make", "smooth", "fill", "refill", "motion", "printer")]
PAGES = [*COMPLETE, *HOW_TO]
# Lines that install from a clone.
SKIPPED = {
    "git clone https://github.com/phasefill/phasefill",
    "pip install ./phasefill",
}
ENDLESS = "infill studio "  # serves a page until it is stopped; tests/test_studio_in_browser.py tries it
# What a user has, and the pages that say how therefore do not make.
GIVEN = {
    "scan.nrrd",
    "scan.nii.gz",
    "large.nii.gz",
    "labels.nrrd",
    "labels.seg.nrrd",
    "dicom-folder",
    "part.stl",
    "part.frd",
    "cloud.xyz",
    "leaf.svg",
    "loads.png",
    "print.gcode",
    "before.gcode",
    "after.gcode",
    "printer.cfg",
    "m503.txt",
}


def blocks(text: str) -> list[tuple[str, str]]:
    """Return the fenced blocks of a page: the language, and what stands in them.

    >>> blocks("a\\n```bash\\ninfill list\\n```\\nb\\n")
    [('bash', 'infill list\\n')]
    """
    return [(found[1], found[2]) for found in FENCE.finditer(text)]


def page_blocks(page: str) -> list[tuple[str, str]]:
    """Return the fenced blocks of a page of the repository."""
    return blocks((ROOT / page).read_text(encoding="utf-8"))


def row_names(text: str) -> list[str]:
    """Return the first words of the rows of a summary or a table, up to two blanks.

    >>> row_names("part.stl\\n  mesh    12 triangles\\n\\n  open sides  2")
    ['part.stl', 'mesh', 'open sides']
    """
    return [re.split(r"\s{2,}", line.strip())[0] for line in text.splitlines() if line.strip()]


def without_numbers(name: str) -> str:
    """Return a row's name with N for every number, as they may differ from machine to machine.

    >>> without_numbers("honeycomb, 40.05 x 40.05 x 4 mm")
    'honeycomb, N x N x N mm'
    """
    return re.sub(r"\d[\d.,]*\d|\d", "N", name)


@pytest.fixture
def coarse_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `fill` take the coarsest grids that still resolve a pattern: what runs is tested, not how fine it is."""
    monkeypatch.setattr(sizing, "FINE", sizing.LEAST_FINE._replace(across=sizing.FINE.across))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with nothing but small stand-ins for what a user has."""
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    monkeypatch.chdir(tmp_path)
    shape = (26, 26, 26)
    radius = np.linalg.norm(np.indices(shape) - 12.5, axis=0)
    bone = np.clip(226 + 100 * (8 - radius), -1000, 1000).round().astype(np.int16)
    image = sitk.GetImageFromArray(bone)
    image.SetSpacing((0.7, 0.7, 1.0))
    for name in ("scan.nrrd", "scan.nii.gz", "large.nii.gz"):
        sitk.WriteImage(image, name)
    Path("dicom-folder").mkdir()
    write_series(sitk, Path("dicom-folder"), "1.2.826.0.1.1", image)
    labels = np.where(radius < 8, 3, 0).astype(np.uint8)
    labels[13:][labels[13:] == 3] = 4
    sitk.WriteImage(sitk.GetImageFromArray(labels), "labels.nrrd")
    seg_nrrd(Path("labels.seg.nrrd"), FIELDS.partition("Segment10")[0], (labels.T.clip(2) - 2).astype(np.uint8))
    trimesh.creation.box((40, 12, 10)).export("part.stl")  # slender: voxels are counted along its length
    np.savetxt("cloud.xyz", trimesh.sample.sample_surface(trimesh.creation.icosphere(3, 5.0), 4000, seed=1)[0])
    leaf = '<path d="M2 10 Q10 0 18 10 Q10 20 2 10 Z"/>'
    Path("leaf.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">{leaf}</svg>'
    )
    Image.fromarray(np.tile(np.arange(0, 240, 4, dtype=np.uint8), (60, 1))).save("loads.png")
    stressed = bricks((12.0, 12.0, 1.0), (4, 4, 1)).points
    Path("part.frd").write_text(frd(stressed, {"STRESS": {"SXX": stressed[:, 0]}}))
    for name in ("print.gcode", "before.gcode", "after.gcode"):
        Path(name).write_bytes(written(Dialect(layers=5)))
    Path("printer.cfg").write_text("[printer]\nkinematics: corexy\nmax_velocity: 300\nmax_accel: 3000\n")
    Path("m503.txt").write_text("echo: M203 X200 Y200 Z12 E120\necho: M204 P1000 R1000 T1000\necho: M205 X8 Y8\n")
    assert {path.name for path in tmp_path.iterdir()} == GIVEN
    return tmp_path


def globbed(word: str) -> list[str]:
    """Return the files that a word with * stands for, or the word."""
    return sorted(str(path) for path in Path().glob(word)) if "*" in word else [word]


def done(line: str) -> Any:
    """Run a line as a shell would, in this process, and return what came of it."""
    words = [found for word in shlex.split(line, comments=True) for found in globbed(word)]
    target = words.pop() if ">" in words else ""
    result = run(*(word for word in words[1:] if word != ">"))
    if target:
        Path(target).write_bytes(result.stdout_bytes)
    return result


@pytest.mark.parametrize("page", PAGES)
def test_every_line_runs_or_installs(page: str) -> None:
    lines = [line for language, block in page_blocks(page) if language == "bash" for line in block.splitlines()]
    assert lines
    for line in lines:
        assert line.startswith("infill ") or line in SKIPPED
    if page == "README.md":
        assert [line for line in lines if line in SKIPPED] == lines[: len(SKIPPED)]  # the first block installs
        assert {language for language, _ in page_blocks(page)} == {"bash", "python", "text"}
        assert set(lines) >= SKIPPED


@pytest.mark.longest
@pytest.mark.parametrize("page", COMPLETE)
def test_the_blocks_of_a_page_run_in_an_empty_folder(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In their order, with nothing that a reader must bring."""
    monkeypatch.chdir(tmp_path)
    run_page(page, capsys)


@pytest.mark.longest
@pytest.mark.parametrize("page", HOW_TO)
def test_the_blocks_of_a_page_run_with_the_files_of_a_user(
    page: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run_page(page, capsys)


def run_page(page: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Run the blocks of a page in their order; a block of text shows rows that the block before it printed.

    No block of Python replaces a file: where a command would refuse, a reader would not expect it.
    """
    printed = ""
    for language, block in page_blocks(page):
        if language in ("bash", "python"):
            printed = ""
        if language == "python" and (saved := re.match(r"# (\w+\.py)\n", block)):
            Path(saved[1]).write_text(block)
        elif language == "python":
            before = {path: path.stat().st_mtime_ns for path in Path().iterdir()}
            exec(compile(block, page, "exec"), {})
            assert {path: path.stat().st_mtime_ns for path in before} == before, block
            printed = capsys.readouterr().out
        for line in block.splitlines() if language == "bash" else []:
            if line in SKIPPED or line.startswith(ENDLESS):
                continue
            result = done(line)
            assert result.exit_code == 0, f"{line}\n{result.output}"
            printed += result.output
            for made in re.findall(
                r"(?:-o|--preview|--save-config|--plot|>) (?:layers=)?(\S+)", line.partition(" #")[0]
            ):
                if "--dry-run" not in line and "{" not in made and made != "-":
                    assert Path(made).stat().st_size > 100, line
        if language == "text":
            printed_rows = {without_numbers(name) for name in row_names(printed)}
            # A print of a user's own has features of its own.
            rows = [name for name in row_names(block) if "gcode" not in printed or name[0].islower()]
            assert {without_numbers(name) for name in rows} <= printed_rows


@pytest.mark.slow
def test_every_label_of_the_segmentation_was_written(folder: Path) -> None:
    (line,) = [line for _, block in page_blocks("docs/smooth.md") for line in block.splitlines() if "{label}" in line]
    assert done(line).exit_code == 0
    assert {"Femur, left_right.stl", "Cartilage.stl"} & {path.name for path in folder.iterdir()}


def test_a_command_that_fails_leaves_no_report(folder: Path) -> None:
    """What is redirected is JSON or nothing."""
    assert done("infill make honeycomb -o part.stl --json > report.json").exit_code == 1
    assert Path("report.json").read_text() == ""
