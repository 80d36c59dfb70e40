"""Rules of a refill: the rounding of corners, and the strokes that may change."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from infill.arrays import Flags
from infill.gcode.path_moves import ARC_DEVIATION
from infill.gcode.strokes import CHORD_SAGITTA
from infill.gcode.survey import Survey
from infill.paths.contact import MOST_POINTS, STEP
from infill.paths.corners import COARSEST, UNIT
from infill.paths.rounding import Rounding
from infill.refilling.layers import Layers
from infill.refilling.request import AUTO, ON, SAME, Request

ACCELERATION = 1000.0  # mm/s², where neither the print nor its settings give it
CORNER = 9.0  # mm/s × rad: of a square corner velocity of 5 mm/s
LEAST_CORNER = 1.0  # mm/s × rad: less would cut an arc into crumbs
SHORT_LAYER = 15.0  # s: shorter layers may have been slowed down to cool, whatever the settings of the file
SLOWED_SHARE = 0.97  # of the usual speed of infill: a slower layer was slowed down to cool
LEAST_LEFT = 0.9  # of the length of a layer's infill after rounding, at least
TARGET_LAYERS = 16  # layers measured of a print, about; more of small layers, so that points are about as many
MOST_LAYERS = 128
LEGACY_FLAVOUR = "marlin"  # as slicers write it: "Marlin (legacy)"; "marlin2" is another
LEGACY_SEGMENTS = 200.0  # per second: what Marlin's own configuration gives a delta printer on an 8-bit board
GRADED_ARC_DEVIATION = 0.004  # mm: with a gradient, lines stay 0.95 widths apart; of 0.0125 mm, 0.90 would be left
LARGE = MOST_POINTS * STEP  # mm of infill in a layer: larger layers are sampled


@dataclass(frozen=True, kw_only=True)
class RefillRules:
    """Rules for every batch of a refill.

    Parameters
    ----------
    request : Request
    rounding : Rounding
    acceleration : float, mm/s²
        Where the print commands none.
    usual_speed : float, mm/min
        Of the infill in most layers; 0 if unknown.
    least_layer : float, s
        A layer that would take less is left as it is.
    resets_filament : bool
        True if the print sets its counter of filament by G92, so that new lines may.
    stride : int
        Sampling stride, in layers.
    arc_deviation : float, mm
        Largest distance of written arcs from the segments for which they stand; 0 if none are written.
    """

    request: Request
    rounding: Rounding
    acceleration: float = ACCELERATION
    usual_speed: float = 0.0
    least_layer: float = 0.0
    resets_filament: bool = True
    stride: int = 1
    arc_deviation: float = 0.0

    def rounded_by(self, deviation: float) -> RefillRules:
        """Return the rules with another largest deviation, mm."""
        return replace(self, rounding=replace(self.rounding, deviation=deviation))

    def with_radius(self, radius: float) -> RefillRules:
        """Return the rules with another largest radius of corners, mm."""
        return replace(self, rounding=replace(self.rounding, radius=radius))


def derive_rules(request: Request, print_survey: Survey, samples: Sequence[Layers]) -> RefillRules:
    """Derive the rules for a print from its header and some of its layers."""
    uses_jerk = print_survey.number("machine_max_junction_deviation") is None
    jerk = print_survey.number("machine_max_jerk_x", limit="jerk") if uses_jerk else None
    feeds = [layers.feed for layers in samples]
    lengths = [layer.length for layers in samples for layer in layers]
    cooled = print_survey.settings.get("cooling", "1") != "0"
    least_seconds = print_survey.number("slowdown_below_layer_time", "slow_down_layer_time") if cooled else 0.0
    as_arcs = request.arcs == ON or (request.arcs == AUTO and print_survey.has_arcs)
    settings = "infill_acceleration", "sparse_infill_acceleration", "default_acceleration"
    return RefillRules(
        request=request,
        rounding=Rounding(
            deviation=request.deviation,
            most=request.deviation,
            radius=request.radius,
            corner=max(jerk or CORNER, LEAST_CORNER),
            same_filament=request.density == SAME,
            segments_per_second=math.inf if as_arcs else segment_limit(request, print_survey),
            coarsest=CHORD_SAGITTA if as_arcs else COARSEST,
        ),
        acceleration=print_survey.number(*settings, limit="acceleration") or ACCELERATION,
        usual_speed=float(np.median(np.concatenate(feeds))) if feeds else 0.0,
        least_layer=least_seconds or 0.0,
        resets_filament=print_survey.resets_filament,
        stride=sampling_stride(print_survey.layers, float(np.median(lengths)) if lengths else 0.0),
        arc_deviation=0.0 if not as_arcs else ARC_DEVIATION if request.gradient is None else GRADED_ARC_DEVIATION,
    )


def segment_limit(request: Request, print_survey: Survey) -> float:
    """Return the segments per second that the controller of a print can take; infinite without a limit.

    Bambu Lab's printers name the legacy flavour too, and have fast controllers.
    """
    if isinstance(request.max_segments, float | int):
        return float(request.max_segments)
    settings = print_survey.settings
    flavour, names = settings.get("gcode_flavor", ""), (print_survey.slicer, settings.get("printer_model", ""))
    is_legacy = flavour.strip().lower() == LEGACY_FLAVOUR and not any("bambu" in name.lower() for name in names)
    return LEGACY_SEGMENTS if is_legacy and request.max_segments == AUTO else math.inf


def sampling_stride(layers: float, length: float) -> int:
    """Return the sampling stride, in layers, of a print.

    Parameters
    ----------
    layers : float
        Number of layers.
    length : float
        mm of infill in a typical layer.

    >>> sampling_stride(320, 5000.0), sampling_stride(320, 500.0), sampling_stride(320, 0.0)
    (20, 5, 2)
    """
    number = min(TARGET_LAYERS * max(1.0, LARGE / max(length, 1e-9)), MOST_LAYERS)
    return max(1, round(layers / number))


def unchangeable_strokes(layers: Layers, rules: RefillRules) -> dict[str, Flags]:
    """Find the strokes that must stay as they are, by reason, (M,) each."""
    infill, layer, table = layers.infill, layers.layer, layers.table
    reasons: dict[str, Flags] = {}
    if rules.request.layers is not None:
        low, high = rules.request.layers
        reasons["not among the layers asked for"] = (layer < low) | (layer > high)
    if rules.request.part is not None:
        object_numbers = [number for number, name in layers.marks.names.items() if rules.request.part in name]
        reasons["another object"] = ~np.isin(layers.section, object_numbers)
    # Layers that were slowed down, or are already as short as cooling allows.
    slow = np.zeros(len(layer), dtype=bool)
    if rules.least_layer:
        short = layers.seconds * LEAST_LEFT < rules.least_layer
        slow = (layers.feed < SLOWED_SHARE * rules.usual_speed) | short[layer - layers.marks.layer[0]]
    reasons["slowed down to cool"] = slow
    ends = np.stack([infill.points[infill.first[:-1]], infill.points[infill.first[1:] - 1]])
    reasons["cut off by the end of the file"] = (infill.closes == len(table) - 1) & (not table.data.endswith(b"\n"))
    reasons["finer numbers than a micrometre"] = np.abs(ends / UNIT - np.rint(ends / UNIT)).max(axis=(0, 2)) > 1e-4
    if not rules.resets_filament and rules.request.density != SAME:
        reasons["a counter of filament that is never set"] = ~table.relative_e[infill.opens]
    return reasons


def may_be_slowed(layers: Layers, rules: RefillRules) -> Flags:
    """Find the layers, from the first on, that may be as short as cooling allows."""
    is_short: Flags = layers.seconds < max(SHORT_LAYER, rules.least_layer)
    return is_short
