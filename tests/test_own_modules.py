"""Python files of the user's: whatever they raise or exit with is one line that names them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from test_command_line import one_line_error, run

from infill import FormatError, ParameterError
from infill.options.density_fields import FunctionField
from infill.options.modules import load_object
from infill.options.resolve_pattern import resolve_pattern

FAILURES = [
    "raise RuntimeError('boo')",
    "raise Exception('boo')",
    "raise type('Own', (Exception,), {})('boo')",
    "raise StopIteration",
    "raise MemoryError",
    "assert 0",
    "1 / 0",
    "import nowhere_to_be_found",
    "open('/nowhere/to/be/found')",
    "import sys; sys.exit()",
    "import sys; sys.exit(3)",
    "import sys; sys.exit('bye')",
    "def f(: pass",
]


@pytest.mark.parametrize("line", FAILURES)
def test_a_file_that_fails_is_named(line: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text(f"{line}\n\n\ndef waves(x, y, z):\n    return x\n")
    with pytest.raises(FormatError, match=r"mine\.py cannot be loaded \(.*\); run it by itself first$"):
        load_object(f"{path}:waves")


@pytest.mark.parametrize("line", [line for line in FAILURES if "f(:" not in line])
def test_a_function_that_fails_is_named(line: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text(f"def waves(*places):\n    {line}\n")
    with pytest.raises(ParameterError, match=r"mine\.py:waves, which fails: "):
        resolve_pattern(f"{path}:waves", "fill")
    field = FunctionField(function=load_object(f"{path}:waves"), name="mine.py:waves")  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match=r"mine\.py:waves, which fails: "):
        field.at(np.zeros((2, 3)), None)  # type: ignore[arg-type]


def test_the_command_says_so(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text("import sys\n\nsys.exit(3)\n")
    result = run("make", f"{tmp_path / 'mine.py'}:waves", "-o", tmp_path / "a.stl")
    one_line_error(result, "cannot be loaded .it exits with 3.; run it by itself first")
