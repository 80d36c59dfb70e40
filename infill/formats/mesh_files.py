"""`save` and `read_mesh`: write a mesh to a file and read one, in the format of the suffix."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import require_readable, wrap_reader_errors
from infill.files.suffixes import PRINTS
from infill.files.whole_files import atomic_file
from infill.formats.gltf import write_glb, write_glb_parts
from infill.formats.label_walls import LabelWalls
from infill.formats.obj import read_obj, write_obj
from infill.formats.off import read_off
from infill.formats.parts import Part
from infill.formats.ply import read_ply, write_ply, write_ply_walls
from infill.formats.stl import read_stl, write_stl, write_stl_ascii
from infill.formats.threemf import write_3mf, write_3mf_parts
from infill.formats.vtk_writing import write_vtp
from infill.meshes.merging import merge_unless_closed, surface_of
from infill.plain_numbers import plain_size
from infill.surface import Modifier, Surface

if TYPE_CHECKING:
    import trimesh

FARTHEST = 1e12  # mm, a million kilometres: a larger number is broken, and its squares may overflow
LOG = logging.getLogger("infill")


def save(mesh: trimesh.Trimesh | Surface, path: str | os.PathLike[str], *, ascii: bool = False) -> Path:  # noqa: A002
    """Write a mesh; an existing file is replaced once the new one is complete.

    Parameters
    ----------
    mesh : trimesh.Trimesh or Surface, mm
    path : str or Path
        .stl, .3mf, .obj, .ply or .glb. A .3mf states that it is in millimetres; a .glb is in metres, as glTF requires;
        the others state no unit and hold millimetres.
    ascii : bool
        Write text instead of binary; STL only.

    Returns
    -------
    Path

    Raises
    ------
    FormatError
        For an unknown suffix, or ascii in a format other than STL.
    GeometryError
        For a mesh without faces, or with corners that are not finite.
    OutputError
        If the file cannot be written.
    """
    target = Path(path)
    write = mesh_writer(target, ascii=ascii)
    surface = surface_of(mesh)
    with atomic_file(target) as file:
        write(surface, file)
    return target


def mesh_writer(path: Path, *, ascii: bool = False, more: tuple[str, ...] = ()) -> Callable[[Surface, BinaryIO], None]:  # noqa: A002
    """Return the function that writes the format of `path`, or raise FormatError listing `more` suffixes too."""
    suffix = path.suffix.lower()
    if suffix not in WRITERS:
        description = f"the suffix {path.suffix!r}" if suffix else f"{path.name!r}, which has no suffix"
        suffixes = ", ".join(dict.fromkeys((*WRITERS, *more)))
        raise FormatError(f"cannot tell a mesh format from {description}; use one of {suffixes}")
    if ascii and suffix != ".stl":
        raise FormatError(f"only .stl can be written as text by choice, not {suffix}; leave ascii out")
    return write_stl_ascii if ascii else WRITERS[suffix]


def parts_writer(path: Path, *, more: tuple[str, ...] = ()) -> Callable[[Sequence[Part], BinaryIO], None]:
    """Return the function that writes several meshes into one file; raise FormatError if the format holds one.

    The message lists `more` suffixes too.
    """
    suffix = path.suffix.lower()
    if suffix not in PART_WRITERS:
        mesh_writer(path, more=more)
        *first, last = (*PART_WRITERS, *more)
        raise FormatError(
            f"{path} can hold one mesh and there may be several; use {', '.join(first)} or {last}, "
            "or {label} in the name for a file each"
        )
    return PART_WRITERS[suffix]


def read_mesh(path: str | os.PathLike[str]) -> Surface:
    """Read the triangles of a file.

    Equal vertices are merged, unless the mesh is closed as it stands: in that case, the file specifies on purpose
    which of two equal vertices a triangle uses. Triangles with two equal corners are kept.

    Parameters
    ----------
    path : str or Path
        .stl (binary or text), .3mf, .obj, .ply, .off, .glb or .gltf. 3MF states its unit and glTF is in metres: these
        are converted to millimetres. The others state no unit and are taken as they are.

    Returns
    -------
    Surface
        With `notes` on omitted parts of a 3MF, such as the modifiers of a slicer, and `modifiers` that have an infill
        density.

    Raises
    ------
    FormatError
        If the file is missing, its suffix is unknown, it requires an extension that is not read, or it holds no
        triangles or broken ones.

    Notes
    -----
    Omissions are logged as warnings too, to the log "infill".
    """
    if Path(path).suffix.lower() in PRINTS:
        raise FormatError(
            f"{path} is a sliced print, not a mesh; infill motion tells how long it takes, infill refill smooths its "
            "infill"
        )
    source = require_readable(path, READERS, "a mesh format")
    try:
        with wrap_reader_errors(source, "is broken", "export the mesh again"):
            vertices, faces, *extra = READERS[source.suffix.lower()](source)
            notes, modifiers = (*extra, (), ())[:2]
    except OSError as error:
        raise FormatError(f"cannot read {source}: {error.strerror or error}; check the file") from error
    if len(faces) == 0:
        raise FormatError(f"{source} holds no triangles; export the mesh again")
    if not np.isfinite(vertices).all():
        raise FormatError(f"{source} holds coordinates that are not numbers; export the mesh again")
    farthest = float(np.abs(vertices).max())
    if farthest > FARTHEST:
        raise FormatError(
            f"{source} holds a corner at {plain_size(farthest, digits=6)}; the limit is "
            f"{plain_size(FARTHEST, digits=6)}; check its units, or export the mesh again"
        )
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise FormatError(f"{source} has triangles with corners that do not exist; export the mesh again")
    mesh = merge_unless_closed(vertices, faces)
    for note in notes:
        LOG.warning("%s: %s", source, note)
    return replace(mesh, notes=tuple(notes), modifiers=tuple(modifiers)) if notes else mesh


# Vertices and faces; some readers add notes, and that of 3MF modifiers.
MeshArrays = (
    tuple[NDArray[np.floating], NDArray[np.integer]]
    | tuple[NDArray[np.floating], NDArray[np.integer], tuple[str, ...]]
    | tuple[NDArray[np.floating], NDArray[np.integer], tuple[str, ...], tuple[Modifier, ...]]
)


def _read_3mf(path: Path) -> MeshArrays:
    """Read a 3MF; its reader is loaded for that, because a block of lines needs none."""
    from infill.formats.threemf_reading import read_3mf

    return read_3mf(path)


def _read_gltf(path: Path) -> MeshArrays:
    """Read a .glb or .gltf, whose reader is loaded for that too."""
    from infill.formats.gltf_reader import read_glb, read_gltf

    return (read_gltf if path.suffix.lower() == ".gltf" else read_glb)(path)


WRITERS: dict[str, Callable[[Surface, BinaryIO], None]] = {
    ".stl": write_stl,
    ".3mf": write_3mf,
    ".obj": write_obj,
    ".ply": write_ply,
    ".glb": write_glb,
}
PART_WRITERS: dict[str, Callable[[Sequence[Part], BinaryIO], None]] = {
    ".3mf": write_3mf_parts,
    ".glb": write_glb_parts,
}
# Of labels that share their walls.
WALL_WRITERS: dict[str, Callable[[LabelWalls, BinaryIO], None]] = {
    ".ply": write_ply_walls,
    ".vtp": write_vtp,
}
TETRAHEDRA = ".vtu"  # the suffix of labels as tetrahedra
READERS: dict[str, Callable[[Path], MeshArrays]] = {
    ".stl": read_stl,
    ".3mf": _read_3mf,
    ".obj": read_obj,
    ".ply": read_ply,
    ".off": read_off,
    ".glb": _read_gltf,
    ".gltf": _read_gltf,
}
