"""The density of sparse infill from place to place, as the G-code of a print has it; nothing here is of the package.

The density of a box is the filament that the infill pushes out in it, over the volume of the box: the beads of a slicer
whose lines touch would fill it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from tests.gap_judge import SPARSE
from tests.gcode_judge import arc

FILAMENT = math.pi / 4 * 1.75**2  # mm²
_TAG = re.compile(r"(?:;TYPE:|; FEATURE: )(.*)")
_WORD = re.compile(r"([XYZEFIJ])(-?[\d.]+)")


@dataclass
class SparseLayer:
    """Paths of the sparse infill of a layer, (N, 2) each, mm, and the filament of each of their moves, mm."""

    z: float
    height: float
    paths: list[np.ndarray]
    pushed: list[np.ndarray]

    @property
    def filament(self) -> float:
        """Filament of all of them, mm."""
        return float(sum(amounts.sum() for amounts in self.pushed))

    @property
    def moves(self) -> tuple[np.ndarray, np.ndarray]:
        """Both ends of all moves, (K, 2, 2), and their filament, (K,)."""
        ends = [np.stack([path[:-1], path[1:]], axis=1) for path in self.paths]
        return np.concatenate(ends), np.concatenate(self.pushed)


def read_sparse(text: str) -> list[SparseLayer]:
    """Read the layers with infill of a print in relative E."""
    layers: list[SparseLayer] = []
    role, height = "", 0.2
    x = y = z = math.nan
    path: list[tuple[float, float]] = []
    amounts: list[float] = []

    def close() -> None:
        if amounts:
            if not layers or layers[-1].z != z:
                layers.append(SparseLayer(z=z, height=height, paths=[], pushed=[]))
            layers[-1].paths.append(np.array(path))
            layers[-1].pushed.append(np.array(amounts))
        path.clear()
        amounts.clear()

    for line in text.splitlines():
        if tag := _TAG.match(line):
            close()
            role = tag[1].strip()
        elif line.startswith(";HEIGHT:"):
            height = float(line[8:])
        elif line.startswith(("G0 ", "G1 ", "G2 ", "G3 ")):
            words = {name: float(value) for name, value in _WORD.findall(line.split(";")[0])}
            if words.get("Z", z) != z:
                close()
                z = words["Z"]
            to = words.get("X", x), words.get("Y", y)
            if words.get("E", 0.0) > 0 and to != (x, y) and role in SPARSE:
                if not path:
                    path.append((x, y))
                points = arc((x, y), to, words, clockwise=line[1] == "2")[1:] if line[1] in "23" else (to,)
                path += points
                amounts += [words["E"] / len(points)] * len(points)
            elif to != (x, y):
                close()
            x, y = to
    close()
    return layers


def box_density(layers: Sequence[SparseLayer], low: np.ndarray, high: np.ndarray) -> float:
    """Return the density of a box in the plane, on average over some layers."""
    filament = volume = 0.0
    for layer in layers:
        ends, pushed = layer.moves
        near = ((ends.max(axis=1) >= low) & (ends.min(axis=1) <= high)).all(axis=1)
        filament += float((_share_inside(ends[near], low, high) * pushed[near]).sum())
        volume += float(np.prod(high - low)) * layer.height
    return filament * FILAMENT / volume


def _share_inside(ends: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the share of moves, (K, 2, 2), that lies in a box."""
    begin, step = ends[:, 0], ends[:, 1] - ends[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        at = np.stack([(low - begin) / step, (high - begin) / step])
    beside = (begin < low) | (begin > high)
    enter = np.where(step == 0, np.where(beside, np.inf, -np.inf), at.min(axis=0)).max(axis=1)
    leave = np.where(step == 0, np.where(beside, -np.inf, np.inf), at.max(axis=0)).min(axis=1)
    return np.maximum(np.minimum(leave, 1.0) - np.maximum(enter, 0.0), 0.0)


def local_densities(
    layers: Sequence[SparseLayer],
    region: shapely.Geometry,
    wanted: Callable[[np.ndarray], np.ndarray],
    side: Callable[[float], float],
    number: int = 12,
) -> np.ndarray:
    """Return wanted and actual density, (N, 2), of boxes that lie in a region: as wide as `side` says for a density.

    A box of two cells holds more or less line as its sides meet the pattern, so each counts with boxes that are shifted by
    up to a quarter of its side.
    """
    x0, y0, x1, y1 = region.bounds
    rows = []
    for x in np.linspace(x0, x1, number):
        for y in np.linspace(y0, y1, number):
            half = side(float(wanted(np.array([[x, y]]))[0])) / 2
            if not region.covers(shapely.box(x - 1.5 * half, y - 1.5 * half, x + 1.5 * half, y + 1.5 * half)):
                continue
            densities, needs = [], []
            for shift in np.stack(np.meshgrid(*[np.linspace(-half / 2, half / 2, 4)] * 2), axis=-1).reshape(-1, 2):
                low, high = np.array([x, y]) + shift - half, np.array([x, y]) + shift + half
                grid = np.stack(np.meshgrid(*np.linspace(low, high, 7).T), axis=-1).reshape(-1, 2)
                densities.append(box_density(layers, low, high))
                needs.append(wanted(grid).mean())
            rows.append((np.mean(needs), np.mean(densities)))
    return np.array(rows).reshape(-1, 2)


def crossing_paths(layer: SparseLayer) -> int:
    """Return how many pairs of paths of a layer cross, and paths that cross themselves."""
    lines = np.array([shapely.linestrings(path) for path in layer.paths])
    one, other = shapely.STRtree(lines).query(lines, predicate="crosses")
    return int((one < other).sum()) + int((~shapely.is_simple(lines)).sum())
