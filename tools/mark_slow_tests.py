"""Mark the tests that `make quick` and `make test` leave out: `python tools/mark_slow_tests.py build/cpu_times.txt`.

The file lists the CPU seconds of every test: see tests/cpu_times.py. Three marks are set in the code, and removed where
they no longer belong:

    slow     `make quick` leaves the test out
    long     `make test` runs its first case alone; it is slow, too
    longest  `make test` leaves it out; it is slow, too

The tests that take longest are marked until the others fit.
"""

from __future__ import annotations

import ast
import re
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
QUICK, TEST = 60.0, 400.0  # CPU seconds of what is left for each; imports and collecting come on top
LEAST_SAVED = 2.0  # CPU seconds of the cases after the first
UNMARKED = ("tests/test_architecture.py::test_the_house_keeps_the_rule",)  # what a change breaks first
MARKS = ("pytest.mark.slow", "pytest.mark.long", "pytest.mark.longest")


def read_times(text: str) -> dict[str, tuple[float, float]]:
    r"""Return the seconds of each test, and of its first case if it has cases; the latest time of a case counts.

    >>> read_times("2.0\tfirst\ttests/a.py::b[1]\n3.0\tother\ttests/a.py::b[2]\n")
    {'tests/a.py::b': (5.0, 2.0)}
    """
    cases: dict[str, dict[str, float]] = defaultdict(dict)
    first: dict[str, float] = {}
    for line in text.splitlines():
        seconds, place, case = line.split("\t")
        name = case.split("[")[0]
        if name.startswith("tests/") and name not in UNMARKED:
            cases[name][case] = float(seconds)
            if place == "first":
                first[name] = float(seconds)
    return {name: (sum(times.values()), first.get(name, 0.0)) for name, times in cases.items()}


def choose_marks(times: Mapping[str, tuple[float, float]]) -> dict[str, str]:
    """Return the mark of each test that needs one, from its seconds and those of its first case.

    >>> choose_marks({"a": (1.0, 0.0), "b": (700.0, 200.0), "c": (60.0, 30.0), "d": (900.0, 0.0), "e": (70.0, 0.0)})
    {'b': 'long', 'c': 'long', 'd': 'longest', 'e': 'slow'}
    """
    marks: dict[str, str] = {}
    kept = {name: total for name, (total, _) in times.items()}
    with_cases = {name: first for name, (total, first) in times.items() if 0 < first < total}
    for name in sorted(with_cases, key=lambda test: with_cases[test] - kept[test]):
        if sum(kept.values()) <= TEST or kept[name] - with_cases[name] < LEAST_SAVED:
            break
        marks[name], kept[name] = "long", with_cases[name]
    left = sum(kept.values())
    for name in sorted(kept, key=lambda test: -kept[test]):
        if left <= TEST:
            break
        marks[name] = "longest"
        left -= kept[name]
    left = sum(total for name, (total, _) in times.items() if name not in marks)
    for name, (total, _) in sorted(times.items(), key=lambda test: -test[1][0]):
        if left <= QUICK:
            break
        if name not in marks:
            marks[name] = "slow"
            left -= total
    return marks


def test_functions(tree: ast.Module) -> Iterator[tuple[str, int]]:
    """Yield the name of each test in a module, and the line of its first decorator or of `def`."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test"):
            yield node.name, min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
        elif isinstance(node, ast.ClassDef):
            yield from ((f"{node.name}::{name}", line) for name, line in test_functions(ast.Module(node.body, [])))


def mark_module(source: str, marks: Mapping[str, str]) -> str:
    r"""Return the source of a test module with these marks, and no others, by the name of the test.

    >>> print(mark_module("@pytest.mark.slow\ndef test_a(): ...\ndef test_b(): ...\n", {"test_b": "long"}))
    def test_a(): ...
    @pytest.mark.long
    def test_b(): ...
    <BLANKLINE>
    """
    marked = {
        decorator.lineno
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.FunctionDef)
        for decorator in node.decorator_list
        if ast.unparse(decorator) in MARKS
    }
    lines = [line for number, line in enumerate(source.splitlines(keepends=True), 1) if number not in marked]
    for name, number in sorted(test_functions(ast.parse("".join(lines))), key=lambda test: -test[1]):
        if name in marks:
            line = lines[number - 1]
            lines.insert(number - 1, f"{line[: len(line) - len(line.lstrip())]}@pytest.mark.{marks[name]}\n")
    return "".join(lines)


def main(path: str) -> None:
    """Set the marks in all test modules."""
    times = read_times(Path(path).read_text(encoding="utf-8"))
    marks = choose_marks(times)
    unknown = marks.keys() - {
        f"{file.relative_to(ROOT).as_posix()}::{name}"
        for file in (ROOT / "tests").glob("test_*.py")
        for name, _ in test_functions(ast.parse(file.read_text(encoding="utf-8")))
    }
    if unknown:
        sys.exit(f"there is no test {min(unknown)}; measure the times again")
    for file in sorted((ROOT / "tests").glob("test_*.py")):
        source, prefix = file.read_text(encoding="utf-8"), f"{file.relative_to(ROOT).as_posix()}::"
        own = {name.removeprefix(prefix): mark for name, mark in marks.items() if name.startswith(prefix)}
        marked = mark_module(source, own)
        if own and not re.search(r"^import pytest$", marked, re.MULTILINE):
            sys.exit(f"{file} has to import pytest")
        if marked != source:
            file.write_text(marked, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
