"""Choose what `make quick` and `make test` leave out: `python tools/slow_tests.py LOG`, with the log of a full run.

    python -m pytest -q -n 2 -p no:cov --durations=0 --durations-min=0.003 > LOG

`make quick` leaves out the tests that took longest, all their parameters added up, until what is left fits:
tests/slow.txt.
`make test` leaves out the longest cases, but of every test with parameters the shortest one stays: tests/long.txt.
`make coverage` leaves out nothing.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1] / "tests"
QUICK = 48.0  # seconds of two processes; imports and collecting come on top
TEST = 560.0  # the same, for 6 minutes on two cores
ROW = re.compile(r"([\d.]+)s (?:call|setup|teardown) +(\S.*)")
KEPT = ("tests/test_architecture.py::test_the_house_keeps_the_rule",)  # what a change breaks first


def timed(log: str) -> Counter[str]:
    """Return the seconds of each case, with its parameters."""
    seconds: Counter[str] = Counter()
    for spent, name in ROW.findall(log):
        if name.startswith("tests/") and name.strip() not in KEPT:
            seconds[name.strip()] += float(spent)
    return seconds


def without_parameters(name: str) -> str:
    """Return the name of a test without those of its cases."""
    return "::".join(part.split("[")[0] for part in name.split("::"))


def slow(seconds: Counter[str]) -> list[str]:
    """Return the names of the slowest tests, without their parameters."""
    tests: Counter[str] = Counter()
    for name, spent in seconds.items():
        tests[without_parameters(name)] += spent
    left, names = seconds.total(), []
    for name, spent in tests.most_common():
        if left <= QUICK:
            break
        left -= spent
        names.append(name)
    return sorted(names)


def long(seconds: Counter[str]) -> list[str]:
    """Return the names of the longest cases."""
    cases = Counter(without_parameters(name) for name in seconds)
    left, names = seconds.total(), []
    for name, spent in seconds.most_common():
        if left <= TEST:
            break
        test = without_parameters(name)
        if "[" in name and cases[test] == 1:
            continue
        cases[test] -= 1
        left -= spent
        names.append(name)
    return sorted(names)


if __name__ == "__main__":
    seconds = timed(Path(sys.argv[1]).read_text(encoding="utf-8"))
    for file, names in (("slow.txt", slow(seconds)), ("long.txt", long(seconds))):
        (TESTS / file).write_text("".join(f"{name}\n" for name in names), "utf-8")
