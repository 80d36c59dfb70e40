"""Uploaded prints: their layers, features and time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.studio.numbers import Number, motion_numbers
from infill.studio.print_layers import plan_print

if TYPE_CHECKING:
    from infill.planner.layer_speeds import PlannedLayers


@dataclass(frozen=True, kw_only=True, eq=False)
class ReadPrint:
    """A print: its report and its planned moves.

    Parameters
    ----------
    report : dict
        Of `infill.motion`.
    planned : PlannedLayers
    """

    report: dict[str, Any]
    planned: PlannedLayers

    @property
    def layers(self) -> int:
        """Number of layers."""
        return self.planned.count

    @property
    def numbers(self) -> tuple[Number, ...]:
        """Numbers to show beside it."""
        return tuple(motion_numbers(self.report))

    def facts(self) -> dict[str, Any]:
        """Return its layers, features and times as plain values."""
        heights = self.planned.heights()
        steps = np.diff(heights, prepend=0.0)
        layers = [
            {"z": _round_off(z), "height": _round_off(step)}
            for z, step in zip(heights.tolist(), steps.tolist(), strict=True)
        ]
        return {
            "print": {
                "slicer": self.report["slicer"],
                "layers": layers,
                "features": describe_features(self.report),
                "time_s": self.report["seconds"],
                "filament_mm": self.report["filament"],
                "layer_seconds": self.report["by_layer"]["seconds"],
                "plates": list(self.report["plates"]),
            }
        }


def describe_features(report: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return name, role, time and filament of the features of a print, from the report of `infill.motion`."""
    return [
        {key: feature[key] for key in ("name", "role", "seconds", "filament", "length")}
        for feature in report["features"]
    ]


def _round_off(length: float) -> float | None:
    """Round a length to a tenth of a micrometre; None for none."""
    return round(length, 4) if math.isfinite(length) else None


def read_print(name: str) -> ReadPrint:
    """Plan an uploaded print."""
    from infill.timing.printing_time import motion

    return ReadPrint(report=dict(motion(name).to_dict()), planned=plan_print(name))
