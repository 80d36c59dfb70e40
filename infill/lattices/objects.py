"""The objects of a 3MF that was filled as one part: each takes back its skin and its voids, its name and its colour."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.formats.parts import Part
from infill.formats.threemf_reading import FileObject
from infill.graph import label_connected
from infill.isosurfaces.components import shell_names
from infill.meshes.distance import TriangleTree
from infill.meshes.shells import select_faces, shell_volumes
from infill.surface import Surface

SKIN_SAMPLES, VOID_SAMPLES = 4000, 40  # faces of a shell whose nearest faces of the part say what it belongs to
SAME_SIDE = 0.5  # cosine between normals: where two objects touch, the face of the other one looks the other way


def divide_by_objects(
    filled: Surface, part: Surface, objects: Sequence[FileObject], *, threads: int | None = None
) -> list[Part]:
    """Divide a filled part into the objects of its file; return those that are there, in the order of the file.

    A shell of the result, be it skin or void, belongs to the object of the nearest face of the part: from a void, the
    way to any other object leads through the skin of its own. Objects that became one solid, because they overlap,
    stay one, with the name and the colour of the one that has most of its skin.

    Parameters
    ----------
    filled, part : Surface, mm
        The result, and the part with the faces of all objects in their order.
    objects : sequence of FileObject
        At least one.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    ends = np.cumsum([each.triangles for each in objects])
    if len(objects) == 1 or ends[-1] != len(part.faces):
        return [Part(surface=filled, name=objects[0].name, colour=objects[0].colour)]
    shells, count = shell_names(filled)
    shell_of = shells[filled.faces[:, 0]]
    corners = np.asarray(filled.vertices, dtype=np.float64)[filled.faces]
    skins = shell_volumes(filled, shells, count) > 0
    picked = _pick_faces(shell_of, np.where(skins, SKIN_SAMPLES, VOID_SAMPLES))
    nearest = TriangleTree.of(part).nearest(corners[picked].mean(axis=1), threads=threads)[1]
    found = np.asarray(part.vertices, dtype=np.float64)[part.faces[nearest]]
    agree = np.einsum("ij,ij->i", _unit_normals(corners[picked]), _unit_normals(found)) > SAME_SIDE
    counted = agree | ~skins[shell_of[picked]]
    votes = np.zeros((count, len(objects)), dtype=int)
    np.add.at(votes, (shell_of[picked][counted], np.searchsorted(ends, nearest[counted], side="right")), 1)
    group_of, groups = _join_objects(votes[skins])
    owner = group_of[votes.argmax(axis=1)]
    if set(owner[~skins].tolist()) - set(owner[skins].tolist()):  # voids without a skin: these objects are one solid
        owner, groups = np.zeros(count, dtype=np.int32), 1
        group_of = np.zeros(len(objects), dtype=np.int32)
    skin_votes = votes[skins].sum(axis=0)
    divided = []
    for group in range(groups):
        members = np.flatnonzero(group_of == group)
        largest = objects[members[skin_votes[members].argmax()]]
        faces = (owner == group)[shell_of]
        if faces.any():
            divided.append(Part(surface=select_faces(filled, faces), name=largest.name, colour=largest.colour))
    return divided


def _pick_faces(shell_of: NDArray[np.int32], most: NDArray[np.int_]) -> NDArray[np.intp]:
    """Return faces of every shell, evenly in their order, at most as many as is given for each."""
    order = np.argsort(shell_of, kind="stable")
    bounds = np.searchsorted(shell_of[order], np.arange(len(most) + 1))
    steps = [
        np.linspace(low, high - 1, min(limit, high - low)).astype(int)
        for (low, high), limit in zip(pairwise(bounds.tolist()), most.tolist(), strict=True)
    ]
    picked: NDArray[np.intp] = order[np.concatenate(steps)]
    return picked


def _join_objects(votes: NDArray[np.int_]) -> tuple[NDArray[np.int32], int]:
    """Join objects that share a skin (S, objects); return the group of each object, and the number of groups."""
    skin, one = np.nonzero(votes)
    return label_connected(votes.argmax(axis=1)[skin], one, votes.shape[1])


def _unit_normals(corners: Floats) -> Floats:
    """Return the unit normals of triangles (N, 3, 3), 0 where there is no area."""
    products = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals: Floats = products / np.maximum(np.linalg.norm(products, axis=1), np.finfo(float).tiny)[:, None]
    return normals
