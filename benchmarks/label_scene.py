"""A segmentation as scanners and networks make them: vertebrae and organs of different sizes that touch each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, label, zoom

LABELS = 40
COARSE = 4  # cells: places are shifted by noise that is made on a coarser grid


def segmentation(size: int = 256, labels: int = LABELS, seed: int = 3) -> NDArray[np.uint8]:
    """Return labels of different sizes that fill a body and touch each other, [x, y, z]; 0 around the body.

    A cell has the label of the nearest seed, where distances are divided by a weight of the seed (a Voronoi diagram
    with weights) and places are shifted by smooth noise: walls are wavy, and no two labels have the same shape. A
    third of the seeds stand in a column, flat and regular, like vertebrae. Of each label, the largest piece stays.
    """
    rng = np.random.default_rng(seed)
    column = labels // 3
    along = np.linspace(0.12, 0.88, column)
    seeds = np.concatenate(
        [
            np.column_stack([np.full(column, 0.5), 0.6 + 0.05 * np.sin(9 * along), along]),
            rng.uniform((0.22, 0.26, 0.1), (0.78, 0.74, 0.9), (labels - column, 3)),
        ]
    ).astype(np.float32)
    weights = np.concatenate([np.full(column, 0.8), rng.uniform(0.4, 1.3, labels - column)]).astype(np.float32)
    flatness = np.where(np.arange(labels) < column, 1.6, 1.0).astype(np.float32)
    places = np.stack(np.meshgrid(*[((np.arange(size) + 0.5) / size).astype(np.float32)] * 3, indexing="ij"))
    for axis in range(3):
        noise = gaussian_filter(rng.standard_normal((size // COARSE,) * 3).astype(np.float32), 0.03 * size, mode="wrap")
        places[axis] += zoom(noise * (0.015 / noise.std()), COARSE, order=1)
    nearest = np.full((size,) * 3, np.inf, dtype=np.float32)
    values = np.zeros((size,) * 3, dtype=np.uint8)
    for number, (at, weight, flat) in enumerate(zip(seeds, weights, flatness, strict=True), start=1):
        x, y, z = places - at.reshape(3, 1, 1, 1)
        distance = (x**2 + y**2 + (flat * z) ** 2) / weight**2
        closer = distance < nearest
        values[closer], nearest[closer] = number, distance[closer]
    x, y, z = places - np.float32(0.5)
    values[(x / 0.31) ** 2 + (y / 0.27) ** 2 + (z / 0.46) ** 2 > 1] = 0
    for number in range(1, labels + 1):
        pieces, count = label(values == number)
        if count > 1:
            values[(pieces > 0) & (pieces != np.bincount(pieces.ravel())[1:].argmax() + 1)] = 0
    return values
