"""Places and marks of DICOM frames, from the header of their file.

    functional groups   of each frame or all: Plane Position, Plane Orientation, Pixel Measures, Pixel Value
                        Transformation
    top level           the same for a file of one frame; Grid Frame Offset Vector of a dose; Slice Vector and Spacing
                        Between Slices of nuclear medicine

Source: DICOM PS3.3, C.7.6.16 (functional groups), C.8.8.3 (dose), C.8.4.15 (nuclear medicine).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from infill.imaging.dicom.elements import (
    Mark,
    read_first_item,
    read_items,
    read_number,
    read_numbers,
    read_whole_number,
    to_mark,
)

if TYPE_CHECKING:
    from pydicom.dataset import Dataset

DIRECTION_TOLERANCE = 1e-3  # tolerance for directions of frames: files keep few digits
PLACE_TOLERANCE = 0.01  # mm: likewise for places
MOST_NESTED = 4  # sequences within those of a frame
# Marks that distinguish volumes at the same place, in the order in which they are tried. Those of the first group count
# even where all frames together would lie in even steps.
VOLUME_MARKS = (
    "StackID",
    "TemporalPositionIndex",
    "TemporalPositionIdentifier",
    "TemporalPositionTimeOffset",
    "NominalPercentageOfCardiacPhase",
    "NominalPercentageOfRespiratoryPhase",
    "EffectiveEchoTime",
    "EchoNumbers",
    "EchoTime",
    "DiffusionBValue",
    "ComplexImageComponent",
    "TimeSlotVector",
    "PhaseVector",
    "EnergyWindowVector",
    "DetectorVector",
    "RRIntervalVector",
)
OTHER_MARKS = (
    "DiffusionGradientOrientation",
    "DiffusionDirectionality",
    "TriggerTime",
    "NominalCardiacTriggerDelayTime",
    "InversionTimes",
    "InversionTime",
    "FlipAngle",
    "KVP",
    "ConvolutionKernel",
    "FrameType",
    "ImageType",
    "FrameReferenceTime",
    "AcquisitionNumber",
    "FrameReferenceDateTime",
    "FrameAcquisitionDateTime",
    "AcquisitionDateTime",
    "AcquisitionTime",
)
MARKS = frozenset((*VOLUME_MARKS, *OTHER_MARKS))
VECTORS = ("TimeSlotVector", "PhaseVector", "EnergyWindowVector", "DetectorVector", "RRIntervalVector")
PROJECTION_VECTORS = ("RotationVector", "AngularViewVector")  # views of a camera from around, not slices
FRAME_TIME_TAGS = {0x00181063: "FrameTime", 0x00181065: "FrameTimeVector"}
# Dimensions that give the position of a frame in its volume.
IN_SPACE = {
    "ImagePositionPatient",
    "ImagePositionVolume",
    "InStackPositionNumber",
    "SliceLocation",
    "PlanePositionSequence",
    "PlanePositionVolumeSequence",
    "ImageOrientationPatient",
}


@dataclass(frozen=True, kw_only=True)
class Frame:
    """One frame of a file: its place, and marks of the volume to which it belongs.

    Parameters
    ----------
    path : Path
    number : int
        Index in its file, counted from 0.
    shape : (rows, columns)
    position : (x, y, z), optional
        Centre of the first pixel, mm.
    axes : 6 floats, optional
        Direction along a row, and down a column.
    pixel : (down, along), optional
        Distance of rows, and distance of columns, mm.
    between, thickness : float, optional
        Stated distance and thickness of frames, mm.
    slope, intercept : float
        Scale from stored numbers to values.
    marks : mapping of str to tuple
        Marks that distinguish volumes at the same place, such as an echo time.
    segment : int, optional
        Number of its segment.
    space : str
        "LPS" in the space of the patient, else empty.
    """

    path: Path
    number: int
    shape: tuple[int, int]
    position: tuple[float, ...] | None
    axes: tuple[float, ...] | None
    pixel: tuple[float, ...] | None
    between: float | None
    thickness: float | None
    slope: float = 1.0
    intercept: float = 0.0
    marks: Mapping[str, Mark] = field(default_factory=dict)
    segment: int | None = None
    space: str = "LPS"


def read_frames(path: Path, header: Dataset, count: int, shape: tuple[int, int]) -> tuple[tuple[Frame, ...], str, bool]:
    """Read the frames of a file; return why they have no place ("" if they have), and whether their order may serve."""
    per_frame = read_items(header, "PerFrameFunctionalGroupsSequence")
    shared = read_first_item(header, "SharedFunctionalGroupsSequence")
    if per_frame or shared is not None:
        if per_frame and len(per_frame) != count:
            raise ValueError(f"{count} frames, and {len(per_frame)} are described")
        dimensions = _dimensions(header)
        common: dict[str, Mark] = {}
        if shared is not None:
            _collect_marks(shared, common)
        items: list[Dataset | None] = [*per_frame] if per_frame else [None] * count
        frames = tuple(
            _frame_of_groups(path, header, shared, item, k, shape, dimensions, common) for k, item in enumerate(items)
        )
    else:
        frames = _frames_of_top_level(path, header, count, shape)
    if all(frame.position is not None for frame in frames):
        return frames, "", False
    if any(frame.position is not None for frame in frames):
        return frames, "does not say where some of its frames lie", False
    pointers = header.get("FrameIncrementPointer")
    pointed = [pointers] if isinstance(pointers, int) else list(pointers or ())
    if any(tag in FRAME_TIME_TAGS for tag in pointed) or read_whole_number(header, "NumberOfTemporalPositions", 1) > 1:
        return frames, "holds frames of moments, not of slices", False
    if any(header.get(name) is not None for name in PROJECTION_VECTORS):
        return frames, "holds frames of directions of a camera, not of slices", False
    mark_sets = {tuple(sorted(frame.marks.items())) for frame in frames}
    return frames, "does not say where its frames lie", len(mark_sets) == 1


def _dimensions(header: Dataset) -> list[str]:
    """Return the names of the dimensions that index frames; empty strings for those in space."""
    from pydicom.datadict import keyword_for_tag

    dimensions = []
    for number, item in enumerate(read_items(header, "DimensionIndexSequence")):
        pointer, group = item.get("DimensionIndexPointer"), item.get("FunctionalGroupPointer")
        names = {keyword_for_tag(tag) for tag in (pointer, group) if isinstance(tag, int)}
        dimensions.append("" if names & IN_SPACE else keyword_for_tag(pointer or 0) or f"dimension {number + 1}")
    return dimensions


def _frame_of_groups(
    path: Path,
    header: Dataset,
    shared: Dataset | None,
    item: Dataset | None,
    number: int,
    shape: tuple[int, int],
    dimensions: list[str],
    common: Mapping[str, Mark],
) -> Frame:
    """Build a frame from its own and shared functional groups; `common` are the marks of all frames."""

    def read_group(name: str) -> Dataset | None:
        """Return a functional group of the frame, or else of all frames."""
        own_item = read_first_item(item, name)
        return read_first_item(shared, name) if own_item is None else own_item

    measures, values = read_group("PixelMeasuresSequence"), read_group("PixelValueTransformationSequence")
    place, plane = read_group("PlanePositionSequence"), read_group("PlaneOrientationSequence")
    position, axes = read_numbers(place, "ImagePositionPatient", 3), read_numbers(plane, "ImageOrientationPatient", 6)
    space = "LPS"
    if position is None and axes is None:
        place, plane = read_group("PlanePositionVolumeSequence"), read_group("PlaneOrientationVolumeSequence")
        position, axes = read_numbers(place, "ImagePositionVolume", 3), read_numbers(plane, "ImageOrientationVolume", 6)
        space = "" if position is not None else space
    if position is None and read_whole_number(header, "NumberOfFrames", 1) == 1:
        position = read_numbers(header, "ImagePositionPatient", 3)
    marks: dict[str, Mark] = {}
    if item is not None:
        _collect_marks(item, marks)
        index = read_numbers(read_first_item(item, "FrameContentSequence"), "DimensionIndexValues") or ()
        for name, index_value in zip(dimensions, index, strict=False):
            if name:
                marks.setdefault(name, (index_value,))
    segment = read_number(read_group("SegmentIdentificationSequence"), "ReferencedSegmentNumber")
    slope, intercept = _scaling(header if values is None else values)
    return Frame(
        path=path,
        number=number,
        shape=shape,
        position=position,
        axes=axes or read_numbers(header, "ImageOrientationPatient", 6),
        pixel=read_numbers(measures, "PixelSpacing", 2) or read_numbers(header, "PixelSpacing", 2),
        between=read_number(measures, "SpacingBetweenSlices"),
        thickness=read_number(measures, "SliceThickness"),
        slope=slope,
        intercept=intercept,
        marks={**common, **marks},
        segment=None if segment is None else int(segment),
        space=space,
    )


def _collect_marks(item: Dataset, marks: dict[str, Mark], deep: int = 0) -> None:
    """Add the marks of a frame, at any depth of its groups."""
    for element in item:
        if element.VR == "SQ":
            if deep < MOST_NESTED:
                for inner in element.value:
                    _collect_marks(inner, marks, deep + 1)
        elif element.keyword in MARKS and element.value not in (None, ""):
            marks.setdefault(element.keyword, to_mark(element.value))


def _scaling(header: Dataset) -> tuple[float, float]:
    """Return slope and intercept of the values."""
    slope, intercept = read_number(header, "RescaleSlope"), read_number(header, "RescaleIntercept")
    if slope == 0:
        raise ValueError("RescaleSlope is 0")
    return 1.0 if slope is None else slope, 0.0 if intercept is None else intercept


def _frames_of_top_level(path: Path, header: Dataset, count: int, shape: tuple[int, int]) -> tuple[Frame, ...]:
    """Build frames from the top level: a single one, or several that lie behind each other."""
    dose = read_number(header, "DoseGridScaling")
    slope, intercept = _scaling(header) if dose is None else (dose, 0.0)
    detector = read_first_item(header, "DetectorInformationSequence")
    axes = read_numbers(header, "ImageOrientationPatient", 6) or read_numbers(detector, "ImageOrientationPatient", 6)
    position = read_first_position(header)
    between = read_number(header, "SpacingBetweenSlices")
    marks: dict[str, Mark] = {}
    if count == 1:
        for name in MARKS:
            value = header.get(name)
            if value not in (None, ""):
                marks[name] = to_mark(value)
    single = Frame(
        path=path,
        number=0,
        shape=shape,
        position=position if count == 1 else None,
        axes=axes,
        pixel=read_numbers(header, "PixelSpacing", 2),
        between=between,
        thickness=read_number(header, "SliceThickness"),
        slope=slope,
        intercept=intercept,
        marks=marks,
    )
    if count == 1:
        return (single,)
    offsets = _offsets(header, count, position, axes, between)
    vectors = {name: read_numbers(header, name, count) for name in VECTORS}
    varying = {name: vector for name, vector in vectors.items() if vector is not None and len(set(vector)) > 1}
    normal = None if axes is None else np.cross(axes[:3], axes[3:])
    return tuple(
        Frame(
            **{
                **vars(single),
                "number": k,
                "position": None
                if offsets is None or position is None or normal is None
                else tuple((np.array(position) + offsets[k] * normal).tolist()),
                "marks": {name: (vector[k],) for name, vector in varying.items()},
            }
        )
        for k in range(count)
    )


def read_first_position(header: Dataset) -> tuple[float, ...] | None:
    """Return the place of the first frame by the top level or the first detector, or None."""
    detector = read_first_item(header, "DetectorInformationSequence")
    return read_numbers(header, "ImagePositionPatient", 3) or read_numbers(detector, "ImagePositionPatient", 3)


def _offsets(
    header: Dataset,
    count: int,
    position: tuple[float, ...] | None,
    axes: tuple[float, ...] | None,
    between: float | None,
) -> tuple[float, ...] | None:
    """Return the distance of each frame behind the first, mm, by a vector in the file; else None."""
    offsets = read_numbers(header, "GridFrameOffsetVector", count)
    if offsets is not None:
        if offsets[0] == 0 or position is None or axes is None:
            return offsets
        # Offsets from the origin instead of from the first frame, which are allowed only for frames across the z axis.
        z_component = axes[0] * axes[4] - axes[1] * axes[3]
        is_axial = abs(abs(z_component) - 1) < DIRECTION_TOLERANCE and abs(offsets[0] - position[2]) < PLACE_TOLERANCE
        return tuple((offset - position[2]) * z_component for offset in offsets) if is_axial else None
    slices = read_numbers(header, "SliceVector", count)
    if slices is not None and between:
        return tuple((number - 1) * between for number in slices)
    return None
