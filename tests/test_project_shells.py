"""The solid shell of a project: behind slopes and under domes, slicers make it as they do around infill of their own."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import shapely
import slicers
import trimesh
from made_shapes import ball
from numpy.typing import NDArray

from infill import fill, save_project
from infill.projects import cura as cura_project
from infill.projects import prusaslicer

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa() or "there")
cura = pytest.mark.skipif(bool(slicers.missing_cura()), reason=slicers.missing_cura() or "there")

LAYER, LINE = 0.3, 0.45  # mm
VOXEL = 1.0  # mm: a coarse body is sliced twice as fast, and its shell is the part's, however fine the body is
SHELL = ("Solid infill", "Top solid infill", "Bridge infill", "Internal bridge infill", "SKIN")
BODY = ("Internal infill", "FILL")
Lines = NDArray[np.float64]  # (N, 2, 2): both ends of each, mm
PROFILE = {
    "layer_height": LAYER,
    "first_layer_height": LAYER,
    "solid_infill_below_area": 0,  # else the slicer fills the tip of a pyramid to the full, shell or not
}
OWN = {"fill_density": "20%", "fill_pattern": "gyroid"}


@dataclass(frozen=True)
class Sliced:
    """Lines of a print, by layer and type, and the mm³ of each type."""

    layers: dict[float, dict[str, Lines]]
    volumes: dict[str, float]

    def volume(self, kinds: tuple[str, ...]) -> float:
        """Return the mm³ of some types."""
        return sum(self.volumes.get(kind, 0.0) for kind in kinds)

    def lines(self, z: float, kinds: tuple[str, ...]) -> shapely.MultiLineString:
        """Return the lines of some types in a layer."""
        found = [each for kind in kinds for each in self.layers.get(z, {}).get(kind, [])]
        return shapely.MultiLineString(found)


def read_gcode(path: Path) -> Sliced:
    """Read absolute G-code of PrusaSlicer or CuraEngine, by its comments."""
    layers: dict[float, dict[str, list[tuple[tuple[float, float], tuple[float, float]]]]] = {}
    volumes: dict[str, float] = {}
    kind, at, z, filament = "", (0.0, 0.0), 0.0, 0.0
    for line in path.read_text().splitlines():
        if line.startswith(";TYPE:"):
            kind = line[6:]
        words = {word[0]: float(word[1:]) for word in re.findall(r"(?<=\s)[XYZE]-?[\d.]+", line.split(";")[0])}
        if line.startswith("G92"):
            filament = words.get("E", filament)
        if not line.startswith(("G0 ", "G1 ")):
            continue
        z = round(words.get("Z", z), 3)
        there = (words.get("X", at[0]), words.get("Y", at[1]))
        laid = words.get("E", filament) - filament
        filament = words.get("E", filament)
        if laid > 0 and there != at:
            layers.setdefault(z, {}).setdefault(kind, []).append((at, there))
            volumes[kind] = volumes.get(kind, 0.0) + laid * math.pi / 4 * slicers.FILAMENT_DIAMETER**2
        at = there
    as_arrays = {z: {kind: np.array(lines) for kind, lines in found.items()} for z, found in layers.items()}
    return Sliced(layers=as_arrays, volumes=volumes)


def uncovered(own: Sliced, other: Sliced) -> float:
    """Return the share of the shell of one print where the other has neither shell nor infill."""
    area = bare = 0.0
    for z in sorted(own.layers)[4::3]:  # above the bottom; a third of the layers, for it is slow
        shell = own.lines(z, SHELL).buffer(LINE / 2, quad_segs=2)
        area += shell.area
        bare += shell.difference(other.lines(z, SHELL + BODY).buffer(LINE / 2 + 0.05, quad_segs=2)).area
    return bare / area


def doubled(print_: Sliced) -> float:
    """Return the area where infill is laid on shell, over that of the shell."""
    both = area = 0.0
    for z in sorted(print_.layers)[4::3]:
        shell, body = (print_.lines(z, kinds).buffer(0.4 * LINE, quad_segs=2) for kinds in (SHELL, BODY))
        both += shell.intersection(body).area
        area += shell.area
    return both / area


def hull(*corners: tuple[float, float, float]) -> trimesh.Trimesh:
    return trimesh.PointCloud(corners).convex_hull


def bracket(data: Path) -> trimesh.Trimesh:
    mesh = trimesh.load_mesh(data / "printable" / "bracket_medium.stl")
    return mesh.apply_scale(0.4)


SHAPES: dict[str, Callable[[Path], trimesh.Trimesh]] = {
    "ball": lambda _: ball(9, 3),
    "wedge": lambda _: hull(*[(x, y, z) for x, top in ((0, 3), (26, 9)) for y in (0, 14) for z in (0, top)]),
    "pyramid": lambda _: hull((0, 0, 0), (26, 0, 0), (26, 26, 0), (0, 26, 0), (13, 13, 9)),
    "bracket": bracket,
}


def on_bed(mesh: trimesh.Trimesh, at: float) -> trimesh.Trimesh:
    middle = np.array([*mesh.bounds.mean(axis=0)[:2], mesh.bounds[0][2]])
    return mesh.apply_translation([at, at, 0] - middle)


def sliced(path: Path, folder: Path, **more: object) -> Sliced:
    slicers.prusa_volumes(path, folder, **{**PROFILE, **more})
    return read_gcode(folder / "out.gcode")


@pytest.mark.longest
@prusa
@pytest.mark.parametrize("shape", SHAPES)
def test_prusaslicer_makes_the_shell_of_slopes(
    shape: str, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = on_bed(SHAPES[shape](data), 100)
    mesh.export(tmp_path / "part.stl")
    result = fill(mesh, "gyroid", as_="project", density=0.2, voxel=VOXEL)
    now = save_project(result, tmp_path / "now.3mf", slicer="prusaslicer")
    monkeypatch.setattr(prusaslicer, "PART_SETTINGS", {"fill_density": "0%"})
    vase = save_project(result, tmp_path / "vase.3mf", slicer="prusaslicer")
    own = sliced(tmp_path / "part.stl", tmp_path, **OWN)
    project, lost = sliced(now, tmp_path), sliced(vase, tmp_path)
    # The slicer counts as infill what lies of the body in the shell, a fifth of a narrow one: hence 3 %.
    assert project.volume(SHELL) == pytest.approx(own.volume(SHELL), rel=0.03)
    assert lost.volume(SHELL) < 0.95 * own.volume(SHELL)
    assert uncovered(own, project) < 0.03
    assert uncovered(own, lost) > 0.05
    # No line but those of the body: the part itself has a pattern that prints none.
    assert project.volume(BODY) == pytest.approx(lost.volume(BODY), rel=0.01)
    assert doubled(project) < 0.01


@pytest.mark.slow
@cura
def test_cura_makes_the_shell_of_slopes(tmp_path: Path) -> None:
    """By its engine, which reads no 3MF: a density of 0 takes no skin away."""
    mesh = on_bed(SHAPES["wedge"](tmp_path), 0)
    result = fill(mesh, "gyroid", as_="project", density=0.2, voxel=VOXEL)
    for name, each in result.surfaces.items():
        trimesh.Trimesh(each.vertices, each.faces).export(tmp_path / f"{name}.stl")
    body = {**cura_project.INFILL_SETTINGS, "infill_line_distance": LINE}
    del body["infill_sparse_density"]
    own = cura_sliced(tmp_path, 4.5)  # mm between lines of 0.45 that run two ways: 20 %
    assert cura_project.PART_SETTINGS == {"infill_sparse_density": "0"}
    project = cura_sliced(tmp_path, 0, "-l", "infill.stl", *as_words(body))
    assert own.volume(SHELL) > 0
    assert project.volume(BODY) > 0
    assert project.volume(SHELL) == pytest.approx(own.volume(SHELL), rel=0.03)


def as_words(settings: Mapping[str, object]) -> list[str]:
    return [word for name, value in settings.items() for word in ("-s", f"{name}={value}")]


def cura_sliced(folder: Path, distance: float, *more: str) -> Sliced:
    """Slice part.stl, and what more says, with a distance of the part's own lines in mm (0 for none)."""
    definitions = slicers.cura_definitions()
    widths = ("line_width", "wall_line_width_0", "wall_line_width_x", "infill_line_width", "skin_line_width")
    words = as_words(
        {
            "layer_height": LAYER,
            "layer_height_0": LAYER,
            "infill_sparse_thickness": LAYER,
            "adhesion_type": "none",
            "infill_line_distance": distance,
            "wall_line_count": 2,
            "material_diameter": slicers.FILAMENT_DIAMETER,
            **dict.fromkeys(widths, LINE),
            **dict.fromkeys(("top_layers", "bottom_layers", "initial_bottom_layers"), 4),
        }
    )
    start = ["CuraEngine", "slice", "-j", f"{definitions}/fdmprinter.def.json", *words, "-e0", *words]
    command = [*start, "-o", "out.gcode", "-l", "part.stl", *more]
    slicers.run_slicer(command, folder, CURA_ENGINE_SEARCH_PATH=f"{definitions}:{definitions}/../extruders")
    return read_gcode(folder / "out.gcode")


BELOW: dict[float, dict[str, Lines]] = {-float(z): {} for z in range(4)}


def test_the_comparison_sees_a_missing_shell() -> None:
    """Lines 0.45 mm apart cover a square; every second one covers half of it."""
    rows = np.array([[(0.0, y), (10.0, y)] for y in np.arange(20) * LINE])
    full = Sliced(layers={**BELOW, 0.3: {"Solid infill": rows}}, volumes={})
    half = Sliced(layers={**BELOW, 0.3: {"Solid infill": rows[::2]}}, volumes={})
    assert uncovered(full, full) == 0
    assert uncovered(full, half) == pytest.approx(0.5, abs=0.15)  # lines count as 0.1 mm wider than they are
    twice = Sliced(layers={**BELOW, 0.3: {"Solid infill": rows, "Internal infill": rows}}, volumes={})
    assert doubled(full) == 0
    assert doubled(twice) == pytest.approx(1)
