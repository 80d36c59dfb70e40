"""Meshes and points in millimetres, whatever unit their file has."""

from __future__ import annotations

import logging
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.checks import choose_word
from infill.errors import UsageError
from infill.formats.mesh_files import read_mesh
from infill.imaging.units import STATED_UNITS, UNITS, guess_unit
from infill.meshes.merging import surface_of
from infill.plain_numbers import plain_size
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh

LOG = logging.getLogger("infill")


def to_surface(mesh: str | os.PathLike[str] | trimesh.Trimesh | Surface) -> Surface:
    """Read the file of a mesh, in mm, or convert a mesh or a result of phasefill to plain arrays.

    Raises
    ------
    FormatError
        If a file cannot be read.
    GeometryError
        If there is nothing in a mesh.
    """
    return read_mesh_in_mm(mesh) if isinstance(mesh, (str, os.PathLike)) else surface_of(mesh)


def read_mesh_in_mm(path: str | os.PathLike[str], units: str | None = None) -> Surface:
    """Read the triangles of a file, in mm.

    Parameters
    ----------
    path : str or Path
        See `infill.formats.mesh_files.read_mesh`.
    units : {"um", "mm", "cm", "m", "in"}, optional
        Unit of the coordinates, whatever the file says; if left out, the unit that a .3mf or .glb states, or else mm,
        with a warning to the log "infill" if the size is implausible.
    """
    source, units = Path(path), check_units(units)
    mesh = read_mesh(source)
    stated = STATED_UNITS.get(source.suffix.lower())
    if stated is not None:
        return mesh.scaled(UNITS[units] / stated) if units else mesh
    factor = unit_in_mm(source, mesh.vertices, units)
    return mesh if factor == 1 else mesh.scaled(factor)


def check_units(units: str | None) -> str | None:
    """Check the name of a unit, or raise UsageError."""
    name = None if units is None else choose_word(units, UNITS)
    if name is not None and name not in UNITS:
        raise UsageError.about("units", f"is {units!r}; choose from {', '.join(UNITS)}")
    return name


def unit_in_mm(path: Path, points: NDArray[np.floating], units: str | None) -> float:
    """Return mm per unit; if no unit is given, warn of implausible sizes in mm."""
    if units is not None:
        return UNITS[units]
    longest = float(np.ptp(points, axis=0).max())
    unit = guess_unit(longest)
    if unit == "µm":  # as likely to be large on purpose as not, and easy to notice
        LOG.warning(
            "%s is %s long if its numbers are millimetres; give --units um if they are micrometres",
            path,
            plain_size(longest, digits=4),
        )
    elif unit != "mm" and longest > 0:
        LOG.warning(
            "%s is %s long if its numbers are millimetres; give --units m if they are metres (%s long)",
            path,
            plain_size(longest),
            plain_size(longest * 1000, digits=4),
        )
    return 1.0
