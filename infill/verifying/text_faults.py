"""Faults of lines on their own: F0, words that are not numbers, lines that cannot be read, commands lost or added."""

from __future__ import annotations

from collections import Counter
from typing import Final

import numpy as np

from infill.files.excerpts import excerpt
from infill.verifying.comparison import BeadComparison
from infill.verifying.machine_settings import differing_settings, kind_of_setting
from infill.verifying.trace import Trace
from infill.verifying.violations import ViolationList

AT_THE_END: Final = ("temperature", "fan")  # settings that outlast a print


def check_lines(old: Trace, new: Trace, found: ViolationList) -> int:
    """Add the faults of single lines; return the number of unreadable lines that both prints have."""
    numbers = {line for line, _ in new.not_numbers}
    for line, text in _added_lines(old.zero_feeds, new.zero_feeds):
        found.add_line("F0", line, f"the feed rate is 0 or less: {excerpt(text)}")
    for line, text in _added_lines(old.not_numbers, new.not_numbers):
        found.add_line("number", line, f"a word is not a number: {excerpt(text)}")
    fresh = _added_lines(old.unread, new.unread)
    for line, text in fresh:
        if line not in numbers:
            found.add_line("unreadable", line, f"may move or extrude and cannot be read: {excerpt(text)}")
    return len(new.unread) - len(fresh)


def _added_lines(old: tuple[tuple[int, str], ...], new: tuple[tuple[int, str], ...]) -> list[tuple[int, str]]:
    """Return the lines of the new print that are more than the equal lines of the old one."""
    known = Counter(text for _, text in old)
    added = []
    for line, text in new:
        if known[text] > 0:
            known[text] -= 1
        else:
            added.append((line, text))
    return added


def check_commands(comparison: BeadComparison, found: ViolationList) -> None:
    """Add commands that are missing or new, such as macros, pauses and homing, and heaters left on at the end."""
    old, new = comparison.old, comparison.new
    by_layer = old.layers == new.layers
    counts = []
    for trace in (old, new):
        lines = np.array([line for line, _ in trace.history.others], dtype=np.int64)
        place = np.minimum(np.searchsorted(trace.rows.line, lines), len(trace.rows) - 1)
        layers = trace.rows.layer[place] if by_layer else np.zeros(len(lines), dtype=np.int64)
        places: dict[tuple[int, str], list[int]] = {}
        for layer, (line, text) in zip(layers.tolist(), trace.history.others, strict=True):
            places.setdefault((layer, text), []).append(line)
        counts.append(places)
    for key, lines_of in counts[1].items():
        more = len(lines_of) - len(counts[0].get(key, []))
        if more > 0:
            found.add_line("command", lines_of[-more], f"{excerpt(key[1])} is new", lines=more, last_line=lines_of[-1])
    for key, lines_of in counts[0].items():
        less = len(lines_of) - len(counts[1].get(key, []))
        if less > 0:
            row = int(np.searchsorted(comparison.a.line, lines_of[-less]))
            line = comparison.new_line_after(row)
            found.add_line(
                "command", line, f"{excerpt(key[1])} is missing", lines=less, last_line=line, old_line=lines_of[-less]
            )
    known = list(old.history.known), list(new.history.known)
    reported = {violation.text.partition(", set at")[0] for violation in found.violations}
    for name, text in differing_settings(known[0][old.history.numbers[-1]], known[1][new.history.numbers[-1]]):
        kind = kind_of_setting(name)
        if kind in AT_THE_END and text not in reported:
            found.add_line(kind, new.lines, f"at the end, {text}", old_line=old.lines)
