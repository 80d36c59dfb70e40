"""Meshes with a known truth, in cells of one: what smoothing must keep, and what it may not lose untold."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
import trimesh
from numpy.typing import NDArray
from trimesh import creation, transformations


@dataclass(frozen=True)
class Made:
    """A mesh, its volume, and how thick its thinnest wall is, in cells."""

    mesh: trimesh.Trimesh
    volume: float
    thick: float


def box(x: float, y: float, z: float, at: tuple[float, float, float] = (0, 0, 0)) -> trimesh.Trimesh:
    mesh = creation.box((x, y, z))
    mesh.apply_translation(at)
    return mesh


def rod(radius: float, height: float, at: tuple[float, float, float] = (0, 0, 0)) -> trimesh.Trimesh:
    mesh = creation.cylinder(radius=radius, height=height, sections=48)
    mesh.apply_translation(at)
    return mesh


def ball(radius: float, subdivisions: int = 4) -> trimesh.Trimesh:
    return creation.icosphere(subdivisions=subdivisions, radius=radius)


def less(one: trimesh.Trimesh, *others: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.boolean.difference([one, *others], engine="manifold")


def union(*parts: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.boolean.union(list(parts), engine="manifold")


def together(*parts: trimesh.Trimesh) -> trimesh.Trimesh:
    """As they are: they may overlap."""
    return trimesh.util.concatenate(list(parts))


def turned(mesh: trimesh.Trimesh, rng: np.random.Generator) -> trimesh.Trimesh:
    mesh = mesh.copy()
    mesh.apply_transform(transformations.random_rotation_matrix(rng.random(3)))
    return mesh


def plate_with_holes(thick: float, across: float) -> trimesh.Trimesh:
    holes = [rod(across / 2, 20, (x, y, 0)) for x in (-12, 0, 12) for y in (-8, 8)]
    return less(box(40, 30, thick), *holes)


def bowl(thick: float) -> trimesh.Trimesh:
    """A curved sheet."""
    return less(ball(25), ball(25 - thick), box(100, 100, 50, (0, 0, -30)))


def flange() -> trimesh.Trimesh:
    """A disc with a hub, a bore and ten holes for bolts of 3.2 cells."""
    bolts = [rod(1.6, 40, (15 * np.cos(a), 15 * np.sin(a), 0)) for a in np.arange(10) * np.pi / 5]
    return less(union(rod(20, 4), rod(8, 16, (0, 0, 6))), rod(4, 60), *bolts)


def slits(wide: float) -> trimesh.Trimesh:
    return less(box(60, 20, 12), *[box(wide, 12, 30, (x, 0, 0)) for x in np.linspace(-26, 26, 11)])


def comb(wide: float) -> trimesh.Trimesh:
    return union(box(50, 6, 8, (0, -10, 0)), *[box(wide, 20, 8, (x, 2, 0)) for x in np.linspace(-23, 23, 9)])


def nested() -> trimesh.Trimesh:
    """A ball in a hollow ball, hollow itself."""
    shells = [ball(radius, 3) for radius in (22, 18, 13, 9)]
    for shell in shells[1::2]:
        shell.invert()
    return together(*shells)


def gear() -> trimesh.Trimesh:
    radius, angle = np.where(np.arange(48) % 4 < 2, 20.0, 24.0), np.arange(48) * np.pi / 24
    return creation.extrude_polygon(shapely.Polygon(np.c_[radius * np.cos(angle), radius * np.sin(angle)]), 8)


def blade(degrees: float) -> trimesh.Trimesh:
    corners = [(0, 0), (40, 0), (40, 40 * np.tan(np.radians(degrees)))]
    return creation.extrude_polygon(shapely.Polygon(corners), 30)


def wing(thick: float) -> trimesh.Trimesh:
    """A curved plate with eight holes in it, like the wing of a pelvis."""
    holes = [rod(2, 80, (9 * np.cos(a), 9 * np.sin(a), 0)) for a in np.arange(8) * np.pi / 4]
    return less(bowl(thick), *holes)


def spiked() -> trimesh.Trimesh:
    """A block with eight spikes, thinner than a cell near their tips."""
    spikes = [creation.cone(radius=0.6, height=14, sections=12) for _ in range(8)]
    for number, spike in enumerate(spikes):
        spike.apply_translation((6 * number - 21, 0, 3.5))
    return union(box(50, 6, 8), *spikes)


def vessels(side: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Distances from fourteen straight vessels of one to three cells across, below 0 inside, at cells of a cube."""
    places = np.indices((side,) * 3).reshape(3, -1).T
    distance = np.full(len(places), np.inf)
    for _ in range(14):
        start, end = rng.uniform(4, side - 4, (2, 3))
        along = np.clip((places - start) @ (end - start) / ((end - start) ** 2).sum(), 0, 1)
        off = np.linalg.norm(places - start - along[:, None] * (end - start), axis=1)
        distance = np.minimum(distance, off - rng.choice((0.6, 1.0, 1.5)))
    return distance.reshape((side,) * 3)


def speckled(solid: NDArray[np.bool_], share: float, rng: np.random.Generator) -> NDArray[np.bool_]:
    """Flip a share of the cells at random."""
    return solid ^ (rng.random(solid.shape) < share)


def bust() -> tuple[trimesh.Trimesh, float]:
    """A ball without its foot, open below; and the volume under a flat cap."""
    return ball(20).slice_plane([0, 0, -10], [0, 0, 1]), less(ball(20), box(60, 60, 40, (0, 0, -30))).volume


def every_shape() -> Iterator[tuple[str, Made]]:
    """A hundred shapes by name, shifted against the grid at random, and most of them turned."""
    rng = np.random.default_rng(7)

    def made(
        name: str, mesh: trimesh.Trimesh, thick: float = 2, *, volume: float | None = None, turn: bool = True
    ) -> tuple[str, Made]:
        mesh = turned(mesh, rng) if turn else mesh
        mesh.apply_translation(rng.uniform(-2, 2, 3))
        return name, Made(mesh, mesh.volume if volume is None else volume, thick)

    for size in (20, 40, 60):
        for n in range(8):
            yield made(f"box of {size}, {n}", box(*rng.uniform(0.4 * size, size, 3)), 0.4 * size, turn=n > 3)
    for thick in (0.7, 0.85, 1.0, 1.3, 1.7, 2.0, 2.5, 3.0, 4.0):
        for turn in (False, True):
            yield made(f"plate {thick}{', turned' * turn}", box(50, 40, thick), thick, turn=turn)
    for n, thick in enumerate((1.0, 1.5, 2.0, 3.0, 4.0)):
        for across in (1.5, 2.5, 5.0):
            yield made(f"plate {thick} with holes {across}", plate_with_holes(thick, across), thick, turn=n % 2 == 0)
    for thick in (1.5, 2.0, 3.0):
        yield made(f"bowl {thick}", bowl(thick), thick)
    for n in range(3):
        yield made(f"flange {n}", flange(), 2.4, turn=n > 0)
        yield made(f"gear {n}", gear(), 2.6, turn=n > 0)
    for wide in (1.0, 1.5, 2.0, 3.0):
        yield made(f"slits {wide}", slits(wide), 2.5)
        yield made(f"comb {wide}", comb(wide), wide)
    for n in range(2):
        yield made(f"nested {n}", nested(), 4)
    for n in range(5):
        one, other = box(30, 24, 16), turned(box(18, 27, 16), rng)
        other.apply_translation(rng.uniform(-9, 9, 3))
        yield made(f"overlapping {n}", together(one, other), 10, volume=union(one, other).volume)
    for n in range(3):
        one, other = box(10, 10, 10), box(10, 14, 12, (10, 0, 0))
        yield made(f"touching {n}", together(one, other), 10, volume=one.volume + other.volume)
    for n in range(3):
        mesh, volume = bust()
        yield made(f"bust {n}", mesh, 10, volume=volume, turn=n > 0)
    for degrees in (5, 10, 20, 30):
        yield made(f"blade {degrees}", blade(degrees), 2.5)
    for n in range(9):
        parts = [box(*rng.uniform(6, 25, 3), tuple(rng.uniform(-8, 8, 3))) for _ in range(3)]
        yield made(f"union of boxes {n}", union(*parts), 1)
