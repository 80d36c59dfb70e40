"""Pictures: fields with their zero contour, and solids, on labelled axes at the same scale. Takes the extra `plot`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from infill.files.whole_files import atomic_file
from infill.pictures.render import directions, render
from infill.surface import Surface

try:
    from matplotlib.collections import LineCollection
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.figure import Figure
except ModuleNotFoundError as error:
    raise ModuleNotFoundError("pictures take matplotlib: pip install 'phasefill[plot]'", name=error.name) from None

if TYPE_CHECKING:
    from matplotlib.axes import Axes

RAW, SMOOTH, TRUTH, PEER = "0.35", "#c01818", "#1560bd", "#2a8a3a"
SOLID, VOID = "#f0a03c", "#f6f6f6"
FIELD = LinearSegmentedColormap.from_list("field", [VOID, SOLID])
PIXELS = 420
VIEW = (math.radians(-60), math.radians(25))


def panels(
    columns: int, rows: int = 1, *, width: float = 3.4, height: float = 3.4
) -> tuple[Figure, NDArray[np.object_]]:
    """Return a figure and its axes, (rows, columns)."""
    figure = Figure(figsize=(width * columns, height * rows), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False)
    return figure, axes


def save(figure: Figure, path: Path) -> None:
    """Write the picture with 256 colours, which is a third of the size."""
    drawn = BytesIO()
    figure.savefig(drawn, dpi=100)
    with Image.open(drawn) as picture, atomic_file(path) as file:
        picture.convert("RGB").quantize(256).save(file, format="PNG", optimize=True)


def edges(phi: NDArray[np.floating], h: float, origin: Sequence[float] | None) -> tuple[float, float, float, float]:
    """Return left, right, bottom and top of a plane field [x, y], centred on 0 if there is no origin."""
    nx, ny = phi.shape
    x, y = origin or (-nx * h / 2, -ny * h / 2)
    return x, x + nx * h, y, y + ny * h


def show_field(
    ax: Axes,
    phi: NDArray[np.floating],
    *,
    h: float = 1.0,
    origin: Sequence[float] | None = None,
    title: str = "",
    unit: str = "",
) -> None:
    """Draw a field [x, y], from the colour of void at -1 to that of solid at +1."""
    ax.imshow(phi.T, origin="lower", extent=edges(phi, h, origin), cmap=FIELD, vmin=-1, vmax=1, interpolation="nearest")
    named(ax, title, unit)


def show_contour(
    ax: Axes,
    phi: NDArray[np.floating],
    *,
    h: float = 1.0,
    origin: Sequence[float] | None = None,
    colour: str = SMOOTH,
    label: str = "",
    width: float = 1.4,
    style: str = "-",
) -> None:
    """Draw the zero contour of a field [x, y]."""
    left, right, bottom, top = edges(phi, h, origin)
    x, y = (
        np.linspace(left + h / 2, right - h / 2, phi.shape[0]),
        np.linspace(bottom + h / 2, top - h / 2, phi.shape[1]),
    )
    ax.contour(x, y, phi.T, levels=[0.0], colors=[colour], linewidths=width, linestyles=style)
    if label:
        ax.plot([], [], color=colour, lw=width, ls=style, label=label)


def show_cells(
    ax: Axes,
    f: NDArray[np.floating],
    *,
    h: float = 1.0,
    origin: Sequence[float] | None = None,
    colour: str = RAW,
    label: str = "",
) -> None:
    """Draw the outline of the solid cells of a binary field [x, y], along the edges of cells."""
    left, _, bottom, _ = edges(f, h, origin)
    solid = np.pad(f > 0, 1)
    for axis, (a, b) in enumerate(((left, bottom), (bottom, left))):
        across = solid if axis == 0 else solid.T
        i, j = np.nonzero(across[1:, 1:-1] != across[:-1, 1:-1])
        ends = np.stack([b + j * h, b + (j + 1) * h], axis=1)
        at = np.repeat((a + i * h)[:, None], 2, axis=1)
        lines = np.stack([at, ends] if axis == 0 else [ends, at], axis=2)
        ax.add_collection(LineCollection(list(lines), colors=colour, linewidths=0.8))
    if label:
        ax.plot([], [], color=colour, lw=0.8, label=label)


def show_smoothed(
    ax: Axes,
    phi: NDArray[np.floating],
    f: NDArray[np.floating],
    title: str,
    *,
    h: float = 1.0,
    origin: Sequence[float] | None = None,
    unit: str = "",
    names: tuple[str, str] = ("x", "y"),
    label: str = "φ = 0",
) -> None:
    """Draw a plane field [x, y] with its zero contour, and the edge of the data it came from."""
    show_field(ax, phi, h=h, origin=origin)
    show_cells(ax, f, h=h, origin=origin, label="edge of the data")
    show_contour(ax, phi, h=h, origin=origin, label=label)
    named(ax, title, unit, names)


def show_outline(
    ax: Axes, outline: shapely.Geometry, *, h: float, size: tuple[int, ...], colour: str = TRUTH, label: str = ""
) -> None:
    """Draw an outline that is given in cells of a grid of `size`, about the middle of that grid."""
    for part in shapely.get_parts(shapely.boundary(outline)):
        points = (shapely.get_coordinates(part) - np.array(size) / 2) * h
        ax.plot(*points.T, color=colour, lw=1, ls="--")
    if label:
        ax.plot([], [], color=colour, lw=1, ls="--", label=label)


def legend(figure: Figure, ax: Axes) -> None:
    """Say below all panels what the lines of one of them are."""
    figure.set_figheight(figure.get_figheight() + 0.35)
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=6, fontsize=9, frameon=False)


def named(ax: Axes, title: str, unit: str = "", names: tuple[str, str] = ("x", "y")) -> None:
    """Write title and axes, and give both axes the same scale."""
    ax.set_title(title, fontsize=10)
    ax.set_xlabel(f"{names[0]}{unit and f' [{unit}]'}", fontsize=9)
    ax.set_ylabel(f"{names[1]}{unit and f' [{unit}]'}", fontsize=9)
    ax.tick_params(labelsize=8)
    ax.set_aspect("equal")


def show_solids(
    axes: Sequence[Axes],
    surfaces: Sequence[Surface],
    titles: Sequence[str],
    *,
    h: float = 1.0,
    unit: str = "",
    view: tuple[float, float] = VIEW,
) -> None:
    """Draw surfaces, whose lengths are times h, from the same side and at the same scale.

    Lengths are those in the plane of the picture, from the middle of all surfaces; `view` is azimuth and elevation.
    """
    right, up, _ = turned = directions(*view)
    bounds = np.array([surface.bounds for surface in surfaces]) * h
    centre = (bounds[:, 0].min(axis=0) + bounds[:, 1].max(axis=0)) / 2
    reach = 1.04 * max(float(np.abs((surface.vertices * h - centre) @ turned[:2].T).max()) for surface in surfaces)
    foot = np.full(2, -0.88 * reach)  # of the little axes in the corner
    window = (-reach, reach, -reach, reach)
    for ax, surface, title in zip(axes, surfaces, titles, strict=True):
        moved = Surface(vertices=surface.vertices * h - centre, faces=surface.faces)
        picture = render(moved, width=PIXELS, height=PIXELS, azimuth=view[0], elevation=view[1], window=window)
        ax.imshow(picture, extent=window, interpolation="antialiased")
        named(ax, title, unit, ("across", "up"))
        for i, name in enumerate("xyz"):
            way = 0.11 * reach * np.array([right[i], up[i]])
            ax.plot(*np.stack([foot, foot + way], axis=1), "k-", lw=1)
            ax.text(*(foot + 1.35 * way), name, fontsize=7, ha="center", va="center")
