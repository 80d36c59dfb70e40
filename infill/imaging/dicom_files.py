"""Headers of DICOM files by pydicom (extra `medical`): places of frames, segments, and the storage of pixels.

    functional groups   of each frame or all: Plane Position, Plane Orientation, Pixel Measures, Pixel Value
                        Transformation
    top level           the same for a file of one frame; Grid Frame Offset Vector of a dose; Slice Vector and Spacing
                        Between Slices of nuclear medicine
    Segment Sequence    numbers, names and colours of the segments

Only the last three functions read pixels. Source: DICOM PS3.3, C.7.6.16 (functional groups), C.8.20 (segmentations),
C.8.8.3 (dose), C.8.4.15 (nuclear medicine).
"""

from __future__ import annotations

import contextlib
import io
import math
import os
import unicodedata
import warnings
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, error_text, wrap_reader_errors
from infill.imaging.label_tables import Colour, Segment
from infill.machine import available_memory, require_memory

if TYPE_CHECKING:
    from pydicom.dataset import Dataset

PREAMBLE, MAGIC = 128, b"DICM"
GROUP_LENGTH = 12  # bytes of the element that states the length of the other meta information
SEGMENTATION, LABEL_MAP = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7"
PLAIN_STORAGE = "1.2.840.10008.5.1.4.1.1.7.3"  # a multi-frame secondary capture, which holds only pixels
DEFLATED, EXPLICIT_LITTLE = "1.2.840.10008.1.2.1.99", "1.2.840.10008.1.2.1"
PIXEL_TAGS = {0x7FE00008: "f4", 0x7FE00009: "f8", 0x7FE00010: ""}
LONG_HEADS = {"OB", "OD", "OF", "OL", "OV", "OW", "UN", "SQ", "UC", "UR", "UT", "SV", "UV"}
UNDEFINED = 0xFFFFFFFF
MOST_FRAMES = 2**20  # in one file
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

Mark = tuple[float | str, ...]


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


@dataclass(frozen=True, kw_only=True)
class Pixels:
    """Storage of the numbers of a file.

    Parameters
    ----------
    begin, length : int
        Their position and length, bytes; the length is None for frames that are compressed one by one.
    real : str
        "f4" or "f8" for floating-point numbers, else empty.
    allocated, stored, high : int
        Bits of a cell, used bits, and the highest used bit.
    signed, little, words : bool
        Whether numbers may be negative, have their low byte first, and were written as 16-bit words.
    deflated : bool
        Whether the file is compressed as a whole.
    syntax : str
        UID of the transfer syntax.
    """

    begin: int
    length: int | None
    real: str
    allocated: int
    stored: int
    high: int
    signed: bool
    little: bool
    words: bool
    deflated: bool
    syntax: str


@dataclass(frozen=True, kw_only=True)
class Segments:
    """Segments of a segmentation.

    Parameters
    ----------
    kind : {"BINARY", "FRACTIONAL", "LABELMAP"}
    highest : int
        Stored number of a cell that lies completely in a segment, for fractions.
    known : tuple of Segment
        Numbers, names and colours.
    """

    kind: str
    highest: int
    known: tuple[Segment, ...]


@dataclass(frozen=True, kw_only=True)
class Image:
    """The header of a file.

    Parameters
    ----------
    path : Path
    storage : str
        UID of the storage class, such as CT slices.
    series : str
    count : int
        Number of frames.
    photometric : str
        Meaning of the numbers: MONOCHROME2, RGB, ...
    frames : tuple of Frame
        Empty for colours.
    pixels : Pixels
    order : (str, int, int)
        Sort key of the files of a series.
    unplaced : str
        Reason why the frames have no place; empty if they have.
    stacked : bool
        Whether frames without a place may lie behind each other in the order of the file.
    start : (x, y, z), optional
        Position of the first of those.
    padding : (low, high), optional
        Stored numbers that mark missing pixels.
    table : (first, values), optional
        Modality LUT: the values of the stored numbers from `first` on.
    segments : Segments, optional
    """

    path: Path
    storage: str
    series: str
    count: int
    photometric: str
    frames: tuple[Frame, ...]
    pixels: Pixels
    order: tuple[str, int, int] = ("", 0, 0)
    unplaced: str = ""
    stacked: bool = False
    start: tuple[float, ...] | None = None
    padding: tuple[float, float] | None = None
    table: tuple[int, NDArray[np.float64]] | None = None
    segments: Segments | None = None


def require_pydicom(what: str) -> None:
    """Raise FormatError if pydicom is not installed."""
    try:
        import pydicom  # noqa: F401
    except ImportError as error:
        raise FormatError(f"reading {what} needs the extra medical: pip install 'phasefill[medical]'") from error


def is_dicom(path: Path) -> bool:
    """Tell whether a file begins with the mark of DICOM."""
    with path.open("rb") as file:
        return file.read(PREAMBLE + len(MAGIC))[PREAMBLE:] == MAGIC


def read_image(path: Path) -> Image | None:
    """Read the header of a DICOM file; return None for files without pixels, such as reports or plans.

    Raises
    ------
    FormatError
        If the file is broken, cut off or not DICOM.
    """
    with _wrap_pydicom_errors(path):
        header, pixels = _header(path)
        if pixels is None or header.get("Rows") is None:
            return None
        return _image(path, header, pixels)


@contextlib.contextmanager
def _wrap_pydicom_errors(path: Path) -> Iterator[None]:
    """Turn an exception of pydicom about a file into a FormatError."""
    from pydicom.errors import BytesLengthException, InvalidDicomError

    try:
        # Its warnings concern elements that do not matter here: those that matter are checked.
        with warnings.catch_warnings(), wrap_reader_errors(path, "is broken or cut off", "copy or save it again"):
            warnings.simplefilter("ignore")
            yield
    except (BytesLengthException, InvalidDicomError, OSError) as error:
        if isinstance(error, OSError) and error.errno is not None:  # of the file system, not of the content
            raise
        raise FormatError(f"{path} is broken or not DICOM ({error_text(error)}); copy or save it again") from error


def _header(path: Path) -> tuple[Dataset, Pixels | None]:
    """Return the elements before the pixels, and the storage of the pixels."""
    from pydicom.filereader import read_dataset, read_partial
    from pydicom.uid import ImplicitVRLittleEndian

    pixel_elements: list[tuple[int, str | None, int]] = []

    def at_pixels(tag: int, vr: str | None, length: int) -> bool:
        if tag in PIXEL_TAGS:
            pixel_elements.append((int(tag), vr, length))
        return tag in PIXEL_TAGS

    with path.open("rb") as plain:
        syntax = _syntax(path)
        file: BinaryIO = plain
        deflated = syntax == DEFLATED
        if deflated:
            file = io.BytesIO(_inflate(path))
            header: Dataset = read_dataset(file, is_implicit_VR=False, is_little_endian=True, stop_when=at_pixels)
            implicit, little = False, True
        else:
            header = read_partial(file, stop_when=at_pixels, force=True)
            implicit = bool(header.original_encoding[0])
            little = header.original_encoding[1] is not False
            syntax = str(header.file_meta.get("TransferSyntaxUID", ""))
            implicit = implicit or syntax == ImplicitVRLittleEndian
        if not pixel_elements:
            return header, None
        tag, vr, length = pixel_elements[-1]
        begin = file.tell() + (8 if implicit or vr not in LONG_HEADS else 12)
        available = file.seek(0, os.SEEK_END) - begin
    real = PIXEL_TAGS[tag]
    allocated = _whole_number(header, "BitsAllocated", 16) if not real else 8 * int(real[1])
    stored = _whole_number(header, "BitsStored", allocated) if not real else allocated
    return header, Pixels(
        begin=begin,
        length=None if length == UNDEFINED else min(length, available),
        real=real,
        allocated=allocated,
        stored=stored,
        high=_whole_number(header, "HighBit", stored - 1) if not real else allocated - 1,
        signed=_whole_number(header, "PixelRepresentation", 0) == 1,
        little=little,
        words=vr != "OB",
        deflated=deflated,
        syntax=syntax,
    )


def _syntax(path: Path) -> str:
    """Return the UID of the transfer syntax of a file; empty if it states none."""
    from pydicom.filereader import read_file_meta_info

    return str(read_file_meta_info(path).get("TransferSyntaxUID", "")) if is_dicom(path) else ""


def _inflate(path: Path) -> bytes:
    """Decompress the elements of a deflated file."""
    content = path.read_bytes()
    begin = PREAMBLE + len(MAGIC)
    begin += GROUP_LENGTH + int.from_bytes(content[begin + 8 : begin + GROUP_LENGTH], "little")
    unpacker = zlib.decompressobj(-zlib.MAX_WBITS)
    free = available_memory()
    allowed = 2**34 if free is None else free // 4
    unpacked = unpacker.decompress(content[begin:], allowed)
    if len(unpacked) >= allowed:
        require_memory(5 * allowed, None, SMALLER_VOLUME_ADVICE)
    return unpacked


# --- single elements -------------------------------------------------------------------------------------------


def _whole_number(header: Dataset, name: str, otherwise: int) -> int:
    """Return a whole number, or `otherwise` if the element is missing or empty."""
    value = header.get(name)
    return otherwise if value is None or value == "" else _integer(name, value)


def _integer(name: str, value: Any) -> int:  # noqa: ANN401 - what pydicom makes of an element
    """Convert a value of pydicom to int, or raise ValueError."""
    try:
        return int(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {clean_text(value)!r}") from error


def _numbers(header: Dataset | None, name: str, count: int | None = None) -> tuple[float, ...] | None:
    """Return the finite numbers of an element; None if it is missing or empty."""
    value = None if header is None else header.get(name)
    if value is None or value == "" or value == []:
        return None
    words = [value] if isinstance(value, str | int | float) else value
    try:
        numbers = tuple(float(word) for word in words)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is {clean_text(value)!r}") from error
    if (count is not None and len(numbers) != count) or not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"{name} is {clean_text(value)!r}")
    return numbers


def _number(header: Dataset | None, name: str) -> float | None:
    """Return the finite number of an element; None if it is missing or empty."""
    numbers = _numbers(header, name, 1)
    return None if numbers is None else numbers[0]


def _items(header: Dataset | None, name: str) -> list[Dataset]:
    """Return the items of a sequence; an empty list if it is missing."""
    from pydicom.sequence import Sequence

    value = None if header is None else header.get(name)
    if value is None:
        return []
    if not isinstance(value, Sequence):
        raise ValueError(f"{name} is not a sequence")  # noqa: TRY004 - of a file
    return list(value)


def _first_item(header: Dataset | None, name: str) -> Dataset | None:
    """Return the first item of a sequence, or None."""
    items = _items(header, name)
    return items[0] if items else None


def clean_text(value: object) -> str:
    r"""Return a text on one line, without control characters, truncated if it is long.

    >>> clean_text("a\x1b[31m  b")
    'a[31m b'
    """
    words = " ".join(str(value).split())
    visible = "".join(character for character in words if not unicodedata.category(character).startswith("C"))
    return visible if len(visible) <= 64 else f"{visible[:64]}…"


def _mark_of(value: Any) -> Mark:  # noqa: ANN401 - what pydicom makes of an element
    """Convert a value to a tuple that can be compared and sorted."""
    words = [value] if isinstance(value, str | int | float) or not hasattr(value, "__iter__") else list(value)
    return tuple(float(word) if isinstance(word, int | float) else clean_text(word) for word in words)


# --- the whole header ------------------------------------------------------------------------------------------


def _image(path: Path, header: Dataset, pixels: Pixels) -> Image:
    """Collect the header of a file with pixels."""
    storage = clean_text(header.get("SOPClassUID", ""))
    rows, columns = _whole_number(header, "Rows", 0), _whole_number(header, "Columns", 0)
    samples = _whole_number(header, "SamplesPerPixel", 1)
    count = _whole_number(header, "NumberOfFrames", 1)
    if rows < 1 or columns < 1 or count < 1 or samples < 1:
        raise ValueError(f"{count} frames of {columns} x {rows} pixels")
    photometric = clean_text(header.get("PhotometricInterpretation", ""))
    image = Image(
        path=path,
        storage=storage,
        series=clean_text(header.get("SeriesInstanceUID", "")),
        count=count,
        photometric=photometric,
        frames=(),
        pixels=pixels,
        order=(
            clean_text(header.get("ConcatenationUID", "")),
            _whole_number(header, "InConcatenationNumber", 0),
            _whole_number(header, "InstanceNumber", 0),
        ),
    )
    if samples > 1 or (photometric == "PALETTE COLOR" and storage != LABEL_MAP):
        return image
    _check_pixels(pixels, count, rows * columns)
    frames, unplaced, stacked = _read_frames(path, header, count, (rows, columns))
    return Image(
        **{
            **vars(image),
            "frames": frames,
            "unplaced": unplaced,
            "stacked": stacked,
            "start": _first_position(header),
            "padding": _padding(header, pixels),
            "table": _modality_table(header, pixels),
            "segments": _segments(header, storage),
        }
    )


def _check_pixels(pixels: Pixels, count: int, cells: int) -> None:
    """Raise ValueError if the bit depths are inconsistent, or the file holds fewer numbers than it announces."""
    if pixels.allocated not in (1, 8, 16, 32, 64) or not 1 <= pixels.stored <= pixels.high + 1 <= pixels.allocated:
        raise ValueError(f"{pixels.stored} bits up to bit {pixels.high} of {pixels.allocated}")
    if count > MOST_FRAMES:
        raise ValueError(f"{count} frames")
    needed = -(-count * cells * pixels.allocated // 8)
    if pixels.length is not None and pixels.length < needed:
        raise ValueError(f"{pixels.length} bytes of pixels, of {needed}")


def _read_frames(
    path: Path, header: Dataset, count: int, shape: tuple[int, int]
) -> tuple[tuple[Frame, ...], str, bool]:
    """Read the frames of a file; return why they have no place ("" if they have), and whether their order may serve."""
    per_frame = _items(header, "PerFrameFunctionalGroupsSequence")
    shared = _first_item(header, "SharedFunctionalGroupsSequence")
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
    if any(tag in FRAME_TIME_TAGS for tag in pointed) or _whole_number(header, "NumberOfTemporalPositions", 1) > 1:
        return frames, "holds frames of moments, not of slices", False
    if any(header.get(name) is not None for name in PROJECTION_VECTORS):
        return frames, "holds frames of directions of a camera, not of slices", False
    mark_sets = {tuple(sorted(frame.marks.items())) for frame in frames}
    return frames, "does not say where its frames lie", len(mark_sets) == 1


def _dimensions(header: Dataset) -> list[str]:
    """Return the names of the dimensions that index frames; empty strings for those in space."""
    from pydicom.datadict import keyword_for_tag

    dimensions = []
    for number, item in enumerate(_items(header, "DimensionIndexSequence")):
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

    def macro(name: str) -> Dataset | None:
        own_item = _first_item(item, name)
        return _first_item(shared, name) if own_item is None else own_item

    measures, values = macro("PixelMeasuresSequence"), macro("PixelValueTransformationSequence")
    place, plane = macro("PlanePositionSequence"), macro("PlaneOrientationSequence")
    position, axes = _numbers(place, "ImagePositionPatient", 3), _numbers(plane, "ImageOrientationPatient", 6)
    space = "LPS"
    if position is None and axes is None:
        place, plane = macro("PlanePositionVolumeSequence"), macro("PlaneOrientationVolumeSequence")
        position, axes = _numbers(place, "ImagePositionVolume", 3), _numbers(plane, "ImageOrientationVolume", 6)
        space = "" if position is not None else space
    if position is None and _whole_number(header, "NumberOfFrames", 1) == 1:
        position = _numbers(header, "ImagePositionPatient", 3)
    marks: dict[str, Mark] = {}
    if item is not None:
        _collect_marks(item, marks)
        index = _numbers(_first_item(item, "FrameContentSequence"), "DimensionIndexValues") or ()
        for name, index_value in zip(dimensions, index, strict=False):
            if name:
                marks.setdefault(name, (index_value,))
    segment = _number(macro("SegmentIdentificationSequence"), "ReferencedSegmentNumber")
    slope, intercept = _scaling(header if values is None else values)
    return Frame(
        path=path,
        number=number,
        shape=shape,
        position=position,
        axes=axes or _numbers(header, "ImageOrientationPatient", 6),
        pixel=_numbers(measures, "PixelSpacing", 2) or _numbers(header, "PixelSpacing", 2),
        between=_number(measures, "SpacingBetweenSlices"),
        thickness=_number(measures, "SliceThickness"),
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
            marks.setdefault(element.keyword, _mark_of(element.value))


def _scaling(header: Dataset) -> tuple[float, float]:
    """Return slope and intercept of the values."""
    slope, intercept = _number(header, "RescaleSlope"), _number(header, "RescaleIntercept")
    if slope == 0:
        raise ValueError("RescaleSlope is 0")
    return 1.0 if slope is None else slope, 0.0 if intercept is None else intercept


def _frames_of_top_level(path: Path, header: Dataset, count: int, shape: tuple[int, int]) -> tuple[Frame, ...]:
    """Build frames from the top level: a single one, or several that lie behind each other."""
    dose = _number(header, "DoseGridScaling")
    slope, intercept = _scaling(header) if dose is None else (dose, 0.0)
    detector = _first_item(header, "DetectorInformationSequence")
    axes = _numbers(header, "ImageOrientationPatient", 6) or _numbers(detector, "ImageOrientationPatient", 6)
    position = _first_position(header)
    between = _number(header, "SpacingBetweenSlices")
    marks: dict[str, Mark] = {}
    if count == 1:
        for name in MARKS:
            value = header.get(name)
            if value not in (None, ""):
                marks[name] = _mark_of(value)
    single = Frame(
        path=path,
        number=0,
        shape=shape,
        position=position if count == 1 else None,
        axes=axes,
        pixel=_numbers(header, "PixelSpacing", 2),
        between=between,
        thickness=_number(header, "SliceThickness"),
        slope=slope,
        intercept=intercept,
        marks=marks,
    )
    if count == 1:
        return (single,)
    offsets = _offsets(header, count, position, axes, between)
    vectors = {name: _numbers(header, name, count) for name in VECTORS}
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


def _first_position(header: Dataset) -> tuple[float, ...] | None:
    """Return the place of the first frame by the top level or the first detector, or None."""
    detector = _first_item(header, "DetectorInformationSequence")
    return _numbers(header, "ImagePositionPatient", 3) or _numbers(detector, "ImagePositionPatient", 3)


def _offsets(
    header: Dataset,
    count: int,
    position: tuple[float, ...] | None,
    axes: tuple[float, ...] | None,
    between: float | None,
) -> tuple[float, ...] | None:
    """Return the distance of each frame behind the first, mm, by a vector in the file; else None."""
    offsets = _numbers(header, "GridFrameOffsetVector", count)
    if offsets is not None:
        if offsets[0] == 0 or position is None or axes is None:
            return offsets
        # Offsets from the origin instead of from the first frame, which are allowed only for frames across the z axis.
        z_component = axes[0] * axes[4] - axes[1] * axes[3]
        is_axial = abs(abs(z_component) - 1) < DIRECTION_TOLERANCE and abs(offsets[0] - position[2]) < PLACE_TOLERANCE
        return tuple((offset - position[2]) * z_component for offset in offsets) if is_axial else None
    slices = _numbers(header, "SliceVector", count)
    if slices is not None and between:
        return tuple((number - 1) * between for number in slices)
    return None


def _padding(header: Dataset, pixels: Pixels) -> tuple[float, float] | None:
    """Return the range of stored numbers that mark missing pixels."""
    low = _stored_number(header, "PixelPaddingValue", pixels)
    if low is None:
        return None
    high = _stored_number(header, "PixelPaddingRangeLimit", pixels)
    return min(low, low if high is None else high), max(low, low if high is None else high)


def _stored_number(header: Dataset, name: str, pixels: Pixels) -> float | None:
    """Return a number as the pixels hold it: signed pixels read the same bits as another number."""
    value: Any = header.get(name)
    if value is None or value == "":
        return None
    if isinstance(value, bytes):
        value = int.from_bytes(value[:2], "little" if pixels.little else "big")
    number = _integer(name, value)
    if pixels.signed and number >= 2 ** (pixels.allocated - 1):
        return float(number - 2**pixels.allocated)
    return float(number if pixels.signed or number >= 0 else number + 2**pixels.allocated)


def _modality_table(header: Dataset, pixels: Pixels) -> tuple[int, NDArray[np.float64]] | None:
    """Return the Modality LUT: the first number that it maps, and the values from that number on."""
    item = _first_item(header, "ModalityLUTSequence")
    if item is None:
        return None
    descriptor = _numbers(item, "LUTDescriptor", 3)
    data: Any = item.get("LUTData")
    if descriptor is None or data is None:
        raise ValueError("ModalityLUTSequence holds no table")
    length, first_number, bits = (int(entry) for entry in descriptor)
    length = length if length > 0 else length + 2**16
    if isinstance(data, bytes):
        kind = "u1" if bits <= 8 and len(data) < 2 * length else "u2"
        values = np.frombuffer(data, dtype=("<" if pixels.little else ">") + kind)[:length]
    else:
        values = np.array(_numbers(item, "LUTData"))[:length]
    if len(values) < length:
        raise ValueError(f"ModalityLUTSequence holds {len(values)} of {length} values")
    return first_number, values.astype(np.float64)


# --- segments --------------------------------------------------------------------------------------------------


def _segments(header: Dataset, storage: str) -> Segments | None:
    """Return the segments of a segmentation; None for other files."""
    if storage not in (SEGMENTATION, LABEL_MAP):
        return None
    kind = clean_text(header.get("SegmentationType", "")) or "BINARY"
    kind = "LABELMAP" if storage == LABEL_MAP else kind
    segments = []
    for item in _items(header, "SegmentSequence"):
        number = _whole_number(item, "SegmentNumber", 0)
        name = clean_text(item.get("SegmentLabel") or item.get("SegmentDescription") or "")
        colour = _numbers(item, "RecommendedDisplayCIELabValue", 3)
        segments.append(Segment(value=number, name=name, colour=None if colour is None else _srgb(colour)))
    return Segments(
        kind=kind, highest=max(1, _whole_number(header, "MaximumFractionalValue", 255)), known=tuple(segments)
    )


def _srgb(lab: tuple[float, ...]) -> Colour:
    """Convert a stored CIELab colour to red, green and blue from 0 to 1.

    Notes
    -----
    CIELab for the white D50, each number from 0 to 65535 (PS3.3, C.10.7.1.1); sRGB by IEC 61966-2-1, the matrix for D50
    after Bradford.
    """
    light, a, b = lab[0] * 100 / 65535, lab[1] * 255 / 65535 - 128, lab[2] * 255 / 65535 - 128
    y = (light + 16) / 116
    cubed = np.array([y + a / 500, y, y - b / 200])
    xyz = np.where(cubed > 6 / 29, cubed**3, (cubed - 4 / 29) * 3 * (6 / 29) ** 2) * (0.96422, 1.0, 0.82521)
    matrix = (
        (3.1338561, -1.6168667, -0.4906146),
        (-0.9787684, 1.9161415, 0.0334540),
        (0.0719453, -0.2289914, 1.4052427),
    )
    linear = np.clip(np.array(matrix) @ xyz, 0, 1)
    red, green, blue = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055).tolist()
    return red, green, blue


# --- pixels ----------------------------------------------------------------------------------------------------


def read_plain_pixels(image: Image) -> memoryview:
    """Read the bytes of frames that are not compressed one by one."""
    pixels = image.pixels
    assert pixels.length is not None
    with _wrap_pydicom_errors(image.path):
        if pixels.deflated:
            return memoryview(_inflate(image.path))[pixels.begin : pixels.begin + pixels.length]
        with image.path.open("rb") as file:
            file.seek(pixels.begin)
            return memoryview(file.read(pixels.length))


def write_packed_frames(images: Sequence[Image], target: Path) -> None:
    """Write the compressed frames of similar files into one file without any further information.

    So a reader decompresses the stored values in their order, and it is called once for all slices of a folder.
    """
    from pydicom import Dataset, dcmwrite
    from pydicom.dataset import FileMetaDataset
    from pydicom.encaps import encapsulate

    template = images[0]
    packed = [frame for image in images for frame in _packed_frames(image)]
    plain, pixels = Dataset(), template.pixels
    with _wrap_pydicom_errors(template.path):
        plain.file_meta = FileMetaDataset()
        plain.file_meta.TransferSyntaxUID = pixels.syntax  # type: ignore[assignment]
        plain.file_meta.MediaStorageSOPClassUID = plain.SOPClassUID = PLAIN_STORAGE  # type: ignore[assignment]
        plain.file_meta.MediaStorageSOPInstanceUID = plain.SOPInstanceUID = "2.25.1"  # type: ignore[assignment]
        plain.Rows, plain.Columns = template.frames[0].shape
        plain.NumberOfFrames = len(packed)
        plain.SamplesPerPixel, plain.PhotometricInterpretation = 1, "MONOCHROME2"
        plain.BitsAllocated, plain.BitsStored, plain.HighBit = pixels.allocated, pixels.stored, pixels.high
        plain.PixelRepresentation = int(pixels.signed)
        plain.PixelData = encapsulate(packed)
        plain["PixelData"].VR = "OB"
        plain["PixelData"].is_undefined_length = True
        dcmwrite(target, plain, enforce_file_format=True)


def _packed_frames(image: Image) -> list[bytes]:
    """Return the compressed frames of a file."""
    from pydicom.encaps import generate_frames

    with _wrap_pydicom_errors(image.path), image.path.open("rb") as file:
        file.seek(image.pixels.begin)
        packed = list(generate_frames(file, number_of_frames=image.count))
        if len(packed) != image.count:
            raise ValueError(f"{len(packed)} frames of {image.count}")
        return packed
