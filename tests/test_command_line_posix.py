"""The command line where signals, limits and terminals are those of POSIX."""

from __future__ import annotations

import contextlib
import json
import math
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

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
        [*RUN, *words],
        capture_output=True,
        encoding="utf-8",
        preexec_fn=limit,
        check=False,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )


@pytest.mark.longest
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


@pytest.mark.longest
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


# A command that sends itself a signal: at a number of calls of and by our functions, or of calls of any kind since a
# file of its own began to be written. So every moment can be had, on any machine, however fast it is.
WATCHED = """
import os, signal, sys

number, calls, folder = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
sys.argv[1:4] = []
count, writing = 0, not folder


def opened(event, arguments):
    global writing
    writing = writing or (event == "open" and arguments[1] == "x" and str(arguments[0]).startswith(folder))


def called(frame, event, argument):
    global count
    if writing and event in ("call", "c_call") and (folder or frame.f_globals.get("__name__", "").startswith("infill.")):
        count += 1
        if count == calls:
            sys.setprofile(None)
            assert not folder or os.listdir(folder)
            os.kill(os.getpid(), number)


from infill.cli import main

signal.signal(signal.SIGINT, signal.default_int_handler)  # which a shell takes from what it runs in the background
sys.addaudithook(opened)
sys.setprofile(called)
main()
sys.setprofile(None)
print(count)
"""


def watched(
    words: list[str], *, calls: int = 0, writing: Path | None = None, number: int = signal.SIGINT
) -> subprocess.CompletedProcess[str]:
    """Run a command that gets a signal at so many calls, of those since a file in the folder `writing` was opened."""
    return subprocess.run(
        [sys.executable, "-c", WATCHED, str(int(number)), str(calls), f"{writing or ''}", *words],
        capture_output=True,
        encoding="utf-8",
        check=False,
    )


def calls_of(words: list[str]) -> int:
    """Return how many calls a command makes that is not interrupted."""
    done = watched(words)
    assert done.returncode == 0, done.stderr
    return int(done.stdout.split()[-1])


def interrupted(words: list[str], *, calls: int, code: int = 130, **options: Any) -> None:
    """Run a command that gets a signal: it ends by it, in silence."""
    done = watched(words, calls=calls, **options)
    assert done.returncode == code, done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


SMALL = ["make", "honeycomb", "--size", "20", "--height", "2", "-q"]
MOMENTS = [0.02, 0.3, 0.6, 0.8, 0.99]  # of all calls


@pytest.fixture(scope="module")
def calls_of_make(tmp_path_factory: pytest.TempPathFactory) -> int:
    return calls_of([*SMALL, "-o", str(tmp_path_factory.mktemp("calls") / "a.stl")])


@pytest.mark.longest
@pytest.mark.parametrize("moment", MOMENTS)
def test_ctrl_c_at_any_moment_leaves_no_file(moment: float, calls_of_make: int, tmp_path: Path) -> None:
    assert calls_of_make > 100
    interrupted([*SMALL, "-o", str(tmp_path / "a.stl")], calls=int(moment * calls_of_make))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.longest
def test_a_command_that_is_left_alone_leaves_its_file(tmp_path: Path) -> None:
    """So that the tests above and below would see one."""
    done = watched([*SMALL, "-o", str(tmp_path / "a.stl")], calls=10**9, writing=tmp_path)
    assert done.returncode == 0, done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["a.stl"]


@pytest.mark.longest
@pytest.mark.parametrize(("number", "code"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 143)])
def test_a_signal_while_it_writes_leaves_no_file(number: str, code: int, tmp_path: Path) -> None:
    words = [*SMALL, "-o", str(tmp_path / "a.obj")]
    interrupted(words, calls=20, writing=tmp_path, number=getattr(signal, number), code=code)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_full_stdout_is_told() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [*RUN, "list", "--json"], stdout=full, stderr=subprocess.PIPE, encoding="utf-8", check=False
        )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "cannot write to stdout: No space left" in done.stderr


@pytest.mark.slow
def test_a_bar_moves_where_somebody_sees_it(tmp_path: Path) -> None:
    """On a terminal there is a bar on stderr; stdout stays clean."""
    leader, follower = pty.openpty()
    with open(tmp_path / "report.json", "wb") as stdout:
        process = subprocess.Popen(
            [*RUN, "make", "honeycomb", "--size", "60", "--json", "-o", str(tmp_path / "a.stl")],
            stdout=stdout,
            stderr=follower,
            env={**os.environ, "TERM": "xterm"},
        )
    os.close(follower)
    shown = b""
    with contextlib.suppress(OSError):  # which is how the end of a terminal is told on Linux
        while part := os.read(leader, 65536):
            shown += part
    os.close(leader)
    assert process.wait() == 0
    assert b"smooth" in shown
    assert math.isfinite(json.loads((tmp_path / "report.json").read_text())["volume"])


@pytest.mark.longest
def test_a_link_that_leads_nowhere_is_not_replaced_without_force(tmp_path: Path) -> None:
    link = tmp_path / "a.stl"
    link.symlink_to(tmp_path / "gone.stl")
    words = [
        sys.executable,
        "-m",
        "infill",
        "make",
        "honeycomb",
        "--size",
        "20",
        "--height",
        "3",
        "-q",
        "-o",
        str(link),
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "exists; give another name, or --force" in done.stderr
    assert link.is_symlink()
    assert subprocess.run([*words, "--force"], capture_output=True, check=False).returncode == 0
    assert link.exists()
