"""A script in front of a slicer: try cells until the block has the density that was asked for, then slice it.

python examples/03_before_the_slicer.py [folder]
"""

import shutil
import subprocess
import sys
from pathlib import Path

from infill import make

SETTINGS = {"perimeters": 2, "fill-density": "0%", "top-solid-layers": 0, "bottom-solid-layers": 0, "layer-height": 0.3}


def main(folder: Path, density: float = 0.2) -> float:
    """Write the block that comes nearest to `density`, and return its own density."""
    blocks = (make("honeycomb", size=30, height=4, cell=cell, stamp="exact") for cell in (3, 4, 5, 6, 8))
    best = min(blocks, key=lambda block: abs(block.report["density"] - density))
    best.save(folder / "block.stl")
    return float(best.report["density"])


def slice_it(slicer: str, part: Path) -> None:
    """Write the G-code beside a part; `thin-walls` lets the slicer draw walls that are one line wide."""
    options = [f"--{name}={value}" for name, value in SETTINGS.items()]
    command = [slicer, "--export-gcode", "--thin-walls", *options, "--output", part.with_suffix(".gcode"), part]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    where = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    print(f"{main(where):.1%}")
    if found := shutil.which("prusa-slicer"):
        slice_it(found, where / "block.stl")
    print(f"sliced by {found}" if found else "not sliced: there is no prusa-slicer on the path")
