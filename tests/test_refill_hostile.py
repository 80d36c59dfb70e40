"""Files that are no prints, broken prints, folders and disks that refuse, signals: the old print stays whole."""

from __future__ import annotations

import io
import os
import random
import re
import signal
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from test_command_line_posix import MOMENTS, calls_of, interrupted, limited

from infill import FormatError, InfillError, OutputError, refill
from tests.gcode_judge import changed, judge
from tests.handmade_prints import Dialect, written

RUN = [sys.executable, "-m", "infill.cli"]
PRINT = written(Dialect(layers=5, labels="comment"))
ABSOLUTE = written(Dialect(slicer="orca", absolute=True, layers=5))
FIRST = b";TYPE:Internal infill\n"


def put(folder: Path, data: bytes) -> Path:
    path = folder / "print.gcode"
    path.write_bytes(data)
    return path


def whole_or_new(path: Path, old: bytes) -> None:
    """The file is as it was, or wholly new and lawful; beside it lies nothing but a log."""
    new = path.read_bytes()
    assert judge(old, new, filament=(0.0, 1.3)) == []
    assert {other.name for other in path.parent.iterdir() if other.suffix != ".log"} == {path.name}


def told(path: Path, old: bytes, **options: Any) -> None:
    """Refill, or be refused in one line; the file is whole in any case."""
    said = None
    try:
        refill(path, **options)
    except InfillError as error:
        said = str(error)
    assert said is None or (said and "\n" not in said and path.read_bytes() == old)
    whole_or_new(path, old)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("data", [PRINT, ABSOLUTE], ids=["relative", "absolute"])
def test_a_truncated_print(data: bytes, seed: int, tmp_path: Path) -> None:
    """Cut anywhere, in a number too."""
    old = data[: random.Random(seed).randrange(len(data))]
    told(put(tmp_path, old), old)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\n",
        b"hello",
        b"G1 X1 Y1 E1\n" * 20,
        PRINT.replace(b";LAYER_CHANGE\n", b""),
        b"PK\x03\x04" + bytes(range(256)) * 20,
        b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 20,
        b"\x00" * 5000,
        b"\xff\xfe" + "G1 X1\n".encode("utf-16-le") * 50,
        b"GCDE\x01\x00\x00\x00\x01\x00" + bytes(range(256)),
    ],
    ids=["empty", "a newline", "text", "no tags", "no layers", "zip", "picture", "zeros", "UTF-16", "binary"],
)
def test_what_is_no_print_is_refused_in_a_line(data: bytes, tmp_path: Path) -> None:
    path = put(tmp_path, data)
    with pytest.raises(FormatError) as error:
        refill(path)
    assert "\n" not in str(error.value)
    assert path.name in str(error.value)
    assert path.read_bytes() == data


def test_a_3mf_file_that_was_not_sliced(tmp_path: Path) -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("3D/3dmodel.model", "<model/>")
    path = put(tmp_path, packed.getvalue())
    with pytest.raises(FormatError, match="the archive holds no G-code"):
        refill(path)
    assert path.read_bytes() == packed.getvalue()


def test_a_print_without_infill_stays_as_it_is(tmp_path: Path) -> None:
    old = PRINT.replace(b";TYPE:Internal infill", b";TYPE:Solid infill")
    path = put(tmp_path, old)
    told(path, old)
    assert path.read_bytes() == old


@pytest.mark.longest
def test_a_second_run_changes_nothing(tmp_path: Path) -> None:
    path = put(tmp_path, PRINT)
    refill(path)
    once = path.read_bytes()
    assert changed(PRINT, once) > 0
    refill(path)
    assert path.read_bytes() == once


def spoilt(pattern: bytes, new: bytes, skip: int = 3) -> Callable[[bytes], bytes]:
    """Replace one line in the first infill."""

    def change(data: bytes) -> bytes:
        head, tail = data.split(FIRST, 1)
        found = list(re.finditer(pattern, tail, re.MULTILINE))[skip]
        return head + FIRST + tail[: found.start()] + new + tail[found.end() :]

    return change


BEAD = rb"^G1 X[\d.]+ Y[\d.]+ E[\d.]+$"
SPOILT: dict[str, Callable[[bytes], bytes]] = {
    "NaN": spoilt(BEAD, b"G1 Xnan Ynan E.05"),
    "infinite": spoilt(BEAD, b"G1 Xinf Y-inf E.05"),
    "1e308": spoilt(BEAD, b"G1 X1e308 Y1e308 E.05"),
    "many digits": spoilt(BEAD, b"G1 X" + b"9" * 400 + b" Y1 E.05"),
    "no number": spoilt(BEAD, b"G1 X Y E"),
    "two words of a kind": spoilt(BEAD, b"G1 X101 X102 Y101 E.05"),
    "no line but an E": spoilt(BEAD, b"G1 E.5"),
    "far away": spoilt(BEAD, b"G1 X90000 Y90000 E.05"),
    "F0": spoilt(BEAD, b"G1 F0"),
    "negative F": spoilt(BEAD, b"G1 F-100"),
    "relative moves": spoilt(BEAD, b"G91\nG1 X.1 Y.1 E.003\nG90"),
    "inches": spoilt(BEAD, b"G20\nG1 X4 Y4 E.003\nG21"),
    "another filament mode": spoilt(BEAD, b"M82\nG92 E0\nG1 X104 Y101 E.05\nM83"),
    "an origin": spoilt(BEAD, b"G92 X0 Y0\nG1 X1 Y-1 E.05\nG92 X106.494 Y101.194"),
    "a home": spoilt(BEAD, b"G28 X Y"),
    "a tool": spoilt(BEAD, b"T1\nG1 X104 Y101 E.05\nT0"),
    "an arc by its radius": spoilt(BEAD, b"G2 X104 Y101.5 R2 E.05"),
    "a full circle": spoilt(BEAD, b"G2 I1 J0 E.2"),
    "an arc of no radius": spoilt(BEAD, b"G2 X104 Y101 I0 J0 E.05"),
    "a spline": spoilt(BEAD, b"G5 X104 Y101 I0 J1 P0 Q1 E.05"),
    "a rise": spoilt(BEAD, b"G1 X104 Y101 Z.9 E.05"),
    "small letters": spoilt(BEAD, b"g1 x104 y101 e.05"),
    "a megabyte line": spoilt(BEAD, b"G1 X104 Y101 E.05 ;" + b"x" * 1_000_000),
    "a megabyte of blanks": spoilt(BEAD, b"G1 X104" + b" " * 1_000_000 + b"Y101 E.05"),
    "a megabyte comment": spoilt(BEAD, b";" + b"\xff" * 1_000_000),
    "lone carriage returns": spoilt(BEAD, b"G1 X104 Y101 E.05\r"),
    "zeros": spoilt(BEAD, b"\x00\x00\x00"),
    "a tag cut short": spoilt(BEAD, b";TYPE:"),
    "a section that never ends": lambda data: data.split(b";LAYER_CHANGE", 3)[0] + data.split(FIRST)[1],
    "M73 without end": lambda data: data.replace(b"G1 F4800\n", b"G1 F4800\n" + b"M73 P1 R1\n" * 300),
}


OURS = ("NaN", "1e308", "far away", "relative moves", "a tool", "a full circle", "a megabyte line")


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "pattern"), [*((name, "keep") for name in SPOILT), *((name, "honeycomb") for name in OURS)]
)
def test_odd_lines_in_the_infill(name: str, pattern: str, tmp_path: Path) -> None:
    """The section is left as it was, or lawfully replaced; or the print is refused in one line."""
    old = SPOILT[name](PRINT)
    path = put(tmp_path, old)
    told(path, old, pattern=pattern)


def test_a_folder_that_may_not_be_written_to(tmp_path: Path) -> None:
    path = put(tmp_path, PRINT)
    if os.geteuid() == 0:
        with pytest.raises(OutputError):
            refill(path, output=Path("/proc/nothing.gcode"))
    else:
        tmp_path.chmod(0o500)
        try:
            with pytest.raises(OutputError):
                refill(path)
        finally:
            tmp_path.chmod(0o700)
    assert path.read_bytes() == PRINT


def test_a_print_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InfillError):
        refill(tmp_path / "none.gcode")
    assert list(tmp_path.iterdir()) == []


def test_the_mode_of_the_file_is_kept(tmp_path: Path) -> None:
    path = put(tmp_path, PRINT)
    path.chmod(0o640)
    refill(path)
    assert path.read_bytes() != PRINT
    assert path.stat().st_mode & 0o777 == 0o640


@pytest.mark.slow
def test_one_line_on_stderr_and_exit_1(tmp_path: Path) -> None:
    path = put(tmp_path, b"\x89PNG\r\n\x1a\n" + bytes(2000))
    done = subprocess.run([*RUN, "refill", path], capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert done.stdout == ""


@pytest.mark.longest
@pytest.mark.parametrize("size", [0, 3000, len(PRINT) - 10])
def test_a_full_disk_leaves_the_old_print_whole(size: int, tmp_path: Path) -> None:
    path = put(tmp_path, PRINT)
    done = limited(["refill", str(path)], size)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert path.read_bytes() == PRINT
    assert {other.name for other in tmp_path.iterdir() if other.suffix != ".log"} == {path.name}


@pytest.fixture(scope="module")
def calls_of_refill(tmp_path_factory: pytest.TempPathFactory) -> int:
    folder = tmp_path_factory.mktemp("calls")
    return calls_of(["refill", str(put(folder, PRINT))])


@pytest.mark.longest
@pytest.mark.parametrize("moment", MOMENTS[2:5:2])
def test_ctrl_c_at_any_moment_leaves_the_old_print(moment: float, calls_of_refill: int, tmp_path: Path) -> None:
    path = put(tmp_path, PRINT)
    interrupted(["refill", str(path)], calls=int(moment * calls_of_refill))
    assert path.read_bytes() == PRINT
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.longest
def test_ctrl_c_while_it_writes_leaves_the_old_print(tmp_path: Path) -> None:
    path = put(tmp_path, PRINT)
    interrupted(["refill", str(path)], calls=5, writing=tmp_path)
    assert path.read_bytes() == PRINT
    assert list(tmp_path.iterdir()) == [path]


KILLED = """
import os, signal, sys

count, calls = 0, int(sys.argv.pop(1))


def called(frame, event, argument):
    global count
    if event in ("call", "c_call") and (frame.f_globals.get("__name__") or "").startswith("infill."):
        count += 1
        if count == calls:
            os.kill(os.getpid(), signal.SIGKILL)


from infill.cli import main

sys.setprofile(called)
main()
"""


@pytest.mark.longest
@pytest.mark.parametrize("moment", [0.5, 0.97, 0.999])
def test_a_kill_at_any_moment_leaves_the_old_print_or_the_new_one(
    moment: float, calls_of_refill: int, tmp_path: Path
) -> None:
    """Nobody can tidy up after a kill: a file that was being written may be left beside the print, not in its place."""
    path = put(tmp_path, PRINT)
    words = [sys.executable, "-c", KILLED, str(int(moment * calls_of_refill)), "refill", str(path)]
    done = subprocess.run(words, capture_output=True, check=False)
    assert done.returncode == -signal.SIGKILL
    new = path.read_bytes()
    assert new == PRINT or (changed(PRINT, new) and judge(PRINT, new, filament=(0.8, 1.01)) == [])
    assert len(list(tmp_path.iterdir())) <= 2
