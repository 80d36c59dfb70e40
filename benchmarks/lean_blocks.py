"""How much faster a slicer is on the prism than on the isosurface: ``python -m benchmarks.lean_blocks``.

PrusaSlicer slices the default honeycomb both ways, in turn, with each of its two generators of perimeters; seconds are
those of the processor, since slicing is threaded. It takes many minutes: ``--runs 1`` for a first look, ``--size 30``
for a smaller block. With ``--turns``, both are also sliced turned by a quarter and by half a turn: how much the
filament of one and the same block changes then is what a difference between two blocks is to be seen against.
"""

from __future__ import annotations

import argparse
import math
import os
import re
import statistics
import tempfile
from dataclasses import dataclass
from pathlib import Path

import trimesh

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


def turned(folder: Path, mesh: str, degrees: int) -> str:
    """Write a mesh of the folder turned about z, and return the name of the file."""
    block = trimesh.load_mesh(folder / f"{mesh}.stl")
    block.apply_transform(trimesh.transformations.rotation_matrix(math.radians(degrees), [0, 0, 1]))
    name = f"{mesh}{degrees}.stl"
    block.export(folder / name)
    return name


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--size", type=float, default=60.0, help="mm")
    parser.add_argument("--turns", action="store_true", help="how much filament one block takes, turned")
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
            for mesh, first in (("grid", raw[0]), ("prism", lean[0])) if given.turns else ():
                changes = [
                    sliced(turned(folder, mesh, degrees), generator, folder, DEFAULTS).filament / first.filament - 1
                    for degrees in (90, 180)
                ]
                row(f"the filament of {mesh}.stl turned, {generator}", ", ".join(f"{each:+.2%}" for each in changes))


if __name__ == "__main__":
    main()
