"""The objects of a mesh file apart: a 3MF may hold several, with names and colours."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from infill.formats.parts import Part
from infill.meshes.shells import select_faces
from infill.surface import Surface

MOST_OBJECTS = 100  # that are told apart


def split_objects(surface: Surface, path: Path) -> list[Part]:
    """Split what `infill.read_mesh` has read of a file into its objects, each with a name of its own.

    Parameters
    ----------
    surface : Surface, mm
    path : Path
        A file other than a 3MF, or a 3MF with more than 100 objects, is one object with the name of the file.

    Returns
    -------
    list of Part
        In the order of the file.

    Raises
    ------
    FormatError
        As `infill.read_mesh` does.
    """
    from infill.formats.threemf_reading import read_objects

    whole = [Part(surface=surface, name=path.stem)]
    if path.suffix.lower() != ".3mf":
        return whole
    objects = read_objects(path)
    ends = np.cumsum([0, *(entry.triangles for entry in objects)])
    if not 1 < len(objects) <= MOST_OBJECTS or ends[-1] != len(surface.faces):
        return whole
    numbers = np.arange(len(surface.faces))
    taken: set[str] = set()
    parts = []
    for number, (entry, (low, high)) in enumerate(zip(objects, pairwise(ends.tolist()), strict=True), start=1):
        name = entry.name.strip() or f"object {number}"
        if name in taken:
            name = f"{name} ({number})"
        taken.add(name)
        chosen = select_faces(surface, (numbers >= low) & (numbers < high))
        parts.append(Part(surface=chosen, name=name, colour=entry.colour))
    return parts
