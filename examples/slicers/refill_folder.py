"""Refill every .gcode file of a folder in place; those that were refilled before stay as they are.

python examples/slicers/refill_folder.py folder
"""

import sys
from pathlib import Path

from infill import InfillError, refill


def main(folder: Path) -> int:
    """Return how many sections of infill were replaced; a file that fails stays as it was, and the others go on."""
    replaced = 0
    for path in sorted(folder.glob("*.gcode")):
        try:
            report = refill(path).report
        except InfillError as error:
            print(f"{path.name}: {error}")
            continue
        if report["print"]["already_refilled"]:
            print(f"{path.name}: refilled before")
            continue
        sections, seconds = report["sections"], report["time"]
        saved = seconds["infill_before_s"] - seconds["infill_after_s"]
        print(f"{path.name}: {sections['replaced']} of {sections['all']} sections replaced, {saved / 60:.1f} min saved")
        replaced += sections["replaced"]
    return replaced


if __name__ == "__main__":
    main(Path(sys.argv[1]))
