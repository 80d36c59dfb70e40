"""The command line: parses arguments, calls the library, reports.

`program` is the console script. It loads nothing until it can be interrupted cleanly.
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import io
import os
import signal
import sys
import time
from types import FrameType

INTERRUPTED, TERMINATED = 130, 143
OBJECTS = 100_000  # new objects before a garbage collection: objects that a command loads stay to its end
READ = 0.3  # seconds in which a slicer reads the messages of its script: it stops reading when the script ends


def program() -> None:
    """Run the command line as a separate process, and end it.

    Loaded objects are not freed one by one at the end: with a compiler, that takes 0.3 s.
    """
    gc.set_threshold(OBJECTS, *gc.get_threshold()[1:])
    codes = [1]  # exit status of an unexpected error
    atexit.register(lambda: _end(codes[-1]))  # the first to be registered, so the last to be done
    try:
        main(alone=True)
        codes.append(0)
    except SystemExit as end:
        codes.append(end.code if isinstance(end.code, int) else int(end.code is not None))
        raise


def main(*, alone: bool = False) -> None:
    """Run the command line: exit 0 on success, 1 for errors of the library, 2 for usage errors, 130 when interrupted.

    If it is `alone` in the process, modules that only other code would need are not loaded.
    """
    for name in ("SIGTERM", "SIGHUP"):
        with contextlib.suppress(AttributeError, ValueError):  # no such signal here, or not the main thread
            signal.signal(getattr(signal, name), _terminate)
    _open_missing_streams()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a name that the console cannot show must not fail
            stream.reconfigure(errors="backslashreplace")
    try:
        _run(alone=alone)
        sys.stdout.flush()
    except KeyboardInterrupt:
        _leave(INTERRUPTED)
    except SystemExit as end:
        if end.code in (INTERRUPTED, TERMINATED):
            _leave(end.code)
        raise
    except OSError as error:  # stdout or stderr is full or gone; errors of files are OutputError
        with contextlib.suppress(OSError):
            sys.stderr.write(f"error: cannot write to stdout: {error.strerror or error}\n")
        # Text still buffered for stdout would fail again when Python exits.
        sys.stdout = None
        sys.exit(1)


def _open_missing_streams() -> None:
    """Open the null device in place of standard streams that do not exist: under pythonw, or after `2>&-`.

    Their numbers are taken first: a file that got number 2 would receive messages of compiled libraries.
    """
    for number in range(3):
        with contextlib.suppress(OSError):
            try:
                os.fstat(number)
            except OSError:
                os.open(os.devnull, os.O_RDWR)
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 - for the life of the process


def _end(code: int) -> None:
    """Exit; after an error under a slicer of the PrusaSlicer family, wait until the slicer has read it."""
    if code and "SLIC3R_PP_OUTPUT_NAME" in os.environ:
        with contextlib.suppress(OSError, ValueError, AttributeError):
            sys.stderr.flush()
        time.sleep(READ)
    _leave(code)


def _leave(code: int) -> None:
    """Exit at once: a thread may wait for ever for a lock that the interrupt left locked. Files are removed by now."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):  # full, closed, or None
            stream.flush()
    os._exit(code)


def _run(*, alone: bool) -> None:
    """Run the command of sys.argv; `alone` says that no other process compiles."""
    import warnings

    from infill.cli.app import build_app
    from infill.cli.console import warn
    from infill.kernels.compiling import SOLE_COMPILER

    if alone:
        SOLE_COMPILER.set()
    warnings.showwarning = warn
    try:
        build_app("".join(sys.argv[1:2]))()
    except SystemExit as end:
        if end.code:
            raise


def _terminate(number: int, frame: FrameType | None) -> None:  # noqa: ARG001 - the signature of a handler
    """Exit as after an error, so that half-written files are removed."""
    raise SystemExit(TERMINATED)
