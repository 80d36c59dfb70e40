"""Choose what `make quick` leaves out: `python tools/slow_tests.py LOG`, with the log of a full run.

    python -m pytest -q -n 2 -p no:cov tests infill patterns --durations=0 --durations-min=0.003 > LOG

The tests that took longest, all their parameters added up, are written to tests/slow.txt until what is left fits.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

LIST = Path(__file__).resolve().parents[1] / "tests" / "slow.txt"
SECONDS = 48.0  # of two processes; imports and collecting come on top
ROW = re.compile(r"([\d.]+)s (?:call|setup|teardown) +(\S+)")
KEPT = ("tests/test_architecture.py::test_the_house_keeps_the_rule",)  # what a change breaks first


def chosen(log: str) -> list[str]:
    """Return the names of the slowest tests, without their parameters."""
    seconds: Counter[str] = Counter()
    for spent, name in ROW.findall(log):
        if name.startswith("tests/"):
            seconds["::".join(part.split("[")[0] for part in name.split("::"))] += float(spent)
    left, names = sum(seconds.values()), []
    for name, spent in seconds.most_common():
        if left <= SECONDS:
            break
        if name not in KEPT:
            left -= spent
            names.append(name)
    return sorted(names)


if __name__ == "__main__":
    LIST.write_text("".join(f"{name}\n" for name in chosen(Path(sys.argv[1]).read_text(encoding="utf-8"))), "utf-8")
