"""Numbers as rows of text, some at a time."""

from __future__ import annotations

from typing import IO

import numpy as np
from numpy.typing import NDArray

AT_ONCE = 100_000  # triangles or vertices formatted at a time: a few tens of MB of text


def write_rows(file: IO[bytes], row: str, values: NDArray[np.generic], add: int = 0) -> None:
    """Write one formatted row of text per row of `values`."""
    for low in range(0, len(values), AT_ONCE):
        some = values[low : low + AT_ONCE] + add if add else values[low : low + AT_ONCE]
        file.write((row * len(some) % tuple(some.ravel().tolist())).encode())
