"""Numbers with units, as people write them."""

from __future__ import annotations

import re

LENGTHS = {"mm": 1.0, "um": 1e-3, "µm": 1e-3, "cm": 10.0, "m": 1000.0, "in": 25.4, "inch": 25.4, '"': 25.4}
# By the unit of a quantity: how many of it each unit that may be typed is.
UNITS = {
    "mm": LENGTHS,
    "deg": {"deg": 1.0, "°": 1.0},
    "mm3": {"mm3": 1.0, "mm³": 1.0},
    "mm/s": {"mm/s": 1.0, "mm/min": 1 / 60},
    "mm/s2": {"mm/s2": 1.0, "mm/s²": 1.0},
}
NUMBER = r"[+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:e[+-]?\d+)?|nan|[+-]?inf(?:inity)?"
AMBIGUOUS = r"[+-]?\d{1,3},\d{3}"  # 1,500 is 1.5 to one reader and 1500 to another


def parse_quantity(text: str, unit: str = "") -> float | None:
    """Parse a number with a point or a comma, and a unit or none; return it in `unit`, or None if it is not one.

    >>> [parse_quantity(text, "mm") for text in ("0.5", "0,5", "5mm", "2 cm", "1in", "5 deg", "1,500", "x")]
    [0.5, 0.5, 5.0, 20.0, 25.4, None, None, None]
    """
    match = re.fullmatch(rf"\s*({NUMBER})\s*([^\s\d.,+-]\S*)?\s*", text, flags=re.IGNORECASE)
    if not match or re.fullmatch(AMBIGUOUS, match[1]):
        return None
    number, typed_unit = float(match[1].replace(",", ".")), match[2]
    factor = 1.0 if typed_unit is None else UNITS.get(unit, {}).get(typed_unit.lower())
    return None if factor is None else number * factor


def number_advice(text: str, unit: str = "") -> str:
    """Say which numbers can be typed in place of a text.

    >>> number_advice("five", "mm"), number_advice("1,500")
    ('give a number such as 0.5, 0,5 or 0.5mm', 'write 1.500 or 1500')
    """
    if match := re.match(AMBIGUOUS, text.strip()):
        return f"write {match[0].replace(',', '.')} or {match[0].replace(',', '')}"
    return f"give a number such as 0.5{f', 0,5 or 0.5{unit}' if unit else ' or 0,5'}"
