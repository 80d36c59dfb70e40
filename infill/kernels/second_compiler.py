"""A second process that compiles kernels of a later stage while this process compiles those of an earlier one.

Numba compiles one function at a time in a process. Both processes keep what they compiled in the same folder, so that
the later stage finds its kernels compiled.
"""

from __future__ import annotations

import os
import subprocess
import sys
from functools import partial

from infill.kernels.compiling import AT_FIRST_COMPILATION, UNCACHED
from infill.machine import has_interpreter, usable_cores

_RUNNING: list[subprocess.Popen[bytes]] = []


def compile_beside(module: str) -> None:
    """Run `python -m module` in a second process as soon as this one compiles anything, if there is a core for it.

    Only the first call in a process counts. Without an interpreter to start, there is no second process.
    """
    if usable_cores() > 1 and has_interpreter() and not AT_FIRST_COMPILATION:
        AT_FIRST_COMPILATION.append(partial(_start, module))


def await_second_compiler() -> None:
    """Wait for the second process, if there is one: what it compiles, this process would compile at the same time."""
    while _RUNNING:
        _RUNNING.pop().wait()


def _start(module: str) -> None:
    """Start the second process, unless what it compiled could not be kept."""
    if not UNCACHED.is_set():
        _RUNNING.append(
            subprocess.Popen(  # noqa: S603 - of this package
                [sys.executable, "-P", "-m", module],  # -P: no module of the folder that the user is in
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            )
        )
