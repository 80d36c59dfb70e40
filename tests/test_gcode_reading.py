"""Prints read as arrays: numbers, lines, layers, tags and strokes, each beside a slow and plain reading of its own."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import astuple, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from infill import FormatError
from infill.gcode import stream
from infill.gcode.lines import ARC, BLANK, COMMENT, MOVE, ODD, OTHER, read_compiled_lines, read_plain_lines
from infill.gcode.machine_state import MachineState
from infill.gcode.numbers import (
    MAX_DIGITS,
    WORD,
    parse_long_numbers,
    parse_short_numbers,
    read_numbers,
    write_compiled_words,
    write_plain_words,
    write_words,
)
from infill.gcode.sections import LineMarks, TagState, mark_lines
from infill.gcode.stream import batches
from infill.gcode.strokes import InfillStrokes, find_strokes
from infill.gcode.survey import HEAD, STAMP, TAIL, Survey, survey_print
from infill.gcode.table import GcodeTable, fill_forward_plainly, read_table
from infill.kernels.gcode_lines import fill_forward

NUMBER = rb"[-+]?(?:\d+\.?\d*|\.\d+)"
EIGHTHS = st.integers(-4000, 4000)  # of which every sum is exact, so that nothing here needs a tolerance


# Numbers.


def one_number(token: bytes) -> tuple[float, bool]:
    """Return what is read at the beginning of a token with a blank behind it, and whether it is a number."""
    values, good = read_numbers(np.frombuffer(b"X" + token + b" \n", dtype=np.uint8), np.array([1]))
    return float(values[0]), bool(good[0])


def same(one: float, other: float) -> bool:
    return one == other and np.signbit(one) == np.signbit(other)


@pytest.mark.slow
@settings(max_examples=200)
@given(st.text("0123456789.-+eE_,", max_size=22))
@example("-0")
@example("9999999999999999")  # which no float is
@example("900719925474099.3")
@example("nan")
@example("1_0")
@example("")
@example("-")
@example(".")
@example("1e5")
def test_a_number_is_what_float_says_or_none(token: str) -> None:
    token = re.split("[eE]", token)[0]  # E is a word, here as in Marlin and Klipper
    value, good = one_number(token.encode())
    plain = re.fullmatch(NUMBER, token.encode()) is not None
    assert same(value, float(token)) if good else np.isnan(value)
    assert plain or not good
    if sum(map(str.isdigit, token)) <= MAX_DIGITS:
        assert good == plain


@given(
    st.floats(-1e6, 1e6), st.integers(0, 6), st.sampled_from(["", "+", "0", "00"]), st.sampled_from(" \t\r\n;(*XyfM")
)
def test_what_slicers_write_is_read(value: float, decimals: int, front: str, behind: str) -> None:
    """With and without zeros around, up to whatever may follow a word."""
    plain = f"{value:.{decimals}f}"
    for text in {plain, plain.replace("0.", ".", 1) if plain.lstrip("-").startswith("0.") else plain}:
        front = "" if text.startswith("-") else front
        line = f"G1 X{front}{text}{behind}Y1\n".encode()
        values, good = read_numbers(np.frombuffer(line, dtype=np.uint8), np.array([4]))
        assert good[0]
        assert same(values[0], float(text))


def test_digits_beyond_what_a_float_holds_are_no_number() -> None:
    assert one_number(b"1" * MAX_DIGITS) == (float("1" * MAX_DIGITS), True)
    for token in (b"1" * 17, b"0." + b"1" * 15, b"1" * 300):
        assert not one_number(token)[1]


def test_many_numbers_are_read_as_one_by_one() -> None:
    tokens = [b"1", b"-1.5", b"x", b".25", b"", b"7.", b"--1", b"1.2.3", b"+4"]
    text = b"".join(b"A%s " % token for token in tokens) + b"\n"
    places = np.cumsum([0] + [len(token) + 2 for token in tokens])[:-1] + 1
    values, good = read_numbers(np.frombuffer(text, dtype=np.uint8), places)
    np.testing.assert_array_equal(values, [one_number(token)[0] for token in tokens])
    assert good.tolist() == [one_number(token)[1] for token in tokens] == [1, 1, 0, 1, 0, 1, 0, 0, 1]


@given(st.lists(st.text("0123456789.", max_size=12), min_size=1), st.sampled_from(" ;-X\x00\xff"))
def test_eight_bytes_at_a_time_tell_what_byte_after_byte_does(tokens: list[str], behind: str) -> None:
    text = "".join(token + behind for token in tokens).encode("latin-1") + b"\n"
    places = np.cumsum([0] + [len(token) + 1 for token in tokens])[:-1]
    data = np.frombuffer(text, dtype=np.uint8)
    *quick, whole = parse_short_numbers(data, places)
    for one, other in zip(quick, parse_long_numbers(data, places), strict=True):
        np.testing.assert_array_equal(one[whole], other[whole])
    # A second point ends a number as any other character does.
    read = [re.match(r"\d*\.?\d*", token) for token in tokens]
    assert whole.tolist() == [found is not None and len(found[0]) < WORD for found in read]


def plainly(value: float, decimals: int) -> str:
    """Write a number without needless zeros, by whole numbers."""
    steps = int(np.rint(value * 10.0**decimals))
    whole, rest = divmod(abs(steps), 10**decimals)
    tail = f"{rest:0{decimals}d}".rstrip("0") if decimals else ""
    head = str(whole) if whole or not tail else ""
    return ("-" if steps < 0 else "") + head + ("." + tail if tail else "")


NUMBERS = st.one_of(
    st.just(float("nan")),
    st.sampled_from([0.0, -0.0, 0.5, -0.5, 1e-9, -1e-9, 10.0, 100.0, 0.09999999, 999.9996, -123456789.0]),
    st.floats(-1e6, 1e6),
    st.floats(-2, 2),
)


@pytest.mark.slow
@settings(max_examples=60)
@given(st.lists(st.tuples(NUMBERS, NUMBERS), max_size=8), st.integers(0, 6), st.integers(0, 5))
@example([(9e9, -9e9), (0.0, -0.0)], 5, 3)
def test_words_are_written_to_their_decimals_and_read_back(rows: list[tuple[float, float]], x: int, e: int) -> None:
    columns = [(b" X", np.array([row[0] for row in rows]), x), (b" E", np.array([row[1] for row in rows]), e)]
    written = write_words(columns, b"G1", b"\r\n")
    for codes in (None, np.arange(len(rows), dtype=np.uint8) + ord("0")):
        plain, compiled = (write(columns, b"G1", b"\r\n", codes) for write in (write_plain_words, write_compiled_words))
        assert compiled.text == plain.text
        assert compiled.start.tolist() == plain.start.tolist()
    lines = [written.text[a:b].decode() for a, b in zip(written.start[:-1], written.start[1:], strict=True)]
    assert b"".join(line.encode() for line in lines) == written.text
    expected = [
        "G1" + "".join(f" {name}{plainly(v, d)}" for name, v, d in (("X", one, x), ("E", two, e)) if v == v) + "\r\n"
        for one, two in rows
    ]
    assert lines == expected
    for line, row in zip(lines, rows, strict=True):
        for name, value, decimals in (("X", row[0], x), ("E", row[1], e)):
            found = re.search(f" {name}([^ \r]+)", line)
            assert (found is None) == np.isnan(value)
            if found:
                assert one_number(found[1].encode()) == (np.rint(value * 10.0**decimals) / 10.0**decimals, True)


# Lines.


MODES = ("G90", "G91", "M82", "M83", "G20", "G21", "g91", "M83 ; relative", "  M82", "N7 M83", "g90")
RESETS = ("G92 E0", "G92 X1 Y-2.5", "G92", "G92 Z.5 E-1", "g92 e2", "G28", "G28 X", "G28 W", "G28 Y0 Z0", "G92 E")
OTHERS = ("T0", "T3", "t1", "T12", "TIMELAPSE_TAKE_FRAME", "T?", "G10", "G11", "G10 P0 S200", "G10 S1", "M204 S900")
OTHERS += (
    "M117 G1 X5",
    "EXCLUDE_OBJECT_START NAME=x",
    "M73 P1 R2",
    "G4 P5",
    "G29",
    "%",
    "(remark)",
    "G10;back",
    "G1.1 X3",
)
REMARKS = (";TYPE:FILL", "; G1 X5 E5", "   ;G92 E0", "", "  ", "\t", ";", "N3 ;remark")
ODDS = ("G1 X", "G1 X1 X2", "G1 X1e3", "G1 Xnan", "G1 X--1", "G1 Y1.2.3", "G1 X1 K2", "G1 X{a}", "G1 X=1", "G1 Y2 é3")
ODDS += ("G1 E1 e2", "G1 X1,5", "G1 F9 X" + "1" * 20, 'G1 X"1"', "G2 X1 Y5", "G3", "G1 X1E-05", "G1 X2 (go", "G1 U5")


@st.composite
def number(draw: st.DrawFn) -> str:
    """A number of eighths, spelled in some way."""
    eighths = draw(EIGHTHS)
    text = f"{abs(eighths) / 8:.3f}"
    match draw(st.integers(0, 4)):
        case 0:
            text = text.rstrip("0").rstrip(".")
        case 1:
            text = text.rstrip("0")
        case 2:
            text = "." + text[2:] if text.startswith("0.") else text
        case 3:
            text = "0" + text
    return ("-" if eighths < 0 else draw(st.sampled_from(["", "", "+"]))) + text


@st.composite
def move(draw: st.DrawFn) -> str:
    front = draw(st.sampled_from(["", "", "", " ", "\t ", "N12 ", "n7", "  N8 ", "N9 \t "]))
    name = draw(st.sampled_from(["G1"] * 6 + ["G0", "G01", "g1", "G00", "G2", "G3", "g03"]))
    letters = draw(st.lists(st.sampled_from("XYZEFIJ"), unique=True, max_size=5))
    words = ""
    for letter in letters:
        letter = letter.lower() if draw(st.integers(0, 7)) == 0 else letter
        between = draw(st.sampled_from([" ", " ", " ", "  ", "\t"])) + letter
        words += between + draw(st.sampled_from(["", "", "", " "])) + draw(number())
    return front + name + words + draw(st.sampled_from(["", "", "", " ; X9 E9", ";c", " (Y2)", "*71", "  "]))


@st.composite
def print_text(draw: st.DrawFn) -> list[bytes]:
    lines = draw(
        st.lists(
            st.one_of(move(), move(), move(), *map(st.sampled_from, (MODES, RESETS, OTHERS, REMARKS, ODDS))),
            max_size=14,
        )
    )
    ends = draw(st.lists(st.sampled_from([b"\n", b"\n", b"\r\n"]), min_size=len(lines), max_size=len(lines)))
    if lines and lines[-1] and draw(st.booleans()):
        ends[-1] = b""
    return [line.encode() + end for line, end in zip(lines, ends, strict=True)]


def kind_of(line: bytes) -> tuple[int, int, bytes]:
    """Return what a line is, its code, and its words if it is a move or an arc."""
    line = line.rstrip(b"\r\n")
    line = re.sub(rb"^[Nn]\d+[ \t]*", b"", line.lstrip(b" \t"))
    if not line:
        return BLANK, -1, b""
    if line.startswith(b";"):
        return COMMENT, -1, b""
    found = re.match(rb"[Gg]0?([0-3])(?![\d.])", line)
    if not found:
        return OTHER, -1, b""
    words = re.split(rb"[;(*]", line[found.end() :])[0]
    word = rb"[XYZEFIJ] ?" + NUMBER + rb"(?=[\sA-Z]|$)"
    letters = re.findall(rb"[A-Z]", words.upper())
    fine = re.fullmatch(rb"(?:\s*%s)*\s*" % word, words.upper()) and len(set(letters)) == len(letters)
    fine = fine and not re.search(rb"\d{16}|\d[eE][-+]|\de", words) and b"(go" not in line
    fine = fine and (int(found[1]) < 2 or not {b"I", b"J"}.isdisjoint(letters))
    code = int(found[1])
    return (ARC if code > 1 else MOVE) if fine else ODD, code, words


def slowly(lines: Sequence[bytes], state: MachineState) -> tuple[list[tuple[Any, ...]], MachineState]:
    """Read line by line: kind, x, y, z, e, f, extruded and whether E is relative, and the state at the end."""
    rows = []
    for line in lines:
        kind, _, words = kind_of(line)
        pushed = 0.0
        if kind in (MOVE, ARC):
            said = {
                letter.upper().decode(): float(value)
                for letter, value in re.findall(rb"([A-Za-z]) ?(%s)" % NUMBER, words)
            }
            for name in "xyz":
                if (value := said.get(name.upper())) is not None:
                    state = replace(state, **{name: value + (getattr(state, name) if state.relative else 0.0)})
            if "E" in said:
                pushed = said["E"] - (0.0 if counts_from_last_move(state) else state.e)
                depth = max(0.0, state.retracted - pushed)
                state = replace(state, e=state.e + pushed, retracted=depth)
            state = replace(state, f=said.get("F", state.f))
            state = replace(state, letters=state.letters or "E" * ("E" in said))
            state = replace(state, lost="".join(axis for axis in state.lost if axis not in said))
        elif kind == OTHER:
            state = after_command(line, state)
        elif kind == ODD:
            state = replace(state, lost="XY")
        relative = counts_from_last_move(state)
        rows.append((kind, state.x, state.y, state.z, state.e, state.f, pushed, relative))
    return rows, state


def counts_from_last_move(state: MachineState) -> bool:
    """Return whether E is relative by Marlin's rule, as its pages of G90, G91, M82 and M83 have it."""
    return state.relative_e or (state.relative and not state.absolute_e)


def after_command(line: bytes, state: MachineState) -> MachineState:
    text = re.sub(r"^[Nn]\d+ ?", "", line.decode().strip()).split(";")[0].upper()
    name, *rest = text.split() or [""]
    said = {word[0]: float(word[1:] or 0) for word in rest if re.fullmatch(r"[A-Z][-+.\d]*", word)}
    changes: dict[str, dict[str, Any]] = {
        "G90": {"relative": False, "absolute_e": False},
        "G91": {"relative": True, "absolute_e": False},
        "M82": {"relative_e": False, "absolute_e": True},
        "M83": {"relative_e": True, "absolute_e": False},
        "G20": {"inches": True},
        "G21": {"inches": False},
        "G11": {"firmware_retracted": False},
        "G10": {} if said.keys() & {"P"} else {"firmware_retracted": True},
        "G28": {axis: float("nan") for axis in "xyz" if axis.upper() in said or not said.keys() & set("XYZ")},
        "G92": {axis: said.get(axis.upper(), 0.0) for axis in "xyze" if axis.upper() in said or not said},
    }
    if re.fullmatch(r"T\d+", name):
        return replace(state, tool=int(name[1:]))
    return replace(state, **changes.get(name, {}))


COLUMNS = ("kind", "x", "y", "z", "e", "f", "extruded", "relative_e")
BEGIN = MachineState(x=1.0, y=2.0, z=3.0, e=4.0, f=600.0)


@pytest.mark.longest
@settings(max_examples=120)
@given(
    print_text(),
    st.sampled_from([MachineState(), BEGIN, replace(BEGIN, relative=True), replace(BEGIN, relative_e=True)]),
)
def test_a_table_is_what_reading_line_by_line_gives(lines: list[bytes], state: MachineState) -> None:
    data = b"".join(lines)
    table = read_table(data, state)
    rows, after = slowly(lines, state)
    assert len(table) == len(lines)
    assert [table.text(k, k + 1) for k in range(len(lines))] == lines
    for place, name in enumerate(COLUMNS):
        np.testing.assert_array_equal(getattr(table, name), [row[place] for row in rows], err_msg=f"{name} of {data!r}")
    np.testing.assert_equal(astuple(table.after), astuple(after))
    assert table.before is state
    assert [command.line for command in table.commands] == [k for k, r in enumerate(rows) if r[0] in (OTHER, ODD)]
    for line, codes, numbered in zip(lines, table.code.tolist(), table.numbered.tolist(), strict=True):
        assert numbered == bool(re.match(rb"\s{0,8}[Nn]\d", line))
        assert codes == kind_of(line)[1]


FRAGMENTS = (
    *(b"G1", b"G0", b"G01", b"G2 ", b"g3", b"G1 X", b"N12", b"n3 ", b"M204 S5", b"G1 X1 Y2 ", b"G1 X1 (a) ", b"(b)*12"),
    *(
        b" X",
        b"Y",
        b"E",
        b"e",
        b"I",
        b"J",
        b"F",
        b"Z",
        b"K",
        b"1",
        b"2.5",
        b"-.5",
        b"+3",
        b"-",
        b".",
        b"1e-5",
        b"=",
        b'"',
    ),
    *(
        b" ",
        b"  ",
        b"\t",
        b"         ",
        b";",
        b"(",
        b")",
        b"*7",
        b"12345678901",
        b"99999999",
        b"\xff",
        b"\r",
        b"\n",
        b"\n",
    ),
)


@pytest.mark.slow
@settings(max_examples=400)
@given(st.lists(st.sampled_from(FRAGMENTS), min_size=1, max_size=40).map(b"".join))
@example(b"G1 X1.5 Y-.25 E1e-5")
@example(b"G1 X1 X2\nG1 X1 (a) Y2\nG1 X1 (a) *7 ; b\n")
@example(b"         G1 X1\n        G1 X1\nN123456789012 G1 X1\n")
def test_compiled_reading_is_that_of_numpy(data: bytes) -> None:
    text = np.frombuffer(data if data.endswith(b"\n") else data + b"\n", dtype=np.uint8)
    start = np.append(0, np.flatnonzero(text == ord("\n")) + 1)
    start[-1] = len(data)
    names = ("kind", "code", "numbered", "values", "given")
    for name, plain, compiled in zip(
        names, read_plain_lines(text, start), read_compiled_lines(text, start), strict=True
    ):
        assert plain.dtype == compiled.dtype
        np.testing.assert_array_equal(compiled, plain, err_msg=f"{name} of {data!r}")
        if name == "values":
            np.testing.assert_array_equal(np.signbit(compiled), np.signbit(plain))


@given(st.lists(st.sampled_from([float("nan"), -0.0, 1.0, 2.5])), st.sampled_from([float("nan"), 7.0]))
def test_compiled_filling_is_that_of_numpy(values: list[float], before: float) -> None:
    """Of columns that lie apart in memory, too."""
    rows = np.array([values, values]).T
    plain, filled = fill_forward_plainly(rows[:, 1], before), np.empty(len(values))
    fill_forward(rows[:, 1], before, filled)
    np.testing.assert_array_equal(filled, plain)


@pytest.mark.slow
@settings(max_examples=60)
@given(print_text(), st.integers(0, 14))
def test_a_print_read_in_two_batches_is_the_same(lines: list[bytes], cut: int) -> None:
    whole = read_table(b"".join(lines), BEGIN)
    one = read_table(b"".join(lines[:cut]), BEGIN)
    two = read_table(b"".join(lines[cut:]), one.after)
    for name in (*COLUMNS, "given", "i", "j", "code", "numbered"):
        both = np.concatenate([getattr(one, name), getattr(two, name)])
        np.testing.assert_array_equal(both, getattr(whole, name), err_msg=name)
    np.testing.assert_equal(astuple(two.after), astuple(whole.after))
    shifted = [replace(command, line=command.line + len(one)) for command in two.commands]
    assert [*one.commands, *shifted] == list(whole.commands)


def test_words_that_a_line_gives_are_told_apart_from_what_it_inherits() -> None:
    table = read_table(b"G1 X1 F900\nG2 Y2 I.5 J-1 E.25\n;G1 X9\nG1\n", MachineState())
    assert table.given.tolist() == [
        [True, False, False, False, True, False, False],
        [False, True, False, True, False, True, True],
        [False] * 7,
        [False] * 7,
    ]
    np.testing.assert_array_equal(table.i, [np.nan, 0.5, np.nan, np.nan])
    np.testing.assert_array_equal(table.j, [np.nan, -1, np.nan, np.nan])
    assert table.x.tolist() == [1.0] * 4


@pytest.mark.parametrize("line", ODDS)
def test_what_cannot_be_read_for_certain_is_odd_and_moves_nothing(line: str) -> None:
    table = read_table(line.encode() + b"\n", BEGIN)
    assert table.kind.tolist() == [ODD]
    assert not table.given.any()
    assert table.unread.all()
    assert table.after == replace(BEGIN, lost="XY")


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        (b"M204 P500 T1000 ; X3", "M204", {"P": 500.0, "T": 1000.0}),
        (b"N9 m0106 S.5", "M106", {"S": 0.5}),
        (b"G28 W", "G28", {"W": None}),
        (b"T2", "T2", {}),
        (b"M73.2 R1.0", "M73.2", {"R": 1.0}),
        (b"SET_PRESSURE_ADVANCE ADVANCE=0.1", "SET_PRESSURE_ADVANCE", {}),
        (b"M104 S" + b"9" * 16, "M104", {"S": None}),
    ],
)
def test_a_command_has_its_code_and_its_numbers(line: bytes, code: str, words: dict[str, float | None]) -> None:
    (command,) = read_table(b";\n" + line + b"\n", MachineState()).commands
    assert (command.line, command.code, command.words) == (1, code, words)


def test_an_empty_text_is_an_empty_table() -> None:
    table = read_table(b"", BEGIN)
    assert len(table) == 0
    assert table.start.tolist() == [0]
    assert table.after == BEGIN


def test_a_blank_line_is_blank_with_and_without_its_end() -> None:
    for text in (b"\n", b"\r\n", b"  \n", b"  ", b"\t", b" \r\n"):
        assert read_table(b"G1 X1\n" + text, MachineState()).kind.tolist() == [MOVE, BLANK]


# Batches.


LAYERS = (b";LAYER_CHANGE\n", b"; CHANGE_LAYER\n", b";LAYER:7\n")


@st.composite
def layered(draw: st.DrawFn) -> bytes:
    some = st.sampled_from(
        [*LAYERS, *LAYERS, b"G1 X1 Y2 E.5\n", b";LAYER_COUNT:9\n", b"\n", b"; ;LAYER:1\n", b"M73 P1\r\n"]
    )
    return b"".join(draw(st.lists(some, max_size=40))) + draw(st.sampled_from([b"", b"G1 X5", b";LAYER:"]))


@given(layered(), st.integers(1, 120))
def test_batches_are_the_file_and_begin_at_layers(text: bytes, size: int) -> None:
    found = list(batches(io.BytesIO(text), size))
    assert b"".join(found) == text
    assert all(found)
    for batch in found[1:]:
        assert batch.startswith((b";LAYER_CHANGE", b"; CHANGE_LAYER", b";LAYER:"))


class Counting(io.RawIOBase):
    """A file that is made as it is read, and remembers the most that was asked for at once."""

    def __init__(self, layer: bytes, count: int) -> None:
        self.left = layer * count
        self.at = 0
        self.most = 0

    def read(self, size: int = -1) -> bytes:
        self.most = max(self.most, size)
        text = self.left[self.at : self.at + size]
        self.at += len(text)
        return text


def test_a_batch_is_no_longer_than_what_is_asked_and_a_layer() -> None:
    layer = LAYERS[0] + b"G1 X1 Y2 E.5\n" * 50
    file = Counting(layer, 2000)
    size = 10_000
    lengths = [len(batch) for batch in batches(file, size)]
    assert sum(lengths) == len(layer) * 2000
    assert max(lengths) <= size + len(layer)
    assert file.most == size


def test_after_a_long_layer_batches_are_as_short_as_before() -> None:
    layer = LAYERS[0] + b"G1 X1 Y2 E.5\n" * 50
    long = LAYERS[0] + b"G1 X1 Y2 E.5\n" * 20_000
    size = 10_000
    found = list(batches(io.BytesIO(layer * 20 + long + layer * 2000), size))
    longest = max(range(len(found)), key=lambda k: len(found[k]))
    assert max(map(len, found[longest + 2 :])) <= size + len(layer)
    assert len(found[longest]) <= 2 * (len(long) + size)  # what is asked doubles until the layer ends


def test_a_layer_longer_than_any_is_cut_between_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stream, "MAX_LAYER_BYTES", 4096)
    line = b"G1 X1 Y2 E.5\n"
    found = list(batches(io.BytesIO(line * 5000), 256))
    assert b"".join(found) == line * 5000
    assert all(batch.endswith(b"\n") for batch in found)
    assert max(map(len, found)) <= 2 * 4096  # what is asked doubles up to the limit


@pytest.mark.parametrize("size", [1 << 10, 1 << 14, 1 << 17])
@pytest.mark.parametrize(("front", "behind"), [(0, 0), (0, 9000), (3000, 9000), (40_000, 9000)])
def test_a_line_that_is_too_long_is_refused_wherever_it_is(
    size: int, front: int, behind: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stream, "MAX_LINE_BYTES", 8192)
    around = b"G1 X1\n"
    for longest in (8192, 8193):
        text = around * (front // 6) + b";" * longest + b"\n" + around * (behind // 6)
        if longest == 8192:
            assert b"".join(batches(io.BytesIO(text), size)) == text
        else:
            with pytest.raises(FormatError, match=r"^a line of more than [^\n]*$"):
                list(batches(io.BytesIO(text), size))


# Tags and strokes.


ORIGIN = MachineState(x=0.0, y=0.0, z=0.2)
NOTHING_SAID = TagState()


def read_all(
    text: bytes, before: MachineState = ORIGIN, tags: TagState = NOTHING_SAID
) -> tuple[GcodeTable, LineMarks, InfillStrokes]:
    table = read_table(text, before)
    marks = mark_lines(table, tags)
    return table, marks, find_strokes(table, marks)


def role_after(text: bytes) -> str:
    _, marks, _ = read_all(text)
    assert marks.roles[marks.role[-1]] == marks.after.role
    return marks.after.role


@pytest.mark.slow
@pytest.mark.parametrize(
    "tag", [b";TYPE:Internal infill", b"; FEATURE: Sparse infill", b";TYPE:FILL", b";TYPE:Sparse infill"]
)
@pytest.mark.parametrize("layer", [b";LAYER_CHANGE", b"; CHANGE_LAYER", b";LAYER:3"])
@pytest.mark.parametrize("end", [b"\n", b"\r\n"])
def test_both_families_of_tags_and_those_of_cura(tag: bytes, layer: bytes, end: bytes) -> None:
    lines = [layer, tag, b"M83", b"G1 X1 E.1 F900", b"G1 X2 E.1", layer, b"G1 X3 E.1", b"G1 X4 E.1", b""]
    table, marks, infill = read_all(end.join(lines))
    assert marks.layer.tolist() == [1, 1, 1, 1, 1, 2, 2, 2]
    # PrusaSlicer says it once where all layers are of infill alone.
    assert marks.is_role("sparse infill").tolist() == [False, True, True, True, True, True, True, True]
    assert marks.tagged.tolist() == [True, True, False, False, False, True, False, False]
    assert (len(infill), infill.line.tolist()) == (2, [2, 3, 4, 5, 6, 7])
    assert infill.points.tolist() == [[0, 0], [1, 0], [2, 0], [2, 0], [3, 0], [4, 0]]
    assert table.data[table.start[3] :].startswith(b"G1 X1")


def test_a_role_is_that_of_the_last_tag() -> None:
    assert role_after(b"G1 X1\n") == "untagged"
    assert role_after(b";TYPE:Internal infill\n;TYPE:Gap fill\n") == "gap fill"
    assert role_after(b";TYPE:FILL\n;TYPE:Something else\n") == "other"
    assert role_after(b";TYPE:FILL\n;TYPE:\n") == "untagged"
    assert role_after(b"  ;TYPE:FILL\n;MESH:a.stl\n") == "sparse infill"
    assert role_after(b"M117 ;TYPE:FILL\n") == "untagged"  # which the machine shows


def test_widths_heights_and_accelerations_are_inherited() -> None:
    text = b"G1 X1\n;WIDTH:0.45\n;TYPE:FILL\n;HEIGHT:0.2\nM204 S800\n;LAYER_CHANGE\n; LINE_WIDTH: 0.5\nM204 P900 T5\n"
    text += b";WIDTH:nonsense\n;HEIGHT:-1\n;WIDTH:1e9\n;WIDTH:nan\nM204 T4\nG1 X2\n"
    _, marks, _ = read_all(text, tags=TagState(height=0.3))
    nan = float("nan")
    np.testing.assert_array_equal(marks.width, [nan] + [0.45] * 5 + [0.5] * 8)
    np.testing.assert_array_equal(marks.height, [0.3] * 3 + [0.2] * 11)
    np.testing.assert_array_equal(marks.acceleration, [nan] * 4 + [800.0] * 3 + [900.0] * 7)
    assert (marks.after.width, marks.after.height, marks.after.acceleration) == (0.5, 0.2, 900.0)


TAGGED = (b";TYPE:FILL\n", b";TYPE:Perimeter\n", b";LAYER_CHANGE\n", b";WIDTH:.5\n", b";WIPE_START\n", b";WIPE_END\n")
TAGGED += (b"; printing object a\n", b"; stop printing object a\n", b"M204 S5\n", b"G1 X1\n", b"; remark\n", b"T1\n")


@pytest.mark.slow
@given(st.lists(st.sampled_from(TAGGED), max_size=14), st.integers(0, 14))
def test_tags_read_in_two_batches_are_the_same(lines: list[bytes], cut: int) -> None:
    whole = mark_lines(read_table(b"".join(lines), MachineState()), TagState())
    one = mark_lines(read_table(b"".join(lines[:cut]), MachineState()), TagState())
    two = mark_lines(read_table(b"".join(lines[cut:]), MachineState()), one.after)
    np.testing.assert_equal(two.after, whole.after)
    for name in ("layer", "width", "height", "acceleration", "wiping", "tagged"):
        both = np.concatenate([getattr(one, name), getattr(two, name)])
        np.testing.assert_array_equal(both, getattr(whole, name), err_msg=name)
    names = [marks.roles[k] for marks in (one, two) for k in marks.role]
    assert names == [whole.roles[k] for k in whole.role]
    keys = list(zip(names, whole.layer.tolist(), strict=True))
    for k in range(1, len(keys)):  # a section goes on as long as nothing is said
        said = keys[k] != keys[k - 1] or b"object" in lines[k]
        assert (whole.section[k] != whole.section[k - 1]) == said


def test_what_is_purged_into_the_infill_is_no_infill() -> None:
    stroke = b"G1 X1 E.1\nG1 X2 E.1\n"
    text = (
        b"M83\n;TYPE:FILL\n"
        + b"G1 X0 F900\n"
        + stroke
        + b"T1\n;TYPE:FILL\n"
        + stroke
        + b"; PURGING FINISHED\n"
        + stroke
    )
    _, marks, infill = read_all(text)
    assert [marks.roles[k] for k in marks.role[5:10]] == ["wipe tower"] * 4 + ["sparse infill"]
    assert len(infill) == 2
    assert infill.line[infill.first[:-1]].tolist() == [2, 9]


# A stroke of two moves with something between them: whether it is still one stroke.
BETWEEN: dict[str, bool] = {
    "": True,
    "; remark\n": True,
    "\n": True,
    "M73 P5 R3\n": True,
    "M117 hello\n": True,
    "G1 F900\n": True,  # as it was
    "G1 F1200\n": False,
    "G1 F1200\nG1 F900\n": False,
    "G0 X9 Y0\nG0 X10 Y0\n": False,
    "G1 E-.8\nG1 E.8\n": False,
    "G10\nG11\n": False,
    "M106 S5\n": False,
    "M204 S5\n": False,
    "G92 E0\n": False,
    "T1\n": False,
    ";WIDTH:0.5\n": False,
    ";TYPE:FILL\n": False,
    "; printing object a\n": False,
    "G1 Z.4\nG1 Z.2\n": False,
    "G1 U3 X10 Y0\n": False,
    "G2 X10 Y0 I0 J0 E.1\nG1 X10 Y0\n": False,  # which cannot be read, so that the place must be said again
}


@pytest.mark.parametrize("between", BETWEEN)
def test_what_ends_a_stroke(between: str) -> None:
    text = f"M83\n;TYPE:FILL\nG1 F900\nG1 X10 E1\n{between}G1 Y10 E1\nG1 X0 E1\n".encode()
    table, _, infill = read_all(text)
    assert len(infill) == (1 if BETWEEN[between] else 2)
    lines = [k for k in range(len(table)) if table.text(k, k + 1) in (b"G1 X10 E1\n", b"G1 Y10 E1\n", b"G1 X0 E1\n")]
    ends = np.delete(infill.line, infill.first[:-1])
    assert ends.tolist() == lines
    assert infill.line[infill.first[:-1]].tolist() == [infill.line[k + 1] - 1 for k in infill.first[:-1]]


# A move that is in no stroke, though it stands under the tag of the infill.
@pytest.mark.parametrize(
    "line",
    [
        "G1 X20 Y9",
        "G1 X20 Y9 E-.1",
        "G1 X20 Y9 Z.4 E1",
        "N5 G1 X20 Y9 E1",
        "G2 X20 Y9 I1 J1 E1",
        "G3 X20 Y10 I5 J0 Z.4 E1",
        "G3 X20 Y10 R2 E1",
        "G1 E1",
        "G1 X10 Y10 E1",
    ],
)
def test_what_is_in_no_stroke(line: str) -> None:
    _, _, infill = read_all(f"M83\n;TYPE:FILL\nG1 F900\nG1 X10 E1\nG1 Y10 E1\n{line}\n".encode())
    assert infill.line.tolist() == [2, 3, 4]
    _, _, infill = read_all(f"M83\n;TYPE:FILL\nG1 F900\n{line}\n".encode(), MachineState(x=10.0, y=10.0, z=0.2))
    assert len(infill) == 0
    assert infill.points.shape == (0, 2)
    assert infill.first.tolist() == [0]


@pytest.mark.parametrize("mode", ["G91", "G20", "; WIPE_START", ";TYPE:Perimeter"])
def test_nothing_is_drawn_where_moves_mean_something_else(mode: str) -> None:
    text = f"M83\n;TYPE:FILL\nG1 X10 E1 F900\n{mode}\nG1 Y10 E1\nG1 X20 E1\n; WIPE_END\n".encode()
    assert read_all(text)[2].line.tolist() == [1, 2]


@pytest.mark.slow
@given(st.lists(st.tuples(EIGHTHS, EIGHTHS), min_size=2, max_size=9, unique=True), st.booleans(), st.data())
def test_strokes_are_the_runs_of_one_rate(points: list[tuple[int, int]], absolute: bool, data: st.DataObject) -> None:
    """A path with changes of the filament per mm of 5 % or of nothing, in absolute or relative E."""
    rates = data.draw(st.lists(st.sampled_from([0.04, 0.042]), min_size=len(points) - 1, max_size=len(points) - 1))
    path = np.array(points) / 8
    steps = np.hypot(*np.diff(path, axis=0).T)
    assume(steps.min() >= 0.5)  # mm: shorter ones leave the rate open by more than 2 %
    pushed = np.round(steps * rates, 5)
    words = np.cumsum(pushed) if absolute else pushed
    text = f"M8{'2' if absolute else '3'}\n;TYPE:FILL\nG1 F1800\n"
    text += "".join(f"G1 X{x:.3f} Y{y:.3f} E{e:.5f}\n" for (x, y), e in zip(path[1:].tolist(), words, strict=True))
    _, _, infill = read_all(text.encode(), MachineState(x=float(path[0, 0]), y=float(path[0, 1]), z=0.2))
    breaks = np.flatnonzero(np.diff(rates)) + 1
    runs = np.split(np.arange(len(rates)), breaks)
    assert len(infill) == len(runs)
    for k, run in enumerate(runs):
        at = slice(int(infill.first[k]), int(infill.first[k + 1]))
        np.testing.assert_array_equal(infill.points[at], path[run[0] : run[-1] + 2])
        assert infill.line[at].tolist() == [run[0] + 2, *(run + 3).tolist()]
        # Sums of at most eight numbers of that size: rounding alone.
        assert infill.length[k] == pytest.approx(steps[run].sum(), rel=1e-12)
        assert infill.filament[k] == pytest.approx(pushed[run].sum(), rel=1e-9)


# A print at a glance.


def looked_at(text: bytes) -> Survey:
    file = io.BytesIO(text)
    found = survey_print(file)
    assert file.tell() == 0
    assert found.size == len(text)
    return found


@pytest.mark.parametrize(
    ("line", "name"),
    [
        (b"; generated by PrusaSlicer 2.9.4+linux-x64 on 2026-01-02 at 03:04:05 UTC", "PrusaSlicer 2.9.4+linux-x64"),
        (b"; generated by SuperSlicer 2.5.59 on 2024-01-01 at 10:00:00", "SuperSlicer 2.5.59"),
        (b"; generated by OrcaSlicer 2.3.1 on 2026-01-02 at 03:04:05", "OrcaSlicer 2.3.1"),
        (b"; generated by Slic3r Prusa Edition 1.41.0 on 2018-01-01", "Slic3r Prusa Edition 1.41.0"),
        (b"; BambuStudio 02.00.03.54", "BambuStudio 02.00.03.54"),
        (b";Generated with Cura_SteamEngine 5.8.1", "Cura_SteamEngine 5.8.1"),
        (b";Sliced by ideaMaker 4.3.3.6560, 2023-01-01", "ideaMaker 4.3.3.6560"),
        (b"; a print of my own", ""),
    ],
)
@pytest.mark.parametrize("end", [b"\n", b"\r\n"])
def test_what_each_slicer_calls_itself(line: bytes, name: str, end: bytes) -> None:
    assert looked_at(b"; HEADER_BLOCK_START" + end + line + end + b"G1 X1" + end).slicer == name


@pytest.mark.parametrize(
    ("value", "told", "number"),
    [
        ("0.45", "0.45", 0.45),
        ("0.45,0.5", "0.45,0.5", 0.45),
        ("15%", "15%", 15.0),
        ("a = b = c", "a = b = c", None),
        ("", "", None),
        ("nan", "nan", None),
        ("inf", "inf", None),
        ("caf\xe9;\\nG1 X5", "caf\xe9;\\nG1 X5", None),
        ("  7  ", "7", 7.0),
        ("x" * 70_000, "x" * 70_000, None),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_settings_of_any_value(value: str, told: str, number: float | None, end: str) -> None:
    found = looked_at(f"G1 X1{end}; nozzle_x = {value}{end}; layer_height = 0.2{end};not_one = 3{end}".encode())
    assert found.settings["nozzle_x"] == told
    assert found.number("nozzle_x") == number
    assert found.number("missing", "nozzle_x", "layer_height") == (0.2 if number is None else number)
    assert found.number("missing") is None
    assert set(found.settings) == {"nozzle_x", "layer_height"}


def test_bytes_that_are_no_utf8_do_not_stop_it() -> None:
    found = looked_at(b"G1 X1\n; printer_model = caf\xe9\n")
    assert found.settings["printer_model"] == "caf\N{REPLACEMENT CHARACTER}"


def test_settings_are_found_at_the_end_of_a_long_print() -> None:
    filling = b"G1 X1 Y1 E.5\n" * ((HEAD + TAIL) // 10)
    text = b"; early = 1\nM83\n" + filling + b"; middle = 2\n" + filling + b"; late = 3\n"
    assert looked_at(text).settings == {"early": "1", "late": "3"}


def test_the_modes_and_the_windows_of_a_print() -> None:
    layer = b";LAYER_CHANGE\n;TYPE:Internal infill\n" + b"G1 X1 Y1 E.1\nG1 X2 Y1 E.1\n" * 30
    front = b"G21\nM83\nG1 E-2 F1800\nT1\n"
    found = looked_at(front + layer * 400 + b"G91\nM82\n")
    begin = found.begin
    assert (begin.relative, begin.relative_e, begin.tool, begin.retracted, begin.f) == (False, True, 1, 2.0, 1800.0)
    assert np.isnan([begin.x, begin.y, begin.z]).all()
    assert found.windows
    for window, height in found.windows:
        assert window == layer * 3
        assert np.isnan(height)  # no line gives one
    assert found.layers == pytest.approx(400, rel=0.01)  # layers are alike; what stands before the first is not
    assert not found.resets_filament
    assert not found.stamp


@pytest.mark.parametrize(("field", "line"), [("stamp", STAMP + b" 0.5.0"), ("resets_filament", b"G92 E0")])
def test_what_a_print_tells_of_itself(field: str, line: bytes) -> None:
    assert getattr(looked_at(line + b"\nG1 X1\n"), field)
    assert not getattr(looked_at(b"G1 X1\n"), field)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (b"", "the file is empty"),
        (b"PK\x03\x04 and more\nG1 X1\n", "a zip or 3MF file"),
        (b"\x89PNG\r\n\x1a\n", "a picture"),
        (b"\xff\xd8\xff\xe0", "a picture"),
        (b"%PDF-1.4\n", "a PDF file"),
        (b"solid cube\nfacet\n", "an STL file"),
        (b"G1 X1\n\0\0", "bytes that no text has"),
        (b"hello\nworld\n", "no line of G-code"),
        (b"x" * (9 << 20), "has no lines"),
    ],
)
def test_what_is_no_gcode_is_refused_in_one_line(text: bytes, told: str) -> None:
    with pytest.raises(FormatError) as error:
        survey_print(io.BytesIO(text))
    assert told in str(error.value)
    assert "G-code" in str(error.value)
    assert "\n" not in str(error.value)
