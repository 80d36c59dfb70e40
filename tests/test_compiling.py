"""Compiling is told once in a process, only where something is compiled, and only once for what is one kind of input."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

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
    np.testing.assert_array_equal(field.gathered(values, threads=1), field.gathered(values[:], threads=1))
    whole = [signature[0] for signature in gather.signatures]
    assert all(not kind.mutable for kind in whole)
