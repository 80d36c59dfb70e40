"""Compiling is told once in a process, only where something is compiled, and only once for what is one kind of input."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path

import numba
import numpy as np
import pytest
import trimesh

from infill import smooth_volume
from infill.kernels import compiling, second_compiler
from infill.kernels.compiling import log_compilation, njit
from infill.meshes.compile_simplification import make_ring
from infill.meshes.measuring import volume_and_area
from infill.meshes.shells import shell_volumes, vertex_components
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import smooth_bricks
from infill.surface import Surface

MODULE = """
from infill.kernels.compiling import njit, log_compilation

@njit(cache=True)
def one(x): return x + 1

@njit(cache=True)
def two(x): return x * 2

with log_compilation("nothing"):
    pass
for what, kernel in (("one", one), ("two", two), ("one", one)):
    with log_compilation(what):
        kernel(3)
with log_compilation("one for other numbers"):
    one(0.5)
"""


@pytest.mark.longest
def test_compiling_is_told_once_in_a_process(tmp_path: Path) -> None:
    (tmp_path / "kernels.py").write_text(MODULE)
    root = str(Path(__file__).resolve().parents[1])
    environment = {
        **os.environ,
        "NUMBA_CACHE_DIR": str(tmp_path / "cache"),
        "PYTHONPATH": f"{root}{os.pathsep}{tmp_path}",
    }
    first, second = (
        subprocess.run(
            [sys.executable, "-c", "import kernels"],
            env=environment,
            capture_output=True,
            encoding="utf-8",
            check=True,
        )
        for _ in range(2)
    )
    assert first.stderr == "preparing one for input of this kind, up to a minute, the first time\n"
    assert second.stderr == ""  # found compiled


def _last_of_twice(values: np.ndarray) -> float:
    return float((values + values)[-1])


def test_code_that_makes_an_array_says_so() -> None:
    values = np.arange(3.0)
    with pytest.raises(numba.core.errors.NumbaError):
        njit()(_last_of_twice)(values)
    assert njit(makes_arrays=True)(_last_of_twice)(values) == 4.0


def test_only_code_that_makes_arrays_counts_references() -> None:
    from infill.kernels import collapsing, covering

    for module in (collapsing, covering):
        kernels = [value for value in vars(module).values() if isinstance(value, numba.core.dispatcher.Dispatcher)]
        counted = {kernel.__name__ for kernel in kernels if kernel.targetoptions["_nrt"]}
        assert 0 < len(counted) < len(kernels)
        assert not {"_collapse_in_order", "_sample_in_order", "squared_distance"} & counted  # the loops inside


def test_the_second_process_compiles_for_the_number_types_of_smoothing() -> None:
    ring = make_ring()
    assert ring.closed
    assert ring.volume == pytest.approx(4 * np.pi**2, rel=0.01)
    cells = np.zeros((8, 8, 8), dtype=bool)
    cells[2:6, 2:6, 2:6] = True
    smoothed = smooth_volume(cells, tolerance=None).surface
    assert smoothed.vertices.dtype == ring.vertices.dtype
    assert smoothed.faces.dtype == ring.faces.dtype


LISTENING = """
from numba.core import event
from infill.meshes.compile_simplification import make_ring
from infill.meshes.edge_collapse import collapse_edges

with event.install_recorder("numba:compile") as recorder:
    collapse_edges(make_ring(), tolerance=0.02)
print(len(recorder.buffer))
"""


@pytest.mark.longest
def test_what_the_second_process_compiled_is_not_compiled_again(tmp_path: Path) -> None:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    module = [sys.executable, "-m", "infill.meshes.compile_simplification"]
    subprocess.run(module, env=environment, check=True)
    ran = subprocess.run([sys.executable, "-c", LISTENING], env=environment, check=True, capture_output=True)
    assert int(ran.stdout) == 0


@pytest.mark.parametrize(("cores", "uncached", "started"), [(2, False, True), (1, False, False), (2, True, False)])
def test_a_second_process_starts_if_there_is_a_core_and_a_folder(
    monkeypatch: pytest.MonkeyPatch, cores: int, uncached: bool, started: bool
) -> None:
    commands: list[list[str]] = []

    class Process:
        def __init__(self, command: list[str], **_options: object) -> None:
            commands.append(command)

        def wait(self) -> None:
            commands.append(["waited"])

    monkeypatch.setattr(second_compiler.subprocess, "Popen", Process)
    monkeypatch.setattr(second_compiler, "usable_cores", lambda: cores)
    monkeypatch.setattr(second_compiler, "UNCACHED", threading.Event())
    monkeypatch.setattr(compiling, "AT_FIRST_COMPILATION", starts := [])
    monkeypatch.setattr(second_compiler, "AT_FIRST_COMPILATION", starts)
    monkeypatch.setattr(compiling, "REPORTED", threading.Event())
    if uncached:
        second_compiler.UNCACHED.set()
    for _ in range(3):  # a process may run several commands
        second_compiler.compile_beside("some.module")
    assert not commands
    with log_compilation("a test"):
        njit()(lambda x: x + 1)(1)
    second_compiler.await_second_compiler()
    assert commands == ([[sys.executable, "-P", "-m", "some.module"], ["waited"]] if started else [])


def test_measures_are_compiled_once_whatever_faces_are_stored_as() -> None:
    from infill.kernels.measures import sum_shells, sum_up

    ball = trimesh.creation.icosphere(1)
    for kind in (np.int32, np.int64, np.uint32):
        for faces in (ball.faces.astype(kind), ball.faces.astype(kind)[:, ::-1]):
            surface = Surface(vertices=np.asarray(ball.vertices), faces=faces)
            assert abs(volume_and_area(surface)[0]) == pytest.approx(abs(surface.volume))
            names, count = vertex_components(faces, len(surface.vertices))
            assert shell_volumes(surface, names, count) == pytest.approx([surface.volume])
    for kernel in (sum_up, sum_shells):
        assert {str(signature[1]) for signature in kernel.signatures} == {"array(int32, 2d, C)"}


def test_bricks_are_gathered_by_one_kernel_whether_or_not_arrays_are_writable() -> None:
    from infill.kernels.transfer import gather

    values = np.linspace(-1, 1, 20**3, dtype=np.float32).reshape(20, 20, 20)
    field = smooth_bricks(values, Smoothing(steps=1), threads=1)
    before = len(gather.signatures)
    np.testing.assert_array_equal(field.gathered(values, threads=1), field.gathered(values[:], threads=1))
    new = gather.signatures[before:]
    assert all(not signature[0].mutable for signature in new)
    assert len(new) <= 1
