"""Whether the density of `infill fill` follows a field: ``python -m benchmarks.fill_graded``.

A bar is filled by the command, from 10% at one end of its inside to 40% at the other. The file is read again, and cut
into slabs of two cells across the bar, and into boxes of two cells along each of its sides. What is solid in each is
compared with the mean of the field there. A pattern that does not repeat after a cell along every side, as a honeycomb,
is judged by slabs: a box holds more or less of it by where it lies. Planes of `cubic` do not repeat after a cell even
along the bar, so it is not here.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

import manifold3d
import numpy as np
import trimesh

from benchmarks.pairs import row
from infill import read_mesh
from infill.meshes.solids import to_manifold

# Cells of 8 mm are whole inside: parts of cells beside the walls would be denser or less dense than whole ones.
BAR, WALL, LOW, HIGH = (114.4, 34.4, 34.4), 1.2, 0.1, 0.4  # mm
OFF = 0.02
# Pattern, what grows with the density, the size asked for, and whether it repeats after a cell along every side.
CASES = (
    ("gyroid", "width", "--cell 8", True),
    ("gyroid", "cell", "", False),
    ("schwarz-p", "width", "--cell 8", True),
    ("schwarz-d", "width", "--cell 8", True),
    ("i-wp", "width", "--cell 8", True),
    ("octet", "width", "--cell 16", True),
    ("honeycomb", "width", "--cell 8", False),
    ("grid", "width", "--cell 8", True),
)


def filled(pattern: str, grade: str, size: str, folder: Path) -> tuple[manifold3d.Manifold, dict[str, object]]:
    """Run the command, and return what it wrote and said."""
    part, result = folder / "bar.stl", folder / "filled.stl"
    trimesh.creation.box(BAR).export(part)
    field = ["--density", f"{LOW:.0%}:{HIGH:.0%}", "--by", "x", "--grade", grade]
    words = ["fill", str(part), "--pattern", pattern, *size.split(), *field, "--wall", str(WALL)]
    command = [sys.executable, "-m", "infill", *words, "--json", "-q", "--force", "-o", str(result)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return to_manifold(read_mesh(result)), json.loads(done.stdout)


def parted(length: float, side: float) -> list[tuple[float, float]]:
    """Return the ends of as many pieces of a side as fit into a length about 0."""
    count = max(1, int(length / side))
    ends = (np.arange(count + 1) - count / 2) * side
    return list(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))


def off(solid: manifold3d.Manifold, boxes: list[tuple[tuple[float, float], ...]]) -> float:
    """Return how far the density is from the field's, in the box where that is worst."""
    inside, worst = np.array(BAR) - 2 * WALL, 0.0
    for box in boxes:
        low, high = np.array(box).T
        there = (manifold3d.Manifold.cube(high - low).translate(low) ^ solid).volume() / float(np.prod(high - low))
        asked = LOW + (HIGH - LOW) * ((low[0] + high[0]) / 2 / inside[0] + 0.5)
        worst = max(worst, abs(there - asked))
    return worst


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--patterns", nargs="*")
    given = parser.parse_args()
    bad = 0
    with tempfile.TemporaryDirectory(prefix="fill-graded-") as name:
        for pattern, grade, size, repeats in CASES:
            if given.patterns and pattern not in given.patterns:
                continue
            solid, report = filled(pattern, grade, size, Path(name))
            sizes = report["infill"]
            side = 2 * max(sizes["cells"] or [sizes["cell"]])  # type: ignore[index]
            long, wide, high = np.array(BAR) - 2 * WALL
            slabs = [(x, (-wide / 2, wide / 2), (-high / 2, high / 2)) for x in parted(long, side)]
            boxes = list(product(parted(long, side), parted(wide, side), parted(high, side)))
            slab, box = off(solid, slabs), off(solid, boxes)
            holds = max(slab, box if repeats else 0.0) <= OFF
            figure = f"{100 * slab:.1f} points in {len(slabs)} slabs, {100 * box:.1f} in {len(boxes)} boxes"
            limit = "; ".join([f"{100 * OFF:g} points", *report["problems"]])  # type: ignore[misc]
            row(f"{pattern}, by {grade}, cells of {side / 2:.1f} mm", figure, limit, holds=holds)
            bad += not holds
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
