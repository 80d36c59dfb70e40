"""Fig. 6: silhouettes of the bunny, the armadillo and the horse as mosaics, smoothed for five steps.

python -m examples.paper.fig06_silhouettes [folder] [--small]
"""

from pathlib import Path

import shapely

from examples.paper import models
from examples.paper.entry import Entry, run
from examples.paper.measures import contours
from examples.paper.outlines import LAM, STEPS, compare, told

FINE = 512  # pixels of the silhouettes, whose contour is taken as the truth


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth the silhouettes and compare the contours with those of a finer picture."""
    n = 64 if small else 128
    h = 2 / n
    names = {}
    for name in ("bunny", "armadillo", "horse"):
        fine = contours(models.silhouette(name, FINE))
        names[name] = (
            shapely.MultiPolygon([shapely.Polygon(line * n / FINE) for line in fine]),
            models.silhouette(name, n),
        )
    rows, numbers = compare(names, h, folder / "fig06.png")
    return Entry(
        name="fig06",
        title="Fig. 6: silhouettes",
        setting=(
            f"Projections of scanned models at {FINE}² pixels, on {n} × {n} cells, h = {h:g}, λ = {LAM}, ε₂, "
            f"{STEPS} steps; Choi: dt = 100 h², λh² = 1, ε = h, 10 steps. The paper's own pictures are not published."
        ),
        rows=rows,
        sentence=told(numbers, names),
        numbers=numbers,
    ).save(folder)


if __name__ == "__main__":
    run(main)
