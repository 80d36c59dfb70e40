"""Threads: no more than are allowed, whatever is done with them, and the same result with any number."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from infill import Smoothing, smooth_mesh, smooth_points, smooth_volume
from infill.kernels.threads import in_threads, thread_count, together
from infill.phasefield.inplace import smooth_inplace
from infill.phasefield.sparse import smooth_bricks
from infill.surface import Surface
from infill.surfaces.distance import distances
from infill.surfaces.levels import at_volume, counted
from infill.surfaces.marching import extract
from infill.surfaces.simplification import simplified
from infill.voxels.from_points import voxelise_points

BALL = ((np.indices((40, 40, 40)) - 19.5) ** 2).sum(axis=0) < 15**2
SPHERE = extract(np.where(BALL, 1.0, -1.0), spacing=(1, 1, 1), origin=(0, 0, 0))
POINTS = np.random.default_rng(1).normal(size=(3000, 3))
POINTS *= 10 / np.linalg.norm(POINTS, axis=1, keepdims=True)


def fields(threads: int) -> Any:
    field = smooth_bricks(BALL, Smoothing(steps=10), threads=threads)
    components, straight, _ = counted(field, spacing=(1, 1, 1), threads=threads)
    return np.append(components.cells, straight.values)


def levels(threads: int) -> Any:
    """Of two components, whose levels are looked for together."""
    two = BALL.copy()
    two[18:22] = False
    field = smooth_bricks(two, Smoothing(steps=10), threads=threads)
    components, straight, guess = counted(field, spacing=(1, 1, 1), threads=threads)
    targets = components.cells.astype(np.float64)
    found = at_volume(straight, components, spacing=(1, 1, 1), targets=targets, guess=guess, threads=threads)
    return np.concatenate([found.levels, found.shells.volume, field.to_dense(threads=threads).ravel()])


WORKS: dict[str, Callable[[int], Any]] = {
    "distances": lambda threads: distances(POINTS + 20, SPHERE, threads=threads),
    "simplified": lambda threads: simplified(SPHERE, tolerance=0.2, threads=threads).vertices,
    "solid of points": lambda threads: voxelise_points(POINTS, voxel=0.8, threads=threads).values,
    "closed": lambda threads: Surface(vertices=SPHERE.vertices, faces=SPHERE.faces).closed,
    "fields": fields,
    "levels": levels,
    "in place": lambda threads: smooth_inplace(np.where(BALL, 1, -1)[20], Smoothing(), threads=threads),
}


@pytest.mark.parametrize("name", WORKS)
def test_one_thread_is_one_thread(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With threads=1 nothing starts another, nor hands work to one that is there."""
    expected = WORKS[name](3)
    monkeypatch.setenv("NUMBA_NUM_THREADS", "3")  # what is taken by what does not know how many are allowed
    own, used = threading.current_thread(), set()

    def refused(self: threading.Thread) -> None:
        used.add(self.name)
        raise AssertionError(f"{self.name} was started")

    monkeypatch.setattr(threading.Thread, "start", refused)
    monkeypatch.setattr("infill.kernels.threads._pool", lambda *_: pytest.fail("a pool was asked for"))
    assert np.array_equal(WORKS[name](1), expected)
    assert threading.current_thread() is own
    assert not used


def test_neighbours_are_looked_for_with_as_many_threads_as_are_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    import scipy.spatial

    said = []

    class Tree(scipy.spatial.cKDTree):
        def query(self, *arguments: Any, **options: Any) -> Any:
            said.append(options.get("workers", 1))
            return super().query(*arguments, **options)

    monkeypatch.setattr(scipy.spatial, "cKDTree", Tree)
    monkeypatch.setattr(scipy.spatial, "KDTree", Tree)
    distances(POINTS, SPHERE, threads=2)
    simplified(SPHERE, tolerance=0.5, threads=2)
    voxelise_points(POINTS, voxel=0.8, threads=2)
    assert max(said) == 2
    said.clear()
    monkeypatch.setenv("NUMBA_NUM_THREADS", "3")
    distances(POINTS, SPHERE)
    assert said == [3]


@pytest.mark.parametrize("threads", [1, 2, 3, 5])
def test_works_within_works_take_no_more_threads(threads: int) -> None:
    """Works share out parts of their own, which share out parts of theirs; all are done, in order, and none waits."""
    lock, busy, most = threading.Lock(), set(), [0]

    def part(what: str, thread: int, of: int) -> str:
        with lock:
            busy.add(threading.get_ident())
            most[0] = max(most[0], len(busy))
        time.sleep(0.002)
        with lock:
            busy.discard(threading.get_ident())
        return f"{what}{thread}"

    def work(what: str) -> list[str]:
        parts = (lambda n=n: in_threads(part, f"{what}{n}", threads=threads) for n in range(3))
        return [each for found in together(*parts, threads=threads) for each in found]

    found = together(lambda: work("a"), lambda: work("b"), lambda: work("c"), threads=threads)
    assert found == [[f"{what}{n}{k}" for n in range(3) for k in range(threads)] for what in "abc"]
    assert most[0] <= threads


@pytest.mark.parametrize("fails", [0, 1, 2])
def test_a_work_that_fails_is_heard(fails: int) -> None:
    def work(number: int) -> int:
        if number == fails:
            raise ZeroDivisionError(number)
        return number

    with pytest.raises(ZeroDivisionError, match=str(fails)):
        together(*(lambda n=n: work(n) for n in range(3)), threads=2)
    assert together(lambda: 1, lambda: 2, threads=2) == [1, 2]  # and the pool goes on


def test_in_place_uses_the_threads_it_is_given(monkeypatch: pytest.MonkeyPatch) -> None:
    names = set()
    real = np.sqrt

    def seen(*arguments: Any, **options: Any) -> Any:
        names.add(threading.current_thread().name)
        time.sleep(0.001)
        return real(*arguments, **options)

    monkeypatch.setattr("infill.phasefield.inplace.BLOCK", 512)
    monkeypatch.setattr("infill.phasefield.inplace.np.sqrt", seen)
    smooth_inplace(np.ones((80, 80)), Smoothing(steps=20), threads=2)
    assert len(names) == 2
    assert thread_count(2) == 2


def test_all_of_smooth_with_one_thread_starts_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Voxels, smoothing, levels, the comparison of before and after, distances and simplifying."""
    two = BALL.copy()
    two[18:22] = False
    fewer: dict[str, Any] = {"threads": 1, "tolerance": 0.2}
    smooth_volume(two, threads=3, refine=True)  # compiled
    monkeypatch.setenv("NUMBA_NUM_THREADS", "3")
    monkeypatch.setattr(threading.Thread, "start", lambda _: pytest.fail("a thread was started"))
    monkeypatch.setattr("infill.kernels.threads._pool", lambda *_: pytest.fail("a pool was asked for"))
    smooth_volume(two, refine=True, despeckle=1.0, **fewer)
    smooth_mesh(SPHERE, voxel=1.0, **fewer)
    smooth_points(POINTS, voxel=0.8, **fewer)
