"""`read_volume` and `write_field`: read a volume from a file and write one.

    .npy .npz           [x, y, z], or [z, y, x] where the file says so
    .tif .tiff          pages are z, rows y, columns x; likewise a folder of .tif or .png slices
    .nrrd .nii .mha …   with the place in space
    .mgz .mgh           of FreeSurfer
    .vtk .vti           images of VTK, legacy and XML
    .dcm                frames of DICOM in their place, by pydicom (extra `medical`)
    a DICOM folder      the only series in it, or the named one

Values keep their type, and are copied at most once.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

from infill.errors import FormatError, ParameterError
from infill.files.broken import missing_file, require_not_empty, wrap_read_errors
from infill.files.whole_files import atomic_file
from infill.grid import spacing_of
from infill.imaging.arrays import read_npy, read_npz, write_npz
from infill.imaging.assumed import keep_warnings
from infill.imaging.dicom.reading import read_dicom
from infill.imaging.freesurfer import read_mgh
from infill.imaging.metaimage import read_meta_image
from infill.imaging.nifti import read_nifti
from infill.imaging.nrrd import read_nrrd, write_nrrd
from infill.imaging.slices import SLICE_SUFFIXES, natural_key, read_slices, read_tiff
from infill.imaging.vtk_images import read_vtk
from infill.imaging.vtk_xml import read_vti
from infill.volume import AXES, Volume

DICOM_SUFFIX = ".dcm"


def read_volume(
    path: str | os.PathLike[str],
    *,
    array: str | None = None,
    series: str | None = None,
    frame: int | None = None,
    spacing: float | tuple[float, ...] | None = None,
) -> Volume:
    """Read the volume of a file or a folder.

    Parameters
    ----------
    path : str or Path
        .npy, .npz, .tif, .tiff, .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, .mgz, .mgh, .vtk, .vti; with SimpleITK also
        .dcm; a folder of .tif or .png slices, taken in the order of the numbers in their names; a
        folder of DICOM slices.
    array : str, optional
        Name of the array to read, if an .npz holds several with three axes.
    series : str, optional
        UID of the series to read, if a DICOM folder holds several.
    frame : int, optional
        Index of the volume, counted from 0, in a file with several: a time series, or several numbers per cell. Medical
        images, DICOM folders, and images of FreeSurfer and VTK have frames.
    spacing : float or (hx, hy, hz), optional
        Cell size, mm, which replaces the one in the file; some DICOM files have none.

    Returns
    -------
    Volume
        Values [x, y, z] of the type in the file. Its spacing and place are in mm, as stated in the file, or else
        cells of 1 at the origin. Medical images lie in LPS; their origin is converted from the centre of the
        first cell, which files give, to its lower corner. An .npy is memory-mapped, not loaded.

    Raises
    ------
    FormatError
        If the file is missing, of an unknown format or broken, or holds no grey volume.
    MemoryLimitError
        If the values need more memory than is available.
    ParameterError
        If `array`, `series` or `frame` is given for a file that has none.
    """
    source = Path(path)
    suffix = next((ending for ending in READERS if source.name.lower().endswith(ending)), "")
    if array is not None and suffix != ".npz":
        raise ParameterError.about(
            "array", f"is {array!r}, and only an .npz holds named arrays, not {source}; leave it out"
        )
    if series is not None and not source.is_dir():
        raise ParameterError.about(
            "series", f"is {series!r}, and {source} is not a folder; give the one that holds the series"
        )
    if frame is not None and not source.is_dir() and suffix and suffix not in FRAME_READERS:
        raise _frame_error(frame, source)
    size = None if spacing is None else spacing_of(spacing, AXES)
    with keep_warnings() as assumptions:
        volume = _read(source, suffix, array=array, series=series, frame=frame, size=size)
    if assumptions:
        volume = replace(volume, warnings=(*volume.warnings, *assumptions))
    return volume if size is None else replace(volume, spacing=size)


def _frame_error(frame: int, source: Path) -> ParameterError:
    """Return the error for a frame of a format without frames."""
    return ParameterError.about(
        "frame", f"is {frame!r}, and only {', '.join(FRAME_READERS)} hold frames, not {source}; leave it out"
    )


def _read(
    source: Path,
    suffix: str,
    *,
    array: str | None,
    series: str | None,
    frame: int | None,
    size: tuple[float, ...] | None,
) -> Volume:
    """Read a file or a folder by the reader of its suffix."""
    with wrap_read_errors(source):
        if source.is_dir():
            return _read_folder(source, series, frame, size)
        if not source.is_file():
            raise FormatError(missing_file(source))
        require_not_empty(source)
        if not suffix:
            endings = ", ".join(READERS)
            raise FormatError(f"cannot tell a volume from {source.name!r}; use one of {endings} or a folder of slices")
        if suffix == DICOM_SUFFIX:
            return read_dicom(source, frame, spacing=size)
        if frame is not None:
            return FRAME_READERS[suffix](source, frame)
        return read_npz(source, array) if suffix == ".npz" else READERS[suffix](source)


def holds_dicom(path: Path, series: str | None = None) -> bool:
    """Tell whether `read_volume` reads a path as DICOM, by the suffix of the file or of the files in the folder."""
    if not path.is_dir():
        return path.is_file() and path.stat().st_size > 0 and path.suffix.lower() == DICOM_SUFFIX
    names = _visible_files(path)
    slices = any(file.suffix.lower() in SLICE_SUFFIXES for file in names)
    return bool(names) and (
        not slices or series is not None or any(file.suffix.lower() == DICOM_SUFFIX for file in names)
    )


def _visible_files(folder: Path) -> list[Path]:
    """Return the visible files of a folder, in natural order."""
    return sorted((file for file in folder.iterdir() if file.is_file() and file.name[0] != "."), key=natural_key)


def _read_folder(folder: Path, series: str | None, frame: int | None, size: tuple[float, ...] | None) -> Volume:
    """Read a DICOM folder or a folder of slices."""
    names = _visible_files(folder)
    if not names:
        raise FormatError(f"{folder} holds no files; give the folder with the slices in it")
    if holds_dicom(folder, series):
        return read_dicom(folder, frame, series=series, spacing=size)
    if frame is not None:
        raise _frame_error(frame, folder)
    slices = [file for file in names if file.suffix.lower() in SLICE_SUFFIXES]
    if len({file.suffix.lower()[:4] for file in slices}) > 1:
        raise FormatError(f"{folder} holds slices as .png and as .tif; keep only those of one scan")
    return read_slices(folder, slices)


def write_field(volume: Volume, path: str | os.PathLike[str]) -> Path:
    """Write a volume; an existing file is replaced once the new one is complete.

    Parameters
    ----------
    volume : Volume
        Values [x, y, z], and where they lie in mm.
    path : str or Path
        .npz (arrays `values`, `spacing`, `origin`, `direction` and `space`) or .nrrd.

    Returns
    -------
    Path

    Raises
    ------
    FormatError
        For an unknown suffix.
    OutputError
        If the file cannot be written.
    """
    target = Path(path)
    write = field_writer(target)
    with atomic_file(target) as file:
        write(volume, file)
    return target


def field_writer(path: Path) -> Callable[[Volume, BinaryIO], None]:
    """Return the function that writes the format of `path`, or raise FormatError."""
    suffix = path.suffix.lower()
    if suffix not in FIELD_WRITERS:
        description = f"the suffix {path.suffix!r}" if suffix else f"{path.name!r}, which has no suffix"
        raise FormatError(f"cannot tell a format of volumes from {description}; use one of {', '.join(FIELD_WRITERS)}")
    return FIELD_WRITERS[suffix]


FRAME_READERS: dict[str, Callable[..., Volume]] = {
    **dict.fromkeys((".nrrd", ".nhdr"), read_nrrd),
    **dict.fromkeys((".nii", ".nii.gz"), read_nifti),
    **dict.fromkeys((".mha", ".mhd"), read_meta_image),
    DICOM_SUFFIX: read_dicom,
    **dict.fromkeys((".mgz", ".mgh", ".mgh.gz"), read_mgh),
    ".vtk": read_vtk,
    ".vti": read_vti,
}
READERS: dict[str, Callable[..., Volume]] = {
    ".npy": read_npy,
    ".npz": read_npz,
    ".tif": read_tiff,
    ".tiff": read_tiff,
    **FRAME_READERS,  # a frame may be left out
}
VOLUME_SUFFIXES = tuple(READERS)
FIELD_WRITERS: dict[str, Callable[[Volume, BinaryIO], None]] = {".npz": write_npz, ".nrrd": write_nrrd}
