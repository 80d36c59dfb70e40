"""Support of infill by the layer below, its contact with the beads beside it, and its hold on the walls.

All are shares of the infill's length. A point of a centre line is *supported* if a centre line of the layer below
passes within half a line width of it, so that at least half of the bead lies on something. It is *bonded* if another
stretch of infill passes in its own layer within 1.05 line widths, so that two beads touch. A path is *free* if neither
it nor any path that it touches, over however many others, touches another bead of its layer, such as a wall.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats, Places
from infill.kernels.compiling import log_compilation
from infill.paths.point_grid import SEARCHES, join_near_paths, sort_into_grid

LEAST_POINTS, MOST_POINTS = 1000, 5000  # sampled points in a layer: with fewer, shares would be inaccurate
STEP = 0.4  # mm, of the pieces that paths are cut into; distances to pieces are exact
TOUCHING = 1.05  # line widths between two centre lines whose beads touch
HOLDING = 1.1  # line widths between the centre lines of two paths that hold each other; beads of walls may be wider
SELF_STRETCH = 4.0  # line widths along a path within which it is its own neighbour


@dataclass(frozen=True, kw_only=True)
class Contact:
    """Length of some infill, and the lengths of it that are supported, bonded and free.

    Parameters
    ----------
    length : float, mm
    supported, bonded : float, mm
        Lengths that lie on the layer below, and that touch something in their own layer.
    free : float, mm
        Length of the paths that no wall of their layer holds, not even through other paths.
    """

    length: float = 0.0
    supported: float = 0.0
    bonded: float = 0.0
    free: float = 0.0

    def __add__(self, other: Contact) -> Contact:
        return Contact(
            length=self.length + other.length,
            supported=self.supported + other.supported,
            bonded=self.bonded + other.bonded,
            free=self.free + other.free,
        )

    @property
    def shares(self) -> tuple[float, float]:
        """Supported and bonded per length, 0 to 1."""
        length = self.length or 1.0
        return self.supported / length, self.bonded / length

    @property
    def free_share(self) -> float:
        """Free per length, 0 to 1."""
        return self.free / (self.length or 1.0)


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


def concatenate_samples(a: Samples, b: Samples) -> Samples:
    """Concatenate samples; the paths of the second follow those of the first in number."""
    count = int(a.path.max()) + 1 if len(a.path) else 0
    return Samples(
        points=np.concatenate([a.points, b.points]),
        weight=np.concatenate([a.weight, b.weight]),
        path=np.concatenate([a.path, b.path + count]),
        along=np.concatenate([a.along, b.along]),
        half=np.concatenate([a.half, b.half]),
    )


def sample_paths(points: Floats, offsets: Places, step: float = STEP) -> Samples:
    """Cut every segment into equal pieces, at most `step` long; return their middles.

    >>> sample_paths(np.array([[0.0, 0.0], [0.4, 0.0]]), np.array([0, 2]), 0.2).points[:, 0].round(3).tolist()
    [0.1, 0.3]
    """
    # Axis by axis: NumPy is slow along the short axis of an array.
    number = np.maximum(np.diff(offsets) - 1, 0)  # of segments
    path = np.repeat(np.arange(len(number)), number)
    inner = np.ones(len(points), dtype=bool)
    inner[offsets[1:] - 1] = False
    segment = np.flatnonzero(inner)
    x, y = points[segment].T
    dx, dy = (points[segment + 1] - points[segment]).T
    length = np.hypot(dx, dy)
    pieces = np.maximum(1, np.ceil(length / step - 1e-9)).astype(np.intp)
    segment_of = np.repeat(np.arange(len(segment)), pieces)
    total = np.cumsum(pieces)
    share = (np.arange(len(segment_of)) - (total - pieces)[segment_of] + 0.5) / pieces[segment_of]
    begins = np.concatenate([[0.0], np.cumsum(length)])
    starts = begins[np.cumsum(number) - number]
    path_of = path[segment_of]
    dx_of, dy_of = dx[segment_of], dy[segment_of]
    halves = 2 * pieces[segment_of]
    return Samples(
        points=np.stack([x[segment_of] + share * dx_of, y[segment_of] + share * dy_of], axis=1),
        weight=(length / pieces)[segment_of],
        path=path_of,
        along=begins[segment_of] + share * length[segment_of] - starts[path_of],
        half=np.stack([dx_of / halves, dy_of / halves], axis=1),
    )


def layer_contact(infill: Samples, below: Samples, line_width: float) -> Contact:
    """Measure one layer.

    Parameters
    ----------
    infill : Samples
        The infill of the layer.
    below : Samples
        Everything in the layer below.
    line_width : float, mm
    """
    if not len(infill.points):
        return Contact()
    # One of a few neighbours, anywhere on its piece: patterns repeat, and so would the error of a regular choice.
    random = np.random.default_rng(0)
    stride = max(1, len(infill.points) // MOST_POINTS)
    chosen = np.repeat(np.arange(0, len(infill.points), stride), max(1, LEAST_POINTS // len(infill.points)))
    chosen = np.minimum(chosen + random.integers(0, stride, len(chosen)), len(infill.points) - 1)
    jitter = random.uniform(-1, 1, len(chosen))
    points = infill.points[chosen] + infill.half[chosen] * jitter[:, None]
    along = infill.along[chosen] + infill.weight[chosen] * jitter / 2
    weight = infill.weight[chosen] * (infill.weight.sum() / infill.weight[chosen].sum())
    supported: NDArray[np.bool_] = np.zeros(len(points), dtype=np.bool_)
    if len(below.points):
        supported |= are_near(points, below, line_width / 2)
    bonded = are_beside(points, infill.path[chosen], along, infill, TOUCHING * line_width)
    return Contact(
        length=float(infill.weight.sum()),
        supported=float(weight[supported].sum()),
        bonded=float(weight[bonded].sum()),
    )


def free_length(infill: Samples, walls: Samples, line_width: float) -> float:
    """Measure the length, mm, of the paths of a layer that no wall holds, not even through other paths.

    Parameters
    ----------
    infill : Samples
        The infill of the layer.
    walls : Samples
        All other beads of the layer.
    line_width : float, mm

    >>> wall, across, aside = ([[0.0, 0], [9, 0]], [[2.0, 0.4], [2, 5]], [[4.0, 2], [4, 5]])
    >>> infill = sample_paths(np.array([*across, *aside]), np.array([0, 2, 4]))
    >>> round(free_length(infill, sample_paths(np.array(wall), np.array([0, 2])), 0.45), 9)
    3.0
    """
    if not len(infill.points):
        return 0.0
    # The ends of the pieces, too: a path may touch a wall with its very end.
    points = np.concatenate([infill.points, infill.points - infill.half, infill.points + infill.half])
    path, reach = np.tile(infill.path, 3), HOLDING * line_width
    count = int(path.max()) + 1
    holds: Flags = np.zeros(count, dtype=np.bool_)
    if len(walls.points):
        holds[path[are_near(points, walls, reach)]] = True
    if not holds[infill.path].all():
        group = join_near_paths(points, path, reach)
        holds = (np.bincount(group, weights=holds) > 0)[group]
    return float(infill.weight[~holds[infill.path]].sum())


def are_near(points: Floats, samples: Samples, reach: float) -> Flags:
    """Tell which points, (N, 2), have one of the three pieces with the nearest middles within `reach`, mm.

    Parameters
    ----------
    points : (N, 2) float64, mm
    samples : Samples
        At least one.
    reach : float, mm
    """
    from infill.kernels.point_grids import find_near_pieces

    grid, near = sort_into_grid(samples.points), np.empty(len(points), dtype=np.bool_)
    with log_compilation(SEARCHES):
        find_near_pieces(
            *grid.squares, samples.half[grid.number], np.ascontiguousarray(points), reach + STEP / 2, reach, near
        )
    return near


def project_to_pieces(points: Floats, middle: Floats, half: Floats, which: Places) -> tuple[Floats, Floats]:
    """Project points onto pieces of paths; return the nearest places and the distances.

    Parameters
    ----------
    points : (N, 2) float64, mm
    middle, half : (K, 2) float64, mm
        Of pieces: their middle, and the way from there to their end.
    which : (N, k) int
        Candidate pieces of each point.

    Returns
    -------
    along : (N, k) float64
        From -1, the beginning of the piece, to 1, its end.
    apart : (N, k) float64, mm

    >>> project_to_pieces(np.array([[3.0, 4.0]]), np.zeros((1, 2)), np.array([[2.0, 0.0]]), np.array([[0]]))[0].tolist()
    [[1.0]]
    """
    # Axis by axis: NumPy is slow along the short axis of an array.
    (mx, my), (hx, hy) = ([column[which] for column in pairs.T] for pairs in (middle, half))
    dx, dy = points[:, :1] - mx, points[:, 1:] - my
    along = np.clip((dx * hx + dy * hy) / np.maximum(hx**2 + hy**2, 1e-18), -1.0, 1.0)
    return along, np.hypot(dx - along * hx, dy - along * hy)


def are_beside(points: Floats, path: Places, along: Floats, infill: Samples, reach: float) -> Flags:
    """Tell which points on paths of the infill have another stretch of it within `reach`.

    Parameters
    ----------
    points, path, along : (N, 2), (N,), (N,)
        As in `Samples`.
    infill : Samples
        At least one.
    reach : float, mm
    """
    from infill.kernels.point_grids import find_beside

    grid, beside = sort_into_grid(infill.points), np.empty(len(points), dtype=np.bool_)
    pieces = (column[grid.number] for column in (infill.half, infill.path, infill.along, infill.weight))
    stretch = SELF_STRETCH * reach / TOUCHING
    with log_compilation(SEARCHES):
        find_beside(
            *grid.squares, *pieces, np.ascontiguousarray(points), path, along, reach + STEP / 2, reach, stretch, beside
        )
    return beside
