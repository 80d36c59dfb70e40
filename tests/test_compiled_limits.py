"""Compiled limits of moves, and speeds between them, beside those of NumPy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from infill.gcode.limits import Limits, Model
from infill.planner import junctions
from infill.planner.bounds import Moves, bound_compiled_moves, bound_plain_moves
from infill.planner.junctions import joint_limits

LIMITS = [
    Limits(jerk=(8.0, 8.0, 0.4, 4.5), acceleration=900.0, travel_acceleration=1200.0),
    Limits(jerk=(0.0, 8.0, 0.0, 4.5), feedrate=(50.0, 300.0, 5.0, 25.0), minimum_travel_feedrate=30.0),
    Limits(jerk=(10.0, 12.0, np.inf, 1.0), axis_acceleration=(500.0, np.inf, 100.0, np.inf), minimum_feedrate=2.0),
]


def random_moves(count: int, settings: int) -> Moves:
    """Return moves of which some turn back, some go along few axes, some only push filament, or have no feed rate."""
    random = np.random.default_rng(count)
    delta = random.normal(size=(count, 4)) * random.choice([0.0, 0.01, 1.0], (count, 4))
    delta[1::7] = -delta[::7][: len(delta[1::7])]
    delta[~delta.any(axis=1), 0] = 1.0
    return Moves(
        delta=delta,
        feedrate=random.choice([0.0, 0.5, 20.0, 80.0, np.nan], count),
        setting=random.integers(0, settings, count),
        stop=random.random(count) < 0.02,
    )


@pytest.mark.parametrize("model", ["jerk", "klipper"])
@pytest.mark.parametrize("settings", [1, 3])
@pytest.mark.parametrize("count", [1, 2, 5000])
def test_compiled_limits_are_those_of_numpy(
    monkeypatch: pytest.MonkeyPatch, count: int, settings: int, model: Model
) -> None:
    moves, limits = random_moves(count, settings), [replace(setting, model=model) for setting in LIMITS[:settings]]
    plain, compiled = bound_plain_moves(moves, limits), bound_compiled_moves(moves, limits)
    for name, values in vars(plain).items():
        np.testing.assert_array_equal(getattr(compiled, name), values, err_msg=name)
    joints = {}
    for is_loaded in (False, True):
        monkeypatch.setattr(junctions, "is_compiler_loaded", lambda is_loaded=is_loaded: is_loaded)
        joints[is_loaded] = joint_limits(moves, plain, limits)
    assert count < 9 or len(np.unique(joints[False])) > 99
    np.testing.assert_array_equal(joints[True], joints[False])
