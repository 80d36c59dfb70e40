"""`infill motion`: what files tell about their machine, how files are followed, and the slicers' own estimates."""

from __future__ import annotations

import io
import json
import math
import re
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from test_command_line import one_line_error
from test_command_line import run as run_infill
from typer.testing import CliRunner

import infill
from infill import FormatError, Motion, ParameterError, motion
from infill.cli.app import build_app
from infill.files.suffixes import MESHES
from infill.formats.mesh_files import READERS
from infill.gcode.chords import cut_chords
from infill.gcode.found_limits import CURA, KLIPPER, MARLIN, read_limits
from infill.gcode.given_limits import GivenLimits
from infill.gcode.limits import LIMITING_CODES, Limits, apply_command
from infill.pictures.layer_times import COLOURS as CURVES
from infill.pictures.layer_times import draw_layer_times
from infill.pictures.speeds import BAR, CAPTION, LEAST_HEIGHT, MARGIN, draw_speeds, speed_colours
from infill.planner import timeline
from infill.planner.layer_speeds import PIECE_LENGTH, LayerSpeeds, layer_speeds
from infill.planner.struct_of_arrays import concatenate_rows, slice_rows
from infill.planner.timeline import Timeline
from infill.timing.printing_time import FeatureMotion
from tests import slicers
from tests.prints import FAST, box, cura_print, prusa_print

needs_prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa())
needs_cura = pytest.mark.skipif(bool(slicers.missing_cura()), reason=slicers.missing_cura())

SQUARE = b"""M204 P1000 T1000 R1000
M205 X8 Y8 Z0.4 E5
G1 X0 Y0 Z0 F6000
M83
;LAYER_CHANGE
;TYPE:External perimeter
G1 X20 E1 F3000
G1 Y20 E1
G1 X0 E1
G1 Y0 E1
G1 E-.8 F2100
G1 X5 Y5 F6000
G1 E.8 F2100
;TYPE:Internal infill
G1 X15 Y15 E.7 F4800
G1 X15.05 E.002
G1 X15.05 Y5 E.5
"""


# Limits that no machine has: too low, too high, and of more digits than a number holds.
ABSURD = [
    b"M204 S0.0000001 T0.0000001",
    b"M204 P99999999999 T99999999999 R99999999999",
    b"M204 S1" + b"0" * 400,
    b"M201 X0.0000001 Y0.0000001 E99999999999",
    b"M203 X0.0000001 Y99999999999",
    b"M205 X0.0000001 Y99999999999 J0.0000000001",
    b"M205 S99999999999 T99999999999",
    b"M566 X0.0000001 Y999999999999999",
    b"SET_VELOCITY_LIMIT ACCEL=1e-300 VELOCITY=1e-30",
    b"SET_VELOCITY_LIMIT ACCEL=9e99 VELOCITY=9e99 SQUARE_CORNER_VELOCITY=1e-9",
    b"SET_VELOCITY_LIMIT MINIMUM_CRUISE_RATIO=1 ACCEL_TO_DECEL=9e99",
]


def written(folder: Path, text: bytes, name: str = "print.gcode") -> Path:
    path = folder / name
    path.write_bytes(text)
    return path


def of(found: Motion, role: str) -> FeatureMotion:
    (feature,) = [each for each in found.features if each.role == role]
    return feature


def run(*words: object) -> Any:
    return CliRunner().invoke(build_app(), ["motion", *map(str, words)])


# --- limits ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "name", "value"),
    [
        (b"M201 X1500 E9000 ; mm/s2", "axis_acceleration", (1500, 3000, 100, 9000)),
        (b"M203 Z12", "feedrate", (300, 300, 12, 25)),
        (b"M203 X0", "feedrate", (300, 300, 5, 25)),
        (b"M204 S700", "travel_acceleration", 700),
        (b"M204 S700 T900", "retract_acceleration", 900),
        (b"M204 P700", "acceleration", 700),
        (b"M204 P700", "travel_acceleration", 3000),
        (b"M204 P1250 R1300 T1400", "retract_acceleration", 1300),
        (b"M205 X9 E4.5", "jerk", (9, 9, 0.3, 4.5)),
        (b"M205 X9 Y7", "jerk", (9, 7, 0.3, 5)),
        (b"M205 J0.05", "junction_deviation", 0.05),
        (b"M205 S1 T2", "minimum_travel_feedrate", 2),
        (b"M566 X480 Y600 Z24", "jerk", (8, 10, 0.4, 5)),
        (b"M117 P9", "acceleration", 3000),
    ],
)
def test_a_command_changes_a_limit(line: bytes, name: str, value: object) -> None:
    after = apply_command(Limits(), line.split()[0].decode(), line)
    assert getattr(after, name) == pytest.approx(value)


def test_klipper_takes_the_lower_of_both() -> None:
    limits = Limits(model="klipper")
    assert apply_command(limits, "M204", b"M204 P900 T700").acceleration == 700
    assert apply_command(limits, "M204", b"M204 P900") == limits
    line = b"SET_VELOCITY_LIMIT ACCEL=5000 accel_to_decel=2000 SQUARE_CORNER_VELOCITY=8 VELOCITY=250"
    after = apply_command(limits, "SET_VELOCITY_LIMIT", line)
    assert (after.acceleration, after.travel_acceleration, after.square_corner_velocity) == (5000, 5000, 8)
    assert after.minimum_cruise_ratio == pytest.approx(0.6)
    assert after.feedrate[:2] == (250, 250)


@pytest.mark.parametrize(
    "line",
    [
        b"M204 S0",
        b"M204 P-1 T0",
        b"M201 X0 Y-5",
        b"M205 X-2",
        b"SET_VELOCITY_LIMIT ACCEL=0 VELOCITY=-1",
        b"SET_VELOCITY_LIMIT ACCEL=.. MINIMUM_CRUISE_RATIO=5",
        *ABSURD,
    ],
)
def test_commands_without_sense_change_nothing(line: bytes) -> None:
    assert apply_command(KLIPPER, line.split()[0].decode(), line) == KLIPPER
    assert apply_command(MARLIN, line.split()[0].decode(), line) == MARLIN


def test_settings_without_sense_are_left_out() -> None:
    text = (
        b"; machine_max_acceleration_x = -5\n; machine_max_jerk_x = nan\n; machine_max_acceleration_extruding = inf\n"
    )
    assert read_limits(b"", text + b"; filament_diameter = 0\n").limits == MARLIN
    assert read_limits(b"", text + b"; filament_diameter = 0\n").filament_diameter == 1.75


@pytest.mark.parametrize("value", ["1e-300", "1e-7", "1e300", "1e12"])
def test_settings_of_no_machine_are_left_out(value: str) -> None:
    names = [f"machine_max_{kind}_{axis}" for kind in ("feedrate", "acceleration", "jerk") for axis in "xyze"]
    names += [f"machine_max_acceleration_{kind}" for kind in ("extruding", "travel", "retracting")]
    names += ["machine_min_extruding_rate", "machine_min_travel_rate"]
    text = "".join(f"; {name} = {value},{value}\n" for name in names).encode()
    assert read_limits(b"", text).limits == MARLIN
    deviation = read_limits(b"", b"; machine_max_junction_deviation = 1e-300\n").limits
    assert deviation == MARLIN


@pytest.mark.parametrize(
    "head", [b"", b"; gcode_flavor = klipper\n", b";FLAVOR:Marlin\n;Generated with Cura_SteamEngine 5\n"]
)
def test_limits_of_no_machine_change_no_time(tmp_path: Path, head: bytes) -> None:
    lines = SQUARE.splitlines(keepends=True)
    absurd = b"".join(line + ABSURD[i % len(ABSURD)] + b"\n" for i, line in enumerate(lines))
    expected = motion(written(tmp_path, head + b"SET_VELOCITY_LIMIT\n" + SQUARE)).seconds
    assert motion(written(tmp_path, head + absurd)).seconds == pytest.approx(expected, rel=1e-12)


def test_a_command_does_not_raise_what_the_printer_allows() -> None:
    limits = Limits(highest_acceleration=800)
    assert apply_command(limits, "M204", b"M204 P5000 T5000").acceleration == 800
    assert apply_command(limits, "M204", b"M204 P5000 T5000").travel_acceleration == 5000


@pytest.mark.parametrize(
    "wrong",
    [
        {"model": "nonsense"},
        {"acceleration": 0},
        {"acceleration": math.inf},
        {"feedrate": (1, 1, -1, 1)},
        {"junction_deviation": math.nan},
        {"minimum_cruise_ratio": 1},
        {"acceleration": 1e-300},
        {"travel_acceleration": 1e10},
        {"feedrate": (1, 1, 1e-300, 1)},
        {"jerk": (1e-4, 1, 1, 1)},
        {"junction_deviation": 1e-7},
        {"minimum_cruise_ratio": -0.1},
    ],
)
def test_limits_out_of_range_are_errors(wrong: dict[str, Any]) -> None:
    with pytest.raises(ParameterError, match="give|;"):
        Limits(**wrong)


PRUSA = b"""; generated by PrusaSlicer 2.5.0 on 2026-11-22
; estimated printing time (normal mode) = 1d 2h 3m 4s
; filament_diameter = 2.85
; gcode_flavor = marlin
; machine_max_acceleration_e = 5000,1250
; machine_max_acceleration_extruding = 1250,960
; machine_max_acceleration_retracting = 1300
; machine_max_acceleration_travel = 1400
; machine_max_acceleration_x = 1000
; machine_max_feedrate_z = 12
; machine_max_jerk_e = 4.5
"""


def test_settings_are_found() -> None:
    found = read_limits(b"", PRUSA)
    assert (found.slicer, found.filament_diameter, found.estimate) == ("", 2.85, 93784)
    assert read_limits(PRUSA, b"").slicer == "PrusaSlicer 2.5.0"
    limits = found.limits
    assert (limits.model, limits.acceleration, limits.travel_acceleration) == ("jerk", 1250, 1250)
    assert read_limits(b"", PRUSA.replace(b"= marlin", b"= marlin2")).limits.travel_acceleration == 1400
    assert limits.axis_acceleration == (1000, 3000, 100, 5000)  # of y and z it says nothing
    assert limits.jerk == (10, 10, 0.3, 4.5)
    assert set(found.sources.values()) == {"settings"}
    assert found.after("M204", b"M204 P9000").limits.acceleration == 1250


def test_klipper_takes_what_the_settings_have() -> None:
    found = read_limits(b"", PRUSA.replace(b"= marlin", b"= klipper"))
    assert (found.limits.model, found.limits.acceleration, found.limits.square_corner_velocity) == ("klipper", 1250, 5)
    assert found.sources["square_corner_velocity"] == "assumed"
    assert found.after("M204", b"M204 S9000").limits.acceleration == 9000  # its own limits it keeps to itself


def test_settings_that_do_not_count_are_left_out() -> None:
    found = read_limits(b"", PRUSA + b"; machine_limits_usage = ignore\n")
    assert found.limits == MARLIN
    assert set(found.sources.values()) == {"assumed"}


@pytest.mark.parametrize(
    ("head", "limits"),
    [
        (b"; gcode_flavor = klipper\n", KLIPPER),
        (b"SET_VELOCITY_LIMIT ACCEL=3000\n", KLIPPER),
        (b";FLAVOR:Marlin\n;Generated with Cura_SteamEngine 5.4.0\n", CURA),
        (b"G28\n", MARLIN),
    ],
)
def test_what_is_assumed_is_said(head: bytes, limits: Limits) -> None:
    found = read_limits(head, b"")
    assert found.limits == limits
    assert set(found.sources.values()) == {"assumed"}


def test_a_junction_deviation_makes_the_model() -> None:
    assert read_limits(b"", b"; machine_max_junction_deviation = 0.02\n").limits.model == "junction"
    assert read_limits(b"", b"; machine_max_junction_deviation = 0\n").limits.model == "jerk"


def test_reprap_counts_in_minutes() -> None:
    found = read_limits(b"; gcode_flavor = reprapfirmware\n", b"").after("M203", b"M203 X12000 Y6000")
    assert found.limits.feedrate[:2] == (200, 100)


def test_commands_are_a_source_and_what_is_given_stays() -> None:
    found = read_limits(b"", b"", GivenLimits(fixed={"acceleration": 500.0}))
    for line in (b"M204 P900", b"M205 X12", b"M201 X900"):
        found = found.after(line[:4].decode(), line)
    assert found.limits.acceleration == 500
    expected = {"feedrate": "assumed", "axis_acceleration": "commands", "acceleration": "given", "jerk": "commands"}
    assert found.sources == expected


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        (b";TIME:6666\n;TIME_ELAPSED:12.5\n;TIME_ELAPSED:99.5\n", 99.5),
        (b";TIME:1234\n", 1234),
        (b"; model printing time: 1m 2s; total estimated time: 1h 6m 2s\n", 3962),
        (b"; nothing\n", None),
    ],
)
def test_estimates_are_found(text: bytes, seconds: float | None) -> None:
    assert read_limits(text, b"").estimate == seconds


# --- files -----------------------------------------------------------------------------------------------


def test_a_square_is_summed_up(tmp_path: Path) -> None:
    found = motion(written(tmp_path, SQUARE))
    assert (found.layers, found.retractions) == (1, 1)
    wall, fill = of(found, "external perimeter"), of(found, "sparse infill")
    assert (wall.name, wall.length, wall.filament, wall.paths, wall.segments, wall.turns) == (
        "External perimeter",
        pytest.approx(80),
        pytest.approx(4),
        1,
        4,
        3,
    )
    assert wall.turning == pytest.approx(270 / 80)
    assert wall.median_segment == pytest.approx(20, rel=0.006)  # half a bin
    assert (fill.paths, fill.retractions, fill.segments) == (1, 1, 3)
    assert fill.travel == pytest.approx(math.hypot(5, 5))
    assert fill.short_segments == pytest.approx(1 / 3)
    area = math.pi / 4 * 1.75**2
    assert fill.peak_flow == pytest.approx(area * 80 * 0.05)
    assert wall.peak_flow == pytest.approx(area * 50 / 20)
    assert found.seconds == pytest.approx(sum(each.seconds for each in found.features))
    # Four sides at 50 mm/s. Corners are passed at 8 mm/s, so a ramp takes 42 ms and (50² - 8²) / 2000 = 1.218 mm; the
    # last one goes down to 5 mm/s, the jerk of the filament that is drawn back next.
    ramps, along = 7 * 0.042 + 0.045, 7 * 1.218 + 1.2375
    assert wall.drawing_seconds == pytest.approx(ramps + (80 - along) / 50, rel=1e-9)
    assert of(found, "sparse infill").seconds == found.of_role("sparse infill")


def test_dwelling_counts_and_stops(tmp_path: Path) -> None:
    corner = b"G1 X0 Y0 F6000\nG1 X10\n%bG1 X20\n"
    through = motion(written(tmp_path, corner % b"")).seconds
    stopped = motion(written(tmp_path, corner % b"M400\n")).seconds
    dwelt = motion(written(tmp_path, corner % b"G4 P1500\nG4 S2\n")).seconds
    last = motion(written(tmp_path, corner % b"" + b"G4 S5\n")).seconds
    assert stopped > through
    assert dwelt == pytest.approx(stopped + 3.5)
    assert last == pytest.approx(through + 5)


def test_what_does_not_move_costs_nothing(tmp_path: Path) -> None:
    lines = SQUARE.replace(b"G1 Y20", b"M73 P5 R1\nM106 S255\nM117 busy\n;note\nG1 F3000\nG92 E0\nG1 Y20")
    assert motion(written(tmp_path, lines)).seconds == pytest.approx(motion(written(tmp_path, SQUARE)).seconds)


@pytest.mark.slow
def test_batches_change_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Read in pieces of a few lines, the same comes out: nothing is lost between them."""
    turn = np.cumsum(np.random.default_rng(3).normal(0, 0.7, 600))
    x, y = 50 + np.cumsum([np.cos(turn), np.sin(turn)], axis=1)
    names = [b";TYPE:Perimeter\n", b"G4 P20\n", b"G1 E-.8\n", b"G0 F9000\n", b";TYPE:Gap fill\n", b"", b"", b""]
    lines = [names[i % 8] + f"G1 X{x[i]:.3f} Y{y[i]:.3f}{' E.04' if i % 5 else ''}\n".encode() for i in range(600)]
    path = written(tmp_path, b"M83\nG1 X50 Y50 F4800\n" + b"".join(lines))
    whole = motion(path).to_dict()
    monkeypatch.setattr(timeline, "BATCH", 97)
    pieces = motion(path).to_dict()
    for name in ("seconds", "filament", "length", "travel", "retractions"):
        assert pieces[name] == pytest.approx(whole[name], rel=1e-9)
    for one, other in zip(whole["features"], pieces["features"], strict=True):
        assert list(one.values()) == [
            value if isinstance(value, str) else pytest.approx(value, rel=1e-9) for value in other.values()
        ]


def test_no_more_than_a_batch_waits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Memory does not grow with the file: what is not settled is a few moves of a batch."""
    lines = b"".join(b"G1 X%d Y%d E.04\n" % (i % 100, i % 7) for i in range(5000))
    path = written(tmp_path, b"M83\nG1 X0 Y0 F4800\n" + lines)
    monkeypatch.setattr(timeline, "BATCH", 4096)
    with path.open("rb") as file:
        longest = max(len(plan) for _, plan in Timeline(file))
    assert longest < 2 * 4096 / len(b"G1 X1 Y1 E.04\n")


def test_absolute_filament_is_the_same(tmp_path: Path) -> None:
    pushed = [float(word or b"0") for word in re.findall(rb"E(-?[\d.]+)", SQUARE.split(b"M83")[1])]
    absolute = iter(np.cumsum(pushed))
    head, body = SQUARE.split(b"M83")
    body = re.sub(rb"E-?[\d.]+", lambda _: b"E%.5f" % next(absolute), body)
    expected, found = motion(written(tmp_path, SQUARE)), motion(written(tmp_path, head + b"M82" + body))
    assert found.seconds == pytest.approx(expected.seconds, rel=1e-9)
    assert found.filament == pytest.approx(expected.filament, rel=1e-9)


def test_every_family_of_tags_gives_the_same(tmp_path: Path) -> None:
    expected = motion(written(tmp_path, SQUARE))
    for tags in ({b";TYPE:External perimeter": b"; FEATURE: Outer wall", b";TYPE:Internal infill": b"; FEATURE: Sparse infill", b";LAYER_CHANGE": b"; CHANGE_LAYER"},
                 {b";TYPE:External perimeter": b";TYPE:WALL-OUTER", b";TYPE:Internal infill": b";TYPE:FILL", b";LAYER_CHANGE": b";LAYER:0"}):  # fmt: skip
        text = SQUARE
        for one, other in tags.items():
            text = text.replace(one, other)
        found = motion(written(tmp_path, text))
        assert found.layers == expected.layers
        for role in ("external perimeter", "sparse infill"):
            assert of(found, role).seconds == of(expected, role).seconds


# --- arcs ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("clockwise", [False, True])
@pytest.mark.parametrize("degrees", [10.0, 90.0, 180.0, 359.0, 360.0])
def test_chords_lie_on_their_arc(degrees: float, clockwise: bool) -> None:
    turn = math.radians(-degrees if clockwise else degrees)
    start = np.array([[4.0, 2.0, 1.0]])
    centre = np.array([[1.0, 2.0]])
    end = np.array([[1 + 3 * math.cos(turn), 2 + 3 * math.sin(turn), 2.0]])
    arc, first, last = cut_chords(start, end, centre, np.array([clockwise]))
    assert (arc == 0).all()
    assert (first[1:] == last[:-1]).all()
    assert first[0].tolist() == start[0].tolist()
    assert last[-1].tolist() == end[0].tolist()
    assert np.hypot(*(last[:, :2] - centre).T) == pytest.approx(3)
    assert np.hypot(*(last - first)[:, :2].T).max() <= 1
    assert np.diff(last[:, 2]) == pytest.approx(1 / len(last))
    turned = np.unwrap(np.arctan2(*(last[:, 1::-1] - centre[:, ::-1]).T))
    assert turned[-1] - turned[0] == pytest.approx(turn * (1 - 1 / len(last)))


def test_arcs_are_driven(tmp_path: Path) -> None:
    """Half a circle of 10 mm, in place among moves: its filament and its length count, and it ends where it says."""
    text = b"M83\nG1 X0 Y0 F3000\n;TYPE:Perimeter\nG1 X10 E.5\nG3 X10 Y20 I0 J10 E1.5\nG1 X0 E.5\n"
    found = of(motion(written(tmp_path, text)), "perimeter")
    assert (found.paths, found.filament) == (1, pytest.approx(2.5))
    assert found.length == pytest.approx(20 + math.pi * 10, rel=1e-3)  # chords of 1 mm are 0.04 % short
    assert found.segments == 2 + 36  # 5 degrees each
    assert found.turning * found.length == pytest.approx(180, rel=1e-3)


# --- what is no G-code -----------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"GCDE\1\0\0\0", "binary G-code is cut off"),
        (b"PK\3\4....", "the archive cannot be read"),
        (b"", "is empty"),
        (b" \n\n", "is empty"),
        (b"\x89PNG\r\n\0\0", "is not text"),
        (b"import sys\nprint(1)\n", "has no moves"),
        (b"G28\nM104 S200\nG1 F300\n", "has no moves"),
        (b"G1 X{a} E1\nG1 X{b} E1\n", "no line that extrudes can be read: 2"),
    ],
)
def test_what_is_not_gcode_is_one_line(tmp_path: Path, content: bytes, says: str) -> None:
    path = written(tmp_path, content)
    with pytest.raises(FormatError, match=says):
        motion(path)
    result = run(path)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (1, "", 1)
    assert result.stderr.startswith(f"error: {path}: ")


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    for path, message in ((tmp_path / "nothing.gcode", "there is no file .*nothing.gcode"), (tmp_path, "cannot read")):
        with pytest.raises(FormatError, match=message):
            motion(path)


# --- what is given ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "model"),
    [
        ({"jerk": 5.0}, "jerk"),
        ({"junction_deviation": 0.02}, "junction"),
        ({"square_corner_velocity": 8.0}, "klipper"),
        ({"minimum_cruise_ratio": 0.0}, "klipper"),
        ({"acceleration": 4000.0}, "jerk"),
        ({"model": "vector-jerk"}, "vector-jerk"),
        ({"model": "junction-deviation"}, "junction"),
        ({"model": "junction"}, "junction"),
        ({"model": "klipper"}, "klipper"),
    ],
)
def test_what_is_given_holds(tmp_path: Path, given: dict[str, Any], model: str) -> None:
    found = motion(written(tmp_path, SQUARE), **given)
    assert found.limits["model"] == model
    name = next(iter(given))
    if name != "model":
        assert found.sources[name] == "given"
        assert found.limits[name] in (given[name], [given[name]] * 2 + [0.3, 5.0])
    assert found.seconds != motion(written(tmp_path, SQUARE)).seconds


def test_a_jerk_keeps_the_model_of_a_file_that_has_one(tmp_path: Path) -> None:
    for head, model in (
        (b";Generated with Cura_SteamEngine 5.4.0\n", "vector-jerk"),
        (b"; gcode_flavor = klipper\n", "jerk"),
    ):
        assert motion(written(tmp_path, head + SQUARE), jerk=5).limits["model"] == model


def test_limits_of_two_models_are_an_error(tmp_path: Path) -> None:
    with pytest.raises(
        ParameterError,
        match="jerk and square_corner_velocity belong|square_corner_velocity and jerk belong to 2 models, jerk, klipper; give model",
    ):
        motion(written(tmp_path, SQUARE), jerk=5, square_corner_velocity=5)


# --- the command -----------------------------------------------------------------------------------------


def test_one_file_is_told(tmp_path: Path) -> None:
    path = written(tmp_path, SQUARE)
    text = run(path).stdout
    assert "External perimeter" in text
    assert "acceleration 1000 mm/s² (commands)" in text
    told = json.loads(run(path, "--json", "--jerk", "6").stdout)
    assert told["file"] == str(path)
    assert told["limits"]["jerk"][:2] == [6, 6]
    assert {each.name for each in fields(Motion)} - {"source", "arguments"} | {"file"} == set(told)
    assert told["features"][1] == asdict(motion(path, jerk=6).features[1])


def test_two_files_are_compared(tmp_path: Path) -> None:
    paths = [written(tmp_path, SQUARE, "a.gcode"), written(tmp_path, SQUARE.replace(b"F4800", b"F9600"), "b.gcode")]
    text = run(*paths).stdout
    assert re.search(r"sparse infill +0:00:01 +0:00:01 +-\d", text), text
    assert re.search(r"external perimeter .*[+-]0.0%", text), text
    told = json.loads(run(*paths, "--json").stdout)["files"]
    assert [each["seconds"] for each in told] == [motion(path).seconds for path in paths]


@pytest.mark.slow
def test_a_layer_is_drawn(tmp_path: Path) -> None:
    path, plot = written(tmp_path, SQUARE), tmp_path / "speeds.png"
    assert "wrote" in run(path, path, "--plot", plot, "--layer", 1).stderr
    with Image.open(plot) as picture:
        assert picture.width > 1.7 * picture.height
        assert len(picture.getcolors(1 << 20)) > 20
    assert "exists" in run(path, "--plot", plot).stderr
    assert run(path, "--plot", plot, "--force").exit_code == 0
    assert "layers 1 to 1" in run(path, "--plot", plot, "--force", "--layer", 9).stderr
    assert ".png" in run(path, "--plot", tmp_path / "speeds.txt").stderr
    assert run(path, "--layer", 1).exit_code == 2


def test_the_seconds_of_every_layer_are_told_and_drawn(tmp_path: Path) -> None:
    """They sum up to the time from the first mark on; a layer at half the speed takes longer."""
    head, mark, body = SQUARE.partition(b";LAYER_CHANGE")
    slow = body.replace(b"F3000", b"F1500").replace(b"F4800", b"F2400")
    path = written(tmp_path, head + mark + body + mark + slow + mark + body)
    layers = motion(path).by_layer
    assert sum(layers.seconds) == pytest.approx(motion(path).seconds, abs=0.1)  # without the move to the start
    assert 1.3 * layers.seconds[0] < layers.seconds[1] < 2 * layers.seconds[0]  # and ramps take as long
    assert layers.filament == pytest.approx([4 + 0.7 + 0.002 + 0.5] * 3)
    assert layers.seconds_spread == pytest.approx(np.std(np.diff(layers.seconds)))
    assert layers.filament_spread == pytest.approx(0, abs=1e-9)
    assert re.search(r"layers +3, spread of \d", run(path).stdout)
    plot = tmp_path / "layers.png"
    assert f"wrote {plot}" in run(path, path, "--plot", f"layers={plot}").stderr
    with Image.open(plot) as picture:
        colours = {colour for _, colour in picture.convert("RGB").getcolors(1 << 20)}
    assert set(CURVES) <= colours
    assert "exists" in run(path, "--plot", f"layers={plot}").stderr
    assert "--layer" in run(path, "--plot", f"layers={plot}", "--force", "--layer", 1).stderr
    assert "no marked layers" in run(written(tmp_path, head + body, "b.gcode"), "--plot", f"layers={plot}x.png").stderr


@pytest.mark.parametrize("seconds", [[3.0], [0.0], [0.0, 0.0], [1e-3, 2e-3], [1e5] * 3])
def test_any_layers_have_a_picture(seconds: list[float]) -> None:
    assert draw_layer_times({"one": seconds, "two": seconds[:1]}).width > 100


def test_the_pieces_of_a_layer(tmp_path: Path) -> None:
    """They follow each other, no longer than a piece; at full speed in the middle, slow at corners, as ramps say."""
    layer = layer_speeds(written(tmp_path, SQUARE), 1)
    assert layer.start[1:] == pytest.approx(layer.end[:-1])
    long = np.linalg.norm(layer.end - layer.start, axis=1)
    assert long.max() <= PIECE_LENGTH * (1 + 1e-9)
    assert set(layer.role) == {"external perimeter", "sparse infill"}
    side = layer.draws & (layer.start[:, 1] == 0) & (layer.end[:, 1] == 0)
    middle = (layer.start[side, 0] + layer.end[side, 0]) / 2
    near = np.minimum(middle, 20 - middle)  # from 8 mm/s at both ends, with 1000 mm/s² up to 50 mm/s
    assert layer.speed[side] == pytest.approx(np.minimum(np.sqrt(64 + 2000 * near), 50))
    assert layer.draws.sum() > 200
    assert (~layer.draws).any()


@pytest.mark.parametrize("size", [(60, 20), (20, 60), (30, 0)])
def test_the_picture_of_a_layer_has_no_blank_bands(size: tuple[int, int]) -> None:
    """It is as high as the layer needs beside its width."""
    corners = np.array([(0, 0, 0), (size[0], 0, 0), (*size, 0), (0, size[1], 0), (0, 0, 0)], dtype=float)
    speed, draws = np.full(4, 50.0), np.ones(4, dtype=bool)
    layer = LayerSpeeds(start=corners[:-1], end=corners[1:], speed=speed, draws=draws, role=("infill",) * 4)
    panel = np.asarray(draw_speeds({"layer": layer}))[MARGIN + CAPTION : -BAR - MARGIN]
    inked = np.flatnonzero((panel != 255).any(axis=(1, 2)))
    blank = max(inked[0], len(panel) - 1 - inked[-1], int(np.diff(inked).max()) if size[1] == 0 else 0)
    assert blank <= max(0.03 * len(panel), LEAST_HEIGHT / 2)


def test_colours_tell_speeds_apart() -> None:
    assert len(np.unique(speed_colours(np.linspace(0, 1, 9), 1), axis=0)) == 9


# --- columns ---------------------------------------------------------------------------------------------


def test_columns_are_cut_and_joined(tmp_path: Path) -> None:
    (whole,) = [steps for steps, _ in Timeline(io.BytesIO(SQUARE)) if len(steps) > 3]
    again = concatenate_rows([slice_rows(whole, slice(2)), slice_rows(whole, slice(2, None))])
    assert np.array_equal(again.moves.delta, whole.moves.delta)
    assert np.array_equal(again.feature, whole.feature)


def test_every_limiting_code_does_something() -> None:
    words = {"M204": "S1", "M205": "X1", "SET_VELOCITY_LIMIT": "ACCEL=1"}
    for code in LIMITING_CODES - {"RESET_VELOCITY_LIMIT"}:  # which takes the others back
        line = f"{code} {words.get(code, 'X1')}".encode()
        assert apply_command(Limits(), code, line) != Limits()


# --- the slicers' own estimates --------------------------------------------------------------------------

CONTROLLED = {"acceleration_enabled": "true", "jerk_enabled": "true", "acceleration_infill": 1000, "jerk_infill": 8}


@pytest.mark.slow
@needs_prusa
@pytest.mark.parametrize(
    "settings",
    [
        {"fill_pattern": "gyroid"},
        {"fill_pattern": "honeycomb", **FAST},
        {"fill_pattern": "rectilinear", "use_relative_e_distances": 0, "layer_gcode": ""},
        {
            "fill_pattern": "stars",
            "machine_limits_usage": "time_estimate_only",
            "machine_max_acceleration_extruding": 500,
        },
    ],
    ids=["gyroid", "fast honeycomb", "absolute", "limits in the settings only"],
)
def test_prusaslicer_estimates_the_same(tmp_path: Path, settings: dict[str, object]) -> None:
    """Within 1 %: it looks ahead over some dozens of moves only, and in float32."""
    path = prusa_print(box(tmp_path, (20, 20, 4)), tmp_path / "print.gcode", settings)
    found = motion(path)
    assert found.estimate is not None
    assert found.seconds == pytest.approx(found.estimate, rel=0.01)
    assert found.slicer.startswith("PrusaSlicer 2")
    assert "assumed" not in found.sources.values()
    used = re.search(rb"; filament used \[mm\] = ([\d.]+)", path.read_bytes())
    assert used is not None
    # Five digits of every move, and 0.1 mm that the slicer counts once more or less for the last retraction.
    assert found.filament == pytest.approx(float(used[1]), abs=0.1)
    assert found.layers == 20


@pytest.mark.slow
@needs_cura
@pytest.mark.parametrize(("pattern", "settings"), [("gyroid", {}), ("cross", CONTROLLED)], ids=["gyroid", "controlled"])
def test_curaengine_estimates_the_same(tmp_path: Path, pattern: str, settings: dict[str, object]) -> None:
    """Within 1 %, what it assumes of its machine included."""
    found = motion(
        cura_print(box(tmp_path, (20, 20, 4)), tmp_path / "print.gcode", {"infill_pattern": pattern, **settings})
    )
    assert found.estimate is not None
    assert found.seconds == pytest.approx(found.estimate, rel=0.01)
    assert found.slicer.startswith("Cura_SteamEngine")
    assert found.limits["model"] == "vector-jerk"
    assert found.sources["acceleration"] == ("commands" if settings else "assumed")


def test_it_is_public() -> None:
    assert infill.motion is motion


@pytest.mark.parametrize("suffix", MESHES)
@pytest.mark.parametrize("text", [True, False])
def test_a_mesh_in_the_place_of_a_print_is_recognised(suffix: str, text: bool, tmp_path: Path) -> None:
    """By its name, once it is certain that it holds no print; the commands for meshes are named."""
    path = tmp_path / f"part{suffix}"
    path.write_bytes(b"solid part\nfacet\n" if text else bytes(200))
    for command in (["motion", path], ["refill", path, "-o", tmp_path / "out.gcode"]):
        one_line_error(
            run_infill(*command), "is named like a mesh, and is not a sliced print; slice it first, or infill fill"
        )


def test_the_suffixes_of_meshes_are_those_that_are_read() -> None:
    assert set(MESHES) == set(READERS)
