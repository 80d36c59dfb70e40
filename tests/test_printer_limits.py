"""A printer's own limits: its files, limits by name, macros, and the time they make, against closed forms."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_command_line import one_line_error, run, usage_error
from test_packed_prints import TWO, members, packed
from test_packed_prints import binary as binary

from infill import FormatError, Motion, ParameterError, UsageError, motion, verify
from infill.gcode.estimates import find_estimates
from infill.gcode.given_limits import read_printer
from infill.gcode.limit_names import LIMIT_NAMES, NAMES, is_used, parse_limits, set_limits
from infill.gcode.limits import Limits
from infill.gcode.sliced_file import open_sliced
from infill.planner.bounds import Moves
from infill.planner.lookahead import plan_moves
from tests import slicers
from tests.handmade_prints import Dialect, written
from tests.prints import box, prusa_print

needs_prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa())
# Of a printer of Klipper whose plan is easy to work out: no share of a move must run at constant speed.
PRINTER: Mapping[str, object] = {
    "kinematics": "corexy",
    "max_velocity": 100,
    "max_accel": 1000,
    "max_z_velocity": 10,
    "max_z_accel": 50,
    "minimum_cruise_ratio": 0,
}
EXTRUDER: Mapping[str, object] = {
    "nozzle_diameter": 0.4,
    "filament_diameter": 1.75,
    "max_extrude_only_velocity": 30,
    "max_extrude_only_accel": 600,
}
M503 = """\
echo:  G21    ; Units in mm (mm)
echo:; Maximum feedrates (units/s):
echo:  M203 X100.00 Y100.00 Z10.00 E30.00
echo:; Maximum Acceleration (units/s2):
echo:  M201 X1000.00 Y1000.00 Z50.00 E600.00
echo:; Acceleration (units/s2): P<print_accel> R<retract_accel> T<travel_accel>
echo:  M204 P800.00 R700.00 T900.00
echo:; Advanced: B<min_segment_time_us> S<min_feedrate> T<min_travel_feedrate> X<max_jerk> Y<max_jerk> Z<max_jerk> E<max_jerk>
echo:  M205 B20000.00 S0.00 T0.00 X8.00 Y8.00 Z0.40 E5.00
"""
SETTINGS = b"; gcode_flavor = marlin2\n; machine_max_acceleration_x = 77\n; machine_max_acceleration_extruding = 77\n"


def rows(section: str, options: Mapping[str, object]) -> str:
    return f"[{section}]\n" + "".join(f"{name}: {value}\n" for name, value in options.items())


def config(folder: Path, more: str = "", name: str = "printer.cfg", **printer: object) -> Path:
    path = folder / name
    options = {name: value for name, value in {**PRINTER, **printer}.items() if value is not None}
    path.write_text(rows("printer", options) + rows("extruder", EXTRUDER) + more)
    return path


def answer(folder: Path, status: object) -> Path:
    path = folder / "answer.json"
    path.write_text(json.dumps({"result": {"eventtime": 1.0, "status": status}}))
    return path


def gcode(folder: Path, lines: str, head: bytes = b"") -> Path:
    path = folder / "print.gcode"
    path.write_bytes(head + b"M83\nG1 X0 Y0 Z0 F6000\n" + lines.encode())
    return path


def trapezoid(distance: float, speed: float, acceleration: float, begin: float = 0.0, end: float = 0.0) -> float:
    """Seconds of a move that reaches its speed, from one speed to another."""
    ramps = (2 * speed**2 - begin**2 - end**2) / (2 * acceleration)
    assert ramps <= distance * (1 + 1e-9)
    return (2 * speed - begin - end) / acceleration + (distance - ramps) / speed


# --- closed forms ----------------------------------------------------------------------------------------------

CLOSED: dict[str, tuple[str, float]] = {
    "a line": ("G1 X100 F6000\n", trapezoid(100, 100, 1000)),
    "no faster than the printer": ("G1 X100 F60000\n", trapezoid(100, 100, 1000)),
    "a right angle": (
        "G1 X50 F3000\nG1 Y50\n",  # at the square corner velocity, 5 mm/s
        trapezoid(50, 50, 1000, 0, 5) + trapezoid(50, 50, 1000, 5, 0),
    ),
    "there and back": ("G1 X50 F3000\nG1 X0\n", 2 * trapezoid(50, 50, 1000)),
    "z": ("G1 Z5 F6000\n", trapezoid(5, 10, 50)),
    "x and z": (  # z allows 10 * sqrt(2) mm/s and 50 * sqrt(2) mm/s² along the way
        "G1 X10 Z10 F6000\n",
        trapezoid(10 * math.sqrt(2), 10 * math.sqrt(2), 50 * math.sqrt(2)),
    ),
    "filament alone": ("G1 E-5 F6000\n", trapezoid(5, 30, 600)),
    "filament and z": ("G1 Z1 E9 F6000\n", trapezoid(1, 30 / 9, 50)),  # 30 mm/s of filament are 3.3 mm/s of z
    "drawn back while it moves": ("G1 X10 E-10 F6000\n", trapezoid(10, 30, 600)),
    "an acceleration of the file": ("M204 S500\nG1 X100 F6000\n", trapezoid(100, 100, 500)),
    "above that of the printer": ("M204 S4000\nG1 X100 F6000\n", trapezoid(100, 100, 4000)),
    "P alone is ignored": ("M204 P500\nG1 X100 F6000\n", trapezoid(100, 100, 1000)),
    "the lower of P and T": ("M204 P500 T700\nG1 X100 F6000\n", trapezoid(100, 100, 500)),
    "Marlin's commands": ("M201 X10\nM203 X10 Z1\nM205 X1\nG1 X100 F6000\n", trapezoid(100, 100, 1000)),
    "limits of the file": (
        "SET_VELOCITY_LIMIT VELOCITY=200 ACCEL=2000\nG1 X100 F60000\nM400\nG1 Z5\n",
        trapezoid(100, 200, 2000) + trapezoid(5, 10, 50),  # z keeps its own
    ),
    "back to those of the printer": (
        "SET_VELOCITY_LIMIT VELOCITY=20 ACCEL=20\nRESET_VELOCITY_LIMIT\nG1 X100 F6000\n",
        trapezoid(100, 100, 1000),
    ),
}


@pytest.mark.parametrize("case", CLOSED)
def test_klipper_by_its_config(case: str, tmp_path: Path) -> None:
    lines, seconds = CLOSED[case]
    plan = motion(gcode(tmp_path, lines, SETTINGS), printer=config(tmp_path))
    assert plan.limits["model"] == "klipper"
    assert plan.seconds == pytest.approx(seconds, rel=1e-6)


@pytest.mark.parametrize("distance", [1.0, 3.0, 8.0])
@pytest.mark.parametrize("ratio", [0.0, 0.5, 0.8])
def test_a_share_of_a_move_runs_at_constant_speed(distance: float, ratio: float, tmp_path: Path) -> None:
    """From rest to rest, v² is at most a (1 - r) d."""
    speed = min(math.sqrt(1000 * (1 - ratio) * distance), 100)
    plan = motion(gcode(tmp_path, f"G1 X{distance} F6000\n"), printer=config(tmp_path, minimum_cruise_ratio=ratio))
    assert plan.seconds == pytest.approx(trapezoid(distance, speed, 1000), rel=1e-6)


def test_the_ratio_lowers_the_acceleration_of_the_path_and_not_that_of_an_axis() -> None:
    """Z may speed up by 50 mm/s², less than the 500 that a ratio of 0.5 leaves of 1000: a hop reaches sqrt(a d)."""
    limits = Limits(model="klipper", axis_acceleration=(1000, 1000, 50, 600), acceleration=1000)
    limits = replace(limits, travel_acceleration=1000, minimum_cruise_ratio=0.5, feedrate=(100, 100, 100, 30))
    moves = Moves(
        delta=np.array([[0, 0, 0.4, 0]]), feedrate=np.array([100.0]), setting=np.zeros(1, int), stop=np.zeros(1, bool)
    )
    assert plan_moves(moves, [limits]).seconds.sum() == pytest.approx(2 * math.sqrt(0.4 / 50))


def test_defaults_are_those_of_klipper(tmp_path: Path) -> None:
    """Speeds of z follow from max_velocity; those of filament from it and the nozzle; half of a move is steady."""
    path = tmp_path / "printer.cfg"
    path.write_text(
        "[printer]\nmax_velocity: 300\nmax_accel: 3000\n[extruder]\nnozzle_diameter: 0.6\nfilament_diameter: 2.85\n"
    )
    limits = read_printer(path, {}).limits
    share = 4 * 0.6**2 / (math.pi / 4 * 2.85**2)
    assert limits.feedrate == pytest.approx((300, 300, 300, 300 * share))
    assert limits.axis_acceleration == pytest.approx((3000, 3000, 3000, 3000 * share))
    assert (limits.square_corner_velocity, limits.corner_extrusion_velocity) == (5, 1)
    assert limits.minimum_cruise_ratio == 0.5
    path.write_text(path.read_text().replace("max_accel: 3000", "max_accel: 3000\nmax_accel_to_decel: 1000"))
    assert read_printer(path, {}).limits.minimum_cruise_ratio == pytest.approx(2 / 3)


def test_filament_may_change_its_speed_at_once(tmp_path: Path) -> None:
    """At the joint it jumps by 0.1 of the path's speed, by no more than instantaneous_corner_velocity."""
    lines = "G1 X50 E5 F3000\nG1 X100 F3000\n"
    text = config(tmp_path).read_text().replace("[extruder]", "[extruder]\ninstantaneous_corner_velocity: 2")
    path = tmp_path / "corner.cfg"
    path.write_text(text)
    corner = 2 / 0.1
    seconds = trapezoid(50, 50, 1000, 0, corner) + trapezoid(50, 50, 1000, corner, 0)
    assert motion(gcode(tmp_path, lines), printer=path).seconds == pytest.approx(seconds, rel=1e-6)
    path.write_text(text.replace("velocity: 2", "velocity: 0"))
    assert motion(gcode(tmp_path, lines), printer=path).seconds == pytest.approx(2 * trapezoid(50, 50, 1000), rel=1e-6)


def test_retraction_by_firmware_takes_its_time(tmp_path: Path) -> None:
    """Once drawn back, a second G10 does nothing; a G11 pushes the extra length as well."""
    more = (
        "[firmware_retraction]\nretract_length: 3\nretract_speed: 20\nunretract_extra_length: 1\nunretract_speed: 90\n"
    )
    path = gcode(tmp_path, "G1 X50 F6000\nG10\nG10\nG1 X100\nG11\nG11\nG1 X50\n")
    moves = 3 * trapezoid(50, 100, 1000)
    assert motion(path, printer=config(tmp_path)).seconds == pytest.approx(moves)
    plan = motion(path, printer=config(tmp_path, more))
    assert plan.seconds == pytest.approx(moves + trapezoid(3, 20, 600) + trapezoid(4, 30, 600))
    assert plan.retractions == 1
    slow = motion(path, printer=config(tmp_path, more, minimum_cruise_ratio=0.95))  # sqrt(50 * 3) mm/s, sqrt(50 * 4)
    ratio = motion(path, printer=config(tmp_path, minimum_cruise_ratio=0.95)).seconds
    expected = trapezoid(3, math.sqrt(150), 600) + trapezoid(4, math.sqrt(200), 600)
    assert slow.seconds - ratio == pytest.approx(expected)


# --- Klipper's files -------------------------------------------------------------------------------------------


def test_includes_stand_where_their_lines_do(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "b.cfg").write_text("[printer]\nmax_velocity: 70\nmax_accel: 700\n")
    (tmp_path / "parts" / "a.cfg").write_text("[printer]\nmax_velocity: 60\n[include ../more.cfg]\n")
    (tmp_path / "more.cfg").write_text("[extruder]\nmax_extrude_only_velocity: 44 # of filament\n")
    path = tmp_path / "printer.cfg"
    path.write_text("[include parts/*.cfg]\n[include none/*.cfg]\n[printer]\nMax_Accel = 900 ; its last word\n")
    limits = read_printer(path, {}).limits
    assert (limits.feedrate[0], limits.feedrate[3], limits.acceleration) == (70, 44, 900)


def test_what_was_saved_yields_to_what_is_written(tmp_path: Path) -> None:
    saved = (
        "\n#*# <---------------------- SAVE_CONFIG ---------------------->\n"
        "#*# DO NOT EDIT THIS BLOCK OR BELOW. The contents are auto-generated.\n#*#\n"
        "#*# [printer]\n#*# max_accel = 1\n#*# square_corner_velocity = 9\n"
    )
    limits = read_printer(config(tmp_path, saved), {}).limits
    assert (limits.acceleration, limits.square_corner_velocity) == (1000, 9)


@pytest.mark.parametrize(
    ("more", "name", "note"),
    [
        ("[printer]\nkinematics: delta\n", "[printer] kinematics: delta", "edge"),
        ("[printer]\nkinematics: limited_corexy\nmax_x_accel: 5\n", "[printer] max_x_accel", "not followed"),
        ("[printer]\nkinematics: my_own\n", "[printer] kinematics: my_own", "not known"),
        ("[printer]\nmax_accel_to_decel: 5\n", "[printer] max_accel_to_decel", "yields to minimum_cruise_ratio"),
        ("[extruder]\npressure_advance: 0.04\n", "[extruder] pressure_advance", "does not change"),
        ("[extruder]\npressure_advance_smooth_time: 0.04\n", "[extruder] pressure_advance_smooth_time", "not change"),
        ("[extruder]\nmax_extrude_cross_section: 5\n", "[extruder] max_extrude_cross_section", "refuse"),
        ("[input_shaper]\nshaper_freq_x: 50\n", "[input_shaper]", "does not change"),
        ("[extruder1]\nmax_extrude_only_velocity: 3\n", "[extruder1] max_extrude_only_velocity", "as [extruder]"),
    ],
)
def test_a_stated_limit_that_is_not_followed_is_told(more: str, name: str, note: str, tmp_path: Path) -> None:
    """And changes no time."""
    path = gcode(tmp_path, "G1 X100 E9 F6000\nG1 E-3\nG1 Z2\n")
    plain, plan = motion(path, printer=config(tmp_path)), motion(path, printer=config(tmp_path, more))
    assert plain.notes == ()
    (found,) = [entry for entry in plan.notes if entry.name == name]
    assert note in found.note
    assert plan.seconds == plain.seconds
    assert f"note: {name} " in run("motion", path, "--printer", tmp_path / "printer.cfg").stdout


MACROS = """
[gcode_macro Start_Print]
description: heats
gcode:
  {% set bed = params.BED|default(60) %}
  G28
  SET_VELOCITY_LIMIT ACCEL=500   # gently
  _PURGE

[gcode_macro _PURGE]
gcode:
    M204 S250
    _PURGE
[gcode_macro TRICKY]
gcode:
    M204 S100
    SET_VELOCITY_LIMIT ACCEL={printer.toolhead.max_accel}
[gcode_macro MAYBE]
gcode:
    {% if params.SLOW %}
    M204 S100
    {% endif %}
"""


@pytest.mark.parametrize(
    ("call", "acceleration", "told"),
    [
        ("START_PRINT BED=70", 250, ()),
        ("start_print", 250, ()),
        ("TRICKY", 1000, ("[gcode_macro TRICKY]",)),
        ("MAYBE SLOW=1", 1000, ("[gcode_macro MAYBE]",)),
        ("", 1000, ()),
    ],
)
def test_macros_set_limits(call: str, acceleration: float, told: tuple[str, ...], tmp_path: Path) -> None:
    """As far as their lines say so themselves."""
    plan = motion(gcode(tmp_path, f"{call}\nG1 X100 F6000\n"), printer=config(tmp_path, MACROS))
    assert plan.seconds == pytest.approx(trapezoid(100, 100, acceleration), rel=1e-6)
    assert tuple(note.name for note in plan.notes) == told


# --- Moonraker and Marlin --------------------------------------------------------------------------------------


def test_moonraker_states_the_same(tmp_path: Path) -> None:
    lines = gcode(tmp_path, "START_PRINT\nG1 X100 F6000\nG1 Y50\nG1 Z1\nG1 E-5\n")
    expected = motion(lines, printer=config(tmp_path, MACROS))
    macro = {"gcode": "G28\nSET_VELOCITY_LIMIT ACCEL=500\nM204 S250"}
    texts = {
        name: {option: str(value) for option, value in given.items()}
        for name, given in (("printer", PRINTER), ("extruder", EXTRUDER))
    }
    configured = {
        "config": {**texts, "gcode_macro START_PRINT": macro},
        "settings": {"printer": dict(PRINTER), "extruder": dict(EXTRUDER)},
    }
    plan = motion(lines, printer=answer(tmp_path, {"configfile": configured}))
    assert plan.seconds == expected.seconds
    assert (plan.limits, plan.sources) == (expected.limits, expected.sources)
    assert (
        motion(lines, printer=answer(tmp_path, {"configfile": {"config": configured["config"]}})).limits == plan.limits
    )


def test_what_is_in_force_wins_over_what_is_configured(tmp_path: Path) -> None:
    configured = {"settings": {"printer": dict(PRINTER), "extruder": dict(EXTRUDER)}}
    toolhead = {"max_velocity": 80.0, "max_accel": 400.0, "max_accel_to_decel": 100.0, "square_corner_velocity": 7.0}
    limits = read_printer(answer(tmp_path, {"configfile": configured, "toolhead": toolhead}), {}).limits
    assert (limits.feedrate[:3], limits.acceleration) == ((80, 80, 10), 400)
    assert (limits.minimum_cruise_ratio, limits.square_corner_velocity) == (0.75, 7)
    alone = read_printer(answer(tmp_path, {"toolhead": toolhead}), {})
    assert alone.limits.feedrate[2] == 80
    assert [note.name for note in alone.notes] == ["[extruder]"]


def test_defaults_that_moonraker_fills_in_are_not_told(tmp_path: Path) -> None:
    """Notes are about what was written in printer.cfg."""
    defaults = {"pressure_advance": 0.0, "pressure_advance_smooth_time": 0.04, "max_extrude_cross_section": 0.64}
    texts = {"printer": dict(PRINTER), "extruder": dict(EXTRUDER)}
    settings = {"printer": dict(PRINTER), "extruder": {**EXTRUDER, **defaults}}
    printer = read_printer(answer(tmp_path, {"configfile": {"config": texts, "settings": settings}}), {})
    assert printer.notes == ()
    texts["extruder"]["pressure_advance"] = "0.05"
    printer = read_printer(answer(tmp_path, {"configfile": {"config": texts, "settings": settings}}), {})
    assert [note.name for note in printer.notes] == ["[extruder] pressure_advance"]


@pytest.mark.parametrize("before", ["", "Recv: ", "[12:03:04.567] Recv: ", "12:03:04.567 >> ", "10. "])
@pytest.mark.parametrize("echo", ["echo:", "", "echo: "])
def test_marlin_by_its_settings(before: str, echo: str, tmp_path: Path) -> None:
    """Whatever a console puts before the lines, and with the line ends of Windows."""
    path = tmp_path / "m503.txt"
    text = "".join(f"{before}{line}\n" for line in M503.replace("echo:", echo).splitlines())
    path.write_bytes(("SENDING:M503\n" + text + "ok\n").replace("\n", "\r\n").encode())
    limits = read_printer(path, {}).limits
    assert limits.feedrate == (100, 100, 10, 30)
    assert limits.axis_acceleration == (1000, 1000, 50, 600)
    assert (limits.acceleration, limits.retract_acceleration, limits.travel_acceleration) == (800, 700, 900)
    assert (limits.model, limits.jerk) == ("jerk", (8, 8, 0.4, 5))
    plan = motion(gcode(tmp_path, "G1 X100 F6000\n", SETTINGS), printer=path)
    # Classic jerk: from 8 mm/s at once, and to it; travel speeds up by 900 mm/s².
    assert plan.seconds == pytest.approx(trapezoid(100, 100, 900, 8, 8), rel=1e-6)
    assert set(plan.sources.values()) == {"printer"}


def test_marlin_with_a_junction_deviation(tmp_path: Path) -> None:
    path = tmp_path / "m503.txt"
    path.write_text(M503.replace("X8.00 Y8.00 Z0.40 E5.00", "J0.05"))
    plan = motion(gcode(tmp_path, "G1 X50 F3000\nG1 Y50\n"), printer=path)
    s = math.cos(math.pi / 4)  # v² = a J s / (1 - s), where x and y may brake by sqrt(2) * 1000 along the diagonal
    corner = math.sqrt(900 * 0.05 * s / (1 - s))
    assert plan.limits["junction_deviation"] == 0.05
    assert plan.seconds == pytest.approx(
        trapezoid(50, 50, 900, 0, corner) + trapezoid(50, 50, 900, corner, 0), rel=1e-6
    )


def test_commands_of_the_file_change_marlin_as_they_do_the_printer(tmp_path: Path) -> None:
    """M204 is capped by the axes (M201) alone, M201 and M203 by nothing."""
    path = tmp_path / "m503.txt"
    path.write_text(M503)
    for lines, speed, acceleration in (
        ("M204 T5000\n", 100, 1000),
        ("M204 T5000\nM201 X4000\n", 100, 4000),
        ("M203 X200\n", 200, 900),
    ):
        plan = motion(gcode(tmp_path, f"{lines}G1 X100 F60000\n", SETTINGS), printer=path)
        assert plan.seconds == pytest.approx(trapezoid(100, speed, acceleration, 8, 8), rel=1e-6)


def test_the_normal_mode_of_prusas_firmware_counts(tmp_path: Path) -> None:
    path = tmp_path / "m503.txt"
    path.write_text(
        "echo:Maximum feedrates - normal (mm/s):\necho:  M203 X200.00 Y200.00 Z12.00 E120.00\n"
        "echo:Maximum feedrates - stealth (mm/s):\necho:  M203 X100.00 Y100.00 Z12.00 E120.00\n"
        "echo:Maximum acceleration - normal (mm/s2):\necho:  M201 X1000 Y1000 Z200 E5000\n"
        "echo:Maximum acceleration - stealth (mm/s2):\necho:  M201 X960 Y960 Z200 E5000\n"
        "echo:Acceleration: P=print, R=retract, T=travel\necho:  M204 P1250.00 R1250.00 T1250.00\n"
        "echo:Advanced variables: S=Min feedrate (mm/s), X=maximum XY jerk (mm/s)\n"
        "echo:  M205 S0.00 T0.00 B20000.00 X8.00 Y8.00 Z0.40 E4.50\necho:  M900 K0.05\n"
    )
    printer = read_printer(path, {})
    assert (printer.limits.feedrate[0], printer.limits.axis_acceleration[0]) == (200, 1000)
    assert {note.name for note in printer.notes} == {"M201 of the silent mode", "M205 B", "M900"}


# --- limits by name --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("limit", NAMES, ids=lambda limit: limit.name)
def test_every_name_sets_its_limit(limit: Any) -> None:
    """By each of its names, however they are written, and no other limit."""
    value = 0.25 if limit.unit == "" else 1234.5
    for word in (limit.name, *limit.others):
        for spelled in (word, word.upper(), word.replace("_", " "), word.replace(" ", "")):
            assert parse_limits("limits", f"{spelled}={value}{limit.unit}") == {limit.name: value}
    before = Limits(acceleration=4000)
    after = set_limits(before, {limit.name: value})
    changed = {name for name in vars(before) if getattr(before, name) != getattr(after, name)}
    assert changed == set(limit.fields)
    if limit.axes:
        (name,) = limit.fields
        pairs = zip(getattr(before, name), getattr(after, name), strict=True)
        assert tuple(axis for axis, (old, new) in enumerate(pairs) if old != new) == limit.axes


def test_names_that_klipper_has_are_those_of_its_files(tmp_path: Path) -> None:
    """A limit by name is a line of printer.cfg: what follows from it follows, such as the speed of filament."""
    for limit in NAMES:
        if limit.klipper is None:
            continue
        value = 0.25 if limit.unit == "" else 12.5
        section, option = limit.klipper
        by_name = read_printer(config(tmp_path, minimum_cruise_ratio=None), {limit.name: value}).limits
        in_file = config(tmp_path, f"[{section}]\n{option}: {value}\n", minimum_cruise_ratio=None)
        assert by_name == read_printer(in_file, {}).limits


def test_the_sources_of_limits(tmp_path: Path) -> None:
    path = gcode(tmp_path, "G1 X100 F6000\nSET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=9\n", SETTINGS)
    plan = motion(path, printer=config(tmp_path), limits={"max_accel": 500}, minimum_cruise_ratio=0.0)
    expected = {"feedrate": "printer", "axis_acceleration": "printer", "acceleration": "limits"}
    expected |= {"square_corner_velocity": "commands", "minimum_cruise_ratio": "given"}
    expected |= {"corner_extrusion_velocity": "printer"}
    assert plan.sources == expected
    assert plan.seconds == pytest.approx(trapezoid(100, 100, 500), rel=1e-6)
    alone = motion(path, limits="M204 S=500, velocity=100mm/s,jerk=8")
    assert (alone.limits["model"], alone.sources["feedrate"], alone.sources["jerk"]) == ("jerk", "limits", "limits")


def test_a_limit_that_a_command_of_the_file_replaces_is_told(tmp_path: Path) -> None:
    path = gcode(tmp_path, "M204 P1000 T1000\nG1 X100 F6000\n", SETTINGS)
    (note,) = motion(path, limits={"acceleration": 50}).notes
    assert (note.name, note.note) == ("acceleration", "was given with --limits, and M204 in the file sets another")


def test_commands_change_limits_by_name_and_not_those_for_the_entire_file(tmp_path: Path) -> None:
    path = gcode(tmp_path, "SET_VELOCITY_LIMIT ACCEL=250\nG1 X100 F6000\n")
    assert motion(path, printer=config(tmp_path), limits="accel=500").limits["acceleration"] == 250
    assert motion(path, printer=config(tmp_path), acceleration=500).limits["acceleration"] == 500


def test_limits_by_name_choose_the_model(tmp_path: Path) -> None:
    path = gcode(tmp_path, "G1 X100 F6000\n")
    for text, model in (("scv=5", "klipper"), ("J_e=1", ""), ("M205 J=0.02", "junction"), ("jerk_e=1", "jerk")):
        if model:
            assert motion(path, limits=text).limits["model"] == model
    assert motion(path, limits="jerk=5,scv=5", model="klipper").notes[0].name == "jerk"


def test_a_limit_of_another_model_is_told(tmp_path: Path) -> None:
    path = gcode(tmp_path, "G1 X100 F6000\n")
    plan = motion(path, printer=config(tmp_path), limits="jerk=1,acceleration_x=1,M204T=1")
    assert plan.seconds == motion(path, printer=config(tmp_path)).seconds
    assert [note.name for note in plan.notes] == ["jerk", "acceleration_x", "travel_acceleration"]
    assert [name for name in LIMIT_NAMES if is_used(name, "klipper")] == [n.name for n in NAMES if n.klipper]
    forced = motion(path, printer=config(tmp_path), model="jerk")
    assert "square_corner_velocity" in {note.name for note in forced.notes}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("foo=3", "'foo', which is not a limit; the names are velocity, "),
        ("max_acel=3", "did you mean 'max_accel'?"),
        ("max_accel=fast", "max_accel = 'fast'; give a number from 0.001"),
        ("max_accel=5mm", "max_accel = '5mm'"),
        ("max_accel=-1", "max_accel = '-1'"),
        ("minimum_cruise_ratio=1", "give a number from 0 and below 1"),
        ("max_accel", "give a name and a value, as max_accel=3000"),
        ("=3", "give a name and a value"),
        ("max_accel=3,accel=4", "acceleration twice"),
        ("jerk=8,scv=5", "jerk and square_corner_velocity, which belong to two models"),
    ],
)
def test_limits_that_are_none_are_one_line(text: str, says: str, tmp_path: Path) -> None:
    """What cannot be read is wrong usage; what can, and cannot be done, is an error."""
    path, pattern = gcode(tmp_path, "G1 X100 F6000\n"), re.escape(says)
    with pytest.raises(ParameterError, match=f"^limits .*{pattern}") as caught:
        motion(path, limits=text)
    check = usage_error if isinstance(caught.value, UsageError) else one_line_error
    check(run("motion", path, "--limits", text), f"--limits .*{pattern}")


# --- macros ----------------------------------------------------------------------------------------------------


def test_a_macro_takes_its_time(tmp_path: Path) -> None:
    """At each call; the machine stands still there. Homing and changes of tools can have a time as well."""
    lines = "G28\nSTART_PRINT BED=60\nG1 X50 F6000\nT1\nG1 X100\nEND_PRINT\n"
    path = gcode(tmp_path, lines)
    plain = motion(path, printer=config(tmp_path))
    plan = motion(path, printer=config(tmp_path), macros="START_PRINT=45s,G28=20,t1=1m 30s")
    assert plan.seconds == pytest.approx(2 * trapezoid(50, 100, 1000) + 45 + 20 + 90)
    assert plan.macro_seconds == {"G28": 20, "START_PRINT": 45, "T1": 90}
    assert (plain.macros, plan.macros) == (("START_PRINT", "END_PRINT"), ("END_PRINT",))
    text = run("motion", path, "--macro", "START_PRINT=45s", "--macro", "STRT_PRINT=3").stdout
    assert "--macro END_PRINT=45s counts it" in text
    assert "note: STRT_PRINT has a time, and no line calls it" in text
    assert motion(path, macros={"END_PRINT": 10}).seconds == pytest.approx(motion(path).seconds + 10)


@pytest.mark.parametrize("text", ["START_PRINT=-3", "START_PRINT=1e9", "A=1,a=2"])
def test_times_that_are_none_are_one_line(text: str, tmp_path: Path) -> None:
    one_line_error(run("motion", gcode(tmp_path, "G1 X1\n"), "--macro", text), "^error: --macro ")


@pytest.mark.parametrize("text", ["START_PRINT", "START_PRINT=x", "A B=3", "A=", "A= h", "START-PRINT=3"])
def test_times_that_cannot_be_read_are_wrong_usage(text: str, tmp_path: Path) -> None:
    usage_error(run("motion", gcode(tmp_path, "G1 X1\n"), "--macro", text), "error: --macro ")


# --- files that do not state limits ----------------------------------------------------------------------------

LOOP = "[include other.cfg]\n"
BROKEN: dict[str, tuple[str | bytes, str]] = {
    "a loop": (LOOP, "bad.cfg includes other.cfg includes bad.cfg, in a loop; remove"),
    "no include": ("[include gone.cfg]\n[printer]\n", "includes gone.cfg, which is not in .*; copy it there"),
    "no printer": ("[mcu]\nserial: x\n", r"no section \[printer\], only \[mcu\]"),
    "no number": ("[printer]\nmax_velocity: 1\nmax_accel: fast\n", r"\[printer\] max_accel is 'fast'; it must be"),
    "negative": ("[printer]\nmax_velocity: -1\nmax_accel: 5\n", r"\[printer\] max_velocity is '-1'"),
    "no acceleration": ("[printer]\nmax_velocity: 1\n", r"\[printer\] has no max_accel"),
    "of the extruder": (
        "[printer]\nmax_velocity: 1\nmax_accel: 5\n[extruder]\nmax_extrude_only_accel: {x}\n",
        r"\[extruder\] max_extrude_only_accel is '\{x\}'",
    ),
    "binary": (bytes(range(256)), "is not text"),
    "empty": ("", "is empty"),
    "words": ("hello\n", "neither Klipper's printer.cfg, nor Moonraker's"),
    "a print": ("M204 S500\nG1 X5 F6000\n", "is G-code to print"),
    "cut off": ('{"result": {"status": {', "is not complete JSON"),
    "no objects": ('{"result": {"status": {"webhooks": {}}}}', "neither the object configfile nor toolhead"),
    "an empty object": ('{"result": {"status": {"toolhead": {}}}}', "neither the object configfile nor toolhead"),
    "odd objects": ('{"result": 3}', "neither the object"),
    "an error": ('{"error": {"message": "Klippy Host not connected"}}', "Moonraker, 'Klippy Host not connected'"),
    "a text for a number": ('{"status": {"toolhead": {"max_velocity": "x", "max_accel": 5}}}', "max_velocity is 'x'"),
    "no limits": ("echo: M92 X80.00 Y80.00\nok\n", "states no limits"),
    "inches": ("echo: G20\necho: M203 X5 Y5\n", "inches"),
    "another firmware": ("M566 X600 Y600\nM203 X12000 Y12000\n", r"RepRapFirmware \(M566\)"),
    "impossible": ("echo: M203 X0.00 Y5\n", "no possible X"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_file_without_limits_is_one_line(name: str, tmp_path: Path) -> None:
    content, says = BROKEN[name]
    path = tmp_path / "bad.cfg"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    (tmp_path / "other.cfg").write_text("[include bad.cfg]\n")
    new = tmp_path / "new.gcode"
    print_ = gcode(tmp_path, "G1 X100 F6000\n")
    one_line_error(run("motion", print_, "--printer", path, "--write", new), says)
    assert not new.exists()
    with pytest.raises(FormatError, match=says):
        motion(print_, printer=path)


def test_a_printer_that_is_not_there(tmp_path: Path) -> None:
    print_ = gcode(tmp_path, "G1 X100 F6000\n")
    one_line_error(run("motion", print_, "--printer", tmp_path / "none.cfg"), "there is no file .*none.cfg")
    one_line_error(run("motion", print_, "--printer", tmp_path), "is a folder; give a file, such as printer.cfg")


def test_a_file_that_includes_itself_a_thousand_times_is_refused(tmp_path: Path) -> None:
    """Without a loop: each file includes the next one twice."""
    for number in range(30):
        (tmp_path / f"{number}.cfg").write_text(f"[include {number + 1}.cfg]\n" * 2)
    (tmp_path / "30.cfg").write_text("[printer]\n")
    (tmp_path / "printer.cfg").write_text("[printer]\n[include 0.cfg]\n")
    with pytest.raises(FormatError, match="includes more than 500 files"):
        read_printer(tmp_path / "printer.cfg", {})


# --- written estimates -----------------------------------------------------------------------------------------


def lines_of(path: Path, plate: int | None = None) -> list[bytes]:
    with open_sliced(path) as file, file.text(plate) as sliced:
        return sliced.text.read().splitlines(keepends=True)


def is_time(line: bytes) -> bool:
    """Tell whether a line states time, by words of its own."""
    beginnings = (
        b"M73 ",
        b"; estimated ",
        b"; model printing",
        b"; total estimated",
        b";TIME",
        b";PRINT.TIME",
        b";PRINTING_",
        b";REMAINING_",
    )
    return line.startswith(beginnings)


def same_but_times(old: list[bytes], new: list[bytes]) -> int:
    """Return how many lines differ; each of them must state time, and every other one be the same, byte for byte."""
    assert len(old) == len(new)
    different = [(one, other) for one, other in zip(old, new, strict=True) if one != other]
    for one, other in different:
        assert is_time(one), one
        assert is_time(other), other
        assert (one.endswith(b"\r\n"), one.endswith(b"\n")) == (other.endswith(b"\r\n"), other.endswith(b"\n"))
    return len(different)


def planned(path: Path, folder: Path, **more: Any) -> Motion:
    return motion(path, printer=config(folder, MACROS, max_accel=300), macros="START_PRINT=45s", **more)


DIALECTS = {
    "prusa": Dialect(),
    "both modes": Dialect(progress="P{done} R{left}\nM73 Q{done} S{left}"),
    "windows": Dialect(crlf=True),
    "no newline": Dialect(newline=False),
    "orca": Dialect(slicer="orca", layers=4),
    "bambu": Dialect(slicer="bambu", layers=4),
    "cura": Dialect(slicer="cura", absolute=True),
    "none": Dialect(progress=""),
}


@pytest.mark.parametrize("name", DIALECTS)
def test_nothing_but_statements_of_time_changes(name: str, tmp_path: Path) -> None:
    text = written(DIALECTS[name])
    first = text.index(b"\n") + 1
    path, new = tmp_path / "print.gcode", tmp_path / "new.gcode"
    path.write_bytes(text[:first] + b"START_PRINT BED=60\n" + text[first:])
    plan = planned(path, tmp_path, write=new)
    assert plan.written is not None
    old_lines, new_lines = lines_of(path), lines_of(new)
    changed = same_but_times(old_lines, new_lines)
    assert changed > (0 if plan.written.statements else -1)
    assert plan.written.statements == sum(map(is_time, old_lines))
    assert verify(path, new).agrees
    if any(line.startswith((b"; estimated", b";TIME:", b"; total est", b"; model")) for line in new_lines):
        assert motion(new).estimate == pytest.approx(plan.seconds, abs=1)
    again = tmp_path / "again.gcode"
    planned(new, tmp_path, write=again)
    if name != "both modes":  # the other mode is not planned: its minutes are rounded each time
        assert again.read_bytes() == new.read_bytes()


def test_a_change_elsewhere_would_be_found() -> None:
    old = [b"M73 P1 R2\n", b"G1 X1\n", b"; filament used [mm] = 3\n"]
    assert same_but_times(old, [b"M73 P9 R2\n", *old[1:]]) == 1
    for place, line in ((1, b"G1 X1 \n"), (2, b"; filament used [mm] = 3.0\n"), (0, b"M73 P1 R2\r\n")):
        with pytest.raises(AssertionError):
            same_but_times(old, [*old[:place], line, *old[place + 1 :]])
    assert [is_time(line) for line in old] == [True, False, False]
    assert len(list(find_estimates(b"".join(old)))) == 2


def test_progress_follows_the_plan(tmp_path: Path) -> None:
    """Two moves of 11 s each and 78 s of a macro: a line between them stands at 89 of 100 s."""
    text = "START_PRINT\nM73 P0 R9\nG1 X100 F600\nM73 P1 R1\nG1 X0\nM73 P99 R0\n; estimated printing time (normal mode) = 1s\n"
    path = gcode(tmp_path, text, b"M73 P50 R50\n")
    speed, acceleration = 10.0, 10.0
    printer = config(tmp_path, max_accel=acceleration)
    each = trapezoid(100, speed, acceleration)
    plan = motion(path, printer=printer, macros={"START_PRINT": 100 - 2 * each}, write=tmp_path / "new.gcode")
    assert plan.seconds == pytest.approx(100)
    told = [line for line in lines_of(tmp_path / "new.gcode") if is_time(line)]
    share = b"%d" % (100 - each)
    assert told[:2] == [b"M73 P0 R1\n"] * 2
    assert told[2:] == [
        b"M73 P%s R0\n" % share,
        b"M73 P100 R0\n",
        b"; estimated printing time (normal mode) = 1m 40s\n",
    ]


def test_a_packed_print_keeps_its_form(binary: Path, tmp_path: Path) -> None:
    plan = planned(binary, tmp_path, write=tmp_path / "new.bgcode")
    assert same_but_times(lines_of(binary), lines_of(tmp_path / "new.bgcode")) > 0
    assert (tmp_path / "new.bgcode").read_bytes()[:4] == b"GCDE"
    assert planned(tmp_path / "new.bgcode", tmp_path).seconds == plan.seconds


def test_every_plate_of_an_archive_or_one(tmp_path: Path) -> None:
    path, new = tmp_path / "a.gcode.3mf", tmp_path / "new.gcode.3mf"
    path.write_bytes(packed({1: TWO, 2: TWO}))
    for plate, touched in ((None, {1, 2}), (2, {2})):
        planned(path, tmp_path, plate=plate, write=new, overwrite=True)
        old_files, new_files = members(path), members(new)
        assert list(old_files) == list(new_files)
        changed = {name for name in old_files if old_files[name] != new_files[name]}
        assert changed == {f"Metadata/plate_{number}.gcode{end}" for number in touched for end in ("", ".md5")}
        for number in touched:
            assert same_but_times(lines_of(path, number), lines_of(new, number)) > 0


def test_nothing_is_overwritten_unless_it_is_said(tmp_path: Path) -> None:
    path = tmp_path / "print.gcode"
    path.write_bytes(written(Dialect()))
    old = path.read_bytes()
    printer = ["--printer", config(tmp_path)]
    one_line_error(run("motion", path, *printer, "--write", path), "print.gcode exists; give another name, or --force")
    usage_error(run("motion", path, path, *printer, "--write", tmp_path / "new.gcode"), "for one print")
    usage_error(run("motion", path, *printer, "--in-place", "--write", tmp_path / "new.gcode"), "leave one out")
    usage_error(run("motion", path, *printer, "--write", "-"), "stdout")
    one_line_error(run("motion", path, *printer, "--write", tmp_path / "no" / "new.gcode"), "there is no folder")
    one_line_error(run("motion", tmp_path / "gone.gcode", "--write", path), "there is no file .*gone.gcode")
    assert path.read_bytes() == old
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["print.gcode", "printer.cfg"]
    new = tmp_path / "new.gcode"
    assert "written" in run("motion", path, *printer, "--write", new).stdout
    assert "wrote" in run("motion", path, *printer, "--write", path, "--force").stderr
    assert path.read_bytes() == new.read_bytes() != old
    path.write_bytes(old)
    report = json.loads(run("motion", path, *printer, "--in-place", "--json").stdout)
    assert report["written"] == {"file": str(path), "statements": sum(map(is_time, lines_of(path)))}
    assert path.read_bytes() == new.read_bytes()


@pytest.mark.skipif(sys.platform == "win32", reason="permissions and links as POSIX has them")
def test_permissions_and_links_stay(tmp_path: Path) -> None:
    path, link = tmp_path / "print.gcode", tmp_path / "link.gcode"
    path.write_bytes(written(Dialect()))
    path.chmod(0o640)
    link.symlink_to(path)
    motion(link, limits="accel=300", write=link, overwrite=True)
    assert link.is_symlink()
    assert path.stat().st_mode & 0o777 == 0o640
    assert motion(path, limits="accel=300").seconds == pytest.approx(motion(path).estimate, abs=1)


def test_a_print_that_states_no_time_is_copied_and_said_so(tmp_path: Path) -> None:
    path = gcode(tmp_path, "G1 X100 F6000\n")
    text = run("motion", path, "--write", tmp_path / "new.gcode").stdout
    assert "unchanged: the print states no time" in text
    assert (tmp_path / "new.gcode").read_bytes() == path.read_bytes()


@pytest.mark.slow
@needs_prusa
def test_a_print_of_prusaslicer_gets_the_time_of_the_printer(tmp_path: Path) -> None:
    """With the limits that it was sliced for, its own estimate stays within 1 %; with others, it is replaced."""
    settings = {"fill_pattern": "honeycomb", "remaining_times": 1, "machine_limits_usage": "time_estimate_only"}
    path = prusa_print(box(tmp_path, (20, 20, 4)), tmp_path / "print.gcode", settings)
    marlin = tmp_path / "m503.txt"
    marlin.write_text(
        "echo: M203 X200 Y200 Z12 E120\necho: M201 X1000 Y1000 Z200 E5000\necho: M204 P1250 R1250 T1250\n"
        "echo: M205 X8 Y8 Z0.4 E4.5\n"
    )
    plan = motion(path, printer=marlin)
    assert plan.estimate == pytest.approx(plan.seconds, rel=0.01)
    assert plan.sources["feedrate"] == "printer"
    slow = planned(path, tmp_path, write=tmp_path / "new.gcode")
    assert slow.seconds > 1.05 * plan.seconds
    assert same_but_times(lines_of(path), lines_of(tmp_path / "new.gcode")) > 5
    assert motion(tmp_path / "new.gcode").estimate == pytest.approx(slow.seconds, abs=1)


def test_a_picture_follows_the_printer(tmp_path: Path) -> None:
    """It is planned again with the same arguments."""
    path = gcode(tmp_path, ";LAYER_CHANGE\n;TYPE:Perimeter\nG1 X100 E3 F6000\nG1 X0 E3\n")
    plan = motion(path, printer=config(tmp_path), limits={"velocity": 3})
    assert plan.arguments == {"printer": config(tmp_path), "limits": {"velocity": 3}}
    assert (
        np.asarray(plan.picture()).tobytes() != np.asarray(motion(path, printer=config(tmp_path)).picture()).tobytes()
    )
