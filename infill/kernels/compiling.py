"""Compiling: what to do where the result cannot be kept on disk, and reporting it when it has to be waited for."""

from __future__ import annotations

import logging
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

LOG = logging.getLogger("infill")
TOLD = threading.Event()  # set once compiling was reported in this process
OURS = threading.Event()  # set if nobody else compiles in this process
BLAS = "scipy.linalg.cython_blas"
_WATCHED = ContextVar("watched", default=False)


def njit(**options: Any) -> Callable[[Callable[..., Any]], Any]:  # noqa: ANN401 - hands on
    """Return numba's decorator; where no folder can hold compiled code, the code is not kept."""
    import numba

    if OURS.is_set() and "numba.np.arraymath" not in sys.modules:
        _load_without_blas()

    def compiled(function: Callable[..., Any]) -> Any:  # noqa: ANN401 - a dispatcher of numba's
        try:
            return numba.njit(**options)(function)
        except RuntimeError:
            return numba.njit(**(options | {"cache": False}))(function)

    return compiled


def _load_without_blas() -> None:
    """Load what numba says about arrays, but not the BLAS that matrix products need, of which there are none here.

    With BLAS come SciPy's linear algebra and much more: 0.2 s, a tenth of what a short command takes.
    """
    known = BLAS in sys.modules
    if not known:
        sys.modules.update({BLAS: None})  # type: ignore[dict-item]
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        if not known:
            sys.modules.pop(BLAS, None)


@contextmanager
def told_of_compiling(what: str) -> Iterator[None]:
    """Report to the log "infill" as soon as something inside is being compiled rather than found compiled on disk.

    Done once per process, by the outermost of nested uses; also works as a decorator. `what` follows "compiling".
    """
    if _WATCHED.get() or TOLD.is_set():
        yield
        return
    from numba.core import event

    class Listener(event.Listener):
        def on_start(self, event: object) -> None:  # noqa: ARG002 - what is compiled does not matter
            if not TOLD.is_set():
                TOLD.set()
                LOG.warning("compiling %s: up to a minute, and kept for later runs", what)

        def on_end(self, event: object) -> None:
            pass

    token = _WATCHED.set(True)
    try:
        with event.install_listener("numba:run_pass", Listener()):
            yield
    finally:
        _WATCHED.reset(token)
