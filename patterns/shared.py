"""The parameters that most patterns share, each declared once: cell, angle, phase, frame.

    @dataclass(frozen=True, kw_only=True)
    class Yours(Pattern):
        cell: float = cell_parameter()
        angle: float = angle_parameter()
        phase: tuple[float, float] = phase_parameter()
        frame: bool = frame_parameter(default=True)

They are flags on the command line. A pattern declares those that make sense for it.
"""

from __future__ import annotations

from typing import Any

from patterns.declared import DefaultLength, parameter

SHARED = ("cell", "angle", "phase", "frame")


def cell_parameter(default: float = 6.0) -> Any:  # noqa: ANN401 - a field of type float
    """Return the field for the distance between neighbouring lines, mm."""
    return parameter(DefaultLength(default), "distance between neighbouring lines", low=0.001, high=1e4)


def angle_parameter(default: float = 0.0) -> Any:  # noqa: ANN401 - a field of type float
    """Return the field for the angle by which a pattern is turned, degrees."""
    return parameter(default, "turns the pattern counter-clockwise", unit="deg", low=-180.0, high=180.0)


def phase_parameter(default: tuple[float, float] = (0.0, 0.0)) -> Any:  # noqa: ANN401 - a field of (float, float)
    """Return the field for the shift (x, y) of a pattern, mm."""
    return parameter(default, "shifts the pattern in x and y", low=-1e4, high=1e4)


def seed_parameter() -> Any:  # noqa: ANN401 - a field of type int
    """Return the field for the seed of a random pattern."""
    return parameter(0, "which of all such patterns", unit="", low=0, high=2**31 - 1, whole=True)


def levels_parameter() -> Any:  # noqa: ANN401 - a field of type int
    """Return the field for the levels of an octree."""
    return parameter(2, "how often cubes are doubled where they may be larger", unit="", low=1, high=4, whole=True)


def overhang_parameter() -> Any:  # noqa: ANN401 - a field of type float
    """Return the field for the overhang of branches."""
    return parameter(45.0, "how far walls lean out, from upright", unit="deg", low=10.0, high=60.0)


def frame_parameter(*, default: bool = True) -> Any:  # noqa: ANN401 - a field of type bool
    """Return the field for the frame: whether the outline of the region is a wall too."""
    return parameter(default, "a wall around the block", unit="")
