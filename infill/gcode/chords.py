"""Arcs as firmware drives them: chords of one millimetre, or of fewer degrees where the arc is small."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.table import GcodeTable

MAX_CHORD = 1.0  # mm: the default of Marlin (MM_PER_ARC_SEGMENT) and of Klipper (gcode_arcs)
MIN_CHORD = 0.1  # mm
CHORDS_PER_CIRCLE = 72  # chords at least, if they do not get too short
MAX_CHORDS_PER_ARC, MAX_CHORDS = (
    1 << 14,
    1 << 22,
)  # chords of an arc, and of all at once: more of them mean that the file is wrong
COARSE_RATIO = 0.26  # of the diameter: the sine of 15 degrees; even the smallest arcs are cut finer
PLANES = {17: [0, 1, 2], 18: [2, 0, 1], 19: [1, 2, 0]}  # the axes of the plane and the one across it


def stated_circles(table: GcodeTable, arcs: NDArray[np.intp]) -> tuple[Floats, Floats, Floats]:
    """Read what the words of arcs state of their circles.

    Parameters
    ----------
    table : GcodeTable
    arcs : (N,) int
        Lines.

    Returns
    -------
    offset : (N, 3) float64, mm
        From the start to the centre, I, J and K; 0 where a word is missing.
    radius : (N,) float64, mm
        R; NaN where it is missing. A negative radius is an arc of more than half a circle.
    turns : (N,) float64
        P; 1 where it is missing.
    """
    words = [table.further.get(line, {}) for line in arcs.tolist()] if table.further else [{}] * len(arcs)
    further = {
        letter: np.array([arc_words.get(letter, missing) for arc_words in words], dtype=np.float64)
        for letter, missing in (("K", 0.0), ("R", np.nan), ("P", 1.0))
    }
    offset = np.nan_to_num(np.column_stack([table.i[arcs], table.j[arcs], further["K"]]))
    return offset, further["R"], further["P"]


def chords_of_arc_lines(
    table: GcodeTable, arcs: NDArray[np.intp], start: Floats, end: Floats
) -> tuple[NDArray[np.intp], Floats, Floats, Floats]:
    """Cut arcs into chords; return the arc, begin and vector of each, stretched to the length of its arc.

    Parameters
    ----------
    table : GcodeTable
    arcs : (N,) int
        Lines.
    start, end : (N, 3) float64
        mm

    Returns
    -------
    arc, first : as by `cut_chords`
    way : (M, 3) float64
        From the begin to the end of each chord, stretched to the length of its arc, mm.
    share : (M,) float64
        Of the length of its arc, and so of its filament.
    """
    offset, radius, turns = stated_circles(table, arcs)
    clockwise = table.code[arcs] == 2
    parts = []
    for plane in np.unique(table.plane[arcs]).tolist():
        selected, axes = np.flatnonzero(table.plane[arcs] == plane), PLANES[plane]
        begin, finish = start[selected][:, axes], end[selected][:, axes]
        centre = begin[:, :2] + offset[selected][:, axes[:2]]
        by_radius = ~np.isnan(radius[selected])
        centre[by_radius] = centres_by_radius(begin, finish, radius[selected], clockwise[selected])[by_radius]
        whole = np.floor(np.maximum(turns[selected], 1.0))
        which, first, chord_end = cut_chords(begin, finish, centre, clockwise[selected], whole)
        back = np.argsort(axes)
        way = (chord_end - first) * _arc_ratio(chord_end - first, np.hypot(*(begin[:, :2] - centre).T)[which])[:, None]
        parts.append((selected[which], first[:, back], way[:, back]))
    which, first, way = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    order = np.argsort(which, kind="stable")
    which, first, way = which[order], first[order], way[order]
    length = np.linalg.norm(way, axis=1)
    share = length / np.maximum(np.bincount(which, weights=length, minlength=len(arcs))[which], 1e-300)
    return which, first, way, share


def _arc_ratio(chord_vector: Floats, radius: Floats) -> Floats:
    """Return the ratio of arc to chord length; 1 for chords that are large compared with their circle."""
    half = np.hypot(*chord_vector[:, :2].T) / np.maximum(2 * radius, 1e-300)
    fine = (half > 1e-9) & (half < COARSE_RATIO)
    half = np.where(fine, half, 0.5)
    return np.where(fine, np.arcsin(half) / half, 1.0)


def centres_by_radius(start: Floats, end: Floats, radius: Floats, clockwise: NDArray[np.bool_]) -> Floats:
    """Return the centres of arcs with these radii, (N, 2); a negative radius is an arc of more than half a circle."""
    way = (end - start)[:, :2]
    chord = np.hypot(*way.T)
    height = np.sqrt(np.maximum(np.nan_to_num(radius) ** 2 - (chord / 2) ** 2, 0.0))
    side = np.where(clockwise == (radius > 0), 1.0, -1.0)  # to the right
    right = np.column_stack([way[:, 1], -way[:, 0]]) / np.maximum(chord, 1e-300)[:, None]
    return np.asarray(start[:, :2] + way / 2 + right * (side * height)[:, None])


def arc_turns(start_offset: Floats, end_offset: Floats, clockwise: NDArray[np.bool_]) -> Floats:
    """Return the angles of arcs, (N,), positive counterclockwise, by the offsets of their ends from their centres."""
    begin = np.arctan2(start_offset[:, 1], start_offset[:, 0])
    turn = (np.arctan2(end_offset[:, 1], end_offset[:, 0]) - begin) % (2 * np.pi)
    turn = np.where(turn < 1e-9, 2 * np.pi, turn)  # a full circle, to the last digits of the file
    return np.where(clockwise & (turn < 2 * np.pi), turn - 2 * np.pi, np.where(clockwise, -turn, turn))


def cut_chords(
    start: Floats, end: Floats, centre: Floats, clockwise: NDArray[np.bool_], turns: Floats | None = None
) -> tuple[NDArray[np.intp], Floats, Floats]:
    """Cut arcs into chords.

    Parameters
    ----------
    start, end : (N, 3) float64
        mm; z rises evenly along the arc. Equal x and y mean a full circle.
    centre : (N, 2) float64
        mm
    clockwise : (N,) bool
        Seen from above: G2.
    turns : (N,) float64, optional
        Full circles and the rest, as P counts them: 1 and less mean the arc alone.

    Returns
    -------
    arc : (M,) int
        Index of the arc of each chord.
    first, last : (M, 3) float64
        Its ends; those of an arc are exactly `start` and `end`.

    >>> arc, first, last = cut_chords(np.zeros((1, 3)), np.array([[2.0, 0, 0]]), np.array([[1.0, 0]]), np.array([True]))
    >>> len(arc), last[len(arc) // 2 - 1].round(3).tolist()
    (32, [1.0, 1.0, 0.0])
    """
    start_offset, end_offset = start[:, :2] - centre, end[:, :2] - centre
    radius = np.hypot(*start_offset.T)
    begin = np.arctan2(start_offset[:, 1], start_offset[:, 0])
    turn = arc_turns(start_offset, end_offset, clockwise)
    if turns is not None:
        turn = turn + np.where(clockwise, -2 * np.pi, 2 * np.pi) * np.maximum(turns - 1, 0)
    length = np.abs(turn) * radius
    fine = np.minimum(np.abs(turn) * CHORDS_PER_CIRCLE / (2 * np.pi), length / MIN_CHORD)
    wanted_count = np.clip(np.ceil(np.maximum(length / MAX_CHORD, fine) - 1e-9), 1, MAX_CHORDS_PER_ARC)
    count = np.maximum(wanted_count * min(1.0, MAX_CHORDS / max(wanted_count.sum(), 1.0)), 1).astype(np.intp)
    arc = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(arc)) - np.repeat(np.cumsum(count) - count, count)

    def points_at(share: Floats) -> Floats:
        """Return the points at shares of the arcs, (K, 3), mm."""
        angle = begin[arc] + share * turn[arc]
        level = centre[arc] + radius[arc, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        return np.column_stack([level, start[arc, 2] + share * (end - start)[arc, 2]])

    first, last = points_at(number / count[arc]), points_at((number + 1) / count[arc])
    opening, closing = number == 0, number == count[arc] - 1
    first[opening], last[closing] = start[arc[opening]], end[arc[closing]]
    return arc, first, last
