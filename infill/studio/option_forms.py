"""Options as a page shows them, and as it sends them back: from the declarations that the command line has too.

An option that names a file refers to an uploaded one by its id, ``{"file": "f1"}``; no text of a request is ever taken
for the name of a file or of a module.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_origin

from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.options.declaration import DeclaredOption, declared_options, unit_of
from patterns.declared import Parameter, as_json_value, parameters

SETS = "set"  # the key under which a request has the parameters of a pattern
PLACES = ("z=", "box=")  # how the place of a region begins, if it is no file
FIELDS = ("x", "y", "z", "skin", "roofs")  # that need no file
# Bounds and steps of sliders: what people choose, not what is allowed.
USUAL: Mapping[str, tuple[float, float]] = {
    "density": (0.05, 0.6),
    "cell": (2.0, 20.0),
    "line_width": (0.3, 3.0),
    "wall": (0.4, 4.0),
    "angle": (0.0, 180.0),
    "drain": (1.0, 6.0),
    "smooth_radius": (0.0, 2.0),
    "tolerance": (0.0, 0.2),
    "steps": (0.0, 60.0),
    "height": (1.0, 60.0),
    "overlap": (0.0, 0.5),
    "voxel": (0.2, 3.0),
    "resolution": (50.0, 400.0),
    "despeckle": (0.0, 100.0),
    "crumbs": (0.0, 100.0),
    "max_deviation": (0.0, 2.0),
    "acceleration": (500.0, 20000.0),
    "shell": (0.5, 5.0),
}
FILE_OPTIONS = ("pattern", "by", "labels", "printer", "region")


@dataclass(frozen=True, kw_only=True)
class FormOption:
    """An option as a page shows it.

    Parameters
    ----------
    key, flag, group, help, unit : str
    kind : {"number", "whole", "flag", "choice", "text"}
    choices : tuple of str
    default : any
        Plain value, or None where the default follows from other options.
    default_text : str
        The default in words.
    least, most : float or None
        Ends of a slider.
    many : bool
        Whether the value is a list.
    file : bool
        Whether the value may be an uploaded file.
    """

    key: str
    flag: str
    group: str
    help: str
    kind: Literal["number", "whole", "flag", "choice", "text"]
    unit: str = ""
    choices: tuple[str, ...] = ()
    default: Any = None
    default_text: str = ""
    least: float | None = None
    most: float | None = None
    many: bool = False
    file: bool = False

    def facts(self) -> dict[str, Any]:
        """Return the option as plain values."""
        return {**vars(self), "choices": list(self.choices)}

    @classmethod
    def of(cls, declared: DeclaredOption) -> FormOption:
        """Return the form of a declared option."""
        option = declared.option
        choices = declared.choices
        kinds: dict[Any, Any] = {float: "number", int: "whole", bool: "flag"}
        kind: Any = "choice" if choices else kinds.get(declared.kind, "text")
        least, most = USUAL.get(declared.key, (None, None))
        return cls(
            key=declared.key,
            flag=declared.flag,
            group=option.group,
            help=option.help,
            kind=kind,
            unit=unit_of(option.unit) or ("degrees" if option.unit == "DEG" else ""),
            choices=choices,
            default=_plain_default(declared.default),
            default_text=option.default,
            least=least,
            most=most,
            many=get_origin(option.typed) in (list, tuple),
            file=declared.key in FILE_OPTIONS,
        )

    @classmethod
    def of_parameter(cls, name: str, default: object, described: Parameter) -> FormOption:
        """Return the form of a parameter of a pattern."""
        low, high = (end if abs(end) < float("inf") else None for end in (described.low, described.high))
        plain = as_json_value(default)
        single = not isinstance(plain, list) and described.count == 1
        kind: Any = "flag" if isinstance(plain, bool) else "text" if not single else "number"
        return cls(
            key=name,
            flag=f"--set {name}=",
            group="Pattern",
            help=described.help,
            kind="whole" if kind == "number" and described.whole else kind,
            unit=described.shown_unit,
            default=plain,
            least=low,
            most=high,
            many=not single,
        )


def _plain_default(default: object) -> Any:  # noqa: ANN401 - as JSON has it
    """Return a default as JSON has it."""
    if isinstance(default, tuple):
        return list(default)
    return default if isinstance(default, (str, int, float, bool)) else None


def describe_options(declaration: type[Any], leave_out: Collection[str] = ()) -> list[dict[str, Any]]:
    """Return the options of a product as plain values."""
    declared = declared_options(declaration)
    return [FormOption.of(entry).facts() for key, entry in declared.items() if key not in leave_out]


def describe_parameters(kind: object) -> list[dict[str, Any]]:
    """Return the parameters of a pattern as plain values."""
    return [
        FormOption.of_parameter(name, field.default, described).facts()
        for name, (field, described) in parameters(kind).items()
    ]


def name_files(
    options: Mapping[str, Any], files: Mapping[str, str], allowed: Collection[str], patterns: Iterable[str]
) -> dict[str, Any]:
    """Return options with the names of uploaded files in place of their ids, and without those that are null.

    Parameters
    ----------
    options : mapping
        As the page sent them.
    files : mapping of str to str
        Names of files by id.
    allowed : collection of str
        Keys of the options that the product has here.
    patterns : iterable of str
        Names of patterns.

    Raises
    ------
    UsageError
        If a text would name a file or a module, an id is unknown, or the product has no such option here.
    """
    named: dict[str, Any] = {}
    for key, value in options.items():
        if value is None:
            continue
        if key not in allowed and key != SETS:
            raise UsageError(f"there is no option {quote_value(key)} here")
        if key in FILE_OPTIONS:
            values = value if isinstance(value, list) else [value]
            texts = [_name_file(key, item, files, patterns) for item in values]
            named[key] = texts if isinstance(value, list) else texts[0]
        else:
            named[key] = value
    return named


def _name_file(key: str, value: object, files: Mapping[str, str], patterns: Iterable[str]) -> str:
    """Return one value of an option that may be a file, as a text."""
    if isinstance(value, Mapping):
        name = files.get(str(value.get("file")))
        if name is None:
            raise UsageError.about(key, "refers to a file that is not on this page; upload it again")
        array, settings = value.get("array"), value.get("settings")
        array_words = f":{array}" if array else ""
        setting_words = f":{_check_region_pattern(key, settings, patterns)}" if settings else ""
        return f"{name}{array_words}{setting_words}"
    if not isinstance(value, str):
        raise UsageError.about(key, f"is {quote_value(value)}; give a word, or an uploaded file")
    if key == "pattern" and not _is_pattern(value, patterns):
        raise UsageError.about(key, f"is {quote_value(value)}; choose a pattern of the list, or upload a drawing")
    if key == "by" and value not in FIELDS:
        raise UsageError.about(key, f"is {quote_value(value)}; choose from {', '.join(FIELDS)}, or upload a file")
    if key in ("labels", "printer"):
        raise UsageError.about(key, f"is {quote_value(value)}; upload the file")
    if key == "region":
        if not value.startswith(PLACES):
            raise UsageError.about(key, f"is {quote_value(value)}; begin with z= or box=, or upload a mesh")
        return _check_region_pattern(key, value, patterns)
    return value


def _is_pattern(word: str, patterns: Iterable[str]) -> bool:
    """Tell whether a word is the name of a pattern, or a choice in place of one."""
    return word in ("keep", "auto") or word in set(patterns)


def _check_region_pattern(key: str, text: object, patterns: Iterable[str]) -> str:
    """Return the text of a region; raise UsageError if its pattern is none of the list."""
    words = str(text).replace(":", ",").split(",")
    for word in words:
        name, _, value = word.partition("=")
        if name.strip() == "pattern" and not _is_pattern(value.strip(), patterns):
            raise UsageError.about(key, f"has the pattern {quote_value(value)}; choose a pattern of the list")
    return str(text)
