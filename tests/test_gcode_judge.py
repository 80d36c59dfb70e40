"""The judge of refilled prints accepts what is lawful and finds each fault by its name: it can say no."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from slicers import missing_prusa

from tests.gcode_corpus import CORPUS, Made, prints
from tests.gcode_judge import OUTSIDE, changed, grown, infilled, judge, pushed, replayed
from tests.handmade_prints import Dialect, written
from tests.plain_refill import chamfered
from tests.prints import box, prusa_print

STAMP = b"; refilled by phasefill 0.0.0: halves"
EXTRUDED = re.compile(rb"(?:N\d+ )?G1 ?X([-\d.]+) ?Y([-\d.]+) ?E([-\d.]+)")
FIRST = b";TYPE:Internal infill"


def halves(data: bytes, sparse: bytes = b"Internal infill", *, absolute: bool = False) -> bytes:
    """Cut every move of the sparse infill in two, and stamp the print."""
    ending = b"\r\n" if b"\r\n" in data else b"\n"
    lines, inside, stamped, e = [], False, False, 0.0
    at = (0.0, 0.0)
    for line in data.split(ending):
        place = re.match(rb"(?:N\d+ )?G[0-3] ?(?:F[\d.]+ )?X([-\d.]+) ?Y([-\d.]+)", line)
        there = (float(place[1]), float(place[2])) if place else at
        if re.match(rb"(N\d+ )?; ?(TYPE|FEATURE):", line):
            inside = line.endswith(sparse)
        elif re.match(rb"(N\d+ )?(;LAYER|; CHANGE_LAYER)", line):
            inside = False
        found = EXTRUDED.match(line)
        if inside and found and (absolute or float(found[3]) > 0):
            full = float(found[3]) - (e if absolute else 0.0)
            if full > 0:
                half = round(full / 2, 5)
                middle = [(a + b) / 2 for a, b in zip(at, there, strict=True)]
                first = e + half if absolute else half
                lines.append(b"G1 X%.3f Y%.3f E%.5f" % (*middle, first))
                line = b"G1 X%.3f Y%.3f E%.5f" % (*there, float(found[3]) if absolute else full - half)
        if absolute:
            value = re.match(rb"(?:N\d+ )?G(?:[0-3]|92)[^;]*?E([-\d.]+)", line)
            e = float(value[1]) if value else e
        at = there
        lines.append(line)
        if not stamped and not line.startswith(b";FLAVOR"):
            lines.append(STAMP)
            stamped = True
    return ending.join(lines)


FULL = Dialect(
    objects=2,
    tools=2,
    labels="M486",
    fan_in_infill=True,
    layers=4,
    odd=(b"M117 hello", b"M104 S209", b"SET_VELOCITY_LIMIT ACCEL=900", b"; P\xe4rt"),
)
DIALECTS = {
    "relative E": (FULL, b"Internal infill"),
    "absolute E": (Dialect(absolute=True, zero=True, layers=4), b"Internal infill"),
    "no wipe, no hop": (Dialect(wipe=False, hop=0.0, layers=4), b"Internal infill"),
    "retracted by the firmware": (Dialect(firmware=True, layers=4), b"Internal infill"),
    "CRLF": (Dialect(crlf=True, newline=False, layers=4), b"Internal infill"),
    "infill first": (Dialect(infill_first=True, objects=2, labels="comment", layers=4), b"Internal infill"),
    "Orca": (Dialect(slicer="orca", labels="EXCLUDE_OBJECT", packed=True, layers=4), b"Sparse infill"),
    "Bambu": (Dialect(slicer="bambu", labels="M624", crlf=True, layers=4), b"Sparse infill"),
    "Cura": (Dialect(slicer="cura", absolute=True, layers=4), b"FILL"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", DIALECTS)
def test_moves_cut_in_two_are_lawful(name: str) -> None:
    dialect, sparse = DIALECTS[name]
    old = written(dialect)
    new = halves(old, sparse, absolute=dialect.absolute)
    assert judge(old, new, deviation=0.01, filament=(0.9999, 1.0001)) == []
    assert changed(old, new) == infilled(old) > 0
    assert pushed(new) == pytest.approx(pushed(old), abs=1e-9)
    assert judge(old, old) == []


@pytest.fixture(scope="module")
def sliced(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    if missing_prusa():
        pytest.skip(missing_prusa())
    folder = tmp_path_factory.mktemp("sliced")
    return prusa_print(box(folder, (14, 14, 2.4)), folder / "box.gcode").read_bytes()


@pytest.mark.slow
def test_a_real_print_with_its_moves_cut_in_two_is_lawful(sliced: bytes) -> None:
    new = halves(sliced)
    assert changed(sliced, new) == infilled(sliced) > 0
    assert judge(sliced, new, deviation=0.01, filament=(0.9999, 1.0001)) == []


Lines = list[bytes]


def find(lines: Lines, pattern: bytes, *, after: bytes = FIRST, skip: int = 0) -> int:
    """Return the place of a line that matches, after one that matches `after`."""
    start = next(i for i, line in enumerate(lines) if re.match(after, line))
    return [i for i in range(start + 1, len(lines)) if re.match(pattern, lines[i])][skip]


def edit(pattern: bytes, old: bytes, new: bytes, **places) -> Callable[[Lines], Lines]:
    def edited(lines: Lines) -> Lines:
        i = find(lines, pattern, **places)
        line = re.sub(old, new, lines[i], count=1)
        assert line != lines[i]
        return [*lines[:i], line, *lines[i + 1 :]]

    return edited


def lose(pattern: bytes, **places) -> Callable[[Lines], Lines]:
    def lost(lines: Lines) -> Lines:
        i = find(lines, pattern, **places)
        return [*lines[:i], *lines[i + 1 :]]

    return lost


def insert(line: bytes, before: bytes, **places) -> Callable[[Lines], Lines]:
    def inserted(lines: Lines) -> Lines:
        i = find(lines, before, **places)
        return [*lines[:i], line, *lines[i:]]

    return inserted


def swap(first: bytes, second: bytes) -> Callable[[Lines], Lines]:
    def swapped(lines: Lines) -> Lines:
        i = find(lines, first, after=b"; generated")
        j = find(lines, second, after=b"; generated", skip=0)
        lines = list(lines)
        lines[i], lines[j] = lines[j], lines[i]
        return lines

    return swapped


def move_command_to_the_end(lines: Lines) -> Lines:
    """The fan that turns at the beginning of an infill turns at its end."""
    i, j = find(lines, b"M106 S127"), find(lines, b"M106 S255")
    lines = list(lines)
    lines.insert(j - 1, lines.pop(i))
    return lines


def lift_a_part(lines: Lines) -> Lines:
    i = find(lines, BEAD)
    return [*lines[:i], b"G1 Z.7", *lines[i : i + 4], b"G1 Z.4", *lines[i + 4 :]]


BEAD = rb"G1 X[\d.]+ Y[\d.]+ E[\d.]+$"
WALL = b";TYPE:Perimeter"
MORE = {"after": b";TYPE:Internal infill", "skip": 5}
LAST_BEAD = rb"G1 X[\d.]+ Y[\d.]+ E-"  # whereto the infill's last wipe goes

FAULTS: dict[str, tuple[Callable[[Lines], Lines], str]] = {
    "a wrong E": (edit(BEAD, rb"E[\d.]+", b"E.09", **MORE), "E per mm"),
    "an E that is lost": (edit(BEAD, rb" E[\d.]+", b"", **MORE), "path lost"),
    "a negative E": (edit(BEAD, rb"E", b"E-", **MORE), "wipe:"),
    "a bead of no length": (insert(b"G1 E.1", BEAD, **MORE), "unretract when not retracted"),
    "a lost M106": (lose(b"M106"), "fan lost"),
    "a lost M106 outside": (lose(b"M106", after=b";LAYER_CHANGE"), "fan lost"),
    "a fan that turns too late": (move_command_to_the_end, "fan out of order"),
    "a move outside": (edit(BEAD, rb"X1", b"X2", **MORE), "move outside"),
    "a move into a wall": (edit(BEAD, rb"X102.494 Y\S+ ", b"X102.494 Y100.95 ", skip=1), "move outside"),
    "a path too far from the old one": (edit(BEAD, rb"Y\S+", b"Y101.2", skip=1), "path moved"),
    "a doubled retract": (insert(b"G1 E-.8 F2100", BEAD, **MORE), "extrusion while retracted"),
    "a second retract": (insert(b"G1 E-.8 F2100", b"G1 E-"), "doubled retract"),
    "an unretract missing": (lose(rb"G1 E\.8"), "extrusion while retracted"),
    "a doubled unretract": (insert(b"G1 E.8 F2100", rb"G1 E\.8"), "unretract when not retracted"),
    "an unretract missing outside": (lose(rb"G1 E\.8", after=WALL), "move lost"),
    "an F0": (edit(rb"G1 F4800", b"F4800", b"F0"), "F0"),
    "an F of mm/s": (edit(rb"G1 F4800", b"F4800", b"F80"), "F: line"),
    "a faster F": (edit(rb"G1 F4800", b"F4800", b"F9600"), "F: line"),
    "a dropped newline": (lambda lines: lines[:-1] if not lines[-1] else lines, "newline at the end"),
    "a changed tag": (edit(b";TYPE:Solid infill", b"Solid", b"Top solid"), "tag changed"),
    "a changed width": (edit(b";WIDTH", b"0.45", b"0.46"), "tag changed"),
    "a lost tag of the infill": (lose(b";TYPE:Internal infill"), "tag"),
    "a perimeter moved by 0.001": (edit(BEAD, rb"X(\d+)\.(\d\d)\d", rb"X\1.\g<2>9", after=WALL), "move changed"),
    "a lost M73": (lose(b"M73"), "progress lost"),
    "a word of M73 lost": (edit(b"M73", rb" R\d+", b""), "progress changed"),
    "a Z change": (edit(BEAD, b" E", b" Z.5 E", **MORE), "Z: "),
    "a Z that stays changed": (insert(b"G1 Z.9", BEAD, **MORE), "Z: "),
    "a part of the infill lifted": (lift_a_part, "Z: "),
    "G91 inserted": (insert(b"G91", BEAD, **MORE), "coordinates added"),
    "G91 inserted outside": (insert(b"G91", BEAD, after=WALL), "coordinates added"),
    "M83 turned to M82": (edit(b"M83", b"M83", b"M82", after=b"; generated"), "extruder mode changed"),
    "M82 inserted": (insert(b"M82", BEAD, **MORE), "extruder mode added"),
    "two swapped labels": (swap(b"M486 S0", b"M486 S1"), "object label"),
    "a lost label": (lose(b"M486 S-1"), "object label lost"),
    "a lost T": (lose(b"T1"), "tool lost"),
    "a temperature changed": (edit(b"M104 S209", b"209", b"229", after=b"; generated"), "temperature changed"),
    "a temperature lost": (lose(b"M104 S209", after=b"; generated"), "temperature lost"),
    "an acceleration changed": (edit(b"M204", rb"S\d+", b"S5000"), "acceleration changed"),
    "a velocity limit lost": (lose(b"SET_VELOCITY_LIMIT", after=b"; generated"), "acceleration lost"),
    "a message lost": (lose(b"M117", after=b"; generated"), "command lost"),
    "a message doubled": (insert(b"M117 hello", b"M117 hello", after=b"; generated"), "command added"),
    "a comment spelt anew": (edit(rb"; P\xe4rt", rb"\xe4", b"\xc3\xa4", after=b"; generated"), "comment changed"),
    "extrusion while retracted": (insert(b"G1 X102 Y102 E.02", rb"G1 Z\.8"), "extrusion while retracted"),
    "a changed last position": (edit(LAST_BEAD, rb"X(\d+)", b"X105", skip=4), "position"),
    "a wipe that pulls less": (edit(rb"G1 X\S+ Y\S+ E-", rb"E-\.76", b"E-.5", skip=4), "retraction"),
    "a wipe outside of its tags": (insert(b"G1 X103 Y103 E-.01", BEAD, **MORE), "wipe: "),
    "an arc where there was none": (insert(b"G2 X103 Y103 I.1 J0 E.01", BEAD, **MORE), "arc"),
    "a number with an exponent": (edit(BEAD, rb"E[\d.]+", b"E9e-02", **MORE), "odd word"),
    "a number that is none": (edit(BEAD, rb"X[\d.]+", b"Xnan", **MORE), "odd word"),
    "a line too long": (edit(BEAD, rb" E", b" " * 80 + b"E", **MORE), "line too long"),
    "LF among CRLF": (edit(BEAD, rb"(E[\d.]+)", rb"\1\0", **MORE), "line ending changed"),
    "no stamp": (lose(b"; refilled", after=b"; generated"), "stamp"),
    "two stamps": (insert(STAMP, b";LAYER_CHANGE", after=b"; generated"), "stamp"),
    "a stamp in the settings": (
        lambda lines: [*[line for line in lines if line != STAMP][:-2], STAMP, *lines[-2:]],
        "stamp",
    ),
    "a setting changed": (edit(b"; layer_height", b"0.2", b"0.3"), "comment changed"),
    "half of the infill": (lambda lines: without_a_row(lines), "filament"),
}


def without_a_row(lines: Lines) -> Lines:
    """Every bead pushes 7 % less, which each alone may."""

    def less(match: re.Match[bytes]) -> bytes:
        return b"E%.5f" % (0.93 * float(match[1]))

    inside, left = False, []
    for line in lines:
        if line.startswith((b";TYPE", b";LAYER")):
            inside = line == FIRST
        left.append(re.sub(rb"E(\.?\d[\d.]*)$", less, line) if inside and b"X" in line else line)
    return left


@pytest.mark.long
@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found_by_its_name(fault: str) -> None:
    plant, name = FAULTS[fault]
    dialect = FULL if fault != "LF among CRLF" else Dialect(crlf=True, layers=4)
    old = written(dialect)
    good = halves(old)
    ending = b"\r\n" if dialect.crlf else b"\n"
    bad = ending.join(plant(good.split(ending))).replace(b"\x00\r\n", b"\n")
    assert bad != good
    found = judge(old, bad, deviation=0.1, filament=(0.98, 1.02))
    assert any(name in line for line in found), found
    assert len(found) < 30  # one fault does not bury the print


def test_a_fan_that_turns_too_late_is_found_where_nothing_else_tells_the_order() -> None:
    old = written(Dialect(fan_in_infill=True, wipe=False, progress="", layers=4))
    bad = b"\n".join(move_command_to_the_end(halves(old).split(b"\n")))
    assert [line.split(":")[0] for line in judge(old, bad)] == ["fan moved"]


ABSOLUTE = Dialect(absolute=True, layers=4)
ABSOLUTE_FAULTS: dict[str, tuple[Callable[[Lines], Lines], str]] = {
    "an E that goes on from another": (edit(rb"G1 X\S+ Y\S+ E", rb"E(\d+)", rb"E1\1", skip=5), "E per mm"),
    "an origin in the middle": (insert(b"G92 E0", rb"G1 E", skip=2), "unretract when not retracted"),
    "an E that is not set back": (insert(b"G92 E3", b";LAYER_CHANGE"), "E: a section leaves"),
    "M82 turned to M83": (edit(b"M82", b"M82", b"M83", after=b"; generated"), "extruder mode changed"),
    "a lost origin": (lose(b"G92", after=b"; generated"), "origin lost"),
}


@pytest.mark.slow
@pytest.mark.parametrize("fault", ABSOLUTE_FAULTS)
def test_a_fault_of_absolute_filament_is_found(fault: str) -> None:
    plant, name = ABSOLUTE_FAULTS[fault]
    old = written(ABSOLUTE)
    good = halves(old, absolute=True)
    found = judge(old, b"\n".join(plant(good.split(b"\n"))))
    assert any(name in line for line in found), found


FIRMWARE_FAULTS = {
    "a second G10": (insert(b"G10", b"G10"), "doubled retract"),
    "a lost G11": (lose(b"G11"), "extrusion while retracted"),
    "a second G11": (insert(b"G11", b"G11"), "unretract when not retracted"),
}


@pytest.mark.slow
@pytest.mark.parametrize("fault", FIRMWARE_FAULTS)
def test_a_fault_of_firmware_retraction_is_found(fault: str) -> None:
    plant, name = FIRMWARE_FAULTS[fault]
    old = written(Dialect(firmware=True, layers=4))
    found = judge(old, b"\n".join(plant(halves(old).split(b"\n"))))
    assert any(name in line for line in found), found


def test_filament_may_be_set_back_where_it_is_absolute() -> None:
    """A shorter path and a G92 that tells the rest of the print nothing of it."""
    old = written(ABSOLUTE)
    lines = halves(old, absolute=True).split(b"\n")
    i = find(lines, rb"G1 X\S+ Y\S+ E", skip=7)
    e = re.search(rb"E([\d.]+)", lines[i])
    assert e
    less = float(e[1]) - 0.001  # of some 0.03 mm
    lines[i : i + 1] = [re.sub(rb"E[\d.]+", b"E%.5f" % less, lines[i]), b"G92 E" + e[1]]
    assert judge(old, b"\n".join(lines), deviation=0.01) == []


def test_a_counter_that_is_no_longer_set_is_found() -> None:
    """Other paths need not set it where the old ones did; but what they push, and what they leave, must be right."""
    old = written(Dialect(slicer="cura", absolute=True, layers=5))
    head, tail = old.rsplit(b"\nG92 E0\n", 1)
    assert b";TYPE:FILL" in head
    assert judge(old, old) == []
    assert judge(old, head + b"\n" + tail) != []
    assert judge(old, head + b"\nG92 E1\n" + tail) != []


@pytest.mark.slow
def test_times_may_be_told_anew_and_nothing_else() -> None:
    old = written(FULL)
    new = re.sub(rb"M73 P\d+ R\d+", b"M73 P7 R3", halves(old))
    new = new.replace(b"(normal mode) = 3m 1s", b"(normal mode) = 2m 1s")
    assert judge(old, new) == []
    wrong = new.replace(b"filament used [mm] = ", b"filament used [mm] = 1")
    assert [line.split(":")[0] for line in judge(old, wrong)] == ["filament told"]
    assert any(
        "comment changed" in line
        for line in judge(old, new.replace(b"filament_diameter = 1", b"filament_diameter = 2"))
    )


@pytest.mark.slow
def test_a_layer_that_was_slowed_is_not_made_shorter() -> None:
    """Its slowest layers take some seconds; where 20 are asked for, every second counts."""
    old = written(FULL).replace(b"slowdown_below_layer_time = 0", b"slowdown_below_layer_time = 20")
    new = halves(old)
    assert judge(old, new) == []
    fewer = [line for line in new.split(b"\n") if not re.match(rb"G1 X\S+ Y10[4-9]\S+ E\S+$", line)]
    assert any(line.startswith("cooling") for line in judge(old, b"\n".join(fewer)))


@pytest.mark.slow
def test_the_region_is_what_other_beads_leave_free(sliced: bytes) -> None:
    """As far as the slicer's own infill reaches, and 0.02 mm."""
    new = halves(sliced)
    lines = new.split(b"\n")
    i = find(lines, rb"G1 X\S+ Y\S+ E", skip=4)
    x, y = (float(v) for v in re.match(rb"G1 X(\S+) Y(\S+)", lines[i]).groups())
    inside = sliced.split(FIRST)[1].split(b";TYPE")[0]
    inner = min(float(v) for v in re.findall(rb"X(\S+) Y\S+ E\.", inside))
    for beyond, lawful in ((0.018, True), (0.025, False)):
        place = (inner - beyond, y)
        per_mm = 0.03385
        there, back = math.dist((x, y), place), math.dist((x, y), place)
        spur = [b"G1 X%.3f Y%.3f E%.5f" % (*p, d * per_mm) for p, d in ((place, there), ((x, y), back))]
        found = judge(sliced, b"\n".join([*lines[: i + 1], *spur, *lines[i + 1 :]]), filament=(0.5, 5))
        assert [line.split(":")[0] for line in found] == ([] if lawful else ["move outside"] * 2), found


# Free room in a layer of a printed part, larger by half a line: to the last bit, its mitred outline touches itself.
TOUCHES_ITSELF = [
    (142.26544337254614, 95.19364142408011),
    (137.65634949186332, 97.31119468282847),
    (139.71481139092506, 96.67751576125883),
    (139.6851965552224, 96.63327124862063),
    (139.66800007304806, 96.54718130534),
    (139.68505779012276, 96.46106375996492),
    (139.73377282365044, 96.3880292281212),
    (139.80672875137938, 96.3391965552224),
    (139.89281869465998, 96.32200007304807),
    (139.9789362400351, 96.33905779012275),
    (140.0519707718788, 96.38777282365042),
    (140.67297077187882, 97.00777282365043),
]


def test_a_region_whose_outline_touches_itself_still_ends_where_it_should() -> None:
    """What is 0.01 mm beyond it is let pass, and what is 0.03 mm beyond is found, on every side."""
    room, reach = shapely.Polygon(TOUCHES_ITSELF), 0.225
    found = grown(room, reach)
    assert found.is_valid
    own = shapely.buffer(room.boundary, 1e-6)
    assert shapely.union(found, own).area == pytest.approx(found.area, rel=1e-12)
    # Mitred corners go up to twice as far; between them, where a side is nearest, the region ends at its reach.
    near = shapely.buffer(found, OUTSIDE)
    middles = [(np.array(a) + b) / 2 for a, b in zip(TOUCHES_ITSELF, np.roll(TOUCHES_ITSELF, -1, axis=0), strict=True)]
    sides = np.diff([*TOUCHES_ITSELF, TOUCHES_ITSELF[0]], axis=0)
    outward = np.stack([sides[:, 1], -sides[:, 0]], axis=-1) / np.hypot(*sides.T)[:, None]
    outward *= 1 if room.exterior.is_ccw else -1
    tried = 0
    for beyond, passes in ((0.01, True), (0.03, False)):
        for middle, way in zip(middles, outward, strict=True):
            point = shapely.Point(middle + way * (reach + beyond))
            if room.distance(point) > reach + beyond - 1e-9:  # not nearer to another side
                assert near.covers(point) == passes
                tried += 1
    assert tried >= 8


def test_it_reads_no_code_of_ours() -> None:
    for name in ("gcode_judge.py", "handmade_prints.py"):
        assert "infill import" not in Path(__file__).with_name(name).read_text(encoding="utf-8")


@pytest.mark.longest
@given(prints())
def test_prints_of_any_dialect_are_valid_and_may_be_cut(old: bytes) -> None:
    """What the strategy makes breaks no law itself: so what a refill breaks is its own."""
    sparse = b"FILL" if b";FLAVOR" in old else b"Sparse infill" if b"Sparse infill" in old else b"Internal infill"
    _, runs = replayed(old)
    assert [fault for ran in runs for fault in ran.faults] == []
    absolute = re.search(rb"^M82", old, re.MULTILINE) is not None
    new = halves(old, sparse, absolute=absolute)
    if infilled(old) and changed(old, new):
        assert judge(old, new, deviation=0.01, filament=(0.999, 1.001)) == []


def test_a_plain_refill_shortens_paths_in_relative_and_absolute_filament() -> None:
    for absolute in (False, True):
        old = written(Dialect(absolute=absolute, layers=4))
        new = chamfered(old)
        # Two corners of some 40° in a millimetre and a half or so: 2 (0.2 − 0.188) mm of 3.4 mm.
        assert 0.98 < pushed(new)[0] / pushed(old)[0] < 0.995
        assert pushed(new)[1] == pytest.approx(pushed(old)[1], abs=1e-3)
        assert (b"G92 E" in new.split(FIRST)[1].split(b";LAYER")[0]) == absolute


SLICED = (
    "prusa",
    "prusa-by-object",
    "prusa-heights",
    "prusa-support",
    "prusa-two-tools",
    "prusa-purge",
    "prusa-vase",
    "cura",
)


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name, entry in CORPUS.items() if entry.missing is str or name in SLICED])
def test_a_plain_refill_of_the_corpus_is_lawful(name: str, prints_of_all_kinds: Made) -> None:
    """Each print is valid itself, and has infill if it should: so what a refill breaks is its own."""
    if CORPUS[name].missing():
        pytest.skip(CORPUS[name].missing())
    old = prints_of_all_kinds[name].read_bytes()
    assert [fault for ran in replayed(old)[1] for fault in ran.faults] == []
    assert (infilled(old) > 0) == CORPUS[name].infilled
    new = chamfered(old)
    assert judge(old, new, deviation=0.1, filament=(0.9, 1.0001)) == []
    if name in ("orca-numbered", "prusa-purge") or not CORPUS[name].infilled:
        assert changed(old, new) == 0
    else:
        assert changed(old, new) >= 0.5 * infilled(old)
        assert pushed(new)[0] < pushed(old)[0] + 1e-6
