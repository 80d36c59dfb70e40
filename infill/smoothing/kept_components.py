"""The components of a scan or of a mesh before smoothing, by falling volume, and the input with some of them alone.

Numbers count from 1, the largest; of two of the same volume, the first in the grid or the file comes first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError, ParameterError
from infill.isosurfaces.components import Components, component_cells, data_bits, erase_components, find_components
from infill.meshes.split_components import concatenate_surfaces, split_components
from infill.options.keyword_options import parse_ranges
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.scans import Threshold, threshold_range
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.from_mesh import voxel_size
from infill.voxels.segmentation import segment_volume

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField


def choose_components(value: object, count: int) -> NDArray[np.bool_]:
    """Tell which of `count` components are chosen: (count,) bool.

    Raises
    ------
    ParameterError
        If there is none with a number, or the text cannot be read.

    >>> choose_components("1,3-", 4).tolist()
    [True, False, True, True]
    """
    name = "keep_components"
    chosen = np.zeros(count, dtype=bool)
    for low, high in parse_ranges(name, value):
        last = count if high is None else high
        if max(low, last) > count:
            raise ParameterError.about(
                name,
                f"names component {max(low, last)}, and there {'is 1' if count == 1 else f'are {count}'}; give less",
            )
        chosen[low - 1 : last] = True
    return chosen


@dataclass(frozen=True, kw_only=True, eq=False)
class ScanComponents:
    """The components of the solid in a scan.

    Parameters
    ----------
    scan : Volume
    solid : (nx, ny, nz) bool
    threshold : threshold of `infill.smooth_volume`
        One that does not depend on the values of all cells.
    field : SparseField
    components : Components
    order : (b,) int64
        Places of the components in `components`, by falling volume.
    """

    scan: Volume
    solid: NDArray[np.bool_]
    threshold: Threshold
    field: SparseField
    components: Components
    order: NDArray[np.int64]

    @property
    def volumes(self) -> NDArray[np.float64]:
        """Volumes, falling, (b,) mm³."""
        cells = self.components.cells[self.order].astype(np.float64)
        return cells * self.scan.cell_volume

    def place(self, number: int) -> list[float]:
        """Return a point in a component, counted from 0: x, y, z in mm."""
        cells = component_cells(self.field, self.components, int(self.order[number]))
        cell = cells[np.argmin(((cells - cells.mean(axis=0)) ** 2).sum(axis=1))]
        return self.scan.place((cell[None] + 0.5) * self.scan.cell_size)[0].tolist()  # type: ignore[no-any-return]

    def keep(self, chosen: NDArray[np.bool_]) -> Volume:
        """Return the scan with the cells of all other components void; `chosen` is (b,) bool, by falling volume."""
        if chosen.all():
            return self.scan
        dropped = np.zeros(len(chosen), dtype=bool)
        dropped[self.order[~chosen]] = True
        left = erase_components(self.solid, self.field, self.components, dropped)
        values: NDArray[Any] = self.scan.values
        around = values[~self.solid]
        is_above = isinstance(self.threshold, tuple) and self.threshold[0] is None
        void = around.max() if is_above else around.min()
        return replace(self.scan, values=np.where(self.solid & ~left, void, values).astype(values.dtype))


def find_scan_components(
    scan: Volume, *, threshold: Threshold = None, label: int | Sequence[int] | None = None, threads: int | None = None
) -> ScanComponents:
    """Find the components of the solid in a scan; the arguments are those of `infill.smooth_volume`."""
    (low, high), otsu = threshold_range(threshold), isinstance(threshold, str)
    mask, used = segment_volume(scan, low=low, high=high, label=label, otsu=otsu)
    solid = np.asarray(mask.values) > 0
    field = smooth_bricks(solid, Smoothing(steps=0), threads=threads)
    components = find_components(field, data_bits(field, threads=threads))
    fixed: Threshold = used["low"] if otsu else threshold
    order = np.argsort(-components.cells, kind="stable")
    return ScanComponents(scan=scan, solid=solid, threshold=fixed, field=field, components=components, order=order)


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshComponents:
    """The components of a mesh, each with its cavities.

    Parameters
    ----------
    surface : Surface, mm
    parts : tuple of Surface, mm
        By falling volume.
    """

    surface: Surface
    parts: tuple[Surface, ...]

    @property
    def volumes(self) -> NDArray[np.float64]:
        """Volumes, (b,) mm³."""
        return np.array([abs(part.volume) for part in self.parts])

    def place(self, number: int) -> list[float]:
        """Return a vertex of a component, counted from 0: x, y, z in mm."""
        vertices = np.asarray(self.parts[number].vertices, dtype=np.float64)
        return vertices[np.argmin(((vertices - vertices.mean(axis=0)) ** 2).sum(axis=1))].tolist()  # type: ignore[no-any-return]

    def keep(self, chosen: NDArray[np.bool_]) -> Surface:
        """Return the mesh without the other components; `chosen` is (b,) bool."""
        if chosen.all():
            return self.surface
        left = concatenate_surfaces([part for part, is_left in zip(self.parts, chosen, strict=True) if is_left])
        return replace(left, notes=self.surface.notes, space=self.surface.space)


def find_mesh_components(
    surface: Surface, *, resolution: int | None = None, voxel: float | None = None
) -> MeshComponents:
    """Find the components of a mesh that enclose something; the arguments are those of `infill.smooth_mesh`."""
    corners = np.asarray(surface.vertices)[np.unique(surface.faces)]
    longest = float(np.ptp(corners, axis=0).max()) if len(corners) else 0.0
    if not longest > 0:
        raise GeometryError("all corners of the mesh are one point, so nothing is inside; give a closed mesh")
    parts = split_components(surface, voxel_size(longest, voxel=voxel, resolution=resolution))
    return MeshComponents(surface=surface, parts=parts.surfaces)


def keep_in_scan(
    scan: Volume, numbers: object, *, threshold: Threshold, label: int | Sequence[int] | None
) -> tuple[Volume, Threshold]:
    """Return a scan with the components of these numbers alone, and the threshold, a number if it was to be found.

    Raises
    ------
    ParameterError
        If there is no component of a number.
    """
    components = find_scan_components(scan, threshold=threshold, label=label)
    return components.keep(choose_components(numbers, len(components.order))), components.threshold


def keep_in_mesh(surface: Surface, numbers: object, *, resolution: int | None, voxel: float | None) -> Surface:
    """Return a mesh with the components of these numbers alone; see `keep_in_scan`."""
    components = find_mesh_components(surface, resolution=resolution, voxel=voxel)
    return components.keep(choose_components(numbers, len(components.parts)))
