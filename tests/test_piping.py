"""`-o -`: what goes to stdout is what a file would hold, whole or not at all, and alone there."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from test_command_line import run

from infill import read_mesh
from tests.handmade_prints import Dialect, written

RUN = [sys.executable, "-m", "infill.cli"]
SMALL = ["make", "honeycomb", "--size", "20", "--height", "2", "-q"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def ball() -> str:
    np.save("ball.npy", np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0) < 64)
    return "ball.npy"


@pytest.mark.slow
@pytest.mark.parametrize("output", ["-", "-.PLY", "-.3mf"])
def test_a_block_goes_to_stdout_in_the_format_that_is_named(output: str, folder: Path) -> None:
    suffix = Path(f"a{output[1:]}").suffix or ".stl"
    file = folder / f"file{suffix}"
    result = run(*SMALL, "-o", output, "-o", file)
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    piped = folder / f"piped{suffix}"
    piped.write_bytes(result.stdout_bytes)
    assert read_mesh(piped).closed
    assert read_mesh(piped).volume == read_mesh(file).volume
    if suffix != ".3mf":  # which tells when it was written
        assert piped.read_bytes() == file.read_bytes()


@pytest.mark.slow
@pytest.mark.usefixtures("compiled", "silent_compiler")
def test_a_solid_and_its_field_go_to_stdout(ball: str, folder: Path) -> None:
    for output, name in (("-", "a.stl"), ("-.npz", "a.npz")):
        result = run("smooth", ball, "-o", output, "-o", name)
        assert result.exit_code == 0, result.output
        assert result.stdout_bytes == (folder / name).read_bytes()
        assert "wrote -" in result.stderr
    labels = run("smooth", ball, "--each-label", "-o", "-.3mf", "-q")
    (folder / "labels.3mf").write_bytes(labels.stdout_bytes)
    assert read_mesh(folder / "labels.3mf").volume == pytest.approx(read_mesh(folder / "a.stl").volume)


@pytest.mark.slow
def test_a_refilled_print_goes_to_stdout(folder: Path) -> None:
    (folder / "print.gcode").write_bytes(written(Dialect(layers=4)))
    result = run("refill", "print.gcode", "-o", "-")
    assert result.exit_code == 0, result.output
    assert result.stderr.endswith(" -\n")
    assert run("refill", "print.gcode", "-o", "smooth.gcode", "-q").exit_code == 0
    assert result.stdout_bytes == (folder / "smooth.gcode").read_bytes()
    assert (folder / "print.gcode").read_bytes() == written(Dialect(layers=4))
    dry = run("refill", "print.gcode", "-o", "-", "--dry-run", "--quiet")
    assert (dry.exit_code, dry.stdout) == (0, "")


def test_a_dry_run_leaves_stdout_to_what_it_says() -> None:
    plan = json.loads(run(*SMALL, "-o", "-", "--dry-run", "--json").stdout)
    assert plan["triangles"] > 0


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [["-o", "-", "--json"], ["-o", "-", "-o", "-.3mf"], ["-o", "-", "--preview", "-.png"], ["-o", "-", "-o", "-"]],
)
def test_one_thing_goes_to_stdout(words: list[str], folder: Path) -> None:
    np.save("a.npy", np.zeros((3, 3, 3)))
    for command in (SMALL, ["smooth", "a.npy"]):
        result = run(*command, *words)
        assert result.exit_code == 2
        assert result.stdout == ""


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["-o", "-.xyz"], "cannot tell a mesh format from the suffix '.xyz'"),
        (["-o", "-", "-o", "no/a.stl"], "there is no folder no"),
        (["-o", "-", "--stamp", "exact", "--cells", "3", "--steps", "25"], "--allow-broken"),
    ],
)
def test_an_error_leaves_stdout_empty(words: list[str], says: str) -> None:
    result = run(*SMALL, *words)
    assert result.exit_code == 1
    assert result.stdout == ""
    assert says in result.stderr


@pytest.mark.slow
def test_a_reader_that_is_gone_leaves_no_file(folder: Path) -> None:
    """More than a pipe holds."""
    pipe = subprocess.Popen([*RUN, *SMALL, "-o", "-", "-o", "a.stl"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert pipe.stdout is not None
    assert os.read(pipe.stdout.fileno(), 9) == b"phasefill"
    pipe.stdout.close()
    _, said = pipe.communicate()
    assert pipe.returncode == 1
    assert b"Traceback" not in said
    assert list(folder.iterdir()) == []


@pytest.mark.slow
def test_a_stream_without_a_buffer_takes_everything(folder: Path) -> None:
    """Such a one may take only a part of what it is given at once."""
    command = [*RUN, *SMALL, "-o", "-", "-o", "a.stl"]
    done = subprocess.run(command, capture_output=True, check=True, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    assert done.stdout == (folder / "a.stl").read_bytes()


@pytest.mark.slow
def test_a_terminal_is_refused(folder: Path) -> None:
    pty = pytest.importorskip("pty", reason="a terminal is made the POSIX way")
    leader, follower = pty.openpty()
    done = subprocess.run([*RUN, *SMALL, "-o", "-"], stdout=follower, stderr=subprocess.PIPE, check=False)
    os.close(follower)
    os.close(leader)
    assert done.returncode == 1
    assert done.stderr.startswith(b"error: '-' is stdout, and that is a terminal; send it on")
    assert done.stderr.count(b"\n") == 1
