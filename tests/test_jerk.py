"""Compiled speeds between moves beside those of NumPy."""

from __future__ import annotations

import numpy as np
import pytest

from infill.gcode.limits import Limits
from infill.planner import junctions
from infill.planner.bounds import Moves, bound_moves
from infill.planner.junctions import joint_limits

JERKS = [(8.0, 8.0, 0.4, 4.5), (0.0, 8.0, 0.0, 4.5), (10.0, 12.0, np.inf, 1.0)]


@pytest.mark.parametrize("settings", [1, 3])
@pytest.mark.parametrize("count", [1, 2, 5000])
def test_compiled_jerk_is_that_of_numpy(monkeypatch: pytest.MonkeyPatch, count: int, settings: int) -> None:
    """Also where a move turns back, where nothing moves along an axis, and where an axis allows no jump."""
    random = np.random.default_rng(count)
    delta = random.normal(size=(count, 4)) * random.choice([0.0, 0.01, 1.0], (count, 4))
    delta[1::7] = -delta[::7][: len(delta[1::7])]
    delta[~delta.any(axis=1), 0] = 1.0
    moves = Moves(
        delta=delta,
        feedrate=random.choice([0.5, 20.0, 80.0], count),
        setting=random.integers(0, settings, count),
        stop=random.random(count) < 0.02,
    )
    limits = [Limits(model="jerk", jerk=jerk) for jerk in JERKS[:settings]]
    bounds, joints = bound_moves(moves, limits), {}
    for compiled in (False, True):
        monkeypatch.setattr(junctions, "is_compiler_loaded", lambda compiled=compiled: compiled)
        joints[compiled] = joint_limits(moves, bounds, limits)
    assert count < 9 or len(np.unique(joints[False])) > 99
    np.testing.assert_array_equal(joints[True], joints[False])
