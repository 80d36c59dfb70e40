"""Short segments of paths merged with their neighbours, in rounds: tests/plain_segments.py has the same in NumPy.

A round merges segments three or more apart, so that none sees changes of another of its round.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _apart(px, py, ax, ay, bx, by):
    """Return the distance of a point from the segment AB."""
    cx, cy, dx, dy = bx - ax, by - ay, px - ax, py - ay
    share = min(max((dx * cx + dy * cy) / max(cx * cx + cy * cy, 1e-300), 0.0), 1.0)
    return math.hypot(dx - share * cx, dy - share * cy)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _spread(points, chosen, final, unit, spread_length, shortest):
    """Move both points of a segment apart along their legs; return how far the path moves, and the two points."""
    ax, ay, bx, by = points[chosen, 0], points[chosen, 1], points[chosen + 1, 0], points[chosen + 1, 1]
    before, after = max(chosen - 1, 0), min(chosen + 2, final)
    back_x, back_y, on_x, on_y = (
        points[before, 0] - ax,
        points[before, 1] - ay,
        points[after, 0] - bx,
        points[after, 1] - by,
    )
    back, on = math.hypot(back_x, back_y), math.hypot(on_x, on_y)
    room = min(back, on) - spread_length
    back, on = max(back, 1e-300), max(on, 1e-300)
    back_x, back_y, on_x, on_y = back_x / back, back_y / back, on_x / on, on_y / on
    apart_x, apart_y, between_x, between_y = on_x - back_x, on_y - back_y, bx - ax, by - ay
    # |between + t apart| = spread_length
    square = apart_x * apart_x + apart_y * apart_y
    half = apart_x * between_x + apart_y * between_y
    under = half * half + square * (spread_length * spread_length - (between_x * between_x + between_y * between_y))
    step = (math.sqrt(max(under, 0.0)) - half) / max(square, 1e-9)
    new_ax, new_ay = np.rint((ax + step * back_x) / unit) * unit, np.rint((ay + step * back_y) / unit) * unit
    new_bx, new_by = np.rint((bx + step * on_x) / unit) * unit, np.rint((by + step * on_y) / unit) * unit
    error = max(_apart(ax, ay, new_ax, new_ay, new_bx, new_by), _apart(bx, by, new_ax, new_ay, new_bx, new_by))
    if step > room or math.hypot(new_bx - new_ax, new_by - new_ay) < shortest:
        error = math.inf
    return error, new_ax, new_ay, new_bx, new_by


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _set_length(points, owner, segment, count, length):
    """Set the length of a segment: infinite between two paths."""
    if 0 <= segment < count - 1:
        if owner[segment] == owner[segment + 1]:
            dx, dy = points[segment + 1, 0] - points[segment, 0], points[segment + 1, 1] - points[segment, 1]
            length[segment] = math.hypot(dx, dy)
        else:
            length[segment] = math.inf


@njit(nogil=True, cache=True, error_model="numpy")
def merge_rounds(points, owner, source, least, number, unit, limits, classes, scatter):
    """Merge short segments until none is left that may go; return the number of points that remain, at the front.

    Parameters
    ----------
    points : (N, 2) float64, mm
        Changed.
    owner, source : (N,) int64
        Changed: the path of each point, ascending, and the point that it stands for.
    least : (N,) float64, mm
        Changed: length of the segment after each point below which it is merged.
    number : (M,) int64
        Changed: number of the points of each path.
    unit : float, mm
    limits : tuple of float, mm
        `SHORTEST_SEGMENT`, `MOST_MOVED`, `HARDLY_BENT`, `MOST_SPREAD` and `SPREAD_LENGTH`.
    classes, scatter : float
        `LENGTH_CLASSES` and `SCATTER`.
    """
    shortest, most_moved, hardly_bent, most_spread, spread_length = limits
    count = len(points)
    moved, stays = np.zeros(count), np.zeros(count, dtype=np.bool_)
    length = np.full(count, math.inf)
    for segment in range(count - 1):
        _set_length(points, owner, segment, count, length)
    rank, chosen, goes = np.full(count + 4, math.inf), np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
    short = np.empty(count, dtype=np.int64)
    while count > 1:
        candidates = 0
        for k in range(count - 1):
            if length[k] < least[k] - unit / 10 and not stays[k] and number[owner[k]] != 2:
                rank[k + 2] = math.floor(length[k] / classes) + (k * scatter) % 1.0
                short[candidates] = k
                candidates += 1
        picked = 0
        for n in range(candidates):
            k = short[n]
            if rank[k + 2] < min(min(rank[k], rank[k + 1]), min(rank[k + 3], rank[k + 4])):
                chosen[picked] = k
                picked += 1
        for n in range(candidates):
            rank[short[n] + 2] = math.inf
        if not picked:
            break
        dropped, final = 0, count - 1
        for n in range(picked):
            k = chosen[n]
            before, after = max(k - 1, 0), min(k + 2, final)
            at_begin = k == 0 or owner[k] != owner[k - 1]
            at_end = k + 1 == final or owner[k] != owner[after]
            ax, ay, bx, by = points[k, 0], points[k, 1], points[k + 1, 0], points[k + 1, 1]
            px, py, qx, qy = points[before, 0], points[before, 1], points[after, 0], points[after, 1]
            mx, my = np.rint((ax + bx) / 2 / unit) * unit, np.rint((ay + by) / 2 / unit) * unit
            without_a = math.inf if at_begin else _apart(ax, ay, px, py, bx, by)
            without_b = math.inf if at_end else _apart(bx, by, ax, ay, qx, qy)
            halfway = math.inf
            if not at_begin and not at_end:
                halfway = max(_apart(ax, ay, px, py, mx, my), _apart(bx, by, mx, my, qx, qy))
            error, best = without_a, 0
            if without_b < error:
                error, best = without_b, 1
            if halfway < error:
                error, best = halfway, 2
            merged_error = error + max(moved[before], max(moved[k], moved[min(k + 1, final)]))
            must = math.hypot(bx - ax, by - ay) < shortest and not at_begin and not at_end
            if not must and not merged_error <= most_moved:
                stays[k] = True
                continue
            is_spread = False
            if must and error > hardly_bent:
                spread_error, new_ax, new_ay, new_bx, new_by = _spread(points, k, final, unit, spread_length, shortest)
                if spread_error + merged_error - error <= most_spread:
                    is_spread = True
                    merged_error += spread_error - error
            for segment in (before, k, k + 1):
                moved[segment] = max(moved[segment], merged_error)
                stays[segment] = False
            if is_spread:
                points[k, 0], points[k, 1], points[k + 1, 0], points[k + 1, 1] = new_ax, new_ay, new_bx, new_by
            else:
                stay = k + 1 if best == 0 else k
                if best == 2:
                    points[stay, 0], points[stay, 1] = mx, my
                goes[dropped] = 2 * k + 1 - stay
                dropped += 1
                number[owner[k]] -= 1
            for segment in (k - 1, k, k + 1):
                _set_length(points, owner, segment, count, length)
        if not dropped:
            continue
        goes[dropped] = count
        front = goes[0]
        for n in range(dropped):
            for k in range(goes[n] + 1, goes[n + 1]):
                points[front, 0], points[front, 1] = points[k, 0], points[k, 1]
                owner[front], source[front], least[front] = owner[k], source[k], least[k]
                moved[front], stays[front], length[front] = moved[k], stays[k], length[k]
                front += 1
        count = front
        for n in range(dropped):  # the segment after the point before the one that went, and the next
            for segment in (goes[n] - n - 1, goes[n] - n):
                _set_length(points, owner, segment, count, length)
        length[count - 1] = math.inf
    return count
