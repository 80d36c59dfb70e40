"""DICOM files written by pydicom, with all that may stand in them about places, scales and segments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pydicom import Dataset, dcmwrite
from pydicom.dataset import FileMetaDataset
from pydicom.uid import (
    DeflatedExplicitVRLittleEndian,
    ExplicitVRBigEndian,
    ExplicitVRLittleEndian,
    ImplicitVRLittleEndian,
)

CT, ENHANCED_CT, ENHANCED_PET = (
    "1.2.840.10008.5.1.4.1.1.2",
    "1.2.840.10008.5.1.4.1.1.2.1",
    "1.2.840.10008.5.1.4.1.1.130",
)
CAPTURE, NUCLEAR, DOSE = "1.2.840.10008.5.1.4.1.1.7.3", "1.2.840.10008.5.1.4.1.1.20", "1.2.840.10008.5.1.4.1.1.481.2"
SEGMENTATION, LABEL_MAP = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7"
SYNTAXES = {
    "implicit": ImplicitVRLittleEndian,
    "explicit": ExplicitVRLittleEndian,
    "big": ExplicitVRBigEndian,
    "deflated": DeflatedExplicitVRLittleEndian,
}
AXIAL = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def item(**elements: Any) -> Dataset:
    """Return a data set with these elements; lists of data sets are sequences."""
    made = Dataset()
    for name, value in elements.items():
        setattr(made, name, value)
    return made


def number(value: float) -> str:
    """Return a decimal string as scanners write it: at most 16 characters."""
    return next(text for digits in range(16, 0, -1) if len(text := f"{value:.{digits}g}") <= 16)


def numbers(values: Sequence[float]) -> list[str]:
    return [number(float(value)) for value in values]


def base(storage: str, stored: np.ndarray, *, series: str = "2.25.7", instance: int = 1, bits: int = 0) -> Dataset:
    """Return a file with pixels [frame, row, column] and nothing about their places."""
    count, rows, columns = stored.shape
    one_bit = bits == 1
    size = stored.dtype.itemsize * 8
    made = item(
        SOPClassUID=storage,
        SOPInstanceUID=f"2.25.{instance}",
        StudyInstanceUID="2.25.5",
        SeriesInstanceUID=series,
        FrameOfReferenceUID="2.25.6",
        Modality="SEG" if storage in (SEGMENTATION, LABEL_MAP) else "CT",
        PatientName="A^B",
        PatientID="1",
        InstanceNumber=instance,
        SamplesPerPixel=1,
        PhotometricInterpretation="MONOCHROME2",
        NumberOfFrames=count,
        Rows=rows,
        Columns=columns,
        BitsAllocated=1 if one_bit else size,
        BitsStored=bits or size,
        HighBit=(bits or size) - 1,
        PixelRepresentation=int(stored.dtype.kind == "i"),
    )
    pixels = np.packbits(stored.ravel() > 0, bitorder="little").tobytes() if one_bit else stored.tobytes()
    made.PixelData = pixels + b"\0" * (len(pixels) % 2)
    made["PixelData"].VR = "OB" if one_bit or size == 8 else "OW"
    return made


def measures(pixel: Sequence[float] = (0.5, 1.0), between: float | None = 3.0, thickness: float = 3.0) -> Dataset:
    made = item(PixelSpacing=numbers(pixel), SliceThickness=number(thickness))
    if between is not None:
        made.SpacingBetweenSlices = number(between)
    return made


def enhanced(
    storage: str,
    stored: np.ndarray,
    places: Sequence[Sequence[float]],
    *,
    axes: Sequence[float] = AXIAL,
    pixel: Sequence[float] = (0.5, 1.0),
    between: float | None = 3.0,
    scales: Sequence[tuple[float, float]] | None = None,
    content: Sequence[Mapping[str, Any]] | None = None,
    groups: Sequence[Mapping[str, Any]] | None = None,
    shared: bool = True,
    **elements: Any,
) -> Dataset:
    """Return a file with functional groups: places of each frame, the rest shared or beside them."""
    made = base(storage, stored, **{k: elements.pop(k) for k in ("series", "instance", "bits") if k in elements})
    plane, size = item(ImageOrientationPatient=numbers(axes)), measures(pixel, between)
    common = {"PlaneOrientationSequence": [plane], "PixelMeasuresSequence": [size]}
    per_frame = []
    for k, place in enumerate(places):
        own = item(PlanePositionSequence=[item(ImagePositionPatient=numbers(place))])
        if scales is not None:
            slope, intercept = scales[k]
            own.PixelValueTransformationSequence = [
                item(RescaleSlope=number(slope), RescaleIntercept=number(intercept), RescaleType="US")
            ]
        own.FrameContentSequence = [item(FrameAcquisitionNumber=1, **(content[k] if content else {}))]
        for name, value in {**({} if shared else common), **(groups[k] if groups else {})}.items():
            setattr(own, name, value)
        per_frame.append(own)
    if shared:
        made.SharedFunctionalGroupsSequence = [item(**common)]
    made.PerFrameFunctionalGroupsSequence = per_frame
    for name, value in elements.items():
        setattr(made, name, value)
    return made


def segmentation(
    masks: np.ndarray,
    places: Sequence[Sequence[float]],
    of: Sequence[int],
    *,
    kind: str = "BINARY",
    segments: Mapping[int, Mapping[str, Any]] | None = None,
    **more: Any,
) -> Dataset:
    """Return a segmentation: frames [frame, row, column], each of the segment of that number."""
    groups = [{"SegmentIdentificationSequence": [item(ReferencedSegmentNumber=each)]} for each in of]
    known = segments or {each: {"SegmentLabel": f"segment {each}"} for each in sorted(set(of))}
    made = enhanced(
        SEGMENTATION,
        masks,
        places,
        groups=groups,
        SegmentationType=kind,
        SegmentSequence=[item(SegmentNumber=each, **facts) for each, facts in known.items()],
        **more,
    )
    if kind == "FRACTIONAL":
        made.SegmentationFractionalType, made.MaximumFractionalValue = "OCCUPANCY", int(more.get("highest", 255))
    return made


def slices(
    stored: np.ndarray,
    places: Sequence[Sequence[float]],
    *,
    axes: Sequence[float] = AXIAL,
    pixel: Sequence[float] = (0.5, 1.0),
    each: Sequence[Mapping[str, Any]] | None = None,
    series: str = "2.25.7",
) -> list[Dataset]:
    """Return one file for each slice."""
    found = []
    for k, place in enumerate(places):
        made = base(CT, stored[k : k + 1], series=series, instance=k + 1)
        del made.NumberOfFrames
        made.ImagePositionPatient, made.ImageOrientationPatient = numbers(place), numbers(axes)
        made.PixelSpacing, made.SliceThickness = numbers(pixel), "3"
        for name, value in (each[k] if each else {}).items():
            setattr(made, name, value)
        found.append(made)
    return found


def save(made: Dataset, path: Path, syntax: str = "explicit") -> Path:
    """Write a file; for big-endian, its words are turned."""
    made.file_meta = FileMetaDataset()
    made.file_meta.TransferSyntaxUID = SYNTAXES[syntax]
    if syntax == "big" and made.BitsAllocated > 8:
        made.PixelData = np.frombuffer(made.PixelData, dtype=f"u{made.BitsAllocated // 8}").byteswap().tobytes()
    dcmwrite(path, made, enforce_file_format=True)
    return path


def save_all(files: Sequence[Dataset], folder: Path, order: Sequence[int] | None = None) -> Path:
    """Write the files of a folder, their names in another order than their places."""
    folder.mkdir(exist_ok=True)
    for name, made in zip(order or range(len(files)), files, strict=True):
        save(made, folder / f"{name:04d}.dcm")
    return folder
