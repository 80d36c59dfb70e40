"""The post-processing script for Cura, between stand-ins for Cura's modules: what it hands over, and what goes wrong."""

from __future__ import annotations

import ast
import importlib.util
import json
import os
import re
import shlex
import sys
import time
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from slicers import missing_cura

from tests.gcode_judge import changed, judge
from tests.handmade_prints import Dialect, written
from tests.prints import box, cura_print

SCRIPT = Path(__file__).resolve().parents[1] / "examples" / "cura" / "InfillRefill.py"
PRINT = written(Dialect(slicer="cura", absolute=True, layers=5)).decode()
STAMP = "; refilled by phasefill"

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="the programs that are run are scripts of a POSIX shell"
)


class FakeScript:
    """As Cura's: settings have their defaults until they are set."""

    def __init__(self) -> None:
        self.given: dict[str, Any] = {}

    def getSettingValueByKey(self, key: str) -> Any:  # noqa: N802 - Cura's name
        settings = json.loads(self.getSettingDataString())["settings"]
        return self.given.get(key, settings[key]["default_value"])


@pytest.fixture
def messages() -> list[str]:
    """What is shown to the user."""
    return []


@pytest.fixture
def plugin(messages: list[str], monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script, loaded as Cura loads it: as a module of the plug-in's."""

    class FakeMessage:
        def __init__(self, text: str, lifetime: int = 30, title: str = "") -> None:
            self.text = text

        def show(self) -> None:
            messages.append(self.text)

    class FakeLogger:
        @staticmethod
        def log(kind: str, text: str, *words: object) -> None:
            assert text % words

    package = "PostProcessingPlugin"
    modules = {name: ModuleType(name) for name in ("UM", "UM.Logger", "UM.Message", package, f"{package}.Script")}
    modules["UM.Logger"].Logger = FakeLogger
    modules["UM.Message"].Message = FakeMessage
    modules[f"{package}.Script"].Script = FakeScript
    modules[package].__path__ = []
    modules[f"{package}.{package}"] = ModuleType(f"{package}.{package}")
    for name, module in modules.items():
        monkeypatch.setitem(sys.modules, name, module)
    spec = importlib.util.spec_from_file_location(f"{package}.{package}.InfillRefill", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """A folder with a blank in it, and the program there."""
    path = tmp_path / "my programs" / "infill"
    path.parent.mkdir()
    # With the path to our modules in the command, as the script takes PYTHONPATH away.
    root = shlex.quote(str(SCRIPT.parents[2]))
    path.write_text(f'#!/bin/sh\nPYTHONPATH={root} exec {shlex.quote(sys.executable)} -m infill.cli "$@"\n')
    path.chmod(0o755)
    return path


def scripted(folder: Path, lines: str) -> str:
    """Write a program, and return where it lies."""
    path = folder / "program"
    path.write_text(f"#!/bin/sh\n{lines}\n")
    path.chmod(0o755)
    return str(path)


def items_of(text: str) -> list[str]:
    """Return a print as Cura hands it on: header, start, a layer each, end."""
    head, *layers = text.split(";LAYER:")
    layers = [f";LAYER:{layer}" for layer in layers]
    header, found, start = head.partition(";Generated with")
    last, foot, end = layers[-1].rpartition(";TIME_ELAPSED:")
    line, newline, end = end.partition("\n")
    return [header, found + start, *layers[:-1], last + foot + line + newline, end]


def run(plugin: ModuleType, data: list[str], **given: Any) -> list[str]:
    script = plugin.InfillRefill()
    script.given = given
    return script.execute(data)


def assert_refilled(old: list[str], new: list[str]) -> None:
    """Lawful, and item by item what it was: only the header, which has the stamp, and layers are others."""
    assert judge("".join(old).encode(), "".join(new).encode(), filament=(0.85, 1.003)) == []
    assert changed("".join(old).encode(), "".join(new).encode())
    assert len(new) == len(old)
    assert STAMP in new[0]
    assert new[1] == old[1]
    assert re.sub(r"(?m)^M73 .*", "M73", new[-1]) == re.sub(
        r"(?m)^M73 .*", "M73", old[-1]
    )  # whose progress is told anew
    for before, after in zip(old[2:-1], new[2:-1], strict=True):
        assert before.splitlines()[0] == after.splitlines()[0]
        assert before.startswith(";LAYER:")


@pytest.mark.longest
def test_the_print_is_refilled(plugin: ModuleType, program: Path, messages: list[str]) -> None:
    data = items_of(PRINT)
    assert "".join(data) == PRINT
    kept = list(data)
    new = run(plugin, data, program=str(program))
    assert data == kept
    assert_refilled(data, new)
    assert messages == []
    assert run(plugin, new, program=str(program)) == new  # it is stamped


@pytest.mark.longest
@pytest.mark.skipif(bool(missing_cura()), reason=missing_cura())
def test_a_print_of_curas(plugin: ModuleType, program: Path, messages: list[str], tmp_path: Path) -> None:
    path = cura_print(box(tmp_path, (16, 16, 3)), tmp_path / "cura.gcode", {"infill_pattern": "gyroid"})
    data = items_of(path.read_bytes().decode())
    assert len(data) > 10
    assert_refilled(data, run(plugin, data, program=str(program)))
    assert messages == []


@pytest.mark.longest
def test_characters_and_line_ends_stay(plugin: ModuleType, program: Path) -> None:
    data = items_of(PRINT.replace("\n", "\r\n").replace(";FLAVOR", ";größe \udcff 🂡\r\n;FLAVOR"))
    new = run(plugin, data, program=str(program))
    assert len(new) == len(data)
    text = "".join(new)
    assert "größe \udcff 🂡\r\n" in text
    assert text.count("\n") == text.count("\r\n")


def test_items_that_are_not_curas_come_back_as_one(plugin: ModuleType) -> None:
    """Other scripts may have put them together, or have left none."""
    assert plugin.split_as("new", ["old"]) == ["new"]
    layered = ["head\n", "start\n", ";LAYER:0\na\n", ";LAYER:1\nb\n", "end\n"]
    text = "".join(layered).replace("a\n", "A\n")
    assert plugin.split_as(text, layered) == [*layered[:2], ";LAYER:0\nA\n", *layered[3:]]
    for other in (["".join(layered)], [*layered[:2], "".join(layered[2:])], layered[1:], layered[2:]):
        found = plugin.split_as(text, other)
        assert "".join(found) == text
        assert len(found) in (1, len(other))


def test_settings_become_options(plugin: ModuleType, messages: list[str], tmp_path: Path) -> None:
    told = tmp_path / "told"
    name = scripted(tmp_path, f'echo "$@" > {shlex.quote(str(told))}\necho \'{{"problems": []}}\'')
    data = items_of(PRINT)
    assert run(plugin, data, program=f'"{name}"', pattern="gyroid", density=" 20% ", smooth_radius=1.5) == data
    words, _, gcode = told.read_text().strip().rpartition(" ")
    assert words == "refill --json --quiet --pattern gyroid --density 20% --smooth-radius 1.5"
    assert not Path(gcode).parent.exists()
    run(plugin, data, program=name)
    words, _, gcode = told.read_text().strip().rpartition(" ")
    assert words == "refill --json --quiet --pattern keep --smooth-radius auto"
    assert messages == []


def test_problems_are_shown(plugin: ModuleType, messages: list[str], tmp_path: Path) -> None:
    name = scripted(tmp_path, """echo '{"problems": ["there is no sparse infill in this print"]}'""")
    data = items_of(PRINT)
    assert run(plugin, data, program=name) == data
    assert messages == ["there is no sparse infill in this print"]


FAILING = {
    "an error": ("echo 'error: the disk is full' >&2; exit 1", "error: the disk is full"),
    "no word": ("exit 3", "the program ended with code 3 and said nothing"),
    "killed": ("kill -9 $$", "the program ended with code -9 and said nothing"),
    "no report": ("echo hello", "Expecting value"),
    "the file gone": ('for last; do :; done; rm "$last"; echo \'{"problems": []}\'', "No such file"),
}


@pytest.mark.parametrize("name", FAILING)
def test_a_program_that_fails_leaves_the_print_and_says_why(
    name: str, plugin: ModuleType, messages: list[str], tmp_path: Path
) -> None:
    lines, says = FAILING[name]
    data = items_of(PRINT)
    assert run(plugin, data, program=scripted(tmp_path, lines)) is data
    (message,) = messages
    assert message.startswith("The infill stays as Cura sliced it: ")
    assert says in message


@pytest.mark.slow
def test_an_error_of_the_program_itself(plugin: ModuleType, program: Path, messages: list[str]) -> None:
    data = items_of(PRINT)
    assert run(plugin, data, program=str(program), smooth_radius="wide") is data
    assert "--smooth-radius is 'wide'; give auto, or a number in mm" in messages[0]


def test_a_missing_program(plugin: ModuleType, messages: list[str]) -> None:
    data = items_of(PRINT)
    assert run(plugin, data, program="/nowhere/infill") is data
    assert messages == [
        "The infill stays as Cura sliced it: there is no program '/nowhere/infill'; "
        "install it with pip install phasefill, and give its whole path"
    ]


def test_a_program_that_hangs_is_stopped(plugin: ModuleType, messages: list[str], tmp_path: Path) -> None:
    """Also where a program that it started lives on."""
    name = scripted(tmp_path, f"echo $$ > {shlex.quote(str(tmp_path / 'number'))}\nsleep 20 &\nwait")
    data = items_of(PRINT)
    begin = time.monotonic()
    assert run(plugin, data, program=name, seconds=1) is data
    assert time.monotonic() - begin < 15  # a busy machine is slow to start a shell
    assert "the program took longer than 1 s; allow it more time" in messages[0]
    with pytest.raises(ProcessLookupError):
        os.kill(int((tmp_path / "number").read_text()), 0)


def test_the_environment_of_a_packed_program_stays_outside(
    plugin: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    told = tmp_path / "told"
    monkeypatch.setenv("PYTHONHOME", "/tmp/.mount_Cura")
    monkeypatch.setenv("LD_LIBRARY_PATH", "/tmp/.mount_Cura/lib")
    monkeypatch.setenv("LANG", "C.UTF-8")
    run(plugin, items_of(PRINT), program=scripted(tmp_path, f"env > {shlex.quote(str(told))}; exit 1"))
    names = {line.partition("=")[0] for line in told.read_text().splitlines()}
    assert "LANG" in names
    assert not {"PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH"} & names


def test_the_python_of_older_versions_of_cura_reads_it() -> None:
    tree = ast.parse(SCRIPT.read_text(encoding="utf-8"), feature_version=(3, 7))
    imported = {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    imported |= {name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names}
    others = {name for name in imported if name.partition(".")[0] not in sys.stdlib_module_names}
    assert others == {"UM.Logger", "UM.Message", "Script"}
