"""Fig. 4: what epsilon does: it sets how many cells the field takes from void to solid.

python -m examples.paper.fig04_interface [folder] [--small]
"""

from pathlib import Path

import numpy as np

from examples.paper import plots, shapes
from examples.paper.entry import Entry, Row, run
from infill import Smoothing, smooth

H, LAM, STEPS, WIDTHS = 0.1, 100, 100, (8, 2, 0.4)


def front(m: float, cells: int) -> float:
    """Return the cells from phi = -0.9 to 0.9 across a straight front that has come to rest, without fidelity."""
    f = np.where(np.arange(cells) < cells / 2, 1.0, -1.0)
    phi = smooth(f, Smoothing(fidelity=0, interface=m, steps=20 * cells), method="numpy")
    high, low = np.interp([0.9, -0.9], phi[::-1], np.arange(cells)[::-1])
    return float(low - high)


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth a disc of 20 x 20 cells with three interfaces, and measure them on a long straight front."""
    n = 12 if small else 20
    f = shapes.disc(n, 0.3 * n)
    figure, axes = plots.panels(len(WIDTHS) + 1)
    at = np.arange(n) * H + H / 2 - n * H / 2
    for ax, m in zip(axes[0], WIDTHS, strict=False):
        phi = smooth(f, Smoothing.paper(lam=LAM, h=H, m=m, steps=STEPS), method="numpy")
        plots.show_field(ax, phi, h=H, title=f"m = {m:g}")
        plots.show_cells(ax, f, h=H, label="edge of the data")
        plots.show_contour(ax, phi, h=H, label="φ = 0")
        axes[0, -1].plot(at, phi[:, n // 2], "o-", ms=3, lw=1, label=f"m = {m:g}")
    axes[0, -1].axhline(0, color="0.7", lw=0.8)
    axes[0, -1].set(xlabel="x", ylabel="φ", title="φ along the middle row", ylim=(-1.1, 1.1))
    axes[0, -1].legend(fontsize=8)
    axes[0, -1].title.set_size(10)
    axes[0, -1].tick_params(labelsize=8)
    plots.legend(figure, axes[0, 0])
    plots.save(figure, folder / "fig04.png")
    widths = {m: front(m, 40 if small else 100) for m in WIDTHS}
    rows = [
        Row(what=f"cells from φ = −0.9 to 0.9, m = {m:g}", ours=f"{width:.2f} (2 m = {2 * m:g})")
        for m, width in widths.items()
    ]
    return Entry(
        name="fig04",
        title="Fig. 4: effect of the interface width ε",
        setting=(
            f"{n} × {n} cells, h = {H}, λ = {LAM}, {STEPS} steps; widths on a straight front at rest, λ = 0. "
            "ε_m = m h/(√2 artanh 0.9)."
        ),
        rows=tuple(rows),
        sentence=(
            "m is the number of cells from the surface to φ = 0.9, so the interface is 2 m cells wide; "
            f"at m = {WIDTHS[-1]:g} it is narrower than a cell, and the grid holds the contour on the mosaic."
        ),
        numbers={f"width at m = {m:g}": width for m, width in widths.items()},
    ).save(folder)


if __name__ == "__main__":
    run(main)
