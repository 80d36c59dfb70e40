"""The action for GitHub and the hooks for pre-commit: their steps are run here as their hosts run them."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import trimesh
import yaml
from handmade_prints import Dialect, written

from infill.timing.print_check import check_print

ROOT = Path(__file__).resolve().parents[1]
ACTION = ROOT / "action.yml"
HOOKS = ROOT / ".pre-commit-hooks.yaml"
EXAMPLE = ROOT / "examples" / "github" / "models.yml"
CONFIG = ROOT / "examples" / "github" / "pre-commit-config.yaml"
BASH = shutil.which("bash")
PRINT = written(Dialect(layers=3))
STEPS = {"meshes": "Check meshes and prints", "pairs": "Compare prints"}


def read_yaml(path: Path) -> Any:
    return yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.BaseLoader)


def git(folder: Path, *words: str) -> None:
    identity = ["-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *identity, *words], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository with a box, a print, and a print from which a bead was taken."""
    folder = tmp_path / "models"
    (folder / "a folder").mkdir(parents=True)
    git(folder, "init", "-q")
    trimesh.creation.box((9.0, 9.0, 9.0)).export(folder / "a folder" / "Box.STL", file_type="stl")
    (folder / "part one.gcode").write_bytes(PRINT)
    (folder / "same.gcode").write_bytes(PRINT)
    (folder / "notes.txt").write_text("no mesh")
    git(folder, "add", ".")
    return folder


def add_open_mesh(folder: Path) -> None:
    box = trimesh.creation.box((9.0, 9.0, 9.0))
    trimesh.Trimesh(box.vertices, box.faces[3:], process=False).export(folder / "open.stl")
    git(folder, "add", "open.stl")


def run_step(part: str, folder: Path, **inputs: str) -> subprocess.CompletedProcess[str]:
    """Run a step of the action as GitHub does, with its inputs as the environment."""
    if BASH is None or sys.platform == "win32":
        pytest.skip("no bash here")
    action = read_yaml(ACTION)
    (step,) = (step for step in action["runs"]["steps"] if step.get("name") == STEPS[part])
    values = {name: declared["default"] for name, declared in action["inputs"].items()} | {
        name.replace("_", "-"): value for name, value in inputs.items()
    }
    environment = {
        name: re.sub(r"\$\{\{ inputs\.([\w-]+) \}\}", lambda found: values[found[1]], text)
        for name, text in step["env"].items()
    }
    assert not any("${{" in text for text in environment.values())
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        [BASH, "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]],
        cwd=folder,
        env={**os.environ, **environment, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
    )


# --- what the hosts require -----------------------------------------------------------------------------


def test_the_action_has_what_github_requires() -> None:
    action = read_yaml(ACTION)
    assert {"name", "description", "runs"} <= set(action)
    assert action["runs"]["using"] == "composite"
    for name, declared in action["inputs"].items():
        assert declared["description"]
        assert "default" in declared
        assert name == name.lower()
    used = set()
    for step in action["runs"]["steps"]:
        assert ("run" in step) != ("uses" in step)
        assert "uses" in step or step["shell"] == "bash"
        assert "${{" not in step.get("run", ""), "what strangers write must not reach a shell"
        assert "uses" not in step or re.search(r"@[0-9a-f]{40}$", step["uses"])
        texts = [*step.get("env", {}).values(), *step.get("with", {}).values()]
        used |= {name for text in texts for name in re.findall(r"inputs\.([\w-]+)", text)}
    assert used == set(action["inputs"])


@pytest.mark.slow
def test_the_schemas_hold() -> None:
    """Those of GitHub as check-jsonschema brings them, and the readers of pre-commit."""
    pytest.importorskip("check_jsonschema")
    pytest.importorskip("pre_commit")
    check = [sys.executable, "-m", "check_jsonschema", "--builtin-schema"]
    for words in (
        [*check, "vendor.github-actions", ACTION],
        [*check, "vendor.github-workflows", EXAMPLE],
        [sys.executable, "-m", "pre_commit", "validate-manifest", HOOKS],
        [sys.executable, "-m", "pre_commit", "validate-config", CONFIG],
    ):
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


def test_the_examples_name_what_there_is() -> None:
    steps = read_yaml(EXAMPLE)["jobs"]["check"]["steps"]
    assert set(steps[1]["with"]) <= set(read_yaml(ACTION)["inputs"])
    assert steps[0]["with"]["persist-credentials"] == "false"
    assert steps[0]["uses"] in (ROOT / ".github" / "workflows" / "test.yml").read_text(encoding="utf-8")
    (repo,) = read_yaml(CONFIG)["repos"]
    assert [hook["id"] for hook in repo["hooks"]] == [hook["id"] for hook in read_yaml(HOOKS)]


def test_the_patterns_of_the_hooks_are_those_of_our_files() -> None:
    from infill.files.suffixes import MESHES, PRINTS

    check, verify = read_yaml(HOOKS)
    for suffix in (*MESHES, *(suffix for suffix in PRINTS if suffix != ".gco")):
        assert re.search(check["files"], f"a/b{suffix.upper()}")
    for name in ("a.gcode", "a.bgcode", "A.GCODE.3MF"):
        assert re.search(verify["files"], name)
    assert not re.search(check["files"], "notes.txt")
    assert not re.search(verify["files"], "a.3mf")


# --- the steps of the action ----------------------------------------------------------------------------


@pytest.mark.longest
def test_the_action_checks_what_git_lists(repository: Path) -> None:
    fine = run_step("meshes", repository)
    assert fine.returncode == 0, fine.stdout + fine.stderr
    for name in ("a folder/Box.STL", "part one.gcode", "same.gcode"):
        assert re.search(rf"^{name} +yes", fine.stdout, re.M), fine.stdout
    add_open_mesh(repository)
    broken = run_step("meshes", repository)
    assert broken.returncode == 1
    assert re.search(r"^open\.stl +NO", broken.stdout, re.M)
    assert run_step("meshes", repository, files="*.gcode\n").returncode == 0
    assert "No file" in run_step("meshes", repository, files="*.obj\n").stdout
    assert "No file" in run_step("meshes", repository, files="").stdout


@pytest.mark.longest
def test_the_action_compares_pairs(repository: Path) -> None:
    assert run_step("pairs", repository).returncode == 0
    same = run_step("pairs", repository, pairs="part one.gcode -> same.gcode\n")
    assert same.returncode == 0, same.stdout + same.stderr
    (repository / "other.gcode").write_bytes(PRINT.replace(b"M109 S215", b"M109 S225"))
    pairs = "part one.gcode -> other.gcode\npart one.gcode -> same.gcode\n"
    other = run_step("pairs", repository, pairs=pairs)
    assert other.returncode == 1
    assert "other.gcode" in other.stderr
    assert "same.gcode" in other.stderr
    wrong = run_step("pairs", repository, pairs="same.gcode\n")
    assert wrong.returncode == 1
    assert "is not a pair" in wrong.stdout
    assert run_step("pairs", repository, pairs=pairs, verify_options="--allow temperature").returncode == 0


# --- the hooks --------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_pre_commit_runs_the_hooks(repository: Path, tmp_path: Path) -> None:
    """With what is installed here in place of an environment of its own, which takes 560 MB."""
    pytest.importorskip("pre_commit")
    arguments = {"infill-verify": ["part one.gcode", "same.gcode"]}
    hooks = [
        {**hook, "language": "system", "args": arguments.get(hook["id"], [])}
        for hook in yaml.safe_load(HOOKS.read_text(encoding="utf-8"))
    ]
    (repository / ".pre-commit-config.yaml").write_text(yaml.safe_dump({"repos": [{"repo": "local", "hooks": hooks}]}))
    git(repository, "add", ".")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "PRE_COMMIT_HOME": str(tmp_path / "home")}

    def run() -> subprocess.CompletedProcess[str]:
        words = [sys.executable, "-m", "pre_commit", "run", "--all-files", "--color", "never"]
        return subprocess.run(words, cwd=repository, env=environment, capture_output=True, text=True, check=False)

    fine = run()
    assert fine.returncode == 0, fine.stdout + fine.stderr
    assert fine.stdout.count("Passed") == 2
    add_open_mesh(repository)
    broken = run()
    assert broken.returncode == 1
    assert broken.stdout.count("Failed") == broken.stdout.count("Passed") == 1
    assert re.search(r"open\.stl +NO", broken.stdout)


# --- a print that is whole --------------------------------------------------------------------------------


def test_a_print_is_whole_or_says_why_not(tmp_path: Path) -> None:
    whole, cut, empty, bare = (tmp_path / f"{name}.gcode" for name in ("whole", "cut", "empty", "bare"))
    whole.write_bytes(PRINT)
    verdict = check_print(whole)
    assert verdict.printable
    assert verdict.layers == 3
    assert verdict.warnings == ()
    cut.write_bytes(b"; generated by PrusaSlicer 2.9.6\n;LAYER_CHANGE\nG1 X1 Y1 Z.2 F900\nG1 X9 E1\n")
    (problem,) = check_print(cut).problems
    assert "it was cut off" in problem
    empty.write_bytes(b"G28\nG1 X9 F900\n")
    assert check_print(empty).problems == ("no line of it prints anything",)
    bare.write_bytes(b"G1 X1 Y1 Z.2 F900\nM83\nG1 X9 E1\n")
    assert check_print(bare).printable
    assert check_print(bare).warnings == ("no layers are marked",)
