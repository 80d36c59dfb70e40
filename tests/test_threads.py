"""Work in threads: results come in order, few items wait, and errors and interrupts end it."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import pytest

from infill.kernels.threads import in_order


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_results_come_in_the_order_of_the_items(threads: int) -> None:
    def work(item: int) -> int:
        time.sleep(0.002 * (item % 3))  # later ones are often done first
        return item**2

    assert list(in_order(work, range(20), threads=threads)) == [(item, item**2) for item in range(20)]
    assert list(in_order(work, [], threads=threads)) == []


def test_one_thread_works_in_order() -> None:
    done: list[int] = []
    list(in_order(done.append, range(50), threads=1))
    assert done == list(range(50))


def test_items_are_taken_as_they_are_needed() -> None:
    taken: list[int] = []

    def items() -> Iterator[int]:
        for item in range(100):
            taken.append(item)
            yield item

    for place, (item, _) in enumerate(in_order(abs, items(), threads=2)):
        assert item == place
        assert len(taken) <= place + 4  # one for each thread, one that waits, the one that was yielded


def test_an_error_comes_where_the_result_would() -> None:
    begun: list[int] = []

    def work(item: int) -> float:
        begun.append(item)
        return 1 / (item - 3)

    results = in_order(work, range(1000), threads=2)
    assert [item for item, _ in (next(results), next(results), next(results))] == [0, 1, 2]
    with pytest.raises(ZeroDivisionError):
        next(results)
    assert max(begun) < 8  # nobody goes on


def test_leaving_early_leaves_no_threads() -> None:
    before = threading.active_count()
    results = in_order(abs, range(1000), threads=3)
    next(results)
    results.close()
    assert threading.active_count() == before
