"""A request is a value: what it was used for before does not matter."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from made_shapes import box

from infill.interior.interior import compute_interior
from infill.lattices.choosing import choose_voids
from infill.lattices.job import fill_request
from infill.lattices.request import FillSpec
from infill.lattices.settings import resolve
from infill.meshes.merging import surface_of

pytestmark = pytest.mark.usefixtures("compiled")

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


@pytest.mark.long
@pytest.mark.parametrize("align", ["part", "body"])
@pytest.mark.parametrize("pattern", ["gyroid", "honeycomb", "cross-3d", "adaptive-cubic", "lightning"])
def test_voids_that_are_prepared_are_the_same(pattern: str, align: str) -> None:
    """In a space and in another one, with even walls and with local widths; and preparing changes nothing."""
    request = (
        asked(density=0.3, pattern=pattern, align=align)
        if pattern == "lightning"
        else asked(pattern=pattern, align=align)
    )
    spaces = [compute_interior(part, wall=1.0, voxel=0.6) for part in PARTS]
    voids = choose_voids(request, PARTS[0].bounds, 1)
    if voids.grading is not None:
        voids = voids.with_widths(voids.grading.over(spaces[0], voids.widths))
    before, sizes = replace(voids), {"cell": 5.0, "width": 0.8}  # type: ignore[type-var]
    prepared = voids.prepare(spaces[0], **sizes)
    assert vars(voids).keys() >= vars(before).keys()
    assert all(vars(voids)[name] is value for name, value in vars(before).items())
    assert prepared.count(spaces[0], **sizes) == voids.count(spaces[0], **sizes)
    for which in range(voids.count(spaces[0], **sizes)):
        one, other = (np.empty_like(spaces[0].depth) for _ in range(2))
        assert voids.into(one, spaces[0], which, **sizes) == prepared.into(other, spaces[0], which, **sizes)
        np.testing.assert_array_equal(one, other)
    assert prepared.count(spaces[1], **sizes) == voids.count(spaces[1], **sizes)
