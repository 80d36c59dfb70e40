r"""The lines of a tile, put so that they part the plane into two colours.

Lines can be the borders of two colours only if an even number of them meets at every point. The tile is repeated,
so this is asked on a torus:

Step 1. Open ends that lie close together, seen across the edges of the tile too, are put on one another.
Step 2. Lines are cut at each other, and what is drawn twice is taken once.
Step 3. Where lines hang together with a loose end or a junction of three, no two colours will do. They are
        replaced by their outline at half a bead on either side: two paths that touch::

            --+--      ==' '==
              |   ->     | |

Step 4. At every crossing it is said which sectors are one piece, so that paths turn off instead of crossing: the
        sharp ones, so that paths bend by as little as possible; between equals, those that lie along x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.formats.drawing import MOST_POINTS, Line

Floats = NDArray[np.float64]

CLOSE = 0.25  # line widths within which open ends are taken for one
TOUCH = 0.905  # line widths between the centres of two beads that touch
ALIKE = math.radians(20)  # difference of angles below which a crossing counts as square
ALONG = math.radians(10)  # near x, but no line of symmetry
SNAP = 1e-7  # of a tile


@dataclass(frozen=True, kw_only=True)
class Borders:
    """Edges between two colours around one tile.

    Parameters
    ----------
    edges : (N, 2, 2) float64
        Ends of straight pieces, mm.
    crossings : (M, 2) float64
        Where four pieces or more meet, mm.
    inward : (M, 2) float64
        A direction at each, of length 1, into a sector that is to be connected with those of its colour.
    """

    edges: Floats
    crossings: Floats
    inward: Floats


def borders(lines: list[Line], size: tuple[float, float], *, line_width: float, reach: float) -> Borders:
    """Return the borders between two colours from `reach` outside the tile (0, 0) to `size`, mm.

    Parameters
    ----------
    lines : list of (N, 2) float64
        The lines of one tile, mm; they may reach beyond it.
    size : (width, height)
        Of the tile, mm.
    line_width : float
        mm.
    reach : float
        mm around the tile within which borders are wanted.
    """
    import shapely

    copies = _copies(_ends_together(lines, size, CLOSE * line_width), size, reach)
    noded = shapely.union_all(_as_lines(copies), grid_size=SNAP * max(size))
    parts = shapely.get_parts(shapely.line_merge(noded))
    parts = parts[shapely.get_type_id(parts) == 1]
    ends = shapely.get_coordinates(shapely.get_point(np.repeat(parts, 2), np.tile([0, -1], len(parts))))
    node, places, degree = _nodes(ends, size)
    odd = _odd_parts(node, places, degree, size)
    even, rest = parts[~odd], parts[odd]
    crossings, inward = _crossings(even, node.reshape(-1, 2)[~odd].ravel(), places, degree, line_width)
    if len(rest):
        outline = shapely.boundary(shapely.buffer(shapely.union_all(rest), TOUCH / 2 * line_width, quad_segs=16))
        even = np.concatenate([even, shapely.get_parts(outline)])
    coordinates, owner = shapely.get_coordinates(even, return_index=True)
    edges = np.stack([coordinates[:-1], coordinates[1:]], axis=1)[owner[1:] == owner[:-1]]
    return Borders(edges=edges, crossings=crossings, inward=inward)


def _as_lines(lines: list[Line]) -> NDArray[np.object_]:
    import shapely

    owner = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    found: NDArray[np.object_] = shapely.linestrings(np.concatenate(lines), indices=owner)
    return found


def _ends_together(lines: list[Line], size: tuple[float, float], tolerance: float) -> list[Line]:
    """Return the lines with open ends that lie within a tolerance of each other, modulo the tile, on one point."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import KDTree

    box = np.array(size)
    ends = np.concatenate([line[[0, -1]] for line in lines])
    wrapped = np.mod(ends, box)
    wrapped[wrapped >= box] = 0  # rounding
    pairs = KDTree(wrapped, boxsize=box).query_pairs(tolerance, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(ends), len(ends)))
    _, label = connected_components(graph, directed=False)
    _, first = np.unique(label, return_index=True)
    target = wrapped[first[label]]
    moved = target + box * np.round((ends - target) / box)
    together = []
    for line, pair in zip(lines, moved.reshape(-1, 2, 2), strict=True):
        inner = line[1:-1]
        # Points nearer to an end than it may move would make a spike.
        keep = np.hypot(*(inner - line[0]).T) > tolerance
        keep &= np.hypot(*(inner - line[-1]).T) > tolerance
        together.append(np.vstack([pair[:1], inner[keep], pair[1:]]))
    return [line for line in together if len(line) > 2 or np.hypot(*(line[1] - line[0])) > 0]


def _copies(lines: list[Line], size: tuple[float, float], reach: float) -> list[Line]:
    """Return every copy of the lines that comes within `reach` of the tile."""
    copies: list[Line] = []
    points = 0
    box = np.array(size)
    for line in lines:
        first = np.ceil((-reach - line.max(axis=0)) / box).astype(int)
        last = np.floor((box + reach - line.min(axis=0)) / box).astype(int)
        points += len(line) * int(np.prod(np.maximum(last - first + 1, 0)))
        if points > 4 * MOST_POINTS:
            raise GeometryError(
                f"the drawing and its copies hold more than {4 * MOST_POINTS} points in a tile of {size[0]:.4g} × "
                f"{size[1]:.4g} mm; give a simpler drawing, or one that lies on its page"
            )
        for i in range(first[0], last[0] + 1):
            copies += [line + box * (i, j) for j in range(first[1], last[1] + 1)]
    return copies


def _nodes(ends: Floats, size: tuple[float, float]) -> tuple[NDArray[np.intp], Floats, NDArray[np.intp]]:
    """Return the number of the node at each end, where the nodes lie, and how many ends meet there."""
    keys = np.round(ends / (4 * SNAP * max(size)))
    _, first, node, degree = np.unique(keys, axis=0, return_index=True, return_inverse=True, return_counts=True)
    return node.ravel(), ends[first], degree


def _odd_parts(
    node: NDArray[np.intp], places: Floats, degree: NDArray[np.intp], size: tuple[float, float]
) -> NDArray[np.bool_]:
    """Return which parts hang together, on the torus, with a node where an odd number of ends meets."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import KDTree

    box = np.array(size)
    slack = 1e-5 * max(size)
    inside = ((places > -slack) & (places < box + slack)).all(axis=1)  # all copies that meet there are present
    wrapped = np.mod(places, box)
    wrapped[wrapped >= box] = 0
    same = KDTree(wrapped, boxsize=box).query_pairs(slack, output_type="ndarray")
    joined = np.concatenate([same, node.reshape(-1, 2)])
    graph = coo_array((np.ones(len(joined)), (joined[:, 0], joined[:, 1])), shape=(len(places), len(places)))
    count, label = connected_components(graph, directed=False)
    odd = np.zeros(count, dtype=bool)
    odd[label[inside & (degree % 2 == 1)]] = True
    found: NDArray[np.bool_] = odd[label[node[::2]]]
    return found


def _crossings(
    parts: NDArray[np.object_],
    node: NDArray[np.intp],
    places: Floats,
    degree: NDArray[np.intp],
    line_width: float,
) -> tuple[Floats, Floats]:
    """Return where four parts or more meet, and a direction into a sector that is to be connected there."""
    import shapely

    both = np.repeat(parts, 2)
    ahead = np.minimum(line_width / 2, shapely.length(both) / 2)
    ahead[1::2] *= -1  # from the far end
    near = shapely.get_coordinates(shapely.line_interpolate_point(both, ahead))
    legs = near - places[node]
    angles = np.arctan2(legs[:, 1], legs[:, 0])
    crossings, inward = [], []
    order = np.argsort(node, kind="stable")
    starts = np.searchsorted(node[order], np.flatnonzero(degree >= 4))
    for number, start in zip(np.flatnonzero(degree >= 4), starts, strict=True):
        here = np.sort(angles[order[start : start + degree[number]]])
        if start < len(order) and node[order[start]] == number:
            crossings.append(places[number])
            inward.append(_sector(here))
    return np.array(crossings).reshape(-1, 2), np.array(inward).reshape(-1, 2)


def _sector(angles: Floats) -> tuple[float, float]:
    """Return the direction of a sector between lines at sorted angles, of the colour that is to be connected."""
    widths = np.diff(angles, append=angles[0] + 2 * math.pi)
    middles = angles + widths / 2
    sharp = widths[::2].sum() - widths[1::2].sum()
    along = [float(np.abs(np.cos(middles[k::2] - ALONG)).max()) for k in (0, 1)]
    colour = (0 if along[0] > along[1] else 1) if abs(sharp) < ALIKE else (0 if sharp < 0 else 1)
    middle = float(middles[colour])
    return math.cos(middle), math.sin(middle)
