"""Compiled work shared among threads: a kernel is called once a thread, and takes every n-th piece."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any

from infill.checks import whole
from infill.machine import usable_cores

VARIABLE = "NUMBA_NUM_THREADS"
MOST = 256  # threads: more cost more than they bring


def thread_count(asked: int | None = None) -> int:
    """Return how many threads to work with: as asked, else what NUMBA_NUM_THREADS says, else one a core.

    >>> thread_count(3)
    3
    """
    if asked is not None:
        return min(whole("the number of threads", asked, 1), MOST)
    said = os.environ.get(VARIABLE, "")
    return min(int(said), MOST) if said.isdecimal() and int(said) > 0 else usable_cores()


def in_threads(kernel: Callable[..., Any], *arguments: Any, threads: int) -> list[Any]:  # noqa: ANN401 - hands on
    """Call `kernel(*arguments, thread, threads)` for each thread and return what they return.

    The kernel has to let go of the interpreter, and no two threads may write to the same place.
    """
    if threads == 1:
        return [kernel(*arguments, 0, 1)]
    started = [_pool(threads, os.getpid()).submit(kernel, *arguments, thread, threads) for thread in range(1, threads)]
    first = kernel(*arguments, 0, threads)
    return [first, *(each.result() for each in started)]


def concurrently(*jobs: Callable[[], Any], threads: int | None = None) -> list[Any]:
    """Call different jobs side by side and return what they return, in their order; `threads` as in `thread_count`."""
    count = thread_count(threads)
    if count == 1:
        return [job() for job in jobs]
    with ThreadPoolExecutor(min(count, len(jobs))) as pool:
        return [each.result() for each in [pool.submit(job) for job in jobs]]


@cache
def _pool(threads: int, process: int) -> ThreadPoolExecutor:  # noqa: ARG001 - a forked process has no threads yet
    return ThreadPoolExecutor(threads - 1, thread_name_prefix="infill")
