"""Make the pictures of README and docs: ``make pictures``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from infill import make, smooth_volume
from infill.pictures.preview import save_preview
from infill.pictures.render import render

FOLDER = Path(__file__).parent / "pictures"


def main() -> None:
    """Write the four stages of a design, the mesh of each, both stamps, and a solid before and after."""
    FOLDER.mkdir(exist_ok=True)
    save_preview(make("honeycomb"), FOLDER / "honeycomb.png")
    for name in ("honeycomb", "zigzag", "concentric-heart"):
        block = make(name, size=40, height=8, stamp="exact")
        picture = Image.fromarray(render(block.surface, width=360, height=240))
        picture.save(FOLDER / f"{name}-mesh.png", optimize=True)
    both = Image.new("RGB", (960, 400), "white")
    for left, stamp in ((0, "block"), (480, "exact")):
        block = make("honeycomb", size=14, height=3, angle=0.12, stamp=stamp)
        both.paste(Image.fromarray(render(block.surface, width=480, height=400)), (left, 0))
    both.save(FOLDER / "stamps.png", optimize=True)
    save_preview(smooth_volume(gyroid(), spacing=0.5), FOLDER / "smooth.png")


def gyroid() -> np.ndarray:
    """Return the voxels of a ball of gyroid sheet."""
    x, y, z = np.indices((90, 90, 90)) - 44.5
    wave = 2 * np.pi / 40
    sheet = (
        np.sin(wave * x) * np.cos(wave * y) + np.sin(wave * y) * np.cos(wave * z) + np.sin(wave * z) * np.cos(wave * x)
    )
    return (np.abs(sheet) < 0.45) & (x**2 + y**2 + z**2 < 40**2)


if __name__ == "__main__":
    main()
