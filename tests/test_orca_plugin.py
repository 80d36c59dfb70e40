"""The plug-in for OrcaSlicer, between stand-ins with the names of its contract: the print is refilled, or stays as it was."""

from __future__ import annotations

import ast
import enum
import json
import re
import shlex
import stat
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from tests.gcode_judge import changed, judge
from tests.handmade_prints import Dialect, written

FILE = Path(__file__).resolve().parents[1] / "examples" / "orcaslicer" / "infill_refill.py"
PRINT = written(Dialect(slicer="orca", layers=5))
PROGRAM = Path(sys.executable).with_name("infill")
NOTHING = '{"product": "refill", "problems": [], "print": {}, "sections": {"all": 3, "replaced": 2}, "time": {}, "filament": {}}'
PROBLEM = NOTHING.replace("[]", '["no sparse infill"]')

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="the programs that are run are scripts of a POSIX shell"
)


class Step(enum.Enum):
    posInfill = enum.auto()  # noqa: N815 - OrcaSlicer's names
    psGCodePostProcess = enum.auto()  # noqa: N815


class PluginResult(enum.Enum):
    Success = enum.auto()
    Skipped = enum.auto()
    RecoverableError = enum.auto()
    FatalError = enum.auto()


@dataclass
class ExecutionResult:
    status: PluginResult
    message: str = ""
    data: str = ""

    @classmethod
    def success(cls, message: str = "", data: str = "") -> ExecutionResult:
        return cls(PluginResult.Success, message, data)

    @classmethod
    def skipped(cls, message: str = "") -> ExecutionResult:
        return cls(PluginResult.Skipped, message)

    @classmethod
    def failure(cls, status: PluginResult, message: str = "", data: str = "") -> ExecutionResult:
        return cls(status, message, data)


class FakeCapability:
    """With the configuration as a JSON text, which is {} until something is saved."""

    def __init__(self) -> None:
        self.saved: dict[str, Any] = {}

    def get_config(self) -> str:
        return json.dumps(self.saved)


@dataclass
class Loaded:
    """The plug-in as OrcaSlicer has it: its module, and its capabilities by name."""

    module: ModuleType
    capabilities: dict[str, Any]

    def post_process(self, path: Path, step: Step = Step.psGCodePostProcess, **saved: Any) -> ExecutionResult:
        capability = self.capabilities["Refill the infill"]
        capability.saved = saved
        # At this step there is neither a print nor an object.
        return capability.execute(
            SimpleNamespace(
                orca_version="2.5.0",
                step=step,
                gcode_path=str(path),
                host="File",
                output_name="box.gcode",
                print=None,
                object=None,
            )
        )


@pytest.fixture
def plugin(monkeypatch: pytest.MonkeyPatch) -> Loaded:
    orca = ModuleType("orca")
    packages: list[type] = []
    registered: list[type] = []
    for name, value in {
        "ExecutionResult": ExecutionResult,
        "PluginResult": PluginResult,
        "base": type("base", (), {}),
        "plugin": lambda cls: packages.append(cls) or cls,
        "register_capability": registered.append,
        "slicing": SimpleNamespace(Step=Step, SlicingPipelineCapabilityBase=type("Slicing", (FakeCapability,), {})),
        "script": SimpleNamespace(ScriptPluginCapabilityBase=type("Script", (FakeCapability,), {})),
    }.items():
        setattr(orca, name, value)
    monkeypatch.setitem(sys.modules, "orca", orca)
    module = ModuleType("infill_refill")
    exec(compile(FILE.read_text(encoding="utf-8"), str(FILE), "exec"), module.__dict__)
    (package,) = packages
    package().register_capabilities()
    capabilities = [each() for each in registered]
    assert all(";" not in each.get_name() for each in capabilities)
    return Loaded(module, {each.get_name(): each for each in capabilities})


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty home and an empty PATH, as of a program started from a dock."""
    folder = tmp_path / "my home"
    folder.mkdir()
    monkeypatch.setenv("HOME", str(folder))
    monkeypatch.setenv("PATH", str(tmp_path / "empty"))
    for name in ("PIPX_BIN_DIR", "UV_TOOL_BIN_DIR"):
        monkeypatch.delenv(name, raising=False)
    return folder


@pytest.fixture
def gcode(tmp_path: Path) -> Path:
    """The copy that OrcaSlicer hands on, alone in a folder."""
    path = tmp_path / "slicer's files" / "box.gcode.pp"
    path.parent.mkdir()
    path.write_bytes(PRINT)
    path.chmod(0o640)
    return path


def scripted(path: Path, lines: str) -> str:
    """Write a program, and return where it lies."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\nPATH=/usr/bin:/bin\n{lines}\n")
    path.chmod(0o755)
    return str(path)


def real(path: Path) -> str:
    """Write the program itself, and return where it lies."""
    root = shlex.quote(str(FILE.parents[2]))
    return scripted(path, f'PYTHONPATH={root} exec {shlex.quote(sys.executable)} -m infill.cli "$@"')


def assert_untouched(gcode: Path) -> None:
    """Not a byte of the print has changed, and nothing lies beside it."""
    assert gcode.read_bytes() == PRINT
    assert list(gcode.parent.iterdir()) == [gcode]


@pytest.mark.longest
def test_the_print_is_refilled(plugin: Loaded, home: Path, gcode: Path) -> None:
    """By an infill where pipx puts it, off the PATH; and once only."""
    real(home / ".local" / "bin" / "infill")
    result = plugin.post_process(gcode, verify=True)
    assert result.status is PluginResult.Success, result.message
    assert result.message.startswith("3 of 3 sections of infill, 0.6 min instead of 0.7 (-4.8%), filament -0.1%")
    new = gcode.read_bytes()
    assert judge(PRINT, new, filament=(0.85, 1.003)) == []
    assert changed(PRINT, new)
    assert list(gcode.parent.iterdir()) == [gcode]
    assert stat.S_IMODE(gcode.stat().st_mode) == 0o640
    shown = plugin.capabilities["What was refilled last"].execute()
    assert shown.message == f"box.gcode: {result.message}"

    again = plugin.post_process(gcode)
    assert (again.status, again.message) == (
        PluginResult.Success,
        "the print was refilled before, and stays as it is",
    )
    assert gcode.read_bytes() == new


@pytest.mark.longest
@pytest.mark.skipif(not PROGRAM.exists(), reason="the command is not beside Python here")
def test_a_large_print_is_refilled_by_the_installed_command(
    plugin: Loaded, home: Path, gcode: Path, real_print: Path
) -> None:
    """Compared with what was sliced; the plug-in finds the command where pipx puts it."""
    sliced = real_print.read_bytes()
    gcode.write_bytes(sliced)
    (home / ".local" / "bin").mkdir(parents=True)
    (home / ".local" / "bin" / "infill").symlink_to(PROGRAM)
    result = plugin.post_process(gcode, verify=True)
    assert result.status is PluginResult.Success, result.message
    replaced, all_sections = re.match(r"(\d+) of (\d+) sections of infill", result.message).groups()
    assert int(replaced) > 0.8 * int(all_sections) > 5
    assert b"; refilled by phasefill" in gcode.read_bytes() != sliced
    assert list(gcode.parent.iterdir()) == [gcode]


@pytest.mark.slow
def test_an_error_of_the_program_itself(plugin: Loaded, home: Path, gcode: Path) -> None:
    result = plugin.post_process(gcode, program=real(home / "programs" / "infill"), smooth_radius="wide")
    assert result.status is PluginResult.Skipped
    assert "--smooth-radius is 'wide'; give auto, or a number in mm" in result.message
    assert_untouched(gcode)


def test_other_steps_do_nothing(plugin: Loaded, home: Path, gcode: Path) -> None:
    assert plugin.post_process(gcode, step=Step.posInfill) == ExecutionResult.success()
    assert_untouched(gcode)


def test_a_missing_program(plugin: Loaded, home: Path, gcode: Path) -> None:
    result = plugin.post_process(gcode)
    assert result.status is PluginResult.Skipped
    assert result.message == (
        "the infill stays as OrcaSlicer sliced it: infill is not installed: pipx install phasefill, "
        "or give its whole path as the program"
    )
    assert_untouched(gcode)
    result = plugin.post_process(gcode, program="/nowhere/infill", stop_on_failure=True)
    assert result.status is PluginResult.RecoverableError
    assert "there is no program '/nowhere/infill'" in result.message
    assert_untouched(gcode)


WRITES = 'cp sliced.gcode refilled.gcode; echo "; new" >> refilled.gcode'
FAILING = {
    "an error": ("echo 'error: the disk is full' >&2; exit 1", "error: the disk is full"),
    "an error after writing": (f"{WRITES}; echo 'error: late' >&2; exit 1", "error: late"),
    "no word": ("exit 3", "the program ended with code 3 and said nothing"),
    "killed": ("kill -9 $$", "the program ended with code -9 and said nothing"),
    "no report": (f"{WRITES}; echo hello", "it wrote no report"),
    "another report": (f"{WRITES}; echo '{{}}'", "it wrote no report"),
    "half a report": (f'{WRITES}; echo \'{{"product": "refill"}}\'', "problems"),
    "problems": (f"{WRITES}; echo '{PROBLEM}'", "no sparse infill"),
    "no print": (f"echo '{NOTHING}'", "refilled.gcode"),
    "an empty print": (f": > refilled.gcode; echo '{NOTHING}'", "an empty print"),
    "the print of the folder gone": (f"rm sliced.gcode; echo '{NOTHING}'", "sliced.gcode"),
    "not verified": (
        f"test \"$1\" = refill || {{ echo 'a wall is missing'; echo more; exit 1; }}; {WRITES}; echo '{NOTHING}'",
        "a wall is missing",
    ),
}


@pytest.mark.parametrize("stop", [False, True])
@pytest.mark.parametrize("name", FAILING)
def test_a_failure_leaves_the_print(name: str, stop: bool, plugin: Loaded, home: Path, gcode: Path) -> None:
    """And says why; the export goes on, unless the settings stop it."""
    lines, says = FAILING[name]
    program = scripted(home / "infill", lines)
    result = plugin.post_process(gcode, program=program, verify=True, stop_on_failure=stop)
    assert result.status is (PluginResult.RecoverableError if stop else PluginResult.Skipped)
    assert result.message.startswith("the infill stays as OrcaSlicer sliced it: ")
    assert says in result.message
    assert_untouched(gcode)


def test_a_program_that_hangs_is_stopped(plugin: Loaded, home: Path, gcode: Path) -> None:
    result = plugin.post_process(gcode, program=scripted(home / "infill", "exec sleep 20"), seconds=0.5)
    assert "the program took longer than 0.5 s" in result.message
    assert_untouched(gcode)


@pytest.mark.parametrize(
    "saved", [{"seconds": "soon"}, {"options": "--set 'open"}, {"smooth_radius": None, "seconds": []}]
)
def test_settings_that_cannot_be_read(saved: dict[str, Any], plugin: Loaded, home: Path, gcode: Path) -> None:
    result = plugin.post_process(gcode, program=scripted(home / "infill", "exit 1"), **saved)
    assert result.status is PluginResult.Skipped
    assert_untouched(gcode)


def test_settings_become_options(plugin: Loaded, home: Path, gcode: Path) -> None:
    """The command is the same for every print, so that OrcaSlicer asks for leave once."""
    told = home / "told"
    program = scripted(home / "infill", f'printf "%s|" "$@" >> {shlex.quote(str(told))}\n{WRITES}\necho \'{NOTHING}\'')
    result = plugin.post_process(gcode, program=f'"{program}"')
    assert (result.status, result.message) == (PluginResult.Success, "2 of 3 sections of infill")
    assert gcode.read_bytes() == PRINT + b"; new\n"
    assert told.read_text() == (
        "refill|--json|--quiet|--pattern|keep|--smooth-radius|auto|--arcs|auto|-o|refilled.gcode|sliced.gcode|"
    )
    told.unlink()
    saved = {"pattern": "gyroid", "density": " 40%:12% ", "by": "skin", "smooth_radius": 1.5, "arcs": "on"}
    plugin.post_process(gcode, program=program, options="--set 'cell=3 mm' --max-segments 200", verify=True, **saved)
    assert told.read_text() == (
        "refill|--json|--quiet|--pattern|gyroid|--density|40%:12%|--by|skin|--smooth-radius|1.5|--arcs|on|"
        "--set|cell=3 mm|--max-segments|200|-o|refilled.gcode|sliced.gcode|"
        "verify|--quiet|sliced.gcode|refilled.gcode|"
    )


def test_the_page_shows_the_settings_that_orcaslicer_shows(plugin: Loaded) -> None:
    page = (FILE.parents[2] / "docs" / "slicers" / "orcaslicer.md").read_text(encoding="utf-8")
    (shown,) = re.findall(r"^```json\n(.*?)^```$", page, re.M | re.S)
    defaults = plugin.capabilities["Refill the infill"].get_default_config()
    assert json.loads(shown) == json.loads(json.dumps(defaults)) == defaults
    assert list(json.loads(shown)) == list(defaults)
    (example,) = re.findall(r"^`({.*})`\.$", page, re.M)
    assert json.loads(example).keys() < defaults.keys()


def test_uvx_is_the_last_way(plugin: Loaded, home: Path, gcode: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told = home / "told"
    lines = f'echo "$0" "$1" "$2" "$3" "$4" > {shlex.quote(str(told))}\n{WRITES}\necho \'{NOTHING}\''
    uvx = scripted(home / "on the path" / "uvx", lines)
    monkeypatch.setenv("PATH", str(Path(uvx).parent))
    assert plugin.post_process(gcode).status is PluginResult.Success
    assert told.read_text() == f"{uvx} --from phasefill infill refill\n"
    monkeypatch.setenv("PIPX_BIN_DIR", str(home / "bin"))
    infill = scripted(home / "bin" / "infill", lines)
    plugin.post_process(gcode)
    assert told.read_text().startswith(f"{infill} refill --json ")


def test_the_environment_of_a_packed_program_stays_outside(
    plugin: Loaded, home: Path, gcode: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = home / "told"
    monkeypatch.setenv("PYTHONHOME", "/tmp/.mount_Orca")
    monkeypatch.setenv("LD_LIBRARY_PATH", "/tmp/.mount_Orca/lib")
    monkeypatch.setenv("LANG", "C.UTF-8")
    plugin.post_process(gcode, program=scripted(home / "infill", f"env > {shlex.quote(str(told))}; exit 1"))
    names = {line.partition("=")[0] for line in told.read_text().splitlines()}
    assert "LANG" in names
    assert not {"PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH"} & names


def test_it_opens_nothing_outside_of_the_folder_of_the_print(tmp_path: Path, home: Path, gcode: Path) -> None:
    """OrcaSlicer asks its user about every such file, by Python's audit events; here each is compared with the folder."""
    program = scripted(home / "infill", f"{WRITES}\necho '{NOTHING}'")
    watched = tmp_path / "watched.py"
    watched.write_text(
        f"""
import sys, types
class Any_:
    def __getattr__(self, name): return Any_() if name != "__mro_entries__" else None
orca = types.ModuleType("orca")
orca.base, orca.plugin = object, lambda cls: cls
orca.slicing = types.SimpleNamespace(SlicingPipelineCapabilityBase=object)
orca.script = types.SimpleNamespace(ScriptPluginCapabilityBase=object)
sys.modules["orca"] = orca
space = {{"__name__": "plugin"}}
exec(compile(open({str(FILE)!r}).read(), "plugin", "exec"), space)
FILES = ("open", "os.", "shutil.", "tempfile.", "glob.", "pathlib.")
seen = []
def watch(event, args):
    if on and (event.startswith(FILES) or event == "subprocess.Popen"):
        seen.append((event, [str(each) for each in args[: 2 if event in ("os.rename", "shutil.copyfile") else 1]], args))
on = False
sys.addaudithook(watch)
on = True
space["refill"]({str(gcode)!r}, {{**space["SETTINGS"], "program": {program!r}}})
on = False
asked = [event for event, names, _ in seen if not all(each.startswith({str(gcode.parent)!r}) for each in names)]
print(asked, [args[1] for event, _, args in seen if event == "subprocess.Popen"], sep="\\n")
"""
    )
    done = subprocess.run([sys.executable, str(watched)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    asked, commands = done.stdout.splitlines()
    assert ast.literal_eval(asked) == ["subprocess.Popen"]
    assert str(gcode.parent) not in commands
    assert gcode.read_bytes() == PRINT + b"; new\n"


def test_it_needs_the_standard_library_alone() -> None:
    text = FILE.read_text(encoding="utf-8")
    tree = ast.parse(text, feature_version=(3, 12))
    imported = {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    imported |= {name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names}
    assert {name for name in imported if name.partition(".")[0] not in sys.stdlib_module_names} == {"orca"}
    assert len(text.splitlines()) < 250
    # All imports stand at the top: one made later would be a file that OrcaSlicer asks about.
    assert not [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and _imports(node)]
    # OrcaSlicer's names are read after the plain functions alone.
    assert "orca." not in text.partition("import orca\n")[2].partition("# --- what depends on OrcaSlicer")[0]


def _imports(function: ast.FunctionDef) -> list[ast.stmt]:
    return [node for node in ast.walk(function) if isinstance(node, ast.Import | ast.ImportFrom)]
