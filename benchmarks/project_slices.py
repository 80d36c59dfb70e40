"""What PrusaSlicer makes of projects: ``python -m benchmarks.project_slices``.

Every printable part of the test data is filled by the command, as a project, and sliced twice: the project, and the
part alone without infill. What the project has more must be the infill body's volume where the slicer puts infill,
layer by layer: inside of the perimeters, and a quarter of a line into them. There are no solid layers, so that nothing
else is in the way. A second figure compares it with what of the body lies where perimeters leave at least a line of
room: slicers print none where they leave less. ``--parts bracket_medium`` and ``--patterns gyroid`` for a first look.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import manifold3d
import numpy as np

from benchmarks.fill_parts import FOLDER, PATTERNS
from benchmarks.pairs import row
from infill import Surface, check_project, read_mesh
from infill.meshes.solids import FINE, manifold_status, to_manifold
from tests.slicers import FILLED_SETTINGS, OVERLAP, PERIMETERS, missing_prusa, prusa_volumes

LAYER = float(str(FILLED_SETTINGS["layer_height"]))
LINE = 0.45  # mm
BED = {"bed_shape": "0x0,400x0,400x400,0x400", "max_print_height": 400}
OPEN = {**BED, "top_solid_layers": 0, "bottom_solid_layers": 0, "infill_overlap": f"{OVERLAP / LINE:.0%}"}
SLOW = 1200  # seconds that the slicer may take: it has 1,778 layers in the tallest part
OFF_INFILL, OFF_PERIMETERS = 0.05, 0.01
WALLS = ("Perimeter", "External perimeter", "Overhang perimeter")


def room_in_layers(part: Surface, infill: Surface) -> tuple[float, float]:
    """Return the volume of the infill where the slicer puts any, and what of it has a line of room, mm³."""
    one, two = to_manifold(part), to_manifold(infill)
    low, high = part.bounds[:, 2]
    around = manifold3d.JoinType.Round
    found = wide = 0.0
    for z in np.arange(low + LAYER / 2, high, LAYER):
        section, body = one.slice(z), two.slice(z)
        found += (section.offset(OVERLAP - PERIMETERS, around) ^ body).area() * LAYER
        opened = section.offset(-PERIMETERS - LINE / 2, around).offset(LINE / 2 + OVERLAP, around)
        wide += (opened ^ body).area() * LAYER
    return found, wide


def infill_of(project: Path, part: Surface) -> Surface:
    """Return the infill of a project: the triangles of its object that follow the part's."""
    with zipfile.ZipFile(project) as package:
        model = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    core = model.tag[: model.tag.index("}") + 1]
    vertices, triangles = (
        np.array([[float(each.get(key, "nan")) for key in keys] for each in model.iter(f"{core}{tag}")])
        for tag, keys in (("vertex", ("x", "y", "z")), ("triangle", ("v1", "v2", "v3")))
    )
    return Surface(vertices=vertices, faces=triangles.astype(np.int64)[len(part.faces) :])


def one_case(part: Path, pattern: str, density: float, folder: Path) -> bool:
    """Print a row on a part, and return whether all holds."""
    standing = folder / "part.stl"
    mesh = read_mesh(part).to_trimesh()
    mesh.apply_translation([200, 200, 0] - np.array([*mesh.bounds.mean(axis=0)[:2], mesh.bounds[0][2]]))
    mesh.export(standing)
    project = folder / "part.3mf"
    words = ["fill", str(standing), "--for", "prusaslicer", "--pattern", pattern, "--density", f"{density:.0%}"]
    command = [sys.executable, "-m", "infill", *words, "-q", "--force", "-o", str(project)]
    subprocess.run(command, check=True)
    found = check_project(project, "prusaslicer")
    skin = Surface(vertices=mesh.vertices, faces=mesh.faces)
    taken = read_mesh(standing) if found.volumes[0].triangles == len(mesh.faces) else skin
    whole, layers, said = prusa_volumes(project, folder, seconds=SLOW, **OPEN)
    alone, same, _ = prusa_volumes(standing, folder, seconds=SLOW, **OPEN, fill_density="0%")
    body = wide = float("nan")
    if manifold_status(taken) == FINE:
        body, wide = room_in_layers(taken, infill_of(project, taken))
    infill = sum(whole.values()) - sum(alone.values())
    walls = sum(whole.get(kind, 0.0) for kind in WALLS), sum(alone.get(kind, 0.0) for kind in WALLS)
    wrong = {
        "; ".join(found.problems): not found.fine,
        f"{layers} layers, {same} without": layers != same,
        "repaired": "repair" in said.lower(),
        f"infill {infill / body - 1:+.1%}": not abs(infill / body - 1) <= OFF_INFILL,
        f"perimeters {walls[0] / walls[1] - 1:+.1%}": not abs(walls[0] / walls[1] - 1) <= OFF_PERIMETERS,
    }
    holds = not any(wrong.values())
    off = f"{infill / body - 1:+6.1%} {infill / wide - 1:+6.1%} {walls[0] / walls[1] - 1:+7.2%}"
    numbers = f"{body:8.0f} mm³ {off} {layers:4} layers"
    told = ", ".join(what for what, is_wrong in wrong.items() if is_wrong)
    row(f"{'ok ' if holds else 'NO '} {part.stem}, {pattern}, {density:.0%}", f"{numbers} {told}")
    return holds


def main() -> int:
    """Print a row for every case, and return how many do not hold."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--parts", nargs="*")
    parser.add_argument("--patterns", nargs="*", default=list(PATTERNS))
    parser.add_argument("--densities", nargs="*", type=float, default=[0.2])
    given = parser.parse_args()
    if missing_prusa():
        print(missing_prusa())
        return 1
    parts = [path for path in sorted(FOLDER.iterdir()) if path.suffix in (".stl", ".obj", ".3mf")]
    failed = 0
    print("infill body where there is infill; how much more is extruded for it, and for what of it has a line of room;")
    print("perimeters, against the part alone")
    for part in parts:
        if given.parts and part.stem not in given.parts:
            continue
        for pattern in given.patterns:
            for density in given.densities:
                with tempfile.TemporaryDirectory() as folder:
                    try:
                        failed += not one_case(part, pattern, density, Path(folder))
                    except (RuntimeError, subprocess.CalledProcessError) as error:
                        row(f"NO  {part.stem}, {pattern}", str(error)[-200:])
                        failed += 1
    return failed


if __name__ == "__main__":
    sys.exit(main())
