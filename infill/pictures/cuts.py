"""A solid cut open where that shows its inside, from the front and from above."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from infill.arrays import Floats
from infill.meshes.solids import FINE, from_manifold, solid_status, to_manifold
from infill.pictures.render import AZIMUTH, ELEVATION, Colour, render
from infill.pictures.sections import Cut, choose_cuts
from infill.pictures.sheet import BACKGROUND, PANEL, arrange_panels
from infill.plain_numbers import choose_unit, count_noun, plain_size
from infill.reports.filled_regions import describe_region
from infill.surface import Surface

CUT: Colour = (240, 160, 60)
BEHIND: Colour = (196, 200, 206)
ABOVE = math.radians(55)  # the elevation of the view of a level cut
THUMBNAIL = 256  # pixels
PLANE_TOLERANCE = 1e-6  # of the size: points this close to the plane of a cut belong to the cut
VISIBLE_SIDE = (-1.0, 1.0, -1.0)  # the visible side of a cut across x, y and z
# Azimuth and elevation of each view.
VIEWS = ((AZIMUTH + math.pi / 2, ELEVATION), (AZIMUTH, ELEVATION), (AZIMUTH, ABOVE))


def draw_cuts(
    surface: Surface, report: Mapping[str, Any], *, part: Surface | None = None, given: Sequence[Cut] = ()
) -> Image.Image:
    """Draw a closed surface cut open, upright and level: where requested, or where its inside shows best.

    Parameters
    ----------
    surface : Surface, mm
    report : mapping
        See docs/report.md.
    part : Surface, optional
        The same surface without its voids.
    given : sequence of Cut
        Cuts; by default, or for a missing upright or level cut, the one that shows the inside best.
    """
    panels = {f"cut at {cut}": _draw_half(surface, cut) for cut in choose_cuts(surface, part, given)}
    size = plain_size(*report["extents"], digits=4)
    request, voids = report["request"], report["voids"]
    facts = f"{size}, {request['pattern']}, {report['density']:.1%} solid{_describe_walls(report)}"
    regions = [describe_region(region, request) for region in report["regions"] if region["density"] is not None]
    facts += f": {', '.join(regions)}" if regions else ""
    return arrange_panels(panels, facts, [(CUT, "cut"), (BEHIND, f"behind it; {count_noun(voids['count'], 'void')}")])


def _describe_walls(report: Mapping[str, Any]) -> str:
    """Describe the requested shell, from the least to the largest thickness if regions have their own."""
    walls = [report["request"]["wall"], *(region["wall"] for region in report["regions"] if region["wall"] is not None)]
    if not max(walls):
        return ", without a shell"
    unit = choose_unit(max(walls))
    ends = (plain_size(wall, digits=6, unit=unit) for wall in sorted({min(walls), max(walls)}))
    return f" inside walls of {' to '.join(ends)}"


def draw_block(surface: Surface, box: Surface, report: Mapping[str, Any]) -> Image.Image:
    """Draw a block of infill whole, and cut open where that shows its inside best.

    Parameters
    ----------
    surface, box : Surface, mm
        The block, and the same block if it were solid.
    report : mapping
        See docs/report.md.
    """
    whole = Image.fromarray(render(surface, width=PANEL, height=PANEL, colour=BEHIND))
    panels = {"block": whole} | {f"cut at {cut}": _draw_half(surface, cut) for cut in choose_cuts(surface, box)}
    size = plain_size(*report["extents"], digits=4, separator="")
    facts = f"{size}, {report['request']['pattern']}, {report['density']:.1%} solid"
    return arrange_panels(panels, facts, [(CUT, "cut")])


def render_thumbnail(surface: Surface, side: int = THUMBNAIL) -> bytes:
    """Render a small PNG of a closed surface without its front half."""
    with io.BytesIO() as file:
        _draw_half(surface, choose_cuts(surface)[0], side).save(file, format="PNG")
        return file.getvalue()


def _draw_half(surface: Surface, cut: Cut, side: int = PANEL) -> Image.Image:
    """Draw the part behind, or below, a cut."""
    solid, axis = to_manifold(surface), cut.axis
    if solid_status(solid) == FINE:
        normal = [0.0, 0.0, 0.0]
        normal[axis] = VISIBLE_SIDE[axis]
        surface = from_manifold(solid.trim_by_plane(normal, normal[axis] * cut.at))
    tolerance = PLANE_TOLERANCE * float(np.ptp(surface.bounds, axis=0).max())

    def paint(points: Floats) -> NDArray[np.number]:
        """Return the colour of points, another one on the cut."""
        return np.where((np.abs(points[:, axis] - cut.at) < tolerance)[:, None], np.array(CUT), np.array(BEHIND))

    azimuth, elevation = VIEWS[axis]
    pixels = render(
        surface,
        width=side,
        height=side,
        azimuth=azimuth,
        elevation=elevation,
        background=BACKGROUND,
        paint=paint,
    )
    return Image.fromarray(pixels)
