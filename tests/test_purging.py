"""Prints in several colours that wipe into the infill: what is purged is never touched, all else is refilled.

PrusaSlicer writes "; PURGING FINISHED" once for every tool of a layer, also for the one in use when the layer begins.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import trimesh

from infill import refill
from tests.gcode_judge import judge
from tests.prints import PRINT
from tests.slicers import missing_prusa, run_slicer
from tests.two_colours import TOOL_COMMANDS, colours, sections_of

LAYERS = 4
# Where a tag that ends purging may stand with nothing purged before it.
LABELS = ("; printing object o2 id:1 copy 0", "; stop printing object o2 id:1 copy 0")
STRAY = (
    "never",
    "at the beginning of a layer",
    "at its end",
    "twice",
    "before the first wall",
    "inside the second part",
)


def refilled(text: str, pattern: str = "keep", **asked: object) -> tuple[str, dict]:
    done = refill(text.splitlines(keepends=True), pattern=pattern, **asked)
    assert done.lines is not None
    return "".join(done.lines), done.report


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["keep", "honeycomb"])
@pytest.mark.parametrize("stray", STRAY)
def test_what_is_purged_stays_and_all_else_is_refilled(stray: str, pattern: str) -> None:
    text = colours(LAYERS, stray=stray)
    new, report = refilled(text, pattern)
    assert report["sections"] == {"all": 2 * LAYERS, "replaced": LAYERS, "kept": {"purged filament": LAYERS}}
    assert sections_of(new, "o1") == sections_of(text, "o1")
    changed = [a != b for a, b in zip(sections_of(new, "o2"), sections_of(text, "o2"), strict=True)]
    assert changed == [True] * LAYERS
    # To the judge, such a tag inside a section cuts it; and it takes the box around waves for their region.
    if stray != "inside the second part" and pattern == "keep":
        assert judge(text.encode(), new.encode()) == []


@pytest.mark.slow
@pytest.mark.parametrize("stray", STRAY[1:])
def test_stray_tags_change_nothing_of_what_is_drawn(stray: str) -> None:
    """Beside the tag itself, the two outputs are the same, line by line."""

    def plain(text: str) -> list[str]:
        return [line for line in text.splitlines() if line not in ("; PURGING FINISHED", *LABELS)]

    once, _ = refilled(colours(LAYERS))
    new, _ = refilled(colours(LAYERS, stray=stray))
    assert plain(new) == plain(once)


@pytest.mark.slow
@pytest.mark.parametrize("dialect", TOOL_COMMANDS)
def test_every_command_that_changes_the_tool_begins_purging(dialect: str) -> None:
    text = colours(LAYERS, stray="at the beginning of a layer", tools=TOOL_COMMANDS[dialect])
    new, report = refilled(text)
    assert report["sections"] == {"all": 2 * LAYERS, "replaced": LAYERS, "kept": {"purged filament": LAYERS}}
    assert sections_of(new, "o1") == sections_of(text, "o1")


@pytest.mark.slow
@pytest.mark.parametrize("dialect", ["orca", "bambu"])
def test_other_dialects(dialect: str) -> None:
    text = colours(LAYERS, stray="at the beginning of a layer", dialect=dialect)
    new, report = refilled(text)
    assert report["sections"] == {"all": 2 * LAYERS, "replaced": LAYERS, "kept": {"purged filament": LAYERS}}
    assert sections_of(new, "o1") == sections_of(text, "o1")


def test_a_tool_that_is_selected_again_purges_nothing() -> None:
    text = colours(LAYERS, stray="at the beginning of a layer", again=True)
    _, report = refilled(text)
    assert report["sections"]["replaced"] == LAYERS


def test_a_tool_change_whose_purging_is_never_ended_ends_with_its_layer() -> None:
    """In a layer without wiping into the infill there is no such tag: all of it is ordinary infill."""
    text = colours(LAYERS, stray="at the beginning of a layer", unended=(1, 3))
    new, report = refilled(text)
    assert report["sections"] == {"all": 2 * LAYERS, "replaced": LAYERS + 2, "kept": {"purged filament": LAYERS - 2}}
    old, new_sections = sections_of(text, "o1"), sections_of(new, "o1")
    assert [k for k in range(LAYERS) if old[k] != new_sections[k]] == [1, 3]


def test_a_tower_without_a_tag_of_its_role_is_not_drawn_anew() -> None:
    """Between the tags around a tool change stands the wipe tower, even if the last role said is that of the infill."""
    text = colours(LAYERS, untagged_tower=True)
    new, report = refilled(text)
    sections = report["sections"]
    assert sections["all"] == sections["replaced"] + sum(sections["kept"].values())
    tower = re.compile(r"; CP TOOLCHANGE START\n.*?; CP TOOLCHANGE END\n", re.DOTALL)
    assert tower.findall(new) == tower.findall(text)
    assert len(tower.findall(text)) == LAYERS


def two_boxes(extruders: tuple[int, int]) -> str:
    """An AMF of two boxes, each of an extruder."""
    found = ['<?xml version="1.0" encoding="UTF-8"?>\n<amf unit="millimeter">']
    for number, extruder in enumerate(extruders):
        mesh = trimesh.creation.box((15, 15, 2.4))
        mesh.apply_translation([18 * number, 0, 1.2])
        found.append(f'<object id="{number}"><metadata type="name">o{number + 1}</metadata>')
        found.append(f'<metadata type="slic3r.extruder">{extruder}</metadata>')
        found.append('<metadata type="slic3r.wipe_into_infill">1</metadata><mesh><vertices>')
        points = "<vertex><coordinates><x>{:g}</x><y>{:g}</y><z>{:g}</z></coordinates></vertex>"
        found += [points.format(*point) for point in mesh.vertices]
        found.append("</vertices><volume>")
        found += ["<triangle><v1>{}</v1><v2>{}</v2><v3>{}</v3></triangle>".format(*face) for face in mesh.faces]
        found.append("</volume></mesh></object>")
    return "\n".join([*found, "</amf>"])


@pytest.mark.longest
@pytest.mark.skipif(bool(missing_prusa()), reason=missing_prusa())
def test_a_print_of_two_colours_by_the_slicer(tmp_path: Path) -> None:
    """Every layer purges into the infill of one object, and prints that of the other: as many sections of each."""
    twice = {"retract_length": 0.8, "retract_speed": 35, "retract_lift": 0.4, "retract_before_travel": 1, "wipe": 1}
    twice |= {"temperature": 210, "first_layer_temperature": 215, "filament_density": 1.24, "filament_diameter": 1.75}
    twice |= {"nozzle_diameter": 0.4, "retract_before_wipe": "0%", "cooling": 1, "slowdown_below_layer_time": 0}
    settings = {**PRINT, **{name: f"{value},{value}" for name, value in twice.items()}}
    settings |= {"single_extruder_multi_material": 1, "wipe_tower": 1, "wipe_into_infill": 1, "gcode_label_objects": 1}
    settings |= {"wiping_volumes_matrix": "0,70,70,0", "wiping_volumes_extruders": "35,35,35,35"}
    settings |= {"wipe_tower_x": 160, "wipe_tower_y": 120, "top_solid_layers": 1, "bottom_solid_layers": 1}
    (tmp_path / "two.amf").write_text(two_boxes((1, 2)))
    (tmp_path / "print.ini").write_text("".join(f"{name} = {value}\n" for name, value in settings.items()))
    command = ["prusa-slicer", "--datadir", str(tmp_path), "--load", "print.ini", "--export-gcode"]
    run_slicer([*command, "--center", "125,105", "-o", "print.gcode", "two.amf"], tmp_path)
    report = refill(tmp_path / "print.gcode", output=tmp_path / "new.gcode").report
    old, new = (tmp_path / "print.gcode").read_bytes(), (tmp_path / "new.gcode").read_bytes()
    sections = report["sections"]
    assert sections["replaced"] == sections["kept"]["purged filament"] == sections["all"] // 2 > 5
    assert judge(old, new) == []
