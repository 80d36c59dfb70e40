"""The folders that an assistant may use: names are resolved, and whatever leads out of them is refused."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from infill.errors import FormatError, OutputError, UsageError
from infill.files.array_names import split_array_name
from infill.files.excerpts import quote_value
from infill.lazy.names import HDF5, is_url
from infill.options.trust import check_trusted

HEADERS = (".mhd", ".mha", ".nhdr", ".nrrd")  # volumes whose values may lie in files that they name
HEADER_BYTES = 2**16
DATA_FILE = re.compile(r"(?im)^[ \t]*(?:ElementDataFile[ \t]*=|data ?file[ \t]*:)[ \t]*(.*?)[ \t\r]*$")
PLACEHOLDERS = ("{name}", "{folder}")  # in names of outputs, of several inputs


@dataclass(frozen=True)
class AllowedFolders:
    """Folders whose files may be read and written.

    Parameters
    ----------
    roots : tuple of Path
        Absolute and without links. Relative names begin at the first that has such a file, else at the first.
    """

    roots: tuple[Path, ...]

    @classmethod
    def of(cls, folders: Iterable[Path]) -> Self:
        """Return the folders with these names.

        Raises
        ------
        UsageError
            If one of them is not a folder.
        """
        roots = []
        for folder in folders:
            if not folder.is_dir():
                raise UsageError.about("folder", f"is {quote_value(str(folder))}, which is not a folder")
            roots.append(folder.resolve())
        return cls(tuple(roots))

    def __str__(self) -> str:
        return ", ".join(map(str, self.roots))

    def find_input(self, key: str, value: object) -> str:
        """Return the path of a file or folder to read, with the name of an array in it where the value has one.

        Parameters
        ----------
        key : str
            Of the argument, for messages.
        value : object
            Its value, as the assistant sent it.

        Raises
        ------
        UsageError, FormatError
            If it is not a name, the file does not exist, or it or something in the folder leads out of the folders.
        """
        text = _check_name(key, value)
        dataset = HDF5.fullmatch(text)
        path, array = (Path(dataset["file"]), dataset["dataset"]) if dataset else split_array_name(text)
        real = self._resolve(key, str(path))
        if not real.exists():
            raise FormatError(f"there is no file {quote_value(str(path))} in {self}")
        for further in (*_links_below(real), *_data_files(real)):
            if not self._contains(further.resolve()):
                raise UsageError.about(key, f"leads to {quote_value(further.name)}, outside of {self}")
        return f"{real}:{array}" if array else str(real)

    def find_output(self, key: str, value: object) -> str:
        """Return the path of a file to write.

        Raises
        ------
        UsageError, OutputError
            If it is not a name, or it or a file whose name begins like it leads out of the folders.
        """
        text = _check_name(key, value)
        if any(word in text for word in PLACEHOLDERS) or "{" in str(Path(text).parent):
            raise UsageError.about(key, f"is {quote_value(text)}; one file goes in, so give the name of one")
        path = self._resolve(key, text)
        if not path.parent.is_dir():
            raise OutputError(f"there is no folder {path.parent}; make it first, or write elsewhere")
        stem = path.name.split("{")[0].split(".")[0]
        for link in path.parent.glob("*"):
            if link.is_symlink() and link.name.startswith(stem) and not self._contains(link.resolve()):
                raise OutputError(f"{link.name} is a link out of {self}; give another name")
        return str(path)

    def check_option(self, key: str, value: object) -> None:
        """Raise UsageError if an option names code to run, or a file outside of the folders."""
        for item in value if isinstance(value, (list, tuple)) else [value]:
            problem = None
            for root in self.roots:
                try:
                    check_trusted({key: item}, root / "request")
                except FormatError as error:
                    problem = error
                else:
                    problem = None
                    break
            if problem is not None:
                raise UsageError.about(
                    key, f"is {quote_value(item)}; give a word of the list, or a file in {self}; code is not run here"
                )

    def _resolve(self, key: str, text: str) -> Path:
        """Return the real path of a name, or raise UsageError if it lies outside."""
        named = Path(text).expanduser()
        candidates = [Path(os.path.realpath(root / named)) for root in self.roots]  # an absolute name stays as it is
        inside = [path for path in candidates if self._contains(path)]
        existing = [path for path in candidates if path.exists()]
        if not inside or (existing and not self._contains(existing[0])):
            raise UsageError.about(key, f"is {quote_value(text)}, outside of the folders of this server: {self}")
        return existing[0] if existing else inside[0]

    def _contains(self, path: Path) -> bool:
        """Tell whether a path without links lies in one of the folders."""
        return any(path.is_relative_to(root) for root in self.roots)


def _check_name(key: str, value: object) -> str:
    """Return a value that is the name of a file, or raise UsageError."""
    if not isinstance(value, str) or not value.strip() or "\0" in value:
        raise UsageError.about(key, f"is {quote_value(value)}; give the name of a file")
    if is_url(value):
        raise UsageError.about(key, f"is {quote_value(value)}; this server reads files only, no addresses")
    return value


def _links_below(path: Path) -> Iterator[Path]:
    """Yield the links in a folder and the folders below it; none of a file."""
    for folder, folders, files in os.walk(path):
        for name in (*folders, *files):
            entry = Path(folder, name)
            if entry.is_symlink():
                yield entry


def _data_files(path: Path) -> Iterator[Path]:
    """Yield the files that the header of a volume names for its values."""
    if path.suffix.lower() not in HEADERS or not path.is_file():
        return
    with open(path, "rb") as file:
        head = file.read(HEADER_BYTES).decode("latin-1")
    for named in DATA_FILE.finditer(head):
        names = head[named.end() :].splitlines() if named[1].upper().startswith("LIST") else [named[1]]
        for name in names:
            yield path.parent / name.strip().replace("\\", "/").replace("\0", "")
