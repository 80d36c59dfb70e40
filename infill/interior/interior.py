"""The inside of a part: the depth of each cell of a grid below the wall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.grid import Grid
from infill.interior.layer_stack import WHOLE, LayerStack, split_into_slabs
from infill.interior.local_walls import LocalWall, subtract_walls
from infill.interior.opening import ENDS, Open, Opening, extend_ends, find_flat_ends
from infill.machine import require_memory
from infill.meshes.solids import FINE, manifold_status, unite
from infill.meshes.split_components import concatenate_surfaces, split_components
from infill.plain_numbers import plain_argument, plain_size
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.from_mesh import MeshRepairs, VoxelisedMesh, grid_around, voxelise_with_report
from infill.voxels.partial import distances_in_cells

BAND = 2.5  # cells on either side of the wall in which depths are exact
LEAST_OVERLAP = 1e-5  # of the volume: a smaller overlap of components counts as none
MARGIN = 3  # cells of void around the part
OUT = 3.0  # cells by which voids reach out of an open side, at least
BEYOND = 1.0  # cells by which voids reach out of the part, where no wall remains around them
UP = np.array([0.0, 0.0, 1.0])
PRINTED = (10.0, 1000.0)  # mm: longest sides of parts that are printed
TINY = 10.0  # mm: parts smaller than this may be meant in another unit
BYTES_PACKED = 3  # for each cell of a space in slabs: a bit for the inside, and the packed depth
BYTES_PER_CELL = 18  # a measured peak: depth, one void and its phase, and the bricks in smoothing


@dataclass(frozen=True, kw_only=True, eq=False)
class Interior:
    """The space inside the walls of a part.

    Parameters
    ----------
    layers : LayerStack
        Depth of the centre of each cell below the inner side of the wall, in cells; cut off deep inside.
    size : float
        Of a cell, mm.
    origin : (3,) float64
        The centre of cell (0, 0, 0), mm.
    part : Surface, mm
        The part after repairs: the original, if it is closed, faces outwards, and no components overlap.
    repairs : MeshRepairs
        Assumptions about the mesh.
    skin : {"as given", "turned", "closed", "parted", "united"}
        The last repair of the mesh: faces turned, holes closed, components that touch taken apart, or components that
        overlap united.
    overlap : float
        Share of the volume that components of `part` enclose twice, after repairs.
    wall : float
        mm; the thickest one, if places have others.
    walled : Interior or None
        The space inside the walls, if voids reach through them here.
    through : float
        Number of cells by which they do.
    opening : Opening or None
        Sides where the part has no wall: the depth there is that of a part that goes on.
    outside : float
        Number of cells by which voids that reach through the walls come out of the part.
    """

    layers: LayerStack
    size: float
    origin: NDArray[np.float64]
    part: Surface
    repairs: MeshRepairs
    skin: str
    overlap: float
    wall: float
    walled: Interior | None = None
    through: float = 0.0
    opening: Opening | None = None
    outside: float = BEYOND

    @property
    def depth(self) -> NDArray[np.float32]:
        """Depths of all cells, (nx, ny, nz) in cells: a new array at each access if the space is in slabs."""
        return self.layers.read_layers(0, self.shape[2])

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells of the grid along each axis."""
        return self.layers.shape

    @cached_property
    def layer_shares(self) -> NDArray[np.float64]:
        """Share of each layer of the grid that lies between the open sides of the part, (nz,)."""
        middle = self.origin[2] + self.size * np.arange(self.shape[2])
        if self.opening is None:
            return np.ones(len(middle))
        ends = np.array([[self.opening.low], [self.opening.high]])
        low, high = np.clip((ends - middle) / self.size, -0.5, 0.5)
        shares: NDArray[np.float64] = high - low
        return shares

    def cells_in(self, field: NDArray[np.float32], *, first: int = 0) -> float:
        """Count the cells in a void from its field, parts of cells counted as such.

        Parameters
        ----------
        field : (nx, ny, n) float32
        first : int
            The number of its first layer in the grid.
        """
        shares = self.layer_shares[first : first + field.shape[2]]
        return float(sum(np.clip(layer + 0.5, 0, 1).sum(axis=0, dtype=np.float64) @ shares for layer in field))

    @property
    def below_walls(self) -> NDArray[np.float32]:
        """Depths below the walls, (nx, ny, nz) in cells: `depth`, less what lets voids reach through the walls."""
        return self.depth - np.float32(self.through) if self.through else self.depth

    @cached_property
    def through_walls(self) -> Interior:
        """The same space, where voids reach through the wall and out of the part."""
        through = self.wall / self.size + self.outside
        depth = self.depth + np.float32(through)
        return replace(self, layers=LayerStack.of(depth), wall=0.0, walled=self, through=through)

    @cached_property
    def column_depths(self) -> NDArray[np.float32]:
        """Depth of the deepest cell of each column, (nx, ny) in cells."""
        deepest: NDArray[np.float32] = np.maximum.reduce([slab.max(axis=2) for _, slab in self.layers.read_slabs()])
        return deepest

    @cached_property
    def cells(self) -> float:
        """Number of cells inside the walls, parts of cells counted as such."""
        return sum(self.cells_in(slab, first=first) for first, slab in self.layers.read_slabs())

    @cached_property
    def second_longest_side(self) -> float:
        """The second longest side of the space inside the walls, mm; larger cells of a pattern are of no use."""
        used = [np.zeros(count, dtype=bool) for count in self.shape]
        for first, slab in self.layers.read_slabs():
            inside = (slab > 0) & (self.layer_shares[first : first + slab.shape[2]] >= 0.5)
            used[0] |= inside.any(axis=(1, 2))
            used[1] |= inside.any(axis=(0, 2))
            used[2][first : first + slab.shape[2]] = inside.any(axis=(0, 1))
        sides = [np.flatnonzero(axis) for axis in used]
        return float(sorted(side[-1] + 1 - side[0] for side in sides)[1]) * self.size

    @cached_property
    def thickness(self) -> float:
        """Thickness of the space inside the walls, mm: that of a plate with this volume and surface."""
        cells = 0.0
        for first, slab in self.layers.read_slabs():
            between_ends = self.layer_shares[first : first + slab.shape[2]] > 0
            # Across a plane, weights add up to 1 wherever it lies between the cells.
            cells += sum(
                float(np.clip(1 - np.abs(layer[:, between_ends]), 0, None).sum(dtype=np.float64)) for layer in slab
            )
        area = cells * self.size**2
        return 2 * self.volume / max(area, self.size**2)

    @property
    def volume(self) -> float:
        """Volume inside the walls, mm³."""
        return self.cells * self.size**3


def compute_interior(
    part: Surface,
    *,
    wall: float,
    voxel: float,
    places: Sequence[LocalWall] = (),
    open_: Open | None = None,
    beyond: float = 0.0,
    extra_bytes_per_cell: int = 0,
    slabs: bool = False,
    threads: int | None = None,
    max_memory: int | None = None,
) -> Interior:
    """Compute the inside of a part, without a wall, mm, along all of its skin except its open sides.

    In `places`, the wall has another thickness; where they overlap, that of the last one. Beyond open sides, the inside
    goes on for `beyond`, mm; where the wall is 0, voids may reach as far out of all the skin.
    `extra_bytes_per_cell` adds to the memory that is needed. With `slabs`, a large space is kept in slabs.

    Raises
    ------
    GeometryError
        If the part encloses nothing, is nowhere thicker than two walls, or has no flat side to be open at.
    MemoryLimitError
        If the grid does not fit into memory.
    """
    extents = np.ptp(part.bounds, axis=0)
    thinnest, thickest = (choose((wall, *(place.wall for place in places))) for choose in (min, max))
    further = added_length(open_, thickest, beyond, voxel)
    nowhere = describe_no_room(part, thinnest)
    # Checked first, as measuring may take long; a flat sheet has a separate message.
    if extents.min() > 0 and (extents + further * UP).min() <= 2 * thinnest:
        raise GeometryError.about("wall", nowhere)
    outside = BEYOND if thinnest else BEYOND + beyond / voxel
    margin = MARGIN + math.ceil(outside - BEYOND)
    grid = grid_for_part(part, voxel=voxel, further=further, margin=margin)
    advice = f"the grid has {' x '.join(map(str, grid.shape))} cells; give larger voxels or larger cells"
    require_memory(expected_bytes(grid.shape, extra_bytes_per_cell, slabs=slabs), max_memory, advice)
    voxelised = voxelise_with_report(part, voxel=voxel, margin=margin, max_memory=max_memory)
    closed_part, skin, overlap = _repair_skin(voxelised)
    longer, cells, opening, repairs = closed_part, voxelised.volume, None, voxelised.repairs
    del voxelised  # so that its cells can be freed once their depths are known
    if open_ is not None:
        opening, lids = find_flat_ends(closed_part, open_)
        longer = extend_ends(closed_part, lids, further / len(lids))
        cells = voxelise_with_report(longer, voxel=voxel, margin=MARGIN, max_memory=max_memory).volume
    # Thin gaps between components count too, but not faces inside the solid.
    reach, is_overlapping = thickest / voxel + BAND + outside - BEYOND, overlap > LEAST_OVERLAP

    def depths_of(volume: Volume) -> NDArray[np.float32]:
        """Measure the depth of cells below the walls, in cells."""
        depths = distances_in_cells(longer, volume, reach, several=is_overlapping, threads=threads)
        return subtract_walls(depths, volume, wall, places, BAND + outside)

    origin = np.array(cells.origin) + voxel / 2
    if slabs and not is_overlapping and cells.values.size > WHOLE:
        slab_volumes = split_into_slabs(cells)
        del cells
        layers = LayerStack.packed(depths_of(volume) for volume in slab_volumes)
    else:
        layers = LayerStack.of(depths_of(cells))
    if not any((slab > 0).any() for _, slab in layers.read_slabs()):
        raise GeometryError.about("wall", nowhere)
    space = Interior(
        layers=layers,
        size=voxel,
        origin=origin,
        part=closed_part,
        repairs=repairs,
        skin=skin,
        overlap=overlap,
        wall=thickest,
        opening=opening,
        outside=outside,
    )
    for end in () if open_ is None else ENDS[open_]:
        layer = np.flatnonzero(space.layer_shares > 0)[-1 if end == "top" else 0]
        if not (space.depth[:, :, layer] > 0).any():
            raise GeometryError.about(
                "open",
                f"is {open_!r}, and the flat {end} of the part is nowhere wider than two walls of "
                f"{plain_argument(thickest)} mm; give a thinner wall, or turn the part",
            )
    return space


def describe_no_room(part: Surface, wall: float) -> str:
    """Describe a wall, mm, that leaves no room inside a part, with a remedy."""
    extents = np.ptp(part.bounds, axis=0)
    return (
        f"is {plain_argument(wall)} mm, and the part, {plain_size(*extents)}, is nowhere thicker than two of those; "
        f"give a thinner wall{f', or the right unit: {_units_for(extents.max())}' if extents.max() < TINY else ''}"
    )


def _units_for(longest: float) -> str:
    """Return the units in which a tiny part, mm, has the size of a print."""
    fitting = [
        unit for unit, mm in (("in", 25.4), ("cm", 10.0), ("m", 1000.0)) if PRINTED[0] < longest * mm < PRINTED[1]
    ]
    return f"--units {' or '.join(fitting or ['m'])}"


def expected_bytes(shape: tuple[int, ...], extra_bytes_per_cell: int, *, slabs: bool) -> int:
    """Return the memory for a grid in bytes; in slabs, for one slab and the packed rest."""
    cells = math.prod(shape)
    if slabs and cells > WHOLE:
        return BYTES_PACKED * cells + BYTES_PER_CELL * WHOLE
    return (BYTES_PER_CELL + extra_bytes_per_cell) * cells


def added_length(open_: Open | None, wall: float, beyond: float, voxel: float) -> float:
    """Return the total length, mm, added at all open sides of a part, so that its ends do not matter to the voids."""
    return 0.0 if open_ is None else len(ENDS[open_]) * (wall + beyond + OUT * voxel)


def grid_for_part(part: Surface, *, voxel: float, further: float, margin: int = MARGIN) -> Grid:
    """Return roughly the grid that a part is filled on, extended by a length up or down, mm."""
    return grid_around(
        Surface(vertices=np.concatenate([part.bounds, part.bounds[1:] + further * UP]), faces=np.array([[0, 1, 2]])),
        voxel=voxel,
        margin=margin,
    )


def _repair_skin(voxelised: VoxelisedMesh) -> tuple[Surface, str, float]:
    """Repair the skin; return the part facing outwards, the last repair, and the overlap that remains."""
    mesh, enclosed = voxelised.closed, voxelised.enclosed
    skin = "closed" if voxelised.repairs.holes else "as given"
    if (turned := enclosed.sign < 0).any():
        faces = np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces)
        mesh, skin = Surface(vertices=mesh.vertices, faces=faces), "turned" if skin == "as given" else skin
    overlap = float(enclosed.excess.sum() / enclosed.total)
    verdict = manifold_status(mesh)
    if mesh.closed and verdict == FINE and overlap <= LEAST_OVERLAP:
        return mesh, skin, 0.0
    parts = split_components(mesh, float(voxelised.volume.cell_size[0])).surfaces
    if overlap > LEAST_OVERLAP and (union := unite(parts)) is not None:
        # The union counts what parts enclose together once, as the exact volume does.
        mesh, verdict, skin, overlap = union, FINE, "united", abs(1 - enclosed.total / union.volume)
    elif parts and (apart := concatenate_surfaces(list(parts))).closed:
        mesh, verdict, skin = apart, manifold_status(apart), "parted"
    if verdict != FINE:
        raise GeometryError(
            f"the mesh of {len(mesh.faces):,} triangles is not a solid, even with its holes closed ({verdict}, says "
            "manifold3d); make one of it first: 'infill smooth' does"
        )
    return mesh, skin, overlap
