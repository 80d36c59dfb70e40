"""One case of the slicer report: sliced, refilled in each mode, judged."""

from __future__ import annotations

import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.slicer_cases import OURS, Case, sliced
from benchmarks.slicer_judge import Judged, judged
from infill import refill
from infill.errors import InfillError

NEAR = 0.01  # of the filament: equal
TRIES = 5


def run_case(case: Case, modes: list[str]) -> dict[str, dict[str, Any]]:
    """Return what each mode gives: numbers of `Judged`, and what refill reports; or an error."""
    with tempfile.TemporaryDirectory(prefix="slicer-report-") as name:
        folder = Path(name)
        try:
            plain = sliced(case, case.density, folder)
        except (RuntimeError, AssertionError, OSError, subprocess.TimeoutExpired) as error:
            return {mode: {"error": f"slicing: {error}"[-300:]} for mode in modes}
        own = judged(plain, case.acceleration)
        if not own.length:
            return {mode: {"error": "the slicer made no sparse infill"} for mode in modes}
        found: dict[str, dict[str, Any]] = {"slicer": own.to_dict()}
        for mode in modes:
            try:
                found[mode] = _mode(case, mode, plain, own, folder, found)
            except (InfillError, RuntimeError, subprocess.TimeoutExpired) as error:
                found[mode] = {"error": str(error)[:300]}
        return found


def _mode(
    case: Case, mode: str, plain: Path, own: Judged, folder: Path, found: dict[str, dict[str, Any]]
) -> dict[str, Any]:
    if mode == "slicer":
        return found[mode]
    if mode == "keep":
        return refilled(plain, folder, case, "keep")
    if mode == "ours":
        if case.pattern not in OURS:
            return {"error": "we have no such pattern"}
        return refilled(plain, folder, case, OURS[case.pattern])
    first = found.get("keep") or refilled(plain, folder, case, "keep")
    return _equal(case, first, own, folder)


def refilled(plain: Path, folder: Path, case: Case, pattern: str) -> dict[str, Any]:
    """Refill a print; return what was measured on it, and what refill reports of itself."""
    output = folder / "refilled.gcode"
    begin = time.perf_counter()
    report = refill(plain, output=output, pattern=pattern, overwrite=True).report
    seconds = time.perf_counter() - begin
    numbers: dict[str, Any] = judged(output if output.exists() else plain, case.acceleration).to_dict()
    output.unlink(missing_ok=True)
    return {
        **numbers,
        "refill_seconds": seconds,
        "sections": report["sections"],
        "rounding": report.get("rounding"),
        "density_for_the_same": (report.get("filament") or {}).get("density_for_the_same_percent"),
        "reported": {"contact": report.get("contact"), "time": report.get("time")},
        "problems": report["problems"],
    }


def _equal(case: Case, first: dict[str, Any], own: Judged, folder: Path) -> dict[str, Any]:
    """Slice again at the density that gives back, after rounding, the filament of the slicer's own."""
    if "error" in first:
        return first
    ratio = first["filament"] / own.filament
    if abs(ratio - 1) <= NEAR:
        return {**first, "density": case.density, "tries": 1}
    known = [(case.density, ratio)]  # densities, and filament over the slicer's own
    density, best = first["density_for_the_same"] or _next(known), {**first, "density": case.density}
    for tries in range(2, TRIES + 1):
        found = refilled(sliced(case, density, folder), folder, case, "keep")
        ratio = found["filament"] / own.filament
        if abs(ratio - 1) < abs(best["filament"] / own.filament - 1):
            best = {**found, "density": density}
        best["tries"] = tries
        if abs(ratio - 1) <= NEAR:
            break
        known.append((density, ratio))
        density = _next(known)
    return best


def _next(known: list[tuple[float, float]]) -> float:
    """Return the density at which the filament should be the slicer's own.

    Between the nearest density that gives too little and the nearest that gives too much, else in proportion.

    >>> _next([(10.0, 0.9), (11.0, 1.1)])
    10.5
    >>> _next([(10.0, 0.8)])
    12.5
    """
    low = max((each for each in known if each[1] <= 1), default=None, key=lambda each: each[1])
    high = min((each for each in known if each[1] > 1), default=None, key=lambda each: each[1])
    if low is None or high is None or low[0] >= high[0]:
        density, ratio = known[-1]
        return density / ratio
    share = (1 - low[1]) / (high[1] - low[1])
    return low[0] + min(max(share, 0.2), 0.8) * (high[0] - low[0])  # some patterns jump: halve in effect
