"""A user's request for a comparison of two prints, checked."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Annotated, Final

from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.gcode.dialect import ROLES
from infill.options.declaration import Option
from infill.options.keyword_options import parse_share
from patterns.given import suggest_name

# Every kind, with what it says.
KINDS: Final[dict[str, str]] = {
    "place": "a bead lies beside that of the old print",
    "missing": "a bead, a layer or an object of the old print is missing",
    "added": "a bead or a layer is new",
    "height": "a bead has another z",
    "material": "a bead, or an object in a layer, has another amount of filament",
    "E jump": "the extruder moves much further in one line than in the old print",
    "temperature": "of a nozzle, the bed or the chamber",
    "fan": "the speed of a fan",
    "acceleration": "or jerk, or another limit of the machine",
    "pressure advance": "as set at a bead",
    "retraction": "filament that is retracted at a bead or a travel",
    "tool": "the tool in use",
    "object": "the object that a command names to the printer",
    "speed": "a bead is printed faster",
    "travel": "the nozzle goes through what stands",
    "F0": "a feed rate of 0 or less",
    "number": "a word that is not a number",
    "unreadable": "a line that may move or extrude and cannot be read",
    "command": "a macro, a pause or another command is missing or new",
}
NOTHING = "none"
MAY_DIFFER, LIMITS, FILES = "What may differ", "Limits", "Files"


def parse_kinds(name: str, value: object) -> tuple[str, ...]:
    """Parse kinds of violations, with commas between or in a list, or raise UsageError.

    >>> parse_kinds("allow", "speed, F0")
    ('speed', 'F0')
    """
    return _choose_words(name, value, tuple(KINDS))


def parse_features(name: str, value: object) -> tuple[str, ...]:
    """Parse features by the word that stands for all slicers, or "none", or raise UsageError.

    >>> parse_features("changed", "sparse-infill,perimeter"), parse_features("changed", "none")
    (('sparse infill', 'perimeter'), ())
    """
    words = _choose_words(name, value, (*ROLES, NOTHING))
    return tuple(word for word in words if word != NOTHING)


def _choose_words(name: str, value: object, choices: tuple[str, ...]) -> tuple[str, ...]:
    """Return the choices that a text or a list names."""
    parts = value.split(",") if isinstance(value, str) else list(value) if isinstance(value, Collection) else [value]
    by_word = {choice.lower().replace(" ", "-"): choice for choice in choices}
    chosen = []
    for part in parts:
        word = part.strip().lower().replace(" ", "-").replace("_", "-") if isinstance(part, str) else ""
        if word not in by_word:
            remedy = suggest_name(word, list(by_word)) if word else f"give some of {', '.join(by_word)}"
            raise UsageError.about(name, f"is {quote_value(part)}; {remedy}")
        chosen.append(by_word[word])
    return tuple(dict.fromkeys(chosen))


@dataclass(frozen=True, kw_only=True)
class VerifyRequest:
    """Options of a comparison.

    Parameters
    ----------
    changed : tuple of str, optional
        Features that may have other paths, by `infill.gcode.dialect.ROLES`.
    allow : tuple of str
        Kinds of violations that are counted and not reported.
    material_limit : float
        Share by which the filament of an object in a layer may change, through the features that may.
    speed_limit : float
        Share by which a bead may be printed faster.
    plate : int, optional
        Plate of an archive.

    Raises
    ------
    ParameterError
        If one of them is out of range.
    """

    changed: Annotated[
        tuple[str, ...] | None,
        Option(
            "Features that the post-processor is meant to change, such as sparse-infill,perimeter; none: compare all.",
            MAY_DIFFER,
            unit="FEATURE,...",
            default="sparse-infill where NEW has the stamp of infill refill, else none",
            read=parse_features,
            typed=str,
        ),
    ] = None
    allow: Annotated[
        tuple[str, ...],
        Option(
            "Kinds of violations to count and not to report, such as speed,added.",
            MAY_DIFFER,
            unit="KIND,...",
            default="none",
            read=parse_kinds,
            typed=str,
        ),
    ] = ()
    material_limit: Annotated[
        float,
        Option(
            "How much the filament of an object in a layer may change, where features are meant to change.",
            LIMITS,
            unit="PERCENT",
            default="20%",
            read=parse_share,
            typed=str,
        ),
    ] = 0.2
    speed_limit: Annotated[
        float,
        Option(
            "How much faster a bead may be printed.",
            LIMITS,
            unit="PERCENT",
            default="5%",
            read=parse_share,
            typed=str,
        ),
    ] = 0.05
    plate: Annotated[
        int | None,
        Option("Which plate of an archive, .gcode.3mf.", FILES, unit="N", default="the first"),
    ] = None

    def __post_init__(self) -> None:
        if self.changed is not None:
            object.__setattr__(self, "changed", parse_features("changed", self.changed))
        object.__setattr__(self, "allow", parse_kinds("allow", self.allow) if self.allow else ())
        object.__setattr__(self, "material_limit", parse_share("material_limit", self.material_limit))
        object.__setattr__(self, "speed_limit", parse_share("speed_limit", self.speed_limit))
