"""Names of uploaded files: safe in the folder of a page, and in commands that are shown to people."""

from __future__ import annotations

import re
from collections.abc import Collection

from infill.files.file_names import safe_names

DOUBLE = (".nii.gz", ".gcode.3mf", ".seg.nrrd", ".gcode.gz")
NOT_PLAIN = re.compile(r"[^\w.+ ()=,@~-]|[\x00-\x1f]")


def split_suffix(name: str) -> tuple[str, str]:
    """Split a file name into its stem and its suffix.

    >>> split_suffix("brain.nii.gz"), split_suffix("part.v2.stl"), split_suffix("part")
    (('brain', '.nii.gz'), ('part.v2', '.stl'), ('part', ''))
    """
    lower = name.lower()
    ending = next((suffix for suffix in DOUBLE if lower.endswith(suffix)), None)
    length = len(ending) if ending else len(name) - name.rfind(".") if name.rfind(".") > 0 else 0
    return (name[:-length], name[-length:]) if length else (name, "")


def choose_name(requested: str, taken: Collection[str]) -> str:
    """Return a safe name for an uploaded file that no other file of the page has.

    >>> choose_name("../../etc/part.stl", []), choose_name("part.STL", ["part.stl"]), choose_name("-x;y.obj", [])
    ('part.stl', 'part-2.STL', 'x_y.obj')
    """
    last = re.split(r"[/\\]", requested)[-1]
    stem, suffix = split_suffix(NOT_PLAIN.sub("_", last))
    suffix = re.sub(r"[^\w.]", "", suffix)[:20]
    (stem,) = safe_names([stem[:80]], ["file"])
    used, name, number = {other.lower() for other in taken}, f"{stem}{suffix}", 1
    while name.lower() in used:
        number += 1
        name = f"{stem}-{number}{suffix}"
    return name
