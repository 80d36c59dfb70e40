"""The same input gives the same bytes: on any number of threads, beside other work, whatever clocks and hashes say."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import infill
from infill import Smoothing, smooth_mesh, smooth_points, smooth_volume
from infill.smoothing.attempt import estimate_surface_cells
from infill.smoothing.remedies import MAX_WORK, estimate_work
from infill.smoothing.request import SmoothInput, SmoothRequest
from infill.volume import Volume

pytestmark = pytest.mark.usefixtures("compiled")

CLOCKS = ("process_time", "thread_time", "perf_counter", "monotonic", "time")


def smooth_scan(**options: Any) -> Any:
    """A plate two cells thick between two blocks, which 60 steps break: it takes fewer of them."""
    solid = np.zeros((60, 30, 30), bool)
    solid[4:16, 6:24, 6:24] = solid[44:56, 6:24, 6:24] = solid[16:44, 6:24, 14:16] = True
    return smooth_volume(solid, smoothing=Smoothing(steps=60), method="plain", tolerance=None, **options)


def smooth_fin(**options: Any) -> Any:
    """A bar with a fin half a voxel thick, which is lost: it takes finer voxels."""
    bar, fin = trimesh.creation.box((40, 2, 2)), trimesh.creation.box((40, 0.1, 4))
    return smooth_mesh(trimesh.boolean.union([bar, fin]), tolerance=None, **options)


def smooth_cloud(**options: Any) -> Any:
    points = trimesh.creation.icosphere(4, radius=10.0).vertices * [1, 0.8, 0.6]
    return smooth_points(points, voxel=0.8, tolerance=None, **options)


SOURCES: dict[str, tuple[Callable[..., Any], int]] = {  # and the number of ways that are tried
    "scan": (smooth_scan, 2),
    "mesh": (smooth_fin, 2),
    "points": (smooth_cloud, 1),
}


def stl(name: str, folder: Path, **options: Any) -> bytes:
    """Smooth a source; return its binary STL, and after that its ways and verdict."""
    result = SOURCES[name][0](**options)
    verdict = result.report["verdict"]
    assert len(verdict["tried"]) >= SOURCES[name][1]
    return result.save(folder / "a.stl").read_bytes() + repr(sorted(verdict.items())).encode()


@cache
def expected(name: str, folder: Path) -> bytes:
    return stl(name, folder, threads=1)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("same")


@contextmanager
def busy_processes(count: int) -> Iterator[None]:
    """Keep some cores busy."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


@pytest.mark.long
@pytest.mark.parametrize("name", SOURCES)
@pytest.mark.parametrize("threads", [2, 3])
def test_threads_change_nothing(name: str, threads: int, folder: Path) -> None:
    assert stl(name, folder, threads=threads) == expected(name, folder)


@pytest.mark.long
@pytest.mark.parametrize("name", SOURCES)
def test_load_changes_nothing(name: str, folder: Path) -> None:
    with busy_processes(2):
        assert stl(name, folder, threads=2) == expected(name, folder)


@pytest.mark.long
@pytest.mark.parametrize("name", SOURCES)
@pytest.mark.parametrize("times", [1000.0, 0.001])
def test_clocks_change_nothing(name: str, times: float, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine a thousand times as slow, or as fast, tries the same ways."""
    expected(name, folder)
    for clock in CLOCKS:
        real: Callable[[], float] = getattr(time, clock)
        monkeypatch.setattr(time, clock, lambda real=real: times * real())
    assert stl(name, folder, threads=2) == expected(name, folder)


@pytest.mark.longest
def test_the_order_of_hashes_changes_nothing(folder: Path) -> None:
    script = (
        "import sys, pathlib, hashlib, test_determinism as t\n"
        "for name in t.SOURCES:\n"
        "    print(hashlib.sha256(t.stl(name, pathlib.Path(sys.argv[1]), threads=2)).hexdigest())\n"
    )
    path = os.pathsep.join([str(Path(__file__).parent), *sys.path])
    printed = [
        subprocess.run(
            [sys.executable, "-c", script, str(folder)],
            env=os.environ | {"PYTHONHASHSEED": seed, "PYTHONPATH": path},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert len(printed[0].split()) == len(SOURCES)
    assert printed[0] == printed[1]


def test_clocks_are_read_only_where_time_is_told() -> None:
    """In reports, forecasts and plans, and to warn: nothing that makes a file may import a clock."""
    package = Path(infill.__file__).parent
    readers = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if re.search(r"^\s*(import time\b|from time import)", path.read_text(encoding="utf-8"), re.MULTILINE)
    }
    assert readers == {
        "cli/__init__.py",
        "cli/foreseeing.py",
        "cli/labelled.py",
        "making/duration.py",
        "result.py",
        "smoothing/chunked.py",
        "smoothing/chunked_plan.py",
        "smoothing/chunked_surface.py",
        "smoothing/plan.py",
        "smoothing/together_chunks.py",
        "smoothing/together_plan.py",
        "studio/pages.py",
        "studio/worker.py",
    }


def half_space(side: int) -> Volume:
    return Volume(values=np.indices((side, side, side))[2] < side // 2)


@pytest.mark.parametrize("side", [16, 40, 100])
def test_cells_at_a_surface_are_estimated(side: int) -> None:
    """A plane across the last axis crosses one cell a row; two of three axes count, and are taken for all three."""
    assert estimate_surface_cells(half_space(side)) == pytest.approx(1.5 * side**2, rel=0.3)


def test_work_grows_with_the_surface_and_with_steps() -> None:
    def work(side: int, steps: int, **options: Any) -> float:
        data = SmoothInput(data=half_space(side), facts={})
        return estimate_work(data, SmoothRequest(smoothing=Smoothing(steps=steps), **options))

    assert work(80, 20) == pytest.approx(4 * work(40, 20), rel=0.1)
    assert work(40, 400) > 2 * work(40, 20)
    assert work(40, 20, method="refine") > work(40, 20, method="plain")
    assert work(40, 20, radius=3.0) == work(40, round(3.5 * 9))
    assert work(100, 20) < MAX_WORK / 100
