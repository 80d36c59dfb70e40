"""The folder of a run in chunks: a temporary one, or one that lasts until the output stands, so that a run can resume.

    manifest.json    input, settings and version of the run, and the size of its chunks
    fields/          smoothed fields, a file for each chunk
    fields-1/ ...    those of further ways
    results/         results of finished tasks: see `infill.chunks.keeping`
    pieces/          simplified pieces of the surface
    lock             held by the run at work

Everything but the lock appears under its name once it is complete.
"""

from __future__ import annotations

import contextlib
import json
import os
import secrets
import shutil
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from infill.chunks.keeping import ResultFolder
from infill.errors import OutputError, ParameterError
from infill.files.whole_files import wrap_os_errors
from infill.kernels.threads import run_together, thread_count
from infill.lazy.identities import source_facts
from infill.lazy.volume import LazyVolume
from infill.smoothing.request import SmoothRequest
from infill.version import __version__

MANIFEST, LOCK = "manifest.json", "lock"
FOLDERS = ("fields", "results", "pieces")
FORMAT = 1  # of the folder: raised when its files are written in another way


@dataclass(frozen=True, kw_only=True)
class WorkFolder:
    """The folder of a run.

    Parameters
    ----------
    path : Path
    lasting : bool
        Whether a later run may resume.
    facts : mapping
        What a run has to have in common with this one to resume it, by name.
    size : (3,) int or None
        Bricks of a chunk of the run that is resumed.
    """

    path: Path
    lasting: bool
    facts: Mapping[str, str]
    size: tuple[int, int, int] | None = None

    @property
    def fields(self) -> str:
        """Folder of the smoothed fields of the way that is tried first."""
        return str(self.path / "fields")

    def fields_of(self, number: int) -> str:
        """Make the folder of the smoothed fields of a way, by its number, and return it."""
        path = self.path / f"fields-{number}" if number else self.path / "fields"
        with wrap_os_errors(self.path):
            path.mkdir(exist_ok=True)
        return str(path)

    @property
    def results(self) -> ResultFolder | None:
        """The results of tasks, if they are kept."""
        return ResultFolder(self.path / "results") if self.lasting else None

    @property
    def pieces(self) -> ResultFolder:
        """The simplified pieces of the surface."""
        return ResultFolder(self.path / "pieces")

    def begin(self, size: tuple[int, int, int]) -> None:
        """Write the manifest of a new run."""
        if not self.lasting or self.size is not None:
            return
        text = json.dumps({"format": FORMAT, "facts": dict(self.facts), "size": list(size)}, indent=1)
        part = self.path / f"{secrets.token_hex(4)}.part"
        with wrap_os_errors(self.path):
            part.write_text(text, encoding="utf-8")
            part.replace(self.path / MANIFEST)


def run_facts(volume: LazyVolume, request: SmoothRequest, choice: Mapping[str, object]) -> dict[str, str]:
    """Return the settings that decide the fields of a run, by name, for the manifest."""
    facts = {key: str(value) for key, value in request.facts().items() if key not in LATER}
    place = {
        "spacing": tuple(map(float, volume.spacing)),
        "origin": tuple(map(float, volume.origin)),
        "direction": np.asarray(volume.direction, dtype=float).tolist(),
        "space": volume.space,
    }
    chosen = {**choice, **place}
    return {
        **source_facts(volume.array),
        **facts,
        **{name: str(value) for name, value in chosen.items()},
        "version": __version__,
    }


LATER = ("crumbs", "tolerance", "max_triangles")  # options that change nothing before the surface is found


@contextlib.contextmanager
def open_work_folder(resume: str | os.PathLike[str] | None, facts: Mapping[str, str]) -> Iterator[WorkFolder]:
    """Yield a temporary folder, or the given one, which is removed once the block has ended without an error.

    Raises
    ------
    ParameterError
        If the folder holds something else, the run of another input or of other settings, or is in use.
    OutputError
        If it cannot be written.
    """
    if resume is None:
        path = Path(tempfile.mkdtemp(prefix="infill-chunks-"))
        try:
            _make_folders(path)
            yield WorkFolder(path=path, lasting=False, facts=facts)
        finally:
            shutil.rmtree(path, ignore_errors=True)
        return
    path = Path(resume)
    size = _check_folder(path, facts)
    with wrap_os_errors(path):
        path.mkdir(exist_ok=True)
        _make_folders(path)
    with _locked(path):
        for fields in path.glob("fields*"):
            _drop_damaged_fields(fields)
        yield WorkFolder(path=path, lasting=True, facts=facts, size=size)
        remove_work_folder(path)


def remove_work_folder(path: Path) -> None:
    """Remove the files of a run, and the folder if nothing else is in it."""
    for part in (*(path / name for name in FOLDERS), *path.glob("fields-*")):
        shutil.rmtree(part, ignore_errors=True)
    with contextlib.suppress(OSError):
        (path / MANIFEST).unlink(missing_ok=True)
        (path / LOCK).unlink(missing_ok=True)
        path.rmdir()


def _make_folders(path: Path) -> None:
    for name in FOLDERS:
        (path / name).mkdir(exist_ok=True)


def _check_folder(path: Path, facts: Mapping[str, str]) -> tuple[int, int, int] | None:
    """Return the size of the chunks of the run in a folder, None for a new one; raise an error for another run."""
    if not path.absolute().parent.is_dir():
        raise OutputError(f"there is no folder {path.parent}; make it first, or give another --resume folder")
    if not path.exists():
        return None
    if not path.is_dir():
        raise ParameterError.about("resume", f"is {str(path)!r}, which is not a folder; give another name")
    if not (path / MANIFEST).is_file():
        others = [entry.name for entry in path.iterdir() if entry.name not in (*FOLDERS, LOCK)]
        if others:
            raise ParameterError.about(
                "resume", f"is {str(path)!r}, which holds other files ({min(others)}); give a new or an empty folder"
            )
        return None
    remedy = "give the same again, or another folder"
    try:
        manifest: dict[str, Any] = json.loads((path / MANIFEST).read_text(encoding="utf-8"))
        begun, (along_x, along_y, along_z) = dict(manifest["facts"]), map(int, manifest["size"])
        number = manifest["format"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ParameterError.about(
            "resume", f"is {str(path)!r}, whose manifest cannot be read; remove that folder, or give another one"
        ) from error
    if number != FORMAT:
        begun, facts = {"version": str(begun.get("version"))}, {"version": facts["version"]}
    for name in (*facts, *begun):
        if begun.get(name) != facts.get(name):
            raise ParameterError.about(
                "resume",
                f"is {str(path)!r}, which holds a run whose {name} is {begun.get(name, 'none')}, and not "
                f"{facts.get(name, 'none')}; {remedy}",
            )
    return along_x, along_y, along_z


@contextlib.contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Hold the lock of a folder, where the system has such locks: it goes with the process, however that ends."""
    if find_spec("fcntl") is None:
        yield
        return
    import fcntl

    with wrap_os_errors(path):
        file = (path / LOCK).open("wb")
    with file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise ParameterError.about(
                "resume", f"is {str(path)!r}, in which another run is at work; wait for it, or give another folder"
            ) from error
        yield


def _drop_damaged_fields(folder: Path) -> None:
    """Remove fields whose checksums are wrong, and files that were being written."""
    for part in folder.glob("*.*"):
        if part.suffix != ".npz":
            part.unlink(missing_ok=True)
    paths = sorted(folder.glob("*.npz"))
    threads = thread_count()

    def check(first: int) -> None:
        for path in paths[first::threads]:
            if not _is_whole(path):
                path.unlink(missing_ok=True)

    run_together(*(lambda first=number: check(first) for number in range(threads)), threads=threads)


def _is_whole(path: Path) -> bool:
    """Tell whether the checksums of all arrays in a file are right."""
    try:
        with zipfile.ZipFile(path) as file:
            return file.testzip() is None
    except (OSError, zipfile.BadZipFile, ValueError, EOFError, NotImplementedError):
        return False
