"""The command line where signals, limits and terminals are those of POSIX."""

from __future__ import annotations

import json
import math
import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pty = pytest.importorskip("pty", reason="a terminal is made the POSIX way")
resource = pytest.importorskip("resource", reason="limits of file size are set the POSIX way")

RUN = [sys.executable, "-m", "infill.cli"]


def limited(words: list[str], size: int) -> subprocess.CompletedProcess[str]:
    """Run a command that may write no file larger than `size`: the kernel refuses the rest, as a full disk does."""

    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return subprocess.run(
        [*RUN, *words], capture_output=True, encoding="utf-8", preexec_fn=limit, check=False,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip


@pytest.mark.parametrize("suffix", ["stl", "3mf", "obj", "ply", "glb"])
def test_a_full_disk_leaves_the_old_file_whole(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a.{suffix}"
    path.write_text("precious")
    done = limited(["make", "honeycomb", "--size", "40", "-o", str(path), "--force"], 20_000)
    assert done.returncode == 1
    assert done.stderr.startswith("error: cannot write")
    assert done.stderr.count("\n") == 1
    assert path.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [path]


def test_a_disk_that_is_full_at_the_last_byte_leaves_no_other_file(tmp_path: Path) -> None:
    words = [
        "make",
        "honeycomb",
        "--size",
        "20",
        "--height",
        "2",
        "--ascii",
        "--preview",
        "a.png",
        "--save-config",
        "a.toml",
    ]
    words = [str(tmp_path / word) if word.startswith("a.") else word for word in words]
    whole = tmp_path / "whole.stl"
    assert limited([*words, "-o", str(whole)], 10**9).returncode == 0
    size = whole.stat().st_size
    for path in tmp_path.iterdir():
        path.unlink()
    done = limited([*words, "-o", str(tmp_path / "a.stl")], size - 5)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("delay", [0.05, 0.2, 0.4, 0.8, 1.4])
def test_ctrl_c_at_any_moment_leaves_no_file(delay: float, tmp_path: Path) -> None:
    words = ["make", "honeycomb", "--size", "250x210", "--stamp", "exact", "-o", str(tmp_path / "a.stl")]
    process = subprocess.Popen([*RUN, *words], stderr=subprocess.PIPE, encoding="utf-8", start_new_session=True)
    time.sleep(delay)
    assert process.poll() is None, "ended before it was interrupted"
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=30)
    assert process.returncode != 0
    if delay >= 0.8:  # before, Python itself may still be starting
        assert "Traceback" not in stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("number", "code"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 143)])
def test_a_signal_while_it_writes_leaves_no_file(number: str, code: int, tmp_path: Path) -> None:
    words = ["make", "honeycomb", "--size", "200", "-o", str(tmp_path / "a.obj")]
    process = subprocess.Popen([*RUN, *words], stderr=subprocess.PIPE, encoding="utf-8", start_new_session=True)
    while not list(tmp_path.iterdir()) and process.poll() is None:  # until it writes
        time.sleep(0.01)
    assert process.poll() is None
    process.send_signal(getattr(signal, number))
    _, stderr = process.communicate(timeout=30)
    assert process.returncode == code
    assert "Traceback" not in stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_full_stdout_is_told() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [*RUN, "list", "--json"], stdout=full, stderr=subprocess.PIPE, encoding="utf-8", check=False
        )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "cannot write the report: No space left" in done.stderr


def test_a_bar_moves_where_somebody_sees_it(tmp_path: Path) -> None:
    """On a terminal there is a bar on stderr; stdout stays clean."""
    leader, follower = pty.openpty()
    process = subprocess.Popen(
        [*RUN, "make", "honeycomb", "--size", "60", "--json", "-o", str(tmp_path / "a.stl")],
        stdout=subprocess.PIPE, stderr=follower, env={**os.environ, "TERM": "xterm"},
    )  # fmt: skip
    os.close(follower)
    stdout, _ = process.communicate(timeout=60)
    shown = b""
    while select.select([leader], [], [], 0.5)[0]:
        try:
            part = os.read(leader, 65536)
        except OSError:
            break
        if not part:
            break
        shown += part
    os.close(leader)
    assert process.returncode == 0
    assert b"smooth" in shown
    assert math.isfinite(json.loads(stdout)["volume"])
