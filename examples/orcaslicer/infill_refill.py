# /// script
# requires-python = ">=3.12"
# dependencies = []
#
# [tool.orcaslicer.plugin]
# name = "Refill the infill"
# description = "Round corners, another pattern or a changing density for the infill, by the program infill."
# author = "phasefill"
# version = "0.1.0"
# ///
"""A plug-in for OrcaSlicer after 2.4.2: the infill of the print gets round corners, by the program `infill refill`.

Add this file at File > Plugins > Install local plugin, and choose "Refill the infill" in the process settings, at
Others > Slicing Pipeline Plugin. The program itself is installed apart from OrcaSlicer: `pipx install phasefill`. If
anything fails, the print stays as OrcaSlicer sliced it.

It needs the standard library alone. All that depends on OrcaSlicer stands at the end.
"""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import orca

SETTINGS: dict[str, Any] = {
    "program": "",  # where infill lies; empty: it is looked for
    "pattern": "keep",  # OrcaSlicer's own paths, with round corners; or the name of another pattern
    "density": "",  # empty: OrcaSlicer's filament per mm; same, 20%, 40%:12%
    "by": "",  # what a density of two numbers follows: skin, roofs, x, y, z
    "smooth_radius": "auto",  # mm, of the largest corner
    "arcs": "auto",
    "options": "",  # other options of infill refill, as one would write them
    "verify": False,  # whether infill verify compares both prints before the new one is taken
    "seconds": 600,  # after these the program is stopped
    "stop_on_failure": False,  # whether a failure ends the export, with a message
}
PASSED_ON = ("pattern", "density", "by", "smooth_radius", "arcs")
# Where installers put programs. What is started from a dock or a menu has none of them in its PATH.
PLACES = ("~/.local/bin", "~/.cargo/bin", "/opt/homebrew/bin", "/usr/local/bin", "~/AppData/Roaming/Python/Scripts")
# What programs packed as one file set for their own Python and libraries, and what breaks other programs.
OWN = ("PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")
# The same names in a folder of its own for every print. OrcaSlicer asks for leave to run a command line, and
# remembers the answer by its text, so that text must not change from print to print.
SLICED, REFILLED, SAID, COMPLAINED = "sliced.gcode", "refilled.gcode", "said.txt", "complained.txt"


class RefillError(Exception):
    """The program was not there, took too long, or said what is wrong."""


def command_for(program: str = "") -> list[str]:
    """Return how infill is started: the one named, or one installed, or by uvx; or raise RefillError."""
    if program:
        path = _located(program)
        if not path:
            raise RefillError(f"there is no program {program!r}")
        return [path]
    for name in ("infill", "phasefill"):
        path = _located(name)
        if path:
            return [path]
    uvx = _located("uvx")
    if uvx:
        return [uvx, "--from", "phasefill", "infill"]
    raise RefillError("infill is not installed: pipx install phasefill, or give its whole path as the program")


def _located(name: str) -> str | None:
    """Return where a program lies: on the PATH, or in a folder of an installer's; None if nowhere."""
    name = str(Path(name).expanduser())
    places = (os.environ.get("PIPX_BIN_DIR", ""), os.environ.get("UV_TOOL_BIN_DIR", ""), *PLACES)
    folders = [str(Path(place).expanduser()) for place in places if place]
    return shutil.which(name) or shutil.which(name, path=os.pathsep.join(folders))


def options_of(settings: dict[str, Any]) -> list[str]:
    """Return settings as options of infill refill, or raise RefillError."""
    options = []
    for name in PASSED_ON:
        value = "" if settings[name] is None else str(settings[name]).strip()
        if value:
            options += ["--" + name.replace("_", "-"), value]
    try:
        return options + shlex.split(str(settings["options"]))
    except ValueError as error:
        raise RefillError(f"the options {settings['options']!r} cannot be read: {error}") from None


def refill(gcode: str, settings: dict[str, Any]) -> str:
    """Refill a print in place, and return what was done, in one line; or raise RefillError, OSError or ValueError.

    The print is replaced in one step, after the program has ended well. Before, it is only read.
    """
    command = command_for(str(settings["program"]).strip().strip('"'))
    options = options_of(settings)
    path = Path(gcode).resolve()
    # Beside the print: on the same disk, and where OrcaSlicer lets a plug-in write.
    folder = Path(tempfile.mkdtemp(prefix="infill-", dir=str(path.parent)))
    try:
        shutil.copy(path, folder / SLICED)
        said = run([*command, "refill", "--json", "--quiet", *options, "-o", REFILLED, SLICED], folder, settings)
        report = report_in(said)
        if report["print"].get("already_refilled"):
            return "the print was refilled before, and stays as it is"
        if settings["verify"]:
            run([*command, "verify", "--quiet", SLICED, REFILLED], folder, settings)
        if not (folder / REFILLED).stat().st_size:
            raise RefillError("the program wrote an empty print")
        shutil.copymode(path, folder / REFILLED)
        os.replace(folder / REFILLED, path)
        return summary(report)
    finally:
        _remove(folder)


def run(command: list[str], folder: Path, settings: dict[str, Any]) -> str:
    """Run a program in a folder, and return what it wrote to its standard output, or raise RefillError."""
    with (
        # Files, not pipes and not the null device: OrcaSlicer would ask for leave to open that.
        (folder / SLICED).open("rb") as stdin,
        (folder / SAID).open("wb") as stdout,
        (folder / COMPLAINED).open("wb") as stderr,
    ):
        try:
            code = subprocess.run(
                command,
                stdin=stdin,
                stdout=stdout,
                stderr=stderr,
                cwd=str(folder),
                env={name: value for name, value in os.environ.items() if name not in OWN},
                timeout=float(settings["seconds"]),
                check=False,
                creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
            ).returncode
        except subprocess.TimeoutExpired:
            raise RefillError(f"the program took longer than {settings['seconds']} s; allow it more") from None
    said, complained = ((folder / name).read_text(encoding="utf-8", errors="replace") for name in (SAID, COMPLAINED))
    if code:
        lines = complained.strip().splitlines()[-1:] or said.strip().splitlines()[:1]
        raise RefillError(lines[0] if lines else f"the program ended with code {code} and said nothing")
    return said


def report_in(said: str) -> dict[str, Any]:
    """Return the report of infill refill, or raise RefillError if there is none, or if it names problems."""
    try:
        report = json.loads(said)
    except ValueError:
        report = None
    if not isinstance(report, dict) or report.get("product") != "refill":
        raise RefillError("the program is not the infill of phasefill: it wrote no report")
    if report["problems"]:
        raise RefillError("; ".join(report["problems"]))
    return report


def summary(report: dict[str, Any]) -> str:
    """Return what was done to a print, in one line."""
    sections, seconds, filament = report["sections"], report["time"], report["filament"]
    words = [f"{sections['replaced']} of {sections['all']} sections of infill"]
    before, after = seconds.get("print_before_s"), seconds.get("print_after_s")
    if before and after:
        words.append(f"{after / 60:.1f} min instead of {before / 60:.1f} ({after / before - 1:+.1%})")
    if filament.get("print_ratio"):
        words.append(f"filament {filament['print_ratio'] - 1:+.1%}")
    return ", ".join(words)


def _remove(folder: Path) -> None:
    """Remove the folder file by file: OrcaSlicer would ask about the names as shutil.rmtree has them."""
    try:
        for name in (SLICED, REFILLED, SAID, COMPLAINED):
            (folder / name).unlink(missing_ok=True)
        folder.rmdir()
    except OSError:
        pass  # what stays is removed with the other temporary files


# --- what depends on OrcaSlicer ---

last = {"message": "nothing was refilled since OrcaSlicer was started"}


class Refill(orca.slicing.SlicingPipelineCapabilityBase):
    """The step after the slicer has written the print."""

    def get_name(self):
        return "Refill the infill"

    def get_default_config(self):
        return SETTINGS

    def execute(self, ctx):
        if ctx.step != orca.slicing.Step.psGCodePostProcess or not ctx.gcode_path:
            return orca.ExecutionResult.success()
        stop = False
        try:
            settings = {**SETTINGS, **json.loads(self.get_config() or "{}")}
            stop = settings["stop_on_failure"] is True
            message, failed = refill(ctx.gcode_path, settings), False
        except Exception as error:  # noqa: BLE001 - whatever it is, the print must go on
            message, failed = f"the infill stays as OrcaSlicer sliced it: {error}", True
        last["message"] = f"{ctx.output_name or ctx.gcode_path}: {message}"
        print("infill refill:", last["message"])
        if failed and stop:
            return orca.ExecutionResult.failure(orca.PluginResult.RecoverableError, message)
        return orca.ExecutionResult.skipped(message) if failed else orca.ExecutionResult.success(message)


class LastRefill(orca.script.ScriptPluginCapabilityBase):
    """What became of the last print: no window may be shown while OrcaSlicer writes it."""

    def get_name(self):
        return "What was refilled last"

    def execute(self):
        return orca.ExecutionResult.success(last["message"])


@orca.plugin
class RefillPlugin(orca.base):
    """What this file brings."""

    def register_capabilities(self):
        orca.register_capability(Refill)
        orca.register_capability(LastRefill)
