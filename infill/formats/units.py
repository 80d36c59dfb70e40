"""The unit of the coordinates of a mesh or of points: stated by the format, or guessed from the size of the part."""

from __future__ import annotations

UNITS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}  # mm
# Formats that state their unit and come out in mm: mm per unit of a file written in the usual way. They are not
# questioned.
STATED = {".3mf": 1.0, ".glb": 1000.0, ".gltf": 1000.0}
# Printed parts are 2 mm to 2 m long. A part in metres therefore reads as less than 2, and one in µm as more than 2000.
SMALLEST, LARGEST = 2.0, 2000.0
IN_INCHES = 0.5  # that is 13 to 51 mm: likelier than half a metre to two metres


def guess_unit(largest: float) -> str:
    """Return the unit in which a part whose largest side is `largest` was probably made.

    >>> guess_unit(60.0), guess_unit(0.047)
    ('mm', 'm')
    """
    if largest > LARGEST:
        return "µm"
    if largest >= SMALLEST:
        return "mm"
    return "m" if largest <= IN_INCHES else "in"
