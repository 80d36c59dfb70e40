"""PyVista: `mesh.phasefill` and `image.phasefill`.

PyVista (0.48 or newer) reads the entry point `phasefill` of the group `pyvista.accessors`, and imports this module when
a dataset is first asked for `phasefill`. Lengths are in the unit of the dataset, which phasefill calls mm.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pyvista

from infill.errors import ParameterError
from infill.lattices.job import fill
from infill.result import Result
from infill.smoothing.job import smooth_mesh, smooth_volume
from infill.smoothing.labels import smooth_labels
from infill.surface import Surface
from infill.volume import Volume

NAME = "phasefill"  # of the accessors, and of the report in `user_dict`


@pyvista.register_dataset_accessor(NAME, pyvista.PolyData)
class MeshAccessor:
    """`mesh.phasefill` of a pyvista.PolyData: its polygons are cut into triangles, its data arrays are left out.

    Parameters
    ----------
    mesh : pyvista.PolyData
    """

    def __init__(self, mesh: pyvista.PolyData) -> None:
        self._mesh = mesh

    def smooth(self, **options: Any) -> pyvista.PolyData | pyvista.MultiBlock:  # noqa: ANN401 - of `smooth_mesh`
        """Return the mesh smoothed, by way of voxels.

        Parameters
        ----------
        **options
            Those of `infill.smooth_mesh`: `voxel` or `resolution`, `method`, `radius`, `tolerance` and more.

        Returns
        -------
        pyvista.PolyData
            Triangles, with the report as `user_dict["phasefill"]`. With `by_component`, a MultiBlock of such meshes.

        Raises
        ------
        ParameterError, GeometryError, MemoryLimitError
            As `infill.smooth_mesh`.
        """
        return dataset_of(smooth_mesh(surface_of_polydata(self._mesh), **options))

    def fill(
        self,
        pattern: object = "gyroid",
        **options: Any,  # noqa: ANN401 - of `fill`
    ) -> pyvista.PolyData | pyvista.MultiBlock:
        """Return the mesh as a shell with infill inside, its skin unchanged.

        Parameters
        ----------
        pattern : str or other
            See `infill.fill`.
        **options
            Those of `infill.fill`: `density`, `cell`, `line_width`, `wall`, `drain` and more.

        Returns
        -------
        pyvista.PolyData
            Triangles, with the report as `user_dict["phasefill"]`. For a project, a MultiBlock of part and infill.

        Raises
        ------
        ParameterError, patterns.PatternError, GeometryError, MemoryLimitError
            As `infill.fill`.
        """
        return dataset_of(fill(surface_of_polydata(self._mesh), pattern, **options))


@pyvista.register_dataset_accessor(NAME, pyvista.ImageData)
class ImageAccessor:
    """`image.phasefill` of a pyvista.ImageData: its spacing, origin, offset and direction are kept.

    Values at points lie in the middle of voxels, as those of scans do; values of cells fill their cells.

    Parameters
    ----------
    image : pyvista.ImageData
    """

    def __init__(self, image: pyvista.ImageData) -> None:
        self._image = image

    def smooth(self, *, scalars: str | None = None, **options: Any) -> pyvista.PolyData:  # noqa: ANN401 - of `smooth_volume`
        """Return a smooth surface around the solid in the image.

        Parameters
        ----------
        scalars : str, optional
            The array with the values; by default, the active one.
        **options
            Those of `infill.smooth_volume`: `threshold`, `label`, `method`, `radius`, `tolerance` and more.

        Returns
        -------
        pyvista.PolyData
            Triangles, with the report as `user_dict["phasefill"]`.

        Raises
        ------
        ParameterError
            If there is no such array, or it holds several numbers for each voxel; or as `infill.smooth_volume`.
        GeometryError, MemoryLimitError
            As `infill.smooth_volume`.
        """
        return dataset_of(smooth_volume(volume_of_image(self._image, scalars), **options))

    def labels(self, *, scalars: str | None = None, **options: Any) -> pyvista.MultiBlock:  # noqa: ANN401 - of `smooth_labels`
        """Return a smooth surface for each label of the image.

        Parameters
        ----------
        scalars : str, optional
            The array with the labels, whole numbers, 0 for none; by default, the active one.
        **options
            Those of `infill.smooth_labels`: `together`, `label`, `table` and more.

        Returns
        -------
        pyvista.MultiBlock
            A pyvista.PolyData for each label, by its name; `label_7` where the table has none. The report is its
            `user_dict["phasefill"]`.

        Raises
        ------
        ParameterError
            If there is no such array, or it holds several numbers for each voxel; or as `infill.smooth_labels`.
        GeometryError, MemoryLimitError
            As `infill.smooth_labels`.
        """
        result = smooth_labels(volume_of_image(self._image, scalars), **options)
        return with_report(blocks_of(result), result)


def surface_of_polydata(mesh: pyvista.PolyData) -> Surface:
    """Return the faces of a mesh as triangles; those with more corners, and strips, are cut up."""
    triangles = mesh.triangulate()
    has_faces = triangles.GetNumberOfPolys() > 0
    faces = np.asarray(triangles.regular_faces) if has_faces else np.empty((0, 3), dtype=np.int64)
    return Surface(vertices=np.asarray(triangles.points), faces=faces)


def volume_of_image(image: pyvista.ImageData, scalars: str | None = None) -> Volume:
    """Return an array of an image as a volume in its place.

    Parameters
    ----------
    image : pyvista.ImageData
    scalars : str, optional
        The name of the array; by default, the active one.

    Raises
    ------
    ParameterError
        If there is no such array, or it holds several numbers for each voxel.
    """
    name = image.active_scalars_name if scalars is None else scalars
    if name is None or name not in image.array_names:
        listed = ", ".join(image.array_names) or "no arrays"
        raise ParameterError.about("scalars", f"is {name!r}, and the image has {listed}; give the name of one")
    in_cells = name in image.cell_data and name not in image.point_data
    values = np.asarray(image.cell_data[name] if in_cells else image.point_data[name])
    if values.ndim > 1:
        raise ParameterError.about(
            "scalars", f"is {name!r}, with {values.shape[1]} numbers for each voxel; give an array with one"
        )
    shape = tuple(max(1, count - 1) if in_cells else count for count in image.dimensions)
    spacing, direction = np.array(image.spacing), np.array(image.direction_matrix)
    corner = np.array(image.offset) - (0.0 if in_cells else 0.5)  # of the first voxel, in voxels
    return Volume(
        values=values.reshape(shape, order="F"),
        spacing=tuple(spacing.tolist()),
        origin=tuple((image.origin + direction @ (spacing * corner)).tolist()),
        direction=direction,
    )


def dataset_of(result: Result[Any, Any]) -> pyvista.PolyData | pyvista.MultiBlock:
    """Return the only surface of a result, or all of several by their names, with its report."""
    several = len(result.surfaces) > 1
    return with_report(blocks_of(result) if several else polydata_of(result.surface), result)


def blocks_of(result: Result[Any, Any]) -> pyvista.MultiBlock:
    """Return all surfaces of a result, by their names."""
    return pyvista.MultiBlock({name: polydata_of(result.surfaces[name]) for name in result.surfaces})


def polydata_of(surface: Surface) -> pyvista.PolyData:
    """Return a surface with the same vertices and faces."""
    return pyvista.PolyData.from_regular_faces(np.asarray(surface.vertices), np.asarray(surface.faces), deep=True)


def with_report(dataset: Any, result: Result[Any, Any]) -> Any:  # noqa: ANN401 - a dataset of pyvista
    """Put the report of a result into `user_dict`, which filters hand on and files keep; return the dataset."""
    dataset.user_dict[NAME] = dict(result.report)
    return dataset
