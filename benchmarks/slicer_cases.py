"""What the slicer report slices: patterns, parts, densities and printers, the most telling first.

The matrix fits a night: 6 patterns of PrusaSlicer 2.5 and 2 of CuraEngine, in 6 parts, at 15 and 30 %, for two
printers: 192 slicings, for firmware that reads segments as fast as they come. 8 more are for a board of 8 bits, where
refill writes 200 segments a second at most. Where a Python with the package deli-slicer is named, the engine of
PrusaSlicer 2.9 slices 16 more, with arcs (`arc_fitting`) and without.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import shapely
import trimesh

from tests.prints import FAST, box, cura_print, deli_print, prusa_print

PRUSA = ("honeycomb", "3dhoneycomb", "gyroid", "hilbertcurve", "grid", "cubic")
CURA = ("gyroid", "cubic")
FEW = ("honeycomb", "gyroid")
SLICERS = {  # of a case, as a reader knows them
    "prusa": "PrusaSlicer",
    "cura": "CuraEngine",
    "prusa-8-bit": "PrusaSlicer for a board of 8 bits",
    "prusa-2.9": "PrusaSlicer 2.9",
    "prusa-2.9-arcs": "PrusaSlicer 2.9 with arcs",
}
PATTERNS = {"prusa": PRUSA, "cura": CURA, "prusa-8-bit": FEW, "prusa-2.9": FEW, "prusa-2.9-arcs": FEW}
SMALL = ("prusa-8-bit", "prusa-2.9", "prusa-2.9-arcs")  # slicers that have the small set alone
NEWER = ("prusa-2.9", "prusa-2.9-arcs")
BOX = "box"
PARTS = (
    BOX,
    "bracket_medium",
    "prusa_x-end-motor",
    "prusa_x-carriage",
    "voron_a_drive_frame_lower",
    "prusa_spool-holder",
)
DENSITIES = (15, 30)
PRINTERS = {"normal": 1000.0, "fast": 10000.0}  # mm/s²
DELI_PYTHON = "INFILL_DELI"  # the environment variable that names a Python with the package deli-slicer
MODES = ("slicer", "keep", "keep at equal filament", "ours")
OURS = {  # the pattern of ours that takes the place of the slicer's
    "honeycomb": "honeycomb",
    "3dhoneycomb": "honeycomb-3d",
    "gyroid": "gyroid",
    "hilbertcurve": "hilbert",
    "grid": "grid",
    "cubic": "cubic",
}
# CuraEngine evaluates no formula of its definitions, so the distance of lines is set here: so many directions.
DIRECTIONS = {"cubic": 3}
CURA_FAST = {"speed_infill": 300, "speed_travel": 400}


@dataclass(frozen=True, order=True)
class Case:
    """One slicing that is refilled: `key` names it in the results."""

    slicer: str
    pattern: str
    part: str
    density: float
    printer: str

    @property
    def key(self) -> str:
        return f"{self.slicer}/{self.pattern}/{self.part}/{self.density:g}/{self.printer}"

    @property
    def acceleration(self) -> float:
        return PRINTERS[self.printer]


def case_of(key: str) -> Case:
    """Return the case that a key names.

    >>> case_of("prusa/honeycomb/box/15/fast").printer
    'fast'
    """
    slicer, pattern, part, density, printer = key.split("/")
    return Case(slicer, pattern, part, float(density), printer)


def cases() -> Iterator[Case]:
    """Yield every case: the box at 15 % before the other parts, then the other density."""
    for density in DENSITIES:
        for parts in (PARTS[:1], PARTS[1:]):
            for slicer, patterns in PATTERNS.items():
                for case in itertools.product((slicer,), patterns, parts, (float(density),), PRINTERS):
                    if slicer not in SMALL or quick(Case(*case)):
                        yield Case(*case)


def quick(case: Case) -> bool:
    """Return whether a case belongs to the small set."""
    return case.density == DENSITIES[0] and case.part in PARTS[:2]


def mesh_of(part: str, folder: Path) -> Path:
    """Return the mesh of a part; the box is written."""
    if part == BOX:
        return box(folder)
    return Path(os.environ.get("INFILL_DATA", "data"), "printable", f"{part}.stl")


def sliced(case: Case, density: float, folder: Path) -> Path:
    """Slice a case at some density, %, and return the G-code."""
    mesh = mesh_of(case.part, folder)
    gcode = folder / f"{case.slicer}_{density:.4f}.gcode"
    if case.slicer == "cura":
        return cura_print(mesh, gcode, cura_settings(case, density))
    settings: dict[str, Any] = {"fill_pattern": case.pattern, "fill_density": f"{density:.4f}%"}
    flavor = "marlin" if case.slicer == "prusa-8-bit" else "marlin2"  # PrusaSlicer's Marlin (legacy), and Marlin 2
    settings = {**(FAST if case.printer == "fast" else {}), "gcode_flavor": flavor, **settings}
    if case.slicer not in NEWER:
        return prusa_print(mesh, gcode, settings)
    arcs = "emit_center" if case.slicer.endswith("arcs") else "disabled"
    return deli_print(mesh, gcode, {**settings, "arc_fitting": arcs}, python=os.environ[DELI_PYTHON])


def cura_settings(case: Case, density: float) -> dict[str, Any]:
    """Return what CuraEngine is told: the line distance by hand, and the printer's limits as its first commands."""
    distance = 0.45 * 100 / density * DIRECTIONS.get(case.pattern, 1)
    a = case.acceleration
    top = 400 if case.printer == "fast" else 200
    limits = f"M201 X{a:g} Y{a:g} Z200 E5000\\nM203 X{top} Y{top} Z12 E120\\nM204 P{a:g} T{a:g}"
    return {
        "infill_pattern": case.pattern,
        "infill_sparse_density": f"{density:.4f}",
        "infill_line_distance": f"{distance:.5f}",
        "acceleration_enabled": "false",
        "machine_start_gcode": f"G28\n{limits}\nM109 S210".replace("\\n", "\n"),
        **(CURA_FAST if case.printer == "fast" else {}),
    }


def width_of(part: str, folder: Path) -> float:
    """Return the diameter of the largest circle in the middle section of a part, mm."""
    mesh = trimesh.load_mesh(mesh_of(part, folder))
    section = mesh.section(plane_origin=mesh.bounds.mean(axis=0), plane_normal=[0, 0, 1])
    if section is None:
        return 0.0
    rings = shapely.multilinestrings([shapely.linestrings(loop[:, :2]) for loop in section.discrete])
    areas = shapely.get_parts(shapely.build_area(rings))
    return max((2 * shapely.maximum_inscribed_circle(each, tolerance=0.1).length for each in areas), default=0.0)
