"""Small designs that tests are run on, and comparisons that can fail (see test_shapes.py)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

import manifold3d
import numpy as np
from shapely import Point, Polygon, box

from patterns import (
    PATTERNS,
    ArchimedeanChords,
    Concentric,
    ConcentricHeart,
    Cross,
    Grid,
    Hilbert,
    Honeycomb,
    Octagons,
    OctagramSpiral,
    Pattern,
    Rectilinear,
    Triangles,
    TriHexagon,
    Voronoi,
    Zigzag,
    angle_parameter,
    cell_parameter,
    frame_parameter,
    parameter,
    phase_parameter,
)
from patterns.foam import VoronoiFoam
from patterns.hatch import CrossHatch
from patterns.linework import to_pattern_coordinates
from patterns.octree import Octree
from patterns.polyhedra import Polyhedra
from patterns.protocol import gives
from patterns.unit_cells import Bars, Network, Planes, Surfaces

DESIGNS: list[Pattern] = [
    Honeycomb(),
    Honeycomb(cell=4, angle=7, phase=(1.0, -0.5)),
    Honeycomb(frame=False),
    Zigzag(),
    Zigzag(waves=7.5),
    Zigzag(cell=5, angle=17, frame=False),
    ConcentricHeart(),
    ConcentricHeart(hearts=3, angle=23),
    ConcentricHeart(cell=5, frame=True),
    ConcentricHeart(cell=7, phase=(3.0, -2.0)),
    Rectilinear(),
    Grid(cell=5, angle=17, frame=False),
    Triangles(cell=8, phase=(1.0, -2.0)),
    TriHexagon(frame=False),
    Octagons(),
    Octagons(cell=9, angle=7, phase=(1.0, -0.5), frame=False),
    Hilbert(),
    Hilbert(cell=7, angle=31, phase=(1.0, -0.5), frame=False),
    Cross(),
    Cross(cell=3, angle=40, phase=(1.0, -0.5), frame=False),
    Concentric(),
    Concentric(cell=2.3, frame=False),
    ArchimedeanChords(),
    ArchimedeanChords(cell=4, angle=50, phase=(3.0, -2.0), frame=False),
    OctagramSpiral(),
    OctagramSpiral(cell=4, angle=11, phase=(3.0, -2.0), frame=False),
    Voronoi(),
    Voronoi(cell=8, seed=5, even=0, angle=23, frame=False),
]


@dataclass(frozen=True, kw_only=True)
class Ripples(Pattern):
    """A level set and nothing else, the same at every height: parallel sine waves, `cell` apart along y."""

    name: ClassVar[str] = "ripples"
    summary: ClassVar[str] = "parallel waves"

    cell: float = cell_parameter(5.0)
    swing: float = parameter(1.5, "how far a wave swings", low=0, high=10)
    period: float = parameter(20.0, "length of a wave", low=1, high=100)
    mirrored: bool = parameter(False, "waves the other way", unit="")
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def level_set(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
        x, y = to_pattern_coordinates(x, y, angle=self.angle, phase=self.phase)
        swing = -self.swing if self.mirrored else self.swing
        return np.sin(math.pi * (y - swing * np.sin(2 * math.pi * x / self.period)) / self.cell)

    def line_spacing(self, region: Any) -> float:
        return self.cell / math.hypot(1, 2 * math.pi * self.swing / self.period)


@dataclass(frozen=True, kw_only=True)
class SchwarzP(Pattern):
    """A level set that changes with height."""

    name: ClassVar[str] = "schwarz-p"
    summary: ClassVar[str] = "a surface without edges"
    prismatic: ClassVar[bool] = False

    cell: float = cell_parameter(12.0)

    def level_set(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
        k = 2 * math.pi / self.cell
        return np.cos(k * x) + np.cos(k * y) + np.cos(k * z)

    def line_spacing(self, region: Any) -> float:
        return self.cell / 2


LEVEL_SETS: list[Pattern] = [
    Ripples(),
    Ripples(frame=False, mirrored=True),
    Ripples(cell=7, angle=23, phase=(1.0, -2.0)),
]
BUILT_IN = [name for name in PATTERNS.built_in if PATTERNS[name].prismatic]
IN_SPACE = {name: PATTERNS[name]() for name in PATTERNS.built_in if name not in BUILT_IN}


def one_of_each_kind(names: Iterable[str]) -> list[str]:
    """Return the first pattern of each kind, by name: patterns of a kind have their voids from the same code.

    In space: surfaces, one side of them, planes, polyhedra, octrees, bars, and each pattern that is a kind of its own.
    Of lines: those with a level set, those that follow the part, and the others.
    """
    first: dict[object, str] = {}
    for name in names:
        pattern = IN_SPACE.get(name)
        kinds = (Network, CrossHatch, Surfaces, Planes, Polyhedra, Octree, VoronoiFoam, Bars)
        kind = next((kind for kind in kinds if isinstance(pattern, kind)), type(pattern))
        if pattern is None:
            kind = (PATTERNS[name].follows, gives(PATTERNS[name]))
        first.setdefault(kind, name)
    return list(first.values())


OF_THE_PAPER = ("honeycomb", "zigzag", "concentric-heart")  # walls a cell apart, or more, everywhere
REGIONS: list[Polygon] = [
    box(-30, -30, 30, 30),
    box(5, -10, 45, 20),
    Point(3, 4).buffer(20),
    Polygon([(0, 0), (40, 5), (30, 35), (15, 12), (2, 30)]),
]

# Ten sizes and cells beside the defaults: uneven, small, large, elongated.
SIZES: list[tuple[tuple[float, float], float]] = [
    ((40, 40), 4),
    ((60, 40), 5),
    ((30, 50), 3),
    ((80, 80), 8),
    ((25, 25), 2.5),
    ((100, 60), 10),
    ((61.3, 44.7), 5.7),
    ((33.3, 71.2), 6.3),
    ((20, 20), 1.8),
    ((45, 45), 7.77),
]


def as_manifold(mesh: Any) -> manifold3d.Manifold:
    return manifold3d.Manifold(
        manifold3d.Mesh(
            vert_properties=np.asarray(mesh.vertices, dtype=np.float32),
            tri_verts=np.asarray(mesh.faces, dtype=np.uint32),
        )
    )


def assert_printable(mesh: Any) -> None:
    """The strongest thing to say of a trimesh: closed, consistent, outward, and a solid for manifold3d."""
    assert mesh.is_volume
    assert mesh.volume > 0
    assert as_manifold(mesh).status() == manifold3d.Error.NoError


def smooth_noise(rng: np.random.Generator, shape: tuple[int, ...], passes: int = 3) -> np.ndarray:
    """Random grey data in [-1, 1] whose features are a few cells across."""
    field = rng.uniform(-1, 1, shape)
    for _ in range(passes):
        for axis in range(field.ndim):
            field = (np.roll(field, 1, axis) + field + np.roll(field, -1, axis)) / 3
    return field / np.abs(field).max()
