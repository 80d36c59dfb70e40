"""A post-processing script for Cura: the infill of the print gets round corners, by the program `infill refill`.

Put this file into the folder `scripts` of Cura's configuration folder (Help > Show Configuration Folder), start Cura
again, and add "Refill the infill" at Extensions > Post Processing > Modify G-Code. The program itself is installed
apart from Cura: `pip install phasefill`. If it fails, a message says why, and the print is saved as Cura sliced it.

It needs Python 3.7, its standard library, and what Cura brings.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from UM.Logger import Logger
from UM.Message import Message

from ..Script import Script

LAYER = re.compile("^(?=;LAYER:)", re.MULTILINE)
PROGRESS = re.compile(r"^M73\b.*$", re.MULTILINE)
# What programs packed as one file set for their own Python and libraries, and what breaks other programs.
OWN = ("PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH", "QT_PLUGIN_PATH")
SETTINGS = {
    "program": {
        "label": "Program",
        "description": "The program infill: its name if it is on the path, or else where it lies.",
        "type": "str",
        "default_value": "infill",
    },
    "pattern": {
        "label": "Pattern",
        "description": "keep: Cura's own paths, with round corners. Or the name of another pattern.",
        "type": "str",
        "default_value": "keep",
    },
    "density": {
        "label": "Density",
        "description": "Empty: Cura's filament per mm. same: as much filament as Cura's infill takes.",
        "type": "str",
        "default_value": "",
    },
    "smooth_radius": {
        "label": "Largest radius",
        "description": "Of a corner, mm; auto: as large as support and contact allow.",
        "type": "str",
        "default_value": "auto",
    },
    "seconds": {
        "label": "Time limit",
        "description": "After so many seconds the program is stopped, and the print stays as it was.",
        "unit": "s",
        "type": "int",
        "default_value": 600,
        "minimum_value": "1",
    },
}


class RefillError(Exception):
    """The program was not found, took too long, or said what is wrong."""


class InfillRefill(Script):
    """Hands the G-code to the program, and takes back what it wrote."""

    def getSettingDataString(self) -> str:
        about = {"name": "Refill the infill", "key": "InfillRefill", "metadata": {}, "version": 2}
        return json.dumps({**about, "settings": SETTINGS})

    def execute(self, data: list[str]) -> list[str]:
        try:
            text, report = self._refilled("".join(data))
        except (RefillError, OSError, ValueError) as error:
            _say(f"The infill stays as Cura sliced it: {error}")
            return data
        if report["problems"]:
            _say("; ".join(report["problems"]))
        return split_as(text, data)

    def _refilled(self, text: str) -> tuple[str, dict[str, Any]]:
        """Return what the program makes of a text, and its report."""
        command = [program_named(self._word("program")), "refill", "--json", "--quiet"]
        for name in ("pattern", "density", "smooth_radius"):
            if self._word(name):
                command += ["--" + name.replace("_", "-"), self._word(name)]
        folder = Path(tempfile.mkdtemp(prefix="infill-refill-"))
        try:
            gcode = folder / "print.gcode"
            # As bytes, so that neither line ends nor characters change on the way.
            gcode.write_bytes(text.encode("utf-8", "surrogateescape"))
            report = run(
                [*command, str(gcode)], folder, float(self._word("seconds") or SETTINGS["seconds"]["default_value"])
            )
            return gcode.read_bytes().decode("utf-8", "surrogateescape"), json.loads(report)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def _word(self, key: str) -> str:
        value = self.getSettingValueByKey(key)
        return "" if value is None else str(value).strip().strip('"')


def program_named(name: str) -> str:
    """Return where a program lies, or raise RefillError."""
    found = shutil.which(str(Path(name or "infill").expanduser()))
    if not found:
        raise RefillError(
            f"there is no program {name!r}; install it with pip install phasefill, and give its whole path"
        )
    return found


def run(command: list[str], folder: Path, seconds: float) -> str:
    """Run a program without a window, and return what it wrote to its standard output, or raise RefillError."""
    said, complained = folder / "said.txt", folder / "complained.txt"
    # Files, not pipes: whoever else holds an end of a pipe would keep us waiting after the time is over.
    with said.open("wb") as stdout, complained.open("wb") as stderr:
        try:
            code = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=stdout,
                stderr=stderr,
                cwd=str(folder),
                env={name: value for name, value in os.environ.items() if name not in OWN},
                timeout=seconds,
                check=False,
                creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
            ).returncode
        except subprocess.TimeoutExpired:
            raise RefillError(f"the program took longer than {seconds:g} s; allow it more time") from None
    if code:
        lines = complained.read_text(encoding="utf-8", errors="replace").strip().splitlines()
        raise RefillError(lines[-1] if lines else f"the program ended with code {code} and said nothing")
    return said.read_text(encoding="utf-8", errors="replace")


def split_as(text: str, data: list[str]) -> list[str]:
    """Return a text in as many items as Cura's list has (header, start, one for each layer, end), or in a single one.

    Scripts that run after this one count on the items. Start and end stand in the text as they were; every layer
    begins with its tag.
    """
    tagged = [number for number, item in enumerate(data) if item.startswith(";LAYER:")]
    pieces = LAYER.split(text)
    if not tagged or tagged != list(range(tagged[0], tagged[0] + len(pieces) - 1)):
        return [text]
    start = _items_at_end(pieces[0], data[1 : tagged[0]]) if tagged[0] else None
    end = _items_at_end(pieces[-1], data[tagged[-1] + 1 :])
    if start is None or end is None:
        return [text]
    return [*start, *pieces[1:-1], *end]


def _items_at_end(text: str, items: list[str]) -> list[str] | None:
    """Return what stands before the items at the end of a text, and those items; None if it does not end with them.

    They are the same line by line, but for progress (M73), which is told anew.
    """
    found: list[str] = []
    for item in reversed(items):
        count = item.count("\n") + (not item.endswith("\n"))
        lines = re.split(r"(?<=\n)", text)
        lines = lines[:-1] if lines and not lines[-1] else lines
        cut = len(lines) - count if item else len(lines)
        own = "".join(lines[cut:]) if cut >= 0 else ""
        if PROGRESS.sub("", own) != PROGRESS.sub("", item):
            return None
        found.insert(0, own)
        text = "".join(lines[:cut])
    return [text, *found]


def _say(text: str) -> None:
    """Show a message until it is closed, and log it."""
    Logger.log("w", "infill refill: %s", text)
    Message(text, lifetime=0, title="Refill the infill").show()
