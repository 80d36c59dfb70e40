"""The four steps of the paper, one by one.

python examples/01_make.py [folder]
"""

import sys
from pathlib import Path

from shapely import box

from infill import Grid, Smoothing, extrude, save, smooth, stamp
from patterns import Honeycomb


def main(folder: Path) -> float:
    """Write a honeycomb block and return its volume in mm³."""
    cell = 0.15  # mm; three cells make a wall of 0.45 mm
    grid = Grid(shape=(200, 200), spacing=cell, origin=(-15, -15))
    region = box(-14.775, -14.775, 14.775, 14.775)  # half a wall inside the grid

    points = Honeycomb(cell=6).points(region, spacing=cell / 2)
    stamped = stamp(points, grid, block=3)
    smoothed = smooth(stamped, Smoothing(steps=10))
    mesh = extrude(smoothed, 5, cell, origin=(-15, -15, 0))

    save(mesh, folder / "honeycomb.stl")
    return float(mesh.volume)


if __name__ == "__main__":
    print(f"{main(Path(sys.argv[1] if len(sys.argv) > 1 else '.')):.1f} mm³")
