"""A shaded picture of a mesh, without a display, a GPU or a plotting library.

Every triangle is spread over the pixels of its bounding box, many triangles at once; the nearest one wins.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from infill.ragged import spread
from infill.surface import Surface

Pixels = NDArray[np.uint8]

LIGHT = np.array([-0.45, -0.6, 0.9]) / np.linalg.norm([-0.45, -0.6, 0.9])
AMBIENT = 0.35
SAMPLES = 2  # along each side of a pixel
FRAGMENTS_AT_ONCE = 300_000


def render(
    surface: Surface,
    *,
    width: int,
    height: int,
    azimuth: float = math.radians(-60),
    elevation: float = math.radians(40),
    colour: tuple[int, int, int] = (240, 160, 60),
    background: tuple[int, int, int] = (255, 255, 255),
    window: tuple[float, float, float, float] | None = None,
) -> Pixels:
    """Return a picture of `surface`: (height, width, 3) uint8.

    Parameters
    ----------
    surface : Surface
        Drawn in parallel projection; faces are lit from the upper left and by ambient light.
    width, height : int
        Pixels.
    azimuth, elevation : float
        Position of the eye, seen from the middle of the mesh, in radians: around z from +x, and up.
    window : (left, right, bottom, top), optional
        What the frame shows, in units of the mesh along the first two of `directions`; by default the mesh is fitted to
        the frame.
    """
    columns, rows = width * SAMPLES, height * SAMPLES
    right, up, eye = directions(azimuth, elevation)
    seen = surface.vertices @ np.stack([right, -up, eye], axis=1)  # column, row, nearness
    if window is None:
        low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
        scale = 0.94 * min((columns, rows) / np.maximum(high - low, 1e-12))
    else:
        low, high = np.array([window[0], -window[3]]), np.array([window[1], -window[2]])
        scale = min((columns, rows) / (high - low))
    place = (seen[:, :2] - (low + high) / 2) * scale + np.array([columns, rows]) / 2
    corners = place[surface.faces].astype(np.float32)
    nearness = seen[:, 2][surface.faces].astype(np.float32)
    a, b, c = (surface.vertices[surface.faces[:, i]] for i in range(3))
    b, c = b - a, c - a
    normal = np.stack(
        [
            b[:, 1] * c[:, 2] - b[:, 2] * c[:, 1],
            b[:, 2] * c[:, 0] - b[:, 0] * c[:, 2],
            b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0],
        ]
    )
    length = np.sqrt((normal**2).sum(axis=0))
    front = np.flatnonzero((eye @ normal > 0) & (length > 0))
    camera_light = LIGHT[0] * right + LIGHT[1] * -up + LIGHT[2] * eye
    lit = (camera_light @ normal[:, front] / length[front]).clip(0, 1)
    shade = (AMBIENT + (1 - AMBIENT) * lit).astype(np.float32)
    picture = np.full(rows * columns, -1.0, dtype=np.float32)
    depth = np.full(rows * columns, -np.inf, dtype=np.float32)
    for pixel, near, face in _fragments(corners[front], nearness[front], columns, rows):
        order = np.argsort(near, kind="stable")  # of several writes to one pixel, the last one, the nearest, remains
        pixel, near, face = pixel[order], near[order], face[order]
        nearer = near > depth[pixel]
        depth[pixel[nearer]] = near[nearer]
        picture[pixel[nearer]] = shade[face[nearer]]
    lit_pixels = picture.reshape(height, SAMPLES, width, SAMPLES)
    covered = (lit_pixels >= 0).mean(axis=(1, 3))[..., None]
    brightness = np.where(lit_pixels >= 0, lit_pixels, 0).mean(axis=(1, 3))[..., None]
    mixed = brightness * np.array(colour) + (1 - covered) * np.array(background)
    rounded: Pixels = mixed.clip(0, 255).astype(np.uint8)
    return rounded


def directions(azimuth: float, elevation: float) -> NDArray[np.float64]:
    """Return the unit vectors to the right, up and towards the eye, (3, 3) float64, from angles in radians.

    >>> directions(math.radians(-90), 0).round(12).tolist()[0]
    [1.0, 0.0, 0.0]
    """
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    eye = np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )
    return np.stack([right, np.cross(eye, right), eye])


def _fragments(
    corners: NDArray[np.float32], nearness: NDArray[np.float32], columns: int, rows: int
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float32], NDArray[np.int64]]]:
    """Yield (pixel, nearness, face) of the pixel centres inside the triangles, some triangles at a time."""
    limit = np.array([columns, rows])
    first = np.ceil(corners.min(axis=1) - 0.5).astype(np.int64).clip(0, limit)
    last = np.floor(corners.max(axis=1) - 0.5).astype(np.int64).clip(-1, limit - 1)
    across = (last - first + 1).clip(0)
    counts = across[:, 0] * across[:, 1]
    for face, place in spread(counts, FRAGMENTS_AT_ONCE):
        row, column = np.divmod(place, across[face, 0])
        column, row = column + first[face, 0], row + first[face, 1]
        x, y = column + np.float32(0.5), row + np.float32(0.5)
        (ax, ay), (bx, by), (cx, cy) = (corners[face, i].T for i in range(3))
        whole = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        whole = np.where(whole == 0, np.float32(np.inf), whole)
        v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / whole
        w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / whole
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        face, v, w = face[inside], v[inside], w[inside]
        near = (
            nearness[face, 0]
            + v * (nearness[face, 1] - nearness[face, 0])
            + w * (nearness[face, 2] - nearness[face, 0])
        )
        yield (row[inside] * columns + column[inside]), near, face
