"""The sections of density and of speed on the page of the slicer report."""

from __future__ import annotations

from typing import Any

from benchmarks.slicer_tables import percent, table, verdict

LEAST_GAP = 0.95  # of the spacing at which beads fill the plane
SPACING = 0.407  # mm


def density_section(found: dict[str, Any] | None) -> str:
    """Return the table of patterns: the farthest of all regions and densities."""
    if not found:
        return ""
    keys = [key.split("/") for key in found]
    patterns, regions = dict.fromkeys(key[2] for key in keys), dict.fromkeys(key[0] for key in keys)
    densities = sorted({float(key[1]) for key in keys})
    rows = []
    for pattern in patterns:
        runs = {key: run for key, run in found.items() if key.endswith("/" + pattern)}
        good = {key: run for key, run in runs.items() if "error" not in run}
        if not good:
            rows.append((pattern, "-", "-", "-", "-", "-", "-", "-", f"all {len(runs)} failed"))
            continue
        far = max(good, key=lambda key: abs(good[key]["filament"] - 1))
        off = [key for key, run in good.items() if abs(run["filament"] - 1) > 0.01]
        near = min(good, key=lambda key: good[key]["gap"])
        radii = [run["radius_p1"] for run in good.values() if run["radius_p1"] is not None]
        told = [run["radius_reported"] for run in good.values() if run["radius_reported"] is not None]
        sections = [run["sections"] for run in good.values()]
        rows.append(
            (
                pattern,
                f"{percent(good[far]['filament'] - 1)} ({_place(far)})",
                verdict(not off) + (f" in {len(off)} of {len(good)}" if off else ""),
                f"{good[near]['gap'] / SPACING:.2f} ({_place(near)})",
                f"{max(run['gap_share'] for run in good.values()):.2%}",
                f"{max(run['turns_per_m'] for run in good.values()):.0f}",
                f"{min(radii):.2f}" if radii else "-",
                f"{min(told):.2f}" if told else "none",
                f"{sum(each['replaced'] for each in sections)} of {sum(each['all'] for each in sections)}"
                + (f", {len(runs) - len(good)} runs failed" if len(good) < len(runs) else ""),
            )
        )
    head = ("pattern", "filament, farthest", "within 1 %?", "least gap", "nearer than 0.95", "turns over 30° a m")
    return (
        "## Density\n\n"
        f"Every pattern of ours in {len(regions)} regions ({', '.join(regions)}) at "
        f"{', '.join(f'{density:g}' for density in densities)} %, against the filament of PrusaSlicer's rectilinear "
        "infill of the same region; lightning takes only what roofs need. The gap is the least distance of two "
        "strands, or of a strand and itself beyond 4 "
        f"line widths, over {SPACING} mm, the spacing at which beads 0.45 mm wide fill the plane; beside it, the share "
        "of the length that lies nearer than 0.95 of that, in the worst run. The radius is measured where paths turn "
        "by less than 30° at a vertex: the radius that all but 1 % of such places exceed, in the worst run.\n\n"
        + table((*head, "radius, mm", "as reported, mm", "sections"), rows)
    )


def _place(key: str) -> str:
    region, density, _ = key.split("/")
    return f"{region}, {density} %"


def speed_section(found: dict[str, Any] | None) -> str:
    """Return speed and memory."""
    if not found:
        return ""
    limits = {"ours": (2.0, None), "keep honeycomb": (6.0, 300e6), "keep gyroid": (6.0, 300e6)}
    names = {"ours": "honeycomb of ours, box 60 × 60 × 20"}
    rows = []
    for name, (seconds, memory) in limits.items():
        run = found[name]
        good = run["seconds"] <= seconds and (memory is None or run["memory"] <= memory)
        limit = f"{seconds:g} s" + (f", {memory / 1e6:g} MB" if memory else "")
        rows.append(
            (
                names.get(name, f"{name}, large box"),
                f"{run['bytes'] / 1e6:.1f}",
                f"{run['seconds']:.2f}",
                f"{run['memory'] / 1e6:.0f}",
                f"{run['slicer_seconds']:.2f}",
                f"{run['ratio']:.2f}",
                limit,
                verdict(good),
            )
        )
    memory_rows = [
        (f"{run['bytes'] / 1e6:.1f}", f"{run['seconds']:.1f}", f"{run['memory'] / 1e6:.0f}") for run in found["memory"]
    ]
    return (
        "## Speed and memory\n\n"
        f"`infill refill` as a command, start included, in turn with `prusa-slicer` slicing the same print: medians, "
        f"pairs: {found['runs']}, the ratio pair by pair. {found['cores']} cores; the load at the end was "
        f"{found['load']:.1f}, so that seconds are upper bounds and the ratio is what to trust.\n\n"
        + table(("job", "MB", "s", "peak MB", "slicing, s", "ratio", "limit", "reached?"), rows)
        + "\n`keep` on gyroid boxes of growing height:\n\n"
        + table(("G-code, MB", "s", "peak MB"), memory_rows)
    )
