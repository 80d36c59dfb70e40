"""`verify`: every planted fault is found on its line, nothing is found where nothing changed, bad input is one line."""

from __future__ import annotations

import contextlib
import json
import re
import struct
import tempfile
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_command_line import one_line_error, run, usage_error

from infill import FormatError, InfillError, ParameterError, UsageError, Verification, Violation, refill, verify
from infill.verifying.alignment import longest_rise
from infill.verifying.settings import KINDS
from tests.arc_fitting import fit_arcs
from tests.gcode_corpus import CORPUS, prints
from tests.handmade_prints import Dialect, written
from tests.planted_faults import (
    FAULTS,
    FAULTS_OF_INFILL,
    FAULTS_OF_LABELS,
    Planted,
    next_bead,
    places,
    wall_beads,
)

Fault = tuple[str, Callable[[list[bytes]], Planted]]
# Relative and absolute E of PrusaSlicer, Cura, Klipper's objects, Bambu Studio, M486, words without blanks.
DIALECTS = ("prusa", "prusa-absolute", "cura-by-hand", "orca", "bambu", "sequential", "packed")
# Faults that a dialect has no place for.
IMPOSSIBLE = {("cura-by-hand", "no lift"), ("packed", "no lift")}
LABELLED = {"orca": FAULTS_OF_LABELS, "sequential": FAULTS_OF_LABELS}


def made(name: str, prints: Mapping[str, Path]) -> Path:
    if CORPUS[name].missing():
        pytest.skip(CORPUS[name].missing())
    return prints[name]


def missed(old: Path, lines: list[bytes], faults: Mapping[str, Fault], scratch: Path) -> list[str]:
    """Plant each fault; describe those that are not found on their line."""
    wrong = []
    for name, (kind, plant) in faults.items():
        planted = plant(list(lines))
        new = scratch / "planted.gcode"
        new.write_bytes(b"".join(planted.lines))
        violations = verify(old, new).violations
        last = next_bead(planted)
        right = [
            each
            for each in violations
            if each.kind == kind and (planted.line <= each.line <= last or f"set at line {planted.line}" in each.text)
        ]
        if not right:
            wrong.append(f"{name}: {kind} at line {planted.line} to {last}, not in {list(map(str, violations[:5]))}")
    return wrong


# --- positive controls ---------------------------------------------------------------------------------------


def test_faults_are_many_and_of_many_kinds() -> None:
    """What the tests below plant: at least 40 different faults of 12 kinds or more, on at least 5 dialects."""
    faults = FAULTS | FAULTS_OF_LABELS | FAULTS_OF_INFILL
    assert len(faults) == len(FAULTS) + len(FAULTS_OF_LABELS) + len(FAULTS_OF_INFILL) >= 40
    assert {kind for kind, _ in faults.values()} == set(KINDS)
    assert len(KINDS) >= 12
    assert len(DIALECTS) >= 5


@pytest.mark.slow
@pytest.mark.parametrize("dialect", DIALECTS)
def test_every_planted_fault_is_found_on_its_line(
    dialect: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path
) -> None:
    path = made(dialect, prints_of_all_kinds)
    faults = {name: fault for name, fault in FAULTS.items() if (dialect, name) not in IMPOSSIBLE}
    lines = path.read_bytes().splitlines(keepends=True)
    assert missed(path, lines, faults | LABELLED.get(dialect, {}), tmp_path) == []


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["keep", "honeycomb"])
@pytest.mark.parametrize("dialect", ["prusa", "cura-by-hand", "orca", "bambu", "sequential"])
def test_faults_of_a_refilled_print_are_found(
    dialect: str, pattern: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path
) -> None:
    """In its infill, whose paths are free, and outside of it."""
    path, smooth = made(dialect, prints_of_all_kinds), tmp_path / "smooth.gcode"
    refill(path, output=smooth, pattern=pattern)
    faults = {name: fault for name, fault in FAULTS.items() if (dialect, name) not in IMPOSSIBLE}
    assert missed(path, smooth.read_bytes().splitlines(keepends=True), FAULTS_OF_INFILL | faults, tmp_path) == []


def test_a_binary_print_is_compared_with_its_text(tmp_path: Path) -> None:
    """Lines are those of the text inside."""
    old, binary = tmp_path / "old.gcode", tmp_path / "new.bgcode"
    text = written(Dialect(layers=4))
    old.write_bytes(text)
    binary.write_bytes(binary_print(text))
    assert verify(old, binary).agrees
    planted = FAULTS["a hotter nozzle"][1](text.splitlines(keepends=True))
    binary.write_bytes(binary_print(b"".join(planted.lines)))
    (violation,) = verify(old, binary).violations
    assert violation.text == f"nozzle 245 °C, was 215 °C, set at line {planted.line}"


def binary_print(text: bytes) -> bytes:
    """Write a text as binary G-code: a header, metadata, and blocks of G-code without compression."""

    def block(kind: int, data: bytes) -> bytes:
        body = struct.pack("<HHI", kind, 0, len(data)) + struct.pack("<H", 0) + data
        return body + struct.pack("<I", zlib.crc32(body))

    pieces = [text[i : i + 50_000] for i in range(0, len(text), 50_000)]
    blocks = [block(0, b"Producer=PrusaSlicer 2.9.0\n"), block(3, b""), block(4, b""), block(2, b"")]
    return b"".join([struct.pack("<4sIH", b"GCDE", 1, 1), *blocks, *(block(1, piece) for piece in pieces)])


def test_what_looks_for_missed_faults_can_miss_one(prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    path = prints_of_all_kinds["orca"]
    lines = path.read_bytes().splitlines(keepends=True)
    harmless = {"a remark": ("fan", lambda before: Planted([b"; a remark\n", *before], 1))}
    assert missed(path, lines, harmless, tmp_path)[0].startswith("a remark: fan at line 1")


# --- negative controls ---------------------------------------------------------------------------------------


def without_comments(text: bytes) -> bytes:
    return re.sub(rb"(?m)(^;[^\n]*\n| *;[^\n\r]*)", b"", text)


def with_line_numbers(text: bytes) -> bytes:
    lines = enumerate(re.sub(rb"(?m)^N\d+ ", b"", text).split(b"\n"), 1)
    return b"\n".join(b"N%d %s" % (i, line) if line[:1] in b"GM" and line else line for i, line in lines)


def with_other_progress(text: bytes) -> bytes:
    return re.sub(rb"M73 P\d+ R\d+", b"M73 P7 R3", text)


def with_more_comments(text: bytes) -> bytes:
    return text.replace(b"\nG1 ", b"\n; G1 X0 Y0 E50 F0\nG1 ")


def with_fewer_decimals(text: bytes) -> bytes:
    return re.sub(rb"([XY]-?\d*\.\d\d)\d", rb"\1", text)


def with_other_line_ends(text: bytes) -> bytes:
    return text.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")


def with_arcs(text: bytes) -> bytes:
    return fit_arcs(text)


HARMLESS = (
    without_comments,
    with_line_numbers,
    with_other_progress,
    with_more_comments,
    with_fewer_decimals,
    with_other_line_ends,
    with_arcs,
)


@pytest.mark.long
@pytest.mark.parametrize("change", HARMLESS, ids=lambda change: change.__name__)
def test_a_change_of_the_text_alone_is_no_violation(
    change: Callable[[bytes], bytes], prints_of_all_kinds: Mapping[str, Path], tmp_path: Path
) -> None:
    """In every print of the corpus that can be made here."""
    new, compared = tmp_path / "new.gcode", 0
    for name, entry in CORPUS.items():
        if entry.missing():
            continue
        old = prints_of_all_kinds[name]
        new.write_bytes(change(old.read_bytes()))
        result = verify(old, new)
        assert list(map(str, result.violations)) == [], name
        compared += 1
    assert compared >= 15


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["keep", "gyroid"])
def test_a_refill_is_no_violation(pattern: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    """Gyroids in every fifth print; test_refill_changes_nothing_else.py has honeycombs in others."""
    new, free = tmp_path / "new.gcode", 0
    for name, entry in list(CORPUS.items())[:: 1 if pattern == "keep" else 5]:
        if entry.missing() or name == "orca-numbered":  # which refill refuses
            continue
        old = prints_of_all_kinds[name]
        refill(old, output=new, pattern=pattern)
        result = verify(old, new)
        assert list(map(str, result.violations)) == [], name
        free += result.report["compared"]["free_mm"] > 0
    assert free >= (10 if pattern == "keep" else 3)


@pytest.mark.parametrize("pattern", ["honeycomb", "gyroid"])
def test_the_rise_to_a_layer_is_no_lift_of_travels(pattern: str, tmp_path: Path) -> None:
    """A print that never lifts asks for no lift, in its sections either, which a layer's rise follows."""
    assert run("sample", "print", "-o", tmp_path / "old.gcode").exit_code == 0
    assert b"Z0.4 F10800" in (tmp_path / "old.gcode").read_bytes()
    refill(tmp_path / "old.gcode", output=tmp_path / "new.gcode", pattern=pattern)
    assert list(map(str, verify(tmp_path / "old.gcode", tmp_path / "new.gcode").violations)) == []


def test_a_refill_is_a_violation_where_infill_may_not_change(
    prints_of_all_kinds: Mapping[str, Path], tmp_path: Path
) -> None:
    new = tmp_path / "new.gcode"
    refill(prints_of_all_kinds["orca"], output=new, pattern="gyroid")
    assert "place" in verify(prints_of_all_kinds["orca"], new, changed="none").report["by_kind"]


def test_arcs_are_fitted_at_all_and_pass_both_ways(tmp_path: Path) -> None:
    """A round wall: 200 lines become a few arcs, within 0.04 mm and 5 % of the filament per mm."""
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    text = round_print()
    old.write_bytes(text)
    new.write_bytes(with_arcs(text))
    assert new.read_bytes().count(b"\nG3 ") >= 4
    assert new.stat().st_size < old.stat().st_size / 2
    for pair in ((old, new), (new, old)):
        result = verify(*pair)
        assert list(map(str, result.violations)) == []
        assert result.report["compared"]["agreeing_mm"] == pytest.approx(result.report["compared"]["beads_mm"])


def round_print(radius: float = 20.0, layers: int = 4) -> bytes:
    import math

    lines = ["G28", "G90", "M83", "M104 S210", "M106 S255"]
    for layer in range(1, layers + 1):
        lines += [
            ";LAYER_CHANGE",
            f"G1 Z{0.2 * layer:.1f} F9000",
            f"G1 X{100 + radius} Y100",
            ";TYPE:External perimeter",
        ]
        lines.append("G1 F1800")
        step = 2 * math.pi * radius / 200
        for k in range(1, 201):
            angle = 2 * math.pi * k / 200
            x, y = 100 + radius * math.cos(angle), 100 + radius * math.sin(angle)
            lines.append(f"G1 X{x:.3f} Y{y:.3f} E{0.033 * step:.5f}")
    return "\n".join([*lines, "M104 S0", ""]).encode()


@pytest.mark.parametrize("arcs", [False, True])
def test_a_fault_in_an_arc_is_found(arcs: bool, tmp_path: Path) -> None:
    """The tolerance of paths does not hide a bulge, more filament or a higher speed."""
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(round_print())
    text = with_arcs(round_print()) if arcs else round_print()
    lines = text.split(b"\n")
    i = [k for k, line in enumerate(lines) if b" E0" in line][2]
    for kind, line in {
        "place": re.sub(rb"X([\d.]+)", lambda found: b"X%.3f" % (float(found[1]) + 0.3), lines[i]),
        "material": re.sub(rb"E([\d.]+)", lambda found: b"E%.5f" % (float(found[1]) * 1.1), lines[i]),
        "speed": lines[i] + b" F9000",
    }.items():
        new.write_bytes(b"\n".join([*lines[:i], line, *lines[i + 1 :]]))
        assert kind in {each.kind for each in verify(old, new).violations if each.line in (i + 1, i + 2)}


def test_beads_in_another_order_or_direction_are_no_violation(tmp_path: Path) -> None:
    squares = [[(x, 100.0), (x + 10, 100), (x + 10, 110), (x, 110.5)] for x in (50.0, 70, 90)]

    def text(paths: list[list[tuple[float, float]]]) -> bytes:
        lines = ["G28", "M83", ";LAYER_CHANGE", "G1 Z0.2 F9000", ";TYPE:Perimeter"]
        for path in paths:
            lines.append(f"G1 X{path[0][0]} Y{path[0][1]} F9000")
            lines.append("G1 F1800")
            lines += [f"G1 X{x} Y{y} E0.3" for x, y in path[1:]]
        return "\n".join(lines).encode()

    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(text(squares))
    new.write_bytes(text([squares[2], squares[0][::-1], squares[1]]))
    result = verify(old, new)
    assert list(map(str, result.violations)) == []
    assert result.report["compared"]["agreeing_mm"] == pytest.approx(result.report["compared"]["beads_mm"])


def test_the_same_file_twice_agrees_and_says_so(prints_of_all_kinds: Mapping[str, Path]) -> None:
    path = prints_of_all_kinds["bambu"]
    result = verify(path, path)
    assert result.agrees
    assert result.report["compared"]["not_compared"] == [
        "both names are one file, so that nothing was compared with anything else"
    ]
    assert repr(result).startswith("Verification(no violation in ")


def test_swapped_prints_are_suspected(prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    new = tmp_path / "new.gcode"
    refill(prints_of_all_kinds["orca"], output=new)
    result = verify(new, prints_of_all_kinds["orca"])
    assert not result.agrees
    assert "were the two swapped?" in result.report["compared"]["not_compared"][-1]


# --- nothing is glossed over ---------------------------------------------------------------------------------


def edited(tmp_path: Path, name: str, change: Callable[[bytes], bytes]) -> Path:
    path = tmp_path / f"{name}.gcode"
    path.write_bytes(change(written(Dialect(layers=4))))
    return path


def test_what_cannot_be_compared_is_named(tmp_path: Path) -> None:
    """Lines that cannot be read in both prints, and macros that may move."""

    def change(text: bytes) -> bytes:
        lines = text.replace(b"G28\n", b"G28\nPRINT_START BED=60\n").split(b"\n")
        bead = wall_beads([line + b"\n" for line in lines])[1]
        return b"\n".join([*lines[:bead], b"G5 X1 Y1 I1 J1", *lines[bead:]])

    old, new = edited(tmp_path, "old", change), edited(tmp_path, "new", change)
    result = verify(old, new)
    assert result.agrees
    left_out = result.report["compared"]["not_compared"]
    assert left_out[0].startswith("1 line of both prints that may move or extrude and cannot be read, such as line ")
    assert left_out[-1] == "what the printer does at PRINT_START"


def test_a_fault_that_lasts_is_one_line(tmp_path: Path) -> None:
    old, new = edited(tmp_path, "old", bytes), edited(tmp_path, "new", lambda text: text.replace(b"S215", b"S225"))
    (violation,) = verify(old, new).violations
    assert violation.kind == "temperature"
    assert violation.lines > 100
    assert re.fullmatch(
        r"line \d+ \(layer 1, z 0.2 mm\): temperature: nozzle 225 °C, was 215 °C, set at line \d+ "
        r"\([\d,]+ lines, to line \d+\)",
        str(violation),
    )


def test_a_heater_that_stays_on_is_found(tmp_path: Path) -> None:
    old = edited(tmp_path, "old", bytes)
    new = edited(tmp_path, "new", lambda text: text.replace(b"M104 S0 ; turn off temperature\n", b""))
    (violation,) = verify(old, new).violations
    assert violation.text == "at the end, nozzle 215 °C, was 0 °C"


def test_a_flow_a_little_too_high_everywhere_is_found(tmp_path: Path) -> None:
    """One percent is less than the tolerance of a bead, and more than that of a layer."""

    def more(text: bytes) -> bytes:
        return re.sub(rb"(?m)^(G1 X.*E)([\d.]+)", lambda found: found[1] + b"%.5f" % (float(found[2]) * 1.01), text)

    result = verify(edited(tmp_path, "old", bytes), edited(tmp_path, "new", more))
    assert set(result.report["by_kind"]) == {"material"}
    assert all("of filament in the layer" in each.text for each in result.violations)


def test_the_amount_of_changed_features_has_a_limit(tmp_path: Path) -> None:
    old = edited(tmp_path, "old", bytes)

    def less(text: bytes) -> bytes:
        lines = text.split(b"\n")
        where = places(lines)
        return b"\n".join(
            re.sub(rb"E([\d.]+)", lambda found: b"E%.5f" % (float(found[1]) * 0.4), line)
            if where[i].role == b"Internal infill" and b" E" in line and b"E-" not in line and b"X" in line
            else line
            for i, line in enumerate(lines)
        )

    new = edited(tmp_path, "new", less)
    assert set(verify(old, new, changed="sparse infill").report["by_kind"]) == {"material"}
    assert verify(old, new, changed="sparse infill", material_limit="60%").agrees


@pytest.mark.parametrize("kind", ["temperature", "speed"])
def test_allowed_kinds_are_counted(kind: str, tmp_path: Path) -> None:
    text = {"temperature": (b"S215", b"S225"), "speed": (b"F1500", b"F2500")}[kind]
    old, new = edited(tmp_path, "old", bytes), edited(tmp_path, "new", lambda before: before.replace(*text))
    result = verify(old, new, allow=kind)
    assert result.agrees
    assert result.report["allowed"] == {kind: 1}
    assert verify(old, new).report["by_kind"] == {kind: 1}


def test_a_speed_within_the_limit_passes(tmp_path: Path) -> None:
    old = edited(tmp_path, "old", bytes)
    new = edited(tmp_path, "new", lambda before: before.replace(b"F1500", b"F1800"))
    assert not verify(old, new).agrees
    assert verify(old, new, speed_limit=0.25).agrees
    assert verify(new, old).agrees  # slower


@settings(max_examples=20)
@given(text=prints(), cut=st.tuples(st.integers(0, 10**6), st.integers(1, 60)))
def test_any_dialect_agrees_with_itself_and_any_damage_is_survived(text: bytes, cut: tuple[int, int]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        old, new = Path(folder) / "old.gcode", Path(folder) / "new.gcode"
        old.write_bytes(text)
        assert list(map(str, verify(old, old).violations)) == []
        lines = text.splitlines(keepends=True)
        at = cut[0] % len(lines)
        new.write_bytes(b"".join(lines[:at] + lines[at + cut[1] :]))
        for pair in ((old, new), (new, old)):
            with contextlib.suppress(InfillError):
                json.dumps(verify(*pair).report)


# --- the command -----------------------------------------------------------------------------------------------


def test_the_command_prints_a_line_a_violation_and_exits_1(tmp_path: Path) -> None:
    old = edited(tmp_path, "old", bytes)
    new = edited(tmp_path, "new", lambda text: text.replace(b"S215", b"S225"))
    done = run("verify", old, new)
    assert done.exit_code == 1
    assert done.stdout == "".join(f"{violation}\n" for violation in verify(old, new).violations)
    assert "1: 1 of temperature" in done.stderr
    same = run("verify", old, old, "--quiet")
    assert (same.exit_code, same.stdout, same.stderr) == (0, "", "")
    report = json.loads(run("verify", old, new, "--json", "--quiet").stdout)
    assert report == json.loads(json.dumps(verify(old, new).report))
    allowed = run("verify", old, new, "--allow", "temperature")
    assert allowed.exit_code == 0
    assert "ALLOWED" in allowed.stderr


def test_many_violations_of_a_kind_are_counted(tmp_path: Path) -> None:
    old = tmp_path / "old.gcode"
    new = tmp_path / "new.gcode"
    old.write_bytes(written(Dialect(layers=20)))
    new.write_bytes(re.sub(rb"(?m)^(G1 X[\d.]+ Y10[05]\.[\d.]+ E[\d.]+)$", rb"\1 F0", old.read_bytes()))
    done = run("verify", old, new)
    zero = [line for line in done.stdout.splitlines() if ": F0: " in line]
    assert len(zero) == 10
    assert re.search(r"^and \d+ more violations of kind F0$", done.stdout, re.MULTILINE)


BAD: dict[str, tuple[bytes | None, str]] = {
    "missing": (None, "there is no file"),
    "empty": (b"", "the file is empty"),
    "not G-code": (b"hello\nworld\n", "the file has no moves"),
    "binary": (b"\0\1\2" * 99, "the file is not text"),
    "no filament": (b"G28\nG1 X1 Y1\nG1 X2 Y2\n", "no line lays filament"),
    "another print": (round_print(), "another print"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line(name: str, tmp_path: Path) -> None:
    good, bad = edited(tmp_path, "good", bytes), tmp_path / "bad.gcode"
    content, says = BAD[name]
    if content is not None:
        bad.write_bytes(content)
    for pair in ((good, bad), (bad, good)):
        one_line_error(run("verify", *pair), says)


def test_a_print_that_was_cut_off_is_one_line(prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    good, cut = prints_of_all_kinds["orca"], tmp_path / "cut.gcode"
    text = good.read_bytes()
    cut.write_bytes(text[: len(text) * 2 // 3])
    one_line_error(run("verify", good, cut), r"cut.gcode: the file was cut off at line \d+, in layer \d of 6")
    one_line_error(run("verify", cut, good), "cut off; slice it again")


def test_a_print_cut_off_without_the_mark_of_a_slicer_lacks_layers(tmp_path: Path) -> None:
    old, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    old.write_bytes(round_print())
    new.write_bytes(b"\n".join(round_print().split(b"\n")[:450]))
    missing = [each for each in verify(old, new).violations if each.kind == "missing"]
    assert [each.text for each in missing if "layer" in each.text] == ["the beads of the layer at z 0.8 mm are missing"]
    assert {each.line for each in missing} == {450}


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"allow": "everything"}, "allow is 'everything'"),
        ({"changed": "walls"}, "changed is 'walls'"),
        ({"allow": ("speed", 3)}, "allow is 3"),
    ],
)
def test_unknown_words_are_told(words: dict[str, Any], says: str, tmp_path: Path) -> None:
    path = edited(tmp_path, "print", bytes)
    with pytest.raises(UsageError, match=says):
        verify(path, path, **words)
    name, value = next(iter(words.items()))
    if isinstance(value, str):
        usage_error(run("verify", path, path, f"--{name}", value), f"--{name} is '{value}'")


def test_limits_are_checked(tmp_path: Path) -> None:
    path = edited(tmp_path, "print", bytes)
    with pytest.raises(ParameterError, match="speed_limit is 0; give a share"):
        verify(path, path, speed_limit=0)
    with pytest.raises(ParameterError, match="plate is 2, which is not in"):
        verify(path, path, plate=2)


def test_features_that_no_comment_names_cannot_change(tmp_path: Path) -> None:
    old, new = edited(tmp_path, "old", bytes), edited(tmp_path, "new", without_comments)
    with pytest.raises(UsageError, match="no comment of .*new.gcode names a feature"):
        verify(old, new, changed="perimeter")


def test_errors_and_results_are_public() -> None:
    assert issubclass(FormatError, ValueError)
    violation = Violation(kind="fan", line=3, layer=0, z=None, text="fan 0 %, was 100 %")
    assert str(violation) == "line 3: fan: fan 0 %, was 100 %"
    assert Verification.__dataclass_params__.frozen  # type: ignore[attr-defined]


def test_the_longest_rise_is_in_order() -> None:
    assert longest_rise([]) == []
    assert longest_rise([5, 1, 2, 9, 3, 4]) == [1, 2, 4, 5]
