"""Run every figure and table, and write the page: ``python -m examples.paper [docs] [--only fig02,table1] [--small]``.

Each runs in a process of its own, so that one does not feel the memory of another, and one after the other, so that
times are true. Models that are not there are left out, and the page keeps what an earlier run found.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from pathlib import Path

from examples.paper.entry import LEFT_OUT, STOPPED
from examples.paper.page import SCRIPTS, write


def main() -> int:
    """Run what is asked for and write paper.md."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("docs", type=Path, nargs="?", default=Path("docs"), help="folder of the page (default: docs)")
    parser.add_argument("--only", default="", help="names with commas between, such as fig02,table1")
    parser.add_argument("--small", action="store_true", help="coarser grids, as the tests take them")
    options = parser.parse_args()
    folder = options.docs / "paper"
    folder.mkdir(parents=True, exist_ok=True)
    asked = options.only.split(",") if options.only else [script.entry for script in SCRIPTS]
    if unknown := [name for name in asked if name not in {script.entry for script in SCRIPTS}]:
        parser.error(f"there is no {', '.join(unknown)}; there are {', '.join(script.entry for script in SCRIPTS)}")
    begin = time.perf_counter()
    for script in (script for script in SCRIPTS if script.entry in asked):
        started = time.perf_counter()
        command = [sys.executable, "-m", f"examples.paper.{script.module}", str(folder), *["--small"] * options.small]
        try:
            done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
        except KeyboardInterrupt:
            return STOPPED
        if done.returncode == LEFT_OUT:
            print(f"{script.entry}: left out", file=sys.stderr)
            continue
        if done.returncode:
            print(f"error: {script.module} ended with {done.returncode}", file=sys.stderr)
            return 1
        print(f"{script.entry:10} {time.perf_counter() - started:6.1f} s", file=sys.stderr)
    page = write(options.docs)
    print(f"{page}: {time.perf_counter() - begin:.0f} s in all", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
