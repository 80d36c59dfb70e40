"""Rows of numbers as text, written in pieces."""

from __future__ import annotations

from typing import IO

import numpy as np
from numpy.typing import NDArray

AT_ONCE = 100_000  # triangles or vertices formatted at a time: a few tens of MB of text


def write_rows(file: IO[bytes], row: str, values: NDArray[np.generic], add: int = 0) -> None:
    """Write one formatted line of text per row of `values`."""
    for low in range(0, len(values), AT_ONCE):
        piece = values[low : low + AT_ONCE] + add if add else values[low : low + AT_ONCE]
        file.write((row * len(piece) % tuple(piece.ravel().tolist())).encode())
