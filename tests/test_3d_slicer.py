"""The extension of 3D Slicer: `make hosts` installs slicer-core, the core of Slicer without a window; else it is skipped.

Laws: closed surfaces are the library's own, where the voxels lie; voxels stay; an error leaves everything as it was.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import infill

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "examples" / "3d-slicer"
TURN = np.array([[-1.0, 0.0, 0.0], [0.0, -0.8, 0.6], [0.0, 0.6, 0.8]])
SPACING = np.array([0.9, 1.1, 1.4])
MIDDLE = np.array([12.0, -30.0, 8.0])
RADIUS = 12.0


@pytest.fixture
def segments(monkeypatch: pytest.MonkeyPatch):
    """The module of the extension, as Slicer imports it."""
    pytest.importorskip("slicer_core", reason="slicer-core is not here: `make hosts` installs it")
    monkeypatch.syspath_prepend(FOLDER / "PhasefillSmooth")
    from PhasefillSmoothLib import segments

    yield segments
    for name in [name for name in sys.modules if name.startswith("PhasefillSmoothLib")]:
        del sys.modules[name]


def image_of(mask: np.ndarray, *, first: tuple[int, ...] = (0, 0, 0)):
    """Return voxels as Slicer keeps those of a segment: the box around them, in a turned grid around `MIDDLE`."""
    import vtk
    from slicer_core import vtkOrientedImageData
    from vtk.util.numpy_support import numpy_to_vtk

    image = vtkOrientedImageData()
    low = np.argwhere(mask).min(axis=0)
    high = np.argwhere(mask).max(axis=0)
    box = mask[tuple(slice(a, b + 1) for a, b in zip(low, high, strict=True))]
    low, high = low + first, high + first
    image.SetExtent(*np.stack([low, high], axis=1).ravel().tolist())
    matrix, placed = vtk.vtkMatrix4x4(), np.eye(4)
    placed[:3, :3] = TURN * SPACING
    placed[:3, 3] = MIDDLE - placed[:3, :3] @ (np.array(mask.shape) / 2 - 0.5 + first)
    matrix.DeepCopy(placed.ravel().tolist())
    image.SetGeometryFromImageToWorldMatrix(matrix)
    scalars = numpy_to_vtk(np.ascontiguousarray(box.astype(np.uint8).ravel(order="F")), deep=True)
    image.GetPointData().SetScalars(scalars)
    return image


def halves(**place: tuple[int, ...]):
    """Return a segmentation of a ball in two segments that touch."""
    from slicer_core import vtkSegment, vtkSegmentation

    shape = np.ceil(2 * (RADIUS + 2) / SPACING).astype(int)
    middle = np.reshape(shape / 2 - 0.5, (3, 1, 1, 1))
    offsets = (np.indices(shape) - middle) * np.reshape(SPACING, (3, 1, 1, 1))
    ball = (offsets**2).sum(axis=0) < RADIUS**2
    segmentation = vtkSegmentation()
    segmentation.SetSourceRepresentationName("Binary labelmap")
    for name, mask in (("left", ball & (offsets[0] < 0)), ("right", ball & (offsets[0] >= 0))):
        segment = vtkSegment()
        segment.SetName(name)
        segment.AddRepresentation("Binary labelmap", image_of(mask, **place))
        segmentation.AddSegment(segment, name)
    return segmentation


def surface_of(segmentation, name: str) -> infill.Surface:
    from vtk.util.numpy_support import vtk_to_numpy

    polydata = segmentation.GetSegment(name).GetRepresentation("Closed surface")
    faces = vtk_to_numpy(polydata.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return infill.Surface(vertices=vtk_to_numpy(polydata.GetPoints().GetData()), faces=faces)


@pytest.mark.parametrize("first", [(0, 0, 0), (5, -7, 3)], ids=["from zero", "from elsewhere"])
def test_all_segments_are_smoothed_together_in_place(segments, first: tuple[int, ...]) -> None:
    segmentation = halves(first=first)
    voxels = [
        segmentation.GetSegment(name).GetRepresentation("Binary labelmap").GetMTime() for name in ("left", "right")
    ]
    report = segments.smooth_segments(segmentation)
    left, right = (surface_of(segmentation, name) for name in ("left", "right"))
    assert left.closed
    assert right.closed
    assert left.volume + right.volume == pytest.approx(4 / 3 * np.pi * RADIUS**3, rel=0.02)
    for half, side in ((left, -1), (right, 1)):
        distances = np.linalg.norm(half.vertices - MIDDLE, axis=1)
        assert distances.max() < RADIUS + SPACING.max()
        along = (half.vertices - MIDDLE) @ TURN[:, 0] * side
        assert -SPACING[0] < along.min() < along.mean()
        assert along.mean() > RADIUS / 4
    shared = {tuple(vertex) for vertex in left.vertices} & {tuple(vertex) for vertex in right.vertices}
    assert len(shared) > 50
    assert report["closed"]
    lines = segments.describe(report)
    assert [line.split(":")[0] for line in lines] == ["left", "right", "no problems"]
    assert re.fullmatch(r"left: 3\.\d\d cm³, [+-]0\.0\d% from its voxels", lines[0])
    after = [
        segmentation.GetSegment(name).GetRepresentation("Binary labelmap").GetMTime() for name in ("left", "right")
    ]
    assert after == voxels


def test_one_segment_is_smoothed_by_itself(segments) -> None:
    segmentation = halves()
    report = segments.smooth_segments(segmentation, ["right"], tolerance=0)
    own = infill.smooth_labels(segments.volume_of([segmentation.GetSegment("right")]), tolerance=0)
    assert np.array_equal(surface_of(segmentation, "right").vertices, own.surface.vertices)
    assert [label["name"] for label in report["labels"]] == ["right"]
    assert len(segments.describe(report)) == 2


def test_an_error_is_a_line_and_leaves_all_as_it_was(segments) -> None:
    from slicer_core import vtkSegmentation

    with pytest.raises(ValueError, match="^the segmentation has no segments; add one"):
        segments.smooth_segments(vtkSegmentation())
    segmentation = halves()
    left = segmentation.GetSegment("left").GetRepresentation("Binary labelmap")
    with pytest.raises(ValueError, match="^method is 'best'; choose from"):
        segments.smooth_segments(segmentation, method="best")
    segmentation.GetSegment("right").AddRepresentation("Binary labelmap", left)
    with pytest.raises(ValueError, match="^the segments left and right overlap; smooth each by itself"):
        segments.smooth_segments(segmentation)
    for name in ("left", "right"):
        assert segmentation.GetSegment(name).GetRepresentation("Closed surface") is None


def test_the_source_folder_is_that_of_an_extension() -> None:
    """Every script is named to CMake, and the module, its panel and its logic have the names that Slicer looks for."""
    module = FOLDER / "PhasefillSmooth"
    listed = set(re.findall(r"[\w/]+\.py", (module / "CMakeLists.txt").read_text(encoding="utf-8")))
    there = {path.relative_to(module).as_posix() for path in module.rglob("*.py")}
    assert {name for name in there if name != "PhasefillSmooth.py"} == listed
    assert "SCRIPTS ${MODULE_NAME}.py" in (module / "CMakeLists.txt").read_text(encoding="utf-8")
    assert "add_subdirectory(PhasefillSmooth)" in (FOLDER / "CMakeLists.txt").read_text(encoding="utf-8")
    tree = ast.parse((module / "PhasefillSmooth.py").read_text(encoding="utf-8"))
    classes = {node.name for node in tree.body if isinstance(node, ast.ClassDef)}
    assert classes == {"PhasefillSmooth", "PhasefillSmoothWidget", "PhasefillSmoothLogic"}
