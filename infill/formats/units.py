"""Which unit the numbers of a mesh or of points are in: what the format says, or a guess by the size of the part."""

from __future__ import annotations

UNITS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}  # mm
# Formats that say their unit, and come out in mm: mm per unit of a file that is written as is usual. They are not
# questioned.
STATED = {".3mf": 1.0, ".glb": 1000.0}
# What is printed is 2 mm to 2 m long. So a part in metres reads as less than 2, and one in µm as more than 2000.
SMALLEST, LARGEST = 2.0, 2000.0
IN_INCHES = 0.5  # from 13 to 51 mm: likelier than half a metre to two metres


def guess_unit(largest: float) -> str:
    """Return the unit that a part whose largest side is `largest` was probably made in.

    >>> guess_unit(60.0), guess_unit(0.047)
    ('mm', 'm')
    """
    if largest > LARGEST:
        return "µm"
    if largest >= SMALLEST:
        return "mm"
    return "m" if largest <= IN_INCHES else "in"
