"""Table 2: a noisy sphere and a bell, beside mesh filters that can be installed.

python -m examples.paper.table2_mesh_filters [folder] [--small]
"""

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.peers.meshers import Field, majority_sinc, relaxed, surface_nets, windowed_sinc
from benchmarks.smooth_quality import measured, ours
from benchmarks.solids import Shape
from examples.paper import plots, shapes
from examples.paper.entry import Entry, Row, run
from examples.paper.fig07_08_solids import in_lengths
from infill.surface import Surface

NOISE = 0.2
PRINTED = ".0043 / .0358 / .0021 (another noisy sphere; other filters .0044 and up, mean .0021 to .0027)"
METHODS: dict[str, Callable[[Field], Surface]] = {
    "data": partial(ours, steps=0, level="0"),
    "ours, 20 steps": partial(ours, steps=20, level="0"),
    "ours, 20 steps, refined": partial(ours, steps=20, level="volume", refine=True),
    "Taubin (trimesh)": partial(relaxed, which="taubin"),
    "Laplace (trimesh)": partial(relaxed, which="laplacian"),
    "Humphrey (trimesh)": partial(relaxed, which="humphrey"),
    "windowed sinc 15/0.001 (VTK's recipe)": partial(windowed_sinc, passes=15, band=0.001),
    "windowed sinc 50/0.02 (VTK)": partial(windowed_sinc, passes=50, band=0.02),
    "majority vote, windowed sinc 100/0.003 (VTK)": partial(majority_sinc, passes=100, band=0.003),
    "surface nets (VTK)": surface_nets,
}
SHOWN = ("data", "ours, 20 steps", "windowed sinc 50/0.02 (VTK)", "Taubin (trimesh)")


@dataclass(frozen=True, kw_only=True)
class Found:
    """A surface, and its distances from the true one in the paper's lengths."""

    surface: Surface
    sigma: float
    largest: float
    mean: float
    normal: float
    volume: float
    pieces: int
    seconds: float

    def __str__(self) -> str:
        """Return a cell of the table."""
        return (
            f"{self.sigma:.4f} / {self.largest:.4f} / {self.mean:.4f} / {self.normal:.1f}° / {self.volume:+.2f} % / "
            f"{self.pieces} / {self.seconds:.1f} s"
        )


def judged(method: Callable[[Field], Surface], f: Field, shape: Shape, h: float) -> Found:
    """Return what a method makes of a field."""
    begin = time.process_time()
    surface = method(f)
    seconds = time.process_time() - begin
    distance = np.abs(shape.foot(surface.vertices.astype(np.float64))[0]) * h
    quality = measured(surface, shape, shape.volume or 1.0, seconds)
    return Found(
        surface=surface, sigma=float(distance.std()), largest=float(distance.max()), mean=float(distance.mean()),
        normal=float(quality.normal), volume=float(quality.volume), pieces=quality.parts, seconds=seconds,
    )  # fmt: skip


def main(folder: Path, *, small: bool = False) -> Entry:
    """Measure the distance of every method from the true surface."""
    n = 40 if small else 200
    h = 2 / n
    solids: dict[str, Shape] = {"sphere": shapes.sphere(n), "bell": shapes.bell(n)}
    if small:
        del solids["bell"]
    cases = {
        f"{name}, {f'{noise:.0%} noise' if noise else 'clean'}": (shape, shape.voxels(noise))
        for name, shape in solids.items()
        for noise in (NOISE, 0.0)
    }
    for work in METHODS.values():  # once before it counts: loading takes longer than some of the work
        with suppress(ModuleNotFoundError):
            work(shapes.sphere(20).voxels())
    figure, axes = plots.panels(len(SHOWN), len(cases))
    rows, numbers, nearest, torn = [], {}, [], set()
    for (case, (shape, f)), line in zip(cases.items(), axes, strict=True):
        found: dict[str, Found] = {}
        for method, work in METHODS.items():
            with suppress(ModuleNotFoundError):
                found[method] = judged(work, f, shape, h)
        for method, each in sorted(found.items(), key=lambda item: item[1].mean):
            own = method.startswith(("ours", "data"))
            rows.append(Row(
                what=f"{case}: {method}", ours=str(each) if own else "–", peer="–" if own else str(each),
                paper=PRINTED if (case, method) == ("sphere, 20% noise", "ours, 20 steps") else "–",
            ))  # fmt: skip
            numbers |= {f"{case}, {method}, {what}": getattr(each, what) for what in ("sigma", "largest", "mean")}
        whole = [method for method, each in found.items() if each.pieces == 1 and method != "data"]
        nearest.append(f"{case}: {min(whole, key=lambda method: found[method].mean)}")
        torn |= {method for method, each in found.items() if each.pieces > 1} - {"data"}
        shown = [method for method in SHOWN if method in found]
        surfaces = [in_lengths(found[method].surface, h) for method in shown]
        plots.show_solids(line[: len(shown)], surfaces, [f"{case}: {shown[0]}", *shown[1:]])
    plots.save(figure, folder / "table2.png")
    loose = (
        f"{', '.join(sorted(torn))} leave loose pieces, since they move vertices and cannot join what noise has torn"
    )
    return Entry(
        name="table2",
        title="Table 2: against mesh filters",
        setting=(
            f"{n}³ cells, h = {h:g}; standard deviation / largest / mean distance from the true surface in the "
            "paper's lengths / mean error of the normals / volume / pieces / CPU seconds. The noisy sphere of the "
            "paper was given to its authors and is not published, nor is its bell: this is a sphere with the noise "
            "of Fig. 9, a bell of our own, and both without noise. Filters of trimesh as they come, surface nets "
            "with 16 iterations, windowed sinc with the numbers given, which but for VTK's recipe were tuned on "
            "such shapes. The nearest in the mean comes first."
        ),
        rows=tuple(rows),
        sentence=(
            f"Nearest in the mean among those that give one piece: {'; '.join(nearest)}. "
            f"{loose if torn else 'None is torn'}. Where noise only adds, as here, our 20 steps at φ = 0 gain by "
            "shrinking; the level of the volume and a vote of the majority keep what it added."
        ),
        numbers=numbers,
    ).save(folder)


if __name__ == "__main__":
    run(main)
