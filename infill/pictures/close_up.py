"""A close-up of the largest marked place of a surface, for a corner of the picture that hardly shows it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from infill.arrays import Floats
from infill.meshes.solids import FINE, from_manifold, solid_status, to_manifold
from infill.pictures.render import Colour, Paint, Window, directions, render
from infill.surface import Surface

REACH = 0.1  # of the size of the surface: marked points this close to each other are one place
SIDE = 150  # pixels of a close-up
SURROUNDINGS = 1.6  # of the radius of the place: half the side of its window
GRID = 40  # pixels along a side of the grid that finds out what is visible
LEAST_SEEN = 0.3  # of a place: if less can be seen from every side, the surface is cut open
LEAST_FACTOR = 1.5  # a close-up that enlarges less shows no more than the picture
FRAME = 3  # pixels
CUT_TOLERANCE = 1e-4  # of half the window: points this close to the plane of a cut belong to it


@dataclass(frozen=True, kw_only=True, eq=False)
class MarkedPlace:
    """A place of a surface that is marked.

    Parameters
    ----------
    points : (N, 3) float64, mm
        Marked sample points.
    middle : (3,) float64, mm
    half : float, mm
        Half the side of the window around it.
    """

    points: Floats
    middle: Floats
    half: float


def find_largest_place(points: Floats, area: Floats, size: float, pitch: float) -> MarkedPlace:
    """Find the place with the largest marked area.

    Parameters
    ----------
    points : (N, 3) float64, mm
        Marked points, at least one.
    area : (N,) float64, mm²
        Of each.
    size : float, mm
        Longest side of the surface.
    pitch : float, mm
        Distance between neighbouring sample points.
    """
    reach = max(REACH * size, 2 * pitch)
    boxes = np.unique(np.floor(points / reach), axis=0, return_inverse=True)[1].ravel()
    first = points[boxes == np.argmax(np.bincount(boxes, area))].mean(axis=0)
    near = points[np.linalg.norm(points - first, axis=1) <= reach]
    if not len(near):  # a ring around its mean
        near = points[boxes == np.argmax(np.bincount(boxes, area))]
    middle = (near.min(axis=0) + near.max(axis=0)) / 2
    radius = float(np.linalg.norm(near - middle, axis=1).max())
    return MarkedPlace(points=near, middle=middle, half=max(SURROUNDINGS * radius, 4 * pitch))


def choose_view(
    place: MarkedPlace, samples: Floats, views: Sequence[tuple[float, float]], pitch: float
) -> tuple[tuple[float, float], float]:
    """Choose the view that shows most of a place; return it and the visible share of the place.

    Parameters
    ----------
    place : MarkedPlace
    samples : (M, 3) float64, mm
        Points spread over the surface, which hide what is behind them.
    views : sequence of (azimuth, elevation), radians
    pitch : float, mm
        Distance between neighbouring samples.
    """
    shares = []
    for view in views:
        right, up, eye = directions(*view)
        axes = np.stack([right, up], axis=1)
        pixel = max(2 * place.half / GRID, 1.5 * pitch)
        at, others = ((points - place.middle) @ axes / pixel for points in (place.points, samples))
        inside = np.abs(others).max(axis=1) <= place.half / pixel
        count = math.ceil(place.half / pixel) + 1
        front = np.full((2 * count + 1,) * 2, -np.inf)
        cell = np.rint(others[inside]).astype(int) + count
        np.maximum.at(front, tuple(cell.T), samples[inside] @ eye)
        where = (np.rint(at).astype(int) + count).clip(0, 2 * count)
        shares.append(float((place.points @ eye >= front[tuple(where.T)] - 2 * pixel).mean()))
    best = int(np.argmax(shares))
    return views[best], shares[best]


def draw_close_up(
    surface: Surface,
    place: MarkedPlace,
    view: tuple[float, float],
    paint: Paint,
    *,
    cut: bool,
    cut_colour: Colour,
    background: Colour,
) -> Image.Image:
    """Draw a place of a surface from one side, cut open through its middle if nothing else shows it."""
    right, up, eye = directions(*view)
    depth = math.inf
    if cut and solid_status(solid := to_manifold(surface)) == FINE:
        depth = float(place.middle @ eye)
        surface = from_manifold(solid.trim_by_plane((-eye).tolist(), -depth))

    def paint_cut(points: Floats) -> NDArray[np.number]:
        """Return the colour of points, another one on the cut."""
        is_cut = np.abs(points @ eye - depth) < CUT_TOLERANCE * place.half
        return np.where(is_cut[:, None], np.array(cut_colour), paint(points))

    x, y = float(place.middle @ right), float(place.middle @ up)
    window: Window = (x - place.half, x + place.half, y - place.half, y + place.half)
    pixels = render(
        surface,
        width=SIDE,
        height=SIDE,
        azimuth=view[0],
        elevation=view[1],
        background=background,
        window=window,
        paint=paint_cut,
    )
    return Image.fromarray(pixels)


def insert_close_up(picture: Image.Image, close_up: Image.Image, factor: float, colour: Colour) -> Image.Image:
    """Return a picture with a framed close-up where it is empty, or else beside it, and by how much it enlarges."""
    place = _find_empty_square(np.asarray(picture))
    inserted = picture
    if place is None:
        inserted = Image.new("RGB", (picture.width + SIDE, picture.height), picture.getpixel((0, 0)))
        inserted.paste(picture, (0, 0))
        place = (picture.width, picture.height - SIDE)
    x, y = place
    inserted = inserted.copy()
    inserted.paste(close_up, (x, y))
    draw = ImageDraw.Draw(inserted)
    draw.rectangle((x, y, x + SIDE - 1, y + SIDE - 1), outline=colour, width=FRAME)
    draw.text((x + 2 * FRAME, y + 2 * FRAME), f"{factor:.0f} x", fill=(40, 40, 40), font=ImageFont.load_default(14))
    return inserted


def _find_empty_square(pixels: NDArray[np.uint8]) -> tuple[int, int] | None:
    """Find the upper left corner (x, y) of an empty square for a close-up, the nearest to a corner; or None."""
    taken = (pixels != pixels[0, 0]).any(axis=2)
    sums = np.pad(taken.astype(np.int64).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    inside = sums[SIDE:, SIDE:] - sums[:-SIDE, SIDE:] - sums[SIDE:, :-SIDE] + sums[:-SIDE, :-SIDE]
    rows, columns = np.nonzero(inside == 0)
    if not len(rows):
        return None
    from_side, from_end = (
        np.minimum(at, last - 1 - at) for at, last in zip((columns, rows), inside.T.shape, strict=True)
    )
    best = np.lexsort((columns, -rows, from_side + from_end))[0]
    return int(columns[best]), int(rows[best])
