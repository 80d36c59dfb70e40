"""Make the gallery of patterns that fill parts, docs/gallery.md and its pictures: ``make gallery``, half an hour."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from PIL import Image

from infill import GeometryError, Result, Surface, fill
from infill.inspection.stiffness import Stiffness, homogenise_stiffness
from infill.lattices.stages import FillStages
from infill.pictures.render import render
from infill.reports.filling import FillReport
from patterns import PATTERNS, Cells, Lightning, Pattern, parameters
from patterns.polyhedra import Polyhedra
from patterns.unit_cells import Bars, Cellular, Network, Planes, Surfaces

FOLDER = Path(__file__).parent / "pictures" / "gallery"
PAGE = Path(__file__).parent / "gallery.md"
SIDE, WALL, DENSITY = 30.0, 1.2, 0.2  # of the cube, mm
OTHERS = (0.1, 0.4)  # densities, besides
FINE = 32  # voxels along a cell, for its stiffness
AMONG = (0.38, 0.46, 0.57)  # of a voxel: where it is sampled; symmetry would have many points as far away
OFF = 0.005  # of a density: what is further off is none
STEEP = np.cos(np.radians(45))  # what hangs over by more than this needs support
INTRODUCTION = """# Gallery

Every pattern that [fill](fill.md) knows, in a cube of {side:g} mm at {density:.0%}, cut open; made by `make
gallery`. Drawings and patterns of your own join them.

* *Cell* and *line* are the sizes that give the density of {density:.0%}, in mm: walls are 0.45 mm wide by default,
  and bars come from a cell of 8 mm; other densities are [below](#density-against-cell-size). A network's line is
  its thickest place.
* The *smallest radius* is the requested one, of the fillets where walls meet: 0.25 mm in every pattern, unless
  `--smooth-radius` sets another. Where the grid has four cells to it, at least 95% of all places keep it. Bars
  thinner than six radii have less, and so do voids narrower than two and a half radii, which are round. Minimal
  surfaces bend as their formula says, whatever radius is requested.
* *Stiffness* is Young's modulus of the pattern far from any wall, in percent of the solid's: along x, along z, and
  in the weakest and the stiffest direction. It is an estimate with {fine} voxels to a cell (foam: 24), homogenised
  with Poisson's ratio 0.3, and exact for upright walls along z. At 3 % the octet is within 16 % of the theory of
  slender bars (Deshpande, Fleck & Ashby, 2001). Patterns that depend on the part have no such value.
* `lightning` has as many branches as the roof needs, not 20%: of this cube it fills {light:.1%}.
* *Overhang* is the share of the voids' surfaces that overhang by more than 45°, which a printer has to bridge without
  support.
* *Voids* is their number in this cube. Each needs its own drain in resin and powder.

| pattern | cell | line | stiffness x | z | weakest | stiffest | overhang | voids |
|---|---|---|---|---|---|---|---|---|
"""

SIZES = """## Density against cell size

In the same cube, in mm: the cell of walls 0.45 mm wide, and the thickness of bars and networks in cells of 8 mm.
Cells are no larger than the {room:g} mm inside: walls are thinner then. In so small a cube, walls that happen to
lie along the shell change the cell by up to a tenth. An empty place means that there is no such density.

| pattern | {densities} |
|---|{lines}
"""


def cell_of(pattern: Cellular) -> np.ndarray:
    """Return the voxels of a period at the density of the gallery."""
    count = FINE if pattern.cells == 1 else 24 * pattern.cells
    sides = pattern.lattice()[0] if isinstance(pattern, Polyhedra) else np.ones(3)
    shape = tuple(np.round(count * sides).astype(int).tolist())  # voxels are cubes, but for this rounding
    lines = [(np.arange(n) + among) / n * side for n, among, side in zip(shape, AMONG, sides, strict=True)]
    points = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)
    if isinstance(pattern, Bars):
        away = distance_to_bars(pattern, points * pattern.cells)
    else:
        away = pattern.distance(points)
        away = np.abs(away) if isinstance(pattern, Surfaces) else away
    return (away <= np.quantile(away, DENSITY)).reshape(shape)


def distance_to_bars(pattern: Bars, points: np.ndarray) -> np.ndarray:
    """Return distances (N,) in cells to the bars of a period, and to those around it."""
    nearest = np.full(len(points), np.inf)
    shifts = np.stack(np.meshgrid(*[(-1, 0, 1)] * 3), axis=-1).reshape(-1, 3) * pattern.cells
    edges = (pattern.axes() * pattern.cells)[None] + shifts[:, None, None]
    for start, end in edges.reshape(-1, 2, 3):
        low, high = np.minimum(start, end) - 0.5, np.maximum(start, end) + 0.5
        near = ((points >= low) & (points <= high)).all(axis=1)
        along, there = end - start, points[near] - start
        share = np.clip(there @ along / (along @ along), 0, 1)
        nearest[near] = np.minimum(nearest[near], np.linalg.norm(there - share[:, None] * along, axis=1))
    return nearest


def modulus(found: Stiffness | None, kind: object) -> list[str]:
    """Return the columns of the stiffness; upright walls are as stiff along z as there is of them."""
    if found is None:
        return ["", f"{DENSITY:.0%}" if getattr(kind, "prismatic", False) else "", "", ""]
    upright = np.array(kind.upright) if isinstance(kind, Planes) else np.eye(3)
    along = found.modulus(upright[:, [0, 2]].T)
    return [f"{each:.1%}" for each in (*along, *found.extremes())]


def overhang(voids: Surface) -> float:
    """Return the share of the surface of voids under which nothing is, and which looks down too steeply."""
    mesh = voids.to_trimesh()  # faces look out of the voids: a ceiling looks up
    return float(mesh.area_faces[mesh.face_normals[:, 2] > STEEP].sum() / mesh.area)


def shown(name: str, solid: Surface) -> None:
    """Write a picture of the cube, a corner of it cut away."""
    corner = trimesh.creation.box((SIDE, SIDE, SIDE)).apply_translation((SIDE / 2, -SIDE / 2, SIDE / 2))
    cut = trimesh.boolean.difference([solid.to_trimesh(), corner], engine="manifold")
    picture = Image.fromarray(render(Surface(vertices=cut.vertices, faces=cut.faces), width=320, height=300))
    picture.quantize(32).save(FOLDER / f"{name}.png", optimize=True)


def filled(name: str, density: float = DENSITY) -> Result[FillStages, FillReport]:
    """Return the cube with a pattern in it."""
    asked = None if name == Lightning.name else density
    return fill(trimesh.creation.box((SIDE, SIDE, SIDE)), name, density=asked, wall=WALL)


def size_at(name: str, kind: Cells | Pattern, density: float) -> str:
    """Return what gives a density, if anything does."""
    try:
        report = filled(name, density).report
    except GeometryError:
        return ""
    return size_of(kind, report) if abs(report["density"] - density) < OFF else ""


def size_of(kind: Cells | Pattern, report: FillReport) -> str:
    """Return the cell of walls, or how thick bars are."""
    sizes = report["infill"]
    return f"{sizes['line_width']:.2f} thick" if isinstance(kind, Bars | Network) else f"{sizes['cell']:.1f}"


def size_table(kinds: dict[str, Cells | Pattern], usual: dict[str, str]) -> str:
    """Return the table of sizes at some densities, of which one is known."""
    densities = sorted({DENSITY, *OTHERS})
    rows = []
    for name, size in usual.items():
        columns = [size if each == DENSITY else size_at(name, kinds[name], each) for each in densities]
        rows.append(f"| [{name}](#{name}) | {' | '.join(columns)} |")
        print(rows[-1], flush=True)
    head = SIZES.format(
        room=SIDE - 2 * WALL, densities=" | ".join(f"{each:.0%}" for each in densities), lines="---|" * len(densities)
    )
    return head + "\n".join(rows) + "\n"


def entry(name: str, kind: Cells | Pattern, result: Result[FillStages, FillReport]) -> tuple[str, str]:
    """Return the row and the section of a pattern, and write its picture."""
    shown(name, result.surface)
    sizes, voids = result.report["infill"], result.report["voids"]["count"]
    found = homogenise_stiffness(cell_of(kind)) if isinstance(kind, Cellular) else None
    columns = [f"[{name}](#{name})", f"{sizes['cell']:.1f}", f"{sizes['line_width']:.2f}", *modulus(found, kind)]
    columns += [f"{overhang(result.stages.voids):.0%}", str(voids)]
    own = [each for each in parameters(kind) if each not in GIVEN]
    options = f" Its own parameters: {', '.join(f'`--set {each}`' for each in own)}." if own else ""
    picture = f"![{name}](pictures/gallery/{name}.png)"
    section = f"## {name}\n\n{kind.summary[0].upper()}{kind.summary[1:]}.{options}\n\n{picture}\n"
    return f"| {' | '.join(columns)} |", section


def main() -> None:
    """Fill a cube with every pattern, and write the page."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    kinds: dict[str, Cells | Pattern] = {
        name: PATTERNS[name]() for name in sorted(PATTERNS.built_in, key=lambda name: PATTERNS[name].prismatic)
    }
    rows, sections, light = [], [], 0.0
    usual = {}
    for name, kind in kinds.items():
        result = filled(name)
        row, section = entry(name, kind, result)
        if isinstance(kind, Lightning):
            light = result.report["density"]
        else:
            usual[name] = size_of(kind, result.report)
        rows.append(row)
        sections.append(section)
        print(row, flush=True)
    head = INTRODUCTION.format(side=SIDE, density=DENSITY, fine=FINE, light=light)
    PAGE.write_text(
        head + "\n".join(rows) + "\n\n" + size_table(kinds, usual) + "\n" + "\n".join(sections), encoding="utf-8"
    )


GIVEN = ("cell", "angle", "phase", "frame")  # options of the command, or of no use in a part

if __name__ == "__main__":
    main()
