"""Run the smoothing of labels: small ones at the same time, each on one thread, and large ones by all threads."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Sequence
from contextvars import copy_context
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Generic, TypeVar

from infill.errors import InfillError
from infill.kernels.threads import run_together, thread_count
from infill.machine import available_memory

if TYPE_CHECKING:
    from infill.result import Progress

Outcome = TypeVar("Outcome")


@dataclass(frozen=True, kw_only=True)
class LabelWork:
    """What is known of the work for a label before it begins.

    Parameters
    ----------
    cells : int
        Cells at its surface, about: work and memory grow with them.
    memory : int, bytes
    """

    cells: int
    memory: int


@dataclass(kw_only=True, eq=False)
class _Shares:
    """The progress of labels that are smoothed at the same time, reported by the thread that began.

    A listener need not be safe for threads: what other threads have done shows in its next call.
    """

    progress: Progress | None
    sizes: Sequence[int]
    done: list[float] = field(init=False)
    caller: int = field(init=False)

    def __post_init__(self) -> None:
        self.done, self.caller = [0.0] * len(self.sizes), threading.get_ident()

    def listener(self, number: int) -> Progress | None:
        """Return the listener of one label."""
        return None if self.progress is None else partial(self._tell, number)

    def finish(self, number: int) -> None:
        """Note that a label is done."""
        if self.progress is not None:
            self._tell(number, "smooth", 1.0)

    def _tell(self, number: int, stage: str, share: float) -> None:
        """Note the progress of a label, and report that of all."""
        self.done[number] = max(self.done[number], share)
        if self.progress is not None and threading.get_ident() == self.caller:
            whole = sum(size * part for size, part in zip(self.sizes, self.done, strict=True))
            self.progress(stage, whole / sum(self.sizes))


def run_labels(
    smooth: Callable[[int, int, Progress | None], Outcome | InfillError],
    works: Sequence[LabelWork],
    *,
    stop_early: bool,
    threads: int | None,
    max_memory: int | None,
    progress: Progress | None,
) -> list[Outcome | InfillError | None]:
    """Smooth all labels; return the outcome of each, in order.

    Parameters
    ----------
    smooth : callable
        Smooths the label of a number with a number of threads, and returns the outcome, or the error.
    works : sequence of LabelWork
    stop_early : bool
        Whether an error ends the work: labels after the first that failed may then be None, but none before it.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    max_memory : int, optional
        Bytes that labels smoothed at the same time may take; by default, what is available.
    progress : callable, optional

    Notes
    -----
    A surface does not depend on the number of threads, so that it does not matter which labels meet.
    """
    count = thread_count(threads)
    shares = _Shares(progress=progress, sizes=[work.cells for work in works])
    order = deque(sorted(range(len(works)), key=lambda n: -works[n].cells))
    queue = _LabelQueue(smooth=smooth, waiting=order, shares=shares, stop=stop_early)
    allowed = available_memory() if max_memory is None else max_memory
    alone = count_alone(sorted(works, key=lambda work: -work.cells), count, allowed)
    for _ in range(alone):
        queue.take(count, largest=True)
    # Half of the threads begin with the smallest labels: the largest ones together would take the most memory.
    run_together(
        *(partial(copy_context().run, queue.take_all, largest=thread % 2 == 0) for thread in range(count)),
        threads=count,
    )
    if progress is not None and works:
        progress("smooth", 1.0)
    return queue.outcomes


def count_alone(works: Sequence[LabelWork], threads: int, allowed: int | None) -> int:
    """Return how many labels, the largest first, have to be smoothed one after the other, by all threads each.

    Those larger than the share of one thread in what remains would keep the others waiting at the end. And labels
    that do not fit into memory together follow each other.
    """
    if threads == 1:
        return 0
    remaining, alone = sum(work.cells for work in works), 0
    for number, work in enumerate(works):
        remaining -= work.cells
        fits = allowed is None or sum(other.memory for other in works[number : number + threads]) <= allowed
        if work.cells * (threads - 1) <= remaining and fits:
            break
        alone = number + 1
    return alone


@dataclass(kw_only=True, eq=False)
class _LabelQueue(Generic[Outcome]):
    """The labels that wait, of which each thread takes the next one, and the outcomes."""

    smooth: Callable[[int, int, Progress | None], Outcome | InfillError]
    waiting: deque[int]
    shares: _Shares
    stop: bool
    outcomes: list[Outcome | InfillError | None] = field(init=False)
    lock: threading.Lock = field(default_factory=threading.Lock)
    last: int = field(init=False)

    def __post_init__(self) -> None:
        self.outcomes, self.last = [None] * len(self.waiting), len(self.waiting)

    def take(self, threads: int, *, largest: bool) -> bool:
        """Smooth the largest label that waits, or the smallest; return False if none waits."""
        with self.lock:
            number = len(self.outcomes)
            while self.waiting and number >= self.last:  # those after an error need not be smoothed
                number = self.waiting.popleft() if largest else self.waiting.pop()
            if number >= self.last:
                return False
        outcome = self.smooth(number, threads, self.shares.listener(number))
        self.outcomes[number] = outcome
        self.shares.finish(number)
        if self.stop and isinstance(outcome, InfillError):
            with self.lock:
                self.last = min(self.last, number)
        return True

    def take_all(self, *, largest: bool) -> None:
        """Smooth labels on one thread until none waits."""
        try:
            while self.take(1, largest=largest):
                pass
        finally:  # after a failure, the other threads end with the label that they are at; else none waits
            with self.lock:
                self.waiting.clear()
