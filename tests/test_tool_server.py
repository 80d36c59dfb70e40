"""The tools for assistants, called by the SDK's own client over stdin and stdout.

Laws first: nothing outside the folders is read or written, nothing is overwritten unless asked, an error is one clear
message and the server lives, and every option of a command is an option of its tool.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from handmade_prints import Dialect, written

from infill import InfillError, check
from infill.options.declaration import declared_options
from infill.tool_server.folders import AllowedFolders
from infill.tool_server.tools import TOOLS, write_words

pytest.importorskip("mcp")

import anyio
from tool_client import ToolClient, run_client

PRINT = written(Dialect(layers=4))


def fill_folder(folder: Path) -> None:
    """Put a part, a scan and a print into a folder."""
    trimesh.creation.box((12.0, 12.0, 12.0)).export(folder / "box.stl")
    distance = np.sqrt(((np.indices((20, 20, 20)) - 9.5) ** 2).sum(axis=0))
    np.save(folder / "ball.npy", (distance < 7).astype(np.uint8))
    (folder / "print.gcode").write_bytes(PRINT)


@pytest.fixture(scope="module")
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("outside")
    fill_folder(folder)
    return folder


@pytest.fixture(scope="module")
def inside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("inside")
    fill_folder(folder)
    return folder


@pytest.fixture(scope="module")
def assistant(inside: Path) -> Iterator[ToolClient]:
    with run_client(inside.parent, "--folder", str(inside)) as client:
        yield client


@pytest.fixture
def folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> AllowedFolders:
    """Two folders; the server runs in the first."""
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        fill_folder(tmp_path / name)
    monkeypatch.chdir(tmp_path / "first")
    return AllowedFolders.of([Path(), tmp_path / "second"])


def words_of(folders: AllowedFolders, tool: str, **arguments: Any) -> list[str]:
    return write_words(tool, TOOLS[tool], arguments, folders, Path("picture.png"))


def refusal(folders: AllowedFolders, tool: str, **arguments: Any) -> str:
    with pytest.raises(InfillError) as caught:
        words_of(folders, tool, **arguments)
    text = caught.value.spell(lambda name: name)
    assert "\n" not in text
    return text


# --- schemas follow from the declarations ---------------------------------------------------------------


@pytest.mark.parametrize("name", TOOLS)
def test_every_option_of_a_command_is_an_option_of_its_tool(name: str) -> None:
    from jsonschema import Draft202012Validator

    tool = TOOLS[name]
    schema = tool.schema()
    Draft202012Validator.check_schema(schema)
    declared = {} if tool.declaration is None else declared_options(tool.declaration)
    assert set(schema["properties"]) == {*tool.arguments, *declared}
    assert not tool.arguments.keys() & declared.keys()
    for described in schema["properties"].values():
        assert described["description"]
        assert "--" not in described["description"].replace("--set", "")
        assert "module.py" not in described["description"]
    for key, entry in declared.items():
        values = schema["properties"][key]
        assert values.get("enum", values.get("items", {}).get("enum", [])) == list(entry.choices)


def test_options_become_words_of_the_command(folders: AllowedFolders) -> None:
    root = folders.roots[0]
    words = words_of(
        folders,
        "fill",
        part="box.stl",
        output="new.stl",
        density="15%:30%",
        drain_at=["1,2,3"],
        ties=False,
        phase=[0, -1, 2],
        parameters={"cell": 5},
        overwrite=True,
        picture=False,
        wall=None,
    )
    assert words[:2] == ["fill", "--json"]
    assert words[-2:] == ["--", str(root / "box.stl")]
    line = " ".join(words)
    for piece in ("--density 15%:30%", "--drain-at 1,2,3", "--no-ties", "--phase 0 -1 2", "--set cell=5", "--force"):
        assert piece in line
    assert f"-o {root / 'new.stl'}" in line
    assert "--preview" not in words
    assert "--wall" not in words


# --- folders -------------------------------------------------------------------------------------------


def test_names_are_resolved_in_the_folders(folders: AllowedFolders) -> None:
    first, second = folders.roots
    (second / "other.stl").write_bytes((second / "box.stl").read_bytes())
    assert folders.find_input("part", "box.stl") == str(first / "box.stl")
    assert folders.find_input("part", "other.stl") == str(second / "other.stl")
    assert folders.find_input("part", str(second / "box.stl")) == str(second / "box.stl")
    assert folders.find_output("output", "new.stl") == str(first / "new.stl")
    assert folders.find_output("output", str(second / "{label}.stl")) == str(second / "{label}.stl")
    (first / "scan.h5").write_bytes(b"")
    assert folders.find_input("source", "scan.h5:/volume") == f"{first / 'scan.h5'}:/volume"


OUTSIDE = ("../outside/box.stl", "{outside}/box.stl", "link.stl", "linked/box.stl", "~/box.stl", "series", "head.mhd")


@pytest.fixture
def links(folders: AllowedFolders, outside: Path) -> Path:
    """Links out of a folder: a file, a folder, one in a folder of slices, and the values of a volume."""
    first = folders.roots[0]
    try:
        (first / "link.stl").symlink_to(outside / "box.stl")
    except OSError:  # Windows without the right to make links
        pytest.skip("no links here")
    (first / "linked").symlink_to(outside)
    (first / "series").mkdir()
    (first / "series" / "1.dcm").symlink_to(outside / "ball.npy")
    (first / "head.mhd").write_text(f"ObjectType = Image\nElementDataFile = {outside / 'ball.npy'}\n")
    return first


@pytest.mark.parametrize("name", OUTSIDE)
def test_what_lies_outside_is_refused(name: str, folders: AllowedFolders, links: Path, outside: Path) -> None:
    text = refusal(folders, "smooth", source=name.format(outside=outside), output="new.stl")
    assert "outside of" in text
    assert str(folders.roots[0]) in text
    if name not in ("series", "head.mhd"):
        assert "out" in refusal(folders, "fill", part="box.stl", output=name.format(outside=outside))


@pytest.mark.parametrize(
    ("tool", "arguments"),
    {
        "a field": ("fill", {"part": "box.stl", "by": "{outside}/ball.npy"}),
        "a modifier": ("fill", {"part": "box.stl", "region": ["{outside}/box.stl:density=40%"]}),
        "code in a region": ("fill", {"part": "box.stl", "region": ["z=1..2:pattern=mine.py:waves"]}),
        "code": ("fill", {"part": "box.stl", "pattern": "mine.py:waves"}),
        "code of a block": ("make", {"pattern": "mine.py:waves"}),
        "code of refill": ("refill", {"print": "print.gcode", "pattern": "mine.py:waves"}),
        "code of the list": ("list", {"pattern": "mine.py:waves"}),
        "a drawing": ("refill", {"print": "print.gcode", "pattern": "{outside}/tile.svg"}),
        "a table": ("smooth", {"source": "ball.npy", "labels": "{outside}/labels.txt"}),
        "a printer": ("motion", {"print": "print.gcode", "printer": "{outside}/printer.cfg"}),
        "an address": ("smooth", {"source": "https://example.org/scan.zarr"}),
        "a folder of another": ("fill", {"part": "box.stl", "output": "{{folder}}/new.stl"}),
    }.items(),
    ids=lambda case: case if isinstance(case, str) else "",
)
def test_options_name_no_file_outside_and_no_code(
    tool: str, arguments: Any, folders: AllowedFolders, outside: Path
) -> None:
    tool, values = arguments
    (outside / "tile.svg").write_text("<svg/>")

    def filled(value: Any) -> Any:
        return [filled(item) for item in value] if isinstance(value, list) else value.format(outside=outside)

    given = {key: filled(value) for key, value in values.items()}
    if TOOLS[tool].writes:
        given.setdefault("output", "new.stl")
    assert refusal(folders, tool, **given)


def test_options_name_files_inside(folders: AllowedFolders) -> None:
    second = folders.roots[1]
    (second / "printer.cfg").write_text("[printer]\n")
    assert str(second / "printer.cfg") in words_of(folders, "motion", print="print.gcode", printer="printer.cfg")
    words = words_of(
        folders, "fill", part="box.stl", output="a.stl", region=[f"{second / 'box.stl'}:density=40%"], by="skin"
    )
    assert f"{second / 'box.stl'}:density=40%" in words


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"output": "a.stl"}, "part is missing"),
        ({"part": "box.stl"}, "output is missing; .* dry_run=true"),
        ({"part": 5, "output": "a.stl"}, "part is 5; give the name of a file"),
        ({"part": "none.stl", "output": "a.stl"}, "there is no file 'none.stl'"),
        ({"part": "box.stl", "output": "none/a.stl"}, "there is no folder"),
        ({"part": "box.stl", "output": "a.stl", "densty": 2}, "fill has no option 'densty'; did you mean 'density'"),
        ({"part": "box.stl", "output": "a.stl", "density": "-5%"}, "density is '-5%'"),
        ({"part": "box.stl", "output": "a.stl", "overwrite": "yes"}, "overwrite is 'yes'; it must be true or false"),
        ({"part": "box.stl", "output": "a.stl", "parameters": [1]}, "parameters is .*; give names and values"),
    ],
)
def test_bad_input_is_told_in_the_words_of_the_tool(
    arguments: dict[str, Any], says: str, folders: AllowedFolders
) -> None:
    import re

    assert re.search(says, refusal(folders, "fill", **arguments))


# --- a real client --------------------------------------------------------------------------------------


@pytest.mark.longest
def test_the_client_lists_the_tools(assistant: ToolClient, inside: Path) -> None:
    tools = assistant.tools()
    assert list(tools) == ["list", "make", "fill", "smooth", "refill", "motion", "verify", "check"]
    for name, tool in tools.items():
        assert tool.input_schema == TOOLS[name].schema()
        assert tool.annotations.read_only_hint == (not TOOLS[name].writes)
    assert str(inside) in assistant.client.instructions


@pytest.mark.longest
def test_each_tool_is_called_once(assistant: ToolClient, inside: Path) -> None:
    listed = assistant.call("list").report
    assert "honeycomb" in listed["patterns"]
    one = assistant.call("list", pattern="honeycomb", picture=True)
    assert list(one.report["patterns"]) == ["honeycomb"]
    assert min(one.picture.size) > 100

    block = assistant.call("make", pattern="honeycomb", output="block.stl", size="12x12", height=2)
    assert block.report["closed"]
    assert block.report["files"] == [str(inside / "block.stl")]
    assert check(inside / "block.stl").printable
    assert min(block.picture.size) > 100

    filled = assistant.call("fill", part="box.stl", output="filled.stl", density="25%", resolution=40, picture=False)
    assert filled.report["density"] == pytest.approx(0.25, abs=0.02)
    assert check(inside / "filled.stl").closed
    assert [share for share, _ in filled.progress] == sorted({share for share, _ in filled.progress})
    assert len(filled.progress) >= 2
    assert filled.texts[0].startswith(str(inside / "box.stl"))
    assert json.loads(filled.texts[1]) == filled.report

    ball = assistant.call("smooth", source="ball.npy", output="ball.stl", label=[1])
    assert ball.report["closed"]
    assert check(inside / "ball.stl").printable

    refilled = assistant.call("refill", print="print.gcode", output="refilled.gcode", picture=False)
    assert refilled.report["sections"]["replaced"] > 0
    assert (inside / "print.gcode").read_bytes() == PRINT
    times = assistant.call("motion", print="print.gcode", other="refilled.gcode").report["files"]
    assert times[1]["seconds"] < times[0]["seconds"]
    same = assistant.call("verify", before="print.gcode", after="refilled.gcode")
    assert same.report["agrees"]
    (inside / "moved.gcode").write_bytes(PRINT.replace(b"G1 X", b"G1 X1", 1))
    moved = assistant.call("verify", before="print.gcode", after="moved.gcode").report
    assert not moved["agrees"]
    assert moved["count"] > 0

    verdicts = assistant.call("check", files=["box.stl", "print.gcode", "ball.npy"]).report["files"]
    assert verdicts[0]["printable"]
    assert verdicts[1]["layers"] == 4
    assert "error" in verdicts[2]


@pytest.mark.longest
def test_an_error_is_one_message_and_the_server_lives(assistant: ToolClient, inside: Path, outside: Path) -> None:
    before = (inside / "box.stl").read_bytes()
    assert "outside of" in assistant.call("check", files=[str(outside / "box.stl")]).error
    assert "box.stl exists; give another name, or overwrite=true to overwrite it" in (
        assistant.call("fill", part="box.stl", output="box.stl").error
    )
    assert "output is missing" in assistant.call("refill", print="print.gcode").error
    assert assistant.call("fill", part="box.stl", output="new.stl", line_width=-1).error.startswith("line_width is -1")
    assert "choose from list" in assistant.call("nothing").error
    assert assistant.call("check", files=["ball.npy"]).error
    assert (inside / "box.stl").read_bytes() == before
    assert not (inside / "new.stl").exists()
    assert assistant.call("check", files=["box.stl"]).report["printable"]


@pytest.mark.longest
@pytest.mark.parametrize("mode", ["auto", "legacy"])
def test_a_cancelled_call_ends_its_command(mode: str, tmp_path: Path) -> None:
    fill_folder(tmp_path)
    files = {path.name for path in tmp_path.iterdir()}
    arguments = {"part": "box.stl", "output": "large.stl", "resolution": 400, "picture": False}
    with run_client(tmp_path, mode=mode) as client:

        async def call_and_cancel() -> bool:
            with anyio.move_on_after(4) as scope:
                await client.acall("fill", arguments)
            return scope.cancelled_caught

        assert client.portal.call(call_and_cancel)
        begun = time.monotonic()
        assert client.call("check", files=["box.stl"]).report["printable"]
        assert time.monotonic() - begun < 60
        assert {path.name for path in tmp_path.iterdir()} == files


@pytest.mark.longest
def test_nothing_but_the_protocol_goes_to_stdout(tmp_path: Path) -> None:
    """Whatever is asked, and however it ends; the server ends with its client."""
    fill_folder(tmp_path)
    hello = {
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "test", "version": "1"},
    }
    messages = [
        {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": hello},
        {"jsonrpc": "2.0", "method": "notifications/initialized"},
        {"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": {"name": "check", "arguments": {}}},
    ]
    text = "".join(json.dumps(message) + "\n" for message in messages)
    command = [sys.executable, "-m", "infill.cli", "mcp"]
    with subprocess.Popen(
        command, cwd=tmp_path, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None
        server.stdin.write(text + "no json\n")
        server.stdin.flush()
        answers = [json.loads(server.stdout.readline()) for _ in range(2)]
        rest, _ = server.communicate(timeout=60)
    assert {answer.get("id") for answer in answers} <= {1, 2, None}
    assert all(json.loads(line)["jsonrpc"] == "2.0" for line in rest.splitlines())
    assert server.returncode == 0


@pytest.mark.longest
def test_a_module_in_the_folder_is_not_imported(tmp_path: Path) -> None:
    from infill.tool_server.command_runs import run_command

    (tmp_path / "numpy.py").write_text("raise SystemExit('imported')\n")
    trimesh.creation.box((2.0, 2.0, 2.0)).export(tmp_path / "box.stl")

    async def silent(share: float, stage: str) -> None: ...

    outcome = anyio.run(run_command, ["check", "--json", str(tmp_path / "box.stl")], tmp_path, silent)
    assert outcome.status == 0
    assert outcome.report["printable"]


@pytest.mark.longest
def test_progress_as_lines(tmp_path: Path) -> None:
    """For whoever runs a command: one line for each stage and hundredth, and none unless asked for."""
    for environment, lines in (({}, 0), ({"INFILL_PROGRESS": "lines"}, 2)):
        words = ["make", "honeycomb", "--size", "20", "--height", "1", "-o", "a.stl", "--force"]
        done = subprocess.run(
            [sys.executable, "-m", "infill.cli", *words],
            cwd=tmp_path,
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0
        assert done.stdout == ""
        assert sum(line.startswith("progress: 0.") for line in done.stderr.splitlines()) >= lines
        assert ("progress:" in done.stderr) == bool(environment)


def test_a_folder_that_is_none_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from test_command_line import refused, run

    monkeypatch.chdir(tmp_path)
    refused(run("mcp", "--folder", "none"), "--folder is 'none', which is not a folder")


def test_without_the_package_the_command_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    from test_command_line import refused, run

    with contextlib.suppress(KeyError):
        monkeypatch.delitem(sys.modules, "infill.tool_server.server")
    for name in ("mcp", "mcp.server"):
        monkeypatch.setitem(sys.modules, name, None)
    refused(run("mcp"), r"pip install 'phasefill\[mcp\]'")
