"""Words of slicers: the comments that carry structure, and the names of features.

There are two families of tags, ``;TYPE:Internal infill`` (PrusaSlicer, SuperSlicer, OrcaSlicer for most printers) and
``; FEATURE: Sparse infill`` (Bambu Studio, OrcaSlicer for Bambu printers), and those of Cura, spelled like the first.
The family in a file of OrcaSlicer depends on the printer, so all of them are understood in every file.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Final

OTHER_ROLE: Final = "other"  # role of a name that no known slicer writes
UNTAGGED: Final = "untagged"  # role of everything before the first tag

MAX_TAG_BYTES: Final = 200  # bytes of a comment that are examined
TOOL_CODES: Final = ("M108", "M135")  # select a tool by T: Sailfish and MakerWare

# Meaning of a comment by its prefix. The rest of the line is its value.
TAGS: Final[dict[bytes, str]] = {
    b";TYPE:": "role",
    b"; FEATURE:": "role",
    b";LAYER_CHANGE": "layer",
    b"; CHANGE_LAYER": "layer",
    b";LAYER:": "layer",
    b";Z:": "z",
    b"; Z_HEIGHT:": "z",
    b";HEIGHT:": "height",
    b"; LAYER_HEIGHT:": "height",
    b";WIDTH:": "width",
    b"; LINE_WIDTH:": "width",
    b";WIPE_START": "wipe start",
    b"; WIPE_START": "wipe start",
    b";WIPE_END": "wipe end",
    b"; WIPE_END": "wipe end",
    b"; PURGING FINISHED": "purged",
    b";PURGING FINISHED": "purged",
    b"; CP TOOLCHANGE START": "tool change",
    b"; CP TOOLCHANGE END": "tool change end",
    b"; WIPE_TOWER_START": "tool change",
    b"; WIPE_TOWER_END": "tool change end",
    b"; FLUSH_START": "tool change",
    b"; FLUSH_END": "tool change end",
    b"; NOZZLE_CHANGE_START": "tool change",
    b"; NOZZLE_CHANGE_END": "tool change end",
    b";MESH:": "object",
    b"; printing object ": "object",
    b"; start printing object": "object",
    b"; stop printing object": "object end",
}

PREFIX_LENGTH: Final = min(map(len, TAGS))  # bytes
_BY_BEGINNING: Final = {
    prefix[:PREFIX_LENGTH]: [each for each in TAGS.items() if each[0].startswith(prefix[:PREFIX_LENGTH])]
    for prefix in TAGS
}

ROLES: Final[dict[str, tuple[bytes, ...]]] = {
    "sparse infill": (b"Internal infill", b"Sparse infill", b"FILL"),
    "solid infill": (b"Solid infill", b"Internal solid infill", b"Floating vertical shell", b"SKIN"),
    "top solid infill": (b"Top solid infill", b"Top surface"),
    "bottom solid infill": (b"Bottom surface",),
    "bridge infill": (b"Bridge infill", b"Bridge"),
    "internal bridge infill": (b"Internal bridge infill", b"Internal Bridge"),
    "gap fill": (b"Gap fill", b"Gap infill", b"Thin wall"),
    "ironing": (b"Ironing",),
    "perimeter": (b"Perimeter", b"Internal perimeter", b"Inner wall", b"WALL-INNER"),
    "external perimeter": (b"External perimeter", b"Outer wall", b"WALL-OUTER"),
    "overhang perimeter": (b"Overhang perimeter", b"Overhang wall", b"Bridge wall"),
    "support": (b"Support material", b"Support", b"Support transition", b"SUPPORT"),
    "support interface": (
        b"Support material interface",
        b"Support interface",
        b"Support ironing",
        b"SUPPORT-INTERFACE",
    ),
    "skirt": (b"Skirt/Brim", b"Skirt", b"Brim", b"SKIRT"),
    "wipe tower": (b"Wipe tower", b"Prime tower", b"PRIME-TOWER"),
    "custom": (b"Custom",),
}
_ROLE_OF: Final = {name: role for role, names in ROLES.items() for name in names}


def role_of(name: bytes) -> str:
    """Return the role of a feature that a slicer names so: one word for all slicers, "other" or "untagged".

    An empty name is "untagged": everything before the first tag. Full names count: "Gap infill" is not sparse infill.

    >>> role_of(b"Internal infill"), role_of(b"FILL"), role_of(b"Gap infill"), role_of(b"Mill")
    ('sparse infill', 'sparse infill', 'gap fill', 'other')
    """
    return _ROLE_OF.get(name.strip(), OTHER_ROLE if name else UNTAGGED)


def tool_of(code: str, words: Mapping[str, float | None], text: bytes) -> str:
    """Return the tool that a command selects, always as the same word; "" if it selects none.

    Parameters
    ----------
    code : str
        Such as "T1".
    words : mapping
        Its numbers by letter.
    text : bytes
        The full line.

    >>> tool_of("T1", {}, b"T1"), tool_of("M135", {"T": 1.0}, b"M135 T1"), tool_of("M104", {"S": 210.0}, b"M104 S210")
    ('T1', 'T1', '')
    """
    if code[:1] == "T" and code[1:].isdigit():
        return code
    if code in TOOL_CODES:
        number = words.get("T")
        return "" if number is None else f"T{number:g}"
    if code.upper() == "ACTIVATE_EXTRUDER":
        return text.partition(b";")[0].strip().upper().decode("latin-1")
    return ""


def object_of(code: str, text: bytes) -> tuple[str, str] | None:
    """Return the object that a command names: Marlin's M486 or Klipper's EXCLUDE_OBJECT; None for other commands.

    Returns
    -------
    tuple of str and str, or None
        "number" and a number, "name" and the name of the object with the last number, "object" and a name, or "end"
        and nothing.

    >>> object_of("M486", b"M486 S2"), object_of("M486", b"M486 Acup.stl ; first"), object_of("M486", b"M486 S-1")
    (('number', '2'), ('name', 'cup.stl'), ('end', ''))
    >>> object_of("EXCLUDE_OBJECT_START", b"EXCLUDE_OBJECT_START NAME='cup_1'"), object_of("G1", b"G1 X1")
    (('object', 'cup_1'), None)
    """
    kind = code.upper()
    if kind not in ("M486", "EXCLUDE_OBJECT_START", "EXCLUDE_OBJECT_END"):
        return None
    if kind == "EXCLUDE_OBJECT_END":
        return "end", ""
    word = text.partition(b";")[0].strip()[len(code) :].strip().decode("utf-8", "replace")
    if kind == "EXCLUDE_OBJECT_START":
        _, found, name = word.partition("=")
        return ("object", name.strip().strip("'\"")) if found else None
    letter, value = word[:1].upper(), word[1:].strip()
    if letter == "A":
        return "name", value.strip('"')
    if letter != "S":
        return None
    return ("end", "") if value.startswith("-") else ("number", value)


@lru_cache(maxsize=4096)  # a print has few different ones, ten thousand times
def parse_tag(comment: bytes) -> tuple[str, bytes] | None:
    r"""Parse a comment line; return its meaning and value, or None for a comment without structure.

    Parameters
    ----------
    comment : bytes
        The line, from its semicolon on.

    Returns
    -------
    tuple of str and bytes, or None
        One of the words of `TAGS`, and the rest of the line, without blanks around it.

    >>> parse_tag(b";TYPE:Internal infill\n"), parse_tag(b"; FEATURE: Sparse infill"), parse_tag(b"; a remark")
    (('role', b'Internal infill'), ('role', b'Sparse infill'), None)
    >>> parse_tag(b";LAYER_CHANGE\n"), parse_tag(b";LAYER:12"), parse_tag(b";LAYER_COUNT:99")
    (('layer', b''), ('layer', b'12'), None)
    """
    for prefix, meaning in _BY_BEGINNING.get(comment[:PREFIX_LENGTH], ()):
        if comment.startswith(prefix):
            return meaning, comment[len(prefix) :].strip()
    return None
