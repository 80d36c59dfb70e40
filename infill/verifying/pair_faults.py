"""Faults of moves that both prints have: place, height, filament, retraction, speed, settings."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.plain_numbers import plain_argument
from infill.verifying.alignment import distances
from infill.verifying.comparison import BeadComparison
from infill.verifying.machine_settings import FIRMWARE
from infill.verifying.setting_faults import add_settings
from infill.verifying.tolerances import (
    DEPTH_TOLERANCE,
    FILAMENT_SHARE,
    FILAMENT_STEP,
    HEIGHT_TOLERANCE,
    PATH_TOLERANCE,
    SPEED_STEP,
    UNIT,
)
from infill.verifying.violations import ViolationList, describe_lengths, describe_place, describe_speeds

JUMP_RATIO, JUMP_LENGTH = 3.0, 0.05  # of the old filament, and mm more than that: an E jump


def report_pairs(comparison: BeadComparison, speed_limit: float, found: ViolationList) -> None:
    """Add the violations of moves in pairs."""
    _compare_places(comparison, found)
    _compare_filament(comparison, found)
    _compare_retraction(comparison, found)
    _compare_arrivals(comparison, found)
    _compare_speeds(comparison, speed_limit, found)
    _compare_settings(comparison, found)


def _add_runs(
    comparison: BeadComparison,
    found: ViolationList,
    kind: str,
    chosen: NDArray[np.bool_],
    describe: Callable[[int], str],
    lines: Places | None = None,
) -> None:
    """Add faults of pairs, in the order of the new print; `describe` returns the text for a pair."""
    pairs = np.flatnonzero(chosen)
    pairs = pairs[np.argsort(comparison.second[pairs], kind="stable")]
    found.add_runs(
        kind,
        comparison.new_rows[comparison.second[pairs]],
        lambda place: describe(int(pairs[place])),
        comparison.a.line[comparison.first[pairs]],
        None if lines is None else lines[pairs],
    )


def _compare_places(comparison: BeadComparison, found: ViolationList) -> None:
    """Compare x, y and z of the beads in pairs."""
    a, b = comparison.a.at(comparison.first), comparison.b.at(comparison.second)
    in_order = np.arange(len(a)) < len(comparison.alignment.old)
    off = np.maximum(distances(a.start[:, :2], b.start[:, :2]), distances(a.end[:, :2], b.end[:, :2]))
    both = comparison.both_draw
    _add_runs(
        comparison,
        found,
        "place",
        both & in_order & (off > PATH_TOLERANCE),
        lambda k: f"{describe_place(b.end[k])}, was {describe_place(a.end[k])}",
    )
    rise = np.abs(a.end[:, 2] - b.end[:, 2])
    rise = np.where(np.isnan(a.end[:, 2]) & np.isnan(b.end[:, 2]), 0.0, np.nan_to_num(rise, nan=np.inf))
    _add_runs(
        comparison,
        found,
        "height",
        both & (rise > HEIGHT_TOLERANCE),
        lambda k: f"z {plain_argument(round(b.end[k, 2], 4))} mm, was {plain_argument(round(a.end[k, 2], 4))} mm",
    )


def _compare_filament(comparison: BeadComparison, found: ViolationList) -> None:
    """Compare the filament of pairs, and what is pushed in one place before them."""
    was, slack = _expected_filament(comparison)
    now = comparison.b.filament[comparison.second]
    draws = comparison.a.draws[comparison.first] | comparison.b.draws[comparison.second]
    jump = (now > JUMP_RATIO * np.maximum(was, 0.0) + JUMP_LENGTH) | (
        comparison.a.draws[comparison.first] & (now < -JUMP_LENGTH)
    )
    wrong = np.abs(now - was) > FILAMENT_SHARE * np.abs(was) + FILAMENT_STEP + slack

    def describe_filament(k: int) -> str:
        """Describe the filament of a pair, new and old."""
        return describe_lengths(now[k], was[k], "of filament")

    _add_runs(comparison, found, "E jump", draws & jump, describe_filament)
    after_jump = np.zeros(len(comparison.b) + 1, dtype=bool)
    after_jump[comparison.second[draws & jump] + 1] = True  # where E is absolute, the next line takes it back
    _add_runs(comparison, found, "material", draws & wrong & ~jump & ~after_jump[comparison.second], describe_filament)
    retracts = ~draws & _begins_alike(comparison) & (np.abs(now - was) > DEPTH_TOLERANCE)
    _add_runs(comparison, found, "retraction", retracts, describe_filament)
    blob_was, blob = comparison.a.blob[comparison.first], comparison.b.blob[comparison.second]
    for kind, chosen in (
        ("E jump", blob > blob_was + DEPTH_TOLERANCE),
        ("material", blob < blob_was - DEPTH_TOLERANCE),
    ):
        _add_runs(
            comparison,
            found,
            kind,
            chosen,
            lambda k: describe_lengths(blob[k], blob_was[k], "pushed in one place beyond what was retracted"),
            comparison.b.blob_line[comparison.second] if kind == "E jump" else None,
        )


def _begins_alike(comparison: BeadComparison) -> NDArray[np.bool_]:
    """Return True for pairs that begin at the same point: an arc of a wipe begins before the last of its lines."""
    a, b = comparison.a.start[comparison.first, :2], comparison.b.start[comparison.second, :2]
    return np.asarray(distances(a, b) <= 1.5 * UNIT)


def _expected_filament(comparison: BeadComparison) -> tuple[Floats, Floats]:
    """Return the filament of the old moves in pairs, and a slack where ends differ within the tolerance.

    Points of an arc do not lie where the ends of its lines lay: there the filament is in proportion to the length, and
    its slack is that of the distance between the ends.
    """
    a, b = comparison.a.at(comparison.first), comparison.b.at(comparison.second)
    shift = np.maximum(distances(a.start[:, :2], b.start[:, :2]), distances(a.end[:, :2], b.end[:, :2]))
    loose = (shift > 1.5 * UNIT) & (shift <= PATH_TOLERANCE) & comparison.both_draw
    with np.errstate(divide="ignore", invalid="ignore"):
        expected = np.where(loose, a.filament * b.length / a.length, a.filament)
        return expected, np.where(loose, 2 * shift * a.filament / a.length, 0.0)


def _compare_retraction(comparison: BeadComparison, found: ViolationList) -> None:
    """Compare the filament that is retracted when moves begin."""
    was, now = comparison.a.retracted[comparison.first], comparison.b.retracted[comparison.second]
    _add_runs(
        comparison,
        found,
        "retraction",
        (np.abs(now - was) > DEPTH_TOLERANCE) & (comparison.both_draw | _begins_alike(comparison)),
        lambda k: describe_lengths(now[k], was[k], "retracted"),
    )


def _compare_arrivals(comparison: BeadComparison, found: ViolationList) -> None:
    """Compare the retraction on travels from features that may change to beads that may not."""
    old, new = comparison.old.rows, comparison.new.rows
    before = comparison.old_rows[comparison.first] - 1, comparison.new_rows[comparison.second] - 1
    compared = np.zeros(len(new), dtype=bool)
    compared[comparison.new_rows] = True
    arrives = comparison.both_draw & (before[0] >= 0) & (before[1] >= 0)
    arrives &= ~compared[before[1]] & ~old.draws[before[0]] & ~new.draws[before[1]]
    pairs = np.flatnonzero(arrives)
    pairs = pairs[np.argsort(before[1][pairs])]
    first, second = before[0][pairs], before[1][pairs]
    was, now = old.retracted[first], new.retracted[second]
    off = np.flatnonzero(np.abs(now - was) > DEPTH_TOLERANCE)
    found.add_runs(
        "retraction",
        second[off],
        lambda k: describe_lengths(now[off[k]], was[off[k]], "retracted"),
        old.line[first[off]],
    )
    numbers = comparison.old.settings_at(old.line[first]), comparison.new.settings_at(new.line[second])
    add_settings(found, comparison.old, comparison.new, numbers, second, old.line[first], only=FIRMWARE)


def _compare_speeds(comparison: BeadComparison, speed_limit: float, found: ViolationList) -> None:
    """Compare the feed rates of beads."""
    was, now = comparison.a.feed[comparison.first], comparison.b.feed[comparison.second]
    with np.errstate(invalid="ignore"):
        faster = comparison.both_draw & (now > was * (1 + speed_limit) + SPEED_STEP)
    _add_runs(comparison, found, "speed", faster, lambda k: describe_speeds(now[k], was[k]))


def _compare_settings(comparison: BeadComparison, found: ViolationList) -> None:
    """Compare what the commands have set, at beads, and firmware retraction at travels too."""
    draws = comparison.both_draw
    was = comparison.old.settings_at(comparison.a.line[comparison.first])
    now = comparison.new.settings_at(comparison.b.line[comparison.second])
    add_settings(
        found,
        comparison.old,
        comparison.new,
        (was[draws], now[draws]),
        comparison.new_rows[comparison.second[draws]],
        comparison.a.line[comparison.first[draws]],
    )
    add_settings(
        found,
        comparison.old,
        comparison.new,
        (was[~draws], now[~draws]),
        comparison.new_rows[comparison.second[~draws]],
        comparison.a.line[comparison.first[~draws]],
        only=FIRMWARE,
    )
