"""Objects in a Python file of the user's: ``module.py:name``."""

from __future__ import annotations

import importlib.util
from types import ModuleType

from infill.errors import FormatError, InfillError
from infill.files.broken import error_text, require_readable

MARK = ".py:"


def names_code(text: str) -> bool:
    """Tell whether a text is ``module.py:name``, so that a file is run.

    >>> names_code("mine.py:waves"), names_code("gyroid")
    (True, False)
    """
    return MARK in text


def load_object(text: str) -> object:
    """Run a file and return its object for ``module.py:name``, or raise FormatError.

    Raises
    ------
    FormatError
        If the file is missing, it fails, or it has no object of this name.
    """
    file, _, name = text.rpartition(":")
    path = require_readable(file, [".py"], "a module")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except InfillError:
        raise
    except (Exception, SystemExit) as error:  # whatever a file of the user's raises
        raise FormatError(f"{path} cannot be loaded ({user_error_text(error)}); run it by itself first") from error
    if not hasattr(module, name):
        own = _own_names(module)
        advice = f"it has {', '.join(own)}" if own else "it defines no class and no function"
        raise FormatError(f"{path} has nothing called {name!r}; {advice}")
    return getattr(module, name)


def user_error_text(error: Exception | SystemExit) -> str:
    """Return the text of an error of the user's code on one line; that of an exit says so.

    >>> user_error_text(ValueError("x")), user_error_text(SystemExit(3))
    ('x', 'it exits with 3')
    """
    return f"it exits with {error.code}" if isinstance(error, SystemExit) else error_text(error)


def _own_names(module: ModuleType) -> list[str]:
    """List the public classes and functions that a module defines, in its order."""
    return [
        name
        for name, value in vars(module).items()
        if not name.startswith("_") and callable(value) and getattr(value, "__module__", None) == module.__name__
    ]
