"""Options in a file run no code and read nothing from elsewhere, unless that is typed or the file is trusted."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import IN_SPACE
from test_command_line import one_line_error, run

from infill import FormatError
from infill.lattices.settings import resolve as resolve_fill
from infill.options.trust import check_trusted
from infill.refilling.settings import resolve as resolve_refill
from infill.smoothing.settings import resolve as resolve_smooth

CODE = """
from pathlib import Path
Path("RAN").touch()
import numpy as np
def f(x, y=None, z=None):
    return x[:, 0] if y is None else np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z)
"""
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"><path d="M0 4.5H9"/></svg>'
SAYS = {
    "pattern": 'pattern = "evil.py:f"\n',
    "by": 'density = "10%:20%"\nby = "evil.py:f"\n',
    "dashes": '"by" = "./evil.py:f"\ndensity = "10%:20%"\n',
    "a list": 'pattern = ["evil.py:f"]\n',
    "the table": '[set]\nanything = "evil.py:f"\n',
    "another folder": 'pattern = "in/../evil.py:f"\n',
}
ELSEWHERE = [
    "/etc/hidden.svg",
    "../hidden.svg",
    "in/../../hidden.svg",
    "//server/share/a.svg",
    r"\\server\share\a.svg",
    "C:/hidden.svg",
    r"c:\hidden.svg",
    "~/hidden.svg",
    "linked/hidden.svg",
]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A part, code beside it, a drawing here and one elsewhere, and a folder that leads there."""
    here = tmp_path / "here"
    here.mkdir()
    (here / "in").mkdir()
    monkeypatch.chdir(here)
    trimesh.creation.box((20, 20, 12)).export("part.stl")
    Path("evil.py").write_text(CODE)
    for path in (here / "in" / "a.svg", tmp_path / "hidden.svg"):
        path.write_text(SVG)
    (here / "linked").symlink_to(tmp_path)
    return here


def attached(text: str) -> str:
    """Write options as a project has them, and return its name."""
    with zipfile.ZipFile("theirs.3mf", "w") as package:
        package.writestr("Metadata/phasefill.toml", text)
    return "theirs.3mf"


def plain(text: str) -> str:
    Path("theirs.toml").write_text(text)
    return "theirs.toml"


@pytest.mark.long
@pytest.mark.parametrize("write", [attached, plain])
@pytest.mark.parametrize("where", SAYS)
@pytest.mark.parametrize("words", [["-o", "a.stl"], ["--dry-run"], ["--save-config", "-"]])
def test_code_that_only_a_file_names_is_not_run(write: object, where: str, words: list[str]) -> None:
    config = write(SAYS[where])  # type: ignore[operator]
    one_line_error(
        run("fill", "part.stl", "--config", config, *words), rf"^error: {config} asks to run code: .*evil.py:f"
    )
    assert not Path("RAN").exists()
    assert not Path("a.stl").exists()


@pytest.mark.slow
@pytest.mark.parametrize("write", [attached, plain])
def test_code_is_run_if_it_is_typed_or_the_file_is_trusted(write: object) -> None:
    config = write(SAYS["pattern"])  # type: ignore[operator]
    words = ["fill", "part.stl", "--config", config, "--save-config", "-"]
    assert run(*words, "--pattern", "gyroid").exit_code == 0
    assert not Path("RAN").exists()
    for more in (["--trust"], ["--pattern", "evil.py:f"]):
        assert run(*words, *more).exit_code == 0
        Path("RAN").unlink()


@pytest.mark.slow
@pytest.mark.parametrize("words", [["make"], ["smooth", "part.stl"], ["refill", "part.gcode"]])
def test_other_commands_run_no_code_at_all(words: list[str]) -> None:
    Path("part.gcode").write_text("G1 X0 Y0\n")
    for text in SAYS.values():
        result = run(*words, "--config", plain(text), "-o", "a.stl")
        assert result.exit_code in (1, 2)
        assert "Traceback" not in result.stderr
    assert not Path("RAN").exists()


@pytest.mark.parametrize("text", ELSEWHERE)
def test_files_from_elsewhere_are_not_read(text: str) -> None:
    for resolve, name in (
        (resolve_fill, "pattern"),
        (resolve_fill, "by"),
        (resolve_refill, "pattern"),
        (resolve_smooth, "labels"),
    ):
        config = Path(plain(f"{name} = '{text}'\n"))
        with pytest.raises(FormatError, match=rf"theirs.toml asks to read a file from elsewhere: {name} = ") as told:
            resolve({}, config=config)
        assert str(told.value).isprintable()


@pytest.mark.parametrize("text", ["in/a.svg", "./in/a.svg", "in/../in/a.svg"])
def test_files_beside_it_are_read(text: str, folder: Path) -> None:
    for name in (text, str(folder / text)):
        assert resolve_fill({}, config=Path(plain(f"pattern = '{name}'\n"))).request.pattern == name
    assert resolve_smooth({}, config=Path(plain("labels = 'in/a.txt'\n"))).labels == Path("in/a.txt")


def test_a_trusted_file_may_name_files_from_elsewhere(tmp_path: Path) -> None:
    config = Path(plain(f"pattern = '{tmp_path / 'hidden.svg'}'\n"))
    assert resolve_fill({}, config=config, trust=True).request.pattern == str(tmp_path / "hidden.svg")
    typed = {"pattern": "gyroid"}
    assert resolve_fill(typed, config=config).request.pattern == "gyroid"


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(st.text(max_size=20), st.sampled_from(["pattern", "by", "labels"]))
def test_whatever_is_named_is_told_on_one_line(text: str, name: str) -> None:
    told = ""
    try:
        check_trusted({name: text}, Path("theirs.toml"))
    except FormatError as error:
        told = str(error)
    assert told.isprintable()
    assert (".py:" in text) <= bool(told)


def test_names_of_patterns_are_no_files() -> None:
    """Whatever `infill list` shows, plug-ins included, may be named by a file."""
    from patterns import PATTERNS

    for name in (*PATTERNS, *IN_SPACE, "x", "skin", "keep"):
        check_trusted({"pattern": name, "by": name}, Path("/somewhere/else/theirs.toml"))
