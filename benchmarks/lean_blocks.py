"""How much faster a slicer is on the prism than on the isosurface: ``python -m benchmarks.lean_blocks``.

PrusaSlicer slices the default honeycomb both ways, in turn, with each of its two generators of perimeters; seconds are
those of the processor, since slicing is threaded. It takes many minutes: ``--runs 1`` for a first look, ``--size 30``
for a smaller block.
"""

from __future__ import annotations

import argparse
import os
import re
import statistics
import tempfile
from dataclasses import dataclass
from pathlib import Path

from benchmarks.pairs import row
from infill import make
from tests.slicers import PRUSA_SETTINGS, missing_prusa, run_slicer

FASTER = 1.7
SAME = 0.003  # of the filament
# Its own defaults: every point of the mesh is looked at. The tests slice more coarsely, to save time.
DEFAULTS = {"resolution": 0, "gcode_resolution": 0.0125}


@dataclass(frozen=True, kw_only=True)
class Sliced:
    seconds: float  # of the processor
    filament: float  # mm


def sliced(mesh: str, generator: str, folder: Path, settings: dict[str, object]) -> Sliced:
    """Slice a mesh of the folder."""
    ini = {**PRUSA_SETTINGS, **settings, "perimeter_generator": generator}
    (folder / "print.ini").write_text("".join(f"{name} = {value}\n" for name, value in ini.items()))
    before = os.times()
    command = ["prusa-slicer", "--datadir", "data", "--load", "print.ini", "--export-gcode", "-o", "out.gcode", mesh]
    run_slicer(command, folder)
    after = os.times()
    found = re.search(r"^; filament used \[mm\] = ([\d.]+)", (folder / "out.gcode").read_text(), re.MULTILINE)
    assert found is not None
    return Sliced(seconds=after.children_user - before.children_user, filament=float(found[1]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--size", type=float, default=60.0, help="mm")
    given = parser.parse_args()
    if missing_prusa():
        raise SystemExit(missing_prusa())
    with tempfile.TemporaryDirectory(prefix="lean-blocks-") as name:
        folder = Path(name)
        for surface in ("grid", "prism"):
            make("honeycomb", size=given.size, surface=surface).save(folder / f"{surface}.stl")
        for generator in ("classic", "arachne"):
            raw, lean = [], []
            for _ in range(given.runs):
                raw.append(sliced("grid.stl", generator, folder, DEFAULTS))
                lean.append(sliced("prism.stl", generator, folder, DEFAULTS))
            faster = statistics.median(one.seconds / other.seconds for one, other in zip(raw, lean, strict=True))
            seconds = [statistics.median(run.seconds for run in runs) for runs in (raw, lean)]
            change = lean[0].filament / raw[0].filament - 1
            row(
                f"PrusaSlicer, {generator}: isosurface / prism",
                f"{seconds[0]:.1f} / {seconds[1]:.1f} s, {faster:.2f} x",
                f"{FASTER} x",
                holds=faster >= FASTER,
            )
            row(f"the filament of it, {generator}", f"{change:+.2%}", f"{SAME:.1%}", holds=abs(change) <= SAME)


if __name__ == "__main__":
    main()
