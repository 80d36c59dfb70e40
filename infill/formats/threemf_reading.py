"""`read_3mf`: read the parts that a 3MF builds, with notes on omissions and negative volumes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import wrap_reader_errors
from infill.files.excerpts import excerpt
from infill.formats.threemf_package import (
    EXPORT_ADVICE,
    IDENTITY,
    open_package,
    parse_transform,
)
from infill.formats.threemf_placing import PackageReading, PlacedVolume
from infill.formats.threemf_roles import (
    is_unprinted,
)
from infill.imaging.label_tables import Colour
from infill.meshes.merging import merge_unless_closed
from infill.surface import Modifier

UNITS = {"micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4, "foot": 304.8, "meter": 1000.0}
MOST_NOTES = 20


@dataclass(frozen=True, kw_only=True)
class FileObject:
    """An object of a 3MF, in the order in which `read_3mf` returns its triangles.

    Parameters
    ----------
    name : str
        Empty for none.
    colour : (red, green, blue) or None
        From 0 to 1, sRGB.
    triangles : int
    """

    name: str
    colour: Colour | None
    triangles: int


def read_3mf(
    path: Path,
) -> tuple[NDArray[np.floating], NDArray[np.integer], tuple[str, ...], tuple[Modifier, ...]]:
    """Read the parts that a 3MF builds, where their components and transforms place them.

    Modifiers, blockers and enforcers of supports, objects of types other than "model", and items that are not to be
    printed are left out; negative volumes are taken off. Modifiers with settings of infill or walls are returned apart.

    Parameters
    ----------
    path : Path

    Returns
    -------
    vertices : (V, 3) float, mm
    faces : (F, 3) int
    notes : tuple of str
        Omissions and subtracted volumes.
    modifiers : tuple of Modifier

    Raises
    ------
    FormatError
        If it is broken, builds nothing, or requires an extension that is not read.
    """
    build = _read_build(path)
    if not build.parts:
        return np.empty((0, 3)), np.empty((0, 3), dtype=np.int64), (), ()
    surfaces = [part.surface for part in build.parts]
    starts = np.cumsum([0, *(len(surface.vertices) for surface in surfaces[:-1])])
    vertices = np.concatenate([surface.vertices for surface in surfaces]) * build.scale
    faces = np.concatenate([surface.faces + start for surface, start in zip(surfaces, starts, strict=True)])
    return vertices, faces, build.notes, build.modifiers


def read_objects(path: Path) -> tuple[FileObject, ...]:
    """Return names and colours of the parts that `read_3mf` reads, in its order; raise FormatError as it does."""
    return tuple(
        FileObject(name=part.title, colour=part.colour, triangles=len(part.surface.faces))
        for part in _read_build(path).parts
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Build:
    """The parts that a 3MF builds, minus negative volumes.

    Parameters
    ----------
    parts : list of PlacedVolume
        In the unit of the file.
    scale : float
        That unit, mm.
    notes : tuple of str
    modifiers : tuple of Modifier
        mm
    """

    parts: list[PlacedVolume]
    scale: float
    notes: tuple[str, ...]
    modifiers: tuple[Modifier, ...]


def _read_build(path: Path) -> _Build:
    """Read and place the volumes that the build of a 3MF lists, or raise FormatError."""
    with open_package(path) as package:
        reading = PackageReading(path=path, package=package)
        main = reading.model(reading.main) if reading.main else None
        if main is None or main.root.find(f"{main.core}build") is None:
            raise FormatError(f"{path} has nothing to build in it; {EXPORT_ADVICE}")
        unit = main.root.get("unit", "millimeter").strip().lower()
        if unit not in UNITS:
            raise FormatError(f"{path} is in '{excerpt(unit)}', and 3MF knows {', '.join(UNITS)}; {EXPORT_ADVICE}")
        parts: list[PlacedVolume] = []
        with wrap_reader_errors(path, "holds a number that is not one", EXPORT_ADVICE):
            for item in main.items:
                key = reading.reference(item, reading.main)
                if is_unprinted(item.get("printable")):
                    reading.note(f"object {excerpt(key[1])} is not to be printed: it is left out")
                    continue
                volumes = list(reading.placed(key, parse_transform(item.get("transform", IDENTITY))))
                parts.extend(reading.without_negatives(volumes))
    notes = tuple(reading.notes)
    if len(notes) > MOST_NOTES:
        notes = (*notes[:MOST_NOTES], f"and {len(notes) - MOST_NOTES:,} more")
    if notes and not parts:
        raise FormatError(
            f"{path} holds no part: {'; '.join(notes[:3])}; make it a part in the slicer, or export an STL"
        )
    modifiers = tuple(
        replace(each, surface=merge_unless_closed(each.surface.vertices, each.surface.faces).scaled(UNITS[unit]))
        for each in reading.modifiers
    )
    return _Build(parts=parts, scale=UNITS[unit], notes=notes, modifiers=modifiers)
