"""What the headers of medical images have in common: axes of space and others, the type of a cell, and an affine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import checked_volume
from infill.imaging.assumed import warn
from infill.imaging.frames import chosen
from infill.imaging.units import millimetres
from infill.volume import AXES, Volume

MOST_AXES = 16
SIZES = "the size of its cells along"
TO_LPS = {"RAS": (-1.0, -1.0, 1.0), "LAS": (1.0, -1.0, 1.0), "LPS": (1.0, 1.0, 1.0)}
# Cells from one to the end of another, counted in the file.
ReadCells = Callable[[int, int], NDArray[Any]]


@dataclass(frozen=True, kw_only=True)
class ImageHeader:
    """What the header of an image says.

    Parameters
    ----------
    path : Path
    sizes : tuple of int
        Cells along every axis, the fastest first.
    spatial : (3,) tuple of int
        Which of the axes are those of space, in the order of the columns of the affine; the others are frames.
    affine : (3, 4) float64, mm
        Where the centre of cell (i, j, k) lies: affine @ (i, j, k, 1).
    space : str
        See `infill.Volume`.
    what : str
        What the frames are, for messages, such as "holds 2 numbers per cell".
    """

    path: Path
    sizes: tuple[int, ...]
    spatial: tuple[int, ...]
    affine: NDArray[np.float64]
    space: str
    what: str = ""

    @property
    def cells(self) -> int:
        """Return how many numbers the file holds."""
        return math.prod(self.sizes)

    @property
    def frame_axes(self) -> tuple[int, ...]:
        """Return the axes that are not of space."""
        return tuple(axis for axis in range(len(self.sizes)) if axis not in self.spatial)

    @property
    def frames(self) -> int:
        """Return how many volumes the file holds."""
        return math.prod(self.sizes[axis] for axis in self.frame_axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the cells along each axis of a volume."""
        return tuple(self.sizes[axis] for axis in self.spatial)


def read_frame(header: ImageHeader, frame: int | None, read: ReadCells) -> Volume:
    """Read one volume of an image, counted from 0, or the only one.

    Raises
    ------
    FormatError
        If there are several and none was asked for, or the volume is unusable.
    ParameterError
        If there is no such frame.
    """
    what = header.what or f"has {len(header.sizes)} axes, {times(header.sizes)}"
    at = chosen(header.path, frame, header.frames, what=what)
    cells = math.prod(header.shape)
    if sorted(header.spatial) == list(range(AXES)):  # frames lie one after the other
        values = read(at * cells, (at + 1) * cells).reshape(header.sizes[:AXES], order="F")
        return place_volume(header, values.transpose(header.spatial))
    return place_volume(header, _split(header, read(0, header.cells))[..., at])


def read_frames(header: ImageHeader, read: ReadCells) -> tuple[Volume, ...]:
    """Read all volumes of an image, which may be empty."""
    values = _split(header, read(0, header.cells))
    return tuple(place_volume(header, values[..., at], varied=False) for at in range(header.frames))


def _split(header: ImageHeader, cells: NDArray[Any]) -> NDArray[Any]:
    """Return the cells as [x, y, z, frame]."""
    values = cells.reshape(header.sizes, order="F").transpose(header.spatial + header.frame_axes)
    return values.reshape((*header.shape, header.frames), order="F")


def place_volume(header: ImageHeader, values: NDArray[Any], *, varied: bool = True) -> Volume:
    """Return values [x, y, z] as a volume that lies where the affine says; it must be neither sheared nor flat."""
    columns, first = header.affine[:, :AXES], header.affine[:, AXES]
    spacing = np.linalg.norm(columns, axis=0)
    if not (np.isfinite(header.affine).all() and (spacing > 0).all() and np.isfinite(spacing).all()):
        raise FormatError(
            f"{header.path} has no usable place in space: its matrix is {_rows(header.affine)}; save it again"
        )
    direction = columns / spacing
    corner = first - columns.sum(axis=1) / 2
    place = {"spacing": tuple(spacing.tolist()), "origin": tuple(corner.tolist()), "direction": direction}
    return checked_volume(header.path, values, varied=varied, space=header.space, **place)


def require_sizes(path: Path, sizes: tuple[int, ...]) -> None:
    """Raise FormatError for an image that is no volume, or whose axes have no cells."""
    if not sizes or len(sizes) > MOST_AXES or min(sizes) < 1:
        raise FormatError(f"{path} has {len(sizes)} axes, {times(sizes[:MOST_AXES])}; save a volume with cells")
    if len(sizes) < AXES:
        raise FormatError(f"{path} is a single slice, {times(sizes)}; give the folder of all slices, or a volume")


def times(sizes: tuple[int, ...]) -> str:
    """Return cells along each axis in words."""
    return " x ".join(str(cells) for cells in sizes) + " cells"


def scale_of(path: Path, word: str, what: str = "its sizes") -> float:
    """Return the mm of a unit that a file states; for a word that is none, warn, and take mm."""
    return scales_of(path, [word], what, [""])[0]


def scales_of(path: Path, words: Sequence[str], what: str, axes: Sequence[str]) -> list[float]:
    """Return the mm of the unit of each of several axes, 1 where none is stated; warn once of a word that is none.

    Parameters
    ----------
    path : Path
    words : sequence of str
        Blank where none is stated.
    what : str
        What is in that unit, such as "the size of its cells along".
    axes : sequence of str
        The name of each axis.
    """
    scales = [millimetres(word) if word.strip() else 1.0 for word in words]
    for strange in dict.fromkeys(word for word, scale in zip(words, scales, strict=True) if scale is None):
        *first, last = (axis for axis, word in zip(axes, words, strict=True) if word == strange)
        named = f"{', '.join(first)} and {last}" if first else last
        warn(
            "%s gives %s in %r, no known unit of length; they are taken as mm, unless --spacing gives them",
            path,
            f"{what} {named}".rstrip(),
            strange[:40],
        )
    return [1.0 if scale is None else scale for scale in scales]


def _rows(matrix: NDArray[np.float64]) -> str:
    return "; ".join(" ".join(f"{number:.4g}" for number in row) for row in matrix)
