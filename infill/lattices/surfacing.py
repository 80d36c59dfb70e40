"""From the fields of voids to their surfaces: smoothed, and none that is of no use."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.interior.hollow import Hollow
from infill.interior.inside import INTERFACE, inner_side
from infill.interior.interior import Space
from infill.isosurfaces.components import shell_names
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.lattices.fillets import times_for
from infill.lattices.request import Request, barred
from infill.lattices.voids import Voids
from infill.meshes.shells import first_of_shells, shell_volumes, with_faces
from infill.meshes.winding import winding
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import on_profile
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.surface import Surface

SHORTEST = 1e-3  # cells²: what moves by curvature in this time is not seen
SPECK = 2.0  # cells of the grid: voids smaller than a cube of this side are left solid


def smoothing_for(space: Space, voids: Voids, request: Request, sizes: tuple[float, float]) -> Smoothing:
    """Return the steps that round corners to the radius asked for, for a cell and a width of walls or bars, mm."""
    (cell, width), smoothing = sizes, Smoothing(interface=INTERFACE, fidelity=0.0)
    sharpest = voids.sharpest(_reached(space, request), cell=cell, width=width)
    bar = width * request.thinnest if barred(request.kind) else None
    radius = request.radius(space.thickness)
    times = times_for(radius, sharpest, bar, cell=space.size) / space.size**2  # cells²
    if times < SHORTEST:
        return replace(smoothing, steps=0)
    steps = math.ceil(times / smoothing.alpha)
    return replace(smoothing, steps=steps, alpha=times / steps)


def surfaces_of(
    space: Space, voids: Voids, request: Request, sizes: tuple[float, float], threads: int | None
) -> Hollow:
    """Return the surfaces of the voids, smoothed, without what is no void of any use."""
    cell, width = sizes
    out = np.empty_like(space.depth)
    smoothing = smoothing_for(space, voids, request, sizes)
    inside, walls = _reached(space, request), None
    if request.form == "project":
        walls = inner_side(space, overlap=0.0, tolerance=request.tolerance / 4, threads=threads)
    surfaces, islands, specks = [], 0, 0
    lost: list[Surface] = []
    for which in range(voids.count(inside, cell=cell, width=width)):
        voids.into(out, inside, which, cell=cell, width=width)
        field = smoothed_void(out, inside.depth, smoothing, threads=threads)
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
        kept, few, small, loose = useful(surface, (SPECK * space.size) ** 3)
        islands, specks = islands + few, specks + small
        lost.extend(loose)
        if kept is not None:
            surfaces.append(kept)
    surfaces = [each for each in (outside_of(surface, lost, threads) for surface in surfaces) if each is not None]
    return Hollow(
        space=space,
        cell=cell,
        width=width,
        surfaces=surfaces,
        tolerance=0.0,
        islands=islands,
        specks=specks,
        walls=walls,
    )


def _reached(space: Space, request: Request) -> Space:
    """Return the space that voids may take: in a project, through the walls and a little out of the part."""
    return space.unwalled if request.form == "project" else space


def smoothed_void(
    distance: NDArray[np.float32], depth: NDArray[np.float32], smoothing: Smoothing, *, threads: int | None
) -> SparseField | None:
    """Return the smoothed field of a void, or None if nothing of it is left.

    Parameters
    ----------
    distance, depth : (nx, ny, nz) float32
        Into the void, which is overwritten, and below the inner side of the wall, in cells.
    smoothing : Smoothing
    """
    if not (distance > 0).any():
        return None
    phase = on_profile(distance, INTERFACE, out=distance, threads=threads)
    field = smooth_bricks(phase, smoothing, threads=threads)
    if smoothing.steps:
        # Where the skin bends inwards, curvature would draw voids into the wall.
        walled = field.gathered(depth, threads=threads)
        walled = on_profile(walled, INTERFACE, out=walled, threads=threads)
        field = replace(field, values=np.minimum(field.values, walled, out=walled))
    return field if (field.values > 0).any() else None


def useful(surface: Surface, least: float) -> tuple[Surface | None, int, int, list[Surface]]:
    """Return the voids larger than a volume, mm³, filled where solid hangs free, and how many were neither."""
    names, count = shell_names(surface)
    volume = shell_volumes(surface, names, count)
    islands, specks = volume < 0, (volume >= 0) & (volume < least)
    if not (islands.any() or specks.any()):
        return surface, 0, 0, []
    shell, kept = names[surface.faces[:, 0]], volume >= least
    pieces = [with_faces(surface, shell == each) for each in np.flatnonzero(islands)]
    loose = [replace(piece, faces=piece.faces[:, ::-1]) for piece in pieces]
    useful = with_faces(surface, kept[shell]) if kept.any() else None
    return useful, int(islands.sum()), int(specks.sum()), loose


def outside_of(surface: Surface, lost: list[Surface], threads: int | None) -> Surface | None:
    """Return the shells that do not lie in pieces that were lost."""
    for piece in lost:
        names, first = shell_names(surface)[0], first_of_shells(surface)
        within = winding(np.asarray(surface.vertices, dtype=np.float64)[first], piece, threads=threads) > 0
        if within.any():
            kept = ~within[names[surface.faces[:, 0]]]
            if not kept.any():
                return None
            surface = with_faces(surface, kept)
    return surface
