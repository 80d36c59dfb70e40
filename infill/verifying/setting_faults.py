"""Settings of the machine that differ between two prints, as violations."""

from __future__ import annotations

import numpy as np

from infill.arrays import Places
from infill.verifying.machine_settings import differing_settings, kind_of_setting
from infill.verifying.trace import Trace
from infill.verifying.violations import ViolationList


def settings_codes(old: Trace, new: Trace) -> tuple[Places, Places]:
    """Return numbers for the settings of two prints that are equal where no setting differs."""
    numbers: dict[object, int] = {}
    codes = []
    for trace in (old, new):
        canonical = [frozenset(differing_settings((), settings)) for settings in trace.history.known]
        codes.append(np.array([numbers.setdefault(key, len(numbers)) for key in canonical], dtype=np.int64))
    return codes[0], codes[1]


def add_settings(
    found: ViolationList,
    old: Trace,
    new: Trace,
    numbers: tuple[Places, Places],
    rows: Places,
    old_lines: Places,
    only: str = "",
) -> None:
    """Add the differences between settings, by their numbers, at rows of the new print, ascending or not."""
    if not len(rows):
        return
    order = np.argsort(rows, kind="stable")
    was, now, rows, old_lines = numbers[0][order], numbers[1][order], rows[order], old_lines[order]
    combined = was * (len(new.history.known) + 1) + now
    pairs, inverse = np.unique(combined, return_inverse=True)
    known = list(old.history.known), list(new.history.known)
    places: dict[tuple[str, str], list[int]] = {}
    for number, pair in enumerate(pairs.tolist()):
        before, after = divmod(pair, len(new.history.known) + 1)
        for difference in differing_settings(known[0][before], known[1][after]):
            if not only or difference[0] == only:
                places.setdefault(difference, []).append(number)
    for (name, text), chosen in places.items():
        at = np.flatnonzero(np.isin(inverse, chosen))
        line = int(new.rows.line[rows[at[0]]])
        since = new.set_before(name, line)
        said = f"{text}, set at line {since}" if since else text
        found.add_runs(kind_of_setting(name), rows[at], lambda _, said=said: said, old_lines[at])  # type: ignore[misc]
