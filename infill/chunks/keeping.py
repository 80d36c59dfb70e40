"""Results of tasks in a folder, one file each, so that an interrupted run goes on where it stopped."""

from __future__ import annotations

import contextlib
import secrets
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from infill.chunks.encoding import DamagedDataError, decode_data, digest_data, encode_data

SUFFIX = ".kept"
FREE_SPACE = 0.02  # of the disk: it stays free; results are small


class NotKept:
    """Stands for the result of a task that is not kept."""


NOT_KEPT = NotKept()


@dataclass(frozen=True)
class ResultFolder:
    """A folder with the results of tasks.

    Parameters
    ----------
    folder : Path
    """

    folder: Path

    def keys(self, function: Callable[..., Any], shared: Any, items: Any) -> list[str] | None:  # noqa: ANN401
        """Return a name for each call `function(shared, *item)`; None if the arguments are more than plain data."""
        try:
            common = digest_data(function.__module__, function.__qualname__, shared)
            return [digest_data(common, item) for item in items]
        except (TypeError, AttributeError):
            return None

    def find(self, key: str) -> Any:  # noqa: ANN401
        """Return a result; NOT_KEPT if there is none, or a damaged one, which is removed."""
        path = self._path(key)
        try:
            return decode_data(path.read_bytes())
        except OSError:
            return NOT_KEPT
        except DamagedDataError:
            with contextlib.suppress(OSError):
                path.unlink(missing_ok=True)
            return NOT_KEPT

    def keep(self, key: str, result: Any) -> bool:  # noqa: ANN401
        """Write a result under a temporary name and rename it; return whether there was room, and it is plain data."""
        try:
            pieces = encode_data(result)
        except TypeError:
            return False
        try:
            space = shutil.disk_usage(self.folder)
            if space.free - sum(map(len, pieces)) < FREE_SPACE * space.total:
                return False
            self.write(key, pieces)
        except OSError:
            return False
        return True

    def write(self, key: str, pieces: list[bytes]) -> None:
        """Write the bytes of a result; raise OSError if they cannot be written."""
        path = self._path(key)
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(f"{secrets.token_hex(8)}.part")
        try:
            with part.open("xb") as file:
                file.writelines(pieces)
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)

    def _path(self, key: str) -> Path:
        """Return the file of a result."""
        return self.folder / key[:2] / f"{key}{SUFFIX}"
