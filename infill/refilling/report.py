"""The report of a refill."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from infill.gcode.ending import describe_missing_end
from infill.gcode.infill_sections import ODD_ARCS
from infill.gcode.survey import Survey
from infill.plain_numbers import count_noun
from infill.refilling.placement import family_of, parameter_facts
from infill.refilling.request import AUTO, KEEP, Request
from infill.refilling.rules import RefillRules
from infill.refilling.stats import PURGED, UNREAD, RefillStats
from infill.refilling.support import LEAST_LENGTH, LEAST_SHARE, kept_shares
from infill.reports.common import FORM
from infill.version import __version__

if TYPE_CHECKING:
    from infill.reports.refilling import ContactKeys, RefillReport

FILAMENT_TOLERANCE = 0.01  # relative error of the filament of all infill that is reported
TIME_TOLERANCE = 0.01  # relative increase of the time of all infill that is reported
MANY_KEPT = 0.1  # of the sections: as many that stay for one of these reasons are reported
FAINT = 0.5  # of the difference of two densities: if the infill has less of it, that is reported
MOST_FREE = 0.05  # of the length: if more of it touches no wall, than did as sliced, that is reported
WHY_KEPT = {
    UNREAD: "they hold moves that cannot be redrawn, such as arcs that climb; slice with arc fitting off",
    ODD_ARCS: "they hold arcs that climb, or that close on no circle; slice with arc fitting off",
    PURGED: "a tool change purges filament into them, and that must stay; they get no faster",
    "no faster": "round corners would save no time in them",
}


def refill_report(
    request: Request,
    print_survey: Survey,
    tally: RefillStats | None,
    *,
    already: bool,
    rules: RefillRules | None = None,
    plates: Sequence[int] = (),
    remedy: RefillStats | None = None,
) -> RefillReport:
    """Build the report of one run: plain numbers, strings, lists and dicts."""
    report: RefillReport = {
        "product": "refill",
        "version": __version__,
        "form": FORM,
        "request": {
            "pattern": request.pattern,
            "parameters": parameter_facts(request.pattern, request.parameters, request.lines),
            "density": None if isinstance(request.density, tuple) else request.density,
            "densities": None if request.gradient is None else [request.gradient.first, request.gradient.last],
            "by": request.by,
            "smooth_radius_mm": request.smooth_radius,
            "max_deviation_mm": request.max_deviation,
            "arcs": request.arcs,
            "even": request.even,
            "leeway": request.allowed_leeway if request.even else None,
            "max_segments": request.max_segments,
            "layers": list(request.layers) if request.layers else None,
            "part": request.part,
        },
        "print": {
            "slicer": print_survey.slicer,
            "bytes": print_survey.size,
            "plates": list(plates),
            "already_refilled": already,
            "refilled_before": bool(print_survey.stamp),
        },
        "problems": [],
    }
    if tally is None or rules is None:
        return report
    report["print"]["layers"] = tally.layers
    report["print"]["unread_lines"] = tally.unread
    report["sections"] = {"all": tally.sections, "replaced": tally.replaced, "kept": dict(sorted(tally.kept.items()))}
    report["rounding"] = {
        "deviation_mm": _finite(rules.rounding.deviation),
        "corners": tally.corners,
        "radius_mm": tally.radii.report(),
        "segments_per_s": _finite(rules.rounding.segments_per_second),
    }
    keeps_paths = request.pattern == KEEP
    keeps = keeps_paths and request.density is None
    before, after = tally.infill, tally.infill_after
    ratio = tally.infill_ratio
    density = print_survey.number("fill_density", "sparse_infill_density")
    report["filament"] = {
        "infill_before_mm": before.filament,
        "infill_after_mm": after.filament,
        "print_before_mm": tally.print_before.filament,
        "print_after_mm": tally.print_after.filament,
        "print_before_g": tally.print_before.grams,
        "print_after_g": tally.print_after.grams,
        "print_ratio": tally.filament_ratio,
        "density_for_the_same_percent": round(density / ratio, 2)
        if keeps and density and ratio >= LEAST_LENGTH
        else None,
        "ratio_with_density_same": tally.widened / before.filament if keeps and before.filament else None,
    }
    report["time"] = {
        "slicer_s": tally.slicer_seconds or None,
        "print_before_s": tally.print_before.seconds,
        "print_after_s": tally.print_after.seconds,
        "infill_before_s": tally.print_before.infill_seconds,
        "infill_after_s": tally.print_after.infill_seconds,
    }
    report["contact"] = contact_section(tally)
    if request.even is not None:
        report["even"] = tally.steps.report(request.even)
    report["problems"] = _problems(report, tally)
    if not keeps_paths and 0 < tally.replaced < tally.sections and not _fills(request):
        report["problems"].append(
            f"{tally.sections - tally.replaced} sections keep the slicer's infill, which begins in the air where "
            f"{request.pattern} leaves the layer below empty; take another pattern, such as support-cubic"
        )
    if not keeps_paths and tally.replaced and _is_lightning(print_survey):
        report["problems"].append(
            "the slicer's own infill is lightning: layers and places that it leaves empty stay empty below the new "
            "infill, and without --density that is as sparse; slice again with another pattern, such as grid"
        )
    if print_survey.missing_end:
        report["problems"].insert(0, describe_missing_end(print_survey.missing_end))
    if keeps_paths and loses_filament(tally):
        lost = f"the infill takes {ratio - 1:+z.1%} filament"
        if remedy is not None and not loses_filament(remedy):
            lost += f"; leave --smooth-radius out, and it takes {remedy.infill_ratio - 1:+z.1%}"
        report["problems"].append(lost)
    promised = not keeps_paths and isinstance(request.density, str | None) and request.cell is None
    if promised and tally.replaced and not _fills(request):
        report["problems"].append(
            f"the infill takes {ratio - 1:+z.1%} filament: {request.pattern} has lines below roofs alone, with the "
            "density of the slicer's infill there"
        )
    elif promised and tally.replaced and abs(ratio - 1) > FILAMENT_TOLERANCE:
        report["problems"].append(
            f"the infill takes {ratio - 1:+z.1%} filament: only whole lines can be added or removed here; take another "
            "pattern, or another --density"
        )
    return report


def _is_lightning(print_survey: Survey) -> bool:
    """Tell whether a print states that its slicer filled it with lightning."""
    return "lightning" in {print_survey.settings.get(name) for name in ("fill_pattern", "sparse_infill_pattern")}


def _fills(request: Request) -> bool:
    """Tell whether the cell of the pattern decides how much filament the infill takes."""
    from infill.paths.families.infill_space import fills_print

    return fills_print(family_of(request.pattern, request.parameters, request.lines))


def loses_filament(tally: RefillStats) -> bool:
    """Tell whether the infill lost so much filament that the report must say so."""
    return tally.infill_ratio < LEAST_LENGTH


def contact_section(tally: RefillStats) -> ContactKeys:
    """Report support, contact and hold of the infill, before and after, as measured on some layers."""
    before, after = tally.before.shares, tally.after.shares
    shares = kept_shares(tally.before, tally.after)
    return {
        "measured_mm": tally.before.length,
        "supported_before": before[0],
        "supported_after": after[0],
        "bonded_before": before[1],
        "bonded_after": after[1],
        "free_before": tally.before.free_share,
        "free_after": tally.after.free_share,
        "kept_supported": shares[0],
        "kept_bonded": shares[1],
    }


def _finite(value: float) -> float | None:
    """Replace infinity and NaN with None."""
    return value if math.isfinite(value) else None


def _is_unexplained(reason: str) -> bool:
    """Tell whether no other problem names the sections that stay for a reason."""
    return reason not in WHY_KEPT and not reason.startswith("a check failed")


def _faint_gradient(densities: Sequence[float] | None, tally: RefillStats) -> list[str]:
    """Say that a density hardly changes, because layers are averaged."""
    if not densities or not tally.densities:
        return []
    low, high = min(tally.densities), max(tally.densities)
    if high - low >= FAINT * abs(densities[1] - densities[0]):
        return []
    extent = f"is {low:.0%} everywhere" if f"{low:.0%}" == f"{high:.0%}" else f"is {low:.0%} to {high:.0%} only"
    return [
        f"the density {extent}: the infill is so thin that lines could not lie on one another if it changed more with "
        "height; give one density, or another --by, such as x"
    ]


def _problems(report: RefillReport, tally: RefillStats) -> list[str]:
    """List the problems of a refill, one phrase each."""
    keeps = report["request"]["pattern"] == KEEP
    problems = []
    if not tally.sections:
        problems.append("there is no sparse infill in this print; nothing was changed")
    elif not tally.replaced:
        reasons = ", ".join(f"{reason} ({number})" for reason, number in sorted(tally.kept.items()))
        problems.append(f"none of {tally.sections} sections of infill was changed: {reasons or 'no corner to round'}")
    stay = "they were" if report["print"]["refilled_before"] else "sliced"
    problems += [
        f"{tally.kept[reason]} of {tally.sections} sections stay as {stay}: {words}"
        for reason, words in WHY_KEPT.items()
        if tally.kept.get(reason, 0) >= MANY_KEPT * max(tally.sections, 1)
    ]
    others = {reason: number for reason, number in sorted(tally.kept.items()) if _is_unexplained(reason)}
    if not keeps and tally.replaced and sum(others.values()) >= MANY_KEPT * tally.sections:
        reasons = ", ".join(f"{reason} ({number})" for reason, number in others.items())
        problems.append(f"{sum(others.values())} of {tally.sections} sections stay as {stay}: {reasons}")
    before, after = report["time"]["infill_before_s"], report["time"]["infill_after_s"]
    earlier = "that of the last refill" if report["print"]["refilled_before"] else "the slicer's"
    # More infill than before, where a density asks for it, may take as much longer.
    asked = report["request"]["density"] or report["request"]["densities"]
    denser = max(1.0, tally.infill_ratio) if asked else 1.0
    if tally.replaced and before and after > before * denser * (1 + TIME_TOLERANCE):
        amount = f", {denser - 1:+z.0%} filament" if denser > 1 + TIME_TOLERANCE else ""
        problems.append(
            f"the new infill is slower than {earlier}: it takes {after / before - 1:+z.0%} printing time{amount}; "
            "for less, take another pattern, or keep"
        )
    failed = sum(number for reason, number in tally.kept.items() if reason.startswith("a check failed"))
    if failed:
        problems.append(f"{failed} sections were kept because a check of the new text failed")
    if tally.unread:
        problems.append(
            f"{count_noun(tally.unread, 'line')} that may move or extrude cannot be read, the first is line "
            f"{tally.first_unread}; what cannot be read stays as it is, and the times leave it out"
        )
    problems += _faint_gradient(report["request"]["densities"], tally)
    contact = report["contact"]
    by_itself = report["request"]["smooth_radius_mm"] == AUTO
    less_rounding = "give a smaller --max-deviation" if by_itself else "give a smaller --smooth-radius, or leave it out"
    if contact["measured_mm"] and tally.after.length and contact["kept_supported"] < LEAST_SHARE:
        problems.append(
            f"{1 - contact['kept_supported']:.0%} less of this infill rests on the layer below than before; "
            + (less_rounding if keeps else "try another --pattern")
            + ("" if keeps or asked else ", or none, which keeps the slicer's infill")
        )
    if not keeps and contact["free_after"] - contact["free_before"] > MOST_FREE:
        problems.append(
            f"{contact['free_after']:.0%} of this infill touches no wall, not even through other lines; draw lines "
            "from wall to wall, or take another --pattern, such as gyroid"
        )
    if keeps and contact["measured_mm"] and contact["kept_bonded"] < LEAST_SHARE:
        problems.append(
            f"{1 - contact['kept_bonded']:.0%} less of the doubled lines touch each other than before; {less_rounding}"
        )
    return problems
