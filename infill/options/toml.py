"""TOML files of options: read, and written row by row."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from infill.errors import FormatError, ParameterError

OPTIONS = {"form": "as"}  # names of options that reports call otherwise


def read_toml(path: Path, *, example: str) -> dict[str, Any]:
    """Read a TOML file, or the one attached to a 3MF; dashes in its outermost names become underscores.

    Parameters
    ----------
    path : Path
        A text file, or a 3MF with one attached.
    example : str
        A line that the file should have, for the message.

    Raises
    ------
    FormatError
        If the file is missing or not TOML.
    """
    try:
        content = tomllib.loads(_read_text(path))
    except FileNotFoundError:
        raise FormatError(f"there is no config file {path}; check the name") from None
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror}; check the file") from error
    except FormatError:
        raise
    except RecursionError as error:
        raise FormatError(
            f"{path} is not TOML: lists lie too deep in one another; write lines such as {example}"
        ) from (error)
    except ValueError as error:  # not TOML, no text, or a number of thousands of digits
        from infill.files.broken import error_text

        raise FormatError(f"{path} is not TOML: {error_text(error)}; write lines such as {example}") from error
    return {name.replace("-", "_"): value for name, value in content.items()}


def _read_text(path: Path) -> str:
    """Return the text of a TOML file, or the TOML that is attached to a 3MF."""
    if path.suffix.lower() != ".3mf":
        return path.read_text(encoding="utf-8")
    from infill.formats.threemf import read_attached_settings

    return read_attached_settings(path)


def format_options(request: Mapping[str, Any], head: str) -> str:
    """Format the request of a report as a config file that makes it again.

    >>> print(format_options({"cell": 5.0, "form": "solid", "parameters": {"waves": 3}}, "again"))
    # again
    cell = 5.0
    as = "solid"
    <BLANKLINE>
    [set]
    waves = 3
    <BLANKLINE>
    """
    plain = {OPTIONS.get(name, name): value for name, value in request.items() if name != "parameters"}
    parameter_rows = format_rows(request.get("parameters") or {})
    return "\n".join(
        [f"# {head}", *format_rows(plain), *(["", "[set]", *parameter_rows] if parameter_rows else []), ""]
    )


def format_rows(values: Mapping[str, Any]) -> list[str]:
    """Format each value that is not None as a line of TOML.

    >>> format_rows({"cell": 5.0, "size": (60, 40), "frame": True, "waves": None})
    ['cell = 5.0', 'size = [60, 40]', 'frame = true']
    """
    return [f"{name} = {_format_value(value)}" for name, value in values.items() if value is not None]


def _format_value(value: object) -> str:
    """Return a value as TOML; raise for text that TOML cannot hold."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (tuple, list)):
        return f"[{', '.join(map(_format_value, value))}]"
    if isinstance(value, str):
        if any("\ud800" <= sign <= "\udfff" for sign in value):  # a name whose bytes are no text
            raise ParameterError(f"{value!a} is not text, and a TOML file holds only text; give another name")
        return json.dumps(value, ensure_ascii=False).replace(
            "\x7f", "\\u007f"
        )  # TOML escapes as JSON does, and DEL too
    return repr(value)
