"""A volume from a file: plain arrays, stacks of pictures, medical images.

    .npy .npz           [x, y, z], or [z, y, x] where the file says so
    .tif .tiff          pages are z, rows y, columns x; so is a folder of .tif or .png slices
    .nrrd .nii .mha …   by SimpleITK (extra `medical`), with their place in space
    a DICOM folder      the one series in it, or the one that is named

Values keep their type, and are copied once at most.
"""

from __future__ import annotations

import contextlib
import gzip
import logging
import math
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, ParameterError
from infill.fields import SMALLER, checked_volume, one_line, read_npy, read_npz, told_broken
from infill.machine import require_memory
from infill.volume import AXES, Volume

SLICES = {".tif", ".tiff", ".png"}
GREY_MODES = {"1", "L", "I", "I;16", "I;16L", "I;16B", "F"}
MILLIMETRES = {
    "nm": 1e-6, "µm": 1e-3, "μm": 1e-3, "um": 1e-3, "\\u00b5m": 1e-3, "micron": 1e-3, "microns": 1e-3,
    "micrometer": 1e-3, "mm": 1.0, "millimeter": 1.0, "cm": 10.0, "centimeter": 10.0, "inch": 25.4, "m": 1e3,
}  # fmt: skip
UNEVEN = 0.05  # of a slice: how far DICOM slices may lie from even steps
POSITION = "0020|0032"
USED_TAGS = ("NRRD_space", "vox_offset", "bitpix")  # of the headers that SimpleITK tells


def read_volume(path: str | os.PathLike[str], *, array: str | None = None, series: str | None = None) -> Volume:
    """Return the volume that a file or a folder holds.

    Parameters
    ----------
    path : str or Path
        .npy, .npz, .tif, .tiff; with SimpleITK also .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, .dcm; a folder
        of .tif or .png slices, taken in the order of the numbers in their names; a folder of DICOM slices.
    array : str, optional
        Name of the array to take, where an .npz holds several with three axes.
    series : str, optional
        UID of the series to take, where a DICOM folder holds several.

    Returns
    -------
    Volume
        Values [x, y, z] of the type in the file. Its spacing and place are in mm: as the file says, else
        cells of 1 at the origin. Medical images lie in LPS; their origin is turned from the centre of the
        first cell, as files have it, into its lower corner. An .npy is mapped, not loaded.

    Raises
    ------
    FormatError
        If there is no such file, it is of no known kind, is broken, or holds no grey volume.
    MemoryLimitError
        If the values need more memory than there is.
    ParameterError
        If `array` or `series` is given for a file that has none.
    """
    source = Path(path)
    suffix = next((each for each in READERS if source.name.lower().endswith(each)), "")
    if array is not None and suffix != ".npz":
        raise ParameterError(f"array={array!r} was given for {source}; only an .npz holds named arrays")
    if series is not None and not source.is_dir():
        raise ParameterError(f"series={series!r} was given for {source}; give the folder that holds the series")
    try:
        if source.is_dir():
            return _read_folder(source, series)
        if not source.is_file():
            raise FormatError(f"there is no file {source}; check the name")
        if not suffix:
            known = ", ".join(READERS)
            raise FormatError(f"cannot tell a volume from {source.name!r}; use one of {known} or a folder of slices")
        return read_npz(source, array) if suffix == ".npz" else READERS[suffix](source)
    except OSError as error:
        reason = error.strerror or one_line(error)
        raise FormatError(f"cannot read {source}: {reason}; check the file") from error


# --- stacks of pictures ----------------------------------------------------------------------------------


@contextlib.contextmanager
def _no_complaints(path: Path) -> Iterator[None]:
    """Raise FormatError for what tifffile only logs, such as pages that a truncated file lacks."""
    complaints: list[str] = []

    def keep(record: logging.LogRecord) -> bool:
        if record.levelno >= logging.ERROR:
            complaints.append(record.getMessage())
        return False

    logger = logging.getLogger("tifffile")
    logger.addFilter(keep)
    try:
        yield
    finally:
        logger.removeFilter(keep)
    if complaints:
        said = " ".join(complaints[0].split())
        raise FormatError(f"{path} is broken or cut off ({said}); save it again")


def _read_tiff(path: Path) -> Volume:
    pages, spacing = _tiff_pages(path)
    return checked_volume(path, pages.T, spacing=spacing)


def _tiff_pages(path: Path) -> tuple[NDArray[Any], tuple[float, ...]]:
    """Return grey pages [(z,) y, x] and the cell size along x, y, z."""
    import tifffile

    with _no_complaints(path), told_broken(path), tifffile.TiffFile(path) as tiff:
        found = tiff.series
        if len(found) > 1:
            shapes = ", ".join(str(each.shape) for each in found[:4])
            raise FormatError(f"{path} holds pages of different kinds, {shapes}; save one stack of equal pages")
        axes, shape = found[0].axes, found[0].shape
        if "S" in axes or "C" in axes:
            raise FormatError(
                f"{path} holds colours or channels (axes {axes}, shape {shape}); save one of them as grey"
            )
        if len(shape) > AXES:
            raise FormatError(f"{path} has {len(shape)} axes ({axes}, shape {shape}); save one stack of it")
        require_memory(found[0].nbytes, None, SMALLER)
        return found[0].asarray(), _tiff_spacing(tiff)


def _tiff_spacing(tiff: Any) -> tuple[float, ...]:  # noqa: ANN401 - tifffile.TiffFile
    """Return the cell size along x, y, z in mm, as ImageJ or OME wrote it; 1 where they did not."""
    if tiff.ome_metadata:
        # Only attributes are looked at, and the standard parser fetches nothing from outside.
        pixels = ElementTree.fromstring(tiff.ome_metadata).find(".//{*}Pixels")  # noqa: S314
        if pixels is None or pixels.get("PhysicalSizeX") is None:
            return (1.0,) * AXES
        sizes = [(pixels.get(f"PhysicalSize{axis}"), pixels.get(f"PhysicalSize{axis}Unit", "µm")) for axis in "XYZ"]
        return tuple(float(size) * MILLIMETRES.get(unit.lower(), 1.0) if size else 1.0 for size, unit in sizes)
    if tiff.imagej_metadata:
        unit = MILLIMETRES.get(str(tiff.imagej_metadata.get("unit", "")).lower(), 1.0)
        tags = [tiff.pages[0].tags.get(name) for name in ("XResolution", "YResolution")]
        per_cell = [tag.value[1] / tag.value[0] if tag is not None and tag.value[0] else 1.0 for tag in tags]
        return tuple(size * unit for size in (*per_cell, abs(float(tiff.imagej_metadata.get("spacing", 1.0)))))
    return (1.0,) * AXES


def _read_slices(folder: Path, names: list[Path]) -> Volume:
    pages: NDArray[Any] | None = None
    spacing = (1.0,) * AXES
    for number, name in enumerate(names):
        page, sizes = _read_png(name) if name.suffix.lower() == ".png" else _tiff_pages(name)
        if page.ndim != 2:
            raise FormatError(f"{name} has the shape {page.shape}; a folder of slices holds one grey page per file")
        if pages is None:
            require_memory(page.nbytes * len(names), None, SMALLER)
            pages, spacing = np.empty((len(names), *page.shape), dtype=page.dtype), sizes
        if page.shape != pages.shape[1:] or page.dtype != pages.dtype:
            raise FormatError(
                f"{name} is {page.shape} {page.dtype} and {names[0].name} is {pages.shape[1:]} {pages.dtype}; "
                f"keep only slices of one scan in {folder}"
            )
        pages[number] = page
    assert pages is not None
    return checked_volume(folder, pages.T, spacing=spacing)


def _read_png(path: Path) -> tuple[NDArray[Any], tuple[float, ...]]:
    from PIL import Image

    try:
        with told_broken(path), Image.open(path) as picture:
            if picture.mode not in GREY_MODES:
                raise FormatError(f"{path} is a picture of mode {picture.mode}; save the slices as grey")
            return np.asarray(picture), (1.0,) * AXES
    except Image.DecompressionBombError as error:
        raise FormatError(f"{path} is too large a picture ({one_line(error)}); save the stack as .tif") from error


def _read_folder(folder: Path, series: str | None) -> Volume:
    names = sorted((each for each in folder.iterdir() if each.is_file() and each.name[0] != "."), key=_natural)
    if not names:
        raise FormatError(f"{folder} holds no files; give the folder with the slices in it")
    slices = [each for each in names if each.suffix.lower() in SLICES]
    if not slices or series is not None or any(each.suffix.lower() == ".dcm" for each in names):
        return _read_dicom(folder, series)
    if len({each.suffix.lower()[:4] for each in slices}) > 1:
        raise FormatError(f"{folder} holds slices as .png and as .tif; keep only those of one scan")
    return _read_slices(folder, slices)


def _natural(path: Path) -> list[tuple[int, str]]:
    """Return a key by which slice 9 comes before slice 10."""
    parts = re.split(r"([0-9]+)", path.name.lower())
    return [(int(part), "") if number % 2 else (0, part) for number, part in enumerate(parts)]


# --- medical images --------------------------------------------------------------------------------------


class _Kept:
    """An image of SimpleITK as an array, kept alive for as long as the array is, so that nothing is copied."""

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
    """Turn errors of SimpleITK into ours, and keep its warnings off the terminal."""
    shown = sitk.ProcessObject.GetGlobalWarningDisplay()
    sitk.ProcessObject.SetGlobalWarningDisplay(False)
    try:
        yield
    except RuntimeError as error:
        lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Reason:")]
        said = re.sub(r"^.*ERROR: |\w+\(0x\w+\): |\[nrrd\] ", "", lines[-1] if lines else "no reason given")
        raise FormatError(f"cannot read {path} ({said.strip()}); check the file, or save it again") from error
    finally:
        sitk.ProcessObject.SetGlobalWarningDisplay(shown)


def _read_medical(path: Path) -> Volume:
    sitk = _simpleitk(path.suffix if path.suffix.lower() != ".gz" else ".nii.gz")
    reader = sitk.ImageFileReader()
    reader.SetFileName(str(path))
    with _quiet(sitk, path):
        reader.ReadImageInformation()
    size, kind = reader.GetSize(), sitk.GetPixelIDValueAsString(reader.GetPixelID())
    if reader.GetNumberOfComponents() > 1 or "complex" in kind:
        raise FormatError(f"{path} holds a {kind} per cell; save one grey value, magnitude or label per cell")
    if len(size) > AXES and math.prod(size[AXES:]) > 1:
        raise FormatError(f"{path} has {len(size)} axes, {_times(size)}; save one volume of it, with three")
    if len(size) < AXES or (path.suffix.lower() == ".dcm" and size[2] == 1):
        raise FormatError(f"{path} is a single slice, {_times(size)}; give the folder of all slices, or a volume")
    known = {key: reader.GetMetaData(key) for key in USED_TAGS if reader.HasMetaDataKey(key)}
    if path.name.lower().endswith((".nii", ".nii.gz")):
        _require_whole_nifti(path, size, known)
    require_memory(math.prod(size) * _cell_bytes(kind), None, SMALLER)
    with _quiet(sitk, path):
        image = reader.Execute()
    # An NRRD may lie in a space without a name; the readers of all others turn theirs into LPS.
    named = not path.name.lower().endswith((".nrrd", ".nhdr")) or known.get("NRRD_space") == "left-posterior-superior"
    return _placed(sitk, path, image, "LPS" if named else "")


def _placed(sitk: ModuleType, path: Path, image: Any, space: str) -> Volume:  # noqa: ANN401 - SimpleITK.Image
    """Return an image as a volume: [x, y, z], its origin the lower corner of the first cell."""
    axes = image.GetDimension()
    values = np.asarray(_Kept(sitk, image))
    values = values.reshape(values.shape[-AXES:]).T  # axes beyond three have one cell
    spacing = np.array(image.GetSpacing()[:AXES])
    direction = np.array(image.GetDirection()).reshape(axes, axes)[:AXES, :AXES]
    corner = np.array(image.GetOrigin()[:AXES]) - direction @ (spacing / 2)
    return checked_volume(
        path, values, spacing=tuple(spacing.tolist()), origin=tuple(corner.tolist()), direction=direction, space=space
    )


def _times(size: tuple[int, ...]) -> str:
    return " x ".join(str(cells) for cells in size) + " cells"


def _cell_bytes(kind: str) -> int:
    found = re.search(r"(\d+)-bit", kind)
    return int(found[1]) // 8 if found else 8


def _require_whole_nifti(path: Path, size: tuple[int, ...], known: dict[str, str]) -> None:
    """Raise FormatError for a NIfTI that is cut off: its reader would fill the rest with zeros and say nothing."""
    with told_broken(path):
        needed = int(float(known["vox_offset"])) + math.prod(size) * int(known["bitpix"]) // 8
    if path.suffix.lower() != ".gz":
        held = path.stat().st_size
    else:
        with path.open("rb") as file:
            file.seek(-min(4, path.stat().st_size), os.SEEK_END)
            announced = int.from_bytes(file.read(4), "little")  # of the last part, modulo 4 GiB
        held = needed if announced == needed % 2**32 else _unpacked_bytes(path)
    if held < needed:
        raise FormatError(f"{path} is cut off: it holds {held} bytes of {needed}; copy or save it again")


def _unpacked_bytes(path: Path) -> int:
    with told_broken(path), gzip.open(path) as file:
        held = 0
        while chunk := file.read(2**20):
            held += len(chunk)
    return held


def _read_dicom(folder: Path, series: str | None) -> Volume:
    sitk = _simpleitk("a DICOM folder")
    reader = sitk.ImageSeriesReader()
    with _quiet(sitk, folder):
        found = {
            each: reader.GetGDCMSeriesFileNames(str(folder), each) for each in reader.GetGDCMSeriesIDs(str(folder))
        }
    if not found:
        raise FormatError(f"{folder} holds no DICOM series and no .tif or .png slices; give the folder with the slices")
    listed = ", ".join(f"{each} ({len(names)} slices)" for each, names in found.items())
    if series is None and len(found) > 1:
        raise FormatError(
            f"{folder} holds {len(found)} DICOM series, {listed}; choose one: --series {next(iter(found))}"
        )
    if series is not None and series not in found:
        raise FormatError(f"{folder} holds no DICOM series {series!r}; it holds {listed}")
    names = found[next(iter(found)) if series is None else series]
    if len(names) == 1:
        return _read_medical(Path(names[0]))
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


def _series_bytes(sitk: ModuleType, names: tuple[str, ...]) -> int:
    first = sitk.ImageFileReader()
    first.SetFileName(names[0])
    first.ReadImageInformation()
    return (
        int(math.prod(first.GetSize()[:2])) * len(names) * _cell_bytes(sitk.GetPixelIDValueAsString(first.GetPixelID()))
    )


def _require_even(folder: Path, image: Any, places: list[str]) -> None:  # noqa: ANN401 - SimpleITK.Image
    """Raise FormatError if slices are missing, doubled, or sheared by a tilted scanner: the part would be bent."""
    with told_broken(folder):
        lie = np.array([[float(number) for number in place.split("\\")] for place in places])
    even = np.array([image.TransformIndexToPhysicalPoint((0, 0, k)) for k in range(len(places))])
    off = float(np.linalg.norm(lie - even, axis=1).max()) / image.GetSpacing()[2]
    if not off <= UNEVEN:
        raise FormatError(
            f"{folder} has slices up to {off:.2g} of a slice away from even steps (missing, doubled, or a tilted "
            "scanner); resample the series to even slices first"
        )


READERS: dict[str, Callable[[Path], Volume]] = {
    ".npy": read_npy,
    ".npz": read_npz,
    ".tif": _read_tiff,
    ".tiff": _read_tiff,
    **dict.fromkeys((".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd", ".dcm"), _read_medical),
}
