"""`infill smooth` where signals and limits are those of POSIX: files appear whole or not at all."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from test_command_line_posix import MOMENTS, calls_of, interrupted, limited

resource = pytest.importorskip("resource", reason="limits of file size are set the POSIX way")

RUN = [sys.executable, "-m", "infill.cli"]


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("small") / "ball.npy"
    np.save(path, ((np.indices((30, 30, 30)) - 14.5) ** 2).sum(axis=0) <= 100)
    subprocess.run([*RUN, "smooth", path, "--json"], capture_output=True, check=True)  # kernels are compiled, and kept
    return path


@pytest.mark.longest
@pytest.mark.parametrize("suffix", ["npz", "nrrd"])
def test_a_full_disk_leaves_the_old_file_whole(suffix: str, small: Path, tmp_path: Path) -> None:
    """Of fields; meshes are written as those of `make` are."""
    path = tmp_path / f"a.{suffix}"
    path.write_text("precious")
    done = limited(["smooth", str(small), "-o", str(path), "--force"], 4_000)
    assert done.returncode == 1
    assert done.stderr.startswith("error: cannot write")
    assert done.stderr.count("\n") == 1
    assert path.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.longest
def test_a_disk_that_is_full_at_the_last_byte_leaves_no_other_file(small: Path, tmp_path: Path) -> None:
    words = ["smooth", str(small), "--ascii", "--preview", str(tmp_path / "a.png"), "-o", str(tmp_path / "a.npz")]
    whole = tmp_path / "whole.stl"
    assert limited([*words, "-o", str(whole)], 10**9).returncode == 0
    size = whole.stat().st_size
    for path in tmp_path.iterdir():
        path.unlink()
    done = limited([*words, "-o", str(tmp_path / "a.stl")], size - 5)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def calls_of_smooth(small: Path, tmp_path_factory: pytest.TempPathFactory) -> int:
    folder = tmp_path_factory.mktemp("calls")
    return calls_of(["smooth", str(small), "-q", "-o", str(folder / "a.stl"), "-o", str(folder / "b.obj")])


@pytest.mark.longest
@pytest.mark.parametrize("moment", MOMENTS[1::2])
def test_ctrl_c_at_any_moment_leaves_the_old_file(
    moment: float, calls_of_smooth: int, small: Path, tmp_path: Path
) -> None:
    assert calls_of_smooth > 100
    path = tmp_path / "a.stl"
    path.write_text("precious")
    words = ["smooth", str(small), "-q", "-o", str(path), "-o", str(tmp_path / "b.obj"), "--force"]
    interrupted(words, calls=int(moment * calls_of_smooth))
    assert list(tmp_path.iterdir()) == [path]
    assert path.read_text() == "precious"


@pytest.mark.longest
def test_ctrl_c_while_it_writes_leaves_no_file(small: Path, tmp_path: Path) -> None:
    interrupted(["smooth", str(small), "-q", "-o", str(tmp_path / "a.obj")], calls=20, writing=tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.longest
def test_a_device_as_output(small: Path) -> None:
    """/dev/null has no suffix; a name of a device cannot be replaced, and is not."""
    done = subprocess.run(
        [*RUN, "smooth", str(small), "-o", os.devnull, "--force"], capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert not Path(os.devnull).is_file()


@pytest.mark.longest
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_full_stdout_is_told(small: Path) -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [*RUN, "smooth", str(small), "--json", "-q"],
            stdout=full,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            check=False,
        )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1


@pytest.mark.longest
def test_the_memory_of_a_small_job_is_small(small: Path) -> None:
    """512 MiB hold Python, its compiled kernels and a small volume."""
    code = (
        "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, capture_output=True);"
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *RUN, "smooth", str(small), "--json"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    unit = 1 if sys.platform == "darwin" else 1024
    assert int(done.stdout) * unit < 2**29
