"""Fuzz for some minutes, and end with 1 if anything was found: `python -m tests.fuzzing --minutes 60`."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from tests.fuzzing.campaign import ROOT, run_cases
from tests.fuzzing.targets import TARGETS

ROUND = 120.0  # s of one target before the next has its turn


def main() -> int:
    """Go round the targets until the time is over; every round has new cases."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzzing")
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", default=time.strftime("%Y%m%d-%H%M"))
    parser.add_argument("--only", nargs="*", choices=list(TARGETS), default=list(TARGETS))
    parser.add_argument("--into", type=Path, default=ROOT / "build" / "fuzz")
    given = parser.parse_args()
    ends = time.monotonic() + 60 * given.minutes
    cases, failed, numbers = dict.fromkeys(given.only, 0), dict.fromkeys(given.only, 0), dict.fromkeys(given.only, 0)
    while time.monotonic() < ends:
        for name in given.only:
            left = ends - time.monotonic()
            if left <= 0:
                break
            found = run_cases(
                name, seed=given.seed, start=numbers[name], count=10**9, seconds=min(ROUND, left), into=given.into
            )
            numbers[name] += max(found.cases, 1)
            cases[name] += found.cases
            failed[name] += len(found.faults)
            for fault, count in found.kinds.most_common():
                print(f"{name}: {count} x {fault}", flush=True)
            print(f"{name}: {cases[name]} cases, {failed[name]} with faults, seed {given.seed}", flush=True)
    return 1 if any(failed.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
