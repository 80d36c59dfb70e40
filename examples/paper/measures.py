"""What is measured of contours, fields and surfaces. Lengths are in cells unless a cell size is given."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray
from skimage.measure import find_contours

Field = NDArray[np.floating]


def contours(phi: Field) -> list[NDArray[np.float64]]:
    """Return the zero contours of a plane field, closed at the edge of the grid; the first cell spans 0 to 1."""
    return [line - 0.5 for line in find_contours(np.pad(phi, 1, constant_values=-1), 0.0)]


def length(phi: Field) -> float:
    """Return the length of the zero contours."""
    return float(sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in contours(phi)))


def turning(phi: Field) -> float:
    """Return by how much the zero contours turn in all, in full turns; 1 for a convex outline."""
    total = 0.0
    for line in contours(phi):
        ahead = np.diff(line, axis=0)
        ahead = ahead[np.linalg.norm(ahead, axis=1) > 1e-9]
        angle = np.arctan2(ahead[:, 1], ahead[:, 0])
        bend = (np.diff(np.append(angle, angle[0])) + math.pi) % (2 * math.pi) - math.pi
        total += float(np.abs(bend).sum())
    return total / (2 * math.pi)


def area(phi: Field) -> float:
    """Return what the zero contours enclose."""
    polygons = shapely.get_parts(
        shapely.build_area(shapely.union_all([shapely.LinearRing(line) for line in contours(phi) if len(line) > 3]))
    )
    return float(shapely.area(polygons).sum())


def rms_from(phi: Field, outline: shapely.Geometry) -> float:
    """Return the root mean square distance of the zero contours from an outline, weighted by length."""
    squares, weights = [], []
    for line in contours(phi):
        ahead = np.linalg.norm(np.diff(line, axis=0), axis=1)
        middle = (line[1:] + line[:-1]) / 2
        squares.append(shapely.distance(shapely.points(middle), outline) ** 2)
        weights.append(ahead)
    return float(np.sqrt(np.average(np.concatenate(squares), weights=np.concatenate(weights))))


def mse(phi: Field, f: Field) -> float:
    """Return the mean of (phi - f)² over all cells: our reading of the paper's Eq. (16)."""
    return float(np.mean((phi - f) ** 2, dtype=np.float64))
