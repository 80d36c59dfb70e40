"""Medical images: NRRD, NIfTI, MetaImage and DICOM by SimpleITK (extra `medical`); NRRD is written without it."""

from __future__ import annotations

import contextlib
import gzip
import math
import os
import re
import sys
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import IO, Any, BinaryIO, cast

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.broken import SMALLER, checked_volume, is_ours, told_broken
from infill.formats.frames import chosen
from infill.machine import require_memory
from infill.version import __version__
from infill.volume import AXES, Volume

UNEVEN = 0.05  # of a slice: how far DICOM slices may deviate from even spacing
POSITION = "0020|0032"
SEGMENTS = (".seg.nrrd", ".seg.nhdr")
HEAD = 1024  # bytes that contain the storage class
STORAGE_CLASS = b"\x02\x00\x02\x00UI"  # tag (0002,0002), little-endian like the rest of that header
HEARD = 4096  # bytes of what is printed while a file is read
USED_TAGS = ("NRRD_space", "vox_offset", "bitpix")  # among the headers that SimpleITK reports
NRRD_TYPES = {
    "b1": "uint8",
    "i1": "int8",
    "u1": "uint8",
    "i2": "int16",
    "u2": "uint16",
    "i4": "int32",
    "u4": "uint32",
    "i8": "int64",
    "u8": "uint64",
    "f4": "float",
    "f8": "double",
}
NRRD_SPACES = {"LPS": "left-posterior-superior", "RAS": "right-anterior-superior"}


class _Kept:
    """A SimpleITK image as an array; the image is kept alive as long as the array, so that nothing is copied."""

    def __init__(self, sitk: ModuleType, image: Any) -> None:  # noqa: ANN401 - SimpleITK.Image
        self.image = image
        self.__array_interface__ = sitk.GetArrayViewFromImage(image).__array_interface__


def _simpleitk(what: str) -> ModuleType:
    try:
        import SimpleITK
    except ImportError as error:
        raise FormatError(f"reading {what} needs the extra medical: pip install 'phasefill[medical]'") from error
    return SimpleITK


@contextlib.contextmanager
def _quiet(sitk: ModuleType, path: Path) -> Iterator[None]:
    """Turn SimpleITK errors into ours, and keep its warnings off the terminal."""
    shown = sitk.ProcessObject.GetGlobalWarningDisplay()
    sitk.ProcessObject.SetGlobalWarningDisplay(False)
    try:
        yield
    except RuntimeError as error:
        if is_ours(error):
            raise
        lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Reason:")]
        said = re.sub(r"^.*ERROR: |\w+\(0x\w+\): |\[nrrd\] ", "", lines[-1] if lines else "no reason given")
        raise FormatError(f"cannot read {path} ({said.strip()}); check the file, or save it again") from error
    finally:
        sitk.ProcessObject.SetGlobalWarningDisplay(shown)


def read_medical(path: Path, frame: int | None = None) -> Volume:
    """Return the volume of one file, [x, y, z], where it lies in space, or one of several, counted from 0."""
    sitk = _simpleitk(path.suffix if path.suffix.lower() != ".gz" else ".nii.gz")
    reader, found = _announced(sitk, path)
    size, numbers = found.size, found.components
    if numbers > 1:
        what = f"holds a {found.kind} per cell; save one grey value, magnitude or label per cell"
        if path.name.lower().endswith(SEGMENTS):
            what = f"holds {numbers} layers of segments; write all with {{label}} in the name of the output"
        component = chosen(path, frame, numbers, what=what)
    else:
        at = chosen(path, frame, math.prod(size[AXES:]), what=f"has {len(size)} axes, {_times(size)}")
    if len(size) < AXES or (path.suffix.lower() == ".dcm" and size[2] == 1):
        raise FormatError(f"{path} is a single slice, {_times(size)}; give the folder of all slices, or a volume")
    if numbers == 1 and math.prod(size[AXES:]) > 1:
        reader.SetExtractSize((*size[:AXES], *(0 for _ in size[AXES:])))
        reader.SetExtractIndex((0, 0, 0, *(int(k) for k in np.unravel_index(at, size[AXES:], order="F"))))
    with _quiet(sitk, path):
        image = reader.Execute()
    return _placed(sitk, path, image, found.space, component=component if numbers > 1 else None)


def unpacked_frames(path: Path, source: Path) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Return the numbers in a DICOM file [frame, row, column], and what was said while they were unpacked.

    Parameters
    ----------
    path : Path
        A file that says nothing but pixels: see `infill.formats.dicom_files.write_packed_frames`.
    source : Path
        The file that they come from, for messages.
    """
    sitk = _simpleitk(".dcm")
    said: list[str] = []
    with _quiet(sitk, source), _heard(sitk, said):
        values = sitk.GetArrayFromImage(sitk.ReadImage(str(path), imageIO="GDCMImageIO"))
    return values, tuple(said)


@contextlib.contextmanager
def _heard(sitk: ModuleType, said: list[str]) -> Iterator[None]:
    """Collect what ITK warns of, and what its libraries print on stderr, line by line."""
    base: Any = sitk.LoggerBase

    class Listener(base):  # type: ignore[misc]
        def DisplayText(self, text: str) -> None:  # noqa: N802 - its name in ITK
            said.extend(text.splitlines())

        DisplayErrorText = DisplayWarningText = DisplayGenericOutputText = DisplayText

        def DisplayDebugText(self, text: str) -> None:  # noqa: N802
            """Leave out what is for developers."""

    listener = Listener()
    before = listener.SetAsGlobalITKLogger()
    sitk.ProcessObject.SetGlobalWarningDisplay(True)
    sys.stderr.flush()
    kept = os.dup(2)
    try:
        with tempfile.TemporaryFile() as file:
            os.dup2(file.fileno(), 2)
            try:
                yield
            finally:
                os.dup2(kept, 2)
                file.seek(0)
                said.extend(file.read(HEARD).decode("utf-8", "replace").splitlines())
    finally:
        os.close(kept)
        before.SetAsGlobalITKLogger()
        said[:] = [line for line in dict.fromkeys(each.strip() for each in said) if line]


def read_layers(path: Path) -> tuple[Volume, ...]:
    """Return every component of an image as a volume, in order: the layers of a segmentation, which may be empty."""
    sitk = _simpleitk(path.suffix)
    reader, found = _announced(sitk, path)
    if len(found.size) != AXES:
        return (read_medical(path),)
    with _quiet(sitk, path):
        image = reader.Execute()
    if found.components == 1:
        return (_placed(sitk, path, image, found.space),)
    return tuple(
        _placed(sitk, path, image, found.space, component=layer, varied=False) for layer in range(found.components)
    )


@dataclass(frozen=True, kw_only=True)
class _Announced:
    """What the header of an image says: cells along each axis, type of a cell, numbers per cell, space."""

    size: tuple[int, ...]
    kind: str
    components: int
    space: str


def _announced(sitk: ModuleType, path: Path) -> tuple[Any, _Announced]:
    """Return the reader of a file that has read its header, and what that says, checked."""
    reader = sitk.ImageFileReader()
    reader.SetFileName(str(path))
    with _quiet(sitk, path):
        reader.ReadImageInformation()
    size, kind = reader.GetSize(), sitk.GetPixelIDValueAsString(reader.GetPixelID())
    if "complex" in kind:
        raise FormatError(f"{path} holds a {kind} per cell; save one grey value, magnitude or label per cell")
    known = {key: reader.GetMetaData(key) for key in USED_TAGS if reader.HasMetaDataKey(key)}
    components = reader.GetNumberOfComponents()
    if path.name.lower().endswith((".nii", ".nii.gz")):
        _require_whole_nifti(path, (*size, 1 if "8-bit" in kind else components), known)  # bytes of a colour are one
    require_memory(math.prod(size) * components * _cell_bytes(kind), None, SMALLER)
    # An NRRD may lie in a space without a name; for all other formats, the readers convert theirs to LPS.
    named = not path.name.lower().endswith((".nrrd", ".nhdr")) or known.get("NRRD_space") == "left-posterior-superior"
    return reader, _Announced(size=size, kind=kind, components=components, space="LPS" if named else "")


def _placed(
    sitk: ModuleType,
    path: Path,
    image: Any,  # noqa: ANN401 - SimpleITK.Image
    space: str,
    *,
    component: int | None = None,
    varied: bool = True,
) -> Volume:
    """Return an image, or one component of it, as a volume [x, y, z], with its origin at a corner of the first cell."""
    axes = image.GetDimension()
    values = np.asarray(_Kept(sitk, image))
    values = values if component is None else values[..., component]
    values = values.reshape(values.shape[-AXES:]).T  # axes beyond three have one cell
    spacing = np.array(image.GetSpacing()[:AXES])
    direction = np.array(image.GetDirection()).reshape(axes, axes)[:AXES, :AXES]
    corner = np.array(image.GetOrigin()[:AXES]) - direction @ (spacing / 2)
    place = {"spacing": tuple(spacing.tolist()), "origin": tuple(corner.tolist()), "direction": direction}
    return checked_volume(path, values, varied=varied, space=space, **place)


def _times(size: tuple[int, ...]) -> str:
    return " x ".join(str(cells) for cells in size) + " cells"


def _cell_bytes(kind: str) -> int:
    found = re.search(r"(\d+)-bit", kind)
    return int(found[1]) // 8 if found else 8


def _require_whole_nifti(path: Path, size: tuple[int, ...], known: dict[str, str]) -> None:
    """Raise FormatError for a truncated NIfTI: its reader would silently fill the rest with zeros."""
    with told_broken(path):
        needed = int(float(known["vox_offset"])) + math.prod(size) * int(known["bitpix"]) // 8
    if path.suffix.lower() != ".gz":
        held = path.stat().st_size
    else:
        with path.open("rb") as file:
            file.seek(-min(4, path.stat().st_size), os.SEEK_END)
            announced = int.from_bytes(file.read(4), "little")  # size of the last part, modulo 4 GiB
        held = needed if announced == needed % 2**32 else _unpacked_bytes(path)
    if held < needed:
        raise FormatError(f"{path} is cut off: it holds {held} bytes of {needed}; copy or save it again")


def _unpacked_bytes(path: Path) -> int:
    with told_broken(path), gzip.open(path) as file:
        held = 0
        while chunk := file.read(2**20):
            held += len(chunk)
    return held


def read_dicom(folder: Path, series: str | None) -> Volume:
    """Return the only series in a folder, or the one with the given UID."""
    sitk = _simpleitk("a DICOM folder")
    reader = sitk.ImageSeriesReader()
    with _quiet(sitk, folder):
        found = {
            each: reader.GetGDCMSeriesFileNames(str(folder), each) for each in reader.GetGDCMSeriesIDs(str(folder))
        }
    if not found:
        raise FormatError(f"{folder} holds no DICOM series and no .tif or .png slices; give the folder with the slices")
    _require_whole_slices(folder, {name for names in found.values() for name in names})
    listed = ", ".join(f"{each} ({len(names)} slices)" for each, names in found.items())
    if series is None and len(found) > 1:
        raise FormatError(
            f"{folder} holds {len(found)} DICOM series, {listed}; choose one: --series {next(iter(found))}"
        )
    if series is not None and series not in found:
        raise FormatError(f"{folder} holds no DICOM series {series!r}; it holds {listed}")
    names = found[next(iter(found)) if series is None else series]
    if len(names) == 1:
        return read_medical(Path(names[0]))
    reader.SetFileNames(names)
    reader.MetaDataDictionaryArrayUpdateOn()
    with _quiet(sitk, folder):
        require_memory(_series_bytes(sitk, names), None, SMALLER)
        image = reader.Execute()
        places = [reader.GetMetaData(k, POSITION) for k in range(len(names)) if reader.HasMetaDataKey(k, POSITION)]
    if image.GetNumberOfComponentsPerPixel() > 1:
        raise FormatError(f"{folder} holds colour slices; give a series of grey ones")
    if image.GetDimension() != AXES or len(places) != len(names):
        raise FormatError(f"{folder} holds slices that do not say where they lie; save the stack as a volume")
    _require_even(folder, image, places)
    return _placed(sitk, folder, image, "LPS")


def _require_whole_slices(folder: Path, listed: set[str]) -> None:
    """Raise FormatError for slices that the search for series silently left out, as it does if they are truncated.

    The storage class tells them apart from reports, plans and other objects without pixels, which may lie next to them.
    """
    kinds = {_storage_class(Path(name)) for name in listed} - {b""}
    names = {Path(name).name for name in listed}
    for path in sorted(folder.iterdir()):
        if path.is_file() and path.name not in names and _storage_class(path) in kinds:
            raise FormatError(f"{path} is broken or cut off, and its slice would be missing; copy the folder again")


def _storage_class(path: Path) -> bytes:
    """Return the UID that says what a DICOM file holds, such as CT slices or a report; empty for other files."""
    with path.open("rb") as file:
        head = file.read(HEAD)
    at = head.find(STORAGE_CLASS)
    if head[128:132] != b"DICM" or at < 0:
        return b""
    begin = at + len(STORAGE_CLASS) + 2
    return head[begin : begin + int.from_bytes(head[begin - 2 : begin], "little")].rstrip(b"\0")


def _series_bytes(sitk: ModuleType, names: tuple[str, ...]) -> int:
    first = sitk.ImageFileReader()
    first.SetFileName(names[0])
    first.ReadImageInformation()
    return (
        int(math.prod(first.GetSize()[:2])) * len(names) * _cell_bytes(sitk.GetPixelIDValueAsString(first.GetPixelID()))
    )


def _require_even(folder: Path, image: Any, places: list[str]) -> None:  # noqa: ANN401 - SimpleITK.Image
    """Raise FormatError if slices are missing, duplicated, or sheared by a tilted scanner: the part would be bent."""
    with told_broken(folder):
        lie = np.array([[float(number) for number in place.split("\\")] for place in places])
    even = np.array([image.TransformIndexToPhysicalPoint((0, 0, k)) for k in range(len(places))])
    off = float(np.linalg.norm(lie - even, axis=1).max()) / image.GetSpacing()[2]
    if not off <= UNEVEN:
        raise FormatError(
            f"{folder} has slices up to {off:.2g} of a slice away from even steps (missing, doubled, or a tilted "
            "scanner); resample the series to even slices first"
        )


def write_nrrd(volume: Volume, file: BinaryIO) -> None:
    """Write NRRD: a text header and the values, compressed by gzip; `space origin` is the centre of the first cell.

    Booleans become 0 and 1, and 16-bit floating-point numbers become 32-bit. A space without a name stays
    without one, so that no program reorients its axes. Source: "Definition of NRRD File Format", Teem.
    """
    kind = _stored(volume.values.dtype)
    axes = np.asarray(volume.direction) * volume.cell_size  # column i: one cell along axis i
    centre = np.array(volume.origin) + axes.sum(axis=1) / 2
    space = f"space: {NRRD_SPACES[volume.space]}" if volume.space in NRRD_SPACES else f"space dimension: {AXES}"
    header = (
        "NRRD0005",
        f"# phasefill {__version__}, millimetres",
        f"type: {NRRD_TYPES[kind.str[1:]]}",
        f"dimension: {AXES}",
        space,
        f"sizes: {' '.join(str(cells) for cells in volume.values.shape)}",
        f"space directions: {' '.join(_vector(axis) for axis in axes.T)}",
        f"kinds:{AXES * ' domain'}",
        "endian: little",
        "encoding: gzip",
        f"space origin: {_vector(centre)}",
    )
    file.write(("\n".join(header) + "\n\n").encode("ascii"))
    with gzip.GzipFile(filename="", mode="wb", compresslevel=6, fileobj=cast(IO[bytes], file), mtime=0) as packed:
        for k in range(volume.values.shape[2]):  # layer by layer, so that no second copy is held
            packed.write(volume.values[:, :, k].astype(kind).tobytes(order="F"))


def _stored(kind: np.dtype[np.generic]) -> np.dtype[np.generic]:
    """Return the type in which NRRD holds numbers of type `kind`, low byte first."""
    if kind.kind == "f":
        return np.dtype("<f4" if kind.itemsize <= 4 else "<f8")
    return np.dtype(np.uint8) if kind.kind == "b" else kind.newbyteorder("<")


def _vector(numbers: Iterable[float]) -> str:
    return "(" + ",".join(f"{float(number):.17g}" for number in numbers) + ")"
