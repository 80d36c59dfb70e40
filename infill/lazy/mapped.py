"""Arrays in files that are not compressed: .npy, NIfTI, NRRD and TIFF, read in parts by the system."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import wrap_read_errors, wrap_reader_errors
from infill.imaging.images import StoredCells, placement
from infill.imaging.nifti import locate_nifti
from infill.imaging.nrrd import locate_nrrd
from infill.imaging.slices import locate_tiff, read_tiff_pages
from infill.lazy.volume import LazyVolume, read_error, require_volume
from infill.volume import AXES


@dataclass(frozen=True)
class MappedArray:
    """Cells of one file, one after another.

    Parameters
    ----------
    path : str
    begin : int
        Position of the first cell, bytes.
    stored : (a, b, c) int
        Cells along the axes, the slowest first.
    axes : (3,) int
        The stored axis that is x, y and z.
    kind : str
        Type of the cells, with the order of their bytes.
    """

    path: str
    begin: int
    stored: tuple[int, ...]
    axes: tuple[int, ...]
    kind: str

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along x, y and z."""
        return tuple(self.stored[axis] for axis in self.axes)

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        return np.dtype(self.kind).newbyteorder("=")

    @property
    def grain(self) -> tuple[int, ...]:
        """Cells of a layer across the slowest axis."""
        return tuple(1 if axis == 0 else self.stored[axis] for axis in self.axes)

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""
        with wrap_read_errors(Path(self.path)):
            try:
                cells = np.memmap(self.path, dtype=self.kind, mode="r", offset=self.begin, shape=self.stored)
            except ValueError as error:
                raise read_error(self.path, box, error) from error
            return np.array(cells.transpose(self.axes)[box], dtype=self.dtype, order="C")


@dataclass(frozen=True)
class TiffArray:
    """Compressed pages of one file, or one file for each page.

    Parameters
    ----------
    files : tuple of str
    stored : (z, y, x) int
    kind : str
        Type of the cells.
    """

    files: tuple[str, ...]
    stored: tuple[int, ...]
    kind: str

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along x, y and z."""
        return self.stored[::-1]

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        return np.dtype(self.kind)

    @property
    def grain(self) -> tuple[int, ...]:
        """Cells of a page."""
        return (*self.shape[:2], 1)

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""
        x, y, z = box
        low, high = int(z.start), int(z.stop)
        if len(self.files) == 1:
            pages = read_tiff_pages(Path(self.files[0]), low, high)[:, y, x]
        else:
            pages = np.stack([self._page(self.files[number])[y, x] for number in range(low, high)])
        return np.ascontiguousarray(pages.T, dtype=self.dtype)

    def _page(self, name: str) -> NDArray[Any]:
        """Read the page of a file."""
        page: NDArray[Any] = read_tiff_pages(Path(name), 0, 1)[0]
        if page.shape != self.stored[1:] or page.dtype.newbyteorder("=") != self.dtype:
            raise FormatError(
                f"{name} is {page.shape} {page.dtype} and {Path(self.files[0]).name} is {self.stored[1:]} {self.kind}; "
                "keep only slices of one scan in the folder"
            )
        return page


def open_npy(path: Path) -> LazyVolume:
    """Open an array [x, y, z]."""
    with wrap_reader_errors(path):
        values = npy_format.open_memmap(path, mode="r")
        require_volume(str(path), values.shape, values.dtype)
        along_x, along_y, along_z = values.shape
        stored, axes = (
            (values.shape, (0, 1, 2)) if values.flags.c_contiguous else ((along_z, along_y, along_x), (2, 1, 0))
        )
        return LazyVolume(array=MappedArray(str(path), values.offset, stored, axes, values.dtype.str), name=str(path))


def open_stored(cells: StoredCells, path: Path) -> LazyVolume:
    """Open the only volume of a medical image."""
    header = cells.header
    if header.frames != 1:
        raise FormatError(f"{path} holds {header.frames} volumes; save one of them, or leave --workers out")
    if sorted(header.spatial) != list(range(AXES)):
        raise FormatError(f"{path} has its axes of space behind another one; save it again with three axes")
    sizes = header.sizes[:AXES]
    axes = tuple(AXES - 1 - axis for axis in header.spatial)
    array = MappedArray(str(cells.path), cells.begin, sizes[::-1], axes, cells.kind.str)
    return LazyVolume(array=array, name=str(path), **placement(header))


def open_nifti(path: Path) -> LazyVolume:
    """Open an .nii that is not compressed."""
    return open_stored(locate_nifti(path), path)


def open_nrrd(path: Path) -> LazyVolume:
    """Open an .nrrd that is not compressed."""
    return open_stored(locate_nrrd(path), path)


def open_tiff(files: tuple[Path, ...], folder: Path | None = None) -> LazyVolume:
    """Open a stack of pages, in one file or one for each."""
    stack, name = locate_tiff(files[0]), str(folder or files[0])
    if folder is None:
        require_volume(name, stack.shape, stack.kind)
        if stack.begin is not None:
            array: Any = MappedArray(str(files[0]), stack.begin, stack.shape, (2, 1, 0), stack.kind.str)
        else:
            array = TiffArray((str(files[0]),), stack.shape, stack.kind.newbyteorder("=").str)
    else:
        stored = (len(files), *stack.shape[-2:])
        require_volume(name, stored, stack.kind)
        array = TiffArray(tuple(map(str, files)), stored, stack.kind.newbyteorder("=").str)
    return LazyVolume(array=array, spacing=stack.spacing, name=name)
