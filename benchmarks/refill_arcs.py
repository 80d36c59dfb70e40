"""What `infill refill` makes of prints with arcs, beside the same prints without: ``python -m benchmarks.refill_arcs``.

    python -m benchmarks.refill_arcs [--deli PYTHON] [--data FOLDER] [--patterns keep,gyroid] [--only NAME]

Prints of the folder `prints` of the data that hold arcs are compared with the same print in chords. With `--deli`, a
Python that has the package deli-slicer, a round part is sliced by PrusaSlicer 2.9 with the settings of every print of
the corpus that it slices of one mesh, with arcs and without. Both are refilled; tests/gcode_judge.py, which reads
G-code by itself, counts the sections that changed and judges what was written, and `infill verify` compares it with the
old print.

Printed is a table in Markdown: how much more filament the infill takes with arcs than without, and in brackets the
whole print; how much longer the print takes, with the same of the slicer's own prints in brackets; and the lines of
infill as a share. The command ends with 1 if less than 95 % of the sections are changed that are changed without arcs,
if the filament or the time of the print differs by more than 1 %, or if a judge objects.
"""

from __future__ import annotations

import argparse
import itertools
import os
import re
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import trimesh

from infill import refill, verify
from infill.gcode.sliced_file import open_sliced
from tests.arc_fitting import drawn_arcs, straightened
from tests.gcode_corpus import CORPUS
from tests.gcode_judge import changed, judge, pushed
from tests.prints import deli_print

PATTERNS = ("keep", "honeycomb", "gyroid", "grid", "triangles", "cubic", "hilbert")
FITTING = ("disabled", "emit_center")  # of arcs
FIRMWARE = {  # which takes arcs, and whose rule for corners does not depend on how finely a curve is cut
    "gcode_flavor": "klipper",
    "machine_limits_usage": "time_estimate_only",
}
LEAST_CHANGED = 0.95
MOST_APART = 0.01  # of filament and of time
OUTSIDE = 0.03  # mm that lines with arcs may leave the region of the infill farther than those without, in rings
FILAMENT = (0.8, 1.1)  # of the slicer's own, for the judge


@dataclass(frozen=True)
class Pair:
    """A print in chords, and with arcs."""

    name: str
    straight: Path
    arcs: Path


def stored(data: Path, folder: Path, only: str) -> Iterator[Pair]:
    """Yield the prints of the data that hold arcs; of a binary one, its text."""
    for path in sorted((data / "prints").glob("*arcs*")):
        if only not in path.name:
            continue
        with open_sliced(path) as file, file.text(None) as sliced:
            text = sliced.text.read()
        arcs, straight = (folder / f"{path.name}.{kind}.gcode" for kind in ("arcs", "straight"))
        arcs.write_bytes(text)
        straight.write_bytes(straightened(text))
        yield Pair(path.name, straight, arcs)


def corpus(python: str, folder: Path, only: str) -> Iterator[Pair]:
    """Yield a round part, sliced with the settings of every print of the corpus that PrusaSlicer 2.9 knows."""
    part = folder / "part.stl"
    trimesh.creation.annulus(r_min=4, r_max=11, height=1.6, sections=128).export(part)
    for name, entry in CORPUS.items():
        if entry.settings is None or not entry.infilled or only not in name:
            continue
        paths = [folder / f"{name}.{fitting}.gcode" for fitting in FITTING]
        try:
            for fitting, path in zip(FITTING, paths, strict=True):
                deli_print(part, path, {**FIRMWARE, **entry.settings, "arc_fitting": fitting}, python=python)
        except (RuntimeError, ValueError) as error:  # ValueError: of a setting that PrusaSlicer 2.9 no longer has
            print(f"{name}: {str(error).splitlines()[-1]}", file=sys.stderr)
        else:
            yield Pair(name, *paths)


def row(pair: Pair, pattern: str, folder: Path) -> bool:
    """Print what became of a pair, and return whether all that is promised holds."""
    texts, counts, before, after, strays, faults = [], [], [], [], [], []
    for path in (pair.straight, pair.arcs):
        new = folder / "new.gcode"
        report = refill(path, output=new, pattern=pattern).report
        old_text, new_text = path.read_bytes(), new.read_bytes()
        texts.append(new_text)
        counts.append(changed(old_text, new_text))
        before.append(report["time"]["print_before_s"])
        after.append(report["time"]["print_after_s"])
        found = judge(old_text, new_text, filament=FILAMENT)
        far = re.findall(r"^move outside.* by ([\d.]+) mm", "\n".join(found), re.MULTILINE)
        strays.append(max(map(float, far), default=0.0))
        if path is pair.arcs:
            faults = [fault for fault in found if not fault.startswith("move outside")]
            faults += map(str, verify(path, new).violations)
            sections = report["sections"]["all"]
    if strays[1] > strays[0] + OUTSIDE:
        faults.append(f"{strays[1]:.3f} mm outside of the region, {strays[0]:.3f} mm without arcs")
    infill, others = zip(*map(pushed, texts), strict=True)
    filament = [own + other for own, other in zip(infill, others, strict=True)]
    lines = drawn_arcs(texts[1])[1] / max(drawn_arcs(texts[0])[1], 1)
    apart = [other / one - 1 if one else 0.0 for one, other in (infill, filament, after, before)]
    good = counts[1] >= LEAST_CHANGED * counts[0] and max(map(abs, apart[1:3])) <= MOST_APART and not faults
    cells = (
        pair.name,
        pattern,
        f"{counts[1]} and {counts[0]} of {sections}",
        f"{apart[0]:+.2%} ({apart[1]:+.2%})",
        f"{apart[2]:+.2%} ({apart[3]:+.2%})",
        f"{lines:.2f}",
        "; ".join(faults[:3]),
        "" if good else "BROKEN",
    )
    print("| " + " | ".join(cells) + " |", flush=True)
    return good


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--data", default=os.environ.get("INFILL_DATA", "data"), help="the folder of the data")
    asked.add_argument("--deli", default="", help="a Python with the package deli-slicer")
    asked.add_argument("--patterns", default=",".join(PATTERNS), help="with commas between")
    asked.add_argument("--only", default="", help="prints with this in their name")
    options = asked.parse_args()
    heads = (
        "print",
        "pattern",
        "changed, with arcs and not",
        "infill's filament (the print's)",
        "time (the slicer's own)",
    )
    print("| " + " | ".join((*heads, "lines", "faults", "")) + " |")
    print("|---|---|---|---|---|---|---|---|")
    good = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        pairs = [stored(Path(options.data), folder, options.only)]
        if options.deli:
            pairs.append(corpus(options.deli, folder, options.only))
        for pair in itertools.chain(*pairs):
            for pattern in options.patterns.split(","):
                good &= row(pair, pattern, folder)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
