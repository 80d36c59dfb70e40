"""Density: every pattern of ours in three regions, from 5 to 40 %, against the filament of the slicer's own infill.

Each region is sliced with rectilinear infill, and refilled with the filament that it had. Measured on the G-code: the
filament; the least distance of two strands; turns; the smallest radius of what turns by less than 30 degrees.
"""

from __future__ import annotations

import itertools
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import trimesh
from scipy.spatial import cKDTree

from benchmarks.slicer_judge import ROLE, windows
from infill import refill
from infill.errors import InfillError
from infill.paths.families.catalogue import FAMILIES
from infill.timing.printing_time import motion
from tests.gcode_judge import lines_of, replayed
from tests.gcode_structure import layers_of, samples
from tests.prints import prusa_print

DENSITIES = (5, 10, 20, 30, 40)
REGIONS = ("disc", "bracket", "ring")
HEIGHT = 4.0  # mm
WIDTH = 0.45  # mm
SPACING = 0.45 - 0.2 * (1 - np.pi / 4)  # mm, at which beads with rounded sides fill the plane
ROUND = np.radians(30.0)
SEEN = np.radians(2.0)  # less is the rounding of coordinates


def measure(*, quick: bool) -> dict[str, Any]:
    """Return the numbers of every region and density, by "region/density/pattern"."""
    densities = DENSITIES[1:3] if quick else DENSITIES
    found: dict[str, Any] = {}
    with ProcessPoolExecutor(max_workers=2) as pool:
        for some in pool.map(_region, *zip(*itertools.product(REGIONS, densities), strict=True)):
            found.update(some)
            print(f"density: {len(found)} runs", flush=True)
    return found


def outline(region: str) -> shapely.Polygon:
    """Return the outline of a region, mm.

    >>> outline("ring").bounds
    (-30.0, -30.0, 30.0, 30.0)
    """
    if region == "disc":
        return shapely.Point(0, 0).buffer(30, quad_segs=32)
    if region == "ring":
        return shapely.Point(0, 0).buffer(30, quad_segs=32).difference(shapely.Point(0, 0).buffer(22, quad_segs=32))
    plate = shapely.union(shapely.box(-35, -20, 35, 0), shapely.box(-35, -20, -15, 30))
    bosses = [shapely.Point(x, y).buffer(8, quad_segs=16) for x, y in ((-25, 30), (35, -10), (5, -20))]
    holes = [shapely.Point(x, y).buffer(2.5, quad_segs=16) for x, y in ((-25, 30), (35, -10), (5, -20), (-25, -10))]
    return shapely.difference(shapely.union_all([plate, *bosses]), shapely.union_all(holes))


def _region(region: str, density: float) -> dict[str, Any]:
    found: dict[str, Any] = {}
    with tempfile.TemporaryDirectory(prefix="slicer-density-") as name:
        folder = Path(name)
        mesh = folder / "region.stl"
        trimesh.creation.extrude_polygon(outline(region), HEIGHT, engine="manifold").export(mesh)
        settings = {"fill_pattern": "rectilinear", "fill_density": f"{density}%"}
        plain = prusa_print(mesh, folder / "plain.gcode", {**settings, "top_solid_layers": 2, "bottom_solid_layers": 2})
        own = motion(plain).to_dict()
        before = sum(each["filament"] for each in own["features"] if each["role"] == ROLE)
        for pattern in FAMILIES:
            output = folder / "new.gcode"
            try:
                report = refill(plain, output=output, pattern=pattern, overwrite=True).report
                found[f"{region}/{density}/{pattern}"] = _measured(output, before, report)
            except InfillError as error:
                found[f"{region}/{density}/{pattern}"] = {"error": str(error)[:200]}
            output.unlink(missing_ok=True)
    return found


def _measured(output: Path, before: float, report: dict[str, Any]) -> dict[str, Any]:
    if not output.exists():
        return {"error": "; ".join(report["problems"])[:200] or "nothing was changed"}
    after = sum(each.filament for each in motion(output).features if each.role == ROLE)
    apart, radii, sharp, length = [], [], 0, 0.0
    for window in windows(output.read_bytes(), 1, 6):
        for _, infill, _ in layers_of(window):
            paths = lines_of(infill)
            if paths:
                apart.append(distances(paths))
                found, corners = curvature(paths)
                radii.append(found)
                sharp += corners
                length += sum(float(np.hypot(*np.diff(path, axis=0).T).sum()) for path in paths)
        replayed.cache_clear()
    gaps, all_radii = np.concatenate(apart), np.concatenate(radii)
    return {
        "filament": after / before,
        "sections": report["sections"],
        "gap": float(gaps.min()),
        "gap_share": float((gaps < 0.95 * SPACING).mean()),
        "turns_per_m": sharp / length * 1000,
        "radius": float(all_radii.min()) if len(all_radii) else None,
        "radius_p1": float(np.quantile(all_radii, 0.01)) if len(all_radii) else None,
        "radius_reported": ((report.get("rounding") or {}).get("radius_mm") or {}).get("smallest_hundredth"),
        "problems": report["problems"],
    }


def distances(paths: list[np.ndarray]) -> np.ndarray:
    """Return, for points along the paths, the distance to the nearest other strand, mm, up to two line widths."""
    points, along, path = samples(paths)
    near = np.full(len(points), 2 * WIDTH)
    i, j = cKDTree(points).query_pairs(2 * WIDTH, output_type="ndarray").reshape(-1, 2).T
    away = np.abs(along[i] - along[j])
    # The two ends of a loop that closes are one place of it.
    length = np.array([along[path == number].max(initial=0.0) for number in range(len(paths))])
    loop = np.array([np.hypot(*(each[-1] - each[0])) < 2 * WIDTH for each in paths])
    away = np.where(loop[path[i]], np.minimum(away, length[path[i]] - away), away)
    other = (path[i] != path[j]) | (away > 4 * WIDTH)
    i, j = i[other], j[other]
    apart = np.hypot(*(points[i] - points[j]).T)
    np.minimum.at(near, i, apart)
    np.minimum.at(near, j, apart)
    return near


def curvature(paths: list[np.ndarray]) -> tuple[np.ndarray, int]:
    """Return radii where paths turn by less than 30 degrees, mm, and how many turns are sharper.

    >>> turn = np.linspace(0, 3, 40)
    >>> radii, sharp = curvature([2 * np.column_stack([np.cos(turn), np.sin(turn)])])
    >>> float(radii.min().round(3)), sharp
    (2.0, 0)
    """
    radii, sharp = [np.empty(0)], 0
    for path in paths:
        step = np.diff(path, axis=0)
        length = np.hypot(*step.T)
        step, length = step[length > 0], length[length > 0]
        if len(step) < 2:
            continue
        cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
        turn = np.abs(np.arctan2(cross, (step[:-1] * step[1:]).sum(axis=1)))
        sharp += int((turn > ROUND).sum())
        bent = (turn > SEEN) & (turn <= ROUND)
        radii.append((length[:-1] + length[1:])[bent] / (2 * turn[bent]))
    return np.concatenate(radii), sharp
