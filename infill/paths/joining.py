"""Join the ends of paths along the outline of their region, as slicers anchor infill.

Ends divide a ring of the outline into gaps. A gap may be walked whole, from one end to the next, or in part, as
an anchor of a free end; never twice. Paths in a region do not cross and gaps do not overlap, so joined paths do not
cross either. A walked stretch keeps clear of all beads except its neighbours along the same path.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from infill.paths.clipping import Pieces
from infill.paths.families.family import CLEAR, TOUCH, Path
from infill.paths.gaps import Gaps, find_gaps
from infill.paths.layer_below import LayerBelow
from infill.paths.outlines import Outline
from infill.paths.pairing import choose_gaps
from infill.paths.trimming import trim_ends

SLACK = 0.005  # line widths by which ends may come nearer than other lines, for rounding
SHORTEST = 2.0  # line widths; a path shorter than this is a dot


def join(
    pieces: Pieces,
    outline: Outline,
    *,
    line_width: float,
    anchor: float,
    anchor_max: float,
    ground: LayerBelow | None = None,
    least_spacing: float = CLEAR * TOUCH,
) -> list[Path]:
    """Join paths along the outline.

    Parameters
    ----------
    pieces : Pieces
        From `clip`.
    outline : Outline
    line_width : float
        mm.
    anchor : float
        Length of the anchor of an end that stays free, mm, at most.
    anchor_max : float
        Length of the outline along which two ends are joined, mm, at most; the shortest are joined first.
    ground : LayerBelow, optional
        The layer below: where the outline lies on it, ends are joined before all others, and anchored.
    least_spacing : float
        Line widths that a walked stretch keeps from other lines.

    Returns
    -------
    list of (N, 2) float64, mm
        Joining closes a path only where its ends would overlap. Free ends that come nearer to other lines are
        shortened. Paths shorter than two line widths are dropped.
    """
    clear = least_spacing * line_width
    gaps = find_gaps(pieces, outline, line_width, clear)
    apart = max(TOUCH * line_width, clear)
    is_supported = None if ground is None else _supported_gaps(gaps, outline, ground)
    walked = choose_gaps(gaps, len(pieces.paths), most=anchor_max, overlapping=clear, held=is_supported)
    link: dict[int, tuple[int, Path]] = {}
    for gap in np.flatnonzero(walked).tolist():
        begin, end, place = int(gaps.begin[gap]), int(gaps.end[gap]), float(gaps.place[gap])
        wall = outline.corners_between(int(gaps.ring[gap]), place, float(gaps.length[gap]))
        link[begin], link[end] = (end, wall), (begin, wall[::-1])
    chains = _link_chains(len(pieces.paths), link)
    lengths = np.array([np.hypot(*np.diff(path, axis=0).T).sum() for path in pieces.paths])
    long_chains = [chain for chain in chains if len(chain) > 1 or lengths[chain[0] // 2] >= SHORTEST * line_width]
    free = [end for chain in long_chains for end in (chain[0], chain[-1] ^ 1) if end not in link]
    heading = {end: _heading(pieces.paths[end // 2], end) for end in free}
    anchors = _anchors(heading, gaps, walked, outline, anchor, apart, ground)
    paths = [_assemble_path(chain, pieces.paths, link, anchors) for chain in long_chains]
    on_outline = pieces.ring.ravel() >= 0
    may_trim = [tuple(end not in link and bool(on_outline[end]) for end in (c[0], c[-1] ^ 1)) for c in long_chains]
    trimmed = trim_ends(paths, may_trim, (least_spacing - SLACK) * line_width, line_width)
    return [
        path
        for path, whole in zip(trimmed, paths, strict=True)
        if path is whole or np.hypot(*np.diff(path, axis=0).T).sum() >= SHORTEST * line_width
    ]


def _supported_gaps(gaps: Gaps, outline: Outline, ground: LayerBelow) -> NDArray[np.bool_]:
    """Tell which gaps have a supported middle."""
    middles = np.empty((len(gaps.ring), 2))
    for ring in np.unique(gaps.ring):
        on_ring = gaps.ring == ring
        middles[on_ring] = outline.points_at(int(ring), gaps.place[on_ring] + gaps.length[on_ring] / 2)
    return ground.holds(middles)


def _link_chains(count: int, link: dict[int, tuple[int, Path]]) -> list[list[int]]:
    """Link paths into chains: each path is given by the number of the end at which it is entered.

    Open chains come first, from an end that is not linked; the remaining chains are closed.
    """
    chains: list[list[int]] = []
    seen: set[int] = set()
    for entry in sorted(range(2 * count), key=link.__contains__):
        if entry // 2 not in seen:
            chain = [entry]
            while chain[-1] ^ 1 in link and (after := link[chain[-1] ^ 1][0]) != entry:
                chain.append(after)
            seen.update(end // 2 for end in chain)
            chains.append(chain)
    return chains


def _heading(path: Path, end: int) -> Path:
    """Return the direction in which a path arrives at one of its ends, (2,)."""
    step = path[-1] - path[-2] if end % 2 else path[0] - path[1]
    direction: Path = step / max(float(np.hypot(*step)), 1e-12)
    return direction


def _anchors(
    heading: Mapping[int, Path],
    gaps: Gaps,
    walked: NDArray[np.bool_],
    outline: Outline,
    anchor: float,
    apart: float,
    ground: LayerBelow | None,
) -> dict[int, Path]:
    """Choose the anchors of free ends, by end, from the end on.

    A supported way wins, else the longer one, or the blunter one if it is clear.
    """
    after = dict(zip(gaps.begin.tolist(), range(len(gaps.begin)), strict=True))
    before = dict(zip(gaps.end.tolist(), range(len(gaps.end)), strict=True))
    # Two anchors in a gap keep apart around a right angle too.
    remaining = np.where(walked, 0.0, gaps.length - math.sqrt(2) * apart)
    anchors: dict[int, Path] = {}
    for end, direction in heading.items():
        if end not in after:
            continue
        onwards, back = after[end], before[end]
        ways: list[tuple[float, float, int, Path]] = []
        for gap, clear, sign in ((onwards, gaps.forwards, 1.0), (back, gaps.backwards, -1.0)):
            reach = min(anchor, float(remaining[gap]), float(clear[gap]))
            if reach >= apart:
                place = float(gaps.place[onwards])
                wall = outline.stretch(int(gaps.ring[onwards]), place, sign * reach)
                blunt = bool((_heading(wall[:2], 1) * direction).sum() >= 0)
                is_supported = ground is not None and bool(ground.holds(wall[1:].mean(axis=0)[None])[0])
                ways.append((reach + (blunt + 2 * is_supported) * anchor, reach, gap, wall[1:]))
        if ways:
            _, reach, gap, anchors[end] = max(ways, key=lambda way: way[0])
            remaining[gap] -= reach
    return anchors


def _assemble_path(
    chain: list[int], paths: Sequence[Path], link: dict[int, tuple[int, Path]], anchors: dict[int, Path]
) -> Path:
    """Assemble the path along a chain, with the walls between its pieces and the anchors at its ends."""
    parts: list[Path] = []
    if chain[0] in anchors:
        parts.append(anchors[chain[0]][::-1])
    for entry in chain:
        path = paths[entry // 2]
        parts.append(path[::-1] if entry % 2 else path)
        if entry ^ 1 in link:
            parts.append(link[entry ^ 1][1])
    if chain[-1] ^ 1 in anchors:
        parts.append(anchors[chain[-1] ^ 1])
    if chain[0] in link:
        parts.append(parts[0][:1])
    return np.concatenate(parts)
