"""What results that a browser can show have in common: a page, which notebooks show as well."""

from __future__ import annotations

import contextlib
from abc import ABC, abstractmethod
from pathlib import Path
from typing import BinaryIO, Final

from infill.errors import InfillError

LARGEST_EMBEDDED: Final = 12_000_000  # characters: notebooks keep every page that they show


class Viewable(ABC):
    """A result that a browser can show."""

    @abstractmethod
    def page(self, title: str | None = None) -> str:
        """Return an HTML page that shows the result, can be turned and cut open, and needs no network.

        Parameters
        ----------
        title : str, optional
            By default, a name that the result knows.
        """

    def write_page(self, file: BinaryIO, title: str | None = None) -> None:
        """Write `page` as UTF-8."""
        file.write(self.page(title).encode())

    def show(self) -> Path:
        """Open `page` in the browser; return its file, which stays in the folder for temporary files."""
        return open_in_browser(self.page())

    def _repr_html_(self) -> str | None:
        """Return the page in a frame, for notebooks; None if it cannot be made any more, or is large."""
        from infill.viewer.page import embed_page

        with contextlib.suppress(InfillError):
            page = self.page()
            return embed_page(page) if len(page) <= LARGEST_EMBEDDED else None
        return None


def open_in_browser(page: str, *, opens: bool = True) -> Path:
    """Write a page into the folder for temporary files, and open it unless it is not to be; return its path."""
    import tempfile
    import webbrowser

    with tempfile.NamedTemporaryFile(prefix="infill-", suffix=".html", delete=False) as file:
        file.write(page.encode())
    path = Path(file.name)
    if opens:
        webbrowser.open(path.as_uri())
    return path
