"""Ends of paths joined along the outline of their region, as slicers anchor infill.

Ends divide a ring of the outline into gaps. A gap may be walked whole, from one end to the next, or in part, as
an anchor of a free end; never twice. Paths in a region do not cross and gaps do not overlap, so joined paths do not
cross either. What is walked keeps `CLEAR` of the distance of touching beads from everything that is not next to
it along the same path.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.filling.clipping import Pieces
from infill.filling.families.protocol import TOUCH, Path
from infill.filling.outlines import Floats, Numbers, Outline

CLEAR = 0.95  # of the distance of touching beads: beads overlap by at most 5 %
NEXT = 3.5  # line widths along a path within which it may come near itself: corners of 30° and more
SHORTEST = 2.0  # line widths; a path shorter than this is a dot
STEPS = 4  # per line width, in which the outline is examined


@dataclass(frozen=True, kw_only=True)
class _Gaps:
    """Gaps between neighbouring ends: numbers of ends (2 · path + 0 or 1), places in mm, and how far each is clear."""

    ring: Numbers
    begin: Numbers
    end: Numbers
    place: Floats
    length: Floats
    clear: NDArray[np.bool_]  # the whole of it
    forwards: Floats  # mm that an anchor may reach from `begin`
    backwards: Floats  # mm that an anchor may reach from `end`


def join(pieces: Pieces, outline: Outline, *, line_width: float, anchor: float, anchor_max: float) -> list[Path]:
    """Return paths joined along the outline.

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

    Returns
    -------
    list of (N, 2) float64, mm
        Joining closes a path only where its ends would overlap. Those shorter than two line widths are left out.
    """
    gaps = _gaps(pieces, outline, line_width)
    link: dict[int, tuple[int, Path]] = {}
    walked = np.zeros(len(gaps.length), dtype=bool)
    group = list(range(len(pieces.paths)))
    possible = np.flatnonzero(gaps.clear & (gaps.length <= anchor_max) & (gaps.begin // 2 != gaps.end // 2))
    for gap in possible[np.argsort(gaps.length[possible], kind="stable")].tolist():
        begin, end = int(gaps.begin[gap]), int(gaps.end[gap])
        one, other = _root(group, begin // 2), _root(group, end // 2)
        if one == other or begin in link or end in link:
            continue
        group[one] = other
        walked[gap] = True
        place = gaps.place[gap]
        wall = outline.stretch(int(gaps.ring[gap]), place, place + gaps.length[gap])[1:-1]
        link[begin], link[end] = (end, wall), (begin, wall[::-1])
    chains = _chains(len(pieces.paths), link)
    lengths = np.array([np.hypot(*np.diff(path, axis=0).T).sum() for path in pieces.paths])
    kept = [chain for chain in chains if len(chain) > 1 or lengths[chain[0] // 2] >= SHORTEST * line_width]
    apart = TOUCH * line_width
    rings = _closing(kept, gaps, walked, outline, CLEAR * apart)
    free = [end for chain in kept if chain[0] not in rings for end in (chain[0], chain[-1] ^ 1)]
    heading = {end: _heading(pieces.paths[end // 2], end) for end in free}
    anchors = _anchors(heading, gaps, walked, outline, anchor, apart)
    return [_laid(chain, pieces.paths, link, anchors, rings.get(chain[0])) for chain in kept]


def _gaps(pieces: Pieces, outline: Outline, line_width: float) -> _Gaps:
    """Return the gaps of all rings, and how far each is clear of paths."""
    number = np.flatnonzero(pieces.ring.ravel() >= 0)
    ring, place = pieces.ring.ravel()[number], pieces.place.ravel()[number]
    order = np.lexsort((place, ring))
    number, ring, place = number[order], ring[order], place[order]
    # The gap after the last end of a ring goes on to the first.
    opening = np.flatnonzero(np.append(True, ring[1:] != ring[:-1])[: len(ring)])
    following = np.arange(1, len(ring) + 1)
    closing = np.append(opening[1:], len(ring))[: len(opening)] - 1
    following[closing] = opening
    length = place[following] - place if len(ring) else place
    length[closing] += outline.around[ring[closing]]
    forwards, backwards, whole = _clear(pieces, outline, line_width, (ring, place, length, number, number[following]))
    return _Gaps(
        ring=ring,
        begin=number,
        end=number[following],
        place=place,
        length=length,
        clear=whole,
        forwards=forwards,
        backwards=backwards,
    )


def _clear(
    pieces: Pieces,
    outline: Outline,
    line_width: float,
    gaps: tuple[Numbers, Floats, Floats, Numbers, Numbers],
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Return how far gaps are clear from their begin and from their end, mm, and which are clear as a whole."""
    import shapely

    ring, place, length, begin, end = gaps
    forwards, backwards, whole = length.copy(), length.copy(), np.ones(len(length), dtype=bool)
    if not len(length):
        return forwards, backwards, whole
    reach, near = CLEAR * TOUCH * line_width, NEXT * line_width
    step = line_width / STEPS
    count = np.maximum(1, np.ceil(length / step).astype(np.intp))
    gap = np.repeat(np.arange(len(length)), count)
    within = (np.arange(len(gap)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[gap] * length[gap]
    points = np.empty((len(gap), 2))
    for one in np.unique(ring):
        here = ring[gap] == one
        points[here] = outline.points_at(int(one), (place[gap] + within)[here])

    # Which segments of paths come near, and how far along the path those places are from either end of the gap.
    flat = np.concatenate(pieces.paths)
    owner = np.repeat(np.arange(len(pieces.paths)), [len(path) for path in pieces.paths])
    start = np.flatnonzero(owner[1:] == owner[:-1])
    long = np.hypot(*(flat[start + 1] - flat[start]).T)
    along = np.zeros(len(flat))
    along[start + 1] = long
    along = np.cumsum(along)
    along -= along[np.searchsorted(owner, owner)]
    total = np.zeros(len(pieces.paths))
    np.maximum.at(total, owner, along)
    segments = shapely.linestrings(np.stack([flat[start], flat[start + 1]], axis=1))
    sample, segment = shapely.STRtree(segments).query(shapely.points(points), predicate="dwithin", distance=reach)
    from_begin, from_end = within[sample], (length[gap] - within)[sample]
    a, path = flat[start[segment]], owner[start[segment]]
    part = ((points[sample] - a) * (flat[start[segment] + 1] - a)).sum(axis=-1) / np.maximum(long[segment], 1e-12)
    passed = along[start[segment]] + part.clip(0, long[segment])
    ends = begin[gap[sample]], end[gap[sample]]
    beside = [
        (path == tip // 2) & (np.where(tip % 2 == 0, passed, total[path] - passed) + walked < near)
        for tip, walked in zip(ends, (from_begin, from_end), strict=True)
    ]
    # Where the outline comes near itself nothing is walked: the other side may be.
    one, other = _near_itself(points, ring[gap], place[gap] + within, outline, reach, near)
    tight = np.concatenate([one, other])
    none = np.zeros(len(tight), dtype=bool)
    sample = np.concatenate([sample, tight])
    by_begin, by_end = np.concatenate([beside[0], none]), np.concatenate([beside[1], none])
    which = gap[sample]
    np.minimum.at(forwards, which[~by_begin], (within[sample] - step)[~by_begin])
    np.minimum.at(backwards, which[~by_end], (length[which] - within[sample] - step)[~by_end])
    whole[which[~by_begin & ~by_end]] = False
    return forwards.clip(min=0), backwards.clip(min=0), whole


def _near_itself(
    points: Path, ring: Numbers, place: Floats, outline: Outline, reach: float, near: float
) -> tuple[Numbers, Numbers]:
    """Return pairs of points on the outline that are near each other, but not along a ring."""
    from scipy.spatial import cKDTree

    one, other = cKDTree(points).query_pairs(reach, output_type="ndarray").T
    around = outline.around[ring[one]]
    apart = np.abs(place[one] - place[other]) % around
    far = (ring[one] != ring[other]) | (np.minimum(apart, around - apart) > near)
    return one[far], other[far]


def _root(group: list[int], path: int) -> int:
    """Return the path that stands for all that are joined to `path`."""
    while group[path] != path:
        group[path] = group[group[path]]
        path = group[path]
    return path


def _chains(count: int, link: dict[int, tuple[int, Path]]) -> list[list[int]]:
    """Return which paths follow one another: each by the number of the end that it is entered at."""
    chains: list[list[int]] = []
    seen: set[int] = set()
    for path in range(count):
        for entry in (2 * path, 2 * path + 1):
            if path in seen or entry in link:
                continue
            chain = [entry]
            while chain[-1] ^ 1 in link:
                chain.append(link[chain[-1] ^ 1][0])
            seen.update(end // 2 for end in chain)
            chains.append(chain)
    return chains


def _closing(
    chains: Sequence[list[int]], gaps: _Gaps, walked: NDArray[np.bool_], outline: Outline, apart: float
) -> dict[int, Path]:
    """Return the walls that close chains whose ends are nearer than `apart`, by the end that they are entered at."""
    short = np.flatnonzero(~walked & (gaps.length < apart))
    between = {(int(gaps.begin[gap]), int(gaps.end[gap])): gap for gap in short.tolist()}
    walls: dict[int, Path] = {}
    for chain in chains:
        begin, end = chain[0], chain[-1] ^ 1
        for one, other in ((begin, end), (end, begin)):
            if begin != end and (one, other) in between:
                gap = between[one, other]
                place = float(gaps.place[gap])
                wall = outline.stretch(int(gaps.ring[gap]), place, place + float(gaps.length[gap]))[1:-1]
                walls[begin] = wall if one == end else wall[::-1]
    return walls


def _heading(path: Path, end: int) -> Path:
    """Return the direction in which a path arrives at one of its ends, (2,)."""
    step = path[-1] - path[-2] if end % 2 else path[0] - path[1]
    direction: Path = step / max(float(np.hypot(*step)), 1e-12)
    return direction


def _anchors(
    heading: Mapping[int, Path],
    gaps: _Gaps,
    walked: NDArray[np.bool_],
    outline: Outline,
    anchor: float,
    apart: float,
) -> dict[int, Path]:
    """Return the anchors of free ends, by end, from the end on: the longer way, or the blunter one if it is clear."""
    after = dict(zip(gaps.begin.tolist(), range(len(gaps.begin)), strict=True))
    before = dict(zip(gaps.end.tolist(), range(len(gaps.end)), strict=True))
    # Two anchors in a gap keep apart around a right angle too.
    left = np.where(walked, 0.0, gaps.length - math.sqrt(2) * apart)
    anchors: dict[int, Path] = {}
    for end, direction in heading.items():
        if end not in after:
            continue
        onwards, back = after[end], before[end]
        ways: list[tuple[float, float, int, Path]] = []
        for gap, clear, sign in ((onwards, gaps.forwards, 1.0), (back, gaps.backwards, -1.0)):
            reach = min(anchor, float(left[gap]), float(clear[gap]))
            if reach >= apart:
                place = float(gaps.place[onwards])
                wall = outline.stretch(int(gaps.ring[onwards]), place, place + sign * reach)
                blunt = bool((_heading(wall[:2], 1) * direction).sum() >= 0)
                ways.append((reach + blunt * anchor, reach, gap, wall[1:]))
        if ways:
            _, reach, gap, anchors[end] = max(ways, key=lambda way: way[0])
            left[gap] -= reach
    return anchors


def _laid(
    chain: list[int],
    paths: Sequence[Path],
    link: dict[int, tuple[int, Path]],
    anchors: dict[int, Path],
    closing: Path | None,
) -> Path:
    """Return the path along a chain, with the walls between its pieces, and the anchors at its ends or what closes it."""
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
    if closing is not None:
        parts += [closing, parts[0][:1]]
    return np.concatenate(parts)
