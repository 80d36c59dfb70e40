"""Refill against the slicers themselves: ``python -m benchmarks.slicer_report [--quick] [--only REGEX] [--page]``.

Results go to build/slicer-report.json as they come; a run that is there is not made again, so that a night that ended
early (or after `--minutes`) is taken up where it stopped. The page, docs/slicer-report.md, is written from them, with
the time that the whole matrix takes. `--deli PYTHON` names a Python that has the package deli-slicer (3.12 or later),
and adds PrusaSlicer 2.9; the environment variable INFILL_DELI does the same.
"""

from __future__ import annotations

import argparse
import ast
import hashlib
import json
import multiprocessing
import os
import platform
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from benchmarks.slicer_cases import DELI_PYTHON, MODES, NEWER, PARTS, Case, cases, mesh_of, quick, width_of
from benchmarks.slicer_page import write_page
from benchmarks.slicer_runs import run_case

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "build" / "slicer-report.json"
PAGE = ROOT / "docs" / "slicer-report.md"
EXTRAS = ("density", "speed")
# What refills and judges; with all that these modules import, they are the code that a run was made by.
REFILLS = ("infill.refilling.job", "infill.timing.printing_time")
JUDGES = ("benchmarks/slicer_judge.py", "tests/gcode_judge.py", "tests/gcode_structure.py")


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
    words.add_argument("--deli", default=os.environ.get(DELI_PYTHON, ""), help="a Python with the package deli-slicer")
    given = words.parse_args()
    if given.deli and not shutil.which(given.deli):
        words.error(f"--deli: {given.deli} cannot be run; give the path of a Python that has the package deli-slicer")
    # Absolute, as slicers run in folders of their own, and no symbolic link resolved, which would leave an environment.
    given.deli = str(Path(shutil.which(given.deli) or "").absolute()) if given.deli else ""
    os.environ[DELI_PYTHON] = given.deli
    results = read_results(given.results)
    if not given.page:
        with tempfile.TemporaryDirectory() as folder:
            absent = next((path for part in PARTS if not (path := mesh_of(part, Path(folder))).exists()), None)
        if absent is not None:
            words.error(f"there is no {absent}; set INFILL_DATA to the folder of the test data")
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
    made_with = {name: value for name, value in machine(given.deli).items() if value}
    results["machine"] = {**results.get("machine", {}), **made_with}  # earlier nights may have had more slicers
    if "widths" not in results:
        with tempfile.TemporaryDirectory() as folder:
            results["widths"] = {part: width_of(part, Path(folder)) for part in PARTS}
    begin, code = time.monotonic(), code_of()
    todo: list[tuple[Case, list[str]]] = []
    for case in cases():
        if (given.quick and not quick(case)) or not re.search(given.only, case.key):
            continue
        if case.slicer in NEWER and not given.deli:
            continue
        there = {} if given.again else results["runs"].get(case.key, {})
        if given.stale:
            there = {mode: run for mode, run in there.items() if run.get("code") == code}
        missing = [mode for mode in MODES if mode not in there]
        if missing:
            todo.append((case, missing))
    print(f"{len(todo)} cases to run")
    spawned = multiprocessing.get_context("spawn")
    until, done = begin + 60 * given.minutes, 0
    with spawned.Pool(given.jobs, maxtasksperchild=20) as pool:
        for case, (found, seconds) in pool.imap_unordered(_timed, [(*task, until) for task in todo]):
            if not found:
                continue
            done += 1
            if len(found) == len(MODES):
                results.setdefault("seconds", {})[case.key] = seconds
            results["runs"].setdefault(case.key, {}).update({m: {**run, "code": code} for m, run in found.items()})
            save(results, given.results)
            told = _line(results["runs"][case.key])
            print(f"{done}/{len(todo)} {case.key}: {seconds:.0f} s; {told}", flush=True)
    for name in EXTRAS:
        if (
            (name not in results or given.again)
            and re.search(given.only, name)
            and time.monotonic() < begin + 60 * given.minutes
        ):
            module = __import__(f"benchmarks.slicer_{name}", fromlist=["measure"])
            results[name] = module.measure(quick=given.quick)
            save(results, given.results)


def code_of(root: Path = ROOT) -> str:
    """Return a name of the code that refills and judges: another one once a file of it changes."""
    digest = hashlib.sha256()
    for path in [*imported(REFILLS, root), *(root / name for name in JUDGES)]:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def imported(modules: Iterable[str], root: Path = ROOT) -> list[Path]:
    """Return the files of modules and of all that they import of this repository's packages, in order."""
    files: dict[str, Path] = {}
    waiting = list(modules)
    while waiting:
        module = waiting.pop()
        place = root.joinpath(*module.split("."))
        path = next((path for path in (place.with_suffix(".py"), place / "__init__.py") if path.exists()), None)
        if path is None or module in files:
            continue
        files[module] = path
        for node in ast.walk(ast.parse(path.read_bytes())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.module:
                names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
            waiting += [name for name in names if name.partition(".")[0] in ("infill", "patterns")]
    return [files[module] for module in sorted(files)]


def _timed(task: tuple[Case, list[str], float]) -> tuple[Case, tuple[dict[str, Any], float]]:
    """Run a case unless it is too late; return it, what it gave, and the seconds of one core that it took."""
    case, modes, until = task
    if time.monotonic() >= until:
        return case, ({}, 0.0)
    begin = _core_seconds()
    return case, (run_case(case, modes), _core_seconds() - begin)


def _core_seconds() -> float:
    """Return the seconds of one core that this process and the slicers it ran have taken."""
    uses = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(use.ru_utime + use.ru_stime for use in uses)


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


def machine(deli: str = "") -> dict[str, str]:
    """Return what the numbers were made with."""
    slicer = subprocess.run(["prusa-slicer", "--help"], capture_output=True, text=True, check=False).stdout
    cura = subprocess.run(["CuraEngine", "help"], capture_output=True, text=True, check=False).stderr
    number = re.search(r"version ([\d.]+)", cura)
    version = "from importlib.metadata import version; print(version('deli-slicer'))"
    package = subprocess.run([deli, "-c", version], capture_output=True, text=True, check=True).stdout if deli else ""
    return {
        "deli": package.strip(),
        "prusa": (re.search(r"PrusaSlicer-([\d.]+)", slicer) or ["", "unknown"])[1],
        "cura": number[1] if number else "unknown",
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "date": time.strftime("%Y-%m-%d"),
    }


if __name__ == "__main__":
    sys.exit(main())
