"""What all readers say of a file that is missing, broken, or holds something else than it should."""

from __future__ import annotations

import contextlib
import math
import os
import struct
import tokenize
import traceback
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from numpy.typing import NDArray

from infill.errors import FormatError, InfillError, MemoryLimitError, ParameterError
from infill.volume import AXES, Volume

SMALLER = "cut the volume to the part that matters, or halve its resolution"
# What the libraries that read for us raise for files that hold something else than they should.
BROKEN = (
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
# Of these, what our own lines raise for such files: numbers that are none or infinite, and files that end too early.
BY_DATA = (ValueError, OverflowError, EOFError, struct.error, zlib.error)
COLOURS = (2, 3, 4)  # numbers per cell of a picture that is not grey


def readable(path: str | os.PathLike[str], suffixes: Iterable[str], what: str) -> Path:
    """Return the path of a file that is there and has one of the suffixes, or raise FormatError."""
    source = Path(path)
    if source.suffix.lower() not in suffixes:
        raise FormatError(f"cannot tell {what} from {source.name!r}; use one of {', '.join(suffixes)}")
    if not source.is_file():
        raise FormatError(f"there is no file {source}; check the name")
    return source


@contextlib.contextmanager
def told_broken(path: Path, what: str | None = None, advice: str = "save it again") -> Iterator[None]:
    """Turn what a reader says of a broken file into an error of ours; an error in our own lines stays what it is.

    Parameters
    ----------
    path : Path
    what : str, optional
        What to say of it, such as "is broken".
    advice : str
    """
    try:
        yield
    except InfillError:
        raise
    except MemoryError as error:
        raise MemoryLimitError(f"{path} needs more memory than there is; check it, or give a smaller one") from error
    except BROKEN as error:
        if is_ours(error) and not isinstance(error, BY_DATA):
            raise
        said = what or f"is broken or no {path.suffix} file"
        raise FormatError(f"{path} {said} ({one_line(error)}); {advice}") from error


def is_ours(error: BaseException) -> bool:
    """Return whether an error was raised by a line of this package, and not by a library that it calls."""
    names = [frame.f_globals.get("__name__", "") for frame, _ in traceback.walk_tb(error.__traceback__)]
    return bool(names) and names[-1].split(".")[0] == __name__.split(".")[0]


def one_line(error: Exception) -> str:
    """Return what an error says, in one line that is not too long."""
    words = " ".join(str(error).split())
    if isinstance(error, LookupError) or not words:  # whose words are but a key
        words = f"{type(error).__name__}: {words}".removesuffix(": ")
    return words if len(words) <= 200 else words[:200] + "…"


def checked_volume(path: Path, values: NDArray[Any], **place: Any) -> Volume:  # noqa: ANN401 - hands on
    """Return the checked volume of values [x, y, z]."""
    if values.dtype.kind == "c":
        raise FormatError(f"{path} holds complex numbers; save their magnitude or their phase")
    if values.dtype.kind not in "biuf":
        raise FormatError(f"{path} holds values of type {values.dtype}; save numbers or booleans")
    if values.ndim > AXES and values.shape[-1] in COLOURS:
        raise FormatError(f"{path} holds {values.shape[-1]} numbers per cell, shape {values.shape}; save one as grey")
    if values.ndim != AXES or values.size == 0:
        raise FormatError(f"{path} holds an array of shape {values.shape}; save three axes, with cells")
    if not values.dtype.isnative:
        values = values.astype(values.dtype.newbyteorder("="))
    low, high = values.min().item(), values.max().item()
    if not (math.isfinite(low) and math.isfinite(high)):
        raise FormatError(f"{path} holds cells that are NaN or infinite; fill or cut those cells first")
    if low == high:
        raise FormatError(f"{path} holds {low:g} in all cells, so no surface; check that it is the right file")
    try:
        return Volume(values=values, **place)
    except ParameterError as error:
        raise FormatError(f"{path} has no usable place in space: {error}; resample it, or save it again") from error
