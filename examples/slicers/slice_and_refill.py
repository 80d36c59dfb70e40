"""Slice a part with PrusaSlicer, give its infill round corners, and say what that saves.

python examples/slicers/slice_and_refill.py part.stl --load my-settings.ini
"""

import os
import subprocess
import sys
from pathlib import Path

from infill import motion, refill

SLICER = os.environ.get("PRUSA_SLICER", "prusa-slicer")


def main(part: Path, *options: str) -> float:
    """Write part.gcode, as sliced, and part.smooth.gcode; return the share of the infill's time that is saved."""
    plain, smooth = part.with_suffix(".gcode"), part.with_suffix(".smooth.gcode")
    command = [SLICER, "--export-gcode", *options, "--output", plain, part]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    result = refill(plain, output=smooth)
    before, after = (motion(path).of_role("sparse infill") for path in (plain, smooth))
    saved = 1 - after / before if before else 0.0
    print(f"{result.report['sections']['replaced']} of {result.report['sections']['all']} sections of infill replaced")
    print(f"infill: {before / 60:.1f} min before, {after / 60:.1f} min after, {saved:.1%} saved")
    return saved


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:])
