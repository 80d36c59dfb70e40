"""`infill smooth` on noisy scanned meshes beside trimesh's filters: ``python -m benchmarks.smooth_meshes``.

Models of the test data get Gaussian noise along the normals of their vertices, and each way of smoothing is judged
against the model without noise. Results go to build/smooth-report.json, and the table to docs/smooth-report.md.
"""

from __future__ import annotations

import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from benchmarks.slicer_tables import table
from benchmarks.smooth_geometry import Topology, nearest, sampled
from benchmarks.smooth_page import put
from benchmarks.smooth_runs import arguments, command_of, keep, made_with, read_results, smoothed
from benchmarks.smooth_scans import angle

SECTION = "meshes"
OURS, NOISY = "ours", "not smoothed"
FILTERS: dict[str, Callable[[trimesh.Trimesh], Any]] = {
    "Taubin": trimesh.smoothing.filter_taubin,
    "Humphrey": trimesh.smoothing.filter_humphrey,
}
PAIRS = (
    ("bunny_75k.off", 0.1),
    ("bunny_75k.off", 0.3),
    ("armadillo_52k.off", 0.2),
    ("horse_97k.ply", 0.3),
    ("rocker_arm_20k.obj", 0.2),
    ("cheburashka_13k.obj", 0.1),
    ("fandisk_13k.off", 0.1),
    ("fandisk_13k.off", 0.3),
)
SIZE = 100.0  # mm, the longest side of every model
SAMPLES = 100_000
SEED = 20201


@dataclass(frozen=True)
class Pair:
    """A model and what a scanner with noise would make of it; `edge` is the mean length of its edges, mm."""

    name: str
    truth: trimesh.Trimesh
    noisy: trimesh.Trimesh
    edge: float


def pairs(folder: Path, only: str = "") -> Iterator[Pair]:
    """Return the pairs whose name matches."""
    for file, noise in PAIRS:
        name = f"{Path(file).stem}, {noise:g} edges"
        if re.search(only, name):
            yield roughened(name, trimesh.load(folder / "models" / file, force="mesh"), noise)


def roughened(name: str, mesh: trimesh.Trimesh, noise: float) -> Pair:
    """Return a model, scaled, and itself with noise of so many mean edge lengths (standard deviation)."""
    truth = trimesh.Trimesh(vertices=mesh.vertices * (SIZE / mesh.extents.max()), faces=mesh.faces, process=True)
    if truth.volume < 0:
        truth.invert()
    edge = float(truth.edges_unique_length.mean())
    along = np.random.default_rng(SEED).normal(scale=noise * edge, size=len(truth.vertices))
    moved = truth.vertices + along[:, None] * truth.vertex_normals
    return Pair(name, truth, trimesh.Trimesh(vertices=moved, faces=truth.faces, process=False), edge)


def run(pair: Pair, command: Sequence[str]) -> dict[str, Any]:
    """Return how near each way of smoothing comes to the truth, and what it takes."""
    found: dict[str, Any] = {NOISY: measured(pair, pair.noisy) | {"seconds": 0.0}}
    with tempfile.TemporaryDirectory() as name:
        source, output = Path(name) / "noisy.ply", Path(name) / "out.stl"
        pair.noisy.export(source)
        done = smoothed(command, source, output)
        refused = done.message
        if refused:
            done = smoothed(command, source, output, ["--allow-broken"])
        if not done.status:
            cell = float(np.mean(done.report["grid"]["spacing"]))
            facts = {"seconds": done.seconds, "refused": refused, "cell": cell / pair.edge}
            found[OURS] = measured(pair, trimesh.load(output, force="mesh")) | facts
    for who, smooth in FILTERS.items():
        mesh = pair.noisy.copy()
        begin = time.perf_counter()
        smooth(mesh)
        found[who] = {"seconds": time.perf_counter() - begin}
        found[who] |= measured(pair, trimesh.Trimesh(vertices=mesh.vertices, faces=mesh.faces, process=False))
    return found


def measured(pair: Pair, mesh: trimesh.Trimesh) -> dict[str, Any]:
    """Return distances in edge lengths, the mean of both ways, and the mean angle between normals, degrees."""
    own, true = sampled(mesh, SAMPLES), sampled(pair.truth, SAMPLES)
    feet, faces = nearest(pair.truth)(own.points)
    away = np.linalg.norm(feet - own.points, axis=1)
    back = np.linalg.norm(nearest(mesh)(true.points)[0] - true.points, axis=1)
    return {
        "mean": float((away.mean() + back.mean()) / 2 / pair.edge),
        "p95": float((np.percentile(away, 95) + np.percentile(back, 95)) / 2 / pair.edge),
        "angle": angle(own.normals, pair.truth.face_normals[faces]),
        "volume": float(mesh.volume / pair.truth.volume - 1),
        "closed": Topology(mesh).closed,
        "triangles": len(mesh.faces),
    }


def section(rows: dict[str, dict[str, Any]], made: str) -> str:
    """Return how many pairs are won, and the table."""
    won = {what: _best(rows.values(), what) for what in ("mean", "angle")}
    told = {what: ", ".join(f"{who} {count}" for who, count in counts.items()) for what, counts in won.items()}
    worse = sum(found[OURS]["mean"] > found[NOISY]["mean"] for found in rows.values() if OURS in found)
    refused = sum(bool(found.get(OURS, {"refused": True})["refused"]) for found in rows.values())
    head = [
        f"Made with {made}.\n",
        f"* **Of {len(rows)} pairs, nearest to the truth:** {told['mean']}. Best normals: {told['angle']}.",
        f"* Farther from the truth after our smoothing than before: {worse} of {len(rows)}.",
        f"* Refused by ours with the default options: {refused}; those are made with `--allow-broken`.\n",
    ]
    lines = [_line(name, who, found[who]) for name, found in rows.items() for who in ORDER if who in found]
    return "\n".join(head) + "\n" + table(HEAD, lines)


def _best(rows: Iterable[dict[str, Any]], what: str) -> dict[str, int]:
    """Return how often each is least."""
    ways = [{who: each[what] for who, each in found.items() if who != NOISY} for found in rows]
    best = [min(scores, key=scores.__getitem__) for scores in ways]
    return {who: best.count(who) for who in (OURS, *FILTERS)}


ORDER = (NOISY, OURS, *FILTERS)
HEAD = ("model, noise", "by", "mean / 95 %, edges", "normals", "volume", "triangles", "closed", "s", "cell, edges")


def _line(name: str, who: str, found: dict[str, Any]) -> tuple[str, ...]:
    return (
        name if who == NOISY else "",
        who + ", refused at first" * bool(found.get("refused")),
        f"{found['mean']:.3f} / {found['p95']:.3f}",
        f"{found['angle']:.1f}°",
        f"{found['volume']:+.2%}".replace("-", "−"),
        f"{found['triangles']:,}",
        "yes" if found["closed"] else "no",
        "-" if who == NOISY else f"{found['seconds']:.2f}",
        f"{found['cell']:.2f}" if "cell" in found else "-",
    )


def main() -> None:
    """Run the pairs that are asked for, keep their results, and write the table."""
    given = arguments(__doc__ or "").parse_args()
    command = command_of(given.command)
    stored = read_results(given.results).get(SECTION, {"rows": {}, "made": ""})
    if not given.page:
        stored["made"] = made_with(command)
        for pair in pairs(given.folder, given.only):
            stored["rows"][pair.name] = run(pair, command)
            keep(given.results, SECTION, stored)
            for who in ORDER:
                if who in stored["rows"][pair.name]:
                    print(" | ".join(_line(pair.name, who, stored["rows"][pair.name][who])), flush=True)
    put(given.into, SECTION, section(stored["rows"], stored["made"]))


if __name__ == "__main__":
    sys.exit(main())
