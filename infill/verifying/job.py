"""verify: compare a post-processed print with the print that it was made from, as a printer would print both.

Step 1. Read both prints: the way of the nozzle, and the settings of the machine at each line.
Step 2. Pair their moves by place. Beads without a partner are compared as paths.
Step 3. At every pair, compare the state of the machine; in features that were meant to change, its range.
Step 4. Check lines, commands and travels.
"""

from __future__ import annotations

import os
from collections import Counter
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, UsageError
from infill.gcode.ending import describe_missing_end
from infill.plain_numbers import count_noun, plain_share
from infill.reports.common import report_head
from infill.reports.verifying import VerifiedPrintKeys, VerifyReport
from infill.verifying.changed_features import check_changed_features
from infill.verifying.comparison import BeadComparison, compare_beads, is_changed
from infill.verifying.gap_faults import report_gaps
from infill.verifying.missing_beads import compare_layer_sums, report_missing
from infill.verifying.pair_faults import report_pairs
from infill.verifying.settings import VerifyRequest
from infill.verifying.text_faults import check_commands, check_lines
from infill.verifying.trace import Trace, read_trace
from infill.verifying.travels import check_travels
from infill.verifying.violations import Violation, ViolationList

OTHER_PRINT: Final = 0.1  # share of the beads: with fewer in their place, it is another print
MAX_LISTED: Final = 1000  # violations in a report


@dataclass(frozen=True, kw_only=True, repr=False)
class Verification:
    """Result of `verify`.

    Parameters
    ----------
    violations : tuple of Violation
        In the order of the lines; without those of kinds that are allowed.
    report : dict
        Plain numbers and strings: what ``--json`` prints. docs/report.md lists every key.
    """

    violations: tuple[Violation, ...]
    report: VerifyReport

    def __repr__(self) -> str:
        """Return the number of violations, and how much was compared."""
        compared = self.report["compared"]
        found = count_noun(len(self.violations), "violation") if self.violations else "no violation"
        partly = f", {count_noun(len(compared['not_compared']), 'thing')} not compared" * bool(compared["not_compared"])
        return f"Verification({found} in {compared['beads_mm'] / 1000:.2f} m of beads{partly})"

    @property
    def agrees(self) -> bool:
        """True if there is no violation."""
        return not self.violations


def verify(
    old: str | os.PathLike[str],
    new: str | os.PathLike[str],
    *,
    changed: tuple[str, ...] | str | None = None,
    allow: tuple[str, ...] | str = (),
    material_limit: float | str = 0.2,
    speed_limit: float | str = 0.05,
    plate: int | None = None,
) -> Verification:
    """Compare a post-processed print with the print that it was made from.

    Moves are compared by place and material, not by lines: other comments, line numbers, arcs in place of lines and
    another order of beads are not violations. docs/verify.md explains every kind.

    Parameters
    ----------
    old, new : path
        The print before and after: G-code as text, binary G-code, or an archive of plates (.gcode.3mf).
    changed : str or tuple of str, optional
        Features that the post-processor was meant to change, such as "sparse infill": their paths are free. By default
        the sparse infill if `new` has the stamp of a refill that `old` lacks, else none.
    allow : str or tuple of str
        Kinds of violations to count and not to report.
    material_limit : float
        Share by which the filament of an object in a layer may change through the changed features.
    speed_limit : float
        Share by which a bead may be printed faster.
    plate : int, optional
        Plate of an archive; by default the first that has G-code.

    Returns
    -------
    Verification

    Raises
    ------
    FormatError
        If a file is missing, not G-code, cut off, or if `new` is another print altogether.
    ParameterError
        If an option is out of range, or an archive does not have this plate.
    """
    request = VerifyRequest(
        changed=changed,  # type: ignore[arg-type]  # read by the declaration
        allow=allow,  # type: ignore[arg-type]
        material_limit=material_limit,  # type: ignore[arg-type]
        speed_limit=speed_limit,  # type: ignore[arg-type]
        plate=plate,
    )
    before = read_trace(Path(old), plate)
    if before.first_limits.missing_end:
        raise FormatError(f"{before.path}: {describe_missing_end(before.first_limits.missing_end)}")
    after = read_trace(Path(new), plate, before)
    features = _choose_features(request, before, after)
    comparison = compare_beads(before, after, features)
    _check_same_print(comparison)
    found = ViolationList(after)
    unread = check_lines(before, after, found)
    report_pairs(comparison, request.speed_limit, found)
    report_gaps(comparison, request.speed_limit, found)
    compare_layer_sums(comparison, found, report_missing(comparison, found))
    check_changed_features(before, after, features, request.speed_limit, found)
    _check_amounts(before, after, features, request.material_limit, found)
    check_travels(comparison, is_changed(after, features), found)
    check_commands(comparison, found)
    violations = found.sorted()
    kept = tuple(violation for violation in violations if violation.kind not in request.allow)
    return Verification(
        violations=kept,
        report=_report(request, features, comparison, (violations, kept), unread),
    )


def _choose_features(request: VerifyRequest, before: Trace, after: Trace) -> tuple[str, ...]:
    """Return the features whose paths may differ."""
    if request.changed is None:
        return ("sparse infill",) if after.stamp and after.stamp != before.stamp else ()
    for trace in (before, after) if request.changed else ():
        if {trace.roles[number] for number in np.unique(trace.rows.role).tolist()} <= {"untagged", "other"}:
            raise UsageError.about(
                "changed",
                f"is {', '.join(request.changed)}, but no comment of {trace.path} names a feature; leave it out",
            )
    return request.changed


def _check_same_print(comparison: BeadComparison) -> None:
    """Raise FormatError if the new print is another one, or was cut off."""
    before, after = comparison.old, comparison.new
    length, agreeing = comparison.lengths
    if length and agreeing < OTHER_PRINT * length:
        raise FormatError(
            f"{after.path} is another print than {before.path}: {plain_share(agreeing / length)} of its beads are in "
            "the same place; give the file that the post-processor read, and the one that it wrote"
        )
    beads = np.flatnonzero(comparison.a.draws)
    if after.first_limits.missing_end and len(beads) and not comparison.has_partner[beads[-1]]:
        layer = f"in layer {int(after.rows.layer[-1])} of {before.layers}" if before.layers else "early"
        raise FormatError(
            f"{after.path}: the file was cut off at line {after.lines}, {layer}: it ends without the line "
            f"{after.first_limits.missing_end!r} that {before.path} has; run the post-processor again"
        )


def _check_amounts(before: Trace, after: Trace, features: tuple[str, ...], limit: float, found: ViolationList) -> None:
    """Compare the filament of each object in each layer, where features may change."""
    if not features or before.layers != after.layers:
        return
    by_object = set(before.objects) == set(after.objects)
    free = [_sum_filament(trace, is_changed(trace, features), by_object=by_object) for trace in (before, after)]
    whole = _sum_filament(before, np.ones(len(before.rows), dtype=bool), by_object=by_object)
    for (layer, name), (was, _) in free[0].items():
        now, row = free[1].get((layer, name), (0.0, -1))
        total = whole[layer, name][0]
        if abs(now - was) <= limit * total:
            continue
        if row < 0:
            row = min(int(np.searchsorted(after.rows.layer, layer)), len(after.rows) - 1)
        of = f" of object {name!r}" if name else ""
        found.add_line(
            "material",
            int(after.rows.line[row]),
            f"{now:.1f} mm of filament for {', '.join(features)}{of} in the layer, was {was:.1f} mm: "
            f"{(now - was) / total:+z.1%} of all{of} in it",
        )


def _sum_filament(
    trace: Trace, chosen: NDArray[np.bool_], *, by_object: bool
) -> dict[tuple[int, str], tuple[float, int]]:
    """Sum up filament by layer and name of the object; return the sum and the first row of each."""
    rows = np.flatnonzero(chosen & trace.rows.draws)
    if not len(rows):
        return {}
    things = trace.rows.thing[rows] if by_object else np.zeros(len(rows), dtype=np.int64)
    keys, first, number = np.unique(
        np.column_stack([trace.rows.layer[rows], things]), axis=0, return_index=True, return_inverse=True
    )
    sums = np.bincount(number.ravel(), weights=trace.rows.filament[rows])
    return {
        (layer, trace.objects[thing] if by_object else ""): (amount, int(rows[place]))
        for (layer, thing), amount, place in zip(keys.tolist(), sums.tolist(), first.tolist(), strict=True)
    }


def _report(
    request: VerifyRequest,
    features: tuple[str, ...],
    comparison: BeadComparison,
    violations: tuple[tuple[Violation, ...], tuple[Violation, ...]],
    unread: int,
) -> VerifyReport:
    """Return the report of a comparison."""
    before, after = comparison.old, comparison.new
    head = report_head("verify")
    length, agreeing = comparison.lengths
    every, kept = violations
    free = is_changed(after, features) & after.rows.draws
    roles = list(dict.fromkeys([*before.features, *after.features]))
    nothing = (0.0, 0.0)
    return {
        "form": head["form"],
        "version": head["version"],
        "product": head["product"],
        "agrees": not kept,
        "count": len(kept),
        "by_kind": dict(Counter(violation.kind for violation in kept)),
        "allowed": dict(Counter(violation.kind for violation in every if violation.kind in request.allow)),
        "violations": [asdict(violation) for violation in kept[:MAX_LISTED]],  # type: ignore[misc]
        "request": {
            "changed": list(features),
            "allow": list(request.allow),
            "material_limit": request.material_limit,
            "speed_limit": request.speed_limit,
        },
        "compared": {
            "beads_mm": length,
            "agreeing_mm": agreeing,
            "free_mm": float(np.nan_to_num(after.rows.length[free]).sum()),
            "not_compared": _list_uncompared(features, comparison, unread),
        },
        "old": _print_keys(before),
        "new": _print_keys(after),
        "features": [
            {
                "role": role,
                "seconds_before": before.features.get(role, nothing)[0],
                "seconds_after": after.features.get(role, nothing)[0],
                "filament_before_mm": before.features.get(role, nothing)[1],
                "filament_after_mm": after.features.get(role, nothing)[1],
            }
            for role in roles
        ],
    }


def _print_keys(trace: Trace) -> VerifiedPrintKeys:
    """Return the facts about a print, as report keys."""
    return {
        "slicer": trace.first_limits.slicer,
        "lines": trace.lines,
        "layers": trace.layers,
        "seconds": sum(seconds for seconds, _ in trace.features.values()),
        "filament_mm": sum(filament for _, filament in trace.features.values()),
        "plate": trace.plate,
    }


def _list_uncompared(features: tuple[str, ...], comparison: BeadComparison, unread: int) -> list[str]:
    """List what a comparison leaves out, one phrase each."""
    before, after = comparison.old, comparison.new
    skipped = int(comparison.skipped.sum())
    left_out = []
    if os.path.realpath(before.path) == os.path.realpath(after.path):
        left_out.append("both names are one file, so that nothing was compared with anything else")
    if features:
        left_out.append(f"the paths of {', '.join(features)}")
        if before.layers != after.layers:
            left_out.append(f"their filament by layer: {before.layers} layers are tagged before, {after.layers} after")
    if unread:
        left_out.append(
            f"{count_noun(unread, 'line')} of both prints that may move or extrude and cannot be read, such as line "
            f"{after.unread[0][0]}"
        )
    if skipped:
        left_out.append(f"{count_noun(skipped, 'stretch', 'stretches')} of beads beside a line that cannot be read")
    macros = dict.fromkeys([*before.macros, *after.macros])
    if macros:
        left_out.append(f"what the printer does at {', '.join(macros)}")
    further = [number for number in before.plates if number != before.plate]
    if further:
        left_out.append(f"{'plates' if len(further) > 1 else 'plate'} {', '.join(map(str, further))} of the archive")
    if before.stamp and not after.stamp:
        left_out.append("OLD was refilled and NEW was not: were the two swapped?")
    return left_out
