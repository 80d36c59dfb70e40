"""Make the pictures of README and docs: ``make pictures``."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image, ImageChops

from infill import Smoothing, Surface, fill, make, refill, smooth_labels, smooth_volume
from infill.meshes.distance import TriangleTree
from infill.meshes.split_components import concatenate_surfaces
from infill.pictures.render import render
from infill.pictures.speeds import write_speeds
from infill.planner.layer_speeds import layer_speeds
from infill.samples.catalogue import write_sample

ROOT = Path(__file__).resolve().parents[1]
FOLDER = Path(__file__).parent / "pictures"
PANEL = 320  # pixels along the sides of a picture of labels
LABEL_COLOURS = ((240, 160, 60), (90, 140, 220))
BRAIN = Path(os.environ.get("INFILL_DATA", ROOT / "data")) / "volumes" / "brain_desikan_killiany.nii.gz"
VIEW = (2.2, 0.6)  # azimuth and elevation, radians
sys.path.insert(0, str(ROOT))

from tests import browsing, made_shapes, prints, slicers  # noqa: E402 - the folder beside this one


def main() -> None:
    """Write stages and meshes of designs, both stamps, two solids, two prints before and after, and gradients."""
    FOLDER.mkdir(exist_ok=True)
    make("honeycomb").save(FOLDER / "honeycomb.png")
    for name in ("honeycomb", "zigzag", "concentric-heart"):
        block = make(name, size=40, height=8, stamp="exact")
        picture = Image.fromarray(render(block.surface, width=360, height=240))
        picture.save(FOLDER / f"{name}-mesh.png", optimize=True)
    both = Image.new("RGB", (960, 400), "white")
    for left, stamp in ((0, "block"), (480, "exact")):
        block = make("honeycomb", size=14, height=3, angle=7, stamp=stamp)
        both.paste(Image.fromarray(render(block.surface, width=480, height=400)), (left, 0))
    both.save(FOLDER / "stamps.png", optimize=True)
    smooth_volume(gyroid(), spacing=0.5, tolerance=None).save(FOLDER / "smooth.png")
    save_labels(FOLDER / "labels-together.png")
    if BRAIN.exists():  # tools/data.toml says how to come by it
        save_brain(BRAIN, FOLDER / "brain-together.png")
    fill(bracket(), density=0.2).save(FOLDER / "fill.png")
    if not slicers.missing_prusa():
        save_refill(prints.prusa_print, {"fill_pattern": "honeycomb"}, FOLDER / "refill.png")
        save_gradients(FOLDER / "refill-gradients.png")
        save_following(FOLDER / "refill-following.png")
    if shutil.which("chromium"):
        save_pages(FOLDER / "viewer.png")
    if not slicers.missing_cura():
        save_refill(
            prints.cura_print, {"infill_pattern": "cross", "zig_zaggify_infill": "true"}, FOLDER / "refill-cura.png"
        )


def save_pages(path: Path) -> None:
    """Photograph two pages in a browser, one below the other: a filled part, and the sample print refilled."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_sample("print", folder / "print.gcode")
        fill(write_sample("part", folder / "part.stl"), density=0.15).save(folder / "part.html")
        refilled = refill(folder / "print.gcode", output=folder / "smooth.gcode")
        (folder / "print.html").write_text(refilled.page(), encoding="utf-8")
        pages = []
        for kind, layer in (("part", None), ("print", "20")):
            with browsing.open_page((folder / f"{kind}.html").as_uri(), width=1100, height=520) as page:
                browsing.wait_until_drawn(page)
                if layer is not None:
                    page.get_by_label("Last layer that is shown").fill(layer)
                page.evaluate("viewers[0].frame()")
                pages.append(browsing.pixels(page).astype(np.uint8))
    Image.fromarray(np.vstack(pages)).quantize(128).save(path, optimize=True)


def save_labels(path: Path) -> None:
    """Draw two of three labels at the line where they meet: their voxels, each by itself, and all together."""
    x, y, z = (axis - 15.5 for axis in np.indices((32, 32, 32)))
    angle = np.arctan2(y - 0.23 * z, x - 0.41 * z) + np.pi + 0.4
    labels = np.floor(angle / (2 * np.pi / 3)).astype(int) % 3 + 1
    labels[(x**2 + y**2 + z**2) > 12**2] = 0
    plain = smooth_labels(labels, together=True, method="plain", smoothing=Smoothing(steps=0))
    apart = smooth_labels(labels, method="plain", tolerance=None)
    together = smooth_labels(labels, together=True, method="plain")
    sheet = Image.new("RGB", (3 * PANEL, PANEL), "white")
    for number, result in enumerate((plain, apart, together)):
        shown = [result.surfaces[f"label_{label}"] for label in (1, 2)]
        trees = [TriangleTree.of(surface) for surface in shown]

        def paint(points: np.ndarray, trees: list[TriangleTree] = trees) -> np.ndarray:
            nearest = np.argmin([tree.nearest(points)[0] for tree in trees], axis=0)
            return np.array(LABEL_COLOURS)[nearest]

        whole = concatenate_surfaces(shown)
        view = render(whole, width=PANEL, height=PANEL, azimuth=VIEW[0], elevation=VIEW[1], paint=paint)
        sheet.paste(Image.fromarray(view), (number * PANEL, 0))
    sheet.quantize(64).save(path, optimize=True)


def save_brain(source: Path, path: Path) -> None:
    """Draw the regions of a brain, smoothed together: the triangles that part them from what is around the brain."""
    walls = smooth_labels(source, together=True).stages.walls
    outer = (walls.labels == 0).any(axis=1)
    surface, labels = Surface(vertices=walls.points, faces=walls.triangles[outer]), walls.labels[outer].max(axis=1)
    tree = TriangleTree.of(surface)
    colours = np.random.default_rng(4).integers(60, 250, (labels.max() + 1, 3))
    view = render(
        surface,
        width=2 * PANEL,
        height=2 * PANEL,
        azimuth=np.pi - 0.3,
        elevation=0.25,
        paint=lambda points: colours[labels[tree.nearest(points)[1]]],
    )
    picture = Image.fromarray(view)
    picture.crop(ImageChops.invert(picture).getbbox()).quantize(96).save(path, optimize=True)


def save_following(path: Path) -> None:
    """Slice a part with a step, and write a layer below its lower roof with each pattern that follows the print."""
    low, high = trimesh.creation.box((60, 40, 12)), trimesh.creation.box((30, 40, 24))
    low.apply_translation([0, 0, 6])
    high.apply_translation([-15, 0, 12])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        trimesh.boolean.union([low, high], engine="manifold").export(folder / "step.stl")
        sliced = prints.prusa_print(folder / "step.stl", folder / "print.gcode", {"fill_pattern": "cubic"})
        drawn = {}
        for pattern in ("adaptive-cubic", "support-cubic", "lightning"):
            refill(sliced, output=folder / f"{pattern}.gcode", pattern=pattern)
            drawn[pattern] = layer_speeds(folder / f"{pattern}.gcode", 50)
        with path.open("wb") as file:
            write_speeds(drawn, file)
    with Image.open(path) as picture:
        picture.quantize(64).save(path, optimize=True)


def save_gradients(path: Path) -> None:
    """Slice a box of 60 mm, and write a layer whose density changes along x, and one where it does from the walls."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print_ = prints.prusa_print(prints.box(folder, (60, 60, 20)), folder / "print.gcode")
        both = {}
        for pattern, by in (("honeycomb", "x"), ("grid", "skin")):
            graded = folder / f"{pattern}.gcode"
            refill(print_, output=graded, pattern=pattern, density="40%:12%", by=by)
            both[f"{pattern}, 40%:12% by {by}"] = layer_speeds(graded, 50)
        with path.open("wb") as file:
            write_speeds(both, file)
    with Image.open(path) as picture:
        picture.quantize(64).save(path, optimize=True)


def save_refill(slice_it: Callable[..., Path], settings: dict[str, object], path: Path) -> None:
    """Slice a box of 30 mm, and write a layer of it as it was sliced and as it is refilled, speed in colour."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print_ = slice_it(prints.box(folder, (30, 30, 4)), folder / "print.gcode", settings)
        smooth = refill(print_, output=folder / "smooth.gcode").path
        both = {"as it was sliced": layer_speeds(print_, 10), "refilled": layer_speeds(smooth, 10)}
        with path.open("wb") as file:
            write_speeds(both, file)
    with Image.open(path) as picture:
        picture.quantize(64).save(path, optimize=True)


def bracket() -> trimesh.Trimesh:
    """Return an angle with two holes, 60 mm long."""
    box, rod = made_shapes.box, made_shapes.rod
    angle = made_shapes.union(box(60, 40, 12, (0, 0, 6)), box(16, 40, 40, (-22, 0, 20)))
    return made_shapes.less(angle, *(rod(4, 40, (16, y, 6)) for y in (-10, 10)))


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
