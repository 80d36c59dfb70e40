"""Plan the smoothing of labels together without doing it: the labels, and expected time and memory.

Time grows with the grid and with the faces of cells between labels. What a cell and a face take is measured on two
small scenes, since it depends on the machine, on its load, and on the options.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Unpack

import numpy as np

from infill.imaging.label_tables import Segment
from infill.imaging.segmentations import Segmentation
from infill.kernels.compiling import log_compilation
from infill.phasefield.schedule import MIN_STEPS
from infill.smoothing.label_pieces import find_pieces
from infill.smoothing.label_stages import FACES_PER_RUN, LabelPiece
from infill.smoothing.plan import BYTES_BEFORE
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.smoothing.together import needed_memory, refuse_layers, refuse_unfit, smooth_together
from infill.smoothing.together_stages import BYTES_PER_CELL
from infill.volume import Volume
from infill.voxels.labels import label_extents

if TYPE_CHECKING:
    from infill.reports.smoothing import LabelsForecast

TRIANGLES_PER_FACE = 5.0  # of a label, for each face of its cells, as its runs count them
SCENE, LARGE_SCENE = 24, 112  # cells along the sides of the scenes
MOST_LABELS = 7  # of the scene
EDGE = 4  # cells along the sides of the blocks of the scene that are labels: those of scans are as thin


def plan_together(
    segmentation: Segmentation,
    *,
    begin: float,
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    tetrahedra: bool = False,
    **options: Unpack[SmoothOptions],
) -> LabelsForecast:
    """Return the plan for `infill.smooth_labels` with `together` and the same arguments, as plain numbers.

    Parameters
    ----------
    segmentation : Segmentation
    begin : float
        Start of reading it, by `time.perf_counter`.
    label, table, **options
        See `infill.smooth_labels`.
    tetrahedra : bool
        Whether tetrahedra are made too.

    Raises
    ------
    ParameterError
        If there is no label, or the requested one is missing.
    UsageError
        As `infill.smoothing.together.smooth_together`.
    """
    request = SmoothRequest(**options)
    refuse_unfit(request)
    pieces = find_pieces(segmentation, label, tuple(table))
    refuse_layers(pieces)
    volume = segmentation.layers[pieces[0].segment.layer]
    cells = volume.values.size
    loaded = time.perf_counter()
    seconds = loaded - begin + expected_seconds(cells, pieces, volume, request, tetrahedra=tetrahedra)
    memory = needed_memory(cells, pieces, request)
    memory += 0 if segmentation.shares is None else 2 * segmentation.shares.nbytes
    memory = max(memory, cells * BYTES_PER_CELL if tetrahedra else 0)
    return plan_labels_together(pieces, volume, request, memory=memory, seconds=seconds)


def plan_labels_together(
    pieces: Sequence[LabelPiece], volume: Volume, request: SmoothRequest, *, memory: int, seconds: float
) -> LabelsForecast:
    """Return the plan for labels, with the bytes and the seconds that they take."""
    return {
        "request": request.for_cell(float(volume.cell_size.min())).facts(),
        "labels": [
            {
                **piece.place,
                "data": volume.cell_volume * piece.extent.cells,
                "triangles_before": round(TRIANGLES_PER_FACE * count_faces([piece])),
            }
            for piece in pieces
        ],
        "memory": round(BYTES_BEFORE + memory),
        "seconds": {"total": seconds},
    }


def count_faces(pieces: Sequence[LabelPiece]) -> int:
    """Count the faces of the cells of labels, about, from their runs."""
    return sum(FACES_PER_RUN * piece.extent.runs for piece in pieces)


@log_compilation("the smoother")
def expected_seconds(
    cells: int, pieces: Sequence[LabelPiece], volume: Volume, request: SmoothRequest, *, tetrahedra: bool
) -> float:
    """Estimate the time of a run by two scenes with the same labels, in a small grid and a larger one."""
    faces = count_faces(pieces)
    spacing = tuple(volume.cell_size.tolist())
    shortest = replace(request, smoothing=replace(request.smoothing, steps=min(request.smoothing.steps, MIN_STEPS)))
    _time_scene(SCENE, spacing, shortest, tetrahedra=tetrahedra)  # loads what a run needs
    small, of_small, in_tetrahedra = _time_scene(SCENE, spacing, request, tetrahedra=tetrahedra)
    large, _, _ = _time_scene(LARGE_SCENE, spacing, request, tetrahedra=False)
    per_cell = max(0.0, large - small) / (LARGE_SCENE**3 - SCENE**3)
    per_face = max(0.0, small - per_cell * SCENE**3) / of_small
    return cells * (per_cell + in_tetrahedra / SCENE**3) + faces * per_face


def _time_scene(
    size: int, spacing: tuple[float, ...], request: SmoothRequest, *, tetrahedra: bool
) -> tuple[float, int, float]:
    """Smooth the scene in a grid of this size; return the seconds, the faces of labels, and seconds of tetrahedra."""
    blocks = np.indices((SCENE,) * 3) // EDGE
    labels = np.zeros((size,) * 3, dtype=np.uint8)
    weights = np.array([1, 2, 4]).reshape(3, 1, 1, 1)
    labels[:SCENE, :SCENE, :SCENE] = (blocks * weights).sum(axis=0) % MOST_LABELS + 1
    volume = Volume(values=labels, spacing=spacing)
    pieces = [
        LabelPiece(name=f"label_{extent.value}", segment=Segment(value=extent.value), extent=extent)
        for extent in label_extents(volume)
    ]
    begin = time.perf_counter()
    result = smooth_together(volume, pieces, replace(request, progress=None), [])
    smoothed = time.perf_counter()
    if tetrahedra:
        _ = result.stages.tetrahedra
    return smoothed - begin, count_faces(pieces), time.perf_counter() - smoothed
