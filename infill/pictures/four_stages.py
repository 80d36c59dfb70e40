"""The four stages of `make` side by side: points, stamp, field and mesh."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from infill.grid import VOID, Grid
from infill.pictures.sheet import INK, PANEL, arrange_panels, draw_mesh_panel
from infill.plain_numbers import plain_size
from infill.surface import Surface

SOLID_COLOUR, VOID_COLOUR, CONTOUR = (240, 160, 60), (246, 246, 246), (190, 30, 30)
BORDER_TOLERANCE = 1e-6  # of a pixel: points this close to the border of two pixels all lie in the same one


def draw_four_stages(
    *,
    points: NDArray[np.float64],
    grid: Grid,
    stamp: NDArray[np.floating],
    smoothed: NDArray[np.floating],
    surface: Surface,
    report: Mapping[str, Any],
) -> Image.Image:
    """Draw the stages of a block as one picture.

    Parameters
    ----------
    points : (N, 2) float64, mm
        Along the lines of the pattern.
    grid : Grid
        Of one layer.
    stamp, smoothed : (nx, ny) float
        The layer before and after smoothing, in [-1, 1].
    surface : Surface, mm
    report : mapping
        See docs/report.md.
    """
    request, width = report["request"], report["wall_width"]
    panels = {
        f"points: {len(points):,}": _draw_points(points, grid),
        f"stamp: {' x '.join(map(str, grid.shape))} cells": _draw_field(stamp),
        f"smoothed: {request['steps']} steps": _draw_contours(smoothed),
        f"mesh: {report['triangles']:,} triangles": draw_mesh_panel(surface),
    }
    size = plain_size(*request["size"], request["height"], digits=6)
    mean = "not measured" if width["mean"] is None else f"{width['mean']:.3f} ({width['p5']:.3f} to {width['p95']:.3f})"
    facts = (
        f"{request['pattern']}, {size}, density {report['density']:.1%}, walls {mean} of "
        f"{plain_size(request['line_width'], digits=6)}"
    )
    return arrange_panels(panels, facts)


def _panel_size(shape: tuple[int, ...]) -> tuple[int, int]:
    """Return the size in pixels of a panel for a field of `shape` [x, y]."""
    scale = PANEL / max(shape)
    return max(1, round(shape[0] * scale)), max(1, round(shape[1] * scale))


def _draw_points(points: NDArray[np.float64], grid: Grid) -> Image.Image:
    """Draw the points of the lines as pixels."""
    columns, rows = _panel_size(grid.shape)
    part = (points - grid.origin) / np.array(grid.extents)
    places = np.column_stack([1 - part[:, 1], part[:, 0]]) * (rows, columns)
    row, column = (places + BORDER_TOLERANCE).astype(int).clip(0, (rows - 1, columns - 1)).T
    hit = np.zeros((rows, columns), dtype=bool)
    hit[row, column] = True
    return Image.fromarray(np.where(hit[..., None], np.array(INK), np.array(VOID_COLOUR)).astype(np.uint8))


def _draw_field(layer: NDArray[np.floating]) -> Image.Image:
    """Draw a field [x, y] with y upwards, from the colour of void at -1 to that of solid at +1."""
    part = ((layer.T[::-1] + 1) / 2).clip(0, 1)[..., None]
    shades = part * np.array(SOLID_COLOUR) + (1 - part) * np.array(VOID_COLOUR)
    picture = Image.fromarray(shades.astype(np.uint8))
    return picture.resize(_panel_size(layer.shape), Image.Resampling.BOX)


def _draw_contours(layer: NDArray[np.floating]) -> Image.Image:
    """Draw a field and its zero contour."""
    from skimage.measure import find_contours

    picture = _draw_field(layer)
    draw = ImageDraw.Draw(picture)
    scale = np.array(picture.size) / layer.shape
    for line in find_contours(np.pad(layer, 1, constant_values=VOID), 0.0):  # type: ignore[no-untyped-call]
        x, y = (line - 0.5).T  # cell 0 of the layer is cell 1 of the padded one, and its centre lies at 0.5
        draw.line(list(zip(x * scale[0], picture.height - y * scale[1], strict=True)), fill=CONTOUR, width=1)
    return picture
