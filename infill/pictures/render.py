"""A shaded picture of a mesh, without a display, a GPU or a plotting library.

Every triangle is spread over the pixels of its bounding box, many triangles at once; the nearest one wins.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.ragged import expand_rows
from infill.surface import Surface

Pixels = NDArray[np.uint8]
Colour = tuple[int, int, int]
Window = tuple[float, float, float, float]
Paint = Callable[[Floats], NDArray[np.number]]

AZIMUTH, ELEVATION = math.radians(-60), math.radians(40)
LIGHT = np.array([-0.45, -0.6, 0.9]) / np.linalg.norm([-0.45, -0.6, 0.9])
AMBIENT = 0.35
SAMPLES = 2  # along each side of a pixel
FRAGMENTS_AT_ONCE = 300_000


def render(
    surface: Surface,
    *,
    width: int,
    height: int,
    azimuth: float = AZIMUTH,
    elevation: float = ELEVATION,
    colour: Colour = (240, 160, 60),
    background: Colour = (255, 255, 255),
    window: Window | None = None,
    paint: Paint | None = None,
) -> Pixels:
    """Render a picture of `surface` from an azimuth and elevation in radians: (height, width, 3) uint8.

    Parameters
    ----------
    surface : Surface
        Drawn in parallel projection; faces are lit from the upper left and by ambient light.
    width, height : int
        Pixels.
    azimuth, elevation : float
        Position of the eye, seen from the middle of the mesh, in radians: around z from +x, and up.
    colour, background : (red, green, blue)
        From 0 to 255.
    window : (left, right, bottom, top), optional
        Extent of the frame, in units of the mesh along the first two of `directions`; by default the mesh is fitted to
        the frame. One window for several meshes shows them at one scale and in one place.
    paint : callable, optional
        Returns the colour of visible points of the surface, (N, 3) for (N, 3); by default all have `colour`.
    """
    frame = _Frame.of(surface, (width * SAMPLES, height * SAMPLES), (azimuth, elevation), window)
    shade, depth = _draw_triangles(surface, frame)
    lit = (shade >= 0).astype(np.float64)[:, None]
    if paint is None:
        colours = np.maximum(shade, 0)[:, None]
    else:
        hit = np.flatnonzero(shade >= 0)
        colours = np.zeros((len(shade), 3), dtype=np.float32)
        colours[hit] = paint(frame.points(hit, depth[hit])) * shade[hit, None]
    covered, mean = (
        samples.reshape(height, SAMPLES, width, SAMPLES, samples.shape[1]).mean(axis=(1, 3))
        for samples in (lit, colours)
    )
    mixed = mean * (1.0 if paint is not None else np.array(colour)) + (1 - covered) * np.array(background)
    rounded: Pixels = mixed.clip(0, 255).astype(np.uint8)
    return rounded


@dataclass(frozen=True, kw_only=True, eq=False)
class _Frame:
    """Map between points of space and pixels of a picture.

    Parameters
    ----------
    columns, rows : int
    axes : (3, 3) float64
        Directions in which columns, rows and nearness grow, one a column.
    middle : (3,) float64
        Point at the middle of the picture, along these.
    scale : float
        Columns for a unit of the mesh.
    """

    columns: int
    rows: int
    axes: Floats
    middle: Floats
    scale: float

    @classmethod
    def of(cls, surface: Surface, size: tuple[int, int], eye: tuple[float, float], window: Window | None) -> _Frame:
        """Return the frame of `size` that shows a window, or else all of the surface."""
        right, up, towards = directions(*eye)
        axes = np.stack([right, -up, towards], axis=1)
        at = surface.vertices @ axes
        low, high = at.min(axis=0), at.max(axis=0)
        middle = (low + high) / 2
        if window is None:
            scale = 0.94 * min(np.array(size) / np.maximum(high[:2] - low[:2], 1e-12))
        else:
            corners = np.array([[window[0], -window[3]], [window[1], -window[2]]])
            scale = min(np.array(size) / (corners[1] - corners[0]))
            middle[:2] = corners.mean(axis=0)
        return cls(columns=size[0], rows=size[1], axes=axes, middle=middle, scale=float(scale))

    def place(self, points: NDArray[np.floating]) -> Floats:
        """Return column, row and nearness of points (N, 3)."""
        moved: Floats = points @ self.axes - self.middle
        moved[:, :2] = moved[:, :2] * self.scale + np.array([self.columns, self.rows]) / 2
        return moved

    def points(self, pixel: NDArray[np.integer], nearness: NDArray[np.floating]) -> Floats:
        """Return the points at the middle of pixels, at some nearness: the inverse of `place`."""
        row, column = np.divmod(pixel, self.columns)
        moved = np.column_stack([column + 0.5 - self.columns / 2, row + 0.5 - self.rows / 2, nearness])
        moved[:, :2] /= self.scale
        back: Floats = (moved + self.middle) @ self.axes.T
        return back


def _draw_triangles(surface: Surface, frame: _Frame) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return brightness of every pixel, -1 in the background, and nearness, (rows * columns,) each."""
    right, down, eye = frame.axes.T
    at = frame.place(surface.vertices)
    corners = at[:, :2][surface.faces].astype(np.float32)
    nearness = at[:, 2][surface.faces].astype(np.float32)
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
    camera_light = LIGHT[0] * right + LIGHT[1] * down + LIGHT[2] * eye
    lit = (camera_light @ normal[:, front] / length[front]).clip(0, 1)
    shade = (AMBIENT + (1 - AMBIENT) * lit).astype(np.float32)
    picture = np.full(frame.rows * frame.columns, -1.0, dtype=np.float32)
    depth = np.full(frame.rows * frame.columns, -np.inf, dtype=np.float32)
    for pixel, depths, face in _rasterise(corners[front], nearness[front], frame.columns, frame.rows):
        order = np.argsort(depths, kind="stable")  # the last write to a pixel, the nearest, remains
        pixel, depths, face = pixel[order], depths[order], face[order]
        nearer = depths > depth[pixel]
        depth[pixel[nearer]] = depths[nearer]
        picture[pixel[nearer]] = shade[face[nearer]]
    return picture, depth


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


def _rasterise(
    corners: NDArray[np.float32], nearness: NDArray[np.float32], columns: int, rows: int
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float32], NDArray[np.int64]]]:
    """Yield (pixel, nearness, face) of the pixel centres inside the triangles, some triangles at a time."""
    limit = np.array([columns, rows])
    low = np.ceil(corners.min(axis=1) - 0.5).astype(np.int64).clip(0, limit)
    high = np.floor(corners.max(axis=1) - 0.5).astype(np.int64).clip(-1, limit - 1)
    across = (high - low + 1).clip(0)
    counts = across[:, 0] * across[:, 1]
    for face, place in expand_rows(counts, FRAGMENTS_AT_ONCE):
        row, column = np.divmod(place, across[face, 0])
        column, row = column + low[face, 0], row + low[face, 1]
        x, y = column + np.float32(0.5), row + np.float32(0.5)
        (ax, ay), (bx, by), (cx, cy) = (corners[face, i].T for i in range(3))
        twice_area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        twice_area = np.where(twice_area == 0, np.float32(np.inf), twice_area)
        v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / twice_area
        w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / twice_area
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        face, v, w = face[inside], v[inside], w[inside]
        depths = (
            nearness[face, 0]
            + v * (nearness[face, 1] - nearness[face, 0])
            + w * (nearness[face, 2] - nearness[face, 0])
        )
        yield (row[inside] * columns + column[inside]), depths, face
