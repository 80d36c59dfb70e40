"""Timing in pairs: A B A B …, so that a drift of the machine's speed falls on both."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Run:
    seconds: float
    memory: int  # bytes, the peak of the process
    cpu: float = 0.0  # seconds of all its threads, which other processes disturb less


def process(command: Sequence[str]) -> Run:
    """Run a command as a fresh process and return its wall time and peak memory."""
    import time

    with tempfile.TemporaryFile() as output:
        begin = time.perf_counter()
        child = subprocess.Popen(command, stdout=output, stderr=output)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - begin
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            output.seek(0)
            raise RuntimeError(f"{command} ended with {child.returncode}: {output.read().decode()}")
    unit = 1 if sys.platform == "darwin" else 1024
    return Run(seconds=seconds, memory=usage.ru_maxrss * unit, cpu=usage.ru_utime + usage.ru_stime)


def paired(one: Callable[[], Run], other: Callable[[], Run], runs: int) -> tuple[list[Run], list[Run]]:
    """Return `runs` of each, taken in turn, after one of each that does not count."""
    one(), other()
    ours, theirs = [], []
    for _ in range(runs):
        ours.append(one())
        theirs.append(other())
    return ours, theirs


def median(runs: Sequence[Run]) -> float:
    return statistics.median(run.seconds for run in runs)


def ratio(ours: Sequence[Run], theirs: Sequence[Run]) -> float:
    """Return the median of the ratios, pair by pair."""
    return statistics.median(a.seconds / b.seconds for a, b in zip(ours, theirs, strict=True))


def row(name: str, figure: str, limit: str = "", *, holds: bool | None = None) -> None:
    """Print one line of the table; a figure without a limit is told and not judged."""
    verdict = {True: "ok", False: "NO", None: ""}[holds]
    print(f"{verdict:<3} {name:<58} {figure:<34} {'limit ' + limit if limit else ''}".rstrip(), flush=True)
