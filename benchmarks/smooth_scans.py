"""`infill smooth` on scans beside 3D Slicer's recipe and VTK's surface nets: ``python -m benchmarks.smooth_scans``.

All three get the same cells, solid or not; all three are judged against the surface that the grey values show, which
only the judge sees. Results go to build/smooth-report.json, and the table to docs/smooth-report.md.
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from scipy.ndimage import map_coordinates

from benchmarks.peers.meshers import Field, slicer, surface_nets
from benchmarks.slicer_tables import table
from benchmarks.smooth_geometry import Topology, nearest, sampled
from benchmarks.smooth_page import put
from benchmarks.smooth_runs import arguments, command_of, keep, made_with, read_results, smoothed
from benchmarks.smooth_scenes import SCANS, Image, isosurface, read, write
from infill.surface import Surface

SECTION = "scans"
OURS = "ours"
PEERS: dict[str, Callable[[Field], Surface]] = {"3D Slicer": slicer, "surface nets": surface_nets}
SAMPLES = 200_000
EVERY = 5  # slices of a scan in thick slices


@dataclass(frozen=True)
class Case:
    """What is given, and what it is judged against."""

    name: str
    given: Image
    threshold: float | None  # None for a mask
    truth: Image
    level: float
    grey: bool = True  # whether the truth has grey values, and so normals

    @property
    def solid(self) -> np.ndarray:
        return self.given.values > 0 if self.threshold is None else self.given.values >= self.threshold


def cases(folder: Path) -> Iterator[Case]:
    """Return the scans, and what is made from them: thick slices, and masks without grey values."""
    for name, scan in SCANS.items():
        image = read(folder, scan)
        case = Case(name, image, scan.threshold, image, scan.level, grey=scan.threshold is not None)
        yield case
        if case.grey:
            mask = Image(case.solid.astype(np.uint8), image.spacing)
            yield replace(case, name=f"{name}, as a mask", given=mask, threshold=None)
        if name.startswith("CT"):
            thick = Image(image.values[::EVERY], image.spacing * [EVERY, 1, 1])
            yield replace(case, name=f"{name}, every {EVERY}th slice", given=thick)


def run(case: Case, command: Sequence[str]) -> dict[str, Any]:
    """Return how near each comes to the truth."""
    truth = isosurface(case.truth, case.level)
    found: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = write(case.given, folder / "scan.nrrd")
        options = [] if case.threshold is None else ["--threshold", f"{case.threshold:g}"]
        done = smoothed(command, source, folder / "out.stl", options)
        refused = done.message
        if refused:
            done = smoothed(command, source, folder / "out.stl", [*options, "--allow-broken"])
        if not done.status:
            mesh = trimesh.load(folder / "out.stl", force="mesh")
            found[OURS] = measured(case, truth, mesh) | {"refused": refused}
    for peer, mesher in PEERS.items():
        found[peer] = measured(case, truth, in_mm(mesher(np.where(case.solid.T, 1.0, -1.0)), case.given))
    return found


def in_mm(surface: Surface, image: Image) -> trimesh.Trimesh:
    """Return a surface in cells about the middle of the grid where the image lies."""
    middle = (np.array(image.values.shape[::-1]) - 1) / 2
    vertices = (surface.vertices + middle) * image.spacing[::-1]
    return trimesh.Trimesh(vertices=vertices, faces=surface.faces, process=True)


def measured(case: Case, truth: trimesh.Trimesh, mesh: trimesh.Trimesh) -> dict[str, Any]:
    """Return distances both ways in mm, the error of the volume and of the normals, and whether it is manifold."""
    own, true = sampled(mesh, SAMPLES), sampled(truth, SAMPLES)
    feet = nearest(truth)(own.points)[0]
    away = np.linalg.norm(feet - own.points, axis=1)
    back = np.linalg.norm(nearest(mesh)(true.points)[0] - true.points, axis=1)
    return {
        "to_truth": [float(away.mean()), float(np.percentile(away, 95))],
        "from_truth": [float(back.mean()), float(np.percentile(back, 95))],
        "volume": float(mesh.volume / truth.volume - 1),
        "angle": angle(own.normals, downhill(case.truth, feet)) if case.grey else None,
        "manifold": Topology(mesh).manifold,
    }


def downhill(image: Image, places: np.ndarray) -> np.ndarray:
    """Return the direction in which the grey values fall, (N, 3) in x, y and z, at places in mm."""
    at = (places[:, ::-1] / image.spacing).T
    slopes = np.gradient(image.values.astype(np.float64), *image.spacing)
    return -np.column_stack([map_coordinates(slope, at, order=1, mode="nearest") for slope in slopes[::-1]])


def angle(one: np.ndarray, other: np.ndarray) -> float:
    """Return the mean angle between directions, degrees; those of no length are left out."""
    lengths = np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)
    some = lengths > 0
    cosine = (one[some] * other[some]).sum(axis=1) / lengths[some]
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean())


def two_ways(found: dict[str, Any]) -> float:
    """Return the mean distance, the mean of both ways."""
    return (found["to_truth"][0] + found["from_truth"][0]) / 2


MEASURES: dict[str, Callable[[dict[str, Any]], float | None]] = {
    "nearest (mean of both ways)": two_ways,
    "best normals": lambda found: found["angle"],
    "best volume": lambda found: abs(found["volume"]),
}


def section(rows: dict[str, dict[str, Any]], made: str) -> str:
    """Return how many cases are won, and the table."""
    won = [f"{what} in {_won(rows.values(), value)}" for what, value in MEASURES.items()]
    refused = sum(bool(found.get(OURS, {}).get("refused")) for found in rows.values())
    manifold = {who: sum(found[who]["manifold"] for found in rows.values() if who in found) for who in (OURS, *PEERS)}
    head = [
        f"Made with {made}.\n",
        f"* **Of {len(rows)} cases, ours wins:** {'; '.join(won)}.",
        f"* Manifold: {', '.join(f'{who} {count} of {len(rows)}' for who, count in manifold.items())}.",
        f"* Refused by ours with the default options: {refused}; those are made with `--allow-broken`.\n",
    ]
    return "\n".join(head) + "\n" + table(HEAD, [_line(name, who, found[who]) for name, who, found in _each(rows)])


def _won(rows: Any, value: Callable[[dict[str, Any]], float | None]) -> str:
    won = of = 0
    for found in rows:
        scores = {who: value(each) for who, each in found.items()}
        if None not in scores.values():
            of += 1
            won += min(scores, key=scores.__getitem__) == OURS
    return f"{won} of {of}"


def _each(rows: dict[str, dict[str, Any]]) -> Iterator[tuple[str, str, dict[str, Any]]]:
    return ((name, who, found) for name, found in rows.items() for who in (OURS, *PEERS) if who in found)


HEAD = ("scan", "by", "to the truth: mean / 95 %, mm", "from the truth", "volume", "normals", "manifold")


def _line(name: str, who: str, found: dict[str, Any]) -> tuple[str, ...]:
    return (
        name if who == OURS else "",
        who + ", refused at first" * bool(found.get("refused")),
        *(" / ".join(f"{each:.3f}" for each in found[way]) for way in ("to_truth", "from_truth")),
        f"{found['volume']:+.2%}".replace("-", "−"),
        "-" if found["angle"] is None else f"{found['angle']:.1f}°",
        "yes" if found["manifold"] else "no",
    )


def main() -> None:
    """Run the cases that are asked for, keep their results, and write the table."""
    given = arguments(__doc__ or "").parse_args()
    command = command_of(given.command)
    stored = read_results(given.results).get(SECTION, {"rows": {}, "made": ""})
    if not given.page:
        stored["made"] = made_with(command)
        for case in cases(given.folder):
            if re.search(given.only, case.name):
                stored["rows"][case.name] = run(case, command)
                keep(given.results, SECTION, stored)
                for who, found in stored["rows"][case.name].items():
                    print(" | ".join(_line(case.name, who, found)), flush=True)
    put(given.into, SECTION, section(stored["rows"], stored["made"]))


if __name__ == "__main__":
    sys.exit(main())
