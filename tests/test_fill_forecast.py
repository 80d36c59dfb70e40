"""What a dry run of a fill promises: its memory within a factor of 2, and errors that the run itself would raise."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from made_shapes import box
from test_command_line import one_line_error, run

pytest.importorskip("resource", reason="peaks of memory are read the POSIX way")

pytestmark = pytest.mark.usefixtures("compiled")
PEAK = (
    "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, capture_output=True);"
    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
)


@pytest.mark.longest
@pytest.mark.parametrize(
    "options",
    [
        pytest.param((), id="one"),
        pytest.param(("--region", "z=10..20:pattern=honeycomb"), id="two", marks=pytest.mark.longest),
    ],
)
def test_the_memory_is_within_a_factor_of_two(options: tuple[str, ...], tmp_path: Path) -> None:
    """Of a process that fills a bracket, also where a second pattern takes another whole fill, and a cut."""
    part, output = tmp_path / "part.stl", tmp_path / "filled.stl"
    assert run("sample", "part", "-o", part).exit_code == 0
    planned = json.loads(run("fill", part, *options, "--dry-run", "--json").stdout)["memory"]
    filling = [sys.executable, "-m", "infill.cli", "fill", str(part), *options, "-o", str(output)]
    done = subprocess.run([sys.executable, "-c", PEAK, *filling], capture_output=True, encoding="utf-8", check=True)
    peak = int(done.stdout) * (1 if sys.platform == "darwin" else 1024)
    assert peak / 2 < planned < 2 * peak


@pytest.mark.parametrize("wall", ["9.5", "15", "60"])
def test_a_wall_without_room_is_refused_before_the_run(wall: str, tmp_path: Path) -> None:
    """An L of 12 mm: in the words of the run itself, also where the box around the part has room."""
    part = tmp_path / "part.stl"
    box(30, 30, 12).union(box(12, 30, 40)).export(part)
    planned, done = (run("fill", part, "--wall", wall, *way) for way in (("--dry-run",), ("-o", tmp_path / "o.stl")))
    one_line_error(planned, "is nowhere thicker than two of those")
    assert planned.stderr == done.stderr
    assert run("fill", part, "--wall", "3", "--dry-run").exit_code == 0
