"""CPU time and memory of `infill refill` as a command: ``python -m benchmarks.refill_speed``.

PrusaSlicer slices boxes with 15 % of infill; a process of its own refills each, with kernels compiled before. It prints
a table in Markdown, with the median of the runs: what else a machine does disturbs CPU seconds less than a clock.
``--beside FOLDER`` runs another checkout in turn, and adds its figures; ``--only keep`` takes the cases with this in
their name.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from benchmarks.pairs import Run, paired, process
from tests.prints import box, prusa_print

ROOT = Path(__file__).resolve().parents[1]
GRADIENT = ("--density", "40%:12%", "--by", "x")


@dataclass(frozen=True, kw_only=True)
class Case:
    """A print, and how it is refilled."""

    name: str
    size: tuple[float, float, float]  # mm
    infill: str
    options: tuple[str, ...] = ()


CASES = (
    Case(name="`keep`, honeycomb in 110 × 110 × 80 mm", size=(110, 110, 80), infill="honeycomb"),
    Case(name="`keep`, gyroid in 60 × 60 × 97 mm", size=(60, 60, 97), infill="gyroid"),
    Case(
        name="`--pattern honeycomb` for a grid in 60 × 60 × 20 mm",
        size=(60, 60, 20),
        infill="grid",
        options=("--pattern", "honeycomb"),
    ),
    Case(
        name="the same for a gyroid in 60 × 60 × 60 mm",
        size=(60, 60, 60),
        infill="gyroid",
        options=("--pattern", "honeycomb"),
    ),
    Case(
        name="`--pattern honeycomb --density 40%:12% --by x` for a grid in 60 × 60 × 20 mm",
        size=(60, 60, 20),
        infill="grid",
        options=("--pattern", "honeycomb", *GRADIENT),
    ),
)


def command(checkout: Path, case: Case, gcode: Path) -> list[str]:
    """Return the command that refills a print with the package in a folder."""
    words = ["infill", "refill", str(gcode), "-o", str(gcode.with_name("new.gcode")), "--force", "-q", *case.options]
    code = f"import sys; sys.path.insert(0, {str(checkout)!r}); sys.argv = {words!r}; import infill.cli"
    return [sys.executable, "-P", "-c", f"{code}; infill.cli.program()"]


def figures(runs: list[Run]) -> tuple[str, str, str]:
    """Return CPU seconds, seconds and MB."""
    cpu, wall, peak = (statistics.median(getattr(run, name) for run in runs) for name in ("cpu", "seconds", "memory"))
    return f"{cpu:.1f} s", f"{wall:.1f} s", f"{peak / 1e6:.0f} MB"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", default="", help="cases with this in their name")
    parser.add_argument("--beside", type=Path, help="a checkout of another version")
    options = parser.parse_args()
    checkouts = [ROOT] if options.beside is None else [options.beside.resolve(), ROOT]
    heads = ("CPU", "clock", "memory")
    columns = [f"{head}, {name}" for name in ("before", "now")[2 - len(checkouts) :] for head in heads]
    print("| refill | file | " + " | ".join(columns if options.beside else heads) + " |")
    print("|" + "---|" * (2 + len(columns)), flush=True)
    with tempfile.TemporaryDirectory(prefix="refill-speed-") as name:
        folder = Path(name)
        for case in CASES:
            if options.only not in case.name:
                continue
            gcode = prusa_print(box(folder, case.size), folder / "print.gcode", {"fill_pattern": case.infill})
            first, last = (command(checkout, case, gcode) for checkout in (checkouts[0], checkouts[-1]))
            if options.beside is None:
                process(first)
                measured = [[process(first) for _ in range(options.runs)]]
            else:
                measured = list(paired(partial(process, first), partial(process, last), options.runs))
            cells = [cell for runs in measured for cell in figures(runs)]
            print(f"| {case.name} | {gcode.stat().st_size / 1e6:.1f} MB | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
