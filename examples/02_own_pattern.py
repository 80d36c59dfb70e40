"""A pattern of your own: a square grid of lines, with an option for its spacing.

python examples/02_own_pattern.py [folder]

In a package with the entry point squares = "my_package:Squares" in the group infill.patterns, it has a place at
the command line: infill make squares --cell 6 -o squares.3mf. Parameters that are not shared go by --set name=value.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from shapely import MultiLineString, Polygon, linestrings

from infill import make
from patterns import Pattern, cell_parameter
from patterns.linework import add_frame, clip


@dataclass(frozen=True, kw_only=True)
class Squares(Pattern):
    """Lines along x and y."""

    name: ClassVar[str] = "squares"
    summary: ClassVar[str] = "lines along x and y"
    cell: float = cell_parameter(5.0)

    def lines(self, region: Polygon, z: float = 0.0) -> MultiLineString:
        x0, y0, x1, y1 = region.bounds
        across = [[(x, y0), (x, y1)] for x in np.arange(x0 + self.cell, x1 - self.cell / 2, self.cell)]
        along = [[(x0, y), (x1, y)] for y in np.arange(y0 + self.cell, y1 - self.cell / 2, self.cell)]
        return add_frame(clip(linestrings(across + along), region), region)

    def line_spacing(self, region: Polygon) -> float:
        return self.cell


def main(folder: Path) -> int:
    """Write a block and return the number of cells in it."""
    result = make(Squares(cell=6), size=30, height=4, stamp="exact")
    result.save(folder / "squares.3mf")
    return int(result.report["topology"]["result"]["tunnels"])


if __name__ == "__main__":
    print(f"{main(Path(sys.argv[1] if len(sys.argv) > 1 else '.'))} cells")
