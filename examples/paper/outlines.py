"""What Figs. 5 and 6 share: mosaics of a known outline, smoothed, beside peers."""

from collections.abc import Mapping
from pathlib import Path

import shapely
from scipy.ndimage import gaussian_filter

from benchmarks.peers import cahn_hilliard
from examples.paper import plots
from examples.paper.entry import PICTURE_ONLY, Row
from examples.paper.measures import rms_from, turning
from examples.paper.shapes import Field
from infill import Smoothing, smooth

STEPS, LAM = 5, 100
CLOSE = {"horse": (0.4, 0.25), "5": (-0.1, -0.2)}  # lower left corner of the close up


def compare(
    outlines: Mapping[str, tuple[shapely.Geometry, Field]], h: float, path: Path
) -> tuple[tuple[Row, ...], dict[str, float]]:
    """Draw mosaics and their smoothed contours, and measure their distance from the true outline.

    The peers are Choi's smoother with its own numbers (dt = 100 h², λh² = 1, ε = h, ten steps) and a Gaussian.

    Parameters
    ----------
    outlines : name to (outline, mosaic)
        The outline in cells of the mosaic, the first of which spans 0 to 1.
    h : float
        Cell size.
    path : Path
        Of the picture.
    """
    figure, axes = plots.panels(len(outlines), 3)
    rows, numbers = [], {}
    for (name, (outline, f)), column in zip(outlines.items(), axes.T, strict=True):
        phi = smooth(f, Smoothing.paper(lam=LAM, h=h, steps=STEPS), method="numpy")
        titles = (f"{name}: data", f"{name}: {STEPS} steps", "close up")
        plots.show_field(column[0], f, h=h, title=titles[0])
        plots.show_cells(column[0], f, h=h)
        for ax, title in zip(column[1:], titles[1:], strict=True):
            plots.show_smoothed(ax, phi, f, title, h=h)
        plots.show_outline(column[2], outline, h=h, size=f.shape, label="true outline")
        left, bottom = CLOSE.get(name, (-0.75, 0.2))
        column[2].set(xlim=(left, left + 0.5), ylim=(bottom, bottom + 0.5))
        others = {"Choi": cahn_hilliard.smooth(f), "Gaussian σ 1": gaussian_filter(f, 1.0, mode="nearest")}
        true = shapely.boundary(outline)
        near = {"data": rms_from(f, true), "ours": rms_from(phi, true)}
        near |= {peer: rms_from(field, true) for peer, field in others.items()}
        bends = {"data": turning(f), "ours": turning(phi)} | {peer: turning(field) for peer, field in others.items()}
        for what, found, form in (
            (f"{name}: distance from the true outline, rms, cells", near, ".3f"),
            (f"{name}: turning of the contour, full turns", bends, ".1f"),
        ):
            peers = ", ".join(f"{peer} {found[peer]:{form}}" for peer in others)
            ours = f"{found['ours']:{form}} (data {found['data']:{form}})"
            rows.append(Row(what=what, ours=ours, peer=peers, paper=PICTURE_ONLY))
        numbers |= {f"{name} {who}": value for who, value in near.items()}
        numbers |= {f"{name} {who} turns": value for who, value in bends.items()}
    plots.legend(figure, axes[2, 0])
    plots.save(figure, path)
    return tuple(rows), numbers


def told(numbers: Mapping[str, float], names: Mapping[str, object]) -> str:
    """Return the sentence that the numbers allow."""
    found = [[numbers[f"{name} {who}"] for who in ("ours", "Choi", "Gaussian σ 1")] for name in names]
    wins, spread = sum(each[0] == min(each) for each in found), max(max(each) - min(each) for each in found)
    least = min(numbers[f"{name} data turns"] / numbers[f"{name} ours turns"] for name in names)
    farther = [name for name in names if numbers[f"{name} ours"] > numbers[f"{name} data"]]
    return (
        f"The staircase goes: the contours turn at least {least:.1f} times less than those of the data. Of three "
        f"smoothers ours is nearest to the true outline in {wins} of {len(found)}; they differ by at most {spread:.3f} "
        f"cells"
        + (
            f", and rounding corners takes ours farther from it than the data were for {', '.join(farther)}."
            if farther
            else "."
        )
    )
