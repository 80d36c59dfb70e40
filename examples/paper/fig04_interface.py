"""Fig. 4: what epsilon does: it sets how many cells the field takes from void to solid.

python -m examples.paper.fig04_interface [folder] [--small]
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from examples.paper import plots, shapes
from examples.paper.entry import PICTURE_ONLY, Entry, Row, run
from infill import Smoothing, smooth
from infill.phasefield.allen_cahn import STEEPNESS

H, LAM, STEPS, WIDTHS = 0.1, 100, 100, (8, 2, 0.4)


def front(m: float, cells: int) -> NDArray[np.float64]:
    """Return phi across a straight front that has come to rest, without fidelity."""
    f = np.where(np.arange(cells) < cells / 2, 1.0, -1.0)
    return smooth(f, Smoothing(fidelity=0, interface=m, steps=20 * cells), method="numpy")


def width(phi: NDArray[np.float64]) -> float:
    """Return the cells from phi = 0.9 to -0.9 where phi falls, artanh phi being straight between cells; 0 under one."""
    line = np.arctanh(np.clip(phi, -1 + 1e-12, 1 - 1e-12))
    high, low = np.interp([STEEPNESS, -STEEPNESS], line[::-1], np.arange(len(phi))[::-1])
    return 0.0 if low - high < 1 else float(low - high)


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth a disc of 20 x 20 cells with three interfaces, and measure them on a long straight front."""
    n = 12 if small else 20
    f = shapes.disc(n, 0.3 * n)
    figure, axes = plots.panels(len(WIDTHS) + 1)
    fronts = {m: front(m, 40 if small else 100) for m in WIDTHS}
    held = {}
    for ax, m in zip(axes[0], WIDTHS, strict=False):
        phi = smooth(f, Smoothing.paper(lam=LAM, h=H, m=m, steps=STEPS), method="numpy")
        held[m] = width(phi[n // 2 :, n // 2])
        plots.show_smoothed(ax, phi, f, f"m = {m:g}", h=H)
    for m, phi in fronts.items():
        at = np.arange(len(phi)) + 0.5 - len(phi) / 2
        (line,) = axes[0, -1].plot(at, phi, "o", ms=3, label=f"m = {m:g}")
        fine = np.linspace(-15, 15, 600)
        axes[0, -1].plot(fine, -np.tanh(STEEPNESS * fine / m), "-", lw=0.8, color=line.get_color())
    axes[0, -1].axhline(0, color="0.7", lw=0.8)
    axes[0, -1].set(xlabel="x / h", ylabel="φ", xlim=(-15, 15), ylim=(-1.1, 1.1))
    axes[0, -1].set_title("a front at rest, λ = 0, and tanh", fontsize=10)
    axes[0, -1].legend(fontsize=8)
    axes[0, -1].tick_params(labelsize=8)
    plots.legend(figure, axes[0, 0])
    plots.save(figure, folder / "fig04.png")
    widths = {m: width(phi) for m, phi in fronts.items()}
    rows = [
        Row(
            what=f"cells from φ = −0.9 to 0.9, m = {m:g}: alone / held by the data",
            ours=f"{cells(widths[m])} / {cells(held[m])} (2 m = {2 * m:g})",
            paper=PICTURE_ONLY,
        )
        for m in WIDTHS
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
            "m is the number of cells from the surface to φ = 0.9, so an interface is 2 m cells wide where nothing "
            f"else acts; at λh² = {LAM * H**2:g}, as in the pictures, the data narrow it to {cells(held[8])} cells "
            f"for m = 8, and at m = {WIDTHS[-1]:g} it is narrower than a cell, so that the grid holds the contour on "
            "the mosaic."
        ),
        numbers={f"width at m = {m:g}": width for m, width in widths.items()},
    ).save(folder)


def cells(found: float) -> str:
    """Return a width in words."""
    return f"{found:.2f}" if found else "under 1"


if __name__ == "__main__":
    run(main)
