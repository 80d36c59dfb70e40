"""Imports run one way: patterns <- infill <- infill.cli, and heavy ones wait."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MODULES = sorted(path for package in ("infill", "patterns") for path in (ROOT / package).rglob("*.py"))
HEAVY = {"trimesh", "skimage", "scipy", "manifold3d", "numba", "PIL", "shapely", "numpy", "rich.progress"}


def imported(path: Path) -> set[str]:
    """Return the names of all modules that a file imports, at any depth."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports relatively"
            found.add(node.module or "")
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_run_one_way(path: Path) -> None:
    names = imported(path)
    place = path.relative_to(ROOT).parts
    if place[0] == "patterns":
        assert not {name for name in names if name.split(".")[0] == "infill"}
        others = {name.split(".")[0] for name in names} - set(sys.stdlib_module_names) - {"patterns"}
        assert others <= {"numpy", "shapely"}
    elif place[1] != "cli":
        assert not {name for name in names if name.startswith("infill.cli")}
        assert not {name for name in names if name.split(".")[0] in ("typer", "rich")}


def test_the_reader_of_imports_sees_nested_ones(tmp_path: Path) -> None:
    file = tmp_path / "x.py"
    file.write_text("def f():\n    import infill.cli\n    from numpy import array\n")
    assert imported(file) == {"infill.cli", "numpy"}


def modules_after(code: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    return set(done.stdout.split())


def test_help_loads_nothing_heavy() -> None:
    assert not HEAVY & modules_after("import infill.cli.app; infill.cli.app.build()")


def test_the_help_of_make_loads_no_pattern() -> None:
    """However many there are."""
    code = "import sys; sys.argv = ['infill', 'make', '--help']; import infill.cli; infill.cli.main()"
    loaded = modules_after(code)
    assert "patterns.errors" in loaded
    assert not {"patterns.catalogue", "patterns.honeycomb", "numpy", "shapely"} & loaded


def test_make_needs_neither_a_compiler_nor_trimesh(tmp_path: Path) -> None:
    code = f"from infill import make; make('honeycomb', size=20, height=2).save({str(tmp_path / 'x.stl')!r})"
    assert not {"numba", "llvmlite", "trimesh", "manifold3d", "PIL"} & modules_after(code)


def test_smoothing_without_a_choice_loads_no_compiler() -> None:
    code = "import numpy as np; from infill import smooth; smooth(np.ones((9, 9))); smooth(np.ones((5, 5, 5)))"
    assert not {"numba", "llvmlite", "scipy"} & modules_after(code)


def test_every_public_name_is_found() -> None:
    import infill
    import patterns

    for package in (infill, patterns):
        for name in package.__all__:
            assert getattr(package, name) is not None
    assert set(infill.__all__) <= set(dir(infill))
    with pytest.raises(AttributeError, match="nonsense"):
        _ = infill.nonsense


def test_modules_are_short() -> None:
    long = {path.name: n for path in MODULES if (n := len(path.read_text(encoding="utf-8").splitlines())) > 400}
    assert not long
