"""Decompress DICOM frames by SimpleITK (extra `medical`), in a child process: see child_process.py."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.child_process import read_in_child


def unpacked_frames(path: Path, source: Path) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Decompress a DICOM file; return its numbers [frame, row, column] and the messages of the library.

    Parameters
    ----------
    path : Path
        A file that holds only pixels: see `infill.imaging.dicom.pixels`.
    source : Path
        The original file, for messages.

    Raises
    ------
    FormatError
        If SimpleITK is not installed, or cannot read the file.
    MemoryLimitError
    """
    if importlib.util.find_spec("SimpleITK") is None:
        raise FormatError("reading .dcm needs the extra medical: pip install pydicom SimpleITK")
    reply = read_in_child(f"{__name__}:unpack_frames", str(path), path=source)
    return reply.arrays["values"], reply.said


def unpack_frames(path: str) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Read a DICOM file by SimpleITK; return an empty dict and its numbers [frame, row, column]."""
    import SimpleITK

    image = SimpleITK.ReadImage(path, imageIO="GDCMImageIO")
    return {}, {"values": np.asarray(_ImageArray(SimpleITK.GetArrayViewFromImage(image), image))}


class _ImageArray:
    """The numbers of an image as an array that keeps the image alive, so that no copy is needed."""

    def __init__(self, view: NDArray[Any], image: Any) -> None:  # noqa: ANN401 - SimpleITK.Image
        self.image = image
        self.__array_interface__ = view.__array_interface__
