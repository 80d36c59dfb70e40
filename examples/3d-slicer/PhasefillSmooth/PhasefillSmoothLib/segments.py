"""Smooth segments of 3D Slicer: their closed surfaces become those of phasefill, their voxels stay as they are.

Coordinates are those of the segmentation, RAS and mm. Nothing here needs a window.
"""

from __future__ import annotations

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

VOXELS, SURFACE = "Binary labelmap", "Closed surface"  # Slicer's names of representations
MARGIN = 8  # voxels of void around the segments, of which Slicer keeps no more than their box


def smooth_segments(segmentation, segment_ids=None, **options):
    """Replace the closed surfaces of segments by smooth ones; return the report.

    Several segments are smoothed together, so that neighbours share their walls. All surfaces are made before the first
    is replaced: an error leaves the segmentation as it was.

    Parameters
    ----------
    segmentation : vtkSegmentation
    segment_ids : sequence of str, optional
        By default, all segments.
    **options
        Those of `infill.smooth_labels`: `method`, `tolerance` and more.

    Returns
    -------
    dict
        The report of `infill.smooth_labels`.

    Raises
    ------
    ValueError
        If there is no segment, one has no voxels, or two overlap; and every error of `infill.smooth_labels`.
    """
    from infill import Segment, smooth_labels

    ids = list(segmentation.GetSegmentIDs() if segment_ids is None else segment_ids)
    if not ids:
        raise ValueError("the segmentation has no segments; add one, and paint it")
    segments = [segmentation.GetSegment(segment_id) for segment_id in ids]
    volume = volume_of(segments)
    table = [Segment(value=number, name=segment.GetName()) for number, segment in enumerate(segments, start=1)]
    result = smooth_labels(volume, table=table, together=len(segments) > 1, **options)
    surfaces = {label["number"]: polydata_of(result.surfaces[label["name"]]) for label in result.report["labels"]}
    segmentation.CreateRepresentation(SURFACE)  # Slicer's own, for segments that are left out
    for number, segment in enumerate(segments, start=1):
        segment.AddRepresentation(SURFACE, surfaces[number])
        segment.Modified()
    return dict(result.report)


def volume_of(segments):
    """Return the voxels of segments, numbered from 1, as an `infill.Volume` in its place."""
    from infill import Volume

    images = [segment.GetRepresentation(VOXELS) for segment in segments]
    for segment, image in zip(segments, images, strict=True):
        if image is None or image.GetNumberOfPoints() == 0:
            raise ValueError(f"the segment {segment.GetName()} has no voxels; paint it, or leave it out")
    to_world = matrix_of(images[0])
    for segment, image in zip(segments, images, strict=True):
        if not np.allclose(matrix_of(image), to_world, atol=1e-6):
            raise ValueError(f"the segment {segment.GetName()} lies on another grid; smooth it by itself")
    extents = np.array([image.GetExtent() for image in images]).reshape(-1, 3, 2)
    low, high = extents[:, :, 0].min(axis=0) - MARGIN, extents[:, :, 1].max(axis=0) + MARGIN + 1
    values = np.zeros(high - low, dtype=np.uint16)
    for number, (segment, image, extent) in enumerate(zip(segments, images, extents, strict=True), start=1):
        box = values[tuple(slice(begin, end + 1) for begin, end in extent - low[:, None])]
        cells = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(box.shape, order="F")
        inside = cells == segment.GetLabelValue()
        if not inside.any():
            raise ValueError(f"the segment {segment.GetName()} has no voxels; paint it, or leave it out")
        if box[inside].any():
            other = segments[int(box[inside].max()) - 1].GetName()
            raise ValueError(
                f"the segments {other} and {segment.GetName()} overlap; smooth each by itself, or take the overlap out"
            )
        box[inside] = number
    spacing = np.linalg.norm(to_world[:3, :3], axis=0)
    corner = to_world[:3, :3] @ (low - 0.5) + to_world[:3, 3]
    return Volume(
        values=values,
        spacing=tuple(spacing.tolist()),
        origin=tuple(corner.tolist()),
        direction=to_world[:3, :3] / spacing,
    )


def matrix_of(image):
    """Return the matrix from indices of voxels to the world of a vtkOrientedImageData, (4, 4)."""
    matrix = vtk.vtkMatrix4x4()
    image.GetImageToWorldMatrix(matrix)
    return np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])


def polydata_of(surface):
    """Return an `infill.Surface` as vtkPolyData, which holds copies."""
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(surface.vertices, dtype=np.float64), deep=True))
    faces = np.ascontiguousarray(surface.faces, dtype=np.int64)
    cells = vtk.vtkCellArray()
    rows = np.concatenate([np.full((len(faces), 1), 3, dtype=np.int64), faces], axis=1)
    cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(np.ascontiguousarray(rows.ravel()), deep=True))
    polydata = vtk.vtkPolyData()
    polydata.SetPoints(points)
    polydata.SetPolys(cells)
    return polydata


def describe(report):
    """Return the verdict on a report as lines for the panel: a line for every segment, then the problems."""
    lines = []
    for label in report["labels"]:
        own = label.get("report", label)
        change = own.get("volume_change")
        if change is None and own.get("data"):
            change = own["volume"] / own["data"] - 1
        volume = f"{own['volume'] / 1000:.2f} cm³"
        lines.append(f"{label['name']}: {volume}" + ("" if change is None else f", {change:+.2%} from its voxels"))
    return [*lines, *(report["problems"] or ["no problems"])]
