"""napari: layers of labels and images become layers of surfaces, and these become files.

Lengths are those of a layer's scale, which phasefill calls mm. Nothing here opens a window.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.files.whole_files import atomic_file
from infill.formats.mesh_files import PART_WRITERS, mesh_writer
from infill.formats.parts import Part
from infill.lazy.dask_arrays import is_dask
from infill.meshes.split_components import concatenate_surfaces
from infill.smoothing.job import smooth_volume
from infill.smoothing.labels import smooth_labels
from infill.surface import Surface

LayerData = tuple[Any, dict[str, Any], str]  # data, attributes and type, as napari passes layers on

NAME = "phasefill"  # of the report in the metadata of a layer
AXES = 3
PLACE = ("scale", "translate", "rotate", "shear", "affine", "units", "axis_labels")  # attributes of a layer's place


def labels_to_surfaces(layer: Any, **options: Any) -> list[LayerData]:  # noqa: ANN401 - a layer, and options of `smooth_labels`
    """Return a layer of a smooth surface for each label of a layer, in its colour.

    Parameters
    ----------
    layer : napari.layers.Labels
        With three axes.
    **options
        Those of `infill.smooth_labels`: `method`, `tolerance`, `together`, `label` and more.

    Returns
    -------
    list of (data, attributes, "surface")
        In the place of the layer. The metadata hold the report as "phasefill": of labels together, that of all.

    Raises
    ------
    ParameterError
        If the layer does not have three axes; or as `infill.smooth_labels`.
    GeometryError, MemoryLimitError
        As `infill.smooth_labels`.
    """
    values, grid = _values_and_grid(layer)
    result: Any = smooth_labels(values, **grid, **options)
    return [
        _surface_layer(
            result.surfaces[label["name"]],
            layer,
            name=label["name"],
            report=label.get("report", result.report),
            colour=layer.colormap.map(label["number"]),
        )
        for label in result.report["labels"]
    ]


def image_to_surface(layer: Any, **options: Any) -> list[LayerData]:  # noqa: ANN401 - a layer, and options of `smooth_volume`
    """Return a layer of a smooth surface around the solid in an image.

    Parameters
    ----------
    layer : napari.layers.Image
        With three axes, and one value for each voxel.
    **options
        Those of `infill.smooth_volume`: `threshold`, `method`, `tolerance` and more.

    Returns
    -------
    list of (data, attributes, "surface")
        One, in the place of the layer. The metadata hold the report as "phasefill".

    Raises
    ------
    ParameterError
        If the layer does not have three axes and one value for each voxel; or as `infill.smooth_volume`.
    GeometryError, MemoryLimitError
        As `infill.smooth_volume`.
    """
    values, grid = _values_and_grid(layer)
    result = smooth_volume(values, **grid, **options)
    return [_surface_layer(result.surface, layer, name="surface", report=result.report)]


def voxel_size(layer: Any) -> float:  # noqa: ANN401 - a layer
    """Return the longest side of a voxel of a layer, in the unit of its scale."""
    return max(_cell_size(layer))


def write_surfaces(path: str, layers: Sequence[LayerData]) -> list[str]:
    """Write layers of surfaces to a file as napari shows them, x first; return its path.

    Parameters
    ----------
    path : str
        .stl, .3mf, .obj, .ply or .glb. In a .3mf or .glb, each layer is a mesh with its name.
    layers : sequence of (data, attributes, type)

    Raises
    ------
    FormatError
        For another suffix.
    ParameterError
        If a surface does not have three axes.
    OutputError
        If the file cannot be written.
    """
    target = Path(path)
    parts = [
        Part(surface=surface_in_world(data, attributes), name=attributes.get("name", ""))
        for data, attributes, _ in layers
    ]
    suffix, write_one = target.suffix.lower(), mesh_writer(target)
    with atomic_file(target) as file:
        if suffix in PART_WRITERS:
            PART_WRITERS[suffix](parts, file)
        else:
            write_one(concatenate_surfaces([part.surface for part in parts]), file)
    return [str(target)]


def _values_and_grid(layer: Any) -> tuple[Any, dict[str, Any]]:  # noqa: ANN401 - a layer
    """Return the values of a layer, in its order of axes, with the spacing and the origin of the grid."""
    values = layer.data[0] if layer.multiscale else layer.data
    if values.ndim != AXES or getattr(layer, "rgb", False):
        kind = "colours" if getattr(layer, "rgb", False) else f"{values.ndim} axes"
        raise ParameterError.about("layer", f"{layer.name!r} has {kind}; give one of three axes, with a value a voxel")
    size = _cell_size(layer)
    return values if is_dask(values) else np.asarray(values), {"spacing": size, "origin": tuple(-x / 2 for x in size)}


def _cell_size(layer: Any) -> tuple[float, ...]:  # noqa: ANN401 - a layer
    """Return the size of the voxels of a layer along its own axes."""
    return tuple(abs(float(x)) for x in layer.scale)


def _surface_layer(
    surface: Surface,
    layer: Any,  # noqa: ANN401 - a layer
    *,
    name: str,
    report: Any,  # noqa: ANN401 - of any product
    colour: NDArray[Any] | None = None,
) -> LayerData:
    """Return a surface as a layer in the place of another; vertices count its voxels, from the middle of the first."""
    attributes = {key: getattr(layer, key) for key in PLACE if hasattr(layer, key)}
    attributes |= {"name": f"{layer.name} {name}", "shading": "smooth", "metadata": {NAME: dict(report)}}
    if colour is not None:
        from napari.utils.colormaps import Colormap

        attributes["colormap"] = Colormap([colour, colour], name=f"{layer.name} {name}")
    return (surface.vertices / np.array(_cell_size(layer)), surface.faces), attributes, "surface"


def surface_in_world(data: Any, attributes: dict[str, Any]) -> Surface:  # noqa: ANN401 - of a layer
    """Return the data of a surface layer as they lie in the world of napari, the last axis first.

    Parameters
    ----------
    data : (vertices, faces) and more
        Of a layer; vertices (V, 3), faces (F, 3).
    attributes : dict
        Of the layer, with its scale, translation, rotation, shear and matrix.

    Raises
    ------
    ParameterError
        If the vertices do not have three axes.
    """
    from napari.utils.transforms import Affine

    vertices, faces = np.asarray(data[0], dtype=np.float64), np.asarray(data[1])
    if vertices.shape[1] != AXES:
        raise ParameterError.about("layer", f"has surfaces of {vertices.shape[1]} axes; give surfaces of three")
    own = {key: attributes[key] for key in ("scale", "translate", "rotate", "shear") if attributes.get(key) is not None}
    placing = Affine(**own, ndim=AXES)
    placed, turns = placing(vertices), float(np.linalg.det(placing.linear_matrix))
    if attributes.get("affine") is not None:
        affine = attributes["affine"]
        matrix = np.asarray(getattr(affine, "affine_matrix", affine))
        placed, turns = Affine(affine_matrix=matrix)(placed), turns * float(np.linalg.det(matrix[:AXES, :AXES]))
    # With the order of the axes reversed, faces run the other way round, unless the layer is mirrored.
    return Surface(vertices=np.asarray(placed)[:, ::-1], faces=faces[:, ::-1] if turns > 0 else faces)
