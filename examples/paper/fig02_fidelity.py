"""Fig. 2: what the fidelity lambda does: small, it lets the equation round the mosaic; large, it keeps the mosaic.

python -m examples.paper.fig02_fidelity [folder] [--small]
"""

from pathlib import Path

import numpy as np

from examples.paper import plots, shapes
from examples.paper.entry import PICTURE_ONLY, Entry, Row, run
from examples.paper.measures import area, length
from infill import Smoothing, smooth

H, STEPS, LAMBDAS = 0.1, 100, (10, 100, 1000)


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth a disc of 20 x 20 cells for a hundred steps at three lambdas."""
    n = 12 if small else 20
    radius = 0.3 * n
    f = shapes.disc(n, radius)
    smoothed = {lam: smooth(f, Smoothing.paper(lam=lam, h=H, steps=STEPS), method="numpy") for lam in LAMBDAS}

    end = vanished(f, Smoothing.paper(lam=LAMBDAS[0], h=H, steps=10))
    figure, axes = plots.panels(len(LAMBDAS) + 1)
    for ax, (title, phi) in zip(
        axes[0], {"data f": f, **{f"λ = {lam}": smoothed[lam] for lam in LAMBDAS}}.items(), strict=True
    ):
        plots.show_smoothed(ax, phi, f, title, h=H)
    plots.legend(figure, axes[0, 0])
    plots.save(figure, folder / "fig02.png")

    long = {lam: length(phi) / (2 * np.pi * radius) for lam, phi in smoothed.items()}
    large = {lam: area(phi) / area(f) - 1 for lam, phi in smoothed.items()}
    rows = [Row(what="length of the contour over the circle's, data", ours=f"{length(f) / (2 * np.pi * radius):.4f}")]
    for lam in LAMBDAS:
        rows.append(
            Row(what=f"the same at λ = {lam} (λh² = {lam * H**2:g})", ours=f"{long[lam]:.4f}", paper=PICTURE_ONLY)
        )
        rows.append(Row(what="area, change", ours=f"{large[lam]:+.2%}"))
    rows.append(Row(what=f"steps until the disc is gone at λ = {LAMBDAS[0]}", ours=f"{end or 'never'}"))
    return Entry(
        name="fig02",
        title="Fig. 2: effect of the fidelity λ",
        setting=f"{n} × {n} cells, h = {H}, ε₂, {STEPS} steps, a disc of {radius:g} cells radius.",
        rows=tuple(rows),
        sentence=(
            f"Small λ rounds the disc and takes {-large[10]:.0%} of it away in {STEPS} steps "
            f"({f'all of it after {end}' if end else 'not all of it ever'}), large λ keeps the mosaic, as in the "
            "paper; what decides is λh², so the same λ means something else on another grid."
        ),
        numbers={"gone": end or 0} | {f"length at lambda {lam}": long[lam] for lam in LAMBDAS},
    ).save(folder)


def vanished(f: shapes.Field, smoothing: Smoothing) -> int | None:
    """Return the steps, some at a time, after which no cell is solid, or None if a thousand leave some."""
    phi = f
    for done in range(smoothing.steps, 1000, smoothing.steps):
        phi = smooth(f, smoothing, initial=phi, method="numpy")
        if not (phi > 0).any():
            return done
    return None


if __name__ == "__main__":
    run(main)
