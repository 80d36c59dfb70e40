"""Parameters as people give them: by flags, by --set, in a config file, of whatever pattern."""

from __future__ import annotations

import itertools
import json
import math
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import pytest
import shapely
from shapes import BUILT_IN, Ripples
from test_command_line import SMALL, one_line_error, plain, refused, run

from infill import ParameterError, read_mesh
from infill.making.settings import resolve
from patterns import PATTERNS, Pattern, PatternError, parameter, parameter_values, parameters
from patterns.given import check_named_value

ROOT = Path(__file__).resolve().parents[1]


@dataclass(frozen=True, kw_only=True)
class Rings(Pattern):
    """A plug-in whose parameters have the names of make's options, and ends that are no round numbers."""

    name: ClassVar[str] = "rings"
    summary: ClassVar[str] = "rings about the middle"

    size: int = parameter(1, "how many", unit="", low=1, high=9, whole=True)
    steps: tuple[float, float] = parameter((3.0, 0.0), "how far from ring to ring, and to the first", low=-2, high=20)
    pattern: float | None = parameter(None, "an angle without meaning", unit="deg", low=-40.1, high=360 / 7)
    line_fit: bool = parameter(True, "a flag without meaning", unit="")
    free: float = parameter(0.0, "a number without range", unit="")

    def lines(self, region: Any, z: float = 0.0) -> shapely.MultiLineString:
        middle = shapely.centroid(region)
        gap, first = self.steps
        return shapely.MultiLineString([middle.buffer(first + gap * (i + 1)).exterior for i in range(self.size)])

    def line_spacing(self, region: Any) -> float:
        return self.steps[0]


KINDS: dict[str, Any] = {**{name: PATTERNS[name] for name in BUILT_IN}, "rings": Rings, "ripples": Ripples}
EVERY = [(kind, name) for kind, made in KINDS.items() for name in parameters(made)]
every_parameter = pytest.mark.parametrize(("kind", "name"), EVERY, ids=["-".join(each) for each in EVERY])


@pytest.fixture(autouse=True)
def _plugins(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two plug-ins beside the built-in patterns."""
    monkeypatch.setattr(PATTERNS, "_plugged_in", {"rings": Rings, "ripples": Ripples})


def as_text(value: Any) -> str:
    """Return a value as people type it."""
    if isinstance(value, (tuple, list)):
        return ",".join(map(str, value))
    return str(value).lower()


def good_values(kind: str, name: str) -> list[Any]:
    """Return values at both ends of the range, the default, and whatever else a parameter may be; degrees."""
    field, described = parameters(KINDS[kind])[name]
    if isinstance(field.default, bool):
        return [True, False]
    ends = [end for end in (described.low, described.high) if math.isfinite(end)] or [-1e300, 12.5]
    if isinstance(field.default, tuple):
        return [(end,) * len(field.default) for end in ends]
    return [*ends, None] if field.default is None else ends


def bad_values(kind: str, name: str) -> list[str]:
    """Return texts beyond both ends of the range, and such as are of the wrong kind."""
    field, described = parameters(KINDS[kind])[name]
    if isinstance(field.default, bool):
        return ["maybe", "2", "", "none"]
    low, high = (described.low, described.high)
    beyond: list[Any] = [end for end in (low - 1, high + 1) if math.isfinite(end)]
    if isinstance(field.default, tuple):
        count = len(field.default)
        beyond = [as_text((end,) * count) for end in beyond] + [as_text((1.0,) * (count + 1)), "1"]
    wrong = ["abc", "", "nan", "inf", "-inf", "true"]
    return [*map(as_text, beyond), *wrong] + ["none"] * (field.default is not None) + ["1.5"] * described.whole


def assert_same(one: Pattern, other: Pattern) -> None:
    """The same pattern, to the rounding of a number in a file."""
    assert type(one) is type(other)
    for name in parameter_values(one) | parameter_values(other):
        assert parameter_values(one)[name] == pytest.approx(parameter_values(other)[name], abs=1e-8)


def test_patterns_that_differ_are_not_the_same() -> None:
    for other in (PATTERNS["zigzag"](angle=6), PATTERNS["zigzag"](waves=3), PATTERNS["honeycomb"]()):
        with pytest.raises((AssertionError, KeyError)):
            assert_same(PATTERNS["zigzag"](), other)


# --- every parameter of every pattern --------------------------------------------------------------------


@pytest.mark.slow
@every_parameter
def test_a_parameter_can_be_set_to_all_of_its_range(kind: str, name: str) -> None:
    for value in good_values(kind, name):
        settings = resolve({"pattern": kind}, assigned=[f"{name}={as_text(value)}"])
        assert settings.parameters == {name: value}
        made = parameter_values(settings.build_pattern())[name]
        assert made == pytest.approx(list(value) if isinstance(value, tuple) else value)


@pytest.mark.slow
@every_parameter
def test_what_a_parameter_cannot_be_is_told_with_range_and_unit(kind: str, name: str) -> None:
    field, described = parameters(KINDS[kind])[name]
    for text in bad_values(kind, name):
        with pytest.raises(ParameterError) as caught:
            resolve({"pattern": kind}, assigned=[f"{name}={text}"])
        said = str(caught.value)
        assert said.startswith(f"--set {name}={text}: {name} of {kind} is ")
        assert "\n" not in said
        if isinstance(field.default, bool):
            assert said.endswith("it must be true or false")
        elif math.isfinite(described.high):
            low, high = (described.low, described.high)
            assert f" from {low:.10g} to {high:.10g} {described.shown_unit}".rstrip() in said
        assert (field.default is None) == said.endswith(", or none")


@pytest.mark.slow
@every_parameter
def test_a_parameter_misspelt_is_told_the_nearest(kind: str, name: str) -> None:
    for typo in (f"{name}x", name[0] + name):
        with pytest.raises(ParameterError, match=f"^--set {typo}=1: {kind} has no parameter '{typo}'; did you mean "):
            resolve({"pattern": kind}, assigned=[f"{typo}=1"])


@pytest.mark.slow
@every_parameter
def test_a_parameter_survives_the_file(kind: str, name: str, tmp_path: Path) -> None:
    for value in good_values(kind, name):
        settings = resolve({"pattern": kind, "steps": 7}, assigned=[f"{name}={as_text(value)}"])
        (tmp_path / "a.toml").write_text(settings.to_toml())
        again = resolve({}, tmp_path / "a.toml")
        assert again.to_toml() == settings.to_toml()
        assert_same(again.build_pattern(), settings.build_pattern())
        assert again.steps == 7


@pytest.mark.longest
@pytest.mark.parametrize("kind", KINDS)
def test_the_list_shows_every_parameter_with_its_help(kind: str) -> None:
    text = plain(run("list", kind).stdout)
    for described in parameters(KINDS[kind]).values():
        assert f" {described[1].help} " in text
        assert described[1].range in text
    assert set(json.loads(run("list", kind, "--json").stdout)["patterns"][kind]["options"]) == set(
        parameters(KINDS[kind])
    )


@pytest.mark.parametrize("kind", BUILT_IN)
def test_what_a_tuple_takes_is_told_when_it_is_no_tuple(kind: str) -> None:
    tuples = [name for name, (field, _) in parameters(KINDS[kind]).items() if isinstance(field.default, tuple)]
    for name, value in itertools.product(tuples, (3, "1,2", [1, "b"], [], {})):
        with pytest.raises(PatternError, match=f"{name} of {kind} is .*; it must be 2 numbers from"):
            check_named_value(KINDS[kind], name, value)


# --- how they are written --------------------------------------------------------------------------------


def test_booleans_are_written_in_many_ways() -> None:
    for texts, value in ((("true", "Yes", "ON", "1"), True), (("false", "no", "off", "0"), False)):
        for text in texts:
            assert resolve({"pattern": "zigzag"}, assigned=[f"frame={text}"]).parameters == {"frame": value}


def test_dashes_and_underscores_and_blanks_are_alike(tmp_path: Path) -> None:
    for text in ("line-fit=no", "line_fit=no", " line-fit = no "):
        assert resolve({"pattern": "rings"}, assigned=[text]).parameters == {"line_fit": False}
    (tmp_path / "a.toml").write_text("pattern = 'rings'\n[set]\nline-fit = false\n")
    assert resolve({}, tmp_path / "a.toml").parameters == {"line_fit": False}


@pytest.mark.parametrize("text", ["cell", "", "=5", " = 5"])
def test_an_assignment_has_a_name_and_a_value(text: str) -> None:
    with pytest.raises(ParameterError, match=f"^--set {text}: give a name and a value with = between"):
        resolve({"pattern": "zigzag"}, assigned=[text])


def test_an_option_of_make_is_pointed_to() -> None:
    with pytest.raises(
        ParameterError, match="--set line-width=1: line_width is not a parameter of zigzag; give --line"
    ):
        resolve({"pattern": "zigzag"}, assigned=["line-width=1"])


@pytest.mark.parametrize(
    ("flags", "assigned", "says"),
    [
        ({"cell": 5.0}, ["cell=6"], "--cell 5 and --set cell=6 differ; give cell once"),
        ({}, ["cell=5", "cell=6"], "--set cell=5 and --set cell=6 differ; give cell once"),
        ({"frame": False}, ["frame=yes"], "--no-frame and --set frame=yes differ; give frame once"),
        ({"frame": True}, ["frame=no"], "--frame and --set frame=no differ; give frame once"),
        ({"phase": (1.0, 2.0)}, ["phase=1,3"], "--phase 1 2 and --set phase=1,3 differ; give phase once"),
        (
            {"waves": 3.0},
            ["cell=5"],
            "--waves 3 and --set cell=5 are both given; waves of zigzag replaces cell: leave one out",
        ),
        (
            {},
            ["waves=3", "cell=5"],
            "--set waves=3 and --set cell=5 are both given; waves of zigzag replaces cell: leave one out",
        ),
    ],
)
def test_one_parameter_has_one_value(flags: dict[str, Any], assigned: list[str], says: str) -> None:
    with pytest.raises(ParameterError) as caught:
        resolve({"pattern": "zigzag", **flags}, assigned=assigned)
    assert str(caught.value) == says


def test_the_same_value_twice_is_no_contradiction() -> None:
    settings = resolve({"pattern": "zigzag", "cell": 5.0, "angle": 30.0}, assigned=["cell=5", "cell=5.0", "angle=30"])
    assert settings.parameters == {"cell": 5.0, "angle": 30.0}


def test_what_is_typed_wins_over_the_file(tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text('pattern = "zigzag"\nangle = 10\n[set]\nwaves = 7.5\nframe = false\n')
    assert resolve({}, config).parameters == {"waves": 7.5, "angle": 10, "frame": False}
    assert resolve({}, config, ["waves=3", "angle=20"]).parameters == {"waves": 3.0, "angle": 20.0, "frame": False}
    assert resolve({}, config, ["cell=5"]).parameters == {"cell": 5.0, "angle": 10, "frame": False}
    assert resolve({"cell": 5.0}, config, ["waves=none"]).parameters["cell"] == 5.0
    assert resolve({}, config, ["waves=none"]).build_pattern().cell == 6.0
    config.write_text('pattern = "zigzag"\n[set]\ncell = 8\n')
    assert resolve({}, config, ["waves=none"]).parameters == {"cell": 8.0, "waves": None}
    assert resolve({}, config, ["waves=2"]).parameters == {"waves": 2.0}


# --- at the command line ---------------------------------------------------------------------------------


@pytest.mark.longest
def test_the_flags_of_the_designs_still_work(tmp_path: Path) -> None:
    for kind, flag, text in (("zigzag", "waves", "2.5"), ("concentric-heart", "hearts", "2")):
        paths = [tmp_path / f"{kind}-{i}.stl" for i in (0, 1)]
        for words, path in zip(([f"--{flag}", text], ["--set", f"{flag}={text}"]), paths, strict=True):
            result = run("make", kind, *SMALL, *words, "-o", path)
            assert result.exit_code == 0, result.output
        assert paths[0].read_bytes() == paths[1].read_bytes()
        assert f"--{flag}" not in run("make", "--help").stdout


@pytest.mark.slow
def test_shared_parameters_are_flags_and_can_be_set(tmp_path: Path) -> None:
    flags = ["--cell", "4", "--angle", "12.5", "--phase", "0.5", "1", "--no-frame"]
    texts = ["cell=4", "angle=12.5", "phase=0.5,1", "frame=no"]
    assigned = [word for text in texts for word in ("--set", text)]
    for words, path in ((flags, tmp_path / "a.stl"), (assigned, tmp_path / "b.stl")):
        assert run("make", "honeycomb", *SMALL, *words, "-o", path).exit_code == 0
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()


@pytest.mark.slow
def test_a_plugin_may_name_its_parameters_as_it_likes(tmp_path: Path) -> None:
    config, mesh = tmp_path / "a.toml", tmp_path / "a.stl"
    words = ["--set", "size=2", "--set", "steps=3,1", "--set", "pattern=10", "--steps", "8"]
    done = run("make", "rings", *SMALL, *words, "-o", mesh, "--save-config", config, "--json")
    assert done.exit_code == 0, done.output
    report = json.loads(done.stdout)
    assert report["request"]["parameters"]["size"] == 2
    assert report["request"]["parameters"]["pattern"] == 10
    assert read_mesh(mesh).to_trimesh().body_count == 2
    again = resolve({}, config)
    assert (again.pattern, again.size, again.steps) == ("rings", (20.0, 20.0), 8)
    assert (again.parameters["size"], again.parameters["steps"]) == (2, (3.0, 1.0))
    assert again.to_toml() == config.read_text()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (
            ["--set", "waves=abc"],
            "error: --set waves=abc: waves of zigzag is 'abc'; it must be a number from 0.5 to 1",
        ),
        (["--set", "angle=270"], "--set angle=270: angle of zigzag is 270 degrees; .* from -180 to 180 degrees"),
        (["--set", "wavs=3"], "--set wavs=3: zigzag has no parameter 'wavs'; did you mean 'waves'"),
        (["--set", "qq=3"], "--set qq=3: zigzag has no parameter 'qq'; it has cell, waves, angle, phase, frame"),
        (["--set", "hearts=3"], "zigzag has no parameter 'hearts'; it has cell"),
        (["--set", "cell=3", "--cell", "4"], "--cell 4 and --set cell=3 differ; give cell once"),
        (["--set", "size=3"], "--set size=3: size is not a parameter of zigzag; give --size"),
    ],
)
def test_bad_parameters_are_one_clear_line(words: list[str], says: str, tmp_path: Path) -> None:
    refused(run("make", "zigzag", *words, "-o", tmp_path / "a.stl"), says)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_level_set_is_made_at_the_command_line(tmp_path: Path) -> None:
    result = run("make", "ripples", *SMALL, "--cell", "5", "--set", "swing=1", "-o", tmp_path / "a.stl")
    assert result.exit_code == 0, result.output
    assert read_mesh(tmp_path / "a.stl").closed
    assert "  level set, the same at every height" in run("list", "ripples").stdout


def test_a_plugin_that_fails_to_draw_is_one_clear_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def fails(self: Rings, region: Any, z: float = 0.0) -> None:
        raise RuntimeError("no\nlines")

    monkeypatch.setattr(Rings, "lines", fails)
    for words in (["list", "rings"], ["make", "rings", "-o", tmp_path / "a.stl"]):
        one_line_error(run(*words), "the pattern rings failed: RuntimeError: no lines")


# --- completion ------------------------------------------------------------------------------------------


def offered(words: str) -> set[str]:
    """Return what a fish shell is offered at the end of a line."""
    environment = {"_INFILL_COMPLETE": "complete_fish", "_TYPER_COMPLETE_FISH_ACTION": "get-args"}
    result = run_completing({**environment, "_TYPER_COMPLETE_ARGS": words})
    return {line.split("\t")[0] for line in result.splitlines()}


def run_completing(environment: dict[str, str]) -> str:
    from typer.testing import CliRunner

    from infill.cli.app import build_app

    return CliRunner().invoke(build_app(), [], env=environment, prog_name="infill").stdout


def test_names_of_patterns_are_completed() -> None:
    assert offered("infill make ri") == offered("infill list ri") == {"rings", "ripples"}


@pytest.mark.slow
def test_names_of_parameters_are_completed_then_flags_among_them() -> None:
    assert offered("infill make zigzag --set ") == {"cell=", "waves=", "angle=", "phase=", "frame="}
    assert offered("infill make rings --set ") == {"size=", "steps=", "pattern=", "line-fit=", "free="}
    assert offered("infill make zigzag --set wa") == {"waves="}
    assert offered("infill make rings --set line_") == {"line_fit="}
    assert offered("infill make rings --set line-fit=") == {"line-fit=true", "line-fit=false"}
    assert offered("infill make zigzag --cell 5 --set frame=f") == {"frame=false"}


def test_values_of_options_are_completed() -> None:
    assert offered("infill make zigzag --stamp ") == {"block", "exact"}
    assert offered("infill make zigzag --stamp e") == {"exact"}
    assert offered("infill smooth a.stl --units ") == {"um", "mm", "cm", "m", "in"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", ["infill make --set ", "infill make nonsense --set ", "infill make zigzag --set cell=5"]
)
def test_nothing_is_completed_where_nothing_is_known(words: str) -> None:
    assert not {word for word in offered(words) if word.endswith("=") and word not in words}


def test_flags_of_the_designs_are_not_offered() -> None:
    assert "--cell" in offered("infill make zigzag --")
    assert "--waves" not in offered("infill make zigzag --")


# --- sixty patterns --------------------------------------------------------------------------------------

SIXTY = """
from dataclasses import dataclass
from patterns import Honeycomb, cell_parameter, parameter

def made(number):
    @dataclass(frozen=True, kw_only=True)
    class Made(Honeycomb):
        name = f"made-{number}"
        first: float = parameter(1.0, "the first of its own", low=0, high=10)
        second: int | None = parameter(None, "the second of its own", unit="", low=0, high=10, whole=True)
        third: bool = parameter(False, "the third of its own", unit="")
    Made.__name__ = Made.__qualname__ = f"Made{number}"
    return Made

for number in range(60):
    globals()[f"Made{number}"] = made(number)
"""


@pytest.fixture
def sixty(tmp_path: Path) -> dict[str, str]:
    """The environment of a machine with sixty more patterns, each with three parameters of its own."""
    folder = tmp_path / "sixty-1.0.dist-info"
    folder.mkdir()
    (tmp_path / "sixty.py").write_text(SIXTY)
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: sixty\nVersion: 1.0\n")
    entries = "\n".join(f"made-{number} = sixty:Made{number}" for number in range(60))
    (folder / "entry_points.txt").write_text(f"[infill.patterns]\n{entries}\n")
    path = os.pathsep.join([str(ROOT), str(tmp_path)])
    return {**os.environ, "PYTHONPATH": path, "COLUMNS": "80"}


def said(words: list[str], environment: dict[str, str]) -> str:
    return subprocess.run(
        [sys.executable, *words], capture_output=True, encoding="utf-8", check=True, env=environment
    ).stdout


@pytest.mark.longest
@pytest.mark.parametrize("columns", ["80", "100"])
def test_the_help_of_make_stays_short(sixty: dict[str, str], columns: str) -> None:
    environment = {**sixty, "COLUMNS": columns}
    listed = said(["-m", "infill.cli", "list"], environment)
    assert listed.count("made-") == 60
    assert "first" in said(["-m", "infill.cli", "list", "made-59"], environment)
    text = said(["-m", "infill.cli", "make", "--help"], environment)
    assert len(text.splitlines()) < 90  # sixty patterns more, and not a line
    assert "made-" not in text
    assert text == said(["-m", "infill.cli", "make", "--help"], {**environment, "PYTHONPATH": str(ROOT)})


@pytest.mark.longest
@pytest.mark.skipif(sys.platform == "win32", reason="children have no times of their own there")
def test_the_help_of_make_stays_fast(sixty: dict[str, str]) -> None:
    """Under 0.4 s; 0.25 of them are what any program with typer, rich and pydantic takes to begin.

    Seconds of the processor, not of the clock, the best of five; and on a slow or a busy machine, where one of its
    seconds does less, as much more as those 0.25.
    """
    import resource

    def seconds(words: list[str]) -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        said(words, sixty)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    runs = [
        (seconds(["-m", "infill.cli", "make", "--help"]), seconds(["-c", "import typer.rich_utils, pydantic.fields"]))
        for _ in range(5)
    ]
    help_seconds, begin = map(min, zip(*runs, strict=True))
    assert help_seconds < 0.4 * max(1.0, begin / 0.25)
