"""Make the pictures of the pages on PyVista and napari, off screen: `make host-pictures`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyvista
from napari.layers import Labels
from pictures import bracket

from infill.hosts.napari_layers import labels_to_surfaces, surface_in_world

FOLDER = Path(__file__).parent / "pictures"
COLOURS = "#f0a03c", "#5a8cdc", "#7ab87a"


def main() -> None:
    """Write all pictures."""
    save_pyvista(FOLDER / "pyvista.png")
    save_napari(FOLDER / "napari.png")


def save_pyvista(path: Path) -> None:
    """Write a picture of a part with infill, cut open, beside the labels of an image, as PyVista draws them."""
    plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), window_size=(960, 400), border=False)
    part = bracket()
    filled = pyvista.PolyData.from_regular_faces(part.vertices, part.faces).phasefill.fill("gyroid", density=0.2)
    cut = filled.clip("y", origin=filled.center, invert=False)
    plotter.add_mesh(cut, color=COLOURS[0], smooth_shading=True, split_sharp_edges=True)
    set_view(plotter)
    plotter.subplot(0, 1)
    for sector, colour in zip(sectors().phasefill.labels(together=True), COLOURS, strict=True):
        apart = sector.translate(0.35 * np.array(sector.center))
        plotter.add_mesh(apart, color=colour, smooth_shading=True, split_sharp_edges=True)
    set_view(plotter)
    plotter.screenshot(path)


def save_napari(path: Path) -> None:
    """Write a picture of the voxels of a layer of napari beside the layers of their surfaces, drawn by PyVista."""
    image = sectors()
    values = image["sector"].reshape(image.dimensions, order="F").T  # z first, as napari has it
    layer = Labels(values, scale=image.spacing[::-1], name="sectors")
    plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), window_size=(960, 400), border=False)
    voxels = pyvista.ImageData(dimensions=np.array(image.dimensions) + 1, spacing=image.spacing)
    voxels["sector"] = image["sector"]
    for number in range(1, len(COLOURS) + 1):
        solid = voxels.threshold((number, number), scalars="sector")
        plotter.add_mesh(solid, color=layer.colormap.map(number)[:3], scalars=None)
    set_view(plotter)
    plotter.subplot(0, 1)
    for number, (data, attributes, _) in enumerate(labels_to_surfaces(layer, together=True), start=1):
        surface = surface_in_world(data, attributes)
        mesh = pyvista.PolyData.from_regular_faces(surface.vertices, surface.faces)
        plotter.add_mesh(mesh, color=layer.colormap.map(number)[:3], smooth_shading=True, split_sharp_edges=True)
    set_view(plotter)
    plotter.screenshot(path)


def set_view(plotter: pyvista.Plotter) -> None:
    """Look from the front, somewhat from above."""
    plotter.view_vector((1.2, -2.0, 1.0))
    plotter.camera.zoom(1.2)


def sectors() -> pyvista.ImageData:
    """Return an image of a ball with bumps, in three labels."""
    image = pyvista.ImageData(dimensions=(48, 44, 40), spacing=(1.0, 1.0, 1.1), origin=(-23.5, -21.5, -21.5))
    x, y, z = image.points.T
    radius = np.sqrt(x**2 + y**2 + z**2) + 1.5 * np.sin(4 * np.arctan2(y, x)) * np.hypot(x, y) / 18
    turn = (np.arctan2(y, x) + 0.06 * z) % (2 * np.pi)
    image["sector"] = np.where(radius < 17, 1 + (turn * len(COLOURS) / (2 * np.pi)).astype(int), 0)
    return image


if __name__ == "__main__":
    main()
