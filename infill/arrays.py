"""Names for types of arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Flags = NDArray[np.bool_]
Floats = NDArray[np.float64]
Field = NDArray[np.float32]
Integers = NDArray[np.int64]
AnyIntegers = NDArray[np.integer]  # whatever their size
Places = NDArray[np.intp]  # indices into other arrays
