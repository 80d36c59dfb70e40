"""Features that the post-processor was meant to change: what it may still not do there.

Their paths are free. Yet the machine must be in a state that the old print had there, at a height of the layer, within
what the old print covered there, with no more filament per mm, and no faster.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Final

import numpy as np

from infill.arrays import Floats, Places
from infill.plain_numbers import plain_argument
from infill.verifying.comparison import is_changed
from infill.verifying.setting_faults import add_settings
from infill.verifying.tolerances import DEPTH_TOLERANCE, HEIGHT_TOLERANCE, SPEED_STEP
from infill.verifying.trace import Trace
from infill.verifying.violations import ViolationList, describe_lengths, describe_speeds

HEIGHT_UNIT: Final = 2 * HEIGHT_TOLERANCE  # mm
MARGIN: Final = 1.0  # mm around the beads of a layer within which new paths may lie
RATE_RATIO: Final = 3.0  # of the greatest filament per mm in the old print: an E jump
LEAST_JUMP: Final = 0.05  # mm of filament


def check_changed_features(
    old: Trace, new: Trace, changed: Collection[str], speed_limit: float, found: ViolationList
) -> None:
    """Add the violations of beads of the features in `changed`."""
    mine = np.flatnonzero(is_changed(new, changed))
    theirs = np.flatnonzero(is_changed(old, changed) & old.rows.draws)
    beads = mine[new.rows.draws[mine]]
    if not len(beads) or not len(theirs):
        return
    _check_places(old, new, beads, found)
    _check_heights(old, new, beads, theirs, found)
    _check_filament(old, new, mine, np.flatnonzero(is_changed(old, changed)), found)
    levels = _levels(old, new)
    fastest = _greatest_by_layer(levels[0][theirs], old.rows.feed[theirs])
    limit = _by_layer(fastest, levels[1][beads], float(np.nanmax(old.rows.feed[theirs])))
    now = new.rows.feed[beads]
    faster = np.flatnonzero(now > limit * (1 + speed_limit) + SPEED_STEP)
    found.add_runs("speed", beads[faster], lambda k: describe_speeds(now[faster[k]], limit[faster[k]]))
    _check_settings(old, new, beads, theirs, found)


def _levels(old: Trace, new: Trace) -> tuple[Places, Places]:
    """Return a number for the layer of each row of both prints: by tags or, where these differ in number, by height."""
    if old.layers == new.layers:
        return old.rows.layer, new.rows.layer
    heights = [np.rint(np.nan_to_num(trace.rows.end[:, 2]) / HEIGHT_UNIT).astype(np.int64) for trace in (old, new)]
    return heights[0], heights[1]


def _greatest_by_layer(levels: Places, values: Floats) -> dict[int, float]:
    """Return the greatest of some values in each layer."""
    layers, number = np.unique(levels, return_inverse=True)
    greatest = np.full(len(layers), -np.inf)
    np.maximum.at(greatest, number, np.nan_to_num(values, nan=-np.inf))
    return dict(zip(layers.tolist(), greatest.tolist(), strict=True))


def _by_layer(values: dict[int, float], layers: Places, otherwise: float) -> Floats:
    """Return the value of each layer, or a default."""
    levels, number = np.unique(layers, return_inverse=True)
    return np.array([values.get(level, otherwise) for level in levels.tolist()])[number]


def _check_places(old: Trace, new: Trace, beads: Places, found: ViolationList) -> None:
    """Report new beads outside what the old print covers in their layer."""
    draws = np.flatnonzero(old.rows.draws)
    outside = np.zeros(len(beads), dtype=bool)
    levels = _levels(old, new)
    for axis in (0, 1):
        for sign in (1.0, -1.0):
            ends = sign * np.fmax(sign * old.rows.start[draws, axis], sign * old.rows.end[draws, axis])
            edges = _greatest_by_layer(levels[0][draws], sign * ends)
            edge = _by_layer(edges, levels[1][beads], float(np.nanmax(sign * ends)))
            outside |= sign * new.rows.end[beads, axis] > edge + MARGIN
    rows = beads[outside]
    found.add_runs(
        "place",
        rows,
        lambda k: (
            f"x {plain_argument(round(new.rows.end[rows[k], 0], 3))}, "
            f"y {plain_argument(round(new.rows.end[rows[k], 1], 3))} mm, outside of the layer in the old print"
        ),
    )


def _check_heights(old: Trace, new: Trace, beads: Places, theirs: Places, found: ViolationList) -> None:
    """Report new beads at a height that the feature has nowhere in the layer of the old print."""
    layers = (old.rows.layer, new.rows.layer) if old.layers == new.layers else (old.rows.layer * 0, new.rows.layer * 0)
    z_old, z_new = (
        np.rint(np.nan_to_num(trace.rows.end[rows, 2]) / HEIGHT_UNIT) for trace, rows in ((old, theirs), (new, beads))
    )
    known = set(zip(layers[0][theirs].tolist(), z_old.tolist(), strict=True))
    tagged = {layer for layer, _ in known}
    pairs, inverse = np.unique(np.column_stack([layers[1][beads], z_new]), axis=0, return_inverse=True)
    wrong = [
        layer in tagged and not any((layer, z + step) in known for step in (-1, 0, 1)) for layer, z in pairs.tolist()
    ]
    rows = beads[np.array(wrong, dtype=bool)[inverse.ravel()]]
    heights = old.rows.end[theirs, 2]

    def describe_height(k: int) -> str:
        """Describe the height of a bead, and the nearest old one."""
        z = new.rows.end[rows[k], 2]
        mine = heights[layers[0][theirs] == layers[1][rows[k]]]
        nearest = float(mine[np.argmin(np.abs(mine - z))])
        return f"z {plain_argument(round(z, 4))} mm, was {plain_argument(round(nearest, 4))} mm"

    found.add_runs("height", rows, describe_height)


def _check_filament(old: Trace, new: Trace, mine: Places, theirs: Places, found: ViolationList) -> None:
    """Report beads with far too much filament per mm, blobs, and retraction where the old print has none."""
    a, b = old.rows.at(theirs), new.rows.at(mine)
    draws = a.draws & (a.length > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        greatest = float(np.percentile((a.filament / a.length)[draws], 99)) if draws.any() else np.inf
        rate = np.where(b.draws, b.filament / np.maximum(b.length, 1e-9), 0.0)
    jump = np.flatnonzero((rate > RATE_RATIO * greatest) & (b.filament > LEAST_JUMP))
    found.add_runs(
        "E jump",
        mine[jump],
        lambda k: (
            f"{plain_argument(round(float(b.filament[jump[k]]), 4))} mm of filament on "
            f"{plain_argument(round(float(b.length[jump[k]]), 3))} mm, at most {greatest:.4f} per mm before"
        ),
    )
    deepest = -float(np.minimum(a.filament, 0.0).min(initial=0.0))
    back = np.flatnonzero(-b.filament > deepest + LEAST_JUMP)
    found.add_runs(
        "E jump",
        mine[back],
        lambda k: f"{plain_argument(round(float(b.filament[back[k]]), 4))} mm of filament on a move",
    )
    blob = np.flatnonzero(b.blob > float(a.blob.max(initial=0.0)) + DEPTH_TOLERANCE)
    found.add_runs(
        "E jump",
        mine[blob],
        lambda k: describe_lengths(b.blob[blob[k]], 0.0, "pushed in one place beyond what was retracted"),
        lines=b.blob_line[blob],
    )
    allowed = float(a.retracted[a.draws].max(initial=0.0))
    deep = np.flatnonzero(b.draws & (b.retracted > allowed + DEPTH_TOLERANCE))
    found.add_runs("retraction", mine[deep], lambda k: describe_lengths(b.retracted[deep[k]], allowed, "retracted"))


def _check_settings(old: Trace, new: Trace, beads: Places, theirs: Places, found: ViolationList) -> None:
    """Compare the settings at new beads with those that the old print has in the same feature and layer."""
    was, now = old.settings_at(old.rows.line[theirs]), new.settings_at(new.rows.line[beads])
    known = [[frozenset(settings) for settings in trace.history.known] for trace in (old, new)]
    layers: dict[int, set[int]] = {}
    levels = _levels(old, new)
    stacked = np.unique(np.column_stack([levels[0][theirs], was]), axis=0)
    for layer, number in stacked.tolist():
        layers.setdefault(layer, set()).add(number)
    everywhere = set(was.tolist())
    pairs, inverse = np.unique(np.column_stack([levels[1][beads], now]), axis=0, return_inverse=True)
    nearest = []
    for layer, number in pairs.tolist():
        choices = sorted(layers.get(layer, everywhere))
        nearest.append(min(choices, key=lambda choice: len(known[0][choice] ^ known[1][number])))
    add_settings(
        found,
        old,
        new,
        (np.array(nearest, dtype=np.int64)[inverse.ravel()], now),
        beads,
        np.zeros(len(beads), dtype=np.int64),
    )
