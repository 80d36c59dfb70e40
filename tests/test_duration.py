"""How long a block will take to smooth: measured per step and cell, and told where that is long."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_command_line import SMALL, one_line_error, run

import infill.making.duration
from infill.making.duration import ASSUMED_RATE, TRIAL_STEPS, duration_warning, smoothing_seconds
from infill.making.settings import MakeSettings, resolve

PER_CELL_AND_STEP = 5e-9  # s, of the machine that the tests pretend to run on
LONG = 1_000_000_000  # steps


@pytest.fixture
def tried(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, ...]]:
    """A clock that only smoothing moves; the shapes that are smoothed are kept."""
    clock, shapes = [0.0], []

    def smooth(f: np.ndarray, smoothing: Any) -> None:
        shapes.append(f.shape)
        assert smoothing.steps == TRIAL_STEPS
        clock[0] += f.size * smoothing.steps * PER_CELL_AND_STEP + (1.0 if len(shapes) == 1 else 0.0)

    monkeypatch.setattr(infill.making.duration, "smooth", smooth)
    monkeypatch.setattr(infill.making.duration.time, "perf_counter", lambda: clock[0])
    return shapes


def block(size: str, steps: int) -> Any:
    return resolve({"pattern": "honeycomb", "size": size, "steps": steps}).plan()


@pytest.mark.parametrize(("size", "steps"), [("60", 10**6), ("250x210", 10**5), ("20", LONG)])
def test_the_time_is_that_of_all_cells_and_steps(size: str, steps: int, tried: list[Any]) -> None:
    """What the first try takes to load counts for nothing, and a large grid is measured on a piece."""
    long = block(size, steps)
    assert smoothing_seconds(long) == pytest.approx(long.grid.cells * steps * PER_CELL_AND_STEP)
    assert len(tried) == 2
    assert all(side <= 1000 for shape in tried for side in shape)


def test_what_is_short_is_neither_measured_nor_told(tried: list[Any]) -> None:
    for size, steps in (("60", 0), ("60", 10), ("250x210", 100)):
        assert smoothing_seconds(block(size, steps)) <= block(size, steps).grid.cells * steps * ASSUMED_RATE
        assert duration_warning(block(size, steps)) == ""
    assert tried == []


def test_the_warning_says_how_long_and_what_to_do(tried: list[Any]) -> None:
    assert duration_warning(block("60", LONG)) == (
        "1,000,000,000 steps on 400 x 400 cells take about 9 days here; take fewer steps (10 are usual), or fewer cells"
    )
    assert "about 2 minutes here" in duration_warning(block("60", 150_000))


@pytest.mark.slow
def test_a_dry_run_tells_what_many_steps_cost(tmp_path: Path) -> None:
    words = ["make", "honeycomb", *SMALL, "--dry-run", "-o", tmp_path / "a.stl"]
    result = run(*words, "--steps", LONG)
    assert result.exit_code == 0
    assert re.fullmatch(r"warning: 1,000,000,000 steps on .* take about \d+ \w+ here; .*\n", result.stderr)
    assert "133 x 133 cells" in result.stdout
    assert run(*words).stderr == ""


def test_make_tells_it_before_it_begins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stops(*args: Any, **options: Any) -> None:
        raise MemoryError

    monkeypatch.setattr(MakeSettings, "make", stops)
    words = ["make", "honeycomb", *SMALL, "--steps", str(LONG), "-o", tmp_path / "a.stl"]
    told = run(*words).stderr.splitlines()
    assert told[0].startswith("warning: 1,000,000,000 steps")
    assert told[1].startswith("error: out of memory")
    assert len(run(*words, "-q").stderr.splitlines()) == 1


def test_memory_is_told_first(tmp_path: Path) -> None:
    """What cannot be made at all needs no warning of its time."""
    one_line_error(run("make", "honeycomb", "--size", "100000", "-o", tmp_path / "a.stl"), "GiB of memory")


def test_few_steps_are_not_told_to_be_fewer(tried: list[Any]) -> None:
    assert duration_warning(block("20000", 10)).endswith(" here; take fewer cells")
