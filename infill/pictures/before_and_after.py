"""The input and the smoothed result from one side and at one scale, with lost and added parts marked."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from infill.arrays import Floats
from infill.inspection.deviation import LOST, sample_surface
from infill.meshes.distance import TriangleTree
from infill.meshes.winding import is_solid_boundary
from infill.pictures.close_up import (
    LEAST_FACTOR,
    LEAST_SEEN,
    SIDE,
    choose_view,
    draw_close_up,
    find_largest_place,
    insert_close_up,
)
from infill.pictures.render import AZIMUTH, ELEVATION, Colour, Paint, Window, directions, render
from infill.pictures.sheet import BACKGROUND, PANEL, arrange_panels
from infill.plain_numbers import choose_unit, plain_argument, plain_size
from infill.surface import Surface

FAR_VOXELS = LOST  # voxels: points further away are marked
SAMPLE_PITCH = 0.7  # voxels between the sample points of the area
PROBE_OFFSET = 1e-4  # of the far distance: offset at which solid beside a face is searched
PLAIN: Colour = (214, 206, 192)
LOST_COLOUR: Colour = (214, 39, 40)
ADDED_COLOUR: Colour = (31, 119, 220)
MARGIN = 1.06  # of the frame
VIEW_SHARE = 0.6  # of the maximum over all views
MIN_VISIBLE = 8  # quarters of a pixel: smaller marks are invisible
LEAST_HITS = 1600  # quarters of a pixel, as a square of 20 pixels: smaller marks get a close-up
TRIAL_PIXELS = 64  # pixels along a side of the pictures that select the view

# From above at four corners, the usual one first, then from below, and horizontally from the sides.
VIEWS = (
    *((AZIMUTH + quarter * math.pi / 2, ELEVATION) for quarter in (0, 1, 2, 3)),
    *((AZIMUTH + quarter * math.pi / 2, -ELEVATION) for quarter in (0, 2)),
    *((AZIMUTH + math.radians(-30) + quarter * math.pi / 2, math.radians(5)) for quarter in (0, 1, 2, 3)),
)


@dataclass(frozen=True, kw_only=True, eq=False)
class MarkedSurface:
    """A surface, with its points marked that lie far from another.

    Parameters
    ----------
    surface, other : Surface, mm
    far : float, mm
    colour : (red, green, blue)
        Of the points further away.
    """

    surface: Surface
    other: Surface
    far: float
    colour: Colour
    _tree: TriangleTree = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Sort the triangles of the other surface."""
        object.__setattr__(self, "_tree", TriangleTree.of(self.other))

    def is_far(self, points: Floats) -> NDArray[np.bool_]:
        """Return True for points (N, 3) that lie far from the other surface."""
        return self._tree.nearest(points)[0] > self.far

    @cached_property
    def samples(self) -> tuple[Floats, NDArray[np.bool_], Floats]:
        """Points spread over the surface, (N, 3) mm, True for those that lie far away, and the area of each, mm².

        Points hidden inside the solid do not count as far.
        """
        points, faces, area = sample_surface(self.surface, SAMPLE_PITCH / FAR_VOXELS * self.far)
        spread = area > 0
        points, faces, area = points[spread], faces[spread], area[spread]
        is_far_point = self.is_far(points)
        is_far_point[is_far_point] = is_solid_boundary(
            points[is_far_point], faces[is_far_point], self.surface, PROBE_OFFSET * self.far
        )
        return points, is_far_point, area

    @property
    def area(self) -> float:
        """Area that lies far away, mm²."""
        _, is_far_point, area = self.samples
        return float(area[is_far_point].sum())

    def count_visible(self, view: tuple[float, float]) -> int:
        """Count the far points that are visible from one side, in pixels of a small picture."""
        points, is_far_point, _ = self.samples
        right, up, eye = directions(*view)
        flat = np.stack([points @ right, points @ up], axis=1)
        low, side = flat.min(axis=0), max(float(np.linalg.norm(np.ptp(points, axis=0))), 1e-12)
        place = ((flat - low) / side * (TRIAL_PIXELS - 1)).astype(np.int64) @ (TRIAL_PIXELS, 1)
        nearest = np.lexsort((points @ eye, place))
        front = nearest[np.flatnonzero(np.diff(place[nearest], append=-1))]
        return int(is_far_point[front].sum())


def draw_before_and_after(
    given: Surface, result: Surface, *, cell: float, report: Mapping[str, Any], captions: tuple[str, str]
) -> Image.Image:
    """Draw both surfaces side by side, with lost parts in red and added parts in blue.

    Parameters
    ----------
    given, result : Surface, mm
    cell : float, mm
        Points further than `FAR_VOXELS` of these from the other surface are marked.
    report : mapping
        See docs/report.md.
    captions : (str, str)
        Captions above the two panels.
    """
    if given.volume < 0:  # inside out
        given = replace(given, faces=given.faces[:, ::-1])
    far = float(report["verdict"].get("far", FAR_VOXELS * cell))
    lost = MarkedSurface(surface=given, other=result, far=far, colour=LOST_COLOUR)
    added = MarkedSurface(surface=result, other=given, far=far, colour=ADDED_COLOUR)
    view = _choose_view(lost, added)
    window = _square_window((given, result), view)
    pictures = [_draw_marked(marked, view, window) for marked in (lost, added)]
    panels = {caption: picture for caption, (picture, _) in zip(captions, pictures, strict=True)}
    unit = choose_unit(*report["extents"])
    size = plain_size(*report["extents"], digits=4, separator="", unit=unit)
    volume = plain_size(report["volume"], power=3, digits=6, unit=unit)
    facts = f"{size}, volume {volume} ({report['volume_change']:+z.4%})"
    areas = describe_areas(lost, added, report["verdict"], unit)
    legend = [
        (marked.colour, f"{area} {word}{'' if shown else ', not seen here'}") if area else (None, f"nothing {word}")
        for marked, area, word, (_, shown) in zip((lost, added), areas, ("lost", "added"), pictures, strict=True)
    ]
    ends = f"{facts}; marked if more than {plain_size(far, unit=unit)} ({plain_argument(FAR_VOXELS)} voxels) apart"
    return arrange_panels(panels, ends, [(None, f"{report['verdict']['word']}:"), *legend])


def describe_areas(
    lost: MarkedSurface, added: MarkedSurface, verdict: Mapping[str, Any], unit: str = "mm"
) -> tuple[str, str]:
    """Describe the areas that were lost and added, as the verdict does if it has them; empty for none."""
    missing, new = verdict.get("missing", lost.area), verdict.get("new", added.area)
    thin = verdict.get("thin", 0.0)
    counted, narrow, grown = (plain_size(area, power=2, unit=unit) if area else "" for area in (missing, thin, new))
    return " and ".join(filter(None, (counted, narrow and f"{narrow} too thin to count,"))).rstrip(","), grown


def _draw_marked(marked: MarkedSurface, view: tuple[float, float], window: Window) -> tuple[Image.Image, bool]:
    """Render a surface from one side, with a close-up if marks are small; return it, and True if a mark is visible."""
    hits = 0

    def paint(points: Floats) -> NDArray[np.number]:
        """Return the colour of points, that of the mark where they lie far away; count these."""
        nonlocal hits
        is_far_point = marked.is_far(points) if marked.area else np.zeros(len(points), dtype=bool)
        hits += int(is_far_point.sum())
        return np.where(is_far_point[:, None], np.array(marked.colour), np.array(PLAIN))

    pixels = render(
        marked.surface,
        width=PANEL,
        height=PANEL,
        azimuth=view[0],
        elevation=view[1],
        background=BACKGROUND,
        window=window,
        paint=paint,
    )
    picture = Image.fromarray(pixels)
    if not marked.area or hits >= LEAST_HITS:
        return picture, hits >= MIN_VISIBLE
    close_up = _insert_close_up(marked, picture, view, window, paint)
    return close_up or picture, close_up is not None or hits >= MIN_VISIBLE


def _insert_close_up(
    marked: MarkedSurface, picture: Image.Image, view: tuple[float, float], window: Window, paint: Paint
) -> Image.Image | None:
    """Insert a close-up of the largest marked place; return None where it would show no more than the picture."""
    points, is_far_point, area = marked.samples
    size, pitch = float(np.ptp(points, axis=0).max()), SAMPLE_PITCH / FAR_VOXELS * marked.far
    place = find_largest_place(points[is_far_point], area[is_far_point], size, pitch)
    best, share = choose_view(place, points, (view, *VIEWS), pitch)
    cut = share < LEAST_SEEN
    factor = (window[1] - window[0]) / (2 * place.half) * SIDE / PANEL
    if factor < LEAST_FACTOR and not cut:
        return None
    close_up = draw_close_up(marked.surface, place, best, paint, cut=cut, cut_colour=PLAIN, background=BACKGROUND)
    return insert_close_up(picture, close_up, factor, marked.colour)


def _choose_view(lost: MarkedSurface, added: MarkedSurface) -> tuple[float, float]:
    """Return the first view that shows lost parts, or else added parts, about as well as the best view.

    Without either, return the usual view.
    """
    for marked in (lost, added):
        if not marked.area:
            continue
        counts = [marked.count_visible(view) for view in VIEWS]
        if any(counts):
            return VIEWS[int(np.argmax(np.array(counts) >= VIEW_SHARE * max(counts)))]
    return VIEWS[0]


def _square_window(surfaces: tuple[Surface, ...], view: tuple[float, float]) -> Window:
    """Return a square window around surfaces seen from one side."""
    axes = directions(*view)[:2].T
    at = [surface.vertices[np.unique(surface.faces)] @ axes for surface in surfaces]
    low, high = (
        np.min([projected.min(axis=0) for projected in at], axis=0),
        np.max([projected.max(axis=0) for projected in at], axis=0),
    )
    middle, half = (low + high) / 2, max(float((high - low).max()), 1e-12) / 2 * MARGIN
    left_edge, bottom = (middle - half).tolist()
    right, top = (middle + half).tolist()
    return left_edge, right, bottom, top
