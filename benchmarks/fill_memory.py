"""How much memory `infill fill` takes for parts of 100, 200 and 400 mm: ``python -m benchmarks.fill_memory``.

Upright voids of large parts are made slab by slab, so that the peak of the command does not grow with the height of a
part, and the grid is as fine. Parts are a box, of which most slabs are alike, and a cone, of which no two are. Each is
judged as `benchmarks.fill_parts` does. ``--patterns honeycomb`` and ``--shapes box`` for a first look.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable
from pathlib import Path

import trimesh

from benchmarks.fill_parts import SECONDS, Filled, faults, filled
from benchmarks.pairs import row
from infill import read_mesh

PATTERNS = ("honeycomb", "grid", "rectilinear", "concentric-heart")
HEIGHTS = (100, 200, 400)  # mm
SIDE = 60.0  # mm
GROWTH, COARSER = 1.1, 1.05  # over the lowest part


def box(height: float) -> trimesh.Trimesh:
    return trimesh.creation.box((SIDE, SIDE, height))


def cone(height: float) -> trimesh.Trimesh:
    """Return a cone that is cut off where it is two thirds as wide as at its bottom, and there as wide as the box."""
    profile = [(0, 0), (SIDE / 2, 0), (SIDE / 3, height), (0, height)]
    return trimesh.creation.revolve(profile, sections=96)


SHAPES: dict[str, Callable[[float], trimesh.Trimesh]] = {"box": box, "cone": cone}


def grown(found: Filled, lowest: Filled) -> list[str]:
    """Return in what a result is worse than that of the lowest part."""
    voxel, other = (each.report["grid"]["spacing"][0] for each in (found, lowest))
    wrong = {
        f"{found.peak / lowest.peak:.2f} times the memory": found.peak > GROWTH * lowest.peak,
        f"voxels of {voxel:.3f} mm, not {other:.3f}": voxel > COARSER * other,
    }
    return [text for text, holds in wrong.items() if holds]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--patterns", nargs="*", default=PATTERNS)
    parser.add_argument("--shapes", nargs="*", default=list(SHAPES))
    parser.add_argument("--density", type=float, default=0.2)
    given = parser.parse_args()
    bad = 0
    with tempfile.TemporaryDirectory(prefix="fill-memory-") as name:
        source = Path(name) / "part.stl"
        for shape in given.shapes:
            for pattern in given.patterns:
                lowest: Filled | None = None
                for height in HEIGHTS:
                    SHAPES[shape](height).export(source)
                    found = filled(source, pattern, given.density, Path(name))
                    lowest = lowest or found
                    wrong = [*grown(found, lowest), *faults(read_mesh(source), found, given.density)]
                    report = found.report
                    figure = (
                        f"{found.seconds:5.1f} s {found.peak:5.2f} GiB {report['grid']['spacing'][0]:.3f} mm "
                        f"{report['triangles'] / 1000:4.0f} k {report['density']:.1%}"
                    )
                    limit = "; ".join(wrong) or f"{GROWTH:g} times the memory, {SECONDS} s"
                    row(f"{shape} of {height} mm, {pattern}", figure, limit, holds=not wrong)
                    bad += bool(wrong)
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
