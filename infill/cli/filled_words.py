"""Texts of ``infill fill``: its plan, and its summary."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from infill.cli.console import format_bytes, format_table, print_json

if TYPE_CHECKING:
    from infill.reports.filling import FillForecast, FillReport

REPAIR_TEXTS = {
    "turned": "faces turned outwards",
    "closed": "holes closed",
    "parted": "components that touch taken apart",
    "united": "components that overlap united",
}
# Measured: 4 h 56 m for the solid, 2 h 53 m with PrusaSlicer's own gyroid of the same density.
FILAMENT_ADVICE = "prints slowly as one solid; write --for SLICER, or slice the part itself and run infill refill"
END_TEXTS = {"top": "top", "bottom": "bottom", "both": "top and bottom"}


def show_plan(plan: FillForecast, name: str, *, as_json: bool) -> None:
    """Print the plan of a fill: infill, grid and memory."""
    if as_json:
        print_json(plan)
        return
    grid, infill = plan["grid"], plan["infill"]
    rows = {
        "infill": f"cell about {infill['cell']:.4g} mm, line width about {infill['line_width']:.4g} mm",
        "grid": f"{' x '.join(map(str, grid['shape']))} cells of {grid['spacing'][0]:.4g} mm",
        "memory": f"about {format_bytes(plan['memory'])}",
    }
    typer.echo(format_table(rows, title=f"{name}, {plan['request']['pattern']}: nothing is written (--dry-run)"))


def summary(report: FillReport, files: list[str], name: str, *, verbose: bool) -> str:
    """Format the report of a fill as a short table for stderr."""
    request, mesh, voids, walls, infill = (
        report["request"],
        report["mesh"],
        report["voids"],
        report["walls"],
        report["infill"],
    )
    skin = "as it was" if mesh["skin"] == "as given" else REPAIR_TEXTS[mesh["skin"]]
    if report["drains"]["count"]:
        skin += ", except for the drains"
    if request["open"]:
        skin += f", except for the open {END_TEXTS[request['open']]}"
    graded = report["graded"]
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}; skin {skin}",
        "solid": f"{report['volume']:.6g} mm³, {report['volume'] / report['part']['volume']:.1%} of the part",
        "density": f"{report['density']:.1%} inside the walls: cells of {infill['cell']:.4g} mm, lines of "
        f"{infill['line_width']:.3g} mm",
        "walls": f"{walls['least'] or 0.0:.3g} mm at least, {walls['requested']:g} asked for",
        "voids": f"{voids['count']:,}, {_drain_text(report)}",
    }
    if request["form"] != "solid":
        rows["mesh"] = f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}"
        rows["solid"] = f"{report['volume']:.6g} mm³ of infill"
        del rows["walls"], rows["voids"]
    if graded:
        ends = f"{graded[0]['density']:.0%} to {graded[-1]['density']:.0%}"
        requested = f"{graded[0]['wanted']:.0%} to {graded[-1]['wanted']:.0%}"
        rows["graded"] = f"{ends} by {request['by']}, where {requested} was asked for"
        if request["grade"] == "cell":
            (small, large), (narrow, wide) = infill["cells"] or (0, 0), infill["widths"] or (0, 0)
            rows["graded"] += f"; cells of {small:.3g} to {large:.3g} mm, lines of {narrow:.2g} to {wide:.2g} mm"
    regions = [
        f"{region['density']:.1%} {'elsewhere' if region['place'] == 'rest' else 'in ' + region['place']}"
        for region in report["regions"]
        if region["density"] is not None
    ]
    if regions:
        rows["regions"] = ", ".join(regions)
    if infill["phase"] != request["phase"]:
        shift = ", ".join(f"{length:.3g}" for length in infill["phase"])
        rows["shifted"] = f"by {shift} mm in x, y and z: slicers print more of it there"
    if request["form"] == "project" and infill["left_out"]:
        rows["too narrow"] = f"{infill['left_out']:.3g} mm³ of infill, left out: slicers would print none of it"
    if voids["islands"]:
        rows["left out"] = f"{voids['islands']:,} piece(s) of infill that would have hung free"
    if request["form"] == "solid" and not report["drains"]["count"]:  # drains are for resin and powder
        rows["filament"] = FILAMENT_ADVICE
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if verbose:
        grid = report["grid"]
        rows["grid"] = f"{' x '.join(map(str, grid['shape']))} cells of {grid['spacing'][0]:.4g} mm"
        rows["fillets"] = f"{infill['radius']:.3g} mm"
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=f"{name}, {request['pattern']}")


def _drain_text(report: FillReport) -> str:
    """Describe drains, vents, branches and voids that stay closed, in one line."""
    closed, side = len(report["voids"]["closed"]), report["request"]["open"]
    holes = report["drains"]["holes"]
    if not (holes or side):
        return "sealed: nothing drains from them"
    phrases = [f"{report['voids']['open']:,} open at the {END_TEXTS[side]}"] if side else []
    for kinds, noun in ((("drain", "place"), "drain(s)"), (("vent",), "vent(s)"), (("branch",), "branch(es)")):
        widths = [hole["diameter"] for hole in holes if hole["kind"] in kinds]
        if widths:
            low, high = min(widths), max(widths)
            phrases.append(f"{len(widths):,} {noun} of {low:g}{'' if low == high else f' to {high:g}'} mm")
    if closed:
        phrases.append(f"{closed:,} still sealed" if holes else f"{closed:,} sealed")
    return "; ".join(phrases)
