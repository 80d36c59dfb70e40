"""How near new infill lies to walls, judged by Shapely on the G-code of sliced prints without roofs and floors."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
import shapely
import trimesh

from infill import refill
from tests.gap_judge import read_layers, samples
from tests.prints import cura_print, prusa_print
from tests.slicers import missing_cura, missing_prusa

WIDTH = 0.45  # mm
# Line widths between centre lines. Nearer, a line along a wall pushes it outwards; farther, they hardly hold together.
NEAREST, FARTHEST = 0.8, 0.95
BESIDE = 1.2  # widths: nearer, a line lies beside a wall
STEP = 0.1  # mm between points that are judged
CONTOUR = (
    0.045  # widths, 0.02 mm: an outline cuts across the bends of a wall, whose chords are not those of the next layer
)
PLATE = shapely.box(0, 0, 36, 26).difference(
    shapely.union_all([shapely.Point(10, 13).buffer(5, 32), shapely.box(22, 8, 30, 14)])
)
# CuraEngine joins no lines of infill, and these two of PrusaSlicer neither: they end inside the walls.
OPEN: Mapping[str, Mapping[str, object]] = {
    "cura gyroid": {"infill_pattern": "gyroid"},
    "cura grid": {"infill_pattern": "grid", "infill_line_distance": 6.0},
    "prusa rectilinear": {"fill_pattern": "rectilinear", "infill_anchor": 0, "infill_anchor_max": 0},
}
JOINED: Mapping[str, Mapping[str, object]] = {
    "prusa honeycomb": {"fill_pattern": "honeycomb"},
    "prusa grid, overlapping by a quarter": {"fill_pattern": "grid", "infill_overlap": "25%"},
    "cura grid": {"infill_pattern": "grid", "infill_line_distance": 6.0, "zig_zaggify_infill": "true"},
}
PATTERNS = ("gyroid", "honeycomb", "grid")


def sliced(name: str, settings: Mapping[str, object], folder: Path) -> Path:
    part, path = folder / "plate.stl", folder / "print.gcode"
    trimesh.creation.extrude_polygon(PLATE, 1.0).export(part)
    missing = missing_cura() if name.startswith("cura") else missing_prusa()
    if missing:
        pytest.skip(missing)
    if name.startswith("cura"):
        return cura_print(part, path, {"top_layers": 0, "bottom_layers": 0, "initial_bottom_layers": 0, **settings})
    return prusa_print(part, path, {"top_solid_layers": 0, "bottom_solid_layers": 0, **settings})


def widths_from_walls(text: str) -> np.ndarray:
    """Return the distances of points on infill from the walls of their layer, in line widths, where they lie beside."""
    found = []
    for layer in read_layers(text):
        walls = shapely.union_all(shapely.linestrings(layer.others.reshape(-1, 2, 2)))
        shapely.prepare(walls)
        found.append(shapely.distance(shapely.points(samples(layer.infill, STEP)[0]), walls) / WIDTH)
    apart = np.concatenate(found)
    return apart[apart < BESIDE]


@pytest.mark.long
@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("name", OPEN)
def test_where_lines_end_in_walls_new_ones_lie_beside_them(name: str, pattern: str, tmp_path: Path) -> None:
    path, new = sliced(name, OPEN[name], tmp_path), tmp_path / "new.gcode"
    assert widths_from_walls(path.read_text()).min() < NEAREST - CONTOUR  # else, this test could not fail
    refill(path, output=new, pattern=pattern)
    apart = widths_from_walls(new.read_text())
    assert apart.min() > NEAREST
    assert NEAREST < np.median(apart) < FARTHEST


@pytest.mark.long
@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("name", JOINED)
def test_new_lines_lie_as_far_from_walls_as_those_along_them_did(name: str, pattern: str, tmp_path: Path) -> None:
    path, new = sliced(name, JOINED[name], tmp_path), tmp_path / "new.gcode"
    old = widths_from_walls(path.read_text())
    refill(path, output=new, pattern=pattern)
    apart = widths_from_walls(new.read_text())
    assert apart.min() > old.min() - CONTOUR
    # Of curves that come to a wall and leave it, most of what lies beside it is farther away.
    assert abs(np.quantile(apart, 0.2) - np.median(old)) < CONTOUR / 2
