"""What holds infill up: the bead below it, and the beads beside it.

Both are shares of the infill's length. A point of a centre line is *supported* if a centre line of the layer below
passes within half a line width of it, so that at least half of the bead lies on something. It is *bonded* if another
stretch of infill passes in its own layer within 1.05 line widths, so that two beads touch.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LEAST_POINTS, MOST_POINTS = 1000, 5000  # of a layer that are looked at: with fewer, shares would be off
STEP = 0.4  # mm, of the pieces that paths are cut into; distances to pieces are exact
TOUCHING = 1.05  # line widths between two centre lines whose beads touch
OWN = 4.0  # line widths along a path within which it is its own neighbour
# Within 1.05 line widths of 0.45 mm lie 5 pieces of the path itself, and fewer of each other; more are looked at
# where beads are wider, or chords shorter.
NEIGHBOURS = 12


@dataclass(frozen=True, kw_only=True)
class Contact:
    """How much of some infill touches what.

    Parameters
    ----------
    length : float, mm
    supported, bonded : float, mm
        Lengths that lie on the layer below, and that touch something in their own layer.
    """

    length: float = 0.0
    supported: float = 0.0
    bonded: float = 0.0

    def __add__(self, other: Contact) -> Contact:
        return Contact(
            length=self.length + other.length,
            supported=self.supported + other.supported,
            bonded=self.bonded + other.bonded,
        )

    @property
    def shares(self) -> tuple[float, float]:
        """Supported and bonded per length, 0 to 1."""
        whole = self.length or 1.0
        return self.supported / whole, self.bonded / whole


@dataclass(frozen=True, kw_only=True)
class Samples:
    """Points along paths, each standing for `STEP` mm or less of them.

    Parameters
    ----------
    points : (N, 2) float64, mm
    weight : (N,) float64, mm
    path : (N,) int
    along : (N,) float64, mm
        Distance from the beginning of the path.
    half : (N, 2) float64, mm
        From a point to the end of its piece of the path.
    """

    points: Floats
    weight: Floats
    path: Places
    along: Floats
    half: Floats


def merged(one: Samples, other: Samples) -> Samples:
    """Return the samples of both; paths of the second are numbered anew."""
    number = int(one.path.max()) + 1 if len(one.path) else 0
    return Samples(
        points=np.concatenate([one.points, other.points]),
        weight=np.concatenate([one.weight, other.weight]),
        path=np.concatenate([one.path, other.path + number]),
        along=np.concatenate([one.along, other.along]),
        half=np.concatenate([one.half, other.half]),
    )


def sampled(points: Floats, first: Places, step: float = STEP) -> Samples:
    """Return the middles of equal pieces of every segment, at most `step` long.

    >>> sampled(np.array([[0.0, 0.0], [0.4, 0.0]]), np.array([0, 2]), 0.2).points[:, 0].round(3).tolist()
    [0.1, 0.3]
    """
    # Axis by axis: NumPy is slow along the short axis of an array.
    number = np.maximum(np.diff(first) - 1, 0)  # of segments
    path = np.repeat(np.arange(len(number)), number)
    inner = np.ones(len(points), dtype=bool)
    inner[first[1:] - 1] = False
    segment = np.flatnonzero(inner)
    x, y = points[segment].T
    dx, dy = (points[segment + 1] - points[segment]).T
    length = np.hypot(dx, dy)
    pieces = np.maximum(1, np.ceil(length / step - 1e-9)).astype(np.intp)
    of = np.repeat(np.arange(len(segment)), pieces)
    total = np.cumsum(pieces)
    share = (np.arange(len(of)) - (total - pieces)[of] + 0.5) / pieces[of]
    begins = np.concatenate([[0.0], np.cumsum(length)])
    starts = begins[np.cumsum(number) - number]
    where = path[of]
    dx_of, dy_of = dx[of], dy[of]
    halves = 2 * pieces[of]
    return Samples(
        points=np.stack([x[of] + share * dx_of, y[of] + share * dy_of], axis=1),
        weight=(length / pieces)[of],
        path=where,
        along=begins[of] + share * length[of] - starts[where],
        half=np.stack([dx_of / halves, dy_of / halves], axis=1),
    )


def contact(infill: Samples, below: Samples, line_width: float) -> Contact:
    """Measure one layer.

    Parameters
    ----------
    infill : Samples
        The infill of the layer.
    below : Samples
        Everything in the layer below.
    line_width : float, mm
    """
    from scipy.spatial import cKDTree

    if not len(infill.points):
        return Contact()
    # One of a few neighbours, anywhere on its piece: patterns repeat, and so would the error of a regular choice.
    random = np.random.default_rng(0)
    apart = max(1, len(infill.points) // MOST_POINTS)
    some = np.repeat(np.arange(0, len(infill.points), apart), max(1, LEAST_POINTS // len(infill.points)))
    some = np.minimum(some + random.integers(0, apart, len(some)), len(infill.points) - 1)
    aside = random.uniform(-1, 1, len(some))
    points = infill.points[some] + infill.half[some] * aside[:, None]
    along = infill.along[some] + infill.weight[some] * aside / 2
    weight = infill.weight[some] * (infill.weight.sum() / infill.weight[some].sum())
    supported: NDArray[np.bool_] = np.zeros(len(points), dtype=np.bool_)
    if len(below.points):
        reach = line_width / 2
        _, other = cKDTree(below.points, balanced_tree=False).query(points, k=3, distance_upper_bound=reach + STEP / 2)
        supported |= (_nearest(points, below, other)[0] <= reach).any(axis=1)
    bonded = _beside(points, infill.path[some], along, infill, TOUCHING * line_width)
    return Contact(
        length=float(infill.weight.sum()),
        supported=float(weight[supported].sum()),
        bonded=float(weight[bonded].sum()),
    )


def _nearest(points: Floats, others: Samples, which: Places) -> tuple[Floats, Floats]:
    """Return how far each point is from pieces of others, and where along their path it is nearest: mm, (N, k) both.

    Infinite where there is no piece.
    """
    there = which < len(others.points)
    which = np.where(there, which, 0)
    along, apart = projected(points, others.points, others.half, which)
    return np.where(there, apart, np.inf), others.along[which] + along * others.weight[which] / 2


def projected(points: Floats, middle: Floats, half: Floats, which: Places) -> tuple[Floats, Floats]:
    """Return where pieces of paths are nearest to points, and how far that is.

    Parameters
    ----------
    points : (N, 2) float64, mm
    middle, half : (K, 2) float64, mm
        Of pieces: their middle, and the way from there to their end.
    which : (N, k) int
        The pieces to look at for each point.

    Returns
    -------
    along : (N, k) float64
        From -1, the beginning of the piece, to 1, its end.
    apart : (N, k) float64, mm

    >>> projected(np.array([[3.0, 4.0]]), np.zeros((1, 2)), np.array([[2.0, 0.0]]), np.array([[0]]))[0].tolist()
    [[1.0]]
    """
    # Axis by axis: NumPy is slow along the short axis of an array.
    (mx, my), (hx, hy) = ([column[which] for column in each.T] for each in (middle, half))
    dx, dy = points[:, :1] - mx, points[:, 1:] - my
    along = np.clip((dx * hx + dy * hy) / np.maximum(hx**2 + hy**2, 1e-18), -1.0, 1.0)
    return along, np.hypot(dx - along * hx, dy - along * hy)


def _beside(points: Floats, path: Places, along: Floats, infill: Samples, reach: float) -> NDArray[np.bool_]:
    """Return which points, at certain places along paths of some infill, have another stretch of it within `reach`."""
    from scipy.spatial import cKDTree

    tree, number = cKDTree(infill.points, balanced_tree=False), len(infill.points)
    touches: NDArray[np.bool_] = np.zeros(len(points), dtype=np.bool_)
    left, count = np.arange(len(points)), NEIGHBOURS
    while len(left):
        count = min(count, number)
        _, other = tree.query(points[left], k=count, distance_upper_bound=reach + STEP / 2)
        other = other.reshape(len(left), -1)
        distance, there = _nearest(points[left], infill, other)
        full = other[:, -1] < number
        same = infill.path[np.minimum(other, number - 1)] == path[left, None]
        own = np.abs(there - along[left, None]) <= OWN * reach / TOUCHING
        touches[left] = ((distance <= reach) & ~(same & own)).any(axis=1)
        if count == number:
            break
        left, count = left[full & ~touches[left]], 4 * count
    return touches
