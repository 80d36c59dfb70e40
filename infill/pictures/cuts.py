"""A solid cut open through its middle, from the front and from above."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from infill.pictures.render import AZIMUTH, ELEVATION, Colour, Floats, render
from infill.pictures.sheet import BACKGROUND, PANEL, sheet
from infill.surface import Surface
from infill.surfaces.solids import FINE, solid_of, status_of, surface_from

CUT: Colour = (240, 160, 60)
BEHIND: Colour = (196, 200, 206)
ABOVE = math.radians(55)  # the elevation from which a level cut is looked at
THUMBNAIL = 256  # pixels
ON = 1e-6  # of the size: what lies this near the plane of a cut was cut
AXES = "xyz"


def cuts(surface: Surface, report: Mapping[str, Any]) -> Image.Image:
    """Return a closed surface without its front half, and without its upper half.

    Parameters
    ----------
    surface : Surface, mm
    report : mapping
        See docs/report.md.
    """
    panels = {}
    for axis, elevation in ((1, ELEVATION), (2, ABOVE)):
        middle = float(surface.bounds[:, axis].mean())
        panels[f"cut at {AXES[axis]} = {middle:.4g} mm"] = _half(surface, axis, middle, elevation)
    size = " x ".join(f"{length:.4g}" for length in report["extents"])
    request, voids = report["request"], report["voids"]
    facts = f"{size} mm, {request['pattern']}, {report['density']:.1%} solid inside walls of {request['wall']:g} mm"
    return sheet(panels, facts, [(CUT, "cut"), (BEHIND, f"behind it; {voids['count']:,} void(s)")])


def thumbnail(surface: Surface, side: int = THUMBNAIL) -> bytes:
    """Return a small PNG of a closed surface without its front half."""
    middle = float(surface.bounds[:, 1].mean())
    with io.BytesIO() as file:
        _half(surface, 1, middle, ELEVATION, side).save(file, format="PNG")
        return file.getvalue()


def _half(surface: Surface, axis: int, middle: float, elevation: float, side: int = PANEL) -> Image.Image:
    """Return what lies behind, or below, the middle."""
    solid = solid_of(surface)
    if status_of(solid) == FINE:
        normal = [0.0, 0.0, 0.0]
        normal[axis] = 1.0 if axis == 1 else -1.0
        surface = surface_from(solid.trim_by_plane(normal, normal[axis] * middle))
    near = ON * float(np.ptp(surface.bounds, axis=0).max())

    def paint(points: Floats) -> NDArray[np.number]:
        return np.where((np.abs(points[:, axis] - middle) < near)[:, None], np.array(CUT), np.array(BEHIND))

    pixels = render(
        surface,
        width=side,
        height=side,
        azimuth=AZIMUTH,
        elevation=elevation,
        background=BACKGROUND,
        paint=paint,
    )
    return Image.fromarray(pixels)
