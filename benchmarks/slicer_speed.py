"""Speed and memory of `infill refill`, as a command, in turn with PrusaSlicer slicing the same."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.pairs import median, paired, process, ratio
from tests.prints import PRINT, box, prusa_print

LARGE = {"honeycomb": (110, 110, 80), "gyroid": (60, 60, 97)}  # mm: about 25 MB each
SIZES = (24, 97, 194)  # mm: heights of a gyroid box, 6 to 50 MB
RUNS = 5


def measure(*, quick: bool) -> dict[str, Any]:
    """Return seconds and peak memory of every job."""
    runs = 1 if quick else RUNS
    with tempfile.TemporaryDirectory(prefix="slicer-speed-") as name:
        folder = Path(name)
        found: dict[str, Any] = {"runs": runs, "cores": os.cpu_count()}
        found["ours"] = _pair(folder, (60, 60, 20), "honeycomb", "honeycomb", runs)
        for pattern, size in LARGE.items():
            found[f"keep {pattern}"] = _pair(folder, size, pattern, "keep", runs)
        found["memory"] = [_memory(folder, height) for height in (SIZES[:2] if quick else SIZES)]
        found["load"] = float(os.getloadavg()[0])
    return found


def _pair(folder: Path, size: tuple[float, float, float], infill: str, pattern: str, runs: int) -> dict[str, float]:
    gcode = prusa_print(box(folder, size), folder / "print.gcode", {"fill_pattern": infill})
    slice_it = _slicing(folder, size, infill)
    ours, theirs = paired(lambda: process(_refill(gcode, pattern)), lambda: process(slice_it), runs)
    return {
        "bytes": gcode.stat().st_size,
        "seconds": median(ours),
        "memory": float(np.median([run.memory for run in ours])),
        "slicer_seconds": median(theirs),
        "slicer_memory": float(np.median([run.memory for run in theirs])),
        "ratio": ratio(ours, theirs),
    }


def _memory(folder: Path, height: float) -> dict[str, float]:
    gcode = prusa_print(box(folder, (60, 60, height)), folder / "print.gcode", {"fill_pattern": "gyroid"})
    run = process(_refill(gcode, "keep"))
    return {"bytes": gcode.stat().st_size, "seconds": run.seconds, "memory": run.memory}


def _refill(gcode: Path, pattern: str) -> list[str]:
    output = str(gcode.with_name("new.gcode"))
    return [sys.executable, "-m", "infill", "refill", str(gcode), "-o", output, "--force", "-q", "--pattern", pattern]


def _slicing(folder: Path, size: tuple[float, float, float], infill: str) -> list[str]:
    ini = folder / "print.ini"
    ini.write_text("".join(f"{name} = {value}\n" for name, value in {**PRINT, "fill_pattern": infill}.items()))
    mesh = box(folder, size)
    command = ["prusa-slicer", "--datadir", str(folder), "--load", str(ini), "--export-gcode"]
    return [*command, "-o", str(folder / "again.gcode"), str(mesh)]
