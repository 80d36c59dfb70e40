"""Cut a solid into strips along y: pieces of bounded size, which share their corners with the contours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.contours.zero_contours import Contours, permutation_cycles

Indices = NDArray[np.intp]

CORNERS = 1000  # of a strip, about; see `infill.contours.triangulation`
CUT_CLEARANCE = 1e-5  # of all x: smallest distance of a cut from corners, so that a 32-bit file does not merge them


@dataclass(frozen=True, kw_only=True, eq=False)
class Strips:
    """The solid inside contours, as pieces.

    Parameters
    ----------
    contours : Contours
        The contours, with a corner where a cut crosses them.
    order : (N,) int
        Corners of the contours in the order of the rings around all pieces and around their holes: one ring after
        another, solid on the left.
    first : (R + 1,) int
        Where each ring begins in `order`, and N.
    """

    contours: Contours
    order: Indices
    first: Indices


def cut_strips(contours: Contours, corners: int = CORNERS) -> Strips:
    """Cut the solid inside contours at values of x, so that a strip has about `corners` corners.

    >>> square = Contours(points=np.array([[0.0, 0], [2, 0], [2, 1], [0, 1]]), first=np.array([0, 4]))
    >>> halves = cut_strips(square, 2)
    >>> len(halves.contours.points), halves.first.tolist()
    (6, [0, 4, 8])
    """
    cuts = _choose_cuts(contours.points[:, 0], corners)
    cut, number = _add_crossings(contours, cuts)
    steps, right = _successors(cut, number)
    order, first = permutation_cycles(steps)
    return Strips(contours=cut, order=np.concatenate([np.arange(len(number)), right])[order], first=first)


def _choose_cuts(x: Floats, corners: int) -> Floats:
    """Choose the cuts: each in the widest gap between the corners' x near a quantile."""
    count = -(-len(x) // corners)
    if count < 2:
        return np.empty(0)
    ordered = np.sort(x)
    gaps = np.diff(ordered)
    clearance = 2 * CUT_CLEARANCE * max(float(np.abs(ordered[[0, -1]]).max()), float(ordered[-1] - ordered[0]))
    cuts = []
    for number in range(1, count):
        low, high = (round(len(gaps) * (number + side) / count) for side in (-0.25, 0.25))
        widest = low + int(gaps[low : max(high, low + 1)].argmax())
        if gaps[widest] > clearance:
            cuts.append((ordered[widest] + ordered[widest + 1]) / 2)
    return np.unique(np.array(cuts))


def _add_crossings(contours: Contours, cuts: Floats) -> tuple[Contours, Indices]:
    """Add corners where cuts cross the contours; return them, numbered 2 n + 1 on cut n, 2 n in the strip before it."""
    points, ahead = contours.points, contours.ahead
    strip = np.searchsorted(cuts, points[:, 0])
    across = strip[ahead] - strip
    counts = np.abs(across) + 1
    ends = np.cumsum(counts)
    edge = np.repeat(np.arange(len(points)), counts)
    place = np.arange(len(edge)) - (ends - counts)[edge]
    new = place > 0
    crossed_edge, rank = edge[new], place[new]
    cut_index = np.where(across[crossed_edge] > 0, strip[crossed_edge] + rank - 1, strip[crossed_edge] - rank)
    start, end = points[crossed_edge], points[ahead[crossed_edge]]
    share = (cuts[cut_index] - start[:, 0]) / (end[:, 0] - start[:, 0])
    corners, number = points[edge], 2 * strip[edge]
    corners[new] = np.stack([cuts[cut_index], start[:, 1] + share * (end[:, 1] - start[:, 1])], axis=1)
    number[new] = 2 * cut_index + 1
    first = np.append(0, ends)[contours.first]
    return Contours(points=corners, first=first.astype(np.intp)), number


def _successors(contours: Contours, number: Indices) -> tuple[Indices, Indices]:
    """Return the next corner around each piece, (N + C,), and the C corners on cuts, by cut and then by y.

    A corner on a cut appears once for the strip on its left, and again, after all corners, for the strip on its right.
    """
    count, ahead = len(number), contours.ahead
    on_cut = np.flatnonzero(number % 2)
    on_cut = on_cut[np.lexsort((contours.points[on_cut, 1], number[on_cut]))]
    twin = np.arange(count)
    twin[on_cut] = count + np.arange(len(on_cut))
    next_number = number[ahead]
    # The strip of the edge from each corner to the next, which lies in a single strip.
    strip = np.where(
        number % 2 == 0, number, np.where(next_number % 2 == 0, next_number, np.maximum(number, next_number) - 1)
    )
    corner = np.arange(count)
    steps = np.empty(count + len(on_cut), dtype=np.intp)
    steps[np.where(strip > number, twin, corner)] = np.where(strip > next_number, twin[ahead], ahead)
    # Along a cut, solid lies between the first crossing and the second, the third and the fourth, ...
    low, high = on_cut[::2], on_cut[1::2]
    steps[low] = high
    steps[twin[high]] = twin[low]
    return steps, on_cut
