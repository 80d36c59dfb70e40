"""The tools: each is a command, with the schema of its arguments from the declaration of its options."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args, get_origin

from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.lazy.names import is_lazy
from infill.options.command_words import assignments, flag_words
from infill.options.declaration import DeclaredOption, declared_options, read_options, unit_of
from infill.options.keyword_options import parse_flag, parse_word
from infill.options.trust import FILES

if TYPE_CHECKING:
    from infill.tool_server.folders import AllowedFolders

FLAG = re.compile(r"--[a-z][a-z-]*")
CODE = re.compile(r",? or module\.py:name|\. Or module\.py:name")  # in help texts: a tool runs no code of files
JOINED = re.compile(r"[-,|:=x]")  # in a placeholder that shows how a text is written
PLAIN_TYPES: Mapping[Any, str] = {float: "number", int: "integer", bool: "boolean"}
ArgumentKind = Literal["input", "inputs", "output", "word", "switch", "picture", "parameters", "slicer"]
TYPES: Mapping[ArgumentKind, dict[str, Any]] = {
    "inputs": {"type": "array", "items": {"type": "string"}, "minItems": 1},
    "switch": {"type": "boolean"},
    "picture": {"type": "boolean"},
    "parameters": {"type": "object"},
}


@dataclass(frozen=True, kw_only=True)
class ToolArgument:
    """An argument of a tool that is not a declared option: a file, a pattern, a switch.

    Parameters
    ----------
    kind : {"input", "inputs", "output", "word", "switch", "picture", "parameters", "slicer"}
    help : str
    flag : str
        On the command line; empty for one without.
    required : bool
    """

    kind: ArgumentKind
    help: str
    flag: str = ""
    required: bool = False

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema of its value."""
        choices = {"enum": list(_slicers())} if self.kind == "slicer" else {}
        return {**TYPES.get(self.kind, {"type": "string"}), **choices, "description": self.help}


def _slicers() -> tuple[str, ...]:
    """Return the slicers that projects are for."""
    from infill.projects.project import Slicer

    return get_args(Slicer)


OUTPUT = ToolArgument(kind="output", flag="-o", help="File to write, by suffix: .stl .3mf .obj .ply .glb.")
OVERWRITE = ToolArgument(kind="switch", flag="--force", help="Overwrite the output if it exists. (default: false)")
DRY_RUN = ToolArgument(kind="switch", flag="--dry-run", help="Only say what would be done; write nothing.")
PICTURE = ToolArgument(kind="picture", flag="--preview", help="Return a picture of the result. (default: true)")
PARAMETERS = ToolArgument(
    kind="parameters", flag="--set", help="Parameters of the pattern by name; the tool list says which it has."
)
PRINT = ToolArgument(kind="input", required=True, help="G-code from a slicer: .gcode, .bgcode or .gcode.3mf.")
WRITING = {"output": OUTPUT, "overwrite": OVERWRITE, "dry_run": DRY_RUN, "picture": PICTURE}


@dataclass(frozen=True, kw_only=True)
class CommandTool:
    """A command as a tool.

    Parameters
    ----------
    help : str
    arguments : mapping of str to ToolArgument
        Those that the declaration does not have.
    declared_in : tuple of str
        Module and class of the declaration of its options; empty if there is none.
    writes : bool
        Whether it writes files.
    judges : bool
        Whether exit status 1 can be a verdict.
    """

    help: str
    arguments: Mapping[str, ToolArgument]
    declared_in: tuple[str, ...] = ()
    writes: bool = False
    judges: bool = False

    @property
    def declaration(self) -> type[Any] | None:
        """The dataclass that declares its options."""
        if not self.declared_in:
            return None
        module, name = self.declared_in
        declaration: type[Any] = getattr(importlib.import_module(module), name)
        return declaration

    @property
    def options(self) -> Mapping[str, DeclaredOption]:
        """Its declared options by key."""
        return {} if self.declaration is None else declared_options(self.declaration)

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema of its arguments."""
        properties = {key: argument.schema() for key, argument in self.arguments.items()}
        properties |= {key: option_schema(entry) for key, entry in self.options.items()}
        for described in properties.values():
            described["description"] = self.use_keys(described["description"])
        return {
            "type": "object",
            "properties": properties,
            "required": [key for key, argument in self.arguments.items() if argument.required],
            "additionalProperties": False,
        }

    def use_keys(self, text: str) -> str:
        """Return a text with the keys of the tool in place of flags of its command.

        >>> TOOLS["fill"].use_keys("--line-width is -1 mm; --force overwrites")
        'line_width is -1 mm; overwrite=true overwrites'
        """
        keys = {
            argument.flag: f"{key}=true" if argument.kind == "switch" else key
            for key, argument in self.arguments.items()
        }
        keys |= {entry.flag: key for key, entry in self.options.items()}
        return FLAG.sub(lambda flag: keys.get(flag[0], flag[0]), text)


def option_schema(entry: DeclaredOption) -> dict[str, Any]:
    """Return the JSON schema of a declared option, of the type that the command line takes."""
    kind = entry.option.typed or entry.kind
    items = get_args(kind)[0] if get_origin(kind) in (list, tuple) else None
    schema: dict[str, Any] = {"type": PLAIN_TYPES.get(items or kind, "string")}
    if entry.choices:
        schema = {"type": "string", "enum": list(entry.choices)}
    if items is not None:
        schema = {"type": "array", "items": schema}
    unit = unit_of(entry.option.unit) or ("degrees" if entry.option.unit == "DEG" else "")
    is_text = schema.get("items", schema)["type"] == "string" and not entry.choices
    form = entry.option.unit if is_text and JOINED.search(entry.option.unit) else ""
    words = [CODE.sub("", entry.help), f"In {unit}." if unit and not is_text else "", f"Form: {form}." if form else ""]
    return {**schema, "description": " ".join(filter(None, words))}


def write_words(
    name: str, tool: CommandTool, values: Mapping[str, Any], folders: AllowedFolders, picture: Path
) -> list[str]:
    """Return a call of a tool as words of the command line.

    Parameters
    ----------
    name : str
        Of the command.
    tool : CommandTool
    values : mapping
        Arguments and options by key, as the assistant sent them.
    folders : AllowedFolders
    picture : Path
        Where a picture is written, if one is wanted.

    Raises
    ------
    InfillError
        If a value is of the wrong type or out of range, an argument is missing, or a file lies outside the folders.
    """
    arguments = {key: value for key, value in values.items() if value is not None}
    missing = next(
        (key for key, argument in tool.arguments.items() if argument.required and key not in arguments), None
    )
    if missing is not None:
        raise UsageError.about(missing, "is missing; give it")
    if tool.writes and "output" not in arguments and arguments.get("dry_run") is not True:
        raise UsageError.about("output", "is missing; name the file to write, or give dry_run=true")
    options = {key: value for key, value in arguments.items() if key not in tool.arguments}
    options = _check_options(name, tool, options, folders)
    if "picture" in tool.arguments and "picture" not in arguments and not _can_draw(arguments):
        arguments["picture"] = False
    words, last = [name, "--json"], list[str]()
    for key, argument in tool.arguments.items():
        for word in _argument_words(key, argument, arguments, folders, picture):
            (words if argument.flag else last).append(word)
    for key, value in options.items():
        words += flag_words(tool.options[key], value)
    return [*words, "--", *last]


def _can_draw(arguments: Mapping[str, Any]) -> bool:
    """Tell whether the result can have a picture: those of every label, and of volumes in chunks, have none."""
    every_label = any(arguments.get(key) for key in ("each_label", "together")) or "{" in str(arguments.get("output"))
    return not every_label and not is_lazy(str(arguments.get("source", "")))


def _check_options(name: str, tool: CommandTool, options: Mapping[str, Any], folders: AllowedFolders) -> dict[str, Any]:
    """Return options with the paths of their files; raise an error of the library for any that cannot be used."""
    if tool.declaration is None:
        if options:
            raise UsageError(f"{name} has no option {quote_value(next(iter(options)))}")
        return {}
    read_options(name, tool.declaration, options)
    checked = dict(options)
    for key, value in options.items():
        if tool.options[key].kind is Path:
            checked[key] = folders.find_input(key, value)
        elif key in FILES:
            folders.check_option(key, value)
    return checked


def _argument_words(
    key: str, argument: ToolArgument, arguments: Mapping[str, Any], folders: AllowedFolders, picture: Path
) -> Iterator[str]:
    """Yield the words of an argument; none if it is left out."""
    if argument.kind == "picture":
        wants = parse_flag(key, arguments.get(key, argument is PICTURE)) and not arguments.get("dry_run")
        yield from (argument.flag, str(picture)) if wants else ()
        return
    if key not in arguments:
        return
    value = arguments[key]
    if argument.kind == "input":
        yield folders.find_input(key, value)
    elif argument.kind == "inputs":
        for item in value if isinstance(value, list) and value else [value]:
            yield folders.find_input(key, item)
    elif argument.kind == "output":
        yield from (argument.flag, folders.find_output(key, value))
    elif argument.kind == "switch":
        yield from [argument.flag] if parse_flag(key, value) else ()
    elif argument.kind == "parameters":
        if not isinstance(value, Mapping):
            raise UsageError.about(key, f"is {quote_value(value)}; give names and values")
        for text in assignments(value):
            yield from (argument.flag, text)
    else:
        folders.check_option("pattern", value)
        yield from filter(None, (argument.flag, parse_word(key, value)))


TOOLS: Mapping[str, CommandTool] = {
    "list": CommandTool(
        help="List the infill patterns and what each is for; with a pattern, its parameters and a picture.",
        arguments={
            "pattern": ToolArgument(kind="word", help="Show this one alone."),
            "picture": ToolArgument(kind="picture", flag="--preview", help="Draw the pattern. (default: false)"),
        },
    ),
    "make": CommandTool(
        help="Make a block of infill from a pattern, as a closed mesh.",
        arguments={
            "pattern": ToolArgument(kind="word", required=True, help="A pattern by name; the tool list shows all."),
            **WRITING,
            "parameters": PARAMETERS,
        },
        declared_in=("infill.making.settings", "MakeSettings"),
        writes=True,
    ),
    "fill": CommandTool(
        help="Fill a closed part: a shell and infill as one solid, or a project for a slicer.",
        arguments={
            "part": ToolArgument(kind="input", required=True, help="Mesh: .stl .3mf .obj .ply .off .glb .gltf."),
            **WRITING,
            "parameters": PARAMETERS,
        },
        declared_in=("infill.lattices.settings", "FillOptions"),
        writes=True,
    ),
    "smooth": CommandTool(
        help="Smooth a scan, a segmentation, a mesh or points: no staircase, no shrinkage, a closed mesh.",
        arguments={
            "source": ToolArgument(
                kind="input",
                required=True,
                help="Mesh, volume (.nrrd .nii .mha .npy .tif .zarr .h5:/PATH, a folder of DICOM or slices) or points.",
            ),
            **WRITING,
        },
        declared_in=("infill.smoothing.settings", "SmoothSettings"),
        writes=True,
    ),
    "refill": CommandTool(
        help="Draw the infill of a sliced print again, with round corners or another pattern; the rest stays.",
        arguments={
            "print": PRINT,
            **WRITING,
            "output": ToolArgument(kind="output", flag="-o", help="G-code to write; needed unless dry_run."),
            "parameters": PARAMETERS,
        },
        declared_in=("infill.refilling.request", "Request"),
        writes=True,
    ),
    "motion": CommandTool(
        help="Plan every move of a print as firmware does: how long it takes, feature by feature, and why.",
        arguments={
            "print": PRINT,
            "other": ToolArgument(kind="input", help="A second print, to compare."),
            "picture": ToolArgument(
                kind="picture", flag="--plot", help="Draw the speeds of the middle layer. (default: false)"
            ),
        },
        declared_in=("infill.timing.request", "MotionOptions"),
    ),
    "verify": CommandTool(
        help="Compare a post-processed print with the one before: what changed that must not.",
        arguments={
            "before": ToolArgument(kind="input", required=True, help="The print that the post-processor read."),
            "after": ToolArgument(kind="input", required=True, help="The print that it wrote."),
        },
        declared_in=("infill.verifying.settings", "VerifyRequest"),
        judges=True,
    ),
    "check": CommandTool(
        help="Say whether meshes are printable and prints whole, and why not; or what a slicer will do with a 3MF.",
        arguments={
            "files": ToolArgument(
                kind="inputs", required=True, help="Meshes, or prints: .stl .3mf .obj .ply .glb .gcode .bgcode."
            ),
            "for": ToolArgument(kind="slicer", flag="--for", help="What this slicer will do with a .3mf."),
        },
        judges=True,
    ),
}
