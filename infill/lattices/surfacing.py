"""From the fields of voids to their surfaces: smoothed, and without pieces that are of no use."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.interior.hollow import VoidMeshes
from infill.interior.inside import INTERFACE, extract_inner_side
from infill.interior.interior import Interior
from infill.isosurfaces.components import shell_names
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.lattices.fillets import rounding_time
from infill.lattices.request import FillSpec, has_bars
from infill.lattices.voids import Voids
from infill.meshes.shells import first_vertex_of_shells, select_faces, shell_volumes
from infill.meshes.winding import winding_numbers
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import phase_from_distance
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.surface import Surface

SHORTEST = 1e-3  # cells²: motion by curvature in a shorter time is invisible
SPECK = 2.0  # cells of the grid: voids smaller than a cube of this side are left solid


def choose_smoothing(space: Interior, voids: Voids, request: FillSpec, sizes: tuple[float, float]) -> Smoothing:
    """Choose the steps that round corners to the requested radius, for a cell and a width of walls or bars, mm."""
    (cell, width), smoothing = sizes, Smoothing(interface=INTERFACE, fidelity=0.0)
    sharpest = voids.sharpest(reachable_space(space, request), cell=cell, width=width)
    bar = width * request.thinnest if has_bars(request.kind) else None
    radius = request.radius(space.thickness)
    times = rounding_time(radius, sharpest, bar, cell=space.size) / space.size**2  # cells²
    if times < SHORTEST:
        return replace(smoothing, steps=0)
    steps = math.ceil(times / smoothing.alpha)
    return replace(smoothing, steps=steps, alpha=times / steps)


def make_surfaces(
    space: Interior, voids: Voids, request: FillSpec, sizes: tuple[float, float], threads: int | None
) -> VoidMeshes:
    """Make the surfaces of the voids: smoothed, without pieces of no use."""
    cell, width = sizes
    out = np.empty_like(space.depth)
    smoothing = choose_smoothing(space, voids, request, sizes)
    inside, walls = reachable_space(space, request), None
    if request.form == "project":
        walls = extract_inner_side(space, overlap=0.0, tolerance=request.tolerance / 4, threads=threads)
    surfaces, islands, specks = [], 0, 0
    lost: list[Surface] = []
    for which in range(voids.count(inside, cell=cell, width=width)):
        voids.into(out, inside, which, cell=cell, width=width)
        field = smooth_void(out, inside.depth, smoothing, threads=threads)
        if field is None:
            continue
        surface = extract_bricks(
            field, spacing=(space.size,) * 3, origin=tuple((space.origin - space.size / 2).tolist()), threads=threads
        )
        if space.opening is not None:
            reaching = space.opening.reaching(surface, space.size)
            if reaching is None:
                continue
            surface = reaching
        useful_surface, floating, tiny, loose = drop_small_and_floating(surface, (SPECK * space.size) ** 3)
        islands, specks = islands + floating, specks + tiny
        lost.extend(loose)
        if useful_surface is not None:
            surfaces.append(useful_surface)
    surfaces = [
        void for void in (drop_inside_pieces(surface, lost, threads) for surface in surfaces) if void is not None
    ]
    return VoidMeshes(
        space=space,
        cell=cell,
        width=width,
        surfaces=surfaces,
        tolerance=0.0,
        islands=islands,
        specks=specks,
        walls=walls,
    )


def reachable_space(space: Interior, request: FillSpec) -> Interior:
    """Return the space that voids may take: in a project, through the walls and a little out of the part."""
    return space.unwalled if request.form == "project" else space


def smooth_void(
    distance: NDArray[np.float32], depth: NDArray[np.float32], smoothing: Smoothing, *, threads: int | None
) -> SparseField | None:
    """Smooth the field of a void; return None if nothing of it is left.

    Parameters
    ----------
    distance, depth : (nx, ny, nz) float32
        Distance into the void, which is overwritten, and depth below the inner side of the wall, in cells.
    smoothing : Smoothing
    """
    if not (distance > 0).any():
        return None
    phase = phase_from_distance(distance, INTERFACE, out=distance, threads=threads)
    field = smooth_bricks(phase, smoothing, threads=threads)
    if smoothing.steps:
        # Where the skin bends inwards, curvature would draw voids into the wall.
        walled = field.gathered(depth, threads=threads)
        walled = phase_from_distance(walled, INTERFACE, out=walled, threads=threads)
        field = replace(field, values=np.minimum(field.values, walled, out=walled))
    return field if (field.values > 0).any() else None


def drop_small_and_floating(surface: Surface, least: float) -> tuple[Surface | None, int, int, list[Surface]]:
    """Drop voids below a volume, mm³, and floating solid; return the rest, both counts, and the floating pieces."""
    names, count = shell_names(surface)
    volume = shell_volumes(surface, names, count)
    islands, specks = volume < 0, (volume >= 0) & (volume < least)
    if not (islands.any() or specks.any()):
        return surface, 0, 0, []
    shell, is_kept = names[surface.faces[:, 0]], volume >= least
    pieces = [select_faces(surface, shell == island) for island in np.flatnonzero(islands)]
    loose = [replace(piece, faces=piece.faces[:, ::-1]) for piece in pieces]
    rest = select_faces(surface, is_kept[shell]) if is_kept.any() else None
    return rest, int(islands.sum()), int(specks.sum()), loose


def drop_inside_pieces(surface: Surface, dropped: list[Surface], threads: int | None) -> Surface | None:
    """Drop the shells that lie in pieces of solid that were dropped; return None if no shell remains."""
    for piece in dropped:
        names, starts = shell_names(surface)[0], first_vertex_of_shells(surface)
        within = winding_numbers(np.asarray(surface.vertices, dtype=np.float64)[starts], piece, threads=threads) > 0
        if within.any():
            is_kept = ~within[names[surface.faces[:, 0]]]
            if not is_kept.any():
                return None
            surface = select_faces(surface, is_kept)
    return surface
