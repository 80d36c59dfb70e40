"""What the machine has."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from infill import MemoryLimitError, machine
from infill.ragged import expand_rows


def test_there_is_memory_and_a_core() -> None:
    assert machine.usable_cores() >= 1
    assert machine.available_memory() > 10_000_000


def test_systems_without_affinity(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    assert machine.usable_cores() == os.cpu_count()


@pytest.mark.skipif(not hasattr(os, "sysconf"), reason="no sysconf on this system")
def test_systems_without_proc(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(self: Path, **options: str) -> str:
        raise FileNotFoundError

    monkeypatch.setattr(Path, "read_text", missing)
    assert machine.available_memory() == os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def test_a_system_that_does_not_say_is_trusted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "read_text", lambda self, **options: "nothing of interest")
    assert machine.available_memory() is None
    machine.require_memory(10**18, None, "do less")


def test_limits_are_told_in_gib() -> None:
    machine.require_memory(5, 5, "do less")
    with pytest.raises(MemoryLimitError, match=r"needs about 2\.00 GiB of memory and 1\.00 GiB is allowed; do less"):
        machine.require_memory(2 * 2**30, 2**30, "do less")


FREEING = """
import re, sys, threading
import numpy as np
from infill.machine import return_large_blocks

def resident():
    return int(re.search(r"RssAnon:\\s*([0-9]+) kB", open("/proc/self/status").read())[1]) / 1024

stays = []

def work():
    for _ in range(3):
        np.ones(30 * 2**17)  # 30 MiB: the C library learns from freed blocks what to keep
    blocks = []
    for _ in range(60):
        blocks.append(np.ones(6 * 2**17))
        stays.append(np.ones(500))  # between large blocks: only memory that ends free is given back

if sys.argv[1] == "returned":
    return_large_blocks()
before = resident()
threads = [threading.Thread(target=work) for _ in range(2)]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
print(resident() - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another C library keeps other blocks")
@pytest.mark.parametrize(("way", "least", "most"), [("returned", 0, 10), ("kept", 100, 1000)])
def test_freed_blocks_go_back_to_the_system(way: str, least: float, most: float) -> None:
    """Of 720 MiB in blocks of 6 MiB, freed by threads that ended, nothing is left; by itself, the C library keeps some."""
    command = [sys.executable, "-c", FREEING, way]
    left = float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert least <= left < most, "MiB"


@pytest.mark.parametrize("most", [None, 1, 3, 100])
def test_rows_are_laid_end_to_end(most: int | None) -> None:
    counts = np.array([0, 2, 0, 5, 1, 0])
    parts = list(expand_rows(counts, most))
    row = np.concatenate([part[0] for part in parts])
    place = np.concatenate([part[1] for part in parts])
    assert row.tolist() == [1, 1, 3, 3, 3, 3, 3, 4]
    assert place.tolist() == [0, 1, 0, 1, 2, 3, 4, 0]
    assert list(expand_rows(np.zeros(0, dtype=int))) == []
