"""Errors that all readers raise for a file that is missing, broken, or of the wrong content."""

from __future__ import annotations

import contextlib
import os
import struct
import tokenize
import traceback
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from xml.etree import ElementTree

from infill.errors import FormatError, InfillError, MemoryLimitError
from infill.files.excerpts import excerpt

SMALLER_VOLUME_ADVICE = "cut the volume to the part that matters, or halve its resolution"
# The errors that libraries raise when a file is broken.
READER_ERRORS = (
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    NameError,
    ImportError,
    ArithmeticError,
    EOFError,
    RuntimeError,
    SyntaxError,
    AssertionError,
    struct.error,
    zlib.error,
    tokenize.TokenError,
    zipfile.BadZipFile,
    ElementTree.ParseError,
)
# Of these, the errors that this package raises for such files: numbers that are not finite, and truncated files.
DATA_ERRORS = (ValueError, OverflowError, EOFError, struct.error, zlib.error)


def missing_file(path: object) -> str:
    """Return the message about a file that does not exist.

    >>> missing_file("-")
    "'-' is not a file, and nothing is read from stdin; save it, and give the name of the file"
    """
    if str(path) == "-":
        return "'-' is not a file, and nothing is read from stdin; save it, and give the name of the file"
    return f"there is no file {path}; check the name"


def require_readable(path: str | os.PathLike[str], suffixes: Iterable[str], what: str) -> Path:
    """Return the path of a file that exists and has one of the suffixes, or raise FormatError."""
    source = Path(path)
    if source.suffix.lower() not in suffixes:
        name = source.name or str(source)
        raise FormatError(f"cannot tell {what} from {name!r}; use one of {', '.join(suffixes)}")
    if source.is_dir():
        raise FormatError(f"{source} is a folder; give a file")
    if not source.is_file():
        raise FormatError(missing_file(source))
    return require_not_empty(source)


def require_not_empty(path: Path) -> Path:
    """Return the path of a file that is not empty, or raise FormatError; a full disk leaves empty files."""
    if path.is_file() and path.stat().st_size == 0:
        raise FormatError(f"{path} is empty (0 bytes); export or save it again")
    return path


@contextlib.contextmanager
def wrap_reader_errors(path: Path, what: str | None = None, advice: str = "save it again") -> Iterator[None]:
    """Turn errors of a reader about a broken file into FormatError, and MemoryError into MemoryLimitError.

    Parameters
    ----------
    path : Path
    what : str, optional
        The complaint of the message, such as "is broken".
    advice : str
    """
    try:
        yield
    except InfillError:
        raise
    except MemoryError as error:
        raise MemoryLimitError(f"{path} needs more memory than there is; check it, or give a smaller one") from error
    except READER_ERRORS as error:
        if is_own_error(error) and not isinstance(error, DATA_ERRORS):
            raise
        complaint = what or f"is broken or not a {path.suffix} file"
        raise FormatError(f"{path} {complaint} ({error_text(error)}); {advice}") from error


@contextlib.contextmanager
def wrap_read_errors(path: Path) -> Iterator[None]:
    """Turn an error of the operating system, such as a missing permission, into a FormatError."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or error_text(error)
        raise FormatError(f"cannot read {path}: {reason}; check the file") from error


def is_own_error(error: BaseException) -> bool:
    """Tell whether this package raised the error itself, and not a library that it calls."""
    names = [frame.f_globals.get("__name__", "") for frame, _ in traceback.walk_tb(error.__traceback__)]
    return bool(names) and names[-1].split(".")[0] == __name__.split(".")[0]


def error_text(error: Exception) -> str:
    """Return the text of an error on one line, truncated if too long."""
    words = " ".join(str(error).split())
    if isinstance(error, LookupError) or not words:  # whose text is just a key
        words = f"{type(error).__name__}: {words}".removesuffix(": ")
    return excerpt(words, 200)
