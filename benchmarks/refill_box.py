"""How fast a box prints whose infill is drawn anew in the slicer's own pattern: ``python -m benchmarks.refill_box``.

    python -m benchmarks.refill_box [--size 60,60,20] [--patterns gyroid,honeycomb,hilbert]

PrusaSlicer slices a box with 15 % of each pattern, for Marlin 2 and for a board of 8 bits; `refill --pattern` draws
the infill anew with the same filament. Printed is a table in Markdown, by `infill motion` with the limits of the file:
the turns of the infill over 30 degrees, those of all that is printed, and the time and filament of the print.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from infill import motion, refill
from infill.gcode.dialect import role_of
from infill.gcode.sections import SPARSE
from tests.prints import box, prusa_print

SLICED = {"gyroid": "gyroid", "honeycomb": "honeycomb", "hilbert": "hilbertcurve"}  # as PrusaSlicer calls them
BOARDS = {"Marlin 2": "marlin2", "8 bits": "marlin"}


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--size", default="60,60,20", help="of the box, mm")
    asked.add_argument("--patterns", default=",".join(SLICED), help="with commas between")
    options = asked.parse_args()
    heads = ("pattern", "board", "turns", "of the slicer's", "in the print", "time, s", "of the slicer's", "filament")
    print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        x, y, z = map(float, options.size.split(","))
        part = box(folder, (x, y, z))
        for pattern in options.patterns.split(","):
            for board, flavour in BOARDS.items():
                settings = {"fill_pattern": SLICED[pattern], "gcode_flavor": flavour}
                path = prusa_print(part, folder / "print.gcode", settings)
                refill(path, output=folder / "new.gcode", pattern=pattern)
                old, new = motion(path), motion(folder / "new.gcode")
                everywhere = [sum(feature.turns for feature in plan.features) for plan in (old, new)]
                turns = [
                    sum(feature.turns for feature in plan.features if role_of(feature.name.encode()) == SPARSE)
                    for plan in (old, new)
                ]
                row = (
                    pattern,
                    board,
                    f"{turns[1]}",
                    f"{turns[1] / turns[0]:.3f}",
                    f"{everywhere[1] / everywhere[0]:.3f}",
                    f"{new.seconds:.0f}",
                    f"{new.seconds / old.seconds:.3f}",
                    f"{new.filament / old.filament - 1:+.2%}",
                )
                print("| " + " | ".join(row) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
