"""Files to try the commands with: each is what its command takes, the same every time, and never replaces a file."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from test_command_line import one_line_error, run, usage_error

from infill import FormatError, OutputError, ParameterError, check, motion, read_mesh, read_volume, refill, write_sample
from infill.samples.catalogue import SAMPLES
from infill.samples.plate_print import LAYERS


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, which is the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_command_lists_them_without_a_name(folder: Path) -> None:
    result = run("sample")
    assert result.exit_code == 0
    rows = result.stdout.splitlines()
    assert [row.split()[0] for row in rows[: len(SAMPLES)]] == [*SAMPLES]
    assert not list(folder.iterdir())


def test_the_command_makes_what_it_is_told(folder: Path) -> None:
    result = run("sample", *SAMPLES)
    assert result.exit_code == 0
    assert result.stdout == ""
    assert [line.split()[1] for line in result.stderr.splitlines()] == [each.file for each in SAMPLES.values()]
    assert {path.name for path in folder.iterdir()} == {each.file for each in SAMPLES.values()}
    assert all(10_000 < path.stat().st_size < 1_000_000 for path in folder.iterdir())
    other = run("sample", "part", "-q", "-o", "bracket.3mf")
    assert other.output == ""
    np.testing.assert_allclose(read_mesh("bracket.3mf").bounds, read_mesh("part.stl").bounds, atol=1e-4)


def test_no_file_is_replaced_unless_asked_to(folder: Path) -> None:
    Path("scan.nrrd").write_bytes(b"mine")
    one_line_error(run("sample", "part", "scan"), r"scan\.nrrd exists; give another name, or --force to overwrite it")
    assert [path.name for path in folder.iterdir()] == ["scan.nrrd"]
    with pytest.raises(OutputError, match="exists"):
        write_sample("scan")
    assert Path("scan.nrrd").read_bytes() == b"mine"
    assert run("sample", "scan", "--force").exit_code == 0
    whole = Path("scan.nrrd").read_bytes()
    assert whole.startswith(b"NRRD")
    write_sample("scan", overwrite=True)
    assert Path("scan.nrrd").read_bytes() == whole


@pytest.mark.parametrize("name", SAMPLES)
def test_the_same_name_makes_the_same_bytes(name: str, folder: Path) -> None:
    first, second = write_sample(name), write_sample(name, f"again{Path(SAMPLES[name].file).suffix}")
    assert first.read_bytes() == second.read_bytes()


def test_mistakes_are_told(folder: Path) -> None:
    one_line_error(run("sample", "bone"), "there is no sample 'bone'; choose part, scan or print")
    one_line_error(run("sample", "scan", "-o", "a.nii"), r"a\.nii does not end in \.nrrd")
    usage_error(run("sample", "-o", "a.stl"), "name one")
    usage_error(run("sample", "part", "scan", "-o", "a.stl"), "one file")
    with pytest.raises(ParameterError, match="there is no sample"):
        write_sample("bone")
    with pytest.raises(FormatError, match=r"does not end in \.gcode"):
        write_sample("print", "a.stl")
    assert not list(folder.iterdir())


def test_the_part_is_a_solid_with_three_holes(folder: Path) -> None:
    inspection = check(write_sample("part"))
    assert inspection.printable
    assert not inspection.warnings
    assert inspection.components == 1
    np.testing.assert_allclose(inspection.extents, (60, 40, 40), atol=1e-4)
    part = read_mesh("part.stl")
    edges = np.unique(np.sort(part.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
    assert len(part.vertices) - len(edges) + len(part.faces) == 2 - 2 * 3  # Euler: two for a ball, two less a hole


def test_bone_is_what_the_threshold_says(folder: Path) -> None:
    """One piece with a cavity, well inside the scan; flesh around it, and air around that."""
    from scipy.ndimage import binary_fill_holes, label

    scan = read_volume(write_sample("scan"))
    bone = scan.values >= 226
    assert label(bone)[1] == 1
    assert label(binary_fill_holes(bone) & ~bone)[1] == 1
    assert not any(bone.take([0, -1], axis).any() for axis in range(3))
    assert scan.values.min() < -900
    assert scan.values.max() > 1000
    assert scan.space == "LPS"


def test_the_print_states_what_it_is(folder: Path) -> None:
    path = write_sample("print")
    plan = motion(path)
    assert plan.layers == LAYERS
    assert not plan.unread_lines
    assert not plan.macros
    assert set(plan.sources.values()) == {"commands"}
    assert plan.estimate == pytest.approx(plan.seconds, abs=1)
    text = path.read_text(encoding="ascii")
    stated = float(re.search(r"filament used \[mm\] = ([\d.]+)", text)[1])  # type: ignore[index]
    assert stated == pytest.approx(plan.filament, abs=0.01)
    places = np.array([[float(x), float(y)] for x, y in re.findall(r"^G1 X([\d.]+) Y([\d.]+) E", text, re.M)])
    assert places.min() > 50
    assert places.max() < 150  # of a bed of 200 mm


def test_refill_improves_the_print(folder: Path) -> None:
    """Every section, with as much of its lines on the layer below; the infill takes over a tenth less time."""
    result = refill(write_sample("print"), output="smooth.gcode")
    assert not result.report["problems"]
    assert motion("smooth.gcode").of_role("sparse infill") < 0.9 * motion("print.gcode").of_role("sparse infill")
