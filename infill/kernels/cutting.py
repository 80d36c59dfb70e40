"""Loops of `infill.partition.walls`, compiled: the triangles and points of each label."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

from infill.kernels.compiling import njit


@njit(nogil=True, cache=True)
def count_sides(sides, starts):
    """Count the triangles before those of each label.

    Parameters
    ----------
    sides : (T, 2) int32
        Labels behind and before each triangle; negative ones are left out.
    starts : (labels + 1, 2) int64
        Of 0; written: how many triangles lie before, or behind, labels that come first.
    """
    for t in range(len(sides)):
        for side in range(2):
            if sides[t, side] >= 0:
                starts[sides[t, side] + 1, side] += 1
    for label in range(1, len(starts)):
        for side in range(2):
            starts[label, side] += starts[label - 1, side]


@njit(nogil=True, cache=True)
def sort_sides(sides, cursor, behind, before):
    """Write the triangles in the order of the label behind them, and of that before them; `cursor` is changed."""
    for t in range(len(sides)):
        label = sides[t, 0]
        if label >= 0:
            behind[cursor[label, 0]] = t
            cursor[label, 0] += 1
        label = sides[t, 1]
        if label >= 0:
            before[cursor[label, 1]] = t
            cursor[label, 1] += 1


@njit(nogil=True, cache=True)
def list_points(triangles, behind, before, table, points):
    """Write the points of two lists of triangles to `points`, without repetition; return their number.

    Parameters
    ----------
    triangles : (T, 3) int
    behind, before : (N,), (M,) int
        Numbers of the triangles behind and before a label.
    table : (P,) int
        Of -1; becomes 0 for points that are listed.
    points : (K,) int64
        Written.
    """
    count = 0
    for n in range(len(behind) + len(before)):
        t = behind[n] if n < len(behind) else before[n - len(behind)]
        for side in range(3):
            point = triangles[t, side]
            if table[point] < 0:
                table[point] = 0
                points[count] = point
                count += 1
    return count


@njit(nogil=True, cache=True)
def number_faces(triangles, behind, before, table, points, faces):
    """Write triangles with the places of their corners in `points`; those before a label are turned round.

    `table` has -1 again afterwards.
    """
    for place in range(len(points)):
        table[points[place]] = place
    for n in range(len(behind)):
        for side in range(3):
            faces[n, side] = table[triangles[behind[n], side]]
    for n in range(len(before)):
        for side in range(3):
            faces[len(behind) + n, side] = table[triangles[before[n], 2 - side]]
    for place in range(len(points)):
        table[points[place]] = -1
