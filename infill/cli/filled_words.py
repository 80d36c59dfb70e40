"""Texts of ``infill fill``: its plan, and its summary."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from infill.cli.console import format_bytes, format_table, print_json
from infill.plain_numbers import count_noun, plain_number, plain_place, plain_size
from infill.reports.filled_regions import describe_region

if TYPE_CHECKING:
    from infill.reports.filling import FillForecast, FillReport, FillTie
    from infill.reports.making import LatticePlan

REPAIR_TEXTS = {
    "turned": "faces turned outwards",
    "closed": "holes closed",
    "parted": "components that touch taken apart",
    "united": "components that overlap united",
}
# Measured: 4 h 56 m for the solid, 2 h 53 m with PrusaSlicer's own gyroid of the same density.
FILAMENT_ADVICE = (
    "prints slowly as one solid; --for prusa -o part.3mf makes a project to slice, "
    "or slice the part and run infill refill"
)
# Where a built-in field of density is lowest and where it is highest.
PLACES = {
    "skin": ("at the walls", "in the middle"),
    "z": ("at the bottom", "at the top"),
    "x": ("at the lowest x", "at the highest x"),
    "y": ("at the lowest y", "at the highest y"),
}
PLACES_SHOWN = 4  # ties whose places the summary names
END_TEXTS = {"top": "top", "bottom": "bottom", "both": "top and bottom"}


def show_plan(plan: FillForecast, name: str, *, as_json: bool) -> None:
    """Print the plan of a fill: infill, grid and memory."""
    if as_json:
        print_json(plan)
        return
    typer.echo(format_plan(plan, f"{name}, {plan['request']['pattern']}"))


def format_plan(plan: FillForecast | LatticePlan, title: str) -> str:
    """Format the plan of a part or a block as a short table."""
    grid, infill = plan["grid"], plan["infill"]
    rows = {
        "infill": f"cell about {plain_size(infill['cell'], digits=4)}, line width about "
        f"{plain_size(infill['line_width'], digits=4)}",
        "grid": f"{' x '.join(map(str, grid['shape']))} cells of {plain_size(grid['spacing'][0], digits=4)}",
        "memory": f"about {format_bytes(plan['memory'])}",
    }
    return format_table(rows, title=f"{title}: nothing is written (--dry-run)")


def summary(
    report: FillReport, files: list[str], name: str, *, verbose: bool, objects: tuple[int, int] | None = None
) -> str:
    """Format the report of a fill as a short table for stderr; `objects` are those written, and those of the part."""
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
    rows = {
        "mesh": f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}; skin {skin}",
        "solid": f"{plain_size(report['volume'], digits=6, power=3)}, "
        f"{report['volume'] / report['part']['volume']:.1%} of the part",
        "density": f"{report['density']:.1%} inside the walls: cells of {plain_size(infill['cell'], digits=4)}, lines "
        f"of {plain_size(infill['line_width'])}",
        "walls": f"{plain_size(walls['least'] or 0.0)} at least, {plain_size(walls['requested'], digits=6)} asked for",
        "voids": f"{voids['count']:,}, {_drain_text(report)}",
    }
    if request["form"] != "solid":
        rows["mesh"] = f"{report['triangles']:,} triangles, {'closed' if report['closed'] else 'NOT CLOSED'}"
        rows["solid"] = f"{plain_size(report['volume'], digits=6, power=3)} of infill"
        del rows["walls"], rows["voids"]
    rows |= _density_rows(report)
    if infill["phase"] != request["phase"]:
        shift = ", ".join(plain_number(length) for length in infill["phase"])
        rows["shifted"] = f"by {shift} mm in x, y and z: slicers print more of it there"
    if request["form"] == "project" and infill["left_out"]:
        rows["too narrow"] = (
            f"{plain_size(infill['left_out'], power=3)} of infill, left out: slicers would print none of it"
        )
    if infill["ties"]:
        rows["tied"] = _tie_text(infill["ties"], "out" if request["wall"] else "loose")
    if voids["islands"]:
        rows["left out"] = f"{count_noun(voids['islands'], 'piece')} of infill that would have hung free"
    if objects is not None and objects[1] > 1:
        kept, count = objects
        rows["objects"] = f"{count} in the file, {kept} in the result, with their names and colours"
        if kept < count:
            rows["objects"] += "; objects that overlap become one"
    if request["form"] == "solid" and not report["drains"]["count"]:  # drains are for resin and powder
        rows["filament"] = FILAMENT_ADVICE
    if report["problems"]:
        rows["PROBLEMS"] = "; ".join(report["problems"])
    if verbose:
        grid = report["grid"]
        rows["grid"] = f"{' x '.join(map(str, grid['shape']))} cells of {plain_size(grid['spacing'][0], digits=4)}"
        rows["fillets"] = plain_size(infill["radius"])
        rows["seconds"] = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in report["seconds"].items())
    for path in files:
        rows[f"wrote {path}"] = format_bytes(Path(path).stat().st_size) if Path(path).is_file() else ""
    return format_table(rows, title=f"{name}, {request['pattern']}")


def _tie_text(ties: list[FillTie], without: str) -> str:
    """Describe the bars that tie islands to the rest: how many, how long, and where the longest are."""
    lengths = sorted(tie["length"] for tie in ties)
    span = " to ".join(dict.fromkeys(plain_size(length) for length in (lengths[0], lengths[-1])))
    longest = sorted(ties, key=lambda tie: -tie["length"])[:PLACES_SHOWN]
    places = ", ".join(plain_place(tie["at"]) for tie in longest)
    return (
        f"{count_noun(len(ties), 'island')} that nothing held, by {'a bar' if len(ties) == 1 else 'bars'} of {span} "
        f"at {places}{' and elsewhere' if len(ties) > PLACES_SHOWN else ''}; --no-ties leaves them {without}"
    )


def _density_rows(report: FillReport) -> dict[str, str]:
    """Describe a density that changes from place to place; no rows if it does not."""
    request, infill, rows = report["request"], report["infill"], dict[str, str]()
    if request["densities"] is not None:
        first, last = request["densities"]
        lowest, highest = PLACES.get(str(request["by"]), ("where the field is lowest", "where it is highest"))
        ends = f"{plain_number(100 * first, 6)}% {lowest} to {plain_number(100 * last, 6)}% {highest}"
        sizes = f"cells of {plain_size(infill['cell'], digits=4)}, lines of {plain_size(infill['line_width'])}"
        if request["grade"] == "cell":
            (small, large), (narrow, wide) = infill["cells"] or (0, 0), infill["widths"] or (0, 0)
            sizes = (
                f"cells of {plain_size(small)} to {plain_size(large)}, lines of {plain_size(narrow, digits=2)} to "
                f"{plain_size(wide, digits=2)}"
            )
        rows["density"] = f"{ends}; {report['density']:.1%} on average: {sizes}"
    regions = [describe_region(region, request) for region in report["regions"] if region["density"] is not None]
    if regions:
        rows["regions"] = ", ".join(regions)
    return rows


def _drain_text(report: FillReport) -> str:
    """Describe drains, vents, branches and voids that stay closed, in one line."""
    closed, side = len(report["voids"]["closed"]), report["request"]["open"]
    holes = report["drains"]["holes"]
    if not report["request"]["wall"]:
        return "open at the skin"
    if not (holes or side):
        return "sealed: nothing drains from them"
    phrases = [f"{report['voids']['open']:,} open at the {END_TEXTS[side]}"] if side else []
    for kinds, noun, plural in (
        (("drain", "place"), "drain", "drains"),
        (("vent",), "vent", "vents"),
        (("branch",), "branch", "branches"),
    ):
        widths = [hole["diameter"] for hole in holes if hole["kind"] in kinds]
        if widths:
            low, high = plain_number(min(widths), 6), plain_number(max(widths), 6)
            phrases.append(
                f"{count_noun(len(widths), noun, plural)} of {low if low == high else f'{low} to {high}'} mm"
            )
    if closed:
        phrases.append(f"{closed:,} still sealed" if holes else f"{closed:,} sealed")
    return "; ".join(phrases)
