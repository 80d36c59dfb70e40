"""Ends of paths that come too near to other lines are shortened; areas that nearly touch are moved apart."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from gradient_judge import crossing_paths, read_sparse
from handmade_prints import PER_MM, Dialect, written
from hypothesis import given, settings
from hypothesis import strategies as st
from lines import least_spacing
from shapely import affinity

from infill import refill
from infill.paths.covering import cover
from infill.paths.families.catalogue import FAMILIES
from infill.paths.trimming import trim_ends
from infill.refilling.regions import FreeAreas

WIDTH = 0.45
SPACING = 0.4


def line(*points: tuple[float, float]) -> np.ndarray:
    return np.array(points, dtype=float)


def test_an_end_in_front_of_another_is_shortened() -> None:
    """By as much as is missing, once, from the first of the two."""
    one, other = line((0, 0), (5, 0)), line((5.1, 0), (9, 0))
    first, second = trim_ends([one, other], [(True, True), (True, True)], SPACING, WIDTH)
    np.testing.assert_allclose(first[-1], (4.7, 0), atol=WIDTH / 16)
    np.testing.assert_array_equal(first[0], (0, 0))
    np.testing.assert_array_equal(second, other)
    assert 5.1 - first[-1][0] >= SPACING


def test_an_end_beside_its_own_path_is_shortened() -> None:
    hook = line((0, 0), (5, 0), (5, 2), (1, 2), (1, 0.1))
    (cut,) = trim_ends([hook], [(True, True)], SPACING, WIDTH)
    np.testing.assert_allclose(cut[-1], (1, SPACING), atol=WIDTH / 16)
    assert len(cut) == 5


@pytest.mark.parametrize("free", [(False, False), (True, True)])
def test_what_is_bound_or_would_not_gain_stays(free: tuple[bool, bool]) -> None:
    """Lines that are near all along, and ends that are not free; the paths themselves never change."""
    beside = [line((0, 0), (9, 0)), line((0, 0.2), (9, 0.2))]
    facing = [line((0, 0), (5, 0)), line((5.1, 0), (9, 0))]
    for paths in (beside, facing) if not any(free) else (beside,):
        kept = trim_ends(paths, [free, free], SPACING, WIDTH)
        assert all(one is other for one, other in zip(kept, paths, strict=True))


@given(st.integers(0, 10_000))
@settings(max_examples=40, deadline=None)
def test_lines_in_narrow_regions_keep_their_distance(seed: int) -> None:
    """In rings between two circles that are not concentric, whose narrow place is narrower than a cell."""
    random = np.random.default_rng(seed)
    inner = shapely.Point(random.uniform(-2, 2), random.uniform(-2, 2)).buffer(random.uniform(4, 7))
    ring = affinity.rotate(shapely.Point(0, 0).buffer(10, quad_segs=4).difference(inner), random.uniform(0, 90))
    paths = cover(ring, FAMILIES["honeycomb"], cell=random.uniform(3, 6), line_width=WIDTH, z=0.2, layer=0)
    family = FAMILIES["honeycomb"]
    assert least_spacing(paths, near=4 * WIDTH, most=0.6) > (family.least_spacing - 0.02) * WIDTH


def test_areas_that_nearly_touch_are_cut_apart() -> None:
    large, small = shapely.box(0, 0, 20, 20), shapely.box(20.02, 5, 24, 9)
    far = shapely.box(30, 0, 34, 4)
    region = FreeAreas(polygons=(small, large, far), distance=0.4, skin_distance=0.4)
    apart = region.keep_apart(SPACING)
    assert apart.polygons[0] is large
    assert any(one is far for one in apart.polygons)
    parts = apart.polygons
    assert min(a.distance(b) for i, a in enumerate(parts) for b in parts[:i]) > SPACING - 1e-9
    assert sum(part.area for part in parts) > large.area + far.area + 0.85 * small.area
    assert region.polygons == (small, large, far)
    assert apart.keep_apart(SPACING - 0.01) is apart


def test_areas_keep_off_lines_that_stay() -> None:
    area, own = shapely.box(0, 0, 20, 20), shapely.box(30, 0, 40, 10)
    region = FreeAreas(polygons=(area, own), distance=0.4, skin_distance=0.4)
    across, inside = line((-5, 10), (25, 10)), line((32, 5), (38, 5))
    cut = region.keep_off([across, inside], SPACING, own=[1])
    assert len(cut.polygons) == 3
    assert cut.polygons[-1] is own
    assert min(shapely.distance(shapely.linestrings(across), part) for part in cut.polygons[:2]) > SPACING - 1e-9
    assert region.keep_off([line((25, 0), (25, 9))], SPACING) is region


@pytest.mark.slow
@pytest.mark.parametrize("graded", [{}, {"density": (0.35, 0.15), "by": "x"}])
@pytest.mark.parametrize("x", [128.0, 114.0])
def test_new_lines_keep_off_a_section_that_stays(tmp_path: Path, graded: dict[str, Any], x: float) -> None:
    """A line that runs out of the region through the walls, or next to nothing in an area of another section."""
    text = written(Dialect(size=30.0, cell=4.0, layers=7))
    tag = b";TYPE:Internal infill\n"
    begin = [found.start() for found in re.finditer(tag, text)][2]
    end = text.index(b";LAYER_CHANGE", begin)
    stray = (
        b";TYPE:Custom\n" + tag + b"G1 X%g Y114.9 F7800\nG1 F1800\nG1 X%g Y115.1 E%.5f\n" % (x, x + 2.2, 2.21 * PER_MM)
    )
    sliced, output = tmp_path / "old.gcode", tmp_path / "new.gcode"
    sliced.write_bytes(text[:end] + stray + text[end:])
    report = refill(sliced, output=output, pattern="honeycomb", **graded).report
    assert report["sections"]["kept"] == {"no room found between walls": 1}
    assert report["sections"]["replaced"] == report["sections"]["all"] - 1
    layers = read_sparse(output.read_text())
    assert sum(map(crossing_paths, layers)) == 0
    assert min(least_spacing(layer.paths, near=4 * WIDTH, most=0.6) for layer in layers) > 0.84 * WIDTH


def test_areas_that_are_apart_stay_as_they_are() -> None:
    region = FreeAreas(polygons=(shapely.box(0, 0, 1, 1), shapely.box(5, 0, 9, 4)), distance=0.4, skin_distance=0.4)
    assert region.keep_apart(SPACING) is region
