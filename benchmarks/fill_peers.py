"""`infill fill` beside what people do instead, on one part: ``python -m benchmarks.fill_peers``.

The command, files included, in turn with its peers: a lattice of marching cubes or cylinders cut and united with
trimesh and manifold3d, and one that microgen made (``--microgen PYTHON``, of an environment that has it), united so.
All get our cell and density, and bars our diameter. One judge reads the files: solid by manifold3d, the skin both ways
against the part's, the density and the least wall by points, loose pieces by their number. PrusaSlicer hollows for
resin printers as it slices, into pictures of layers: no mesh of it comes out, so its time alone stands here.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh

from benchmarks.fill_parts import FOLDER, LEAST, MEASURE, WALL, solids
from benchmarks.pairs import Run
from infill import Surface, check, read_mesh
from infill.meshes.distance import TriangleTree
from infill.meshes.winding import winding_numbers

DENSITY, POINTS = 0.2, 40_000
WITHIN = 200_000  # points in the box around the part: by chance, the density is off by a third of a percentage point
PEER = [sys.executable, "-m", "benchmarks.peers.lattice_boolean"]
HEAD = "| part, pattern, program | s | GiB | triangles | manifold | skin, mm | density | thinnest wall, mm | loose |"


@dataclass(frozen=True)
class Judged:
    """A result, judged by its file."""

    triangles: int
    manifold: str
    skin: float  # mm, the farthest either way
    density: float
    wall: float  # mm
    loose: int  # components that hang free


def judge(part: Surface, path: Path) -> Judged:
    """Return what a file holds, compared with the part."""
    solid, verdict = read_mesh(path), check(path)
    own, tree = TriangleTree.of(part), TriangleTree.of(solid)
    skin = trimesh.sample.sample_surface(part.to_trimesh(), POINTS, seed=1)[0]
    to_solid = tree.nearest(np.concatenate([part.vertices, skin]))[0].max()
    points = np.random.default_rng(2).uniform(*part.bounds, (WITHIN, 3))
    # What sticks out of the part: points of the result that lie outside it, by how far.
    stray = solid.vertices[winding_numbers(solid.vertices, part) <= 0]
    to_part = own.nearest(stray)[0].max() if len(stray) else 0.0
    inner = points[winding_numbers(points, part) > 0]
    away = own.nearest(inner)[0]
    filled = winding_numbers(inner, solid) > 0
    empty = away[(away <= WALL) & ~filled]
    return Judged(
        triangles=len(solid.faces),
        manifold=verdict.manifold if verdict.closed else "not closed",
        skin=float(max(to_solid, to_part)),
        density=float(filled[away > WALL].mean()),
        wall=float(empty.min(initial=WALL)),
        loose=solids(solid) - solids(part),
    )


def told(name: str, run: Run, found: Judged) -> None:
    """Print a row of the table."""
    cells = [
        name,
        f"{run.seconds:.1f}",
        f"{run.memory / 2**30:.2f}",
        f"{found.triangles:,}",
        found.manifold,
        f"{found.skin:.4f}",
        f"{found.density:.1%}",
        f"{found.wall:.2f}",
        str(found.loose),
    ]
    print(f"| {' | '.join(cells)} |", flush=True)


def measured(command: list[str]) -> Run:
    """Run a command below a small process, so that the memory is its own and not that of whoever judges."""
    done = subprocess.run([sys.executable, "-c", MEASURE, *command], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{command} ended with {done.returncode}: {done.stderr}")
    seconds, peak = map(float, done.stderr.split()[-2:])
    return Run(seconds=seconds, memory=int(peak * 1024))


def both(one: Run, other: Run) -> Run:
    """Return two runs, one after the other, as one."""
    return Run(seconds=one.seconds + other.seconds, memory=max(one.memory, other.memory))


def compared(path: Path, pattern: str, folder: Path, microgen: str | None) -> None:
    """Print the rows of one part and pattern."""
    part, name = read_mesh(path), f"{path.stem}, {pattern}"
    ours, theirs, inside, lattice = (folder / f"{each}.stl" for each in ("ours", "theirs", "inside", "lattice"))
    words = ["fill", str(path), "--pattern", pattern, "--density", f"{DENSITY}", "--wall", f"{WALL}", "-q", "--force"]
    command = [sys.executable, "-m", "infill", *words, "-o", str(ours)]
    measured(command)  # kernels are compiled
    told(f"{name}, infill fill", measured(command), judge(part, ours))
    done = subprocess.run([*command, "--json"], capture_output=True, text=True, check=True)
    sizes = json.loads(done.stdout)["infill"]
    common = [str(path), str(theirs), "--cell", str(sizes["cell"]), "--wall", str(WALL), "--density", str(DENSITY)]
    made = ["--lattice", pattern, *(["--diameter", str(sizes["line_width"])] if pattern == "octet" else [])]
    told(f"{name}, trimesh and manifold3d", measured([*PEER, *common, *made]), judge(part, theirs))
    if microgen and pattern == "gyroid":
        hollow = measured([*PEER, *common, "--inside", str(inside)])
        script = str(Path(__file__).parent / "peers" / "fill_microgen.py")
        run = both(
            hollow,
            measured([microgen, script, str(inside), str(lattice), str(sizes["cell"]), str(DENSITY), "20"]),
        )
        try:
            run = both(run, measured([*PEER, *common, "--lattice", str(lattice)]))
        except RuntimeError as error:
            said = str(error).strip().splitlines()[-2]
            print(f"| {name}, microgen | {run.seconds:.1f} | {run.memory / 2**30:.2f} | no union: {said} |")
        else:
            told(f"{name}, microgen", run, judge(part, theirs))
    prusa = shutil.which("prusa-slicer")
    if prusa and pattern == "gyroid":
        sla = [
            "--export-sla",
            "--hollowing-enable",
            f"--hollowing-min-thickness={WALL}",
            "--output",
            str(folder / "x.sl1"),
        ]
        run = measured([prusa, *sla, str(path)])
        print(f"| {name}, PrusaSlicer, hollowed layers | {run.seconds:.1f} | {run.memory / 2**30:.2f} | no mesh |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--parts", nargs="*", default=["bracket_medium", "spur_gear"])
    parser.add_argument("--patterns", nargs="*", default=["gyroid", "octet"])
    parser.add_argument("--microgen", help="a Python that has it")
    given = parser.parse_args()
    print(f"At {DENSITY:.0%} with walls of {WALL} mm, of which {LEAST} must stand.\n\n{HEAD}\n|{'---|' * 9}")
    with tempfile.TemporaryDirectory(prefix="fill-peers-") as name:
        for part in given.parts:
            for pattern in given.patterns:
                compared(next(FOLDER.glob(f"{part}.*")), pattern, Path(name), given.microgen)


if __name__ == "__main__":
    main()
