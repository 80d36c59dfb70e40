"""A print that was refilled before: another pattern replaces the infill again, and what cannot be had is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from gcode_judge import judge
from test_command_line import run

from infill import UsageError, refill
from infill.gcode.survey import STAMP
from infill.samples.catalogue import write_sample

pytestmark = pytest.mark.usefixtures("compiled")


@pytest.fixture(scope="module")
def sliced(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("again") / "print.gcode"
    write_sample("print", path)
    return path


@pytest.mark.long
@pytest.mark.parametrize("first", ["keep", "honeycomb"])
def test_another_pattern_replaces_the_infill_again(first: str, sliced: Path, tmp_path: Path) -> None:
    """All sections get the new pattern, with the same filament and nothing else changed, as from the sliced print."""
    once, twice, straight = (tmp_path / f"{name}.gcode" for name in ("once", "twice", "straight"))
    refill(sliced, output=once, pattern=first)
    again = refill(once, output=twice, pattern="grid").report
    direct = refill(sliced, output=straight, pattern="grid").report
    assert not again["print"]["already_refilled"]
    assert again["sections"] == direct["sections"]
    assert again["sections"]["replaced"] > 0
    unstamped = b"".join(line for line in once.read_bytes().splitlines(keepends=True) if not line.startswith(STAMP))
    assert judge(unstamped, twice.read_bytes(), filament=(0.99, 1.01)) == []
    assert twice.read_bytes().count(STAMP) == 1
    assert len(twice.read_bytes()) == pytest.approx(len(straight.read_bytes()), rel=0.1)  # as much infill


@pytest.mark.parametrize("options", [{"smooth_radius": 1.0}, {"density": "same"}, {"layers": (2, 5)}])
def test_what_needs_the_paths_of_the_slicer_is_refused(options: dict[str, Any], sliced: Path, tmp_path: Path) -> None:
    once, target = tmp_path / "once.gcode", tmp_path / "twice.gcode"
    refill(sliced, output=once)
    with pytest.raises(
        UsageError, match="slicer's own paths, and this print was refilled before; refill the print that"
    ):
        refill(once, output=target, **options)
    assert not target.exists()


@pytest.mark.parametrize("options", [{}, {"smooth_radius": 1.0}, {"pattern": "grid", "density": 0.3}])
def test_what_was_done_is_nothing_to_do(options: dict[str, Any], sliced: Path, tmp_path: Path) -> None:
    """A slicer may run the command after every export."""
    once = tmp_path / "once.gcode"
    refill(sliced, output=once, **options)
    before = once.read_bytes()
    done = refill(once, **options)
    assert done.report["print"]["already_refilled"]
    assert done.path is None
    assert once.read_bytes() == before


@pytest.mark.longest
def test_what_was_refilled_is_not_called_the_slicers(sliced: Path, tmp_path: Path) -> None:
    """Values before and the stated estimate are those of the last refill, in the report and in the summary."""
    once = tmp_path / "once.gcode"
    refill(sliced, output=once, pattern="grid")
    again = run("refill", once, "--pattern", "voronoi", "--set", "cell=2", "--dry-run", "--json")
    report, told = json.loads(again.stdout), " ".join(again.stderr.split())
    assert report["print"]["refilled_before"]
    assert "the last refill said" in told
    assert "slower than that of the last refill" in told
    assert "slicer" not in told
    told = " ".join(run("refill", sliced, "--pattern", "voronoi", "--set", "cell=2", "--dry-run").stderr.split())
    assert "the slicer said" in told
    assert "slower than the slicer's" in told
