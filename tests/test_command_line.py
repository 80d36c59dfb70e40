"""One contract for every command, then each command as a user types it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
import typer.main
from PIL import Image
from shapely import box
from shapes import BUILT_IN, IN_SPACE, one_of_each_kind
from typer.testing import CliRunner

import infill
from infill import ParameterError, read_mesh
from infill.cli.app import build_app
from infill.cli.commands import OTHER_OPTIONS
from infill.cli.console import format_bytes
from infill.cli.listing import BRAILLE_BLANK
from infill.cli.words import parse_bytes
from infill.making.settings import MakeSettings, parse_size, resolve
from patterns import PATTERNS, gives, parameters
from patterns.shared import SHARED

COMMANDS = [
    "make",
    "smooth",
    "fill",
    "refill",
    "list",
    "check",
    "motion",
    "verify",
    "sample",
    "studio",
    "setup",
    "view",
    "mcp",
]
SMALL = ["--size", "20", "--height", "2"]
RUN = [sys.executable, "-m", "infill.cli"]


def run(*words: str | Path) -> Any:
    return CliRunner().invoke(build_app(), [str(word) for word in words])


def plain(text: str) -> str:
    """Return help text without boxes, colours and line breaks."""
    return re.sub(r"[\s│╭╮╰╯─]+", " ", re.sub(r"\x1b\[[0-9;]*m", "", text))


def one_line_error(result: Any, says: str) -> None:
    """An error of ours: exit 1, one line on stderr, nothing on stdout."""
    assert result.exit_code == 1, result.output
    assert result.stdout == ""
    assert re.search(says, result.stderr), result.stderr
    assert result.stderr.startswith("error: ")
    assert result.stderr.count("\n") == 1


def usage_error(result: Any, says: str) -> None:
    """A command line that cannot be understood: exit 2, the usage, one line, nothing on stdout."""
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    usage, line = result.stderr.rstrip("\n").rsplit("\n", 1)
    assert usage.lstrip().startswith("Usage: infill"), result.stderr
    assert usage.endswith(" --help' for help.")
    assert line.startswith("error: ")
    assert re.search(says, line), result.stderr


def refused(result: Any, says: str) -> None:
    """One of both: which one it is, tests/test_options.py holds for every option."""
    (usage_error if result.exit_code == 2 else one_line_error)(result, says)


# --- every command ---------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_help_has_an_example_and_exits_0(command: str) -> None:
    for flag in ("--help", "-h"):
        result = run(command, flag)
        assert result.exit_code == 0
        assert f"Example: infill {command}" in plain(result.stdout)


def test_help_names_every_command() -> None:
    text = plain(run("--help").stdout)
    assert all(command in text for command in COMMANDS)
    assert {command.name for command in build_app().registered_commands} == set(COMMANDS)
    assert "Example: infill make" in text


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [["nonsense"], ["make", "honeycomb", "--nonsense"], ["check"], ["make", "honeycomb", "--height", "tall"]]
)
def test_usage_errors_exit_2(words: list[str]) -> None:
    if words != ["check"]:
        usage_error(run(*words), words[-1] if words[-1] != "tall" else "--height")
    else:  # without arguments, it is the help
        assert run(*words).exit_code == 2


def test_the_version_is_the_packages() -> None:
    assert run("--version").stdout == f"infill {infill.__version__} (phasefill)\n"


def test_both_names_are_the_same_program() -> None:
    scripts = {entry.name: entry.value for entry in entry_points(group="console_scripts")}
    assert scripts["infill"] == scripts["phasefill"] == "infill.cli:program"


@pytest.mark.slow
def test_completion_is_there() -> None:
    environment = {**os.environ, "_INFILL_COMPLETE": "complete_bash", "COMP_WORDS": "infill make ho", "COMP_CWORD": "2"}
    code = "import sys; sys.argv = ['infill']; from infill.cli import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, encoding="utf-8", check=False
    )
    assert "honeycomb" in done.stdout


def test_the_readme_names_every_command() -> None:
    readme = (Path(__file__).resolve().parents[1] / "README.md").read_text(encoding="utf-8")
    for command in COMMANDS:
        assert f"infill {command}" in readme


@pytest.mark.longest
@pytest.mark.parametrize("package", ["infill", "infill.cli"])
def test_python_runs_the_package(package: str) -> None:
    """And answers what it is asked, or says what is wrong; the package alone is asked everything."""
    asked = (
        (["--version"], 0, f"infill {infill.__version__} (phasefill)\n"),
        (["list", "honycomb"], 1, "error: there is no pattern 'honycomb'; did you mean 'honeycomb'?"),
        (["list", "--nonsense"], 2, "No such option: --nonsense"),
        (["make", "grid", "--wall", "1", "-o", "a.stl"], 2, "No such option: --wall; did you mean --line-width?"),
        (["make", "voronoi", "--seed", "3", "-o", "a.stl"], 2, "No such option: --seed; did you mean --set seed=N?"),
        (["fill", "a.stl", "--infill", "20", "-o", "b.stl"], 2, "No such option: --infill; did you mean --density?"),
        (["check", "--wall", "1", "a.stl"], 2, "No such option: --wall"),
        (["motion", "-"], 1, "error: '-' is not a file, and nothing is read from stdin; save it"),
    )
    for words, code, says in asked if package == "infill" else asked[:2]:
        done = subprocess.run([sys.executable, "-m", package, *words], capture_output=True, text=True, check=False)
        assert done.returncode == code
        assert says in (done.stderr if code else done.stdout)


# --- list ------------------------------------------------------------------------------------------------


def test_list_is_one_line_a_pattern() -> None:
    lines = run("list").stdout.splitlines()
    for name, line in zip(BUILT_IN, lines, strict=False):
        assert line.split() == [name, *PATTERNS[name].summary.split()]
    rest = lines[len(BUILT_IN) :]
    assert rest[:3] == [
        "'infill list PATTERN' shows one, with its parameters and a picture.",
        "",
        "in space:",
    ]
    for (name, each), line in zip(IN_SPACE.items(), rest[3:], strict=True):
        assert line.split() == [name, *each.summary.split()]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["gyroid", "octet"])
def test_list_shows_a_pattern_that_repeats_in_space(name: str) -> None:
    assert run("list", name).stdout.startswith(f"{name}: {IN_SPACE[name].summary}\n  repeats in space")
    assert json.loads(run("list", name, "--json").stdout) == {
        "patterns": {},
        "in_space": {name: IN_SPACE[name].summary},
    }


@pytest.mark.longest
@pytest.mark.parametrize("name", ["octet", "lightning"])
def test_list_draws_a_cube_of_a_pattern_in_space(name: str, tmp_path: Path) -> None:
    """Cut open, so that the colour of cuts is seen, and what lies behind them; written as other outputs are."""
    path = tmp_path / "a.png"
    path.write_text("mine", encoding="utf-8")
    one_line_error(run("list", name, "--preview", path), "exists; .* --force")
    one_line_error(run("list", name, "--preview", tmp_path / "a.jpg"), r"ends in \.png")
    assert path.read_text(encoding="utf-8") == "mine"
    result = run("list", name, "--preview", path, "--force")
    assert result.stderr == f"wrote {path}\n"
    assert result.stdout.startswith(f"{name}: ")
    assert list(tmp_path.iterdir()) == [path]
    with Image.open(path) as picture:
        assert picture.width > 2 * picture.height  # the block, and two cuts
        red, _, blue = np.asarray(picture.convert("RGB"), dtype=int).transpose(2, 0, 1)
    cut, paper = red > blue + 60, (red == 255) & (blue == 255)
    assert 0.005 < cut.mean() < 0.2
    assert 0.1 < (~cut & ~paper).mean() < 0.9


@pytest.mark.parametrize("name", ["adaptive-cubic", "support-cubic"])
def test_list_shows_a_pattern_that_follows_the_part(name: str) -> None:
    text = run("list", name).stdout
    assert text.startswith(f"{name}: {IN_SPACE[name].summary}\n  follows the part")
    assert "--set levels" in text


@pytest.mark.slow
@pytest.mark.parametrize("name", BUILT_IN)
def test_list_shows_one_pattern(name: str) -> None:
    text, kind = run("list", name).stdout, PATTERNS[name]
    height = "the same at every height" if kind.prismatic else "changing with height"
    assert text.startswith(f"{name}: {kind.summary}\n  {' and '.join(gives(kind))}, {height}\n")
    for option, (_, described) in parameters(kind).items():
        (line,) = [line for line in text.splitlines() if line.split("  ")[1:2] == [_typed(option)]]
        assert line.endswith(described.help)
        assert described.range in text
    assert all(len(line) <= 80 for line in text.splitlines())


def test_list_shows_defaults_with_their_units_and_ranges() -> None:
    text = run("list", "honeycomb").stdout
    assert "6 mm; a number from 0.001 to 10000 mm" in text
    assert "0 degrees; a number from -180 to 180 degrees" in text


def _typed(option: str) -> str:
    return f"--{option}" if option in SHARED else f"--set {option}"


@pytest.mark.long
@pytest.mark.parametrize("name", one_of_each_kind(BUILT_IN))
def test_list_draws_the_pattern(name: str) -> None:
    """Dots of braille, as dark at the left as the lines are; blanks and # where stdout has no braille."""
    drawn = run("list", name).stdout.split("\n\n")[-1].splitlines()
    assert {len(line) for line in drawn} == {40}
    assert len(drawn) == 20
    dots = "".join(drawn)
    assert all(0x2800 <= ord(character) < 0x2900 for character in dots)
    assert sum(character != BRAILLE_BLANK for character in dots) / len(dots) > 0.1
    done = subprocess.run(
        [*RUN, "list", name], capture_output=True, check=True, env={**os.environ, "PYTHONIOENCODING": "ascii"}
    )
    plain_drawing = done.stdout.decode("ascii").split("\n\n")[-1].replace("\r", "").removesuffix("\n").split("\n")
    assert len(plain_drawing) == 30
    assert set("".join(plain_drawing)) == {"#", " "}


def test_the_drawing_is_the_right_way_up() -> None:
    """The tip of a heart is at the lower left, its lobes are not."""
    drawn = run("list", "concentric-heart").stdout.split("\n\n")[-1].splitlines()
    assert drawn[-1][0] != BRAILLE_BLANK
    assert drawn[0][0] == drawn[0][-1] == drawn[-1][-1] == BRAILLE_BLANK


@pytest.mark.slow
def test_list_writes_a_picture(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    result = run("list", "concentric-heart", "--preview", path)
    assert result.stderr == f"wrote {path}\n"
    with Image.open(path) as picture:
        assert picture.size == (600, 600)
        dark = np.asarray(picture.convert("L")) < 128
    lines = PATTERNS["concentric-heart"]().lines(box(-29.775, -29.775, 29.775, 29.775))
    assert dark.mean() == pytest.approx(lines.length * 0.45 / 3600, rel=0.05)  # joints and ends
    assert dark[-20:, :20].any()  # the tip, below
    assert not dark[:20, :20].any()
    one_line_error(run("list", "concentric-heart", "--preview", path), "exists; .* --force")
    assert run("list", "zigzag", "--preview", path, "--force").exit_code == 0
    one_line_error(run("list", "zigzag", "--preview", tmp_path / "a.jpg"), r"ends in \.png")
    assert run("list", "--preview", tmp_path / "b.png").exit_code == 2


def test_list_names_the_nearest_pattern() -> None:
    one_line_error(run("list", "honycomb"), "there is no pattern 'honycomb'; did you mean 'honeycomb'")
    one_line_error(run("list", "Hexagon"), "there is no pattern 'Hexagon'; did you mean 'honeycomb'")


def test_list_as_json() -> None:
    whole = json.loads(run("list", "--json").stdout)
    found = whole["patterns"]
    assert set(whole["in_space"]) == set(IN_SPACE)
    assert set(found) == set(BUILT_IN)
    assert found["honeycomb"]["options"]["angle"] == {
        "help": "turns the pattern counter-clockwise",
        "unit": "degrees",
        "default": 0.0,
        "low": -180.0,
        "high": 180.0,
    }
    assert found["zigzag"]["options"]["waves"]["default"] is None
    assert found["zigzag"]["options"]["phase"]["default"] == [0.0, 0.0]
    assert found["zigzag"]["prismatic"] is True
    assert found["zigzag"]["gives"] == ["lines"]
    assert json.loads(run("list", "zigzag", "--json").stdout) == {"patterns": {"zigzag": found["zigzag"]}}


# --- check -----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_check_says_yes_and_no(tmp_path: Path) -> None:
    mesh = infill.make("honeycomb", size=20, height=2).mesh
    good, bad = infill.save(mesh, tmp_path / "good.stl"), tmp_path / "bad.stl"
    mesh.update_faces([i > 0 for i in range(len(mesh.faces))])
    infill.save(mesh, bad)
    result = run("check", good)
    assert result.exit_code == 0
    assert "printable       yes" in result.stdout
    result = run("check", bad)
    assert result.exit_code == 1
    assert "NO" in result.stdout
    assert "not closed" in result.stdout
    found = json.loads(run("check", bad, "--json").stdout)
    assert found["printable"] is False
    assert found["open_edges"] == 3


def test_check_strict_minds_warnings(data: Path) -> None:
    path = data / "nasty" / "zero_area_triangle.stl"
    assert run("check", path).exit_code == 0
    assert run("check", path, "--strict").exit_code == 1


def test_check_tells_what_it_cannot_read(tmp_path: Path) -> None:
    one_line_error(run("check", tmp_path / "gone.stl"), "there is no file")


def test_check_takes_several_meshes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line for each, in their order; one that cannot be read does not stop the others."""
    monkeypatch.chdir(tmp_path)
    box = trimesh.creation.box((10, 20, 30))
    box.export("good.stl")
    box.copy().apply_scale(0.01).export("tiny.stl")  # of a likely size in another unit: a warning
    box.update_faces(np.arange(len(box.faces)) > 0)
    box.export("bad.stl")
    result = run("check", "good.stl", "gone.stl", "bad.stl", "tiny.stl")
    assert result.exit_code == 1
    assert re.fullmatch("error: there is no file gone.stl; .*\n", result.stderr)
    good, bad, tiny = result.stdout.splitlines()
    assert re.fullmatch(r"good\.stl +yes +12 triangles, 1 part, 10 x 20 x 30 mm", good)
    assert re.fullmatch(r"bad\.stl +NO +3 edges without exactly two faces.*", bad)
    assert re.fullmatch(r"tiny\.stl +yes .*; warning: the size suggests that the unit is m, not mm", tiny)
    assert run("check", "good.stl", "tiny.stl").exit_code == 0
    assert run("check", "good.stl", "tiny.stl", "--strict").exit_code == 1


def test_check_tells_of_several_meshes_in_a_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each object is that of the mesh alone, with its file."""
    monkeypatch.chdir(tmp_path)
    trimesh.creation.box((10, 20, 30)).export("a.stl")
    (tmp_path / "b.stl").write_bytes(b"")
    alone = json.loads(run("check", "a.stl", "--json").stdout)
    result = run("check", "a.stl", "b.stl", "--json")
    assert result.exit_code == 1
    one, other = json.loads(result.stdout)
    assert one == {"file": "a.stl", **alone}
    assert set(other) == {"file", "error"}
    assert other["file"] == "b.stl"
    assert result.stderr == f"error: {other['error']}\n"


# --- make ------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "suffix"),
    [*((name, ".stl") for name in BUILT_IN), *((BUILT_IN[0], other) for other in (".3mf", ".obj", ".ply", ".glb"))],
)
def test_make_writes_a_closed_mesh(name: str, suffix: str, tmp_path: Path) -> None:
    """Every pattern, and every format."""
    path = tmp_path / f"block{suffix}"
    result = run("make", name, *SMALL, "-o", path)
    assert result.exit_code == 0, result.output
    assert result.stdout == ""
    assert "closed" in result.stderr
    assert read_mesh(path).closed


def test_make_reports_as_json(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    result = run("make", "honeycomb", *SMALL, "--angle", "30", "-o", path, "--json")
    report = json.loads(result.stdout)
    assert report["files"] == [str(path)]
    assert report["request"]["parameters"]["angle"] == 30
    assert report["closed"] is True
    assert read_mesh(path).volume == pytest.approx(report["volume"], rel=1e-5)


@pytest.mark.slow
def test_make_writes_several_files_and_a_picture(tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("a.stl", "a.3mf", "a.png")]
    result = run("make", "zigzag", *SMALL, "-o", paths[0], "-o", paths[1], "--preview", paths[2], "-v")
    assert result.exit_code == 0, result.output
    assert all(path.stat().st_size > 1000 for path in paths)
    assert "seconds" in result.stderr
    assert "cells of 0.1504 mm" in result.stderr


def test_make_is_quiet_on_request(tmp_path: Path) -> None:
    result = run("make", "honeycomb", *SMALL, "-o", tmp_path / "a.stl", "-q")
    assert (result.stdout, result.stderr) == ("", "")


def test_make_can_only_report() -> None:
    assert json.loads(run("make", "honeycomb", *SMALL, "--json").stdout)["files"] == []


def test_make_without_anything_to_write_is_a_usage_error() -> None:
    assert run("make", "honeycomb").exit_code == 2


def test_make_writes_stl_as_text(tmp_path: Path) -> None:
    run("make", "honeycomb", *SMALL, "-o", tmp_path / "a.stl", "--ascii")
    assert (tmp_path / "a.stl").read_bytes().startswith(b"solid")


@pytest.mark.slow
def test_make_tells_pinholes_and_problems(tmp_path: Path) -> None:
    words = ["make", "honeycomb", "--size", "25", "--cell", "2.5", "--height", "2", "-o", tmp_path / "a.stl"]
    assert re.search(r"closed up +\d+ gaps? narrower than a line", run(*words).stderr)
    words = ["make", "honeycomb", *SMALL, "--stamp", "exact", "--cells", "3", "--steps", "25", "-o", tmp_path / "b.stl"]
    one_line_error(run(*words), "--allow-broken")
    assert not (tmp_path / "b.stl").exists()
    assert "PROBLEMS" in run(*words, "--allow-broken").stderr


def test_walls_that_cannot_be_measured_are_said_so(tmp_path: Path) -> None:
    words = ["--size", "1.8", "--cell", "1.35", "--height", "1", "-o", tmp_path / "a.stl"]
    assert "not measured: every wall is too close" in run("make", "honeycomb", *words).stderr
    assert json.loads(run("make", "honeycomb", *words, "--force", "--json").stdout)["wall_width"]["mean"] is None


@pytest.mark.slow
def test_dry_run_writes_nothing(tmp_path: Path) -> None:
    words = ["make", "honeycomb", "--size", "250x210", "-o", tmp_path / "a.stl", "--dry-run"]
    result = run(*words)
    assert result.exit_code == 0
    assert "1667 x 1400 cells of 0.15 mm" in result.stdout
    assert list(tmp_path.iterdir()) == []
    path = tmp_path / "a.stl"
    facts = json.loads(run("make", "zigzag", "--size", "50x40", "-o", path, "--dry-run", "--json").stdout)
    assert list(tmp_path.iterdir()) == []
    assert run("make", "zigzag", "--size", "50x40", "-o", path).exit_code == 0
    report = json.loads(run("make", "zigzag", "--size", "50x40", "-o", path, "--force", "--json").stdout)
    assert (facts["request"], facts["grid"]) == (report["request"], report["grid"])
    assert facts["stl_bytes"] == pytest.approx(path.stat().st_size, rel=0.25)  # as near as the plan is


# --- settings --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_saved_config_makes_the_same_block(tmp_path: Path) -> None:
    config, one, other = tmp_path / "a.toml", tmp_path / "a.stl", tmp_path / "b.stl"
    words = [
        *SMALL,
        "--cell",
        "4",
        "--angle",
        "12.5",
        "--phase",
        "0.5",
        "1",
        "--no-frame",
        "--stamp",
        "exact",
        "--steps",
        "8",
    ]
    assert run("make", "honeycomb", *words, "--save-config", config, "-o", one).exit_code == 0
    assert run("make", "--config", config, "-o", other).exit_code == 0
    assert one.read_bytes() == other.read_bytes()
    assert run("make", "--config", config, "--save-config", config, "--force").exit_code == 0
    assert "angle = 12.5" in config.read_text()


@pytest.mark.slow
def test_a_config_goes_to_stdout_alone(tmp_path: Path) -> None:
    config, mesh = tmp_path / "a.toml", tmp_path / "a.stl"
    words = ["make", "honeycomb", *SMALL, "--cell", "4", "--angle", "12.5"]
    for more in ([], ["-q"], ["-o", mesh]):
        result = run(*words, *more, "--save-config", "-")
        assert result.exit_code == 0, result.output
        config.write_text(result.stdout)
        assert resolve({}, config).to_toml() == result.stdout
        assert (result.stderr == "") == (not mesh.exists())
    assert sorted(tmp_path.iterdir()) == [mesh, config]
    assert "angle = 12.5" in result.stdout
    for other in ("--json", "--dry-run"):
        usage_error(run(*words, other, "--save-config", "-"), "stdout for itself")
    one_line_error(run("make", "honeycomb", "--height", "-1", "--save-config", "-"), "--height is -1 mm")


@pytest.mark.parametrize("name", BUILT_IN)
def test_settings_survive_the_file(name: str, tmp_path: Path) -> None:
    given = {option: value for option, value in (("cell", 5), ("angle", 20)) if option in parameters(PATTERNS[name])}
    settings = resolve({"pattern": name, "size": "30x20", "alpha": 0.2, **given})
    (tmp_path / "a.toml").write_text(settings.to_toml())
    again = resolve({}, tmp_path / "a.toml")
    assert again.to_toml() == settings.to_toml()
    assert again.plan().pattern == settings.plan().pattern


def test_flags_win_over_the_file(tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text('pattern = "honeycomb"\nsize = [30, 20]\nline-width = 0.6\ncell = 8\n')
    settings = resolve({"cell": 5.0, "height": None}, config)
    assert settings == MakeSettings(pattern="honeycomb", size=(30.0, 20.0), line_width=0.6, parameters={"cell": 5.0})
    assert settings.plan().request_keys()["height"] == 6.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("size = 20", "no pattern is given"),
        ('pattern = "honeycomb"\nhieght = 3', "no option 'hieght'; did you mean 'height'"),
        ('pattern = "honeycomb"\nqqq = 3', "no option 'qqq'; it has cell, angle"),
        ("pattern = 3", "pattern is 3; it must be a word"),
        ('pattern = "honeycomb"\nset = 3', "set is 3; it must be a table"),
        ('pattern = "honeycomb"\n[set]\nsell = 3', "honeycomb has no parameter 'sell'; did you mean 'cell'"),
        (
            'pattern = "honeycomb"\ncell = 5\n[set]\ncell = 6',
            "cell = 5 in the config file and cell = 6 in .set. of the config file differ",
        ),
        ('pattern = "zigzag"\ncell = 5\n[set]\nwaves = 6', "waves of zigzag replaces cell: leave one out"),
        ('pattern = "honeycomb"\nwaves = 3', "honeycomb has no option 'waves'"),
        ('pattern = "honeycomb"\nheight = "tall"', "height is 'tall'; it must be a number"),
        ('pattern = "honeycomb"\nframe = 1', "frame of honeycomb is 1; it must be true or false"),
        ('pattern = "honeycomb"\nphase = [1]', "phase of honeycomb is 1 mm; it must be 2 numbers from -10000"),
        ('pattern = "honeycomb"\nstamp = 3', "stamp is 3; it must be a word"),
        ('pattern = "honeycomb"\nsize = [1, 2, 3, 4]', "give millimetres as 60x40"),
        ('pattern = "honeycomb', "is not TOML"),
        ('pattern = "honeycomb"\ncell = true', "cell of honeycomb is True; it must be a number from 0.001"),
    ],
)
def test_a_bad_config_is_one_clear_line(text: str, says: str, tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text(text)
    one_line_error(run("make", "--config", config, "-o", tmp_path / "a.stl"), says)
    assert list(tmp_path.iterdir()) == [config]


def test_a_missing_config_is_told(tmp_path: Path) -> None:
    one_line_error(run("make", "--config", tmp_path / "no.toml", "-o", tmp_path / "a.stl"), "there is no config file")
    one_line_error(run("make", "--config", tmp_path, "-o", tmp_path / "a.stl"), "cannot read")


def test_sizes_and_bytes_are_read_as_people_write_them() -> None:
    assert parse_size("size", "60") == parse_size("size", 60) == parse_size("size", [60, 60]) == (60, 60)
    assert parse_size("size", " 60 × 40 ") == parse_size("size", "60X40") == (60, 40)
    assert [parse_bytes(text) for text in ("100", "1K", "2 MB", "1.5 GiB")] == [100, 1024, 2 * 2**20, 3 * 2**29]
    assert parse_size("size", "60x40x2") == (60, 40, 2)
    for bad in ("", "x", "60x40x2x1", "60x", None):
        with pytest.raises(ParameterError, match="size is"):
            parse_size("size", bad)
    for bad in ("", "-1G", "0", "2Q"):
        with pytest.raises(ParameterError, match="max_memory is"):
            parse_bytes(bad)
    assert [format_bytes(n) for n in (5, 12_345, 10_625_284, 3e9, 5e12)] == [
        "5 B",
        "12.3 kB",
        "10.6 MB",
        "3 GB",
        "5,000 GB",
    ]


def test_toml_quotes_what_it_must() -> None:
    from infill.options.toml import format_rows

    assert format_rows({"name": 'a "b" \\ c'}) == ['name = "a \\"b\\" \\\\ c"']


def test_cell_and_what_replaces_it(tmp_path: Path) -> None:
    """A flag for one drops the other from the file; both at once are an error."""
    config = tmp_path / "a.toml"
    config.write_text(resolve({"pattern": "concentric-heart", "hearts": 5, "angle": 10}).to_toml())
    assert "cell" not in config.read_text()
    assert resolve({}, config).parameters["hearts"] == 5
    assert resolve({"cell": 8.0}, config).parameters == {
        "cell": 8.0,
        "angle": 10.0,
        "phase": (0.0, 0.0),
        "frame": False,
    }
    config.write_text('pattern = "concentric-heart"\ncell = 8\n')
    assert resolve({"hearts": 2}, config).parameters == {"hearts": 2}
    with pytest.raises(ParameterError, match="hearts of concentric-heart replaces cell: leave one out"):
        resolve({"pattern": "concentric-heart", "hearts": 5, "cell": 4})


# --- errors: one clear line, exit 1, nothing written -----------------------------------------------------

BAD = [
    (["honycomb"], "there is no pattern 'honycomb'; did you mean 'honeycomb'"),
    (["qqqq"], "there is no pattern 'qqqq'; there are concentric-heart, zigzag, honeycomb"),
    *[
        (["honeycomb", option, value], "finite number above 0")
        for option in ("--size", "--height", "--line-width")
        for value in ("0", "-3", "nan", "inf")
    ],
    (["honeycomb", "--size", "60x0"], "size y is 0 mm; it must be a finite number above 0"),
    (["honeycomb", "--size", "big"], "size is 'big'; give millimetres as 60x40"),
    *[
        (["honeycomb", "--cell", value], "cell of honeycomb is .* from 0.001 to 10000 mm")
        for value in ("0", "-3", "nan", "inf")
    ],
    (["honeycomb", "--cells", "4"], "no middle cell; use an odd number"),
    (["honeycomb", "--cells", "0"], "whole number of at least 1"),
    (["honeycomb", "--cell", "1.3"], "1.3 mm apart, under 3 line widths .1.35 mm."),
    (["honeycomb", "--alpha", "0.26"], "stable up to 0.25 on this 2D grid; lower alpha"),
    (["honeycomb", "--alpha", "nan"], "alpha is nan"),
    (["honeycomb", "--steps", "-1"], "--steps is -1"),
    (["honeycomb", "--fidelity", "-1"], "fidelity is -1"),
    (["honeycomb", "--stamp", "round"], "'--stamp': .*'round' is not one of 'block', 'exact'"),
    (["honeycomb", "--size", "100000"], "needs about .* GiB of memory and .* GiB is at hand; the grid has"),
    (["honeycomb", "--max-memory", "80M"], "needs about 0.* GiB of memory and 0.08 GiB is allowed"),
    (["honeycomb", "--max-memory", "lots"], "--max-memory is 'lots'"),
    (["honeycomb", "--waves", "3"], "honeycomb has no option 'waves'"),
    (["honeycomb", "--angle", "200"], "angle of honeycomb is 200 degrees; .* -180 to 180"),
    (["honeycomb", "--size", "20", "--cells", "1"], "in smoothing.*; with --stamp exact"),
    (["honeycomb", "--size", "1"], "no room for walls"),
]


BROKEN = {
    "--stamp exact": ["zigzag", "--size", "19.95", "--cell", "1.35"],
    "--stamp exact --cells 5": ["honeycomb", "--size", "20", "--cells", "1"],
    "--cells 5": ["honeycomb", "--size", "30", "--stamp", "exact", "--cells", "3", "--steps", "60"],
}


@pytest.mark.parametrize("remedy", BROKEN)
def test_what_a_broken_block_is_told_mends_it(remedy: str, tmp_path: Path) -> None:
    words = [*BROKEN[remedy], "-o", str(tmp_path / "a.stl")]
    refused(run("make", *words), f"; with {remedy} nothing is lost; --allow-broken writes it as it is")
    mended = run("make", *words, *remedy.split())
    assert mended.exit_code == 0, mended.stderr
    assert "PROBLEMS" not in mended.stderr


@pytest.mark.long
@pytest.mark.parametrize(("words", "says"), BAD, ids=[" ".join(words) for words, _ in BAD])
def test_bad_input_is_one_clear_line(words: list[str], says: str, tmp_path: Path) -> None:
    refused(run("make", *words, "-o", tmp_path / "a.stl", "--preview", tmp_path / "a.png"), says)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["a.xyz", "a", "a.stl.zip"])
def test_an_unknown_suffix_is_told_before_the_work(name: str, tmp_path: Path) -> None:
    one_line_error(run("make", "honeycomb", "-o", tmp_path / name), r"use one of \.stl, \.3mf, \.obj, \.ply, \.glb")
    assert list(tmp_path.iterdir()) == []


def test_pictures_are_png(tmp_path: Path) -> None:
    one_line_error(run("make", "honeycomb", "--preview", tmp_path / "a.jpg"), r"ends in \.png")


@pytest.mark.slow
@pytest.mark.parametrize("flag", ["-o", "--preview", "--save-config"])
def test_existing_files_are_kept_without_force(flag: str, tmp_path: Path) -> None:
    path = tmp_path / {"-o": "a.stl", "--preview": "a.png", "--save-config": "a.toml"}[flag]
    path.write_text("precious")
    one_line_error(run("make", "honeycomb", *SMALL, flag, path), "exists; .* --force")
    assert path.read_text() == "precious"
    assert run("make", "honeycomb", *SMALL, flag, path, "--force").exit_code == 0
    assert path.read_bytes() != b"precious"


def test_two_outputs_are_two_files(tmp_path: Path) -> None:
    same = tmp_path / "a.stl"
    one_line_error(run("make", "honeycomb", *SMALL, "-o", same, "--save-config", same), "is named twice")
    one_line_error(run("make", "honeycomb", *SMALL, "-o", same, "-o", tmp_path / "." / "a.stl"), "is named twice")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_all_outputs_appear_or_none(tmp_path: Path) -> None:
    long = tmp_path / ("x" * 300 + ".obj")
    one_line_error(run("make", "honeycomb", *SMALL, "-o", tmp_path / "a.stl", "-o", long), "cannot write|too long")
    assert list(tmp_path.iterdir()) == []
    words = ["-o", tmp_path / "a.stl", "-o", tmp_path / "b.obj", "--preview", tmp_path / "a.png"]
    assert run("make", "honeycomb", *SMALL, *words).exit_code == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.png", "a.stl", "b.obj"]


@pytest.mark.longest
def test_names_that_a_console_cannot_show(tmp_path: Path) -> None:
    path = infill.save(infill.make("honeycomb", size=20, height=2).mesh, tmp_path / "测试.stl")
    for words in (["check", str(path)], ["check", str(path), "--json"]):
        done = subprocess.run(
            [*RUN, *words], capture_output=True, check=False, env={**os.environ, "PYTHONIOENCODING": "cp1252"}
        )
        assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_a_limit_holds_for_a_dry_run_too(tmp_path: Path) -> None:
    words = ["make", "honeycomb", "--size", "250x210", "--stamp", "exact", "--dry-run"]
    assert run(*words).exit_code == 0
    one_line_error(run(*words, "--max-memory", "500M"), "0.49 GiB is allowed")


@pytest.mark.slow
def test_make_tells_its_surface_and_what_the_exact_stamp_would_give(tmp_path: Path) -> None:
    lean = run("make", "honeycomb", "--size", "30", "-o", tmp_path / "a.stl").stderr
    assert "prism, within 0.002 mm of the isosurface at mid height" in lean
    assert re.search(r"^  advice +--stamp exact makes the walls 0\.4(4[89]|5[012]) mm wide", lean, re.MULTILINE)
    exact = run("make", "honeycomb", "--size", "30", "--stamp", "exact", "-o", tmp_path / "b.stl").stderr
    assert "advice" not in exact
    grid = run("make", "honeycomb", "--size", "30", "--tolerance", "0", "-o", tmp_path / "c.stl").stderr
    assert "grid, the isosurface as it is" in grid


def test_a_saved_config_holds_surface_and_tolerance(tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text(resolve({"pattern": "zigzag", "surface": "prism", "tolerance": 0.01}).to_toml())
    assert (resolve({}, config).surface, resolve({}, config).tolerance) == ("prism", 0.01)
    assert resolve({"tolerance": 0.0}, config).tolerance == 0


@pytest.mark.slow
def test_missing_and_unwritable_folders_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one_line_error(run("make", "honeycomb", *SMALL, "-o", tmp_path / "no" / "a.stl"), "there is no folder")
    (tmp_path / "d.stl").mkdir()
    one_line_error(run("make", "honeycomb", *SMALL, "-o", tmp_path / "d.stl", "--force"), "is a folder")
    (tmp_path / "d.stl").rmdir()
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    one_line_error(run("make", "honeycomb", *SMALL, "-o", tmp_path / "a.stl"), "may not be written to")
    assert list(tmp_path.iterdir()) == []


def test_a_full_memory_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*args: Any, **options: Any) -> None:
        raise MemoryError

    monkeypatch.setattr(MakeSettings, "make", full)
    one_line_error(run("make", "honeycomb", "-o", tmp_path / "a.stl"), "out of memory; use larger cells")


@pytest.mark.slow
def test_a_broken_plugin_is_one_line_on_stderr(tmp_path: Path) -> None:
    """A real, broken distribution beside ours: the command works and names it once."""
    folder = tmp_path / "site" / "broken-1.0.dist-info"
    folder.mkdir(parents=True)
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: broken\nVersion: 1.0\n")
    (folder / "entry_points.txt").write_text("[infill.patterns]\nbroken = no_such_module:Pattern\n")
    done = subprocess.run(
        [*RUN, "list"],
        capture_output=True,
        encoding="utf-8",
        check=False,
        env={**os.environ, "PYTHONPATH": str(folder.parent)},
    )
    assert done.returncode == 0
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("warning: plug-in pattern 'broken' (no_such_module:Pattern)")
    assert "honeycomb" in done.stdout


@pytest.mark.parametrize("dry", [False, True])
@pytest.mark.parametrize("command", ["smooth", "fill", "refill", "motion", "verify", "check"])
def test_a_missing_input_is_told_before_an_output_that_exists(command: str, dry: bool, tmp_path: Path) -> None:
    old = tmp_path / "old.stl"
    old.write_bytes(b"old")
    written = ["-o", old, *(["--dry-run"] if dry else [])]
    output = {"verify": [old], "check": [], "motion": []}.get(command, written)
    done = run(command, tmp_path / "gone.stl", *output)
    assert done.exit_code == 1
    assert f"there is no file {tmp_path / 'gone.stl'}; check the name" in done.stderr
    assert "exists" not in done.stderr
    assert old.read_bytes() == b"old"


def test_options_of_other_programs_are_answered_with_options_that_exist() -> None:
    """Some command has each of the answers."""
    commands = typer.main.get_command(build_app()).commands.values()  # type: ignore[attr-defined]
    flags = [{flag for option in command.params for flag in option.opts} for command in commands]
    for typed, answers in OTHER_OPTIONS.items():
        assert all(any(answer.split()[0] in known for known in flags) for answer in answers), typed
