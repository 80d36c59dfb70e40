"""Common parts of the headers of medical images: axes of space and frames, the type of a cell, and an affine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.imaging.assumed import warn
from infill.imaging.checked_volume import checked_volume
from infill.imaging.frames import choose_frame
from infill.imaging.units import millimetres
from infill.plain_numbers import plain_argument
from infill.volume import AXES, Volume

MOST_AXES = 16
CELL_SIZE_PHRASE = "the size of its cells along"
TO_LPS = {"RAS": (-1.0, -1.0, 1.0), "LAS": (1.0, -1.0, 1.0), "LPS": (1.0, 1.0, 1.0)}
# Reads the cells from one index to before another, in the order of the file.
CellReader = Callable[[int, int], NDArray[Any]]


@dataclass(frozen=True, kw_only=True)
class ImageHeader:
    """The header of an image.

    Parameters
    ----------
    path : Path
    sizes : tuple of int
        Cells along every axis, the fastest first.
    spatial : (3,) tuple of int
        Axes of space, in the order of the columns of the affine; the others are frames.
    affine : (3, 4) float64, mm
        Maps cell indices to cell centres: affine @ (i, j, k, 1).
    space : str
        See `infill.Volume`.
    what : str
        Description of the frames, for messages, such as "holds 2 numbers per cell".
    """

    path: Path
    sizes: tuple[int, ...]
    spatial: tuple[int, ...]
    affine: NDArray[np.float64]
    space: str
    what: str = ""

    @property
    def cells(self) -> int:
        """Number of cells in the file."""
        return math.prod(self.sizes)

    @property
    def frame_axes(self) -> tuple[int, ...]:
        """Axes that are not of space."""
        return tuple(axis for axis in range(len(self.sizes)) if axis not in self.spatial)

    @property
    def frames(self) -> int:
        """Number of volumes in the file."""
        return math.prod(self.sizes[axis] for axis in self.frame_axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along each axis of a volume."""
        return tuple(self.sizes[axis] for axis in self.spatial)


def read_frame(header: ImageHeader, frame: int | None, read: CellReader) -> Volume:
    """Read one volume of an image, counted from 0, or the only one.

    Raises
    ------
    FormatError
        If there are several and none is requested, or the volume is unusable.
    ParameterError
        If the requested frame does not exist.
    """
    what = header.what or f"has {len(header.sizes)} axes, {describe_sizes(header.sizes)}"
    frame_index = choose_frame(header.path, frame, header.frames, what=what)
    cells = math.prod(header.shape)
    if sorted(header.spatial) == list(range(AXES)):  # frames lie one after the other
        values = read(frame_index * cells, (frame_index + 1) * cells).reshape(header.sizes[:AXES], order="F")
        return place_volume(header, values.transpose(header.spatial))
    return place_volume(header, _cells_by_frame(header, read(0, header.cells))[..., frame_index])


@dataclass(frozen=True, kw_only=True)
class StoredCells:
    """Where an image that is not compressed has its cells in a file, so that a part of them can be read.

    Parameters
    ----------
    header : ImageHeader
        Its axes of space come first.
    path : Path
        The file.
    begin : int
        Position of the first cell, bytes.
    kind : dtype
    """

    header: ImageHeader
    path: Path
    begin: int
    kind: np.dtype[Any]


def read_frames(header: ImageHeader, read: CellReader) -> tuple[Volume, ...]:
    """Read all volumes of an image; they may be empty."""
    values = _cells_by_frame(header, read(0, header.cells))
    return tuple(place_volume(header, values[..., frame_index], varied=False) for frame_index in range(header.frames))


def _cells_by_frame(header: ImageHeader, cells: NDArray[Any]) -> NDArray[Any]:
    """Reorder the cells to [x, y, z, frame]."""
    values = cells.reshape(header.sizes, order="F").transpose(header.spatial + header.frame_axes)
    return values.reshape((*header.shape, header.frames), order="F")


def place_volume(header: ImageHeader, values: NDArray[Any], *, varied: bool = True) -> Volume:
    """Place values [x, y, z] by the affine, which must be neither sheared nor flat; return the volume."""
    return checked_volume(header.path, values, varied=varied, **placement(header))


def placement(header: ImageHeader) -> dict[str, Any]:
    """Return spacing, origin, direction and space of a volume by the affine, which must not be flat."""
    columns, centre = header.affine[:, :AXES], header.affine[:, AXES]
    spacing = np.linalg.norm(columns, axis=0)
    if not (np.isfinite(header.affine).all() and (spacing > 0).all() and np.isfinite(spacing).all()):
        raise FormatError(
            f"{header.path} has no usable place in space: its matrix is {_format_matrix(header.affine)}; save it again"
        )
    corner = centre - columns.sum(axis=1) / 2
    return {
        "spacing": tuple(spacing.tolist()),
        "origin": tuple(corner.tolist()),
        "direction": columns / spacing,
        "space": header.space,
    }


def require_sizes(path: Path, sizes: tuple[int, ...]) -> None:
    """Raise FormatError unless an image has at least three axes, all with cells."""
    if not sizes or len(sizes) > MOST_AXES or min(sizes) < 1:
        raise FormatError(
            f"{path} has {len(sizes)} axes, {describe_sizes(sizes[:MOST_AXES])}; save a volume with cells"
        )
    if len(sizes) < AXES:
        raise FormatError(
            f"{path} is a single slice, {describe_sizes(sizes)}; give the folder of all slices, or a volume"
        )


def describe_sizes(sizes: tuple[int, ...]) -> str:
    """Describe the numbers of cells along the axes in words."""
    return " x ".join(str(cells) for cells in sizes) + " cells"


def scale_of(path: Path, word: str, what: str = "its sizes") -> float:
    """Return the mm of a stated unit; for an unknown word, warn and assume mm."""
    return scales_of(path, [word], what, [""])[0]


def scales_of(path: Path, words: Sequence[str], what: str, axes: Sequence[str]) -> list[float]:
    """Return the mm of the unit of each axis, 1 where none is stated; warn once about each unknown word.

    Parameters
    ----------
    path : Path
    words : sequence of str
        Blank where none is stated.
    what : str
        Quantity in that unit, such as "the size of its cells along".
    axes : sequence of str
        The name of each axis.
    """
    scales = [millimetres(word) if word.strip() else 1.0 for word in words]
    for unknown_word in dict.fromkeys(word for word, scale in zip(words, scales, strict=True) if scale is None):
        *leading, final = (axis for axis, word in zip(axes, words, strict=True) if word == unknown_word)
        axis_list = f"{', '.join(leading)} and {final}" if leading else final
        warn(
            "%s gives %s in %r, no known unit of length; they are taken as mm, unless --spacing gives them",
            path,
            f"{what} {axis_list}".rstrip(),
            unknown_word[:40],
        )
    return [1.0 if scale is None else scale for scale in scales]


def _format_matrix(matrix: NDArray[np.float64]) -> str:
    """Format a matrix as text."""
    return "; ".join(" ".join(plain_argument(number, 4) for number in row) for row in matrix)
