"""The promises that the slicer report judges, and the sums over parts that it judges them by."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from benchmarks.slicer_cases import Case, case_of

SAME = "keep at equal filament"
KEPT = 0.94  # of the slicer's own support and contact, at least
WIDE = 10  # cells across
LINE = 0.45  # mm
Runs = dict[str, dict[str, Any]]
Pair = tuple[Case, dict[str, Any], dict[str, Any]]  # the slicer's own, and a mode


def pairs(runs: Runs, mode: str, **chosen: object) -> list[Pair]:
    """Return the cases that have a mode: with the slicer's own numbers and the mode's.

    Parameters
    ----------
    runs : dict
        Modes by name, by key of the case.
    mode : str
    **chosen : object
        Fields of the case that it must have: pattern="gyroid", printer="fast".
    """
    found = []
    for key, modes in runs.items():
        case = case_of(key)
        own, other = modes.get("slicer"), modes.get(mode)
        if any(getattr(case, name) != value for name, value in chosen.items()):
            continue
        if own and other and "error" not in own and "error" not in other:
            found.append((case, own, other))
    return found


def saved(own: dict[str, Any], other: dict[str, Any], planner: str = "seconds") -> float:
    """Return by what share the infill takes less time; less than 0 if it takes more."""
    return 1 - float(other[planner]) / float(own[planner])


def kept(own: dict[str, Any], other: dict[str, Any]) -> float:
    """Return the lesser of support and contact, over the slicer's own; contact only where the slicer has some.

    >>> kept({"supported": 0.9, "bonded": 0.0}, {"supported": 0.9, "bonded": 0.1})
    1.0
    """
    found = [other["supported"] / own["supported"]] if own["supported"] else []
    if own["bonded"] > 0.05:  # less is lines that happen to pass
        found.append(other["bonded"] / own["bonded"])
    return float(min(found, default=1.0))


def filament(own: dict[str, Any], other: dict[str, Any]) -> float:
    """Return the infill's filament over the slicer's own, less 1."""
    return float(other["filament"] / own["filament"] - 1)


def turns(own: dict[str, Any], other: dict[str, Any]) -> float:
    """Return the turns over 30 degrees over the slicer's own."""
    return float(other["turns"] / own["turns"]) if own["turns"] else 0.0


def middle(values: Sequence[float]) -> float:
    return float(statistics.median(values))


@dataclass(frozen=True, kw_only=True)
class Promise:
    """A line of what must hold.

    Parameters
    ----------
    text : str
        What is promised.
    limit : str
        The figure, as a reader sees it.
    mode : str
    chosen : dict
        Fields of the cases that it is about.
    measure : callable
        The number of one case.
    collect : callable
        One number of all.
    reached : callable
        Whether that number is good enough.
    show : callable
        The number, as a reader sees it.
    wide : bool
        Only of cases whose regions are wider than `WIDE` cells.
    """

    text: str
    limit: str
    mode: str
    chosen: dict[str, str]
    measure: Callable[[dict[str, Any], dict[str, Any]], float]
    collect: Callable[[Sequence[float]], float]
    reached: Callable[[float], bool]
    show: str = "{:.1%}"
    wide: bool = False

    def judged(self, runs: Runs, widths: dict[str, float]) -> tuple[float, list[float]] | None:
        """Return the one number and those of the cases, or None without any.

        A middle is one over parts, so that a part of which many cases were run counts no more than another.
        """
        by_part: dict[str, list[float]] = {}
        for case, own, other in pairs(runs, self.mode, **self.chosen):
            if not self.wide or is_wide(widths, case):
                by_part.setdefault(case.part, []).append(self.measure(own, other))
        values = [value for part in by_part.values() for value in part]
        if not values:
            return None
        return self.collect([middle(part) for part in by_part.values()] if self.collect is middle else values), values

    def of_wide(self) -> Promise:
        """Return the same promise for parts whose regions are wide."""
        return replace(self, text=f"{self.text}, regions wider than {WIDE} cells", wide=True)


def at_least(share: float) -> dict[str, Any]:
    """Return the fields of a promise that a share is reached.

    >>> fields = at_least(0.08)
    >>> fields["limit"], fields["reached"](0.081), fields["reached"](0.079)
    ('at least 8 %', True, False)
    """
    return {"limit": f"at least {100 * share:.0f} %", "reached": lambda value: value >= share}


def promises() -> list[Promise]:
    """Return all promises that are judged on single cases."""
    found = []
    for pattern, printer, least, least_wide in (
        ("honeycomb", "normal", 0.08, 0.12),
        ("honeycomb", "fast", 0.06, 0.10),
        ("3dhoneycomb", "normal", 0.18, 0.18),
        ("3dhoneycomb", "fast", 0.18, 0.18),
        ("hilbertcurve", "normal", 0.10, 0.10),
        ("hilbertcurve", "fast", 0.10, 0.10),
        ("gyroid", "normal", 0.12, 0.12),
        ("gyroid", "fast", 0.40, 0.40),
    ):
        promise = Promise(
            text=f"keep, {pattern}, {printer} printer, equal filament: infill time saved, middle over parts",
            mode=SAME,
            chosen={"slicer": "prusa", "pattern": pattern, "printer": printer},
            measure=saved,
            collect=middle,
            **at_least(least),
        )
        found += [promise, replace(promise.of_wide(), **at_least(least_wide))]
    for pattern in ("honeycomb", "3dhoneycomb", "hilbertcurve", "gyroid"):
        found.append(
            Promise(
                text=f"keep, {pattern}: turns over 30°, over the slicer's own, middle over parts",
                limit="at most a third",
                mode=SAME,
                chosen={"slicer": "prusa", "pattern": pattern},
                measure=turns,
                collect=middle,
                reached=lambda value: value <= 1 / 3,
                show="{:.2f}",
            )
        )
        found.append(
            Promise(
                text=f"keep, {pattern}: support and contact, the lesser, over the slicer's own, least of all runs",
                limit=f"at least {KEPT}",
                mode="keep",
                chosen={"slicer": "prusa", "pattern": pattern},
                measure=kept,
                collect=min,
                reached=lambda value: value >= KEPT,
                show="{:.3f}",
            )
        )
    for mode, sliced in (("keep", "same slicing"), (SAME, "equal filament")):
        found.append(
            Promise(
                text=f"keep, every pattern: time over the slicer's own, {sliced}, slowest of all runs",
                limit="at most 1 % more",
                mode=mode,
                chosen={},
                measure=lambda own, other: -saved(own, other),
                collect=max,
                reached=lambda value: value <= 0.01,
                show="{:+.1%}",
            )
        )
    for mode, what in ((SAME, "keep, density solved again"), ("ours", "ours, every pattern")):
        found.append(
            Promise(
                text=f"{what}: filament off the slicer's own, farthest of all runs",
                limit="within 1 %",
                mode=mode,
                chosen={},
                measure=lambda own, other: abs(filament(own, other)),
                collect=max,
                reached=lambda value: value <= 0.01,
            )
        )
    honeycomb = {"slicer": "prusa", "pattern": "honeycomb"}
    found += [
        Promise(
            text="our honeycomb: infill time under the slicer's honeycomb, middle over parts",
            limit="at least 17 %",
            mode="ours",
            chosen=honeycomb,
            measure=saved,
            collect=middle,
            reached=lambda value: value >= 0.17,
        ),
        Promise(
            text="our honeycomb: share supported, least of all runs",
            limit="at least 0.99",
            mode="ours",
            chosen=honeycomb,
            measure=lambda _, other: float(other["supported"]),
            collect=min,
            reached=lambda value: value >= 0.99,
            show="{:.3f}",
        ),
        Promise(
            text="our honeycomb: retractions over the slicer's own, most of all runs",
            limit="no more",
            mode="ours",
            chosen=honeycomb,
            measure=lambda own, other: float(other["retractions"] / max(own["retractions"], 1)),
            collect=max,
            reached=lambda value: value <= 1,
            show="{:.2f}",
        ),
    ]
    return found + [promise.of_wide() for promise in found[-3:]]


def against_keep(runs: Runs, pattern: str) -> list[tuple[Case, float]]:
    """Return the time of ours over that of keep, both with the slicer's filament, less 1, case by case."""
    kept_runs = {case: other for case, _, other in pairs(runs, SAME, slicer="prusa", pattern=pattern)}
    return [
        (case, ours["seconds"] / kept_runs[case]["seconds"] - 1)
        for case, _, ours in pairs(runs, "ours", slicer="prusa", pattern=pattern)
        if case in kept_runs
    ]


def is_wide(widths: dict[str, float], case: Case) -> bool:
    """Return whether the regions of a case are as wide as promises take them to be."""
    return cells_across(widths, case) >= WIDE


def cells_across(widths: dict[str, float], case: Case) -> float:
    """Return how many lines of infill the largest circle in a part's section holds across.

    >>> round(cells_across({"box": 60.0}, Case("prusa", "gyroid", "box", 15.0, "fast")))
    20
    """
    return widths.get(case.part, 0.0) * case.density / 100 / LINE
