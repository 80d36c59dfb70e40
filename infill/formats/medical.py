"""DICOM, a file or a folder of slices, by SimpleITK (extra `medical`)."""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from infill.errors import FormatError
from infill.formats.broken import SMALLER, checked_volume, is_ours, told_broken
from infill.formats.frames import chosen
from infill.machine import require_memory
from infill.volume import AXES, Volume

UNEVEN = 0.05  # of a slice: how far DICOM slices may deviate from even spacing
POSITION = "0020|0032"
HEAD = 1024  # bytes that contain the storage class
STORAGE_CLASS = b"\x02\x00\x02\x00UI"  # tag (0002,0002), little-endian like the rest of that header


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
    sitk = _simpleitk(path.suffix)
    reader, found = _announced(sitk, path)
    size, numbers = found.size, found.components
    if numbers > 1:
        what = f"holds a {found.kind} per cell; save one grey value, magnitude or label per cell"
        component = chosen(path, frame, numbers, what=what)
    else:
        at = chosen(path, frame, math.prod(size[AXES:]), what=f"has {len(size)} axes, {_times(size)}")
    if len(size) < AXES or size[2] == 1:
        raise FormatError(f"{path} is a single slice, {_times(size)}; give the folder of all slices, or a volume")
    if numbers == 1 and math.prod(size[AXES:]) > 1:
        reader.SetExtractSize((*size[:AXES], *(0 for _ in size[AXES:])))
        reader.SetExtractIndex((0, 0, 0, *(int(k) for k in np.unravel_index(at, size[AXES:], order="F"))))
    with _quiet(sitk, path):
        image = reader.Execute()
    return _placed(sitk, path, image, found.space, component=component if numbers > 1 else None)


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
    components = reader.GetNumberOfComponents()
    require_memory(math.prod(size) * components * _cell_bytes(kind), None, SMALLER)
    return reader, _Announced(size=size, kind=kind, components=components, space="LPS")


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
