"""File names with a placeholder for a label: ``bones/{label}.stl``, or ``{number}`` for its number."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from infill.files.file_names import safe_names
from infill.imaging.label_tables import Segment

NAME, NUMBER = "{label}", "{number}"


def is_template(path: Path) -> bool:
    """Tell whether a path has a placeholder for a label.

    >>> is_template(Path("bones/{label}.stl")), is_template(Path("bones.stl"))
    (True, False)
    """
    return NAME in str(path) or NUMBER in str(path)


def fill_template(path: Path, names: Sequence[str], segments: Sequence[Segment]) -> list[Path]:
    """Return the path of each label, with its name, made safe for every file system, and its number.

    >>> [path.name for path in fill_template(Path("{number}_{label}.stl"), ["L1/L2"], [Segment(value=4)])]
    ['4_L1_L2.stl']
    """
    safe = safe_names(names, [f"label_{segment.value}" for segment in segments])
    return [
        Path(str(path).replace(NUMBER, str(segment.value)).replace(NAME, name))
        for name, segment in zip(safe, segments, strict=True)
    ]
