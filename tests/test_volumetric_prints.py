"""Files whose E words are mm³: the same print, however it is counted, takes the same filament, flow and time."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import pytest

from infill import motion, refill
from infill.gcode.machine_state import MachineState, apply_m200
from infill.gcode.table import read_table
from infill.refilling.layers import Layers, read_layers
from tests.handmade_prints import Dialect, written

AREA = math.pi / 4 * 1.75**2  # mm²


def volumetric(text: bytes, area: float = AREA) -> bytes:
    """Return a print with relative E in mm³, F of filament alone as it was."""
    return re.sub(rb"(?m)(?<= E)-?[\d.]+", lambda word: b"%.5f" % (float(word[0]) * area), text)


LINEAR = written(Dialect(slicer="prusa", progress=""))
CURA = written(Dialect(slicer="cura", progress=""))
TELLING = {  # how programs say it
    "a setting": (LINEAR, lambda text: text + b"; use_volumetric_e = 1\n"),
    "M200": (LINEAR, lambda text: b"M200 D1.75\n" + text),
    "M200 without blanks": (LINEAR, lambda text: b"N1 m200d1.75 s1*7\n" + text),
    "M200 S": (LINEAR, lambda text: b"M200 S1\n" + text),
    "M200 of a tool": (LINEAR, lambda text: b"M200 T0 D1.75\nM200 T1 D2.85\n" + text),
    "M200 after a limit": (LINEAR, lambda text: b"M200 D1.75\nM200 L20\n" + text),
    "UltiGCode": (CURA, lambda text: re.sub(rb"(?m)^;FLAVOR:.*$", b";FLAVOR:UltiGCode", text)),
    "Marlin(Volumetric)": (CURA, lambda text: re.sub(rb"(?m)^;FLAVOR:.*$", b";FLAVOR:Marlin(Volumetric)", text)),
}


@pytest.mark.long
@pytest.mark.parametrize("name", TELLING)
def test_the_same_print_in_other_units_is_the_same(name: str, tmp_path: Path) -> None:
    linear, telling = TELLING[name]
    (tmp_path / "linear.gcode").write_bytes(linear)
    text = telling(volumetric(linear))
    assert b"FLAVOR" in text or linear is LINEAR
    (tmp_path / "volumetric.gcode").write_bytes(text)
    one, other = motion(tmp_path / "linear.gcode"), motion(tmp_path / "volumetric.gcode")
    assert other.volumetric
    assert not one.volumetric
    assert other.filament_diameter == 1.75
    assert other.filament == pytest.approx(one.filament, rel=1e-4)  # words are rounded to 1e-5
    assert other.seconds == pytest.approx(one.seconds, rel=1e-3)
    for mine, theirs in zip(one.features, other.features, strict=True):
        assert theirs.peak_flow == pytest.approx(mine.peak_flow, rel=1e-2)  # lines of 0.1 mm push 0.003 mm

    reports = [
        refill(tmp_path / f"{each}.gcode", output=tmp_path / f"{each}.new.gcode").report
        for each in ("linear", "volumetric")
    ]
    stated, told = ({key: value for key, value in each["filament"].items() if value is not None} for each in reports)
    assert told == pytest.approx(stated, rel=1e-3)  # every key, shares too
    assert {"infill_before_mm", "infill_after_mm", "print_before_mm", "ratio_with_density_same"} <= stated.keys()
    for section in ("contact", "time"):
        plain = {key: value for key, value in reports[0][section].items() if value is not None}
        assert {key: reports[1][section][key] for key in plain} == pytest.approx(plain, rel=5e-3)
    assert reports[1]["sections"] == reports[0]["sections"]
    assert reports[0]["sections"]["replaced"] > 0
    # E words stay mm³: what the new file takes agrees with the report.
    again = motion(tmp_path / "volumetric.new.gcode")
    change = reports[1]["filament"]["infill_after_mm"] - reports[1]["filament"]["infill_before_mm"]
    assert again.filament - other.filament == pytest.approx(change, abs=0.01)
    assert again.seconds == pytest.approx(motion(tmp_path / "linear.new.gcode").seconds, rel=1e-3)


@pytest.mark.parametrize("line", ["M200 D0", "M200 S0", "M200 L5", "; M200 D1.75", "; use_volumetric_e = 0"])
def test_what_is_counted_in_mm_stays_so(line: str, tmp_path: Path) -> None:
    (tmp_path / "one.gcode").write_bytes(LINEAR)
    (tmp_path / "other.gcode").write_bytes(line.encode() + b"\n" + LINEAR)
    assert motion(tmp_path / "other.gcode").filament == motion(tmp_path / "one.gcode").filament


def test_each_tool_has_its_filament() -> None:
    text = b"M83\nM200 T0 D1.75\nM200 T1 D2.85\nG1 X1 E10\nT1\nG1 X2 E10\nM200 D0\nG1 X3 E10\n"
    table = read_table(text, MachineState(x=0.0, y=0.0, z=0.0))
    assert table.filament[[3, 5, 7]].tolist() == pytest.approx([10 / AREA, 10 / (math.pi / 4 * 2.85**2), 10])
    assert table.extruded[[3, 5, 7]].tolist() == [10, 10, 10]


def test_no_diameter_without_sense_is_taken() -> None:
    for words in ({"D": 1e9}, {"D": None}, {"T": -1.0, "D": 2.0}, {"T": 1e9, "D": 2.0}, {"L": 3.0}):
        assert apply_m200(MachineState(), words).diameters == (1.75,)


def test_a_diameter_is_in_the_unit_of_the_file() -> None:
    text = b"M83\nG20\nM200 D.07\nG1 X1 E1\n"
    table = read_table(text, MachineState(x=0.0, y=0.0, z=0.0))
    assert table.filament[3] == pytest.approx(25.4 / (math.pi / 4 * (0.07 * 25.4) ** 2))


def test_a_diameter_of_the_settings_is_taken(tmp_path: Path) -> None:
    wide = math.pi / 4 * 2.85**2
    text = volumetric(LINEAR, wide) + b"; use_volumetric_e = 1\n; filament_diameter = 2.85\n"
    (tmp_path / "linear.gcode").write_bytes(LINEAR)
    (tmp_path / "wide.gcode").write_bytes(text)
    assert motion(tmp_path / "wide.gcode").filament == pytest.approx(
        motion(tmp_path / "linear.gcode").filament, rel=1e-4
    )


@pytest.mark.slow
@pytest.mark.parametrize("pattern", ["keep", "gyroid"])
def test_every_drawing_of_a_print_begins_alike(pattern: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A small print is drawn several times; the firmware and the rule of E are known before its first line."""
    begins: list[MachineState | None] = []

    def noting(file: BinaryIO, begin: MachineState | None = None) -> Iterator[Layers]:
        begins.append(begin)
        return read_layers(file, begin)

    path = tmp_path / "a.gcode"
    path.write_bytes(LINEAR + b"; gcode_flavor = klipper\n")
    monkeypatch.setattr("infill.refilling.drafting.read_layers", noting)
    monkeypatch.setattr("infill.refilling.drafting.FILAMENT_TOLERANCE", -1.0)  # which no drawing meets
    refill(path, output=tmp_path / "b.gcode", pattern=pattern)
    assert len(begins) > (pattern == "gyroid")
    assert {begin.firmware for begin in begins if begin is not None} == {"klipper"}
    assert None not in begins
