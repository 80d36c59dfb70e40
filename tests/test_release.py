"""A release: the same bytes from the same source, a recipe that conda's own tool reads, a container that builds."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import pytest

from infill.version import __version__

ROOT = Path(__file__).resolve().parents[1]


def load_tool(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def project() -> dict[str, dict[str, list[str]]]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    subprocess.run(["git", "clone", "-q", str(ROOT), str(tmp_path / "clone")], check=True)
    return tmp_path / "clone"


def build_release(tree: Path) -> subprocess.CompletedProcess[str]:
    tool = [sys.executable, "tools/build_release.py", "dist"]
    return subprocess.run(tool, cwd=tree, capture_output=True, encoding="utf-8", check=False)


@pytest.mark.longest
def test_a_release_built_twice_has_the_same_bytes(clone: Path) -> None:
    built = build_release(clone)
    names = [line.split()[1] for line in built.stdout.splitlines() if re.match(r"[0-9a-f]{64}  ", line)]
    assert names == [f"phasefill-{__version__}-py3-none-any.whl", f"phasefill-{__version__}.tar.gz"], built.stderr


@pytest.mark.longest
def test_a_release_that_differs_is_refused(clone: Path) -> None:
    (clone / "infill" / "stray.py").write_text("stray = 1\n")  # git does not track it: only the first build has it
    built = build_release(clone)
    assert built.returncode == 1
    assert "error: built twice, phasefill-" in built.stderr


def test_condas_own_tool_reads_the_recipe(project: dict[str, dict[str, list[str]]]) -> None:
    rattler_build = pytest.importorskip("rattler_build", reason="py-rattler-build reads recipes")
    text = load_tool("write_conda_recipe").conda_recipe(__version__, "0" * 64)
    recipe = rattler_build.Stage0Recipe.from_yaml(text)
    assert [variant.recipe.package.version for variant in recipe.render(rattler_build.VariantConfig())] == [__version__]
    needed = recipe.to_dict()["requirements"]["run"]
    assert [name.replace(" ", "") for name in needed[1:]] == project["dependencies"]
    assert recipe.to_dict()["build"]["python"]["entry_points"] == [
        f"{name} = {target}" for name, target in project["scripts"].items()
    ]


@pytest.mark.longest
def test_the_container_gets_all_that_the_wheel_is_built_of(tmp_path: Path) -> None:
    for line in re.findall(r"^COPY (?!--)(.*)$", (ROOT / "Dockerfile").read_text(encoding="utf-8"), re.M):
        *names, target = line.split()
        for name in names:
            path = tmp_path / "source" / (name if (ROOT / name).is_dir() else Path(name).name)
            assert path.parent == tmp_path / "source" or target == f"/source/{name}"
            if (ROOT / name).is_dir():
                shutil.copytree(ROOT / name, path)
            else:
                path.parent.mkdir(exist_ok=True)
                shutil.copyfile(ROOT / name, path)
    wheels = []
    for source in (ROOT, tmp_path / "source"):
        folder = tmp_path / f"dist-{source.name}"
        build = [sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", str(folder), str(source)]
        subprocess.run(build, capture_output=True, check=True)
        wheels.append(next(folder.iterdir()).read_bytes())
    assert wheels[0] == wheels[1]
