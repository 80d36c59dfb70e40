"""A library that crashes, hangs or takes all memory costs one line, and leaves nothing behind."""

from __future__ import annotations

import logging
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

from infill.cli.console import print_log, say, warn
from infill.errors import FormatError, InfillError, MemoryLimitError, OutputError, ParameterError, escape_unprintable
from infill.files.child_process import read_in_child
from infill.imaging.volume_files import read_volume
from tests import volume_writers as w

READERS = "tests.child_readers:"
SCAN = Path("scan.dcm")
posix = pytest.mark.skipif(os.name != "posix", reason="signals and limits of POSIX")


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["u1", "<i2", ">f4", "f8"])
def test_arrays_and_data_come_back(kind: str) -> None:
    reply = read_in_child(f"{READERS}arrays", 60, kind, path=SCAN)
    assert reply.data == {"sum": 1770.0, "word": "ä"}
    assert np.array_equal(reply.arrays["values"], np.arange(60).reshape(2, -1).T)
    assert reply.arrays["values"].dtype == np.dtype(kind)
    assert reply.arrays["none"].shape == (0,)
    reply.arrays["values"][0] = 7  # its own
    assert reply.said == ()


@pytest.mark.slow
def test_an_array_outlives_all_that_brought_it() -> None:
    values = read_in_child(f"{READERS}arrays", 10**6, "f8", path=SCAN).arrays["values"]
    for _ in range(3):
        read_in_child(f"{READERS}arrays", 10, "f8", path=SCAN)
    assert values[-1, 1] == 10**6 - 1


@pytest.mark.slow
def test_what_is_printed_comes_back_once_and_without_places_in_the_source() -> None:
    said = read_in_child(f"{READERS}says", "slices are missing", path=SCAN).said
    assert set(said) == {"slices are missing", "Reader: slices are missing", "from below"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "error", "says"),
    [
        ("ours", ParameterError, "^a text; so$"),
        ("RuntimeError", FormatError, r"cannot read scan.dcm \(a text; so\); check the file"),
        ("ValueError", FormatError, r"cannot read scan.dcm \(a text; so\); check the file"),
        ("MemoryError", MemoryLimitError, "scan.dcm needs more memory than there is"),
    ],
)
def test_an_error_of_the_reader_is_one_of_ours(kind: str, error: type[InfillError], says: str) -> None:
    with pytest.raises(error, match=says):
        read_in_child(f"{READERS}raises", kind, "a text; so", path=SCAN)


@pytest.mark.slow
def test_the_last_line_of_a_library_counts() -> None:
    text = "sitk::ERROR: at length\nitk::ERROR: Reader(0x55aa): no pixels"
    with pytest.raises(FormatError, match=r"cannot read scan.dcm \(no pixels\)"):
        read_in_child(f"{READERS}raises", "RuntimeError", text, path=SCAN)


@pytest.mark.slow
@posix
@pytest.mark.parametrize("number", [signal.SIGSEGV, signal.SIGABRT, signal.SIGKILL])
def test_a_reader_that_crashes_is_one_line(number: signal.Signals) -> None:
    with pytest.raises(
        FormatError, match=f"scan.dcm crashes the library that reads it .{number.name}., so it is probably damaged; "
    ):
        read_in_child(f"{READERS}dies", int(number), path=SCAN)


@pytest.mark.slow
@posix
def test_a_pointer_to_nowhere_is_one_line() -> None:
    with pytest.raises(FormatError, match="SIGSEGV"):
        read_in_child(f"{READERS}stack_overflow", path=SCAN)


@pytest.mark.slow
@pytest.mark.parametrize("status", [0, 3])
def test_a_reader_that_ends_without_an_answer_is_one_line(status: int) -> None:
    with pytest.raises(FormatError, match=f"exit status {status}"):
        read_in_child(f"{READERS}leaves", status, path=SCAN)


def alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    # A process that has ended, and that nobody has asked for its status, is no longer running.
    state = Path(f"/proc/{process}/stat")
    return not state.exists() or state.read_text().rpartition(")")[2].split()[0] != "Z"


def wait_until(condition: object, seconds: float = 20.0) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():  # type: ignore[operator]
            return True
        time.sleep(0.02)
    return False


@pytest.mark.slow
@posix
def test_a_reader_that_hangs_is_ended(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="scan.dcm takes over 3 s to read; check"):
        read_in_child(f"{READERS}sleeps", str(tmp_path / "pid"), path=SCAN, seconds=3)
    assert wait_until(lambda: not alive(int((tmp_path / "pid").read_text())))


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the limit is that of Linux")
def test_a_reader_that_takes_all_memory_is_refused() -> None:
    with pytest.raises(MemoryLimitError, match="needs more memory than there is"):
        read_in_child(f"{READERS}greedy", 4, path=SCAN, memory=2**30)
    assert read_in_child(f"{READERS}greedy", 1, path=SCAN, memory=2**31).data == {"held": 1}


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="looks at processes of Linux")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_no_child_and_no_file_outlives_its_parent(number: signal.Signals, tmp_path: Path) -> None:
    """Ctrl-C, the end of a session, and an end that nobody can answer."""
    text = (
        "from infill.files.child_process import read_in_child; from pathlib import Path; import signal; "
        "signal.signal(signal.SIGINT, signal.default_int_handler); "  # a shell's background jobs ignore Ctrl-C
        f"read_in_child({READERS + 'sleeps'!r}, {str(tmp_path / 'pid')!r}, path=Path('scan.dcm'))"
    )
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    root = Path(__file__).resolve().parents[1]
    environment = {**os.environ, "TMPDIR": str(scratch), "PYTHONPATH": str(root)}
    with subprocess.Popen([sys.executable, "-c", text], cwd=root, env=environment, stderr=subprocess.DEVNULL) as parent:
        noted = tmp_path / "pid"
        assert wait_until(lambda: noted.exists() and noted.read_text())
        child = int(noted.read_text())
        assert alive(child)
        parent.send_signal(number)
        parent.wait(timeout=20)
    assert wait_until(lambda: not alive(child))
    assert list(scratch.iterdir()) == []


@pytest.mark.slow
def test_nothing_is_left_in_the_folder_for_temporary_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    for without in (False, True):
        if without and hasattr(os, "memfd_create"):
            monkeypatch.delattr(os, "memfd_create")
        assert read_in_child(f"{READERS}arrays", 60, "u1", path=SCAN).arrays["values"].sum() == 1770
        with pytest.raises(FormatError):
            read_in_child(f"{READERS}leaves", 1, path=SCAN)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_system_whose_files_have_names_works_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on Windows, which passes no numbers of files and removes no file that is mapped."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr("infill.files.child_process.HAS_NAMELESS_FILES", False)
    assert read_in_child(f"{READERS}arrays", 60, "u1", path=SCAN).arrays["values"].sum() == 1770
    with pytest.raises(FormatError):
        read_in_child(f"{READERS}leaves", 1, path=SCAN)
    assert list(tmp_path.iterdir()) == []


def test_a_frozen_application_reads_in_its_own_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    assert read_in_child(f"{READERS}arrays", 60, "u1", path=SCAN).arrays["values"].sum() == 1770


@pytest.mark.slow
def test_the_child_loads_little(monkeypatch: pytest.MonkeyPatch) -> None:
    """NumPy and a few modules of ours; the reader loads its library."""
    modules = set(read_in_child(f"{READERS}loaded", path=SCAN).data["modules"])
    assert "numpy" in modules
    assert not {"scipy", "trimesh", "numba", "skimage", "manifold3d", "typer", "shapely", "SimpleITK"} & modules


@pytest.mark.slow
def test_a_file_in_the_working_directory_does_not_stand_in_for_a_module(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "json.py").write_text("raise SystemExit('mine')")
    monkeypatch.chdir(tmp_path)
    assert read_in_child(f"{READERS}arrays", 60, "u1", path=SCAN).arrays["values"].sum() == 1770


# --- what is quoted --------------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", ["\x1b[31m", "\x07", "\r", "\n", "\x9b", "\u202e", "\u2028", "\x7f"])
def test_what_is_quoted_from_a_file_cannot_steer_a_terminal(bad: str, tmp_path: Path) -> None:
    values = np.arange(60).reshape(3, 4, 5).astype("i2")
    path = tmp_path / "a.nrrd"
    path.write_bytes(w.nrrd(values).data.replace(b"type: short", f"type: x{bad}x".encode()))
    with pytest.raises(FormatError) as caught:
        read_volume(path)
    assert str(caught.value).isprintable()
    assert escape_unprintable(f"a{bad}b").isprintable()
    assert str(OutputError(f"cannot write {bad}; choose another name")).isprintable()


@pytest.mark.parametrize("word", ["plain", "µm, 3×4, naïve", "日本 🦴"])
def test_other_words_stay(word: str) -> None:
    assert str(FormatError(word)) == word


def test_messages_and_warnings_of_the_program_are_shown_as_text(capsys: pytest.CaptureFixture[str]) -> None:
    with print_log(shown=True):
        logging.getLogger("infill").warning("%s gives \x1b[31m\r\n", "a.nrrd")
    warn("broken \x9b\n", UserWarning, "", 0)
    say("one\x07\ntwo")
    assert capsys.readouterr().err.splitlines() == [
        r"a.nrrd gives \x1b[31m\r\n",
        r"warning: broken \x9b\n",
        r"one\x07",
        "two",
    ]
