"""Faults in the middle of a run in chunks: one clear line, nothing lost, nothing half-written."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr
from test_chunked_command import PLAIN, gyroid
from test_command_line import run

from infill import InfillError, MemoryLimitError, Smoothing
from infill.lazy.opening import open_volume
from infill.lazy.volume import LazyVolume
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.request import SmoothRequest
from infill.voxels.noise import LAYERS

pytestmark = [
    pytest.mark.usefixtures("compiled", "silent_compiler"),
    pytest.mark.skipif(os.name == "nt", reason="signals and limits are of another kind"),
]

SIDE = 60


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("source") / "f.zarr"
    zarr.create_array(str(path), shape=(SIDE,) * 3, chunks=(32,) * 3, dtype="u1")[:] = gyroid(SIDE, 30)
    return path


@pytest.fixture
def folder(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the input, and one for temporary files."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "f.zarr").symlink_to(source)
    (tmp_path / "scratch").mkdir()
    return tmp_path


LIMITED = """
import resource, sys
from infill.cli import program
from infill.smoothing import chunk_plans
import infill.smoothing.chunked
chunk_plans.LARGEST_CELLS = 32
limit = int(sys.argv[1])
if limit:
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
sys.argv = ["infill", "smooth", "f.zarr", *sys.argv[2:]]
program()
"""


def limited(limit: int, *words: str) -> subprocess.CompletedProcess[str]:
    """Run `infill smooth` in a process whose files hold no more bytes than a limit, 0 for none."""
    environment = {**os.environ, "TMPDIR": str(Path("scratch").absolute()), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-c", LIMITED, str(limit), *words, "-q", "--workers", "1"]
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


def names() -> set[str]:
    return {str(path) for path in Path().rglob("*") if "f.zarr" not in path.parts}


@pytest.mark.longest
def test_a_disk_that_is_full_while_fields_are_kept_changes_nothing(folder: Path) -> None:
    free = limited(0, *PLAIN, "--hash", "--resume", "kept")
    full = limited(20_000, *PLAIN, "--hash", "--resume", "kept")
    assert free.returncode == full.returncode == 0, full.stderr
    assert free.stdout == full.stdout != ""
    assert full.stderr == ""
    assert names() == {"scratch"}


@pytest.mark.longest
@pytest.mark.parametrize("output", ["a.ply", "a.stl", "a.obj", "a.precomputed", "a.zarr"])
def test_a_disk_that_is_full_while_output_is_written(output: str, folder: Path) -> None:
    words = (*PLAIN, "-o", output)
    done = limited(30_000, *words)
    assert done.returncode == 1, done.stderr
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith(f"error: cannot write {output}: the file would be larger than is allowed")
    assert names() == {"scratch"}


@pytest.mark.longest
def test_a_run_that_filled_the_disk_goes_on(folder: Path) -> None:
    words = (*PLAIN, "-o", "a.ply", "--resume", "kept")
    assert limited(100_000, *words).returncode == 1
    assert {"kept", "kept/manifest.json", "kept/results"} <= names()
    assert not Path("a.ply").exists()
    assert limited(0, *words).returncode == 0
    assert limited(0, *PLAIN, "-o", "whole.ply").returncode == 0
    assert Path("a.ply").read_bytes() == Path("whole.ply").read_bytes()
    assert names() == {"scratch", "a.ply", "whole.ply"}


@pytest.mark.longest
def test_a_disk_that_is_full_while_the_surface_is_simplified(folder: Path) -> None:
    done = limited(20_000, *PLAIN[:4], "-o", "a.ply")
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "scratch/infill-chunks-" in done.stderr
    assert "the file would be larger than is allowed" in done.stderr
    assert names() == {"scratch"}


def test_a_chunk_that_is_missing_is_told(folder: Path) -> None:
    shutil.copytree("f.zarr", "hole.zarr")
    Path("hole.zarr/c/1/0/1").unlink()
    report = json.loads(run("smooth", "hole.zarr", *PLAIN, "-o", "a.ply", "--json", "-q").stdout)
    assert report["input"]["warnings"] == [
        "hole.zarr lacks 1 of its 8 chunks, which Zarr reads as 0; check that it was copied whole"
    ]
    values = gyroid(SIDE, 30)
    values[32:, :32, 32:] = 0
    np.save("hole.npy", values)
    hashes = [
        run("smooth", name, *PLAIN, "--workers", "1", "--hash", "-q").stdout for name in ("hole.zarr", "hole.npy")
    ]
    assert hashes[0] == hashes[1] != ""


class Killing:
    """A source whose cells end the process that reads them, once, at the fifth box of a chunk."""

    shape, dtype = (SIDE,) * 3, np.dtype("u1")

    def __init__(self, flag: Path) -> None:
        self.flag, self.parent = flag, os.getpid()

    def read(self, box: tuple[slice, ...]) -> Any:
        if os.getpid() != self.parent and box[0].stop - box[0].start > LAYERS:  # noise is measured in some layers
            with self.flag.open("a") as file:
                file.write("x")
            if self.flag.stat().st_size == 5:
                os.kill(os.getpid(), signal.SIGKILL)
        return gyroid(SIDE, 30)[box]


REQUEST = SmoothRequest(method="plain", smoothing=Smoothing(steps=2), tolerance=None)


@pytest.mark.longest
def test_a_worker_that_is_killed_loses_nothing_that_was_done(tmp_path: Path) -> None:
    def smoothed(scheduler: str, **options: Any) -> str:
        volume = LazyVolume(array=Killing(tmp_path / "flag"))
        with smooth_in_chunks(
            volume, REQUEST, threshold=120, workers=1, scheduler=scheduler, side=32, **options
        ) as surface:
            return surface.report()["hash"]

    with pytest.raises(
        MemoryLimitError, match="a worker ended before its chunk was done, often because memory ran out"
    ):
        smoothed("processes", resume=tmp_path / "kept")
    assert len(list((tmp_path / "kept/fields").glob("*.npz"))) == 4
    assert smoothed("processes", resume=tmp_path / "kept") == smoothed("threads")
    assert not (tmp_path / "kept").exists()


INTERRUPTED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
from infill.chunks import solving
from infill.cli import program
from infill.smoothing import chunk_plans
chunk_plans.LARGEST_CELLS = 32
whole, count = solving.smooth, 0
def call(*arguments):
    global count
    count += 1
    if count == 5:
        os.kill(os.getpid(), signal.SIGINT)
        import time
        time.sleep(5)
    return whole(*arguments)
call.__module__, call.__qualname__ = whole.__module__, whole.__qualname__
solving.smooth = call
sys.argv = ["infill", "smooth", "f.zarr", *sys.argv[1:]]
program()
"""


@pytest.mark.longest
def test_an_interrupted_run_goes_on(folder: Path) -> None:
    words = (*PLAIN, "-q", "--workers", "1", "-o", "a.ply", "--resume", "kept")
    done = subprocess.run([sys.executable, "-c", INTERRUPTED, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 130
    assert done.stderr.count("\n") <= 1
    assert len(list(Path("kept/fields").glob("*.npz"))) == 4
    assert not Path("a.ply").exists()
    assert not list(Path("kept").rglob("*.part"))
    assert limited(0, *words[:6], "-o", "a.ply", "--resume", "kept").returncode == 0
    assert names() == {"scratch", "a.ply"}


@pytest.fixture
def cluster() -> Iterator[Any]:
    from distributed import LocalCluster

    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None, memory_limit=0) as local:
        yield local


@pytest.mark.longest
@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_goes_away_loses_nothing_that_was_done(source: Path, tmp_path: Path, cluster: Any) -> None:
    finished = 0

    def watch(stage: str, share: float) -> None:
        nonlocal finished
        if stage == "smooth":
            finished += 1
            if finished == 4:
                cluster.close()

    def smoothed(**options: Any) -> str:
        request = SmoothRequest(
            method="plain", smoothing=Smoothing(steps=2), tolerance=None, progress=options.pop("progress", None)
        )
        with smooth_in_chunks(open_volume(source), request, threshold=120, side=32, **options) as surface:
            return surface.report()["hash"]

    with pytest.raises(InfillError, match="the scheduler of the cluster does not answer; check that it runs"):
        smoothed(resume=tmp_path / "kept", scheduler=cluster.scheduler_address, progress=watch)
    assert len(list((tmp_path / "kept/results").rglob("*.kept"))) >= 4
    assert smoothed(resume=tmp_path / "kept", workers=1) == smoothed(workers=1)
