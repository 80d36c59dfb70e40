"""From the fields of voids to their surfaces: smoothed, and without pieces that are of no use."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.interior.interior import Interior
from infill.isosurfaces.components import shell_names
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.lattices.bodies import Fields
from infill.lattices.fillets import rounding_time
from infill.lattices.request import has_bars
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.lattices.voids import Layout
from infill.meshes.shells import first_vertex_of_shells, select_faces, shell_volumes
from infill.meshes.solids import simplify_solid
from infill.meshes.winding import winding_numbers
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import phase_from_distance
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.plain_numbers import plain_argument
from infill.surface import Surface

INTERFACE = 2.0  # cells: in a thinner interface, curvature moves the surface slower than it should
SHARE = 0.8  # of the tolerance for simplifying; the rest covers the error of the grid
SHORTEST = 1e-3  # cells²: motion by curvature in a shorter time is invisible
ROUNDED_DOWN = 0.7  # so that the largest radius, of one digit, is not more than it
SPECK = 2.0  # cells of the grid: voids smaller than a cube of this side are left solid


def choose_smoothing(task: FillTask, fields: Fields) -> Smoothing:
    """Choose the steps that round the corners of voids to the requested radius.

    Raises
    ------
    GeometryError
        If voids in the part are rounded to nothing by that radius.
    """
    request, layout, space = task.request, fields.layout, fields.layout.space
    smoothing = Smoothing(interface=INTERFACE, fidelity=0.0)
    bar = layout.width * request.thinnest if has_bars(request.kind) else None
    thickness = (space.walled or space).thickness
    radius = request.radius(thickness)
    if radius > thickness / 2:
        raise GeometryError.about(
            "smooth_radius",
            f"is {plain_argument(radius, 3)} mm, more than half of the thickness of the space inside the walls, "
            f"{plain_argument(thickness, 3)} mm on average, and leaves hardly a void; give "
            f"{plain_argument(ROUNDED_DOWN * thickness / 2, 1)} mm or less",
        )
    times = rounding_time(radius, fields.find_sharpest(), bar, cell=space.size) / space.size**2  # cells²
    if times < SHORTEST:
        return replace(smoothing, steps=0)
    steps = math.ceil(times / smoothing.alpha)
    return replace(smoothing, steps=steps, alpha=times / steps)


def make_surfaces(task: FillTask, fields: Fields) -> VoidMeshes:
    """Make the surfaces of voids: smoothed, without pieces of no use."""
    threads, inside = task.threads, fields.layout.space
    space, smoothing = inside.walled or inside, choose_smoothing(task, fields)
    out, walls = np.empty_like(space.depth), None
    if task.request.wall == 0:
        walls = space.part
    elif task.request.form == "project":
        walls = extract_inner_side(space, overlap=0.0, tolerance=task.request.tolerance / 4, threads=threads)

    def trace_fields() -> Iterator[Surface]:
        """Yield the surface of each field, smoothed, if there is one."""
        for which in range(fields.count):
            fields.write_sdf(out, which, inside.depth)
            field = smooth_void(out, inside.depth, smoothing, threads=threads)
            surface = None if field is None else extract_surface(field, space, threads)
            if surface is not None and space.opening is not None:
                surface = space.opening.keep_reaching(surface, space.size)
            if surface is not None:
                yield surface

    hollow = drop_useless(trace_fields(), replace(fields.layout, space=space))
    return replace(hollow, walls=walls, ties=fields.ties)


def drop_useless(surfaces: Iterable[Surface], layout: Layout) -> VoidMeshes:
    """Drop small voids and floating solid; return the other voids, with the counts of both."""
    least, islands, specks = (SPECK * layout.space.size) ** 3, 0, 0
    voids: list[Surface] = []
    lost: list[Surface] = []
    for surface in surfaces:
        useful, floating, small, loose = drop_small_and_floating(surface, least)
        islands, specks = islands + floating, specks + small
        if loose is not None:
            lost.append(loose)
        if useful is not None:
            voids.append(useful)
    rest = (drop_inside_pieces(surface, lost, layout.threads) for surface in voids)
    return VoidMeshes(
        layout=layout, surfaces=tuple(void for void in rest if void is not None), islands=islands, specks=specks
    )


def extract_surface(field: SparseField, space: Interior, threads: int | None) -> Surface:
    """Extract the surface of a field in a space, mm."""
    origin = tuple((space.origin - space.size / 2).tolist())
    return extract_bricks(field, spacing=(space.size,) * 3, origin=origin, threads=threads)


def extract_inner_side(space: Interior, *, overlap: float, tolerance: float, threads: int | None) -> Surface:
    """Extract the surface of the space inside the walls, extended into them by the overlap, mm."""
    field = smooth_bricks(
        phase_from_distance(space.depth + np.float32(overlap / space.size), INTERFACE, threads=threads),
        Smoothing(steps=0),
        spacing=(space.size,) * 3,
        threads=threads,
    )
    surface = extract_surface(field, space, threads)
    return simplify_solid(surface, tolerance) if tolerance > 0 else surface


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


def drop_small_and_floating(surface: Surface, least: float) -> tuple[Surface | None, int, int, Surface | None]:
    """Drop voids below a volume, mm³, and floating solid; return the rest, both counts, and the floating solid."""
    names, count = shell_names(surface)
    volume = shell_volumes(surface, names, count)
    islands, specks = volume < 0, (volume >= 0) & (volume < least)
    if not (islands.any() or specks.any()):
        return surface, 0, 0, None
    shell, is_kept = names[surface.faces[:, 0]], volume >= least
    loose = select_faces(surface, islands[shell]) if islands.any() else None
    if loose is not None:
        loose = replace(loose, faces=loose.faces[:, ::-1])
    rest = select_faces(surface, is_kept[shell]) if is_kept.any() else None
    return rest, int(islands.sum()), int(specks.sum()), loose


def drop_inside_pieces(surface: Surface, dropped: list[Surface], threads: int | None) -> Surface | None:
    """Drop the shells that lie in floating solid that was dropped; return None if no shell remains."""
    for solid in dropped:
        names, starts = shell_names(surface)[0], first_vertex_of_shells(surface)
        within = winding_numbers(np.asarray(surface.vertices, dtype=np.float64)[starts], solid, threads=threads) > 0
        if within.any():
            is_kept = ~within[names[surface.faces[:, 0]]]
            if not is_kept.any():
                return None
            surface = select_faces(surface, is_kept)
    return surface
