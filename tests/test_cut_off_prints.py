"""Prints without their end, and choices of layers and objects that hit nothing."""

from __future__ import annotations

from pathlib import Path

import pytest
from handmade_prints import Dialect, written
from test_command_line import one_line_error, run

from infill import motion, refill
from infill.gcode.ending import ENDS, WORDS, find_missing_end

SLICERS = ("prusa", "orca", "bambu", "cura")


@pytest.mark.parametrize("slicer", SLICERS)
def test_a_print_without_its_end_is_told_and_a_whole_one_is_not(slicer: str, tmp_path: Path) -> None:
    whole = written(Dialect(slicer=slicer, layers=8))
    cut = whole[: int(0.7 * len(whole))]
    said = []
    for name, text in (("whole.gcode", whole), ("cut.gcode", cut), ("half_a_line.gcode", cut[: cut.rfind(b"\n") - 3])):
        (tmp_path / name).write_bytes(text)
        report = refill(tmp_path / name, output=tmp_path / "new.gcode", overwrite=True).report
        problems = [problem for problem in report["problems"] if "it was cut off" in problem]
        missing = motion(tmp_path / name).missing_end
        assert bool(problems) == bool(missing)
        assert not missing or missing in problems[0]
        said.append(bool(missing))
    assert said == [False, True, True]
    assert "CUT OFF" in run("motion", tmp_path / "cut.gcode").stdout
    assert "CUT OFF" not in run("motion", tmp_path / "whole.gcode").stdout


def test_old_and_unknown_slicers_lack_nothing() -> None:
    assert (
        find_missing_end("PrusaSlicer 2.3.3", b"")
        == find_missing_end("Slic3r 1.3", b"")
        == find_missing_end("", b"")
        == ""
    )
    for name, word in WORDS.items():
        assert find_missing_end(f"{name} 5.9", b"G1 X1\n") == word
        assert find_missing_end(f"{name} 5.9", f"G1 X1\n{word}\nM84\n".encode()) == ""
    assert WORDS.keys() == ENDS.keys()


def test_layers_and_objects_that_are_not_there_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "print.gcode"
    path.write_bytes(written(Dialect(labels="comment", objects=2, layers=6, name=b"box.stl")))
    before = sorted(tmp_path.iterdir())
    words = ("refill", path, "-o", tmp_path / "new.gcode")
    one_line_error(
        run(*words, "--layers", "300-400"), "--layers is 300 to 400, and the print has 6; give some from 1 to 6"
    )
    one_line_error(run(*words, "--layers", "7-"), "--layers is 7 and more, and the print has 6")
    one_line_error(
        run(*words, "--object", "vase"), "--object is 'vase', which is in no name of an object; it has .*box"
    )
    assert sorted(tmp_path.iterdir()) == before
    for choice in (["--layers", "2-400"], ["--layers", "6"], ["--object", "box"]):
        assert run(*words, *choice, "--force").exit_code == 0
    path.write_bytes(written(Dialect(layers=6)))
    one_line_error(run(*words, "--object", "vase", "--force"), "nothing in its file names one")
