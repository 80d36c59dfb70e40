"""What the new print lacks, or adds: layers, objects, beads, and shares of a layer too small to be seen on one bead."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Places
from infill.plain_numbers import count_noun, plain_argument
from infill.verifying.comparison import BeadComparison
from infill.verifying.tolerances import FILAMENT_STEP, PATH_TOLERANCE
from infill.verifying.trace import TraceRows
from infill.verifying.violations import RUN_GAP, ViolationList, describe_lengths

LAYER_SHARE: Final = 0.005  # of a layer's filament


def report_missing(comparison: BeadComparison, found: ViolationList) -> NDArray[np.bool_]:
    """Report layers, objects and beads that the new print lacks, and layers that it adds; return the missing rows."""
    gone = np.zeros(len(comparison.a), dtype=bool)
    gaps = comparison.gaps
    told = (comparison.skipped | comparison.bad)[gaps.old_gap]
    gone[gaps.old[(gaps.old_off > PATH_TOLERANCE) & ~told]] = True
    for low, high in comparison.alignment.missing:
        gone[low:high] |= comparison.a.draws[low:high]
    every = gone.copy()
    _report_missing_objects(comparison, found, gone)
    for low, high in _joined(comparison.alignment.missing):
        inside = np.arange(low, high)[gone[low:high]]
        if len(inside):
            _add_missing(
                comparison, found, inside, f"the beads of {_describe_heights(comparison.a, inside)} are missing"
            )
            gone[inside] = False
    rows = np.flatnonzero(gone)
    breaks = np.flatnonzero(np.diff(rows) > RUN_GAP) + 1
    for run in np.split(rows, breaks) if len(rows) else []:
        length = float(comparison.a.length[run].sum())
        if length <= PATH_TOLERANCE:  # a point of a bead, which an arc passes by
            continue
        _add_missing(
            comparison, found, run, f"{count_noun(len(run), 'bead')} of {length:.1f} mm, missing before this line"
        )
    for low, high in _joined(comparison.alignment.added):
        inside = np.arange(low, high)[comparison.b.draws[low:high]]
        if len(inside):
            text = f"the beads of {_describe_heights(comparison.b, inside)} are new"
            found.add_runs("added", comparison.new_rows[inside], lambda _, text=text: text)  # type: ignore[misc]
    return every


def _report_missing_objects(comparison: BeadComparison, found: ViolationList, gone: NDArray[np.bool_]) -> None:
    """Report objects of which no bead is left, in place of their beads."""
    draws = np.flatnonzero(comparison.a.draws)
    count = len(comparison.old.objects)
    beads = np.bincount(comparison.a.thing[draws], minlength=count)
    lost = np.bincount(comparison.a.thing[draws], weights=gone[draws], minlength=count)
    if count < 2:
        return
    for thing in np.flatnonzero((beads > 0) & (lost == beads)).tolist():
        rows = draws[comparison.a.thing[draws] == thing]
        name = comparison.old.objects[thing]
        if name:
            _add_missing(comparison, found, rows, f"the object {name!r} is missing")
            gone[rows] = False


def _add_missing(comparison: BeadComparison, found: ViolationList, rows: Places, text: str) -> None:
    """Add what is missing, at the line of the new print before which it was printed."""
    old_lines = np.unique(comparison.a.line[rows])
    line = comparison.new_line_after(int(rows[0]))
    found.add_line("missing", line, text, lines=len(old_lines), last_line=line, old_line=int(old_lines[0]))


def compare_layer_sums(comparison: BeadComparison, found: ViolationList, gone: NDArray[np.bool_]) -> None:
    """Compare the filament of whole layers, where nothing else differs: a share too small to be seen on one bead."""
    a, b = comparison.a, comparison.b
    if not len(a) or not len(b):
        return
    layers_a, layers_b = a.layer, b.layer
    if comparison.old.layers != comparison.new.layers:  # then the print is one layer
        layers_a, layers_b = np.zeros_like(a.layer), np.zeros_like(b.layer)
    count = max(int(layers_a.max()), int(layers_b.max())) + 1
    was, now, beads = (
        np.bincount(layers[rows.draws], weights=weights[rows.draws], minlength=count)
        for layers, rows, weights in (
            (layers_a, a, a.filament),
            (layers_b, b, b.filament),
            (layers_a, a, np.ones(len(a))),
        )
    )
    known = np.zeros(count, dtype=bool)
    known[layers_a[gone]] = True
    known[layers_b[found.faulty[comparison.new_rows]]] = True
    for trace, lines, levels in ((comparison.old, a.line, layers_a), (comparison.new, b.line, layers_b)):
        unread = np.searchsorted(lines, [line for line, _ in trace.unread])
        known[levels[np.minimum(unread, len(levels) - 1)]] = True
    wrong = np.abs(now - was) > LAYER_SHARE * was + 4 * FILAMENT_STEP * np.sqrt(beads)
    layers = np.flatnonzero(wrong & ~known)
    first = np.minimum(np.searchsorted(layers_b, layers), len(b) - 1)
    for layer, row in zip(layers.tolist(), first.tolist(), strict=True):
        text = describe_lengths(now[layer], was[layer], "of filament in the layer")
        found.add_line("material", int(b.line[row]), text)


def _joined(ranges: tuple[tuple[int, int], ...]) -> list[tuple[int, int]]:
    """Join ranges of which one begins where the other ends."""
    joined: list[tuple[int, int]] = []
    for low, high in ranges:
        if joined and joined[-1][1] == low:
            joined[-1] = (joined[-1][0], high)
        else:
            joined.append((low, high))
    return joined


def _describe_heights(rows: TraceRows, inside: Places) -> str:
    """Name the layers of some beads by their heights."""
    heights = np.unique(np.round(rows.end[inside, 2], 3))
    if len(heights) == 1:
        return f"the layer at z {plain_argument(heights[0])} mm"
    return f"{len(heights)} layers from z {plain_argument(heights[0])} to {plain_argument(heights[-1])} mm"
