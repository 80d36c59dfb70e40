"""Run a reader that is not ours in a process of its own, with limits, and take over the arrays that it returns.

A library in C++ may end its process where a file is broken; in a child, that is one line of ours. The child loads what
the reader needs and nothing else. Arrays come back by a file in memory, or else on disk, that has no name and so is
never left behind; they are mapped, not copied. What the libraries print comes back as text.
"""

from __future__ import annotations

import contextlib
import ctypes
import importlib
import json
import mmap
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from infill import errors
from infill.errors import FormatError, InfillError, MemoryLimitError
from infill.files.broken import BROKEN
from infill.machine import GIB, available_memory

SECONDS = 600.0  # for one file: the slowest network drive fills memory in that time
BASE = GIB  # bytes of address space for the interpreter and its libraries
MOST_LINES = 20  # of what the libraries print
LONGEST_LINE = 300
PLACE = re.compile(r"^(WARNING|ERROR): In .*, line \d+$")  # where in its source a library stands; of no use here
ADDRESS = re.compile(r" ?\(0x[0-9a-f]+\)")
TRACE = "Traceback (most recent call last)"
LENGTH = 8  # bytes, at the end, that say how long the text before them is
ALIGNED = 64  # bytes
NAMELESS = os.name == "posix"  # elsewhere numbers of files do not travel, and no file is removed while it is mapped
KILL_ON_DEATH = 1  # PR_SET_PDEATHSIG of Linux
# Threads reserve address space, and reading needs none.
ENVIRONMENT = {
    "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}
# `-P` keeps the working directory off the path: a file there must not stand in for a module.
BOOT = (
    "import json, sys; request = json.load(sys.stdin); sys.path[:] = request['path']; "
    "from infill.files.child_process import serve; serve(request)"
)


@dataclass(frozen=True, kw_only=True)
class Reply:
    """What a reader returned.

    Parameters
    ----------
    data : dict
        Numbers, texts, lists and dicts.
    arrays : dict of str to array
        They may be changed.
    said : tuple of str
        Lines that the libraries printed, each once.
    """

    data: dict[str, Any] = field(default_factory=dict)
    arrays: dict[str, NDArray[Any]] = field(default_factory=dict)
    said: tuple[str, ...] = ()


def read_in_child(
    reader: str,
    *arguments: Any,  # noqa: ANN401 - whatever JSON holds
    path: Path,
    seconds: float = SECONDS,
    memory: int | None = None,
) -> Reply:
    """Run a reader in a child process, and return what it returned.

    Parameters
    ----------
    reader : str
        Module and function, such as "infill.imaging.medical:unpack_frames". It takes the arguments and returns (data,
        arrays): a dict that JSON can hold, and a dict of NumPy arrays.
    *arguments
        What JSON can hold.
    path : Path
        The file that is read, for messages.
    seconds : float
        How long it may take.
    memory : int, optional
        Bytes that it may use beside its libraries; if left out, what is available. Windows has no such limit.

    Raises
    ------
    FormatError
        If the reader raises an error, or ends its process, as libraries do for broken files; or takes too long.
    MemoryLimitError
        If it needs more memory.

    Notes
    -----
    Where there is no interpreter to start, as in a frozen application, the reader runs in this process.
    """
    if getattr(sys, "frozen", False) or not sys.executable:
        data, arrays = _function(reader)(*arguments)
        return Reply(data=data, arrays=arrays)
    allowed = memory if memory is not None else available_memory()
    request = {
        "path": sys.path,
        "reader": reader,
        "arguments": arguments,
        "memory": None if allowed is None else allowed + BASE,
        "seconds": seconds,
        "parent": os.getpid(),
    }
    with _result_file() as (file, name):
        request["result"] = name
        code, printed = _run(json.dumps(request), seconds, path, () if isinstance(name, str) else (name,))
        answer = _answer(file)
        if answer is None:
            raise _crashed(path, code, printed)
        if "error" in answer:
            raise _error(path, **answer["error"])
        return Reply(data=answer["data"], arrays=_arrays(file, answer["arrays"]), said=_lines(printed))


def _run(request: str, seconds: float, path: Path, files: tuple[int, ...]) -> tuple[int, str]:
    """Run the child to its end; return its exit status and what it printed. It does not outlive this call."""
    with subprocess.Popen(  # noqa: S603 - this interpreter, and a text of ours
        [sys.executable, "-P", "-c", BOOT],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={**os.environ, **ENVIRONMENT, "PYTHONIOENCODING": "utf-8"},
        pass_fds=files,
        encoding="utf-8",
        errors="replace",
    ) as child:
        try:
            printed, _ = child.communicate(request, timeout=seconds)
        except subprocess.TimeoutExpired as error:
            raise FormatError(
                f"{path} takes over {seconds:g} s to read; check that it is whole, or copy it to a fast disk"
            ) from error
        finally:
            child.kill()  # on an interrupt too; nothing happens if it has ended
    return child.returncode, printed


@contextlib.contextmanager
def _result_file() -> Iterator[tuple[IO[bytes], int | str]]:
    """Yield a file for the result, and its number or its name for the child."""
    if NAMELESS and hasattr(os, "memfd_create"):
        with open(os.memfd_create("infill-volume"), "r+b") as file:
            yield file, file.fileno()
    elif NAMELESS:
        with tempfile.TemporaryFile() as file:
            yield file, file.fileno()
    else:
        with tempfile.TemporaryDirectory(prefix="infill-") as folder, (Path(folder) / "volume").open("x+b") as file:
            yield file, file.name


def _answer(file: IO[bytes]) -> dict[str, Any] | None:
    """Return what the child wrote at the end, or None if it did not come to that."""
    size = os.fstat(file.fileno()).st_size
    if size < LENGTH:
        return None
    file.seek(size - LENGTH)
    length = int.from_bytes(file.read(LENGTH), "little")
    if length > size - LENGTH:
        return None
    file.seek(size - LENGTH - length)
    try:
        found = json.loads(file.read(length))
    except ValueError:
        return None
    return found if isinstance(found, dict) else None


def _arrays(file: IO[bytes], described: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    if not described:
        return {}
    held: Any
    if NAMELESS:
        held = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_COPY)
    else:
        file.seek(0)
        held = bytearray(file.read())
    return {
        name: np.ndarray(tuple(each["shape"]), dtype=each["dtype"], buffer=held, offset=each["at"])
        for name, each in described.items()
    }


def _lines(printed: str) -> tuple[str, ...]:
    """Return what was printed, line by line, each once, without places in the source of a library."""
    lines = (ADDRESS.sub("", line.strip())[:LONGEST_LINE] for line in printed.splitlines())
    return tuple(dict.fromkeys(line for line in lines if line and not PLACE.match(line)))[:MOST_LINES]


def _error(path: Path, kind: str, text: str, *, ours: bool) -> InfillError:
    if ours:
        found = getattr(errors, kind, FormatError)
        return found(text)
    if kind == "MemoryError" or "bad_alloc" in text or "allocate memory" in text:
        return MemoryLimitError(f"{path} needs more memory than there is; check it, or give a smaller one")
    return FormatError(f"cannot read {path} ({text}); check the file, or save it again")


def _crashed(path: Path, code: int, printed: str) -> InfillError:
    """Return the error for a child that ended without an answer."""
    if "MemoryError" in printed or "bad_alloc" in printed:
        return MemoryLimitError(f"{path} needs more memory than there is; check it, or give a smaller one")
    how = f"exit status {code}"
    if code < 0:
        with contextlib.suppress(ValueError):
            how = signal.Signals(-code).name
    return FormatError(f"{path} ends the library that reads it ({how}), as broken files do; save or export it again")


# --- in the child ----------------------------------------------------------------------------------------


def serve(request: dict[str, Any]) -> None:
    """Run the reader that was asked for, and write what it returns to the file of the result."""
    _limit(request)
    answer: dict[str, Any] = {}
    arrays: dict[str, NDArray[Any]] = {}
    try:
        answer["data"], arrays = _function(request["reader"])(*request["arguments"])
    except (InfillError, MemoryError, OSError, *BROKEN) as error:
        arrays = {}
        said = str(error) if isinstance(error, InfillError) else _said(error)
        answer = {"error": {"kind": type(error).__name__, "text": said, "ours": isinstance(error, InfillError)}}
    with open(request["result"], "r+b") as file:
        answer["arrays"] = {name: _write(file, values) for name, values in arrays.items()}
        text = json.dumps(answer).encode()
        file.write(text + len(text).to_bytes(LENGTH, "little"))


def _limit(request: dict[str, Any]) -> None:
    """Set the limits that this system has, and end with the parent."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(KILL_ON_DEATH, signal.SIGKILL)
        if os.getppid() != request["parent"]:
            sys.exit(1)  # it had ended before
    try:
        import resource
    except ImportError:  # Windows
        return
    for name, most in (
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_CPU, int(request["seconds"]) + 1),
        (resource.RLIMIT_AS, request["memory"]),
    ):
        if most is not None:
            hard = resource.getrlimit(name)[1]
            with contextlib.suppress(ValueError, OSError):  # macOS knows some of them by name only
                resource.setrlimit(name, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))


def _write(file: IO[bytes], values: NDArray[Any]) -> dict[str, Any]:
    """Append an array to a file; return where it is."""
    at = file.seek(0, os.SEEK_END)
    file.write(b"\0" * (-at % ALIGNED))
    at += -at % ALIGNED
    plain = np.ascontiguousarray(values)
    file.write(plain.reshape(-1).view(np.uint8).data if plain.size else b"")
    return {"shape": plain.shape, "dtype": plain.dtype.str, "at": at}


def _function(reader: str) -> Any:  # noqa: ANN401
    module, _, name = reader.partition(":")
    return getattr(importlib.import_module(module), name)


def _said(error: Exception) -> str:
    """Return what a library says of a file, in one line: the last of its own, without addresses."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip() and not line.startswith("Reason:")]
    last = re.sub(r"^.*ERROR: |\w+\(0x\w+\): ", "", lines[-1]) if lines else type(error).__name__
    return last[:LONGEST_LINE]
