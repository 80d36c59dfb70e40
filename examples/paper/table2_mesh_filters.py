"""Table 2: a noisy sphere and a bell, beside mesh filters that can be installed.

python -m examples.paper.table2_mesh_filters [folder] [--small]
"""

import math
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

from benchmarks.peers.meshers import Field, majority_sinc, relaxed, surface_nets, windowed_sinc
from benchmarks.smooth_quality import Quality, measured, ours
from benchmarks.solids import Shape, sphere
from examples.paper import plots, shapes
from examples.paper.entry import NOT_GIVEN, Entry, Row, run
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


def judged(method: Callable[[Field], Surface], f: Field, shape: Shape) -> tuple[Surface, Quality]:
    """Return what a method makes of a field, and how good it is."""
    begin = time.process_time()
    surface = method(f)
    seconds = time.process_time() - begin
    return surface, measured(surface, shape, shape.volume, seconds)


def lengths(q: Quality, h: float) -> dict[str, float]:
    """Return standard deviation, largest and mean of the distance in the paper's lengths."""
    return {"sigma": math.sqrt(q.rms**2 - q.mean**2) * h, "largest": q.largest * h, "mean": q.mean * h}


def told(q: Quality, h: float) -> str:
    """Return a cell of the table."""
    distances = " / ".join(f"{length:.4f}" for length in lengths(q, h).values())
    return f"{distances} / {q.normal:.1f}° / {q.volume:+.2f} % / {q.parts} / {q.seconds:.1f} s"


def main(folder: Path, *, small: bool = False) -> Entry:
    """Measure the distance of every method from the true surface."""
    n = 40 if small else 200
    h = 2 / n
    solids: dict[str, Shape] = {"sphere": sphere(n), "bell": shapes.bell(n)}
    if small:
        del solids["bell"]
    cases = {
        f"{name}, {f'{noise:.0%} noise' if noise else 'clean'}": (shape, shape.voxels(noise))
        for name, shape in solids.items()
        for noise in (NOISE, 0.0)
    }
    for work in METHODS.values():  # once before it counts: loading takes longer than some of the work
        with suppress(ModuleNotFoundError):
            work(sphere(20).voxels())
    figure, axes = plots.panels(len(SHOWN), len(cases))
    rows, numbers, nearest, torn = [], {}, [], set()
    for (case, (shape, f)), line in zip(cases.items(), axes, strict=True):
        found: dict[str, tuple[Surface, Quality]] = {}
        for method, work in METHODS.items():
            with suppress(ModuleNotFoundError):
                found[method] = judged(work, f, shape)
        for method, (_, q) in sorted(found.items(), key=lambda item: item[1][1].mean):
            ours_or_theirs = {"ours" if method.startswith(("ours", "data")) else "peer": told(q, h)}
            printed = PRINTED if (case, method) == ("sphere, 20% noise", "ours, 20 steps") else NOT_GIVEN
            rows.append(Row(what=f"{case}: {method}", paper=printed, **{"ours": NOT_GIVEN, **ours_or_theirs}))
            numbers |= {f"{case}, {method}, {what}": length for what, length in lengths(q, h).items()}
        whole = [method for method, (_, q) in found.items() if q.parts == 1 and method != "data"]
        nearest.append(f"{case}: {min(whole, key=lambda method: found[method][1].mean)}")
        torn |= {method for method, (_, q) in found.items() if q.parts > 1} - {"data"}
        shown = [method for method in SHOWN if method in found]
        surfaces = [found[method][0] for method in shown]
        plots.show_solids(line[: len(shown)], surfaces, [f"{case}: {shown[0]}", *shown[1:]], h=h)
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
