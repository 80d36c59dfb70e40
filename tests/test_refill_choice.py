"""`--pattern auto`: our honeycomb where it prints faster with the same filament, else the slicer's own paths."""

from __future__ import annotations

from pathlib import Path

import pytest
from handmade_prints import Dialect, written
from test_command_line import run

from infill import UsageError, refill
from infill.refilling.choosing import choose_pattern


def report(seconds: float, *, filament: float = 100.0, replaced: int = 10) -> dict:
    return {
        "time": {"print_after_s": seconds},
        "filament": {"infill_before_mm": 100.0, "infill_after_mm": filament},
        "sections": {"all": 10, "replaced": replaced},
    }


@pytest.mark.parametrize(
    ("honeycomb", "taken", "words"),
    [
        (report(90.0), "honeycomb", "it prints faster"),
        (report(101.0), "keep", "would be no faster"),
        (report(90.0, filament=103.0), "keep", r"would take \+3.0% filament"),
        (report(90.0, replaced=8), "keep", "fits in 8 of 10 sections"),
    ],
)
def test_the_faster_pattern_is_taken_if_it_fits(honeycomb: dict, taken: str, words: str) -> None:
    import re

    pattern, choice = choose_pattern({"honeycomb": honeycomb, "keep": report(100.0)}.__getitem__)
    assert pattern == taken
    assert choice is not None
    assert re.search(words, choice["reason"])
    assert choice["seconds"] == {"honeycomb": honeycomb["time"]["print_after_s"], "keep": 100.0}


def test_what_auto_writes_is_what_the_pattern_writes(tmp_path: Path) -> None:
    """And the summary says which it is, and why; a second time there is nothing to do."""
    path, chosen, named = tmp_path / "print.gcode", tmp_path / "auto.gcode", tmp_path / "named.gcode"
    path.write_bytes(written(Dialect(slicer="orca")))
    result = refill(path, output=chosen, pattern="auto")
    taken = result.report["request"]["pattern"]
    refill(path, output=named, pattern=taken)
    assert chosen.read_bytes() == named.read_bytes()
    times = result.report["choice"]["seconds"]
    assert taken == min(times, key=lambda pattern: times[pattern]) or taken == "keep"
    shown = run("refill", path, "-o", tmp_path / "again.gcode", "--pattern", "auto").stderr
    assert f"{taken}, since" in " ".join(shown.split())
    again = refill(chosen, output=tmp_path / "twice.gcode", pattern="auto")
    assert "choice" not in again.report
    assert (tmp_path / "twice.gcode").read_bytes() == chosen.read_bytes()


def test_options_of_one_pattern_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "print.gcode"
    path.write_bytes(written(Dialect(slicer="orca")))
    with pytest.raises(UsageError):
        refill(path, pattern="auto", density=0.2, dry_run=True)
