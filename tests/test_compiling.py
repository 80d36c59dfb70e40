"""Compiling is told once in a process, and only where something is compiled."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest

from infill.kernels.compiling import njit

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
    with pytest.raises(numba.TypingError):
        njit()(_last_of_twice)(values)
    assert njit(makes_arrays=True)(_last_of_twice)(values) == 4.0


def test_only_code_that_makes_arrays_counts_references() -> None:
    from infill.kernels import collapsing, covering

    for module in (collapsing, covering):
        kernels = [value for value in vars(module).values() if isinstance(value, numba.core.dispatcher.Dispatcher)]
        counted = {kernel.__name__ for kernel in kernels if kernel.targetoptions["_nrt"]}
        assert 0 < len(counted) < len(kernels)
        assert not {"_collapse_in_order", "_sample_in_order", "squared_distance"} & counted  # the loops inside
