"""What holds a print's infill together, measured on the G-code by other means than the package's.

Supported is what lies on the layer below: its centre line over a bead there, of any role. Bonded is what touches
another line of infill at its side: a doubled wall.
"""

from __future__ import annotations

import numpy as np
import shapely
from scipy.spatial import cKDTree

from tests.gcode_judge import Move, lines_of, replayed

STEP = 0.1  # mm between samples
TOUCH = 1.05  # line widths from centre line to centre line: beads overlap by a tenth where they touch


def layers_of(data: bytes) -> list[tuple[float, list[Move], list[Move]]]:
    """Return height, beads of the sparse infill and all other beads of each layer, upwards."""
    found: dict[float, tuple[list[Move], list[Move]]] = {}
    parts, runs = replayed(data)
    for part, ran in zip(parts, runs, strict=True):
        for move in ran.beads():
            found.setdefault(round(move.end[2], 3), ([], []))[not part.sparse].append(move)
    return [(z, *found[z]) for z in sorted(found)]


def covered(moves: list[Move]):
    """Return the area of beads."""
    lines = [shapely.linestrings(path) for path in lines_of(moves)]
    return shapely.union_all(shapely.buffer(lines, width_of(moves) / 2, quad_segs=3))


def width_of(moves: list[Move]) -> float:
    """Return the width that half of the length has, or more: short chords are many, and count for little."""
    width = np.array([move.width or 0.45 for move in moves])
    length = np.array([np.hypot(move.end[0] - move.start[0], move.end[1] - move.start[1]) for move in moves])
    order = np.argsort(width)
    return float(width[order][np.searchsorted(np.cumsum(length[order]), length.sum() / 2)])


def supported(data: bytes) -> float:
    """Return the share of the infill's length that lies on a bead of the layer below."""
    held, whole = held_up(data)
    return held / whole if whole else 1.0


def held_up(data: bytes) -> tuple[float, float]:
    """Return how much of the infill lies on a bead of the layer below, mm, and how much there is above a layer."""
    whole = held = 0.0
    below: list[list[Move]] = []  # beads of infill and all others, which may have another width
    for _, infill, rest in layers_of(data):
        if infill and below:
            pieces = [shapely.linestrings(path) for path in lines_of(infill)]
            x, y, right, top = shapely.total_bounds(pieces)
            box = shapely.box(x - 2, y - 2, right + 2, top + 2)
            ground = shapely.intersection(shapely.union_all([covered(moves) for moves in below]), box)
            shapely.prepare(ground)
            whole += shapely.length(pieces).sum()
            held += shapely.length(shapely.intersection(pieces, ground)).sum()
        below = [moves for moves in (infill, rest) if moves]
    return float(held), float(whole)


def bonded(data: bytes) -> float:
    """Return the share of the infill's length beside which another strand of it lies, as near as beads touch."""
    touching, whole = touched(data)
    return touching / whole if whole else 0.0


def touched(data: bytes) -> tuple[float, float]:
    """Return how much of the infill lies beside another strand of it, mm, and how much there is."""
    whole = touching = 0
    for _, infill, _ in layers_of(data):
        if not infill:
            continue
        points, along, path = samples(lines_of(infill))
        width = width_of(infill)
        i, j = cKDTree(points).query_pairs(TOUCH * width, output_type="ndarray").reshape(-1, 2).T
        # The same strand, a little further along, is no neighbour; nor one that is crossed.
        beside = (path[i] != path[j]) | (np.abs(along[i] - along[j]) > 4 * width)
        whole += len(points)
        touching += len(np.unique(np.concatenate([i[beside], j[beside]])))
    return touching * STEP, whole * STEP


def samples(paths: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points along paths, a step apart, with their place along the path and the path's number."""
    points, along, number = [], [], []
    for k, path in enumerate(paths):
        length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
        at = np.arange(STEP / 2, length[-1], STEP)
        points.append(np.column_stack([np.interp(at, length, path[:, 0]), np.interp(at, length, path[:, 1])]))
        along.append(at)
        number.append(np.full(len(at), k))
    return np.concatenate(points), np.concatenate(along), np.concatenate(number)
