"""FreeSurfer's volumes: .mgh, and .mgz, the same in gzip.

A header of 284 bytes, high byte first, then the cells, x fastest, frame after frame. The header gives the directions of
the axes and the centre of the volume in RAS (right, anterior, superior); here they become LPS, as in all medical
images. Source: "MGH/MGZ volume format" of the FreeSurfer wiki.
"""

from __future__ import annotations

import gzip
import math
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import IO, cast

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER, checked_volume, told_broken
from infill.imaging.assumed import warn
from infill.imaging.frames import chosen
from infill.machine import require_memory
from infill.volume import AXES, Volume

HEADER = struct.Struct(">7ih15f")  # version, cells in x, y and z, frames, type, freedom, whether placed, place
HEADER_BYTES = 284
VERSION = 1  # in the low byte; newer files keep what the image is for in the others
TYPES = {0: ">u1", 1: ">i4", 3: ">f4", 4: ">i2", 10: ">u2"}
# Where the header does not say: cells of 1 mm, the axes towards left, inferior and anterior.
UNPLACED = (1.0, 1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)
TO_LPS = np.array([-1.0, -1.0, 1.0])


@dataclass(frozen=True, kw_only=True)
class _Header:
    """What the first bytes say: cells along each axis, frames, type of a cell, size, axes (columns) and centre, RAS."""

    shape: tuple[int, int, int]
    frames: int
    kind: np.dtype[np.generic]
    spacing: NDArray[np.float64]
    axes: NDArray[np.float64]
    centre: NDArray[np.float64]

    @property
    def frame_bytes(self) -> int:
        """Bytes of one frame."""
        return math.prod(self.shape) * self.kind.itemsize


def read_mgh(path: Path, frame: int | None = None) -> Volume:
    """Return the volume of a file, [x, y, z] in LPS, or one of its frames, counted from 0."""
    packed = path.suffix.lower() != ".mgh"
    with told_broken(path), _opened(path, packed=packed) as file:
        header = _header(path, file.read(HEADER_BYTES))
        what = f"has 4 axes, {' x '.join(map(str, (*header.shape, header.frames)))} cells"
        at = chosen(path, frame, header.frames, what=what)
        if not packed and path.stat().st_size < HEADER_BYTES + header.frames * header.frame_bytes:
            _cut_off(path, path.stat().st_size, HEADER_BYTES + header.frames * header.frame_bytes)
        require_memory(2 * header.frame_bytes, None, SMALLER)
        file.seek(HEADER_BYTES + at * header.frame_bytes)
        held = _read(file, header.frame_bytes)
        while packed and file.read(2**24):  # to the end, where the checksum is
            pass
    if len(held) < header.frame_bytes:
        _cut_off(path, len(held), header.frame_bytes)
    values = np.frombuffer(held, dtype=header.kind).reshape(header.shape, order="F")
    direction = TO_LPS[:, None] * header.axes
    # The centre is that of cell n / 2, which lies half a cell beyond the middle where n is even.
    first = TO_LPS * header.centre - direction @ (header.spacing * np.array(header.shape) / 2)
    corner = first - direction @ header.spacing / 2
    return checked_volume(
        path,
        values,
        spacing=tuple(header.spacing.tolist()),
        origin=tuple(corner.tolist()),
        direction=direction,
        space="LPS",
    )


def _opened(path: Path, *, packed: bool) -> IO[bytes]:
    return cast(IO[bytes], gzip.open(path)) if packed else path.open("rb")


def _header(path: Path, head: bytes) -> _Header:
    if len(head) < HEADER_BYTES:
        raise FormatError(f"{path} is cut off within its header of {HEADER_BYTES} bytes; copy or save it again")
    version, nx, ny, nz, frames, kind, _, placed, *place = HEADER.unpack_from(head)
    if version & 255 != VERSION or min(nx, ny, nz, frames) < 1:
        raise FormatError(f"{path} has no header of FreeSurfer; check that it is an {path.suffix} file")
    if kind not in TYPES:
        raise FormatError(f"{path} holds cells of type {kind}, which are no numbers; save it as integers or floats")
    if not placed:
        warn(
            "%s does not say the size and the place of its cells; 1 mm is taken, towards left, inferior and anterior, "
            "unless --spacing gives it",
            path,
        )
    numbers = np.array(place if placed else UNPLACED, dtype=np.float64)
    return _Header(
        shape=(nx, ny, nz),
        frames=frames,
        kind=np.dtype(TYPES[kind]),
        spacing=numbers[:AXES],
        axes=numbers[AXES:-AXES].reshape(AXES, AXES).T,
        centre=numbers[-AXES:],
    )


def _read(file: IO[bytes], count: int) -> bytes:
    """Return up to so many bytes; room is taken only for those there are."""
    held = bytearray()
    while len(held) < count and (some := file.read(min(2**24, count - len(held)))):
        held += some
    return bytes(held)


def _cut_off(path: Path, held: int, needed: int) -> None:
    raise FormatError(f"{path} is cut off: it holds {held} bytes of {needed}; copy or save it again")
