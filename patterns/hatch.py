"""Cross hatch: upright walls along y and along x in turn, with saddles between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.unit_cells import Surfaces

if TYPE_CHECKING:
    from collections.abc import Callable

    from patterns.unit_cells import Floats


def cross_hatch(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return a mean of cos x and cos y whose weight goes from one to the other and back in a period of z.

    Where one of them has all the weight, walls are upright, half a cell apart: to 5 %, this holds at half of all
    heights. Where both weights are equal, a section of the walls consists of squares that touch at their corners.

    >>> import numpy as np
    >>> bool(abs(cross_hatch(np.array(np.pi / 2), np.array(1.3), np.array(0.0))) < 1e-12)
    True
    """
    import numpy as np

    change = np.sin(math.pi / 2 * np.cos(z))
    value: Floats = (1 + change) / 2 * np.cos(x) + (1 - change) / 2 * np.cos(y)
    return value


@dataclass(frozen=True, kw_only=True)
class CrossHatch(Surfaces):
    """Walls alternately along y and along x, half a cell apart."""

    paths: ClassVar[bool] = True

    name: str = "cross-hatch"
    summary: str = "upright walls, alternately along y and along x; both sides hang together"
    value: Callable[[Floats, Floats, Floats], Floats] = cross_hatch
