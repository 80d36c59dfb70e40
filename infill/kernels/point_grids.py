"""Points in the squares of a grid, and searches around places: the specification is `scipy.spatial.cKDTree`.

A grid is `low` and `cell`, the corner and the side of its squares; `shape`, their numbers along x and y; `begins`,
where the points of each square begin among the sorted ones, x running fastest; and `points`, (N, 2), sorted. All
lengths are in mm.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.disjoint_sets import join

WIDER = 1e-6  # squares that a search goes beyond its distance, so that rounding leaves out none


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _square_of(place, low, cell, count):
    """Return the square along an axis in which a place lies; the first or the last one for places outside."""
    return int(min(max((place - low) / cell, 0.0), count - 1.0))


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _squares_around(place, distance, low, cell, count):
    """Return the first and the last square along an axis within a distance of a place; no square if it is outside."""
    closest = (place - distance - low) / cell - WIDER
    upper = (place + distance - low) / cell + WIDER
    if not (closest < count and upper >= 0.0):
        return 0, -1
    return int(max(closest, 0.0)), int(min(upper, count - 1.0))


@njit(nogil=True, cache=True, error_model="numpy")
def sort_points(points, low, cell, shape, begins, number):
    """Sort points by their squares.

    Parameters
    ----------
    begins : (X * Y + 1,) int64
        Written; zeros on entry.
    number : (N,) int64
        Written: the points in the order of their squares, and within a square as they are.
    """
    for k in range(len(points)):
        column = _square_of(points[k, 0], low[0], cell, shape[0])
        begins[_square_of(points[k, 1], low[1], cell, shape[1]) * shape[0] + column + 1] += 1
    for square in range(len(begins) - 1):
        begins[square + 1] += begins[square]
    # Each begin moves to the end of its square, which is the begin of the next one.
    for k in range(len(points)):
        column = _square_of(points[k, 0], low[0], cell, shape[0])
        square = _square_of(points[k, 1], low[1], cell, shape[1]) * shape[0] + column
        number[begins[square]] = k
        begins[square] += 1
    for square in range(len(begins) - 1, 0, -1):
        begins[square] = begins[square - 1]
    begins[0] = 0


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def find_distance(low, cell, shape, begins, points, x, y, distance):
    """Return the distance of a place from the nearest point; infinite from `distance` on."""
    best = distance * distance
    is_hit = False
    left, right = _squares_around(x, distance, low[0], cell, shape[0])
    bottom, top = _squares_around(y, distance, low[1], cell, shape[1])
    if left <= right:
        for row in range(bottom, top + 1):
            for k in range(begins[row * shape[0] + left], begins[row * shape[0] + right + 1]):
                dx, dy = x - points[k, 0], y - points[k, 1]
                square = dx * dx + dy * dy
                if square < best:
                    best, is_hit = square, True
    return math.sqrt(best) if is_hit else math.inf


@njit(nogil=True, cache=True, error_model="numpy")
def find_nearest(low, cell, shape, begins, points, places, distance, nearest):
    """Find the distance to the nearest point of each place.

    Parameters
    ----------
    places : (M, 2) float64
    distance : float
        Points as far away as this do not count.
    nearest : (M,) float64
        Written; infinite where no point counts.
    """
    for place in range(len(places)):
        nearest[place] = find_distance(low, cell, shape, begins, points, places[place, 0], places[place, 1], distance)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _project(x, y, mx, my, hx, hy):
    """Project a place to a piece: see `infill.paths.contact.project_to_pieces`."""
    dx, dy = x - mx, y - my
    along = min(max((dx * hx + dy * hy) / max(hx * hx + hy * hy, 1e-18), -1.0), 1.0)
    return along, math.hypot(dx - along * hx, dy - along * hy)


@njit(nogil=True, cache=True, error_model="numpy")
def find_near_pieces(low, cell, shape, begins, points, half, places, distance, reach, is_near):
    """Tell for each place whether one of the three pieces with the nearest middles is within reach.

    Parameters
    ----------
    points, half : (N, 2) float64
        Of pieces, sorted: their middles, and the way from there to an end.
    places : (M, 2) float64
    distance : float
        Middles as far away as this do not count.
    reach : float
    is_near : (M,) bool
        Written.
    """
    for place in range(len(places)):
        x, y = places[place, 0], places[place, 1]
        closest = second = third = distance * distance
        one = two = three = -1
        left, right = _squares_around(x, distance, low[0], cell, shape[0])
        bottom, top = _squares_around(y, distance, low[1], cell, shape[1])
        if left <= right:
            for row in range(bottom, top + 1):
                for k in range(begins[row * shape[0] + left], begins[row * shape[0] + right + 1]):
                    dx, dy = x - points[k, 0], y - points[k, 1]
                    square = dx * dx + dy * dy
                    if square < closest:
                        closest, second, third = square, closest, second
                        one, two, three = k, one, two
                    elif square < second:
                        second, third = square, second
                        two, three = k, two
                    elif square < third:
                        third, three = square, k
        is_near[place] = False
        for k in (one, two, three):
            if k >= 0 and _project(x, y, points[k, 0], points[k, 1], half[k, 0], half[k, 1])[1] <= reach:
                is_near[place] = True
                break


@njit(nogil=True, cache=True, error_model="numpy")
def find_beside(
    low,
    cell,
    shape,
    begins,
    points,
    half,
    path,
    along,
    weight,
    places,
    path_of,
    travelled,
    distance,
    reach,
    stretch,
    is_near,
):
    """Tell for each place on a path whether a piece is within reach that is another path's, or far along its own.

    Parameters
    ----------
    points, half, path, along, weight : (N, …)
        Of pieces, sorted: as in `infill.paths.contact.Samples`.
    places : (M, 2) float64
    path_of, travelled : (M,) int64 and float64
        The path of each place, and how far along it is.
    distance : float
        Middles as far away as this do not count.
    reach, stretch : float
        Pieces nearer than `stretch` along its own path do not count.
    is_near : (M,) bool
        Written.
    """
    limit = distance * distance
    for place in range(len(places)):
        x, y = places[place, 0], places[place, 1]
        is_near[place] = False
        left, right = _squares_around(x, distance, low[0], cell, shape[0])
        bottom, top = _squares_around(y, distance, low[1], cell, shape[1])
        if left > right:
            continue
        for row in range(bottom, top + 1):
            for k in range(begins[row * shape[0] + left], begins[row * shape[0] + right + 1]):
                dx, dy = x - points[k, 0], y - points[k, 1]
                if dx * dx + dy * dy >= limit:
                    continue
                share, apart = _project(x, y, points[k, 0], points[k, 1], half[k, 0], half[k, 1])
                if apart > reach:
                    continue
                if path[k] == path_of[place]:
                    there = along[k] + share * weight[k] / 2
                    if abs(there - travelled[place]) <= stretch:
                        continue
                is_near[place] = True
                break
            if is_near[place]:
                break


@njit(nogil=True, cache=True, error_model="numpy")
def join_near(low, cell, shape, begins, points, path, reach, parent):
    """Join the paths of which two points are within reach.

    Parameters
    ----------
    points, path : (N, 2) float64 and (N,) int64
        Sorted.
    parent : (P,) int64
        Changed: the disjoint sets of paths, see `infill.kernels.disjoint_sets`.
    """
    limit = reach * reach
    for point in range(len(points)):
        x, y = points[point, 0], points[point, 1]
        left, right = _squares_around(x, reach, low[0], cell, shape[0])
        bottom, top = _squares_around(y, reach, low[1], cell, shape[1])
        if left > right:
            continue
        for row in range(bottom, top + 1):
            for k in range(begins[row * shape[0] + left], begins[row * shape[0] + right + 1]):
                if path[k] != path[point]:
                    dx, dy = x - points[k, 0], y - points[k, 1]
                    if dx * dx + dy * dy <= limit:
                        join(parent, path[point], path[k])


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _find_around(low, cell, shape, begins, points, x, y, distance, names, squares):
    """Write the points nearest to a place, by their order in the grid, and the squares of their distances."""
    last = len(names) - 1
    for rank in range(last + 1):
        names[rank], squares[rank] = -1, math.inf
    limit = distance * distance
    left, right = _squares_around(x, distance, low[0], cell, shape[0])
    bottom, top = _squares_around(y, distance, low[1], cell, shape[1])
    if left <= right:
        for row in range(bottom, top + 1):
            for k in range(begins[row * shape[0] + left], begins[row * shape[0] + right + 1]):
                dx, dy = x - points[k, 0], y - points[k, 1]
                square = dx * dx + dy * dy
                if square < limit and square < squares[last]:
                    rank = last
                    while rank > 0 and square < squares[rank - 1]:
                        names[rank], squares[rank] = names[rank - 1], squares[rank - 1]
                        rank -= 1
                    names[rank], squares[rank] = k, square


@njit(nogil=True, cache=True, error_model="numpy")
def find_several(low, cell, shape, begins, points, number, places, distance, names, squares):
    """Find the nearest points of each place, the nearest first.

    Parameters
    ----------
    number : (N,) int64
        What each point is called.
    places : (M, 2) float64
    distance : float
        Points as far away as this do not count.
    names : (M, K) int64
        Written; -1 where fewer points count.
    squares : (M, K) float64
        Written: squares of their distances, infinite where fewer points count.
    """
    for place in range(len(places)):
        x, y = places[place, 0], places[place, 1]
        _find_around(low, cell, shape, begins, points, x, y, distance, names[place], squares[place])
        for rank in range(names.shape[1]):
            if names[place, rank] >= 0:
                names[place, rank] = number[names[place, rank]]


@njit(nogil=True, cache=True, error_model="numpy")
def project_to_nearest(
    low,
    cell,
    shape,
    begins,
    points,
    number,
    half,
    places,
    count,
    reach,
    farthest,
    same,
    names,
    squares,
    onto,
    apart,
    is_unsure,
):
    """Project each place to the nearest of the `count` pieces with the nearest middles.

    Parameters
    ----------
    points : (N, 2) float64
        Middles of pieces, sorted.
    number : (N,) int64
        What each piece is called.
    half : (N, 2) float64
        From the middle of each, by its name, to its end.
    places : (M, 2) float64
    count : int
        At most N and K.
    reach : float
        Farther pieces do not count.
    farthest : float
        Middles are sought so far: `reach` and the longest half, or all that there are.
    same : float
        Places so near to each other are one.
    names, squares : (K,) int64 and float64
        Overwritten: K middles are sought, as some may be as near as the last one that counts.
    onto : (M, 2) float64
        Written: the place itself where no piece counts.
    apart : (M,) float64
        Written: the distance; infinite there.
    is_unsure : (M,) bool
        Written: whether that hangs on which of several middles, or of several pieces, are taken as the nearest ones.
    """
    full = min(len(names), len(points)) - 1
    for place in range(len(places)):
        x, y = places[place, 0], places[place, 1]
        distance = min(cell, farthest)
        _find_around(low, cell, shape, begins, points, x, y, distance, names, squares)
        while names[full] < 0 and distance < farthest:
            distance = min(2 * distance, farthest)
            _find_around(low, cell, shape, begins, points, x, y, distance, names, squares)
        last = squares[count - 1]
        nearest = certain = math.inf
        is_open = is_split = False
        for rank in range(len(names)):
            if names[rank] < 0 or squares[rank] > last:
                break
            k = names[rank]
            hx, hy = half[number[k], 0], half[number[k], 1]
            share, there = _project(x, y, points[k, 0], points[k, 1], hx, hy)
            px, py = points[k, 0] + share * hx, points[k, 1] + share * hy
            if there < nearest:
                nearest, is_split = there, False
                onto[place, 0], onto[place, 1] = px, py
            elif there == nearest and max(abs(px - onto[place, 0]), abs(py - onto[place, 1])) > same:
                is_split = True
            if squares[rank] < last:
                certain = min(certain, there)
            is_open |= rank >= count
        is_left_out = math.isfinite(last) and (squares[len(names) - 1] <= last or (is_open and not certain <= nearest))
        is_unsure[place] = is_split or is_left_out or not (math.isfinite(nearest) or reach < math.inf)
        apart[place] = nearest
        if nearest > reach or math.isinf(nearest):
            apart[place], onto[place, 0], onto[place, 1] = math.inf, x, y


@njit(nogil=True, cache=True, error_model="numpy")
def mark_pinched(low, cell, shape, begins, points, number, ring, place, around, reach, exempt, pinched):
    """Mark the points on rings that are near another one, and far from it along their ring.

    Parameters
    ----------
    points, number, ring, place : (N, 2) float64, (N,) int64, (N,) int64, (N,) float64
        Sorted: the points, their names, their rings, and how far along these they are.
    around : (R,) float64
        Length of each ring.
    reach, exempt : float
        A point is near up to `reach`; and far beyond `exempt` along the ring, either way, or on another one.
    pinched : (N,) bool
        Written where it is true: for each point, by its name.
    """
    limit = reach * reach
    for point in range(len(points)):
        x, y = points[point, 0], points[point, 1]
        left, right = _squares_around(x, reach, low[0], cell, shape[0])
        bottom, top = _squares_around(y, reach, low[1], cell, shape[1])
        if left > right:
            continue
        for row in range(bottom, top + 1):
            for k in range(begins[row * shape[0] + left], begins[row * shape[0] + right + 1]):
                dx, dy = x - points[k, 0], y - points[k, 1]
                if k == point or dx * dx + dy * dy > limit:
                    continue
                whole = around[ring[point]]
                way = abs(place[point] - place[k]) % whole
                if ring[k] != ring[point] or min(way, whole - way) > exempt:
                    pinched[number[point]] = True
