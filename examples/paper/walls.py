"""When thin walls die: what is left of a straight wall and of a round pin, by thickness, steps and fidelity.

python -m examples.paper.walls [folder] [--small]
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement, islice
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from examples.paper import plots
from examples.paper.entry import Entry, Row, run
from infill.phasefield.allen_cahn import Smoothing, step

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Field = NDArray[np.float64]

FIDELITIES = {0.01: "0.01 (λ = 100, h = 0.01)", 0.1: "0.1 (λ = 100, h ≈ 1/32)", 1.0: "1 (λ = 100, h = 0.1)"}
STEPS, LONG = 300, 3000  # of the chart, of the rows
PLACES = (0.0, 0.25, 0.5)  # of the middle, in cells from a cell's centre; 0.75 is the mirror image of 0.25
MARGIN = 8  # cells of void on each side
LEVELS = (0.0, 0.5, 0.9, 0.95, 0.99, 2.0)
COLOURS = ("#8c1c13", "#e0532f", "#f6a04d", "#fddc92", "#f4f4ea")
NAMES = ("under 50 %", "50 to 90 %", "90 to 95 %", "95 to 99 %", "99 % or more")
GONE = "#3c3c46"
TICKS = (1, 2, 5, 10, 20, 50, 100, 300)


def bars(thicknesses: Sequence[float], places: Sequence[Sequence[float]]) -> Field:
    """Return walls (one axis) or round pins (two), stamped exactly, f = clip((w/2 - d) / (h/2), -1, 1).

    Parameters
    ----------
    thicknesses : (t,) floats, in cells
    places : (p, axes) floats
        Where the middle lies, in cells from the centre of a cell. Each thickness is taken at each.

    Returns
    -------
    (t, p, n[, n]) float64
    """
    thick, middle = np.asarray(thicknesses, dtype=float), np.asarray(places, dtype=float)
    half = math.ceil(thick.max() / 2) + MARGIN
    x = np.arange(-half, half + 1.0)
    axes = middle.shape[1]
    away = [np.expand_dims(x - middle[:, [a]], tuple(1 + b for b in range(axes) if b != a)) for a in range(axes)]
    distance = np.sqrt(sum(part**2 for part in away))
    return np.clip(thick.reshape(-1, *[1] * distance.ndim) - 2 * distance, -1, 1)


def whole_walls(thicknesses: Sequence[int]) -> Field:
    """Return walls of whole cells, +1 and -1 with the edges on the faces of cells, (t, 1, n)."""
    walls = [bars([thick], [[0.0 if thick % 2 else 0.5]])[0] for thick in thicknesses]
    most = max(wall.shape[1] for wall in walls)
    return np.stack([np.pad(wall, ((0, 0), (0, most - wall.shape[1])), constant_values=-1) for wall in walls])


def states(f: Field, smoothing: Smoothing) -> Iterator[Field]:
    """Yield the field after 1, 2, ... steps; nothing flows along the first two axes, which tell components apart."""
    weights = (0.0, 0.0, *smoothing.weights((1.0,) * (f.ndim - 2)))
    phi = f
    while True:
        phi = step(phi, f, smoothing, weights)
        yield phi


def widths(phi: Field) -> Field:
    """Return how much of the last axis is above 0, in cells, on straight lines between cell centres.

    >>> widths(np.array([-1.0, 1.0, 1.0, 0.0, -1.0])).item()
    2.5
    """
    a, b = phi[..., :-1], phi[..., 1:]
    above, crossed = (a > 0) & (b > 0), (a > 0) != (b > 0)
    share = np.maximum(a, b) / np.where(crossed, np.abs(a) + np.abs(b), 1)
    return (above + np.where(crossed, share, 0)).sum(axis=-1)


def sizes(phi: Field) -> Field:
    """Return the width of walls, (t, p, n), or of pins, (t, p, n, n), the diameter of the disc of equal area."""
    return widths(phi) if phi.ndim == 3 else np.sqrt(4 / math.pi * widths(phi).sum(axis=-1))


def history(f: Field, fidelity: float, steps: int) -> Field:
    """Return the size of each component after 1 to `steps` steps, (t, p, steps)."""
    return np.stack([sizes(phi) for phi in islice(states(f, Smoothing(fidelity=fidelity)), steps)], axis=-1)


def left(f: Field, thicknesses: Field, fidelity: float, steps: int) -> Field:
    """Return what share of its size is left of each component, at its worst place, (t, steps).

    In the data a wall whose edges lie inside cells reads up to a sixth of a cell too thick or too thin, which smoothing
    mends: what is left is of the true size, or of what the data read if that is less.
    """
    size = np.minimum(sizes(f), thicknesses[:, None])[..., None]
    after = history(f, fidelity, steps)
    return np.divide(after, size, out=np.zeros_like(after), where=size > 0).min(axis=1)


def gone(after: Field) -> list[int | None]:
    """Return the first step after which nothing is left, or None, of each row of sizes or shares, (t, steps)."""
    return [int(np.argmax(row == 0)) + 1 if (row == 0).any() else None for row in after]


def chart(ax: Axes, thicknesses: Field, kept: Field, n: int) -> None:
    """Colour thickness and steps by what is kept, bands at every n-th thickness, the end at all."""
    steps = np.arange(1, kept.shape[1] + 1)
    ax.contourf(steps, thicknesses[::n], np.clip(kept[::n], 0, 1.5), levels=LEVELS, colors=COLOURS)
    ax.contour(steps, thicknesses[::n], kept[::n], levels=LEVELS[1:-1], colors="k", linewidths=0.6)
    ends = [end or math.inf for end in gone(kept)]
    ax.fill_betweenx(thicknesses, np.minimum(ends, steps[-1]), steps[-1], color=GONE, lw=0)
    ax.text(0.97, 0.02, "gone", color="w", fontsize=9, ha="right", va="bottom", transform=ax.transAxes)
    ax.set_xscale("log")
    ticks = [tick for tick in TICKS if tick <= steps[-1]]
    ax.set_xticks(ticks, [str(tick) for tick in ticks])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.grid(color="k", alpha=0.25, lw=0.5)
    ax.set_xlim(1, steps[-1])
    ax.tick_params(labelsize=8)
    ax.set_xlabel("steps", fontsize=9)


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth walls and pins of many thicknesses, at several places of the grid, and chart what is left."""
    fine, steps, long = (4, 100, 400) if small else (16, STEPS, LONG)
    walls = np.linspace(1, 8, 7 * fine + 1)
    whole = 1 if small else 4  # what is left of a pin wavers with parts of a cell, when it ends does not
    pins = np.linspace(2, 16, 14 * whole + 1)
    kinds = {
        "thickness of the wall [cells]": (walls, bars(walls, [(place,) for place in PLACES]), 1),
        "diameter of the pin [cells]": (pins, bars(pins, list(combinations_with_replacement(PLACES, 2))), whole),
    }
    figure, axes = plots.panels(len(FIDELITIES), len(kinds), width=3.5, height=3.3)
    for line, (name, (thicknesses, f, every)) in zip(axes, kinds.items(), strict=True):
        for ax, (fidelity, title) in zip(line, FIDELITIES.items(), strict=True):
            chart(ax, thicknesses, left(f, thicknesses, fidelity, steps), every)
            ax.set_title(f"fidelity {title}", fontsize=10)
            ax.set_ylabel(name, fontsize=9)
    figure.legend(
        handles=[
            Patch(facecolor=colour, edgecolor="k", lw=0.5, label=name)
            for colour, name in zip((*COLOURS[::-1], GONE), (*NAMES[::-1], "gone"), strict=True)
        ],
        loc="outside lower center",
        ncols=6,
        fontsize=9,
        title="left of the thickness",
        title_fontsize=9,
    )
    plots.save(figure, folder / "walls.png")

    cells = (1, 2, 3, 4, 5, 6)
    after = {fidelity: history(whole_walls(cells), fidelity, long)[:, 0] for fidelity in FIDELITIES}
    ends = {fidelity: gone(each) for fidelity, each in after.items()}
    rows = [
        Row(
            what=f"steps until a wall of 1, 2, 3, 4, 5, 6 cells is gone, fidelity {fidelity:g}",
            ours=", ".join("never" if end is None else str(end) for end in ends[fidelity]),
        )
        for fidelity in FIDELITIES
    ]
    rows += [
        Row(
            what=f"what is left of a wall of {thick} cells after {n} steps, fidelity 0.01 [cells]",
            ours=f"{after[0.01][thick - 1, n - 1]:.2f}",
        )
        for thick, n in ((3, 10), (3, 20), (4, 30), (5, 30))
    ]
    return Entry(
        name="walls",
        title="When thin walls die",
        setting=(
            f"One wall, or round pin, alone; α = 1/7, m = 2. The chart takes the worst of several places on the grid, "
            f"a quarter of a cell apart; the rows take walls of whole cells along the grid, followed for {long} steps."
        ),
        rows=tuple(rows),
        sentence=(
            f"Along the grid, at fidelity 0.01, a wall of 4 cells keeps {after[0.01][3, 9] / 4:.1%} of its thickness "
            f"for ten steps and one of 5 {after[0.01][4, 29] / 5:.1%} for thirty; one of 3 is gone after "
            f"{ends[0.01][2]}. A pin must be far thicker: its surface is curved."
        ),
        numbers={
            "width of a 3-cell wall after 10 steps": float(after[0.01][2, 9]),
            "width of a 5-cell wall after 100 steps": float(after[0.01][4, 99]),
            "steps after which a 3-cell wall is gone": float(ends[0.01][2] or math.inf),
        },
    ).save(folder)


if __name__ == "__main__":
    run(main)
