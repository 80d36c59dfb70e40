"""The report of `infill verify`."""

from __future__ import annotations

from typing import Annotated, TypedDict

from infill.reports.common import ReportForm


class VerifyKeys(TypedDict):
    """Requested comparison."""

    changed: Annotated[list[str], "Features whose paths may differ, by the word that stands for all slicers"]
    allow: Annotated[list[str], "Kinds of violations that are counted and not reported"]
    material_limit: Annotated[float, "Share by which the filament of an object in a layer may change"]
    speed_limit: Annotated[float, "Share by which a bead may be printed faster"]


class ViolationKeys(TypedDict):
    """Violations in the order of the lines, at most 1000."""

    kind: Annotated[str, "Kind: see [verify](verify.md#kinds)"]
    line: Annotated[int, "Line of the new print where it begins, from 1"]
    layer: Annotated[int, "Layer by the tags of the slicer, from 1; 0 before the first, or without tags"]
    z: Annotated[float | None, "Height of the nozzle, mm; null before it is stated"]
    text: Annotated[str, "New value, and the old one"]
    lines: Annotated[int, "Number of lines with this fault"]
    last_line: Annotated[int, "Last of these lines"]
    old_line: Annotated[int, "Line of the old print that it is compared with; 0 without one"]


class ComparedKeys(TypedDict):
    """What was compared, bead by bead."""

    beads_mm: Annotated[float, "Length of the beads of the old print that were compared, mm"]
    agreeing_mm: Annotated[float, "Length of those that the new print has in the same place, mm"]
    free_mm: Annotated[float, "Length of the beads of the new print whose paths may differ, mm"]
    not_compared: Annotated[list[str], "What could not be compared, one phrase each; empty if everything was"]


class VerifiedFeatureKeys(TypedDict):
    """Time and filament by feature, as [`infill motion`](motion.md) plans them."""

    role: Annotated[str, "Role, the same for all slicers: `sparse infill`, `external perimeter`, … or `other`"]
    seconds_before: Annotated[float, "Time in the old print, s"]
    seconds_after: Annotated[float, "Time in the new print, s"]
    filament_before_mm: Annotated[float, "Filament in the old print, mm"]
    filament_after_mm: Annotated[float, "Filament in the new print, mm"]


class VerifiedPrintKeys(TypedDict):
    """A print that was read."""

    slicer: Annotated[str, "Name and version of the slicer; empty if unknown"]
    lines: Annotated[int, "Number of lines"]
    layers: Annotated[int, "Number of layers by the tags of the slicer"]
    seconds: Annotated[float, "Time, s"]
    filament_mm: Annotated[float, "Filament, mm"]
    plate: Annotated[int | None, "Plate of an archive; null for other files"]


class VerifyReport(ReportForm):
    """The report of `infill.verify`."""

    agrees: Annotated[bool, "Whether there is no violation but allowed ones"]
    count: Annotated[int, "Number of violations"]
    by_kind: Annotated[dict[str, int], "Number of violations of each kind that occurs"]
    allowed: Annotated[dict[str, int], "Number of violations of each kind that was allowed and occurs"]
    violations: list[ViolationKeys]
    request: VerifyKeys
    compared: ComparedKeys
    old: Annotated[VerifiedPrintKeys, "Print before"]
    new: Annotated[VerifiedPrintKeys, "Print after"]
    features: list[VerifiedFeatureKeys]
