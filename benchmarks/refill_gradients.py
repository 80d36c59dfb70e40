"""Whether the infill of real parts follows a field: ``python -m benchmarks.refill_gradients``.

    python -m benchmarks.refill_gradients [--data FOLDER] [--parts bracket_medium] [--patterns honeycomb] [--layers 8]

PrusaSlicer slices parts, and `refill --density 40%:12% --by x` draws their infill. tests/gradient_judge.py, which reads
G-code by itself, measures some layers: the density in boxes of two cells that lie in the infill, two cells from its
border, against the field; pairs of lines that cross; and the least distance between lines, in line widths. The filament
is compared with what the field integrates to over the regions, and the time with a refill of one density, that of the
same filament. Printed is a table in Markdown; where there is no room for a box, it says so.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import shapely

from infill import refill
from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.family import PathSpec
from infill.paths.families.waves import WaveFamily
from tests.gradient_judge import FILAMENT, SparseLayer, crossing_paths, local_densities, read_sparse
from tests.lines import least_spacing
from tests.prints import box, prusa_print

WIDTH = 0.45  # mm
DENSE, SPARSE = 0.4, 0.12
PARTS = ("box", "bracket_medium", "prusa_x-carriage", "voron_a_drive_frame_lower")
PATTERNS = ("honeycomb", "gyroid", "grid")
STEP = 0.5  # mm between points of an integral
SPAN = 4.0  # mm between lines of the slicer's infill that still enclose a region


def regions(layers: list[SparseLayer]) -> dict[float, shapely.Geometry]:
    """Return where the slicer's own infill lies, by height: it is dense enough to show its region."""
    found = {}
    for layer in layers:
        lines = shapely.MultiLineString(layer.paths)
        found[layer.z] = shapely.buffer(shapely.buffer(lines, SPAN / 2), (WIDTH - SPAN) / 2)
    return found


def side_of(pattern: str) -> Callable[[float], float]:
    """Return the side of a box of two cells at a density: cells of waves count as squares of their area."""
    family = FAMILIES[pattern]

    def side(density: float) -> float:
        cell = family.cell_for(density, WIDTH)
        if not isinstance(family, WaveFamily):
            return 2 * cell
        rows = family.rows(PathSpec(cell=cell, line_width=WIDTH, radius=math.inf))
        return 2 * math.sqrt(rows.waves[0].period * rows.pitch)

    return side


def needed(region: shapely.Geometry, wanted: Callable[[np.ndarray], np.ndarray]) -> float:
    """Return the integral of a field over a region, mm²."""
    x0, y0, x1, y1 = region.bounds
    points = np.stack(np.meshgrid(np.arange(x0, x1, STEP), np.arange(y0, y1, STEP)), axis=-1).reshape(-1, 2)
    inside = shapely.contains_xy(region, points[:, 0], points[:, 1])
    return float(wanted(points[inside]).mean() * region.area)


def row(path: Path, pattern: str, number: int, folder: Path) -> tuple[str, ...]:
    """Refill a print, and measure some of its layers."""
    new = folder / "new.gcode"
    graded = refill(path, output=new, pattern=pattern, density=(DENSE, SPARSE), by="x").report
    before, after = read_sparse(path.read_text()), read_sparse(new.read_text())
    points = np.concatenate([line for layer in before for line in layer.paths])
    x0, x1 = points[:, 0].min(), points[:, 0].max()

    def wanted(places: np.ndarray) -> np.ndarray:
        return np.interp(places[:, 0], [x0, x1], [DENSE, SPARSE])

    where = regions(before)
    chosen = [after[k] for k in np.linspace(0, len(after) - 1, number).astype(int)]
    side, errors = side_of(pattern), []
    for layer in chosen:
        inner = shapely.buffer(where[layer.z], -side(DENSE))
        if not inner.is_empty:
            pairs = local_densities([layer], inner, wanted, side)
            errors += list(pairs[:, 1] - pairs[:, 0])
    crossing = sum(map(crossing_paths, after))
    nearest = min(least_spacing(layer.paths, near=4 * WIDTH, most=0.6) for layer in chosen) / WIDTH
    filament = sum(layer.filament for layer in after) * FILAMENT
    need = sum(needed(where[layer.z], wanted) * layer.height for layer in after)
    mean = need / sum(where[layer.z].area * layer.height for layer in after)
    plain = refill(path, pattern=pattern, density=mean, dry_run=True).report
    time = graded["time"]["print_after_s"] / plain["time"]["print_after_s"]
    sections = graded["sections"]
    return (
        f"{sections['replaced']} of {sections['all']}",
        f"{len(errors)}",
        f"{100 * np.mean(errors):+.1f}" if errors else "no room",
        f"{100 * np.abs(errors).max():.1f}" if errors else "no room",
        f"{crossing}",
        f"{nearest:.2f}",
        f"{filament / need - 1:+.1%}",
        f"{time:.2f}",
    )


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--data", default=os.environ.get("INFILL_DATA", "data"), help="the folder of the data")
    asked.add_argument("--parts", default=",".join(PARTS), help="with commas between")
    asked.add_argument("--patterns", default=",".join(PATTERNS), help="with commas between")
    asked.add_argument("--layers", type=int, default=8, help="that are measured of each print")
    options = asked.parse_args()
    print("| part | pattern | sections | boxes | error, points | most | crossing | spacing | filament | time |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for part in options.parts.split(","):
            mesh = box(folder) if part == "box" else Path(options.data) / "printable" / f"{part}.stl"
            settings = {"fill_pattern": "grid", "fill_density": "30%", "gcode_flavor": "marlin2"}
            path = prusa_print(mesh, folder / "print.gcode", settings)
            for pattern in options.patterns.split(","):
                print(
                    "| " + " | ".join((part, pattern, *row(path, pattern, options.layers, folder))) + " |", flush=True
                )
    return 0


if __name__ == "__main__":
    sys.exit(main())
