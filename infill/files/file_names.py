"""File names made of any text, so that every file system takes them."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

FORBIDDEN = re.compile(r'[<>:"/\\|?*]')  # on Windows, which forbids most
INVISIBLE = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")  # control, format and unassigned characters
RESERVED = re.compile(r"(?:con|prn|aux|nul|conin\$|conout\$|(?:com|lpt)[0-9¹²³])(?:\..*)?", re.IGNORECASE)
MOST_BYTES = 120  # of a name in UTF-8: a file may have 255 with what stands around it


def safe_names(names: Sequence[str], others: Sequence[str]) -> list[str]:
    """Return a file name for each name, all different even where case or the form of letters does not count.

    Parameters
    ----------
    names : sequence of str
        Any text.
    others : sequence of str
        What to call each if nothing of its name is left.

    >>> safe_names(["L1/L2: body?", "", "aux", "Rib", "rib", ".."], ["label_1", "label_2"] * 3)
    ['L1_L2_ body_', 'label_2', '_aux', 'Rib', 'rib_2', 'label_2_2']
    """
    taken: set[str] = set()
    found = []
    for name, other in zip(names, others, strict=True):
        safe = _safe(name) or other
        again = 2
        unique = safe
        while _key(unique) in taken:
            unique = f"{safe}_{again}"
            again += 1
        taken.add(_key(unique))
        found.append(unique)
    return found


def _safe(name: str) -> str:
    """Return a name without what a file system forbids; empty if nothing is left."""
    seen = "".join(each for each in unicodedata.normalize("NFC", name) if unicodedata.category(each) not in INVISIBLE)
    seen = " ".join(seen.split())
    safe = FORBIDDEN.sub("_", seen).lstrip(". -").rstrip(". ")
    safe = safe.encode()[:MOST_BYTES].decode("utf-8", "ignore").rstrip(". ")
    if not safe.strip("_"):
        return ""
    return f"_{safe}" if RESERVED.fullmatch(safe) else safe


def _key(name: str) -> str:
    """Return what two names have in common that some file system takes for one."""
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", name).casefold())
