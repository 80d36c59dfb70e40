"""Headers of DICOM files by pydicom (extra `medical`): frames, segments, and the storage of pixels.

Source: DICOM PS3.3, C.8.20 (segmentations), C.11.1 (modality tables), C.7.5.1 (padding).
"""

from __future__ import annotations

import contextlib
import io
import os
import warnings
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, error_text, wrap_reader_errors
from infill.imaging.dicom.elements import (
    clean_text,
    read_first_item,
    read_items,
    read_numbers,
    read_whole_number,
    to_integer,
)
from infill.imaging.dicom.places import Frame, read_first_position, read_frames
from infill.imaging.label_tables import Colour, Segment
from infill.machine import available_memory, require_memory

if TYPE_CHECKING:
    from pydicom.dataset import Dataset

PREAMBLE, MAGIC = 128, b"DICM"
GROUP_LENGTH = 12  # bytes of the element that states the length of the other meta information
SEGMENTATION, LABEL_MAP = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7"
DEFLATED = "1.2.840.10008.1.2.1.99"
PIXEL_TAGS = {0x7FE00008: "f4", 0x7FE00009: "f8", 0x7FE00010: ""}
LONG_HEADS = {"OB", "OD", "OF", "OL", "OV", "OW", "UN", "SQ", "UC", "UR", "UT", "SV", "UV"}
UNDEFINED = 0xFFFFFFFF
MOST_FRAMES = 2**20  # in one file


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
        raise FormatError(f"reading {what} needs the extra medical: pip install pydicom SimpleITK") from error


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
    with wrap_pydicom_errors(path):
        header, pixels = _header(path)
        if pixels is None or header.get("Rows") is None:
            return None
        return _image(path, header, pixels)


@contextlib.contextmanager
def wrap_pydicom_errors(path: Path) -> Iterator[None]:
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
        """Tell whether an element holds the pixels, and note it."""
        if tag in PIXEL_TAGS:
            pixel_elements.append((int(tag), vr, length))
        return tag in PIXEL_TAGS

    with path.open("rb") as plain:
        syntax = _syntax(path)
        file: BinaryIO = plain
        deflated = syntax == DEFLATED
        if deflated:
            file = io.BytesIO(inflate(path))
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
    allocated = read_whole_number(header, "BitsAllocated", 16) if not real else 8 * int(real[1])
    stored = read_whole_number(header, "BitsStored", allocated) if not real else allocated
    return header, Pixels(
        begin=begin,
        length=None if length == UNDEFINED else min(length, available),
        real=real,
        allocated=allocated,
        stored=stored,
        high=read_whole_number(header, "HighBit", stored - 1) if not real else allocated - 1,
        signed=read_whole_number(header, "PixelRepresentation", 0) == 1,
        little=little,
        words=vr != "OB",
        deflated=deflated,
        syntax=syntax,
    )


def _syntax(path: Path) -> str:
    """Return the UID of the transfer syntax of a file; empty if it states none."""
    from pydicom.filereader import read_file_meta_info

    return str(read_file_meta_info(path).get("TransferSyntaxUID", "")) if is_dicom(path) else ""


def inflate(path: Path) -> bytes:
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


def _image(path: Path, header: Dataset, pixels: Pixels) -> Image:
    """Collect the header of a file with pixels; a picture in colour gets no frames."""
    storage = clean_text(header.get("SOPClassUID", ""))
    rows, columns = read_whole_number(header, "Rows", 0), read_whole_number(header, "Columns", 0)
    samples = read_whole_number(header, "SamplesPerPixel", 1)
    count = read_whole_number(header, "NumberOfFrames", 1)
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
            read_whole_number(header, "InConcatenationNumber", 0),
            read_whole_number(header, "InstanceNumber", 0),
        ),
    )
    if samples > 1 or (photometric == "PALETTE COLOR" and storage != LABEL_MAP):
        return image
    _check_pixels(pixels, count, rows * columns)
    frames, unplaced, stacked = read_frames(path, header, count, (rows, columns))
    return Image(
        **{
            **vars(image),
            "frames": frames,
            "unplaced": unplaced,
            "stacked": stacked,
            "start": read_first_position(header),
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
    number = to_integer(name, value)
    if pixels.signed and number >= 2 ** (pixels.allocated - 1):
        return float(number - 2**pixels.allocated)
    return float(number if pixels.signed or number >= 0 else number + 2**pixels.allocated)


def _modality_table(header: Dataset, pixels: Pixels) -> tuple[int, NDArray[np.float64]] | None:
    """Return the Modality LUT: the first number that it maps, and the values from that number on."""
    item = read_first_item(header, "ModalityLUTSequence")
    if item is None:
        return None
    descriptor = read_numbers(item, "LUTDescriptor", 3)
    data: Any = item.get("LUTData")
    if descriptor is None or data is None:
        raise ValueError("ModalityLUTSequence holds no table")
    length, first_number, bits = (int(entry) for entry in descriptor)
    length = length if length > 0 else length + 2**16
    if isinstance(data, bytes):
        kind = "u1" if bits <= 8 and len(data) < 2 * length else "u2"
        values = np.frombuffer(data, dtype=("<" if pixels.little else ">") + kind)[:length]
    else:
        values = np.array(read_numbers(item, "LUTData"))[:length]
    if len(values) < length:
        raise ValueError(f"ModalityLUTSequence holds {len(values)} of {length} values")
    return first_number, values.astype(np.float64)


def _segments(header: Dataset, storage: str) -> Segments | None:
    """Return the segments of a segmentation; None for other files."""
    if storage not in (SEGMENTATION, LABEL_MAP):
        return None
    kind = clean_text(header.get("SegmentationType", "")) or "BINARY"
    kind = "LABELMAP" if storage == LABEL_MAP else kind
    segments = []
    for item in read_items(header, "SegmentSequence"):
        number = read_whole_number(item, "SegmentNumber", 0)
        name = clean_text(item.get("SegmentLabel") or item.get("SegmentDescription") or "")
        colour = read_numbers(item, "RecommendedDisplayCIELabValue", 3)
        segments.append(Segment(value=number, name=name, colour=None if colour is None else _srgb(colour)))
    return Segments(
        kind=kind, highest=max(1, read_whole_number(header, "MaximumFractionalValue", 255)), known=tuple(segments)
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
