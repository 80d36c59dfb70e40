"""Several files to smooth, fill and refill: each has its result, failures are listed at the end, and the rest is done."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from handmade_prints import Dialect, written
from made_shapes import box
from test_command_line import run, usage_error

from infill import check
from infill.cli.several import expand_files


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two small parts, a broken one and two prints."""
    monkeypatch.chdir(tmp_path)
    box(10, 8, 6).export("a.stl")
    shutil.copy("a.stl", "b.v2.stl")
    Path("broken.stl").write_text("no mesh")
    for name in ("one", "two"):
        Path(f"{name}.gcode").write_bytes(written(Dialect(size=20.0)))
    return tmp_path


def names(folder: str) -> list[str]:
    return sorted(path.name for path in Path(folder).iterdir())


def test_what_fails_is_listed_at_the_end_and_the_rest_is_done(folder: Path) -> None:
    result = run("smooth", "broken.stl", "a.stl", "missing.stl", "b.v2.stl", "--voxel", "1", "-o", "out/deep")
    assert result.exit_code == 1
    assert names("out/deep") == ["a.stl", "b.v2.stl"]
    assert check("out/deep/a.stl").printable
    assert Path("out/deep/a.stl").read_bytes() == Path("out/deep/b.v2.stl").read_bytes()
    *_, head, first, second = result.stderr.splitlines()
    assert head == "2 of 4 files failed:"
    assert first.startswith("  broken.stl is neither text nor a whole binary STL")
    assert second == "  there is no file missing.stl; check the name"
    assert "Traceback" not in result.stderr


def test_each_file_has_the_result_that_it_has_alone(folder: Path) -> None:
    both = run("refill", "one.gcode", "two.gcode", "--pattern", "gyroid", "-o", "out")
    alone = run("refill", "one.gcode", "--pattern", "gyroid", "-o", "alone.gcode")
    assert (both.exit_code, alone.exit_code) == (0, 0)
    assert names("out") == ["one.gcode", "two.gcode"]
    assert Path("out/one.gcode").read_bytes() == Path("alone.gcode").read_bytes()
    assert "failed" not in both.stderr


def test_prints_are_refilled_in_place_without_a_folder(folder: Path) -> None:
    before = Path("one.gcode").read_bytes()
    assert run("refill", "one.gcode", "two.gcode", "-q").exit_code == 0
    assert Path("one.gcode").read_bytes() == Path("two.gcode").read_bytes() != before


@pytest.mark.slow
def test_parts_become_projects(folder: Path) -> None:
    result = run("fill", "a.stl", "b.v2.stl", "--for", "prusaslicer", "--voxel", "1", "-o", "out", "-q")
    assert result.exit_code == 0, result.stderr
    assert names("out") == ["a.3mf", "b.v2.3mf"]


def test_a_placeholder_names_results_beside_their_inputs(folder: Path) -> None:
    Path("deep").mkdir()
    shutil.move("b.v2.stl", "deep/a.stl")
    words = ("--voxel", "1", "-o", "{folder}/{name}-smooth.3mf", "--preview", "{folder}/{name}.png", "-q")
    assert run("smooth", "a.stl", "deep/a.stl", *words).exit_code == 0
    assert {"a-smooth.3mf", "a.png"} <= set(names("."))
    assert names("deep") == ["a-smooth.3mf", "a.png", "a.stl"]
    assert run("smooth", "a.stl", "--voxel", "1", "-o", "{name}.obj", "-q").exit_code == 0  # of a single file too
    assert Path("a.obj").is_file()


@pytest.mark.parametrize("output", ["x.stl", "-"])
def test_no_result_replaces_that_of_another_file(folder: Path, output: str) -> None:
    usage_error(
        run("smooth", "a.stl", "b.v2.stl", "--voxel", "1", "-o", output), "2 files would write to .*name a folder"
    )
    assert not Path("x.stl").exists()


def test_files_of_one_name_need_their_folders(folder: Path) -> None:
    Path("deep").mkdir()
    shutil.copy("a.stl", "deep/a.stl")
    usage_error(run("smooth", "a.stl", "deep/a.stl", "--voxel", "1", "-o", "out"), "{folder}/{name}")
    assert not Path("out").exists()


def test_a_dry_run_leaves_no_folder_and_reports_come_one_after_another(folder: Path) -> None:
    result = run("smooth", "a.stl", "b.v2.stl", "--voxel", "1", "-o", "out", "--dry-run", "--json")
    assert result.exit_code == 0, result.stderr
    assert not Path("out").exists()
    decoder, rest, reports = json.JSONDecoder(), result.stdout.strip(), []
    while rest:
        report, end = decoder.raw_decode(rest)
        reports.append(report)
        rest = rest[end:].strip()
    assert len(reports) == 2


def test_a_folder_in_which_nothing_was_written_goes_again(folder: Path) -> None:
    assert run("smooth", "broken.stl", "missing.stl", "-o", "out/deep").exit_code == 1
    assert not Path("out").exists()


def test_an_option_that_is_wrong_ends_the_run_before_the_first_file(folder: Path) -> None:
    usage_error(run("smooth", "a.stl", "b.v2.stl", "--smooth", "hard", "-o", "out"), "--smooth")
    assert not Path("out").exists()


def test_nothing_to_write_is_wrong_usage_once(folder: Path) -> None:
    usage_error(run("smooth", "a.stl", "b.v2.stl"), "nothing to write; give -o FILE")
    usage_error(run("fill", "a.stl", "b.v2.stl"), "nothing to write; give -o FILE")


def test_stars_are_expanded_where_no_shell_does(folder: Path) -> None:
    assert expand_files(["*.gcode", "one.gcode", "none*.stl"]) == [
        Path("one.gcode"),
        Path("two.gcode"),
        Path("none*.stl"),
    ]


def test_a_star_that_matches_one_file_is_that_file(folder: Path) -> None:
    assert run("smooth", "a*.stl", "--voxel", "1", "-o", "x.stl", "-q").exit_code == 0
    assert Path("x.stl").is_file()


def test_commands_with_one_file_still_refuse_more(folder: Path) -> None:
    usage_error(run("motion", "one.gcode", "two.gcode", "one.gcode"), "extra argument")
