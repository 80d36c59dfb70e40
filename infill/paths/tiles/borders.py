r"""Turn the lines of a tile into the borders of two colours.

Lines can be the borders of two colours only if an even number of them meets at every point. The tile is repeated,
so all steps work on a torus:

Step 1. Open ends that lie close together, also across the edges of the tile, are merged.
Step 2. Lines are cut at each other, and duplicate pieces are dropped.
Step 3. Loose ends and junctions of three, five … lines are joined in pairs, along the lines, as shortly as that can
        be done. The way between a pair becomes a double line of two beads that touch; without it, the number is
        even everywhere. A loose stroke is doubled as a whole; of a honeycomb, one wall in three::

            __/      __//
              \\        \\

Step 4. At every crossing two sectors are connected, so that paths turn off instead of crossing: the sharp ones, so
        that paths bend by as little as possible; between equals, those that lie along x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.drawing import MOST_POINTS, Line
from infill.errors import GeometryError
from infill.graph import label_connected
from infill.paths.tiles.pairing import TileGraph, choose_doubled_parts
from infill.plain_numbers import plain_argument

CLOSE = 0.25  # line widths within which open ends are merged
TOUCH = 0.905  # line widths between the centres of two beads that touch
ALIKE = math.radians(20)  # difference of angles below which a crossing counts as square
ALONG = math.radians(10)  # near x, but not a line of symmetry
SNAP = 1e-7  # of a tile: precision to which lines are cut at each other
MERGE_DISTANCE = 1e-5  # of a tile: closer nodes are merged
CUT = (math.sqrt(3) - 1.7, math.sqrt(7) - 2.6)  # of a tile: its corner; drawings have no lines along these values
AHEAD = 0.03  # of a tile: distance from a crossing at which directions are measured
MOST_COPIES = 200  # of one line in a tile


@dataclass(frozen=True, kw_only=True)
class Borders:
    """Lines of one tile by their role, single or double; mm. Copies in the next tiles are left out.

    Parameters
    ----------
    single : (N, 2, 2) float64
        Ends of straight pieces between two colours.
    double : (M, 2, 2) float64
        Ends of straight pieces inside one colour, of which two beads are made.
    crossings : (K, 2) float64
        Where four single pieces or more meet.
    inward : (K, 2) float64
        A direction at each, of length 1, into a sector that is to be connected with those of its colour.
    """

    single: Floats
    double: Floats
    crossings: Floats
    inward: Floats


def find_borders(lines: list[Line], size: tuple[float, float], *, line_width: float) -> Borders:
    """Find the borders between two colours, and the lines to be doubled, in a tile from (0, 0) to `size`.

    Parameters
    ----------
    lines : list of (N, 2) float64
        The lines of one tile, mm; they may reach beyond it.
    size : (width, height)
        Of the tile, mm.
    line_width : float
        mm.

    Raises
    ------
    GeometryError
        If every line is shorter than a quarter of a line width at this size, or there are too many lines for a tile.
    """
    merged = _merge_ends(lines, size, CLOSE * line_width)
    if not merged:
        raise GeometryError(
            f"every line of the drawing is shorter than {plain_argument(CLOSE * line_width, 3)} mm in tiles of "
            f"{plain_argument(size[0], 4)} × {plain_argument(size[1], 4)} mm; make the cell larger"
        )
    graph = _cut_to_torus(_copies_in_tile(merged, size), size)
    double = choose_doubled_parts(graph)
    crossings, inward = _crossings(graph, ~double, AHEAD * min(size))
    single = _edges([part for part, is_double in zip(graph.parts, double, strict=True) if not is_double])
    doubled = _edges([part for part, is_double in zip(graph.parts, double, strict=True) if is_double])
    return Borders(single=single, double=doubled, crossings=crossings, inward=inward)


def _edges(parts: list[Line]) -> Floats:
    """Return the segments of lines, (S, 2, 2)."""
    pieces = [np.stack([part[:-1], part[1:]], axis=1) for part in parts]
    return np.concatenate(pieces) if pieces else np.empty((0, 2, 2))


def _merge_ends(lines: list[Line], size: tuple[float, float], tolerance: float) -> list[Line]:
    """Merge open ends that lie within a tolerance of each other, modulo the tile; return the lines."""
    ends = np.concatenate([line[[0, -1]] for line in lines])
    label, places = _cluster_points(ends, size, tolerance)
    new_ends = places[label] + np.array(size) * np.round((ends - places[label]) / size)
    result = []
    for line, line_ends in zip(lines, new_ends.reshape(-1, 2, 2), strict=True):
        inner = line[1:-1]
        # Points nearer to an end than it may move would make a spike.
        keep = np.minimum(np.hypot(*(inner - line[0]).T), np.hypot(*(inner - line[-1]).T)) > tolerance
        result.append(np.vstack([line_ends[:1], inner[keep], line_ends[1:]]))
    return [line for line in result if np.hypot(*np.diff(line, axis=0).T).sum() > 0]


def _cluster_points(points: Floats, size: tuple[float, float], tolerance: float) -> tuple[NDArray[np.intp], Floats]:
    """Cluster points on the torus; return the cluster of each point, and the places of clusters."""
    from scipy.spatial import KDTree

    box = np.array(size)
    wrapped = np.mod(points, box)
    wrapped[wrapped >= box] = 0  # rounding
    pairs = KDTree(wrapped, boxsize=box).query_pairs(tolerance, output_type="ndarray")
    label, _ = label_connected(pairs[:, 0], pairs[:, 1], len(points))
    _, representatives = np.unique(label, return_index=True)
    return label.astype(np.intp), wrapped[representatives]


def _copies_in_tile(lines: list[Line], size: tuple[float, float]) -> list[Line]:
    """Copy the lines to every tile from which they may reach into the tile, wherever it is cut out."""
    copies: list[Line] = []
    points = 0
    box = np.array(size)
    for line in lines:
        lowest = np.ceil(-line.max(axis=0) / box).astype(int)
        highest = np.floor((2 * box - line.min(axis=0)) / box).astype(int)
        count = int(np.prod(np.maximum(highest - lowest + 1, 0)))
        points += len(line) * count
        if points > MOST_POINTS or count > MOST_COPIES:
            raise GeometryError(
                f"draw on the page: {count} copies of a line, or {points} points, meet in a tile of "
                f"{plain_argument(size[0], 4)} × {plain_argument(size[1], 4)} mm; the limits are {MOST_COPIES} and "
                f"{MOST_POINTS}"
            )
        for i in range(lowest[0], highest[0] + 1):
            copies += [line + box * (i, j) for j in range(lowest[1], highest[1] + 1)]
    return copies


def _cut_to_torus(copies: list[Line], size: tuple[float, float]) -> TileGraph:
    """Cut the lines of one tile at each other and at its edges."""
    import shapely

    owner = np.repeat(np.arange(len(copies)), [len(line) for line in copies])
    lines = shapely.linestrings(np.concatenate(copies), indices=owner)
    noded = shapely.union_all(lines, grid_size=SNAP * max(size))
    x, y = (share * side for share, side in zip(CUT, size, strict=True))
    cut = shapely.line_merge(shapely.intersection(noded, shapely.box(x, y, x + size[0], y + size[1])))
    parts = shapely.get_parts(cut)
    parts = [shapely.get_coordinates(part) for part in parts[shapely.get_type_id(parts) == 1]]
    ends = np.concatenate([part[[0, -1]] for part in parts])
    label, places = _cluster_points(ends, size, MERGE_DISTANCE * max(size))
    return TileGraph(parts=parts, node=label.reshape(-1, 2), places=places)


def _crossings(graph: TileGraph, chosen: NDArray[np.bool_], ahead: float) -> tuple[Floats, Floats]:
    """Find the crossings of four single parts or more, and a direction into a sector to connect at each."""
    import shapely

    leg_angles: dict[int, list[float]] = {int(node): [] for node in np.flatnonzero(graph.degree(chosen) >= 4)}
    for number in np.flatnonzero(chosen):
        for end, node in zip((1, -1), graph.node[number].tolist(), strict=True):
            if node in leg_angles:
                line = graph.parts[number][::end]
                ahead_point = shapely.line_interpolate_point(shapely.linestrings(line), ahead)
                leg = shapely.get_coordinates(ahead_point)[0] - line[0]
                leg_angles[node].append(math.atan2(leg[1], leg[0]))
    inward = [_sector(np.sort(angles)) for angles in leg_angles.values()]
    return graph.places[list(leg_angles)].reshape(-1, 2), np.array(inward).reshape(-1, 2)


def _sector(angles: Floats) -> tuple[float, float]:
    """Return the direction of a sector between lines at sorted angles, of the colour to connect."""
    widths = np.diff(angles, append=angles[0] + 2 * math.pi)
    middles = angles + widths / 2
    sharp = widths[::2].sum() - widths[1::2].sum()
    along = [float(np.abs(np.cos(middles[k::2] - ALONG)).max()) for k in (0, 1)]
    colour = (0 if along[0] > along[1] else 1) if abs(sharp) < ALIKE else (0 if sharp < 0 else 1)
    middle = float(middles[colour])
    return math.cos(middle), math.sin(middle)
