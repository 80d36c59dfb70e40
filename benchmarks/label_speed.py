"""Every label in one run: ``python -m benchmarks.label_speed [--size 256] [--refine]``.

Forty blobs of different sizes on 256³ cells, each with a label of its own. The promise: all forty take less than twice
the slowest five of them, each smoothed alone in the whole volume as ``--label N`` does. And the surfaces are the same.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from numpy.typing import NDArray

from benchmarks.pairs import row
from infill import smooth_labels, smooth_volume

LABELS, SLOWEST = 40, 5
SMALLEST, LARGEST = 5, 36  # radii, cells of 256


def blobs(size: int, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return balls with bumps, as many as there are labels, their radii spread evenly, none over another."""
    values = np.zeros((size,) * 3, dtype=np.uint8)
    placed: list[tuple[NDArray[np.float64], float]] = []
    for label, radius in enumerate(np.linspace(LARGEST, SMALLEST, LABELS) * size / 256, start=1):
        outer = 1.3 * radius
        for _ in range(100_000):
            at = rng.uniform(outer + 1, size - outer - 1, 3)
            if all(np.linalg.norm(at - other) > outer + reach + 2 for other, reach in placed):
                break
        else:
            raise RuntimeError("the blobs do not fit; take fewer")
        placed.append((at, outer))
        low, high = np.floor(at - outer).astype(int), np.ceil(at + outer).astype(int)
        box = tuple(slice(a, b) for a, b in zip(low, high, strict=True))
        away = np.indices(high - low) + (low - at).reshape(3, 1, 1, 1)
        far = np.sqrt((away**2).sum(axis=0))
        bumps = np.sin(away * rng.uniform(2, 5) / radius + rng.uniform(0, 6, (3, 1, 1, 1))).sum(axis=0)
        values[box][far < radius * (1 + 0.08 * bumps)] = label
    return values


def alone(values: NDArray[np.uint8], label: int, *, refine: bool) -> float:
    """Return the seconds that a label takes by itself, in the whole volume."""
    begin = time.perf_counter()
    smooth_volume(values, label=label, refine=refine, allow_broken=True)
    return time.perf_counter() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--refine", action="store_true")
    options = parser.parse_args()
    values = blobs(options.size, np.random.default_rng(1))
    print(f"{options.size}³, {LABELS} labels{', refined' if options.refine else ''}, best of {options.runs} runs")
    smooth_volume(values, label=LABELS, refine=options.refine, allow_broken=True)  # compiles
    every, slowest, largest = [], [], []
    for _ in range(options.runs):
        begin = time.perf_counter()
        smooth_labels(values, refine=options.refine, allow_broken=True)
        every.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        smooth_labels(values, label=tuple(range(1, SLOWEST + 1)), refine=options.refine, allow_broken=True)
        largest.append(time.perf_counter() - begin)
        slowest.append(sum(sorted(alone(values, n + 1, refine=options.refine) for n in range(LABELS))[-SLOWEST:]))
    row(f"all {LABELS} labels", f"{min(every):.2f} s")
    row(f"the slowest {SLOWEST}, each alone in the whole volume", f"{min(slowest):.2f} s")
    share = min(every) / min(slowest)
    row("    the first over the second", f"{share:.2f} x", "2 x", holds=share < 2)
    row(f"the largest {SLOWEST} in one run", f"{min(largest):.2f} s, {min(every) / min(largest):.2f} x")


if __name__ == "__main__":
    main()
