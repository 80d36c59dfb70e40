"""Resources of this machine: cores and memory."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from functools import cache
from pathlib import Path

from infill.errors import MemoryLimitError

GIB = 2**30
LARGE_BLOCK = 4 * 2**20  # bytes: smaller ones are allocated too often to be fetched from the system each time
MMAP_THRESHOLD = -3  # glibc's number of this setting
LARGEST_SHOWN = 2**100  # largest number of bytes in a message: a grid may exceed the range of a float


def has_interpreter() -> bool:
    """Tell whether `sys.executable` is a Python to start: a frozen application has none."""
    return bool(sys.executable) and not getattr(sys, "frozen", False)


def usable_cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def available_memory() -> int | None:
    """Return the free memory in bytes, the total if only that is known, or None."""
    if sys.platform == "win32":
        return _windows_available()
    try:
        line = re.search(r"MemAvailable:\s*(\d+) kB", Path("/proc/meminfo").read_text(encoding="ascii"))
        available = int(line[1]) * 1024 if line else None
    except OSError:  # not Linux: use the total, the best that is available
        available = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return available


def _windows_available() -> int | None:
    """Return the free memory in bytes on Windows."""

    class Status(ctypes.Structure):
        _fields_ = (
            ("length", ctypes.c_ulong),
            ("load", ctypes.c_ulong),
            *((name, ctypes.c_ulonglong) for name in ("total", "available", "a", "b", "c", "d", "e")),
        )

    status = Status(length=ctypes.sizeof(Status))
    succeeded = ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status))  # type: ignore[attr-defined]
    return int(status.available) if succeeded else None


@cache
def return_large_blocks() -> None:
    """Have freed blocks of memory of 4 MiB and more returned to the system at once, for the rest of the process.

    Linux's C library keeps freed blocks of up to 32 MiB for later, for each thread apart: half as much memory again as
    is in use. This does nothing on other systems.
    """
    if sys.platform == "linux" and hasattr(library := ctypes.CDLL(None), "mallopt"):
        library.mallopt(MMAP_THRESHOLD, LARGE_BLOCK)


def require_memory(needed: int, limit: int | None, advice: str) -> None:
    """Raise MemoryLimitError if `needed` bytes exceed `limit`, or the available memory if `limit` is None."""
    allowed = available_memory() if limit is None else limit
    if allowed is not None and needed > allowed:
        needed = min(needed, LARGEST_SHOWN)
        origin = "is at hand" if limit is None else "is allowed"
        raise MemoryLimitError(
            f"this needs about {needed / GIB:.2f} GiB of memory and {allowed / GIB:.2f} GiB {origin}; {advice}"
        )
