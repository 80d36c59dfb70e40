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
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.checked_volume import checked_volume
from infill.imaging.frames import choose_frame
from infill.machine import require_memory
from infill.volume import AXES, Volume

HEADER = struct.Struct(">7ih15f")  # version, cells in x, y and z, frames, type, freedom, flag of the place, place
HEADER_BYTES = 284
VERSION = 1  # in the low byte; newer files keep the intent of the image in the others
TYPES = {0: ">u1", 1: ">i4", 3: ">f4", 4: ">i2", 10: ">u2"}
# Default without a place in the header: cells of 1 mm, the axes towards left, inferior and anterior.
DEFAULT_PLACE = (1.0, 1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)
TO_LPS = np.array([-1.0, -1.0, 1.0])


@dataclass(frozen=True, kw_only=True)
class _MghHeader:
    """The first bytes: cells along each axis, frames, type of a cell, size, axes (columns) and centre, RAS."""

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
    """Read the volume of a file, [x, y, z] in LPS, or one of its frames, counted from 0."""
    packed = path.suffix.lower() != ".mgh"
    with wrap_reader_errors(path), _open(path, packed=packed) as file:
        header = _parse_header(path, file.read(HEADER_BYTES))
        what = f"has 4 axes, {' x '.join(map(str, (*header.shape, header.frames)))} cells"
        frame_index = choose_frame(path, frame, header.frames, what=what)
        if not packed and path.stat().st_size < HEADER_BYTES + header.frames * header.frame_bytes:
            _raise_cut_off(path, path.stat().st_size, HEADER_BYTES + header.frames * header.frame_bytes)
        require_memory(2 * header.frame_bytes, None, SMALLER_VOLUME_ADVICE)
        file.seek(HEADER_BYTES + frame_index * header.frame_bytes)
        content = _read(file, header.frame_bytes)
        while packed and file.read(2**24):  # to the end, where the checksum is
            pass
    if len(content) < header.frame_bytes:
        _raise_cut_off(path, len(content), header.frame_bytes)
    values = np.frombuffer(content, dtype=header.kind).reshape(header.shape, order="F")
    direction = TO_LPS[:, None] * header.axes
    # The centre is that of cell n / 2, which lies half a cell beyond the middle where n is even.
    corner_centre = TO_LPS * header.centre - direction @ (header.spacing * np.array(header.shape) / 2)
    corner = corner_centre - direction @ header.spacing / 2
    return checked_volume(
        path,
        values,
        spacing=tuple(header.spacing.tolist()),
        origin=tuple(corner.tolist()),
        direction=direction,
        space="LPS",
    )


def _open(path: Path, *, packed: bool) -> IO[bytes]:
    """Open a file, decompressing it if it is packed."""
    return cast(IO[bytes], gzip.open(path)) if packed else path.open("rb")


def _parse_header(path: Path, head: bytes) -> _MghHeader:
    """Parse and check the header."""
    if len(head) < HEADER_BYTES:
        raise FormatError(f"{path} is cut off within its header of {HEADER_BYTES} bytes; copy or save it again")
    version, nx, ny, nz, frames, kind, _, placed, *place = HEADER.unpack_from(head)
    if version & 255 != VERSION or min(nx, ny, nz, frames) < 1:
        raise FormatError(f"{path} has no header of FreeSurfer; check that it is an {path.suffix} file")
    if kind not in TYPES:
        raise FormatError(f"{path} holds cells of type {kind}, which are not numbers; save it as integers or floats")
    if not placed:
        warn(
            "%s does not say the size and the place of its cells; 1 mm is taken, towards left, inferior and anterior, "
            "unless --spacing gives it",
            path,
        )
    numbers = np.array(place if placed else DEFAULT_PLACE, dtype=np.float64)
    return _MghHeader(
        shape=(nx, ny, nz),
        frames=frames,
        kind=np.dtype(TYPES[kind]),
        spacing=numbers[:AXES],
        axes=numbers[AXES:-AXES].reshape(AXES, AXES).T,
        centre=numbers[-AXES:],
    )


def _read(file: IO[bytes], count: int) -> bytes:
    """Read up to `count` bytes; allocate memory only for those that the file holds."""
    content = bytearray()
    while len(content) < count and (chunk := file.read(min(2**24, count - len(content)))):
        content += chunk
    return bytes(content)


def _raise_cut_off(path: Path, available: int, needed: int) -> None:
    """Raise FormatError for a file that ends too early."""
    raise FormatError(f"{path} is cut off: it holds {available} bytes of {needed}; copy or save it again")
