"""A plugin that appends the CPU seconds of every test, its child processes included, to build/cpu_times.txt.

    python -m pytest -q -n 2 -p no:cov -p tests.cpu_times
    python tools/mark_slow_tests.py build/cpu_times.txt

CPU seconds, since those of a clock depend on what else the machine does.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

FILE = Path(__file__).resolve().parents[1] / "build" / "cpu_times.txt"


def cpu_seconds() -> float:
    """Return the CPU seconds of this process and of its children that have ended."""
    return sum(os.times()[:4])


def is_first_case(item: pytest.Item) -> bool:
    """Tell whether an item is the first case of a test with parameters."""
    callspec = getattr(item, "callspec", None)
    return callspec is not None and not any(callspec.indices.values())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    begin = cpu_seconds()
    try:
        return (yield)
    finally:
        FILE.parent.mkdir(exist_ok=True)
        with FILE.open("a", encoding="utf-8") as file:
            file.write(f"{cpu_seconds() - begin:.3f}\t{'first' if is_first_case(item) else 'other'}\t{item.nodeid}\n")
