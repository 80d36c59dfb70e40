"""Time over the number of cells N: O(N), O(N log N), or that of the surface."""

from collections.abc import Mapping
from pathlib import Path
from statistics import median

import numpy as np
from matplotlib.ticker import LogLocator

from benchmarks.solids import sphere
from examples.paper import plots
from examples.paper.timing import CHOI, DENSE, PLAIN, ROUNDS, SPARSE, TRANSFORMS, in_turn, methods, swing

SIZES, FITTED = (32, 48, 64, 96, 128, 160, 200, 256), 96
THEIRS = (CHOI, TRANSFORMS)
FITS = (PLAIN, DENSE, SPARSE, *THEIRS)
LOOKS = {
    PLAIN: (plots.RAW, "-", "o"),
    DENSE: (plots.TRUTH, "-", "s"),
    SPARSE: (plots.SMOOTH, "-", "D"),
    CHOI: (plots.PEER, "-", "^"),
    TRANSFORMS: (plots.PEER, ":", "v"),
}


def growth(n: int, *, small: bool) -> dict[str, float]:
    """Return the median seconds a step on a sphere of n³ cells, by method, after a round that does not count."""
    rounds = 2 if small else max(ROUNDS, min(9, 10**7 // n**3))
    works = methods(sphere(n).voxels())
    times, _ = in_turn({name: works[name] for name in FITS}, rounds + 1)
    return {name: median(taken[1:]) for name, taken in times.items()}


def exponent(curve: Mapping[int, Mapping[str, float]], name: str, sizes: list[int]) -> float:
    """Return p of the time N^p that fits best, by least squares of the logarithms."""
    return float(np.polyfit(np.log([n**3 for n in sizes]), np.log([curve[n][name] for n in sizes]), 1)[0])


def of_curve(curve: Mapping[int, Mapping[str, float]], sizes: list[int], powers: Mapping[str, float]) -> str:
    """Say whether the curve tells O(N) from O(N log N)."""
    first, last = sizes[0], sizes[-1]
    logarithm = np.log(last) / np.log(first) - 1
    a_cell = {name: [curve[n][name] / n**3 for n in sizes] for name in FITS}
    rise = a_cell[TRANSFORMS][-1] / a_cell[TRANSFORMS][0] - 1
    level = swing(a_cell[DENSE]) - 1
    seen = level < logarithm / 2 and logarithm / 2 < rise < 2 * logarithm
    told = "so the logarithm shows" if seen else "so the logarithm does not stand out from what caches do"
    largest = curve[last]
    surface = f"the exponent of N is {powers[SPARSE]:.2f} with the blocks"
    if powers[SPARSE] < 0.8 < min(powers[name] for name in FITS if name != SPARSE):
        surface = f"only the blocks change the power of N, to {powers[SPARSE]:.2f}"
    return (
        f"O(N) against O(N log N): from n = {first} to {last} log N grows by {logarithm:.0%}, the time a cell of "
        f"Choi's transforms changes by {rise:+.0%} and that of our sweep of every cell varies by {level:.0%}, "
        f"{told}. At n = {last} Choi takes {largest[CHOI] / largest[DENSE]:.0f} times as long as the sweep, its "
        f"transforms alone {largest[TRANSFORMS] / largest[DENSE]:.0f} times, and {surface}."
    )


def draw(path: Path, curve: Mapping[int, Mapping[str, float]], fitted: list[int]) -> None:
    """Draw time over N with guides, and time a cell over N."""
    figure, axes = plots.panels(2, width=5.4, height=4.8)
    left, right = axes[0]
    sizes = list(curve)
    cells = np.array(sizes, dtype=np.float64) ** 3
    for name, (colour, style, mark) in LOOKS.items():
        taken = np.array([curve[n][name] for n in sizes])
        for ax, values in ((left, taken * 1e3), (right, taken / cells * 1e9)):
            ax.plot(cells, values, color=colour, ls=style, marker=mark, ms=4, lw=1.4, label=name)
    guides = {
        "∝ N": (DENSE, cells, (0, (6, 3))),
        "∝ N log N": (CHOI, cells * np.log(cells), (0, (2, 2))),
        "∝ N^(2/3)": (SPARSE, cells ** (2 / 3), (0, (1, 1))),
    }
    part = np.array([n in fitted for n in sizes])
    for label, (name, law, style) in guides.items():
        scale = np.exp(
            np.mean([np.log(curve[n][name] / value) for n, value in zip(sizes, law, strict=True) if n in fitted])
        )
        for ax, values in ((left, law * scale * 1e3), (right, law * scale / cells * 1e9)):
            ax.plot(cells[part], values[part], color="0.6", lw=2.5, ls=style, zorder=0, label=label)
    for ax, title, unit in ((left, "time a step", "ms"), (right, "time a cell and step", "ns")):
        ax.set(xscale="log", yscale="log")
        ax.set_title(title, fontsize=10)
        ax.set_xlabel("cells N", fontsize=9)
        ax.set_ylabel(f"time [{unit}]", fontsize=9)
        ax.set_xticks(cells, [f"{n}³" for n in sizes], fontsize=8)
        ax.yaxis.set(major_locator=LogLocator(subs=(1, 3)), major_formatter="{x:g}")
        ax.minorticks_off()
        ax.tick_params(labelsize=8)
        ax.grid(color="0.92")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize=9, frameon=False)
    plots.save(figure, path)
