"""What tags and commands leave behind them: whatever is missing, said twice or said in odd places, what follows recovers."""

from __future__ import annotations

import re

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from infill import refill
from infill.gcode.machine_state import MachineState
from infill.gcode.sections import TagState, mark_lines
from infill.gcode.table import read_table
from tests.handmade_prints import Dialect, written
from tests.two_colours import colours

# Tags and commands of slicers that begin or end something.
MARKERS = (
    "; PURGING FINISHED",
    "; CP TOOLCHANGE START",
    "; CP TOOLCHANGE END",
    "; CP EMPTY GRID START",
    "; CP EMPTY GRID END",
    "; WIPE_TOWER_START",
    "; WIPE_TOWER_END",
    "; FLUSH_START",
    "; FLUSH_END",
    "; SKIPPABLE_START",
    "; SKIPTYPE: timelapse",
    "; SKIPPABLE_END",
    ";WIPE_START",
    ";WIPE_END",
    "; WIPE_START",
    "; WIPE_END",
    "; printing object o9 id:9 copy 0",
    "; stop printing object o9 id:9 copy 0",
    "; start printing object, unique label id: 9",
    ";MESH:NONMESH",
    ";MESH:b.stl",
    "EXCLUDE_OBJECT_START NAME=o9",
    "EXCLUDE_OBJECT_END NAME=o9",
    "M486 S3",
    "M486 S-1",
    "M624 AQAAAAAAAAA=",
    "M625",
    ";TYPE:Wipe tower",
    "; FEATURE: Prime tower",
    ";TYPE:PRIME-TOWER",
    ";TYPE:Skirt/Brim",
    ";TYPE:Ironing",
    ";TYPE:Support material",
    ";TYPE:Custom",
    ";TYPE:",
    "; CUSTOM_GCODE",
    ";COLOR_CHANGE,T0,#FF0000",
    ";PAUSE_PRINT",
    "T0",
    "T1",
    "M600",
)
LAYERS, STREWN = 3, 2  # and in how many, from the first on, markers are strewn
FIXED = {"smooth_radius": 1.0, "max_deviation": 0.1}  # so that no layer decides for another
CLEAN = colours(LAYERS)


def refilled(text: str) -> tuple[str, dict]:
    done = refill(text.splitlines(keepends=True), **FIXED)
    assert done.lines is not None
    return "".join(done.lines), done.report


CLEAN_NEW, CLEAN_REPORT = refilled(CLEAN)


def layers_of(text: str) -> list[str]:
    return re.split(r"(?m)^(?=;LAYER_CHANGE$)", text)[1:]


def strew(text: str, markers: list[tuple[float, str]]) -> str:
    """Put markers in between the lines of the first layers; places are shares of them."""
    head, *layers = re.split(r"(?m)^(?=;LAYER_CHANGE$)", text)
    lines = "".join(layers[:STREWN]).splitlines()
    for place, marker in sorted(markers, reverse=True):
        lines.insert(1 + int(place * (len(lines) - 1)), marker)
    return head + "\n".join(lines) + "\n" + "".join(layers[STREWN:])


def lines_outside_infill(text: str) -> list[str]:
    """Return what is no plain move of a straight line: tags, commands, travels, retractions."""
    return [line for line in text.splitlines() if not re.match(r"G1 (X\S+ ?)?(Y\S+ ?)?E[\d.]+|; refilled by", line)]


PLACES = st.floats(0, 1, allow_nan=False)


@pytest.mark.longest
@settings(max_examples=30)
@given(st.lists(st.tuples(PLACES, st.sampled_from(MARKERS)), min_size=1, max_size=5))
@example([(0.5, "; PURGING FINISHED")])
@example([(0.9, ";WIPE_START")])
@example([(0.999, "; CP TOOLCHANGE START")])
@example([(0.999, "T1"), (0.999, "; FLUSH_START")])
def test_stray_markers_are_forgotten(markers: list[tuple[float, str]]) -> None:
    """All sections are told; layers without markers are drawn as ever; and every line of another kind is there."""
    text = strew(CLEAN, markers)
    new, report = refilled(text)
    sections = report["sections"]
    assert sections["all"] == sections["replaced"] + sum(sections["kept"].values())
    assert sections["replaced"] + sections["kept"].get("purged filament", 0) >= 2 * (LAYERS - STREWN)
    assert layers_of(new)[STREWN:] == layers_of(CLEAN_NEW)[STREWN:]
    assert sorted(lines_outside_infill(new)) == sorted(lines_outside_infill(text))


@pytest.mark.slow
@settings(max_examples=15)
@given(st.sets(st.integers(0, 10**4), min_size=1, max_size=6))
def test_missing_markers_are_forgotten(places: set[int]) -> None:
    """Any comment or tool change of the first layers may be missing, but for the tags of the layers themselves."""
    head, *layers = re.split(r"(?m)^(?=;LAYER_CHANGE$)", CLEAN)
    lines = "".join(layers[:STREWN]).splitlines()
    said = [k for k, line in enumerate(lines) if line.startswith((";", "T")) and line != ";LAYER_CHANGE"]
    missing = {said[place % len(said)] for place in places}
    text = head + "\n".join(line for k, line in enumerate(lines) if k not in missing) + "\n" + "".join(layers[STREWN:])
    new, report = refilled(text)
    sections = report["sections"]
    assert sections["all"] == sections["replaced"] + sum(sections["kept"].values())
    assert layers_of(new)[STREWN:] == layers_of(CLEAN_NEW)[STREWN:]


@pytest.mark.slow
@settings(max_examples=15)
@given(st.lists(st.tuples(PLACES, st.sampled_from([*MARKERS, ";LAYER_CHANGE", ";LAYER:7"])), min_size=1, max_size=4))
def test_nothing_that_is_purged_is_touched(markers: list[tuple[float, str]]) -> None:
    """What stands between a change of the tool and the first tag after it, in a layer, stays as it was."""
    text = strew(CLEAN, markers)
    new, _ = refilled(text)
    # A tool change, up to the first tag, with no other layer between: as in the text, and as a plain expression says it.
    purge = re.compile(r"(?m)^T[01]$(?:(?!^;LAYER)[\s\S])*?^; PURGING FINISHED$")
    tools, old = "", []
    for found in purge.finditer(text):
        before = re.findall(r"(?m)^T[01]$", text[: found.start()])
        tools = before[-1] if before else ""
        if found[0][:2] != tools:  # the tool in use, selected again, purges nothing
            old.append(found[0])
    assert [part in new for part in old] == [True] * len(old)


@given(st.lists(st.sampled_from([";LAYER_CHANGE", ";LAYER:4", ";Z:0.4", "G1 Z.4 F900", "; a remark"]), max_size=5))
def test_tags_of_a_layer_with_nothing_printed_between_begin_it_once(middle: list[str]) -> None:
    """As where the settings of PrusaSlicer write ";LAYER:4" after its own tag."""
    head = "M83\n;LAYER_CHANGE\n;TYPE:FILL\nG1 X9 E1 F900\n;LAYER_CHANGE\n"
    text = head + "".join(f"{line}\n" for line in middle) + ";TYPE:FILL\nG1 X1 E1\n"
    marks = mark_lines(read_table(text.encode(), MachineState()), TagState())
    assert (marks.layers, marks.after.layer, marks.layer[-1]) == (2, 2, 2)


def test_an_empty_layer_with_a_number_is_one() -> None:
    text = b";LAYER:1\n;TYPE:FILL\nG1 X9 E1 F900\n;LAYER:2\n;LAYER:3\n;TYPE:FILL\nG1 X1 E2\n"
    assert mark_lines(read_table(text, MachineState()), TagState()).after.layer == 3


@pytest.mark.slow
@pytest.mark.parametrize("slicer", ["prusa", "orca", "bambu"])
def test_a_role_that_is_said_once_lasts(slicer: str) -> None:
    """PrusaSlicer says it once if all layers are of infill alone, or if a layer begins with what the last ended with."""
    text = written(Dialect(slicer=slicer, infill_first=True)).decode()
    tag = re.compile(r"(?m)^(?:;TYPE:|; FEATURE: )(.*)\n")
    role, kept = "", []
    for line in text.splitlines(keepends=True):
        said = tag.match(line)
        if said and said[1] == role:
            continue
        role = said[1] if said else role
        kept.append(line)
    before, after = refilled(text)[1], refilled("".join(kept))[1]
    assert before["sections"] == after["sections"]
    assert before["sections"]["replaced"] > 0


@pytest.mark.parametrize("end", ["", ";WIPE_END\n"])
def test_a_wipe_ends_with_what_extrudes_if_nothing_says_so(end: str) -> None:
    text = f"M83\n;TYPE:FILL\nG1 X9 E1 F900\n;WIPE_START\nG1 X5 E-.5\n{end};TYPE:FILL\nG1 E.5\nG1 Y9 E1\nG1 X0 E1\n"
    marks = mark_lines(read_table(text.encode(), MachineState()), TagState())
    lines = text.splitlines()
    assert [lines[k] for k in marks.wiping.nonzero()[0]] == [";WIPE_START", "G1 X5 E-.5"]
    assert not marks.after.wiping


def test_the_name_of_an_object_ends_with_its_layer() -> None:
    text = b";LAYER_CHANGE\n; printing object a\n;TYPE:FILL\nG1 X9 E1 F900\n;LAYER_CHANGE\n;TYPE:FILL\nG1 X1 E2\n"
    marks = mark_lines(read_table(text, MachineState()), TagState())
    assert [marks.names[int(section)] for section in marks.section[[3, 6]]] == ["a", ""]
