"""The inside of a part: how deep below its wall each cell of a grid lies."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.filling.solids.opening import ENDS, Open, Opening, flat_sides, lengthened
from infill.grid import Grid
from infill.machine import require_memory
from infill.surface import Surface
from infill.surfaces.parting import joined, parted
from infill.surfaces.solids import FINE, status, united
from infill.voxels.from_mesh import Repairs, Voxelised, grid_around, voxelise_reported
from infill.voxels.partial import distances_in_cells

BAND = 2.5  # cells on either side of the wall in which depths are exact
LEAST_OVERLAP = 1e-5  # of the volume: components that overlap by less are taken not to
MARGIN = 3  # cells of void around the part
OUT = 3.0  # cells by which voids reach out of an open side, at least
BEYOND = 1.0  # cells: how far voids that no wall is to be left around reach out of the part
UP = np.array([0.0, 0.0, 1.0])
TINY = 10.0  # mm: parts smaller than this may be meant in another unit
BYTES_PER_CELL = 18  # a measured peak: depth, one void and its phase, and the bricks that are smoothed


@dataclass(frozen=True, kw_only=True, eq=False)
class Space:
    """What lies inside the walls of a part.

    Parameters
    ----------
    depth : (nx, ny, nz) float32
        How deep the centre of each cell lies below the inner side of the wall, in cells; cut off deep inside.
    size : float
        Of a cell, mm.
    origin : (3,) float64
        The centre of cell (0, 0, 0), mm.
    part : Surface, mm
        The part as it was taken: as it was given, if that is closed, faces outwards, and no two components overlap.
    repairs : Repairs
        What had to be assumed.
    skin : {"as given", "turned", "closed", "parted", "united"}
        What was done to the mesh to have a part: faces turned, holes closed, components that touch taken apart, or
        united where they overlap; the last of these that was.
    overlap : float
        Share of the volume that components of `part` still enclose twice.
    wall : float
        mm
    walled : Space or None
        What lies inside the walls, if voids reach through them here.
    opening : Opening or None
        Where the part has no wall: there, `depth` goes on as if the part did.
    box_of : (Space, (3,) int) or None
        The space of which it is a box, and the first cell of that.
    """

    depth: NDArray[np.float32]
    size: float
    origin: NDArray[np.float64]
    part: Surface
    repairs: Repairs
    skin: str
    overlap: float
    wall: float
    walled: Space | None = None
    opening: Opening | None = None
    box_of: tuple[Space, NDArray[np.int64]] | None = None

    @property
    def shell(self) -> Surface:
        """The skin of the part that has a wall, mm."""
        return self.part if self.opening is None else self.opening.shell

    @cached_property
    def shares(self) -> NDArray[np.float64]:
        """Which share of each layer of the grid lies between the open sides of the part, (nz,)."""
        middle = self.origin[2] + self.size * np.arange(self.depth.shape[2])
        if self.opening is None:
            return np.ones(len(middle))
        ends = np.array([[self.opening.low], [self.opening.high]])
        low, high = np.clip((ends - middle) / self.size, -0.5, 0.5)
        shares: NDArray[np.float64] = high - low
        return shares

    @property
    def within(self) -> NDArray[np.bool_]:
        """Which cells lie inside the walls, and between the open sides: those whose centre does."""
        return (self.depth > 0) & (self.shares >= 0.5)

    def reaches(self, end: str) -> bool:
        """Return whether there is room inside the walls at an end, top or bottom, of the part."""
        layers = np.flatnonzero(self.shares > 0)
        return bool((self.depth[:, :, layers[-1 if end == "top" else 0]] > 0).any())

    def cells_in(self, field: NDArray[np.float32]) -> float:
        """Return how many cells lie in a void, by how deep they do, parts of cells counted as such."""
        return float(sum(np.clip(layer + 0.5, 0, 1).sum(axis=0, dtype=np.float64) @ self.shares for layer in field))

    @cached_property
    def unwalled(self) -> Space:
        """The same, where voids reach through the wall and a little out of the part."""
        return replace(self, depth=self.depth + np.float32(self.wall / self.size + BEYOND), wall=0.0, walled=self)

    @cached_property
    def cells(self) -> float:
        """How many cells lie inside the walls, parts of cells counted as such."""
        return self.cells_in(self.depth)

    @cached_property
    def across(self) -> float:
        """The second longest side of what lies inside the walls, mm: larger cells of a pattern are of no use."""
        inside = self.within
        sides = [np.flatnonzero(inside.any(axis=tuple({0, 1, 2} - {axis}))) for axis in range(3)]
        return float(sorted(each[-1] + 1 - each[0] for each in sides)[1]) * self.size

    @cached_property
    def thickness(self) -> float:
        """How thick what lies inside the walls is, mm: as a plate with this volume and surface would be."""
        some = self.shares > 0
        area = sum(int((np.abs(layer[:, some]) < 0.5).sum()) for layer in self.depth) * self.size**2
        return 2 * self.volume / max(area, self.size**2)

    @property
    def volume(self) -> float:
        """What lies inside the walls, mm³."""
        return self.cells * self.size**3


def space_inside(
    part: Surface,
    *,
    wall: float,
    voxel: float,
    open_: Open | None = None,
    beyond: float = 0.0,
    held: int = 0,
    threads: int | None = None,
    max_memory: int | None = None,
) -> Space:
    """Return the inside of a part, without a wall, mm, along all of its skin but for its open sides.

    Beyond these, the inside goes on for some way, `beyond`, mm. `held` bytes are needed for each cell besides.

    Raises
    ------
    GeometryError
        If the part encloses nothing, is nowhere thicker than two walls, or has no flat side to be open at.
    MemoryLimitError
        If the grid does not fit into memory.
    """
    extents = np.ptp(part.bounds, axis=0)
    further = further_for(open_, wall, beyond, voxel)
    sides = " x ".join(f"{side:.3g}" for side in extents)
    nowhere = (
        f"wall is {wall:g} mm, and the part, {sides} mm, is nowhere thicker than two of those; "
        f"give a thinner wall{', or the right unit' if extents.max() < TINY else ''}"
    )
    # Seen before anything is measured, however long that would take; a flat sheet has a message of its own.
    if extents.min() > 0 and (extents + further * UP).min() <= 2 * wall:
        raise GeometryError(nowhere)
    grid = grid_of(part, voxel=voxel, further=further)
    advice = f"the grid has {' x '.join(map(str, grid.shape))} cells; give larger voxels or larger cells"
    require_memory((BYTES_PER_CELL + held) * math.prod(grid.shape), max_memory, advice)
    found = voxelise_reported(part, voxel=voxel, margin=MARGIN, max_memory=max_memory)
    whole, skin, overlap = _skin(found)
    longer, cells, opening = whole, found.volume, None
    if open_ is not None:
        opening, lids = flat_sides(whole, open_)
        longer = lengthened(whole, lids, further / len(lids))
        cells = voxelise_reported(longer, voxel=voxel, margin=MARGIN, max_memory=max_memory).volume
    # Thin gaps between components count too, but not faces inside the solid.
    reach, several = wall / voxel + BAND, overlap > LEAST_OVERLAP
    depth = distances_in_cells(longer, cells, reach, several=several, threads=threads)
    depth -= np.float32(wall / voxel)
    if not (depth > 0).any():
        raise GeometryError(nowhere)
    space = Space(
        depth=depth,
        size=voxel,
        origin=np.array(cells.origin) + voxel / 2,
        part=whole,
        repairs=found.repairs,
        skin=skin,
        overlap=overlap,
        wall=wall,
        opening=opening,
    )
    for end in () if open_ is None else ENDS[open_]:
        if not space.reaches(end):
            raise GeometryError(
                f"open is {open_!r}, and the flat {end} of the part is nowhere wider than two walls of {wall:g} mm; "
                "give a thinner wall, or turn the part"
            )
    return space


def further_for(open_: Open | None, wall: float, beyond: float, voxel: float) -> float:
    """Return how much longer, mm, a part is made for its open sides: by a wall, and so much that it does not matter."""
    return 0.0 if open_ is None else len(ENDS[open_]) * (wall + beyond + OUT * voxel)


def grid_of(part: Surface, *, voxel: float, further: float) -> Grid:
    """Return about the grid that a part is filled on, which reaches so much further up or down, mm."""
    return grid_around(
        Surface(vertices=np.concatenate([part.bounds, part.bounds[1:] + further * UP]), faces=np.array([[0, 1, 2]])),
        voxel=voxel,
        margin=MARGIN,
    )


def _skin(found: Voxelised) -> tuple[Surface, str, float]:
    """Return the part facing outwards, without overlaps if possible, what was done to it, and what still overlaps."""
    mesh, held = found.closed, found.enclosed
    skin = "closed" if found.repairs.holes else "as given"
    if (turned := held.sign < 0).any():
        faces = np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces)
        mesh, skin = Surface(vertices=mesh.vertices, faces=faces), "turned" if skin == "as given" else skin
    overlap = float(held.excess.sum() / held.total)
    verdict = status(mesh)
    if mesh.closed and verdict == FINE and overlap <= LEAST_OVERLAP:
        return mesh, skin, 0.0
    parts = parted(mesh, float(found.volume.cell_size[0])).surfaces
    if overlap > LEAST_OVERLAP and (whole := united(parts)) is not None:
        # The union counts what parts enclose together once, as the exact volume does.
        mesh, verdict, skin, overlap = whole, FINE, "united", abs(1 - held.total / whole.volume)
    elif parts and (apart := joined(list(parts))).closed:
        mesh, verdict, skin = apart, status(apart), "parted"
    if verdict != FINE:
        raise GeometryError(
            f"the mesh of {len(mesh.faces):,} triangles is no solid, even with its holes closed ({verdict}, says "
            "manifold3d); make one of it first: 'infill smooth' does"
        )
    return mesh, skin, overlap
