"""A picture of a result: the four stages of `make`, or the input and output of `smooth`, side by side."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from infill.errors import FormatError
from infill.formats.whole_files import whole_file
from infill.grid import VOID, Grid
from infill.making.stages import MakeStages
from infill.pictures.before_and_after import before_and_after
from infill.pictures.render import render
from infill.pictures.sheet import BACKGROUND, INK, PANEL, sheet
from infill.result import Result
from infill.smoothing.by_component import ComponentStages
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.smoothing.stages import SmoothStages

SOLID_COLOUR, VOID_COLOUR, CONTOUR = (240, 160, 60), (246, 246, 246), (190, 30, 30)
SUFFIXES = (".png",)


def check_preview(path: str | os.PathLike[str]) -> Path:
    """Return the path, or raise FormatError if it does not name a picture format we can write."""
    target = Path(path)
    if target.suffix.lower() not in SUFFIXES:
        raise FormatError(f"a preview cannot be written as {target.name!r}; use a name that ends in {SUFFIXES[0]}")
    return target


def save_preview(result: Result[Any], path: str | os.PathLike[str]) -> Path:
    """Write `preview` as a PNG file."""
    target = check_preview(path)
    with whole_file(target) as file:
        write_preview(result, file)
    return target


def write_preview(result: Result[Any], file: BinaryIO) -> None:
    """Write `preview` as PNG."""
    preview(result).save(file, format="PNG")


def preview(result: Result[Any]) -> Image.Image:
    """Return the stages of a result as one picture: points, stamp, field and mesh, or voxels and mesh."""
    stages = result.stages
    if isinstance(stages, MakeStages):
        return _four_stages(stages, result)
    if isinstance(stages, ComponentStages):
        return _components(stages, result)
    return _before_and_after(stages, result)


def _components(stages: ComponentStages, result: Result[Any]) -> Image.Image:
    """Return a mesh and its components, smoothed one by one."""
    report = result.report
    before = f"given: {len(stages.given.faces):,} triangles"
    after = f"smoothed: {len(result.surfaces)} components, {report['triangles']:,} triangles"
    return before_and_after(stages.given, result.whole, cell=stages.voxel, report=report, captions=(before, after))


def _before_and_after(stages: SmoothStages, result: Result[Any]) -> Image.Image:
    """Return what was given, a mesh or the surface of the voxels, and the smoothed surface."""
    from infill.smoothing.placing import staircase

    report = result.report
    shape = " x ".join(map(str, report["grid"]["shape"]))
    given = staircase(stages) if stages.given is None else stages.given
    before = f"data: {shape} voxels" if stages.given is None else f"given: {len(given.faces):,} triangles"
    after = f"smoothed: {report['request']['steps']} steps, {report['triangles']:,} triangles"
    return before_and_after(
        given,
        result.surface,
        cell=float(stages.data.cell_size.max()),
        report=report,
        captions=(before, after),
    )


def _mesh(surface: Surface) -> Image.Image:
    return Image.fromarray(render(surface, width=PANEL, height=PANEL, background=BACKGROUND))


def _four_stages(stages: MakeStages, result: Result[Any]) -> Image.Image:
    report, request = result.report, result.report["request"]
    width = report["wall_width"]
    panels = {
        f"points: {len(stages.points):,}": _points(stages.points, stages.grid),
        f"stamp: {' x '.join(map(str, stages.grid.shape))} cells": _field(stages.stamp),
        f"smoothed: {request['steps']} steps": _contoured(stages.smoothed),
        f"mesh: {report['triangles']:,} triangles": _mesh(result.surface),
    }
    size = " x ".join(f"{length:g}" for length in (*request["size"], request["height"]))
    mean = "not measured" if width["mean"] is None else f"{width['mean']:.3f} ({width['p5']:.3f} to {width['p95']:.3f})"
    facts = (
        f"{request['pattern']}, {size} mm, density {report['density']:.1%}, "
        f"walls {mean} of {request['line_width']:g} mm"
    )
    return sheet(panels, facts)


def _frame(shape: tuple[int, ...]) -> tuple[int, int]:
    """Return the size in pixels of a panel for a field of `shape` [x, y]."""
    scale = PANEL / max(shape)
    return max(1, round(shape[0] * scale)), max(1, round(shape[1] * scale))


def _points(points: NDArray[np.float64], grid: Grid) -> Image.Image:
    columns, rows = _frame(grid.shape)
    part = (points - grid.origin) / np.array(grid.extents)
    hit = np.zeros((rows, columns), dtype=bool)
    hit[
        ((1 - part[:, 1]) * rows).astype(int).clip(0, rows - 1), (part[:, 0] * columns).astype(int).clip(0, columns - 1)
    ] = True
    return Image.fromarray(np.where(hit[..., None], np.array(INK), np.array(VOID_COLOUR)).astype(np.uint8))


def _field(layer: NDArray[np.floating]) -> Image.Image:
    """Draw a field [x, y] with y upwards, from the colour of void at -1 to that of solid at +1."""
    part = ((layer.T[::-1] + 1) / 2).clip(0, 1)[..., None]
    shades = part * np.array(SOLID_COLOUR) + (1 - part) * np.array(VOID_COLOUR)
    picture = Image.fromarray(shades.astype(np.uint8))
    return picture.resize(_frame(layer.shape), Image.Resampling.BOX)


def _contoured(layer: NDArray[np.floating]) -> Image.Image:
    """Draw a field and its zero contour."""
    from skimage.measure import find_contours

    picture = _field(layer)
    draw = ImageDraw.Draw(picture)
    scale = np.array(picture.size) / layer.shape
    for line in find_contours(np.pad(layer, 1, constant_values=VOID), 0.0):  # type: ignore[no-untyped-call]
        x, y = (line - 0.5).T  # cell 0 of the layer is cell 1 of the padded one, and its centre lies at 0.5
        draw.line(list(zip(x * scale[0], picture.height - y * scale[1], strict=True)), fill=CONTOUR, width=1)
    return picture
