"""Make the pictures of README and docs: ``make pictures``."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

from infill import make
from infill.preview import save_preview
from infill.render import render

FOLDER = Path(__file__).parent / "pictures"


def main() -> None:
    """Write the four stages of each design, and its mesh."""
    FOLDER.mkdir(exist_ok=True)
    for name in ("honeycomb", "zigzag", "concentric-heart"):
        save_preview(make(name), FOLDER / f"{name}.png")
        block = make(name, size=40, height=8, stamp="exact")
        picture = Image.fromarray(render(block.surface, width=360, height=240))
        picture.save(FOLDER / f"{name}-mesh.png", optimize=True)
    both = Image.new("RGB", (960, 400), "white")
    for left, stamp in ((0, "block"), (480, "exact")):
        block = make("honeycomb", size=14, height=3, angle=0.12, stamp=stamp)
        both.paste(Image.fromarray(render(block.surface, width=480, height=400)), (left, 0))
    both.save(FOLDER / "stamps.png", optimize=True)


if __name__ == "__main__":
    main()
