"""Every command works where stdin, stdout or stderr does not exist: under pythonw, in some slicers, after `2>&-`."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

from infill import read_mesh
from tests.handmade_prints import Dialect, written

RUN = [sys.executable, "-m", "infill.cli"]
COMMANDS = {
    "make": ["make", "honeycomb", "--size", "20", "--height", "2", "-o", "out.stl"],
    "smooth": ["smooth", "ball.npy", "--smooth", "plain", "-o", "out.stl"],
    "fill": ["fill", "box.stl", "--density", "30%", "-o", "out.stl"],
    "refill": ["refill", "print.gcode", "-o", "out.gcode"],
    "motion": ["motion", "print.gcode", "--json"],
    "check": ["check", "box.stl", "--json"],
    "list": ["list", "--json"],
}
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="a shell that closes streams")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, compiled: None) -> Path:
    monkeypatch.chdir(tmp_path)
    np.save("ball.npy", np.sum((np.indices((20, 20, 20)) - 9.5) ** 2, axis=0) < 49)
    trimesh.creation.box((14, 14, 10)).export("box.stl")
    Path("print.gcode").write_bytes(written(Dialect(layers=4, size=9.0)))
    return tmp_path


def closed(words: list[str], redirection: str) -> subprocess.CompletedProcess[str]:
    """Run a command whose shell has closed some of its streams."""
    return subprocess.run(
        ["sh", "-c", f'exec "$@" {redirection}', "sh", *RUN, *words],
        capture_output=True,
        encoding="utf-8",
        check=False,
        stdin=subprocess.DEVNULL,
    )


@pytest.mark.long
@pytest.mark.parametrize("redirection", ["2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_does_its_work_without_streams(name: str, redirection: str, folder: Path) -> None:
    before = set(folder.iterdir())
    done = closed(COMMANDS[name], redirection)
    assert done.returncode == 0, done
    assert done.stderr == ""
    made = {path.name for path in set(folder.iterdir()) - before}
    assert made == {word for word in COMMANDS[name] if word.startswith("out.")}
    if "out.stl" in made:
        assert read_mesh("out.stl").closed
    if "out.gcode" in made:
        assert Path("out.gcode").read_bytes().count(b"G1 ") > 50
    if redirection == "2>&-" and "--json" in COMMANDS[name]:
        assert json.loads(done.stdout)


@pytest.mark.long
@pytest.mark.parametrize("redirection", ["2>&-", ">&-", "<&- >&- 2>&-"])
def test_an_error_ends_with_its_status_and_leaves_nothing(redirection: str, folder: Path) -> None:
    before = sorted(folder.iterdir())
    done = closed(["smooth", "none.stl", "-o", "out.stl"], redirection)
    assert done.returncode == 1
    assert done.stderr == ("error: there is no file none.stl; check the name\n" if redirection == ">&-" else "")
    assert sorted(folder.iterdir()) == before


@pytest.mark.slow
def test_what_should_go_to_a_stdout_that_is_none_is_an_error() -> None:
    done = closed(["make", "honeycomb", "--size", "20", "-o", "-"], ">&-")
    assert done.returncode == 1
    assert done.stderr == "error: '-' is stdout, and this process has none; name a file\n"


def test_streams_that_are_none_are_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    """As under pythonw, which has no numbers of files either."""
    from infill.cli import main

    for name in ("stdin", "stdout", "stderr"):
        monkeypatch.setattr(sys, name, None)
    monkeypatch.setattr(sys, "argv", ["infill", "check", "box.stl"])
    main()
    assert sys.stderr is not None
    for stream in (sys.stdin, sys.stdout, sys.stderr):
        assert stream.name == os.devnull
        stream.close()
