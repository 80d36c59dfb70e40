"""A pattern of your own in one file: a square grid of lines, with an option for its spacing.

python examples/02_own_pattern.py [folder]

At the command line, the file and the class stand in place of a name:

    infill list 02_own_pattern.py:Squares
    infill make 02_own_pattern.py:Squares --cell 6 -o squares.3mf
    infill fill part.stl --pattern 02_own_pattern.py:Squares -o filled.stl
    infill refill print.gcode --pattern 02_own_pattern.py:Squares -o refilled.gcode

Parameters that are not shared go by --set name=value. In a package with the entry point squares =
"my_package:Squares" in the group infill.patterns, the pattern has a name of its own: infill make squares.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from shapely import MultiLineString, Polygon, linestrings

from infill import make
from patterns import Pattern, cell_parameter, frame_parameter
from patterns.linework import add_frame, clip


@dataclass(frozen=True, kw_only=True)
class Squares(Pattern):
    """Lines along x and y, where these are multiples of the cell: the same in every region, so that layers fit."""

    name: ClassVar[str] = "squares"
    summary: ClassVar[str] = "lines along x and y"
    cell: float = cell_parameter(5.0)
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon, z: float = 0.0) -> MultiLineString:
        x0, y0, x1, y1 = region.bounds
        columns, rows = (np.arange(np.ceil(low / self.cell), high / self.cell) for low, high in ((x0, x1), (y0, y1)))
        lines = [linestrings([(x, y0), (x, y1)]) for x in columns * self.cell]
        lines += [linestrings([(x0, y), (x1, y)]) for y in rows * self.cell]
        return add_frame(clip(lines, region), region) if self.frame else clip(lines, region)

    def line_spacing(self, region: Polygon) -> float:
        return self.cell


def main(folder: Path) -> int:
    """Write a block and return the number of cells in it."""
    result = make(Squares(cell=6), size=36, height=4, stamp="exact")
    result.save(folder / "squares.3mf")
    return int(result.report["topology"]["result"]["tunnels"])


if __name__ == "__main__":
    print(f"{main(Path(sys.argv[1] if len(sys.argv) > 1 else '.'))} cells")
