"""What every filled part keeps: its skin, its density and its walls, measured on the mesh; test_fill.py has what it finds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh

from infill import Result, Surface
from infill.lattices.quality_checks import measure_least_wall
from infill.meshes.distance import TriangleTree
from infill.meshes.solids import FINE, manifold_status
from infill.meshes.winding import winding_numbers


def assert_filled(
    result: Result[Any, Any], part: trimesh.Trimesh, *, wall: float, density: float | None, points: int = 24000
) -> None:
    """Check the promises of `fill` on the mesh of a closed part without drains; a density of None is not checked."""
    solid, voids, report = result.surface, result.stages.voids, result.report
    skin = Surface(vertices=np.asarray(part.vertices), faces=np.asarray(part.faces))
    assert report["problems"] == []
    # The skin, bit for bit.
    assert (solid.vertices[: len(part.vertices)] == part.vertices).all()
    assert (solid.faces[: len(part.faces)] == part.faces).all()
    assert len(solid.faces) == len(part.faces) + len(voids.faces)
    # A solid, with the density asked for.
    assert solid.closed
    assert manifold_status(solid) == FINE
    assert solid.volume == pytest.approx(part.volume - voids.volume)
    places = np.random.default_rng(1).uniform(*part.bounds, (points, 3))
    away = np.where(winding_numbers(places, skin) > 0, TriangleTree.of(skin).nearest(places)[0], 0.0)
    if density is not None:
        assert report["density"] == pytest.approx(density, abs=0.005)
        # Again, by points: those at least a wall below the skin that lie in no void.
        deep = places[away > wall]
        assert len(deep) > 3000
        # Three times what chance does.
        assert np.mean(winding_numbers(deep, voids) == 0) == pytest.approx(density, abs=0.025)
    # The wall, from both sides.
    assert measure_least_wall(skin, [voids], 2)[0] >= 0.9 * wall
    outer = trimesh.sample.sample_surface(part, 5000, seed=2)[0]
    assert TriangleTree.of(voids).nearest(outer)[0].min() >= 0.9 * wall
    assert not winding_numbers(places[(away > 0) & (away < 0.9 * wall)][:2000], voids).any()
