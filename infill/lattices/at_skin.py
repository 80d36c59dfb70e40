"""Infill that goes on to the skin: of a project, whose shell a slicer makes, and of a part without a shell."""

from __future__ import annotations

import numpy as np

from infill.errors import GeometryError
from infill.isosurfaces.components import shell_names
from infill.lattices.drawn_voids import Prismatic
from infill.lattices.surfacing import SHARE, extract_inner_side
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.distance import TriangleTree
from infill.meshes.shells import select_faces, shell_volumes
from infill.meshes.solids import simplify_solid, subtract
from infill.meshes.split_components import drop_pieces
from infill.surface import Surface

SHORT = 1e-3  # mm: edges of the infill of a project are longer than that, or nearly
INTO_WALL = 0.75  # of the wall: infill reaches this far into it where voids cannot be cut out of the part
CRUMB = 0.5  # cells: pieces at the skin that are nowhere longer are cut-off crumbs of the pattern
AT_SKIN = 1e-3  # mm from it


def subtract_voids(task: FillTask, hollow: VoidMeshes) -> Surface:
    """Subtract the voids from the part, or from most of it if manifold3d rejects that; return the surface.

    Where voids meet the skin, they leave edges so short that both ends are one point in single precision, as in files:
    such edges are collapsed.
    """
    space, voids, tolerance = hollow.space, hollow.surfaces, SHARE * task.request.tolerance
    infill = subtract(space.part, voids)
    if infill is None:
        overlap = INTO_WALL * task.request.wall
        inside = extract_inner_side(space, overlap=overlap, tolerance=tolerance, threads=task.threads)
        infill = subtract(inside, voids)
    if infill is None or not len(infill.faces):
        raise GeometryError("manifold3d rejects the voids as solids; give another cell or smaller voxels")
    return simplify_solid(infill, SHORT)


def drop_crumbs(task: FillTask, infill: Surface, hollow: VoidMeshes) -> tuple[Surface, int, float]:
    """Drop the crumbs that the skin cuts off the pattern; return the rest, and their count and volume, mm³.

    A crumb is a piece at the skin no longer than half a cell along any axis, or in plan, where walls are upright. The
    largest piece always stays.
    """
    names, count = shell_names(infill)
    volume = shell_volumes(infill, names, count)
    vertices = np.asarray(infill.vertices, dtype=np.float64)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    used = np.unique(infill.faces)
    np.minimum.at(low, names[used], vertices[used])
    np.maximum.at(high, names[used], vertices[used])
    axes = 2 if isinstance(task.pattern, Prismatic) else 3
    is_small = ((high - low)[:, :axes] <= CRUMB * hollow.cell).all(axis=1) & (volume > 0)
    is_small[np.argmax(volume)] = False
    if not is_small.any():
        return infill, 0, 0.0
    skin = TriangleTree.of(hollow.space.part)
    crumbs, lost = [], 0.0
    for number in np.flatnonzero(is_small):
        piece = select_faces(infill, names[infill.faces[:, 0]] == number)
        distance, _ = skin.nearest(np.asarray(piece.vertices, dtype=np.float64), threads=task.threads)
        if distance.min() <= AT_SKIN:
            crumbs.append(piece)
            lost += float(volume[number])
    return drop_pieces(infill, crumbs, task.threads), len(crumbs), lost
