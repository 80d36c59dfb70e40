"""The layer of a block that is drawn once and extruded, judged; and options that would keep its walls."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from infill.errors import ParameterError
from infill.inspection.changes import TopologyChanges
from infill.inspection.layers import LayerInspection, inspect_smoothing
from infill.inspection.width import WallWidth, wall_width
from infill.making.request import DEFAULT_CELLS, Block, plan_block
from infill.options.resolve_pattern import with_parameters
from infill.phasefield.methods import smooth
from infill.plain_numbers import count_noun, plain_argument
from infill.voxels.stamping import stamp_layer
from patterns import Pattern, PatternError, parameter_values
from patterns.linework import body_numbers, sample_points

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely import MultiLineString

MIN_WIDTH_SHARE = 0.6  # of the requested width, at the 5th percentile; below this, a wall counts as lost
MAX_PINHOLE_SHARE = 0.02  # of the void in holes; acute angles alone do not explain more than this
POINTS_PER_CELL = 2  # neighbouring stamps overlap
MOST_TRIED = 4_000_000  # cells of a grid on which a remedy is tried: half a second
LARGER_CELLS = 1.5, 2.0, 3.0  # times as large, as remedies


@dataclass(frozen=True, kw_only=True, eq=False)
class JudgedLayer:
    """The verdict on the layer of a block.

    Parameters
    ----------
    inspection : LayerInspection
        How components and holes changed.
    width : WallWidth
        Of the smoothed walls, mm.
    problems : list of str
        Losses of a print, one phrase each.
    """

    inspection: LayerInspection
    width: WallWidth
    problems: list[str]


def sample_block(block: Block) -> NDArray[np.float64]:
    """Return points along the lines: from the pattern if it overrides `points`, else from the cached lines."""
    spacing = min(block.grid.cell_size) / POINTS_PER_CELL
    has_points = type(block.pattern).points is not Pattern.points
    return block.pattern.points(block.region, spacing) if has_points else sample_points(block.lines, spacing)


def stamp_block(block: Block, points: NDArray[np.float64]) -> NDArray[np.float32]:
    """Stamp the lines of a block on its grid; return the layer (nx, ny) in [-1, 1]."""
    return stamp_layer(block.lines, points, block.grid, method=block.stamp, block=block.cells, width=block.line_width)


def judge_layer(block: Block, stamped: NDArray[np.float32], smoothed: NDArray[np.floating]) -> JudgedLayer:
    """Compare the layer of a block with its stamp and with its lines."""
    inspection = inspect_smoothing(stamped, smoothed, line_cells=block.cells)
    width = wall_width(block.lines, smoothed, block.grid, requested=block.line_width)
    fused_lines = _count_fused_lines(block.lines, inspection.before.components, block.line_width)
    return JudgedLayer(
        inspection=inspection, width=width, problems=list(_problems(inspection.changes, width, fused_lines))
    )


def suggest_remedies(block: Block) -> str:
    """Return advice for a block with problems: the first options with which its layer has none, tried here."""
    for words, changed in _changed_blocks(block):
        if changed.grid.cells > MOST_TRIED:
            continue
        stamped = stamp_block(changed, sample_block(changed))
        smoothed = smooth(stamped, changed.smoothing, spacing=changed.grid.spacing)
        if not judge_layer(changed, stamped, smoothed).problems:
            return f"with {words} nothing is lost; --allow-broken writes it as it is"
    return "use larger cells, thinner lines or fewer --steps (or --allow-broken, to have it anyway)"


def _changed_blocks(block: Block) -> Iterator[tuple[str, Block]]:
    """Yield changes of a request and the blocks they give: those first that change the pattern least."""
    finer = max(block.cells + 2, 5)
    changes: list[tuple[str, dict[str, Any]]] = [(f"--cells {finer}", {"cells": finer})]
    if block.stamp == "block":
        exact = DEFAULT_CELLS["exact"]
        words = "--stamp exact" if block.cells == DEFAULT_CELLS["block"] else f"--stamp exact --cells {exact}"
        changes.insert(0, (words, {"stamp": "exact", "cells": exact}))
    if block.smoothing.steps > 1:
        steps = block.smoothing.steps // 2
        changes.append((f"--steps {steps}", {"smoothing": replace(block.smoothing, steps=steps)}))
    cell = float(parameter_values(block.pattern).get("cell") or 0.0)
    for larger in [float(f"{factor * cell:.2g}") for factor in LARGER_CELLS] if cell else []:
        pattern = with_parameters(block.pattern, {"cell": larger})
        changes.append((f"--cell {plain_argument(larger)}", {"pattern": pattern}))
    for words, change in changes:
        with suppress(ParameterError, PatternError):
            yield words, _replan(block, change)


def _replan(block: Block, change: dict[str, Any]) -> Block:
    """Check a request again with some of its options changed."""
    options = {
        "pattern": block.pattern,
        "size": block.grid.extents,
        "height": block.height,
        "line_width": block.line_width,
        "stamp": block.stamp,
        "cells": block.cells,
        "smoothing": block.smoothing,
        "parameters": {},
        "surface": block.surface,
        "tolerance": block.tolerance,
    }
    return plan_block(**{**options, **change})


def _count_fused_lines(lines: MultiLineString, components: int, line_width: float) -> int:
    """Count bodies of lines that the stamp fused; those up to three line widths long do not count."""
    number = body_numbers(lines)
    length = np.bincount(number, weights=shapely.length(np.array(lines.geoms, dtype=object)))
    return max(0, int((length > 3 * line_width).sum()) - components)


def _problems(tally: TopologyChanges, width: WallWidth, fused_lines: int) -> Iterator[str]:
    """Describe the problems of the walls, one phrase each."""
    if fused_lines:
        yield f"{count_noun(fused_lines, 'line')} of the pattern fused with others at this line width"
    for count, noun, event in (
        (tally.broken + tally.voids_joined + tally.walls_pierced, "wall", "broke"),
        (tally.vanished, "part", "vanished"),
        (tally.appeared, "part", "appeared from nowhere"),
        (tally.fused + tally.voids_cut, "gap", "between walls closed up"),
        (tally.voids_closed, "hole", "closed"),
    ):
        if count:
            yield f"{count_noun(count, noun)} {event} in smoothing"
    if tally.pinholes and tally.pinhole_share and tally.pinhole_share > MAX_PINHOLE_SHARE:
        yield (
            f"{count_noun(tally.pinholes, 'hole')} narrower than a line, {tally.pinhole_share:.0%} of all void, closed "
            "in smoothing"
        )
    if width.p5 < MIN_WIDTH_SHARE * width.requested:
        yield (
            f"the walls are {plain_argument(width.p5, 3)} mm thin at the 5th percentile, under {MIN_WIDTH_SHARE:.0%} "
            f"of the {plain_argument(width.requested)} mm asked for"
        )
