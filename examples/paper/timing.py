"""Both methods, timed in turn."""

import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from scipy import fft

from benchmarks.peers import cahn_hilliard
from examples.paper import shapes
from infill import Smoothing, smooth
from infill.phasefield.sparse import smooth_bricks

STEPS, ROUNDS = 10, 3
OURS, PEER = Smoothing.paper(steps=STEPS), cahn_hilliard.CahnHilliard(steps=STEPS)
FEW = 4  # steps of the specification that are timed: they cost the same each, and nothing comes before them
PLAIN, DENSE, SPARSE = "ours, NumPy float64, 1 thread", "ours, every cell", "ours, blocks at the surface"
CHOI, CHOI_PLAIN, TRANSFORMS = "Choi", "Choi, float64, 1 thread", "Choi, its two transforms alone"


def methods(f: shapes.Field) -> dict[str, Callable[[], Any]]:
    """Return what is timed, each on data of the type it takes best; the first three in float32 with all threads."""
    solid, double = f > 0, f.astype(np.float64)
    few = Smoothing.paper(steps=FEW)
    return {
        SPARSE: lambda: smooth_bricks(solid, OURS),
        DENSE: lambda: smooth(f, OURS, method="dense"),
        CHOI: lambda: cahn_hilliard.smooth(f, PEER),
        PLAIN: lambda: smooth(double, few, method="numpy"),
        CHOI_PLAIN: lambda: cahn_hilliard.smooth(double, PEER, kind=np.float64, threads=1),
        TRANSFORMS: lambda: transforms(f),
    }


def transforms(f: shapes.Field) -> shapes.Field:
    """Do what steps cannot do without if they work on waves: there and back again."""
    for _ in range(STEPS):
        f = fft.irfftn(fft.rfftn(f, workers=-1), s=f.shape, axes=(0, 1, 2), workers=-1)
    return f


def in_turn(works: Mapping[str, Callable[[], Any]], rounds: int) -> tuple[dict[str, list[float]], dict[str, Any]]:
    """Return the seconds a step of each, round by round, and what it returned.

    They are taken in turn, so that a drift of the machine's speed falls on all; CPU time where there is one thread.
    """
    times: dict[str, list[float]] = {name: [] for name in works}
    results = {}
    for _ in range(rounds):
        for name, work in works.items():
            clock = time.process_time if name in (PLAIN, CHOI_PLAIN) else time.perf_counter
            begin = clock()
            results[name] = work()
            times[name].append((clock() - begin) / (FEW if name == PLAIN else STEPS))
    return times, results


def swing(values: Iterable[float]) -> float:
    """Return the largest over the smallest."""
    found = list(values)
    return max(found) / min(found)
