"""Strokes and sections drawn anew in the text of a print, the checks that watch over them, and what is said of time."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from infill.gcode.estimates import EstimateChange, completion_letters, find_estimates, stated_seconds, update_estimate
from infill.gcode.infill_sections import InfillSection, find_sections
from infill.gcode.lines import MOVE
from infill.gcode.machine_state import MachineState
from infill.gcode.section_text import (
    TravelSettings,
    compose_section,
    measure_travel,
    replace_sections,
    validate_sections,
)
from infill.gcode.sections import TagState, mark_lines
from infill.gcode.splicing import NewPaths, SplicedText, find_difference, splice_paths, verify_replay
from infill.gcode.strokes import FILAMENT_UNIT, InfillStrokes, find_strokes
from infill.gcode.table import GcodeTable, read_table

Floats = NDArray[np.float64]

RATE = 0.04  # mm of filament per mm
BEGIN = MachineState(x=0.0, y=0.0, z=0.2, f=7200.0)
FOREIGN = ("M73 P5 R3", "; remark", "", "M117 hello", ";", "; feature: X9")  # what may stand inside a stroke
STEPS = st.tuples(st.integers(-30_000, 30_000), st.integers(-30_000, 30_000))  # µm


# Prints of a few strokes.


@dataclass(frozen=True, kw_only=True)
class Writer:
    """How a print is written down: the mode of E, the line ends, and the counter so far."""

    absolute: bool
    end: bytes
    lines: list[str]

    def text(self) -> bytes:
        return b"".join(line.encode() + self.end for line in self.lines)


@st.composite
def prints(draw: st.DrawFn) -> bytes:
    """Two or three strokes of a few moves, with all that may stand in them and between them."""
    absolute = draw(st.booleans())
    lines = ["M82" if absolute else "M83", "G1 F1800", ";LAYER_CHANGE", ";TYPE:Internal infill", ";WIDTH:0.45"]
    counter = draw(st.integers(0, 5_000_000)) if absolute else 0
    lines.append(f"G92 E{counter / 1e5:.5f}")
    at = (0, 0)

    def pushed(steps: int) -> str:
        nonlocal counter
        counter = counter + steps if absolute else steps
        return f"E{counter / 1e5:.5f}"

    for _ in range(draw(st.integers(1, 3))):
        if draw(st.booleans()):
            lines.append(f"G1 {pushed(-80_000)} F2100")
            at = draw(STEPS)
            lines += [f"G1 X{at[0] / 1000} Y{at[1] / 1000} F7200", f"G1 {pushed(80_000)} F2100"]
            lines += ["G1 F1800"] if draw(st.booleans()) else []
        elif draw(st.booleans()):
            lines += ["M106 S50"] + (["G92 E0"] if absolute else [])
            counter = 0
        else:
            lines += ["G10", "G11"]
        for _ in range(draw(st.integers(1, 5))):
            there = draw(STEPS)
            length = float(np.hypot(there[0] - at[0], there[1] - at[1])) / 1000
            if length < 0.5:  # mm: below that the decimals leave the rate open
                continue
            at = there
            feed = draw(st.sampled_from(["", "", "", " F1800"]))
            lines.append(f"G1 X{at[0] / 1000} Y{at[1] / 1000} {pushed(round(length * RATE * 1e5))}{feed}")
            lines += draw(st.lists(st.sampled_from(FOREIGN), max_size=2))
    lines += draw(st.sampled_from([[], ["M107"], [";TYPE:Perimeter", f"G1 X1 Y1 {pushed(50_000)} F1200"]]))
    return Writer(absolute=absolute, end=draw(st.sampled_from([b"\n", b"\r\n"])), lines=lines).text()


def looked_at(text: bytes) -> tuple[GcodeTable, InfillStrokes]:
    table = read_table(text, BEGIN)
    return table, find_strokes(table, mark_lines(table, TagState()))


def lengths(points: Floats, first: Sequence[int]) -> Floats:
    return np.array([np.hypot(*np.diff(points[a:b], axis=0).T).sum() for a, b in pairwise(first)])


def anew(
    infill: InfillStrokes, which: Sequence[int], paths: Sequence[Floats], source: Sequence[Sequence[int]]
) -> NewPaths:
    """Return new paths with the filament per mm of the old ones."""
    first = np.concatenate([[0], np.cumsum([len(path) for path in paths])]).astype(np.intp)
    points = np.concatenate([*paths, np.empty((0, 2))])
    some = np.array(which, dtype=np.intp)
    rate = infill.filament[some] / infill.length[some]
    return NewPaths(
        which=some,
        points=points,
        first=first,
        source=np.array([place for each in source for place in each], dtype=np.intp),
        filament=rate * lengths(points, first.tolist()),
    )


def as_it_was(infill: InfillStrokes, which: Sequence[int]) -> NewPaths:
    places = [range(int(infill.first[k]), int(infill.first[k + 1])) for k in which]
    return anew(infill, which, [infill.points[list(each)] for each in places], places)


@st.composite
def redrawings(draw: st.DrawFn, infill: InfillStrokes) -> NewPaths:
    """Some strokes, each with corners left out, moved, or become several."""
    which = [k for k in range(len(infill)) if draw(st.integers(0, 3))]
    paths, sources = [], []
    for k in which:
        first, last = int(infill.first[k]), int(infill.first[k + 1]) - 1
        path, source = [infill.points[first]], [first]
        for place in range(first + 1, last):
            for _ in range(draw(st.integers(0, 3))):
                shift = np.array(draw(st.tuples(st.integers(-900, 900), st.integers(-900, 900)))) / 1000
                path.append(np.round(infill.points[place] + shift, 3))
                source.append(place)
        path.append(infill.points[last])
        source.append(last)
        paths.append(np.array(path))
        sources.append(source)
        assume((np.hypot(*np.diff(paths[-1], axis=0).T) > 0.01).all())
    return anew(infill, which, paths, sources)


def is_drawn(line: bytes) -> bool:
    return bool(re.match(rb"G1 X\S+ Y\S+ E", line))


# Laws of splicing.


@pytest.mark.slow
@settings(max_examples=50)
@given(prints(), st.data())
def test_whatever_is_redrawn_all_else_stays(text: bytes, data: st.DataObject) -> None:
    table, infill = looked_at(text)
    new = data.draw(redrawings(infill))
    done = splice_paths(table, infill, new)
    assert verify_replay(table, infill, new, done) == ""
    old_lines, new_lines = text.splitlines(keepends=True), done.text.splitlines(keepends=True)
    taken = {int(n) for k in new.which for n in infill.line[infill.first[k] + 1 : infill.first[k + 1]]}
    rest = [line for n, line in enumerate(old_lines) if n not in taken]
    # What is new are moves and resets of the counter; without them, the rest stands as it stood, in its order.
    fresh = list(new_lines)
    for n in np.flatnonzero(done.same)[::-1]:
        place = int(n + done.shift[n])
        assert new_lines[place] == old_lines[n]
        del fresh[place]
    inner = [line for line in fresh if not is_drawn(line) and not line.startswith(b"G92")]
    assert inner == [line for n, line in enumerate(old_lines) if not done.same[n] and n not in taken]
    assert [line for line in rest if not is_drawn(line)] == [
        line
        for n, line in enumerate(new_lines)
        if not is_drawn(line) and not (line.startswith(b"G92") and line in fresh and n not in _copied(done))
    ]
    assert sum(map(is_drawn, fresh)) == len(new.points) - len(new.which)
    # Where the nozzle passes is what was asked for.
    other = read_table(done.text, BEGIN)
    now = [n for n in range(len(other)) if n not in _copied(done) and is_drawn(new_lines[n])]
    wanted = np.delete(new.points, new.first[:-1], axis=0)
    np.testing.assert_array_equal(np.stack([other.x[now], other.y[now]], axis=1), np.round(wanted, 3))


def _copied(done: SplicedText) -> set[int]:
    old = np.flatnonzero(done.same)
    return set((old + done.shift[old]).tolist())


@pytest.mark.slow
@settings(max_examples=50)
@given(prints(), st.data())
def test_the_counter_is_reset_only_where_it_is_needed(text: bytes, data: st.DataObject) -> None:
    table, infill = looked_at(text)
    new = data.draw(redrawings(infill))
    done = splice_paths(table, infill, new)
    resets = done.text.count(b"G92 E") - text.count(b"G92 E")
    if text.startswith(b"M83"):
        assert resets == 0
        return
    last = infill.line[infill.first[new.which + 1] - 1]
    opens = infill.line[infill.first[new.which]]
    # The counter after a stroke, as written, is off what the next lines expect by a step or more.
    written = np.round((table.e[opens] + new.filament) / FILAMENT_UNIT)
    off = written != np.round(table.e[last] / FILAMENT_UNIT)
    assert resets == off.sum()


@pytest.mark.slow
@settings(max_examples=50)
@given(prints())
def test_nothing_redrawn_is_the_same_text(text: bytes) -> None:
    table, infill = looked_at(text)
    new = as_it_was(infill, [])
    done = splice_paths(table, infill, new)
    assert done.text == text
    assert done.same.all()
    assert not done.shift.any()
    assert verify_replay(table, infill, new, done) == ""


@pytest.mark.slow
@given(prints())
def test_a_stroke_redrawn_as_it_was_has_as_many_lines_and_the_same_places(text: bytes) -> None:
    table, infill = looked_at(text)
    new = as_it_was(infill, range(len(infill)))
    done = splice_paths(table, infill, new)
    assert verify_replay(table, infill, new, done) == ""
    other = read_table(done.text, BEGIN)
    assert len(other) == len(table)
    for name in ("kind", "x", "y", "z", "f"):
        np.testing.assert_array_equal(getattr(other, name), getattr(table, name))
    # Every word of the slicer's was rounded by half a step, and so is every one of ours.
    np.testing.assert_allclose(other.extruded, table.extruded, rtol=0, atol=8 * FILAMENT_UNIT)
    assert np.abs(other.extruded.sum() - table.extruded.sum()) <= FILAMENT_UNIT


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("mode", ["M82", "M83"])
def test_whole_millimetres_are_written_as_they_were(mode: str, end: str) -> None:
    words = [1, 2, 3, 4] if mode == "M82" else [1, 1, 1, 1]
    places = ["X10 Y0", "X10 Y10", "X0 Y10", "X0 Y0"]
    moves = [f"G1 {place} E{e}" for place, e in zip(places, words, strict=True)]
    text = end.join([mode, ";TYPE:FILL", moves[0] + " F1800", moves[1], "; remark", *moves[2:], "M107", ""]).encode()
    table, infill = looked_at(text)
    assert len(infill) == 1
    done = splice_paths(table, infill, as_it_was(infill, [0]))
    assert done.text == text


def test_lines_between_moves_keep_their_places_between_corners() -> None:
    text = b"M83\n;TYPE:FILL\nG1 X10 Y0 E1 F1800\n; one\nG1 X10 Y10 E1\nM73 P1\n\n; two\nG1 X20 Y10 E1\n; three\n"
    table, infill = looked_at(text)
    first = int(infill.first[0])
    path = np.array([[0, 0], [9, 0], [10, 1], [10, 9], [11, 10], [20, 10]], dtype=float)
    new = anew(infill, [0], [path], [[first, first + 1, first + 1, first + 2, first + 2, first + 3]])
    done = splice_paths(table, infill, new)
    names = [b"".join(re.findall(rb"[XY]\d+|;.*|M73", line)) for line in done.text.split(b"\n")[2:-1]]
    assert names == [b"X9Y0", b"X10Y1", b"; one", b"X10Y9", b"X11Y10", b"M73", b"", b"; two", b"X20Y10", b"; three"]
    assert verify_replay(table, infill, new, done) == ""


# Faults that are planted in a new text, and what is said of them.


HEAD = ";TYPE:FILL\nG1 F1800\n"
OLD = {
    "M82": "G92 E5\n"
    + HEAD
    + "G1 X10 Y0 E6\nM73 P1\nG1 X10 Y10 E7\nG1 X20 Y10 E8\nG1 E7.2 F2100\nM107\nG1 X1 Y1 F1200\n",
    "M83": "G92 E5\n"
    + HEAD
    + "G1 X10 Y0 E1\nM73 P1\nG1 X10 Y10 E1\nG1 X20 Y10 E1\nG1 E-.8 F2100\nM107\nG1 X1 Y1 F1200\n",
}
# Of each: what stands in the text, what is put in its place, and what must be said; by mode where they differ.
FAULTS: dict[str, tuple[str, str, str]] = {
    "a wrong E": (r"(Y1 E)(\S+)(?=\nM73)", r"\g<1>9\2", "filament|the state at the end"),
    "an E left out": (r"(X10 Y9) E\S+", r"\1", "a new move without filament"),
    "an E that is a little wrong": (r"(X10 Y9 E\S*?)(\d)$", "", "the filament per mm of a new move"),
    "a moved end": (r"X20 Y10 E", r"X20.1 Y10 E", "X after a line that was copied"),
    "another moved end": (r"X20 Y10 E", r"X20 Y10.01 E", "Y after a line that was copied"),
    "a moved corner": (r"X10 Y9 E", r"X10 Y9.3 E", "the filament per mm of a new move"),
    "a move of z": (r"X20 Y10 E", r"X20 Y10 Z.3 E", "Z after a line that was copied"),
    "a line that is lost": (r"M107\n", "", "the number of lines"),
    "a line that is new": (r"M107\n", "M107\n;\n", "the number of lines"),
    "a line that becomes another": (r"M107\n", ";M107\n", "what a line is"),
    "a move that becomes a remark": (r"G1 X10 Y9 E", r";G1 X10 Y9 E", "filament|the number of new moves"),
    "a copied move that goes elsewhere": (r"X1 Y1 F1200", r"X1 Y2 F1200", "Y after a line that was copied"),
    "another feed rate of a copied line": (r"F2100", r"F2101", "F after a line that was copied"),
    "another feed rate to the end": (r"(X20 Y10 E\S+)", r"\1 F1500", "the feed rate of a new move"),
    "another feed rate on the way": (r"(X10 Y1 E\S+)", r"\1 F1500", "the feed rate of a new move"),
    "another retraction": (r"E(7.2|-.8) F2100", r"E-5 F2100", "the filament of a line that was copied"),
}


def cut_corner(text: str) -> tuple[GcodeTable, InfillStrokes, NewPaths, SplicedText]:
    table, infill = looked_at(text.encode())
    path = np.array([[0, 0], [9, 0], [10, 1], [10, 9], [11, 10], [20, 10]], dtype=float)
    new = anew(infill, [0], [path], [[0, 1, 1, 2, 2, 3]])
    return table, infill, new, splice_paths(table, infill, new)


@pytest.mark.slow
@pytest.mark.parametrize("mode", OLD)
@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_named(mode: str, fault: str) -> None:
    table, infill, new, done = cut_corner(f"{mode}\n{OLD[mode]}")
    assert verify_replay(table, infill, new, done) == ""
    found, instead, told = FAULTS[fault]
    text = done.text.decode()
    if instead or fault.startswith("a line"):
        wrong, times = re.subn(found, instead, text, count=1)
    else:  # two hundredths of the move's filament more
        wrong, times = re.subn(r"(X10 Y9 E)(\S+)", lambda m: f"{m[1]}{float(m[2]) + 0.016:.5f}", text, count=1)
    assert times == 1
    assert wrong != text
    assert re.search(told, verify_replay(table, infill, new, replace(done, text=wrong.encode())))


@pytest.mark.parametrize("fault", ["feed", "mode", "tool", "retracted"])
def test_another_state_at_the_end_is_named(fault: str) -> None:
    table, infill, new, done = cut_corner(
        "M83\n;TYPE:FILL\nG1 X10 Y0 E1 F1800\nG1 X10 Y10 E1\nG1 X20 Y10 E1\nM107\nG10\n"
    )
    assert verify_replay(table, infill, new, done) == ""
    old, instead = {
        "feed": (b"M107\n", b"M107\n"),
        "mode": (b"M107", b"M82"),
        "tool": (b"M107", b"T3"),
        "retracted": (b"G10", b"G11"),
    }[fault]
    text = done.text.replace(old, instead)
    if fault == "feed":
        text = re.sub(rb"(X20 Y10 E\S+)", rb"\1 F1500", text)
    told = verify_replay(table, infill, new, replace(done, text=text))
    assert told in ("the state at the end", "F after a line that was copied")


def test_a_counter_that_is_not_reset_is_named() -> None:
    table, infill, new, done = cut_corner(f"M82\n{OLD['M82']}")
    assert done.text.count(b"G92 E8\n") == 1
    told = verify_replay(table, infill, new, replace(done, text=done.text.replace(b"G92 E8\n", b";G92 E8\n")))
    assert told in ("the filament of a line that was copied", "the counter of filament")


@pytest.mark.parametrize(
    ("after", "old", "instead", "told"),
    [
        ("M107\nG92 E0\n", "G92 E8\n", ";G92 E8\n", "the counter of filament"),
        ("G1 Z.6\n", "X20 Y10 E", "X20 Y10 Z.3 E", "a new move in z"),
        ("G1 X1 Y1 F900\n", "X20 Y10 E", "X20.01 Y10 E", "the end of a stroke"),
        ("G1 X1 Y1 F900\n", "X20 Y10 E", "X20 Y9.99 E", "the end of a stroke"),
    ],
)
def test_a_fault_that_the_next_line_covers_is_named(after: str, old: str, instead: str, told: str) -> None:
    moves = "G1 X10 Y0 E6\nG1 X10 Y10 E7\nG1 X20 Y10 E8\n"
    table, infill, new, done = cut_corner(f"M82\nG92 E5\n{HEAD}{moves}{after}")
    assert verify_replay(table, infill, new, done) == ""
    assert done.text.count(old.encode()) == 1
    text = done.text.replace(old.encode(), instead.encode())
    assert verify_replay(table, infill, new, replace(done, text=text)) == told


@pytest.mark.parametrize(("steps", "resets"), [(0, 0), (1, 1), (-1, 1), (3, 1)])
@pytest.mark.parametrize("mode", ["M82", "M83"])
def test_a_counter_is_reset_if_it_is_off_by_a_step(mode: str, steps: int, resets: int) -> None:
    words = [1, 2] if mode == "M82" else [1, 1]
    text = f"{mode}\n{HEAD}G1 X10 Y0 E{words[0]}\nG1 X10 Y10 E{words[1]}\nG1 X0 F7200\n"
    table, infill = looked_at(text.encode())
    new = as_it_was(infill, [0])
    new = replace(new, filament=new.filament + steps * FILAMENT_UNIT)
    done = splice_paths(table, infill, new)
    assert done.text.count(b"G92 E2\n") == done.text.count(b"G92") == (resets if mode == "M82" else 0)
    assert verify_replay(table, infill, new, done) == ""


# Sections drawn anew.


@st.composite
def sections(draw: st.DrawFn) -> tuple[bytes, int]:
    """A section of a few strokes with travels between, retracted or not, and lines that must be kept."""
    absolute = draw(st.booleans())
    counter = 3.0 if absolute else 0.0
    lines = ["M82" if absolute else "M83", "G92 E3", "G1 Z.2", ";LAYER_CHANGE", ";TYPE:FILL", ";HEIGHT:0.2"]
    kept = 0

    def pushed(amount: float) -> str:
        nonlocal counter
        counter = counter + amount if absolute else amount
        return f"E{counter:.5f}"

    for row in range(draw(st.integers(1, 4))):
        if row:
            if draw(st.booleans()):
                lines += [f"G1 {pushed(-0.8)} F2100", "G1 Z.6 F600", f"G1 X0 Y{row} F9000", "G1 Z.2 F600"]
                lines += [f"G1 {pushed(0.8)} F2100"]
                if absolute and draw(st.booleans()):  # as PrusaSlicer does after every retraction
                    lines.append("G92 E0")
                    counter = 0.0
            else:
                lines += [f"G1 X0 Y{row} F9000"]
            for line in draw(st.lists(st.sampled_from(["; kept", "M106 S9", "M73 P1", "M204 S500", ""]), max_size=2)):
                lines.append(line)
                kept += 1
        lines += ["G1 F1800", f"G1 X20 Y{row} {pushed(0.8)}", f"G1 X20 Y{row}.5 {pushed(0.02)}"]
    lines += [";TYPE:Perimeter", f"G1 X30 Y0 {pushed(0.4)}", "M107"]
    return Writer(absolute=absolute, end=draw(st.sampled_from([b"\n", b"\r\n"])), lines=lines).text(), kept


PATHS = st.lists(
    st.lists(st.tuples(st.integers(0, 20_000), st.integers(0, 5000)), min_size=2, max_size=5, unique=True).map(
        lambda points: np.array(points) / 1000
    ),
    max_size=4,
)
WAYS = st.builds(
    TravelSettings,
    travel=st.sampled_from([9000.0, 7200.0]),
    retraction=st.sampled_from([0.0, 0.8, 2.5]),
    lift=st.sampled_from([0.0, 0.4]),
    firmware=st.booleans(),
)


def one_body(text: bytes) -> tuple[GcodeTable, InfillSection]:
    table = read_table(text, BEGIN)
    marks = mark_lines(table, TagState())
    found, odd = find_sections(table, marks, find_strokes(table, marks))
    assert odd == {}
    (body,) = found
    return table, body


@pytest.mark.slow
@settings(max_examples=60)
@given(sections(), PATHS, WAYS, st.lists(st.booleans(), min_size=5, max_size=5))
def test_a_section_drawn_anew_leaves_all_as_it_was(
    section: tuple[bytes, int], paths: list[Floats], ways: TravelSettings, retracts: list[bool]
) -> None:
    table, body = one_body(section[0])
    text, pushed = compose_section(table, body, paths, body.rate, ways, retracts[: len(paths) + 1])
    begins = [body.start, *(path[-1] for path in paths)]
    ends = [*(path[0] for path in paths), body.end]
    travels = [bool((one != other).any()) for one, other in zip(begins, ends, strict=True)]
    number = sum(map(min, travels, retracts)) if ways.firmware or ways.retraction else 0
    done = replace_sections(table, [body], [text])
    other = read_table(done.text, BEGIN)
    assert find_difference(table, other, done) == ""
    assert validate_sections(other, done, [body], [text]) == ""
    assert done.text == table.text(0, body.first) + text + table.text(body.last + 1, len(table))
    part = slice(body.first, body.first + text.count(b"\n"))
    before, after = other.e[part.start - 1], other.e[part.stop - 1]
    moves = (other.kind[part] == MOVE) & other.given[part, :2].any(axis=1)
    drawn = moves & (other.extruded[part] > 0)
    places = np.stack([other.x[part], other.y[part]], axis=1)
    wanted = [point for path in paths for point in path[1:].tolist()]
    assert places[drawn].tolist() == wanted
    assert (places[-1] if len(places) else body.start).tolist() == body.end.tolist()
    assert (other.f[part][drawn] == body.feed).all()
    assert (other.f[part][moves & ~drawn] == ways.travel).all()
    assert text.count(b"\r\n") == (text.count(b"\n") if b"\r" in section[0] else 0)
    length = sum(float(np.hypot(*np.diff(path, axis=0).T).sum()) for path in paths)
    assert pushed == pytest.approx(length * body.rate)
    # Relative words, or the words of an absolute counter: every path is rounded once.
    assert other.extruded[part][drawn].sum() == pytest.approx(pushed, abs=(len(paths) + 1) * FILAMENT_UNIT)
    if table.relative_e[body.first]:
        assert after - before == pytest.approx(pushed, abs=(len(paths) + 1) * FILAMENT_UNIT)
        assert b"G92" not in text
    else:
        assert after == pytest.approx(table.e[body.last], abs=FILAMENT_UNIT)
    # As many times back as forth, as far back as forth, lifted where and only where it is retracted.
    lines = text.splitlines()
    still = other.extruded[part][~moves]
    if ways.firmware:
        assert lines.count(b"G10") == lines.count(b"G11") == number
        assert not still.any()
    else:
        assert b"G10" not in lines
        np.testing.assert_allclose(still[still < 0], -ways.retraction, rtol=0, atol=2 * FILAMENT_UNIT)
        np.testing.assert_allclose(still[still > 0], ways.retraction, rtol=0, atol=2 * FILAMENT_UNIT)
        assert (still < 0).sum() == (still > 0).sum() == number
    assert (np.diff(other.z[part]) > 0.3).sum() == (number if ways.lift else 0)
    assert set(np.round(other.z[part][moves], 6)) <= {0.2, round(0.2 + ways.lift, 6)}
    assert (other.z[part][drawn] == 0.2).all()
    assert len([line for line in lines if not line.startswith(b"G")]) == section[1]
    assert [line for line in lines if not line.startswith(b"G")] == [
        line for line in table.text(body.first, body.last + 1).splitlines() if not line.startswith(b"G")
    ]


def square(middle: str = "", mode: str = "M83") -> bytes:
    """A section of two strokes of the same rate with something between."""
    text = f"{mode}\nG1 Z.2\n;TYPE:FILL\nG1 F1800\nG1 X10 Y0 E.4\nG1 X10 Y10 E.4\n{middle}G1 X0 Y10 F9000\n"
    return (text + "G1 F1800\nG1 X0 Y0 E.4\nG1 X5 Y0 E.2\n;TYPE:Perimeter\nG1 X9 Y0 E.3\n").encode()


ODDITIES = {
    "G1 X1 X2\n": "a line that cannot be read",
    "G2 X10 Y10 I0 J0 E.1\n": "a line that cannot be read",
    "G2 X10 Y5 I2 J0 E.1\n": "arcs that climb or close on no circle",
    "G2 X10 Y10 I1 J0 E.1\n": "lines of different widths",
    "N5 G1 X10\n": "line numbers",
    "G92 X10\n": "a G92 command in between",
    "G92 X10 E0\n": "a G92 command in between",
    "G92\n": "lines at different heights",  # which sets all axes to 0
    "G4 P5\n": "a G4 command in between",
    "T1\n": "a T1 command in between",
    "M83\n": "a M83 command in between",
    "WAIT_FOR=5\n": "a WAIT_FOR=5 command in between",
    "G1 X10 Y5 E.4\n": "lines of different widths",
    "G1 X10 Y5 Z.3 E.2\n": "lines at different heights",
    "G1 Z.4\n": "lines at different heights",
    "G1 X10 Y10 E.2\n": "extrusion of another kind",  # a blob, where a stroke ends
    "G1 X0 Y9\nG1 X0 Y10 Z.2 E.1\nG1 X0 Y10 E.1\nG1 X0 Y8 E.08\n": "extrusion of another kind",  # before a stroke
    "; WIPE_START\nG1 X9 Y10 E.04\n; WIPE_END\n": "extrusion of another kind",
}


@pytest.mark.parametrize("middle", ODDITIES)
def test_an_odd_section_is_told(middle: str) -> None:
    table = read_table(square(middle), BEGIN)
    marks = mark_lines(table, TagState())
    assert find_sections(table, marks, find_strokes(table, marks)) == ([], {ODDITIES[middle]: [1]})


@pytest.mark.parametrize(
    "middle",
    [
        "",
        "; remark\n",
        "\n",
        "M73 P1\n",
        "M106 S5\n",
        "M204 S500\n",
        "G10\nG11\n",
        "G10 P0 S200\n",
        "G1 E-1\nG1 E1\n",
        "G1 X10 Y5 E.2\n",
        "G1 Z.4\nG1 X0 Y10\nG1 Z.2\n",
        "SET_VELOCITY_LIMIT ACCEL=5\n",
        "G92 E0\n",
    ],
)
def test_a_plain_section_is_found(middle: str) -> None:
    table, body = one_body(square(middle))
    lines = square(middle).splitlines()
    assert (body.first, body.last) == (lines.index(b"G1 X10 Y0 E.4"), lines.index(b"G1 X5 Y0 E.2"))
    assert (body.start.tolist(), body.end.tolist(), body.z) == ([0, 0], [5, 0], 0.2)
    assert (body.feed, body.feed_after) == (1800, 1800)
    assert body.rate == pytest.approx(0.04)
    drawn = table.given[:, :2].any(axis=1)[body.first : body.last + 1]
    assert body.filament == pytest.approx(table.extruded[body.first : body.last + 1][drawn].sum())
    assert body.length == pytest.approx(body.filament / 0.04)


def test_the_feed_rate_of_a_section_is_that_of_most_of_it() -> None:
    _, body = one_body(square("G1 F1200\nG1 X10 Y9 E.04\n"))
    assert (len(body.strokes), body.feed, body.feed_after) == (3, 1800, 1800)
    _, body = one_body(square().replace(b"G1 X5 Y0", b"G1 F1500\nG1 X5 Y0"))
    assert (len(body.strokes), body.feed, body.feed_after) == (3, 1800, 1500)


def test_every_section_has_its_own_body() -> None:
    text = square() + square("G4 P1\n") + square("M73 P2\n")
    table = read_table(text, BEGIN)
    marks = mark_lines(table, TagState())
    found, odd = find_sections(table, marks, find_strokes(table, marks))
    assert odd == {"a G4 command in between": [3]}
    assert [body.first for body in found] == [4, 4 + 2 * 12 + 1]
    assert len({body.section for body in found}) == 2


@pytest.mark.parametrize("resets", [0, 1, 3])
def test_a_counter_that_is_set_on_the_way_is_set_once_in_the_end(resets: int) -> None:
    """To what the lines behind expect. Where filament is relative, such lines stay, and set nothing."""
    path = np.array([[0.0, 0.0], [5.0, 0.0]])
    middle, counter = "G92 E0\n" * resets, 0.0 if resets else 0.8
    text = f"M82\nG1 Z.2\n;TYPE:FILL\nG1 F1800\nG1 X10 Y0 E.4\nG1 X10 Y10 E.8\n{middle}G1 X0 Y10 F9000\nG1 F1800\n"
    text += f"G1 X0 Y0 E{counter + 0.4:.1f}\nG1 X5 Y0 E{counter + 0.6:.1f}\n;TYPE:Perimeter\n"
    table, body = one_body(text.encode())
    assert body.filament == pytest.approx(1.4)
    new, pushed = compose_section(table, body, [path], body.rate, TravelSettings(), [False, False])
    assert pushed == pytest.approx(0.2)
    assert new.count(b"G92") == 1
    assert b"\nG92 E%.1f\n" % (counter + 0.6) in new
    table, body = one_body(square(middle))
    new, _ = compose_section(table, body, [path], body.rate, TravelSettings(), [False, False])
    assert new.count(b"G92 E0\n") == new.count(b"G92") == resets


def test_a_temperature_that_is_set_by_g10_is_kept_and_a_retraction_is_not() -> None:
    table, body = one_body(square("G10 P0 S200\nG10\nG11\n"))
    text, _ = compose_section(
        table, body, [np.array([[0.0, 0.0], [5.0, 0.0]])], body.rate, TravelSettings(), [False, False]
    )
    assert text.splitlines().count(b"G10 P0 S200") == 1
    assert b"G10\n" not in text
    assert b"G11" not in text


WRONG = {
    "G1 X1 X2\n": "a new line that cannot be read",
    "G1 X1 E-1\n": "a new move that draws filament back",
    "G1 X1 Z.4 E.1\nG1 Z.2\n": "a new move at another height",
    "G1 F0\n": "a new move without a feed rate",
    "G1 E-1\nG1 X1 E.1\nG1 E1\n": "extrusion while retracted",
    "G1 E-1\n": "a section that ends retracted",
    "G1 E-1\nG1 E.9\n": "a section that ends retracted",
    "G1 E-1\nG1 E1\n": "",
    "G1 X1 E.1\n": "",
}


@pytest.mark.parametrize("wrong", WRONG)
def test_a_new_section_that_is_unlawful_is_told(wrong: str) -> None:
    table, body = one_body(square())
    text = wrong.encode()
    done = replace_sections(table, [body], [text])
    assert validate_sections(read_table(done.text, BEGIN), done, [body], [text]) == WRONG[wrong]


def test_a_lift_while_firmware_retracts_is_one() -> None:
    text = "M83\nG1 Z.2\n"
    for k in range(4):
        text += f"G1 X10 Y{k} E1 F1800\nG10 ; retract\nG1 Z.6 F700\nG1 X0 Y{k} F8000\nG1 Z.2\nG11\n"
    table = read_table(text.encode(), BEGIN)
    lifted = TravelSettings(travel=8000, lift=0.4, lift_feed=700, firmware=True)
    assert replace(measure_travel(table), lift=round(measure_travel(table).lift, 6)) == lifted
    # Nor is what follows G11 lifted: the next layer.
    assert measure_travel(read_table(b"G10\nG11\nG1 Z.6\nG1 Z.2\n", BEGIN)).lift == 0


@pytest.mark.parametrize("absolute", [False, True])
def test_the_ways_of_a_print(absolute: bool) -> None:
    e = ["E1", "E-.8 F2400", "E.8 F1500", "E1"] if not absolute else ["E1", "E.2 F2400", "E1 F1500", "E2"]
    text = f"M8{'23'[not absolute]}\nG1 Z.2\n"
    for k in range(4):
        text += f"G92 E0\nG1 X10 Y{k} {e[0]} F1800\nG1 {e[1]}\nG1 Z.6 F700\nG1 X0 Y{k} F8000\nG1 Z.2\nG1 {e[2]}\n"
    ways = measure_travel(read_table(text.encode(), BEGIN))
    assert ways.lift == pytest.approx(0.4)
    ways = replace(ways, lift=0.4)
    assert ways == TravelSettings(
        travel=8000, retraction=0.8, retract_feed=2400, prime_feed=1500, lift=0.4, lift_feed=700
    )
    assert measure_travel(read_table(b"M107\n", BEGIN), ways) == ways  # nothing told: as before
    assert measure_travel(read_table(b"G10\n", BEGIN)).firmware
    assert not measure_travel(read_table(b"G10 P0 S200\n", BEGIN)).firmware


# Time and filament told anew.


TOLD = [
    b"M73 P50 R30",
    b"M73 P100 R0",
    b"M73 Q12 S34",
    b"M73 P5 R61 Q5 S62",
    b"M73 C7",
    b"M73 L12",
    b"M73 P12.5 R7.5",
    b"M73 P50 R30 ; P9 R9",
    b"; estimated printing time (normal mode) = 1d 2h 3m 4s",
    b"; estimated printing time (silent mode) = 58m 30s",
    b"; estimated printing time (normal mode) = 7s",
    b"; estimated first layer printing time (normal mode) = 1m 2s",
    b"; total estimated time: 34m 27s",
    b"; model printing time: 28m 12s; total estimated time: 34m 27s",
    b";TIME:1234",
    b";PRINT.TIME:99",
    b";TIME_ELAPSED:12.345678",
    b"; filament used [mm] = 8459.54",
    b"; filament used [mm] = 8459.54, 0.00, 12.30",
    b"; filament used [cm3] = 20.35",
    b"; filament used [g] = 25.23",
    b"; total filament used [g] = 25.23",
    b"; total filament cost = 0.63",
    b"; filament cost = 0.63",
    b"; total filament length [mm] : 1234.56",
    b"; total filament volume [cm^3] : 2969.41",
    b"; total filament weight [g] : 3.68,1.20",
    b";Filament used: 1.23456m",
    b";Filament used: 1.23456m, 0.5m",
]
NOT_TOLD = [
    b"M73.2 R1.0",
    b"; filament_cost = 25",
    b"; filament_diameter = 1.75",
    b"; total filament used for wipe tower [g] = 0.00",
    b";TIME",
    b";TIMELAPSE:1",
    b"G1 X1 ;TIME:5",
    b"M730 P1",
    b"; M73 P1 R2",
    b" M73 P1",
]


@pytest.mark.parametrize("end", [b"\n", b"\r\n"])
def test_lines_that_tell_are_found_and_no_others(end: bytes) -> None:
    lines = [line for pair in zip(TOLD, NOT_TOLD * 3, strict=False) for line in pair]
    text = end.join(lines) + end
    assert [text[first:last] for first, last in find_estimates(text)] == TOLD


@pytest.mark.parametrize("line", TOLD)
def test_of_a_print_without_moves_time_is_told_as_it_was(line: bytes) -> None:
    assert update_estimate(line, 0.0, EstimateChange()) == line
    assert update_estimate(line, 7.0, EstimateChange(tools=(1.0, 1.0))) == line


@settings(max_examples=60)
@given(
    st.sampled_from(TOLD), st.floats(0.01, 1e6), st.floats(0, 1), st.floats(0.1, 3), st.sampled_from([b"", b"PRQST"])
)
@example(b";TIME:1234", 0.2, 1.0, 1.0, b"")
def test_no_time_is_ever_negative(line: bytes, seconds: float, share: float, filament: float, done: bytes) -> None:
    change = EstimateChange(seconds=seconds, ratio=0.9, silent=2 * seconds, filament=filament, tools=(filament, 1.0))
    new = update_estimate(line, seconds * share, change, done)
    assert b"-" not in new
    assert b"\n" not in new
    assert re.sub(rb"[\d.]+[dhms]?", b"", new).split() == re.sub(rb"[\d.]+[dhms]?", b"", line).split()
    assert stated_seconds(new) >= (1 if stated_seconds(line) else 0)
    for share_done in re.findall(rb"[PQ](\d+)", new.split(b";")[0] if line.startswith(b"M73") else b""):
        assert 0 <= int(share_done) <= 100
    if b"ilament" in line:
        decimals = [len(n.partition(b".")[2]) for n in re.findall(rb"[\d.]+(?=[,m ]|$)", line.partition(b"]")[2])]
        assert [
            len(n.partition(b".")[2]) for n in re.findall(rb"[\d.]+(?=[,m ]|$)", new.partition(b"]")[2])
        ] == decimals


@given(st.integers(1, 400_000))
@example(86_400)
@example(3600)
def test_a_time_is_what_was_planned(seconds: int) -> None:
    for line in (b"; estimated printing time (normal mode) = 1h 2s", b";TIME:5", b"; model printing time: 1d 1m 1s"):
        new = update_estimate(line, 0.0, EstimateChange(seconds=float(seconds)))
        assert stated_seconds(new) == seconds
        assert update_estimate(new, 0.0, EstimateChange(seconds=float(seconds))) == new


@given(st.lists(st.floats(0, 1), min_size=1, max_size=30), st.floats(1, 400_000), st.integers(0, 2))
def test_progress_runs_from_all_that_is_left_to_nothing(at: list[float], total: float, decimals: int) -> None:
    """Of a print of any length, the share done rises and what is left falls, from the whole to nothing."""
    change = EstimateChange(seconds=total, silent=1.5 * total)
    places = [0.0, *sorted(at), 1.0]
    lines = [b"M73 P%.*f R9 Q3 S%.*f" % (decimals, 4, decimals, 9)] * (len(places) - 1) + [b"M73 P100 R0 Q100 S0"]
    new = [
        update_estimate(line, share * total, change, done)
        for line, share, done in zip(lines, places, completion_letters(lines), strict=True)
    ]
    for letter, sign in ((b"P", 1), (b"Q", 1), (b"R", -1), (b"S", -1)):
        values = [sign * float(re.search(letter + rb"([\d.]+)", line)[1]) for line in new]  # type: ignore[index]
        assert values == sorted(values)
    assert new[-1] == b"M73 P100 R0 Q100 S0"
    first = {found[1]: float(found[2]) for found in re.finditer(rb"([RS])([\d.]+)", new[0])}
    # Whole minutes, cut off after whole seconds were rounded; S has decimals here.
    assert first[b"R"] == (total + 0.5) // 60
    assert 60 * first[b"S"] == pytest.approx(1.5 * total, abs=60 * 10.0**-decimals + 0.5)


@pytest.mark.parametrize(
    ("lines", "done"),
    [
        ([b"M73 P0 R5", b"M73 P100 R0"], [b"", b"PR"]),
        ([b"M73 P0 R5", b"M73 P100 R0", b"M73 Q100 S0"], [b"", b"PR", b"QS"]),
        ([b"M73 P100 R0", b"M73 P100 R0", b"M73 L9"], [b"", b"PR", b""]),
        ([b"M73 P0", b"M73 P98"], [b"", b""]),  # goes on afterwards
        ([b";TIME_ELAPSED:5.0", b"; a remark", b";TIME_ELAPSED:7.0"], [b"", b"", b"T"]),
        ([b";TIME:9"], [b""]),
        ([], []),
    ],
)
def test_what_is_done_in_the_end(lines: list[bytes], done: list[bytes]) -> None:
    assert completion_letters(lines) == done


HOUR = EstimateChange(seconds=3600.0, first_layer=60.0, ratio=0.9, first_ratio=0.5, silent=7200.0, prepared=300.0)


@pytest.mark.parametrize(
    ("line", "change", "told"),
    [
        (b"; filament used [mm] = 100.00", EstimateChange(filament=0.9), b"; filament used [mm] = 90.00"),
        (
            b"; filament used [g] = 10.0, 20.0, 30.0",
            EstimateChange(tools=(0.5, 2.0)),
            b"; filament used [g] = 5.0, 40.0, 30.0",
        ),
        (
            b"; total filament used [g] = 10",
            EstimateChange(filament=1.26, tools=(9.0,)),
            b"; total filament used [g] = 13",
        ),
        (
            b"; total filament weight [g] : 4.00,2.00",
            EstimateChange(tools=(0.5,)),
            b"; total filament weight [g] : 2.00,2.00",
        ),
        (b"; total filament length [mm] : 100.0", EstimateChange(filament=0.9), b"; total filament length [mm] : 90.0"),
        (b";Filament used: 2.00000m, 1m", EstimateChange(tools=(0.25, 2.0)), b";Filament used: 0.50000m, 2m"),
        (b";TIME_ELAPSED:100.500000", HOUR, b";TIME_ELAPSED:900.000000"),
        (b"M73 P50 R61 ; P50 R60", HOUR, b"M73 P25 R48 ; P50 R60"),
        (b"M73 P5.0 R6.5", HOUR, b"M73 P25.0 R48.7"),
        (b"M73 Q50 S60", HOUR, b"M73 Q25 S90"),
        (b"M73 C5 L3 D9", HOUR, b"M73 C4 L3 D8"),
        (b"; estimated printing time (silent mode) = 5s", HOUR, b"; estimated printing time (silent mode) = 2h 0m 0s"),
        (
            b"; estimated first layer printing time (normal mode) = 5s",
            HOUR,
            b"; estimated first layer printing time (normal mode) = 1m 0s",
        ),
        (
            b"; estimated first layer printing time (silent mode) = 1m 50s",
            HOUR,
            b"; estimated first layer printing time (silent mode) = 55s",
        ),
        (
            b"; model printing time: 1h 1m 0s; total estimated time: 2h 0m 0s",
            HOUR,
            b"; model printing time: 1h 0m 0s; total estimated time: 1h 5m 0s",
        ),
        (b"; total estimated time: 2h 0m 0s", HOUR, b"; total estimated time: 1h 5m 0s"),
    ],
)
def test_what_is_told(line: bytes, change: EstimateChange, told: bytes) -> None:
    assert update_estimate(line, 900.0, change) == told


def test_what_is_not_planned_follows_what_is() -> None:
    """The time of a silent mode, and what the slicer counts beside the moves."""
    lines = [
        b"; estimated printing time (silent mode) = 1h 0m 0s",
        b"; model printing time: 50m 0s; total estimated time: 57m 0s",
        b"M73 Q0 S999",
    ]
    assert EstimateChange(ratio=0.5).with_stated_times(lines) == EstimateChange(
        ratio=0.5, silent=1800.0, prepared=420.0
    )
    assert EstimateChange(ratio=0.5).with_stated_times([b"M73 Q0 S30", b"M73 Q5 S20"]).silent == 900.0


def test_filament_is_told_by_what_the_print_says_of_its_tools() -> None:
    lines = [b"; filament used [g] = 9.0", b"; filament used [mm] = 100.0, 0.0, 300.0"]
    change = EstimateChange(seconds=5.0).with_stated_filament(lines, {0: -10.0, 2: 30.0, 7: 1.0})
    assert change == EstimateChange(seconds=5.0, filament=420 / 400, tools=(0.9, 1.0, 1.1))
    for said in ([], [b"; filament used [mm] = 0.0"], [b"; filament used [mm] = 5.0, 1.0"]):
        untold = EstimateChange(filament=0.97, tools=(0.97,))
        assert untold.with_stated_filament(said, {0: -10.0}) == untold


@pytest.mark.parametrize(
    ("line", "seconds"),
    [
        (b"; estimated printing time (normal mode) = 1d 1h 1m 1s", 90061.0),
        (b"; model printing time: 3m 1s; total estimated time: 8m 2s", 181.0),
        (b";TIME:77", 77.0),
        (b";PRINT.TIME:12", 12.0),
        (b";TIME_ELAPSED:12.5", 0.0),
        (b"M73 P1 R30", 0.0),
        (b"; estimated printing time (normal mode) = unknown", 0.0),
    ],
)
def test_seconds_that_are_said(line: bytes, seconds: float) -> None:
    assert stated_seconds(line) == seconds
