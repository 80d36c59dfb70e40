"""Turn a mesh into cells: mark the cell centres inside it, whatever state the mesh is in."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.checks import check_length, check_whole_number
from infill.errors import GeometryError, ParameterError, UsageError
from infill.grid import Grid
from infill.machine import require_memory
from infill.meshes.hole_filling import component_volumes, fill_holes
from infill.meshes.merging import merge_unless_closed
from infill.plain_numbers import plain_argument, plain_size
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.partial import EnclosedVolumes, measure_enclosed
from infill.voxels.scanlines import SLAB, fill_rows_and_count, intersect_rows, is_inside_out

RESOLUTION = 200  # cells along the longest side by default
FEWEST = 2  # voxels along the longest side
ROUNDING = 1e-6  # of a cell: how far a side may exceed whole cells without getting another cell
CROSSING_BYTES, FACE_BYTES = 60, 420  # measured peaks, sorting included


@dataclass(frozen=True, kw_only=True)
class MeshRepairs:
    """Assumptions that `voxelise` made about a mesh.

    Parameters
    ----------
    components : int
        Parts of the mesh that share no vertex.
    turned : int
        Components that faced inwards while others faced outwards.
    holes : int
        Loops of open edges that got a cap. A triangle that occurs twice or faces the wrong way counts as one too.
    hole_share : float
        Area of the caps over the area of mesh and caps. The inside is a guess where this is large.
    volume : float
        Volume that the mesh and its caps enclose, mm³; where components overlap, it counts once.
    """

    components: int
    turned: int
    holes: int
    hole_share: float
    volume: float


@dataclass(frozen=True, kw_only=True)
class VoxelisedMesh:
    """The cells inside a mesh, and how they came about.

    Parameters
    ----------
    volume : Volume
        Booleans, True inside.
    repairs : MeshRepairs
        Assumptions about the mesh.
    closed : Surface
        The mesh around these cells, mm: equal vertices merged where that closes it, else with caps on its holes. The
        caps are its last faces.
    enclosed : EnclosedVolumes
        The exact volumes inside the mesh.
    several : bool
        Whether it has several components, or overlaps itself.
    """

    volume: Volume
    repairs: MeshRepairs
    closed: Surface
    enclosed: EnclosedVolumes
    several: bool


def grid_around(
    surface: Surface, *, voxel: float | None = None, resolution: int | None = None, margin: int = 2
) -> Grid:
    """Lay the grid on which a mesh is voxelised: see `voxelise`."""
    lower, upper = surface.bounds
    extents = upper - lower
    longest = float(extents.max())
    if not longest > 0:
        raise GeometryError("all corners of the mesh are one point, so nothing is inside; give a closed mesh")
    size = voxel_size(longest, voxel=voxel, resolution=resolution)
    if voxel is not None and size > longest / FEWEST:
        raise ParameterError.about(
            "voxel",
            f"is {plain_argument(size)} mm and the part {plain_size(*extents, digits=6)}; "
            f"give at most {plain_argument(longest / FEWEST)} mm",
        )
    shape = tuple(max(1, math.ceil(side / size - ROUNDING)) + 2 * margin for side in extents.tolist())
    origin = (lower + upper) / 2 - np.array(shape) * size / 2
    return Grid(shape=shape, spacing=size, origin=tuple(origin.tolist()))


def voxel_size(longest: float, *, voxel: float | None, resolution: int | None) -> float:
    """Return the size of the voxels, mm, or divide the longest side of the data by the resolution, 200 by default.

    Raises
    ------
    ParameterError
        If both are given, or one is out of range.
    """
    if voxel is None:
        return longest / check_whole_number("resolution", RESOLUTION if resolution is None else resolution, 1)
    if resolution is not None:
        raise UsageError.about(("voxel", "resolution"), "are both given; give one of them")
    return check_length("voxel", voxel)


def estimate_solid_cells(surface: Surface, grid: Grid) -> float:
    """Estimate the number of cells inside a mesh and the caps on its holes; overlaps count twice.

    Raises
    ------
    GeometryError
        If it encloses nothing.
    """
    cell_vertices, faces, _ = fill_holes(
        (surface.vertices - np.array(grid.origin)) / grid.cell_size - 0.5, surface.faces
    )
    return abs(float(_components(cell_vertices, faces, len(surface.faces))[1].sum()))


def _components(
    vertices: NDArray[np.float64], faces: NDArray[np.integer], given: int
) -> tuple[NDArray[np.integer], NDArray[np.float64]]:
    """Label the components of the faces; return them and signed volumes. The first `given` faces are not caps."""
    component, volumes = component_volumes(vertices, faces)
    if not volumes.any():
        raise GeometryError(
            f"the mesh of {given} triangles encloses nothing (loose triangles or a flat sheet); give a closed mesh"
        )
    return component, volumes


def voxelise(
    surface: Surface,
    *,
    voxel: float | None = None,
    resolution: int | None = None,
    margin: int = 2,
    max_memory: int | None = None,
) -> Volume:
    """Mark the cells whose centre lies inside a mesh.

    Parameters
    ----------
    surface : Surface
        It may be open, inside out, intersect itself, or have several components.
    voxel : float, optional
        Cell size, mm.
    resolution : int, optional
        Cells along the longest side of the mesh's bounding box instead; 200 if neither is given.
    margin : int
        Empty cells beyond the bounding box on every side.
    max_memory : int, optional
        Bytes; by default, whatever is available.

    Returns
    -------
    Volume
        Booleans, True inside; the mesh's bounding box is centred in the grid.

    Raises
    ------
    ParameterError
        For numbers out of range, both `voxel` and `resolution`, or cells too large for the part.
    GeometryError
        If the mesh encloses nothing.
    MemoryLimitError
        If the grid does not fit into memory.

    Notes
    -----
    A cell is inside if the mesh winds around its centre at least once, counted with sign: the winding
    number w = sum of the signed crossings of a ray is not 0. Overlapping components are therefore united, an
    inverted mesh gives the same result as the right way out, and a component that faces inwards within another is
    a cavity. Components that face inwards on their own are turned first, together with everything inside them.

    Corners of open edges less than a hundredth of a cell apart are merged. Holes are closed by fans from the
    centre of their rim before anything is counted, so that w is a whole number everywhere. For flat holes in a
    consistently oriented mesh, the result is that of the generalised winding number (Jacobson et al. 2013,
    "Robust inside-outside segmentation using generalized winding numbers", doi:10.1145/2461912.2461916) cut
    at 1/2, at the cost of one ray per row of cells.

    A wall thinner than a cell is found only where a cell centre happens to lie in it.

    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> voxelise(Surface(vertices=corners, faces=faces), voxel=1.0).values.shape
    (8, 8, 8)
    """
    return voxelise_with_report(
        surface, voxel=voxel, resolution=resolution, margin=margin, max_memory=max_memory
    ).volume


def voxelise_with_report(
    surface: Surface,
    *,
    voxel: float | None = None,
    resolution: int | None = None,
    margin: int = 2,
    max_memory: int | None = None,
) -> VoxelisedMesh:
    """Voxelise a mesh as `voxelise` does; return the cells, the assumptions, and the closed mesh."""
    margin = check_whole_number("margin", margin, 0)
    if len(surface.faces) == 0:
        raise GeometryError("the mesh has no triangles, so nothing is inside; give a closed mesh")
    if not np.isfinite(surface.vertices[np.unique(surface.faces)]).all():
        raise GeometryError("the mesh holds coordinates that are not finite; export it again")
    mesh = merge_unless_closed(surface.vertices, surface.faces)
    grid = grid_around(mesh, voxel=voxel, resolution=resolution, margin=margin)
    size, shape, extents = float(grid.cell_size[0]), grid.shape, np.ptp(mesh.bounds, axis=0)
    advice = f"the grid has {' x '.join(map(str, shape))} cells; give larger voxels or a lower resolution"
    require_memory(math.prod(shape), max_memory, advice)  # before anything is allocated
    origin = np.array(grid.origin)

    vertices, faces, holes = fill_holes((mesh.vertices - origin) / size - 0.5, mesh.faces)
    doubled = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    expected = float(np.abs(doubled[:, 2]).sum()) / 2
    required = math.prod(shape) + CROSSING_BYTES * expected + FACE_BYTES * len(faces) + 8 * SLAB
    require_memory(int(required), max_memory, advice)
    areas = np.linalg.norm(doubled, axis=1)
    component, volumes = _components(vertices, faces, len(mesh.faces))
    crossed = intersect_rows(vertices, faces, shape)
    turned = is_inside_out(crossed, component, volumes)
    if turned.any():
        crossed = replace(crossed, sign=np.where(turned[component[crossed.face]], -crossed.sign, crossed.sign))
    inside, largest_winding = fill_rows_and_count(crossed, shape)
    if not inside.any():
        raise ParameterError.about(
            "voxel",
            f"is {plain_argument(size)} mm and the part {plain_size(*extents, digits=6)}: "
            "no centre of a cell lies inside; give a voxel of at most half the thinnest wall",
        )
    closed = Surface(vertices=(vertices + 0.5) * size + origin, faces=faces) if holes else mesh
    cells = Volume(values=inside, spacing=size, origin=tuple(origin.tolist()))
    enclosed_volumes = measure_enclosed(
        closed, component, turned, volumes * size**3, cells, overlap=largest_winding > 1
    )
    repairs = MeshRepairs(
        components=len(volumes),
        turned=int(turned.sum()),
        holes=holes,
        hole_share=float(areas[len(mesh.faces) :].sum() / areas.sum()),
        volume=enclosed_volumes.total,
    )
    return VoxelisedMesh(
        volume=cells,
        repairs=repairs,
        closed=closed,
        enclosed=enclosed_volumes,
        several=len(volumes) > 1 or largest_winding > 1,
    )
