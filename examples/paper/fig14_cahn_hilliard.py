"""Fig. 14: noisy models, smoothed by the modified Allen-Cahn equation and by Choi's modified Cahn-Hilliard equation.

python -m examples.paper.fig14_cahn_hilliard [folder] [--small]
"""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.ndimage import gaussian_filter, label

from benchmarks.peers import cahn_hilliard
from benchmarks.peers.meshers import surface_of
from benchmarks.solids import sphere
from examples.paper import models, plots, shapes
from examples.paper.entry import NOT_GIVEN, Entry, Row, run
from examples.paper.measures import mse
from infill import Smoothing, Surface, smooth
from infill.kernels.threads import thread_count

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STEPS, NOISE, RUNS = 10, 0.2, 3
PAPER_MSE = {"bunny": 0.019, "armadillo": 0.016}
CLOSE_UP = 0.15  # of the side of the grid
VIEWS = {"armadillo": (math.radians(120), math.radians(15))}  # from the front; the others as all pictures


@dataclass(frozen=True, kw_only=True)
class Smoothed:
    """What came out of one method, and what it took."""

    phi: shapes.Field
    surface: Surface
    seconds: float = 0.0

    @property
    def components(self) -> int:
        """Components of solid, which hang together by faces of cells."""
        return label(self.phi > 0)[1]


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth the noisy models for ten steps by both methods."""
    solids = {"sphere": sphere(60).voxels()} if small else {name: models.voxels(name) for name in PAPER_MSE}
    figure, axes = plots.panels(4, len(solids))
    rows: list[Row] = []
    numbers: dict[str, float] = {}
    for (name, clean), line in zip(solids.items(), axes, strict=True):
        f = shapes.noisy(clean, NOISE, np.random.default_rng(0))
        found = {"data": Smoothed(phi=f, surface=surface_of(f))} | both(f)
        draw(line, name, f, clean, found)
        volume = surface_of(clean).volume
        change = {which: one.surface.volume / volume - 1 for which, one in found.items()}
        change["data"] = float((f > 0).sum() / (clean > 0).sum()) - 1  # lone cells have little volume as a surface
        spread = {which: mse(one.phi, f) for which, one in found.items()}
        rows += [
            Row(
                what=f"{name}: MSE, mean (φ − f)²",
                ours=f"{spread['ours']:.4f}",
                paper=f"{PAPER_MSE[name]} (Table 1)" if name in PAPER_MSE else NOT_GIVEN,
                peer=f"Choi {spread['Choi']:.4f}",
            ),
            Row(
                what=f"{name}: volume against the voxels without noise",
                ours=f"{change['ours']:+.2%} (data {change['data']:+.2%})",
                peer=f"Choi {change['Choi']:+.2%}",
            ),
            Row(
                what=f"{name}: components / Euler number of the surface",
                ours=f"{told(found['ours'])} (data {told(found['data'])}, without noise {told_clean(clean)})",
                peer=f"Choi {told(found['Choi'])}",
            ),
            Row(
                what=f"{name}: seconds for {STEPS} steps",
                ours=f"{found['ours'].seconds:.3f}",
                peer=f"Choi {found['Choi'].seconds:.2f}, {found['Choi'].seconds / found['ours'].seconds:.0f} × ours",
            ),
        ]
        for which, one in found.items():
            numbers |= {
                f"{name}, {which}: mse": spread[which],
                f"{name}, {which}: volume": change[which],
                f"{name}, {which}: components": one.components,
                f"{name}, {which}: Euler number": one.surface.euler_number,
                f"{name}, {which}: seconds": one.seconds,
            }
    plots.legend(figure, axes[0, 3])
    plots.save(figure, folder / "fig14.png")
    return Entry(
        name="fig14",
        title="Fig. 14: beside Choi's Cahn-Hilliard smoother",
        setting=(
            f"{' and '.join(solids)} with {NOISE:.0%} noise within 2 cells of the surface, on {len(clean)}³ cells; "
            f"ours λ = 100 at h = 0.01, ε₂, {STEPS} steps, Choi dt = 0.01, λ = 1e4, ε = h, {STEPS} steps; level φ = "
            f"0. Wall time, median of {RUNS} runs in turn, arrays in and out, float32, {thread_count()} threads: "
            "ours compiled, Choi with SciPy's transforms on all threads and NumPy on one. The noise is counted in "
            "cells, the rest are volumes of surfaces."
        ),
        rows=tuple(rows),
        sentence=sentence(tuple(solids), numbers),
        numbers=numbers,
    ).save(folder)


def both(f: shapes.Field) -> dict[str, Smoothed]:
    """Smooth by both methods in turn, after a run that does not count."""
    solid = f > 0
    works: dict[str, Callable[[], Any]] = {
        "ours": lambda: smooth(solid, Smoothing.paper(steps=STEPS), method="sparse"),
        "Choi": lambda: cahn_hilliard.smooth(f, cahn_hilliard.CahnHilliard(steps=STEPS)),
    }
    times: dict[str, list[float]] = {name: [] for name in works}
    fields = {}
    for _ in range(RUNS + 1):
        for name, work in works.items():
            begin = time.perf_counter()
            fields[name] = work()
            times[name].append(time.perf_counter() - begin)
    return {
        name: Smoothed(phi=phi, surface=surface_of(np.clip(phi, -1, 1)), seconds=median(times[name][1:]))
        for name, phi in fields.items()
    }


def told(one: Smoothed) -> str:
    """Return components and Euler number."""
    return f"{one.components} / {one.surface.euler_number}"


def told_clean(clean: shapes.Field) -> str:
    """Return components and Euler number of the voxels without noise."""
    return told(Smoothed(phi=clean, surface=surface_of(clean)))


def draw(line: "Sequence[Axes]", name: str, f: shapes.Field, clean: shapes.Field, found: dict[str, Smoothed]) -> None:
    """Draw the three surfaces, and a slice where the two methods differ most."""
    n, middle = len(f), len(f) // 2
    h, half = 2 / n, round(CLOSE_UP * n / 2)
    titles = (f"{name}, {NOISE:.0%} noise", f"ours, {STEPS} steps", f"Choi, {STEPS} steps")
    surfaces = [one.surface for one in found.values()]
    plots.show_solids(line[:3], surfaces, titles, h=h, view=VIEWS.get(name, plots.VIEW))
    ours, theirs = (found[which].phi[:, middle] for which in ("ours", "Choi"))
    apart = gaussian_filter(((ours > 0) != (theirs > 0)).astype(np.float32), half / 2)
    spot = np.clip(np.unravel_index(np.argmax(apart), apart.shape), half, n - half)
    ax = line[3]
    plots.show_field(ax, f[:, middle], h=h)
    plots.show_cells(ax, clean[:, middle], h=h, label="edge of the voxels without noise")
    plots.show_contour(ax, ours, h=h, label="ours, φ = 0")
    plots.show_contour(ax, theirs, h=h, label="Choi, φ = 0", colour=plots.PEER, style="--")
    plots.named(ax, "close up, slice at y = 0", names=("x", "z"))
    ax.set(
        **{name: ((at - half) * h - 1, (at + half) * h - 1) for name, at in zip(("xlim", "ylim"), spot, strict=True)}
    )


def sentence(names: tuple[str, ...], numbers: dict[str, float]) -> str:
    """Say who does what better, as measured."""

    def both_of(what: str) -> list[tuple[float, float]]:
        return [(numbers[f"{name}, ours: {what}"], numbers[f"{name}, Choi: {what}"]) for name in names]

    def listed(values: list[float], digits: str) -> str:
        return " and ".join(f"{value:{digits}}" for value in values)

    longer = listed([theirs / own for own, theirs in both_of("seconds")], ".0f")
    components = both_of("components")
    single = [all(pair[n] == 1 for pair in components) for n in range(2)]
    clean = {
        (True, True): "Both leave one component",
        (True, False): "Ours leaves one component, Choi's more",
        (False, True): "Choi's leaves one component, ours more",
        (False, False): "Both leave more than one component",
    }[single[0], single[1]]
    volume = both_of("volume")
    less = all(own < theirs for own, theirs in volume)
    nearer = sum(abs(own) < abs(theirs) for own, theirs in volume)
    whose = {0: "Choi's", len(names): "ours"}.get(nearer, "now one, now the other")
    added = [numbers[f"{name}, data: volume"] for name in names]
    told = [listed(list(side), "+.2%") for side in (added, *zip(*volume, strict=True))]
    return (
        f"{clean}; Choi's takes {longer} times as long. The noise adds {told[0]} to the volume; after ours "
        f"{told[1]} are left of it, after Choi's {told[2]}, so {whose} is nearer to the voxels without noise"
        + (", since ours shrinks what is convex." if less else ".")
    )


if __name__ == "__main__":
    run(main)
