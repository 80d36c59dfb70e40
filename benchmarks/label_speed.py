"""Every label in one run: ``python -m benchmarks.label_speed [--size 256] [--refine]``.

Forty blobs on 256³ cells, each with a label of its own, in one run of `smooth_labels` and each alone in the whole
volume, as ``--label N`` does it. Two volumes: five large blobs among many small ones, as organs or the bones of a foot
are, and a geometric series of radii. The promise: in the first, all forty take less than twice the slowest five alone.
In the second nothing is promised: the surface of all forty is itself more than twice that of the largest five.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from numpy.typing import NDArray

from benchmarks.pairs import row
from infill import Surface, smooth_labels, smooth_volume

LABELS, SLOWEST = 40, 5
RADII = {  # cells of 256
    "five large ones among small ones": np.concatenate([np.linspace(46, 38, 5), np.geomspace(15, 4, 35)]),
    "radii in a geometric series": np.geomspace(46, 4, LABELS),
}


def blobs(size: int, radii: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return balls with bumps, each with a label, none over another."""
    values = np.zeros((size,) * 3, dtype=np.uint8)
    placed: list[tuple[NDArray[np.float64], float]] = []
    for label, radius in enumerate(radii * size / 256, start=1):
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


def alone(values: NDArray[np.uint8], label: int, *, refine: bool) -> tuple[float, Surface]:
    """Return the seconds that a label takes by itself, in the whole volume, and its surface."""
    begin = time.perf_counter()
    found = smooth_volume(values, label=label, refine=refine, allow_broken=True, tolerance=None)
    return time.perf_counter() - begin, found.surface


def compare(name: str, values: NDArray[np.uint8], runs: int, *, refine: bool) -> None:
    """Print the table of one volume."""
    print(f"\n{name}: {values.shape[0]}³ cells{', refined' if refine else ''}, best of {runs} runs")
    every, apart, off = [], [], 0.0
    for _ in range(runs):
        begin = time.perf_counter()
        found = smooth_labels(values, refine=refine, allow_broken=True, tolerance=None)
        every.append(time.perf_counter() - begin)
        each = [alone(values, label + 1, refine=refine) for label in range(LABELS)]
        apart.append(sorted(seconds for seconds, _ in each))
        for (_, whole), surface in zip(each, found.surfaces.values(), strict=True):
            off = max(off, float(np.abs(whole.vertices - surface.vertices).max()))
    areas = np.array([surface.area for surface in found.surfaces.values()])
    slowest = min(sum(seconds[-SLOWEST:]) for seconds in apart)
    share, least = min(every) / slowest, areas.sum() / np.sort(areas)[-SLOWEST:].sum()
    row(f"all {LABELS} labels in one run", f"{min(every):.2f} s")
    row(f"all {LABELS}, each alone in the whole volume", f"{min(map(sum, apart)):.2f} s")
    row(f"the slowest {SLOWEST} of those", f"{slowest:.2f} s")
    promised = least < 2
    row(
        "    the first over the last",
        f"{share:.2f} x",
        "2 x" if promised else "",
        holds=share < 2 if promised else None,
    )
    row("    the same of their areas", f"{least:.2f} x")
    row("    largest distance between the two surfaces", f"{off:.1g} cells", "1e-3", holds=off < 1e-3)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--refine", action="store_true")
    options = parser.parse_args()
    for name, radii in RADII.items():
        values = blobs(options.size, radii, np.random.default_rng(1))
        smooth_volume(values, label=LABELS, refine=options.refine, allow_broken=True, tolerance=None)  # compiles
        compare(name, values, options.runs, refine=options.refine)


if __name__ == "__main__":
    main()
