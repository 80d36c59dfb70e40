"""PrusaSlicer and CuraEngine, run without a display on an STL file, and what they say of it.

Settings are a user's who prints walls of one line: the slicer's own defaults, without infill and without
top and bottom skins, which have nothing to do with a block of infill.
"""

from __future__ import annotations

import math
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

LAYER_HEIGHT = 0.3  # mm
FILAMENT_DIAMETER = 1.75  # mm
SECONDS = 300  # to slice at most; most take 10 or less

PRUSA_SETTINGS = {
    "layer_height": LAYER_HEIGHT,
    "first_layer_height": LAYER_HEIGHT,
    "filament_diameter": FILAMENT_DIAMETER,
    "extrusion_width": 0.45,
    "first_layer_extrusion_width": 0.45,
    # 2.5's other generator, Arachne, is slower on our walls and logs errors about itself.
    "perimeter_generator": "classic",
    # One line along walls of one line. It is the program's default; without it, as in most of its printer profiles,
    # lines run along both sides of a wall and extrude 17 to 33 % too much.
    "thin_walls": 1,
    "fill_density": "0%",
    "top_solid_layers": 0,
    "bottom_solid_layers": 0,
    "skirts": 0,
    # As fine as the G-code. The default, every point of the mesh, extrudes the same and takes 4 times as long.
    "resolution": 0.0125,
}

# A user's who has infill: two perimeters and three solid layers, all lines of one width.
FILLED_SETTINGS = {
    "layer_height": 0.2,
    "first_layer_height": 0.2,
    "filament_diameter": FILAMENT_DIAMETER,
    **dict.fromkeys(
        (
            "extrusion_width",
            "first_layer_extrusion_width",
            "perimeter_extrusion_width",
            "external_perimeter_extrusion_width",
            "infill_extrusion_width",
            "solid_infill_extrusion_width",
            "top_infill_extrusion_width",
        ),
        0.45,
    ),
    "perimeters": 2,
    "skirts": 0,
    "top_solid_layers": 3,
    "bottom_solid_layers": 3,
}
PERIMETERS = 0.857  # mm that two of them take: they overlap where their sides are round
OVERLAP = 0.25 * 0.45  # mm that infill reaches into them, by PrusaSlicer's default: a quarter of a line

# CuraEngine takes the definitions' plain defaults and evaluates none of their formulas: what follows from the
# layer height or from "no infill" is set by hand. The line width stays at its default, 0.4 mm: CuraEngine 4 prints
# nothing where a wall is narrower than the line, and the walls along x and y come out 0.42 mm wide.
CURA_SETTINGS = {
    "layer_height": LAYER_HEIGHT,
    "layer_height_0": LAYER_HEIGHT,
    "infill_sparse_thickness": LAYER_HEIGHT,
    "infill_line_distance": 0,
    "top_layers": 0,
    "bottom_layers": 0,
    "initial_bottom_layers": 0,
    "adhesion_type": "none",
    "meshfix_maximum_resolution": 0.25,  # as most printer definitions have it that set it; else 0.5
}

_REPAIRS = ("degenerate_facets", "edges_fixed", "facets_removed", "facets_reversed", "backwards_edges", "open_edges")
_PRUSA_COMPLAINT = re.compile(r"\b(warning|error|fatal|failed|exception|substituted|repaired)\b", re.IGNORECASE)
# Not about the mesh: Cura's definitions hold types that its own engine does not read, and -v lists all settings.
_CURA_COMPLAINT = re.compile(r"^\[(WARNING|ERROR)\](?! Unrecognized data type in JSON|  -s )")


def missing_prusa() -> str:
    """Say what is missing to run PrusaSlicer; nothing if it is there."""
    return "" if shutil.which("prusa-slicer") else "no prusa-slicer on the path: `make slicers` installs it"


def missing_cura() -> str:
    """Say what is missing to run CuraEngine; nothing if all is there."""
    if not shutil.which("CuraEngine"):
        return "no CuraEngine on the path: `make slicers` installs it"
    if cura_definitions() is None:
        return "no definitions for CuraEngine: `make slicers` fetches them, or set CURA_DEFS to their folder"
    return ""


def cura_definitions() -> Path | None:
    """Return the folder of fdmprinter.def.json, if there is one."""
    folders = (
        os.environ.get("CURA_DEFS"),
        Path(__file__).resolve().parents[1] / ".slicers" / "cura" / "definitions",
        "/usr/share/cura/resources/definitions",
    )
    for folder in folders:
        if folder and (Path(folder) / "fdmprinter.def.json").is_file():
            return Path(folder).resolve()
    return None


def prusa_info(path: Path) -> dict[str, Any]:
    """Return what `prusa-slicer --info` reads: volume (mm³), manifold, parts, and what it had to repair."""
    with tempfile.TemporaryDirectory() as folder:
        output = _run_on(path, folder, "prusa-slicer", "--datadir", "data", "--info", "mesh.stl")
    said = dict(re.findall(r"^(\w+) *= *(\S+)", output, re.MULTILINE))
    return {
        "volume": float(said["volume"]),
        "manifold": said["manifold"] == "yes",
        "parts": int(said["number_of_parts"]),
        "repairs": {name: int(said[name]) for name in _REPAIRS if int(said.get(name, 0))},
    }


def prusa_slice(path: Path) -> dict[str, Any]:
    """Return layers, extruded_mm3 and messages (warnings and errors) of slicing with PrusaSlicer."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "print.ini").write_text("".join(f"{name} = {value}\n" for name, value in PRUSA_SETTINGS.items()))
        output = _run_on(
            path,
            folder,
            "prusa-slicer",
            "--datadir",
            "data",
            "--load",
            "print.ini",
            "--export-gcode",
            "-o",
            "out.gcode",
            "mesh.stl",
        )
        gcode = Path(folder, "out.gcode").read_text()
    filament = float(_only(r"^; filament used \[mm\] = ([\d.]+)", gcode))
    return {
        "layers": len(re.findall(r"^;LAYER_CHANGE", gcode, re.MULTILINE)),
        "extruded_mm3": filament * math.pi / 4 * FILAMENT_DIAMETER**2,
        "messages": [line for line in output.splitlines() if _PRUSA_COMPLAINT.search(line)],
    }


def prusa_volumes(
    path: Path, folder: Path, *, seconds: float = SECONDS, **more: object
) -> tuple[dict[str, float], int, str]:
    """Return mm³ by type, the number of layers, and what PrusaSlicer says, of a file that is printed with infill."""
    settings = {**FILLED_SETTINGS, **more}
    (folder / "print.ini").write_text("".join(f"{name} = {value}\n" for name, value in settings.items()))
    words = ["--datadir", "data", "--load", "print.ini", "--dont-arrange", "--export-gcode", "-o", "out.gcode"]
    said = run_slicer(["prusa-slicer", *words, str(path)], folder, seconds=seconds)
    found: dict[str, float] = {}
    kind, before, layers = "", 0.0, 0
    for line in (folder / "out.gcode").read_text().splitlines():
        layers += line.startswith(";LAYER_CHANGE")
        if line.startswith(";TYPE:"):
            kind = line[6:]
        if line.startswith("G92 E"):
            before = float(line[5:].split()[0])
        if (move := re.match(r"G1 .*?E(-?[\d.]+)", line)) is not None:
            laid = float(move[1]) - before
            if laid > 0 and re.search("[XY]", line):
                found[kind] = found.get(kind, 0.0) + laid * math.pi / 4 * FILAMENT_DIAMETER**2
            before = float(move[1])
    return found, layers, said


def cura_slice(path: Path) -> dict[str, Any]:
    """Return layers, extruded_mm3 and messages (warnings and errors) of slicing with CuraEngine."""
    definitions = cura_definitions()
    assert definitions is not None, missing_cura()
    settings = [word for name, value in CURA_SETTINGS.items() for word in ("-s", f"{name}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        output = _run_on(
            path,
            folder,
            "CuraEngine",
            "slice",
            "-v",
            "-j",
            str(definitions / "fdmprinter.def.json"),
            *settings,
            "-e0",
            *settings,
            "-o",
            "out.gcode",
            "-l",
            "mesh.stl",
            CURA_ENGINE_SEARCH_PATH=f"{definitions}:{definitions.parent / 'extruders'}",
        )
    return {
        "layers": int(_only(r"^Layer count: (\d+)", output)),
        "extruded_mm3": float(_only(r"^Filament \(mm\^3\): ([\d.]+)", output)),
        "messages": [line[:200] for line in output.splitlines() if _CURA_COMPLAINT.search(line)],
    }


def run_slicer(
    command: Sequence[str], folder: str | os.PathLike[str], *, seconds: float = SECONDS, **variables: str
) -> str:
    """Run a slicer in a folder, without a display, and return all it says.

    Parameters
    ----------
    command : sequence of str
    folder : path
        Where it runs.
    seconds : float
        How long it may take.
    **variables
        Of its environment.

    Raises
    ------
    RuntimeError
        If it fails.
    """
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run(
        command,
        cwd=folder,
        env={**environment, "LC_ALL": "C", **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
        timeout=seconds,
        check=False,
    )
    if done.returncode:
        raise RuntimeError(f"{command[0]} ended with {done.returncode}: {done.stdout[-500:]}")
    return done.stdout


def _run_on(mesh: Path, folder: str, *command: str, **variables: str) -> str:
    """Run a slicer beside a copy of a mesh, mesh.stl, so that no word of our own path is taken for a message."""
    shutil.copyfile(mesh, Path(folder, "mesh.stl"))
    return run_slicer(command, folder, **variables)


def _only(pattern: str, text: str) -> str:
    """Return what the pattern's one match holds."""
    (found,) = re.findall(pattern, text, re.MULTILINE)
    return found
