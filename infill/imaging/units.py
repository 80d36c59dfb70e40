"""Units of length: their names in files, and a guess for coordinates without a unit."""

from __future__ import annotations

import re
import unicodedata

UNITS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}  # mm
# Formats that state their unit and are converted to mm: mm per unit of a usual file. Their unit is never guessed.
STATED_UNITS = {".3mf": 1.0, ".glb": 1000.0, ".gltf": 1000.0}
# Printed parts are 2 mm to 2 m long. A part in metres therefore reads as less than 2, and one in µm as more than 2000.
SMALLEST, LARGEST = 2.0, 2000.0
LARGEST_IN_METRES = 0.5  # 13 to 51 mm, which is likelier than half a metre to two metres

INCH = 25.4
SYMBOLS = {
    "fm": 1e-12,
    "pm": 1e-9,
    "å": 1e-7,
    "nm": 1e-6,
    "μ": 1e-3,
    "μm": 1e-3,
    "um": 1e-3,
    "mm": 1.0,
    "cm": 10.0,
    "dm": 100.0,
    "m": 1e3,
    "dam": 1e4,
    "hm": 1e5,
    "km": 1e6,
    "thou": INCH / 1000,
    "mil": INCH / 1000,
    "mils": INCH / 1000,
    "li": INCH / 12,
    "pt": INCH / 72,
    "in": INCH,
    '"': INCH,
    "''": INCH,
    "″": INCH,
    "”": INCH,
    "ft": 12 * INCH,
    "'": 12 * INCH,
    "′": 12 * INCH,
    "yd": 36 * INCH,
}
WORDS = {
    "angstrom": 1e-7,
    "ångström": 1e-7,
    "ångstrom": 1e-7,
    "micron": 1e-3,
    "inch": INCH,
    "inche": INCH,  # of inches
    "foot": 12 * INCH,
    "feet": 12 * INCH,
    "yard": 36 * INCH,
}
PREFIXES = {
    "femto": 1e-12,
    "pico": 1e-9,
    "nano": 1e-6,
    "micro": 1e-3,
    "milli": 1.0,
    "centi": 10.0,
    "deci": 100.0,
    "": 1e3,
    "deca": 1e4,
    "hecto": 1e5,
    "kilo": 1e6,
}
METRE = re.compile(r"(femto|pico|nano|micro|milli|centi|deci|deca|hecto|kilo|)[- ]?(?:met(?:er|re))s?")
# Prefixes that differ from others only by case: Mm is a million metres and mm a thousandth.
LARGE_PREFIXES = {"Mm", "Pm", "Ym", "Zm", "Em", "Tm", "Gm"}
ESCAPED = re.compile(r"\\u([0-9a-fA-F]{4})")  # as ImageJ writes what is not ASCII


def millimetres(word: str) -> float | None:
    """Return the mm of a unit of length, or None for an unknown word.

    >>> millimetres("µm"), millimetres("Micrometers"), millimetres("inch"), millimetres("pixel")
    (0.001, 0.001, 25.4, None)
    """
    word_alone = ESCAPED.sub(lambda match: chr(int(match[1], 16)), word).strip().strip("\0").strip()
    if word_alone in LARGE_PREFIXES:
        return None
    # Two characters stand for micro, two for ångström; NFKC makes one of each. A prime must not become letters.
    text = unicodedata.normalize("NFKC", word_alone).lower() if word_alone not in SYMBOLS else word_alone
    text = text if text in SYMBOLS else text.rstrip(".")
    if text in SYMBOLS:
        return SYMBOLS[text]
    if metre := METRE.fullmatch(text.replace("μ", "micro")):
        return PREFIXES[metre[1]]
    return WORDS.get(text, WORDS.get(text.removesuffix("s")))


def guess_unit(largest: float) -> str:
    """Guess the unit of a part from the length of its longest side.

    >>> guess_unit(60.0), guess_unit(0.047)
    ('mm', 'm')
    """
    if largest > LARGEST:
        return "µm"
    if largest >= SMALLEST:
        return "mm"
    return "m" if largest <= LARGEST_IN_METRES else "in"
