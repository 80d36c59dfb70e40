"""The speed that `make` promises: ``python -m benchmarks.make``, about a minute.

Every figure is paired with its peer in one run: medians of runs in turn, and of their ratios.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

from benchmarks.pairs import Run, median, paired, process, ratio, row

INFILL = [sys.executable, "-m", "infill.cli"]
BARE_MESH = "import numpy, shapely, typer, trimesh; from skimage.measure import marching_cubes"
BARE_HELP = "import typer, rich.console"
RUNS = 7
GIB = 2**30

# The scheme at 512 x 512 as one would write it down: whole arrays, float64, np.pad for the edge.
NAIVE = """
import sys, time, numpy as np
from infill import Smoothing, smooth
rng = np.random.default_rng(0)
s = Smoothing(steps=100)
f = np.where(smooth(np.sign(rng.uniform(-1, 1, (512, 512))), Smoothing(steps=30, fidelity=0)) > 0, 1.0, -1.0)
E, p, a = s.decay, s.pull, s.alpha
def naive():
    phi = f.copy()
    for _ in range(s.steps):
        q = np.pad(phi, 1, mode="edge")
        phi = phi + a * (q[2:, 1:-1] + q[:-2, 1:-1] + q[1:-1, 2:] + q[1:-1, :-2] - 4 * phi)
        phi = phi / np.sqrt(E + phi**2 * (1 - E))
        phi = (phi + p * f) / (1 + p)
    return phi
work = {"naive": naive, "numpy": lambda: smooth(f, s, method="numpy"), "dense": lambda: smooth(f, s)}[sys.argv[1]]
begin = time.perf_counter()
work()
print(time.perf_counter() - begin)
"""


def python(code: str) -> Run:
    return process([sys.executable, "-c", code])


def smoothing(which: str) -> Run:
    """Time 100 steps at 512 x 512 in a fresh process, imports and data apart."""
    import subprocess

    done = subprocess.run([sys.executable, "-c", NAIVE, which], capture_output=True, text=True, check=True)
    return Run(seconds=float(done.stdout), memory=0)


def main() -> None:
    print(f"Python {sys.version.split()[0]}, {RUNS} runs of each in turn, {time.strftime('%Y-%m-%d')}")
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder) / "out.stl")
        make = [*INFILL, "make", "honeycomb", "-o", out, "--force"]

        ours, bare = paired(lambda: process(make), lambda: python(BARE_MESH), RUNS)
        found = ratio(ours, bare)
        row("infill make honeycomb / bare imports", f"{median(ours):.2f} s, {found:.2f} x", "1.6 x", holds=found <= 1.6)

        ours, bare = paired(lambda: process([*INFILL, "--help"]), lambda: python(BARE_HELP), RUNS)
        found = ratio(ours, bare)
        row(
            "infill --help / import typer, rich.console",
            f"{median(ours):.2f} s, {found:.2f} x",
            "3 x",
            holds=found <= 3,
        )

        ours, plain = paired(lambda: process([*make, "--preview", f"{out}.png"]), lambda: process(make), RUNS)
        seconds = median(ours) - median(plain)
        row("the picture of the four stages on top", f"{seconds:.2f} s", "1 s", holds=seconds < 1)

        bed = [*make, "--size", "250x210"]
        ours, tall = paired(lambda: process([*bed, "--height", "6"]), lambda: process([*bed, "--height", "600"]), 5)
        seconds, memory = max(median(ours), median(tall)), max(run.memory for run in [*ours, *tall]) / GIB
        holds = seconds <= 4 and memory < 1
        row(
            "whole bed, 250 x 210 mm, 2.3 million cells",
            f"{seconds:.2f} s, {memory:.2f} GiB",
            "4 s, 1 GiB",
            holds=holds,
        )
        found = ratio(tall, ours)
        row("the same 600 mm tall / 6 mm tall", f"{found:.2f} x", "1.3 x", holds=found <= 1.3)

    for peer in ("naive", "numpy"):
        slow, fast = paired(lambda peer=peer: smoothing(peer), lambda: smoothing("dense"), RUNS)
        found = ratio(slow, fast)
        name = {"naive": "a naive NumPy form (np.pad)", "numpy": "the specification, method='numpy'"}[peer]
        figure = f"{median(slow) * 10:.2f} / {median(fast) * 10:.2f} ms a step, {found:.1f} x"
        if peer == "naive":
            row(f"2D fast path against {name}", figure, "15 x", holds=found >= 15)
        else:
            row(f"2D fast path against {name}", figure)


if __name__ == "__main__":
    main()
