"""Examples run, and each has one golden number."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from infill import check

FOLDER = Path(__file__).resolve().parents[1] / "examples"
GOLDEN = {
    "01_make": 1022.024,
    "02_own_pattern": 25,
    "03_before_the_slicer": 0.198714,
    "04_smooth_a_scan": 15430.8,
}


@pytest.mark.parametrize("name", GOLDEN)
def test_the_example_gives_its_number(name: str, tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location(f"example_{name}", FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.main(tmp_path) == pytest.approx(GOLDEN[name], rel=1e-4)
    (file,) = tmp_path.iterdir()
    assert check(file).printable


def test_every_example_is_here() -> None:
    assert {path.stem for path in FOLDER.glob("*.py")} == set(GOLDEN)
