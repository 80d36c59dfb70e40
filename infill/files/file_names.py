"""File names made from any text that every file system accepts, also in the place of ``{label}`` or ``{number}``."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from pathlib import Path

FORBIDDEN = re.compile(r'[<>:"/\\|?*]')  # on Windows, which forbids most
INVISIBLE = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")  # control, format and unassigned characters
RESERVED = re.compile(r"(?:con|prn|aux|nul|conin\$|conout\$|(?:com|lpt)[0-9¹²³])(?:\..*)?", re.IGNORECASE)
NAME, NUMBER = "{label}", "{number}"  # placeholders
MOST_BYTES = 120  # of a name in UTF-8: a file may have 255 with what stands around it


def safe_names(names: Sequence[str], others: Sequence[str]) -> list[str]:
    """Return a file name for each name, or for its fallback; all differ, even where case or Unicode form is ignored.

    Parameters
    ----------
    names : sequence of str
        Any text.
    others : sequence of str
        Fallback for each name, used if nothing of it remains.

    >>> safe_names(["L1/L2: body?", "", "aux", "Rib", "rib", ".."], ["label_1", "label_2"] * 3)
    ['L1_L2_ body_', 'label_2', '_aux', 'Rib', 'rib_2', 'label_2_2']
    """
    taken: set[str] = set()
    file_names = []
    for name, fallback in zip(names, others, strict=True):
        safe = _allowed_name(name) or fallback
        suffix = 2
        unique = safe
        while _comparison_key(unique) in taken:
            unique = f"{safe}_{suffix}"
            suffix += 1
        taken.add(_comparison_key(unique))
        file_names.append(unique)
    return file_names


def _allowed_name(name: str) -> str:
    """Return a name that every file system allows, shortened where necessary; empty if nothing remains."""
    visible = "".join(
        character
        for character in unicodedata.normalize("NFC", name)
        if unicodedata.category(character) not in INVISIBLE
    )
    visible = " ".join(visible.split())
    safe = FORBIDDEN.sub("_", visible).lstrip(". -").rstrip(". ")
    safe = safe.encode()[:MOST_BYTES].decode("utf-8", "ignore").rstrip(". ")
    if not safe.strip("_"):
        return ""
    return f"_{safe}" if RESERVED.fullmatch(safe) else safe


def _comparison_key(name: str) -> str:
    """Return a key that is equal for two names that some file system confuses."""
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", name).casefold())


def is_template(path: Path) -> bool:
    """Tell whether a path has a placeholder for a label.

    >>> is_template(Path("bones/{label}.stl")), is_template(Path("bones.stl"))
    (True, False)
    """
    return NAME in str(path) or NUMBER in str(path)


def fill_template(path: Path, names: Sequence[str], numbers: Sequence[int]) -> list[Path]:
    """Return the path of each label, with its name, made safe for every file system, and its number.

    >>> [path.name for path in fill_template(Path("{number}_{label}.stl"), ["L1/L2"], [4])]
    ['4_L1_L2.stl']
    """
    safe = safe_names(names, [f"label_{number}" for number in numbers])
    return [
        Path(str(path).replace(NUMBER, str(number)).replace(NAME, name))
        for name, number in zip(safe, numbers, strict=True)
    ]
