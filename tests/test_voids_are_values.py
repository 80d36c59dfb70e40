"""A request is a value: what it was used for before does not matter."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh
from made_shapes import box

from infill.interior.interior import compute_interior
from infill.lattices.bodies import Fields
from infill.lattices.job import fill_request
from infill.lattices.request import FillSpec
from infill.lattices.settings import resolve
from infill.lattices.task import FillTask
from infill.lattices.voids import Layout
from infill.meshes.merging import surface_of

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

BALL = trimesh.creation.icosphere(3, 1.0)
BALL.apply_scale(np.array([16, 14, 12]) / np.ptp(BALL.bounds, axis=0))
PARTS = [surface_of(part) for part in (box(16, 14, 12).apply_translation(-box(16, 14, 12).bounds.mean(axis=0)), BALL)]


def asked(**options: Any) -> FillSpec:
    return resolve({"density": "20%:40%", "voxel": 0.6, "wall": 1.0, **options}).request


@pytest.mark.longest
@pytest.mark.parametrize("options", [{"by": "skin"}, {"by": "z", "pattern": "grid", "align": "body"}])
def test_a_grading_for_two_parts_gives_what_fresh_ones_give(options: dict[str, Any]) -> None:
    """In boxes of one size, so that both have the same grid."""
    request = asked(**options)
    for part in PARTS:
        used, fresh = (fill_request(part, each) for each in (request, asked(**options)))
        np.testing.assert_array_equal(used.surface.vertices, fresh.surface.vertices)
        assert used.report["graded"] == fresh.report["graded"]


@pytest.mark.longest
@pytest.mark.parametrize("align", ["part", "body"])
@pytest.mark.parametrize("pattern", ["gyroid", "honeycomb", "cross-3d", "adaptive-cubic", "lightning"])
def test_voids_drawn_again_are_the_same(pattern: str, align: str) -> None:
    """After a drawing of another size, and after one in another space; the earlier drawing stays as it is."""
    request = (
        asked(density=0.3, pattern=pattern, align=align)
        if pattern == "lightning"
        else asked(pattern=pattern, align=align)
    )
    spaces = [compute_interior(part, wall=1.0, voxel=0.6) for part in PARTS]
    task = FillTask.of(PARTS[0], request, threads=1)
    local = request.grading and request.grading.widths_in(spaces[0], task.pattern.widths)
    fresh, wider, elsewhere = (
        Layout(space=space, cell=5.0, width=width, local=local, threads=1)
        for space, width in ((spaces[0], 0.8), (spaces[0], 0.9), (spaces[1], 0.8))
    )
    fields = task.draw(fresh)
    before = written(fields)
    for known in (task.draw(wider, fields), task.draw(elsewhere, fields)):
        again = task.draw(fresh, known)
        assert again.find_sharpest() == fields.find_sharpest()
        for first, kept, second in zip(before, written(fields), written(again), strict=True):
            assert first[0] == kept[0] == second[0]
            np.testing.assert_array_equal(first[1], kept[1])
            np.testing.assert_array_equal(first[1], second[1])


def written(fields: Fields) -> list[tuple[float, np.ndarray]]:
    """Return the number of cells that each field fills, and the field."""
    depth = fields.layout.space.depth
    outs = [np.empty_like(depth) for _ in range(fields.count)]
    return [(fields.write_sdf(out, which, depth), out) for which, out in enumerate(outs)]
