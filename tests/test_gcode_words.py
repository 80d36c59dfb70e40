"""Every move that firmware obeys is planned, or counted: dialects of words, arcs, extruders, commands."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from infill import FormatError, Motion, motion, refill
from infill.cli.app import build_app
from infill.cli.timing import format_length
from infill.gcode.found_limits import read_limits
from infill.gcode.limits import Limits, apply_command
from infill.gcode.lines import MOVE
from infill.gcode.machine_state import MachineState
from infill.gcode.table import read_table
from infill.gcode.unusual_moves import is_macro, may_move, read_move
from tests.handmade_prints import Dialect, written

HEAD = "; gcode_flavor = marlin\nG90\nM83\nG21\nG1 X50 Y50 Z0.2 F600\n"
TURN = 2 * math.pi * 10  # mm

LAID = {  # what follows the head, and the mm that it lays; firmware obeys all of it
    "plain": ("G1 X70 Y50 E1\nG1 X70 Y60 E1\n", 30),
    "no blanks": ("G1X70Y50E1\nG1X70Y60E1\n", 30),
    "a capital exponent is a word": ("G1 X70 Y50E1\nG1 X70 Y60 E1\n", 30),
    "numbers and checksums": ("N1G1X70Y50E1*12\nN2 g1 x70 y60 e1*5\n", 30),
    "small letters": ("g1 x70 y50 e1\ng1x70y60e1\n", 30),
    "blanks before numbers": ("G1 X  70 Y\t50 E   1\nG1 X70 Y60 E1\n", 30),
    "deep in a block": (" " * 20 + "G1 X70 Y50 E1\nG1 X70 Y60 E1\n", 30),
    "remarks in brackets": ("G1 (a) X70 (X9) Y50 E1 (b) ; c\nG1 X70 Y60 E1\n", 30),
    "an endstop": ("G1 X70 Y50 E1 H2\nG1 X70 Y60 E1\n", 30),
    "a laser": ("G1 X70 Y50 E1 S1\nG1 X70 Y60 E1\n", 30),
    "a fourth axis": ("G1 X70 Y50 U1 V2 W3 C4 D5 E1\nG1 X70 Y60 E1\n", 30),
    "several extruders at once": ("G1 X70 Y50 E.5:.5\nG1 X70 Y60 E1\n", 30),
    "many digits": ("G1 X70.00000000000000001 Y50 E1\nG1 X70 Y60 E1\n", 30),
    "MakerBot's extruders": ("M135 T0\nG92 A0 B0\nG1 X70 Y50 A1\nG1 X90 A2\n", 40),
    "MakerBot's second extruder": ("M135 T1\nG92 A0 B0\nG1 X70 Y50 B1\nG1 X90 B2\n", 40),
    "inches": ("G20\nG1 X2 Y2 E1\nG1 X3 E.1\nG21\nG1 X70 E.1\n", math.hypot(0.8, 0.8) + 25.4 + 6.2),
    "relative": ("G91\nG1 X20 E1\nG1 Y10 E1\nG90\nG1 X50 Y60 E1\n", 50),
    "modes put aside": ("SAVE_GCODE_STATE NAME=a\nG91\nG1 X20 E1\nRESTORE_GCODE_STATE NAME=a\nG1 X80 Y50 E1\n", 30),
    "modes pushed": ("M120\nG91\nG1 X20 E1\nM121\nG1 X80 Y50 E1\n", 30),
    "an arc": ("G2 X70 Y50 I10 J0 E1\n", TURN / 2),
    "an arc without blanks": ("G2X70Y50I10J0E1\n", TURN / 2),
    "an arc by its radius": ("G2 X70 Y50 R10 E1\n", TURN / 2),
    "a long arc by its radius": ("G3 X60 Y60 R-10 E1\n", TURN * 3 / 4),
    "a short arc by its radius": ("G2 X60 Y60 R10 E1\n", TURN / 4),
    "turns": ("G2 I10 J0 P2 E1\n", TURN * 2),
    "one turn": ("G2 I10 J0 P1 E1\n", TURN),
    "no end": ("G3 I10 J0 E1\n", TURN),
    "across y": ("G18\nG2 X70 Z0.2 I10 K0 E1\nG17\n", TURN / 2),
    "across x": ("G19\nG2 Y70 Z0.2 J10 K0 E1\nG17\n", TURN / 2),
    "across y, a quarter": ("G18\nG2 X60 Z10.2 I0 K10 E1\nG17\n", TURN / 4),
    "a helix": ("G2 X70 Y50 Z5.2 I10 J0 E1\n", math.hypot(TURN / 2, 5)),
    "another origin": ("G92 X0 Y0\nG2 X20 Y0 I10 J0 E1\n", TURN / 2),
    "an arc in inches": ("G20\nG2 I.5 E1\n", 2 * math.pi * 12.7),
}


def of(folder: Path, text: str, head: str = HEAD, **given: Any) -> Motion:
    path = folder / "print.gcode"
    path.write_text(head + text)
    return motion(path, **given)


@pytest.mark.slow
@pytest.mark.parametrize("name", LAID)
def test_what_firmware_obeys_is_planned(name: str, tmp_path: Path) -> None:
    text, length = LAID[name]
    found = of(tmp_path, text)
    assert found.length == pytest.approx(length, abs=1e-3)  # a chord is as long as its arc, to the sag of a helix
    assert found.unread_lines == 0
    assert found.travel == pytest.approx(50 * math.sqrt(2) if "Z0.2" not in HEAD else math.hypot(50, 50, 0.2))
    assert all(each.seconds > 0 for each in found.features)


COUNTED = {  # what cannot be planned, though it may move or extrude
    "an expression": "G1 X{a} Y50 E1",
    "an exponent": "G1 X70 Y50 E1e-2",
    "a small exponent": "G1 X7e1 Y50",
    "a capital exponent": "G1 X7E+01 Y50",
    "a word twice": "G1 X70 X71 E1",
    "a word that is not known": "G1 X70 Q1 E1",
    "a number that is none": "G1 X70 Y5.0.1 E1",
    "a comma": "G1 X70,5 E1",
    "an open bracket": "G1 X70 (Y50 E1",
    "a fourth axis alone": "G1 U20",
    "an arc without a centre": "G2 X70 Y50 E1",
    "an arc of radius 0": "G2 X70 Y50 R0 E1",
    "an arc around its own beginning": "G2 X70 Y50 I0 J0 E1",
    "an arc by radius to nowhere": "G2 R10 E1",
    "centres of arcs that are no offsets": "G90.1",
    "a spline": "G5 X70 Y50 I1 J2 P3 Q4 E1",
    "steps": "G6 X70",
    "a place that was saved": "G61 X Y",
    "a move behind a mode": "G53 G1 X70 E1",
    "a move behind another mode": "N4 G90 G1 X70",
    "a move without its code": "X70 Y50 E1",
    "a blank in the code": "G 1 X70 E1",
    "another workspace": "G55",
    "a forced move": "FORCE_MOVE STEPPER=extruder DISTANCE=9",
    "a code with a point": "G1.1 X70",
    "a block that a switch skips": "/G1 X70 E1",
    "a block of a group that a switch skips": "/2 G1 X70 E1",
    "a block that a switch skips, numbered": "/N5 G1 X70 E1",
    "a numbered block that a switch skips": "N5 / G1 X70 E1",
    "a mode that a switch skips": "/M83",
    "a counter that a switch skips": "/ G92 E0",
    "a tool that a switch skips": "/T1",
    "a remark before a move": "(go) G1 X70 E1",
    "remarks before a move": "N4 (to) (a wall) G01X70E1",
    "what is no word before a move": "> G1 X70 E1",
    "another end of line within a comment": "; go\rG1 X70 E1",
    "another end of line within a command": "M107\rG1 X70 E1",
    "another end of line between moves": "G1 X70\rG1 X80 E1",
}


@pytest.mark.long
@pytest.mark.parametrize("name", COUNTED)
def test_what_cannot_be_planned_is_counted(name: str, tmp_path: Path) -> None:
    found = of(tmp_path, f"G1 X60 E1\n{COUNTED[name]}\n;\n{COUNTED[name]}\nG1 X50 Y50 E1\n")
    assert (found.unread_lines, found.first_unread_line) == (2, HEAD.count("\n") + 2)
    assert found.first_unread_text == COUNTED[name]
    result = CliRunner().invoke(build_app(), ["motion", str(tmp_path / "print.gcode")])
    assert result.exit_code == 0
    assert f"left out 2 lines that may move or extrude, first at line {HEAD.count(chr(10)) + 2}" in result.stdout
    result = CliRunner().invoke(build_app(), ["motion", str(tmp_path / "print.gcode"), "--json"])
    assert json.loads(result.stdout)["unread_lines"] == 2


def test_an_arc_whose_radius_does_not_reach_its_end_is_counted(tmp_path: Path) -> None:
    """Of 20 mm with a radius of 9; in the plane of x and z, too. One of 10 reaches."""
    found = of(tmp_path, "G2 X70 Y50 R9 E1\nG18\nG2 X70 Z20.2 R9 E1\nG17\nG2 X70 Y70 R10 E1\n")
    assert (found.unread_lines, found.first_unread_line) == (2, HEAD.count("\n") + 1)
    assert found.length == pytest.approx(TURN / 2, rel=1e-6)
    table = read_table(b"M83\nG1 X0 Y0 Z0\nG2 X20 Y0 R9 E1\nG2 X40 Y0 R10 E1\n", MachineState())
    assert table.extruded.tolist() == [0, 0, 0, 1]


@pytest.mark.parametrize("line", ["G1 X{a} E1", "G2 X70 Y50 E1", "M101", "G5 X9 Y9 P1 Q1 E1", "X70 E1"])
def test_a_file_of_which_nothing_that_extrudes_can_be_read_is_an_error(line: str, tmp_path: Path) -> None:
    with pytest.raises(
        FormatError, match="no line that extrudes can be read: 1 are not understood, the first is line 5"
    ):
        of(tmp_path, f"{line}\nG1 X90\n", head=HEAD.replace("M83\n", ""))
    assert of(tmp_path, "G1 X90\n").unread_lines == 0  # a mill's, say


QUIET = (
    "G29",
    "G4 P5",
    "M117 G1 X5 E5",
    "M118 go G1 X1",
    "G1 F900",
    "G1",
    "; G1 X{a}",
    "M600",
    "T1",
    "M204 S500",
    "G17",
    "G54",
)
QUIET += ("(G1 X5)", "; /G1 X5", "/", "//", "/ (G1 X5)", "/; G1 X5", "M117 /G1 X5", "%O1", "M107\r", "M107\r\r")
QUIET += ("EXCLUDE_OBJECT_START NAME=g1_x5", "SET_PRESSURE_ADVANCE ADVANCE=0.1", "M106 S255", "G92 E0", "G10", "%", "")


@pytest.mark.slow
@pytest.mark.parametrize("line", QUIET)
def test_what_moves_nothing_is_not_counted(line: str, tmp_path: Path) -> None:
    assert of(tmp_path, f"G1 X70 E1\n{line}\nG1 X90 E1\n").unread_lines == 0
    code = read_table(line.encode() + b"\n", MachineState()).commands
    assert not any(may_move(each.code, line.encode()) or is_macro(each.code) for each in code)


def test_macros_are_named(tmp_path: Path) -> None:
    found = of(tmp_path, "print_start EXTRUDER=200\nG1 X70 E1\nPRINT_START\nEND_PRINT\n")
    assert found.macros == ("PRINT_START", "END_PRINT")
    result = CliRunner().invoke(build_app(), ["motion", str(tmp_path / "print.gcode")])
    assert "PRINT_START, END_PRINT: what the printer does there is not known" in result.stdout


@pytest.mark.longest
@settings(max_examples=80)
@given(
    st.dictionaries(st.sampled_from("XYZEF"), st.integers(-4000, 4000).map(lambda value: value / 8), min_size=1),
    st.data(),
)
def test_however_a_move_is_spelled_it_is_the_same(words: dict[str, float], data: st.DataObject) -> None:
    """Blanks, small letters, line numbers, remarks and words that change nothing: read by the line or many at a time."""
    plain = read_table(
        ("G1" + "".join(f" {letter}{value:g}" for letter, value in words.items()) + "\n").encode(), MachineState()
    )
    text = data.draw(st.sampled_from(["", " ", "N7 ", "N12", "\t" * 12])) + data.draw(
        st.sampled_from(["G1", "g01", "G1 "])
    )
    for letter, value in words.items():
        text += data.draw(
            st.sampled_from(["", " ", "  ", " (go) ", " H1 ", " s0 "])
            if "H1" not in text and "s0" not in text
            else st.just(" ")
        )
        text += letter + data.draw(st.sampled_from(["", " ", "   "])) + f"{value:.3f}"
    text += data.draw(st.sampled_from(["", " ; X1", "(Y2)", "*71", " *7", "\r"]))
    table = read_table(text.encode() + b"\n", MachineState())
    assert not table.unread.any(), text
    for name in ("x", "y", "z", "e", "f"):
        assert getattr(table.after, name) == pytest.approx(getattr(plain.after, name), nan_ok=True), text
    found = read_move(text.encode())
    assert found == (1, pytest.approx(words))


def test_a_file_is_read_alike_by_both_readers() -> None:
    text = written(Dialect(arcs=True))
    careful = text.replace(b"G1 X", b"G1 H0 X").replace(b"G2 X", b"G2 H0 X").replace(b"G3 X", b"G3 H0 X")
    quick, slow = read_table(text, MachineState()), read_table(careful, MachineState())
    assert (quick.kind == MOVE).sum() > 2 * (slow.kind == MOVE).sum()
    for name in ("x", "y", "z", "e", "f", "extruded"):
        assert getattr(quick, name).tolist() == pytest.approx(getattr(slow, name).tolist(), nan_ok=True)


# Commands.


@pytest.mark.parametrize(
    "spelled", ["M204 P700", "M204P700", "m204 p700", "N12 M204 P700*34", "N12M204P700", "  M204 P 700 ; P9"]
)
def test_a_limit_is_read_however_it_is_spelled(spelled: str, tmp_path: Path) -> None:
    assert of(tmp_path, f"{spelled}\nG1 X70 E1\n").limits["acceleration"] == 700


@pytest.mark.parametrize(
    "spelled",
    [
        "SET_VELOCITY_LIMIT ACCEL=1500",
        "set_velocity_limit accel=1500",
        'N12 SET_VELOCITY_LIMIT ACCEL="1500"*34',
        "SET_VELOCITY_LIMIT ACCEL = 1.5e3 ; ACCEL=9",
    ],
)
def test_klippers_limits_are_read_and_taken_back(spelled: str, tmp_path: Path) -> None:
    found = of(tmp_path, f"{spelled}\nG1 X70 E1\n", head="; gcode_flavor = klipper\nM83\n")
    assert (found.limits["acceleration"], found.sources["acceleration"]) == (1500, "commands")
    found = of(tmp_path, f"{spelled}\nG1 X70 E1\nRESET_VELOCITY_LIMIT\n", head="; gcode_flavor = klipper\nM83\n")
    assert (found.limits["acceleration"], found.sources["acceleration"]) == (3000, "assumed")


def test_firmwares_mean_other_things_by_the_same_codes() -> None:
    assert apply_command(Limits(), "M204", b"M204 X7 Y2 P900", firmware="repetier") == Limits()  # a heater's constants
    assert apply_command(Limits(), "M205", b"M205 X0.02", firmware="smoothie").junction_deviation == 0.02
    assert read_limits(b"; gcode_flavor = smoothie\n", b"").limits.model == "junction"
    for head in (b"M566 X600\nM203 X12000\n", b"M203 X30000 Y30000 Z900\n"):
        assert read_limits(head, b"").feedrate_unit == 1 / 60
    assert read_limits(b"M203 X500 Y500 Z12\n", b"").feedrate_unit == 1


def test_feed_rate_and_flow_are_scaled(tmp_path: Path) -> None:
    lines = "G1 X60 E1 F600\nG1 X90 E3\n"
    plain = of(tmp_path, lines)
    fast = of(tmp_path, "M220 S200\n" + lines + "M220 S100\n")
    assert fast.features[0].drawing_seconds == pytest.approx(plain.features[0].drawing_seconds / 2, rel=0.02)  # ramps
    kept = of(tmp_path, "M220 B\nM220 S50\nM220 R\n" + lines)
    assert kept.seconds == plain.seconds
    assert of(tmp_path, "M221 S50\n" + lines).filament == pytest.approx(plain.filament / 2)
    assert of(tmp_path, "M221 T1 S50\n" + lines).filament == plain.filament
    assert of(tmp_path, "M221 T1 S50\nT1\n" + lines).filament == pytest.approx(plain.filament / 2)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lines", "count"),
    [
        ("G10\nG1 X70\nG11\n", 1),
        ("G10\nG10\nG11\n", 1),
        ("G10\nG11\nG10\n", 2),
        ("G10 P0 S200\n", 0),
        ("G10 S1\nG1 X70\nG11\n", 1),  # Marlin's long one
        ("G10 S0\nG1 X70\nG11\n", 1),
        ("G10 S\nG1 X70\nG11\n", 1),
        ("G10 S1 ; before a change of tools\nG11\n", 1),
        ("G10 S200\n", 0),  # a temperature
        ("G10 R150\n", 0),
        ("G10 P1 S1\n", 0),
        ("G10 P1 X5 Y2 Z0\n", 0),  # offsets of a tool
        ("G10 X5\n", 0),
        ("G10 L2 P1 X0 Y0\n", 0),  # an origin
        ("G10 L20 P1 X0\n", 0),
        ("G1 E-1\nG1 E1\nG10\n", 2),
    ],
)
def test_firmware_retractions_count(lines: str, count: int, tmp_path: Path) -> None:
    for tail in ("", "G1 X99 E1\n"):
        found = of(tmp_path, f"G1 X60 E1\n{lines}{tail}")
        assert found.retractions == count
        assert sum(each.retractions for each in found.features) == count


def test_a_temperature_of_reprapfirmware_is_no_retraction(tmp_path: Path) -> None:
    head = HEAD.replace("marlin", "reprapfirmware")
    assert of(tmp_path, "G1 X60 E1\nG10 S1\nG1 X70 E1\n", head).retractions == 0
    assert of(tmp_path, "G1 X60 E1\nG10\nG1 X70 E1\n", head).retractions == 1


# By the pages of each firmware: mm of filament that "G1 X60 E5, G1 X80 E6" push behind some modes and G92 E4.
RELATIVE, ABSOLUTE = 11.0, 2.0
MODES = {  # Marlin, Klipper, RepRapFirmware
    "G90 M82": (ABSOLUTE, ABSOLUTE, ABSOLUTE),
    "G90 M83": (RELATIVE, RELATIVE, RELATIVE),
    "M83 G90": (RELATIVE, RELATIVE, RELATIVE),
    "M82 G90": (ABSOLUTE, ABSOLUTE, ABSOLUTE),
    "G91 G90": (ABSOLUTE, ABSOLUTE, ABSOLUTE),
    "M82 G91": (RELATIVE, RELATIVE, ABSOLUTE),
    "G91 M82": (ABSOLUTE, RELATIVE, ABSOLUTE),
    "G91 M83": (RELATIVE, RELATIVE, RELATIVE),
    "G91 M83 M82": (ABSOLUTE, RELATIVE, ABSOLUTE),
    "G91 M82 M83": (RELATIVE, RELATIVE, RELATIVE),
    "G91 M82 G91": (RELATIVE, RELATIVE, ABSOLUTE),
    "G91 M82 G90": (ABSOLUTE, ABSOLUTE, ABSOLUTE),
    "M83 G91 M82 G90": (ABSOLUTE, ABSOLUTE, ABSOLUTE),
    "M83 G91 G90": (RELATIVE, RELATIVE, RELATIVE),
    "G91 M82 M120 M83 M121": (ABSOLUTE, RELATIVE, ABSOLUTE),
}


@pytest.mark.slow
@pytest.mark.parametrize("modes", MODES)
@pytest.mark.parametrize(("at", "flavour"), list(enumerate(["marlin", "klipper", "reprapfirmware"])))
def test_whether_e_counts_from_the_last_move(modes: str, at: int, flavour: str, tmp_path: Path) -> None:
    head = f"; gcode_flavor = {flavour}\nG1 X50 Y50 Z0.2 F600\n"
    moves = "G92 E4\nG1 X60 E5\nG1 X80 E6\n"  # both move, whatever X means
    found = of(tmp_path, "\n".join(modes.split()) + "\n" + moves, head)
    assert found.filament == pytest.approx(MODES[modes][at])
    by_letters = moves.replace("E4", "A4 B0").replace("E", "A")  # as MakerBot has it
    found = of(tmp_path, "\n".join(modes.split()) + "\n" + by_letters, head)
    if "M120" not in modes:
        assert found.filament == pytest.approx(MODES[modes][at])


def test_klipper_is_known_by_its_commands(tmp_path: Path) -> None:
    text = "G91\nM82\nG92 E4\nG1 X10 E5\nG1 X10 E6\n"
    assert of(tmp_path, text, "G1 X50 Y50 F600\n").filament == ABSOLUTE
    assert of(tmp_path, text, "SET_VELOCITY_LIMIT ACCEL=900\nG1 X50 Y50 F600\n").filament == RELATIVE


@pytest.mark.slow
@pytest.mark.parametrize("command", ["motion", "refill"])
def test_lines_that_end_with_cr_alone_are_told(command: str, tmp_path: Path) -> None:
    old = written(Dialect())
    path, new = tmp_path / "mac.gcode", tmp_path / "new.gcode"
    path.write_bytes(old.replace(b"\n", b"\r"))
    output = [] if command == "motion" else ["-o", str(new)]
    result = CliRunner().invoke(build_app(), [command, str(path), *output])
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (1, "", 1)
    assert f"{path}: its lines end with CR alone" in result.stderr
    assert not new.exists()
    path.write_bytes(path.read_bytes().replace(b"\r", b"\n"))  # the remedy
    assert CliRunner().invoke(build_app(), [command, str(path), *output]).exit_code == 0


@given(st.floats(0, 1e7))
def test_a_length_is_told_to_a_hundredth_or_to_what_it_is_printed_to(mm: float) -> None:
    for decimals in (1, 2):
        number, unit = format_length(mm, decimals).split()
        assert float(number) * {"mm": 1, "m": 1000}[unit] == pytest.approx(mm, rel=0.06, abs=0.051)
        assert unit == ("mm" if mm < 10 ** (4 - decimals) else "m")


# Refill.


@pytest.mark.parametrize(
    "line", ["/G1 X40 Y9 E1", "(go) G1 X40 Y9 E1", "G5 X40 Y9 I1 J1 P1 Q1", "; go\rG1 X40 Y9", "X40 E1"]
)
def test_where_the_nozzle_is_behind_what_may_move_it_is_not_known(line: str) -> None:
    """Before x and y are both said again, nothing begins that could be drawn anew."""
    text = f"M83\n;TYPE:FILL\nG1 X10 Y0 E1 F900\n{line}\nG1 X20 E1\nG1 Y20 E1\nG1 X30 E1\n"
    table = read_table(text.encode(), MachineState())
    assert table.unread.tolist() == [False, False, False, True, False, False, False]
    assert table.unsure.tolist() == [False, False, False, False, True, True, False]


@pytest.mark.slow
def test_infill_beside_lines_that_cannot_be_read_stays(tmp_path: Path) -> None:
    """What follows such a line begins nobody knows where: not before x and y are said again is anything drawn anew."""
    text = b"M83\n;TYPE:FILL\nG1 X10 Y0 E1 F900\nG1 X{a} Y9 E1\nG1 X20 E1\nG1 Y20 E1\nG1 X30 E1\n"
    table = read_table(text, MachineState())
    assert table.unsure.tolist() == [False, False, False, False, True, True, False]
    old = written(Dialect())
    marked = old.replace(b"G1 X1", b"G1 Q1 X1", 3)
    assert marked != old
    path = tmp_path / "print.gcode"
    path.write_bytes(marked)
    report = refill(path, output=tmp_path / "new.gcode").report
    assert report["print"]["unread_lines"] == motion(path).unread_lines == 3
    assert any("3 lines that may move or extrude cannot be read" in each for each in report["problems"])
    assert (tmp_path / "new.gcode").read_bytes().count(b"G1 Q1 X1") == 3


# --- places where no machine is --------------------------------------------------------------------------


@pytest.mark.parametrize("word", ["Y2147483647", "X-2147483649.5", "Z1000000", "X100000.001"])
@pytest.mark.parametrize("begin", ["G1 ", "G0", "g1 "])
def test_a_place_beyond_every_machine_is_counted_and_draws_nothing(word: str, begin: str) -> None:
    """Sampled along such a move, a wall would fill the memory."""
    axis = word[0].lower() if begin.islower() else word[0]
    table = read_table(
        f"G1 X1 Y2 F600\n{begin}{axis}{word[1:]} E1\nG1 X3 Y2 E1\n".encode(), MachineState(relative_e=True)
    )
    assert table.unread.tolist() == [False, True, False]
    assert table.x[2] == 3


def test_the_farthest_place_is_a_place() -> None:
    table = read_table(b"G1 X100000 Y-100000 E1\n", MachineState())
    assert table.x.tolist() == [100_000]
    assert not table.unread.any()
