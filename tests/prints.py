"""Prints as people slice them: walls, skins, infill, retraction and wipe, by PrusaSlicer and CuraEngine.

The settings are those of a common printer with a 0.4 mm nozzle, 0.2 mm layers, lines 0.45 mm wide; `FAST` turns it
into a fast one.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import trimesh

from tests.slicers import cura_definitions, missing_cura, run_slicer

PRINT: Mapping[str, object] = {
    "printer_technology": "FFF",
    "gcode_flavor": "marlin",
    "nozzle_diameter": 0.4,
    "filament_diameter": 1.75,
    "filament_density": 1.24,
    "temperature": 210,
    "first_layer_temperature": 215,
    "use_relative_e_distances": 1,
    "layer_gcode": "G92 E0",
    "bed_shape": "0x0,250x0,250x210,0x210",
    "layer_height": 0.2,
    "first_layer_height": 0.2,
    "extrusion_width": 0.45,
    "first_layer_extrusion_width": 0.42,
    "infill_extrusion_width": 0.45,
    "perimeters": 2,
    "top_solid_layers": 5,
    "bottom_solid_layers": 4,
    "perimeter_speed": 45,
    "external_perimeter_speed": 25,
    "small_perimeter_speed": 25,
    "infill_speed": 80,
    "solid_infill_speed": 80,
    "top_solid_infill_speed": 40,
    "bridge_speed": 30,
    "gap_fill_speed": 40,
    "travel_speed": 180,
    "first_layer_speed": 20,
    "default_acceleration": 1000,
    "infill_acceleration": 1000,
    "perimeter_acceleration": 800,
    "first_layer_acceleration": 1000,
    "machine_max_acceleration_extruding": 1250,
    "machine_max_acceleration_retracting": 1250,
    "machine_max_acceleration_travel": 1250,
    "machine_max_acceleration_x": 1000,
    "machine_max_acceleration_y": 1000,
    "machine_max_acceleration_z": 200,
    "machine_max_acceleration_e": 5000,
    "machine_max_feedrate_x": 200,
    "machine_max_feedrate_y": 200,
    "machine_max_feedrate_z": 12,
    "machine_max_feedrate_e": 120,
    "machine_max_jerk_x": 8,
    "machine_max_jerk_y": 8,
    "machine_max_jerk_z": 0.4,
    "machine_max_jerk_e": 4.5,
    "machine_limits_usage": "emit_to_gcode",
    "retract_length": 0.8,
    "retract_speed": 35,
    "retract_lift": 0.4,
    "retract_before_travel": 1,
    "wipe": 1,
    "retract_before_wipe": "0%",
    "infill_overlap": "10%",
    "infill_anchor": 2.5,
    "infill_anchor_max": 12,
    "fill_density": "15%",
    "fill_pattern": "honeycomb",
    "fill_angle": 45,
    "skirts": 1,
    "cooling": 1,
    "slowdown_below_layer_time": 0,
    "gcode_comments": 0,
    "perimeter_generator": "arachne",
}
FAST: Mapping[str, object] = {
    "infill_speed": 300,
    "infill_acceleration": 10000,
    "default_acceleration": 10000,
    "perimeter_acceleration": 5000,
    "travel_speed": 400,
    "machine_max_acceleration_extruding": 10000,
    "machine_max_acceleration_retracting": 10000,
    "machine_max_acceleration_travel": 10000,
    "machine_max_acceleration_x": 10000,
    "machine_max_acceleration_y": 10000,
    "machine_max_feedrate_x": 400,
    "machine_max_feedrate_y": 400,
}

CURA: Mapping[str, object] = {
    "layer_height": 0.2,
    "layer_height_0": 0.2,
    "infill_sparse_thickness": 0.2,
    "line_width": 0.45,
    "wall_line_width": 0.45,
    "wall_line_width_0": 0.45,
    "wall_line_width_x": 0.45,
    "infill_line_width": 0.45,
    "skin_line_width": 0.45,
    "wall_line_count": 2,
    "wall_thickness": 0.9,
    "top_layers": 5,
    "bottom_layers": 4,
    "initial_bottom_layers": 4,
    "infill_sparse_density": 15,
    "infill_line_distance": 3.0,
    "infill_pattern": "gyroid",
    "speed_infill": 80,
    "speed_wall_0": 25,
    "speed_wall_x": 45,
    "speed_travel": 180,
    "material_diameter": 1.75,
    "retraction_enable": "true",
    "retraction_amount": 0.8,
    "retraction_speed": 35,
    "retraction_min_travel": 1.5,
    "adhesion_type": "none",
    "machine_width": 250,
    "machine_depth": 210,
    "machine_height": 210,
    "machine_center_is_zero": "false",
    "machine_gcode_flavor": "RepRap (Marlin/Sprinter)",
    "machine_start_gcode": "G28\nM109 S210",
    "machine_end_gcode": "M104 S0\nM84",
    "layer_start_x": 0,
    "layer_start_y": 0,
}

DELI = """
import sys
from deli import _engine
_engine.slice([(sys.argv[1], [1, 1, 1], [0, 0, 0], 1, [], 0.0, [], [])], open(sys.argv[2]).read(), sys.argv[3])
"""


def box(folder: Path, size: tuple[float, float, float] = (60, 60, 20)) -> Path:
    """Write a box, standing on z = 0, and return its path."""
    mesh = trimesh.creation.box(size)
    mesh.apply_translation([0, 0, size[2] / 2])
    path = Path(folder) / "box_{:g}_{:g}_{:g}.stl".format(*size)
    mesh.export(path)
    return path


def prusa_print(meshes: Path | list[Path], gcode: Path, settings: Mapping[str, object] | None = None) -> Path:
    """Slice one mesh or several with PrusaSlicer and return the path of the G-code."""
    named = [Path(mesh).resolve() for mesh in ([meshes] if isinstance(meshes, str | os.PathLike) else meshes)]
    with tempfile.TemporaryDirectory() as folder:
        ini = Path(folder, "print.ini")
        ini.write_text("".join(f"{name} = {value}\n" for name, value in {**PRINT, **(settings or {})}.items()))
        merge = ["--merge"] if len(named) > 1 else []
        command = ["prusa-slicer", "--datadir", folder, "--load", str(ini), "--export-gcode", *merge]
        run_slicer([*command, "--center", "125,105", "-o", str(Path(gcode).resolve()), *map(str, named)], folder)
    return Path(gcode)


def deli_print(mesh: Path, gcode: Path, settings: Mapping[str, object] | None = None, *, python: str) -> Path:
    """Slice one mesh with the engine of PrusaSlicer 2.9, by a Python that has deli-slicer; return the G-code's path."""
    with tempfile.TemporaryDirectory() as folder:
        ini = Path(folder, "print.ini")
        ini.write_text("".join(f"{name} = {value}\n" for name, value in {**PRINT, **(settings or {})}.items()))
        files = [Path(mesh).resolve(), ini, Path(gcode).resolve()]
        run_slicer([python, "-c", DELI, *map(str, files)], folder, PYTHONPATH="")
    return Path(gcode)


def cura_print(mesh: Path, gcode: Path, settings: Mapping[str, object] | None = None) -> Path:
    """Slice one mesh with CuraEngine and return the path of the G-code."""
    definitions = cura_definitions()
    assert definitions is not None, missing_cura()
    moved = trimesh.load_mesh(mesh)
    low, high = moved.bounds
    moved.apply_translation([125 - (low[0] + high[0]) / 2, 105 - (low[1] + high[1]) / 2, -low[2]])
    assert np.isfinite(moved.bounds).all()
    words = [word for name, value in {**CURA, **(settings or {})}.items() for word in ("-s", f"{name}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        moved.export(Path(folder, "mesh.stl"))
        command = ["CuraEngine", "slice", "-j", str(definitions / "fdmprinter.def.json"), *words, "-e0", *words]
        search = f"{definitions}:{definitions.parent / 'extruders'}"
        run_slicer(
            [*command, "-o", str(Path(gcode).resolve()), "-l", "mesh.stl"], folder, CURA_ENGINE_SEARCH_PATH=search
        )
    return Path(gcode)
