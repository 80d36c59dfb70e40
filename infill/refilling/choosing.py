"""Choose a pattern: our honeycomb where it prints faster than the slicer's own paths with round corners."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from infill.refilling.request import KEEP

if TYPE_CHECKING:
    from infill.reports.refilling import ChoiceKeys, RefillReport

FASTEST = "honeycomb"  # of the patterns that lie on themselves in every layer
FILAMENT_TOLERANCE = 0.01  # of the filament of the infill
LEAST_REPLACED = 0.9  # of the sections
PATTERNS = (FASTEST, KEEP)


def choose_pattern(report_on: Callable[[str], RefillReport]) -> tuple[str, ChoiceKeys | None]:
    """Choose between a new pattern and the slicer's own paths.

    Parameters
    ----------
    report_on : callable
        Returns the report of a dry run with a pattern.

    Returns
    -------
    pattern : str
    choice : dict or None
        Times of both in the report, and why; None if the print was refilled before and there is no choice.
    """
    reports = {pattern: report_on(pattern) for pattern in PATTERNS}
    if any("time" not in report for report in reports.values()):
        return KEEP, None
    reason = _objection(reports)
    seconds = {pattern: report["time"]["print_after_s"] for pattern, report in reports.items()}
    return KEEP if reason else FASTEST, {"seconds": seconds, "reason": reason or "it prints faster"}


def _objection(reports: Mapping[str, RefillReport]) -> str:
    """Say why the new pattern is not taken; "" if it is."""
    new, kept = reports[FASTEST], reports[KEEP]
    before, after = new["filament"]["infill_before_mm"], new["filament"]["infill_after_mm"]
    if not before or new["sections"]["replaced"] < LEAST_REPLACED * new["sections"]["all"]:
        return f"{FASTEST} fits in {new['sections']['replaced']} of {new['sections']['all']} sections"
    if abs(after / before - 1) > FILAMENT_TOLERANCE:
        return f"{FASTEST} would take {after / before - 1:+z.1%} filament of infill"
    if new["time"]["print_after_s"] >= kept["time"]["print_after_s"]:
        return f"{FASTEST} would be no faster"
    return ""
