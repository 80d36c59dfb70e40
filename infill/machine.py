"""The resources of this machine: cores and memory."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from pathlib import Path

from infill.errors import MemoryLimitError

GIB = 2**30
LARGEST = 2**100  # bytes that a message names: a grid may be too large for a float


def usable_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def available_memory() -> int | None:
    """Return how many bytes of memory are free, or the total where only that is known; None if neither is."""
    if sys.platform == "win32":
        return _windows_available()
    try:
        found = re.search(r"MemAvailable:\s*(\d+) kB", Path("/proc/meminfo").read_text(encoding="ascii"))
        available = int(found[1]) * 1024 if found else None
    except OSError:  # not Linux: use the total, the best that is available
        available = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return available


def _windows_available() -> int | None:
    class Status(ctypes.Structure):
        _fields_ = (
            ("length", ctypes.c_ulong),
            ("load", ctypes.c_ulong),
            *((name, ctypes.c_ulonglong) for name in ("total", "available", "a", "b", "c", "d", "e")),
        )

    status = Status(length=ctypes.sizeof(Status))
    asked = ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status))  # type: ignore[attr-defined]
    return int(status.available) if asked else None


def require_memory(needed: int, limit: int | None, advice: str) -> None:
    """Raise MemoryLimitError if `needed` bytes exceed `limit`, or the available memory if it is None."""
    allowed = available_memory() if limit is None else limit
    if allowed is not None and needed > allowed:
        needed = min(needed, LARGEST)
        whose = "is at hand" if limit is None else "is allowed"
        raise MemoryLimitError(
            f"this needs about {needed / GIB:.2f} GiB of memory and {allowed / GIB:.2f} GiB {whose}; {advice}"
        )
