"""One contract for every option of every command: what it cannot be is told by the name that was typed, with its status.

Exit status 2 is for a command line that cannot be understood, 1 for one that can, and cannot be done.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
import typer
from handmade_prints import Dialect, written
from test_command_line import COMMANDS, one_line_error, usage_error
from typer.testing import CliRunner

from infill import ParameterError, make, motion, smooth_mesh, smooth_volume
from infill.cli.app import build_app
from infill.gcode.limits import JUNCTION_DEVIATION, MODELS
from infill.making.settings import resolve
from infill.smoothing.request import METHODS
from infill.smoothing.sources import KINDS

# Files that a test needs, and a command line that works, to which an option is added.
WORKING = {
    "make": "honeycomb --size 20 --height 2 -o a.stl",
    "smooth": "grey.npy --threshold 50 -o a.stl",
    "smooth mesh": "box.stl -o a.stl",
    "smooth points": "cloud.xyz --voxel 1 -o a.stl",
    "smooth labels": "grey.npy -o a.stl",
    "fill": "box.stl -o a.stl",
    "fill honeycomb": "box.stl -o a.stl --pattern honeycomb",
    "fill voronoi": "box.stl -o a.stl --pattern voronoi",
    "refill": "print.gcode -o a.gcode",
    "refill gyroid": "print.gcode -o a.gcode --pattern gyroid",
    "refill even": "print.gcode -o a.gcode --pattern gyroid --even volume",
    "check": "box.stl",
    "motion": "print.gcode",
    "motion plot": "print.gcode --plot a.png",
    "motion corner": "print.gcode --model klipper",
    "verify": "print.gcode print.gcode",
    "studio": "box.stl --no-browser",
}
# Values out of range, which cannot be done, by option; "nan" is among them wherever it can be typed.
OUT_OF_RANGE = {
    "studio": {"--port": "-1 99999"},
    "make": {
        "--cell": "-1 nan 1e9",
        "--angle": "1000 nan",
        "--phase": "1e9_0 nan_0",
        "--waves": "-1 nan",
        "--hearts": "-1",
        "--size": "-3 0x5 nan 5xnan",
        "--height": "-1 0 nan",
        "--line-width": "-1 0 nan",
        "--density": "-5% 0.5% 95% nan%",
        "--cells": "0 -1 4",
        "--steps": "-1",
        "--fidelity": "-1 nan",
        "--interface": "-1 nan",
        "--alpha": "-1 9 nan",
        "--tolerance": "-1 9 nan",
        "--max-memory": "-1G 0 nan",
        "--set": "cell=-1 cell=nan angle=1000",
    },
    "smooth": {
        "--voxel": "-1 0.01 nan",
        "--spacing": "-1 1,0,1 nan",
        "--roi": "0,9,0,9,9,0 0,9,0,9,0,nan",
        "--threshold": "5000 -5000 nan",
        "--despeckle": "-1 nan",
        "--steps": "-1",
        "--smooth-radius": "-1 0 nan",
        "--crumbs": "-1 nan",
        "--keep-components": "0 9 3-1",
        "--fidelity": "-1 nan",
        "--interface": "0 nan",
        "--level": "5 nan",
        "--tolerance": "-1 nan",
        "--max-triangles": "0 -5",
        "--threads": "0 -1",
        "--max-memory": "-1G 0 nan",
        "--workers": "0 -1",
    },
    "smooth labels": {"--range": "5,1 3000,4000 nan,5", "--label": "99", "--frame": "7"},
    "smooth mesh": {"--resolution": "0 -1"},
    "smooth points": {"--shell": "-1 0 nan"},
    "fill": {
        "--density": "-5% 0.5% 95% nan%",
        "--cell": "-1 0 nan",
        "--line-width": "-1 0 nan",
        "--wall": "-1 nan 9",
        "--angle": "1000 nan",
        "--phase": "1e9_0_0 nan_0_0",
        "--drain": "-1 0 nan",
        "--drain-at": "nan,0,0 1e9,0,0",
        "--region": "z=1e9..2e9:density=40% z=1..2:density=95% box=0,0,0,1,1,nan:density=40%",
        "--cut": "x=nan",
        "--smooth-radius": "-1 nan",
        "--overlap": "-1 9 nan",
        "--tolerance": "-1 nan",
        "--max-triangles": "0 -5 100",
        "--resolution": "0 -1",
        "--voxel": "-1 0 nan 100",
        "--threads": "0 -1",
        "--max-memory": "-1G 0 nan",
    },
    "fill honeycomb": {"--set": "waves=3 cell=3", "--seed": "3"},
    "fill voronoi": {"--seed": "-1 9999999999", "--set": "seed=-1"},
    "refill": {
        "--smooth-radius": "-1 nan",
        "--max-deviation": "-1 nan",
        "--max-segments": "-1 0 nan",
        "--layers": "9-2 0-3",
    },
    "refill gyroid": {"--density": "-5% 150% nan%", "--set": "cell=-1 angle=nan"},
    "refill even": {"--leeway": "-5% 0 90% nan%"},
    "motion": {
        "--acceleration": "-1 nan",
        "--jerk": "-1 nan",
        "--junction-deviation": "-1 nan",
        "--square-corner-velocity": "-1 nan",
        "--minimum-cruise-ratio": "-1 2 nan",
        "--plate": "9",
        "--limits": "foo=3 max_accel=-1 accel=5,max_accel=5 jerk=8,scv=5 minimum_cruise_ratio=1",
        "--macro": "START_PRINT=-1 START_PRINT=1e9 A=1,a=2",
    },
    "motion plot": {"--layer": "999 0 -1"},
    "verify": {"--material-limit": "-5% 150% nan%", "--speed-limit": "-5% 150% nan%", "--plate": "9"},
}
# Words that an option cannot read, in addition to what is out of range above.
UNREAD = {
    "make": {
        "--stamp": "foo",
        "--surface": "foo",
        "--size": "1x2x3x4 x",
        "--cells": "2.5",
        "--set": "cell cell=foo",
        "--max-memory": "1Q",
    },
    "smooth": {
        "--smooth": "foo",
        "--as": "foo",
        "--units": "yard",
        "--spacing": "1,2",
        "--roi": "1,2",
        "--steps": "2.5",
        "--label": "1.5",
        "--keep-components": "x 1,- -2",
        "--workers": "2.5",
        "--scheduler": "foo",
    },
    "smooth labels": {"--range": "5 1,2,3"},
    "fill": {
        "--align": "foo",
        "--as": "foo",
        "--open": "foo",
        "--units": "yard",
        "--max-triangles": "2.5",
        "--for": "foo",
        "--by": "foo",
        "--grade": "foo",
        "--region": "foo z=1..2 z=a..2:density=40% z=1..2:density=foo",
        "--seed": "2.5",
    },
    "check": {"--for": "foo"},
    "refill": {"--density": "dense", "--by": "foo", "--smooth-radius": "wide", "--layers": "1.5", "--arcs": "foo"},
    "refill even": {"--even": "foo", "--leeway": "foo"},
    "motion": {
        "--model": "foo",
        "--limits": "max_accel =5 max_accel=fast max_accel=5mm",
        "--macro": "START_PRINT START_PRINT=x START-PRINT=3",
    },
    "verify": {"--changed": "foo perimeter,foo", "--allow": "foo speed,foo", "--material-limit": "much"},
}
NAMES = {"FILE", "FOLDER", "NAME", "UID", "keep|auto|NAME|FILE"}  # metavars of what may be any word


def run(*words: str) -> Any:
    """Run a command, as the console script does: without the parsers of the others."""
    return CliRunner().invoke(build_app(words[0]), words)


@cache
def parsed(command: str) -> Any:
    """Return the parser of a command."""
    return typer.main.get_command(build_app(command)).commands[command]  # type: ignore[attr-defined]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, silent_compiler: None) -> Path:
    """A folder with a scan, a mesh, points and a print."""
    monkeypatch.chdir(tmp_path)
    np.save("grey.npy", np.pad(np.full((8, 8, 8), 100, np.int16), 4))
    box = trimesh.creation.box((10, 10, 10))
    box.export("box.stl")
    np.savetxt("cloud.xyz", trimesh.sample.sample_surface(box, 2000, seed=1)[0])
    Path("print.gcode").write_bytes(written(Dialect(layers=5)))
    return tmp_path


def words(case: str, option: str, value: str) -> list[str]:
    """Return a command line with an option; what it replaces of the one that works is left out."""
    line = WORKING[case].split()
    if option in line:
        line[line.index(option) : line.index(option) + 2] = []
    if option == "--waves":
        line[0] = "zigzag"
    if option == "--hearts":
        line[0] = "concentric-heart"
    typed = [option, *value.split("_")] if option == "--phase" else [f"{option}={value}"]
    return [case.split()[0], *line, *typed]


def options_of(command: str) -> Iterator[Any]:
    """Yield every option of a command, hidden ones too, as the parser knows them."""
    yield from (each for each in parsed(command).params if each.param_type_name == "option")


def name_of(option: Any) -> str:
    return str(max(option.opts, key=len))


def cases(table: dict[str, dict[str, str]]) -> list[tuple[str, str, str]]:
    return [
        (case, option, value)
        for case, options in table.items()
        for option, values in options.items()
        for value in values.split()
    ]


def in_table(table: dict[str, dict[str, str]], command: str) -> set[str]:
    return {option for case, options in table.items() if case.split()[0] == command for option in options}


@pytest.mark.parametrize("command", COMMANDS)
def test_the_tables_have_every_option_that_takes_a_value(command: str) -> None:
    known = in_table(OUT_OF_RANGE, command) | in_table(UNREAD, command)
    for option in options_of(command):
        if not option.is_flag and (option.metavar or "") not in NAMES:
            assert name_of(option) in known
    assert known <= {name_of(option) for option in options_of(command)}


@pytest.mark.long
@pytest.mark.parametrize("case", OUT_OF_RANGE)
def test_what_is_out_of_range_is_told_by_the_option_that_was_typed(case: str, folder: Path) -> None:
    before = sorted(folder.iterdir())
    for option, values in OUT_OF_RANGE[case].items():
        for value in values.split():
            one_line_error(run(*words(case, option, value)), f"^error: .*{option}\\b")
            assert sorted(folder.iterdir()) == before


@pytest.mark.slow
@pytest.mark.parametrize("case", dict.fromkeys([*OUT_OF_RANGE, *UNREAD]))
def test_what_cannot_be_read_is_wrong_usage(case: str, folder: Path) -> None:
    """A word where numbers are wanted, for every option with a range, and what else cannot be read."""
    before = sorted(folder.iterdir())
    tried = [(option, "a-word") for option in OUT_OF_RANGE.get(case, {}) if option not in ("--set", "--phase")]
    tried += [(option, value) for option, values in UNREAD.get(case, {}).items() for value in values.split()]
    for option, value in tried:
        usage_error(run(*words(case, option, value)), f"{option}\\b")
        assert sorted(folder.iterdir()) == before


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_a_value_that_is_missing_is_wrong_usage(command: str) -> None:
    for option in options_of(command):
        if not option.is_flag:
            usage_error(run(command, "x", name_of(option)), name_of(option))


@pytest.mark.parametrize("command", COMMANDS)
def test_an_unknown_option_is_wrong_usage(command: str) -> None:
    usage_error(run(command, "x", "--nonsense"), "--nonsense")
    if command not in ("smooth", "fill", "refill", "check", "sample", "setup"):  # which take any number of words
        usage_error(run(command, "x", "y", "z", "more"), "more|unexpected")


@pytest.mark.long
@pytest.mark.parametrize(
    "line",
    [
        "make honeycomb",
        "smooth grey.npy",
        "make honeycomb --cell 4 --set cell=3 -o a.stl",
        "make zigzag --cell 4 --set waves=3 -o a.stl",
        "smooth grey.npy --threshold 5 --otsu -o a.stl",
        "smooth grey.npy --threshold 5 --range 3,4 -o a.stl",
        "smooth grey.npy --threshold 5 --label 3 -o a.stl",
        "smooth box.stl --voxel 1 --resolution 9 -o a.stl",
        "smooth cloud.xyz --voxel 1 --resolution 9 -o a.stl",
        "fill box.stl --voxel 1 --resolution 9 -o a.stl",
        "smooth grey.npy --refine --fidelity 1 -o a.stl",
        "smooth grey.npy --labels a.txt -o a.stl",
        "fill box.stl",
        "fill box.stl --as infill --drain 2 -o a.stl",
        "fill box.stl --as project -o a.3mf",
        "fill box.stl --as solid --for cura -o a.3mf",
        "fill box.stl --density 20% --cell 5 --line-width 0.4 -o a.stl",
        "refill print.gcode --preview a.png --dry-run",
        "refill print.gcode --pattern gyroid --set cell=5 --density 20% -o a.gcode",
        "refill print.gcode --density 20% -o a.gcode",
        "motion print.gcode --layer 3",
        "motion print.gcode --jerk 5 --square-corner-velocity 5",
        "list --preview a.png",
        "sample -o a.stl",
        "sample part scan -o a.stl",
    ],
)
def test_what_excludes_each_other_or_leaves_nothing_to_do_is_wrong_usage(line: str, folder: Path) -> None:
    before = sorted(folder.iterdir())
    usage_error(run(*line.split()), "error|Error")
    assert sorted(folder.iterdir()) == before


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    [
        "make honycomb -o a.stl",
        "make honeycomb --set wavs=3 -o a.stl",
        "make honeycomb -o a.xyz",
        "make honeycomb -o none/a.stl",
        "make --config none.toml -o a.stl",
        "smooth none.npy -o a.stl",
        "smooth box.stl --otsu -o a.stl",
        "refill print.gcode --pattern honycomb -o a.gcode",
        "motion none.gcode",
        "list honycomb",
        "check none.stl",
        "sample none",
        "sample part -o a.gcode",
        "sample scan -o a.npy",
        "sample print -o a.stl",
        "sample part part",
    ],
)
def test_what_is_not_there_or_does_not_fit_is_an_error(line: str, folder: Path) -> None:
    before = sorted(folder.iterdir())
    one_line_error(run(*line.split()), "^error: ")
    assert sorted(folder.iterdir()) == before


def test_a_config_file_is_no_usage(folder: Path) -> None:
    """What stands in it is told by its own name, as an error of ours, though the same is wrong usage when typed."""
    Path("a.toml").write_text('pattern = "honeycomb"\nheight = "tall"\n')
    one_line_error(run("make", "--config", "a.toml", "-o", "a.stl"), "^error: height is 'tall'; it must be a number")
    Path("a.toml").write_text('pattern = "honeycomb"\nline-width = -1\n')
    one_line_error(run("make", "--config", "a.toml", "-o", "a.stl"), "^error: line_width is -1 mm")
    one_line_error(run("make", "--config", "a.toml", "-o", "a.stl", "--line-width", "-2"), "^error: --line-width is -2")


def test_python_callers_read_the_names_of_their_arguments(folder: Path) -> None:
    cells = np.pad(np.full((4, 4, 4), 100), 2)
    box = trimesh.creation.box((10, 10, 10))
    for says, call in {
        "line_width is -1 mm": lambda: make("honeycomb", size=20, height=2, line_width=-1),
        "cells is 0": lambda: make("honeycomb", size=20, height=2, cells=0),
        "stamp is 'round'": lambda: make("honeycomb", size=20, height=2, stamp="round"),  # type: ignore[arg-type]
        "threshold is 5000": lambda: smooth_volume(cells, threshold=5000, tolerance=None),
        "threshold goes from 5 to 1": lambda: smooth_volume(cells, threshold=(5, 1), tolerance=None),
        "radius is -1 mm": lambda: smooth_volume(cells, threshold=5, radius=-1, tolerance=None),
        "method is 'best'": lambda: smooth_volume(cells, threshold=5, method="best", tolerance=None),  # type: ignore[arg-type]
        "resolution is 0": lambda: smooth_mesh(box, resolution=0, tolerance=None),
        "junction_deviation is -1": lambda: motion("print.gcode", junction_deviation=-1),
    }.items():
        with pytest.raises(ParameterError, match=f"^{says}"):
            call()
    with pytest.raises(ParameterError, match="^height is 'tall'"):
        resolve({"pattern": "honeycomb", "height": "tall"})


def test_the_choices_are_those_of_the_library() -> None:
    from typing import get_args

    from infill.imaging.units import UNITS
    from infill.interior.opening import Open
    from infill.lattices.grading import Varies
    from infill.lattices.request import Align, Form
    from infill.making.request import DEFAULT_CELLS
    from infill.projects.project import SLICERS

    told = {(command, name_of(option)): option.metavar for command in COMMANDS for option in options_of(command)}
    assert told["smooth", "--smooth"].split("|") == [*METHODS]
    assert told["smooth", "--as"].split("|") == [*KINDS]
    assert told["smooth", "--units"].split("|") == [*UNITS]
    assert told["fill", "--as"].split("|") == [*get_args(Form)]
    assert told["fill", "--for"].split("|") == told["check", "--for"].split("|") == [*SLICERS]
    assert told["fill", "--align"].split("|") == [*get_args(Align)]
    assert told["fill", "--open"].split("|") == [*get_args(Open)]
    assert told["fill", "--grade"].split("|") == [*get_args(Varies)]
    assert told["make", "--stamp"].split("|") == [*DEFAULT_CELLS]
    assert set(told["motion", "--model"].split("|")) == {*MODELS} - {"junction"} | {JUNCTION_DEVIATION}
    from infill.cli import checking, timing

    for module, function, argument, wanted in (
        (checking, "check", "slicer", SLICERS),
        (timing, "motion", "model", (*MODELS, JUNCTION_DEVIATION)),
    ):
        from typing import get_type_hints

        hint = get_type_hints(getattr(module, function))[argument]
        found = {word for each in [hint, *get_args(hint)] for word in get_args(each) if isinstance(word, str)}
        assert found == {*wanted}
