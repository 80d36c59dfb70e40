"""What `infill fill` makes of every printable part of the test data: ``python -m benchmarks.fill_parts``.

The command runs as a user's would, files included, and what it wrote is judged anew: the skin against the part's own
file, the wall by the nearest void to points all over the skin, which no ray undercuts, the density by the volumes of
both files, what hangs together, and manifold3d.
``--parts bracket_medium`` and ``--patterns gyroid`` for a first look.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from benchmarks.pairs import row
from infill import Surface, check, read_mesh
from infill.lattices.drain_holes import find_closed_voids
from infill.meshes.distance import TriangleTree

PATTERNS = ("gyroid", "honeycomb", "octet", "concentric-heart")
DENSITIES = (0.15, 0.3)
WALL, LEAST = 1.2, 0.9
SECONDS, GIBIBYTES, TRIANGLES, OFF = 120, 4, 1_000_000, 0.005
POINTS = 20_000  # on the skin, from which the wall is measured
# A process of its own, so that the memory is the command's and not that of whoever judges it.
MEASURE = """
import resource, subprocess, sys, time
begin = time.perf_counter()
done = subprocess.run(sys.argv[1:])
spent = time.perf_counter() - begin
print(spent, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=sys.stderr)
sys.exit(done.returncode)
"""
FOLDER = Path(os.environ.get("INFILL_DATA", Path(__file__).parents[2] / "shared" / "data")) / "printable"


@dataclass(frozen=True, kw_only=True)
class Filled:
    seconds: float
    peak: float  # GiB
    report: dict[str, Any]
    result: Path


def filled(part: Path, pattern: str, density: float, folder: Path) -> Filled:
    """Run the command, and return what it took and said."""
    result = folder / "filled.stl"
    words = ["fill", str(part), "--pattern", pattern, "--density", f"{density:.0%}", "--wall", str(WALL)]
    command = [sys.executable, "-m", "infill", *words, "--json", "-q", "--force", "-o", str(result)]
    done = subprocess.run([sys.executable, "-c", MEASURE, *command], capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}: {done.stderr}")
    seconds, peak = map(float, done.stderr.split()[-2:])
    return Filled(seconds=seconds, peak=peak / 2**20, report=json.loads(done.stdout), result=result)


def solids(surface: Surface) -> int:
    """Return how many closed surfaces face outwards: what hangs free inside would be one more."""
    return len(find_closed_voids(Surface(vertices=surface.vertices, faces=surface.faces[:, ::-1])))


def faults(part: Surface, found: Filled, density: float) -> list[str]:
    """Return in what a result is not what it should be, by the file alone but for the volume inside the walls."""
    solid, report = read_mesh(found.result), found.report
    count = len(part.faces)
    corners = np.asarray(part.vertices, dtype=np.float32)[part.faces]
    skin = np.asarray(solid.vertices, dtype=np.float32)[solid.faces[:count]]
    voids = Surface(vertices=solid.vertices, faces=solid.faces[count:, ::-1])
    share = 1 - (part.volume - solid.volume) / report["part"]["inside"]
    points = trimesh.sample.sample_surface(part.to_trimesh(), POINTS, seed=1)[0]
    wall = float(TriangleTree.of(voids).nearest(points)[0].min())
    verdict = check(found.result)
    wrong = {
        "the skin differs": not np.array_equal(corners, skin),
        f"density {share:.1%}": abs(share - density) > OFF,
        f"report says {report['density']:.1%}, the file {share:.1%}": abs(share - report["density"]) > OFF / 5,
        f"wall {wall:.2f} mm": wall < LEAST * WALL,
        f"manifold3d: {verdict.manifold}": verdict.manifold != "NoError" or not verdict.closed,
        f"{found.seconds:.0f} s": found.seconds > SECONDS,
        f"{found.peak:.1f} GiB": found.peak > GIBIBYTES,
        f"{len(solid.faces):,} triangles": len(solid.faces) > TRIANGLES,
        "voids are not listed": len(report["voids"]["closed"])
        != report["voids"]["count"] + len(find_closed_voids(part)),
        "solids do not hang together as before": solids(solid) != solids(part),
        "; ".join(report["problems"]): bool(report["problems"]),
    }
    return [text for text, holds in wrong.items() if holds]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--parts", nargs="*", help="names of files, without their suffix")
    parser.add_argument("--patterns", nargs="*", default=PATTERNS)
    given = parser.parse_args()
    parts = sorted(path for path in FOLDER.glob("*.*") if path.suffix in (".stl", ".obj", ".3mf"))
    bad = 0
    with tempfile.TemporaryDirectory(prefix="fill-parts-") as name:
        for path in parts:
            if given.parts and path.stem not in given.parts:
                continue
            part = read_mesh(path)
            for pattern in given.patterns:
                for density in DENSITIES:
                    found = filled(path, pattern, density, Path(name))
                    wrong = faults(part, found, density)
                    report = found.report
                    figure = (
                        f"{found.seconds:5.1f} s {found.peak:4.1f} GiB {report['triangles'] / 1000:4.0f} k "
                        f"{report['density']:.1%} {report['walls']['least']:.2f} mm"
                    )
                    row(f"{path.stem}, {pattern}, {density:.0%}", figure, "; ".join(wrong), holds=not wrong)
                    bad += bool(wrong)
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
