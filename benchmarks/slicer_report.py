"""Refill against the slicers themselves: ``python -m benchmarks.slicer_report [--quick] [--only REGEX] [--page]``.

Results go to build/slicer-report.json as they come; a run that is there is not made again. The page,
docs/slicer-report.md, is written from them.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import multiprocessing
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from benchmarks.slicer_cases import MODES, PARTS, Case, cases, quick, width_of
from benchmarks.slicer_page import write_page
from benchmarks.slicer_runs import run_case

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "build" / "slicer-report.json"
PAGE = ROOT / "docs" / "slicer-report.md"
EXTRAS = ("density", "speed")


def main() -> None:
    """Run what is missing, and write the page."""
    words = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    words.add_argument("--quick", action="store_true", help="the box and one bracket, at 15 %%")
    words.add_argument("--only", default="", help="cases whose name matches: prusa/honeycomb/box/15/fast")
    words.add_argument("--again", action="store_true", help="run what is there too")
    words.add_argument("--stale", action="store_true", help="run what older code of ours made, too")
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--page", action="store_true", help="only write the page, of what is there")
    words.add_argument("--minutes", type=float, default=1e9, help="begin no case after so long")
    words.add_argument("--results", type=Path, default=RESULTS)
    given = words.parse_args()
    results = read_results(given.results)
    if not given.page:
        os.nice(5)
        fill(results, given)
    write_page(PAGE, results, total=len(list(cases())), code=code_of())
    print(f"wrote {PAGE}")


def read_results(path: Path) -> dict[str, Any]:
    """Return the results so far."""
    empty: dict[str, Any] = {"form": 1, "runs": {}}
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else empty


def save(results: dict[str, Any], path: Path) -> None:
    """Replace the file of results, whole."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_suffix(".part")
    draft.write_text(json.dumps(results, indent=1), encoding="utf-8")
    os.replace(draft, path)


def fill(results: dict[str, Any], given: argparse.Namespace) -> None:
    """Make the runs that are missing."""
    results["machine"] = machine()
    if "widths" not in results:
        with tempfile.TemporaryDirectory() as folder:
            results["widths"] = {part: width_of(part, Path(folder)) for part in PARTS}
    begin, code = time.monotonic(), code_of()
    todo: list[tuple[Case, list[str]]] = []
    for case in cases():
        if (given.quick and not quick(case)) or not re.search(given.only, case.key):
            continue
        there = {} if given.again else results["runs"].get(case.key, {})
        if given.stale:
            there = {mode: run for mode, run in there.items() if run.get("code") == code}
        missing = [mode for mode in MODES if mode not in there]
        if missing:
            todo.append((case, missing))
    print(f"{len(todo)} cases to run")
    forked = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(max_workers=given.jobs, mp_context=forked, max_tasks_per_child=20) as pool:
        waiting, done = {}, 0
        for case, modes in todo:
            waiting[pool.submit(_timed, case, modes, begin + 60 * given.minutes)] = case
        for future in as_completed(waiting):
            case, found = waiting[future], future.result()
            if not found:
                continue
            done += 1
            results["runs"].setdefault(case.key, {}).update({m: {**run, "code": code} for m, run in found.items()})
            save(results, given.results)
            told = _line(results["runs"][case.key])
            print(f"{done}/{len(todo)} {case.key}: {told}", flush=True)
    for name in EXTRAS:
        if (
            (name not in results or given.again)
            and re.search(given.only, name)
            and time.monotonic() < begin + 60 * given.minutes
        ):
            module = __import__(f"benchmarks.slicer_{name}", fromlist=["measure"])
            results[name] = module.measure(quick=given.quick)
            save(results, given.results)


def code_of() -> str:
    """Return what tells the code that refills and judges from older code."""
    found = hashlib.sha256()
    for room in ("filling", "gcode"):
        for path in sorted((ROOT / "infill" / room).rglob("*.py")):
            found.update(path.read_bytes())
    for path in (ROOT / "benchmarks" / "slicer_judge.py", ROOT / "tests" / "gcode_structure.py"):
        found.update(path.read_bytes())
    return found.hexdigest()[:12]


def _timed(case: Case, modes: list[str], until: float) -> dict[str, Any]:
    return run_case(case, modes) if time.monotonic() < until else {}


def _line(found: dict[str, Any]) -> str:
    base = found.get("slicer", {}).get("seconds")
    parts = []
    for mode, run in found.items():
        if "error" in run:
            parts.append(f"{mode}: {run['error'][:60]}")
        elif base and mode != "slicer":
            own = found["slicer"]
            parts.append(
                f"{mode} {run['seconds'] / base - 1:+.1%} (filament {run['filament'] / own['filament'] - 1:+.1%}, "
                f"supported {run['supported']:.3f}/{own['supported']:.3f}, "
                f"bonded {run['bonded']:.3f}/{own['bonded']:.3f}, turns {run['turns']}/{own['turns']}, "
                f"retractions {run['retractions']}/{own['retractions']})"
            )
    return "; ".join(parts)


def machine() -> dict[str, str]:
    """Return what the numbers were made with."""
    slicer = subprocess.run(["prusa-slicer", "--help"], capture_output=True, text=True, check=False).stdout
    cura = subprocess.run(["CuraEngine", "help"], capture_output=True, text=True, check=False).stderr
    number = re.search(r"version ([\d.]+)", cura)
    return {
        "prusa": (re.search(r"PrusaSlicer-([\d.]+)", slicer) or ["", "unknown"])[1],
        "cura": number[1] if number else "unknown",
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "date": time.strftime("%Y-%m-%d"),
    }


if __name__ == "__main__":
    sys.exit(main())
