"""What `infill refill` leaves of every infill pattern of PrusaSlicer and CuraEngine, with the slicer's own paths.

    python -m benchmarks.refill_keep [--density 10,15,20,40] [--size 60] [--only octagram] [--deli PYTHON]

A box is sliced with every pattern, refilled, and judged by tests/gap_judge.py, which reads G-code by itself: the widest
gap to the next bead of every layer before and after, the filament of the infill, and how much of it touches walls.
Printed is a table in Markdown; the command ends with 1 if a pattern lost more than is promised and the report said
nothing of it. `--deli` names a Python that has the package deli-slicer, and adds the patterns of PrusaSlicer 2.9.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from infill import refill
from infill.refilling.support import LEAST_LENGTH
from infill.refilling.widest_gap import MOST_GROWTH
from tests.gap_judge import PIXEL, filament, infill_width, touching_walls, widest_gaps
from tests.prints import box, cura_print, deli_print, prusa_print

PRUSA = [
    "rectilinear",
    "alignedrectilinear",
    "grid",
    "triangles",
    "stars",
    "cubic",
    "line",
    "concentric",
    "honeycomb",
    "3dhoneycomb",
    "gyroid",
    "hilbertcurve",
    "archimedeanchords",
    "octagramspiral",
    "adaptivecubic",
    "supportcubic",
    "lightning",
]
# Directions of lines in a layer: as many times farther apart they are at the same density.
CURA = {
    "grid": 2,
    "lines": 1,
    "triangles": 3,
    "trihexagon": 3,
    "cubic": 3,
    "cubicsubdiv": 3,
    "tetrahedral": 2,
    "quarter_cubic": 2,
    "concentric": 1,
    "zigzag": 1,
    "cross": 1,
    "cross_3d": 1,
    "gyroid": 1,
    "lightning": 1,
}
CUT = 0.03  # mm that chords may add
LEAST_TOUCH = 0.97  # of the length that touches walls
WIDTH = 0.45  # mm of a line


def sliced(engine: str, pattern: str, density: int, part: Path, folder: Path, deli: str = "") -> Path:
    path = folder / f"{engine}_{pattern}_{density}.gcode"
    settings = {"fill_pattern": pattern, "fill_density": f"{density}%"}
    if engine == "prusa":
        return prusa_print(part, path, settings)
    if engine == "deli":
        return deli_print(part, path, settings, python=deli)
    apart = round(WIDTH * 100 / density * CURA[pattern], 3)
    return cura_print(part, path, {"infill_pattern": pattern, "infill_line_distance": apart})


def row(engine: str, pattern: str, density: int, path: Path) -> bool:
    """Print what became of a print, and return whether it is what is promised."""
    output = path.with_suffix(".new.gcode")
    report = refill(path, output=output).report
    old, new = path.read_text(), output.read_text()
    gaps = widest_gaps(old, new)
    before, after = (max((pair[k] for pair in gaps), default=0.0) for k in (0, 1))
    growth = max((late / early - 1 for early, late in gaps), default=0.0)
    kept = filament(new) / filament(old)
    reach = 1.1 * infill_width(old)
    touched = touching_walls(old, reach)
    touch = touching_walls(new, reach) / touched if touched else 1.0  # concentric lines keep away from walls
    time = report["time"]["infill_after_s"] / report["time"]["infill_before_s"]
    wide = any(late > (1 + MOST_GROWTH) * early + CUT + PIXEL for early, late in gaps)
    good = not wide and touch >= LEAST_TOUCH and (kept >= LEAST_LENGTH or bool(report["problems"]))
    cells = (
        engine,
        pattern,
        f"{density} %",
        f"{before:.2f} to {after:.2f} mm",
        f"{growth:+.1%}",
        f"{kept - 1:+.1%}",
        f"{touch - 1:+.1%}",
        f"{time - 1:+.1%}",
        "; ".join(report["problems"]) if good else "BROKEN: " + "; ".join(report["problems"]),
    )
    print("| " + " | ".join(cells) + " |", flush=True)
    return good


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--density", default="10,15,20,40", help="per cent, with commas between")
    asked.add_argument("--size", type=float, default=60.0, help="of the box, mm")
    asked.add_argument("--only", default="", help="patterns with this in their name")
    asked.add_argument("--deli", default="", help="a Python with the package deli-slicer")
    options = asked.parse_args()
    engines = {"prusa": PRUSA, "cura": list(CURA)} | ({"deli": PRUSA} if options.deli else {})
    print("| slicer | pattern | density | widest gap (radius) | most in a layer | filament | walls | time | problems |")
    print("|---|---|---|---|---|---|---|---|---|")
    good = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        part = box(folder, (options.size, options.size, 3.0))
        for density in map(int, options.density.split(",")):
            for engine, patterns in engines.items():
                for pattern in patterns:
                    if options.only in pattern:
                        path = sliced(engine, pattern, density, part, folder, options.deli)
                        good &= row(engine, pattern, density, path)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
