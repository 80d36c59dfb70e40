"""`infill smooth` run as a user runs it: the command in a process of its own, its report, its time and memory."""

from __future__ import annotations

import argparse
import json
import os
import platform
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "build" / "smooth-report.json"
PAGE = ROOT / "docs" / "smooth-report.md"
COMMAND = f"{shlex.quote(sys.executable)} -m infill.cli"
LIMIT = 1200  # seconds for one file

# The peak of a process is at least that of its parent when it was started; so a process without libraries starts it.
RUNNER = """
import json, os, resource, subprocess, sys, time
begin = time.perf_counter()
try:
    status = subprocess.run(sys.argv[3:], timeout=float(sys.argv[2])).returncode
except subprocess.TimeoutExpired:
    status = -9
taken = time.perf_counter() - begin
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
os.write(int(sys.argv[1]), json.dumps([status, taken, peak]).encode())
"""


@dataclass(frozen=True)
class Smoothed:
    """What the command did."""

    status: int  # 0, or as the process ended
    message: str  # its error, one line, without folders
    report: dict[str, Any]  # empty where there is none
    seconds: float
    memory: int  # bytes, the peak of the process


def smoothed(command: Sequence[str], source: Path, output: Path, options: Sequence[str] = ()) -> Smoothed:
    """Smooth a file by the command and return what it did."""
    words = [*command, "smooth", str(source), "-o", str(output), "--json", "--force", *options]
    with tempfile.TemporaryFile() as told, tempfile.TemporaryFile() as talk, tempfile.TemporaryFile() as spent:
        runner = [sys.executable, "-I", "-S", "-c", RUNNER, str(spent.fileno()), str(LIMIT), *words]
        where = {"cwd": output.parent, "env": environment(command)}
        subprocess.run(runner, stdout=told, stderr=talk, pass_fds=[spent.fileno()], check=True, **where)
        for file in (told, talk, spent):
            file.seek(0)
        text, errors = told.read().decode(), talk.read().decode().strip().splitlines()
        status, seconds, memory = json.loads(spent.read())
    unit = 1 if sys.platform == "darwin" else 1024
    message = (errors[-1] if errors else f"ended with {status} and said nothing") if status else ""
    return Smoothed(
        status=status,
        message=message.replace(f"{source.parent}{os.sep}", "").replace(f"{output.parent}{os.sep}", ""),
        report=json.loads(text) if status == 0 else {},
        seconds=seconds,
        memory=memory * unit,
    )


def environment(command: Sequence[str]) -> dict[str, str]:
    """Return the variables for a command: ours finds the infill beside this file, any other its own."""
    rest = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return rest | ({"PYTHONPATH": str(ROOT)} if list(command) == shlex.split(COMMAND) else {})


def command_of(text: str) -> list[str]:
    """Return the words of a command, the program by its full path, since it is run in another folder."""
    first, *rest = shlex.split(text)
    return [str(Path(first).absolute()) if os.sep in first else first, *rest]


def arguments(text: str) -> argparse.ArgumentParser:
    """Return what the three benchmarks of the page have in common at the command line."""
    words = argparse.ArgumentParser(description=text.partition("\n")[0])
    default = os.environ.get("INFILL_DATA", ROOT.parent / "shared" / "data")
    words.add_argument(
        "folder", nargs="?", type=lambda word: Path(word).resolve(), default=default, help="that of the test data"
    )
    words.add_argument("--only", default="", metavar="REGEX", help="cases whose name matches")
    words.add_argument("--jobs", type=int, default=1, metavar="N", help="cases at a time; more than one blur times")
    words.add_argument(
        "--command",
        default=os.environ.get("INFILL_COMMAND", COMMAND),
        help="the infill under test: a path, or words as for a shell (default: $INFILL_COMMAND, else this one)",
    )
    words.add_argument("--page", action="store_true", help="only write the page, of what is there")
    words.add_argument("--into", type=Path, default=PAGE, help="the page to write, with its markers")
    words.add_argument("--results", type=Path, default=RESULTS, help="where the results are kept")
    return words


def version_of(command: Sequence[str]) -> str:
    """Return what the command says of itself."""
    with tempfile.TemporaryDirectory() as folder:
        where = {"cwd": folder, "env": environment(command)}
        return subprocess.run(
            [*command, "--version"], capture_output=True, text=True, check=True, **where
        ).stdout.strip()


def read_results(path: Path) -> dict[str, Any]:
    """Return the results so far."""
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def keep(path: Path, section: str, results: dict[str, Any]) -> None:
    """Put the results of one benchmark beside those of the others, the file replaced whole."""
    everything = read_results(path) | {section: results}
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_suffix(".part")
    draft.write_text(json.dumps(everything, indent=1), encoding="utf-8")
    os.replace(draft, path)


def made_with(command: Sequence[str]) -> str:
    """Return a line on what the numbers were made with."""
    import vtk

    return (
        f"{version_of(command)}, VTK {vtk.VTK_VERSION}, Python {platform.python_version()}, "
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, {time.strftime('%Y-%m-%d')}"
    )
