"""Readers that misbehave, for a child process to run."""

from __future__ import annotations

import os
import signal
import sys
import time
from typing import Any

import numpy as np

from infill.errors import ParameterError

Answer = tuple[dict[str, Any], dict[str, np.ndarray]]


def arrays(cells: int, kind: str) -> Answer:
    values = np.arange(cells, dtype=kind)
    return {"sum": float(values.sum()), "word": "ä"}, {"values": values.reshape(2, -1).T, "none": values[:0]}


def says(line: str) -> Answer:
    print(line)
    print("WARNING: In /build/itkReader.cxx, line 12\nReader (0x5581aa): " + line, file=sys.stderr)
    os.write(2, b"from below\n")
    return {}, {}


def raises(kind: str, text: str) -> Answer:
    raise {"ours": ParameterError, "RuntimeError": RuntimeError, "ValueError": ValueError, "MemoryError": MemoryError}[
        kind
    ](text)


def dies(number: int) -> Answer:
    os.kill(os.getpid(), number)
    time.sleep(60)
    return {}, {}


def leaves(status: int) -> Answer:
    os._exit(status)


def sleeps(file: str) -> Answer:
    with open(file, "w") as note:
        note.write(str(os.getpid()))
    time.sleep(600)
    return {}, {}


def greedy(gib: int) -> Answer:
    held = [np.empty(2**27) for _ in range(gib)]  # a GiB each, of addresses
    return {"held": len(held)}, {}


def loaded() -> Answer:
    return {"modules": sorted(sys.modules)}, {}


def stack_overflow() -> Answer:
    import ctypes

    ctypes.string_at(0)
    signal.pause()
    return {}, {}
