"""Infill patterns as smooth, watertight, printable meshes.

Names are loaded on first use, so that a command does not pay for what it does not need.

>>> from infill import make
>>> make("honeycomb", size=(20, 20), height=3).mesh.is_volume
True
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

from infill.version import __version__ as __version__

if TYPE_CHECKING:
    from infill.errors import (
        FormatError,
        GeometryError,
        InfillError,
        MemoryLimitError,
        OutputError,
        ParameterError,
        UsageError,
    )
    from infill.formats.mesh_files import read_mesh, save
    from infill.formats.point_files import read_points
    from infill.grid import Grid
    from infill.imaging.label_tables import Segment, read_labels
    from infill.imaging.segmentations import Segmentation, read_segmentation
    from infill.imaging.volume_files import read_volume
    from infill.inspection.printability import Inspection, check
    from infill.inspection.width import WallWidth, wall_width
    from infill.isosurfaces.marching import isosurface
    from infill.isosurfaces.stacking import extrude, stack
    from infill.lattices.groups import Graded, Meshing, Shell
    from infill.lattices.job import fill
    from infill.lattices.regions import Region
    from infill.making.block import make
    from infill.phasefield.allen_cahn import Smoothing, rescale
    from infill.phasefield.methods import smooth
    from infill.projects.doctor import Diagnosis, check_project
    from infill.projects.saving import save_project
    from infill.refilling.job import RefillResult, refill
    from infill.result import Result
    from infill.samples.catalogue import write_sample
    from infill.smoothing.job import smooth_mesh, smooth_points, smooth_volume
    from infill.smoothing.labels import smooth_labels
    from infill.surface import Surface
    from infill.timing.printing_time import Motion, motion
    from infill.verifying.job import Verification, verify
    from infill.verifying.violations import Violation
    from infill.volume import Volume
    from infill.voxels.stamping import stamp, stamp_lines

_HOMES = {
    "phasefield.allen_cahn": ("Smoothing", "rescale"),
    "errors": (
        "FormatError",
        "GeometryError",
        "InfillError",
        "MemoryLimitError",
        "OutputError",
        "ParameterError",
        "UsageError",
    ),
    "refilling.job": ("RefillResult", "refill"),
    "lattices.groups": ("Graded", "Meshing", "Shell"),
    "lattices.job": ("fill",),
    "lattices.regions": ("Region",),
    "formats.mesh_files": ("read_mesh", "save"),
    "grid": ("Grid",),
    "inspection.printability": ("Inspection", "check"),
    "timing.printing_time": ("Motion", "motion"),
    "making.block": ("make",),
    "verifying.job": ("Verification", "verify"),
    "verifying.violations": ("Violation",),
    "result": ("Result",),
    "formats.point_files": ("read_points",),
    "samples.catalogue": ("write_sample",),
    "smoothing.labels": ("smooth_labels",),
    "imaging.label_tables": ("Segment", "read_labels"),
    "imaging.segmentations": ("Segmentation", "read_segmentation"),
    "smoothing.job": ("smooth_mesh", "smooth_points", "smooth_volume"),
    "phasefield.methods": ("smooth",),
    "isosurfaces.stacking": ("extrude", "stack"),
    "voxels.stamping": ("stamp", "stamp_lines"),
    "imaging.volume_files": ("read_volume",),
    "projects.doctor": ("Diagnosis", "check_project"),
    "projects.saving": ("save_project",),
    "surface": ("Surface",),
    "isosurfaces.marching": ("isosurface",),
    "volume": ("Volume",),
    "inspection.width": ("WallWidth", "wall_width"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Diagnosis",
    "FormatError",
    "GeometryError",
    "Graded",
    "Grid",
    "InfillError",
    "Inspection",
    "MemoryLimitError",
    "Meshing",
    "Motion",
    "OutputError",
    "ParameterError",
    "RefillResult",
    "Region",
    "Result",
    "Segment",
    "Segmentation",
    "Shell",
    "Smoothing",
    "Surface",
    "UsageError",
    "Verification",
    "Violation",
    "Volume",
    "WallWidth",
    "check",
    "check_project",
    "extrude",
    "fill",
    "isosurface",
    "make",
    "motion",
    "read_labels",
    "read_mesh",
    "read_points",
    "read_segmentation",
    "read_volume",
    "refill",
    "rescale",
    "save",
    "save_project",
    "smooth",
    "smooth_labels",
    "smooth_mesh",
    "smooth_points",
    "smooth_volume",
    "stack",
    "stamp",
    "stamp_lines",
    "verify",
    "wall_width",
    "write_sample",
]


def __getattr__(name: str) -> object:
    if name not in _HOME_OF:
        raise AttributeError(f"module 'infill' has no attribute {name!r}")
    return getattr(importlib.import_module(f"infill.{_HOME_OF[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
