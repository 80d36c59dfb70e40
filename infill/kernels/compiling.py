"""Compilation: functions without a disk cache where none is writable, and messages about waiting for the compiler."""

from __future__ import annotations

import gc
import logging
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from typing import Any

LOG = logging.getLogger("infill")
REPORTED = threading.Event()  # set once compilation was reported in this process
UNCACHED = threading.Event()  # set if compiled code cannot be kept for later runs
_CACHED_TEXT = "preparing %s for input of this kind, up to a minute, the first time"
_UNCACHED_TEXT = (
    "preparing %s takes up to a minute in every run, because no folder for it is writable; set NUMBA_CACHE_DIR to one"
)
SOLE_COMPILER = threading.Event()  # set if no other thread compiles in this process
AT_FIRST_COMPILATION: list[Callable[[], None]] = []  # called as soon as compilation is reported
MAKERS = frozenset({"copy", "empty", "full", "ones", "reshape", "zeros"})  # names by which code makes arrays
BLAS = "scipy.linalg.cython_blas"
OBJECTS_BETWEEN_COLLECTIONS = 50_000
_WATCHED = ContextVar("watched", default=False)


def njit(
    *,
    makes_arrays: bool = False,
    from_python: bool = True,
    **options: Any,  # noqa: ANN401 - hands on
) -> Callable[[Callable[..., Any]], Any]:
    """Return numba's decorator; without a writable folder, compiled code is not cached.

    Code that makes no arrays does not count references to them: counting them, by one processor at a time, takes up to
    half the time of loops that look at rows of arrays. Numba refuses to compile code that makes an array without.

    A function that only kernels call gets no entry for Python, which takes a tenth of the time to compile it.

    Parameters
    ----------
    makes_arrays : bool
        Whether the function makes arrays in other ways than by the names in `MAKERS`: by an expression of arrays, say.
    from_python : bool
        Whether Python calls the function, rather than kernels alone: calling it without an entry ends the process.
    **options
        Of `numba.njit`.
    """
    import numba

    if SOLE_COMPILER.is_set() and "numba.np.arraymath" not in sys.modules:
        _load_without_blas()

    def compiled(function: Callable[..., Any]) -> Any:  # noqa: ANN401 - a dispatcher of numba's
        counts = makes_arrays or not MAKERS.isdisjoint(function.__code__.co_names)
        # No other language calls these functions.
        chosen = options | {"no_cfunc_wrapper": True, "no_cpython_wrapper": not from_python, "_nrt": counts}
        try:
            return _with_optional_cache(numba.njit(**chosen)(function))
        except RuntimeError:
            UNCACHED.set()
            return numba.njit(**(chosen | {"cache": False}))(function)

    return compiled


def _with_optional_cache(function: Any) -> Any:  # noqa: ANN401 - a dispatcher of numba's
    """Return a function whose compiled code is used even if the disk has no room to keep it."""
    cache = vars(function)["_cache"]  # numba has no public name for it
    save = cache.save_overload

    def save_if_possible(*signature_and_code: object) -> None:
        try:
            save(*signature_and_code)
        except OSError as error:
            if not UNCACHED.is_set():
                UNCACHED.set()
                LOG.warning("compiled code cannot be kept for the next run: %s", error.strerror or error)

    cache.save_overload = save_if_possible
    return function


def is_compiler_loaded() -> bool:
    """Tell whether numba is loaded: loading it takes 0.3 s, which short work in NumPy does not."""
    return "numba" in sys.modules


def _load_without_blas() -> None:
    """Load numba's array functions without the BLAS of matrix products, which this package does not use.

    BLAS loads SciPy's linear algebra and much more: 0.2 s, a tenth of the time of a short command.
    """
    is_loaded = BLAS in sys.modules
    if not is_loaded:
        sys.modules.update({BLAS: None})  # type: ignore[dict-item]
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        if not is_loaded:
            sys.modules.pop(BLAS, None)


def collect_garbage_rarely() -> None:
    """Collect garbage rarely in this process: the compiler makes millions of objects that stay, and little garbage.

    That is 5 to 10 % of the time of compiling, and memory does not grow.
    """
    _, middle, old = gc.get_threshold()
    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS, middle, old)


def compile_for(kernel: Any, *examples: Any) -> None:  # noqa: ANN401 - numba's functions, and what they are given
    """Compile a kernel for arguments of the types of these, and call nothing."""
    import numba

    kernel.compile(tuple(numba.typeof(example) for example in examples))  # type: ignore[no-untyped-call]


@contextmanager
def log_compilation(what: str) -> Iterator[None]:
    """Report to the log "infill" as soon as code inside is compiled rather than loaded from disk.

    Report once per process, in the outermost of nested uses; also works as a decorator. `what` follows "preparing".
    """
    if _WATCHED.get() or REPORTED.is_set():
        yield
        return
    from numba.core import event

    token = _WATCHED.set(True)
    try:
        with event.install_listener("numba:run_pass", _listener()(what)):
            yield
    finally:
        _WATCHED.reset(token)


@cache
def _listener() -> Callable[[str], Any]:
    """Return the class, made once, of what hears that something is being compiled."""
    from numba.core import event

    class Listener(event.Listener):
        def __init__(self, what: str) -> None:
            self.what = what

        def on_start(self, event: object) -> None:  # noqa: ARG002 - any compilation counts
            if not REPORTED.is_set():
                REPORTED.set()
                LOG.warning(_UNCACHED_TEXT if UNCACHED.is_set() else _CACHED_TEXT, self.what)
                if SOLE_COMPILER.is_set():
                    collect_garbage_rarely()
                for start in AT_FIRST_COMPILATION:
                    start()

        def on_end(self, event: object) -> None:
            pass

    return Listener
