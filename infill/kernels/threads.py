"""Sharing work among threads: one pool, one way to share, and never more threads than allowed."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import cache, partial
from typing import Any, TypeVar

from infill.checks import check_whole_number
from infill.machine import usable_cores

Item = TypeVar("Item")
Result = TypeVar("Result")

VARIABLE = "NUMBA_NUM_THREADS"
MAX_THREADS = 256  # threads: more cost more than they gain
WAKE = 0.5  # s


def thread_count(requested: int | None = None) -> int:
    """Return the number of threads to use: as requested, else NUMBA_NUM_THREADS, else one per core.

    >>> thread_count(3)
    3
    """
    if requested is not None:
        return min(check_whole_number("threads", requested, 1), MAX_THREADS)
    setting = os.environ.get(VARIABLE, "")
    return min(int(setting), MAX_THREADS) if setting.isdecimal() and int(setting) > 0 else usable_cores()


def in_threads(kernel: Callable[..., Any], *arguments: Any, threads: int) -> list[Any]:  # noqa: ANN401 - hands on
    """Call `kernel(*arguments, thread, threads)` for each thread and return what they return.

    With n threads, each call of the kernel handles every n-th piece of the work. The kernel must release the GIL, and
    no two calls may write to the same place.
    """
    return run_together(*(partial(kernel, *arguments, thread, threads) for thread in range(threads)), threads=threads)


def run_together(*works: Callable[[], Any], threads: int) -> list[Any]:
    """Run several tasks at once, on this thread and `threads` - 1 others, and return their results in order.

    A task may share out parts of its own: a part that has not begun yet is done by the thread that waits for it. So
    there are never more threads than allowed, however deeply tasks are nested, and all waiting threads make progress.

    >>> run_together(lambda: 1, lambda: 2, threads=2)
    [1, 2]
    """
    if threads == 1 or len(works) < 2:
        return [run_interruptibly(work) for work in works]
    pool = _pool(threads, os.getpid())
    handed = [pool.submit(work) for work in works[1:]]
    try:
        results = [run_interruptibly(works[0])]
        for work, future in zip(works[1:], handed, strict=True):
            results.append(run_interruptibly(work) if future.cancel() else future.result())
    finally:
        for future in handed:  # after a failure or an interrupt, the remaining tasks do not begin
            future.cancel()
    return results


def run_interruptibly(work: Callable[[], Result]) -> Result:
    """Return the result of a task, run on another thread if this is the main one, so that Ctrl-C takes effect at once.

    Python handles a signal on the main thread alone, and not before a compiled loop there has ended. After an
    interrupt, the other thread works on, unless the process ends, and its result is lost.

    >>> run_interruptibly(lambda: 3)
    3
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    future: Future[Result] = Future()
    threading.Thread(target=_fulfil, args=(future, work), name="infill-main", daemon=True).start()
    while not wait([future], timeout=WAKE).done:  # without a timeout, nothing interrupts waiting on Windows
        pass
    return future.result()


def _fulfil(future: Future[Result], work: Callable[[], Result]) -> None:
    """Give a future the result of a task, or its error."""
    try:
        future.set_result(work())
    except BaseException as error:  # noqa: BLE001 - raised where the result is awaited
        future.set_exception(error)


@cache
def _pool(threads: int, process: int) -> ThreadPoolExecutor:  # noqa: ARG001 - a forked process has no threads yet
    """Return the pool of `threads` - 1 workers beside the calling thread, kept for each process."""
    return ThreadPoolExecutor(threads - 1, thread_name_prefix="infill")


def in_order(work: Callable[[Item], Result], items: Iterable[Item], *, threads: int) -> Generator[tuple[Item, Result]]:
    """Yield each item with the result of its work; the next ones are worked on meanwhile.

    Items are taken as they are needed, one more than there are threads, so that memory holds only a few. An error
    of the work is raised where its result would be yielded. With one thread, work is done in order.

    Parameters
    ----------
    work : callable
    items : iterable
        Taken in the thread that asks for the results.
    threads : int, 1 or more

    >>> list(in_order(abs, [-3, 2], threads=2))
    [(-3, 3), (2, 2)]
    """
    waiting: deque[tuple[Item, Future[Result]]] = deque()
    with ThreadPoolExecutor(threads, thread_name_prefix="infill") as pool:
        try:
            for item in items:
                waiting.append((item, pool.submit(work, item)))
                if len(waiting) > threads:
                    next_item, result = waiting.popleft()
                    yield next_item, result.result()
            while waiting:
                next_item, result = waiting.popleft()
                yield next_item, result.result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)
