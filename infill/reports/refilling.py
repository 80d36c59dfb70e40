"""The report of `infill refill`."""

from __future__ import annotations

from typing import Annotated, Any, NotRequired, TypedDict

from infill.reports.common import ReportHead


class RefillRequest(TypedDict):
    """Requested refill."""

    pattern: Annotated[str, "`keep`, the name of a pattern, or the path of a drawing; with `auto`, the one taken"]
    parameters: Annotated[dict[str, Any], "Parameters of the pattern by name, angles in degrees"]
    density: Annotated[float | str | None, "Share of the volume, or `same`; null for the filament of the slicer"]
    densities: Annotated[
        Annotated[list[float], 2] | None,
        "Shares of the volume where `by` is lowest and highest; null for one density, or none",
    ]
    by: Annotated[str | None, "Field that the density follows, by its name; null for one density, or none"]
    smooth_radius_mm: Annotated[float | str, "Largest radius of a corner, mm, or `auto`"]
    max_deviation_mm: Annotated[float | None, "Largest distance by which a path may move, mm"]
    even: Annotated[str | None, "Whether layers are evened out, by `time` or `volume`; null if not"]
    leeway: Annotated[float | None, "Share by which the infill of a layer may change for that; null without"]
    arcs: Annotated[str, "Whether curves are written as arcs: `auto`, `on` or `off`"]
    max_segments: Annotated[float | str, "Segments per second, or `auto` or `none`"]
    layers: Annotated[Annotated[list[int], 2] | None, "First and last layer, counted from 1; null for all layers"]
    part: Annotated[str | None, "Text in the names of the objects to refill; null for all objects"]


class ChoiceKeys(TypedDict):
    """Choice among patterns with `--pattern auto`."""

    seconds: Annotated[dict[str, float], "Printing time with each pattern that was tried, s"]
    reason: Annotated[str, "Why the pattern in `request.pattern` was taken, in words"]


class PrintKeys(TypedDict):
    """Print that was read."""

    slicer: Annotated[str, "Name of the slicer, as it states it, or empty"]
    bytes: Annotated[int, "Size of the unpacked G-code, bytes"]
    plates: Annotated[list[int], "Numbers of the plates of an archive (`.gcode.3mf`), all of which count; else empty"]
    already_refilled: Annotated[bool, "Whether the print was refilled before, so that round corners were nothing to do"]
    refilled_before: Annotated[bool, "Whether infill refilled it before: values before are then those of that refill"]
    layers: NotRequired[Annotated[int, "Number of layers"]]
    unread_lines: NotRequired[
        Annotated[int, "Number of lines that may move or extrude and were not understood; times leave them out"]
    ]


class SectionKeys(TypedDict):
    """Sections of sparse infill: runs between two tags."""

    all: Annotated[int, "Number of sections"]
    replaced: Annotated[int, "Number of sections with new paths"]
    kept: Annotated[dict[str, int], "Number of unchanged sections by [reason](refill.md#when-the-slicers-paths-stay)"]


class RadiusKeys(TypedDict):
    """Radii of the rounded corners, to a fifteenth; null without corners."""

    smallest_hundredth: Annotated[float, "1st percentile, mm"]
    median: Annotated[float, "Median, mm"]
    largest_hundredth: Annotated[float, "99th percentile, mm"]


class RoundingKeys(TypedDict):
    """Rounding of corners."""

    deviation_mm: Annotated[float | None, "Largest move of a path at its corners, mm; null if only lines limit it"]
    corners: Annotated[int, "Number of rounded corners"]
    radius_mm: RadiusKeys | None
    segments_per_s: Annotated[float | None, "Segments per second that the controller can take; null without a limit"]


class FilamentKeys(TypedDict):
    """Filament of the sparse infill and of the print."""

    infill_before_mm: Annotated[float, "Infill as sliced, mm"]
    infill_after_mm: Annotated[float, "Infill as refilled, mm"]
    print_before_mm: Annotated[float, "Entire print as sliced, mm: as its comments state, or else as counted"]
    print_after_mm: Annotated[float, "Entire print as refilled, mm"]
    print_before_g: Annotated[float | None, "Entire print as sliced, g; null if it states neither grams nor a density"]
    print_after_g: Annotated[float | None, "Entire print as refilled, g"]
    print_ratio: Annotated[float, "Entire print, after over before"]
    density_for_the_same_percent: Annotated[
        float | None,
        "Density to set in the slicer for the old amount, %; null if the old one is unknown, or for another pattern",
    ]
    ratio_with_density_same: Annotated[
        float | None, "Infill with `--density same`, after over before; null for another pattern, or with a density"
    ]


class TimeKeys(TypedDict):
    """Times as [`infill motion`](motion.md) plans them, by the limits in the file."""

    slicer_s: Annotated[float | None, "Estimate of the slicer in the file, s; null without one"]
    print_before_s: Annotated[float, "Entire print as sliced, s"]
    print_after_s: Annotated[float, "Entire print as refilled, s: the new estimate in the file"]
    infill_before_s: Annotated[float, "Sparse infill as sliced, with the travel and retractions that lead to it, s"]
    infill_after_s: Annotated[float, "Sparse infill as refilled, s"]


class ContactKeys(TypedDict):
    """Support, contact and hold of the infill, measured on some layers."""

    measured_mm: Annotated[float, "Length of infill that was measured, mm; 0 without a measurement"]
    supported_before: Annotated[float, "Share of the length on the layer below, as sliced"]
    supported_after: Annotated[float, "Share of the length on the layer below, as refilled"]
    bonded_before: Annotated[float, "Share of the length that touches a neighbouring line, as sliced"]
    bonded_after: Annotated[float, "Share of the length that touches a neighbouring line, as refilled"]
    free_before: Annotated[float, "Share that touches no wall of its layer, nor lines that do, as sliced"]
    free_after: Annotated[float, "Share that touches no wall of its layer, nor lines that do, as refilled"]
    kept_supported: Annotated[float, "Supported share, after over before"]
    kept_bonded: Annotated[float, "Bonded share, after over before; 1 if hardly any infill was bonded"]


class EvenKeys(TypedDict):
    """Steps between neighbouring layers that both have new infill, with `--even` only."""

    unit: Annotated[str, "Unit of the steps and of their spread: `s`, or `mm` of filament"]
    steps: Annotated[int, "Number of steps"]
    spread_sliced: Annotated[float, "Standard deviation of the steps as sliced"]
    spread_before: Annotated[float, "Standard deviation of the steps with the new infill, not evened out"]
    spread_after: Annotated[float, "Standard deviation of the steps as written"]
    median_step_sliced: Annotated[float, "Median size of a step as sliced"]
    median_step_before: Annotated[float, "Median size of a step with the new infill, not evened out"]
    median_step_after: Annotated[float, "Median size of a step as written"]


class RefillReport(ReportHead):
    """The report of `infill.refill`; a print that was refilled before lacks the keys from `sections` on."""

    problems: Annotated[list[str], "Warnings before printing, one phrase each; empty without warnings"]
    request: RefillRequest
    choice: NotRequired[ChoiceKeys]
    print: PrintKeys
    sections: NotRequired[SectionKeys]
    rounding: NotRequired[RoundingKeys]
    filament: NotRequired[FilamentKeys]
    time: NotRequired[TimeKeys]
    contact: NotRequired[ContactKeys]
    even: NotRequired[EvenKeys]
