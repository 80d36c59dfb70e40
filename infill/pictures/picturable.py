"""What all results have in common: a picture, which notebooks show."""

from __future__ import annotations

import contextlib
import io
from typing import TYPE_CHECKING, BinaryIO

from infill.errors import InfillError

if TYPE_CHECKING:
    from PIL import Image


class Picturable:
    """A result with a picture, which notebooks show."""

    def picture(self) -> Image.Image:
        """Return the picture."""
        raise NotImplementedError

    def write_picture(self, file: BinaryIO) -> None:
        """Write `picture` as PNG."""
        self.picture().save(file, format="PNG")

    def _repr_png_(self) -> bytes | None:
        """Return the picture for notebooks; None if it cannot be drawn any more."""
        with io.BytesIO() as file, contextlib.suppress(InfillError):
            self.write_picture(file)
            return file.getvalue()
        return None
