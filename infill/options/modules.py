"""What a Python file of the user's holds: ``module.py:name``."""

from __future__ import annotations

import importlib.util

from infill.errors import FormatError
from infill.files.broken import readable, told_broken

MARK = ".py:"


def names_code(text: str) -> bool:
    """Return whether a text is ``module.py:name``, for which a file is run.

    >>> names_code("mine.py:waves"), names_code("gyroid")
    (True, False)
    """
    return MARK in text


def object_in(text: str) -> object:
    """Return what ``module.py:name`` stands for; the file is run for it.

    Raises
    ------
    FormatError
        If there is no such file, it fails, or nothing in it has this name.
    """
    file, _, name = text.rpartition(":")
    path = readable(file, [".py"], "a module")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with told_broken(path, "cannot be loaded", "run it by itself first"):
        spec.loader.exec_module(module)
    if not hasattr(module, name):
        raise FormatError(f"{path} has nothing called {name!r}; check the name")
    return getattr(module, name)
