"""Frames of DICOM that are packed, by SimpleITK (extra `medical`), in a process of its own: see child_process.py."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.child_process import read_in_child


def unpacked_frames(path: Path, source: Path) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Return the numbers in a DICOM file [frame, row, column], and what was said while they were unpacked.

    Parameters
    ----------
    path : Path
        A file that says nothing but pixels: see `infill.imaging.dicom_files.write_packed_frames`.
    source : Path
        The file that they come from, for messages.

    Raises
    ------
    FormatError
        If SimpleITK is not installed, or cannot read the file.
    MemoryLimitError
    """
    if importlib.util.find_spec("SimpleITK") is None:
        raise FormatError("reading .dcm needs the extra medical: pip install 'phasefill[medical]'")
    reply = read_in_child(f"{__name__}:unpack_frames", str(path), path=source)
    return reply.arrays["values"], reply.said


def unpack_frames(path: str) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Read a DICOM file by SimpleITK; return nothing more about it, and its numbers [frame, row, column]."""
    import SimpleITK

    image = SimpleITK.ReadImage(path, imageIO="GDCMImageIO")
    return {}, {"values": np.asarray(_Kept(SimpleITK.GetArrayViewFromImage(image), image))}


class _Kept:
    """The numbers of an image as an array; the image is kept alive as long as the array, so that nothing is copied."""

    def __init__(self, view: NDArray[Any], image: Any) -> None:  # noqa: ANN401 - SimpleITK.Image
        self.image = image
        self.__array_interface__ = view.__array_interface__
