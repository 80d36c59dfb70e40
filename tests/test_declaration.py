"""One declaration an option: flags, config keys, checks and the keywords of the Python functions follow from it."""

from __future__ import annotations

import inspect
import pickle
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Annotated, Any, Literal

import numpy as np
import pytest
import trimesh
import typer
from test_command_line import run

import infill
import patterns as infill_patterns
from infill import ParameterError, UsageError
from infill.cli.app import build_app
from infill.cli.declared import takes_options
from infill.lattices.groups import FLAT_NAMES
from infill.lattices.request import check_request
from infill.lattices.settings import FillOptions
from infill.making.settings import MakeSettings
from infill.options.declaration import Option, by_key, declared_options, drop_replaced, read_options
from infill.phasefield.allen_cahn import Smoothing
from infill.refilling.request import Request
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.smoothing.settings import SmoothSettings
from infill.timing.request import MotionOptions
from infill.verifying.settings import VerifyRequest

DECLARATIONS: dict[str, type[Any]] = {
    "make": MakeSettings,
    "smooth": SmoothSettings,
    "fill": FillOptions,
    "refill": Request,
    "motion": MotionOptions,
    "verify": VerifyRequest,
}
# Flags of the run and its files, which no config file has.
RUN = {"ascii", "config", "dry_run", "force", "json", "max_memory", "output", "preview", "quiet", "save_config", "set"}
RUN |= {"cut", "hash", "in_place", "layer", "plot", "resume", "scheduler", "threads", "trust", "verbose", "workers"}
RUN |= {"write"}
PATTERN_FLAGS = {"cell", "angle", "phase", "frame", "waves", "hearts"}  # of `make`: parameters of the pattern
ONLY_MAKE = PATTERN_FLAGS | {"allow_broken"}


@dataclass(frozen=True, kw_only=True)
class Coffee:
    """A small declaration."""

    cups: Annotated[int, Option("Number of cups.", "Coffee", unit="N", default="1")] = 1
    litres: Annotated[float | None, Option("Instead of cups.", "Coffee", unit="L", replaces=("cups",))] = None
    kind: Annotated[Literal["black", "white"], Option("Sort.", "Coffee", name="as")] = "black"
    sugar: Annotated[bool, Option("Sweet.", "Taste", negatable=True)] = False
    made: int = 0


def test_what_is_annotated_is_an_option() -> None:
    declared = declared_options(Coffee)
    assert list(declared) == ["cups", "litres", "as", "sugar"]
    assert [entry.flag for entry in declared.values()] == ["--cups", "--litres", "--as", "--sugar"]
    assert [entry.placeholder for entry in declared.values()] == ["N", "L", "black|white", None]
    assert declared["cups"].help == "Number of cups. (default: 1)"
    assert by_key(Coffee(kind="white")) == {"cups": 1, "litres": None, "as": "white", "sugar": False}


def test_values_are_checked_by_the_type() -> None:
    assert read_options("brew", Coffee, {"cups": 3, "litres": 0.5, "as": "white", "sugar": True}) == {
        "cups": 3,
        "litres": 0.5,
        "as": "white",
        "sugar": True,
    }
    for values in ({"cups": 1.5}, {"litres": "much"}, {"as": 3}, {"sugar": 1}):
        with pytest.raises(UsageError, match=f"^{next(iter(values))} is "):
            read_options("brew", Coffee, values)
    with pytest.raises(ParameterError, match="brew has no option 'made'"):
        read_options("brew", Coffee, {"made": 1})
    with pytest.raises(ParameterError, match="did you mean 'cups'"):
        read_options("brew", Coffee, {"cup": 1})


def test_a_typed_option_replaces_those_that_say_the_same() -> None:
    filed = {"cups": 2, "sugar": True}
    assert drop_replaced(Coffee, {"litres": 1.0}, filed) == {"sugar": True}
    assert drop_replaced(Coffee, {"litres": 1.0, "cups": 3}, filed) == filed
    assert drop_replaced(Coffee, {"sugar": False}, filed) == filed


@pytest.mark.parametrize(
    ("words", "typed"),
    [
        ([], {}),
        (["--cups", "1"], {"cups": 1}),
        (["--as", "white", "--no-sugar"], {"as": "white", "sugar": False}),
        (["--litres", "0.5", "--sugar"], {"litres": 0.5, "sugar": True}),
    ],
)
def test_a_command_receives_what_was_typed(words: list[str], typed: dict[str, object]) -> None:
    received: list[dict[str, Any]] = []

    @takes_options(Coffee)
    def brew(cup: Annotated[str, typer.Argument()], *, typed: dict[str, Any], hot: bool = False) -> None:
        """Make coffee."""
        received.append({"cup": cup, "hot": hot, **typed})

    app = typer.Typer()
    app.command()(brew)
    result = typer.testing.CliRunner().invoke(app, ["big", *words, "--hot"])
    assert result.exit_code == 0, result.output
    assert received == [{"cup": "big", "hot": True, **typed}]


@pytest.mark.parametrize("command", DECLARATIONS)
def test_every_flag_of_a_command_is_declared(command: str) -> None:
    parser = typer.main.get_command(build_app(command)).commands[command]  # type: ignore[attr-defined]
    flags = {max(each.opts, key=len)[2:].replace("-", "_") for each in parser.params if each.opts[0][0] == "-"}
    declared = set(declared_options(DECLARATIONS[command]))
    assert declared <= flags
    assert flags - declared <= RUN | (ONLY_MAKE if command == "make" else set())


@pytest.mark.parametrize("command", DECLARATIONS)
def test_defaults_satisfy_their_own_checks(command: str) -> None:
    checked = 0
    for key, entry in declared_options(DECLARATIONS[command]).items():
        if entry.default not in (None, ()):
            assert read_options(command, DECLARATIONS[command], {key: entry.default}) == {key: entry.default}
            checked += 1
    assert checked >= (0 if command == "motion" else 2)  # of which every option is as in the print by default


def keywords(function: Callable[..., Any]) -> dict[str, Any]:
    """Return the keywords of a function and their defaults."""
    parameters = inspect.signature(function).parameters.values()
    return {each.name: each.default for each in parameters if each.kind is not each.VAR_KEYWORD}


def declared_defaults(command: str) -> dict[str, Any]:
    return {entry.field: entry.default for entry in declared_options(DECLARATIONS[command]).values()}


def test_the_keywords_of_motion_are_its_options() -> None:
    declared, python = declared_defaults("motion"), keywords(infill.motion)
    assert {name: python.pop(name) for name in declared} == declared
    assert set(python) == {"path", "write", "overwrite"}


def test_the_keywords_of_fill_are_its_options() -> None:
    declared = declared_defaults("fill")
    del (
        declared["units"],
        declared["slicer"],
        declared["seed"],
    )  # of the file, the project, and a parameter of a pattern
    declared["as_"] = declared.pop("form") or "solid"
    python = keywords(infill.fill)
    assert {name: python.pop(name) for name in declared} == declared
    assert set(python) == {"part", "for_", "shell", "meshing", "threads", "max_memory", "progress"}


@pytest.mark.longest
def test_keywords_in_groups_are_those_alone() -> None:
    box = trimesh.creation.box((20, 20, 20))
    alone = infill.fill(box, wall=1.5, drain=3, vent=True, density=(0.15, 0.4), by="x", voxel=0.5, tolerance=0.05)
    grouped = infill.fill(
        box,
        shell=infill.Shell(wall=1.5, drain=3, vent=True),
        density=infill.Graded(0.15, 0.4, by="x"),
        meshing=infill.Meshing(voxel=0.5, tolerance=0.05),
    )
    assert np.array_equal(alone.surface.vertices, grouped.surface.vertices)
    assert np.array_equal(alone.surface.faces, grouped.surface.faces)
    assert alone.report["request"] == grouped.report["request"]


def test_every_keyword_in_a_group_is_one_of_fill_with_its_default() -> None:
    python = keywords(infill.fill)
    for group in (infill.Shell, infill.Meshing):
        for field in fields(group):
            assert python[FLAT_NAMES.get(field.name, field.name)] == field.default


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"wall": 2, "shell": infill.Shell(wall=1)}, "wall is given alone and in shell"),
        ({"open_": "top", "shell": infill.Shell(open="bottom")}, "open is given alone and in shell"),
        ({"voxel": 0.5, "meshing": infill.Meshing(voxel=0.4)}, "voxel is given alone and in meshing"),
        ({"by": "x", "density": infill.Graded(0.1, 0.2)}, "by is given alone, and density is a Graded"),
    ],
)
def test_a_keyword_given_twice_is_told(words: dict[str, Any], says: str) -> None:
    with pytest.raises(UsageError, match=says):
        infill.fill(trimesh.creation.box((20, 20, 20)), **words)


def test_the_keywords_of_refill_are_its_options() -> None:
    declared, python = declared_defaults("refill"), keywords(infill.refill)
    assert {name: python.pop(name) for name in declared} == declared
    assert set(python) == {"gcode", "output", "dry_run", "overwrite", "progress"}


def test_the_keywords_of_verify_are_its_options() -> None:
    declared, python = declared_defaults("verify"), keywords(infill.verify)
    assert {name: python.pop(name) for name in declared} == declared
    assert set(python) == {"old", "new"}


def test_the_keywords_of_make_are_its_options() -> None:
    declared, python = declared_defaults("make"), keywords(infill.make)
    smoothing = python.pop("smoothing")
    for name in ("steps", "fidelity", "interface", "alpha"):
        assert declared.pop(name) == getattr(smoothing, name)
    assert {name: python.pop(name) for name in declared} == declared
    assert set(python) == {"pattern", "allow_broken", "max_memory", "progress"}


def test_the_keywords_of_smooth_are_its_options() -> None:
    declared = set(declared_defaults("smooth"))
    common = set(SmoothOptions.__annotations__) - {"smoothing", "threads", "max_memory", "progress"}
    settings = SmoothSettings()
    assert settings.options["smoothing"] == Smoothing(steps=20)
    spelled = {"radius": "smooth_radius"}
    assert {spelled.get(name, name) for name in common} <= declared
    functions = (infill.smooth_volume, infill.smooth_mesh, infill.smooth_points, infill.smooth_labels)
    python = {name for function in functions for name in keywords(function)}
    inputs = {"volume", "mesh", "points", "origin", "normals", "labels", "table", "segmentation", "resume"}
    assert python - inputs <= declared
    reading = set(settings.reading) | {"labels", "each_label"}
    assert declared <= python | {spelled.get(name, name) for name in common} | reading | {
        "steps",
        "fidelity",
        "interface",
        "between",
        "otsu",
    }


def test_an_option_that_is_added_reaches_everything() -> None:
    """A new field is a flag, a config key and a line of a saved config, with its check."""

    @dataclass(frozen=True, kw_only=True)
    class More(SmoothSettings):
        fuzz: Annotated[float, Option("How fuzzy.", "Surface", unit="MM", default="0")] = 0.0

    assert "fuzz = 0.5" in More(fuzz=0.5).to_toml().splitlines()
    assert read_options("smooth", More, {"fuzz": 2}) == {"fuzz": 2}
    with pytest.raises(UsageError, match="fuzz is 'x'; it must be a number"):
        read_options("smooth", More, {"fuzz": "x"})


def test_contradictions_are_told_with_status_2() -> None:
    result = run("smooth", "a.npy", "--refine", "--smooth", "plain", "-o", "a.stl")
    assert result.exit_code == 2
    assert "--refine is smooth = refine, and smooth is plain" in result.stderr


@pytest.mark.parametrize(
    ("call", "parameter", "flag"),
    [
        (lambda: infill.make("honeycomb", line_width=-1), "line_width", "--line-width"),
        (lambda: infill.make("honeycomb", cell=-1), "cell", "--cell"),
        (lambda: infill.fill(trimesh.creation.box(), wall=-1), "wall", "--wall"),
        (lambda: infill.refill("a.gcode", max_deviation=-1), "max_deviation", "--max-deviation"),
        (lambda: infill.smooth_volume(np.eye(3)[..., None], threshold=0.5, tolerance=-1), "tolerance", "--tolerance"),
    ],
)
def test_an_error_carries_the_name_of_its_parameter(call: Callable[[], object], parameter: str, flag: str) -> None:
    with pytest.raises((ParameterError, infill_patterns.PatternError)) as caught:
        call()
    assert caught.value.parameter == parameter
    assert str(caught.value).startswith(f"{parameter} ")
    assert caught.value.spell(lambda name: f"--{name.replace('_', '-')}") == str(caught.value).replace(
        parameter, flag, 1
    )


def test_an_error_of_a_label_keeps_its_parameter() -> None:
    error = ParameterError.about(("voxel", "resolution"), "are both given").within("label 3")
    assert str(error) == "label 3: voxel and resolution are both given"
    assert error.spell(str.upper) == "label 3: VOXEL and RESOLUTION are both given"
    assert ParameterError.like(infill_patterns.PatternError.about("cell", "is 3")).parameters == ("cell",)
    assert ParameterError.like(infill_patterns.PatternError("too many")).parameters == ()
    assert pickle.loads(pickle.dumps(error)).parameters == ("voxel", "resolution")


@pytest.mark.parametrize(
    ("product", "name"),
    [
        *(("fill", name) for name in ("wall", "overlap", "tolerance", "smooth_radius", "voxel", "line_width", "cell")),
        *(("smooth", name) for name in ("radius", "tolerance", "despeckle", "crumbs")),
    ],
)
def test_a_length_that_may_be_0_is_not_said_to_be_above_it(product: str, name: str) -> None:
    """Whatever is accepted, the message on a negative length must not exclude."""

    def check(value: float) -> None:
        given: dict[str, Any] = {name: value}
        if product == "fill":
            check_request(pattern="gyroid", own={}, **given)
        else:
            SmoothRequest(**given)

    with pytest.raises(ParameterError) as refusal:
        check(-1.0)
    try:
        check(0.0)
    except ParameterError:
        assert "above 0" in str(refusal.value)
    else:
        assert "must be a number from 0 to" in str(refusal.value)
