"""Run the reader of a foreign library in a child process, with limits, and take over the arrays that it returns.

A library in C++ may crash on a broken file; in a child, the crash becomes an error of one line. The child loads only
the modules that the reader needs. Arrays come back through a file in memory, or else on disk, that has no name and
so is never left behind; they are mapped, not copied. The output of the libraries comes back as text.
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
from infill.files.broken import READER_ERRORS
from infill.machine import GIB, available_memory, has_interpreter
from infill.plain_numbers import plain_argument

TIME_LIMIT = 600.0  # for one file: the slowest network drive fills memory in that time
BASE_MEMORY = GIB  # bytes of address space for the interpreter and its libraries
MOST_LINES = 20  # of the output of libraries
LONGEST_LINE = 300
SOURCE_PLACE = re.compile(r"^(WARNING|ERROR): In .*, line \d+$")  # a place in the source of a library
ADDRESS = re.compile(r" ?\(0x[0-9a-f]+\)")
TRACE = "Traceback (most recent call last)"
LENGTH_BYTES = 8  # bytes, at the end, that say how long the text before them is
ALIGNMENT = 64  # bytes
HAS_NAMELESS_FILES = (
    os.name == "posix"
)  # elsewhere numbers of files do not travel, and no file is removed while it is mapped
KILL_ON_DEATH = 1  # PR_SET_PDEATHSIG of Linux
# Threads reserve address space, and reading needs none.
ENVIRONMENT = {
    "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}
# `-P` keeps the working directory off the path: a file there must not stand in for a module.
BOOT_CODE = (
    "import json, sys; request = json.load(sys.stdin); sys.path[:] = request['path']; "
    "from infill.files.child_process import serve; serve(request)"
)


@dataclass(frozen=True, kw_only=True)
class Reply:
    """The result of a reader.

    Parameters
    ----------
    data : dict
        Numbers, texts, lists and dicts.
    arrays : dict of str to array
        They are writable.
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
    seconds: float = TIME_LIMIT,
    memory: int | None = None,
) -> Reply:
    """Run a reader in a child process and return its result.

    Parameters
    ----------
    reader : str
        Module and function, such as "infill.imaging.medical:unpack_frames". It takes the arguments and returns (data,
        arrays): a dict that JSON can hold, and a dict of NumPy arrays.
    *arguments
        Any values that JSON can hold.
    path : Path
        The file that is read, for messages.
    seconds : float
        Time limit.
    memory : int, optional
        Bytes that it may use beside its libraries; if left out, the available memory. Windows has no such limit.

    Raises
    ------
    FormatError
        If the reader raises an error, or ends its process, as libraries do for broken files; or takes too long.
    MemoryLimitError
        If it needs more memory.

    Notes
    -----
    Without an interpreter to start, as in a frozen application, the reader runs in this process.
    """
    if not has_interpreter():
        data, arrays = _import_function(reader)(*arguments)
        return Reply(data=data, arrays=arrays)
    allowed = memory if memory is not None else available_memory()
    request = {
        "path": sys.path,
        "reader": reader,
        "arguments": arguments,
        "memory": None if allowed is None else allowed + BASE_MEMORY,
        "seconds": seconds,
        "parent": os.getpid(),
    }
    with _result_file() as (file, name):
        request["result"] = name
        code, printed = _run_child(json.dumps(request), seconds, path, () if isinstance(name, str) else (name,))
        answer = _read_answer(file)
        if answer is None:
            raise _crash_error(path, code, printed)
        if "error" in answer:
            raise _child_error(path, **answer["error"])
        return Reply(data=answer["data"], arrays=_map_arrays(file, answer["arrays"]), said=_output_lines(printed))


def _run_child(request: str, seconds: float, path: Path, files: tuple[int, ...]) -> tuple[int, str]:
    """Run the child to its end; return its exit status and its output. It does not outlive this call."""
    with subprocess.Popen(  # noqa: S603 - this interpreter, and a constant text
        [sys.executable, "-P", "-c", BOOT_CODE],
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
                f"{path} takes over {plain_argument(seconds)} s to read; check that it is whole, or copy it to a fast "
                "disk"
            ) from error
        finally:
            child.kill()  # on an interrupt too; nothing happens if it has ended
    return child.returncode, printed


@contextlib.contextmanager
def _result_file() -> Iterator[tuple[IO[bytes], int | str]]:
    """Yield a file for the result, and its number or its name for the child."""
    if HAS_NAMELESS_FILES and hasattr(os, "memfd_create"):
        with open(os.memfd_create("infill-volume"), "r+b") as file:
            yield file, file.fileno()
    elif HAS_NAMELESS_FILES:
        with tempfile.TemporaryFile() as file:
            yield file, file.fileno()
    else:
        with tempfile.TemporaryDirectory(prefix="infill-") as folder, (Path(folder) / "volume").open("x+b") as file:
            yield file, file.name


def _read_answer(file: IO[bytes]) -> dict[str, Any] | None:
    """Return the answer that the child wrote at the end of the file, or None if it did not come to that."""
    size = os.fstat(file.fileno()).st_size
    if size < LENGTH_BYTES:
        return None
    file.seek(size - LENGTH_BYTES)
    length = int.from_bytes(file.read(LENGTH_BYTES), "little")
    if length > size - LENGTH_BYTES:
        return None
    file.seek(size - LENGTH_BYTES - length)
    try:
        answer = json.loads(file.read(length))
    except ValueError:
        return None
    return answer if isinstance(answer, dict) else None


def _map_arrays(file: IO[bytes], entries: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """Map the arrays of the result file into memory, by name."""
    if not entries:
        return {}
    buffer: Any
    if HAS_NAMELESS_FILES:
        buffer = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_COPY)
    else:
        file.seek(0)
        buffer = bytearray(file.read())
    return {
        name: np.ndarray(tuple(entry["shape"]), dtype=entry["dtype"], buffer=buffer, offset=entry["at"])
        for name, entry in entries.items()
    }


def _output_lines(printed: str) -> tuple[str, ...]:
    """Split the child's output into distinct lines, without those that only name a place in a library's source."""
    lines = (ADDRESS.sub("", line.strip())[:LONGEST_LINE] for line in printed.splitlines())
    return tuple(dict.fromkeys(line for line in lines if line and not SOURCE_PLACE.match(line)))[:MOST_LINES]


def _child_error(path: Path, kind: str, text: str, *, ours: bool) -> InfillError:
    """Return the error that corresponds to the one in the child."""
    if ours:
        error_class = getattr(errors, kind, FormatError)
        return error_class(text)
    if kind == "MemoryError" or "bad_alloc" in text or "allocate memory" in text:
        return MemoryLimitError(f"{path} needs more memory than there is; check it, or give a smaller one")
    return FormatError(f"cannot read {path} ({text}); check the file, or save it again")


def _crash_error(path: Path, code: int, printed: str) -> InfillError:
    """Return the error for a child that ended without an answer."""
    if "MemoryError" in printed or "bad_alloc" in printed:
        return MemoryLimitError(f"{path} needs more memory than there is; check it, or give a smaller one")
    how = f"exit status {code}"
    if code < 0:
        with contextlib.suppress(ValueError):
            how = signal.Signals(-code).name
    return FormatError(
        f"{path} crashes the library that reads it ({how}), so it is probably damaged; save or export it again"
    )


# --- in the child ----------------------------------------------------------------------------------------


def serve(request: dict[str, Any]) -> None:
    """Run the requested reader and write its result to the result file."""
    _set_limits(request)
    answer: dict[str, Any] = {}
    arrays: dict[str, NDArray[Any]] = {}
    try:
        answer["data"], arrays = _import_function(request["reader"])(*request["arguments"])
    except (InfillError, MemoryError, OSError, *READER_ERRORS) as error:
        arrays = {}
        message = str(error) if isinstance(error, InfillError) else _error_message(error)
        answer = {"error": {"kind": type(error).__name__, "text": message, "ours": isinstance(error, InfillError)}}
    with open(request["result"], "r+b") as file:
        answer["arrays"] = {name: _append_array(file, values) for name, values in arrays.items()}
        text = json.dumps(answer).encode()
        file.write(text + len(text).to_bytes(LENGTH_BYTES, "little"))


def _set_limits(request: dict[str, Any]) -> None:
    """Set the limits that this system has, and end with the parent."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(KILL_ON_DEATH, signal.SIGKILL)
        if os.getppid() != request["parent"]:
            sys.exit(1)  # it had ended before
    try:
        import resource
    except ImportError:  # Windows
        return
    for name, limit in (
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_CPU, int(request["seconds"]) + 1),
        (resource.RLIMIT_AS, request["memory"]),
    ):
        if limit is not None:
            hard = resource.getrlimit(name)[1]
            with contextlib.suppress(ValueError, OSError):  # macOS knows some of them by name only
                resource.setrlimit(name, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))


def _append_array(file: IO[bytes], values: NDArray[Any]) -> dict[str, Any]:
    """Append an array to a file; return its shape, type and position."""
    position = file.seek(0, os.SEEK_END)
    file.write(b"\0" * (-position % ALIGNMENT))
    position += -position % ALIGNMENT
    contiguous = np.ascontiguousarray(values)
    file.write(contiguous.reshape(-1).view(np.uint8).data if contiguous.size else b"")
    return {"shape": contiguous.shape, "dtype": contiguous.dtype.str, "at": position}


def _import_function(reader: str) -> Any:  # noqa: ANN401
    """Import the function that `module:name` refers to."""
    module, _, name = reader.partition(":")
    return getattr(importlib.import_module(module), name)


def _error_message(error: Exception) -> str:
    """Return the last message of a library about a file, on one line, without addresses."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip() and not line.startswith("Reason:")]
    message = re.sub(r"^.*ERROR: |\w+\(0x\w+\): ", "", lines[-1]) if lines else type(error).__name__
    return message[:LONGEST_LINE]
