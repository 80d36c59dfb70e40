"""napari: the panels, which napari makes of the signatures of these functions. The work runs beside the window.

Annotations are types here, not text as elsewhere: magicgui does not look up the text of what a function returns.
"""

from typing import Annotated, Any, Literal

from napari.layers import Image, Labels
from napari.qt.threading import FunctionWorker, thread_worker
from napari.types import LayerDataTuple

from infill.hosts.napari_layers import LayerData, image_to_surface, labels_to_surfaces, voxel_size

DEFAULT_TOLERANCE = 0.1  # voxels, which the library calls "auto"

# In voxels, so that one default suits layers of every scale.
Tolerance = Annotated[
    float,
    {
        "label": "tolerance, voxels",
        "min": 0.0,
        "max": 2.0,
        "step": 0.05,
        "tooltip": "How far fewer triangles may move the surface; 0 keeps them all",
    },
]
Threshold = Annotated[float, {"min": -1e9, "max": 1e9, "tooltip": "Voxels of at least this value are solid"}]
Otsu = Annotated[bool, {"label": "threshold by Otsu", "tooltip": "Find the threshold in the image"}]
Together = Annotated[bool, {"tooltip": "Neighbours share their walls, and labels keep their volumes"}]


def smooth_labels_layer(
    labels: Labels,
    method: Literal["auto", "plain", "refine"] = "auto",
    tolerance: Tolerance = DEFAULT_TOLERANCE,
    together: Together = False,
) -> FunctionWorker[list[LayerDataTuple]]:
    """Make a smooth surface of each label of a layer."""

    def work() -> list[LayerData]:
        """Smooth the labels."""
        length = tolerance_of(labels, tolerance)
        return labels_to_surfaces(labels, method=method, tolerance=length, together=together)

    return thread_worker(work, start_thread=True, progress={"desc": "Smoothing labels"})()


def smooth_image_layer(
    image: Image,
    threshold: Threshold = 0.0,
    otsu: Otsu = True,
    method: Literal["auto", "plain", "refine", "grey"] = "auto",
    tolerance: Tolerance = DEFAULT_TOLERANCE,
) -> FunctionWorker[list[LayerDataTuple]]:
    """Make a smooth surface around the solid in an image."""

    def work() -> list[LayerData]:
        """Smooth the image."""
        length = tolerance_of(image, tolerance)
        level: float | Literal["otsu"] = "otsu" if otsu else threshold
        return image_to_surface(image, threshold=level, method=method, tolerance=length)

    return thread_worker(work, start_thread=True, progress={"desc": "Smoothing an image"})()


def tolerance_of(layer: Any, voxels: float) -> float | Literal["auto"]:  # noqa: ANN401 - a layer
    """Return a tolerance as the library takes it, in the unit of the layer's scale."""
    return "auto" if voxels == DEFAULT_TOLERANCE else voxels * voxel_size(layer)
