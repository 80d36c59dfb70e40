"""The stages of smoothing, data, field and surface, and the place of a surface in space."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.isosurfaces.sparse_marching import extract_bricks
from infill.machine import require_memory
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.surface import Surface
from infill.volume import Volume

if TYPE_CHECKING:
    from PIL import Image

    from infill.isosurfaces.levels import LevelSurface


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothStages:
    """The stages of `infill.smooth_volume`, `infill.smooth_mesh` and `infill.smooth_points`.

    Parameters
    ----------
    data : Volume
        The solid on the grid, and the place of the grid in space.
    levelled : LevelSurface
        The smoothed field in bricks, the surface in cells of the grid, and the level of each component.
    given : Surface, optional
        The input mesh, mm.
    """

    data: Volume
    levelled: LevelSurface
    given: Surface | None = None

    def staircase(self) -> Surface:
        """Return the surface of the data, mm, in the same place as the result."""
        return raw_surface(self.levelled.field, self.data, None)

    def before(self) -> Surface:
        """Return the input mesh, or the surface of the data, mm."""
        return self.staircase() if self.given is None else self.given

    def field(self) -> Volume:
        """Return the whole field, minus its level, so that the surface lies at 0: float32, [x, y, z].

        For a surface at the level that keeps the volume, it is the distance from the surface, +-1 some cells away.

        Raises
        ------
        MemoryLimitError
            If it does not fit into memory.
        """
        require_memory(4 * self.data.values.size, None, "write a mesh instead of the field, or use larger voxels")
        values = self.levelled.field.to_dense()
        values -= np.float32(self.levelled.height)
        return replace(self.data, values=values.clip(-1, 1, out=values))

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return a picture of the input (a mesh, or the surface of the voxels) beside the smoothed surface."""
        from infill.pictures.before_and_after import draw_before_and_after

        shape = " x ".join(map(str, report["grid"]["shape"]))
        input_surface = self.before()
        before = f"data: {shape} voxels" if self.given is None else f"given: {len(input_surface.faces):,} triangles"
        after = f"smoothed: {report['request']['steps']} steps, {report['triangles']:,} triangles"
        cell = float(self.data.cell_size.max())
        return draw_before_and_after(input_surface, surface, cell=cell, report=report, captions=(before, after))


def surface_of_data(data: Volume, threads: int | None) -> Surface:
    """Extract the surface of data as they are, placed in space."""
    return raw_surface(smooth_bricks(data.values, Smoothing(steps=0), threads=threads), data, threads)


def raw_surface(field: SparseField, data: Volume, threads: int | None) -> Surface:
    """Extract the surface of the unsmoothed data in the bricks, placed in space."""
    grey = replace(field, values=field.data.astype(np.float32))
    return place_surface(extract_bricks(grey, spacing=tuple(data.cell_size), threads=threads), data)


def place_surface(surface: Surface, data: Volume) -> Surface:
    """Move a surface from grid coordinates to the place of the volume in space."""
    return surface.moved(data.place(surface.vertices), space=data.space, mirrored=data.mirrored)
