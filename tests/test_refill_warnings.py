"""What a refill says in plain words: infill that is slower than before, and sections that stay as sliced."""

from __future__ import annotations

import io
import re
from pathlib import Path

import pytest
from handmade_prints import Dialect, written
from test_command_line import run

from infill import refill
from infill.gcode.infill_sections import ODD_ARCS
from infill.gcode.survey import survey_print
from infill.paths.rounding import Rounding
from infill.refilling.report import refill_report
from infill.refilling.request import Request
from infill.refilling.rules import RefillRules
from infill.refilling.stats import PURGED, InfillAmounts, PrintAmounts, RefillStats


def problems(pattern: str, tally: RefillStats, density: float | None = None) -> list[str]:
    request = Request(pattern=pattern, density=density)
    survey = survey_print(io.BytesIO(written(Dialect())))
    rules = RefillRules(request=request, rounding=Rounding())
    return refill_report(request, survey, tally, already=False, rules=rules)["problems"]


@pytest.mark.parametrize(("seconds", "words"), [(144.0, "+44%"), (127.0, "+27%"), (100.5, ""), (80.0, "")])
def test_infill_that_is_slower_is_told(seconds: float, words: str) -> None:
    tally = RefillStats(
        sections=1,
        replaced=1,
        print_before=PrintAmounts(seconds=500.0, infill_seconds=100.0),
        print_after=PrintAmounts(seconds=400.0 + seconds, infill_seconds=seconds),
    )
    told = [problem for problem in problems("gyroid", tally) if "slower" in problem]
    assert len(told) == bool(words)
    assert all(f"takes {words} printing time" in problem for problem in told)


@pytest.mark.parametrize(
    ("density", "seconds", "words"),
    [(0.3, 195.0, ""), (0.3, 220.0, "+120% printing time, +100% filament;"), (None, 195.0, "+95% printing time;")],
)
def test_more_infill_that_was_asked_for_may_take_longer(density: float | None, seconds: float, words: str) -> None:
    tally = RefillStats(
        sections=1,
        replaced=1,
        infill=InfillAmounts(filament=100.0),
        infill_after=InfillAmounts(filament=200.0),
        print_before=PrintAmounts(seconds=500.0, infill_seconds=100.0),
        print_after=PrintAmounts(seconds=400.0 + seconds, infill_seconds=seconds),
    )
    told = [problem for problem in problems("gyroid", tally, density) if "slower" in problem]
    assert len(told) == bool(words)
    assert all(words in problem for problem in told)


@pytest.mark.parametrize(
    ("reason", "number", "words"),
    [
        (PURGED, 4, "4 of 10 sections stay as sliced: a tool change purges filament into them"),
        (ODD_ARCS, 9, "slice with arc fitting off"),
        ("no faster", 5, "round corners would save no time in them"),
        (PURGED, 0, ""),
    ],
)
def test_many_sections_that_stay_are_told(reason: str, number: int, words: str) -> None:
    tally = RefillStats(sections=10, replaced=10 - number, kept={reason: number} if number else {})
    told = [problem for problem in problems("keep", tally) if "stay as sliced" in problem]
    assert len(told) == bool(words)
    assert all(words in problem for problem in told)


def test_a_print_with_arcs_that_climb_says_what_to_do(tmp_path: Path) -> None:
    """In the report and in the summary; plain arcs are refilled."""
    path = tmp_path / "arcs.gcode"
    text = written(Dialect(slicer="orca", arcs=True))
    climbing = re.sub(rb"^(G[23] [^\n]*?)( E)", rb"\1 Z0.9\2", text, flags=re.MULTILINE)
    path.write_bytes(climbing)
    told = refill(path, dry_run=True, pattern="honeycomb").report["problems"]
    assert any("arcs that climb" in problem and "arc fitting off" in problem for problem in told)
    assert "slice with arc fitting off" in " ".join(
        run("refill", path, "--dry-run", "--pattern", "honeycomb").stderr.split()
    )
    path.write_bytes(text)
    assert not any(
        "stay as sliced" in problem for problem in refill(path, dry_run=True, pattern="honeycomb").report["problems"]
    )
    path.write_bytes(written(Dialect(slicer="orca")))
    assert not any(
        "stay as sliced" in problem for problem in refill(path, dry_run=True, pattern="honeycomb").report["problems"]
    )


RING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="6mm" height="6mm" viewBox="0 0 6 6">'
    '<circle cx="3" cy="3" r="2" fill="none" stroke="black"/></svg>'
)


def test_infill_that_touches_no_wall_is_told(tmp_path: Path) -> None:
    """Circles that touch nothing, in the report and in the summary; what is recommended touches walls everywhere."""
    path, ring = tmp_path / "box.gcode", tmp_path / "ring.svg"
    path.write_bytes(written(Dialect(size=30, cell=4)))
    ring.write_text(RING)
    report = refill(path, dry_run=True, pattern=ring).report
    assert report["contact"]["free_before"] == 0
    assert report["contact"]["free_after"] > 0.9
    assert any("touches no wall" in problem and "gyroid" in problem for problem in report["problems"])
    told = " ".join(run("refill", path, "--dry-run", "--pattern", ring).stderr.split())
    assert "free 100% touches no wall, not even through other lines (0%)" in told
    report = refill(path, dry_run=True, pattern="gyroid").report
    assert report["contact"]["free_after"] == 0
    assert not any("touches no wall" in problem for problem in report["problems"])


@pytest.mark.slow
@pytest.mark.parametrize("setting", ["fill_pattern = lightning", "sparse_infill_pattern = lightning"])
def test_a_print_of_lightning_is_told_for_a_new_pattern(setting: str, tmp_path: Path) -> None:
    """Its slicer leaves layers without infill, above which a new pattern begins in the air."""
    sliced = tmp_path / "print.gcode"
    sliced.write_bytes(written(Dialect()) + f"; {setting}\n".encode())
    told = {pattern: refill(sliced, dry_run=True, pattern=pattern).report["problems"] for pattern in ("keep", "gyroid")}
    assert any("is lightning: layers and places" in problem for problem in told["gyroid"])
    assert not any("lightning" in problem for problem in told["keep"])


@pytest.mark.slow
def test_infill_that_stays_above_what_lightning_leaves_empty_is_told(tmp_path: Path) -> None:
    """Layers that are slowed down to cool, purged sections, or those that nobody asked for."""
    sliced = tmp_path / "print.gcode"
    sliced.write_bytes(written(Dialect(layers=8, size=24.0)))
    told = {
        (pattern, layers): refill(sliced, dry_run=True, pattern=pattern, layers=layers).report["problems"]
        for pattern in ("lightning", "gyroid")
        for layers in (None, (1, 4))
    }
    begins = {key: any("begins in the air" in problem for problem in problems) for key, problems in told.items()}
    assert begins == {key: key == ("lightning", (1, 4)) for key in told}


@pytest.mark.slow
def test_infill_that_is_all_gone_is_not_said_to_rest_on_nothing(tmp_path: Path) -> None:
    """In a pin, every roof is near a wall."""
    sliced = tmp_path / "print.gcode"
    sliced.write_bytes(written(Dialect(size=7.0, cell=3.0)))
    report = refill(sliced, output=tmp_path / "new.gcode", pattern="lightning", density=0.1).report
    assert report["filament"]["infill_after_mm"] == 0
    assert not any("rests on the layer below" in problem for problem in report["problems"])
