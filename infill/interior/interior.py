"""The inside of a part: how deep below its wall each cell of a grid lies."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.grid import Grid
from infill.interior.layer_stack import WHOLE, Layers, in_slabs
from infill.interior.opening import ENDS, Open, Opening, flat_sides, lengthened
from infill.machine import require_memory
from infill.meshes.solids import FINE, status, united
from infill.meshes.split_components import joined, parted
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.from_mesh import Repairs, Voxelised, grid_around, voxelise_reported
from infill.voxels.partial import distances_in_cells

BAND = 2.5  # cells on either side of the wall in which depths are exact
LEAST_OVERLAP = 1e-5  # of the volume: components that overlap by less are taken not to
MARGIN = 3  # cells of void around the part
OUT = 3.0  # cells by which voids reach out of an open side, at least
BEYOND = 1.0  # cells: how far voids that no wall is to be left around reach out of the part
UP = np.array([0.0, 0.0, 1.0])
TINY = 10.0  # mm: parts smaller than this may be meant in another unit
BYTES_PACKED = 3  # for each cell of a space in slabs: whether it is inside, and how deep, packed
BYTES_PER_CELL = 18  # a measured peak: depth, one void and its phase, and the bricks that are smoothed


@dataclass(frozen=True, kw_only=True, eq=False)
class Space:
    """What lies inside the walls of a part.

    Parameters
    ----------
    layers : Layers
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
    through : float
        By how many cells they do.
    opening : Opening or None
        Where the part has no wall: there, the depth goes on as if the part did.
    box_of : (Space, (3,) int) or None
        The space of which it is a box, and the first cell of that.
    """

    layers: Layers
    size: float
    origin: NDArray[np.float64]
    part: Surface
    repairs: Repairs
    skin: str
    overlap: float
    wall: float
    walled: Space | None = None
    through: float = 0.0
    opening: Opening | None = None
    box_of: tuple[Space, NDArray[np.int64]] | None = None

    @property
    def depth(self) -> NDArray[np.float32]:
        """That of all cells, (nx, ny, nz) in cells: of a space in slabs, a new array each time."""
        return self.layers.between(0, self.shape[2])

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells of the grid along each axis."""
        return self.layers.shape

    @property
    def shell(self) -> Surface:
        """The skin of the part that has a wall, mm."""
        return self.part if self.opening is None else self.opening.shell

    @cached_property
    def shares(self) -> NDArray[np.float64]:
        """Which share of each layer of the grid lies between the open sides of the part, (nz,)."""
        middle = self.origin[2] + self.size * np.arange(self.shape[2])
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

    def cells_in(self, field: NDArray[np.float32], *, first: int = 0) -> float:
        """Return how many cells lie in a void, by how deep they do, parts of cells counted as such.

        Parameters
        ----------
        field : (nx, ny, n) float32
        first : int
            The first of its layers.
        """
        shares = self.shares[first : first + field.shape[2]]
        return float(sum(np.clip(layer + 0.5, 0, 1).sum(axis=0, dtype=np.float64) @ shares for layer in field))

    @property
    def below_walls(self) -> NDArray[np.float32]:
        """How deep all cells lie below the walls, (nx, ny, nz) in cells, also where voids reach through these."""
        return self.depth - np.float32(self.through) if self.through else self.depth

    @cached_property
    def unwalled(self) -> Space:
        """The same, where voids reach through the wall and a little out of the part."""
        through = self.wall / self.size + BEYOND
        depth = self.depth + np.float32(through)
        return replace(self, layers=Layers.of(depth), wall=0.0, walled=self, through=through)

    @cached_property
    def deepest(self) -> NDArray[np.float32]:
        """How deep the deepest cell of each column lies, (nx, ny) in cells."""
        deepest: NDArray[np.float32] = np.maximum.reduce([slab.max(axis=2) for _, slab in self.layers.each()])
        return deepest

    @cached_property
    def cells(self) -> float:
        """How many cells lie inside the walls, parts of cells counted as such."""
        return sum(self.cells_in(slab, first=first) for first, slab in self.layers.each())

    @cached_property
    def across(self) -> float:
        """The second longest side of what lies inside the walls, mm: larger cells of a pattern are of no use."""
        used = [np.zeros(count, dtype=bool) for count in self.shape]
        for first, slab in self.layers.each():
            inside = (slab > 0) & (self.shares[first : first + slab.shape[2]] >= 0.5)
            used[0] |= inside.any(axis=(1, 2))
            used[1] |= inside.any(axis=(0, 2))
            used[2][first : first + slab.shape[2]] = inside.any(axis=(0, 1))
        sides = [np.flatnonzero(each) for each in used]
        return float(sorted(each[-1] + 1 - each[0] for each in sides)[1]) * self.size

    @cached_property
    def thickness(self) -> float:
        """How thick what lies inside the walls is, mm: as a plate with this volume and surface would be."""
        cells = 0.0
        for first, slab in self.layers.each():
            some = self.shares[first : first + slab.shape[2]] > 0
            # Weights add up to 1 across a plane wherever it lies between the cells.
            cells += sum(float(np.clip(1 - np.abs(layer[:, some]), 0, None).sum(dtype=np.float64)) for layer in slab)
        area = cells * self.size**2
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
    slabs: bool = False,
    threads: int | None = None,
    max_memory: int | None = None,
) -> Space:
    """Return the inside of a part, without a wall, mm, along all of its skin but for its open sides.

    Beyond these, the inside goes on for some way, `beyond`, mm. `held` bytes are needed for each cell besides.
    With `slabs`, a large space is kept in slabs.

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
    require_memory(_bytes(grid.shape, held, slabs=slabs), max_memory, advice)
    found = voxelise_reported(part, voxel=voxel, margin=MARGIN, max_memory=max_memory)
    whole, skin, overlap = _skin(found)
    longer, cells, opening, repairs = whole, found.volume, None, found.repairs
    del found  # so that the cells can go when their depths are known
    if open_ is not None:
        opening, lids = flat_sides(whole, open_)
        longer = lengthened(whole, lids, further / len(lids))
        cells = voxelise_reported(longer, voxel=voxel, margin=MARGIN, max_memory=max_memory).volume
    # Thin gaps between components count too, but not faces inside the solid.
    reach, several = wall / voxel + BAND, overlap > LEAST_OVERLAP

    def deep(some: Volume) -> NDArray[np.float32]:
        found = distances_in_cells(longer, some, reach, several=several, threads=threads)
        found -= np.float32(wall / voxel)
        return found

    origin = np.array(cells.origin) + voxel / 2
    if slabs and not several and cells.values.size > WHOLE:
        some = in_slabs(cells)
        del cells
        layers = Layers.packed(deep(each) for each in some)
    else:
        layers = Layers.of(deep(cells))
    if not any((slab > 0).any() for _, slab in layers.each()):
        raise GeometryError(nowhere)
    space = Space(
        layers=layers,
        size=voxel,
        origin=origin,
        part=whole,
        repairs=repairs,
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


def _bytes(shape: tuple[int, ...], held: int, *, slabs: bool) -> int:
    """Return what is needed for a grid, or for a slab of it and what is kept of all of it."""
    cells = math.prod(shape)
    if slabs and cells > WHOLE:
        return BYTES_PACKED * cells + BYTES_PER_CELL * WHOLE
    return (BYTES_PER_CELL + held) * cells


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
