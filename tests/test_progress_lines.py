"""Of time there is one figure: refill's, that of the file it writes, and that of `motion` on that file."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from infill import motion, refill
from infill.cli.app import build_app
from tests.handmade_prints import Dialect, written

TAIL = b"""; filament used [cm3] = 0.96
; filament used [g] = 1.20
; total filament used [g] = 1.20
; estimated printing time (normal mode) = 59m 59s
; estimated printing time (silent mode) = 1h 2m 0s
; estimated first layer printing time (normal mode) = 9s
"""


def long_print(layers: int = 24) -> bytes:
    """Return a print of several minutes with progress in it, as PrusaSlicer writes it, both modes on lines of their own."""
    text = written(Dialect(slicer="prusa", progress="P{done} R{left}\nM73 Q{done} S{left}", layers=layers))
    first = text.index(b"\n") + 1
    text = text[:first] + b"M73 P0 R60\nM73 Q0 S62\n" + text[first:]
    return text + b"M73 P100 R0\nM73 Q100 S0\n" + TAIL


def told(text: bytes, letter: bytes) -> list[float]:
    lines = re.findall(rb"(?m)^M73 [^\n;]*", text)
    return [float(word) for line in lines for word in re.findall(rb"\b%s([\d.]+)" % letter, line)]


def seconds(text: bytes, name: bytes) -> int:
    found = re.search(rb"; estimated printing time \(%s mode\) = (?:(\d+)h )?(?:(\d+)m )?(\d+)s" % name, text)
    assert found is not None
    hours, minutes, rest = (int(part or 0) for part in found.groups())
    return 3600 * hours + 60 * minutes + rest


@pytest.mark.long
@pytest.mark.parametrize("slow", [1, 20])
@pytest.mark.parametrize("pattern", ["keep", "honeycomb"])
def test_there_is_one_figure_of_time(pattern: str, slow: int, tmp_path: Path) -> None:
    text = re.sub(
        rb"(?m)(?<=[ E\d]F)\d+(?:\.\d+)?", lambda feed: b"%d" % max(60, round(float(feed[0]) / slow)), long_print()
    )
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(text)
    report = refill(old, output=new, pattern=pattern).report
    assert report["sections"]["replaced"] > 0
    before, after = motion(old), motion(new)
    assert report["time"]["slicer_s"] == 3599
    assert report["time"]["print_before_s"] == pytest.approx(before.seconds, rel=1e-9)
    assert report["time"]["print_after_s"] == pytest.approx(after.seconds, rel=1e-9)
    assert report["time"]["infill_before_s"] == pytest.approx(before.of_role("sparse infill"), rel=1e-9)
    assert report["time"]["infill_after_s"] == pytest.approx(after.of_role("sparse infill"), rel=1e-9)
    written_text = new.read_bytes()
    assert seconds(written_text, b"normal") == after.estimate == round(after.seconds)
    ratio = after.seconds / before.seconds
    assert seconds(written_text, b"silent") == round(3720 * ratio)
    for letter in (b"P", b"Q"):
        assert told(written_text, letter) == sorted(told(written_text, letter))
        assert told(written_text, letter)[-1] == 100
    for letter, whole in ((b"R", after.seconds), (b"S", 3720 * ratio)):
        left = told(written_text, letter)
        assert left == sorted(left, reverse=True)
        assert left[0] == (whole + 0.5) // 60  # whole minutes of whole seconds, as slicers write them
        assert left[-1] == 0


@pytest.mark.slow
def test_each_line_tells_what_is_left_behind_it(tmp_path: Path) -> None:
    """Cut a print off at each of its lines of progress: what lies before takes the share that the line tells."""
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(long_print(layers=8))
    refill(old, output=new)
    text = new.read_bytes()
    whole = motion(new).seconds
    places = [found.start() for found in re.finditer(rb"(?m)^M73 P\d", text)][1:-1]
    assert len(places) > 5
    for place in places[:: max(1, len(places) // 6)]:
        part = tmp_path / "part.gcode"
        part.write_bytes(text[:place])
        share = float(re.match(rb"M73 P(\d+)", text[place:])[1])  # type: ignore[index]
        # Cut off, the last move before the line ends at rest: some tenths of a second; P is cut to a per cent.
        assert share == pytest.approx(100 * motion(part).seconds / whole, abs=1 + 100 * 0.3 / whole)


@pytest.mark.slow
def test_a_layer_and_grams_are_told(tmp_path: Path) -> None:
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(long_print(layers=8))
    report = refill(old, output=new).report
    grams = re.search(rb"; filament used \[g\] = ([\d.]+)", new.read_bytes())
    assert grams is not None
    assert report["filament"]["print_before_g"] == 1.2
    assert report["filament"]["print_after_g"] == float(grams[1])
    assert report["filament"]["print_after_mm"] < report["filament"]["print_before_mm"]
    first = new.read_bytes().split(b";LAYER_CHANGE")[:2]
    (tmp_path / "first.gcode").write_bytes(b";LAYER_CHANGE".join(first))
    layer = re.search(rb"first layer printing time \(normal mode\) = (\d+)s", new.read_bytes())
    assert layer is not None
    # Cut off, its last move ends at rest.
    assert float(layer[1]) == pytest.approx(motion(tmp_path / "first.gcode").seconds, abs=1)
    result = CliRunner().invoke(build_app(), ["refill", str(old), "-o", str(new), "--force"])
    assert f"and {report['filament']['print_after_g']:.2f} g" in result.stderr
    assert "the slicer said 0:59:59" in result.stderr


@pytest.mark.slow
def test_curas_times_are_planned_too(tmp_path: Path) -> None:
    text = written(Dialect(slicer="cura", progress="", layers=8))
    text = re.sub(rb"(?m)^;TIME(_ELAPSED)?:.*\n", b"", text)
    parts = re.split(rb"(?m)(?=^;LAYER:)", text)
    text = (
        b";TIME:6666\n".join(parts[:1])
        + b";TIME:6666\n"
        + b"".join(part + b";TIME_ELAPSED:%d.5\n" % n for n, part in enumerate(parts[1:], 1))
    )
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(text)
    report = refill(old, output=new).report
    assert report["sections"]["replaced"] > 0
    after = motion(new)
    assert re.findall(rb";TIME:(\d+)", new.read_bytes()) == [b"%d" % round(after.seconds)]
    gone = [float(each) for each in re.findall(rb";TIME_ELAPSED:([\d.]+)", new.read_bytes())]
    assert gone == sorted(gone)
    assert gone[-1] == pytest.approx(after.seconds, abs=1e-6)
    assert after.estimate == pytest.approx(report["time"]["print_after_s"], abs=1e-6)


@pytest.mark.slow
def test_a_head_of_bambu_studio(tmp_path: Path) -> None:
    text = written(Dialect(slicer="bambu", progress="P{done} R{left}", layers=8))
    text = re.sub(rb"; (?:model printing time|total estimated time)[^\n]*\n", b"", text)
    first = text.index(b"\n") + 1
    text = (
        text[:first]
        + b"; model printing time: 5m 0s; total estimated time: 11m 0s\nM73 P0 R11\n"
        + text[first:]
        + b"M73 P100 R0\n"
    )
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(text)
    refill(old, output=new)
    after = round(motion(new).seconds)
    head = re.search(
        rb"model printing time: (?:(\d+)m )?(\d+)s; total estimated time: (?:(\d+)m )?(\d+)s", new.read_bytes()
    )
    assert head is not None
    minutes, rest, more, less = (int(part or 0) for part in head.groups())
    assert 60 * minutes + rest == after
    assert 60 * more + less == after + 360  # what the slicer counts for preparing stays
    left = told(new.read_bytes(), b"R")
    assert left == sorted(left, reverse=True)
    assert (left[0], left[-1]) == ((after + 360 + 0.5) // 60, 0)
