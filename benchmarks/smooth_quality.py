"""How near smoothed voxels come to the true surface: ``python -m benchmarks.smooth_quality --cases sphere,rbox``.

Shapes with a known surface are turned into voxels of -1 and +1, smoothed by us and by other software at the
settings it recommends, and compared. All lengths are in cells. Half a minute to two minutes a case.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from benchmarks.peers.meshers import (
    Field,
    gaussian,
    level_set,
    majority_sinc,
    relaxed,
    surface_nets,
    windowed_sinc,
)
from benchmarks.solids import Shape, ellipsoid, gyroid, honeycomb, rbox, sphere, torus
from infill import Smoothing
from infill.isosurfaces.components import data_bits, find_components
from infill.isosurfaces.levels import straighten_profile, surface_at_volume
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import smooth_bricks
from infill.surface import Surface

CASES = {build.__name__: (build, 0.0) for build in (sphere, ellipsoid, torus, rbox, gyroid, honeycomb)}
CASES |= {f"sphere_noise{percent}": (sphere, percent / 100) for percent in (10, 20, 30, 40)}


def ours(f: Field, steps: int, level: str, *, refine: bool = False) -> Surface:
    """Return the scheme of the paper, or the refined one, at level 0 or at the level of the voxels' volume."""
    field = (refine_bricks if refine else smooth_bricks)(f > 0, Smoothing(steps=steps))
    cells, half = (1.0, 1.0, 1.0), tuple(n / 2 for n in f.shape)
    if level == "0":
        surface = extract_bricks(field, spacing=cells)
    else:
        solid = find_components(field, data_bits(field))
        straight = field if refine else straighten_profile(field)
        found = surface_at_volume(straight, solid, spacing=cells, targets=solid.cells.astype(np.float64))
        surface = extract_bricks(
            straight, spacing=cells, level=found.common
        )  # specks of noise get no level of their own
    return Surface(vertices=surface.vertices - half, faces=surface.faces)


SINC = ((15, 0.001), (50, 0.02), (100, 0.003))
METHODS: dict[str, Callable[[Field], Surface]] = {
    **{f"ours, {n} steps, level {c}": partial(ours, steps=n, level=c) for n in (10, 20) for c in ("0", "volume")},
    "ours, 20 steps refined": partial(ours, steps=20, level="volume", refine=True),
    **{f"VTK windowed sinc {n}/{b:g}": partial(windowed_sinc, passes=n, band=b) for n, b in SINC},
    "VTK surface nets 16": surface_nets,
    "SimpleITK AntiAliasBinary": partial(level_set, which="itk"),
    "PyMCubes smooth": partial(level_set, which="mcubes"),
    **{f"SciPy Gaussian {sigma:g}": partial(gaussian, sigma=sigma) for sigma in (1, 1.5, 2.5)},
    "majority + windowed sinc": partial(majority_sinc, passes=100, band=0.003),
    "trimesh Taubin": partial(relaxed, which="taubin"),
    "trimesh Humphrey": partial(relaxed, which="humphrey"),
    "trimesh Humphrey 30, alpha 0": partial(relaxed, which="humphrey", alpha=0.0, beta=0.5, iterations=30),
}
SLOW, NOISY = {"PyMCubes smooth"}, {"SciPy Gaussian 2.5", "majority + windowed sinc"}


@dataclass(frozen=True, kw_only=True)
class Quality:
    """What is measured; distances from the vertices, in cells; the angle is weighted by area, in degrees."""

    rms: float
    mean: float
    largest: float
    normal: float
    volume: float
    euler: int
    parts: int
    seconds: float


def measured(surface: Surface, shape: Shape, volume: float, seconds: float, *, samples: int | None = None) -> Quality:
    """Return the quality of a surface of `shape`, whose true volume is `volume`.

    Distances and normals are those of all vertices and faces, or of about `samples` of them, evenly spread.
    """
    used, faces = np.unique(surface.faces, return_inverse=True)
    vertices, faces = surface.vertices[used].astype(np.float64), faces.reshape(-1, 3)
    every = max(1, len(vertices) // samples) if samples else 1
    distance, _ = shape.foot(vertices[::every])
    a, b, c = (vertices[faces[::every, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    doubled = np.linalg.norm(across, axis=1)
    _, normal = shape.foot((a + b + c) / 3)
    cosine = (across * normal).sum(axis=1) / np.maximum(doubled, 1e-30)
    links = coo_array((np.ones(len(faces) * 2), (faces[:, [0, 0]].ravel(), faces[:, [1, 2]].ravel())))
    links.resize(len(vertices), len(vertices))
    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)) @ [len(vertices), 1]).size
    angle = np.degrees(np.arccos(np.clip(cosine, -1, 1))) @ doubled / doubled.sum()
    return Quality(
        rms=np.sqrt((distance**2).mean()),
        mean=np.abs(distance).mean(),
        largest=np.abs(distance).max(),
        normal=angle,
        volume=100 * (surface.volume / volume - 1),
        euler=len(vertices) - edges + len(faces),
        parts=connected_components(links, directed=False)[0],
        seconds=seconds,
    )


def main() -> None:
    """Print one table a case, and who comes nearest."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", default=",".join(CASES), help="names with commas between (default: all)")
    parser.add_argument("--slow", action="store_true", help="also what takes longer than ten seconds")
    options = parser.parse_args()
    cases = options.cases.split(",")
    if unknown := [case for case in cases if case not in CASES]:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(CASES)}")
    for case in cases:
        build, noise = CASES[case]
        shape = build()
        f = shape.voxels(noise)
        volume = shape.volume or float((f > 0).sum())
        names = [n for n in METHODS if (n not in SLOW or options.slow) and (n not in NOISY or noise)]
        print(f"\n{case}\n{'':32s}     rms    max  normal   volume   Euler  parts    CPU")
        found: dict[str, Quality] = {}
        for name in names:
            begin = time.process_time()
            try:
                surface = METHODS[name](f)
            except ModuleNotFoundError as error:
                print(f"{name:32s}skipped: {error.name} is not installed")
                continue
            found[name] = q = measured(surface, shape, volume, time.process_time() - begin)
            line = f"{q.rms:8.3f}{q.largest:7.2f}{q.normal:7.2f}°{q.volume:+8.3f}%{q.euler:8d}{q.parts:7d}"
            print(f"{name:32s}{line}{q.seconds:6.1f}s", flush=True)
        verdict({name: q for name, q in found.items() if (q.euler, q.parts) == (shape.euler, 1)})


def verdict(found: dict[str, Quality]) -> None:
    """Print who of those with the right topology wins in distance and in normals, and by how much."""
    for what in ("rms", "normal"):
        ranked = sorted((getattr(q, what), name) for name, q in found.items())
        mine, theirs = ([r for r in ranked if r[1].startswith("ours") is own][:1] for own in (True, False))
        if mine and theirs:
            (us, our), (them, their) = mine[0], theirs[0]
            print(f"  {what}: ours {'wins' if us < them else 'loses'}, {us / them:.2f} x: {our} against {their}")


if __name__ == "__main__":
    main()
