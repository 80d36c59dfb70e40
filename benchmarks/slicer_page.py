"""The page of the slicer report, written from its results: nothing on it is typed by hand but words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from benchmarks.slicer_cases import (
    DELI_PYTHON,
    DENSITIES,
    NEWER,
    OURS,
    PARTS,
    PATTERNS,
    PRINTERS,
    SLICERS,
    Case,
    case_of,
    cases,
)
from benchmarks.slicer_extras import density_section, speed_section
from benchmarks.slicer_judge import TALL, WINDOWS
from benchmarks.slicer_promises import (
    SAME,
    WIDE,
    Runs,
    against_keep,
    filament,
    is_wide,
    middle,
    pairs,
    promises,
    saved,
)
from benchmarks.slicer_tables import percent, shown, table, verdict

LITTLE = 0.05  # saved: less is little

INTRODUCTION = """\
# Refill against the slicers

`infill refill` beside the infill that PrusaSlicer and CuraEngine make themselves: real parts, sliced, refilled, and
measured on the G-code. `make slicer-report` makes every number on this page; it is written from the runs that were made
so far.
"""

READING = """\
## How to read it

*Modes.* `keep` is the slicer's own infill with round corners (`infill refill PRINT.gcode`). Rounding shortens paths, so
`keep` at the slicer's density lays less filament; *equal filament* is `keep` after slicing again at the density that
gives the old amount back within 1 %. *Ours* is a pattern of ours in the same regions (`--pattern NAME`), with the
slicer's filament.

*Time* is that of the sparse infill alone, with all that leads to it: travel, retractions and lifts between its paths
count, and so does the way to the first of them. One planner judges all files: look-ahead with Klipper's rule for
corners, square corner velocity 5 mm/s, no minimum cruise ratio. A minus means less time.

*Supported* is the share of the infill's length whose centre line lies on a bead of the layer below, of any feature,
that is within half a line width of its centre line. *Bonded* is the share that another stretch of infill of the same
layer touches: within 1.05 line widths from centre line to centre line, the path's own next 4 line widths left out. Both
are measured on {windows} runs of {tall} layers, spread over the print, by an implementation that shares no code with
the package (`tests/gcode_structure.py`), so they differ a little from what `refill` reports.

*Printers.* {printers}. Their firmware is Marlin 2, which reads segments as
fast as they come. For a board of 8 bits (the flavour *Marlin (legacy)*), `refill` writes 200 segments a second at most:
curves save nearly as much then, and nothing at 300 mm/s. For such a board, the box and the bracket are sliced as well.
The slicers lay lines 0.45 mm wide, 0.2 mm high, with two walls; PrusaSlicer retracts 0.8 mm with wipe and lift. No
minimum layer time. The machine that ran this is shared, so that the seconds of `refill` itself are upper bounds.
"""


def write_page(path: Path, results: dict[str, Any], total: int, code: str) -> None:
    """Write the page of all results there are, of `total` cases; `code` tells runs of today's code from older ones."""
    path.write_text(page(results, total, code), encoding="utf-8", newline="\n")


def page(results: dict[str, Any], total: int, code: str) -> str:
    """Return the page."""
    runs: Runs = results["runs"]
    parts = [
        INTRODUCTION,
        _stands_on(results, total, code),
        _newer(results),
        _takes(results),
        promises_section(results),
        READING.format(printers=_printers(), windows=WINDOWS, tall=TALL),
        *(_pattern_section(runs, slicer, pattern) for slicer, patterns in PATTERNS.items() for pattern in patterns),
        _little_section(runs),
        _planners_section(runs),
        density_section(results.get("density")),
        speed_section(results.get("speed")),
    ]
    return "\n".join(part.rstrip() + "\n" for part in parts if part)


def _stands_on(results: dict[str, Any], total: int, code: str) -> str:
    runs, made = results["runs"], results.get("machine", {})
    named = [case_of(key) for key in runs]
    count = {density: sum(case.density == density for case in named) for density in DENSITIES}
    told = ", ".join(f"{number} at {density} %" for density, number in count.items())
    made_runs = [run for modes in runs.values() for run in modes.values() if run.get("error") != _NONE]
    failed = sum("error" in run for run in made_runs)
    refills = [run for modes in runs.values() for mode, run in modes.items() if mode != "slicer"]
    old = sum(run.get("code") != code for run in refills)
    stale = f"; {old} of {len(refills)} refills were made by older code, of refill or of this report" if old else ""
    return (
        f"It stands on {len(runs)} of {total} slicings ({told}), of {len({case.part for case in named})} of "
        f"{len(PARTS)} parts, each refilled in up to three modes; {failed} of these failed{stale}. "
        f"Made with PrusaSlicer {made.get('prusa', '?')}, CuraEngine {made.get('cura', '?')}, "
        f"Python {made.get('python', '?')}, {made.get('system', '?')}, {made.get('date', '?')}.\n"
    )


def _newer(results: dict[str, Any]) -> str:
    """Return which slicings PrusaSlicer 2.9 made, or what is missing for them."""
    number = sum(case_of(key).slicer in NEWER for key in results["runs"])
    if not number:
        return (
            "PrusaSlicer 2.9 was left out: no Python that has the package deli-slicer was named "
            f"(`--deli PYTHON`, or the environment variable {DELI_PYTHON}).\n"
        )
    package = results.get("machine", {}).get("deli") or "?"
    return f"{number} of these slicings are of PrusaSlicer 2.9, whose engine the package deli-slicer {package} holds.\n"


def _takes(results: dict[str, Any]) -> str:
    """Return how long a case took, and how long the whole matrix takes."""
    seconds: dict[str, float] = results.get("seconds", {})
    if not seconds:
        return ""
    spent = sorted(seconds.values())
    hours = sum(estimates(seconds).values()) / 2 / 3600
    return (
        f"One case, with its slicings, refills and measurements, takes {middle(spent):.0f} s of one core in the middle "
        f"over {len(spent)} cases, {spent[0]:.0f} to {spent[-1]:.0f} s. So the whole matrix takes about {hours:.1f} "
        "hours with `--jobs 2` on two cores: a case that was not run counts as the mean of those most like it.\n"
    )


def estimates(seconds: dict[str, float]) -> dict[str, float]:
    """Return seconds of one core for every case of the matrix: measured, or the mean of the cases most like it.

    Part, density, pattern, slicer and printer make cases alike, in this order. Where no case of the density was run,
    the seconds are in proportion to it.

    >>> found = estimates({"prusa/grid/box/15/fast": 10.0, "prusa/grid/bracket_medium/15/fast": 30.0})
    >>> found["prusa/grid/box/15/fast"], found["cura/gyroid/box/30/normal"]
    (10.0, 20.0)
    """
    known = [(case_of(key), value) for key, value in seconds.items()]
    found = {}
    for case in cases():
        alike = [(_likeness(case, other), value * case.density / other.density) for other, value in known]
        most = max(likeness for likeness, _ in alike)
        values = [value for likeness, value in alike if likeness == most]
        found[case.key] = seconds.get(case.key, sum(values) / len(values))
    return found


def _likeness(case: Case, other: Case) -> int:
    """Return a weight of what two cases share: what comes before weighs more than all that comes after."""
    names = ("part", "density", "pattern", "slicer", "printer")
    return sum((getattr(case, name) == getattr(other, name)) << (len(names) - n) for n, name in enumerate(names))


_NONE = "we have no such pattern"


def _printers() -> str:
    speeds = {"normal": "infill at 80 mm/s, travel at 180", "fast": "infill at 300 mm/s, travel at 400"}
    return "; ".join(f"*{name}*: {value:g} mm/s² for all moves, {speeds[name]}" for name, value in PRINTERS.items())


def promises_section(results: dict[str, Any]) -> str:
    """Return the table of promises: what was promised, what was measured, whether it was reached."""
    runs: Runs = results["runs"]
    widths: dict[str, float] = results.get("widths", {})
    rows: list[Sequence[str]] = []
    for promise in promises():
        found = promise.judged(runs, widths)
        if found is None:
            rows.append((promise.text, promise.limit, "-", "-", "not measured"))
            continue
        value, values = found
        least, most = (shown(end, promise.show) for end in (min(values), max(values)))
        spread = f"{least} to {most}, {_runs(values)}"
        rows.append((promise.text, promise.limit, shown(value, promise.show), spread, verdict(promise.reached(value))))
    for pattern in ("gyroid", "hilbertcurve"):
        wide = [value for case, value in against_keep(runs, pattern) if is_wide(widths, case)]
        text = f"our {OURS[pattern]} against `keep` of the slicer's, regions wider than {WIDE} cells, middle over runs"
        if wide:
            spread = f"{percent(min(wide))} to {percent(max(wide))}, {_runs(wide)}"
            rows.append((text, "no slower", percent(middle(wide)), spread, verdict(middle(wide) <= 0)))
        else:
            rows.append((text, "no slower", "-", "-", "not measured"))
    head = ("promise", "limit", "measured", "from and to", "reached?")
    return "## What was promised, and what holds\n\n" + table(head, rows)


def _runs(values: Sequence[float]) -> str:
    return f"{len(values)} run" + "s" * (len(values) > 1)


def _of(runs: Runs, slicer: str, pattern: str) -> list[tuple[Case, dict[str, Any]]]:
    """Return the cases of a pattern in the order of a table."""
    some = [(case_of(key), modes) for key, modes in runs.items()]
    some = [(case, modes) for case, modes in some if (case.slicer, case.pattern) == (slicer, pattern)]
    order = {part: number for number, part in enumerate(PARTS)}
    some.sort(key=lambda each: (each[0].density != DENSITIES[0], each[0].density, order[each[0].part], each[0].printer))
    return some


def _pattern_section(runs: Runs, slicer: str, pattern: str) -> str:
    name = SLICERS[slicer]
    ours = OURS.get(pattern)
    times, holds, failed = [], [], []
    for case, modes in _of(runs, slicer, pattern):
        own = modes.get("slicer", {})
        if "seconds" not in own:
            failed.append(f"{case.part} at {case.density:g} %, {case.printer}: {own.get('error', 'not run')}")
            continue
        good = {mode: run for mode, run in modes.items() if "error" not in run}
        keep, same, our = (good.get(mode) for mode in ("keep", SAME, "ours"))
        failed += [
            f"{case.part} at {case.density:g} %, {case.printer}, {mode}: {run['error']}"
            for mode, run in modes.items()
            if "error" in run and run["error"] != _NONE
        ]
        label = (case.part, f"{case.density:g}", case.printer)
        times.append((*label, *_time_cells(own, keep, same, our)))
        holds.append((*label, *_hold_cells(own, keep, our)))
    if not times:
        return f"## {name}: {pattern}\n\nNo run.{_listed(failed)}\n" if failed else ""
    about = f"Ours is `{ours}`." if ours else "There is no pattern of ours for it."
    first = ("part", "%", "printer")
    return (
        f"## {name}: {pattern}\n\n{about}\n\n"
        + table(
            (*first, "slicer, s", "keep", "per mm filament", "equal filament", "at %", "ours", "per mm filament"), times
        )
        + "\n"
        + table((*first, "supported", "bonded", "turns over 30°", "retractions", "paths", "MB", "refill, s"), holds)
        + "\nOf support and what follows: the slicer's own, `keep`, ours.\n"
        + _listed(failed)
    )


def _listed(failed: Iterable[str]) -> str:
    failed = list(failed)
    return "\nFailed: " + "; ".join(failed) + ".\n" if failed else ""


def _time_cells(
    own: dict[str, Any], keep: dict[str, Any] | None, same: dict[str, Any] | None, our: dict[str, Any] | None
) -> tuple[str, ...]:
    def change(run: dict[str, Any] | None) -> str:
        return percent(-saved(own, run)) if run else "-"

    def per_mm(run: dict[str, Any] | None) -> str:
        return percent((1 - saved(own, run)) / (1 + filament(own, run)) - 1) if run else "-"

    off = "" if not same or abs(filament(own, same)) <= 0.01 else f" (filament {percent(filament(own, same))})"
    at = f"{same.get('density', 0):.4g}" if same else "-"
    ours = "" if not our or abs(filament(own, our)) <= 0.01 else f" (filament {percent(filament(own, our))})"
    return (
        f"{own['seconds']:.0f}",
        change(keep),
        per_mm(keep),
        change(same) + off,
        at,
        change(our) + ours,
        per_mm(our),
    )


def _hold_cells(own: dict[str, Any], keep: dict[str, Any] | None, our: dict[str, Any] | None) -> tuple[str, ...]:
    def three(name: str, show: str, scale: float = 1.0) -> str:
        return ", ".join(show.format(run[name] / scale) if run else "-" for run in (own, keep, our))

    seconds = ", ".join(f"{run['refill_seconds']:.1f}" if run else "-" for run in (keep, our))
    return (
        three("supported", "{:.3f}"),
        three("bonded", "{:.3f}"),
        three("turns", "{:.0f}"),
        three("retractions", "{:.0f}"),
        three("paths", "{:.0f}"),
        three("bytes", "{:.1f}", 1e6),
        seconds,
    )


def _little_section(runs: Runs) -> str:
    """Return where keep gains little, with what explains it."""
    rows = []
    for case, own, same in pairs(runs, SAME):
        gain = saved(own, same)
        if gain >= LITTLE:
            continue
        sections = same["sections"]
        reasons = ", ".join(f"{number} {reason}" for reason, number in sections["kept"].items()) or "none"
        rows.append(
            (
                f"{case.slicer} {case.pattern}",
                case.part,
                f"{case.density:g}",
                case.printer,
                percent(-gain),
                f"{own['length'] / max(own['paths'], 1):.0f}",
                f"{own['turns'] / max(own['length'], 1) * 1000:.0f}",
                f"{own['seconds'] / own['whole']:.0%}",
                f"{sections['replaced']} of {sections['all']}",
                reasons,
            )
        )
    if not rows:
        return ""
    head = ("pattern", "part", "%", "printer", "equal filament", "mm a path", "turns a m", "infill's share", "refilled")
    return (
        "## Where little is gained, and why\n\n"
        f"All runs of `keep` at equal filament that save less than {LITTLE:.0%}. Two things explain them: straight "
        "patterns have few corners for their length (few turns a metre), and small or chopped regions are mostly ends, "
        "anchors along walls and travel (few mm a path), which rounding does not touch. Sections that would not gain "
        "are left as the slicer made them, with the reason.\n\n" + table((*head, "kept as they were"), rows)
    )


def _planners_section(runs: Runs) -> str:
    """Return the middle of what each mode saves by pattern, under three models of the firmware."""
    rows = []
    planners = ("seconds", "seconds_cruise", "seconds_jerk")
    for slicer, patterns in PATTERNS.items():
        for pattern in patterns:
            for printer in PRINTERS:
                cells = []
                for mode in (SAME, "ours"):
                    some = pairs(runs, mode, slicer=slicer, pattern=pattern, printer=printer)
                    cells += [
                        percent(-middle([saved(own, other, planner) for _, own, other in some])) if some else "-"
                        for planner in planners
                    ]
                if any(cell != "-" for cell in cells):
                    rows.append((f"{slicer} {pattern}", printer, *cells))
    head = ["pattern", "printer"]
    head += [f"{mode}, {planner}" for mode in ("keep", "ours") for planner in ("Klipper", "cruise ratio 0.5", "jerk 8")]
    return (
        "## The same under other planners\n\n"
        "Middle over parts and densities of the change of infill time, equal filament: by Klipper's rules as above, "
        "the same with its default minimum cruise ratio of 0.5, and with a jerk of 8 mm/s by axis as PrusaSlicer "
        "estimates. The last knows no limit to the speed on a curve cut into chords, so it flatters curves.\n\n"
        + table(head, rows)
    )
