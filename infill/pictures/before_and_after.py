"""What was given and what smoothing made of it, from one side and at one scale, and what was lost and added."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from infill.inspection.fidelity import sampled
from infill.meshes.distance import Tree
from infill.meshes.winding import bounds_solid
from infill.pictures.render import AZIMUTH, ELEVATION, Colour, Floats, Window, directions, render
from infill.pictures.sheet import BACKGROUND, PANEL, sheet
from infill.surface import Surface

FAR = 1.5  # voxels: what lies further away is marked
PITCH = 0.7  # voxels between points by which the area is found
ASIDE = 1e-4  # of what is far: where it is looked for solid beside a face
PLAIN: Colour = (214, 206, 192)
LOST: Colour = (214, 39, 40)
ADDED: Colour = (31, 119, 220)
MARGIN = 1.06  # of the frame
ENOUGH = 0.6  # of the most that any view shows
SEEN = 8  # quarters of a pixel: less than this nobody sees
SMALL = 64  # pixels along a side of the pictures by which the view is chosen

# From above at four corners, the usual one first, then from below, and straight from the sides.
VIEWS = (
    *((AZIMUTH + quarter * math.pi / 2, ELEVATION) for quarter in (0, 1, 2, 3)),
    *((AZIMUTH + quarter * math.pi / 2, -ELEVATION) for quarter in (0, 2)),
    *((AZIMUTH + math.radians(-30) + quarter * math.pi / 2, math.radians(5)) for quarter in (0, 1, 2, 3)),
)


@dataclass(frozen=True, kw_only=True, eq=False)
class Marked:
    """A surface, and which of its points lie far from another.

    Parameters
    ----------
    surface, other : Surface, mm
    far : float, mm
    colour : (red, green, blue)
        Of what lies further away.
    """

    surface: Surface
    other: Surface
    far: float
    colour: Colour
    _tree: Tree = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Sort the triangles of the other surface."""
        object.__setattr__(self, "_tree", Tree.of(self.other))

    def is_far(self, points: Floats) -> NDArray[np.bool_]:
        """Return which points (N, 3) lie far from the other surface."""
        return self._tree.nearest(points)[0] > self.far

    @cached_property
    def samples(self) -> tuple[Floats, NDArray[np.bool_], Floats]:
        """Points all over the surface, (N, 3) mm, which of them lie far away, and the area of each, mm².

        What is hidden inside the solid does not count as far.
        """
        points, faces, area = sampled(self.surface, PITCH / FAR * self.far)
        spread = area > 0
        points, faces, area = points[spread], faces[spread], area[spread]
        far = self.is_far(points)
        far[far] = bounds_solid(points[far], faces[far], self.surface, ASIDE * self.far)
        return points, far, area

    @property
    def area(self) -> float:
        """The area that lies far away, mm²."""
        _, far, area = self.samples
        return float(area[far].sum())

    def shown(self, view: tuple[float, float]) -> int:
        """Return how much of what lies far away is seen from one side, in pixels of a small picture."""
        points, far, _ = self.samples
        right, up, eye = directions(*view)
        flat = np.stack([points @ right, points @ up], axis=1)
        low, side = flat.min(axis=0), max(float(np.linalg.norm(np.ptp(points, axis=0))), 1e-12)
        place = ((flat - low) / side * (SMALL - 1)).astype(np.int64) @ (SMALL, 1)
        nearest = np.lexsort((points @ eye, place))
        front = nearest[np.flatnonzero(np.diff(place[nearest], append=-1))]
        return int(far[front].sum())


def before_and_after(
    given: Surface, result: Surface, *, cell: float, report: Mapping[str, Any], captions: tuple[str, str]
) -> Image.Image:
    """Return both surfaces side by side, with what was lost in red and what was added in blue.

    Parameters
    ----------
    given, result : Surface, mm
    cell : float, mm
        What lies further than `FAR` of these from the other surface is marked.
    report : mapping
        See docs/report.md.
    captions : (str, str)
        What stands above the two.
    """
    if given.volume < 0:  # inside out
        given = replace(given, faces=given.faces[:, ::-1])
    lost = Marked(surface=given, other=result, far=FAR * cell, colour=LOST)
    added = Marked(surface=result, other=given, far=FAR * cell, colour=ADDED)
    view = _view(lost, added)
    window = _window((given, result), view)
    pictures = [_picture(each, view, window) for each in (lost, added)]
    panels = {caption: picture for caption, (picture, _) in zip(captions, pictures, strict=True)}
    size = " x ".join(f"{length:.4g}" for length in report["extents"])
    facts = f"{size} mm, volume {report['volume']:.6g} cubic mm ({report['volume_change']:+.4%})"
    told = [
        (each.colour, f"{float(f'{each.area:.3g}'):,g} square mm {word}{'' if shown else ', not seen here'}")
        if each.area
        else (None, f"nothing {word}")
        for each, word, (_, shown) in zip((lost, added), ("lost", "added"), pictures, strict=True)
    ]
    ends = f"{facts}; marked if more than {FAR * cell:.3g} mm ({FAR:g} voxels) apart"
    return sheet(panels, ends, [(None, f"{report['verdict']['word']}:"), *told])


def _picture(marked: Marked, view: tuple[float, float], window: Window) -> tuple[Image.Image, bool]:
    """Return a surface as it is seen from one side, and whether anything that is marked is seen."""
    hits = 0

    def paint(points: Floats) -> NDArray[np.number]:
        nonlocal hits
        far = marked.is_far(points) if marked.area else np.zeros(len(points), dtype=bool)
        hits += int(far.sum())
        return np.where(far[:, None], np.array(marked.colour), np.array(PLAIN))

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
    return Image.fromarray(pixels), hits >= SEEN


def _view(lost: Marked, added: Marked) -> tuple[float, float]:
    """Return a view that shows what was lost, or else what was added: the first that shows about as much as the best.

    Where there is neither, that is the usual one.
    """
    for each in (lost, added):
        if not each.area:
            continue
        counts = [each.shown(view) for view in VIEWS]
        if any(counts):
            return VIEWS[int(np.argmax(np.array(counts) >= ENOUGH * max(counts)))]
    return VIEWS[0]


def _window(surfaces: tuple[Surface, ...], view: tuple[float, float]) -> Window:
    """Return a square window around surfaces, as they are seen from one side."""
    axes = directions(*view)[:2].T
    at = [surface.vertices[np.unique(surface.faces)] @ axes for surface in surfaces]
    low, high = np.min([each.min(axis=0) for each in at], axis=0), np.max([each.max(axis=0) for each in at], axis=0)
    middle, half = (low + high) / 2, max(float((high - low).max()), 1e-12) / 2 * MARGIN
    left, bottom = (middle - half).tolist()
    right, top = (middle + half).tolist()
    return left, right, bottom, top
