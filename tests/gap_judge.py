"""How far the layers of a print are from their next bead, and what their infill takes: read by means of its own.

A gap is the largest circle inside the region of the infill that no centre line of a bead enters, found on a raster by
SciPy's distance transform. The region is what the other beads of the layer enclose, where the sliced print has infill.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

PIXEL = 0.1  # mm
SPARSE = ("Internal infill", "Sparse infill", "FILL")
_TAG = re.compile(r"(?:;TYPE:|; FEATURE: )(.*)")
_LAYER = re.compile(r";LAYER_CHANGE|; CHANGE_LAYER|;LAYER:")
_WORD = re.compile(r"([XYZEF])(-?[\d.]+)")


@dataclass
class Layer:
    """Beads of a layer: (N, 4) mm, from x, y to x, y; and mm of filament that its infill takes."""

    infill: np.ndarray
    others: np.ndarray
    filament: float


def read_layers(text: str) -> list[Layer]:
    """Read straight moves, layer by layer, of prints in relative or absolute E."""
    found: list[tuple[list, list, list]] = []
    role, relative = "", False
    x = y = e = 0.0
    for line in text.splitlines():
        if _LAYER.match(line):
            found.append(([], [], [0.0]))
        elif tag := _TAG.match(line):
            role = tag[1].strip()
        elif line.startswith(("M82", "M83")):
            relative = line.startswith("M83")
        elif line.startswith("G92"):
            words = dict(_WORD.findall(line.split(";")[0]))
            e = float(words.get("E", e))
        elif line.startswith(("G0 ", "G1 ")):
            words = {name: float(value) for name, value in _WORD.findall(line.split(";")[0])}
            nx, ny = words.get("X", x), words.get("Y", y)
            pushed = 0.0
            if "E" in words:
                pushed = words["E"] if relative else words["E"] - e
                e = words["E"]
            if pushed > 0 and (nx, ny) != (x, y) and found:
                infill, others, filament = found[-1]
                (infill if role in SPARSE else others).append((x, y, nx, ny))
                filament[0] += pushed if role in SPARSE else 0.0
            x, y = nx, ny
    shaped = [[np.array(beads, dtype=float).reshape(-1, 4) for beads in layer[:2]] for layer in found]
    return [Layer(infill=a, others=b, filament=layer[2][0]) for (a, b), layer in zip(shaped, found, strict=True)]


def raster(beads: np.ndarray, low: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return which pixels the centre lines of beads pass through."""
    found = np.zeros(shape, dtype=bool)
    if len(beads):
        length = np.hypot(beads[:, 2] - beads[:, 0], beads[:, 3] - beads[:, 1])
        number = np.ceil(length / (PIXEL / 2)).astype(int) + 1
        row = np.repeat(np.arange(len(beads)), number)
        share = np.concatenate([np.linspace(0, 1, n) for n in number])[:, None]
        points = beads[row, :2] + share * (beads[row, 2:] - beads[row, :2])
        at = np.rint((points - low) / PIXEL).astype(int)
        found[at[:, 0], at[:, 1]] = True
    return found


def gap_map(old: Layer, new: Layer) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the distance to the next bead before and after, mm, and the region, on a raster."""
    ends = np.concatenate([layer.reshape(-1, 2) for layer in (old.infill, old.others)])
    low = ends.min(axis=0) - 1.0
    shape = tuple((np.ceil((ends.max(axis=0) + 1.0 - low) / PIXEL)).astype(int) + 1)
    walls = raster(old.others, low, shape)
    # Walls half a line wide close what is left open between two of their ends.
    closed = ndimage.distance_transform_edt(~walls) * PIXEL > 0.25
    label, _ = ndimage.label(closed)
    infill = raster(old.infill, low, shape)
    outside = set(np.unique(np.concatenate([label[0], label[-1], label[:, 0], label[:, -1]])))
    inside = set(np.unique(label[infill])) - outside - {0}
    region = np.isin(label, list(inside))
    before = ndimage.distance_transform_edt(~(walls | infill)) * PIXEL
    after = ndimage.distance_transform_edt(~(walls | raster(new.infill, low, shape))) * PIXEL
    return np.where(region, before, 0.0), np.where(region, after, 0.0), region


def widest_gaps(old: str, new: str) -> list[tuple[float, float]]:
    """Return the radius of the widest gap of each layer with infill, before and after, mm."""
    found = []
    for a, b in zip(read_layers(old), read_layers(new), strict=True):
        if len(a.infill) and len(a.others):
            before, after, _ = gap_map(a, b)
            found.append((float(before.max()), float(after.max())))
    return found


def filament(text: str) -> float:
    """Return what the infill takes, mm of filament."""
    return sum(layer.filament for layer in read_layers(text))


def infill_width(text: str) -> float:
    """Return how wide PrusaSlicer says the lines of infill are, mm, the usual one; 0.45 where it is not said."""
    role, width, found = "", "0.45", []
    for line in text.splitlines():
        if tag := _TAG.match(line):
            role = tag[1].strip()
        elif line.startswith(";WIDTH:"):
            width = line[7:]
        elif role in SPARSE and line.startswith("G1 ") and " E" in line:
            found.append(float(width))
    return float(np.median(found)) if found else 0.45


def touching_walls(text: str, reach: float = 1.1 * 0.45) -> float:
    """Return how much of the infill lies within `reach` of a bead of another kind, mm: as near as beads touch.

    Where legs lead away from a wall, hundredths of a millimetre count: a print has thousands of such ends alike, so
    that whatever coarser samples miss at one of them they miss at all.
    """
    found = 0.0
    for layer in read_layers(text):
        if len(layer.infill) and len(layer.others):
            tree = cKDTree(samples(layer.others, 0.02)[0])
            pieces = cut(layer.infill, 0.25)
            near, _ = tree.query((pieces[:, :2] + pieces[:, 2:]) / 2, distance_upper_bound=reach + 0.15)
            close = pieces[np.isfinite(near)]
            if len(close):
                points, weight = samples(close, 0.005)
                near, _ = tree.query(points, distance_upper_bound=reach)
                found += float(weight[np.isfinite(near)].sum())
    return found


def cut(beads: np.ndarray, step: float) -> np.ndarray:
    """Return beads cut into pieces of equal length, a step long at most, (N, 4) mm."""
    length = np.hypot(beads[:, 2] - beads[:, 0], beads[:, 3] - beads[:, 1])
    number = np.ceil(length / step).astype(int).clip(1)
    row = np.repeat(np.arange(len(beads)), number)
    share = np.concatenate([np.arange(n) / n for n in number])[:, None]
    way = (beads[:, 2:] - beads[:, :2])[row]
    start = beads[row, :2] + share * way
    return np.concatenate([start, start + way / number[row, None]], axis=1)


def samples(beads: np.ndarray, step: float = 0.05) -> tuple[np.ndarray, np.ndarray]:
    """Return points along beads, a step apart, and the length that each stands for, mm."""
    length = np.hypot(beads[:, 2] - beads[:, 0], beads[:, 3] - beads[:, 1])
    number = np.ceil(length / step).astype(int).clip(1)
    row = np.repeat(np.arange(len(beads)), number)
    share = np.concatenate([(np.arange(n) + 0.5) / n for n in number])[:, None]
    return beads[row, :2] + share * (beads[row, 2:] - beads[row, :2]), (length / number)[row]
