"""Paper volumes and medical data, smoothed: ``python -m benchmarks.smooth_files [FOLDER]``.

FOLDER is that of the test data (default: $INFILL_DATA, else ../shared/data). The paper's "MSE of volume", Eq. (16), is
missing from its text; three readings are printed: the mean of (phi - f)² over all cells, the same over the
solid ones, and 100 times the mean of |sign phi - f|.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import numpy as np

from infill import Result, Smoothing, Surface, read_mesh, read_volume, smooth, smooth_mesh, smooth_volume

PAPER = {"bunny": "models/bunny_75k.off", "armadillo": "models/armadillo_52k.off", "pig": "models/pig_filled.stl"}
MEDICAL = {
    "skull": "medical/skull_d.stl",
    "mandible": "medical/mandible_repaired_mm.stl",
    "foot bones": "medical/foot_right_bodyparts3d.stl",
    "foot bones (26)": "medical/foot_bones_26.ply",
    "femur": "medical/femur.stl",
}
SIDE = 180  # cells along the longest side: 1.8 of the 2 that 200 cells span
KEPT = 100  # voxels: no larger component may be lost


def readings(result: Result) -> tuple[float, float, float]:
    """Return three readings of the paper's MSE of volume."""
    f = np.where(result.stages.data.values > 0, 1.0, -1.0)
    phi = smooth(f, Smoothing(steps=result.report["request"]["steps"]), method="numpy")
    squared = (phi - f) ** 2
    return float(squared.mean()), float(squared[f > 0].mean()), 100 * float(np.abs(np.sign(phi) - f).mean())


def paper(folder: Path) -> None:
    print("200³, 20 steps      level volume   level 0    mean (phi-f)²  in the solid  100 mean |sign phi - f|")
    for name, path in PAPER.items():
        mesh, change = read_mesh(folder / path), {}
        for level in ("volume", 0.0):
            result = smooth_mesh(
                mesh, resolution=SIDE, smoothing=Smoothing(steps=20), level=level, allow_broken=True, tolerance=None
            )
            change[level] = result.report["volume_change"]
        one, two, three = readings(result)
        print(f"{name:<18} {change['volume']:+12.4%} {change[0.0]:+9.3%} {one:14.4f} {two:13.4f} {three:13.4f}")


def medical(folder: Path) -> None:
    print("\n30 steps                 voxels             components over 100 voxels, kept   volume   closed   problems")
    for name, path in MEDICAL.items():
        mesh = read_mesh(folder / path)
        tell(name, lambda mesh=mesh, **options: smooth_mesh(mesh, resolution=SIDE, tolerance=None, **options))
    head = read_volume(folder / "volumes/ct_head_cranium_int16.npz", array="hu")
    tell("head CT, 226 HU", lambda **options: smooth_volume(head, threshold=226, tolerance=None, **options))
    skull = read_volume(folder / "volumes/seg_skull_label_seg3d.npz", array="label")
    tell("skull, labels", lambda **options: smooth_volume(skull, tolerance=None, **options))


def tell(name: str, work) -> None:
    for refine in (False, True):
        begin = time.perf_counter()
        result = work(smoothing=Smoothing(steps=30 if not refine else 20), allow_broken=True, refine=refine)
        taken = time.perf_counter() - begin
        report, surface = result.report, result.surface
        total, kept = kept_components(result)
        problems = "; ".join(report["problems"]) or "none"
        print(
            f"{name + (', refined' if refine else ''):<26} {' x '.join(map(str, report['grid']['shape'])):<16} "
            f"{kept} of {total}, {report['topology']['data']['components']} in all, {report['volume_change']:+.4%}, "
            f"{'closed' if surface.closed and surface.volume > 0 else 'NOT CLOSED'}, {taken:.1f} s, {problems}"
        )


def kept_components(result: Result) -> tuple[int, int]:
    """Return how many components of the data exceed `KEPT` voxels, and at how many of those there is a surface."""
    from scipy import ndimage
    from scipy.spatial import cKDTree

    data = result.stages.data
    labels, _ = ndimage.label(data.values > 0)
    cells = np.bincount(labels.ravel())[1:]
    large = np.flatnonzero(cells > KEPT) + 1
    tree = cKDTree(_in_cells(result.surface, data))
    kept = 0
    for label, box in enumerate(ndimage.find_objects(labels), start=1):
        if label in large:
            place = np.argwhere(labels[box] == label) + [each.start for each in box]
            kept += bool(tree.query(place, distance_upper_bound=1.5)[0].min() <= 1.5)
    return len(large), kept


def _in_cells(surface: Surface, data) -> np.ndarray:
    """Return the vertices in cells of the grid, the centre of the first being 0."""
    return (surface.vertices - np.array(data.origin)) @ np.asarray(data.direction) / data.cell_size - 0.5


def main() -> None:
    default = os.environ.get("INFILL_DATA", Path(__file__).parents[2] / "shared" / "data")
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else default)
    paper(folder)
    medical(folder)


if __name__ == "__main__":
    main()
